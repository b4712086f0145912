#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "contact/sliding/unknowns.hpp"
#include "core/derivative_check.hpp"
#include "tests/support/branch.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/sliding_models.hpp"

// Selke & Kikuchi's two examples with contact points that slide along the body: the classic beam then converges with
// order four to the extensible elastica, contact forces being point forces. Expected values are those of the extensible
// elastica between its contacts, by shooting and by quadrature of its first integral, which agree in all digits given.
namespace arcwall::sliding_channel_test {

namespace {

using test::ExploredBranch;
using test::SlidingChannel;
using test::SlidingModel;
using Component = MemberObservable::Component;

constexpr double buckling = 0.432686705811, touch = 0.435739888353, spreads = 1.726295916538,
                 flat_buckles = 7.003081493782, least_shortening = 6.214791656, crosses = 4.905879279,
                 lower_touch = 4.253608535128, lines = 14.8210269646;

TraceOptions until(double lambda) {
  TraceOptions options;
  options.step.first = 0.05;
  options.target_values = {test::stop_at_lambda(-1.0), test::stop_at_lambda(lambda)};
  return options;
}

SlidingModel channel(int elements, std::vector<SineDeviation> imperfection = {},
                     ContinuumChoice continuum = ContinuumChoice::symmetric) {
  return SlidingChannel{.members = {{2.0, elements}}, .imperfection = std::move(imperfection), .continuum = continuum}
      .model();
}

std::shared_ptr<const Observable> middle(const SlidingModel& model) { return model.at("0", 0.5, Component::z); }

double shortening(const SlidingModel& model, const State& state) { return -model.joint(1, Dof::x)->value(state); }

// The perfect column's whole path: straight, on the upper wall, crossing the channel, on both walls.
struct PerfectChannel {
  SlidingModel model;
  TraceOptions options;
  std::vector<ExploredBranch> branches;

  explicit PerfectChannel(int elements, double to = 10.0, ContinuumChoice continuum = ContinuumChoice::symmetric)
      : model(channel(elements, {}, continuum)), options(until(to)) {
    options.target_values.push_back({.quantity = middle(model), .value = 0.0});
    branches = test::follow(model.system(), model.system().rest(), options, {middle(model)},
                            {{.quantity = model.joint(1, Dof::x), .label = "shortening"}});
  }

  // λ of every event that has an expected value, in order.
  std::vector<double> loads() const {
    std::vector<double> found;
    for (const Event& event : test::events_of(branches)) found.push_back(event.state.lambda);
    found.push_back(at_middle()->state.lambda);
    return found;
  }

  // The point at which the middle crosses the channel's axis.
  const PathPoint* at_middle() const {
    for (const Arc& arc : branches.back().arcs)
      if (std::abs(middle(model)->value(arc.to.state)) < 1e-12) return &arc.to;
    return nullptr;
  }
};

const std::vector<EventKind> kinds{EventKind::branch_point,       EventKind::contact_closes, EventKind::contact_spreads,
                                   EventKind::branch_point,       EventKind::turning_point,  EventKind::contact_closes,
                                   EventKind::contact_limit_point};
const std::vector<double> expected{buckling,         touch,       spreads,     flat_buckles,
                                   least_shortening, lower_touch, lower_touch, crosses};

}  // namespace

TEST(SlidingChannelEvents, ConvergeWithOrderFour) {
  const std::vector<int> meshes{10, 20, 40, 80};
  std::vector<double> sizes;
  std::map<std::size_t, std::vector<double>> errors;
  for (const int elements : meshes) {
    const PerfectChannel found(elements);
    std::vector<EventKind> in_order;
    for (const Event& event : test::events_of(found.branches)) in_order.push_back(event.kind);
    ASSERT_EQ(in_order, kinds) << elements << " elements";
    ASSERT_NE(found.at_middle(), nullptr);
    sizes.push_back(1.0 / elements);
    for (std::size_t i = 0; i < expected.size(); ++i) errors[i].push_back(found.loads()[i] / expected[i] - 1.0);
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE("event " + std::to_string(i) + ", lambda = " + std::to_string(expected[i]));
    EXPECT_GE(test::observed_order(sizes, errors[i]), 3.8);
    EXPECT_LE(std::abs(errors[i].back()), 1e-7);
  }
}

TEST(SlidingChannelEvents, HaveTheShapesOfTheElastica) {
  const PerfectChannel found(80);
  const auto events = test::events_of(found.branches);
  const auto expect = [&](std::size_t i, double mid, double shorter) {
    EXPECT_NEAR(middle(found.model)->value(events[i].state), mid, 1e-6) << "event " << i;
    EXPECT_NEAR(shortening(found.model, events[i].state), shorter, 1e-6) << "event " << i;
  };
  expect(0, 0.0, 0.004120825769);
  expect(1, 0.15, 0.032153206553);
  expect(2, 0.15, 0.051044717737);
  expect(3, 0.15, 0.142961858290);
  expect(4, 0.110490974, 0.136360582166);
  expect(5, -0.15, 0.313645142120);
  // Between the touch and the flat part's buckling the middle stays on the wall; there the flat part is 1.0102276 long
  // and each of its ends pushes with 2.3860594.
  const SlidingContact& system = found.model.system();
  const State& flat = events[3].state;
  const Vector s = flat.x.tail(mesh_of(flat).breakpoints());
  ASSERT_EQ(s.size(), 2);
  EXPECT_NEAR(s[1] - s[0], 1.010227594814, 1e-6);
  EXPECT_NEAR(s[0] + s[1], 2.0, 1e-8);
  for (const Index end : {0, 1}) EXPECT_NEAR(system.force(flat, end), 2.386059449746, 1e-6);
}

// Theory of the second variation: 0 on the stable arcs, 1 on the bulged arc that the flat part's buckling leads to.
TEST(SlidingChannelEvents, CountUnstableDirections) {
  const PerfectChannel found(20);
  ASSERT_EQ(found.branches.size(), 3U);
  EXPECT_EQ(test::events_of(found.branches)[0].branching->type, BranchType::pitchfork);
  EXPECT_TRUE(found.branches[1].record.mirror_image);
  const Event buckles = test::events_of(found.branches)[3];
  EXPECT_EQ(buckles.branching->type, BranchType::one_sided);
  EXPECT_EQ(buckles.branching->multiplicity, 1);
  bool lower = false;
  for (std::size_t b = 0; b < found.branches.size(); ++b) {
    const auto& arcs = found.branches[b].arcs;
    EXPECT_EQ(found.branches[b].record.end->reason, b == 2 ? EndReason::stop : EndReason::switched_branch);
    for (std::size_t i = 1; i < arcs.size(); ++i) {
      if (b < 2 && i + 1 == arcs.size()) continue;  // singular
      const PathPoint& to = arcs[i].to;
      lower = lower || middle(found.model)->value(to.state) < -0.1499;
      EXPECT_EQ(to.count.unstable, b == 2 && !lower ? 1 : 0) << "branch " << b << ", lambda = " << to.state.lambda;
    }
  }
  EXPECT_TRUE(lower);
}

// Every arc between events is monotone in λ: no teeth.
TEST(SlidingChannelEvents, LeaveTheLoadMonotoneBetweenThem) {
  for (const int elements : {10, 20, 40, 80}) {
    const PerfectChannel found(elements);
    for (std::size_t b = 0; b < found.branches.size(); ++b) {
      double sign = b == 2 ? -1.0 : 1.0;  // the bulged arc falls, up to the lower wall
      const auto& arcs = found.branches[b].arcs;
      for (std::size_t i = 1; i < arcs.size(); ++i) {
        const double rise = arcs[i].to.state.lambda - arcs[i - 1].to.state.lambda;
        EXPECT_GT(sign * rise, 0.0) << elements << " elements, lambda = " << arcs[i].to.state.lambda;
        for (const Event& event : arcs[i].events)
          if (event.kind == EventKind::contact_limit_point) sign = -sign;
      }
    }
  }
}

TEST(SlidingChannelEvents, KeepTheInvariants) {
  const PerfectChannel found(20);
  for (const ExploredBranch& branch : found.branches)
    test::expect_sliding_invariants(found.model.system(), branch.arcs, found.options, branch.lambda_scale);
}

// Beyond 14.821 the three contacts are lines, of whose lengths only the sum is determined. A path may end there.
TEST(SlidingChannelEvents, EndBeforeAContinuumIfToldSo) {
  std::vector<double> ends;
  for (const int elements : {20, 40, 80}) {
    const PerfectChannel found(elements, 20.0, ContinuumChoice::stop);
    const BranchEnd& end = *found.branches.back().record.end;
    EXPECT_EQ(end.reason, EndReason::equilibrium_family);
    ASSERT_TRUE(end.continuum.has_value());
    EXPECT_EQ(end.continuum->parts, 3);
    EXPECT_EQ(end.continuum->length, 0.0);  // all three are points yet
    EXPECT_EQ(end.continuum->energy, found.model.system().energy(found.branches.back().arcs.back().to.state));
    const auto events = test::events_of(found.branches);
    std::vector<EventKind> in_order;
    for (const Event& event : events) in_order.push_back(event.kind);
    EXPECT_EQ(in_order, kinds) << elements << " elements";
    ends.push_back(found.branches.back().arcs.back().to.state.lambda / lines - 1.0);
  }
  EXPECT_LE(std::abs(ends[2]), 1e-6);
  EXPECT_GE(test::observed_order({4.0, 2.0, 1.0}, ends), 3.8);
}

namespace {

// Three flat parts of a pinned column, at the last point of its path: upper, lower, upper.
struct ThreeParts {
  std::array<double, 3> lengths{};
  double before = 0.0, behind = 0.0;  // what is left at the ends
};

ThreeParts three_parts(const State& state) {
  ThreeParts parts;
  const Vector s = state.x.tail(mesh_of(state).breakpoints());
  EXPECT_EQ(s.size(), 6);
  if (s.size() != 6) return parts;
  for (std::size_t i = 0; i < 3; ++i) parts.lengths[i] = s[2 * Index(i) + 1] - s[2 * Index(i)];
  parts.before = s[0];
  parts.behind = 2.0 - s[5];
  return parts;
}

}  // namespace

// In the continuum the path keeps to the member that is symmetric, as the column was where it began.
TEST(SlidingChannelEvents, GoOnWithTheSymmetricMemberOfAContinuum) {
  const PerfectChannel found(20, 17.0);
  EXPECT_EQ(found.branches.back().record.end->reason, EndReason::stop);
  const auto events = test::events_of(found.branches);
  ASSERT_EQ(events.size(), kinds.size() + 1);
  const Event& spreading = events.back();
  EXPECT_EQ(spreading.kind, EventKind::contact_spreads);
  EXPECT_EQ(spreading.guards.size(), 3U);
  ASSERT_TRUE(spreading.continuum.has_value());
  EXPECT_EQ(spreading.continuum->parts, 3);
  EXPECT_EQ(spreading.continuum->length, 0.0);
  EXPECT_FALSE(spreading.unstable_after.has_value());  // neutral to the second order
  const SlidingContact& system = found.model.system();
  const State& last = found.branches.back().arcs.back().to.state;
  EXPECT_NEAR(last.lambda, 17.0, 1e-12);
  const ThreeParts parts = three_parts(last);
  EXPECT_GT(parts.lengths[0], 0.05);
  for (const double length : parts.lengths) EXPECT_NEAR(length, parts.lengths[0], 1e-10);
  EXPECT_NEAR(parts.before, parts.behind, 1e-8);
  EXPECT_GE(system.least_gap(last, 10), -1e-9);
  State beside = last;  // where neither moments nor forces of the neutral spans are round-off
  for (Index i = 0; i < beside.x.size(); ++i) beside.x[i] += 1e-3 * std::sin(1.0 + 2.0 * double(i));
  const SlidingUnknowns index(beside.active_set);
  for (std::size_t span = 0; span < 2; ++span) beside.x[index.holding_force(span)] = 1e-7;
  EXPECT_LE(check_derivatives(system, beside, 1e-6).worst(), 1e-6);
}

// A loose span has neither moment nor slope at its ends, a height of 0.3 between them, and is antisymmetric: between
// its ends and its middle, which are its inflections, it turns by 2 β. By the first integral of the extensible
// elastica, with the resultant R at the angle β,
//
//     ½ EI κ² = R (cos φ − cos β) [1 − R (cos φ + cos β)/2EA],     P = R cos β,
//
// φ from −β to β. Quadrature gives its length and height, and a span to a pinned end is half of one. So at P = 17 the
// sum of the three lengths is 0.16351457603; no β makes P greater than 18.7729113084, where both spans turn at once.
TEST(SlidingChannelEvents, ReachTheGreatestLoadOfAContinuum) {
  std::vector<double> sums, greatest;
  for (const int elements : {20, 40, 80}) {
    const SlidingModel model = channel(elements);
    TraceOptions options = until(20.0);
    options.target_values.push_back(test::stop_at_lambda(17.0));
    options.target_values.back().stops = false;
    const auto branches = test::follow(model.system(), model.system().rest(), options, {middle(model)});
    const auto has_continuum = [](const Arc& arc) {
      return std::any_of(arc.events.begin(), arc.events.end(), [](const Event& event) { return event.continuum; });
    };
    const auto branch = std::find_if(branches.begin(), branches.end(), [&](const auto& one) {
      return std::any_of(one.arcs.begin(), one.arcs.end(), has_continuum);
    });
    ASSERT_NE(branch, branches.end());
    const auto& arcs = branch->arcs;
    const auto begins = std::find_if(arcs.begin(), arcs.end(), has_continuum);
    const auto at_17 =
        std::find_if(begins, arcs.end(), [](const Arc& arc) { return std::abs(arc.to.state.lambda - 17.0) <= 1e-12; });
    ASSERT_NE(at_17, arcs.end());
    double sum = 0.0;
    for (const double length : three_parts(at_17->to.state).lengths) sum += length;
    sums.push_back(sum - 0.16351457603);
    const auto last = std::max_element(
        begins, arcs.end(), [](const Arc& a, const Arc& b) { return a.to.state.lambda < b.to.state.lambda; });
    greatest.push_back(last->to.state.lambda / 18.7729113084 - 1.0);
  }
  EXPECT_LE(std::abs(sums.back()), 1e-6);
  EXPECT_GE(test::observed_order({4.0, 2.0, 1.0}, sums), 3.5);
  EXPECT_LE(std::abs(greatest.back()), 1e-6);
  EXPECT_GE(test::observed_order({4.0, 2.0, 1.0}, greatest), 3.5);
}

// In small slopes k² = P Λ/EI, Λ = 1 − P/EA. A span from a pinned end, without moment, to a flat part, without slope
// and moment, has w = C (sin k s + k s) and is half a wave long, k l = π; one from a flat part on one wall to one on
// the other is a whole wave long, k l = 2π. Three flat parts leave two of either: L − 6 π/k is the sum of their
// lengths, but for the square of the slopes, that is of the gap.
TEST(SlidingChannelEvents, LeaveAllLengthButThreeWavesToThreeFlatParts) {
  std::vector<double> errors;
  for (const double gap : {0.02, 0.01}) {
    const SlidingModel model = SlidingChannel{.members = {{2.0, 40}}, .upper = gap, .lower = gap}.model();
    const auto branches = test::follow(model.system(), model.system().rest(), until(20.0), {middle(model)});
    ASSERT_EQ(branches.back().record.end->reason, EndReason::stop);
    const State& last = branches.back().arcs.back().to.state;
    ASSERT_NEAR(last.lambda, 20.0, 1e-12);
    double sum = 0.0;
    for (const double length : three_parts(last).lengths) sum += length;
    const double k = std::sqrt(20.0 * (1.0 - 20.0 / 210.0) / 0.175);
    errors.push_back(sum / (2.0 - 6.0 * pi / k) - 1.0);
  }
  EXPECT_LE(std::abs(errors[1]), 1e-2);
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.1);
}

// A half sine of 0.00176 presses the flat part onto the wall: it never buckles. Touch: 0.430656908534.
TEST(SlidingChannelHalfSine, StaysOnTheWall) {
  std::vector<double> at_ten;
  for (const int elements : {20, 40}) {
    const SlidingModel model = channel(elements, {{.amplitude = 0.00176}});
    const TraceOptions options = until(10.0);
    const auto branches = test::follow(model.system(), model.system().rest(), options);
    ASSERT_EQ(branches.size(), 1U);
    EXPECT_EQ(branches[0].record.end->reason, EndReason::stop);
    const auto events = test::events_of(branches);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].kind, EventKind::contact_closes);
    EXPECT_NEAR(events[0].state.lambda, 0.430656908534, 2e-6 * std::pow(20.0 / elements, 4));
    EXPECT_EQ(events[1].kind, EventKind::contact_spreads);
    for (const Arc& arc : branches[0].arcs) EXPECT_EQ(arc.to.count.unstable, 0) << arc.to.state.lambda;
    const State& last = branches[0].arcs.back().to.state;
    EXPECT_NEAR(last.lambda, 10.0, 1e-12);
    EXPECT_NEAR(middle(model)->value(last), 0.15, 1e-9);
    test::expect_sliding_invariants(model.system(), branches[0].arcs, options, branches[0].lambda_scale);
  }
}

// With a third harmonic that bends the middle off the wall there is one smooth maximum. The reference, 6.863204701 at
// mid 0.146860, is for an arc length of 2 instead of a chord of 2: relative differences of 4e-6.
TEST(SlidingChannelThirdHarmonic, HasOneLimitPoint) {
  std::vector<double> limits;
  for (const int elements : {20, 40, 80}) {
    const SlidingModel model = channel(elements, test::snapping_imperfection());
    const TraceOptions options = until(10.0);
    const auto branches = test::follow(model.system(), model.system().rest(), options);
    ASSERT_EQ(branches.size(), 1U);
    EXPECT_EQ(branches[0].record.end->reason, EndReason::stop);
    std::vector<EventKind> in_order;
    const auto events = test::events_of(branches);
    for (const Event& event : events) in_order.push_back(event.kind);
    ASSERT_EQ(in_order, (std::vector{EventKind::contact_closes, EventKind::contact_splits, EventKind::limit_point,
                                     EventKind::contact_closes, EventKind::contact_limit_point}));
    EXPECT_NEAR(middle(model)->value(events[2].state), 0.146860, 1e-5);
    EXPECT_EQ(events[2].unstable_before, 0);
    EXPECT_EQ(events[2].unstable_after, 1);
    EXPECT_EQ(branches[0].arcs.back().to.count.unstable, 0);
    limits.push_back(events[2].state.lambda);
    if (elements == 20)
      test::expect_sliding_invariants(model.system(), branches[0].arcs, options, branches[0].lambda_scale);
  }
  EXPECT_NEAR(limits[2], 6.863204701, 4e-6 * limits[2]);
  EXPECT_GE(std::log2((limits[0] - limits[1]) / (limits[1] - limits[2])), 3.8);
}

// The shortest stretch of contact is a thousandth of the member: here it has several elements from the start.
TEST(SlidingChannelThirdHarmonic, SplitsOnMeshesFinerThanTheShortestStretchSlow) {
  const SlidingModel model = channel(1280, test::snapping_imperfection());
  const auto branches = test::follow(model.system(), model.system().rest(), until(7.5));
  ASSERT_EQ(branches.size(), 1U);
  const auto events = test::events_of(branches);
  ASSERT_GE(events.size(), 3U);
  EXPECT_EQ(events[1].kind, EventKind::contact_splits);
  EXPECT_EQ(events[2].kind, EventKind::limit_point);
  EXPECT_NEAR(events[2].state.lambda, 6.863204701, 4e-6 * events[2].state.lambda);
}

// A point contact from 0.448961073442, a line from 1.34307213737; at M₀ = 5 and 10 the flat part reaches 0.4818518221
// and 0.6330999632 from the middle to each side, the floor bears 19.7690983 and 57.5371015. Already at 10 elements the
// errors are below 3e-6, where the classic beam has a remainder of order two (extension under large shear forces).
TEST(SlidingFoundation, FindsTheFlatPartAndItsForces) {
  struct Expected {
    double moment, half_length, force;
  };
  const Expected expect[] = {{5.0, 0.4818518221, 19.7690983}, {10.0, 0.6330999632, 57.5371015}};
  std::vector<double> sizes, spreading, lengths, forces;
  for (const int elements : {10, 20, 40}) {
    const SlidingModel model = test::SlidingFoundation{.elements = elements}.model();
    TraceOptions options = until(10.0);
    options.target_values.push_back({.quantity = std::make_shared<ParameterValue>(), .value = 5.0});
    const auto branches = test::follow(model.system(), model.system().rest(), options);
    ASSERT_EQ(branches.size(), 1U);
    const auto events = test::events_of(branches);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].kind, EventKind::contact_closes);
    EXPECT_NEAR(events[0].state.lambda, 0.448961073442, 1e-9);  // circles are exact to the fourth order in slopes
    EXPECT_EQ(events[1].kind, EventKind::contact_spreads);
    sizes.push_back(1.0 / elements);
    spreading.push_back(events[1].state.lambda / 1.34307213737 - 1.0);
    for (const Expected& e : expect) {
      const auto& arcs = branches[0].arcs;
      const auto at = std::find_if(arcs.begin(), arcs.end(),
                                   [&](const Arc& arc) { return std::abs(arc.to.state.lambda - e.moment) < 1e-11; });
      ASSERT_NE(at, arcs.end());
      const State& state = at->to.state;
      const Vector s = state.x.tail(mesh_of(state).breakpoints());
      ASSERT_EQ(s.size(), 2);
      EXPECT_NEAR(s[0] + s[1], 2.0, 1e-8);
      lengths.push_back(0.5 * (s[1] - s[0]) / e.half_length - 1.0);
      forces.push_back((model.system().force(state, 0) + model.system().force(state, 1)) / e.force - 1.0);
      if (elements >= 20) {
        EXPECT_LE(std::abs(lengths.back()), 1e-6);
        EXPECT_LE(std::abs(forces.back()), 1e-6);
      }
    }
    test::expect_sliding_invariants(model.system(), branches[0].arcs, options, branches[0].lambda_scale);
  }
  EXPECT_LE(std::abs(spreading[0]), 1e-8);
  EXPECT_LE(std::abs(spreading[1]), 1e-9);
  for (const std::size_t moment : {0U, 1U}) {
    std::vector<double> length_errors, force_errors;
    for (std::size_t mesh = 0; mesh < sizes.size(); ++mesh) {
      length_errors.push_back(lengths[2 * mesh + moment]);
      force_errors.push_back(forces[2 * mesh + moment]);
    }
    EXPECT_GE(test::observed_order(sizes, length_errors), 1.9);
    EXPECT_GE(test::observed_order(sizes, force_errors), 1.9);
  }
}

// A small imperfection singles one equilibrium of the continuum out: behind λ = 14.82 two contacts become stretches,
// then the third. The corrections behind that are long, since little resists an exchange of lengths between the three.
TEST(NearlyPerfectChannel, AllThreeContactsBecomeStretchesOneAfterTheOtherSlow) {
  std::vector<double> upper, lower;
  for (const int elements : {40, 80, 160}) {
    const SlidingModel model = channel(elements, {{.amplitude = 2e-3, .waves = 1}, {.amplitude = 3e-4, .waves = 3}});
    const auto branches = test::follow(model.system(), model.system().rest(), until(18.0), {middle(model)});
    EXPECT_EQ(branches.back().record.end->reason, EndReason::stop) << elements << " elements";
    upper.push_back(test::event_of(branches, EventKind::contact_spreads, 0).state.lambda);
    lower.push_back(test::event_of(branches, EventKind::contact_spreads, 1).state.lambda);
  }
  for (const auto& loads : {upper, lower})
    EXPECT_NEAR(std::log2(std::abs((loads[1] - loads[0]) / (loads[2] - loads[1]))), 4.0, 0.3);  // order four
  EXPECT_NEAR(upper.back(), lines, 0.005 * lines);                                              // of the perfect column
  EXPECT_GT(lower.back(), upper.back());
}

// Beyond the load at which the flat parts buckle the path comes back, and the stretch on the lower wall becomes a point
// at the load at which it began: from there on the path is another than that which led to it.
TEST(NearlyPerfectChannel, IsFollowedBackFromTheBucklingOfItsFlatParts) {
  const SlidingModel model = channel(40, {{.amplitude = 2e-3, .waves = 1}, {.amplitude = 3e-4, .waves = 3}});
  const auto branches = test::follow(model.system(), model.system().rest(), until(60.0), {middle(model)});
  const double began = test::event_of(branches, EventKind::contact_spreads, 1).state.lambda;
  EXPECT_NEAR(test::event_of(branches, EventKind::contact_shrinks).state.lambda, began, 1e-8);
  for (const Event& event : test::events_of(branches)) {
    if (event.kind == EventKind::contact_limit_point) {
      EXPECT_LT(event.state.lambda, 5.0);
    }
  }
  EXPECT_LT(branches.back().arcs.back().to.state.lambda, 14.0);
}

}  // namespace arcwall::sliding_channel_test
