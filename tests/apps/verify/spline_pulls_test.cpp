#include "apps/verify/spline_pulls.hpp"

#include <gtest/gtest.h>

#include "tests/apps/traced_deck.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::verify::spline_pulls_test {

using namespace test::tables;

namespace {

// A clamped column, pressed on a floor on which a part of it lies from x = 0.855 to 0.904 at λ = 3.27.
const std::string column =
    title("a column on a spline") + material("m", 2.1e7, "nu = 0.3") + rectangle("s", 0.023, 0.0005) +
    points({{"left", 0.0, 0.0}, {"right", 1.4, 0.0}}) + supports({{"left", "x z rotation"}, {"right", "z"}}) +
    force("right", -5.6e-5, 0.0) + path("step = 0.05; jumps = false; stop = { lambda = [-1.0, 3.27] }") +
    member("column", "left", "right", "euler-bernoulli", 40, imperfection({{1, -0.000106}, {3, 0.000012}})) +
    wall(
        "floor",
        R"(side = "below"; profile = { type = "spline", x = [-0.35, -0.05, 0.25, 0.55, 0.85, 1.15, 1.45, 1.75], z = [-0.0033, -0.00344, -0.004, -0.00317, -0.00321, -0.00322, -0.0039, -0.00417] })");

// The same floor but for one more point, at x = 0.88, higher by some parts in 10⁻⁶ than the floor is there.
deck::Wall with_point(const deck::Wall& floor, double higher) {
  auto spline = std::get<deck::SplineProfile>(floor.profile);
  const double z = spline.z[4] + PlainWall(floor).gap({0.88, spline.z[4]}) * -1.0 + 1e-6 * higher;
  spline.x.insert(spline.x.begin() + 5, 0.88);
  spline.z.insert(spline.z.begin() + 5, z);
  deck::Wall other = floor;
  other.profile = spline;
  return other;
}

}  // namespace

// Raised, the point is pressed on; lowered, it would have to pull, by far more than the pressure beside it.
TEST(SplinePulls, AreSeenWhereAPartLiesAcross) {
  const test::TracedDeck traced(column);
  const State& state = traced.record().points.back().state;
  const deck::Wall& floor = traced.model().deck().walls.front();
  EXPECT_TRUE(spline_pulls(traced.model(), {PlainWall(floor)}, state).empty());
  const deck::Wall raised = with_point(floor, 100.0), lowered = with_point(floor, -100.0);
  EXPECT_TRUE(spline_pulls(traced.model(), {PlainWall(raised)}, state).empty());
  const auto pulls = spline_pulls(traced.model(), {PlainWall(lowered)}, state);
  ASSERT_EQ(pulls.size(), 1U);
  EXPECT_GT(pulls[0].held, 0.0);
  EXPECT_GT(pulls[0].pull, 10.0 * pulls[0].held);
  EXPECT_NEAR(1.4 * pulls[0].label.fraction, 0.88, 0.03);
}

// To both sides of each knot the slope of the curvature, by differences.
TEST(PlainWall, TellsWhereTheRateOfItsCurvatureJumps) {
  const std::vector<double> x{-2.0, -0.9, 0.1, 0.5, 1.4, 2.0};
  const deck::Wall wall{
      .name = "wall", .side = Side::below, .profile = deck::SplineProfile{x, {0.1, 0.6, 0.2, 0.9, 0.4, 0.5}}};
  const PlainWall plain(wall);
  const auto jumps = plain.rate_jumps();
  ASSERT_EQ(jumps.size(), x.size() - 2);
  for (const PlainWall::RateJump& jump : jumps) {
    const auto curvature = [&](double aside) { return plain.curvature({jump.x + aside, 0.0}); };
    const double near = 1e-4, far = 2e-4;
    const double behind = (curvature(far) - curvature(near)) / (far - near);
    const double before = (curvature(-near) - curvature(-far)) / (far - near);
    const double slope = std::tan(plain.slope_angle({jump.x, 0.0}));
    EXPECT_NEAR((behind - before) / std::sqrt(1.0 + slope * slope), jump.jump, 2e-2 * (1.0 + std::abs(jump.jump)));
  }
}

}  // namespace arcwall::verify::spline_pulls_test
