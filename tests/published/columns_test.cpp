#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/convergence.hpp"
#include "tests/support/explore.hpp"
#include "tests/support/models.hpp"

// Columns of length 1 and EI = 1, pushed by λ. Branch points of the straight column: P (1 − P/EA + P/GA) = n² π²,
// pinned (Euler; Engesser's and Haringx's terms as Reissner's beam has them). Behind them the inextensible elastica by
// complete elliptic integrals; where it stretches and shears, values by shooting with adaptive Taylor series.
namespace arcwall::columns_test {

namespace {

using test::BeamTheory;
using test::Column;
using test::Graph;

// A bent pinned column whose ends have turned by `degrees`: load, distance of the ends, deflection in the middle.
struct Bent {
  double degrees = 0.0, load = 0.0, chord = 0.0, middle = 0.0;
};

// Inextensible: with k = sin(α/2), P = (2K)², chord 2E/K − 1, deflection k/K.
Bent elastica(double degrees) {
  const double k = std::sin(0.5 * degrees * pi / 180.0);
  const double K = std::comp_ellint_1(k), E = std::comp_ellint_2(k);
  return {degrees, 4.0 * K * K, 2.0 * E / K - 1.0, k / K};
}

// The rotation of a node of the column, here at its end or at a quarter of it.
std::shared_ptr<const Observable> rotation_at(const Structure& column, double fraction) {
  const MemberMesh& mesh = column.members()[0];
  const auto node = static_cast<std::size_t>(std::lround(fraction * double(mesh.nodes.size() - 1)));
  return std::make_shared<DofObservable>(column, mesh.rotations[node].value());
}

// The buckled column where the rotation at `fraction` has these values, in degrees and rising. The last one ends it.
std::vector<Bent> bent(const Column& column, double fraction, const std::vector<double>& degrees) {
  const auto structure = column.structure();
  const auto angle = rotation_at(*structure, fraction);
  TraceOptions trace;
  trace.step.first = 1.0;
  for (const double value : degrees)
    trace.target_values.push_back(
        {.quantity = angle, .value = value * pi / 180.0, .stops = value == degrees.back(), .label = "angle"});
  const Graph graph = test::explore(*structure, trace, {.policy = BranchPolicy::most_stable, .preference = {angle}});
  std::vector<Bent> found;
  if (graph.records.size() != 2) {
    ADD_FAILURE() << graph.records.size() << " branches";
    return std::vector<Bent>(degrees.size());
  }
  EXPECT_TRUE(graph.records[1].mirror_image);
  const MemberMesh& mesh = structure->members()[0];
  for (const Arc& arc : graph.branches[1].arcs)
    for (const double value : degrees)
      if (std::abs(angle->value(arc.to.state) - value * pi / 180.0) < 1e-10) {
        EXPECT_EQ(arc.to.count.unstable, Index{0});
        found.push_back({.degrees = value,
                         .load = arc.to.state.lambda,
                         .chord = structure->current(arc.to.state, 1).x(),
                         .middle = std::abs(structure->current(arc.to.state, mesh.nodes[mesh.nodes.size() / 2]).y())});
      }
  EXPECT_EQ(found.size(), degrees.size());
  found.resize(degrees.size());
  return found;
}

// The state at 60° over four meshes, and its limit.
void expect_bent_converges(const Bent& exact, const BeamTheory& theory, const std::function<Bent(int elements)>& at) {
  std::vector<double> loads, chords, middles;
  for (const int elements : {8, 16, 32, 64}) {
    const Bent found = at(elements);
    loads.push_back(found.load);
    chords.push_back(found.chord);
    middles.push_back(found.middle);
  }
  test::expect_convergence(loads, {.exact = exact.load, .order = double(theory.convergence)});
  test::expect_convergence(chords, {.exact = exact.chord, .order = double(theory.convergence)});
  test::expect_convergence(middles, {.exact = exact.middle, .order = double(theory.convergence)});
}

void expect_bent(const Bent& found, const Bent& expected, double relative) {
  SCOPED_TRACE(expected.degrees);
  EXPECT_NEAR(found.load / expected.load, 1.0, relative);
  EXPECT_NEAR(found.chord, expected.chord, relative);
  EXPECT_NEAR(found.middle, expected.middle, relative);
}

std::vector<Event> branch_points(const Structure& column, double until, double first_step = 1.0) {
  TraceOptions trace;
  trace.step.first = first_step;
  trace.target_values = {test::stop_at_lambda(until)};
  return events_of(test::trace(column, trace), EventKind::branch_point);
}

// P (1 − P/EA + P/GA) = n² π²
double buckling_load(int n, double EA, double GA = infinity) {
  const double c = 1.0 / EA - 1.0 / GA, euler = n * n * pi * pi;
  return 2.0 * euler / (1.0 + std::sqrt(1.0 - 4.0 * c * euler));
}

}  // namespace

TEST(PinnedColumn, HasItsBranchPointsWithTheirCounts) {
  const double EA = 1000.0;
  const auto points = branch_points(*Column{.EA = EA, .elements = 40}.structure(), 170.0);
  ASSERT_EQ(points.size(), 3U);
  for (int n = 1; n <= 3; ++n) {
    const Event& event = points[static_cast<std::size_t>(n - 1)];
    const double load = buckling_load(n, EA);
    // The element's error: (π n/40)⁴/720 relative, amplified by the factor that the stretch adds.
    EXPECT_NEAR(event.state.lambda, load, 2.0 * load * std::pow(pi * double(n) / 40.0, 4) / 720.0 + 1e-9);
    EXPECT_EQ(event.branching->type, BranchType::pitchfork);
    EXPECT_EQ(event.branching->multiplicity, 1);
    EXPECT_EQ(event.unstable_before, n - 1);
    EXPECT_EQ(event.unstable_after, n);
    EXPECT_LE(event.lambda_uncertainty, 1e-10 * load);
  }
}

// On fine meshes the round-off of K is what moves its zero. With n elements it is some n² roundings here; the element's
// error is below 1e-12.
TEST(PinnedColumn, SaysHowFarRoundOffMovesItsBranchPoints) {
  const double EA = 1000.0;
  for (const int elements : {640, 1280}) {
    const auto points = branch_points(*Column{.EA = EA, .elements = elements}.structure(), 50.0);
    ASSERT_EQ(points.size(), 2U);
    for (int n = 1; n <= 2; ++n) {
      const Event& event = points[static_cast<std::size_t>(n - 1)];
      const double load = buckling_load(n, EA);
      EXPECT_NEAR(event.state.lambda, load, event.lambda_uncertainty + 1e-11 * load);
      EXPECT_GE(event.lambda_uncertainty, 1e-11 * load);
      EXPECT_LE(event.lambda_uncertainty, 1e-8 * load);
    }
  }
}

// A support moves the end by λ instead of a load: the column buckles where the support has shortened it by P/EA, P
// being the load above, and the support carries that load.
TEST(PinnedColumn, BucklesUnderASupportThatMoves) {
  const double EA = 1000.0;
  StructureBuilder builder;
  builder.add_joint({0.0, 0.0});
  builder.add_joint({1.0, 0.0});
  builder.add_member({.name = "column",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis({0.0, 0.0}, {1.0, 0.0}),
                      .section = test::section_of(EA, 1.0),
                      .elements = 40});
  for (const Index joint : {0, 1}) builder.fix(builder.dof(joint, Dof::z));
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(1, Dof::x), {.proportional = -1.0});
  const auto column = builder.build();
  const auto points = branch_points(*column, 0.02, 1e-3);
  ASSERT_EQ(points.size(), 1U);
  const double load = buckling_load(1, EA), shortening = load / EA;
  const double by_element = 2.0 * std::pow(pi / 40.0, 4) / 720.0;  // relative, as above
  EXPECT_NEAR(points[0].state.lambda, shortening, by_element * shortening + 1e-12);
  EXPECT_EQ(points[0].branching->type, BranchType::pitchfork);
  EXPECT_EQ(points[0].unstable_after, 1);
  const double reaction = column->reaction(points[0].state, column->dof(1, Dof::x));
  EXPECT_NEAR(reaction, -EA * points[0].state.lambda, 1e-9 * load);
}

TEST(PinnedColumn, BucklingLoadsConverge) {
  const auto expect = [](const BeamTheory& theory, double EA, double GA) {
    SCOPED_TRACE(theory.name);
    for (const int n : {1, 2}) {
      const auto loads = test::on_four_meshes(8, [&](int elements) {
        const auto column = Column{.EA = EA, .elements = elements, .GA = GA, .beam = theory}.structure();
        return branch_points(*column, 60.0).at(static_cast<std::size_t>(n - 1)).state.lambda;
      });
      test::expect_convergence(loads, {.exact = buckling_load(n, EA, GA), .order = double(theory.convergence)});
    }
  };
  for (const BeamTheory& theory : test::elastica_theories()) expect(theory, 1000.0, infinity);
  for (const BeamTheory& theory : test::shear_theories()) expect(theory, 1000.0, 500.0);
}

// A clamped column buckles at 4 n² π² evenly, else where tan(k/2) = k/2, P = k²: 4.4934² · 4. Inextensible.
TEST(ClampedColumn, BucklingLoadsConvergeSlow) {
  const double euler[] = {4.0 * pi * pi, 80.762914225706519898, 16.0 * pi * pi};
  for (const BeamTheory& theory : test::elastica_theories())
    for (const std::size_t n : {0U, 1U, 2U}) {
      const auto loads = test::on_four_meshes(12, [&](int elements) {
        const auto load = [&](double flexibility) {
          const Column column{.EA = 1.0 / flexibility, .clamped = true, .elements = elements, .beam = theory};
          return branch_points(*column.structure(), 170.0, 5.0).at(n).state.lambda;
        };
        return test::at_zero(load, 1e-5);
      });
      test::expect_convergence(loads, {.exact = euler[n], .order = double(theory.convergence)});
    }
}

// EA = 4e7 stands for an inextensible column: P/EA = 3e-7.
TEST(PinnedColumn, FollowsTheElasticaBehindTheEulerLoadSlow) {
  const std::vector<double> degrees{10.0, 20.0, 30.0, 40.0, 50.0, 60.0};
  for (const BeamTheory& theory : test::elastica_theories()) {
    SCOPED_TRACE(theory.name);
    const auto found = bent({.EA = 4e7, .elements = 40, .beam = theory}, 0.0, degrees);
    for (std::size_t i = 0; i < degrees.size(); ++i) expect_bent(found[i], elastica(degrees[i]), 1e-6);
    expect_bent_converges(elastica(60.0), theory, [&](int elements) {
      Bent limit{.degrees = 60.0};
      const auto at = [&](double Bent::*what) {
        return test::at_zero(
            [&](double flexibility) {
              return bent({.EA = 1.0 / flexibility, .elements = elements, .beam = theory}, 0.0, {60.0})[0].*what;
            },
            1e-5);
      };
      limit.load = at(&Bent::load);
      limit.chord = at(&Bent::chord);
      limit.middle = at(&Bent::middle);
      return limit;
    });
  }
}

// Where the ends of the pinned column meet, 2E = K, the force between them has no arm, and the column may turn about
// them: one more branch point, behind which it is unstable. At 130.7° and 2.18 times the Euler load.
TEST(PinnedColumn, LosesItsStabilityWhereItsEndsMeet) {
  const auto chord = [](double degrees) { return elastica(degrees).chord; };
  double low = 120.0, high = 140.0;
  for (int i = 0; i < 50; ++i) (chord(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  const double expected = elastica(0.5 * (low + high)).load;
  EXPECT_NEAR(expected / (pi * pi), 2.18, 0.01);
  for (const BeamTheory& theory : test::elastica_theories()) {
    const auto loads = test::on_four_meshes(8, [&](int elements) {
      const auto second_branch_point = [&](double flexibility) {
        const auto structure = Column{.EA = 1.0 / flexibility, .elements = elements, .beam = theory}.structure();
        TraceOptions trace;
        trace.step.first = 1.0;
        trace.target_values = {test::stop_at_lambda(24.0)};
        const Graph graph = test::explore(*structure, trace, {.policy = BranchPolicy::all, .depth = 1});
        const Event event = only_event(graph.branches.at(1), EventKind::branch_point);
        EXPECT_EQ(event.unstable_before, 0);
        EXPECT_EQ(event.unstable_after, 1);
        EXPECT_EQ(event.branching->type, BranchType::pitchfork);
        return event.state.lambda;
      };
      return test::at_zero(second_branch_point, 1e-5);
    });
    test::expect_convergence(loads, {.exact = expected, .order = double(theory.convergence)});
  }
}

// Two quarters of a clamped column are a pinned one of half its length upright: four times the load, the same shape. α
// is the rotation at a quarter of the length.
TEST(ClampedColumn, FollowsTheElasticaBehindTheEulerLoad) {
  const std::vector<double> degrees{10.0, 20.0, 40.0, 60.0};
  for (const BeamTheory& theory : test::elastica_theories()) {
    SCOPED_TRACE(theory.name);
    const auto found = bent({.EA = 4e7, .clamped = true, .elements = 80, .beam = theory}, 0.25, degrees);
    for (std::size_t i = 0; i < degrees.size(); ++i) {
      Bent expected = elastica(degrees[i]);
      expected.load *= 4.0;
      expect_bent(found[i], expected, 2e-6);  // P/EA = 1e-6
    }
  }
}

TEST(PinnedColumn, FollowsTheExtensibleElastica) {
  struct Table {
    double EA;
    std::vector<Bent> rows;
  };
  const Table tables[] = {{1000.0,
                           {{20.0, 10.119328723778356, 0.9602114510214882, 0.10863824020479494},
                            {40.0, 10.590310472544742, 0.8729254089598278, 0.20921226040279964},
                            {60.0, 11.448352867534028, 0.7344641563116902, 0.2942767575752229}}},
                          {100.0,
                           {{20.0, 11.224391176424405, 0.8641393477638875, 0.09785701358196722},
                            {40.0, 11.607944515899808, 0.7904459938523788, 0.19020462396514337},
                            {60.0, 12.308225394301186, 0.6704395140109461, 0.2715630331025475}}}};
  for (const BeamTheory& theory : test::elastica_theories())
    for (const Table& table : tables) {
      SCOPED_TRACE(theory.name + ", EA = " + std::to_string(table.EA));
      const auto found = bent({.EA = table.EA, .elements = 40, .beam = theory}, 0.0, {20.0, 40.0, 60.0});
      for (std::size_t i = 0; i < 3; ++i) expect_bent(found[i], table.rows[i], 1e-6);
      expect_bent_converges(table.rows[2], theory, [&](int elements) {
        return bent({.EA = table.EA, .elements = elements, .beam = theory}, 0.0, {60.0})[0];
      });
    }
}

TEST(PinnedColumn, FollowsReissnersBeamWhereItShears) {
  struct Table {
    double EA, GA;
    std::vector<Bent> rows;
  };
  const Table tables[] = {{1000.0,
                           500.0,
                           {{20.0, 9.927474084298538, 0.959214911730937, 0.1107545468540177},
                            {40.0, 10.408704733617057, 0.8685218980493156, 0.21299531236885583},
                            {60.0, 11.28796123710808, 0.724905547967086, 0.29889790388306176},
                            {80.0, 12.710989706261067, 0.5387607770484912, 0.36192745099447826}}},
                          {100.0,
                           50.0,
                           {{20.0, 9.211484715434638, 0.8721545266907453, 0.11943086671680674},
                            {40.0, 9.719912033760659, 0.762766937196182, 0.22862895321510834},
                            {60.0, 10.662262972087738, 0.588746880493597, 0.31825888885062376},
                            {80.0, 12.225177778391377, 0.3607204081718595, 0.3806402229754601}}}};
  for (const BeamTheory& theory : test::shear_theories())
    for (const Table& table : tables) {
      SCOPED_TRACE(theory.name + ", EA = " + std::to_string(table.EA));
      const auto column = [&](int elements) {
        return Column{.EA = table.EA, .elements = elements, .GA = table.GA, .beam = theory};
      };
      if (theory.convergence >= 4) {
        const auto found = bent(column(40), 0.0, {20.0, 40.0, 60.0, 80.0});
        for (std::size_t i = 0; i < 4; ++i) expect_bent(found[i], table.rows[i], 1e-6);
      }
      expect_bent_converges(table.rows[3], theory,
                            [&](int elements) { return bent(column(elements), 0.0, {80.0})[0]; });
    }
}

}  // namespace arcwall::columns_test
