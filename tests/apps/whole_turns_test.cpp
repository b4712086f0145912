// States whose rotations differ by whole turns are one state.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/apps/traced_deck.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::whole_turns_test {

using namespace test::tables;
namespace {

using test::TracedDeck;

// A perfect column on hinges, which goes right round its foot.
const std::string column =
    title("whole turns") + material("steel", 21000.0) + rectangle("s", 3.918180471015534, 0.6616489527415612) +
    member("column", "foot", "top", "elastica", 28, "", "steel") +
    points({{"foot", 0.0, 0.0}, {"top", 0.0, 28.670695085225667}}) + supports({{"foot", "x z"}, {"top", "x"}}) +
    force("top", 0.0, -35.77008178355774) + monitor("side", "column:0.5", "x") + monitor("down", "top", "z", flipped) +
    path(
        R"(step = 0.05; stop = { lambda = [-2.0, 3.0], down = [-8.6012085255677, 37.271903610793366] }; branches = "all"; jumps = false)");

// A strip that is bent by a push of its end, and pressed beside its middle.
const std::string strip =
    title("whole turns") + material("steel", 2.0e5) + rectangle("strip", 10.0, 0.3) +
    points({{"left", 0.0, 0.0}, {"right", 100.0, 0.0}}) +
    supports({{"left", "x z rotation"}, {"right", "z rotation"}}) +
    member("strip", "left", "right", "elastica", 40, imperfection({{1, 0.02}}), "steel", "strip") +
    prescribed("right", "x = -0.5; constant = true") + force("strip:0.4", 0.0, -1.0) +
    monitor("mid", "strip:0.5", "z") +
    path(
        "step = 0.1; stop = { mid = [-8.0, 8.0], lambda = [-10.0, 20.0] }; search = true; search_at = [-5.312, "
        "-1.607]; jumps = false");

}  // namespace

// The branch along which both ends of the column lie at one place is its own image where the load changes its sign, so
// that the loop closes where it began: after one turn, along which the load swings between opposite values.
TEST(WholeTurns, CloseTheLoopOfAColumn) {
  const TracedDeck traced(column);
  const Record& record = traced.record();
  for (const RecordBranch& branch : record.branches) EXPECT_LT(branch.points, 60) << branch.id;
  const RecordBranch& loop = record.branches.back();
  ASSERT_TRUE(loop.end.has_value());
  EXPECT_EQ(loop.end->reason, EndReason::closed_loop);
  double least = infinity, greatest = -infinity, start = 0.0, end = 0.0;
  for (const RecordPoint& point : record.points) {
    if (point.branch != loop.id) continue;
    if (point.step == 0) start = point.lambda;
    end = point.lambda;
    least = std::min(least, point.lambda);
    greatest = std::max(greatest, point.lambda);
  }
  EXPECT_NEAR(end, start, 1e-8);
  EXPECT_NEAR(greatest, start, 1e-8);
  EXPECT_NEAR(least, -start, 1e-8);
}

// Every state that is found is another one, and the mesh resolves it: pushed together by 0.5 % it bears some hundred
// newtons, a folded element of EA = 600 kN a hundred times that.
TEST(WholeTurns, AreNotFoundAsOtherStatesSlow) {
  const TracedDeck traced(strip);
  const Record& record = traced.record();
  ASSERT_EQ(record.searches.size(), 2u);
  for (const RecordSearch& search : record.searches) {
    EXPECT_GE(search.found.size(), 2u);
    for (std::size_t i = 0; i < search.found.size(); ++i) {
      EXPECT_LT(std::abs(search.found[i].energy), 200.0);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(std::abs(search.found[i].energy - search.found[j].energy), 1e-3) << i << " and " << j;
    }
  }
}

}  // namespace arcwall::whole_turns_test
