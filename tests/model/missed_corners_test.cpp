// A symmetric toggle that has swayed aside lies on a floor with one of its halves, and comes back to the symmetric path
// where that half is let go and the other one touches. Its two halves have different meshes then, so that they do so
// within their errors only; yet what follows is that both lie on the floor, stable, and not the unstable path on which
// both are free.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/session.hpp"

namespace arcwall::missed_corners_test {
namespace {

const std::string common = R"toml(
[material.steel]
E = 21000.0
nu = 0.3
[section.s]
shape = "rectangle"
width = 0.85
height = 0.145
[[wall]]
name = "floor"
side = "below"
profile = { type = "flat", z = -0.6 }
[[monitor]]
name = "down"
at = "top"
component = "z"
sign = -1
)toml";

std::string toggle(int elements) {
  const std::string more =
      ", theory = \"elastica\", material = \"steel\", section = \"s\", elements = " + std::to_string(elements) + " }\n";
  return "title = \"a toggle above a floor\"\n"
         "[point]\na = [0.0, 0.0]\ntop = [7.0, 0.96]\nb = [14.0, 0.0]\n"
         "[support]\na = [\"x\", \"z\", \"rotation\"]\nb = [\"x\", \"z\", \"rotation\"]\n"
         "[[load]]\nat = \"top\"\nforce = [0.0, -0.26]\n"
         "[path]\nstep = 0.05\nstop = { lambda = [-3.0, 3.0] }\n"
         "[member]\nwest = { from = \"a\", to = \"top\"" +
         more + "east = { from = \"top\", to = \"b\"" + more + common;
}

// One half of it, whose top moves up and down only: the symmetric path.
std::string half() {
  return "title = \"half a toggle above a floor\"\n"
         "[point]\na = [0.0, 0.0]\ntop = [7.0, 0.96]\n"
         "[support]\na = [\"x\", \"z\", \"rotation\"]\ntop = [\"x\", \"rotation\"]\n"
         "[[load]]\nat = \"top\"\nforce = [0.0, -0.13]\n"
         "[path]\nstep = 0.05\nstop = { lambda = [-6.0, 6.0], contacts = 1 }\n"
         "[member]\nwest = { from = \"a\", to = \"top\", theory = \"elastica\", material = \"steel\", section = \"s\", "
         "elements = 56 }\n" +
         common;
}

Session traced(const std::string& deck) {
  Session run({.deck = "deck.toml", .deck_text = deck});
  EXPECT_TRUE(run.begin()) << run.problem();
  while (run.next() != nullptr) {
  }
  return run;
}

std::vector<RecordEvent> events_of(const Session& run, EventKind kind) {
  std::vector<RecordEvent> found;
  for (const RecordEvent& event : run.events())
    if (event.kind == kind) found.push_back(event);
  return found;
}

TEST(MissedCorners, AreLeftWithTheContactThatMissedThemByTheErrorOfTheMeshSlow) {
  const Session symmetric = traced(half());
  const auto touches = events_of(symmetric, EventKind::contact_closes);
  ASSERT_EQ(touches.size(), 1u);
  for (const int elements : {20, 28, 56}) {
    SCOPED_TRACE(elements);
    const Session run = traced(toggle(elements));
    EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
    const auto closes = events_of(run, EventKind::contact_closes);
    ASSERT_EQ(closes.size(), 2u);
    EXPECT_NEAR(closes[1].lambda, touches[0].lambda, 3e-5);
    const RecordPoint& last = run.record().points.back();
    EXPECT_EQ(last.lambda, 3.0);
    EXPECT_EQ(last.contacts, 2);
    EXPECT_EQ(last.count.unstable, 0);
  }
}

// Just before the corner the contact that is let go there still holds.
TEST(MissedCorners, AreReachedWithTheCountOfTheContactsThatHoldUpToThemSlow) {
  const auto limits = events_of(traced(toggle(28)), EventKind::limit_point);
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_EQ(limits[0].unstable_before, 0);
  EXPECT_EQ(limits[0].unstable_after, 1);
  EXPECT_EQ(limits[1].unstable_before, 1);
  EXPECT_EQ(limits[1].unstable_after, 0);
}

}  // namespace
}  // namespace arcwall::missed_corners_test
