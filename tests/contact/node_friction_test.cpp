#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "contact/multiplier_contact.hpp"
#include "contact/outline.hpp"
#include "contact/profile.hpp"
#include "core/derivative_check.hpp"

// A node on springs to the ground, k_x = 1 and k_z = 1, that touches a wall with friction.
namespace arcwall::node_friction_test {

namespace {

class Springs final : public Equations {
 public:
  Dimensions dimensions(const ActiveSet&) const override { return {.unknowns = 2}; }
  void residual(const State& state, Eigen::Ref<Vector> F) const override {
    F = state.x - state.lambda * Vec2(1.0, 0.0);
  }
  void linearize(const State& state, Linearization& out) const override {
    out.F = state.x - state.lambda * Vec2(1.0, 0.0);
    out.F_lambda = -Vec2(1.0, 0.0);
    out.K.resize(2, 2);
    out.K.setZero();
    out.K.insert(0, 0) = 1.0;
    out.K.insert(1, 0) = 0.0;  // of the pattern, in which contact adds its own
    out.K.insert(1, 1) = 1.0;
    out.K.makeCompressed();
    out.pattern_of = state.active_set;
  }
  double energy(const State& state) const override { return 0.5 * state.x.squaredNorm() - state.lambda * state.x[0]; }
};

// Its place is that of the origin, moved by its two unknowns.
class Node final : public TrackedPoint {
 public:
  const std::vector<Index>& unknowns() const override { return unknowns_; }
  Vec2 position(const State& state) const override { return {state.x[0], state.x[1]}; }
  PointMotion motion(const State& state, const Direction& direction) const override {
    return {.position = position(state), .velocity = {direction.dx[0], direction.dx[1]}};
  }
  void kinematics(const State& state, PointKinematics& out) const override {
    out.position = position(state);
    out.jacobian = Matrix::Identity(2, 2);
    out.curvature = {Matrix::Zero(2, 2), Matrix::Zero(2, 2)};
    out.rate.setZero();
    out.jacobian_rate = Matrix::Zero(2, 2);
  }

 private:
  std::vector<Index> unknowns_{0, 1};
};

std::vector<std::shared_ptr<const Obstacle>> all_walls() {
  const auto profile = [](std::unique_ptr<Profile> made, Side side) {
    return obstacle(std::shared_ptr<const Profile>(std::move(made)), side);
  };
  const auto outline = [](std::unique_ptr<Outline> made, double half_height = 0.0) {
    return obstacle(std::shared_ptr<const Outline>(std::move(made)), half_height);
  };
  return {profile(line_profile(0.1, 0.3), Side::below),
          profile(parabola_profile({0.3, 0.1}, 0.7), Side::below),
          profile(circle_profile({0.1, -1.0}, 1.5, Side::below), Side::below),
          profile(spline_profile({-2.0, -1.0, 0.0, 1.0, 2.0}, {0.0, 0.1, -0.1, 0.2, 0.0}), Side::above),
          outline(half_plane_outline({0.0, 0.1}, {-0.5, 1.0})),
          outline(circle_outline({0.2, -1.0}, 1.1, Keep::outside)),
          outline(ellipse_outline({0.2, -1.0}, {1.5, 0.8}, 0.3, Keep::outside)),
          outline(curve_outline({{-2.0, 0.0}, {-0.5, 0.1}, {0.5, -0.1}, {2.0, 0.0}})),
          outline(polyline_outline({{-2.0, 0.0}, {0.1, 0.2}, {2.0, -0.5}}, 0.5)),
          outline(half_plane_outline({0.0, 0.0}, {-0.5, 1.0}), 0.1),
          outline(circle_outline({0.2, -1.0}, 1.0, Keep::outside), 0.1),
          outline(ellipse_outline({0.2, -1.0}, {1.4, 0.7}, 0.3, Keep::outside), 0.1),
          outline(curve_outline({{-2.0, -0.1}, {-0.5, 0.0}, {0.5, -0.2}, {2.0, -0.1}}), 0.1)};
}

const Springs springs;

MultiplierContact contact_with(const std::shared_ptr<const Obstacle>& wall) {
  std::vector<Candidate> candidates;
  candidates.emplace_back(std::make_unique<Node>(), wall, ContactLabel{.wall = "wall", .member = "node"});
  candidates.front().set_friction(0.4);
  return {springs, std::move(candidates), {}};
}

State near_wall(const MultiplierContact& contact, ContactMode mode) {
  const State open{.x = Vec2(0.12, 0.15), .lambda = 0.3, .active_set = contact.open_active_set()};
  const ModeOfContact change{.contact = 0, .mode = mode};
  State state = contact.with_modes(open, std::span(&change, 1));
  state.x[2] = 0.7;
  state.x[3] = -0.3;
  return state;
}

}  // namespace

TEST(NodeFriction, DerivativesAreConsistentOnEveryWall) {
  for (const auto& wall : all_walls()) {
    const MultiplierContact contact = contact_with(wall);
    for (const ContactMode mode : {ContactMode::sticks, ContactMode::slips_forward, ContactMode::slips_backward})
      EXPECT_LE(check_derivatives(contact, near_wall(contact, mode)).worst(), 1e-9);
  }
}

// The structure is to the left of the tangent: the tangent turned by 90° is the normal.
TEST(NodeFriction, OnTheWallThePlaceGrowsByTheLengthAlongTheTangent) {
  for (const auto& wall : all_walls()) {
    const MultiplierContact contact = contact_with(wall);
    State state{.x = Vec2(0.12, 0.15), .lambda = 0.0, .active_set = contact.open_active_set()};
    Gap gap, place;
    for (int i = 0; i < 30; ++i) {
      contact.candidate(0).gap(state, gap);
      state.x -= gap.value / gap.gradient.squaredNorm() * Vector(gap.gradient);
    }
    contact.candidate(0).gap(state, gap);
    contact.candidate(0).place(state, 0.0, place);
    const Vec2 normal(gap.gradient), tangent(place.gradient);
    EXPECT_LE((perp(tangent) - normal).norm(), 1e-12);
  }
}

TEST(NodeFriction, ASlipIsAColumnThatDiffersFromItsRow) {
  const MultiplierContact contact = contact_with(all_walls().front());
  Linearization now;
  contact.linearize(near_wall(contact, ContactMode::slips_forward), now);
  ASSERT_EQ(now.B.cols(), 1);
  EXPECT_EQ(now.B(3, 0), 1.0);
  EXPECT_EQ(now.C(0, 2), 0.4);
  EXPECT_EQ(now.C(0, 3), 1.0);
  EXPECT_EQ(contact.multiplier_count(near_wall(contact, ContactMode::slips_forward).active_set), 2);
}

namespace {

// With a rotation beside the two displacements.
class TurningSprings final : public Equations {
 public:
  Dimensions dimensions(const ActiveSet&) const override { return {.unknowns = 3}; }
  void residual(const State& state, Eigen::Ref<Vector> F) const override { F = state.x; }
  void linearize(const State& state, Linearization& out) const override {
    out.F = state.x;
    out.F_lambda = Vector::Zero(3);
    out.K.resize(3, 3);
    out.K.setZero();
    for (Index column = 0; column < 3; ++column)
      for (Index row = column; row < 3; ++row) out.K.insert(row, column) = row == column ? 1.0 : 0.0;
    out.K.makeCompressed();
    out.pattern_of = state.active_set;
  }
  double energy(const State& state) const override { return 0.5 * state.x.squaredNorm(); }
};

// A face of the node, below its axis.
class Face final : public TrackedPoint {
 public:
  static constexpr double below = 0.1;
  const std::vector<Index>& unknowns() const override { return unknowns_; }
  Vec2 position(const State& state) const override {
    return {state.x[0] + below * std::sin(state.x[2]), state.x[1] - below * std::cos(state.x[2])};
  }
  PointMotion motion(const State& state, const Direction& direction) const override {
    PointKinematics at;
    kinematics(state, at);
    return {.position = at.position, .velocity = at.jacobian * direction.dx.head<3>()};
  }
  void kinematics(const State& state, PointKinematics& out) const override {
    const double s = std::sin(state.x[2]), c = std::cos(state.x[2]);
    out.position = position(state);
    out.jacobian = Matrix::Zero(2, 3);
    out.jacobian(0, 0) = out.jacobian(1, 1) = 1.0;
    out.jacobian(0, 2) = below * c;
    out.jacobian(1, 2) = below * s;
    out.curvature = {Matrix::Zero(3, 3), Matrix::Zero(3, 3)};
    out.curvature[0](2, 2) = -below * s;
    out.curvature[1](2, 2) = below * c;
    out.rate.setZero();
    out.jacobian_rate = Matrix::Zero(2, 3);
  }

 private:
  std::vector<Index> unknowns_{0, 1, 2};
};

const TurningSprings turning_springs;

MultiplierContact face_on_floor(std::unique_ptr<TrackedPoint> rubs) {
  std::vector<Candidate> candidates;
  candidates.emplace_back(std::make_unique<Face>(),
                          obstacle(std::shared_ptr<const Profile>(line_profile(-0.1, 0.3)), Side::below),
                          ContactLabel{.wall = "wall", .member = "node"});
  candidates.front().set_friction(0.4, std::move(rubs));
  return {turning_springs, std::move(candidates), {}};
}

// The row of the place, by the rotation.
double lever(const MultiplierContact& contact) {
  const State open{.x = Vector::Zero(3), .lambda = 0.0, .active_set = contact.open_active_set()};
  const ModeOfContact sticks{.contact = 0, .mode = ContactMode::sticks};
  State state = contact.with_modes(open, std::span(&sticks, 1));
  state.x << 0.03, 0.02, 0.2, 0.7, -0.3;
  EXPECT_LE(check_derivatives(contact, state).worst(), 1e-9);
  Linearization now;
  contact.linearize(state, now);
  return now.K.coeff(4, 2);
}

}  // namespace

// On the face the place moves by the lever as the node turns, seen along the wall; on the axis it does not.
TEST(NodeFriction, OnTheAxisFrictionHasNoLever) {
  const double slope = std::atan(0.3);
  EXPECT_NEAR(lever(face_on_floor(nullptr)), -Face::below * std::cos(slope - 0.2), 1e-12);
  EXPECT_EQ(lever(face_on_floor(std::make_unique<Node>())), 0.0);
}

}  // namespace arcwall::node_friction_test
