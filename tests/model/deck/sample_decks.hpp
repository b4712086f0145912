#pragma once

#include <string>
#include <string_view>

namespace arcwall::deck {

/// A column under an end load between two walls: the shortest deck that has all that most decks have.
inline constexpr std::string_view column_deck = R"toml(title = "Column"

[material.steel]
E = 2.1e4

[section.square]
shape = "rectangle"
width = 0.1
height = 0.2

[point]
A = [0.0, 0.0]
B = [2.0, 0.0]

[member.column]
from = "A"
to = "B"
theory = "euler-bernoulli"
material = "steel"
section = "square"
elements = 80

[support]
A = ["x", "z"]
B = ["z"]

[[load]]
at = "B"
force = [-1.0, 0.0]
)toml";

/// Every key of a deck, with values that are not the defaults.
inline constexpr std::string_view full_deck = R"toml(title = "Everything"
description = "two lines\nand a \"quote\""

[units]
length = "cm"
force = "kN"

[material.steel]
E = 2.1e4
nu = 0.29
[material.plain]
E = 7
expansion = 1.2e-5

[section.square]
shape = "rectangle"
width = 0.1
height = 0.2
shear_correction = 0.8
[section.rod]
shape = "circle"
radius = 0.5
[section.pipe]
shape = "tube"
radius = 0.5
thickness = 0.05
[section.bar]
shape = "general"
A = 6.0
I = 2.0
[section.slab]
shape = "general"
A = 6.0
I = 2.0
shear_area = 5.0
height = 1.5

[point]
B = [2.0, 0.0]
A = [0.0, 0.0]
C = [4, 1]
D = [6.0, 1.0]

[member.column]
from = "A"
to = "B"
theory = "euler-bernoulli"
material = "plain"
section = "square"
elements = 80
imperfection = [{ shape = "sine", amplitude = 1e-3, waves = 1 }, { shape = "sine", amplitude = -1e-4, waves = 3 }]
hinge = ["to"]
[member.arch]
from = "B"
to = "C"
theory = "essenburg"
order = 1
along = "director"
material = "steel"
section = "rod"
elements = 10
via = [3.0, 0.9]
[member.wave]
from = "C"
to = "D"
theory = "reissner"
material = "steel"
section = "pipe"
elements = 12
sine = { rise = 0.1, waves = 2 }
imperfection = { shape = "sine", amplitude = 1e-3, waves = 1 }
[member.spline]
from = "A"
to = "D"
theory = "elastica"
order = 4
material = "plain"
section = "slab"
elements = 7
curve = { x = [0.0, 2.0, 4.0, 6.0], z = [0.0, 2.0, 2.0, 1.0] }
hinge = ["from", "to"]
[member.strut]
from = "A"
to = "C"
theory = "truss"
strain = "log"
material = "plain"
section = "bar"
elements = 1

[support]
A = ["x", "z", "rotation"]
D = ["z", "thickness", "thickness2"]

[[load]]
at = "B"
force = [-1.0, 0.5]
moment = 0.25
[[load]]
at = "column:0.25"
moment = 2.0
constant = true
[[load]]
on = "arch"
distributed = [0.0, -3.0]
frame = "member"

[[spring]]
name = "prop"
at = "column:0.5"
stiffness = { x = 2.5, rotation = 0.5 }
[[spring]]
between = ["A", "C"]
stiffness = { z = 0.125 }
[[spring]]
on = "wave"
foundation = { z = 3.0 }

[[wall]]
name = "upper"
side = "above"
contact_surface = "axis"
profile = { type = "flat", z = 5.0 }
[[wall]]
name = "slope"
side = "below"
members = ["column", "arch"]
profile = { type = "line", z = -5.0, slope = 0.05 }
[[wall]]
name = "hill"
side = "below"
members = ["column"]
profile = { type = "circle", centre = [1.0, -9.0], radius = 4.9 }
motion = { x = 0.5, z = -1.0, rotation = 0.25, about = [1.0, -9.0] }
[[wall]]
name = "bowl"
side = "below"
members = ["column"]
profile = { type = "parabola", apex = [1.0, -4.0], curvature = 0.1 }
[[wall]]
name = "ground"
side = "below"
members = ["column"]
profile = { type = "spline", x = [-1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0], z = [-3, -3, -3, -3, -4, -3, -3, -3, -3, -3] }
[[wall]]
name = "stop"
members = ["column"]
outline = { type = "half-plane", point = [20.0, 0.0], normal = [-1.0, 0.75] }
[[wall]]
name = "bore"
members = ["column"]
outline = { type = "circle", centre = [1.0, 0.75], radius = 30.0, structure = "inside" }
[[wall]]
name = "ramp"
members = ["column"]
outline = { type = "polyline", x = [10.5, 20.0, 30.0], z = [-30.0, -20.0, -31.0], closed = true, structure = "outside" }
corner_radius = 0.125
[[wall]]
name = "cam"
members = ["column"]
outline = { type = "ellipse", centre = [1.0, -20.0], axes = [2.5, 1.25], angle = 0.75 }
[[wall]]
name = "lumen"
members = ["column"]
outline = { type = "curve", x = [-40.5, 0.5, 40.0], z = [-40.0, -38.5, -41.0] }

[contact]
method = "augmented"
points = "nodes"
penalty = 1e5
gap_tolerance = 1e-9

[path]
method = "displacement"
output_at = { mid = [-0.05], lambda = [0.4, 0.4475] }
control = { at = "column:0.5", component = "x" }
step = -0.5
min_step = 1e-6
max_step = 2.0
max_points = 100
branches = "all"
depth = 3
watch = ["mid", "end"]
events = "detect"
equilibrium_family = "stop"
search = true
search_at = [0.3, 4.0]
search_guesses = 7
search_seed = 3
[path.stop]
mid = [-0.16, 0.16]
lambda = [-1, 10.0]
contacts = 40

[[monitor]]
name = "mid"
at = "column:0.5"
component = "face-below-z"
[[monitor]]
name = "end"
at = "D"
component = "reaction-z"
sign = -1

[[prescribed]]
at = "D"
z = -0.5
rotation = 0.25
[[prescribed]]
at = "C"
x = 0.125
constant = true

[[load]]
on = "column"
temperature = 20.0
gradient = 0.5

[[load]]
on = "column"
pressure = -0.5
constant = true

[[monitor]]
name = "push"
wall = "hill"
component = "moment"
[[monitor]]
name = "clear"
at = "column:0.5"
wall = "upper"
component = "gap"
[[monitor]]
name = "bent"
member = "wave"
component = "max-moment"
[[monitor]]
name = "prop"
spring = "prop"
component = "force-x"
)toml";

/// The text with its first `from` replaced; the text must contain it.
inline std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at == std::string_view::npos) return "`" + std::string(from) + "` is not in the sample deck";
  return std::string(text.substr(0, at)) + std::string(to) + std::string(text.substr(at + from.size()));
}

}  // namespace arcwall::deck
