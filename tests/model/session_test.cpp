#include "answers/sessions.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::session_test {

namespace {

struct Case {
  std::string deck;
  std::vector<std::string> assignments{};
};

// Contact that slides, contact at nodes with several branches, a long frame without walls, beams with a thickness.
const std::vector<Case> runs{{"channel"},
                             {"channel", {"contact.points = 'nodes'", "path.branches = 'all'"}},
                             {"lee", {"member.column.elements = 400"}},
                             {"thick"}};

Session opened(const Case& run) {
  return open_session(std::string(EXAMPLES) + "/" + run.deck + ".toml", run.assignments);
}

// All of a run as bytes: every state, event and branch.
std::string traced(const Case& run) {
  Session session = opened(run);
  while (session.next() != nullptr) {
  }
  EXPECT_GT(session.points().size(), 5U);
  return session.checkpoint();
}

}  // namespace

// The same to the last bit as one after the other, also beside a run of the same deck.
TEST(Session, TwoAtOnceInTwoThreadsGiveWhatEachGivesAloneSlow) {
  std::vector<std::string> alone;
  for (const Case& run : runs) alone.push_back(traced(run));
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t j = i; j < runs.size(); ++j) {
      std::string first, second;
      std::thread one([&] { first = traced(runs[i]); });
      std::thread other([&] { second = traced(runs[j]); });
      one.join();
      other.join();
      EXPECT_TRUE(first == alone[i]) << runs[i].deck;
      EXPECT_TRUE(second == alone[j]) << runs[j].deck;
    }
}

// What it was made from may go: the file, the texts, the session that it was moved from.
TEST(Session, OwnsAllThatItNeeds) {
  const auto folder = std::filesystem::temp_directory_path() / "arcwall_session_test";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "column.toml").string();
  std::ofstream(file) << deck::column_deck;
  const std::string whole = [&] {
    Session session = open_session(file);
    while (session.next() != nullptr) {
    }
    return session.checkpoint();
  }();

  std::vector<Session> kept;
  {
    Session session = open_session(file);
    session.next();
    kept.push_back(std::move(session));
  }
  std::filesystem::remove_all(folder);
  while (kept.front().next() != nullptr) {
  }

  EXPECT_TRUE(kept.front().checkpoint() == whole);
  EXPECT_TRUE(kept.front().has_ended());
  EXPECT_EQ(kept.front().description().deck_text, deck::column_deck);
}

TEST(Session, BeginsTheRunWhereNobodyHas) {
  Session asked = opened({"truss"}), begun = opened({"truss"});
  ASSERT_TRUE(begun.begin());
  EXPECT_TRUE(begun.points().empty());
  const RecordPoint* first = asked.next();
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first, &asked.points().front());
  EXPECT_EQ(first->state.x, begun.next()->state.x);
}

TEST(Session, BeginsOnce) {
  const std::string alone = traced({"truss"});
  Session session = opened({"truss"});
  ASSERT_TRUE(session.begin());
  EXPECT_TRUE(session.begin());
  session.next();
  EXPECT_TRUE(session.begin());
  EXPECT_EQ(session.points().size(), 1U);
  Session again = resume_session(session.checkpoint(), "checkpoint", Session::Resume::go_on);
  EXPECT_TRUE(again.begin());
  while (again.next() != nullptr) {
  }
  EXPECT_TRUE(again.checkpoint() == alone);
}

TEST(Session, HasNoPointsWhereItFindsNoStart) {
  std::ostringstream deck;
  deck << std::ifstream(std::string(EXAMPLES) + "/truss.toml").rdbuf()
       << "[[load]]\nat = \"top\"\nforce = [0.0, -1e300]\nconstant = true\n";
  Session session = make_session({.deck = "heavy.toml", .deck_text = deck.str()});
  EXPECT_FALSE(session.begin());
  const std::string problem = session.problem();
  EXPECT_NE(problem.find("find no equilibrium"), std::string::npos) << problem;
  EXPECT_EQ(session.next(), nullptr);
  EXPECT_FALSE(session.begin());
  EXPECT_EQ(session.problem(), problem);
  EXPECT_TRUE(session.points().empty());
  EXPECT_FALSE(session.has_ended());
}

// Driven by λ the same loads have a limit point at λ = 0.843, behind which the path goes back for ever.
TEST(Session, SaysWhereAStructureGivesWayToItsConstantLoads) {
  Session session = make_session({.deck = "portal.toml", .deck_text = R"toml(
title = "A portal under constant loads beyond its limit"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e4, I = 1.0 }
point = { a = [0.0, 0.0], e = [0.0, 0.7], f = [1.0, 0.7], b = [1.0, 0.0] }
support = { a = ["x", "z", "rotation"], b = ["x", "z"] }
member.left = { from = "a", to = "e", theory = "elastica", elements = 4, material = "m", section = "s" }
member.top = { from = "e", to = "f", theory = "elastica", elements = 4, material = "m", section = "s" }
member.right = { from = "f", to = "b", theory = "elastica", elements = 4, material = "m", section = "s" }
load = [{ at = "e", force = [3.0, -30.0], constant = true }, { at = "top:0.5", force = [0.0, -1.0] }]
path = { step = 0.1, stop = { lambda = [-1.0, 1.0] } }
)toml"});
  EXPECT_FALSE(session.begin());
  EXPECT_NE(session.problem().find("turns back at about 0.84 of their value"), std::string::npos) << session.problem();
}

TEST(Session, IsNotStoppedBeforeItBegins) {
  Session session = opened({"truss"});
  session.stop({.reason = EndReason::max_points, .detail = ""});
  EXPECT_FALSE(session.has_ended());
  while (session.next() != nullptr) {
  }
  EXPECT_TRUE(session.checkpoint() == traced({"truss"}));
}

TEST(Session, SaysWhatIsWrongWithADeck) {
  EXPECT_THROW(open_session("no such file.toml"), InputError);
  EXPECT_THROW(opened({"truss", {"section.bar.A = -1.0", "member.left.elements = 0"}}), InputError);
}

}  // namespace arcwall::session_test
