#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "model/event_names.hpp"
#include "tests/model/friction_decks.hpp"
#include "tests/support/deck_tables.hpp"

// What friction dissipates, reversals, and what must not change the path. References as in friction_test.cpp.
namespace arcwall::friction_test {

using namespace test::tables;

namespace {

double dissipation_at_end(const Session& session, Index stage) {
  double last = 0.0;
  for (const RecordPoint& point : session.points())
    if (session.record().stage_number(point.branch) == stage)
      last = std::accumulate(point.dissipation.begin(), point.dissipation.end(), 0.0);
  return last;
}

std::string two_blocks(const std::string& stages) {
  return bars + "[point]\nA = [0.0, 0.0]\nB = [10.0, 0.0]\nC = [30.0, 0.0]\n" + bar("ab", "A", "B") +
         bar("bc", "B", "C") + weight("B", 1.0) + weight("C", 2.0) + stages;
}

// A bar of EA = 210 and length 10 in four elements on a floor, μ = 0.4, weight 0.05 a length at its nodes, pushed at
// its left end.
std::string heavy_bar(const std::string& stages) {
  std::string text = bars + "[point]\nA = [0.0, 0.0]\n";
  for (int i = 1; i <= 4; ++i) text += fmt::format("n{} = [{}, 0.0]\n", i, 2.5 * i);
  for (int i = 1; i <= 4; ++i)
    text += bar(fmt::format("b{}", i), i == 1 ? "A" : fmt::format("n{}", i - 1), fmt::format("n{}", i));
  for (int i = 1; i <= 4; ++i) text += weight(fmt::format("n{}", i), i < 4 ? 0.125 : 0.0625);
  text.replace(text.find("friction = 0.3"), 14, "friction = 0.4");
  return text + stages;
}

// A rope of 14 bars over half a drum of radius 100, μ = 0.25, with 10 at both ends and λ times 10 more at one: the
// right one, or mirrored the left one; in bars from left to right, or reversed from right to left.
std::string rope(bool mirrored, bool reversed) {
  std::string text =
      "[material.m]\nE = 1e4\n[section.s]\nshape = \"general\"\nA = 20.0\nI = 1.0\n"
      "[path]\nstep = 0.1\nstop = { lambda = [-0.1, 5.0] }\n"
      "[[wall]]\nname = \"drum\"\ncontact_surface = \"axis\"\nfriction = 0.25\n"
      "outline = { type = \"circle\", centre = [0.0, 0.0], radius = 99.999999 }\n[point]\n";
  const auto add = [&](int i, double x, double z) {
    text += fmt::format("p{} = [{:.12g}, {:.12g}]\n", i, mirrored ? -x : x, z);
  };
  add(0, -100.0, -200.0);
  for (int i = 1; i <= 13; ++i) {
    const double turned = (i - 1) * std::numbers::pi / 12.0;
    add(i, -100.0 * std::cos(turned), 100.0 * std::sin(turned));
  }
  add(14, 100.0, -200.0);
  for (int i = 0; i < 14; ++i)
    text += fmt::format(
        "[member.m{}]\nfrom = \"p{}\"\nto = \"p{}\"\ntheory = \"truss\"\nmaterial = \"m\"\nsection = "
        "\"s\"\nelements = 1\n",
        i, reversed ? i + 1 : i, reversed ? i : i + 1);
  for (const char* at : {"p0", "p14"}) text += weight(at, 10.0);
  return text + "[[load]]\nat = \"p14\"\nforce = [0.0, -10.0]\n";
}

const std::string all_of_dissipation = "[[monitor]]\nname = \"lost\"\ncomponent = \"dissipation\"\n";
const std::string use_of_floor = "[[monitor]]\nname = \"use\"\nwall = \"floor\"\ncomponent = \"friction-use\"\n";

const std::string press_and_drag =
    stage("press", "prescribed.0", 0.0005, -1.0, 0.4) + stage("drag", "prescribed.1", 0.01, -1.0, 0.2) +
    stage("back", "prescribed.1", -0.001, -0.4, 1.0) + stage("again", "prescribed.1", 0.001, -1.0, 0.4);
const std::string drawn_clamp = "[[prescribed]]\nat = \"clamp\"\nx = 1.0\n";

// λ of the changes of contact of all branches, in their order.
std::vector<double> changes(const Session& session) {
  std::vector<double> found;
  for (const RecordEvent& event : session.events())
    if (changes_contact(event.kind)) found.push_back(event.lambda);
  return found;
}

void expect_same_changes(const std::string& text, const std::vector<double>& expected, double tolerance,
                         double scale = 1.0) {
  const std::vector<double> found = changes(run_of(text));
  ASSERT_EQ(found.size(), expected.size()) << text;
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], scale * expected[i], scale * tolerance) << text;
}

}  // namespace

// 0.3 (0.05 − 0.3/21) on the way out; 4 · 0.3 (0.05 − 0.3/21) a cycle.
TEST(FrictionPath, BlockDissipatesTheWorkOfItsLoop) {
  const Session session = run_of(block(0.3) + all_of_dissipation + use_of_floor);
  EXPECT_NEAR(dissipation_at_end(session, 0), 0.0107142857142857, 1e-14);
  EXPECT_NEAR(dissipation_at_end(session, 2) - dissipation_at_end(session, 0), 0.0428571428571429, 1e-13);
  double before = 0.0;
  for (const RecordPoint& point : session.points()) {
    EXPECT_GE(point.monitors[1], before);
    before = point.monitors[1];
    EXPECT_LE(point.monitors[2], 1.0 + 1e-9);
  }
  EXPECT_EQ(session.points().front().monitors[2], 0.0);
  EXPECT_EQ(session.points().back().monitors[2], 1.0);
  EXPECT_EQ(session.points().back().monitors[1], dissipation_at_end(session, 2));
}

// B goes to and fro between ±0.107142857142857 under 0.3, C between ±0.05 under 0.6.
TEST(FrictionPath, TwoBlocksDissipateTheWorkOfTheirLoop) {
  const Session session = run_of(two_blocks(stage("out", "prescribed.0", 0.005, -1.0, 0.15) +
                                            stage("back", "prescribed.0", -0.005, -0.3, 1.0) +
                                            stage("again", "prescribed.0", 0.005, -1.0, 0.3)));
  EXPECT_NEAR(dissipation_at_end(session, 0), 0.3 * 0.107142857142857 + 0.6 * 0.05, 1e-13);
  EXPECT_NEAR(dissipation_at_end(session, 2) - dissipation_at_end(session, 0),
              4.0 * (0.3 * 0.107142857142857 + 0.6 * 0.05), 1e-12);
}

// Node i slips at u = Σ_{j<i} (F_i − 0.05 j) 2.5/210 with F_i = 0.05 i, the last at F = 0.175; turned at 0.004 back at
// twice these ways.
TEST(FrictionPath, HeavyBarSlipsNodeByNode) {
  const Session session = run_of(heavy_bar(stage("push", "prescribed.0", 0.0001, -1.0, 0.004) +
                                           stage("pull", "prescribed.0", -0.0001, -0.008, 1.0) +
                                           stage("push-again", "prescribed.0", 0.0001, -1.0, 0.008)));
  EXPECT_EQ(reason(session), EndReason::stop);
  expect_law(session);
  const std::vector<double> forward{0.000595238095238095, 0.00178571428571429, 0.00357142857142857};
  const auto out = lambdas(session, EventKind::contact_slips, 0), back = lambdas(session, EventKind::contact_slips, 1);
  ASSERT_EQ(out.size(), 3U);
  ASSERT_EQ(back.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(out[i], forward[i], 1e-12);
    EXPECT_NEAR(back[i], -2.0 * forward[i], 1e-12);
  }
  // The last node never slips. u_1 … u_3 at 0.004 with F = 0.15 + 210/10 (0.004 − 0.00357142857142857).
  const double force = 0.15 + 21.0 * (0.004 - 0.00357142857142857);
  double way = 0.004, loop = 0.0;
  for (int i = 1; i <= 3; ++i) {
    way -= (force - 0.05 * (i - 1)) * 2.5 / 210.0;
    loop += 4.0 * 0.05 * way;
  }
  EXPECT_NEAR(dissipation_at_end(session, 2) - dissipation_at_end(session, 0), loop, 1e-14);
}

// The same block, driven to and fro by the values that λ visits: in the path, and in the second of two stages.
TEST(FrictionPath, VisitsTurnTheBlockRound) {
  const double slip = 0.3 / 21.0;
  const auto expect_at = [](const std::vector<double>& found, double lambda) {
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0], lambda, 1e-12);
  };
  const std::string text = block_on_spring + all_of_dissipation + path("step = 0.005; visit = [0.05, -0.05, 0.05]");
  const Session run = run_of(text);
  EXPECT_EQ(reason(run), EndReason::stop);
  expect_law(run);
  expect_at(lambdas(run, EventKind::contact_slips, 0), slip);
  expect_at(lambdas(run, EventKind::contact_slips, 1), 0.05 - 2.0 * slip);
  expect_at(lambdas(run, EventKind::contact_slips, 2), -0.05 + 2.0 * slip);
  expect_at(lambdas(run, EventKind::reversal, 1), 0.05);
  expect_at(lambdas(run, EventKind::reversal, 2), -0.05);
  EXPECT_EQ(run.points().back().lambda, 0.05);
  EXPECT_NEAR(dissipation_at_end(run, 0), 0.0107142857142857, 1e-14);
  EXPECT_NEAR(dissipation_at_end(run, 2) - dissipation_at_end(run, 0), 0.0428571428571429, 1e-13);
  EXPECT_EQ(run.record().stages, (std::vector<std::string>{"visit-1", "visit-2", "visit-3"}));
  for (std::size_t killed = 1; killed < run.points().size(); ++killed) expect_resumed(text, run, killed);

  const Session staged =
      run_of(block_on_spring + stage("out", "prescribed.0", 0.005, -1.0, 0.05) +
             table("[[stage]]", R"(name = "cycle"; drives = ["prescribed.0"]; visit = [-0.1, 0.0])"));
  EXPECT_EQ(reason(staged), EndReason::stop);
  expect_at(lambdas(staged, EventKind::contact_slips, 1), -2.0 * slip);
  expect_at(lambdas(staged, EventKind::contact_slips, 2), -0.1 + 2.0 * slip);
  EXPECT_EQ(staged.points().back().lambda, 0.0);
}

TEST(FrictionPath, HeavyBarSlipsAsAWholeInTheEnd) {
  const Session session = run_of(heavy_bar(stage("push", "prescribed.0", 0.0001, -1.0, 0.006)));
  const auto out = lambdas(session, EventKind::contact_slips, 0);
  ASSERT_EQ(out.size(), 4U);
  EXPECT_NEAR(out[3], 0.0047619047619, 1e-12);
  EXPECT_NEAR(std::abs(monitor_at_end(session, 0)), 0.175, 1e-12);
}

// The cycle of a dragged strip with 0.2 of amplitude: 0.4342639376193.
TEST(FrictionPath, DraggedStripDissipatesTheWorkOfItsLoop) {
  const Session session = run_of(strip(0.3, press_and_drag, drawn_clamp));
  EXPECT_EQ(reason(session), EndReason::stop);
  EXPECT_NEAR(dissipation_at_end(session, 3) - dissipation_at_end(session, 1), 0.4342639376193, 1e-6);
}

// The error of the integral along the path is of the fourth order in the steps.
TEST(FrictionPath, DissipationConvergesWithTheSteps) {
  const auto lost = [](double longest) {
    return dissipation_at_end(run_of(strip(0.3, fmt::format("[path]\nmax_step = {}\n", longest) +
                                                    stage("press", "prescribed.0", 0.0005, -1.0, 0.4))),
                              0);
  };
  const double exact = lost(0.003), coarse = std::abs(lost(0.025) - exact), fine = std::abs(lost(0.0125) - exact);
  EXPECT_GT(coarse, 0.0);
  EXPECT_LT(fine, coarse / 8.0);
}

TEST(FrictionPath, AStageThatDrivesBackBeginsWithAReversal) {
  const Session session = run_of(strip(0.3, press_and_drag, drawn_clamp));
  std::vector<Index> reversed;
  for (const RecordEvent& event : session.events())
    if (event.kind == EventKind::reversal) reversed.push_back(event.branch);
  EXPECT_EQ(reversed, (std::vector<Index>{2, 3}));
}

TEST(FrictionPath, StepsAndMethodsDoNotChangeTheEvents) {
  const std::string node = incline(1.0), drawn = two_blocks(stage("out", "prescribed.0", 0.005, -1.0, 0.15) +
                                                            stage("back", "prescribed.0", -0.005, -0.25, 1.0));
  for (const std::string& text : {node, drawn}) {
    const std::vector<double> expected = changes(run_of(text));
    EXPECT_GE(expected.size(), 3U);
    for (const char* const options :
         {"max_step = 0.01", "max_step = 0.04", "max_step = 0.16", "method = \"load\"", "method = \"riks\"",
          "method = \"normal-plane\"", "method = \"cylindrical\"", "method = \"pseudo-arclength\""})
      expect_same_changes(text + "[path]\n" + options + "\n", expected, 1e-10);
  }
  const std::string pressed = strip(0.8, stage("press", "prescribed.0", 0.0005, -1.0, 0.08));
  const std::vector<double> expected = changes(run_of(pressed));
  for (const char* const options : {"max_step = 0.02", "max_step = 0.3", "method = \"riks\"",
                                    "method = \"normal-plane\"", "method = \"pseudo-arclength\""})
    expect_same_changes(pressed + "[path]\n" + options + "\n", expected, 1e-9);
}

TEST(FrictionPath, UnitsDoNotChangeTheEvents) {
  const auto in_units = [](double length, double newton) {
    return material("m", 210.0 * newton / (length * length)) +
           general_section("s", length * length, std::pow(length, 4)) +
           points({{"A", 0.0, 0.0}, {"B", 10.0 * length, 0.0}}) + supports({{"A", "z"}}) +
           prescribed("A", fmt::format("x = {}", length)) + flat_wall("floor", "below", 0.0, rough(0.3)) +
           force("B", 0.0, -newton, constant) + bar("bar", "A", "B") + stage("out", "prescribed.0", 0.005, -1.0, 0.05) +
           stage("back", "prescribed.0", -0.005, -0.1, 1.0);
  };
  const std::vector<double> expected = changes(run_of(in_units(1.0, 1.0)));
  EXPECT_EQ(expected.size(), 3U);
  expect_same_changes(in_units(1000.0, 1.0), expected, 1e-12);
  expect_same_changes(in_units(0.0254, 4448.0), expected, 1e-12);
}

TEST(FrictionPath, MirrorImagesHaveTheSameEvents) {
  const std::string text = strip(0.3, press_and_drag, drawn_clamp);
  std::string mirrored = text;
  mirrored.replace(mirrored.find("tip = [0.5, 0.0]"), 16, "tip = [-0.5, 0.0]");
  mirrored.replace(mirrored.find("x = 1.0"), 7, "x = -1.0");
  expect_same_changes(mirrored, changes(run_of(text)), 1e-10);
}

// By hand the rope slips as a whole at λ = 1.20406, the drum's polygon undeformed. Its last node leaves the drum where
// its force vanishes, and it goes on sliding as λ falls: for each copy alike.
TEST(FrictionPath, ARopeLeavesItsDrumInEachCopyAlikeSlow) {
  for (const bool mirrored : {false, true})
    for (const bool reversed : {false, true}) {
      const Session run = run_of(rope(mirrored, reversed));
      EXPECT_EQ(reason(run), EndReason::stop);
      const std::vector<double> slips = lambdas(run, EventKind::contact_slips, 0),
                                opens = lambdas(run, EventKind::contact_opens, 0);
      ASSERT_EQ(slips.size(), 7U);
      EXPECT_NEAR(slips.back(), 1.20406, 3e-4);
      ASSERT_EQ(opens.size(), 5U);
      EXPECT_NEAR(opens.front(), 1.204388568, 1e-8);
      EXPECT_EQ(lambdas(run, EventKind::contact_limit_point, 0), std::vector{opens.front()});
    }
}

// A reed is bent round a card that comes under it. Behind the snap the slip would turn back at 11.9425, and a stick
// would leave the cone: measured on one that was forced, |T| − μ p grows by 2.6 Δλ².
TEST(FrictionPath, JamsWhereAStickWouldLeaveTheCone) {
  const Session run = run_of(
      material("s", 2e5) + rectangle("s", 5.0, 0.5) + points({{"p", 0.0, 30.0}, {"e", 0.0, 0.0}}) +
      supports({{"p", "x z rotation"}}) + member("s", "p", "e", "elastica", 16, "", "s") +
      wall(
          "card",
          R"(contact_surface = "axis"; friction = 0.3; outline = { type = "circle", centre = [6.0, -1.0], radius = 2.0 }; motion = { x = -1.0 })") +
      stage("go", "wall.card", 0.05, -0.1, 16.0));
  EXPECT_EQ(reason(run), EndReason::jammed);
  EXPECT_NEAR(run.points().back().lambda, 11.94248, 1e-5);
  EXPECT_TRUE(lambdas(run, EventKind::contact_sticks, 0).empty());
}

// A ladder whose contacts slip or stick from the start, and a block that is dragged to and fro.
TEST(FrictionPath, BeginsAtLambdaZero) {
  const std::string ladder =
      material("alu", 7e7) + rectangle("rail", 0.06, 0.08) + points({{"foot", 0.0, 0.0}, {"top", 1.5, 4.0}}) +
      path("step = 0.05; stop = { lambda = [-0.1, 2.0] }") +
      member("ladder", "foot", "top", "euler-bernoulli", 20, "", "alu", "rail") +
      force("ladder:0.25", 0.0, -1.0, constant) + force("ladder:0.75", 0.0, -1.0) +
      wall(
          "floor",
          R"(contact_surface = "axis"; friction = 0.3; outline = { type = "half-plane", point = [0.0, 0.0], normal = [0.0, 1.0] })") +
      wall(
          "house",
          R"(contact_surface = "axis"; friction = 0.2; outline = { type = "half-plane", point = [1.5, 0.0], normal = [-1.0, 0.0] })");
  for (const std::string& text : {ladder, block(0.3), rope(false, false)}) {
    const Session run = run_of(text);
    for (const RecordPoint& point : run.points())
      if (point.step == 0) {
        EXPECT_EQ(point.lambda, 0.0);
      }
    for (const RecordEvent& event : run.events())
      if (event.step == 0) {
        EXPECT_EQ(event.lambda, 0.0) << to_text(event.kind);
      }
  }
}

// Weights that press blocks one after the other, in either order, before they are drawn.
TEST(FrictionPath, TheOrderOfWeightsDoesNotChangeTheEvents) {
  const auto pressed = [](const char* first, const char* second) {
    const std::string weights =
        "[[load]]\nat = \"B\"\nforce = [0.0, -1.0]\n[[load]]\nat = \"C\"\nforce = [0.0, -2.0]\n";
    return bars + "[point]\nA = [0.0, 0.0]\nB = [10.0, 0.0]\nC = [30.0, 0.0]\n" + bar("ab", "A", "B") +
           bar("bc", "B", "C") + weights + stage("first", first, 0.5, -1.0, 1.0) +
           stage("second", second, 0.5, -1.0, 1.0) + stage("out", "prescribed.0", 0.005, -1.0, 0.15);
  };
  const Session one = run_of(pressed("load.0", "load.1")), other = run_of(pressed("load.1", "load.0"));
  const auto expected = lambdas(one, EventKind::contact_slips, 2), found = lambdas(other, EventKind::contact_slips, 2);
  ASSERT_EQ(expected.size(), 2U);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(expected[0], 0.3 / 21.0, 1e-12);
  EXPECT_NEAR(expected[1], 0.1, 1e-12);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
}

// Killed at every change of contact, just behind it, on the slip between, and where a stage has turned.
TEST(FrictionPath, RunsResumedAtEventsAreEqualToTheLastBit) {
  const std::string text = strip(0.3, press_and_drag, drawn_clamp) + all_of_dissipation;
  const Session whole = run_of(text);
  const std::size_t points = whole.points().size();
  std::vector<std::size_t> killed{points / 4};
  for (std::size_t i = 0; i < points; ++i)
    if (const auto& event = whole.points()[i].event;
        event && (changes_contact(*event) || *event == EventKind::reversal))
      killed.insert(killed.end(), {i + 1, i + 2});
  EXPECT_GE(killed.size(), 7U);
  for (const std::size_t at : killed) {
    if (at >= points) continue;
    expect_resumed(text, whole, at);
  }
}

}  // namespace arcwall::friction_test
