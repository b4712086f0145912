#include "elements/structure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "core/derivative_check.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/essenburg_models.hpp"
#include "tests/support/models.hpp"

namespace arcwall::structure_test {

namespace {

// A frame that has everything: a straight column with an imperfection, a curved and hinged girder, a bar, held and free
// joints, proportional and constant point and distributed loads.
struct Everything {
  StructureBuilder builder{};
  Index foot = 0, corner = 0, far = 0, end = 0;

  Everything() {
    const Vec2 at[] = {{0.0, 0.0}, {0.2, 3.0}, {4.0, 3.0}, {4.5, 0.0}};
    foot = builder.add_joint(at[0]);
    corner = builder.add_joint(at[1]);
    far = builder.add_joint(at[2]);
    end = builder.add_joint(at[3]);
    const Section section{.E = 100.0, .A = 2.0, .I = 0.3, .height = 0.4};
    const Index column = builder.add_member({.name = "column",
                                             .from = foot,
                                             .to = corner,
                                             .axis = straight_axis(at[0], at[1]),
                                             .imperfection = {{.amplitude = 0.05, .waves = 2}},
                                             .section = section,
                                             .elements = 3});
    const Index girder = builder.add_member({.name = "girder",
                                             .from = corner,
                                             .to = far,
                                             .axis = arc_axis(at[1], {2.0, 3.8}, at[2]),
                                             .section = section,
                                             .elements = 4,
                                             .hinge_to = true});
    const Index bar = builder.add_member({.name = "bar",
                                          .from = far,
                                          .to = end,
                                          .axis = straight_axis(at[2], at[3]),
                                          .theory = Theory::truss,
                                          .strain = TrussStrain::log,
                                          .section = section});
    for (const Index node : {foot, end})
      for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(node, which));
    builder.fix(builder.shared_rotation(foot).value());
    builder.fix(builder.dof(far, Dof::x));  // a guide
    builder.add_load(builder.dof(corner, Dof::x), 1.5, LoadKind::proportional);
    builder.add_load(builder.dof(builder.mesh(girder).nodes[2], Dof::z), -0.7, LoadKind::constant);
    builder.add_load(builder.shared_rotation(corner).value(), 0.4, LoadKind::proportional);
    builder.add_load(builder.dof(end, Dof::x), 0.3, LoadKind::proportional);  // on a support
    builder.add_distributed_load(column, {0.5, -0.2}, LoadKind::proportional);
    builder.add_distributed_load(girder, {0.1, -0.6}, LoadKind::constant);
    builder.add_distributed_load(bar, {0.2, 0.3}, LoadKind::proportional);
  }
};

Vec2 reaction_sum(const Structure& structure, const State& state) {
  Vec2 sum = Vec2::Zero();
  for (Index node = 0; node < structure.node_count(); ++node)
    sum += Vec2(structure.reaction(state, structure.dof(node, Dof::x)),
                structure.reaction(state, structure.dof(node, Dof::z)));
  return sum;
}

// Whose rows vanish on parallel motions, in a state that is none of equilibrium.
std::vector<Index> nodes_afloat(const Structure& structure) {
  test::Numbers numbers(31);
  Linearization now;
  structure.linearize({.x = 0.05 * numbers.vector(structure.size({})), .lambda = 0.7}, now);
  const Matrix K = test::full(now.K);
  Matrix motion = Matrix::Zero(K.rows(), 2);
  for (Index i = 0; i < K.rows(); ++i) {
    const Dof which = structure.meaning(i).dof;
    if (which == Dof::x) motion(i, 0) = 1.0;
    if (which == Dof::z) motion(i, 1) = 1.0;
  }
  std::vector<Index> nodes;
  for (Index i = 0; i < K.rows(); ++i) {
    if (!now.translation_free[static_cast<std::size_t>(i)]) continue;
    nodes.push_back(structure.meaning(i).node);
    EXPECT_EQ(structure.unknown(structure.dof(nodes.back(), Dof::x)), i);
    EXPECT_EQ(structure.unknown(structure.dof(nodes.back(), Dof::z)), i + 1);
    EXPECT_LE((K.middleRows(i, 2) * motion).norm(), 1e-13 * K.middleRows(i, 2).norm());
  }
  return nodes;
}

}  // namespace

TEST(Structure, DerivativesAreConsistentWithEverythingInIt) {
  const auto structure = Everything().builder.build();
  test::Numbers numbers(30);
  for (int i = 0; i < 5; ++i) {
    const State state{.x = 0.3 * numbers.vector(structure->size({})), .lambda = numbers()};
    // Central differences: round-off 1e-12 times ratios of stiffnesses up to 100.
    EXPECT_LE(check_derivatives(*structure, state).worst(), 1e-9);
  }
}

// Two nodes of the column and two of the girder share no element with a support; the corner is one of them.
TEST(Structure, ParallelMotionsExertNoForceOnWhatIsAfloat) {
  Everything everything;
  const std::vector<Index> nodes = nodes_afloat(*everything.builder.build());
  EXPECT_EQ(nodes.size(), 4U);
  EXPECT_EQ(std::count(nodes.begin(), nodes.end(), everything.corner), 1);
}

// The first and the last of five elements are held; nodes inside an element are as free as those between two.
TEST(Structure, ParallelMotionsExertNoForceWhateverTheTheory) {
  const std::tuple<Theory, int, std::size_t> cases[] = {
      {Theory::euler_bernoulli, 2, 2}, {Theory::elastica, 4, 2},  {Theory::elastica, 6, 2}, {Theory::reissner, 1, 2},
      {Theory::reissner, 2, 5},        {Theory::essenburg, 1, 2}, {Theory::essenburg, 2, 5}};
  for (const auto& [theory, order, expected] : cases) {
    SCOPED_TRACE("theory " + std::to_string(static_cast<int>(theory)) + ", order " + std::to_string(order));
    StructureBuilder builder;
    const Vec2 from(0.0, 0.0), to(2.0, 0.5);
    const Index first = builder.add_joint(from), last = builder.add_joint(to);
    builder.add_member({.name = "beam",
                        .from = first,
                        .to = last,
                        .axis = straight_axis(from, to),
                        .theory = theory,
                        .order = order,
                        .section = test::essenburg_section(100.0, 0.3, 0.2, 0.2),
                        .elements = 5});
    for (const Index node : {first, last}) builder.fix(builder.dof(node, Dof::z));
    builder.fix(builder.dof(first, Dof::x));
    EXPECT_EQ(nodes_afloat(*builder.build()).size(), expected);
  }
}

TEST(Structure, ReactionsHoldTheLoads) {
  const auto structure = Everything().builder.build();
  const State loaded = test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, 0.8, 4);
  // Lengths: column √(0.2² + 3²) and its imperfection's, girder and bar by their axes.
  const auto column = straight_axis({0.0, 0.0}, {0.2, 3.0});
  const ImperfectAxis shape(*column, {{.amplitude = 0.05, .waves = 2}});
  double column_length = 0.0;  // element by element, as Gauss points are only so many
  for (int k = 0; k < 3; ++k) column_length += shape.length(k * column->length() / 3, (k + 1) * column->length() / 3);
  const double girder_length = arc_axis({0.2, 3.0}, {2.0, 3.8}, {4.0, 3.0})->length();
  const double bar_length = std::hypot(0.5, 3.0);
  const Vec2 proportional = Vec2(1.5 + 0.3, 0.0) + column_length * Vec2(0.5, -0.2) + bar_length * Vec2(0.2, 0.3);
  const Vec2 constant = Vec2(0.0, -0.7) + girder_length * Vec2(0.1, -0.6);
  EXPECT_LE((reaction_sum(*structure, loaded) + 0.8 * proportional + constant).norm(), 1e-12);
}

TEST(Structure, ReactionsBalanceMomentsInTheDeformedState) {
  // A clamped cantilever with a tip force across: the clamp's moment is force times the tip's current arm.
  const test::Cantilever cantilever{.EA = 1e3, .EI = 1.0, .length = 1.0, .elements = 4, .tip_force = 2.0};
  const auto structure = cantilever.structure();
  const State bent = test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, 1.0, 4);
  const Vec2 tip = structure->current(bent, 1);
  const Index clamp = structure->members()[0].rotations[0].value();
  EXPECT_NEAR(structure->reaction(bent, clamp), -2.0 * tip.x(), 1e-10);
  EXPECT_NEAR(structure->reaction(bent, structure->dof(0, Dof::z)), -2.0, 1e-10);
  EXPECT_NEAR(structure->reaction(bent, structure->dof(0, Dof::x)), 0.0, 1e-10);
  EXPECT_EQ(structure->reaction(bent, structure->dof(1, Dof::z)), 0.0) << "free";
}

TEST(Structure, AHeldDofIsNoUnknownAndZero) {
  Everything model;
  const auto structure = model.builder.build();
  const Index held = structure->dof(model.foot, Dof::x), free = structure->dof(model.corner, Dof::z);
  EXPECT_FALSE(structure->unknown(held).has_value());
  ASSERT_TRUE(structure->unknown(free).has_value());
  const auto meaning = structure->meaning(*structure->unknown(free));
  EXPECT_EQ(meaning.node, model.corner);
  EXPECT_EQ(meaning.dof, Dof::z);
  const State state{.x = test::Numbers(31).vector(structure->size({}))};
  EXPECT_EQ(structure->value(state, held), 0.0);
  EXPECT_EQ(structure->value(state, free), state.x[*structure->unknown(free)]);
  EXPECT_EQ(structure->current(state, model.foot), structure->position(model.foot));
}

TEST(Structure, AHingeGivesTheMemberARotationOfItsOwn) {
  Everything model;
  const auto structure = model.builder.build();
  const MemberMesh &column = structure->members()[0], &girder = structure->members()[1], &bar = structure->members()[2];
  EXPECT_EQ(column.rotations.back(), girder.rotations.front());  // rigidly joined
  EXPECT_EQ(column.rotations.back(), model.builder.shared_rotation(model.corner));
  EXPECT_TRUE(girder.rotations.back().has_value());
  EXPECT_FALSE(model.builder.shared_rotation(model.far).has_value());
  EXPECT_FALSE(bar.rotations.front().has_value());  // bars do not turn
}

// A moment cannot pass a hinge: the hinged end of a propped beam under a tip moment has none.
TEST(Structure, AHingeTransmitsNoMoment) {
  StructureBuilder builder;
  const Vec2 at[] = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  for (const Vec2& position : at) builder.add_joint(position);
  for (int i = 0; i < 2; ++i)
    builder.add_member({.name = i == 0 ? "a" : "b",
                        .from = i,
                        .to = i + 1,
                        .axis = straight_axis(at[i], at[i + 1]),
                        .section = {.E = 1.0, .A = 100.0, .I = 1.0},
                        .elements = 2,
                        .hinge_to = i == 0});
  for (const Index node : {0, 2})
    for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(node, which));
  builder.fix(builder.shared_rotation(0).value());
  builder.fix(builder.shared_rotation(2).value());
  builder.add_load(builder.dof(1, Dof::z), -1e-6, LoadKind::proportional);
  const auto structure = builder.build();
  const State loaded = test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, 1.0, 1);
  // Two cantilevers of length 1 share the force: w = −½ · 1e-6 · 1³/(3 EI), clamp moments ½ · 1e-6.
  EXPECT_NEAR(structure->value(loaded, structure->dof(1, Dof::z)), -1e-6 / 6.0, 1e-12);
  EXPECT_NEAR(structure->reaction(loaded, structure->members()[0].rotations.front().value()), 0.5e-6, 1e-12);
}

TEST(Structure, ARampAppliesTheConstantLoadsProportionallyAndNoOthers) {
  Everything model;
  const auto whole = model.builder.build(), ramp = model.builder.build(true);
  const Vector x = 0.1 * test::Numbers(32).vector(whole->size({}));
  Vector F(x.size()), G(x.size());
  whole->residual({.x = x, .lambda = 0.0}, F);
  ramp->residual({.x = x, .lambda = 1.0}, G);
  EXPECT_LE((F - G).norm(), 1e-14 * F.norm());
  ramp->residual({.x = Vector::Zero(x.size()), .lambda = 0.0}, G);
  EXPECT_EQ(G.norm(), 0.0);
}

TEST(Structure, WeightsDoNotDependOnTheUnitsOrTheNumberOfElements) {
  // All nodes moved by (L, 0) and turned by 1 have the length √2 whatever the mesh: held degrees of freedom count as
  // zeros.
  for (const double unit : {1.0, 0.01})
    for (const int elements : {2, 20}) {
      StructureBuilder builder;
      const Vec2 a(0.0, 0.0), b(3.0 * unit, 4.0 * unit);
      builder.add_joint(a);
      builder.add_joint(b);
      builder.add_member({.name = "m",
                          .from = 0,
                          .to = 1,
                          .axis = straight_axis(a, b),
                          .section = {.E = 1.0, .A = 1.0, .I = 1.0},
                          .elements = elements});
      builder.add_load(builder.dof(1, Dof::x), 1.0, LoadKind::proportional);
      const auto structure = builder.build();
      EXPECT_NEAR(structure->length_scale(), 5.0 * unit, 1e-15);
      Vector x = Vector::Zero(structure->size({}));
      for (Index i = 0; i < x.size(); ++i) {
        const Dof which = structure->meaning(i).dof;
        x[i] = which == Dof::x ? 5.0 * unit : which == Dof::rotation ? 1.0 : 0.0;
      }
      EXPECT_NEAR((structure->weights({}).array() * x.array().square()).sum(), 2.0, 1e-13);
    }
}

TEST(Structure, ForceScaleIsTheGreatestReferenceLoad) {
  EXPECT_EQ(test::Cantilever{.tip_force = -3.0}.structure()->force_scale(), 3.0);
  const test::Cantilever moment{.length = 2.0, .tip_moment = 5.0};
  EXPECT_EQ(moment.structure()->force_scale(), 2.5);
}

// EA/h, not 12 EI/h³, is the greatest entry of this stubby beam: 0.1 ε L EA/h, h = L/4, two elements at a node.
TEST(Structure, ForceRoundOffFollowsTheStiffestEntry) {
  const auto structure = test::Cantilever{.EA = 1e6, .EI = 1.0, .length = 1.0, .elements = 4}.structure();
  EXPECT_NEAR(structure->force_roundoff(), 0.1 * 2.220446049250313e-16 * 2.0 * 4e6, 1e-22);
}

}  // namespace arcwall::structure_test
