#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/writer.hpp"
#include "tests/apps/loading/loading_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::loading_test {

using namespace test::tables;

namespace {

// A column whose right end is pushed, and whose middle is; [cm, kN]. Its middle is pushed off by a little that stays.
std::string pushed_column(const std::string& more) {
  return column(centimetres, force("mid", 0.0, 0.002, constant) + force("mid", 0.0, 0.02) +
                                 prescribed("B", "x = -1.0") + path("step = 0.02") + monitor("mid", "mid", "z") +
                                 monitor("push", "B", "reaction-x") + more);
}

const std::string three_stages =
    table("[[stage]]",
          R"(name = "shorten"; drives = ["prescribed.0"]; stop = { lambda = [-0.1, 0.05] }; step = 0.005)") +
    table("[[stage]]",
          R"(name = "press"; drives = ["load.1"]; stop = { lambda = [-1.0, 0.5] }; output_at = { lambda = [0.25] })") +
    table("[[stage]]",
          R"(name = "release"; drives = ["prescribed.0"]; stop = { lambda = [-0.05, 0.1] }; step = -0.005)");

// The last point of each stage.
std::vector<RecordPoint> ends_of_stages(const Record& record) {
  std::vector<RecordPoint> ends(record.stages.size());
  for (const RecordPoint& point : record.points)
    ends[static_cast<std::size_t>(record.stage_number(point.branch))] = point;
  return ends;
}

std::string indented_in_and_out() {
  return column(
      centimetres,
      wall(
          "indenter",
          R"(side = "above"; contact_surface = "axis"; profile = { type = "circle", centre = [1.0, 1.05], radius = 1.0 }; motion = { z = -1.0, rotation = 0.3, about = [1.0, 1.05] })") +
          force("B", 0.05, 0.0) + path("step = 0.01") + monitor("mid", "mid", "z") +
          wall_monitor("push", "indenter", "force-z") +
          table("[[stage]]", R"(name = "in"; drives = ["wall.indenter"]; stop = { lambda = [-0.1, 0.15] })") +
          table("[[stage]]", R"(name = "pull"; drives = ["load.0"]; stop = { lambda = [-1.0, 1.0] }; step = 0.1)") +
          table("[[stage]]",
                R"(name = "out"; drives = ["wall.indenter"]; stop = { lambda = [-0.15, 0.1] }; step = -0.01)"));
}

// A bow that a plate presses down and a force draws out, in the stages of `order`.
std::string pressed_and_pulled(const std::string& order) {
  return title("Bow under a plate") + material("m", 21000.0) + rectangle("s", 0.1, 0.1) +
         points({{"A", 0.0, 0.0}, {"B", 2.0, 0.0}}) +
         member("arch", "A", "B", "elastica", 20, "sine = { rise = 0.3, waves = 1 }") +
         supports({{"A", "x z"}, {"B", "z"}}) +
         flat_wall("plate", "above", 0.32, R"(contact_surface = "axis"; motion = { z = -1.0 })") +
         force("B", 0.1, 0.0) + monitor("quarter", "arch:0.25", "z") + monitor("end", "B", "x") +
         wall_monitor("push", "plate", "force-z") + order;
}

const std::string press =
    table("[[stage]]", R"(name = "press"; drives = ["wall.plate"]; step = 0.01; stop = { lambda = [-0.1, 0.2] })");
const std::string pull =
    table("[[stage]]", R"(name = "pull"; drives = ["load.0"]; step = 0.1; stop = { lambda = [-1.0, 1.0] })");
const std::string back =
    table("[[stage]]", R"(name = "back"; drives = ["wall.plate"]; step = -0.01; stop = { lambda = [-0.2, 0.1] })");

std::string stage_problem(const std::string& from, const std::string& to) {
  std::string deck = pushed_column(three_stages);
  deck.replace(deck.find(from), from.size(), to);
  try {
    deck::read_deck_text(deck, "stages.toml");
  } catch (const InputError& error) {
    std::string all;
    for (const Diagnostic& one : error.diagnostics()) all += one.message + "\n";
    return all;
  }
  return "";
}

}  // namespace

// Each stage begins where the last has ended, and holds what that has moved: as if it had been there from the start.
TEST(Stages, FollowEachOther) {
  const TracedDeck staged(pushed_column(three_stages));
  const Record& record = staged.record();
  ASSERT_EQ(record.stages, (std::vector<std::string>{"shorten", "press", "release"}));
  const std::vector<RecordPoint> ends = ends_of_stages(record);
  ASSERT_EQ(ends[2].lambda, -0.05);
  for (std::size_t i = 1; i < record.points.size(); ++i) {
    const RecordPoint &before = record.points[i - 1], &here = record.points[i];
    if (record.stage_number(before.branch) == record.stage_number(here.branch)) continue;
    EXPECT_EQ(here.lambda, 0.0);
    for (std::size_t m = 0; m < here.monitors.size(); ++m) EXPECT_NEAR(here.monitors[m], before.monitors[m], 1e-10);
  }
  // Held by a constant movement, and by none.
  std::string held = pushed_column("[path.stop]\nlambda = [-1.0, 0.5]\n"), without = held;
  const std::string movement = "[[prescribed]]\nat = \"B\"\nx = -1.0\n";
  held.replace(held.find(movement), movement.size(), "[[prescribed]]\nat = \"B\"\nx = -0.05\nconstant = true\n");
  without.replace(without.find(movement), movement.size(), "[[prescribed]]\nat = \"B\"\nx = 0.0\nconstant = true\n");
  const TracedDeck after_shortening(held), alone(without);
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_NEAR(ends[1].monitors[m], after_shortening.record().points.back().monitors[m], 1e-9);
    EXPECT_NEAR(ends[2].monitors[m], alone.record().points.back().monitors[m], 1e-9);
  }
  expect_confirmed(staged);
}

TEST(Stages, AreNamedInTheFiles) {
  const TracedDeck staged(pushed_column(three_stages));
  const std::string path = path_csv(staged.record(), UnitLabels::shown);
  EXPECT_NE(path.find(",event,unstable_load_control,stage\n"), std::string::npos);
  EXPECT_NE(path.find(",start,0,shorten\n"), std::string::npos);
  const auto events = events_json(staged.record());
  EXPECT_EQ(events["events"].front()["stage"], "shorten");
  EXPECT_EQ(events["events"].back()["stage"], "release");
  EXPECT_EQ(events["branches"].back()["stage"], "release");
}

// An indenter that has been driven in, pulled at and drawn out again: contact closes, stays closed and opens.
TEST(Stages, MoveWallsInAndOut) {
  const TracedDeck staged(indented_in_and_out());
  const std::vector<RecordPoint> ends = ends_of_stages(staged.record());
  EXPECT_LT(ends[0].monitors[1], -0.01);
  EXPECT_LT(ends[0].monitors[0], -0.05);
  EXPECT_GT(ends[1].contacts, 0);
  EXPECT_EQ(ends[2].contacts, 0);
  EXPECT_NEAR(ends[2].monitors[0], 0.0, 1e-10);
  const auto opens = events_of(staged, EventKind::contact_opens);
  ASSERT_FALSE(opens.empty());
  EXPECT_EQ(staged.record().stage_of(opens.back().branch), "out");
  expect_confirmed(staged);
}

// What stages do in one order they do in the other: here nothing jumps, and no energy is lost. Contact points, spread
// stretches and the mesh with them are taken over from stage to stage.
TEST(Stages, DoTheSameInEitherOrderSlow) {
  const auto ends = [](const std::string& order) {
    const TracedDeck staged(pressed_and_pulled(order));
    EXPECT_EQ(staged.record().branches.back().end->reason, EndReason::stop);
    expect_confirmed(staged);
    return std::pair(staged.record().points.back(), events_of(staged, EventKind::contact_spreads).size());
  };
  const auto [press_first, spread_first] = ends(press + pull);
  const auto [pull_first, spread_later] = ends(pull + press);
  EXPECT_EQ(press_first.contacts, pull_first.contacts);
  EXPECT_GT(press_first.contacts, 0);
  for (std::size_t m = 0; m < press_first.monitors.size(); ++m)
    EXPECT_NEAR(press_first.monitors[m], pull_first.monitors[m], 1e-9) << m;
}

// A stage that is driven back leads to where it began.
TEST(Stages, LeadBackToTheStart) {
  const TracedDeck staged(pressed_and_pulled(pull + press + back));
  const std::vector<RecordPoint> ends = ends_of_stages(staged.record());
  for (std::size_t m = 0; m < ends[0].monitors.size(); ++m)
    EXPECT_NEAR(ends[2].monitors[m], ends[0].monitors[m], 1e-9) << m;
  EXPECT_EQ(ends[2].contacts, 0);
}

// A stage in two parts has the events of the whole, at the λ that are left.
TEST(Stages, MayBeCutInTwo) {
  std::string first = press, second = press;
  first.replace(first.find("0.2]"), 4, "0.08]");
  second.replace(second.find("\"press\""), 7, "\"more\"");
  second.replace(second.find("0.2]"), 4, "0.12]");
  const TracedDeck whole(pressed_and_pulled(pull + press)), cut(pressed_and_pulled(pull + first + second));
  std::vector<std::pair<EventKind, double>> expected, found;
  const auto collect = [](const TracedDeck& traced, const std::string& stage, double from, auto& to) {
    for (const RecordEvent& event : traced.record().events)
      if (event.kind != EventKind::start && event.kind != EventKind::end &&
          traced.record().stage_of(event.branch) == stage)
        to.emplace_back(event.kind, from + event.lambda);
  };
  collect(whole, "press", 0.0, expected);
  collect(cut, "press", 0.0, found);
  collect(cut, "more", 0.08, found);
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_FALSE(expected.empty());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].first, expected[i].first);
    EXPECT_NEAR(found[i].second, expected[i].second, 1e-9);
  }
}

// A member has the same parts in all stages, whichever of them drives a force or a moment inside it: what one stage and
// what two do, in either order, is the same.
TEST(Stages, MayDriveLoadsInsideAMemberOneAfterTheOther) {
  const std::string deck = R"(
title = "Loads inside a member"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e4, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "z", "rotation"] }
member.l = { from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 8 }
load = [{ at = "b", force = [0.0, -0.1] }, { at = "l:0.5", moment = 0.3 }, { at = "l:0.25", force = [0.0, -0.4] }]
wall = [{ name = "p", contact_surface = "axis", outline = { type = "half-plane", point = [0.0, -0.5], normal = [0.0, 1.0] } }]
monitor = [{ name = "z", at = "b", component = "z" }]
path = { stop = { lambda = [-2.0, 1.0] } }
)";
  const auto at_end = [&](const std::vector<std::string>& drives) {
    std::string stages;
    for (const std::string& one : drives)
      stages += fmt::format("[[stage]]\nname = \"s{}\"\ndrives = [{}]\n", stages.size(), one);
    const TracedDeck run(deck + stages);
    expect_confirmed(run);
    EXPECT_EQ(run.record().points.back().lambda, 1.0);
    return run.record().points.back().monitors.at(0);
  };
  const double together = at_end({"\"load.0\", \"load.1\", \"load.2\""});
  EXPECT_NEAR(at_end({"\"load.0\"", "\"load.1\"", "\"load.2\""}), together, 1e-9);
  EXPECT_NEAR(at_end({"\"load.2\"", "\"load.1\"", "\"load.0\""}), together, 1e-9);
}

// Stopped anywhere and taken up again, to the last bit.
TEST(Stages, GoOnFromACheckpointSlow) {
  for (const std::string& deck :
       {pushed_column(three_stages), indented_in_and_out(), pressed_and_pulled(pull + press + back)}) {
    const TracedDeck whole(deck);
    const std::size_t count = whole.record().points.size();
    for (const std::size_t stop : {std::size_t{3}, count / 2, count - 2}) {
      Session run = make_session({.deck = "deck.toml", .deck_text = deck});
      for (std::size_t i = 0; i < stop; ++i) ASSERT_NE(run.next(), nullptr);
      Session resumed = resume_session(run.checkpoint(), "checkpoint", Session::Resume::go_on);
      while (resumed.next() != nullptr) {
      }
      EXPECT_EQ(path_csv(resumed.record(), UnitLabels::shown), path_csv(whole.record(), UnitLabels::shown)) << stop;
      EXPECT_EQ(events_json(resumed.record()), events_json(whole.record())) << stop;
    }
  }
}

// A stage that ends early ends the run.
TEST(Stages, EndWhereOneDoes) {
  const TracedDeck cut(pushed_column(three_stages), {"path.max_points=3"});
  EXPECT_EQ(cut.record().branches.size(), 1u);
  EXPECT_EQ(cut.record().branches.back().end->reason, EndReason::max_points);
}

TEST(Stages, AreWrittenAsTheyAreRead) {
  const deck::Deck deck = deck::read_deck_text(pushed_column(three_stages), "stages.toml");
  EXPECT_EQ(deck::read_deck_text(deck::to_toml(deck), "written.toml"), deck);
}

TEST(Stages, SayWhatIsWrongWithThem) {
  EXPECT_EQ(stage_problem("title", "title"), "");
  EXPECT_NE(stage_problem("drives = [\"load.1\"]", "drives = [\"load.0\"]").find("is nothing that λ may drive"),
            std::string::npos);
  EXPECT_NE(stage_problem("drives = [\"load.1\"]", "drives = [\"prescribed.0\"]").find("no stage drives load.1"),
            std::string::npos);
  EXPECT_NE(stage_problem("drives = [\"load.1\"]", "drives = []").find("empty"), std::string::npos);
  EXPECT_NE(stage_problem("name = \"press\"", "name = \"shorten\"").find("the name of another stage"),
            std::string::npos);
  EXPECT_NE(stage_problem("step = 0.005", "branches = \"all\"").find("traces all branches"), std::string::npos);
  EXPECT_EQ(stage_problem("[[stage]]", "[contact]\npoints = \"moving\"\n[[stage]]"), "");
}

}  // namespace arcwall::loading_test
