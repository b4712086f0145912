#include "elements/member_point.hpp"

#include <gtest/gtest.h>

#include "core/derivative_check.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/models.hpp"

namespace arcwall::member_point_test {

namespace {

using Component = MemberObservable::Component;

// A curved, imperfect beam of height 0.4, clamped at the left, guided along x at the right.
StructureBuilder described_beam() {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(2.0, 0.5);
  builder.add_joint(a);
  builder.add_joint(b);
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = arc_axis(a, {1.0, 0.7}, b),
                      .imperfection = {{.amplitude = 0.03, .waves = 2}},
                      .section = {.E = 10.0, .A = 1.0, .I = 0.1, .height = 0.4},
                      .elements = 4});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.shared_rotation(0).value());
  builder.fix(builder.dof(1, Dof::z));
  builder.add_load(builder.dof(1, Dof::x), 1.0, LoadKind::proportional);
  builder.add_distributed_load(0, {0.0, -1.0}, LoadKind::proportional);
  return builder;
}

std::unique_ptr<Structure> beam() { return described_beam().build(); }

// The same whose supports move with λ.
std::unique_ptr<Structure> moved_beam() {
  StructureBuilder builder = described_beam();
  builder.fix(builder.dof(0, Dof::x), {.constant = 0.1, .proportional = 0.5});
  builder.fix(builder.dof(0, Dof::z), {.proportional = -0.2});
  builder.fix(builder.shared_rotation(0).value(), {.constant = -0.3, .proportional = 1.5});
  builder.fix(builder.dof(1, Dof::z), {.proportional = 0.7});
  return builder.build();
}

}  // namespace

// Jacobian and curvature of the position by central differences of step 1e-5: truncation 1e-10, round-off 1e-11.
TEST(MemberPoint, DerivativesAreThoseOfThePosition) {
  const auto structure = beam();
  const MemberMesh& mesh = structure->members()[0];
  const State state{.x = test::Numbers(40).vector(structure->size({}))};
  constexpr double step = 1e-5, tolerance = 1e-9;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    for (const double offset : {0.0, 0.2, -0.3}) {
      const MemberPoint point(*structure, mesh, node, offset);
      PointKinematics at;
      point.kinematics(state, at);
      EXPECT_EQ(at.position, point.position(state));
      const auto& unknowns = point.unknowns();
      ASSERT_EQ(at.jacobian.cols(), static_cast<Index>(unknowns.size()));
      for (std::size_t i = 0; i < unknowns.size(); ++i) {
        const auto column = static_cast<Index>(i);
        State above = state, below = state;
        above.x[unknowns[i]] += step;
        below.x[unknowns[i]] -= step;
        PointKinematics a, b;
        point.kinematics(above, a);
        point.kinematics(below, b);
        EXPECT_LE(((a.position - b.position) / (2.0 * step) - at.jacobian.col(column)).norm(), tolerance);
        for (int c = 0; c < 2; ++c) {
          const auto& second = at.curvature[static_cast<std::size_t>(c)];
          EXPECT_LE(((a.jacobian.row(c) - b.jacobian.row(c)) / (2.0 * step) - second.row(column)).norm(), tolerance);
          EXPECT_EQ(second, second.transpose());
        }
      }
    }
}

// Rates by λ likewise, where both ends are moved; what moves is known of a held end, too.
TEST(MemberPoint, MovesWithItsSupports) {
  const auto structure = moved_beam();
  const MemberMesh& mesh = structure->members()[0];
  test::Numbers numbers(43);
  const State state{.x = numbers.vector(structure->size({})), .lambda = 0.4};
  const Direction direction{.dx = numbers.vector(structure->size({})), .dlambda = 0.7};
  constexpr double step = 1e-5, tolerance = 1e-9;
  for (const std::size_t node : {0U, 2U, 4U})
    for (const double offset : {0.0, 0.2}) {
      const MemberPoint point(*structure, mesh, node, offset);
      State above = state, below = state;
      above.lambda += step;
      below.lambda -= step;
      PointKinematics at, a, b;
      point.kinematics(state, at);
      point.kinematics(above, a);
      point.kinematics(below, b);
      EXPECT_LE(((a.position - b.position) / (2.0 * step) - at.rate).norm(), tolerance);
      EXPECT_LE(((a.jacobian - b.jacobian) / (2.0 * step) - at.jacobian_rate).norm(), tolerance);
      EXPECT_EQ(at.rate.norm() > 0.0, node != 2U);
      Vec2 velocity = 0.7 * at.rate;
      for (std::size_t i = 0; i < point.unknowns().size(); ++i)
        velocity += at.jacobian.col(static_cast<Index>(i)) * direction.dx[point.unknowns()[i]];
      EXPECT_LE((point.motion(state, direction).velocity - velocity).norm(), 1e-14);
    }
  for (const std::size_t node : {0U, 4U})
    for (const Component component : {Component::x, Component::z, Component::rotation, Component::face_above_z})
      EXPECT_LE(check_gradient(MemberObservable(*structure, mesh, node, component), state), 1e-8);
}

TEST(MemberPoint, FacesStandNormalToTheDeformedSection) {
  const auto structure = beam();
  const MemberMesh& mesh = structure->members()[0];
  const State state{.x = test::Numbers(41).vector(structure->size({}))};
  const Vec2 axis = MemberPoint(*structure, mesh, 2, 0.0).position(state);
  const Vec2 face = MemberPoint(*structure, mesh, 2, 0.2).position(state);
  const double angle = mesh.shape[2].angle + structure->value(state, mesh.rotations[2].value());
  EXPECT_NEAR((face - axis).norm(), 0.2, 1e-15);
  EXPECT_LE((face - axis - 0.2 * Vec2(-std::sin(angle), std::cos(angle))).norm(), 1e-15);
  EXPECT_EQ(axis, structure->current(state, mesh.nodes[2]));
}

TEST(MemberPoint, OfAClampedEndDependsOnNothing) {
  const auto structure = beam();
  EXPECT_TRUE(MemberPoint(*structure, structure->members()[0], 0, 0.2).unknowns().empty());
  EXPECT_EQ(MemberPoint(*structure, structure->members()[0], 4, 0.2).unknowns().size(), 2U);
}

TEST(MemberObservable, GradientsAreConsistent) {
  const auto structure = beam();
  const MemberMesh& mesh = structure->members()[0];
  const State state{.x = test::Numbers(42).vector(structure->size({})), .lambda = 0.3};
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    for (const Component component :
         {Component::x, Component::z, Component::rotation, Component::face_above_z, Component::face_below_z}) {
      const MemberObservable observable(*structure, mesh, node, component);
      // Where everything is held the gradient is zero, and so is the difference.
      EXPECT_LE(check_gradient(observable, state), 1e-8);
    }
}

TEST(MemberObservable, IsMeasuredFromTheAxisWithoutImperfection) {
  const auto structure = beam();
  const MemberMesh& mesh = structure->members()[0];
  const State rest{.x = Vector::Zero(structure->size({}))};
  const auto at_rest = [&](Component component) {
    return MemberObservable(*structure, mesh, 1, component).value(rest);
  };
  const Vec2 deviation = mesh.shape[1].position - mesh.axis[1].position;
  EXPECT_NEAR(deviation.norm(), 0.03, 1e-15);  // the crest of the second half wave
  EXPECT_NEAR(at_rest(Component::x), deviation.x(), 1e-15);
  EXPECT_NEAR(at_rest(Component::z), deviation.y(), 1e-15);
  EXPECT_NEAR(at_rest(Component::rotation), mesh.shape[1].angle - mesh.axis[1].angle, 1e-15);
  const double above = mesh.shape[1].position.y() + 0.2 * std::cos(mesh.shape[1].angle) -
                       (mesh.axis[1].position.y() + 0.2 * std::cos(mesh.axis[1].angle));
  EXPECT_NEAR(at_rest(Component::face_above_z), above, 1e-15);
}

TEST(DofObservable, ReadsADisplacementAndIsZeroWhereHeld) {
  const auto structure = beam();
  const State state{.x = test::Numbers(43).vector(structure->size({}))};
  const DofObservable free(*structure, structure->dof(1, Dof::x)), held(*structure, structure->dof(1, Dof::z));
  EXPECT_EQ(free.value(state), structure->value(state, structure->dof(1, Dof::x)));
  EXPECT_LE(check_gradient(free, state), 1e-8);
  EXPECT_EQ(held.value(state), 0.0);
  EXPECT_EQ(held.gradient(state).dx.norm(), 0.0);
}

TEST(ReactionObservable, GradientsAreConsistent) {
  const auto structure = beam();
  const State state{.x = 0.3 * test::Numbers(44).vector(structure->size({})), .lambda = 0.7};
  for (const Index dof : {structure->dof(0, Dof::x), structure->dof(0, Dof::z), structure->dof(1, Dof::z),
                          structure->members()[0].rotations[0].value()})
    EXPECT_LE(check_gradient(ReactionObservable(*structure, dof), state), 1e-7);
}

}  // namespace arcwall::member_point_test
