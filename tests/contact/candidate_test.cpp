#include "contact/candidate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/contact/contact_models.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::candidate_test {

namespace {

// A point that can be put anywhere: x = (x, z).
class FreePoint final : public TrackedPoint {
 public:
  const std::vector<Index>& unknowns() const override { return unknowns_; }
  Vec2 position(const State& state) const override { return state.x.head<2>(); }
  PointMotion motion(const State& state, const Direction& direction) const override {
    return {.position = position(state), .velocity = direction.dx.head<2>()};
  }
  void kinematics(const State& state, PointKinematics& out) const override {
    out.position = position(state);
    out.jacobian.setIdentity(2, 2);
    for (auto& second : out.curvature) second.setZero(2, 2);
  }

 private:
  std::vector<Index> unknowns_{0, 1};
};

Candidate at_wall(std::unique_ptr<Profile> profile, Side side) {
  return {
      std::make_unique<FreePoint>(), obstacle(std::move(profile), side), {.wall = "w", .member = "m", .fraction = 0.5}};
}

State place(double x, double z) { return {.x = Vec2(x, z)}; }

}  // namespace

TEST(Candidate, GapIsPositiveOnTheFreeSide) {
  EXPECT_NEAR(at_wall(flat_profile(0.2), Side::above).gap(place(1.0, 0.05)), 0.15, 1e-16);
  EXPECT_NEAR(at_wall(flat_profile(0.2), Side::above).gap(place(1.0, 0.3)), -0.1, 1e-16);
  EXPECT_NEAR(at_wall(flat_profile(-0.2), Side::below).gap(place(1.0, 0.05)), 0.25, 1e-16);
  EXPECT_NEAR(at_wall(flat_profile(-0.2), Side::below).gap(place(1.0, -0.3)), -0.1, 1e-16);
}

TEST(Candidate, GapToASlopeIsTheDistance) {
  // z = 1 + 0.75 x: the distance of (2, 0) is 2.5 · 0.8.
  EXPECT_NEAR(at_wall(line_profile(1.0, 0.75), Side::above).gap(place(2.0, 0.0)), 2.0, 1e-15);
  EXPECT_NEAR(at_wall(line_profile(1.0, 0.75), Side::below).gap(place(2.0, 5.0)), 2.0, 1e-15);
}

// Gradient and Hessian of the gap of faces and axis against all walls, by central differences of step 1e-5 (truncation
// 1e-10 of higher derivatives up to ten, round-off 1e-11).
TEST(Candidate, GradientAndHessianAreThoseOfTheGap) {
  constexpr double step = 1e-5, tolerance = 1e-8;
  test::Numbers numbers(50);
  for (const bool on_axis : {false, true}) {
    const test::ContactModel model(test::contact_beam(), test::all_walls(on_axis), 0.1);
    ASSERT_GE(model.system().contact_count(), 40);
    const State state{.x = 0.2 * numbers.vector(model.structure().size({}))};
    for (Index j = 0; j < model.system().contact_count(); ++j) {
      const Candidate& candidate = model.system().candidate(j);
      ASSERT_TRUE(candidate.faces_wall(state));
      Gap at;
      candidate.gap(state, at);
      EXPECT_NEAR(at.value, candidate.gap(state), 1e-15);
      const auto& unknowns = candidate.point().unknowns();
      for (std::size_t i = 0; i < unknowns.size(); ++i) {
        const auto column = static_cast<Index>(i);
        State above = state, below = state;
        above.x[unknowns[i]] += step;
        below.x[unknowns[i]] -= step;
        Gap a, b;
        candidate.gap(above, a);
        candidate.gap(below, b);
        EXPECT_NEAR((a.value - b.value) / (2.0 * step), at.gradient[column], tolerance);
        EXPECT_LE(((a.gradient - b.gradient) / (2.0 * step) - at.hessian.col(column)).norm(), tolerance);
      }
      EXPECT_LE((at.hessian - at.hessian.transpose()).norm(), 1e-15);
      const Direction direction{.dx = numbers.vector(state.x.size()), .dlambda = 0.0};
      const auto gap_at = [&](double s) { return candidate.gap(moved(state, direction, s)); };
      EXPECT_NEAR(candidate.gap_rate(state, direction), (gap_at(step) - gap_at(-step)) / (2.0 * step), tolerance);
    }
  }
}

TEST(Candidate, BeyondTheEndOfAWallThereIsNoSurface) {
  const Candidate candidate = at_wall(circle_profile({0.0, 0.0}, 1.0, Side::below), Side::below);
  EXPECT_TRUE(candidate.faces_wall(place(0.5, 3.0)));
  EXPECT_FALSE(candidate.faces_wall(place(1.5, 3.0)));
  EXPECT_EQ(candidate.gap(place(1.5, -3.0)), infinity);
  EXPECT_EQ(candidate.gap_rate(place(1.5, 3.0), {.dx = Vec2(0.0, 1.0)}), 0.0);
}

TEST(Candidate, KeepsItsLabel) {
  const Candidate candidate = at_wall(flat_profile(0.0), Side::above);
  EXPECT_EQ(candidate.label().wall, "w");
  EXPECT_EQ(candidate.label().member, "m");
  EXPECT_EQ(candidate.label().fraction, 0.5);
}

}  // namespace arcwall::candidate_test
