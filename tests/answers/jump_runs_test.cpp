// Runs that go on after jumps, as loading tests do, against closed forms, shooting and the whole path cut at the loads
// of the jumps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "answers/find_event.hpp"
#include "answers/path_at_lambda.hpp"
#include "answers/sessions.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/exit_status.hpp"
#include "tests/apps/deck_texts.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::jump_runs_test {

using namespace test::tables;
namespace {

using test::TracedDeck;

// A bistable cell: a bar of EA over a half-span b, risen by h₀ = 1, with a spring of stiffness k beside it. Squeezed to
// a rise h it carries λ = c h (1 − h²) + k (1 − h), c = EA/(2 L³).
struct Cell {
  static constexpr double half_span = 10.0, EA = 1e4;
  double k = 0.0;

  static double c() { return EA / (2.0 * std::pow(half_span * half_span + 1.0, 1.5)); }
  double load(double h) const { return c() * h * (1.0 - h * h) + k * (1.0 - h); }
  double energy(double h) const {
    const double strained = h * h - 1.0, closed = 1.0 - h;
    return 0.25 * c() * strained * strained + 0.5 * k * closed * closed;
  }
  double rise_at_snap() const { return std::sqrt((1.0 - k / c()) / 3.0); }
  double snap_load() const { return load(rise_at_snap()); }
  // At a load, before the snap and after it: the load falls with h there.
  double rise(double at, bool snapped) const {
    double low = snapped ? -2.0 : rise_at_snap(), high = snapped ? -rise_at_snap() : 1.0;
    for (int i = 0; i < 200; ++i) {
      const double h = 0.5 * (low + high);
      (load(h) > at ? low : high) = h;
    }
    return 0.5 * (low + high);
  }
};

// Cells on each other, the strongest at the top: one after the other snaps from below, each once on the whole path.
constexpr int cell_count = 10;
Cell cell(int i) { return {.k = 0.1 * (i + 1)}; }

std::string chain_of_cells(const std::string& branches) {
  std::string points, members, springs, supports, monitors;
  for (int i = 0; i <= cell_count; ++i) {
    points += fmt::format("p{} = [{}, {}.0]\n", i, i % 2 == 0 ? "0.0" : "10.0", i);
    supports += fmt::format("p{} = [\"x\"{}]\n", i, i == 0 ? ", \"z\"" : "");
    if (i == 0) continue;
    members += fmt::format(
        "[member.bar{}]\nfrom = \"p{}\"\nto = \"p{}\"\ntheory = \"truss\"\nstrain = \"green\"\nelements = 1\nmaterial "
        "= "
        "\"m\"\nsection = \"s\"\n",
        i, i - 1, i);
    springs +=
        fmt::format("[[spring]]\nbetween = [\"p{}\", \"p{}\"]\nstiffness = {{ z = {} }}\n", i - 1, i, cell(i - 1).k);
    monitors += fmt::format("[[monitor]]\nname = \"z{}\"\nat = \"p{}\"\ncomponent = \"z\"\n", i, i);
  }
  return "title = \"Ten bistable cells\"\nmaterial.m = { E = 1e4 }\nsection.s = { shape = \"general\", A = 1.0, I = "
         "1.0 }\n"
         "load = [{ at = \"p10\", force = [0.0, -1.0] }]\n[point]\n" +
         points + "[support]\n" + supports + members + springs + monitors + "[path]\nstep = 0.1\nbranches = \"" +
         branches + "\"\nstop.lambda = [-5.0, 3.0]\n";
}

// The rise of each cell, from the monitors, which are the displacements of the points.
double rise_of(const std::vector<double>& monitors, int i) {
  const auto k = static_cast<std::size_t>(i);
  return 1.0 + monitors[k] - (i > 0 ? monitors[k - 1] : 0.0);
}

// The stable states of a traced path at a λ that lie behind an event, in the path's order.
std::vector<State> stable_behind(const TracedDeck& traced, const RecordEvent& event) {
  std::vector<State> found;
  for (const std::size_t point : crossings(traced.record(), event.lambda)) {
    if (static_cast<Index>(point) <= event.step) continue;
    const auto there = at_crossing(traced.model(), traced.record(), point, event.lambda);
    if (there && there->unstable == Index{0}) found.push_back(there->state);
  }
  return found;
}

std::vector<const RecordEvent*> jumps_of(const Record& record) {
  std::vector<const RecordEvent*> found;
  for (const RecordEvent& event : record.events)
    if (event.jump) found.push_back(&event);
  return found;
}

const RecordPoint& first_point(const Record& record, Index branch) {
  return *std::find_if(record.points.begin(), record.points.end(),
                       [&](const RecordPoint& point) { return point.branch == branch; });
}

const std::string channel =
    test::pressed_column_in_channel(40, "branches = \"jump\", stop = { lambda = [-1.0, 10.0] }") + test::shortening;

// Two bars of half-span 10 and rise 1, Green strain, EA = 1e4.
std::string truss(const std::string& path) {
  return test::low_truss + "[path]\nstep = 0.3\nbranches = \"jump\"\n" + path;
}

}  // namespace

TEST(JumpRuns, TakeTheStaircaseOfTenBistableCells) {
  const TracedDeck run(chain_of_cells("jump"), {"path.jumps=true"});
  const Record& record = run.record();
  const auto jumps = jumps_of(record);
  ASSERT_EQ(jumps.size(), 10u);
  ASSERT_EQ(record.branches.size(), 11u);
  for (int i = 0; i < cell_count; ++i) {
    const RecordEvent& event = *jumps[static_cast<std::size_t>(i)];
    EXPECT_EQ(event.kind, EventKind::limit_point);
    EXPECT_NEAR(event.lambda, cell(i).snap_load(), 1e-10);
    const RecordBranch& next = record.branches[static_cast<std::size_t>(i) + 1];
    EXPECT_EQ(event.jump->on_branch, next.id);
    EXPECT_EQ(next.origin, event.id);
    EXPECT_EQ(next.parent, event.branch);
    EXPECT_TRUE(next.after_jump);
    const BranchEnd& end = record.branches[static_cast<std::size_t>(i)].end.value();
    EXPECT_EQ(end.reason, EndReason::jumped);
    EXPECT_EQ(end.partner, static_cast<int>(next.id));
    const RecordPoint& landing = first_point(record, next.id);
    EXPECT_EQ(landing.lambda, event.lambda);
    EXPECT_EQ(landing.count.unstable, 0);
    for (int j = 0; j < cell_count; ++j)
      EXPECT_NEAR(rise_of(landing.monitors, j), cell(j).rise(event.lambda, j <= i), 1e-8) << i << ", " << j;
    // The load does work on the way, and the cell stores or gives the rest.
    const double before = cell(i).rise_at_snap(), after = cell(i).rise(event.lambda, true);
    const double released = event.lambda * (before - after) + cell(i).energy(before) - cell(i).energy(after);
    EXPECT_NEAR(event.jump->energy_released, released, 1e-9);
    // The cell that snapped comes back first when λ is reversed; all before it have less to hold them.
    ASSERT_TRUE(event.jump->on_return);
    EXPECT_NEAR(event.jump->on_return->lambda, cell(i).load(-cell(i).rise_at_snap()), 1e-9);
  }
  EXPECT_EQ(record.branches.back().end->reason, EndReason::stop);
  EXPECT_EQ(exit_status(record), ExitStatus::success);
  for (const RecordPoint& point : record.points) EXPECT_NE(point.count.stability, Stability::unstable);
  const std::string text = events_text(record);
  EXPECT_NE(text.find("after a jump at λ = "), std::string::npos) << text;
  EXPECT_NE(text.find("branch 10 near step 0"), std::string::npos) << text;
  test::expect_whole(run);
}

TEST(JumpRuns, LandWhereTheWholePathPassesTheSameLoad) {
  const TracedDeck run(chain_of_cells("jump")), whole(chain_of_cells("primary"));
  const auto jumps = jumps_of(run.record());
  ASSERT_EQ(jumps.size(), 10u);
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    const RecordEvent& snap = event_of(whole, EventKind::limit_point, 2 * static_cast<int>(i) + 1);
    EXPECT_NEAR(jumps[i]->lambda, snap.lambda, 1e-10);
    const std::vector<State> behind = stable_behind(whole, snap);
    ASSERT_FALSE(behind.empty());
    const RecordPoint& landing = first_point(run.record(), jumps[i]->jump->on_branch.value());
    for (std::size_t m = 0; m < landing.monitors.size(); ++m)
      EXPECT_NEAR(landing.monitors[m], whole.model().monitors()[m].quantity->value(behind.front()), 1e-9);
  }
}

// Shooting: the column with two contact points above falls to one above, one below, one above at the snap.
TEST(JumpRuns, TakeTheStaircaseOfAColumnInAChannel) {
  const TracedDeck run(channel, {"path.jumps=true"});
  const TracedDeck whole(channel, {"path.branches=\"most-stable\""});
  const auto jumps = jumps_of(run.record());
  ASSERT_FALSE(jumps.empty());
  const RecordPoint& landing = first_point(run.record(), jumps[0]->jump->on_branch.value());
  EXPECT_EQ(jumps[0]->jump->contact_pattern, "upper lower upper");
  EXPECT_NEAR(landing.monitors.at(0), -0.15, 1e-9);
  EXPECT_NEAR(landing.monitors.at(1), 0.357478384025, 1e-7);
  EXPECT_NEAR(jumps[0]->jump->energy_released, 0.449814851283, 1e-7);
  ASSERT_TRUE(jumps[0]->jump->on_return);
  EXPECT_NEAR(jumps[0]->jump->on_return->lambda, 4.252069687267, 1e-7);
  EXPECT_NEAR(jumps[0]->jump->energy_dissipated.value(), 0.564429600789, 1e-6);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
  for (const RecordEvent* jump : jumps) {
    const auto same = std::find_if(whole.record().events.begin(), whole.record().events.end(), [&](const auto& event) {
      return event.kind == jump->kind && std::abs(event.lambda - jump->lambda) < 1e-6;
    });
    ASSERT_NE(same, whole.record().events.end());
    const RecordPoint& here = first_point(run.record(), jump->jump->on_branch.value());
    const std::vector<State> behind = stable_behind(whole, *same);
    const auto is_here = [&](const State& state) {
      const auto& monitors = whole.model().monitors();
      return std::abs(monitors[0].quantity->value(state) - here.monitors[0]) < 1e-7 &&
             std::abs(monitors[1].quantity->value(state) - here.monitors[1]) < 1e-7;
    };
    EXPECT_TRUE(std::any_of(behind.begin(), behind.end(), is_here)) << jump->lambda;
  }
  test::expect_whole(run);
}

// A column that buckles onto a stable branch follows it, and does not jump.
TEST(JumpRuns, FollowAStableBranchOffABranchPoint) {
  const std::string column = test::straight_column(16, "lambda = [-1.0, 0.5]") + R"toml(
[[monitor]]
name = "mid"
at = "c:0.5"
component = "z"
)toml";
  const TracedDeck follows(column), jumps(column, {"path.branches=\"jump\""});
  EXPECT_TRUE(jumps_of(jumps.record()).empty());
  EXPECT_EQ(jumps.record().branches.front().end->reason, EndReason::switched_branch);
  ASSERT_EQ(jumps.record().points.size(), follows.record().points.size());
  EXPECT_EQ(jumps.record().points.back().monitors, follows.record().points.back().monitors);
}

// With P L³ = z (25 − z²) a steep truss sways at z = √23 and falls to the other root of z³ − 25 z + 2 √23 = 0 below.
TEST(JumpRuns, LeaveABranchPointWhoseBranchIsUnstable) {
  const TracedDeck run(title("A steep truss") + material("m", 1.0) + general_section("s", 1.0, 1.0) +
                       points({{"left", -1.0, 0.0}, {"top", 0.0, 5.0}, {"right", 1.0, 0.0}}) +
                       supports({{"left", "x z"}, {"right", "x z"}}) + force("top", 0.0, -1.0) +
                       monitor("w", "top", "z") +
                       path(R"(step = 0.005; branches = "jump"; stop = { lambda = [-1.0, 2.0] })") + test::two_bars);
  const auto jumps = jumps_of(run.record());
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_EQ(jumps[0]->kind, EventKind::branch_point);
  EXPECT_NEAR(first_point(run.record(), 1).monitors.at(0), -0.5 * (std::sqrt(23.0) + std::sqrt(31.0)) - 5.0, 1e-9);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
  test::expect_whole(run);
}

// The truss lands at w = −2.1547, beyond a bound of −1.5: the run has one point there, and ends.
TEST(JumpRuns, EndBehindABoundThatTheJumpPasses) {
  const TracedDeck run(truss("stop.w = [-1.5, 0.5]\n"));
  ASSERT_EQ(run.record().branches.size(), 2u);
  EXPECT_EQ(run.record().branches[1].points, 1);
  EXPECT_EQ(run.record().branches[1].end->reason, EndReason::stop);
  EXPECT_NEAR(run.last().x.tail(1)[0], -2.1547005383793, 1e-9);
  test::expect_whole(run);
}

// A half truss of height 0.3 snaps onto a floor at −0.1, where it would fall on by itself: the floor bears
// λ + EA (L₀ − L)/L₀ · 0.1/L.
TEST(JumpRuns, EndOnAFloorThatAloneHoldsTheStructure) {
  const TracedDeck run(title("Snap onto a floor") + material("m", 1e6) + general_section("s", 1e-3, 1e-9) +
                       points({{"a", -1.0, 0.0}, {"t", 0.0, 0.3}}) + supports({{"a", "x z"}, {"t", "x"}}) +
                       path(R"(step = 0.1; stop = { lambda = [-100.0, 30.0] }; branches = "jump")") +
                       bar("l", "a", "t") + force("t", 0.0, -1.0) + flat_wall("floor", "below", -0.1, on_axis) +
                       monitor("z", "t", "z") + wall_monitor("floor", "floor", "force-z"));
  const double L0 = std::sqrt(1.09), L = std::sqrt(1.01);
  const RecordEvent& snaps = event_of(run, EventKind::limit_point);
  ASSERT_NE(snaps.jump, nullptr);
  EXPECT_NEAR(snaps.jump->monitors.at(0), -0.4, 1e-12);
  EXPECT_NEAR(snaps.jump->monitors.at(1), snaps.lambda + 1e3 * (L0 - L) / L0 * 0.1 / L, 1e-9);
  EXPECT_EQ(run.record().points.back().lambda, 30.0);
}

// An arch under a round peg that moves down reaches its limit point between two nodes. With contact at nodes it is
// still stable at that load, and comes to rest at the same state; from a little farther it snaps to its other side.
TEST(JumpRuns, DoNotEndAtTheStateThatTheyLeave) {
  const TracedDeck run(
      title("An arch under a peg") + material("m", 1.0) + general_section("s", 17173.10076109166, 1.0) +
      points({{"p0", 0.0, 0.0}, {"p1", 1.0, 0.0}}) +
      member("m0", "p0", "p1", "elastica", 30, "via = [0.5, 0.1621381779147173]") +
      supports({{"p0", "x z rotation"}, {"p1", "x z"}}) +
      path(R"(step = 0.05; branches = "jump"; stop = { lambda = [-0.3, 1.0] })") + monitor("mid", "m0:0.5", "z") +
      wall(
          "w0",
          R"(contact_surface = "axis"; outline = { type = "circle", centre = [0.5113197745886897, 0.2821381779147173], radius = 0.1 }; motion = { z = -0.40534544478679324 })"));
  const RecordEvent& snaps = event_of(run, EventKind::limit_point);
  ASSERT_NE(snaps.jump, nullptr);
  EXPECT_GT(snaps.jump->energy_released, 1.0);
  EXPECT_EQ(run.record().points.back().lambda, 1.0);
}

// A beam that slides hangs on a spring whose force has a maximum of 1: beyond it nothing holds the load.
TEST(JumpRuns, EndWhereNothingHoldsTheStructure) {
  Session run = test::traced(R"toml(
title = "A beam on a spring that gives way"
material.m = { E = 1e4 }
section.s = { shape = "general", A = 1.0, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "rotation"] }
spring = [{ at = "a", law = { direction = "z", displacement = [-0.2, -0.1, 0.0, 0.1], force = [0.0, -1.0, 0.0, 1.0] } }]
load = [{ at = "a", force = [0.0, -1.0] }]
monitor = [{ name = "w", at = "a", component = "z" }]
path = { step = 0.3, branches = "jump", stop = { lambda = [-5.0, 5.0] } }
member.beam = { from = "a", to = "b", theory = "elastica", elements = 2, material = "m", section = "s" }
)toml");
  const RecordBranch& only = run.record().branches.back();
  EXPECT_EQ(only.id, 0);
  EXPECT_EQ(only.end->reason, EndReason::unstable);
  EXPECT_EQ(only.end->detail, "no state after a jump is known: the structure finds no equilibrium at this load");
  EXPECT_NEAR(run.record().points.back().lambda, 1.0, 1e-9);
  EXPECT_EQ(exit_status(run.record()), ExitStatus::ended_early);
  EXPECT_NO_THROW(resume_session(run.checkpoint(), "checkpoint", Session::Resume::go_on));
}

TEST(JumpRuns, AreResumedToTheSameBits) {
  const std::string deck = chain_of_cells("jump");
  const TracedDeck whole(deck);
  Session begun = make_session({.deck = "deck.toml", .deck_text = deck, .assignments = {"path.jumps=false"}});
  ASSERT_TRUE(begun.begin());
  for (int i = 0; begun.next() != nullptr; ++i) {
    if (i % 3 != 0) continue;
    begun = resume_session(begun.checkpoint(), "checkpoint", Session::Resume::go_on);
  }
  EXPECT_EQ(events_json(begun.record()), events_json(whole.record()));
  ASSERT_EQ(begun.points().size(), whole.record().points.size());
  EXPECT_EQ(begun.points().back().state.x, whole.last().x);
}

// The load comes in two stages; the second begins where the first has landed and gone on.
TEST(JumpRuns, GoOnInTheNextStage) {
  const TracedDeck run(truss("stop.lambda = [-1.0, 20.0]\n") +
                       table("[[stage]]", R"(name = "first"; drives = ["load.0"]; stop = { lambda = [-1.0, 4.0] })") +
                       table("[[stage]]", R"(name = "second"; drives = ["load.0"])"));
  const Record& record = run.record();
  ASSERT_EQ(record.branches.size(), 3u);
  EXPECT_EQ(record.branches[1].stage, 0);
  EXPECT_EQ(record.branches[2].stage, 1);
  EXPECT_FALSE(record.branches[2].after_jump);
  // Both bars carry EA z (1 − z²)/L³ = 24 at the end.
  const double z = 1.0 + record.points.back().monitors.at(0);
  EXPECT_NEAR(1e4 * z * (1.0 - z * z) / std::pow(101.0, 1.5), 24.0, 1e-8);
  test::expect_whole(run);
}

// Branches of a stage are counted on from those of the stages before.
TEST(JumpRuns, NameTheBranchThatFollowsInALaterStage) {
  const TracedDeck run(
      truss("stop.lambda = [-1.0, 20.0]\n") +
      table("[[stage]]", R"(name = "through"; drives = ["load.0"]; stop = { lambda = [-1.0, 4.0] })") +
      table("[[stage]]", R"(name = "back"; drives = ["load.0"]; step = -0.3; stop = { lambda = [-20.0, 1.0] })"));
  const std::vector<RecordBranch>& branches = run.record().branches;
  ASSERT_EQ(branches.size(), 4u);
  EXPECT_EQ(branches[0].end->detail, "continues after a jump as branch 1");
  EXPECT_EQ(branches[2].end->detail, "continues after a jump as branch 3");
  EXPECT_EQ(branches[3].parent, 2);
}

// A curve of events begins at an event behind a jump.
TEST(JumpRuns, LeadToTheEventsOfACurve) {
  const TracedDeck run(chain_of_cells("jump"));
  std::string problem;
  const auto third = find_event(run.model(), EventKind::limit_point, 3, {}, problem);
  ASSERT_TRUE(third) << problem;
  EXPECT_NEAR(third->event.state.lambda, cell(2).snap_load(), 1e-10);
  EXPECT_FALSE(find_event(run.model(), EventKind::limit_point, 11, {}, problem));
}

TEST(JumpRuns, RefuseWhatLocatesNoEvents) {
  EXPECT_EQ(
      test::said_of(truss("events = \"detect\"\n")),
      "deck.toml:40:12: path.branches: \"jump\" needs located events, and events is \"detect\"; leave out events, "
      "or write events = \"locate\"");
}

TEST(JumpRuns, RefuseAMethodThatEndsWhereTheLoadTurns) {
  EXPECT_EQ(test::said_of(truss("method = \"load\"\n")),
            "deck.toml:40:12: path.branches: \"jump\" begins where λ turns, and method \"load\" ends there; use method "
            "\"spherical\"");
}

}  // namespace arcwall::jump_runs_test
