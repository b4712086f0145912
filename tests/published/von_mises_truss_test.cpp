#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/explore.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// Two bars of half span b and rise h, apex load P = λ (von Mises 1923), v the descent of the apex. With z = h − v, l² =
// b² + z², L the length at rest, the limit loads over EA and the points where the apex begins to sway are
//
//   Green         z² = h²/3:                      P = 2 h³ / (3√3 L³)              sway at z² = h² − 2 b²
//   engineering   l³ = b² L:                      P = 2 (1 − (b/L)^(2/3))^(3/2)    sway at l³ − L l² + L b² = 0
//   logarithmic   z² + (b² − z²) ln(l/L) = 0:     P = −2 L ln(l/L) z / l²          sway at (1 − ln(l/L)) b² + z²
//   ln(l/L) = 0
//
// all of them from the stationary values of the bars' energy EA L ε²/2.
namespace arcwall::von_mises_truss_test {

namespace {

using test::trace;
using test::VonMisesTruss;

struct Point {
  double load, descent;  // over EA; the way down
};

struct Strain {
  TrussStrain strain;
  Point shallow_limit;  // b = 10, h = 1
  Point steep_limit;    // b = 1, h = 5
  Point steep_sway;
};

// The closed forms to 16 digits.
const Strain strains[] = {
    {TrussStrain::green,
     {0.00037919801295143635767, 0.42264973081037423549},
     {0.36290930581557556109, 2.1132486540518711775},
     {0.072349226394304637627, 0.2041684766872804584}},
    {TrussStrain::engineering,
     {0.00038108719041809789404, 0.4236074651689875275},
     {1.0783419850888413043, 3.5991088306340957919},
     {0.082023771929285112763, 0.21806592100492534019}},
    {TrussStrain::log,
     {0.00038298928854153894156, 0.42456395665616353628},
     {6.8834790440425346313, 4.2363147605089071766},
     {0.094400890920574742823, 0.2342882288795262199}},
};

TraceOptions down_to(const Structure& truss, double descent) {
  TraceOptions options;
  options.target_values.push_back(test::stop_at(truss, 1, Dof::z, -descent));
  return options;
}

double descent(const Structure& truss, const State& state) { return -test::displacement_of(truss, state, 1).y(); }

VonMisesTruss steep(TrussStrain strain, bool sways = true) {
  return {.EA = 1.0, .half_span = 1.0, .rise = 5.0, .strain = strain, .sways = sways};
}

// Both limit points of a branch, the second the mirror image of the first.
void expect_limits(const Structure& truss, const test::Branch& branch, double EA, const Point& expected, double rise,
                   Index unstable_before) {
  const auto found = events_of(branch, EventKind::limit_point);
  ASSERT_EQ(found.size(), 2U);
  const double load = EA * expected.load;
  EXPECT_NEAR(found[0].state.lambda, load, 1e-11 * load);
  EXPECT_NEAR(found[1].state.lambda, -load, 1e-11 * load);
  // λ is level there: displacements are sure to about the root of that.
  EXPECT_NEAR(descent(truss, found[0].state), expected.descent, 1e-8 * rise);
  EXPECT_NEAR(descent(truss, found[1].state), 2.0 * rise - expected.descent, 1e-8 * rise);
  EXPECT_EQ(found[0].unstable_before, unstable_before);
  EXPECT_EQ(found[0].unstable_after, unstable_before + 1);
  EXPECT_EQ(found[1].unstable_before, unstable_before + 1);
  EXPECT_EQ(found[1].unstable_after, unstable_before);
}

}  // namespace

TEST(VonMisesTruss, LimitLoadsMatchTheClosedFormsForAllStrains) {
  for (const Strain& expected : strains) {
    SCOPED_TRACE(static_cast<int>(expected.strain));
    constexpr double EA = 1e4;
    const auto truss = VonMisesTruss{.EA = EA, .strain = expected.strain}.structure();
    const auto w = test::displacement(*truss, 1, Dof::z);
    const TraceOptions options = down_to(*truss, 2.3);
    const test::Branch branch = trace(*truss, options, std::vector<Watch>{{.quantity = w, .label = "w"}});

    expect_limits(*truss, branch, EA, expected.shallow_limit, 1.0, 0);
    EXPECT_TRUE(events_of(branch, EventKind::turning_point).empty());
    EXPECT_TRUE(events_of(branch, EventKind::branch_point).empty());  // h < √2 b
    expect_branch_invariants(*truss, branch, options);
  }
}

// Green: λ = EA z (h² − z²) / L³ all along the path.
TEST(VonMisesTruss, ThePathIsTheClosedForm) {
  const auto truss = VonMisesTruss{.EA = 1.0}.structure();
  const test::Branch branch = trace(*truss, down_to(*truss, 2.25));
  const double L = std::sqrt(101.0);
  for (const Arc& arc : branch.arcs) {
    const double z = 1.0 - descent(*truss, arc.to.state);
    EXPECT_NEAR(arc.to.state.lambda, z * (1.0 - z * z) / (L * L * L), 1e-14);
  }
  EXPECT_NEAR(branch.last().state.lambda, 0.00069270843996673129803, 1e-14);
}

TEST(VonMisesTruss, SteepTrussesThatCannotSwayHaveTheSameFormulas) {
  for (const Strain& expected : strains) {
    SCOPED_TRACE(static_cast<int>(expected.strain));
    const auto truss = steep(expected.strain, false).structure();
    expect_limits(*truss, trace(*truss, down_to(*truss, 10.2)), 1.0, expected.steep_limit, 5.0, 0);
  }
}

// Those that can sway do so long before: a pitchfork, at which one direction is lost that stays lost up to the limit.
TEST(VonMisesTruss, SteepTrussesSwayBeforeTheirLimitPoint) {
  for (const Strain& expected : strains) {
    SCOPED_TRACE(static_cast<int>(expected.strain));
    const auto truss = steep(expected.strain).structure();
    TraceOptions options = down_to(*truss, 4.9);
    options.step.max = 0.1;  // a branch point's state is a cubic through four points a hundredth of its step apart
    const test::Branch branch = trace(*truss, options);
    const auto points = events_of(branch, EventKind::branch_point);
    ASSERT_FALSE(points.empty());
    const Event& sway = points.front();
    EXPECT_NEAR(sway.state.lambda, expected.steep_sway.load, 1e-9 * expected.steep_sway.load);
    EXPECT_NEAR(descent(*truss, sway.state), expected.steep_sway.descent, 1e-9 * 5.0);
    EXPECT_EQ(sway.branching->type, BranchType::pitchfork);
    EXPECT_EQ(sway.unstable_before, 0);
    EXPECT_EQ(sway.unstable_after, 1);
    const Event limit = only_event(branch, EventKind::limit_point);
    EXPECT_NEAR(limit.state.lambda, expected.steep_limit.load, 1e-11 * expected.steep_limit.load);
    expect_branch_invariants(*truss, branch, options);
  }
}

// Green: with u the sway the energy is stationary on u² + z² = h² − 2 b², where P = 2 EA b² z / L³. The branch joins
// both points z = ±√(h² − 2 b²) of the first; of its two mirror images one is traced.
TEST(VonMisesTruss, TheSwayBranchIsTheClosedFormAndJoinsBothBranchPoints) {
  const auto truss = steep(TrussStrain::green).structure();
  const double L = std::sqrt(26.0), radius = std::sqrt(23.0);
  const test::Graph graph = test::explore(*truss, down_to(*truss, 10.1), {.policy = BranchPolicy::all});
  ASSERT_EQ(graph.records.size(), 2U);
  const auto points = events_of(graph.branches[0], EventKind::branch_point);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(points[1].state.lambda, -points[0].state.lambda, 1e-9);
  EXPECT_TRUE(graph.records[1].mirror_image);
  EXPECT_EQ(graph.branches[1].end.reason, EndReason::reached_branch);
  double least = infinity, greatest = -infinity;
  for (const Arc& arc : graph.branches[1].arcs) {
    const Vec2 moved = test::displacement_of(*truss, arc.to.state, 1);
    const double u = moved.x(), z = 5.0 + moved.y();
    EXPECT_NEAR(u * u + z * z, radius * radius, 1e-9);
    EXPECT_NEAR(arc.to.state.lambda, 2.0 * z / (L * L * L), 1e-10);
    least = std::min(least, z);
    greatest = std::max(greatest, z);
  }
  EXPECT_NEAR(greatest, radius, 1e-9);
  EXPECT_LT(least, -0.9 * radius);
}

// `follow` comes to the second point along the sway branch, where λ turns and an eigenvalue touches zero, and goes on
// along the straight way that is stable from there on, P = EA z (h² − z²)/L³; not into the mirror image.
TEST(VonMisesTruss, FollowingGoesOnWhereTheSwayEnds) {
  const auto truss = steep(TrussStrain::green).structure();
  const double L = std::sqrt(26.0), radius = std::sqrt(23.0), load = 2.0 * radius / (L * L * L);
  const test::Graph graph = test::explore(*truss, down_to(*truss, 10.3), {.policy = BranchPolicy::most_stable});
  ASSERT_EQ(graph.records.size(), 3U);
  const Event met = only_event(graph.branches[1], EventKind::branch_point);
  EXPECT_EQ(met.branching->type, BranchType::pitchfork);
  EXPECT_FALSE(met.unconfirmed);
  EXPECT_TRUE(events_of(graph.branches[1], EventKind::limit_point).empty()) << "the pitchfork is the place";
  EXPECT_NEAR(met.state.lambda, -load, 1e-9 * load);
  EXPECT_NEAR(descent(*truss, met.state), 5.0 + radius, 1e-8);
  EXPECT_EQ(graph.branches[1].end.reason, EndReason::switched_branch);
  for (const EventKind kind : {EventKind::limit_point, EventKind::branch_point})
    EXPECT_TRUE(events_of(graph.branches[2], kind).empty());
  for (const Arc& arc : graph.branches[2].arcs) {
    const Vec2 moved = test::displacement_of(*truss, arc.to.state, 1);
    const double z = 5.0 + moved.y();
    // λ is level along the sway, so that its place on the branch that came is known to about the root of round-off.
    EXPECT_NEAR(moved.x(), 0.0, &arc == &graph.branches[2].arcs.front() ? 1e-7 : 1e-9);
    EXPECT_NEAR(arc.to.state.lambda, z * (25.0 - z * z) / (L * L * L), 1e-10);
    if (&arc != &graph.branches[2].arcs.front()) {
      EXPECT_EQ(arc.to.count.unstable, Index{0});
    }
  }
  const Event& start = graph.branches[2].arcs.front().events.front();
  EXPECT_FALSE(start.unstable_before) << "K is singular there";
  EXPECT_EQ(start.unstable_after, Index{0});
  EXPECT_EQ(graph.branches[2].end.reason, EndReason::stop);
}

}  // namespace arcwall::von_mises_truss_test
