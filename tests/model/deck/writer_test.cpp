#include "model/deck/writer.hpp"

#include <gtest/gtest.h>

#include <string>

#include "model/deck/reader.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::deck::writer_test {

namespace {

Deck read(std::string_view text) { return read_deck_text(text, "sample.toml"); }

void expect_same_after_writing(const Deck& deck) {
  const std::string text = to_toml(deck);
  const Deck again = read(text);
  EXPECT_EQ(again, deck) << text;
  EXPECT_EQ(to_toml(again), text);
}

}  // namespace

TEST(DeckWriter, WritesWhatReadsTheSame) {
  expect_same_after_writing(read(column_deck));
  expect_same_after_writing(read(full_deck));
}

TEST(DeckWriter, TellsDifferentDecksApart) {
  const Deck deck = read(column_deck);
  Deck other = deck;
  other.members.at(0).elements = 81;
  Deck elsewhere = read("\n\n" + std::string(column_deck));

  EXPECT_NE(deck, other);
  EXPECT_EQ(deck, elsewhere);
  EXPECT_NE(deck.members.at(0).position.line, elsewhere.members.at(0).position.line);
}

TEST(DeckWriter, WritesEveryDefault) {
  const std::string text = to_toml(read(column_deck));

  for (const char* line : {"method = \"spherical\"", "method = \"multiplier\"", "gap_tolerance = 1e-10", "step = 0.02",
                           "min_step = 1e-08", "max_step = 0.2", "max_points = 5000", "branches = \"most-stable\"",
                           "depth = 2", "watch = []", "events = \"locate\"", "constant = false", "moment = 0.0"}) {
    EXPECT_NE(text.find(std::string("\n") + line + "\n"), std::string::npos) << line;
  }
}

// In a comment, since it follows from other keys: who changes these gets another.
TEST(DeckWriter, SaysWhereContactIsLookedForAndWhy) {
  const std::string wall = "[[wall]]\nname = \"w\"\nside = \"above\"\nprofile = { type = \"flat\", z = 1.0 }\n";
  const std::string text = std::string(column_deck) + wall;
  const auto written = [](const std::string& deck) { return to_toml(read(deck)); };
  EXPECT_NE(written(text).find("\n# points = \"moving\": the default where all members are"), std::string::npos);
  EXPECT_NE(written(text + "[contact]\nmethod = \"penalty\"\npenalty = 1.0\n")
                .find("\n# points = \"nodes\": method penalty puts springs at nodes\n"),
            std::string::npos);
  EXPECT_NE(written(text + "[contact]\npoints = \"nodes\"\n").find("\npoints = \"nodes\"\n"), std::string::npos);
  EXPECT_EQ(written(std::string(column_deck)).find("# points"), std::string::npos);
  expect_same_after_writing(read(text));
}

TEST(DeckWriter, WritesEventsThatStop) {
  const std::string deck(column_deck);
  expect_same_after_writing(read(deck + "[path.stop]\nevent = \"limit-point\"\n"));
  expect_same_after_writing(read(deck + "[path.stop]\nevent = [\"branch-point\", \"contact-opens\"]\n"));
}

TEST(DeckWriter, KeepsTextAndNumbersExactly) {
  Deck deck = read(column_deck);
  deck.title = "quote \" backslash \\ newline \n tab \t bell \a é λ";
  deck.materials.at(0).E = 0.1 + 0.2;
  deck.points.at(1).at = {1.0 / 3.0, 1e300};

  const Deck again = read(to_toml(deck));

  EXPECT_EQ(again.title, deck.title);
  EXPECT_EQ(again.materials.at(0).E, 0.1 + 0.2);
  EXPECT_EQ(again.points.at(1).at, deck.points.at(1).at);
}

// A spline of many points must stay within the reader's limit on the length of a line.
TEST(DeckWriter, BreaksLongLists) {
  Deck deck = read(column_deck);
  SplineProfile profile;
  for (int i = 0; i < 20000; ++i) {
    profile.x.push_back(i / 3.0);
    profile.z.push_back(-1.0 - 1.0 / (i + 7.0));
  }
  deck.walls.push_back({.name = "ground", .side = Side::below, .profile = profile});

  EXPECT_EQ(read(to_toml(deck)), deck);
}

}  // namespace arcwall::deck::writer_test
