#pragma once

#include <fmt/format.h>

#include <string>

/// Parts of decks that several suites trace.
namespace arcwall::test {

/// Two bars from points left to top and top to right, of material m and section s, with Green's strain.
inline const std::string two_bars = R"toml(
[member.a]
from = "left"
to = "top"
theory = "truss"
strain = "green"
elements = 1
material = "m"
section = "s"
[member.b]
from = "top"
to = "right"
theory = "truss"
strain = "green"
elements = 1
material = "m"
section = "s"
)toml";

/// A column from A to B between walls at 0.2 to both sides, of material m and section s; its imperfection has a third
/// harmonic.
inline std::string column_in_channel(int elements) {
  return fmt::format(R"toml(
[[wall]]
name = "upper"
side = "above"
profile = {{ type = "flat", z = 0.2 }}
[[wall]]
name = "lower"
side = "below"
profile = {{ type = "flat", z = -0.2 }}
[member.column]
from = "A"
to = "B"
theory = "elastica"
elements = {}
imperfection = [{{ shape = "sine", amplitude = 0.00176, waves = 1 }}, {{ shape = "sine", amplitude = 0.0001, waves = 3 }}]
material = "m"
section = "s"
)toml",
                     elements);
}

}  // namespace arcwall::test
