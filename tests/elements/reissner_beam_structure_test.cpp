#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "elements/mechanism.hpp"
#include "elements/reissner_beam.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/models.hpp"

// Structures of beams that are flexible in shear: orders of convergence under small loads, where Castigliano's theorem
// has the answer, and how members are made of the elements. Large deflections are in tests/published.
namespace arcwall::exact_beam_structure_test {

namespace {

// E = G = 1, so that areas are stiffnesses.
Section section(const ExactBeamStiffness& of) {
  return {.E = 1.0, .A = of.EA, .I = of.EI, .G = 1.0, .shear_area = of.GA};
}

// A cantilever along an axis, clamped at its start.
struct Cantilever {
  ExactBeamStiffness stiffness{};
  int order = 2, elements = 1;
  Vec2 tip_force = Vec2::Zero();
  double tip_moment = 0.0;
  Vec2 distributed = Vec2::Zero();
  std::vector<SineDeviation> imperfection{};

  std::unique_ptr<Structure> along(std::unique_ptr<Axis> axis) const {
    StructureBuilder builder;
    const Index root = builder.add_joint(axis->at(0.0).position);
    const Index tip = builder.add_joint(axis->at(axis->length()).position);
    const Index member = builder.add_member({.name = "cantilever",
                                             .from = root,
                                             .to = tip,
                                             .axis = std::move(axis),
                                             .imperfection = imperfection,
                                             .theory = Theory::reissner,
                                             .order = order,
                                             .section = section(stiffness),
                                             .elements = elements});
    for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(root, which));
    builder.fix(builder.shared_rotation(root).value());
    builder.add_load(builder.dof(tip, Dof::x), tip_force.x(), LoadKind::proportional);
    builder.add_load(builder.dof(tip, Dof::z), tip_force.y(), LoadKind::proportional);
    builder.add_load(builder.shared_rotation(tip).value(), tip_moment, LoadKind::proportional);
    if (distributed != Vec2::Zero()) builder.add_distributed_load(member, distributed, LoadKind::proportional);
    return builder.build();
  }
  std::unique_ptr<Structure> straight() const { return along(straight_axis({0.0, 0.0}, {1.0, 0.0})); }
};

constexpr Index tip = 1;  // the second joint

// Displacement of the tip under small loads: −K(0)⁻¹ F_λ.
Vec2 linear_tip(const Structure& structure) {
  Linearization rest;
  structure.linearize(test::rest(structure), rest);
  const Matrix K = test::full(rest.K);
  return test::displacement_of(structure, {.x = K.ldlt().solve(-rest.F_lambda)}, tip);
}

// Errors over four meshes fall with h^(2 order). `finest_error` is a little above the error measured on the finest one.
void expect_order(int order, double finest_error, const std::function<double(int elements)>& error) {
  SCOPED_TRACE("order " + std::to_string(order));
  const std::vector<double> errors = test::on_four_meshes(4, error);
  test::expect_order(errors, 2.0 * order);
  EXPECT_LE(std::abs(errors.back()), finest_error);
}

State solved(const Structure& structure, double lambda, int steps) {
  return test::solved_at(structure, test::rest(structure), lambda, steps);
}

}  // namespace

// Timoshenko's beam under a tip force: P L³/(3 EI) + P L/GA, whatever the thickness. Order 2 has it on any mesh; order
// 1 misses 1/(4 n²) of the bending.
TEST(ExactBeamOrder, ThinBeamsDoNotLock) {
  for (const double thickness : {0.1, 1e-2, 1e-3, 1e-4}) {
    SCOPED_TRACE(thickness);
    const double EI = thickness * thickness / 12.0, GA = 0.3;
    const double bending = 1.0 / (3.0 * EI), shear = 1.0 / GA;
    for (const int elements : {1, 2, 4}) {
      const auto deflection = [&](int order) {
        const Cantilever beam{.stiffness = {.EA = 1.0, .GA = GA, .EI = EI},
                              .order = order,
                              .elements = elements,
                              .tip_force = {0.0, 1.0}};
        return linear_tip(*beam.straight()).y();
      };
      const double tolerance = 1e-15 / EI * bending;  // ε times the condition of K
      EXPECT_NEAR(deflection(1), bending * (1.0 - 0.25 / (elements * elements)) + shear, tolerance);
      EXPECT_NEAR(deflection(2), bending + shear, tolerance);
    }
  }
}

// The moment does work on the rotation, at any size: a full circle at 2π, two at 4π.
TEST(ExactBeamOrder, AnEndMomentRollsTheCantileverUp) {
  const Cantilever beam{
      .stiffness = {.EA = 1e3, .GA = 400.0, .EI = 1.0}, .order = 2, .elements = 24, .tip_moment = 1.0};
  const auto structure = beam.straight();
  const Index rotation = structure->members()[0].rotations.back().value();
  for (const int turns : {1, 2}) {
    const State state = solved(*structure, 2.0 * pi * turns, 40 * turns);
    EXPECT_NEAR(structure->value(state, rotation), 2.0 * pi * turns, 1e-10);
    EXPECT_LE(structure->current(state, tip).norm(), 1e-3);
    EXPECT_NEAR(structure->energy(state), -0.5 * std::pow(2.0 * pi * turns, 2), 1e-9);
  }
}

// A quarter of a circle of radius 1 under a small tip force or load along z. With N = V sin α, Q = V cos α, V the force
// beyond a section at α, and arms of 1 − sin α to the tip, Castigliano's theorem gives
// P [(3π/4 − 2)/EI + (π/4)/EA + (π/4)/GA] and q [(5/4 − π/2 + π²/16)/EI + (π²/16 − 1/4)/EA + (π²/16 + 1/4)/GA].
TEST(ExactBeamOrder, QuarterCircleUnderSmallLoads) {
  constexpr ExactBeamStiffness thick{.EA = 100.0, .GA = 40.0, .EI = 1.0};
  const auto axis = [] { return arc_axis({0.0, 0.0}, {std::sqrt(0.5), 1.0 - std::sqrt(0.5)}, {1.0, 1.0}); };
  const double under_force = (0.75 * pi - 2.0) / thick.EI + 0.25 * pi / thick.EA + 0.25 * pi / thick.GA;
  const double sixteenth = pi * pi / 16.0;
  const double under_load =
      (1.25 - 0.5 * pi + sixteenth) / thick.EI + (sixteenth - 0.25) / thick.EA + (sixteenth + 0.25) / thick.GA;
  for (const int order : {1, 2}) {
    expect_order(order, order == 1 ? 1.2e-4 : 2.5e-8, [&](int elements) {
      const Cantilever beam{.stiffness = thick, .order = order, .elements = elements, .tip_force = {0.0, 1.0}};
      return linear_tip(*beam.along(axis())).y() - under_force;
    });
    expect_order(order, order == 1 ? 1.2e-4 : 2.5e-8, [&](int elements) {
      const Cantilever beam{.stiffness = thick, .order = order, .elements = elements, .distributed = {0.0, 1.0}};
      return linear_tip(*beam.along(axis())).y() - under_load;
    });
  }
}

// Along z = y(x) = 0.2 sin πx, small force along z at the tip: Castigliano again, the integral by Simpson's rule. The
// nodes of the deviated axis are not equally far apart.
TEST(ExactBeamOrder, ImperfectCantileverUnderASmallForce) {
  constexpr ExactBeamStiffness thick{.EA = 100.0, .GA = 40.0, .EI = 1.0};
  const auto compliance = [&](double x) {
    const double slope = 0.2 * pi * std::cos(pi * x), ds = std::sqrt(1.0 + slope * slope);
    const double M = 1.0 - x, N = slope / ds, Q = 1.0 / ds;
    return ds * (M * M / thick.EI + N * N / thick.EA + Q * Q / thick.GA);
  };
  constexpr int parts = 2000;
  double exact = 0.0;
  for (int i = 0; i < parts; ++i)
    exact += (compliance(double(i) / parts) + 4.0 * compliance((i + 0.5) / parts) + compliance((i + 1.0) / parts)) /
             (6.0 * parts);
  for (const int order : {1, 2})
    expect_order(order, order == 1 ? 1.2e-4 : 3e-9, [&](int elements) {
      const Cantilever beam{.stiffness = thick,
                            .order = order,
                            .elements = elements,
                            .tip_force = {0.0, 1.0},
                            .imperfection = {{.amplitude = 0.2, .waves = 1}}};
      return linear_tip(*beam.straight()).y() - exact;
    });
}

namespace {

constexpr ExactBeamStiffness ordinary{.EA = 100.0, .GA = 40.0, .EI = 1.0};

}  // namespace

TEST(ExactBeamStructure, MiddleNodesAreNodesOfTheStructureButNotOfTheMesh) {
  const auto first = Cantilever{.stiffness = ordinary, .order = 1, .elements = 4}.straight();
  const auto second = Cantilever{.stiffness = ordinary, .order = 2, .elements = 4}.straight();
  EXPECT_EQ(first->node_count(), 5);
  EXPECT_EQ(first->size({}), 12);
  EXPECT_TRUE(first->members()[0].middle_nodes.empty());
  EXPECT_EQ(second->node_count(), 9);
  EXPECT_EQ(second->size({}), 24);
  const MemberMesh& mesh = second->members()[0];
  EXPECT_EQ(mesh.nodes.size(), 5u);
  ASSERT_EQ(mesh.middle_nodes.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_LE((second->position(mesh.middle_nodes[k]) - Vec2(0.125 + 0.25 * double(k), 0.0)).norm(), 1e-15);
    EXPECT_TRUE(second->unknown(mesh.middle_rotations[k]));
  }
  // Means over all nodes: a unit displacement of every node along x, but for the clamped one.
  const Vector weights = second->weights({});
  double translation = 0.0, rotation = 0.0;
  for (Index i = 0; i < weights.size(); ++i)
    (second->meaning(i).dof == Dof::rotation ? rotation : translation) += weights[i];
  EXPECT_NEAR(rotation, 8.0 / 9.0, 1e-15);
  EXPECT_NEAR(translation, 2.0 * 8.0 / 9.0, 1e-14);
  // Unknowns are numbered along the member, so the stiffness is a band.
  Linearization now;
  second->linearize(test::rest(*second), now);
  for (Index j = 0; j < now.K.cols(); ++j)
    for (SparseMatrix::InnerIterator entry(now.K, j); entry; ++entry) EXPECT_LE(entry.row() - j, 8);
}

TEST(ExactBeamStructure, ReactionsBalanceTheLoads) {
  for (const int order : {1, 2}) {
    const Cantilever beam{.stiffness = ordinary,
                          .order = order,
                          .elements = 5,
                          .tip_force = {0.3, -0.4},
                          .tip_moment = 0.2,
                          .distributed = {0.5, -1.0}};
    const auto structure = beam.straight();
    const State state = solved(*structure, 1.5, 3);
    EXPECT_NEAR(structure->reaction(state, structure->dof(0, Dof::x)), -1.5 * (0.3 + 0.5), 1e-12);
    EXPECT_NEAR(structure->reaction(state, structure->dof(0, Dof::z)), -1.5 * (-0.4 - 1.0), 1e-12);
    // Moments about the clamped end at the origin, of the loads where they are now.
    const Vec2 end = structure->current(state, tip);
    double moment = 1.5 * (0.2 + end.x() * -0.4 - end.y() * 0.3);
    const MemberMesh& mesh = structure->members()[0];
    const auto add = [&](Index node, double share) {
      const Vec2 r = structure->current(state, node);
      moment += 1.5 * share * (r.x() * -1.0 - r.y() * 0.5);
    };
    for (std::size_t k = 0; k + 1 < mesh.nodes.size(); ++k) {
      const double ends = order == 1 ? 0.1 : 1.0 / 30.0;
      add(mesh.nodes[k], ends);
      add(mesh.nodes[k + 1], ends);
      if (order == 2) add(mesh.middle_nodes[k], 4.0 / 30.0);
    }
    EXPECT_NEAR(structure->reaction(state, structure->members()[0].rotations.front().value()), -moment, 1e-12);
  }
}

TEST(ExactBeamStructure, MechanismsAreFoundHoweverThinAndFine) {
  for (const double thickness : {1.0, 1e-2, 1e-4, 1e-10})
    for (const int order : {1, 2})
      for (const bool rolls : {false, true}) {
        StructureBuilder builder;
        const Index left = builder.add_joint({0.0, 0.0}), right = builder.add_joint({0.6, 0.8});
        builder.add_member({.name = "beam",
                            .from = left,
                            .to = right,
                            .axis = straight_axis({0.0, 0.0}, {0.6, 0.8}),
                            .theory = Theory::reissner,
                            .order = order,
                            .section = section({.EA = 1.0, .GA = 0.3, .EI = thickness * thickness / 12.0}),
                            .elements = order == 1 ? 1 : 40});
        builder.fix(builder.dof(left, Dof::x));
        builder.fix(builder.dof(left, Dof::z));
        if (!rolls) builder.fix(builder.dof(right, Dof::z));
        const auto mechanism = find_mechanism(*builder.build());
        EXPECT_EQ(mechanism.has_value(), rolls) << "thickness " << thickness << " order " << order;
      }
}

}  // namespace arcwall::exact_beam_structure_test
