#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "continuation/explorer.hpp"
#include "elements/member_point.hpp"
#include "tests/support/branch.hpp"
#include "tests/support/models.hpp"

// Branch points and the branches behind them. Loads of the arches: shooting with adaptive Taylor series, confirmed by
// collocation. Columns: P (1 − P/EA) = n² π² EI/L², and the elliptic integrals of the inextensible elastica.
namespace arcwall {

namespace {

struct Explored {
  std::vector<BranchRecord> branches;
  std::map<int, std::vector<Event>> events;
  std::map<int, std::vector<PathPoint>> points;
};

Explored explore(const System& system, const TraceOptions& trace, const ExploreOptions& options) {
  Explorer explorer(system, test::rest(system), trace, {}, options);
  Explored result;
  while (auto step = explorer.next()) {
    for (Event& event : step->arc.events) result.events[step->branch].push_back(event);
    result.points[step->branch].push_back(std::move(step->arc.to));
  }
  result.branches = explorer.branches();
  return result;
}

std::vector<Event> of_kind(const std::vector<Event>& events, EventKind kind) {
  std::vector<Event> found;
  for (const Event& event : events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

// A pinned column of length 1 and EI = 1, compressed by λ.
std::unique_ptr<Structure> column(double EA, int elements) {
  StructureBuilder builder;
  const Index a = builder.add_joint({0.0, 0.0}), b = builder.add_joint({1.0, 0.0});
  builder.add_member({.name = "column",
                      .from = a,
                      .to = b,
                      .axis = straight_axis({0.0, 0.0}, {1.0, 0.0}),
                      .section = {.E = EA, .A = 1.0, .I = 1.0 / EA},
                      .elements = elements});
  builder.fix(builder.freedom(a, Freedom::x));
  builder.fix(builder.freedom(a, Freedom::z));
  builder.fix(builder.freedom(b, Freedom::z));
  builder.add_load(builder.freedom(b, Freedom::x), -1.0, LoadKind::proportional);
  return builder.build();
}

// Pinned semicircle, R = 127, EA = 1378·64.52, EI = 1378·41.62, λ downwards at the crown.
std::unique_ptr<Structure> semicircle(int elements) {
  const double R = 127.0, c = R * std::sqrt(0.5);
  StructureBuilder builder;
  const Index left = builder.add_joint({-R, 0.0}), crown = builder.add_joint({0.0, R}),
              right = builder.add_joint({R, 0.0});
  const Section section{.E = 1378.0, .A = 64.52, .I = 41.62};
  builder.add_member({.name = "west",
                      .from = left,
                      .to = crown,
                      .axis = arc_axis({-R, 0.0}, {-c, c}, {0.0, R}),
                      .section = section,
                      .elements = elements});
  builder.add_member({.name = "east",
                      .from = crown,
                      .to = right,
                      .axis = arc_axis({0.0, R}, {c, c}, {R, 0.0}),
                      .section = section,
                      .elements = elements});
  for (const Index end : {left, right})
    for (const Freedom which : {Freedom::x, Freedom::z}) builder.fix(builder.freedom(end, which));
  builder.add_load(builder.freedom(crown, Freedom::z), -1.0, LoadKind::proportional);
  return builder.build();
}

TEST(PinnedColumn, HasItsBranchPointsWithTheirCounts) {
  const double EA = 1000.0;
  const auto structure = column(EA, 40);
  TraceOptions trace;
  trace.step.first = 1.0;
  trace.landmarks = {test::stop_at_lambda(170.0)};
  const Explored found = explore(*structure, trace, {.policy = BranchPolicy::primary});

  const auto points = of_kind(found.events.at(0), EventKind::branch_point);
  ASSERT_EQ(points.size(), 3U);
  for (Index n = 1; n <= 3; ++n) {
    const Event& event = points[static_cast<std::size_t>(n - 1)];
    const double euler = double(n * n) * pi * pi;
    const double load = 0.5 * EA * (1.0 - std::sqrt(1.0 - 4.0 * euler / EA));  // P (1 − P/EA) = n² π²
    // The element's error: (π n/40)⁴/720 relative, amplified by the factor that the stretch adds.
    EXPECT_NEAR(event.state.lambda, load, 2.0 * load * std::pow(pi * double(n) / 40.0, 4) / 720.0 + 1e-9);
    EXPECT_EQ(event.branching->type, BranchType::symmetric);
    EXPECT_EQ(event.branching->multiplicity, 1);
    EXPECT_EQ(event.unstable_before, n - 1);
    EXPECT_EQ(event.unstable_after, n);
    EXPECT_LE(event.localised, 1e-10 * load);
  }
}

// Elliptic integrals: P/P_E at end angles of 20°, 40° and 60°.
TEST(PinnedColumn, FollowsTheElasticaBehindTheEulerLoad) {
  const auto structure = column(4e7, 40);
  const Index rotation = *structure->members()[0].rotations[0];
  const auto angle = std::make_shared<FreedomObservable>(*structure, rotation);
  TraceOptions trace;
  trace.step.first = 1.0;
  for (const double degrees : {20.0, 40.0, 60.0}) {
    const double radians = degrees * pi / 180.0;
    trace.landmarks.push_back({.quantity = angle, .value = radians, .stops = degrees == 60.0, .label = "angle"});
  }
  trace.landmarks.push_back(test::stop_at_lambda(30.0));
  const Explored found = explore(*structure, trace, {.policy = BranchPolicy::follow, .preference = {angle}});

  ASSERT_EQ(found.branches.size(), 2U);
  EXPECT_EQ(found.branches[0].end->reason, EndReason::branched);
  EXPECT_TRUE(found.branches[1].mirrored);
  const std::map<double, double> expected{
      {20.0, 10.021565372982778}, {40.0, 10.497935655332741}, {60.0, 11.367017035003174}};
  std::size_t met = 0;
  for (const PathPoint& point : found.points.at(1))
    for (const auto& [degrees, load] : expected)
      if (std::abs(angle->value(point.state) - degrees * pi / 180.0) < 1e-10) {
        ++met;
        EXPECT_NEAR(point.state.lambda / load, 1.0, 1e-6) << degrees;
        EXPECT_EQ(point.count.unstable, Index{0});
      }
  EXPECT_EQ(met, expected.size());
}

TEST(PinnedSemicircle, SwaysBeforeItsLimitPointToBothSidesAlike) {
  const auto structure = semicircle(48);
  const Index crown = 1;
  const auto w = test::displacement(*structure, crown, Freedom::z);
  TraceOptions trace;
  trace.step.first = 1.0;
  trace.landmarks = {{.quantity = w, .value = -150.0, .stops = true, .label = "w"}};
  const Explored found = explore(*structure, trace, {.policy = BranchPolicy::all, .depth = 1});

  ASSERT_EQ(found.branches.size(), 2U);
  EXPECT_TRUE(found.branches[1].mirrored);
  EXPECT_EQ(found.branches[1].parent, 0);
  const auto sway = of_kind(found.events.at(0), EventKind::branch_point);
  ASSERT_EQ(sway.size(), 1U);
  // c h⁴ with 48 elements a half: 6e-8 relative was seen, half of the tolerance.
  EXPECT_NEAR(sway[0].state.lambda, 20.8420786502809, 20.84 * 1.2e-7);
  EXPECT_EQ(sway[0].branching->type, BranchType::symmetric);
  const auto limit = of_kind(found.events.at(1), EventKind::limit_point);
  ASSERT_EQ(limit.size(), 1U);
  EXPECT_NEAR(limit[0].state.lambda, 27.6290182852711, 27.63 * 1.2e-7);
  EXPECT_NEAR(std::abs(structure->value(limit[0].state.x, structure->freedom(crown, Freedom::x))), 66.6164258550, 1e-3);
  EXPECT_NEAR(w->value(limit[0].state), -92.3234990050, 1e-3);
}

// Node contact, so only the order of things is the continuum's: Euler load, upper wall, snap, lower wall, λ = 10.
TEST(PerfectChannel, IsFollowedToTheLowerWallWithoutCycling) {
  for (const int elements : {20, 40}) {
    const test::ContactModel model = test::Channel{.elements = elements}.model();
    const MemberMesh& mesh = model.structure().members()[0];
    const auto middle = std::make_shared<MemberObservable>(
        model.structure(), mesh, static_cast<std::size_t>(elements) / 2, MemberObservable::Component::z);
    TraceOptions trace;
    trace.step.first = 0.05;
    trace.tied_contacts = true;
    trace.landmarks = {test::stop_at_lambda(10.0)};
    const Explored found = explore(model.system(), trace, {.policy = BranchPolicy::follow, .preference = {middle}});

    ASSERT_EQ(found.branches.size(), 2U);
    const auto euler = of_kind(found.events.at(0), EventKind::branch_point);
    ASSERT_EQ(euler.size(), 1U);
    EXPECT_NEAR(euler[0].state.lambda, 0.432686705811397, 1e-6);  // P (1 − P/EA) = P_E
    const auto closes = of_kind(found.events.at(1), EventKind::contact_closes);
    ASSERT_FALSE(closes.empty());
    EXPECT_NEAR(closes[0].state.lambda, 0.435739888353, 2e-6);  // the extensible elastica touches, shooting
    EXPECT_EQ(found.branches[1].end->reason, EndReason::stop);
    EXPECT_NEAR(found.points.at(1).back().state.lambda, 10.0, 1e-12);
    EXPECT_NEAR(middle->value(found.points.at(1).back().state), -0.15, 1e-12);
    for (const Event& event : of_kind(found.events.at(1), EventKind::branch_point))
      EXPECT_TRUE(event.branching->discretisation);
  }
}

}  // namespace

}  // namespace arcwall
