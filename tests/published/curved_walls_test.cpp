#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/essenburg_models.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// Beams that lie on curved walls over a length, with contact at their nodes: a strip that is wrapped round a cylinder,
// a beam that is bent onto a parabola.
namespace arcwall::curved_walls_test {

namespace {

constexpr double length = 1.5;

// A strip 0.01 high, clamped at the top of a cylinder of radius 1, its tip pulled down by λ. EI = 1, EA and GA so large
// that stretch and shear move the tip by 1e-5.
test::ContactModel strip(Theory theory, int order, int elements) {
  StructureBuilder builder;
  const Vec2 top(0.0, 0.0), tip(length, 0.0);
  builder.add_joint(top);
  builder.add_joint(tip);
  const bool thick = theory == Theory::essenburg;
  builder.add_member({.name = "strip",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis(top, tip),
                      .theory = theory,
                      .order = order,
                      .quadratic = QuadraticTerm::director,
                      .section = thick ? test::essenburg_section(1.2e7, 0.3, 1.0, 0.01)
                                       : Section{.E = 1.0, .A = 1.2e5, .I = 1.0, .G = 1.0, .shear_area = 4e4},
                      .elements = elements});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.shared_rotation(0).value());
  builder.add_load(builder.dof(1, Dof::z), -1.0, LoadKind::proportional);
  return {builder.build(),
          {{.name = "cylinder",
            .side = Side::below,
            .profile = circle_profile({0.0, -1.0}, 1.0, Side::below),
            .on_axis = true}},
          0.05};
}

struct Wrapped {
  double turn = 0.0, angle = 0.0;  // of the tip, of the part on the cylinder
};

Wrapped wrapped_at(const test::ContactModel& model, const State& state) {
  Wrapped found{.turn = -model.structure().value(state, *model.structure().members()[0].rotations.back()), .angle = 0};
  for (Index j = 0; j < model.system().contact_count(); ++j)
    if (state.active_set[static_cast<std::size_t>(j)])
      found.angle = std::max(found.angle, length * model.system().candidate(j).label().fraction);
  return found;
}

// On one path, at two loads.
std::pair<Wrapped, Wrapped> wrapped(const test::ContactModel& model, double first, double last) {
  TraceOptions options;
  options.step.first = 0.05;
  options.target_values = {{.quantity = std::make_shared<ParameterValue>(), .value = first},
                           test::stop_at_lambda(last)};
  const test::Branch branch = test::trace(model.system(), options);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  expect_branch_invariants(model.system(), branch, options, {.recount_every = 20});
  const auto landed = [&](const Arc& arc) { return std::abs(arc.to.state.lambda - first) <= 1e-12; };
  const auto at = std::find_if(branch.arcs.begin(), branch.arcs.end(), landed);
  if (at == branch.arcs.end()) {
    ADD_FAILURE() << "no point at " << first;
    return {};
  }
  return {wrapped_at(model, at->to.state), wrapped_at(model, branch.last().state)};
}

// The part on the cylinder reaches to the angle α where the free part has the curvature of the wall. With φ the tip's
// rotation and a = sin φ,
//
//   1/2 = P (a − sin α),    ∫_α^φ dψ/√(2 P (a − sin ψ)) = L − α,
//
// whose solutions for L = 1.5 by quadrature are P = 1.468600571600 with φ = 0.961211363768 for α = 0.5, and P =
// 5.923791225577 with φ = 1.254618499526 for α = 60°.
void expect_turn_of_the_elastica(Theory theory, int order) {
  constexpr int elements = 30;
  const test::ContactModel model = strip(theory, order, elements);
  const auto [half, whole] = wrapped(model, 1.468600571600, 5.923791225577);
  EXPECT_NEAR(half.turn, 0.961211363768, 2e-5);
  EXPECT_NEAR(whole.turn, 1.254618499526, 1e-4);
  EXPECT_NEAR(half.angle, 0.5, 1.01 * length / elements);
  EXPECT_NEAR(whole.angle, pi / 3.0, 1.01 * length / elements);
}

}  // namespace

TEST(WrappedStrip, ClassicHasTheTurnOfTheElastica) { expect_turn_of_the_elastica(Theory::euler_bernoulli, 2); }
TEST(WrappedStrip, ElasticaHasTheTurnOfTheElastica) { expect_turn_of_the_elastica(Theory::elastica, 6); }
TEST(WrappedStrip, ExactHasTheTurnOfTheElastica) { expect_turn_of_the_elastica(Theory::reissner, 2); }
TEST(WrappedStrip, EssenburgHasTheTurnOfTheElasticaSlow) { expect_turn_of_the_elastica(Theory::essenburg, 2); }

// A classic beam of half length 1 above the parabola z = −h/2 − d + ½ k x² under small end moments conforms to it for M
// > EI k + 6 EI (d − k/2), over |x| < c with 1 − c = √(6 EI (d − k/2)/(M − EI k)); each edge bears (M − EI k)/(1 − c).
// Inside the pressure is EI κ″, next to nothing: springs settle it, and rigid contact at nodes does not always. Nodes
// know the edge to an element.
TEST(ClassicBeamOnAParabola, ConformsToIt) {
  constexpr double EI = 2.8, h = 0.2, d = 8e-5, k = 5e-5;
  constexpr int elements = 80;
  StructureBuilder builder;
  const Vec2 middle(0.0, 0.0), end(1.0, 0.0);
  builder.add_joint(middle);
  builder.add_joint(end);
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis(middle, end),
                      .section = {.E = 21000.0, .A = h * h, .I = EI / 21000.0, .height = h},
                      .elements = elements});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.shared_rotation(0).value());
  builder.fix(builder.dof(1, Dof::z));
  builder.add_load(builder.shared_rotation(1).value(), 1e-3, LoadKind::proportional);
  const test::ContactModel model(
      builder.build(), {{.name = "wall", .side = Side::below, .profile = parabola_profile({0.0, -0.5 * h - d}, k)}},
      0.05, {.method = ContactLaw::Method::penalty, .stiffness = 1e8});
  TraceOptions options;
  options.step.first = 0.05;
  options.target_values.push_back(test::stop_at_lambda(5.0));
  const test::Branch branch = test::trace(model.system(), options);
  ASSERT_EQ(branch.end.reason, EndReason::stop);
  const State& state = branch.last().state;
  double edge = 0.0, force = 0.0;
  for (Index j = 0; j < model.system().contact_count(); ++j) {
    force += model.system().force(state, j);
    if (state.active_set[static_cast<std::size_t>(j)])
      edge = std::max(edge, model.system().candidate(j).label().fraction);
  }
  const double bending = 5e-3 - EI * k, free = std::sqrt(6.0 * EI * (d - 0.5 * k) / bending);
  EXPECT_NEAR(edge, 1.0 - free, 1.01 / elements);
  EXPECT_NEAR(force, bending / free, bending / free / elements);
}

}  // namespace arcwall::curved_walls_test
