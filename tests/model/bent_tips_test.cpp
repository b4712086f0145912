// A strip that weight presses flat on its floor, with a sinusoidal imperfection: its free end is bent onto the floor or
// off it by the slope of its natural curvature.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/deck/reader.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::bent_tips_test {
namespace {

using test::traced;

constexpr double length = 5.0, amplitude = 0.01, force = 0.1;

// Clamped at B; λ times `upwards` pulls at the free end A.
std::string strip(const std::string& from, const std::string& to, int waves, double upwards) {
  return R"toml(
title = "A strip pressed flat"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e5, I = 1.0 }
point = { A = [0.0, 0.0], B = [5.0, 0.0] }
support = { B = ["x", "z", "rotation"] }
wall = [{ name = "floor", side = "below", contact_surface = "axis", profile = { type = "flat", z = -0.010001 } }]
monitor = [{ name = "A", at = "A", component = "z" }]
path = { step = 0.01, max_step = 0.05, stop = { lambda = [-0.2, 1.0] } }
)toml"
         "member.beam = { from = \"" +
         from + "\", to = \"" + to +
         "\", theory = \"euler-bernoulli\", material = \"m\", section = \"s\", elements = 60, imperfection = { shape = "
         "\"sine\", amplitude = 0.01, waves = " +
         std::to_string(waves) +
         " } }\nload = [{ on = \"beam\", distributed = [0.0, -0.2], constant = true }, { at = \"A\", force = [0.0, " +
         std::to_string(upwards) + "] }]\n";
}

// EI κ₀′ at the end of a sine wave, by stress-free length, which holds the force of the end in balance.
double balancing_load(int waves) {
  const double k = waves * M_PI / length, slope = amplitude * k;
  return amplitude * k * k * k / std::pow(1.0 + slope * slope, 2) / force;
}

void expect_one_change(const Session& session, EventKind kind, double lambda) {
  EXPECT_EQ(session.record().branches.back().end->reason, EndReason::stop);
  const auto events = test::events_of(session.record(), kind);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events.front().lambda, lambda, 3e-6);  // a force of 2.7e-7 hardly lifts an end
}

}  // namespace

TEST(BentTips, LiftWhenTheForceExceedsTheShearOfTheNaturalCurvature) {
  for (const int waves : {2, 3}) {
    SCOPED_TRACE(waves);
    expect_one_change(traced(strip("A", "B", waves, force)), EventKind::contact_opens, balancing_load(waves));
  }
  expect_one_change(traced(strip("B", "A", 2, force)), EventKind::contact_opens, balancing_load(2));
}

// With the other sign of the imperfection the tip is off the floor until a force has pressed it down.
TEST(BentTips, ComeDownAtTheSameForce) {
  expect_one_change(traced(strip("B", "A", 3, -force)), EventKind::contact_closes, balancing_load(3));
}

}  // namespace arcwall::bent_tips_test
