#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "model/session.hpp"

// Contact with Coulomb friction at nodes and free ends. The references of blocks on springs and of a node on an incline
// are closed forms; the strips are shot elasticas (extensible, θ′ = M/EI, fixed steps of order 8), all digits given.
namespace arcwall::friction_test {

namespace {

Session session_of(const std::string& text) {
  return Session({.deck = "friction.toml", .deck_text = "title = \"Friction\"\n" + text});
}

Session run_of(const std::string& text) {
  Session session = session_of(text);
  while (session.next() != nullptr) {
  }
  EXPECT_EQ(session.problem(), "");
  return session;
}

std::vector<double> lambdas(const Session& session, EventKind kind, Index branch) {
  std::vector<double> found;
  for (const RecordEvent& event : session.events())
    if (event.kind == kind && event.branch == branch) found.push_back(event.lambda);
  return found;
}

EndReason reason(const Session& session) { return session.record().branches.back().end->reason; }

double monitor_at_end(const Session& session, std::size_t which) { return session.points().back().monitors[which]; }

void expect_law(const Session& session) {
  for (const RecordPoint& point : session.points())
    for (const RecordForce& contact : point.forces)
      if (contact.friction) {
        EXPECT_LE(std::abs(contact.friction->force),
                  contact.friction->coefficient * contact.force * (1.0 + 1e-9) + 1e-12);
      }
}

// Whether a contact slips against the wall's tangent.
bool slips_back(const RecordPoint& point) {
  return std::any_of(point.forces.begin(), point.forces.end(), [](const RecordForce& contact) {
    return contact.friction && contact.friction->mode == ContactMode::slips_backward;
  });
}

const std::string bars = R"(
[material.m]
E = 210.0
[section.s]
shape = "general"
A = 1.0
I = 1.0
[support]
A = ["z"]
[[prescribed]]
at = "A"
x = 1.0
[[wall]]
name = "floor"
side = "below"
contact_surface = "axis"
profile = { type = "flat", z = 0.0 }
friction = 0.3
[[monitor]]
name = "F"
at = "A"
component = "reaction-x"
)";

std::string bar(const std::string& name, const std::string& from, const std::string& to) {
  return fmt::format(
      "[member.{}]\nfrom = \"{}\"\nto = \"{}\"\ntheory = \"truss\"\nstrain = \"engineering\"\n"
      "material = \"m\"\nsection = \"s\"\nelements = 1\n",
      name, from, to);
}

std::string weight(const std::string& at, double weight) {
  return fmt::format("[[load]]\nat = \"{}\"\nforce = [0.0, {}]\nconstant = true\n", at, -weight);
}

std::string stage(const std::string& name, const std::string& drives, double step, double low, double high) {
  return fmt::format("[[stage]]\nname = \"{}\"\ndrives = [\"{}\"]\nstep = {}\nstop = {{ lambda = [{}, {}] }}\n", name,
                     drives, step, low, high);
}

// A block of weight 1 on a spring of stiffness 21, dragged to and fro.
std::string block(double friction) {
  std::string text = bars + "[point]\nA = [0.0, 0.0]\nB = [10.0, 0.0]\n" + bar("bar", "A", "B") + weight("B", 1.0) +
                     stage("out", "prescribed.0", 0.005, -1.0, 0.05) +
                     stage("back", "prescribed.0", -0.005, -0.1, 1.0) +
                     stage("again", "prescribed.0", 0.005, -1.0, 0.1);
  text.replace(text.find("friction = 0.3"), 14, fmt::format("friction = {}", friction));
  return text;
}

}  // namespace

TEST(Friction, BlockOnASpringSlipsAndSticks) {
  const Session session = run_of(block(0.3));
  EXPECT_EQ(reason(session), EndReason::stop);
  expect_law(session);
  const double slip = 0.3 / 21.0;
  const auto out = lambdas(session, EventKind::contact_slips, 0), back = lambdas(session, EventKind::contact_slips, 1),
             again = lambdas(session, EventKind::contact_slips, 2);
  ASSERT_EQ(out.size(), 1U);
  ASSERT_EQ(back.size(), 1U);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_NEAR(out[0], slip, 1e-12);
  EXPECT_NEAR(back[0], -2.0 * slip, 1e-12);
  EXPECT_NEAR(again[0], 2.0 * slip, 1e-12);
  EXPECT_NEAR(std::abs(monitor_at_end(session, 0)), 0.3, 1e-12);
}

// Slips at u = 0.3/21, the second block at 0.1; back after twice these ways.
TEST(Friction, TwoBlocksSlipOneAfterTheOther) {
  const Session session =
      run_of(bars + "[point]\nA = [0.0, 0.0]\nB = [10.0, 0.0]\nC = [30.0, 0.0]\n" + bar("ab", "A", "B") +
             bar("bc", "B", "C") + weight("B", 1.0) + weight("C", 2.0) +
             stage("out", "prescribed.0", 0.005, -1.0, 0.15) + stage("back", "prescribed.0", -0.005, -0.25, 1.0));
  expect_law(session);
  const auto out = lambdas(session, EventKind::contact_slips, 0), back = lambdas(session, EventKind::contact_slips, 1);
  ASSERT_EQ(out.size(), 2U);
  ASSERT_EQ(back.size(), 2U);
  EXPECT_NEAR(out[0], 0.3 / 21.0, 1e-12);
  EXPECT_NEAR(out[1], 0.1, 1e-12);
  EXPECT_NEAR(back[0], -0.6 / 21.0, 1e-12);
  EXPECT_NEAR(back[1], -0.2, 1e-12);
}

namespace {

// A node at the origin on springs k_x = 1, k_z = 10, on a rough incline of 40°, pressed down by λ from 0 to 1, then
// pulled by λ < 0 along x.
std::string incline(double friction) {
  const double angle = 40.0 * std::numbers::pi / 180.0;
  return fmt::format(R"(
[material.m]
E = 1e-9
[section.s]
shape = "general"
A = 1.0
I = 1.0
[point]
O = [0.0, 0.0]
far = [0.0, 1.0]
[support]
far = ["x", "z"]
[[spring]]
at = "O"
stiffness = {{ x = 1.0, z = 10.0 }}
[[load]]
at = "O"
force = [0.0, -1.0]
[[load]]
at = "O"
force = [1.0, 0.0]
[[wall]]
name = "slope"
members = ["bar"]
contact_surface = "axis"
outline = {{ type = "half-plane", point = [0.0, 0.0], normal = [{}, {}] }}
friction = {}
[[monitor]]
name = "x"
at = "O"
component = "x"
)",
                     -std::sin(angle), std::cos(angle), friction) +
         bar("bar", "O", "far") + stage("press", "load.0", 0.1, -1.0, 1.0) + stage("pull", "load.1", -0.02, -0.4, 1.0);
}

constexpr double opening = -0.1191753592594;  // −(k_x/k_z) cot 40°

}  // namespace

// μ = 0.3 < tan 40°: it slips down from the start, to w = −0.121853932357 up the slope.
TEST(Friction, NodeSlipsDownAnIncline) {
  const Session session = run_of(incline(0.3));
  expect_law(session);
  double at_one = 0.0;
  for (const RecordPoint& point : session.points())
    if (point.branch == 0) at_one = point.monitors[0];
  EXPECT_NEAR(at_one, -0.121853932357 * std::cos(40.0 * std::numbers::pi / 180.0), 2e-10);
}

TEST(Friction, NodeSticksThenSlipsThenLeavesAnIncline) {
  const Session session = run_of(incline(1.0));
  const auto slips = lambdas(session, EventKind::contact_slips, 1),
             opens = lambdas(session, EventKind::contact_opens, 1);
  ASSERT_EQ(slips.size(), 1U);
  ASSERT_EQ(opens.size(), 1U);
  EXPECT_NEAR(slips[0], -0.0874886635259, 1e-10);
  EXPECT_NEAR(opens[0], opening, 1e-10);
}

// Above μ = K_tt/K_tn = 1.0647 the slip wants λ to rise: a limit point by friction, and another at the opening.
TEST(Friction, SlipThatTheLoadDoesNotFollowTurnsTheLoad) {
  const Session session = run_of(incline(1.25));
  const auto slips = lambdas(session, EventKind::contact_slips, 1),
             opens = lambdas(session, EventKind::contact_opens, 1),
             turns = lambdas(session, EventKind::contact_limit_point, 1);
  ASSERT_EQ(slips.size(), 1U);
  ASSERT_EQ(opens.size(), 1U);
  EXPECT_NEAR(slips[0], -0.2005493069522, 1e-10);
  EXPECT_NEAR(opens[0], opening, 1e-10);
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_EQ(turns[0], slips[0]);
  EXPECT_EQ(turns[1], opens[0]);
  for (const RecordPoint& point : session.points())
    if (point.branch == 1 && slips_back(point)) {
      EXPECT_EQ(point.count.unstable, Index{1});
    }
}

namespace {

// A strip that a clamp at (0, sin 60°) points down to a floor, whose tip touches it at rest; the clamp goes down.
std::string strip(double friction, const std::string& stages, const std::string& drag = "") {
  return fmt::format(R"(
[material.m]
E = 10000.0
[section.s]
shape = "general"
A = 1.0
I = 1e-4
[point]
clamp = [0.0, 0.8660254037844386]
tip = [0.5, 0.0]
[member]
strip = {{ from = "clamp", to = "tip", theory = "elastica", material = "m", section = "s", elements = 20 }}
[support]
{}
[[prescribed]]
at = "clamp"
z = -1.0
[[wall]]
name = "floor"
side = "below"
contact_surface = "axis"
profile = {{ type = "flat", z = 0.0 }}
friction = {}
[[monitor]]
name = "x"
at = "tip"
component = "x"
[[monitor]]
name = "T"
wall = "floor"
component = "force-x"
[[monitor]]
name = "p"
wall = "floor"
component = "force-z"
)",
                     drag.empty() ? "clamp = [\"x\", \"rotation\"]" : "clamp = [\"rotation\"]", friction) +
         drag + stages;
}

}  // namespace

// With μ < cot 60° it slips from the start; dragged on, its shape is constant; turned, it sticks for 0.00245442295107.
TEST(Friction, DraggedStripSlipsSticksAndSlipsBack) {
  const Session session =
      run_of(strip(0.3,
                   stage("press", "prescribed.0", 0.0005, -1.0, 0.4) + stage("drag", "prescribed.1", 0.01, -1.0, 0.1) +
                       stage("back", "prescribed.1", -0.001, -0.2, 1.0),
                   "[[prescribed]]\nat = \"clamp\"\nx = 1.0\n"));
  EXPECT_EQ(reason(session), EndReason::stop);
  expect_law(session);
  const RecordPoint* pressed = nullptr;
  for (const RecordPoint& point : session.points())
    if (point.branch == 0) pressed = &point;
  ASSERT_NE(pressed, nullptr);
  EXPECT_NEAR(pressed->monitors[0], 0.848318084440 - 0.5, 1e-7);
  EXPECT_NEAR(pressed->monitors[2], 2.043932631876, 1e-6);
  EXPECT_NEAR(pressed->monitors[1], -0.6131797895628, 1e-6);
  const auto slips = lambdas(session, EventKind::contact_slips, 2);
  ASSERT_EQ(slips.size(), 1U);
  EXPECT_NEAR(slips[0], -0.00245442295107, 1e-8);
  EXPECT_NEAR(monitor_at_end(session, 2), 1.597276181152, 1e-6);
  EXPECT_NEAR(monitor_at_end(session, 1), 0.479182854346, 1e-6);
}

// With μ = 0.8 it sticks and buckles, slips at d = 0.0723106541656, and d turns there.
TEST(Friction, PressedStripSticksBucklesAndSlips) {
  const Session session = run_of(strip(0.8, stage("press", "prescribed.0", 0.0005, -1.0, 0.08)));
  const auto slips = lambdas(session, EventKind::contact_slips, 0),
             turns = lambdas(session, EventKind::contact_limit_point, 0),
             smooth = lambdas(session, EventKind::limit_point, 0);
  ASSERT_EQ(slips.size(), 1U);
  EXPECT_NEAR(slips[0], 0.0723106541656, 1e-7);
  ASSERT_EQ(turns.size(), 1U);
  ASSERT_EQ(smooth.size(), 1U);
  EXPECT_NEAR(smooth[0], 0.06692724, 1e-6);
}

TEST(Friction, ResumedRunsAreEqualToTheLastBit) {
  const std::string text =
      strip(0.3, stage("press", "prescribed.0", 0.0005, -1.0, 0.1) + stage("back", "prescribed.0", -0.001, -0.1, 1.0));
  const Session whole = run_of(text);
  const std::size_t points = whole.points().size();
  for (const std::size_t killed : {std::size_t{2}, points / 3, points / 2, points - 3}) {
    Session first = session_of(text);
    while (first.points().size() < killed) ASSERT_NE(first.next(), nullptr);
    Session rest = Session::from(first.checkpoint(), "checkpoint", Session::Resume::go_on);
    while (rest.next() != nullptr) {
    }
    ASSERT_EQ(rest.points().size(), points);
    for (std::size_t i = 0; i < points; ++i) {
      EXPECT_EQ(rest.points()[i].lambda, whole.points()[i].lambda);
      EXPECT_EQ(rest.points()[i].state.x, whole.points()[i].state.x);
    }
    EXPECT_EQ(rest.events().size(), whole.events().size());
  }
}

TEST(Friction, AWallWithoutFrictionIsAsBefore) {
  std::string without = block(0.0);
  const Session zero = run_of(without);
  without.replace(without.find("friction = 0\n"), 13, "");
  const Session none = run_of(without);
  ASSERT_EQ(zero.points().size(), none.points().size());
  for (std::size_t i = 0; i < zero.points().size(); ++i) EXPECT_EQ(zero.points()[i].state.x, none.points()[i].state.x);
}

TEST(Friction, DecksThatAskForMoreAreRejected) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      const Session session = session_of(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string good = strip(0.3, "[path]\nstep = 0.01\n[path.stop]\nlambda = [-1.0, 0.1]\n");
  EXPECT_EQ(message(good), "");
  EXPECT_NE(message(good + "[contact]\npoints = \"moving\"\n").find("at nodes"), std::string::npos);
  EXPECT_NE(message(good + "[contact]\nmethod = \"penalty\"\npenalty = 1.0\n").find("springs in place of walls"),
            std::string::npos);
  EXPECT_NE(message(good + "[[friction]]\nmember = \"stripp\"\ncoefficient = 0.1\n").find("no member"),
            std::string::npos);
  EXPECT_NE(message(good + "[[friction]]\ncoefficient = 0.1\n").find("what it is for"), std::string::npos);
}

}  // namespace arcwall::friction_test
