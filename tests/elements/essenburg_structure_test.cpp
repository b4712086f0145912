#include <gtest/gtest.h>

#include <cmath>

#include "elements/member_point.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/essenburg_models.hpp"

// Structures of beams whose thickness changes: linear solutions in closed form, orders of convergence, and how members
// are made of the elements. Contact is in tests/published.
namespace arcwall::essenburg_structure_test {

namespace {

constexpr double E = 21000.0, nu = 0.29, h = 0.2, EI = E * h * h * h * h / 12.0;

Vector linear_solution(const Structure& structure) {
  Linearization rest;
  structure.linearize(test::rest(structure), rest);
  return test::full(rest.K).ldlt().solve(-rest.F_lambda);
}

// At a load, by a path from rest.
State loaded(const Structure& structure, double lambda) {
  TraceOptions options;
  options.step.first = 0.2 * lambda;
  options.target_values.push_back(test::stop_at_lambda(lambda));
  return test::trace(structure, options).last().state;
}

// A beam from (0, 0) to (2, 0) between a pin and a roller, bent by end moments λ: its middle goes down.
std::unique_ptr<Structure> bent_beam(int elements, const test::EssenburgBeams& beams, bool thickness_held = false) {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(2.0, 0.0);
  builder.add_joint(a);
  builder.add_joint(b);
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis(a, b),
                      .theory = Theory::essenburg,
                      .order = beams.order,
                      .quadratic = beams.quadratic,
                      .section = test::essenburg_section(E, nu, h, h),
                      .elements = elements});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.dof(1, Dof::z));
  builder.add_load(builder.shared_rotation(0).value(), -1.0, LoadKind::proportional);
  builder.add_load(builder.shared_rotation(1).value(), 1.0, LoadKind::proportional);
  for (const Index joint : {0, 1})
    for (const ThicknessDofs& end : builder.thickness(joint)) {
      if (!thickness_held) continue;
      builder.fix(end.e);
      builder.fix(end.xi);
    }
  return builder.build();
}

// A cantilever along an axis, clamped at its start with free thickness, λ at its tip (joint 1).
std::unique_ptr<Structure> cantilever(std::unique_ptr<Axis> axis, int elements, const test::EssenburgBeams& beams,
                                      double height, const Vec2& force) {
  StructureBuilder builder;
  const Vec2 root = axis->at(0.0).position, tip = axis->at(axis->length()).position;
  builder.add_joint(root);
  builder.add_joint(tip);
  builder.add_member({.name = "cantilever",
                      .from = 0,
                      .to = 1,
                      .axis = std::move(axis),
                      .theory = Theory::essenburg,
                      .order = beams.order,
                      .quadratic = beams.quadratic,
                      .section = test::essenburg_section(1.0, nu, 1.0, height),
                      .elements = elements});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.shared_rotation(0).value());
  builder.add_load(builder.dof(1, Dof::x), force.x(), LoadKind::proportional);
  builder.add_load(builder.dof(1, Dof::z), force.y(), LoadKind::proportional);
  return builder.build();
}

}  // namespace

// Linear bending by end moments: the axis is a parabola of curvature κ = M/EI, e = 0 and ξ = ν κ/2, so the lower face
// rises by ν κ h²/8 against it. Elements of order 1 with one point have this at their nodes on any mesh.
TEST(EssenburgStructure, LinearBendingIsExactAtTheNodesOfAnyMesh) {
  const double kappa = 1.0 / EI;
  for (const int order : {1, 2})
    for (const int elements : {1, 2, 3, 8}) {
      const auto structure = bent_beam(elements, {.order = order});
      const Vector x = linear_solution(*structure);
      for (const MemberSection& at : structure->members()[0].contact_sections()) {
        const double s = 2.0 * at.fraction;
        const auto value = [&](Index dof) { return structure->value({.x = x}, dof); };
        EXPECT_NEAR(value(structure->dof(at.node, Dof::z)), -0.5 * kappa * s * (2.0 - s), 1e-11 * kappa);
        EXPECT_NEAR(value(*at.rotation), kappa * (s - 1.0), 1e-11 * kappa);
        EXPECT_NEAR(value(at.thickness->e), 0.0, 1e-11 * kappa);
        EXPECT_NEAR(value(at.thickness->xi), 0.5 * nu * kappa, 1e-10 * kappa);
      }
    }
}

// The same with M = 0.4: w = −M L²/(8 EI), the lower face at −M (L² − ν h²)/(8 EI).
TEST(EssenburgStructure, LinearBendingMovesTheLowerFaceLessThanTheAxis) {
  const auto structure = bent_beam(2, {.order = 1});
  const Vector x = 0.4 * linear_solution(*structure);
  const MemberSection middle = structure->members()[0].section(1);
  const double w = structure->value({.x = x}, structure->dof(middle.node, Dof::z));
  const double xi = structure->value({.x = x}, middle.thickness->xi),
               e = structure->value({.x = x}, middle.thickness->e);
  EXPECT_NEAR(w, -0.07142857142857, 1e-12);
  EXPECT_NEAR(w - 0.5 * h * e + 0.25 * h * h * xi, -0.07122142857143, 1e-12);
}

// Large rotations: the lower face of the middle at M = 0.4 is at −0.07108695291778, converged with 320 quadratic
// elements on the half, by an independent program whose elements of order 1 on 5, 10, 20 and 40 per half are at the
// values below.
TEST(EssenburgStructure, BendingConvergesWithTheOrdersOfTheElements) {
  const auto bottom = [](int order, int elements) {
    const auto structure = bent_beam(2 * elements, {.order = order});
    const State state = loaded(*structure, 0.4);
    const auto middle = static_cast<std::size_t>(elements);
    return MemberPoint(*structure, structure->members()[0], middle, -0.5 * h).position(state).y() + 0.5 * h;
  };
  const double converged = -0.07108695291778;
  std::vector<double> linear;
  const std::vector<double> published{-0.07108215, -0.07108567, -0.07108663, -0.07108687};
  for (std::size_t k = 0; k < 4; ++k) {
    const double value = bottom(1, 5 << k);
    EXPECT_NEAR(value, published[k], 0.6e-8) << k;
    linear.push_back(value - converged);
  }
  test::expect_order(linear, 2.0);
  test::expect_order(test::on_four_meshes(10, [&](int elements) { return bottom(2, elements) - converged; }), 4.0);
}

// A very thick straight cantilever, loaded across at its tip: against the limit of the quadratic elements. The
// thickness makes layers at the ends of length h/5, which the elements must resolve before the orders show.
TEST(EssenburgStructure, LoadedCantileversConvergeWithTheOrdersOfTheElements) {
  for (const QuadraticTerm quadratic : {QuadraticTerm::fixed, QuadraticTerm::director}) {
    const auto tip = [&](int order, int elements) {
      const test::EssenburgBeams beams{.order = order, .quadratic = quadratic};
      const auto structure = cantilever(straight_axis({0.0, 0.0}, {1.0, 0.0}), elements, beams, 1.5, {0.0, -1.0});
      return test::displacement_of(*structure, loaded(*structure, 0.0675), 1).y();
    };
    const double limit = tip(2, 256);
    test::expect_order(test::on_four_meshes(8, [&](int elements) { return tip(1, elements) - limit; }), 2.0);
    test::expect_order(test::on_four_meshes(8, [&](int elements) { return tip(2, elements) - limit; }), 4.0);
  }
}

// The same of a quarter of a circle as thick as its radius, the stress-free state of which is curved: the two finest of
// the meshes that resolve the layers.
TEST(EssenburgStructure, CurvedCantileversKeepTheOrders) {
  for (const QuadraticTerm quadratic : {QuadraticTerm::fixed, QuadraticTerm::director}) {
    const auto tip = [&](int order, int elements) {
      const test::EssenburgBeams beams{.order = order, .quadratic = quadratic};
      auto axis = arc_axis({0.0, 0.0}, {std::sqrt(0.5), 1.0 - std::sqrt(0.5)}, {1.0, 1.0});
      const auto structure = cantilever(std::move(axis), elements, beams, 1.0, {0.0, -1.0});
      return test::displacement_of(*structure, loaded(*structure, 0.02), 1).y();
    };
    const double limit = tip(2, 512);
    for (const int order : {1, 2}) {
      const double coarse = tip(order, 64) - limit, fine = tip(order, 128) - limit;
      EXPECT_NEAR(std::log2(coarse / fine), 2.0 * order, 0.1) << coarse << ", " << fine;
    }
  }
}

// The moment does work on the rotation of the section, at any size: a thin cantilever closes to a circle at 2π EI,
// whose strains of h/2 · 2π = 0.0063 at the faces change that by their square.
TEST(EssenburgStructure, AnEndMomentRollsTheCantileverUp) {
  constexpr double thin = 0.002, bending = thin * thin * thin / 12.0;
  StructureBuilder builder;
  builder.add_joint({0.0, 0.0});
  builder.add_joint({1.0, 0.0});
  builder.add_member({.name = "cantilever",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis({0.0, 0.0}, {1.0, 0.0}),
                      .theory = Theory::essenburg,
                      .quadratic = QuadraticTerm::director,
                      .section = test::essenburg_section(1.0, nu, 1.0, thin),
                      .elements = 40});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.shared_rotation(0).value());
  builder.add_load(builder.shared_rotation(1).value(), 2.0 * pi * bending, LoadKind::proportional);
  const auto structure = builder.build();
  const State state = loaded(*structure, 1.0);
  EXPECT_NEAR(structure->value(state, *structure->members()[0].rotations.back()), 2.0 * pi, 1e-3);
  EXPECT_LE(structure->current(state, 1).norm(), 1e-3);
  EXPECT_NEAR(structure->energy(state), -0.5 * bending * std::pow(2.0 * pi, 2), 1e-3 * bending);
}

// Held at the supports, e and ξ make layers there that shift the linear first contact of a face 0.08 above a foundation
// from M = 0.449303 to 0.44889 (Essenburg's equations solved exactly).
TEST(EssenburgStructure, ThicknessIsFreeAtSupportsUnlessHeld) {
  const auto first_contact = [](bool held) {
    const auto structure = bent_beam(80, {}, held);
    const Vector x = linear_solution(*structure);
    const MemberSection middle = structure->members()[0].section(40);
    const auto value = [&](Index dof) { return structure->value({.x = x}, dof); };
    const double bottom = value(structure->dof(middle.node, Dof::z)) - 0.5 * h * value(middle.thickness->e) +
                          0.25 * h * h * value(middle.thickness->xi);
    return -0.08 / bottom;
  };
  EXPECT_NEAR(first_contact(false), 0.4493029786, 1e-9);
  EXPECT_NEAR(first_contact(true), 0.44889, 5e-6);
}

namespace {

// A cantilever from (0, 0) over (0.5, 0) to (1, kink), loaded across at its tip, with or without a hinge at the joint.
std::unique_ptr<Structure> two_members(double kink, bool hinge, double second_height = 0.2) {
  StructureBuilder builder;
  const std::vector<Vec2> at{{0.0, 0.0}, {0.5, 0.0}, {1.0, kink}};
  for (const Vec2& place : at) builder.add_joint(place);
  for (const Index k : {0, 1}) {
    const auto from = static_cast<std::size_t>(k);
    builder.add_member({.name = k == 0 ? "first" : "second",
                        .from = k,
                        .to = k + 1,
                        .axis = straight_axis(at[from], at[from + 1]),
                        .theory = Theory::essenburg,
                        .section = test::essenburg_section(1.0, nu, 0.1, k == 0 ? 0.2 : second_height),
                        .elements = 4,
                        .hinge_from = k == 1 && hinge});
  }
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.shared_rotation(0).value());
  builder.add_load(builder.dof(2, Dof::z), 1e-5, LoadKind::proportional);
  return builder.build();
}

}  // namespace

// A cut is no joint: the thickness goes on where the axis does and the section is the same, and nowhere else.
TEST(EssenburgStructure, MembersThatGoOnStraightShareTheirThickness) {
  const auto cut = two_members(0.0, false);
  const auto whole = cantilever(straight_axis({0.0, 0.0}, {1.0, 0.0}), 8, {}, 0.2, {0.0, 1e-4});
  EXPECT_EQ(cut->size({}), whole->size({}));
  const Vector x = linear_solution(*cut), y = linear_solution(*whole);  // widths 0.1 and 1, loads alike
  EXPECT_NEAR(cut->value({.x = x}, cut->dof(2, Dof::z)), whole->value({.x = y}, whole->dof(1, Dof::z)),
              1e-10 * std::abs(x.maxCoeff()));
  EXPECT_EQ(two_members(0.01, false)->size({}), whole->size({}) + 2);
  EXPECT_EQ(two_members(0.0, false, 0.1)->size({}), whole->size({}) + 2);
  EXPECT_EQ(two_members(0.0, true)->size({}), whole->size({}) + 3);
}

TEST(EssenburgStructure, ReactionsBalanceADistributedLoad) {
  for (const int order : {1, 2}) {
    StructureBuilder builder;
    const Vec2 a(0.0, 0.0), b(1.0, 0.5);
    builder.add_joint(a);
    builder.add_joint(b);
    const Index member = builder.add_member({.name = "beam",
                                             .from = 0,
                                             .to = 1,
                                             .axis = straight_axis(a, b),
                                             .theory = Theory::essenburg,
                                             .order = order,
                                             .section = test::essenburg_section(100.0, nu, 0.2, 0.2),
                                             .elements = 5});
    builder.fix(builder.dof(0, Dof::x));
    builder.fix(builder.dof(0, Dof::z));
    builder.fix(builder.shared_rotation(0).value());
    builder.add_distributed_load(member, {0.01, -0.02}, LoadKind::proportional);
    const auto structure = builder.build();
    const State state = test::solved_at(*structure, test::rest(*structure), 1.0, 4);
    const double length = std::hypot(1.0, 0.5);
    EXPECT_NEAR(structure->reaction(state, structure->dof(0, Dof::x)), -0.01 * length, 1e-13);
    EXPECT_NEAR(structure->reaction(state, structure->dof(0, Dof::z)), 0.02 * length, 1e-13);
  }
}

}  // namespace arcwall::essenburg_structure_test
