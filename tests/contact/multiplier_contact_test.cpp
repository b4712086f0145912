#include "contact/multiplier_contact.hpp"

#include <gtest/gtest.h>

#include "core/algebra/bordered_solver.hpp"
#include "core/derivative_check.hpp"
#include "tests/contact/contact_models.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::multiplier_contact_test {

namespace {

using test::ContactModel;
using test::Numbers;

ActiveSet closed_every(Index count, Index stride) {
  ActiveSet active_set(static_cast<std::size_t>(count), 0);
  if (stride > 0)
    for (Index j = 1; j < count; j += stride) active_set[static_cast<std::size_t>(j)] = 1;
  return active_set;
}

State random_state(const MultiplierContact& system, const ActiveSet& active_set, Numbers& numbers) {
  return {.x = 0.2 * numbers.vector(system.size(active_set)), .lambda = numbers(), .active_set = active_set};
}

// The beam of contact_models.hpp, classic, whose clamp moves with λ.
std::unique_ptr<Structure> moved_beam() {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(2.0, 0.1);
  builder.add_joint(a);
  builder.add_joint(b);
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = arc_axis(a, {1.0, 0.2}, b),
                      .section = {.E = 100.0, .A = 1.0, .I = 0.1, .height = 0.2},
                      .elements = 4});
  builder.fix(builder.dof(0, Dof::x), {.constant = 0.02, .proportional = 0.2});
  builder.fix(builder.dof(0, Dof::z), {.proportional = -0.1});
  builder.fix(builder.shared_rotation(0).value(), {.constant = 0.1, .proportional = 0.3});
  builder.fix(builder.dof(1, Dof::x), {.proportional = -0.1});  // free in z and to turn
  builder.add_load(builder.dof(1, Dof::z), 1.0, LoadKind::proportional);
  return builder.build();
}

}  // namespace

// Central differences: round-off 1e-12 times ratios of stiffnesses up to 1000.
TEST(MultiplierContact, DerivativesAreConsistentWhicheverContactsAreClosed) {
  Numbers numbers(60);
  for (const bool on_axis : {false, true}) {
    const ContactModel model(test::contact_beam(), test::all_walls(on_axis), 0.1);
    for (const Index stride : {0, 1, 2, 3, 7}) {
      SCOPED_TRACE(stride);
      const ActiveSet active_set = closed_every(model.system().contact_count(), stride);
      EXPECT_LE(check_derivatives(model.system(), random_state(model.system(), active_set, numbers)).worst(), 1e-9);
    }
  }
}

// Likewise with springs as stiff as the beam and a hundred times stiffer.
TEST(MultiplierContact, DerivativesAreConsistentWithEveryLaw) {
  Numbers numbers(67);
  for (const auto method : {ContactLaw::Method::penalty, ContactLaw::Method::augmented})
    for (const double stiffness : {10.0, 1e3}) {
      const ContactModel model(test::contact_beam(), test::all_walls(false), 0.1,
                               {.method = method, .stiffness = stiffness});
      for (const Index stride : {1, 3}) {
        const ActiveSet active_set = closed_every(model.system().contact_count(), stride);
        EXPECT_LE(check_derivatives(model.system(), random_state(model.system(), active_set, numbers)).worst(), 1e-9);
      }
    }
}

// Springs softer than the beam leave a node its translations, which curved walls resist besides: what is factorized is
// K all the same.
TEST(MultiplierContact, IsSolvedForWithEveryLawAndStiffness) {
  Numbers numbers(70);
  for (const auto method : {ContactLaw::Method::rigid, ContactLaw::Method::penalty, ContactLaw::Method::augmented})
    for (const double stiffness : {1.0, 10.0, 1e3, 1e6})
      for (const bool on_axis : {false, true})
        for (test::TestWall& wall : test::all_walls(on_axis)) {
          SCOPED_TRACE(stiffness);
          const ContactModel model(
              test::contact_beam({.section = {.E = 100.0, .A = 1.0, .I = 0.1, .height = 0.2}, .elements = 16}), {wall},
              0.1, {.method = method, .stiffness = stiffness});
          const MultiplierContact& system = model.system();
          const State state = random_state(system, closed_every(system.contact_count(), 3), numbers);
          Linearization now;
          system.linearize(state, now);
          BorderedSolver solver;
          ASSERT_EQ(solver.factorize(now, system.multiplier_count(state.active_set)), FactorStatus::ok);
          const Matrix right = numbers.matrix(state.x.size(), 2);
          Matrix X = right;
          ASSERT_TRUE(solver.solve_inner(X));
          const Matrix terms = test::full(now.K).cwiseAbs() * X.cwiseAbs();
          EXPECT_LE((product(now, X) - right).norm(), 1e-12 * terms.norm());
        }
}

// What is told of a contact is what acts in the equations: on the axis of a beam, whose nodes have displacements in x
// and z, the equations of a node miss the force vector that is told where its force is left out.
TEST(MultiplierContact, TellsTheForcesThatActInTheEquations) {
  Numbers numbers(69);
  const auto walls = test::all_walls(true);
  const ContactModel model(test::contact_beam(), {walls[1], walls[6]}, 0.1);  // inclined
  const MultiplierContact& system = model.system();
  const State state = random_state(system, closed_every(system.contact_count(), 2), numbers);
  Vector with(state.x.size()), without(state.x.size());
  system.residual(state, with);
  const auto closed = system.closed_contacts(state);
  ASSERT_EQ(static_cast<Index>(closed.size()), state.active_set.closed_count());
  std::size_t k = 0;
  for (Index j = 0; j < system.contact_count(); ++j) {
    const ContactPoint contact = system.contact(state, j);
    const TrackedPoint& point = system.candidate(j).point();
    EXPECT_EQ(contact.label.wall, "wall");
    EXPECT_EQ(contact.place, point.position(state));
    EXPECT_EQ(contact.force, system.force(state, j));
    const auto multiplier = system.multiplier_index(state.active_set, j);
    if (!multiplier) {
      EXPECT_EQ(contact.force_vector, Vec2(0.0, 0.0));
      continue;
    }
    EXPECT_EQ(closed[k++].force_vector, contact.force_vector);
    EXPECT_EQ(*contact.pressure(), contact.force / contact.label.tributary);
    State less = state;
    less.x[*multiplier] = 0.0;
    system.residual(less, without);
    ASSERT_EQ(point.unknowns().size(), 2U);
    EXPECT_NEAR(without[point.unknowns()[0]] - with[point.unknowns()[0]], contact.force_vector.x(), 1e-12);
    EXPECT_NEAR(without[point.unknowns()[1]] - with[point.unknowns()[1]], contact.force_vector.y(), 1e-12);
  }
}

// λ moves the points of both ends, and with them gaps, their gradients and their forces.
TEST(MultiplierContact, DerivativesAreConsistentWhereSupportsMove) {
  Numbers numbers(68);
  for (const auto method : {ContactLaw::Method::rigid, ContactLaw::Method::penalty, ContactLaw::Method::augmented}) {
    const ContactModel model(moved_beam(), test::all_walls(false), 0.1, {.method = method, .stiffness = 10.0});
    const MultiplierContact& system = model.system();
    for (const Index stride : {0, 1, 3}) {
      ActiveSet active_set = closed_every(system.contact_count(), stride);
      if (stride > 0) active_set[0] = 1;
      const State state = random_state(system, active_set, numbers);
      EXPECT_LE(check_derivatives(system, state).worst(), 1e-9);
      const Direction direction{.dx = numbers.vector(state.x.size()), .dlambda = numbers()};
      const Vector rates = system.guards_along(state, direction).rates;
      for (Index j = 0; j < rates.size(); ++j)
        EXPECT_NEAR(rates[j], apply(system.guard_gradient(state, j), direction), 1e-14 * (1.0 + std::abs(rates[j])));
    }
  }
}

// A beam on two supports, under a force of 1 at a quarter of its length, touches a wall at its middle: 11/16 of the
// force go there, and the place of the force goes down by 23/12288. A wall that gives way by 1/k per force takes
// (11/768)/(1/48 + 1/k). K's diagonal is 10¹⁵ times as stiff as the beam.
TEST(MultiplierContact, KeepsItsDigitsOnALongChain) {
  const int elements = 40000;
  StructureBuilder builder;
  builder.add_joint({0.0, 0.0});
  builder.add_joint({1.0, 0.0});
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis({0.0, 0.0}, {1.0, 0.0}),
                      .section = test::section_of(12.0, 1.0),
                      .elements = elements});
  for (const Index joint : {0, 1}) builder.fix(builder.dof(joint, Dof::z));
  builder.fix(builder.dof(0, Dof::x));
  const Index loaded = builder.dof(builder.mesh(0).nodes[elements / 4], Dof::z);
  builder.add_load(loaded, -1.0, LoadKind::proportional);
  const auto structure = builder.build();
  const double stiffness = 30.0;
  for (const auto method : {ContactLaw::Method::rigid, ContactLaw::Method::penalty}) {
    std::vector<Candidate> middle;
    middle.emplace_back(std::make_unique<MemberPoint>(*structure, structure->members()[0], elements / 2, 0.0),
                        obstacle(flat_profile(0.0), Side::below), ContactLabel{.tributary = 1.0});
    const MultiplierContact contact(*structure, std::move(middle), {}, {.method = method, .stiffness = stiffness});
    const ActiveSet closed(1, 1);
    const State rest{.x = Vector::Zero(contact.size(closed)), .active_set = closed};
    Linearization now;
    contact.linearize(rest, now);
    BorderedSolver solver;
    ASSERT_EQ(solver.factorize(now, 1), FactorStatus::ok);
    Matrix response = -now.F_lambda;
    ASSERT_TRUE(solver.solve_inner(response));
    const double influence = 11.0 / 768.0, softness = method == ContactLaw::Method::rigid ? 0.0 : 1.0 / stiffness;
    const double force = influence / (1.0 / 48.0 + softness);
    EXPECT_NEAR(response(response.rows() - 1, 0) / force, 1.0, 1e-6);
    const double down = -9.0 / 768.0 + force * influence;
    EXPECT_NEAR(response(structure->unknown(loaded).value(), 0) / down, 1.0, 1e-6);
  }
}

TEST(MultiplierContact, APenaltySpringHasItsTributaryLength) {
  const ContactModel model(test::contact_beam(),
                           {{.name = "floor", .side = Side::below, .profile = flat_profile(-1.0)}}, 0.1,
                           {.method = ContactLaw::Method::penalty, .stiffness = 50.0});
  const MultiplierContact& system = model.system();
  Numbers numbers(68);
  const ActiveSet active_set = closed_every(system.contact_count(), 1);
  State state = random_state(system, active_set, numbers);
  Vector F(state.x.size());
  for (Index j = 1; j < system.contact_count(); ++j) {
    // Elements of the arc are of length L/4; the last node has half of one.
    const double length = system.candidate(j).label().tributary;
    EXPECT_NEAR(length, (j + 1 < system.contact_count() ? 2.0 : 1.0) * system.candidate(1).label().tributary / 2.0,
                1e-12);
    const Index k = *system.multiplier_index(active_set, j);
    state.x[k] = -50.0 * length * system.candidate(j).gap(state);
    system.residual(state, F);
    EXPECT_NEAR(F[k], 0.0, 1e-13);
    EXPECT_DOUBLE_EQ(system.enforcement(system.open_active_set(), j).compliance,
                     system.scales().force / system.scales().length / (50.0 * length));
  }
}

// The energy's derivative is the residual where forces are those of the springs.
TEST(MultiplierContact, TheEnergyOfPenaltySpringsIsTheirWork) {
  const ContactModel model(test::contact_beam(), test::all_walls(false), 0.1,
                           {.method = ContactLaw::Method::penalty, .stiffness = 50.0});
  const MultiplierContact& system = model.system();
  const Index n = system.size({});
  Numbers numbers(69);
  const ActiveSet active_set = closed_every(system.contact_count(), 2);
  const State at = random_state(system, active_set, numbers);
  const auto pressed = [&](double s) {
    State state = at;
    state.x[2] += s;
    for (Index j = 0; j < system.contact_count(); ++j)
      if (const auto k = system.multiplier_index(active_set, j))
        state.x[*k] = -50.0 * system.candidate(j).label().tributary * system.candidate(j).gap(state);
    return state;
  };
  Vector F(at.x.size());
  system.residual(pressed(0.0), F);
  constexpr double s = 1e-5;
  EXPECT_NEAR((system.energy(pressed(s)) - system.energy(pressed(-s))) / (2.0 * s), F[2], 1e-7 * F.head(n).norm());
}

TEST(MultiplierContact, OneLinearizationServesChangingActiveSets) {
  Numbers numbers(61);
  const ContactModel model(test::contact_beam(), test::all_walls(false), 0.1);
  Linearization reused;
  for (const Index stride : {0, 3, 3, 2, 0, 7}) {
    const State state = random_state(model.system(), closed_every(model.system().contact_count(), stride), numbers);
    model.system().linearize(state, reused);
    Linearization fresh;
    model.system().linearize(state, fresh);
    EXPECT_EQ(reused.F, fresh.F);
    EXPECT_EQ(reused.F_lambda, fresh.F_lambda);
    EXPECT_EQ(Matrix(reused.K), Matrix(fresh.K));
  }
}

TEST(MultiplierContact, AClosedContactPushesAgainstItsGapsGradient) {
  const ContactModel model(test::contact_beam(),
                           {{.name = "floor", .side = Side::below, .profile = flat_profile(-1.0)}}, 0.1);
  const MultiplierContact& system = model.system();
  Numbers numbers(62);
  ActiveSet active_set(static_cast<std::size_t>(system.contact_count()), 0);
  active_set[2] = 1;
  State state = random_state(system, active_set, numbers);
  const Index k = *system.multiplier_index(active_set, 2);
  EXPECT_EQ(k, system.size(active_set) - 1);
  state.x[k] = 5.0;
  EXPECT_EQ(system.force(state, 2), 5.0);
  EXPECT_EQ(system.force(state, 0), 0.0);
  Vector F(state.x.size()), free(system.size({}) - 0);
  system.residual(state, F);
  model.structure().residual({.x = state.x.head(free.size()), .lambda = state.lambda}, free);
  Gap gap;
  system.candidate(2).gap(state, gap);
  Vector expected = free;
  const auto& unknowns = system.candidate(2).point().unknowns();
  for (std::size_t i = 0; i < unknowns.size(); ++i) expected[unknowns[i]] -= 5.0 * gap.gradient[static_cast<Index>(i)];
  EXPECT_LE((F.head(free.size()) - expected).norm(), 1e-14 * (1.0 + expected.norm()));
  EXPECT_EQ(F[k], -gap.value);
}

TEST(MultiplierContact, GuardsAreGapsAndForcesInTheirScales) {
  const ContactModel model(test::contact_beam(), test::all_walls(false), 0.3);
  const MultiplierContact& system = model.system();
  EXPECT_EQ(system.scales().force, 3.0);
  EXPECT_EQ(system.enforcement(system.open_active_set(), 0).force_scale, 3.0);
  Numbers numbers(63);
  const ActiveSet active_set = closed_every(system.contact_count(), 4);
  const State state = random_state(system, active_set, numbers);
  const Vector guards = system.guards(state);
  for (Index j = 0; j < guards.size(); ++j)
    EXPECT_DOUBLE_EQ(guards[j], active_set[static_cast<std::size_t>(j)]
                                    ? system.force(state, j) / 3.0
                                    : system.candidate(j).gap(state) / system.scales().length);
}

TEST(MultiplierContact, GuardRatesAreGradientsAppliedToADirection) {
  const ContactModel model(test::contact_beam(), test::all_walls(true), 0.1);
  const MultiplierContact& system = model.system();
  Numbers numbers(64);
  const State state = random_state(system, closed_every(system.contact_count(), 3), numbers);
  const Direction direction{.dx = numbers.vector(state.x.size()), .dlambda = numbers()};
  const Vector rates = system.guards_along(state, direction).rates;
  for (Index j = 0; j < rates.size(); ++j)
    EXPECT_NEAR(rates[j], apply(system.guard_gradient(state, j), direction), 1e-14 * (1.0 + std::abs(rates[j])));
}

TEST(MultiplierContact, TransferKeepsThePointAndTheForcesThatStay) {
  const ContactModel model(test::contact_beam(), test::all_walls(false), 0.1);
  const MultiplierContact& system = model.system();
  Numbers numbers(65);
  const ActiveSet from = closed_every(system.contact_count(), 2), to = closed_every(system.contact_count(), 3);
  const State state = random_state(system, from, numbers);
  const State moved = system.with_active_set(state, to);
  EXPECT_EQ(moved.active_set, to);
  EXPECT_EQ(moved.lambda, state.lambda);
  EXPECT_EQ(moved.x.size(), system.size(to));
  const Index n = system.size({});
  EXPECT_EQ(Vector(moved.x.head(n)), Vector(state.x.head(n)));
  for (Index j = 0; j < system.contact_count(); ++j) {
    const bool stays = from[static_cast<std::size_t>(j)] && to[static_cast<std::size_t>(j)];
    EXPECT_EQ(system.force(moved, j), stays ? system.force(state, j) : 0.0);
  }
  EXPECT_EQ(system.with_active_set(state, from).x, state.x);
}

TEST(MultiplierContact, MultipliersHaveNoWeightInTheMetric) {
  const ContactModel model(test::contact_beam(), test::all_walls(false), 0.1);
  const ActiveSet active_set = closed_every(model.system().contact_count(), 5);
  const Vector weights = model.system().weights(active_set);
  const Index m = model.system().multiplier_count(active_set);
  EXPECT_GT(m, 0);
  EXPECT_EQ(weights.tail(m).norm(), 0.0);
  EXPECT_EQ(Vector(weights.head(weights.size() - m)), model.structure().weights({}));
}

TEST(MultiplierContact, AContactIsWeakWhereGapAndForceVanish) {
  // A floor just under the beam's lower face at rest: node 0 is clamped and no candidate.
  const test::TestWall floor{.name = "floor", .side = Side::below, .profile = flat_profile(0.0), .on_axis = true};
  StructureBuilder builder;
  for (const double x : {0.0, 1.0, 2.0}) builder.add_joint({x, 0.0});
  for (Index i = 0; i < 2; ++i)
    builder.add_member({.name = "m",
                        .from = i,
                        .to = i + 1,
                        .axis = straight_axis({double(i), 0.0}, {double(i + 1), 0.0}),
                        .section = {.E = 1.0, .A = 1.0, .I = 1.0}});
  builder.fix(builder.dof(0, Dof::x));
  builder.add_load(builder.dof(1, Dof::z), -1.0, LoadKind::proportional);
  const ContactModel model(builder.build(), {floor}, 0.1);
  const MultiplierContact& system = model.system();
  const ActiveSet open(static_cast<std::size_t>(system.contact_count()), 0);
  State state{.x = Vector::Zero(system.size(open)), .lambda = 0.0, .active_set = open};
  const auto weak = [&](const State& at) { return degenerate_contacts(system.guards(at), at.active_set, 1e-12); };
  EXPECT_EQ(static_cast<Index>(weak(state).size()), system.contact_count());

  // Lifted at one node, pressed at another: neither is weak.
  ActiveSet active_set = open;
  active_set[1] = 1;
  state = system.with_active_set(state, active_set);
  state.x[system.candidate(0).point().unknowns().back()] += 0.1;  // its z
  EXPECT_EQ(weak(state).front(), 1);
  state.x[*system.multiplier_index(active_set, 1)] = 1.0;
  for (const Index j : weak(state)) EXPECT_GT(j, 1);
}

TEST(MultiplierContact, UnitForceIsWhatAUnitOfTheForceGuardDoesToTheResidual) {
  const ContactModel model(test::contact_beam(), test::all_walls(false), 0.3);
  const MultiplierContact& system = model.system();
  Numbers numbers(66);
  const ActiveSet open(static_cast<std::size_t>(system.contact_count()), 0);
  const State state = random_state(system, open, numbers);
  for (const Index j : {Index{0}, Index{5}, system.contact_count() - 1}) {
    ActiveSet active_set = open;
    active_set[static_cast<std::size_t>(j)] = 1;
    State closed = system.with_active_set(state, active_set);
    closed.x[*system.multiplier_index(active_set, j)] = system.enforcement(active_set, j).force_scale;
    Vector F(closed.x.size()), F_open(state.x.size());
    system.residual(closed, F);
    system.residual(state, F_open);
    EXPECT_LE((system.unit_force(state, j) - (F_open - F.head(F_open.size()))).norm(), 1e-13);
  }
}

TEST(MultiplierContact, AClosedContactBeyondItsWallIsAnObstruction) {
  // The wall ends at x = 1.2, between nodes.
  const ContactModel model(
      test::contact_beam(),
      {{.name = "short", .side = Side::above, .profile = spline_profile({-1.0, 0.0, 1.2}, {1, 1, 1})}}, 0.1);
  const MultiplierContact& system = model.system();
  const ActiveSet open(static_cast<std::size_t>(system.contact_count()), 0);
  const State rest{.x = Vector::Zero(system.size(open)), .lambda = 0.0, .active_set = open};
  const auto has_left = [&](const State& state) {
    return system.check({.from = state, .to = state}).fault == StepVerdict::Fault::wall_left;
  };
  EXPECT_FALSE(has_left(rest)) << "open contacts may face nothing";
  // The last node stands beside the wall: its guard is large and does not move.
  const Index last = system.contact_count() - 1;
  EXPECT_FALSE(system.candidate(last).faces_wall(rest));
  EXPECT_GE(system.guards(rest)[last], 0.5);
  EXPECT_EQ(system.guard_gradient(rest, last).dx.norm(), 0.0);
  for (Index j = 0; j < system.contact_count(); ++j) {
    ActiveSet active_set = open;
    active_set[static_cast<std::size_t>(j)] = 1;
    EXPECT_EQ(has_left(system.with_active_set(rest, active_set)), !system.candidate(j).faces_wall(rest));
  }
}

}  // namespace arcwall::multiplier_contact_test
