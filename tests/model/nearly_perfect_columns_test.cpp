// Columns whose imperfections have two and three half waves buckle in one half wave all the same, to which only their
// products of third order lead: a pitchfork with a very small imperfection. Its own branch bends aside just before
// Euler's load, within a thousandth of the span, and the straight state goes on behind it, unstable. A long step ends
// there; between its ends lie no points of the path, and so there is no branch point.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "tests/model/traced_session.hpp"

namespace arcwall::nearly_perfect_columns_test {
namespace {

constexpr double E = 21000.0, length = 2.4, width = 0.2, height = 0.033, wall = 0.078, load = 0.0216;

std::string column(double two, double three) {
  return R"toml(
title = "A column that is not straight, but has nothing of one half wave, below a wall"
material.steel = { E = 21000.0, nu = 0.3 }
section.s = { shape = "rectangle", width = 0.2, height = 0.033 }
point = { left = [0.0, 0.0], right = [2.4, 0.0] }
support = { left = ["x", "z"], right = ["z"] }
load = [{ at = "right", force = [-0.0216, 0.0] }]
wall = [{ name = "upper", side = "above", profile = { type = "flat", z = 0.078 }, contact_surface = "axis" }]
monitor = [{ name = "mid", at = "column:0.5", component = "z" }]
path = { stop = { lambda = [-1.0, 3.0] } }
[member.column]
from = "left"
to = "right"
theory = "elastica"
material = "steel"
section = "s"
elements = 56
imperfection = [{ shape = "sine", amplitude = )toml" +
         std::to_string(two) + R"toml(, waves = 2 }, { shape = "sine", amplitude = )toml" + std::to_string(three) +
         R"toml(, waves = 3 }]
)toml";
}

// The load P of the elastica of amplitude a: P (1 − P/EA) = (π/l)² EI (1 + (π a/l)²/8 + …).
double load_of_elastica(double a) {
  const double second_moment = width * std::pow(height, 3) / 12.0, wave_number = M_PI / length;
  const double straight = wave_number * wave_number * E * second_moment;
  return straight * (1.0 + std::pow(wave_number * a, 2) / 8.0) * (1.0 + straight / (E * width * height));
}

struct Column {
  double two, three, step;
};

void PrintTo(const Column& c, std::ostream* out) { *out << c.two << ", " << c.three << ", step " << c.step; }

class NearlyPerfectColumn : public testing::TestWithParam<Column> {};

TEST_P(NearlyPerfectColumn, FollowsTheBranchThatBendsAside) {
  const Column& c = GetParam();
  const Session run = test::traced(
      column(c.two, c.three), {"path.step=" + std::to_string(c.step), "path.max_step=" + std::to_string(4.0 * c.step)});
  EXPECT_TRUE(test::events_of(run.record(), EventKind::branch_point).empty());
  EXPECT_TRUE(test::events_of(run.record(), EventKind::limit_point).empty());
  const RecordEvent& closes = test::event_of(run.record(), EventKind::contact_closes);
  EXPECT_NEAR(closes.lambda * load, load_of_elastica(wall), 5e-5 * load);
  EXPECT_EQ(run.record().branches.size(), 1U);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
}

// Of three amplitudes of each shape and seven steps these ended on the straight state.
INSTANTIATE_TEST_SUITE_P(StepsThatGoTooFar, NearlyPerfectColumn,
                         testing::Values(Column{0.0012, 0.00006, 0.02}, Column{0.0012, 0.0003, 0.03},
                                         Column{0.0017, 0.00006, 0.05}, Column{0.0017, 0.0003, 0.01},
                                         Column{0.0023, 0.00006, 0.005}, Column{0.0023, 0.0003, 0.0125}));

// The branches pass each other within some 1e-5 of the span here, and what the imperfection does along the critical
// mode is lost in the round-off of the residual.
INSTANTIATE_TEST_SUITE_P(HardlyAnyImperfection, NearlyPerfectColumn,
                         testing::Values(Column{0.0003, 0.0002, 0.05}, Column{0.0005, 0.0002, 0.02},
                                         Column{0.0008, 0.00003, 0.005}));

}  // namespace
}  // namespace arcwall::nearly_perfect_columns_test
