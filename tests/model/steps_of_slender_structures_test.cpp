// Steps are as long as the structure's motion allows, whatever λ is and however it compares with what it was at first.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "core/root_find.hpp"
#include "core/types.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::steps_of_slender_structures_test {

namespace {

constexpr const char* pushed_strip = R"toml(
title = "A strip with L/h = 1000, pushed together"
material.m = { E = 2.0e11 }
section.s = { shape = "rectangle", width = 0.02, height = 0.001 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "z"], b = ["z"] }
path = { stop.lambda = [-1.0e-6, 0.8] }
prescribed = [{ at = "b", x = -1.0 }]
monitor = [{ name = "mid", at = "s:0.5", component = "z" }]
[member.s]
from = "a"
to = "b"
theory = "elastica"
material = "m"
section = "s"
elements = 20
imperfection = { shape = "sine", amplitude = 1.0e-4, waves = 1 }
)toml";

constexpr const char* hanging_rope = R"toml(
title = "A rope of 1000 m that hangs by its weight, its ends then brought together by 50 m"
material.m = { E = 1.0e11 }
section.s = { shape = "circle", radius = 0.025 }
point = { a = [0.0, 0.0], b = [1000.0, 0.0] }
support = { a = ["x", "z"], b = ["x", "z"] }
load = [{ on = "s", distributed = [0.0, -151.0], constant = true }]
prescribed = [{ at = "b", x = -50.0 }]
path = { stop.lambda = [-1.0e-6, 1.0] }
monitor = [{ name = "mid", at = "s:0.5", component = "z" }, { name = "H", at = "b", component = "reaction-x" }]
[member.s]
from = "a"
to = "b"
theory = "elastica"
material = "m"
section = "s"
elements = 60
)toml";

// Horizontal force and sag of an elastic catenary of this length, stiffness and weight over a span (Irvine 1981).
struct Catenary {
  double length, stiffness, weight;

  double span(double H) const {
    const double V = 0.5 * weight * length;
    return 2.0 * H / weight * std::asinh(V / H) + H * length / stiffness;
  }
  double force(double over) const {
    const auto excess = [&](double H) -> std::optional<double> { return span(H) - over; };
    return bracketed_root(excess, 1e3, *excess(1e3), 1e7, *excess(1e7), 1e-12)->at;
  }
  double sag(double H) const {
    const double half = 0.5 * length, V = weight * half;
    return H / weight * (std::hypot(1.0, V / H) - 1.0) + weight * half * half / (2.0 * stiffness);
  }
};

// Of the elastica whose ends come together by a part δ of its length, δ = 2 (1 − E(k)/K(k)).
double modulus_at(double shortening) {
  const auto excess = [&](double k) -> std::optional<double> {
    return 2.0 * (1.0 - std::comp_ellint_2(k) / std::comp_ellint_1(k)) - shortening;
  };
  return bracketed_root(excess, 0.1, *excess(0.1), 0.999, *excess(0.999), 1e-14)->at;
}

}  // namespace

// λ goes to 4·10⁴ times the buckling movement, over which its scale at the start would make 5000 steps of a fiftieth of
// the way.
TEST(PushedStrip, IsFollowedInStepsOfItsMotion) {
  const Session run = test::traced(pushed_strip);
  const Record& record = run.record();
  EXPECT_LE(record.points.size(), 100U);
  const RecordPoint& last = record.points.back();
  EXPECT_EQ(last.lambda, 0.8);
  const double k = modulus_at(0.8);
  // The imperfection is 10⁻⁴ of the length.
  EXPECT_NEAR(last.monitors[0], k / std::comp_ellint_1(k), 2e-4);
}

// A straight rope has no stiffness across itself: its weight moves it by tens of metres at 1e-5 of its value already.
TEST(HangingRope, ComesToHangInStepsOfItsMotion) {
  const Session run = test::traced(hanging_rope);
  const RecordPoint& last = run.record().points.back();
  EXPECT_EQ(last.lambda, 1.0);
  const Catenary rope{.length = 1000.0, .stiffness = 1e11 * std::numbers::pi * 0.025 * 0.025, .weight = 151.0};
  const double H = rope.force(950.0);
  EXPECT_NEAR(last.monitors[0], -rope.sag(H), 1e-4 * rope.sag(H));
  EXPECT_NEAR(last.monitors[1], H, 1e-4 * H);
}

}  // namespace arcwall::steps_of_slender_structures_test
