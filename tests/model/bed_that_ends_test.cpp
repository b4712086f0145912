// A heavy plank that lies flush on a bench and projects over its edge: it lifts off behind the edge under any load.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/deck/reader.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::bed_that_ends_test {
namespace {

using test::traced;

constexpr double weight = 0.05, projects = 2.0, rounding = 0.05;

// The bench ends at x = 0, with a rounded corner; the plank is 8 long, and 6 of it lie on the bench.
std::string plank(int elements, const std::string& load) {
  return R"toml(
title = "A plank over the edge of a bench"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e4, I = 1.0 }
point = { back = [-6.0, 0.0], front = [2.0, 0.0] }
support = { back = ["x"] }
path = { step = 0.01, stop = { lambda = [-0.1, 1.0] } }
member.p = { from = "back", to = "front", theory = "elastica", material = "m", section = "s", elements = )toml" +
         std::to_string(elements) + R"toml( }
wall = [{ name = "bench", acts_on = "axis", corner_radius = 0.05, outline = { type = "polyline", x = [-8.0, 0.0, 0.0], z = [0.0, 0.0, -3.0] } }]
monitor = [{ name = "tip", at = "front", component = "z" }]
)toml" + load;
}

const std::string by_lambda = "load = [{ on = \"p\", distributed = [0.0, -0.05] }]\n";

// The contact points at the last point of the path: where the zone on the bench ends, and at its edge.
struct Ends {
  RecordForce of_zone{}, at_edge{};
};

Ends ends_of(const Session& session) {
  Ends ends;
  for (const RecordForce& point : session.record().points.back().forces) {
    if (point.label.fraction > 0.6) ends.at_edge = point;
    if (point.label.fraction > 0.0 && point.label.fraction < 0.6) ends.of_zone = point;
  }
  return ends;
}

}  // namespace

// Small slopes: beyond the zone w = q s³ (b − s) / 24, which meets the edge at s = b = a √2, where the moment is that
// of the projecting part, q a²/2. It begins where the rounding does.
TEST(BedThatEnds, IsLeftBehindItsEdgeUnderTheLeastLoad) {
  const Session session = traced(plank(80, by_lambda));
  const RecordPoint& first = session.record().points.front();
  const double a = projects + rounding, b = a * std::sqrt(2.0), q = weight * first.lambda;
  EXPECT_GT(first.lambda, 0.0);
  EXPECT_NEAR(first.monitors.front(), -q * (b * b * b * a / 24.0 + a * a * a * a / 8.0), 1e-6);
}

// Own shooting of the extensible elastica from the zone's end to the free end, to 12 digits; also where the weight is
// constant and nothing else acts.
TEST(BedThatEnds, IsLeftAsByShooting) {
  for (const int elements : {40, 80, 200}) {
    SCOPED_TRACE(elements);
    const Session session = traced(plank(elements, by_lambda));
    EXPECT_EQ(session.record().branches.back().end->reason, EndReason::stop);
    EXPECT_NEAR(session.record().points.back().monitors.front(), -0.211472724487, 1e-8);
    const Ends ends = ends_of(session);
    EXPECT_NEAR(8.0 * ends.of_zone.label.fraction, 3.06665173, 1e-5);
    EXPECT_NEAR(ends.of_zone.force, 0.03600718, 1e-6);
    EXPECT_NEAR(8.0 * ends.at_edge.label.fraction, 5.9528108, 1e-5);
    EXPECT_NEAR(ends.at_edge.force, 0.21092542, 1e-6);
  }
}

TEST(BedThatEnds, IsLeftUnderConstantWeight) {
  const Session session = traced(plank(64,
                                       "load = [{ on = \"p\", distributed = [0.0, -0.05], constant = true }, "
                                       "{ at = \"front\", force = [0.0, -0.02] }]\n"));
  EXPECT_EQ(session.record().branches.back().end->reason, EndReason::stop);
  EXPECT_EQ(session.record().points.front().lambda, 0.0);
  EXPECT_NEAR(session.record().points.front().monitors.front(), -0.211472724487, 1e-8);
}

}  // namespace arcwall::bed_that_ends_test
