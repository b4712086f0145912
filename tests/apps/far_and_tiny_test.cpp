// Structures far from the origin, or in lengths of 10⁻¹²: what a run stores is in the user's coordinates, and right.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "apps/cli/summary.hpp"
#include "core/text.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::far_and_tiny_test {
namespace {

using test::TracedDeck;

// A portal under loads on its columns with a stop beside its corner, in these units of length from an origin.
std::string portal(double x, double z, double unit) {
  const auto at = [&](double along, double up) {
    return "[" + round_trip(x + unit * along) + ", " + round_trip(z + unit * up) + "]";
  };
  const std::string member = "theory = \"elastica\", material = \"steel\", section = \"column\", elements = 8 }\n";
  return "title = \"Portal\"\nunits = { length = \"m\", force = \"kN\" }\nmaterial.steel = { E = " +
         round_trip(2.1e8 / (unit * unit)) +
         " }\nsection.column = { shape = \"general\", A = " + round_trip(0.01 * unit * unit) +
         ", I = " + round_trip(1e-5 * std::pow(unit, 4)) + " }\npoint = { a = " + at(0.0, 0.0) +
         ", b = " + at(0.0, 4.0) + ", c = " + at(4.0, 4.0) + ", d = " + at(4.0, 0.0) + " }\n" +
         "support = { a = [\"x\", \"z\"], d = [\"x\", \"z\"] }\n"
         "load = [{ at = \"b\", force = [0.0, -1.0] }, { at = \"c\", force = [0.0, -1.0] }]\n"
         "path = { step = 20.0, stop.lambda = [-100.0, 400.0], sensitivity = [\"section.column.I\"] }\n"
         "wall = [{ name = \"stop\", contact_surface = \"axis\", outline = { type = \"half-plane\", point = " +
         at(4.0625, 4.0) +
         ", normal = [-1.0, 0.0] } }]\n"
         "monitor = [{ name = \"sway\", at = \"c\", component = \"x\" }, { name = \"stop\", wall = \"stop\", component "
         "= "
         "\"force-x\", sign = -1 }, { name = \"most\", member = \"right\", component = \"max-moment\" }]\n"
         "[member]\nleft = { from = \"a\", to = \"b\", " +
         member + "beam = { from = \"b\", to = \"c\", " + member + "right = { from = \"c\", to = \"d\", " + member;
}

}  // namespace

TEST(FarAndTiny, RunsAreThoseOfAnOrdinaryPlaceAndUnit) {
  const TracedDeck ordinary(portal(0.0, 0.0, 1.0));
  const RecordEvent& buckles = event_of(ordinary, EventKind::branch_point);
  const RecordEvent& touches = event_of(ordinary, EventKind::contact_closes);
  struct Place {
    double x, z, unit;
  };
  for (const Place& of : {Place{5e5, 5.4e6, 1.0}, Place{0.0, 0.0, 1e-12}, Place{-3e-3, 7e-4, 1e-9}}) {
    SCOPED_TRACE(fmt::format("at {}, {} in units of {}", of.x, of.z, of.unit));
    const TracedDeck traced(portal(of.x, of.z, of.unit));
    EXPECT_NE(summary(traced.model()).find(fmt::format("smallest initial gap {:.6g} m", 0.0625 * of.unit)),
              std::string::npos);
    test::expect_whole(traced);
    ASSERT_EQ(traced.record().events.size(), ordinary.record().events.size());
    const RecordEvent& first = event_of(traced, EventKind::branch_point);
    EXPECT_NEAR(first.lambda, buckles.lambda, 1e-8 * buckles.lambda);
    EXPECT_EQ(first.unstable_after, buckles.unstable_after);
    const RecordEvent& touch = event_of(traced, EventKind::contact_closes);
    EXPECT_NEAR(touch.lambda, touches.lambda, 1e-6 * touches.lambda);
    EXPECT_NEAR(touch.monitors[0], 0.0625 * of.unit, 1e-5 * of.unit);
    EXPECT_NEAR(touch.contacts.front().x - of.x, 4.0625 * of.unit, 1e-5 * of.unit);
    const double inertia = std::pow(of.unit, 4);
    ASSERT_TRUE(first.sensitivity.front().slope.has_value());
    EXPECT_NEAR(*first.sensitivity.front().slope * inertia, *buckles.sensitivity.front().slope,
                1e-5 * *buckles.sensitivity.front().slope);
    const auto &last = traced.record().points.back(), &other = ordinary.record().points.back();
    EXPECT_NEAR(last.monitors[1], other.monitors[1], 1e-5 * other.monitors[1]);
    EXPECT_NEAR(last.monitors[2], other.monitors[2] * of.unit, 1e-5 * other.monitors[2] * of.unit);
    EXPECT_NEAR(last.energy, other.energy * of.unit, 1e-5 * std::abs(other.energy) * of.unit);
  }
}

}  // namespace arcwall::far_and_tiny_test
