#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/apps/loading/loading_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::loading_test {

using namespace test::tables;

namespace {

// Lee's frame whose loaded point is pushed down.
const std::string pushed_lees_frame =
    title("Lee's frame, pushed") + material("m", 720.0) + general_section("s", 6.0, 2.0) +
    points({{"foot", 0.0, 0.0}, {"corner", 0.0, 120.0}, {"loaded", 24.0, 120.0}, {"end", 120.0, 120.0}}) +
    member("column", "foot", "corner", "elastica", 20) + member("left", "corner", "loaded", "elastica", 4) +
    member("right", "loaded", "end", "elastica", 16) + supports({{"foot", "x z"}, {"end", "x z"}}) +
    prescribed("loaded", "z = -1.0") + path("step = 1.0; stop = { lambda = [-1.0, 90.0] }");

}  // namespace

// Values of the extensible elastica by shooting. The load limit, at P = 6.863177634771, is no event of this path: the
// column stays stable through it and snaps at the greatest shortening.
TEST(Prescribed, AColumnInAChannelSnapsAtItsGreatestShortening) {
  const TracedDeck traced(shortened_channel(centimetres));
  for (const Pushed& expected : {Pushed{EventKind::contact_closes, 0.032143539028, 0.430672151315, 0, 0},
                                 Pushed{EventKind::contact_splits, 0.05094848886, 1.713687836575, 0, 0},
                                 Pushed{EventKind::limit_point, 0.140743077449, 6.863020510418, 0, 1},
                                 Pushed{EventKind::limit_point, 0.13624180266, 6.211668066388, 1, 0},
                                 Pushed{EventKind::contact_closes, 0.313633947801, 4.252069687267, 0, 0}}) {
    const RecordEvent found = event_near(traced, expected.kind, expected.shortening);
    EXPECT_NEAR(found.lambda, expected.shortening, 3e-6 * expected.shortening);
    EXPECT_NEAR(-found.monitors[1], expected.P, 1e-4 * expected.P);
    EXPECT_EQ(found.unstable_before, expected.before);
    EXPECT_EQ(found.unstable_after, expected.after);
  }
  EXPECT_EQ(events_of(traced, EventKind::limit_point).size(), 2u);
}

TEST(Prescribed, GivesTheSameEventsInOtherUnitsSlow) {
  expect_same_events(TracedDeck(shortened_channel(centimetres)), TracedDeck(shortened_channel(metres)), 1e-8);
}

TEST(Prescribed, IsConfirmedWhateverTheContactSlow) {
  expect_confirmed(TracedDeck(shortened_channel(centimetres)));
  expect_confirmed(TracedDeck(shortened_channel(centimetres, "[contact]\npoints = \"nodes\"\n")));
}

// What is moved gets a column unless a monitor has it.
TEST(Prescribed, HasItsReactionAsAColumn) {
  const auto columns = [](const std::string& more) {
    std::vector<std::string> names;
    const TracedDeck traced(shortened_channel(centimetres, more), {"path.max_points=3"});
    for (const MonitorColumn& column : traced.model().monitors())
      names.push_back(column.name + " [" + column.unit + "]");
    return names;
  };
  const std::string units = "[units]\nlength = \"cm\"\nforce = \"kN\"\n";
  EXPECT_EQ(columns(units), (std::vector<std::string>{"mid [cm]", "reaction-x-B [kN]"}));
  EXPECT_EQ(columns(units + "[[monitor]]\nname = \"P\"\nat = \"B\"\ncomponent = \"reaction-x\"\nsign = -1\n"),
            (std::vector<std::string>{"mid [cm]", "P [kN]"}));
}

// Lee's frame (E = 720, A = 6, I = 2, sides 120, the load at 24) whose loaded point is pushed down: values by two
// independent solvers, also those of the displacement limits under a dead load.
TEST(Prescribed, LeesFrameSnapsWhereItsDeflectionTurns) {
  const TracedDeck traced(pushed_lees_frame);
  const RecordEvent down = event_near(traced, EventKind::limit_point, 61.002978851425);
  EXPECT_NEAR(down.lambda, 61.002978851425, 3e-6 * down.lambda);
  EXPECT_NEAR(-down.monitors[0], 1.19441041878, 1e-5);
  EXPECT_EQ(down.unstable_before, 0);
  EXPECT_EQ(down.unstable_after, 1);
  const RecordEvent back = event_near(traced, EventKind::limit_point, 50.746251363189);
  EXPECT_NEAR(back.lambda, 50.746251363189, 3e-6 * back.lambda);
  EXPECT_NEAR(-back.monitors[0], -0.438048021661, 1e-4);
  EXPECT_EQ(back.unstable_after, 0);
  EXPECT_EQ(events_of(traced, EventKind::limit_point).size(), 2u);
  // A dead load has its limit points at ways of 48.735137245104 and, where it is −0.941443155560, again.
  const auto& points = traced.record().points;
  const auto least = std::min_element(points.begin(), points.end(), [](const RecordPoint& a, const RecordPoint& b) {
    return -a.monitors[0] < -b.monitors[0];
  });
  bool behind_first = false;
  for (auto point = points.begin(); point != points.end(); ++point) {
    behind_first = behind_first || point->lambda > 48.735137245104;
    if (std::abs(point - least) <= 1 || !point->unstable_load_control) continue;
    EXPECT_EQ(*point->unstable_load_control, behind_first && point < least ? 1 : 0) << point->lambda;
  }
  expect_confirmed(traced);
}

TEST(Prescribed, LeesFrameSnapsWithTheOrderOfTheTheory) {
  constexpr double reference = 61.002978851425;
  for (const auto& [theory, order] : {std::pair("elastica", 5.0), std::pair("euler-bernoulli", 3.5)}) {
    SCOPED_TRACE(theory);
    std::vector<double> errors;
    for (const int times : {2, 4, 8}) {
      std::vector<std::string> assignments{"path.stop={ lambda = [-1.0, 61.5] }", "path.step=2.0"};
      for (const auto& [name, elements] : {std::pair("column", 5), std::pair("left", 1), std::pair("right", 4)}) {
        assignments.push_back(fmt::format("member.{}.elements={}", name, times * elements));
        assignments.push_back(fmt::format("member.{}.theory=\"{}\"", name, theory));
      }
      const TracedDeck traced(pushed_lees_frame, assignments);
      errors.push_back(event_near(traced, EventKind::limit_point, reference).lambda / reference - 1.0);
    }
    EXPECT_GT(least_order(errors, 1e-11), order) << errors[0] << ", " << errors[1] << ", " << errors[2];
  }
}

// Driven by the way of a point or by the force on it, the frame passes through the same states.
TEST(Prescribed, PassesThroughTheStatesOfADeadLoad) {
  const std::string monitors =
      "[[monitor]]\nname = \"turn\"\nat = \"loaded\"\ncomponent = \"rotation\"\n"
      "[[monitor]]\nname = \"x\"\nat = \"corner\"\ncomponent = \"x\"\n"
      "[[monitor]]\nname = \"push\"\nat = \"loaded\"\ncomponent = \"z\"\nsign = -1\n";
  const std::string force = "[[monitor]]\nname = \"F\"\nat = \"loaded\"\ncomponent = \"reaction-z\"\nsign = -1\n";
  std::string by_force = pushed_lees_frame;
  by_force.replace(by_force.find("[[prescribed]]"), 0, "[[load]]\nat = \"loaded\"\nforce = [0.0, -1.0]\n");
  by_force.erase(by_force.find("[[prescribed]]"), by_force.find("[path]") - by_force.find("[[prescribed]]"));
  const TracedDeck moved(pushed_lees_frame + monitors + force,
                         {"path.output_at={ lambda = [10.0, 30.0, 55.0] }", "path.stop={ lambda = [-1.0, 60.0] }"});
  const TracedDeck loaded(by_force + monitors, {"path.output_at={ push = [10.0, 30.0, 55.0] }",
                                                "path.stop={ push = [-1.0, 60.0] }", "path.step=0.1"});
  for (const double way : {10.0, 30.0, 55.0}) {
    SCOPED_TRACE(way);
    const auto at = [&](const TracedDeck& traced) {
      for (const RecordPoint& point : traced.record().points)
        if (std::abs(point.monitors[2] - way) <= 1e-9) return point;
      ADD_FAILURE() << "no such point";
      return traced.record().points.back();
    };
    const RecordPoint a = at(moved), b = at(loaded);
    EXPECT_NEAR(a.monitors[0], b.monitors[0], 1e-9);
    EXPECT_NEAR(a.monitors[1], b.monitors[1], 1e-9 * 120.0);
    EXPECT_NEAR(a.monitors[3], b.lambda, 1e-9);
  }
}

TEST(Prescribed, GivesTheSameEventsAlongAnyPathSlow) {
  expect_same_events_along_any_path(shortened_channel(centimetres), 0.004, 1e-8);
}

// A steep truss (b = 1, h = 5, Green's strain) whose apex is pushed down: it sways between z² = h² − 2b² on both sides,
// in closed form, and has no limit point at all. At rest it moves by symmetry alone, without any unknown.
TEST(Prescribed, ASteepTrussSwaysAndHasNoLimitPoint) {
  const TracedDeck traced(title("Steep truss, pushed") + material("m", 1.0) + general_section("s", 1.0, 1.0) +
                          points({{"left", -1.0, 0.0}, {"top", 0.0, 5.0}, {"right", 1.0, 0.0}}) +
                          member("a", "left", "top", "truss", 1) + member("b", "top", "right", "truss", 1) +
                          supports({{"left", "x z"}, {"right", "x z"}}) + prescribed("top", "z = -1.0") +
                          path(R"(step = 0.02; branches = "primary"; stop = { lambda = [-0.5, 10.5] })"));
  const auto sways = events_of(traced, EventKind::branch_point);
  ASSERT_EQ(sways.size(), 2u);
  EXPECT_NEAR(sways[0].lambda, 5.0 - std::sqrt(23.0), 1e-9);
  EXPECT_NEAR(-sways[0].monitors[0], 0.0723492263943, 1e-9);  // (h² − z²) z EA/L³ there
  EXPECT_EQ(sways[0].unstable_after, 1);
  EXPECT_NEAR(sways[1].lambda, 5.0 + std::sqrt(23.0), 1e-8);
  EXPECT_EQ(sways[1].unstable_after, 0);
  EXPECT_TRUE(events_of(traced, EventKind::limit_point).empty());
  // Under a dead load there are, by Green's closed forms, limit points at z = ± h/√3 as well.
  const double sway = 5.0 - std::sqrt(23.0), limit = 5.0 - 5.0 / std::sqrt(3.0);
  for (const RecordPoint& point : traced.record().points) {
    const double way = std::min(point.lambda, 10.0 - point.lambda);  // of either side
    if (std::abs(way - sway) < 1e-6 || std::abs(way - limit) < 1e-6) continue;
    ASSERT_TRUE(point.unstable_load_control.has_value()) << point.lambda;
    EXPECT_EQ(*point.unstable_load_control, way < sway ? 0 : way < limit ? 1 : 2) << point.lambda;
  }
  expect_confirmed(traced);
}

// Held while λ varies it is there from the start: as where λ has brought it.
TEST(Prescribed, IsAppliedBeforeThePathWhereItIsConstant) {
  const std::string path =
      "[path]\nstep = 0.1\noutput_at = { lambda = [0.2, 0.4, 0.6, 0.8] }\n[path.stop]\nlambda = [-0.1, 1.0]\n"
      "[[monitor]]\nname = \"mid\"\nat = \"mid\"\ncomponent = \"z\"\n";
  const std::string moved = "[[prescribed]]\nat = \"mid\"\nz = 0.1\nrotation = 0.2\n";
  const std::string load = "[[load]]\nat = \"B\"\nforce = [0.01, 0.0]\n";
  const TracedDeck by_lambda(column(centimetres, moved + path));
  const TracedDeck before(column(centimetres, moved + "constant = true\n" + load + path));
  const std::vector<double>& after = by_lambda.record().points.back().monitors;
  const std::vector<double>& start = before.record().points.front().monitors;
  ASSERT_EQ(start.size(), 3u);
  EXPECT_NEAR(before.record().points.front().lambda, 0.0, 1e-20);
  for (std::size_t i = 0; i < start.size(); ++i) EXPECT_NEAR(start[i], after[i], 1e-9 * (1.0 + std::abs(after[i])));
  expect_confirmed(before);
}

// A strip that is nearly straight and constantly shorter than it was leaves the straight shape with its imperfection,
// as where λ shortens it: shortening π² A²/4L less that by the thrust 4 π² EI/L², A = 9.0 and N = 172.7 in small
// slopes. Steps that counts do not bound lead past the bend, to a straight strip of many unstable directions.
TEST(Prescribed, ThatIsConstantFollowsAStripIntoItsBend) {
  const std::string strip = R"(
title = "Shortened strip"
units = { length = "mm", force = "N" }
material.steel = { E = 2.1e5 }
section.s = { shape = "rectangle", width = 10.0, height = 1.0 }
point = { a = [0.0, 0.0], b = [200.0, 0.0] }
support = { a = ["x", "z", "rotation"], b = ["z", "rotation"] }
monitor = [{ name = "mid", at = "c:0.5", component = "z" }, { name = "rx", at = "b", component = "reaction-x" }]
member.c = { from = "a", to = "b", theory = "elastica", material = "steel", section = "s", elements = 20, imperfection = )";
  const std::string path = "path = { step = 0.1, stop = { lambda = [-1.0, 1.0] } }\n";
  for (const std::string amplitude : {"0.005", "0.02", "0.1"}) {
    const std::string imperfect = strip + "{ shape = \"sine\", amplitude = " + amplitude + ", waves = 1 } }\n" + path;
    for (const std::string x : {"-0.2", "-1.0", "-4.0"}) {
      SCOPED_TRACE(amplitude + ", " + x);
      const TracedDeck by_lambda(imperfect + "prescribed = [{ at = \"b\", x = " + x + " }]\n");
      const TracedDeck before(imperfect + "prescribed = [{ at = \"b\", x = " + x +
                              ", constant = true }]\nload = [{ at = \"c:0.5\", force = [0.0, -0.1] }]\n");
      const RecordPoint &after = by_lambda.record().points.back(), &start = before.record().points.front();
      EXPECT_EQ(start.count.unstable, 0);
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(start.monitors[i], after.monitors[i], 1e-8 * std::abs(after.monitors[i]));
      if (x != "-1.0" || amplitude == "0.1") continue;
      EXPECT_NEAR(start.monitors[0], 9.0, 0.15);
      EXPECT_NEAR(start.monitors[1], -172.7, 1.0);
    }
  }
}

// Two beams, and a hinge at their joint: of either, or of both.
std::string joined_by_a_hinge(const std::string& first, const std::string& second) {
  return fmt::format(R"(
title = "Turned at a hinge"
material.m = {{ E = 21000.0, nu = 0.29 }}
section.s = {{ shape = "rectangle", width = 0.1, height = 0.1 }}
point = {{ A = [0.0, 0.0], B = [1.0, 0.0], C = [2.0, 0.0] }}
support = {{ A = ["x", "z", "rotation"], B = ["z"], C = ["z", "rotation"] }}
prescribed = [{{ at = "B", rotation = 0.1 }}]
path = {{ step = 0.2, output_at = {{ lambda = [0.2, 0.4, 0.6, 0.8] }}, stop = {{ lambda = [-1.0, 1.0] }} }}
monitor = [{{ name = "left", at = "first:1", component = "rotation" }}, {{ name = "right", at = "second:0", component = "rotation" }},
           {{ name = "M_left", at = "first:1", component = "moment" }}, {{ name = "M_right", at = "second:0", component = "moment" }}]
[member]
first = {{ from = "A", to = "B", theory = "euler-bernoulli", elements = 4, material = "m", section = "s"{} }}
second = {{ from = "B", to = "C", theory = "euler-bernoulli", elements = 4, material = "m", section = "s"{} }}
)",
                     first, second);
}

// The rotation is that of the ends that are joined rigidly, as of supports and springs; an end with a hinge keeps its
// own and carries no moment.
TEST(Prescribed, TurnsAtAHingeTheEndsThatAreRigidlyJoined) {
  const std::string hinged = ", hinge = [\"to\"]", also_hinged = ", hinge = [\"from\"]";
  for (const bool left : {true, false}) {
    SCOPED_TRACE(left ? "the left one has a hinge" : "the right one has a hinge");
    const TracedDeck traced(joined_by_a_hinge(left ? hinged : "", left ? "" : also_hinged));
    const std::vector<double>& last = traced.record().points.back().monitors;
    const double turn = left ? last[1] : last[0], free = left ? last[0] : last[1];
    EXPECT_NEAR(turn, 0.1, 1e-14);
    EXPECT_LT(std::abs(free), 0.01);
    EXPECT_NEAR(left ? last[2] : last[3], 0.0, 1e-12);
    EXPECT_GT(std::abs(left ? last[3] : last[2]), 1e-2);
    expect_confirmed(traced);
  }
  try {
    TracedDeck none(joined_by_a_hinge(hinged, also_hinged));
    FAIL() << "both ends have a hinge";
  } catch (const InputError& error) {
    EXPECT_NE(to_text(error.diagnostics().front()).find("prescribed.rotation: no member end at \"B\" has a rotation"),
              std::string::npos)
        << to_text(error.diagnostics().front());
  }
}

}  // namespace arcwall::loading_test
