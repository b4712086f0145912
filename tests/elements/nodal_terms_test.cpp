#include "elements/nodal_terms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/algebra/bordered_solver.hpp"
#include "core/derivative_check.hpp"
#include "elements/mechanism.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/essenburg_models.hpp"
#include "tests/support/sliding_models.hpp"

namespace arcwall::nodal_terms_test {

namespace {

struct BeamKind {
  Theory theory;
  int order;
};

constexpr BeamKind beam_kinds[] = {{Theory::euler_bernoulli, 2}, {Theory::elastica, 4}, {Theory::elastica, 6},
                                   {Theory::reissner, 1},        {Theory::reissner, 2}, {Theory::essenburg, 1},
                                   {Theory::essenburg, 2}};

std::string name_of(const BeamKind& kind) {
  return "theory " + std::to_string(static_cast<int>(kind.theory)) + ", order " + std::to_string(kind.order);
}

// A beam from joint 0 to joint 1, clamped at joint 0; EA = 4, EI = 0.0133.
StructureBuilder clamped_beam(const BeamKind& kind, const Vec2& to, int elements,
                              QuadraticTerm quadratic = QuadraticTerm::fixed) {
  StructureBuilder builder;
  const Vec2 from(0.0, 0.0);
  builder.add_joint(from);
  builder.add_joint(to);
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis(from, to),
                      .theory = kind.theory,
                      .order = kind.order,
                      .quadratic = quadratic,
                      .section = test::essenburg_section(100.0, 0.3, 0.2, 0.2),
                      .elements = elements});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.shared_rotation(0).value());
  return builder;
}

// A straight beam from (0, 0) to (L, 0) between joints 0 and 1, without supports. Its stiffnesses are its numbers.
StructureBuilder plain_beam(const BeamKind& kind, double EA, double EI, double L, int elements, double GA = 0.0) {
  StructureBuilder builder;
  builder.add_joint({0.0, 0.0});
  builder.add_joint({L, 0.0});
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis({0.0, 0.0}, {L, 0.0}),
                      .theory = kind.theory,
                      .order = kind.order,
                      .section = test::section_of(EA, EI, GA),
                      .elements = elements});
  return builder;
}

void clamp(StructureBuilder& builder, Index joint) {
  builder.fix(builder.dof(joint, Dof::x));
  builder.fix(builder.dof(joint, Dof::z));
  builder.fix(builder.shared_rotation(joint).value());
}

State rest(const System& system) { return {.x = Vector::Zero(system.size({}))}; }

// Every degree of freedom of the first end is moved, and one of the last; springs at the last and inside, to the ground
// and between degrees of freedom of which none, one or both are held.
StructureBuilder moved_and_sprung(const BeamKind& kind) {
  StructureBuilder builder = clamped_beam(kind, {2.0, 0.5}, 4);
  builder.fix(builder.dof(0, Dof::x), {.constant = 0.01, .proportional = 0.05});
  builder.fix(builder.dof(0, Dof::z), {.proportional = 0.1});
  builder.fix(builder.shared_rotation(0).value(), {.constant = 0.03, .proportional = -0.2});
  for (const ThicknessDofs& end : builder.thickness(0)) {
    builder.fix(end.e, {.constant = 0.01, .proportional = 0.02});
    builder.fix(end.xi, {.proportional = -0.03});
  }
  builder.fix(builder.dof(1, Dof::z), {.constant = 0.02, .proportional = -0.1});
  builder.add_ground_stiffness(builder.dof(1, Dof::x), 0.7);
  builder.add_ground_stiffness(builder.dof(1, Dof::z), 0.3);  // at a support that moves
  builder.add_ground_stiffness(builder.shared_rotation(1).value(), 0.2);
  builder.add_ground_stiffness(builder.dof(builder.mesh(0).nodes[2], Dof::z), 1.1);
  builder.add_spring(builder.dof(0, Dof::z), builder.dof(builder.mesh(0).nodes[3], Dof::z), 0.6);
  builder.add_spring(builder.dof(1, Dof::z), builder.dof(0, Dof::z), 0.5);
  builder.add_spring(builder.mesh(0).rotations[1].value(), builder.mesh(0).rotations[3].value(), 0.04);
  builder.add_foundation(0, {0.2, 0.3});
  builder.add_load(builder.dof(1, Dof::x), 0.02, LoadKind::proportional);
  builder.add_load(builder.dof(1, Dof::z), -0.03, LoadKind::proportional);
  builder.add_load(builder.dof(builder.mesh(0).nodes[1], Dof::z), 0.01, LoadKind::constant);
  return builder;
}

}  // namespace

TEST(NodalTerms, AreZeroWhereNothingWasSaid) {
  NodalTerms terms;
  terms.add_load(7, {.constant = 1.0, .proportional = 2.0});
  terms.add_load(3, {.proportional = -5.0});
  terms.add_load(7, {.proportional = 0.5});
  terms.hold(4, {.proportional = 0.25});
  terms.hold(5, {});
  terms.add_ground_stiffness(4, 8.0);
  terms.add_load(4, {.constant = 3.0});
  EXPECT_EQ(terms.load(7), (Driven{.constant = 1.0, .proportional = 2.5}));
  EXPECT_EQ(terms.load(5), Driven{});
  EXPECT_TRUE(terms.is_held(4) && terms.is_held(5) && !terms.is_held(7));
  EXPECT_TRUE(terms.is_displaced(4) && !terms.is_displaced(5) && !terms.is_displaced(7));
  EXPECT_EQ(terms.ground_stiffness(7), 0.0);
  EXPECT_EQ(terms.support_force(4, 0.0, [](Index) { return 0.0; }), -3.0);
  EXPECT_EQ(terms.support_force(4, 1.0, [](Index) { return 0.0; }), -1.0);
  EXPECT_EQ(terms.greatest_proportional_load([](Index dof) { return dof == 3 ? 10.0 : 1.0; }), 2.5);
  EXPECT_EQ(terms.ramp().load(7), (Driven{.proportional = 1.0}));
  EXPECT_EQ(terms.ramp().support(4), Driven{});
  EXPECT_EQ(terms.ramp().ground_stiffness(4), 8.0);
}

// --- supports that move ---------------------------------------------------------------------------------------------

// Central differences: round-off 1e-12 times ratios of stiffnesses.
TEST(MovedSupport, DerivativesAreConsistentWhateverTheTheory) {
  test::Numbers numbers(81);
  for (const BeamKind& kind : beam_kinds) {
    SCOPED_TRACE(name_of(kind));
    const auto structure = moved_and_sprung(kind).build();
    const State state{.x = 0.1 * numbers.vector(structure->size({})), .lambda = 0.5 + 0.2 * numbers()};
    EXPECT_LE(check_derivatives(*structure, state).worst(), 1e-9);
    std::vector<Index> held{structure->dof(0, Dof::x), structure->dof(0, Dof::z),
                            structure->members()[0].rotations.front().value(), structure->dof(1, Dof::z)};
    for (const Index dof : held) {
      EXPECT_LE(check_gradient(ReactionObservable(*structure, dof), state), 1e-9);
      EXPECT_LE(check_gradient(DofObservable(*structure, dof), state), 1e-9);
    }
  }
}

// The right end of a beam that is clamped at both ends is moved across by δ and may slide along the axis: by the
// slope-deflection equations the forces are 12 EI δ/L³ and the moments 6 EI δ/L², both over 1 + 12 EI/(GA L²) where the
// beam shears (Timoshenko). Rounding and the geometry's nonlinearity are of the order 1e-9.
TEST(MovedSupport, OfAClampedBeamHasTheForcesOfSlopeDeflection) {
  const double EI = 3.0, L = 2.0, delta = 1e-5, GA = 500.0;
  for (const BeamKind& kind : {BeamKind{Theory::euler_bernoulli, 2}, BeamKind{Theory::elastica, 4},
                               BeamKind{Theory::elastica, 6}, BeamKind{Theory::reissner, 2}}) {
    SCOPED_TRACE(name_of(kind));
    StructureBuilder builder = plain_beam(kind, 1000.0, EI, L, 6, GA);
    clamp(builder, 0);
    builder.fix(builder.dof(1, Dof::z), {.proportional = delta});
    builder.fix(builder.shared_rotation(1).value());
    const auto structure = builder.build();
    const State moved = test::solved_at(*structure, rest(*structure), 1.0, 1);
    const double softer = kind.theory == Theory::reissner ? 1.0 + 12.0 * EI / (GA * L * L) : 1.0;
    const double force = 12.0 * EI * delta / (L * L * L * softer), moment = 6.0 * EI * delta / (L * L * softer);
    const auto rotation = [&](std::size_t at) { return structure->members()[0].rotations[at].value(); };
    EXPECT_NEAR(structure->reaction(moved, structure->dof(1, Dof::z)), force, 1e-7 * force);
    EXPECT_NEAR(structure->reaction(moved, structure->dof(0, Dof::z)), -force, 1e-7 * force);
    EXPECT_NEAR(structure->reaction(moved, rotation(0)), -moment, 1e-7 * moment);
    EXPECT_NEAR(structure->reaction(moved, rotation(6)), -moment, 1e-7 * moment);
    EXPECT_EQ(structure->value(moved, structure->dof(1, Dof::z)), delta);
    EXPECT_EQ(structure->current(moved, 1).y(), delta);
  }
}

// It is turned by a unit instead: slope deflection gives the moments 4EI/L there and 2EI/L at the other end, and the
// forces 6EI/L².
TEST(MovedSupport, TurnsTheEndOfAClampedBeam) {
  const double EI = 3.0, L = 2.0, angle = 1e-5;
  StructureBuilder builder = plain_beam({Theory::euler_bernoulli, 2}, 1000.0, EI, L, 5);
  clamp(builder, 0);
  builder.fix(builder.dof(1, Dof::z));
  builder.fix(builder.shared_rotation(1).value(), {.proportional = angle});
  const auto structure = builder.build();
  const State turned = test::solved_at(*structure, rest(*structure), 1.0, 1);
  const auto rotation = [&](std::size_t at) { return structure->members()[0].rotations[at].value(); };
  EXPECT_NEAR(structure->reaction(turned, rotation(5)) / angle, 4.0 * EI / L, 1e-7);
  EXPECT_NEAR(structure->reaction(turned, rotation(0)) / angle, 2.0 * EI / L, 1e-7);
  EXPECT_NEAR(structure->reaction(turned, structure->dof(1, Dof::z)) / angle, -6.0 * EI / (L * L), 1e-7);
}

// Two bars in a row: the force is EA δ / 2, half of δ stands in the middle. Strain is nonlinear by δ.
TEST(MovedSupport, PullsBars) {
  for (const TrussStrain strain : {TrussStrain::green, TrussStrain::log}) {
    StructureBuilder builder;
    const Vec2 at[] = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
    for (const Vec2& position : at) builder.add_joint(position);
    for (int i = 0; i < 2; ++i)
      builder.add_member({.name = "bar",
                          .from = i,
                          .to = i + 1,
                          .axis = straight_axis(at[i], at[i + 1]),
                          .theory = Theory::truss,
                          .strain = strain,
                          .section = {.E = 5.0, .A = 2.0}});
    const double delta = 1e-6;
    for (const Index joint : {0, 1, 2}) builder.fix(builder.dof(joint, Dof::z));
    builder.fix(builder.dof(0, Dof::x));
    builder.fix(builder.dof(2, Dof::x), {.proportional = delta});
    const auto structure = builder.build();
    const State pulled = test::solved_at(*structure, rest(*structure), 1.0, 1);
    EXPECT_NEAR(structure->reaction(pulled, structure->dof(2, Dof::x)) / delta, 10.0 / 2.0, 1e-4);
    EXPECT_NEAR(structure->reaction(pulled, structure->dof(0, Dof::x)) / delta, -10.0 / 2.0, 1e-4);
    EXPECT_NEAR(structure->value(pulled, structure->dof(1, Dof::x)) / delta, 0.5, 1e-5);
    const State loose{.x = 0.1 * test::Numbers(82).vector(structure->size({})), .lambda = 0.7};
    builder.fix(builder.dof(2, Dof::x), {.proportional = 0.3});  // a movement whose F_λ differences resolve
    EXPECT_LE(check_derivatives(*builder.build(), loose).worst(), 1e-9);
  }
}

// A support that moves the free end of a cantilever across exerts what a dead load would have to: without the support
// and under that load the state is the same, and in equilibrium. By statics the clamp carries the opposite force, and
// the moment of the force about it, at the place to which the end has gone.
TEST(MovedSupport, DoesWhatItsReactionDoesAsALoad) {
  for (const BeamKind& kind : beam_kinds) {
    SCOPED_TRACE(name_of(kind));
    const double length = 2.0, across = 0.6;
    StructureBuilder builder = clamped_beam(kind, {length, 0.0}, 6, QuadraticTerm::director);
    StructureBuilder loaded = builder;
    builder.fix(builder.dof(1, Dof::z), {.proportional = across});
    const auto moved = builder.build();
    const State at_place = test::solved_at(*moved, rest(*moved), 1.0, 12);
    const auto reaction = [&](Index dof) { return moved->reaction(at_place, dof); };
    const Index end_x = moved->dof(1, Dof::x), end_z = moved->dof(1, Dof::z);
    const double force = reaction(end_z);
    EXPECT_GE(force, 0.003);  // 3 EI δ/L³ = 0.003, and more where it bends far
    EXPECT_LE(moved->value(at_place, end_x), -0.1);

    loaded.add_load(end_z, force, LoadKind::proportional);
    const auto pushed = loaded.build();
    State under_load{.x = Vector::Zero(pushed->size({})), .lambda = 1.0};
    for (Index e = 0; e < pushed->element_count(); ++e)
      for (std::size_t i = 0; i < pushed->element_dofs(e).size(); ++i) {
        const Index dof = pushed->element_dofs(e)[i];
        if (const auto unknown = pushed->unknown(dof)) under_load.x[*unknown] = moved->value(at_place, dof);
      }
    Vector F(under_load.x.size());
    pushed->residual(under_load, F);
    EXPECT_LE(F.norm(), 1e-11 * force);

    EXPECT_NEAR(reaction(moved->dof(0, Dof::x)), 0.0, 1e-11 * force);
    EXPECT_NEAR(reaction(moved->dof(0, Dof::z)), -force, 1e-11 * force);
    const double arm = length + moved->value(at_place, end_x);
    EXPECT_NEAR(reaction(moved->members()[0].rotations.front().value()), -arm * force, 1e-11 * force);
  }
}

// ∂Π/∂λ at fixed unknowns is the work of the supports' forces, less what loads grow by.
TEST(MovedSupport, DoesTheWorkOfItsReaction) {
  for (const BeamKind& kind : beam_kinds) {
    SCOPED_TRACE(name_of(kind));
    const auto structure = moved_and_sprung(kind).build();
    State state{.x = 0.1 * test::Numbers(83).vector(structure->size({})), .lambda = 0.4};
    std::set<Index> dofs;
    for (Index e = 0; e < structure->element_count(); ++e)
      for (std::size_t i = 0; i < structure->element_dofs(e).size(); ++i) dofs.insert(structure->element_dofs(e)[i]);
    double rate = 0.0;
    for (const Index dof : dofs) {
      const double load_rate = structure->nodal_terms().load(dof).proportional;
      rate += structure->reaction(state, dof) * structure->held_rate(dof);
      rate -= load_rate * structure->value(state, dof);
    }
    const double step = 1e-3;
    const auto energy = [&](double lambda) {
      State moved = state;
      moved.lambda = lambda;
      return structure->energy(moved);
    };
    const double near = energy(0.4 + step) - energy(0.4 - step), far = energy(0.4 + 2 * step) - energy(0.4 - 2 * step);
    EXPECT_NEAR((8.0 * near - far) / (12.0 * step), rate, 1e-9 * std::max(1.0, std::abs(rate)));
  }
}

TEST(MovedSupport, ConstantValuesAreAppliedByTheRamp) {
  const StructureBuilder builder = moved_and_sprung({Theory::euler_bernoulli, 2});
  const auto whole = builder.build(), ramp = builder.build(true);
  const Vector x = 0.1 * test::Numbers(84).vector(whole->size({}));
  Vector F(x.size()), G(x.size());
  whole->residual({.x = x, .lambda = 0.0}, F);
  ramp->residual({.x = x, .lambda = 1.0}, G);
  EXPECT_LE((F - G).norm(), 1e-14 * F.norm());
  ramp->residual({.x = Vector::Zero(x.size()), .lambda = 0.0}, G);
  EXPECT_EQ(G.norm(), 0.0);
}

// --- stiffness to ground --------------------------------------------------------------------------------------------

namespace {

// A cantilever of length 2 whose tip carries P and stands on a spring; a spring holds its clamp's rotation.
struct SprungCantilever {
  static constexpr double EI = 3.0, L = 2.0, tip = 0.9, root = 8.0, P = 1e-6;

  static StructureBuilder builder() {
    StructureBuilder builder = plain_beam({Theory::euler_bernoulli, 2}, 1000.0, EI, L, 6);
    builder.fix(builder.dof(0, Dof::x));
    builder.fix(builder.dof(0, Dof::z));
    builder.add_ground_stiffness(builder.shared_rotation(0).value(), root);
    builder.add_ground_stiffness(builder.dof(1, Dof::z), 0.5 * tip);
    builder.add_ground_stiffness(builder.dof(1, Dof::z), 0.5 * tip);  // they add
    builder.add_load(builder.dof(1, Dof::z), P, LoadKind::proportional);
    return builder;
  }
  static double deflection() { return P / (tip + 1.0 / (L * L * L / (3.0 * EI) + L * L / root)); }
};

}  // namespace

TEST(GroundStiffness, SharesTheLoadOfACantilever) {
  const auto structure = SprungCantilever::builder().build();
  const State loaded = test::solved_at(*structure, rest(*structure), 1.0, 1);
  const double w = SprungCantilever::deflection();
  EXPECT_NEAR(structure->value(loaded, structure->dof(1, Dof::z)), w, 1e-8 * w);
  const double carried = SprungCantilever::P - SprungCantilever::tip * w;
  EXPECT_NEAR(structure->reaction(loaded, structure->dof(0, Dof::z)), -carried, 1e-8 * SprungCantilever::P);
  EXPECT_EQ(structure->reaction(loaded, structure->dof(1, Dof::z)), 0.0) << "a spring is no support";
}

TEST(GroundStiffness, SharesTheLoadWhereTheMeshSlides) {
  const test::SlidingModel model(SprungCantilever::builder(), {}, 0.1);
  const State loaded = test::solved_at(model.system(), model.system().rest(), 1.0, 1);
  const double w = SprungCantilever::deflection();
  EXPECT_NEAR(model.joint(1, Dof::z)->value(loaded), w, 1e-8 * w);
}

TEST(GroundStiffness, IsListedBesideK) {
  const auto structure = SprungCantilever::builder().build();
  Linearization now;
  for (int time = 0; time < 2; ++time) {  // the list is cleared
    structure->linearize(rest(*structure), now);
    double at_tip = 0.0, at_root = 0.0;
    for (const GroundTerm& term : now.ground) {
      EXPECT_EQ(term.row, term.column);
      (structure->meaning(term.row).dof == Dof::z ? at_tip : at_root) += term.stiffness;
    }
    EXPECT_EQ(at_tip, SprungCantilever::tip);
    EXPECT_EQ(at_root, SprungCantilever::root);
  }
  const Index tip = structure->unknown(structure->dof(1, Dof::x)).value();
  EXPECT_TRUE(now.translation_free[static_cast<std::size_t>(tip)]);
}

// A beam on two supports with a spring k in the middle goes down by 1/(48 + k) there under a force of 1; on springs
// alone by 1/48 + 1/(2k). K's diagonal, 10¹⁵ times as great, has lost the spring.
TEST(GroundStiffness, KeepsItsDigitsOnALongChain) {
  const int elements = 40000;
  for (const bool on_springs : {false, true}) {
    StructureBuilder builder = plain_beam({Theory::euler_bernoulli, 2}, 12.0, 1.0, 1.0, elements);
    const Index middle = builder.dof(builder.mesh(0).nodes[elements / 2], Dof::z);
    const double k = 20.0;
    if (on_springs) {
      for (const Index joint : {0, 1}) builder.add_ground_stiffness(builder.dof(joint, Dof::z), k);
      builder.add_ground_stiffness(builder.dof(0, Dof::x), k);
    } else {
      for (const Index joint : {0, 1}) builder.fix(builder.dof(joint, Dof::z));
      builder.fix(builder.dof(0, Dof::x));
      builder.add_ground_stiffness(middle, k);
    }
    builder.add_load(middle, 1.0, LoadKind::proportional);
    const auto structure = builder.build();
    Linearization now;
    structure->linearize(rest(*structure), now);
    BorderedSolver solver;
    ASSERT_EQ(solver.factorize(now, 0), FactorStatus::ok);
    Matrix w = -now.F_lambda;
    ASSERT_TRUE(solver.solve_inner(w));
    const double expected = on_springs ? 1.0 / 48.0 + 0.5 / k : 1.0 / (48.0 + k);
    EXPECT_NEAR(w(structure->unknown(middle).value(), 0) / expected, 1.0, 1e-6);
  }
}

// --- springs between degrees of freedom
// -----------------------------------------------------------------------------------------

namespace {

// Two cantilevers of length 2 and EI = 3 one above the other. A spring k joins their tips, of which the upper one
// carries P; nothing else holds the lower one's.
struct JoinedCantilevers {
  static constexpr double EI = 3.0, L = 2.0, k = 0.9, P = 1e-6;

  static StructureBuilder builder() {
    StructureBuilder builder;
    for (const double z : {0.0, 1.0})
      for (const double x : {0.0, L}) builder.add_joint({x, z});
    for (const Index from : {0, 2}) {
      const double z = from == 0 ? 0.0 : 1.0;
      builder.add_member({.name = from == 0 ? "lower" : "upper",
                          .from = from,
                          .to = from + 1,
                          .axis = straight_axis({0.0, z}, {L, z}),
                          .section = test::section_of(1000.0, EI),
                          .elements = 4});
      clamp(builder, from);
    }
    builder.add_spring(builder.dof(1, Dof::z), builder.dof(3, Dof::z), k);
    builder.add_load(builder.dof(3, Dof::z), P, LoadKind::proportional);
    return builder;
  }
};

}  // namespace

// By c = 3EI/L³ of each cantilever: the spring and the lower one behind it resist as c k/(c + k).
TEST(SpringBetween, SharesTheLoadOfTwoCantilevers) {
  using Two = JoinedCantilevers;
  const double c = 3.0 * Two::EI / (Two::L * Two::L * Two::L), behind = c * Two::k / (c + Two::k);
  const double upper = Two::P / (c + behind), lower = upper * behind / c;
  const auto structure = Two::builder().build();
  const State loaded = test::solved_at(*structure, rest(*structure), 1.0, 1);
  EXPECT_NEAR(structure->value(loaded, structure->dof(3, Dof::z)), upper, 1e-8 * upper);
  EXPECT_NEAR(structure->value(loaded, structure->dof(1, Dof::z)), lower, 1e-8 * upper);
  EXPECT_NEAR(structure->reaction(loaded, structure->dof(0, Dof::z)), -c * lower, 1e-8 * Two::P);
  const test::SlidingModel model(Two::builder(), {}, 0.1);
  const State slid = test::solved_at(model.system(), model.system().rest(), 1.0, 1);
  EXPECT_NEAR(model.joint(1, Dof::z)->value(slid), lower, 1e-8 * upper);
}

// A pointwise hinge with a spring: a beam whose halves are joined at a hinge by a spring for their rotations has the
// deflection P L³/(48 EI) + P L²/(16 k) in its middle, where P acts.
TEST(SpringBetween, StiffensAHinge) {
  const double EI = 3.0, L = 2.0, k = 1.7, P = 1e-6;
  StructureBuilder builder;
  const Vec2 at[] = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  for (const Vec2& position : at) builder.add_joint(position);
  for (int i = 0; i < 2; ++i)
    builder.add_member({.name = "half",
                        .from = i,
                        .to = i + 1,
                        .axis = straight_axis(at[i], at[i + 1]),
                        .section = test::section_of(1000.0, EI),
                        .elements = 3,
                        .hinge_from = i == 1});
  builder.fix(builder.dof(0, Dof::x));
  for (const Index end : {0, 2}) builder.fix(builder.dof(end, Dof::z));
  EXPECT_TRUE(find_mechanism(*builder.build()).has_value());
  builder.add_spring(builder.mesh(0).rotations.back().value(), builder.mesh(1).rotations.front().value(), k);
  EXPECT_FALSE(find_mechanism(*builder.build()).has_value());
  builder.add_load(builder.dof(1, Dof::z), P, LoadKind::proportional);
  const auto structure = builder.build();
  const State loaded = test::solved_at(*structure, rest(*structure), 1.0, 1);
  const double w = P * (L * L * L / (48.0 * EI) + L * L / (16.0 * k));
  EXPECT_NEAR(structure->value(loaded, structure->dof(1, Dof::z)), w, 1e-8 * w);
}

// --- the sliding mesh has the same terms ----------------------------------------------------------------------------

// A column with a spring and a support inside, and a girder; feet and inner support move. Both meshes give one
// equilibrium, far from rest.
TEST(NodalTerms, AreThoseOfTheFixedMeshWhereItSlides) {
  for (const BeamKind& kind : {BeamKind{Theory::euler_bernoulli, 2}, BeamKind{Theory::elastica, 4}}) {
    SCOPED_TRACE(name_of(kind));
    StructureBuilder builder;
    const Vec2 at[] = {{0.0, 0.0}, {0.2, 3.0}, {4.0, 3.0}};
    for (const Vec2& position : at) builder.add_joint(position);
    for (int i = 0; i < 2; ++i)
      builder.add_member({.name = i == 0 ? "column" : "girder",
                          .from = i,
                          .to = i + 1,
                          .axis = straight_axis(at[i], at[i + 1]),
                          .theory = kind.theory,
                          .order = 4,
                          .section = test::section_of(100.0, 2.0),
                          .elements = 8});
    const auto inside = [&](Index member, std::size_t node, Dof which) {
      return builder.dof(builder.mesh(member).nodes[node], which);
    };
    builder.fix(builder.dof(0, Dof::x), {.proportional = 0.2});
    builder.fix(builder.dof(0, Dof::z), {.constant = 0.1});
    builder.fix(builder.shared_rotation(0).value(), {.proportional = -0.3});
    builder.fix(builder.dof(2, Dof::z), {.constant = 0.05, .proportional = -0.4});
    builder.fix(inside(1, 3, Dof::z), {.proportional = 0.15});
    builder.add_ground_stiffness(inside(0, 4, Dof::x), 0.8);
    builder.add_ground_stiffness(builder.dof(2, Dof::x), 0.4);
    builder.add_ground_stiffness(builder.dof(2, Dof::z), 0.4);
    builder.add_spring(builder.dof(0, Dof::z), builder.dof(2, Dof::x), 0.2);
    builder.add_spring(inside(0, 6, Dof::x), inside(1, 2, Dof::x), 0.3);
    builder.add_foundation(1, {0.1, 0.2});
    builder.add_load(builder.dof(1, Dof::x), 0.3, LoadKind::proportional);
    builder.add_load(builder.dof(2, Dof::z), 0.1, LoadKind::constant);
    builder.add_distributed_load(1, {0.0, -0.1}, LoadKind::proportional);
    const auto fixed = builder.build();
    const test::SlidingModel model(builder, {}, 0.1);
    const SlidingContact& sliding = model.system();
    const State tied = test::solved_at(*fixed, rest(*fixed), 1.0, 5);
    const State slid = test::solved_at(sliding, sliding.rest(), 1.0, 5);
    for (const Index dof :
         {fixed->dof(1, Dof::x), fixed->dof(1, Dof::z), fixed->dof(2, Dof::x), fixed->dof(2, Dof::z)}) {
      const JointObservable motion(model.structure(), dof, JointObservable::What::motion);
      EXPECT_NEAR(motion.value(slid), fixed->value(tied, dof), 1e-9);
      EXPECT_LE(check_gradient(motion, slid), 1e-8);
    }
    for (const Index dof :
         {fixed->dof(0, Dof::x), fixed->dof(0, Dof::z), fixed->dof(2, Dof::z), inside(1, 3, Dof::z)}) {
      const JointObservable reaction(model.structure(), dof, JointObservable::What::reaction);
      EXPECT_NEAR(reaction.value(slid), fixed->reaction(tied, dof), 1e-8);
      EXPECT_GE(std::abs(reaction.value(slid)), 1e-3);
      EXPECT_LE(check_gradient(reaction, slid), 1e-7);
    }
    EXPECT_NEAR(sliding.energy(slid), fixed->energy(tied), 1e-9);
    for (const double fraction : {0.0, 0.07, 0.5, 1.0})
      for (const auto component : {MemberObservable::Component::x, MemberObservable::Component::rotation})
        EXPECT_LE(check_gradient(*model.at("column", fraction, component), slid), 1e-8) << fraction;
    State off = slid;
    off.x += 0.02 * test::Numbers(85).vector(off.x.size());
    off.lambda = 0.8;
    const DerivativeReport report = check_derivatives(sliding, off, 1e-5);
    EXPECT_LE(report.K, 1e-9);
    EXPECT_LE(report.F_lambda, 1e-9);
    EXPECT_EQ(report.consistency, 0.0);
    EXPECT_LE(report.energy, 1e-8);
  }
}

// --- elements that λ drives -----------------------------------------------------------------------------------------

namespace {

// A spring between two degrees of freedom that λ shortens, and that hardens with λ: V = ½ k (d − λ c)² + ¼ λ q d⁴, d =
// u₁ − u₀.
class Actuator final : public DrivenElement {
 public:
  Actuator(double k, double c, double q) : k_(k), c_(c), q_(q) {}

  int unknown_count() const override { return 2; }
  double evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const override {
    const double d = u[1] - u[0], stretch = d - lambda * c_, d3 = d * d * d;
    const auto spread = [](double force, double* to) {
      to[0] = -force;
      to[1] = force;
    };
    if (f != nullptr) spread(k_ * stretch + lambda * q_ * d3, f);
    if (f_lambda != nullptr) spread(-k_ * c_ + q_ * d3, f_lambda);
    if (K != nullptr) {
      K[0] = K[3] = k_ + 3.0 * lambda * q_ * d * d;
      K[1] = -K[0];
    }
    return 0.5 * k_ * stretch * stretch + 0.25 * lambda * q_ * d * d3;
  }

 private:
  double k_, c_, q_;
};

// The tip of a cantilever and a support above it.
StructureBuilder pulled_cantilever(double q, double EI, double L) {
  StructureBuilder builder = plain_beam({Theory::euler_bernoulli, 2}, 1000.0, EI, L, 5);
  clamp(builder, 0);
  builder.add_element(std::make_shared<Actuator>(2.0, 1e-5, q), {builder.dof(0, Dof::z), builder.dof(1, Dof::z)});
  return builder;
}

}  // namespace

TEST(DrivenElement, HasItsPartOfEveryDerivative) {
  StructureBuilder builder = pulled_cantilever(3.0, 3.0, 2.0);
  builder.fix(builder.dof(0, Dof::z), {.constant = 0.1, .proportional = 0.2});
  const auto structure = builder.build();
  test::Numbers numbers(86);
  for (int i = 0; i < 3; ++i) {
    const State state{.x = 0.2 * numbers.vector(structure->size({})), .lambda = numbers()};
    EXPECT_LE(check_derivatives(*structure, state).worst(), 1e-9);
    const ReactionObservable reaction(*structure, structure->dof(0, Dof::z));
    EXPECT_LE(check_gradient(reaction, state), 1e-9);
  }
}

// The tip of a cantilever, of stiffness 3EI/L³, is pulled by a spring whose other end is on the support: where λ
// shortens the spring by λ c, 3EI/L³ w = k (λ c − w).
TEST(DrivenElement, PullsTheTipOfACantilever) {
  const double EI = 3.0, L = 2.0, beam = 3.0 * EI / (L * L * L);
  const auto structure = pulled_cantilever(0.0, EI, L).build();
  const State pulled = test::solved_at(*structure, rest(*structure), 0.7, 1);
  const double w = 2.0 * 0.7e-5 / (beam + 2.0);
  EXPECT_NEAR(structure->value(pulled, structure->dof(1, Dof::z)), w, 1e-8 * w);
  EXPECT_NEAR(structure->reaction(pulled, structure->dof(0, Dof::z)), 0.0, 1e-8 * w) << "it is inside";
}

TEST(DrivenElement, IsNotForMeshesThatSlide) {
  EXPECT_FALSE(pulled_cantilever(0.0, 1.0, 1.0).can_slide());
  EXPECT_TRUE(SprungCantilever::builder().can_slide());
}

}  // namespace arcwall::nodal_terms_test
