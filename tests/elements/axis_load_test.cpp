#include <gtest/gtest.h>

#include <cmath>

#include "elements/distributed_load.hpp"
#include "elements/structure.hpp"
#include "tests/elements/element_checks.hpp"
#include "tests/support/beam_theories.hpp"

namespace arcwall::axis_load_test {

namespace {

const Vec2 given(0.7, -1.9);
const LineLoad load{.first = given, .frame = LoadFrame::member};

// Of each frame and measure, linear along the member.
std::vector<LineLoad> all_loads() {
  std::vector<LineLoad> loads;
  for (const LoadFrame frame : {LoadFrame::global, LoadFrame::member})
    for (const LoadMeasure measure : {LoadMeasure::axis, LoadMeasure::plan})
      loads.push_back({.first = given, .slope = {0.9, 1.3}, .frame = frame, .measure = measure});
  return loads;
}

// An arc with a wave.
struct WavyArc {
  std::unique_ptr<Axis> arc = arc_axis({0.0, 0.0}, {1.0, 0.3}, {2.0, 0.0});
  ImperfectAxis shape{*arc, {{.amplitude = 0.05, .waves = 2}}};
};

// The load of a clamped beam on the nodes of its mesh.
Vector nodal_forces(const test::BeamTheory& theory, LoadFrame frame, const Vec2& q) {
  StructureBuilder builder;
  const Vec2 from(1.0, 2.0), to(4.0, 6.0);
  builder.add_joint(from);
  builder.add_joint(to);
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis(from, to),
                      .theory = theory.theory,
                      .order = theory.order,
                      .section = test::section_of(10.0, 1.0, 4.0),
                      .elements = 3});
  builder.add_distributed_load(0, q, LoadKind::proportional, frame);
  const auto structure = builder.build();
  Linearization at;
  structure->linearize({.x = Vector::Zero(structure->size({}))}, at);
  return -at.F_lambda;
}

}  // namespace

TEST(AxisLoad, DerivativesAreConsistent) {
  test::Numbers numbers(141);
  const WavyArc bent;
  for (const LineLoad& one : all_loads()) {
    const BeamDistributedLoad beam(stretch_reference(bent.shape, 0.4, 0.9), one, 0.4, 0.9);
    for (int i = 0; i < 5; ++i) test::expect_derivatives(beam, 0.5 * numbers.vector(6));
    EXPECT_EQ(test::evaluated(beam, Vector::Zero(6)).energy, 0.0);
  }
}

// Its forces add up to the load on the chord of a perfect axis, ∫ t dS and ∫ n dS, to round-off of the Gauss points.
TEST(AxisLoad, AddsUpToThatAlongAndAcrossTheChord) {
  test::Numbers numbers(142);
  const auto arc = arc_axis({0.0, 0.0}, {1.0, 0.3}, {2.0, 0.0});
  const StretchReference stretch = stretch_reference(ImperfectAxis(*arc, {}), 0.4, 0.6);
  const Vector f = -test::evaluated(BeamDistributedLoad(stretch, load), numbers.vector(6)).f;
  const Vec2 expected = given.x() * stretch.chord + given.y() * perp(stretch.chord);
  EXPECT_LE((f.segment<2>(0) + f.segment<2>(3) - expected).norm(), 1e-9);
}

// The ends of the stretch slide along the member while the beam stays where it is.
TEST(AxisLoad, RatesAreConsistent) {
  constexpr double step = 1e-6;
  test::Numbers numbers(143);
  const WavyArc bent;
  const Vector q = numbers.vector(6);
  for (const LineLoad& one : all_loads()) {
    const auto respond = [&](double S1, double S2) {
      const Vec2 first = bent.shape.at(S1).position;
      return StretchLoad(stretch_reference(bent.shape, S1, S2), one, S1, S2)
          .respond(q.head<2>() - first, q[2], q.segment<2>(3) - first, q[5]);
    };
    const auto rate = [&](double by1, double by2) {
      return StretchLoad::Vector6((respond(0.5 + by1, 0.9 + by2).force - respond(0.5 - by1, 0.9 - by2).force) /
                                  (2.0 * step));
    };
    const auto here = respond(0.5, 0.9);
    EXPECT_LE((here.stiffness - here.stiffness.transpose()).norm(), 1e-14);
    EXPECT_LE((here.force_rate[0] - rate(step, 0.0)).norm(), 1e-8);
    EXPECT_LE((here.force_rate[1] - rate(0.0, step)).norm(), 1e-8);
  }
}

TEST(AxisLoad, OnAStraightBeamIsTheLoadTurned) {
  const Vec2 t(0.6, 0.8), turned = given.x() * t + given.y() * perp(t);
  const test::BeamTheory theories[] = {{.theory = Theory::euler_bernoulli},
                                       {.theory = Theory::elastica, .order = 6},
                                       {.theory = Theory::reissner, .order = 1},
                                       {.theory = Theory::reissner, .order = 2}};
  for (const test::BeamTheory& theory : theories)
    EXPECT_LE((nodal_forces(theory, LoadFrame::member, given) - nodal_forces(theory, LoadFrame::global, turned)).norm(),
              1e-13);
}

}  // namespace arcwall::axis_load_test
