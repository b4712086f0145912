// Where structures fall to, against closed forms, shooting and a slow motion with a step rule of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "answers/sessions.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "continuation/equilibria/descent.hpp"
#include "core/algebra/factorization.hpp"
#include "core/linearization.hpp"
#include "model/deck_mesh.hpp"
#include "model/event_names.hpp"
#include "tests/apps/deck_texts.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::jump_test {

using namespace test::tables;
namespace {

using test::TracedDeck;

// Two bars of half-span 10 and rise 1, Green strain, EA = 1e4; the path ends at a depth.
std::string truss(const std::string& depth) {
  return test::low_truss + path(R"(step = 0.3; jumps = true; branches = "primary"; stop.w = [)" + depth + ", 0.5]");
}

// Lee's frame: a column of 120 and a beam of 120, EI = 1440, loaded at a fifth of the beam.
const std::string lee =
    title("Lee's frame") + material("m", 720.0, "nu = 0.3") + general_section("s", 6.0, 2.0) +
    points({{"foot", 0.0, 0.0}, {"corner", 0.0, 120.0}, {"loaded", 24.0, 120.0}, {"end", 120.0, 120.0}}) +
    supports({{"foot", "x z"}, {"end", "x z"}}) + force("loaded", 0.0, -1.0) +
    path("step = 0.1; jumps = true; stop = { w = [-95.0, 10.0] }") + monitor("u", "loaded", "x") +
    monitor("w", "loaded", "z") + member("column", "foot", "corner", "elastica", 20) +
    member("left", "corner", "loaded", "elastica", 4) + member("right", "loaded", "end", "elastica", 16);

// A beam between walls as in the other tests of columns in a channel.
const std::string channel =
    test::pressed_column_in_channel(40, "jumps = true, stop = { lambda = [-1.0, 10.0] }") + test::shortening;

// μ W ẋ = −F at fixed λ by steps x − (K + μ W)⁻¹ F of one Newton iteration each, no longer than a length that is
// prescribed: no search, no energy, no contact.
State slow_motion(const System& system, State state, double mu, double longest) {
  Linearization at;
  const auto solver = make_ldlt();
  const Vector weights = system.weights(state.active_set);
  for (int step = 0; step < 20000; ++step) {
    system.linearize(state, at);
    for (Index i = 0; i < weights.size(); ++i) at.K.coeffRef(i, i) += mu * weights[i];
    if (solver->factorize(at.K, {}) != FactorStatus::ok) throw std::runtime_error("singular");
    Matrix dx = -at.F;
    solver->solve(dx);
    const double length = std::sqrt((weights.array() * dx.col(0).array().square()).sum());
    state.x += std::min(1.0, longest / length) * dx.col(0);
    if (length < 1e-12) return state;
  }
  throw std::runtime_error("no rest");
}

// Shooting: the snap from two points above ends with one point above, one below, one above; mid −0.15, shortening
// 0.357478384025, released 0.449814851283; back at 4.252069687267, loop 0.564429600789.
void expect_the_fall_of_the_channel(const RecordEvent& snap) {
  ASSERT_TRUE(snap.jump);
  EXPECT_EQ(snap.jump->reason, "") << snap.jump->why;
  EXPECT_EQ(snap.jump->contact_pattern, "upper lower upper");
  EXPECT_NEAR(snap.jump->monitors.at(0), -0.15, 1e-9);
  EXPECT_NEAR(snap.jump->monitors.at(1), 0.357478384025, 1e-7);
  EXPECT_NEAR(snap.jump->energy_released, 0.449814851283, 1e-7);
  ASSERT_TRUE(snap.jump->on_return);
  EXPECT_EQ(snap.jump->on_return->kind, EventKind::contact_limit_point);
  EXPECT_NEAR(snap.jump->on_return->lambda, 4.252069687267, 1e-7);
  EXPECT_NEAR(snap.jump->energy_dissipated.value(), 0.564429600789, 1e-6);
}

}  // namespace

// The truss falls from h (1 − 1/√3) to h (1 + 2/√3) = 2.1547005383793 and releases 7.3888900263118; it comes back by
// the same, so that 14.777780052624 are lost. Closed forms.
TEST(Jump, OfATrussIsThatOfTheClosedForm) {
  const TracedDeck traced(truss("-2.5"));
  const RecordEvent& snap = event_of(traced, EventKind::limit_point);
  ASSERT_TRUE(snap.jump);
  EXPECT_EQ(snap.jump->reason, "");
  EXPECT_NEAR(snap.jump->monitors.at(0), -2.1547005383793, 1e-9);
  EXPECT_NEAR(snap.jump->energy_released, 7.3888900263118, 1e-9);
  EXPECT_EQ(snap.jump->unstable, 0);
  EXPECT_EQ(snap.jump->on_branch, 0);
  ASSERT_TRUE(snap.jump->on_return);
  EXPECT_NEAR(snap.jump->on_return->lambda, -snap.lambda, 1e-9);
  ASSERT_TRUE(snap.jump->energy_dissipated);
  EXPECT_NEAR(*snap.jump->energy_dissipated, 14.777780052624, 1e-9);

  const auto json = event_json(traced.record(), snap);
  EXPECT_NEAR(json["jump"]["monitors"]["w"].get<double>(), -2.1547005383793, 1e-9);
  const std::string text = events_text(traced.record());
  EXPECT_NE(text.find("jumps to"), std::string::npos);
  // The point whose monitor is next to that of the destination.
  const auto& points = traced.record().points;
  const auto far = [](const RecordPoint& point) { return std::abs(point.monitors.at(0) + 2.1547005383793); };
  const auto nearest =
      std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) { return far(a) < far(b); });
  EXPECT_NE(text.find(" branch 0 near step " + std::to_string(nearest->step) + " "), std::string::npos) << text;
}

// A run that is read back has its jumps, and none is looked for again.
TEST(Jump, IsKeptInACheckpoint) {
  Session run = test::traced(truss("-2.5"));
  const Session read = resume_session(run.checkpoint(), "checkpoint", Session::Resume::as_ended);
  const RecordEvent& snap = test::event_of(run.record(), EventKind::limit_point);
  ASSERT_TRUE(snap.jump && snap.jump->on_return);
  EXPECT_EQ(event_json(read.record(), test::event_of(read.record(), EventKind::limit_point)),
            event_json(run.record(), snap));
}

// Who stops a run does not wait for a descent; who goes on with it has the jumps at its end.
TEST(Jump, IsNotLookedForWhereARunIsStopped) {
  Session run = test::traced(truss("-2.5"));
  Session begun = make_session({.deck = "deck.toml", .deck_text = truss("-2.5")});
  ASSERT_TRUE(begun.begin());
  while (test::events_of(begun.record(), EventKind::limit_point).empty()) ASSERT_NE(begun.next(), nullptr);
  const std::string checkpoint = begun.checkpoint();
  begun.stop({.reason = EndReason::interrupted, .detail = "enough"});
  EXPECT_EQ(begun.next(), nullptr);
  EXPECT_FALSE(test::event_of(begun.record(), EventKind::limit_point).jump);

  Session resumed = resume_session(checkpoint, "checkpoint", Session::Resume::go_on);
  while (resumed.next() != nullptr) {
  }
  EXPECT_EQ(event_json(resumed.record(), test::event_of(resumed.record(), EventKind::limit_point)),
            event_json(run.record(), test::event_of(run.record(), EventKind::limit_point)));
}

// A path that ends before it comes there: the state is found all the same, and the way back is followed from it.
TEST(Jump, IsFoundWhereThePathDoesNotPass) {
  const TracedDeck traced(truss("-1.2"));
  const RecordEvent& snap = event_of(traced, EventKind::limit_point);
  ASSERT_TRUE(snap.jump);
  EXPECT_NEAR(snap.jump->monitors.at(0), -2.1547005383793, 1e-9);
  EXPECT_FALSE(snap.jump->on_branch);
  ASSERT_TRUE(snap.jump->on_return);
  EXPECT_NEAR(snap.jump->on_return->lambda, -snap.lambda, 1e-9);
}

// The deck stops the path at the event itself, so that no point of the path lies beyond.
TEST(Jump, IsFoundWhereThePathStopsAtTheEvent) {
  const TracedDeck traced(truss("-2.5"), {"path.stop.event=[\"limit-point\"]"});
  const RecordEvent& snap = event_of(traced, EventKind::limit_point);
  ASSERT_TRUE(snap.jump);
  EXPECT_NEAR(snap.jump->monitors.at(0), -2.1547005383793, 1e-9);
  EXPECT_NEAR(snap.jump->energy_released, 7.3888900263118, 1e-9);
  EXPECT_FALSE(snap.jump->on_branch);
  ASSERT_TRUE(snap.jump->on_return);
  EXPECT_NEAR(snap.jump->on_return->lambda, -snap.lambda, 1e-9);
  expect_the_fall_of_the_channel(
      event_of(TracedDeck(channel, {"path.stop.event=[\"limit-point\"]"}), EventKind::limit_point));
}

// The column traced to just behind its limit point alone: contact that slides is begun where the structure comes to
// rest, and followed back from there.
TEST(Jump, BeginsContactThatSlidesWhereThePathDoesNotPass) {
  const TracedDeck traced(channel, {"path.max_points=33"});
  const RecordEvent& snap = event_of(traced, EventKind::limit_point);
  expect_the_fall_of_the_channel(snap);
  EXPECT_FALSE(snap.jump->on_branch);
}

// An arch under a load along it snaps onto a floor: onto a point of it, along a part that is pressed, and from end to
// end where the floor is as high as the hinges. Where the path passes the state it is that of the path, which was
// traced to it through every change of contact.
TEST(Jump, OnAFloorIsThatOfThePathWhereverThatEndsSlow) {
  struct Floor {
    std::string z, word;
  };
  for (const Floor& floor : {Floor{"-0.06", "floor"}, Floor{"-0.02", "floor="}, Floor{"0.0", "floor="}}) {
    const std::string arch = test::arch_above_a_floor(floor.z);
    const TracedDeck whole(arch), part(arch, {"path.max_points=10"});
    const RecordEvent &on_path = event_of(whole, EventKind::limit_point), &off = event_of(part, EventKind::limit_point);
    ASSERT_TRUE(on_path.jump && off.jump);
    EXPECT_TRUE(on_path.jump->on_branch);
    EXPECT_FALSE(off.jump->on_branch);
    EXPECT_EQ(on_path.jump->contact_pattern, floor.word);
    EXPECT_EQ(off.jump->contact_pattern, floor.word);
    EXPECT_NEAR(off.jump->monitors.at(0), on_path.jump->monitors.at(0), 1e-6);
    EXPECT_NEAR(off.jump->energy_released, on_path.jump->energy_released, 1e-8);
  }
}

// Shooting: u 85.912715359, w −92.553278331, released 82.328152133, back at −0.94144315556, loop 215.843460563.
TEST(Jump, OfLeesFrameIsThatOfShooting) {
  const TracedDeck traced(lee);
  const RecordEvent& snap = event_of(traced, EventKind::limit_point);
  ASSERT_TRUE(snap.jump && snap.jump->on_return);
  EXPECT_NEAR(snap.jump->monitors.at(0), 85.912715359, 1e-5);
  EXPECT_NEAR(snap.jump->monitors.at(1), -92.553278331, 1e-5);
  EXPECT_NEAR(snap.jump->energy_released, 82.328152133, 1e-4);
  EXPECT_NEAR(snap.jump->on_return->lambda, -0.94144315556, 1e-7);
  EXPECT_NEAR(snap.jump->energy_dissipated.value(), 215.843460563, 1e-4);

  // The same state by a motion of another rule.
  const System& system = traced.model().system();
  State start = traced.record().points[static_cast<std::size_t>(snap.step) + 1].state;
  start.lambda = snap.lambda;
  const State rest = slow_motion(system, start, 2e3, 0.01);
  EXPECT_NEAR(traced.model().monitors()[1].quantity->value(rest), snap.jump->monitors.at(1), 1e-8);
}

TEST(Jump, OfAColumnInAChannelIsThatOfShooting) {
  const TracedDeck traced(channel);
  expect_the_fall_of_the_channel(event_of(traced, EventKind::limit_point));
}

namespace {

// A steep truss of rise 5 and half-span 1, which sways at z = √23 above its feet; that branch is unstable.
std::string steep_truss(const std::string& branches) {
  return test::truss_of(1.0, 5.0, 1.0) +
         path("step = 0.005; jumps = true; branches = \"" + branches + "\"; stop.w = [-4.5, 0.5]");
}

}  // namespace

// With P L³ = z (25 − z²) at z = √23 it falls to the other root of z³ − 25 z + 2 √23 = 0 below, z = −(√23 + √31)/2:
// to the right and to the left alike, also where the path itself goes straight on.
TEST(Jump, OfABranchPointWhoseBranchIsUnstable) {
  for (const char* branches : {"most-stable", "primary"}) {
    const TracedDeck traced(steep_truss(branches));
    const RecordEvent& sway = event_of(traced, EventKind::branch_point);
    ASSERT_TRUE(sway.jump) << branches;
    EXPECT_EQ(sway.jump->reason, "");
    EXPECT_NEAR(sway.jump->monitors.at(0), -0.5 * (std::sqrt(23.0) + std::sqrt(31.0)) - 5.0, 1e-9);
  }
  const TracedDeck stopped(steep_truss("primary"), {"path.stop.event=[\"branch-point\"]"});
  const RecordEvent& sway = event_of(stopped, EventKind::branch_point);
  ASSERT_TRUE(sway.jump);
  EXPECT_NEAR(sway.jump->monitors.at(0), -0.5 * (std::sqrt(23.0) + std::sqrt(31.0)) - 5.0, 1e-9);
}

// Above a floor z = −2.5 + 0.2 x it falls to the right or to the left. On the floor Π has a minimum at x = 4.4481035
// and one at x = −3.6490728, at heights of −6.61037929601187 and −8.22981456547270 below the top; 0.30883094333755 and
// 0.48479403612256 are released. Minima of the bars' energy along the line, by Newton's method with 40 digits.
TEST(Jump, OfBothSensesOfAModeIsToldWhereTheyDiffer) {
  const std::string deck =
      steep_truss("most-stable") +
      wall("floor", R"(side = "below"; contact_surface = "axis"; profile = { type = "line", z = -2.5, slope = 0.2 })");
  const Session run = test::traced(deck);
  const RecordEvent& sway = test::event_of(run.record(), EventKind::branch_point);
  ASSERT_TRUE(sway.jump);
  EXPECT_EQ(sway.jump->reason, "two_destinations") << sway.jump->why;
  ASSERT_EQ(sway.jump->destinations.size(), 2U);
  const RecordJump *right = &sway.jump->destinations[0], *left = &sway.jump->destinations[1];
  if (right->monitors.at(0) < left->monitors.at(0)) std::swap(right, left);
  EXPECT_NEAR(right->monitors.at(0), -6.61037929601187, 1e-9);
  EXPECT_NEAR(left->monitors.at(0), -8.22981456547270, 1e-9);
  EXPECT_NEAR(right->energy_released, 0.30883094333755, 1e-9);
  EXPECT_NEAR(left->energy_released, 0.48479403612256, 1e-9);
  EXPECT_EQ(right->contact_pattern, "floor");

  const auto json = event_json(run.record(), sway);
  EXPECT_EQ(json["jump"]["reason"], "two_destinations");
  EXPECT_EQ(json["jump"]["two_destinations"].size(), 2U);
  Session kept = test::traced(deck);
  const Session read = resume_session(kept.checkpoint(), "checkpoint", Session::Resume::as_ended);
  EXPECT_EQ(event_json(read.record(), test::event_of(read.record(), EventKind::branch_point)), json);
}

// What a descent may do is bounded by what it is given.
TEST(Jump, TakesNoMoreWorkThanItIsGiven) {
  const TracedDeck traced(lee, {"path.max_points=40"});
  const RecordEvent& snap = event_of(traced, EventKind::limit_point);
  ASSERT_TRUE(snap.jump);
  Index work = 0;
  const DeckMesh mesh(traced.model());
  const auto& points = traced.record().points;
  State start = points[static_cast<std::size_t>(snap.step) + 1].state;
  start.lambda = snap.lambda;
  const Descent none = descend(mesh.system(), mesh.state(mesh.unknowns(start), snap.lambda),
                               traced.model().options().factorization, work);
  EXPECT_EQ(none.end, DescentEnd::cut_off);
  work = 100000;
  const Descent whole = descend(mesh.system(), mesh.state(mesh.unknowns(start), snap.lambda),
                                traced.model().options().factorization, work);
  EXPECT_EQ(whole.end, DescentEnd::at_rest);
  EXPECT_LT(100000 - work, 2000);
  Index few = (100000 - work) / 2;
  EXPECT_EQ(
      descend(mesh.system(), mesh.state(mesh.unknowns(start), snap.lambda), traced.model().options().factorization, few)
          .end,
      DescentEnd::cut_off);
}

// A column that buckles into the post-buckling branch, which is stable, does not fall.
TEST(Jump, IsNoneWhereTheBranchBehindIsStable) {
  const TracedDeck traced(test::straight_column(16, "lambda = [-1.0, 0.5]"), {"path.jumps=true"});
  EXPECT_FALSE(event_of(traced, EventKind::branch_point).jump);
}

// The load of the truss is brought on in two stages, with λ = 0 at the start of each.
TEST(Jump, OfAStageIsThatOfTheWholeLoad) {
  const TracedDeck whole(truss("-2.5"));
  const TracedDeck staged(
      truss("-2.5") + table("[[stage]]", R"(name = "first"; drives = ["load.0"]; stop = { lambda = [-1.0, 0.7] })") +
      table("[[stage]]", R"(name = "second"; drives = ["load.0"])"));
  const RecordEvent &snap = event_of(staged, EventKind::limit_point),
                    &expected = event_of(whole, EventKind::limit_point);
  EXPECT_NEAR(snap.lambda, expected.lambda - 0.7, 1e-9);
  ASSERT_TRUE(snap.jump);
  EXPECT_NEAR(snap.jump->monitors.at(0), -2.1547005383793, 1e-9);
  EXPECT_NEAR(snap.jump->energy_released, 7.3888900263118, 1e-9);
  ASSERT_TRUE(snap.jump->on_return);
  EXPECT_NEAR(snap.jump->on_return->lambda, -expected.lambda - 0.7, 1e-9);
}

// A buckled strip is pushed through by a finger, which leaves it where it is unstable: no point of the path beyond
// moves it. The strip falls into the mirror image of its first shape: with sin(slope/2) = k sin φ its ends are nearer
// by 2 − 2 E(k)/K(k) of its length, and its middle has moved by k/K(k). The imperfection adds to one what it takes off
// the other, to first order.
TEST(Jump, IsFoundWhereAMovingWallLeavesAnUnstableStrip) {
  const TracedDeck traced(
      title("A buckled strip, pushed off its middle") + material("steel", 2.0e5) + rectangle("strip", 10.0, 0.3) +
      points({{"left", 0.0, 0.0}, {"right", 100.0, 0.0}}) +
      supports({{"left", "x z rotation"}, {"right", "z rotation"}}) + prescribed("right", "x = -0.5; constant = true") +
      path("step = 0.1; jumps = true; stop = { lambda = [-0.1, 16.0] }") + monitor("mid", "strip:0.5", "z") +
      member("strip", "left", "right", "elastica", 40, imperfection({{1, 0.02}}), "steel", "strip") +
      wall("finger", R"(outline = { type = "circle", centre = [40.0, 10.0], radius = 2.0 }; motion = { z = -1.0 })"));
  // Shortened by N/EA besides, N = (4 K/L)² EI.
  double low = 0.0, high = 0.5;
  while (high - low > 1e-15) {
    const double k = 0.5 * (low + high), K = std::comp_ellint_1(k);
    const double strain = 16.0 * K * K / 1e4 * 0.3 * 0.3 / 12.0;
    (1.0 - (1.0 - strain) * (2.0 * std::comp_ellint_2(k) / K - 1.0) < 0.005 ? low : high) = k;
  }
  const double middle = 100.0 * low / std::comp_ellint_1(low);
  const RecordEvent& snap = event_of(traced, EventKind::contact_limit_point);
  EXPECT_EQ(snap.unstable_after, 1);
  ASSERT_TRUE(snap.jump);
  EXPECT_EQ(snap.jump->reason, "");
  const double first = traced.record().points.front().monitors.at(0), other = snap.jump->monitors.at(0);
  EXPECT_NEAR(0.5 * (first - other), middle, 1e-4);
  EXPECT_NEAR(first + other, 0.0, 0.01);
  EXPECT_EQ(snap.jump->contact_pattern, "");
  EXPECT_GT(snap.jump->energy_released, 0.0);
  const auto told = std::count_if(traced.record().events.begin(), traced.record().events.end(),
                                  [](const RecordEvent& event) { return event.jump != nullptr; });
  EXPECT_EQ(told, 1);
}

// An arch snaps onto a pin that is thinner than an element is long. Pins of radius 6, 5 and 4 stop the crown at -11.90,
// -12.95 and -13.99 on any mesh; one of radius 2 stops it two further such differences down. A mesh of elements of 10
// may not feel it: then no jump is told, and none leads through.
TEST(JumpTest, LandsOnAPinThatIsThinnerThanAnElement) {
  for (const std::string elements : {"20", "40", "80"})
    for (const double radius : {4.0, 3.0, 2.0}) {
      SCOPED_TRACE(elements + ", " + std::to_string(radius));
      const TracedDeck traced(R"toml(
title = "Arch snaps onto a thin pin"
material.steel = { E = 2.1e5 }
section.s = { shape = "rectangle", width = 10.0, height = 1.0 }
point = { a = [-100.0, 0.0], b = [100.0, 0.0] }
support = { a = ["x", "z"], b = ["x", "z"] }
path = { step = 1.0, jumps = true, branches = "jump", stop = { lambda = [-1.0, 40.0] } }
load = [{ at = "c:0.45", force = [0.0, -1.0] }]
monitor = [{ name = "crown", at = "c:0.5", component = "z" }, { name = "f", wall = "pin", component = "force-z" }]
wall = [{ name = "pin", outline = { type = "circle", centre = [3.0, -6.0], radius = )toml" +
                              std::to_string(radius) + R"toml( } }]
[member.c]
from = "a"
to = "b"
via = [0.0, 12.0]
theory = "elastica"
material = "steel"
section = "s"
elements = )toml" + elements + "\n");
      const RecordPoint& end = traced.record().points.back();
      EXPECT_GE(end.monitors[0], -17.0);
      if (elements == "20" && end.lambda < 40.0) continue;
      EXPECT_EQ(end.lambda, 40.0);
      EXPECT_GT(end.monitors[1], 20.0);
      EXPECT_NEAR(end.monitors[0], -13.99 - 1.04 * (4.0 - radius), 0.2);
    }
}

}  // namespace arcwall::jump_test
