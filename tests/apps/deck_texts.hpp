#pragma once

#include <fmt/format.h>

#include <string>

#include "tests/support/deck_tables.hpp"

/// Parts of decks that several suites trace.
namespace arcwall::test {

using namespace tables;

/// Two bars from points left to top and top to right, of material m and section s, with Green's strain.
inline const std::string two_bars = member("a", "left", "top", "truss", 1, R"(strain = "green")") +
                                    member("b", "top", "right", "truss", 1, R"(strain = "green")");

/// Two bars with Green's strain, and a load and a monitor w at the top; tables may follow.
inline std::string truss_of(double half_span, double rise, double EA) {
  return title("Two bars") + material("m", EA) + general_section("s", 1.0, 1.0) +
         points({{"left", -half_span, 0.0}, {"top", 0.0, rise}, {"right", half_span, 0.0}}) +
         supports({{"left", "x z"}, {"right", "x z"}}) + force("top", 0.0, -1.0) + monitor("w", "top", "z") + two_bars;
}
inline const std::string low_truss = truss_of(10.0, 1.0, 1e4);

/// The same two bars with a spring at the top, whose stiffness makes the limit points meet at a cusp; traced past both,
/// and tables may follow.
inline const std::string truss_on_spring =
    title("Two bars and a spring") + material("m", 1e4) + general_section("s", 1.0, 1.0) +
    points({{"left", -10.0, 0.0}, {"top", 0.0, 1.0}, {"right", 10.0, 0.0}}) +
    supports({{"left", "x z"}, {"right", "x z"}}) + force("top", 0.0, -1.0) +
    table("[[spring]]", R"(at = "top"; stiffness = { z = 1.0 })") +
    path(R"(step = 0.3; branches = "primary"; stop = { w = [-2.5, 0.5] })") + monitor("w", "top", "z") + two_bars;

/// A straight column of length 2 between pins, EI = 0.175 and EA = 210, traced up to its pitchfork or another stop;
/// tables may follow.
inline std::string straight_column(int elements, const std::string& stop = "event = \"branch-point\"") {
  return fmt::format(R"toml(
title = "A straight column"
material.m = {{ E = 21000.0 }}
section.s = {{ shape = "general", A = 0.01, I = 8.333333333333333e-6 }}
point = {{ A = [0.0, 0.0], B = [2.0, 0.0] }}
support = {{ A = ["x", "z"], B = ["z"] }}
load = [{{ at = "B", force = [-1.0, 0.0] }}]
path = {{ step = 0.05, stop = {{ {} }} }}
member.c = {{ from = "A", to = "B", theory = "elastica", elements = {}, material = "m", section = "s" }}
)toml",
                     stop, elements);
}

/// A column from A to B between walls at 0.2 to both sides, of material m and section s; its imperfection has a third
/// harmonic.
inline std::string column_in_channel(int elements) {
  return channel(0.2) + member("column", "A", "B", "elastica", elements, imperfection({{1, 0.00176}, {3, 0.0001}}));
}

/// A deck of that column, pressed at B, with its monitor `mid`; `path`: the keys of [path]. Tables may follow.
inline std::string pressed_column_in_channel(int elements, const std::string& path) {
  return R"toml(
title = "A column in a channel"
material.m = { E = 21000.0, nu = 0.29 }
section.s = { shape = "rectangle", width = 0.1, height = 0.1 }
point = { A = [0.0, 0.0], B = [2.0, 0.0] }
support = { A = ["x", "z"], B = ["z"] }
load = [{ at = "B", force = [-1.0, 0.0] }]
path = { step = 0.05, )toml" +
         path + R"toml( }
[[monitor]]
name = "mid"
at = "column:0.5"
component = "z"
)toml" + column_in_channel(elements);
}

/// A monitor of the way of its end.
inline const std::string shortening = R"toml([[monitor]]
name = "shortening"
at = "B"
component = "x"
sign = -1
)toml";

/// A sine arch of rise 0.1 and span 2 under a load along it, with a floor at a height z; where it falls to is asked
/// for.
inline std::string arch_above_a_floor(const std::string& z) {
  return R"toml(
title = "An arch above a floor"
material.m = { E = 21000.0, nu = 0.29 }
section.s = { shape = "rectangle", width = 0.1, height = 0.1 }
point = { l = [0.0, 0.0], r = [2.0, 0.0] }
support = { l = ["x", "z"], r = ["x", "z"] }
member.arch = { from = "l", to = "r", sine = { rise = 0.1, waves = 1 }, theory = "elastica", elements = 40, material = "m", section = "s" }
load = [{ on = "arch", distributed = [0.0, -1.0] }]
path = { step = 0.01, jumps = true, stop = { lambda = [-0.05, 0.2] } }
monitor = [{ name = "quarter", at = "arch:0.25", component = "z" }]
wall = [{ name = "floor", side = "below", contact_surface = "axis", profile = { type = "flat", z = )toml" +
         z + " } }]\n";
}

}  // namespace arcwall::test
