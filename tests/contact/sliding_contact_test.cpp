#include "contact/sliding_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/sliding/bounds/pulling_jump.hpp"
#include "core/derivative_check.hpp"
#include "tests/contact/contact_models.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/sliding_models.hpp"

namespace arcwall::sliding_contact_test {

namespace {

using test::Numbers;
using test::SlidingChannel;
using test::SlidingModel;
using Point = SlidingContactLayout::Point;
using Span = SlidingContactLayout::Span;

// A mesh of one strand with its points, at their places, and which of them are closed.
struct Layouts {
  std::string name;
  std::vector<MeshSegment> elements;
  std::vector<Point> points;
  std::vector<double> s;
  std::vector<std::uint8_t> closed;
};

Vector of(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

ActiveSet active_set_of(const SlidingModel& model, const Layouts& on) {
  const auto layout = std::make_shared<SlidingContactLayout>(
      model.structure(), model.structure().mesh(ElementsPerSegment{on.elements}), on.points, of(on.s));
  const std::size_t tied = model.system().open_active_set().size();
  ActiveSet active_set(on.points.size() + tied, 0, layout);
  for (std::size_t k = 0; k < on.closed.size(); ++k) active_set[k] = on.closed[k];
  return active_set;
}

// Off its rest by a twentieth of the shortest element, loaded, with forces and moments.
State random_state(const SlidingModel& model, const ActiveSet& active_set, Numbers& numbers) {
  const SlidingContact& system = model.system();
  State state{.x = Vector::Zero(system.size(active_set)), .lambda = 1.0 + numbers(), .active_set = active_set};
  const auto& layout = static_cast<const SlidingContactLayout&>(*active_set.layout());
  const SlidingMesh& mesh = layout.mesh();
  const Index n = mesh.unknowns(), m = mesh.breakpoints();
  Vector s(m);
  for (std::size_t k = 0; k < layout.points().size(); ++k)
    s[static_cast<Index>(k)] = 0.3 + 0.35 * double(k) + 0.05 * numbers();
  double shortest = infinity;
  for (Index node = 1; node < mesh.nodes(0); ++node)
    shortest = std::min(shortest, mesh.coordinate(0, node, s) - mesh.coordinate(0, node - 1, s));
  state.x.head(n) = model.structure().rest(mesh, s) + 0.05 * shortest * numbers.vector(n);
  for (Index j = n; j < n + system.multiplier_count(active_set); ++j) state.x[j] = 1.0 + numbers();
  state.x.tail(m) = s;
  return state;
}

// Two walls, nought above and one below.
const std::vector<Layouts>& layouts() {
  static const std::vector<Layouts> all{
      {"no point", {6}, {}, {}, {}},
      {"an open point", {2, 3}, {{.obstacle = 0}}, {0.3}, {0}},
      {"a closed point", {3, 4}, {{.obstacle = 0}}, {0.3}, {1}},
      {"points on both walls", {3, 3, 2}, {{.obstacle = 0}, {.obstacle = 1}}, {0.3, 0.65}, {1, 1}},
      {"one of two closed", {3, 3, 2}, {{.obstacle = 1}, {.obstacle = 0}}, {0.3, 0.65}, {0, 1}},
      {"two on one wall", {2, 3, 2}, {{.obstacle = 1}, {.obstacle = 1}}, {0.3, 0.65}, {1, 1}},
      {"a short flat part", {3, 1, 3}, {{.obstacle = 0, .behind = Span::flat}, {.obstacle = 0}}, {0.3, 0.65}, {1, 1}},
      {"a long flat part", {3, 8, 3}, {{.obstacle = 0, .behind = Span::flat}, {.obstacle = 0}}, {0.3, 0.65}, {1, 1}},
      {"a pressed part", {2, 4, 2}, {{.obstacle = 1, .behind = Span::pressed}, {.obstacle = 1}}, {0.3, 0.65}, {1, 1}},
      {"a point behind a flat part",
       {2, 1, 3, 2},
       {{.obstacle = 0, .behind = Span::flat}, {.obstacle = 0}, {.obstacle = 1}},
       {0.3, 0.65, 1.0},
       {1, 1, 1}},
      {"a flat tail", {3, 4}, {{.obstacle = 0, .behind = Span::flat}}, {0.3}, {1}},
      {"a pressed tail", {3, 6}, {{.obstacle = 1, .behind = Span::pressed}}, {0.3}, {1}},
      {"a pressed tail before a point", {6, 2}, {{.obstacle = 1, .before = Span::pressed}}, {0.3}, {1}},
      {"a point that slips",
       {3, 4},
       {{.obstacle = 0, .rubbing = {.mode = ContactMode::slips_backward, .s = 0.2}}},
       {0.3},
       {1}},
      {"points that stick and slip",
       {3, 3, 2},
       {{.obstacle = 0, .rubbing = {.mode = ContactMode::sticks, .w = 0.1, .s = 0.2, .stretch = 1.1}},
        {.obstacle = 1, .rubbing = {.mode = ContactMode::slips_forward}}},
       {0.3, 0.65},
       {1, 1}},
      {"more elements than asked for", {8, 24}, {{.obstacle = 0}}, {0.3}, {1}},
  };
  return all;
}

// A beam of height 0.2 from (0, 0) to (2, 0.1), curved and wavy, clamped and loaded at both ends.
StructureBuilder wavy_beam(bool reversed, Theory theory = Theory::euler_bernoulli) {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(2.0, 0.1);
  builder.add_joint(reversed ? b : a);
  builder.add_joint(reversed ? a : b);
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = reversed ? arc_axis(b, {1.0, 0.2}, a) : arc_axis(a, {1.0, 0.2}, b),
                      .imperfection = {{.amplitude = 0.02, .waves = 2}},
                      .theory = theory,
                      .order = 4,
                      .section = {.E = 100.0, .A = 1.0, .I = 0.1, .height = 0.2},
                      .elements = 7});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.shared_rotation(0).value());
  builder.add_load(builder.dof(1, Dof::x), -2.0, LoadKind::proportional);
  builder.add_load(builder.dof(1, Dof::z), 1.0, LoadKind::constant);
  builder.add_load(*builder.shared_rotation(1), 0.3, LoadKind::proportional);
  return builder;
}

std::vector<test::TestWall> two_of(const std::vector<test::TestWall>& walls, std::size_t kind) {
  return {walls[kind], walls[kind + walls.size() / 2]};
}

}  // namespace

namespace {

// A beam along an arc of a circle, warm and bent by λ, so that nothing but its ends distinguishes one place of it.
StructureBuilder round_beam(Theory theory) {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(2.0, 0.1);
  builder.add_joint(a);
  builder.add_joint(b);
  const Index beam = builder.add_member({.name = "beam",
                                         .from = 0,
                                         .to = 1,
                                         .axis = arc_axis(a, {1.0, 0.2}, b),
                                         .theory = theory,
                                         .order = 4,
                                         .section = {.E = 100.0, .A = 1.0, .I = 0.1, .height = 0.2},
                                         .elements = 7});
  builder.add_thermal_strain(
      beam, {.strain = {.constant = 0.01, .proportional = 0.02}, .curvature = {.constant = 0.1, .proportional = 0.2}});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.shared_rotation(0).value());
  builder.add_load(builder.dof(1, Dof::x), -2.0, LoadKind::proportional);
  return builder;
}

MeshSegment straight_segment() {
  MeshSegment segment(1);
  segment.straight = true;
  return segment;
}

}  // namespace

// Also where the zone has no length, or less. Rates by temperature have round-off of 1e-7 in any element.
TEST(SlidingContact, DerivativesAreConsistentInAZoneWithoutElements) {
  Numbers numbers(83);
  const Layouts on{"a zone without elements",
                   {3, straight_segment(), 3},
                   {{.obstacle = 0, .behind = Span::flat}, {.obstacle = 0}},
                   {0.3, 0.65},
                   {1, 1}};
  for (const Theory theory : {Theory::euler_bernoulli, Theory::elastica}) {
    const SlidingModel model(round_beam(theory), two_of(test::all_walls(false), 0), 0.1);
    State state = random_state(model, active_set_of(model, on), numbers);
    ASSERT_EQ(mesh_of(state).axial_forces(), 1);
    const Index last = state.x.size() - 1;
    for (const double length : {0.35, 0.0, -0.01}) {
      state.x[last] = state.x[last - 1] + length;
      const auto report = check_derivatives(model.system(), state, 1e-6);
      EXPECT_LE(report.K, 1e-9) << length;
      EXPECT_LE(report.F_lambda, 1e-6) << length;
      EXPECT_EQ(report.consistency, 0.0) << length;
      EXPECT_LE(report.energy, 1e-7) << length;
      EXPECT_LE(report.guard_gradient, 1e-6) << length;
    }
  }
}

// Central differences of fourth order and step 1e-6: round-off 1e-10 of the greatest entry; a thousand times that in
// guards, which are of order 1 where entries of short elements are of order 1000. Of these a wrong one shows with
// either of two steps, and round-off with the shorter one alone.
TEST(SlidingContact, DerivativesAreConsistentOnEveryLayoutAmongAllWallsSlow) {
  Numbers numbers(70);
  for (const bool on_axis : {false, true}) {
    const auto walls = test::all_walls(on_axis);
    for (std::size_t kind = 0; kind < walls.size() / 2; ++kind)
      for (const bool reversed : {false, true}) {
        auto both = two_of(walls, kind);
        for (test::TestWall& wall : both) wall.friction = 0.3;
        const SlidingModel model(wavy_beam(reversed), both, 0.1);
        for (const Layouts& on : layouts()) {
          SCOPED_TRACE(on.name + ", wall " + std::to_string(kind) + (reversed ? ", reversed" : ""));
          const State state = random_state(model, active_set_of(model, on), numbers);
          const auto report = check_derivatives(model.system(), state, 1e-6);
          EXPECT_LE(report.K, 1e-9);
          EXPECT_LE(report.F_lambda, 1e-8);
          EXPECT_EQ(report.consistency, 0.0);
          EXPECT_LE(report.energy, 1e-7);
          if (report.guard_gradient > 1e-6) {
            EXPECT_LE(check_derivatives(model.system(), state, 3e-6).guard_gradient, 1e-6);
          }
        }
      }
  }
}

// A wall that the beam leaves its clamp along bounds the curvature there.
TEST(SlidingContact, DerivativesAreConsistentAtAClampOnAWall) {
  Numbers numbers(71);
  for (const bool reversed : {false, true}) {
    auto [builder, clamped, free] = test::clamped_member(
        {0.0, 0.0}, {2.0, 0.0}, reversed,
        {.name = "beam", .section = {.E = 100.0, .A = 1.0, .I = 0.1, .height = 0.2}, .elements = 7});
    builder.add_load(builder.dof(free, Dof::z), -1.0, LoadKind::proportional);
    builder.add_distributed_load(0, {0.1, -0.3}, LoadKind::proportional);
    const SlidingModel model(
        builder, {{.name = "wall", .side = Side::below, .profile = circle_profile({0.0, -1.1}, 1.0, Side::below)}},
        0.1);
    const State state = random_state(model, model.system().open_active_set(), numbers);
    const Vector bounds = model.system().guards(state).tail(3);
    EXPECT_TRUE((bounds.array() != 1.0).any());  // as they are where nothing touches
    EXPECT_LE(check_derivatives(model.system(), state, 1e-6).guard_gradient, 1e-6);
  }
}

namespace {

// The same beam with forces at 3/7 of its length, 0.87, and at 5/7 of it, 1.45.
StructureBuilder beam_with_forces(bool reversed, Theory theory) {
  StructureBuilder builder = wavy_beam(reversed, theory);
  const auto add = [&](std::size_t node, double x, double z, LoadKind kind) {
    builder.add_load(builder.dof(builder.mesh(0).nodes[node], Dof::x), x, kind);
    builder.add_load(builder.dof(builder.mesh(0).nodes[node], Dof::z), z, kind);
  };
  add(3, 0.5, -2.0, LoadKind::proportional);
  add(3, 0.0, 0.7, LoadKind::constant);
  add(5, -1.0, 1.5, LoadKind::proportional);
  return builder;
}

// On nodes or inside elements, before and behind points.
const std::vector<Layouts>& layouts_with_forces() {
  static const std::vector<Layouts> all{
      {"on nodes", {{3, 0}, {2, 1}, 2}, {}, {}, {}},
      {"on nodes behind a closed point", {2, {2, 0}, {2, 1}, 2}, {{.obstacle = 0}}, {0.3}, {1}},
      {"one inside", {2, {3, 1}, 2}, {{.obstacle = 0}}, {0.3}, {1}},
      {"the other inside", {2, {3, 0}, 3}, {{.obstacle = 1}}, {0.3}, {0}},
      {"both inside", {2, 4}, {{.obstacle = 0}}, {0.3}, {1}},
      {"inside beside points", {3, 2, 3}, {{.obstacle = 0}, {.obstacle = 1}}, {0.3, 0.65}, {1, 1}},
  };
  return all;
}

}  // namespace

// As above. Second derivatives of the places of forces inside elements are differences themselves.
TEST(SlidingContact, DerivativesAreConsistentWhereForcesActInside) {
  Numbers numbers(81);
  const auto walls = two_of(test::all_walls(false), 2);
  for (const Theory theory : {Theory::euler_bernoulli, Theory::elastica})
    for (const bool reversed : {false, true}) {
      const SlidingModel model(beam_with_forces(reversed, theory), walls, 0.1);
      for (const Layouts& on : layouts_with_forces()) {
        SCOPED_TRACE(on.name + (reversed ? ", reversed" : ""));
        const State state = random_state(model, active_set_of(model, on), numbers);
        const auto report = check_derivatives(model.system(), state, 1e-6);
        EXPECT_LE(report.K, 1e-9);
        EXPECT_LE(report.F_lambda, 1e-8);
        EXPECT_EQ(report.consistency, 0.0);
        EXPECT_LE(report.energy, 1e-7);
        EXPECT_LE(report.guard_gradient, 1e-6);
      }
    }
}

namespace {

// Elements of a part that hands a load on to its wall.
MeshSegment handing_on(int elements, Index load) {
  MeshSegment segment(elements);
  segment.pressed = true;
  segment.handed_on = {load};
  return segment;
}

}  // namespace

// The wall bears what is normal to it, which turns as the part's nodes move along it, and goes from node to node as the
// part's edges do.
TEST(SlidingContact, DerivativesAreConsistentWhereAPartHandsAForceOn) {
  Numbers numbers(82);
  const Layouts on{"handed on",
                   {3, 2, handing_on(6, 0), 3},
                   {{.obstacle = 0}, {.obstacle = 1, .behind = Span::pressed}, {.obstacle = 1}},
                   {0.3, 0.65, 1.0},
                   {1, 1, 1}};
  for (const std::size_t kind : {2u, 3u})  // a parabola, a circle
    for (const Theory theory : {Theory::euler_bernoulli, Theory::elastica}) {
      const SlidingModel model(beam_with_forces(false, theory), two_of(test::all_walls(false), kind), 0.1);
      const auto report =
          check_derivatives(model.system(), random_state(model, active_set_of(model, on), numbers), 1e-6);
      EXPECT_LE(report.K, 1e-9);
      EXPECT_LE(report.F_lambda, 1e-7);
      EXPECT_EQ(report.consistency, 0.0);
      EXPECT_LE(report.guard_gradient, 1e-6);
    }
}

namespace {

// A cantilever of length 1, EI = 1, with a force at a third of its length and one at its tip, on one segment.
class CantileverWithForceInside {
 public:
  CantileverWithForceInside(Theory theory, int order, double EA, const Vec2& inside, const Vec2& tip)
      : model_(described(theory, order, EA, inside, tip),
               {{.name = "floor", .side = Side::below, .profile = flat_profile(-10.0)}}, 0.1) {}

  // At λ = 1 on a mesh of these segments.
  State solved(const std::vector<MeshSegment>& segments) const {
    const SlidingStructure& structure = model_.structure();
    const auto layout = std::make_shared<SlidingContactLayout>(structure, structure.mesh(ElementsPerSegment{segments}),
                                                               std::vector<Point>{}, Vector());
    const State rest{.x = structure.rest(layout->mesh(), Vector()),
                     .lambda = 0.0,
                     .active_set = ActiveSet(model_.system().open_active_set().size(), 0, layout)};
    return test::solved_at(model_.system(), rest, 1.0, 20);
  }

 private:
  static StructureBuilder described(Theory theory, int order, double EA, const Vec2& inside, const Vec2& tip) {
    StructureBuilder builder;
    builder.add_joint({0.0, 0.0});
    builder.add_joint({1.0, 0.0});
    builder.add_member({.name = "beam",
                        .from = 0,
                        .to = 1,
                        .axis = straight_axis({0.0, 0.0}, {1.0, 0.0}),
                        .theory = theory,
                        .order = order,
                        .section = {.E = 1.0, .A = EA, .I = 1.0, .height = 0.01},
                        .elements = 3});
    for (const Dof which : {Dof::x, Dof::z}) {
      const int i = which == Dof::x ? 0 : 1;
      builder.fix(builder.dof(0, which));
      builder.add_load(builder.dof(builder.mesh(0).nodes[1], which), inside[i], LoadKind::proportional);
      builder.add_load(builder.dof(1, which), tip[i], LoadKind::proportional);
    }
    builder.fix(builder.shared_rotation(0).value());
    return builder;
  }

  SlidingModel model_;
};

// The place of a node from the end.
AxisPlace node_of(const State& state, Index from_end = 0) {
  const SlidingMesh& mesh = mesh_of(state);
  return mesh.node(0, mesh.nodes(0) - 1 - from_end, mesh_state_of(state));
}

}  // namespace

// A force inside an element does what it does on a node: nodes are where they are in a beam of small deflections, at
// z = −P S² (3 a − S)/(6 EI) before the force at a and −P a² (3 S − a)/(6 EI) behind it.
TEST(SlidingContact, ForcesInsideElementsBendAsInABeam) {
  constexpr double P = 1e-4, a = 1.0 / 3.0;
  for (const Theory theory : {Theory::euler_bernoulli, Theory::elastica}) {
    const CantileverWithForceInside beam(theory, 4, 1e4, {0.0, -P}, {0.0, 0.0});
    const State state = beam.solved({4});
    for (Index node = 1; node <= 4; ++node) {
      const double S = double(node) / 4.0;
      const double z = S < a ? -P * S * S * (3.0 * a - S) / 6.0 : -P * a * a * (3.0 * S - a) / 6.0;
      EXPECT_NEAR(node_of(state, 4 - node).position.y(), z, 1e-7 * P) << node;
    }
  }
}

// At large deflections the tip converges to that of meshes with a node at the force with order four: the force is at
// one or two thirds of its element on every mesh.
TEST(SlidingContact, ForcesInsideElementsConvergeWithOrderFour) {
  constexpr double EA = 1e5;
  const Vec2 inside(-1.0, -6.0), tip(-1.5, 2.0);
  const CantileverWithForceInside reference(Theory::elastica, 6, EA, inside, tip);
  const State exact = reference.solved({{32, 0}, 64});
  for (const auto& [theory, order] :
       {std::pair(Theory::euler_bernoulli, 4), std::pair(Theory::elastica, 4), std::pair(Theory::elastica, 6)}) {
    const CantileverWithForceInside beam(theory, order, EA, inside, tip);
    std::vector<double> sizes, errors;
    for (const int elements : {8, 16, 32}) {
      const State state = beam.solved({elements});
      sizes.push_back(1.0 / elements);
      errors.push_back((node_of(state).position - node_of(exact).position).norm());
    }
    EXPECT_GE(test::observed_order(sizes, errors), 3.5) << static_cast<int>(theory) << ", " << order;
    EXPECT_LE(errors.back(), 1e-6);
  }
}

namespace {

// λ moves walls and supports by some tenths. Differences of step 1e-3: round-off 1e-10, ten times that with a step of
// 1e-4; truncation is less.
void expect_rates(const SlidingContact& system, const State& state) {
  constexpr double step = 1e-3;
  EXPECT_LE(check_derivatives(system, state, step).F_lambda, 1e-9);
  for (Index j = 0; j < system.guard_count(state.active_set); ++j) {
    const auto guard = [&](double by) {
      State moved = state;
      moved.lambda += by;
      return system.guard(moved, j);
    };
    const double near = guard(step) - guard(-step), far = guard(2.0 * step) - guard(-2.0 * step);
    const double rate = system.guard_gradient(state, j).dlambda;
    EXPECT_NEAR(rate, (8.0 * near - far) / (12.0 * step), 1e-9 * (1.0 + std::abs(rate))) << j;
  }
}

}  // namespace

// Among walls that stand still, while λ heats the beam.
TEST(SlidingContact, KnowsTheRatesOfHeatSlow) {
  Numbers numbers(77);
  for (const Theory theory : {Theory::euler_bernoulli, Theory::elastica}) {
    StructureBuilder builder = wavy_beam(false, theory);
    builder.add_thermal_strain(
        0, {.strain = {.constant = 0.02, .proportional = 0.1}, .curvature = {.constant = 0.1, .proportional = -0.2}});
    const SlidingModel model(builder, two_of(test::all_walls(false), 2), 0.1);
    for (const Layouts& on : layouts()) {
      SCOPED_TRACE(on.name);
      const State state = random_state(model, active_set_of(model, on), numbers);
      const auto report = check_derivatives(model.system(), state, 1e-6);
      EXPECT_LE(report.K, 1e-9);
      EXPECT_LE(report.energy, 1e-7);
      EXPECT_LE(report.guard_gradient, 1e-6);
      expect_rates(model.system(), state);
    }
  }
}

// Springs along the beam go with it where the mesh slides.
TEST(SlidingContact, DerivativesAreConsistentOnAFoundationSlow) {
  Numbers numbers(79);
  for (const Theory theory : {Theory::euler_bernoulli, Theory::elastica}) {
    StructureBuilder builder = wavy_beam(false, theory);
    builder.add_foundation(0, {3.0, 5.0});
    const SlidingModel model(builder, two_of(test::all_walls(false), 2), 0.1);
    for (const Layouts& on : layouts()) {
      SCOPED_TRACE(on.name);
      const State state = random_state(model, active_set_of(model, on), numbers);
      const auto report = check_derivatives(model.system(), state, 1e-6);
      EXPECT_LE(report.K, 1e-9);
      EXPECT_LE(report.F_lambda, 1e-8);
      EXPECT_EQ(report.consistency, 0.0);
      EXPECT_LE(report.energy, 1e-7);
      EXPECT_LE(report.guard_gradient, 1e-6);
    }
  }
}

// Among walls that λ moves and turns.
TEST(SlidingContact, KnowsTheRatesOfWallsThatMoveSlow) {
  Numbers numbers(78);
  for (const Theory theory : {Theory::euler_bernoulli, Theory::elastica})
    for (const bool on_axis : {false, true}) {
      auto walls = test::all_walls(on_axis);
      for (test::TestWall& wall : walls) wall.motion = {.way = {0.1, -0.2}, .turn = 0.1, .about = {1.0, 0.0}};
      for (std::size_t kind = 0; kind < walls.size() / 2; ++kind) {
        const SlidingModel model(wavy_beam(false, theory), two_of(walls, kind), 0.1);
        for (const Layouts& on : layouts()) {
          SCOPED_TRACE(on.name + ", wall " + std::to_string(kind));
          const State state = random_state(model, active_set_of(model, on), numbers);
          EXPECT_LE(check_derivatives(model.system(), state, 1e-6).K, 1e-9);
          expect_rates(model.system(), state);
        }
      }
    }
}

// Walls of two cubics, which would pull on a part across the point between them: how far its edge is from there.
TEST(SlidingContact, DerivativesAreConsistentBesideAPointOfASpline) {
  Numbers numbers(87);
  for (const bool reversed : {false, true}) {
    const double middle = reversed ? 1.4 : 0.5;  // in the part, near its second edge
    std::vector<test::TestWall> walls;
    for (const Side side : {Side::above, Side::below}) {
      const auto z = [&](double height) { return 0.3 - 0.3 * sign_of(side) * height; };
      walls.push_back({.name = "wall",
                       .side = side,
                       .profile = spline_profile({middle - 1.0, middle - 0.4, middle, middle + 0.4, middle + 3.0},
                                                 {z(1.0), z(0.9), z(1.05), z(0.9), z(1.0)}),
                       .motion = {.way = {0.1, -0.2}, .turn = 0.1, .about = {1.0, 0.0}}});
    }
    const SlidingModel model(wavy_beam(reversed), walls, 0.1);
    for (const std::size_t wall : {0U, 1U}) {
      const Layouts on{"a pressed part",
                       {2, 4, 2},
                       {{.obstacle = wall, .behind = Span::pressed}, {.obstacle = wall}},
                       {0.3, 0.65},
                       {1, 1}};
      const State state = random_state(model, active_set_of(model, on), numbers);
      const auto& bounds = sliding_layout(state.active_set).bounds();
      std::size_t near = 0;
      for (std::size_t i = 0; i < bounds.size(); ++i)
        if (dynamic_cast<const sliding::PullingJumpBound*>(bounds[i].get()) != nullptr)
          near += model.system().guard(state, static_cast<Index>(state.active_set.size() + i)) < 0.5 ? 1 : 0;
      EXPECT_GE(near, 1U);
      EXPECT_LE(check_derivatives(model.system(), state, 1e-6).guard_gradient, 1e-6);
      expect_rates(model.system(), state);
    }
  }
}

// The right end is free in z alone, so that it touches walls, while λ moves it along x and turns it.
TEST(SlidingContact, KnowsTheRatesOfFreeEndsThatSupportsMove) {
  Numbers numbers(80);
  for (const bool on_axis : {false, true}) {
    const auto walls = test::all_walls(on_axis);
    for (std::size_t kind = 0; kind < walls.size() / 2; ++kind) {
      StructureBuilder builder = wavy_beam(false);
      builder.fix(builder.dof(1, Dof::x), {.proportional = -0.1});
      builder.fix(*builder.shared_rotation(1), {.constant = 0.1, .proportional = 0.2});
      const SlidingModel model(builder, two_of(walls, kind), 0.1);
      const std::size_t ends = model.system().open_active_set().size();
      ASSERT_EQ(ends, 2U);  // one a wall
      for (std::size_t closed = 0; closed < ends; ++closed) {
        SCOPED_TRACE("wall " + std::to_string(kind) + ", end " + std::to_string(closed));
        const Layouts& on = layouts()[2];
        ActiveSet active_set = active_set_of(model, on);
        active_set[on.points.size() + closed] = 1;
        const State state = random_state(model, active_set, numbers);
        EXPECT_LE(check_derivatives(model.system(), state, 1e-6).K, 1e-9);
        expect_rates(model.system(), state);
      }
    }
  }
}

TEST(SlidingContact, OneLinearizationServesChangingLayouts) {
  Numbers numbers(71);
  const SlidingModel model(wavy_beam(false), two_of(test::all_walls(false), 2), 0.1);
  Linearization reused;
  for (const std::size_t i : {0U, 2U, 2U, 3U, 4U, 8U, 7U, 0U}) {
    const State state = random_state(model, active_set_of(model, layouts()[i]), numbers);
    model.system().linearize(state, reused);
    Linearization fresh;
    model.system().linearize(state, fresh);
    EXPECT_EQ(reused.F, fresh.F);
    EXPECT_EQ(reused.F_lambda, fresh.F_lambda);
    EXPECT_EQ(reused.B, fresh.B);
    EXPECT_EQ(reused.C, fresh.C);
    EXPECT_EQ(Matrix(reused.K), Matrix(fresh.K));
  }
}

TEST(SlidingContact, UnitForcesAreTheResponseToAForceOfOne) {
  Numbers numbers(72);
  const SlidingModel model(wavy_beam(false), two_of(test::all_walls(false), 3), 0.1);
  const SlidingContact& system = model.system();
  const State open = random_state(model, active_set_of(model, layouts()[4]), numbers);
  for (const Index j : {Index{0}, open.active_set.size() > 2 ? Index{2} : Index{0}}) {
    ActiveSet closed = open.active_set;
    closed[static_cast<std::size_t>(j)] = 1;
    State pushed = system.with_active_set(open, closed);
    const Enforcement how = system.enforcement(closed, j);
    pushed.x[*how.multiplier] = how.force_scale;
    Vector with(pushed.x.size());
    system.residual(pushed, with);
    Vector without(open.x.size());
    system.residual(open, without);
    const Vector response = system.unit_force(open, j);
    const Index n = mesh_of(open).unknowns();
    EXPECT_LE((without.head(n) - with.head(n) - response.head(n)).norm(), 1e-12 * response.norm());
    EXPECT_EQ(response.tail(response.size() - n).norm(), 0.0);
  }
}

TEST(SlidingContact, TransferKeepsThePointAndTheForcesThatStay) {
  Numbers numbers(73);
  const SlidingModel model(wavy_beam(false), two_of(test::all_walls(false), 0), 0.1);
  const SlidingContact& system = model.system();
  Layouts on = layouts()[3];
  const ActiveSet from = active_set_of(model, on);
  const State state = random_state(model, from, numbers);
  ActiveSet to = from;
  to[0] = 0;
  to[2] = 1;  // the free end
  const State moved = system.with_active_set(state, to);
  EXPECT_EQ(moved.x.size(), system.size(to));
  EXPECT_EQ(system.force(moved, 0), 0.0);
  EXPECT_EQ(system.force(moved, 1), system.force(state, 1));
  EXPECT_EQ(system.force(moved, 2), 0.0);
  const Index n = mesh_of(state).unknowns();
  EXPECT_EQ(Vector(moved.x.head(n)), Vector(state.x.head(n)));
  EXPECT_EQ(Vector(moved.x.tail(4)), Vector(state.x.tail(4)));
  EXPECT_EQ(system.with_active_set(state, from).x, state.x);
}

TEST(SlidingContact, GuardsAreGapsAndForcesInTheirScales) {
  Numbers numbers(74);
  const SlidingModel model = SlidingChannel{}.model();
  const SlidingContact& system = model.system();
  const State state = random_state(model, active_set_of(model, layouts()[4]), numbers);
  const Vector guards = system.guards(state);
  ASSERT_EQ(guards.size(), system.guard_count(state.active_set));
  // Point 0 is open below the column, point 1 closed above it: gaps of faces 0.05 off the axis to walls at ±0.2.
  const AxisPlace at = mesh_of(state).node(0, mesh_of(state).breakpoint(0).second, mesh_state_of(state));
  EXPECT_NEAR(guards[0], (at.position.y() - 0.05 * std::cos(at.angle) + 0.2) / system.scales().length, 1e-14);
  EXPECT_DOUBLE_EQ(guards[1], system.force(state, 1) / system.scales().force);
}

// What is told of a contact is what acts in the equations: where a force of an inclined wall on the axis is left out,
// the equations of its node miss the force vector that is told.
TEST(SlidingContact, TellsTheForcesThatActInTheEquations) {
  Numbers numbers(79);
  const SlidingModel model(wavy_beam(false), two_of(test::all_walls(true), 1), 0.1);
  const SlidingContact& system = model.system();
  const State state =
      random_state(model, active_set_of(model, layouts()[8]), numbers);  // a pressed part on the lower wall
  const MeshState now = mesh_state_of(state);
  const SlidingMesh& mesh = mesh_of(state);
  Vector with(state.x.size()), without(state.x.size());
  system.residual(state, with);
  const auto expect_force = [&](const ContactPoint& contact, const ContactPoint& beside, Index position, Index force) {
    EXPECT_EQ(contact.label.wall, "wall");
    EXPECT_EQ(contact.label.member, "beam");
    EXPECT_NEAR(contact.force + beside.force, state.x[force], 1e-12 * std::abs(state.x[force]));
    EXPECT_LE((contact.place - mesh.node(0, position, now).position).norm(), 1e-15);
    State less = state;
    less.x[force] = 0.0;
    system.residual(less, without);
    const NodeUnknowns unknowns = mesh.node_unknowns(0, position);
    const Vec2 vector = contact.force_vector + beside.force_vector;
    EXPECT_NEAR(without[unknowns[0]] - with[unknowns[0]], vector.x(), 1e-12);
    EXPECT_NEAR(without[unknowns[1]] - with[unknowns[1]], vector.y(), 1e-12);
    EXPECT_GT(contact.force_vector.y() * contact.force, 0.0);
  };
  const auto closed = system.closed_contacts(state), pressed = system.pressed_nodes(state);
  ASSERT_EQ(closed.size(), 2U);
  ASSERT_EQ(pressed.size(), 5U);  // three nodes inside, and half an element at each end
  const double element = (now.s[1] - now.s[0]) / 4.0;
  const Index n = mesh.unknowns(), first = mesh.breakpoint(0).second;
  for (const Index k : {0, 1}) {
    const ContactPoint &end = closed[static_cast<std::size_t>(k)], &beside = pressed[static_cast<std::size_t>(3 + k)];
    expect_force(end, beside, mesh.breakpoint(k).second, n + k);
    EXPECT_LE((system.contact(state, k).force_vector - end.force_vector - beside.force_vector).norm(), 1e-12);
    EXPECT_FALSE(end.pressure());
    EXPECT_NEAR(beside.label.tributary, 0.5 * element, 1e-15);
  }
  for (Index i = 0; i < 3; ++i) {
    const ContactPoint& node = pressed[static_cast<std::size_t>(i)];
    expect_force(node, {}, first + 1 + i, n + 2 + i);
    EXPECT_NEAR(node.label.tributary, element, 1e-15);
    EXPECT_NEAR(*node.pressure(), node.force / element, 1e-12);
  }
}

// A path may begin where one on the same body under other loads has ended.
TEST(SlidingContact, AdoptsStatesOfABodyUnderOtherLoads) {
  Numbers numbers(77);
  const auto walls = two_of(test::all_walls(false), 0);
  StructureBuilder loaded = wavy_beam(false);
  loaded.add_load(loaded.dof(1, Dof::z), 5.0, LoadKind::constant);
  const SlidingModel from(wavy_beam(false), walls, 0.1), to(loaded, walls, 0.1);
  const State state = random_state(from, active_set_of(from, layouts()[3]), numbers);
  const State adopted = to.system().adopted(state);
  EXPECT_EQ(adopted.x, state.x);
  EXPECT_EQ(adopted.lambda, state.lambda);
  EXPECT_EQ(adopted.active_set.closed_count(), state.active_set.closed_count());
  Vector before(state.x.size()), after(state.x.size());
  from.system().residual(state, before);
  to.system().residual(adopted, after);
  const Index loaded_unknown = *to.structure().unknown(mesh_of(adopted), to.structure().dof(1, Dof::z));
  EXPECT_NEAR(before[loaded_unknown] - after[loaded_unknown], 5.0, 1e-12);
  after[loaded_unknown] = before[loaded_unknown];
  EXPECT_EQ(before, after);
}

// Places where nodes sit are nodes; between them values and rates are those of the element's own interpolation. Rates
// by s are differences of step 2e-6 of arc lengths that are sure to 1e-13.
TEST(SlidingContact, PlacesMoveWithTheMeshConsistently) {
  Numbers numbers(75);
  using Component = MemberObservable::Component;
  const SlidingModel model(wavy_beam(false), two_of(test::all_walls(false), 0), 0.1);
  for (const std::size_t i : {2U, 3U, 7U}) {
    const State state = random_state(model, active_set_of(model, layouts()[i]), numbers);
    for (const Component component :
         {Component::x, Component::z, Component::rotation, Component::face_above_z, Component::face_below_z})
      for (const double fraction : {0.013, 0.27, 0.5, 0.77, 0.93})
        EXPECT_LE(check_gradient(*model.at("beam", fraction, component), state, 1e-6), 1e-8)
            << fraction << ", component " << static_cast<int>(component);
    const SlidingMesh& mesh = mesh_of(state);
    const MeshState now = mesh_state_of(state);
    for (Index node = 0; node < mesh.nodes(0); ++node) {
      const AxisPlace there = mesh.node(0, node, now);
      const AxisPlace same = mesh.place({.strand = 0, .s = mesh.coordinate(0, node, now.s)}, now);
      EXPECT_LE((there.position - same.position).norm(), 1e-13);
      EXPECT_NEAR(there.angle, same.angle, 1e-12);
    }
  }
}

TEST(SlidingContact, JointsAndReactionsMoveConsistently) {
  Numbers numbers(76);
  const SlidingModel model(wavy_beam(false), two_of(test::all_walls(false), 0), 0.1);
  const State state = random_state(model, active_set_of(model, layouts()[3]), numbers);
  for (const Dof which : {Dof::x, Dof::z}) {
    EXPECT_LE(check_gradient(*model.joint(1, which), state), 1e-9);
    const JointObservable reaction(model.structure(), model.structure().dof(0, which), JointObservable::What::reaction);
    EXPECT_LE(check_gradient(reaction, state), 1e-7);
  }
}

}  // namespace arcwall::sliding_contact_test
