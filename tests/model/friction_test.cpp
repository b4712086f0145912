#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "model/dissipation.hpp"
#include "tests/model/friction_decks.hpp"
#include "tests/support/deck_tables.hpp"

// Contact with Coulomb friction at nodes and free ends. The references of blocks on springs and of a node on an incline
// are closed forms; the strips are shot elasticas (extensible, θ′ = M/EI, fixed steps of order 8), all digits given.
namespace arcwall::friction_test {

using namespace test::tables;

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
    expect_resumed(text, whole, killed);
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

// Natural curvature 1, EA/EI = 10⁵, shot: 0.625382563985 and 1.666264845603 at 0.1 and 0.3. Nothing rubs.
TEST(Friction, RingOnARoughPlateHasNone) {
  const Session session =
      run_of(material("m", 1.0) + general_section("s", 1e5, 1.0) + points({{"bottom", 0.0, -1.0}, {"top", 0.0, 1.0}}) +
             member("right", "bottom", "top", "elastica", 24, "via = [1.0, 0.0]") +
             member("left", "top", "bottom", "elastica", 24, "via = [-1.0, 0.0]") +
             supports({{"bottom", "rotation"}, {"top", "x rotation"}}) + prescribed("top", "z = -1.0") +
             flat_wall("floor", "below", -1.0, rough(0.5)) + wall_monitor("force", "floor", "force-z") +
             wall_monitor("use", "floor", "friction-use") +
             path("step = 0.01; output_at = { lambda = [0.1] }; stop = { lambda = [-1.0, 0.3] }"));
  EXPECT_EQ(reason(session), EndReason::stop);
  for (const RecordPoint& point : session.points()) {
    if (point.lambda == 0.1) {
      EXPECT_NEAR(point.monitors[0], 0.625382563985, 1e-8);
    }
    if (point.lambda > 0.0) {
      EXPECT_LE(point.monitors[1], 1e-7);
    }
    EXPECT_EQ(total_dissipation(point), 0.0);
  }
  EXPECT_EQ(session.points().back().lambda, 0.3);
  EXPECT_NEAR(monitor_at_end(session, 0), 1.666264845603, 1e-8);
}

// The tip of a wire with another friction than its shaft: with 0.3 at the tip alone it slips as with 0.3 everywhere.
TEST(Friction, APairMayNameAPoint) {
  const std::string stages = stage("press", "prescribed.0", 0.0005, -1.0, 0.1);
  const std::string pair = "[[friction]]\npoint = \"tip\"\ncoefficient = 0.3\n";
  const Session all = run_of(strip(0.3, stages)), tip = run_of(strip(0.0, stages) + pair);
  ASSERT_EQ(all.points().size(), tip.points().size());
  for (std::size_t i = 0; i < all.points().size(); ++i) EXPECT_EQ(all.points()[i].monitors, tip.points()[i].monitors);
}

// What lies in a corner of two rough walls.
TEST(Friction, TwoFrictionsAtOneEndAreNotDetermined) {
  std::string text = block(0.3);
  text +=
      "[[wall]]\nname = \"stop\"\ncontact_surface = \"axis\"\nfriction = 0.3\n"
      "outline = { type = \"half-plane\", point = [10.02, 0.0], normal = [-1.0, 0.0] }\n";
  const Session session = run_of(text);
  EXPECT_EQ(reason(session), EndReason::not_modelled);
  EXPECT_NE(session.record().branches.back().end->detail.find("two frictions at one end"), std::string::npos);
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
  const auto expect_said = [&](const std::string& text, const std::string& words) {
    EXPECT_NE(message(text).find(words), std::string::npos) << message(text);
  };
  const auto with_friction = [&](const std::string& value) {
    std::string text = good;
    return text.replace(text.find("friction = 0.3"), 14, "friction = " + value);
  };
  const auto with_path = [&](const std::string& options) {
    return strip(0.3, "[path]\nstep = 0.01\n" + options + "\n[path.stop]\nlambda = [-1.0, 0.1]\n");
  };
  expect_said(with_friction("-0.1"),
              "friction must not be negative: it is the ratio of the greatest friction force to the contact force");
  expect_said(with_friction("\"rough\""),
              "friction is a number, e.g. 0.3; for a contact that never slips give a large one, e.g. 1e3");
  expect_said(good + "[contact]\nmethod = \"penalty\"\npenalty = 1.0\n",
              "springs in place of walls have no friction; contact.method = \"multiplier\" has");
  expect_said(good + "[[friction]]\nmember = \"stripp\"\ncoefficient = 0.1\n",
              "there is no member \"stripp\"; did you mean \"strip\"?");
  expect_said(good + "[[friction]]\npoint = \"top\"\ncoefficient = 0.1\n", "there is no end of a member \"top\"");
  expect_said(good + "[[friction]]\ncoefficient = 0.1\n", "say what it is for: wall, member or point");
  expect_said(good + "[[monitor]]\nname = \"s\"\nwall = \"floor\"\ncomponent = \"slip\"\n",
              "slip is that of a place: give at");
  expect_said(good + "[[monitor]]\nname = \"s\"\nwall = \"floor\"\nat = \"tip\"\ncomponent = \"dissipation\"\n",
              "no dissipation");
  expect_said(with_path("branches = \"jump\""), "it jumps; where it comes to rest depends on the motion");
  expect_said(with_path("sensitivity = [\"wall.floor.friction\"]"),
              "events behind the first slip depend on the way that led there");
  const std::string lost = "[[monitor]]\nname = \"lost\"\ncomponent = \"dissipation\"\n";
  expect_said(with_path("watch = [\"lost\"]") + lost, "no turning points");
  expect_said(with_path("output_at = { lost = [0.1] }") + lost, "no value of \"lost\" can be solved for");
}

}  // namespace arcwall::friction_test
