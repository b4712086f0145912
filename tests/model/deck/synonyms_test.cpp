#include "model/deck/synonyms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/numbers.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/toml_source.hpp"
#include "model/deck/writer.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::deck::synonyms_test {

namespace {

bool is_key(std::string_view word) {
  return std::any_of(declared_keys().begin(), declared_keys().end(),
                     [&](const DeclaredKey& key) { return key.name == word; });
}

bool is_word(std::string_view word) {
  return std::any_of(declared_keys().begin(), declared_keys().end(), [&](const DeclaredKey& key) {
    return std::find(key.words.begin(), key.words.end(), word) != key.words.end();
  });
}

std::string all_replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// With all that a deck may say otherwise said so.
std::string in_other_words(std::string text) {
  for (const Synonym& one : synonyms()) {
    if (one.use != Synonym::Use::read) continue;
    const std::string word(one.word), other(one.other);
    if (is_word(word)) text = all_replaced(std::move(text), "\"" + word + "\"", "\"" + other + "\"");
    if (!is_key(word)) continue;
    for (const char* before : {"\n", "{ ", ", "})
      text = all_replaced(std::move(text), before + word + " = ", before + other + " = ");
  }
  return text;
}

// A deck that has each word that another one is read as.
std::string deck_of_all_words() {
  std::string text = replaced(full_deck, "branches = \"all\"", "branches = \"most-stable\"\njumps = false");
  text = replaced(text, "points = \"nodes\"", "points = \"moving\"");
  text = replaced(text, "contacts = 40", "contacts = 40\nevent = [\"contact-transfers\", \"turning-point\"]");
  return text + R"toml(
[curve]
event = { kind = "contact-shrinks", number = 2 }
parameter = "wall.upper.profile.z"
range = [4.0, 6.0]
output_at = [4.5]
)toml";
}

std::string problem_of(const std::string& text) {
  try {
    read_deck_text(text, "deck.toml");
  } catch (const InputError& error) {
    return error.diagnostics().front().message + "; " + error.diagnostics().front().cure;
  }
  return "";
}

}  // namespace

TEST(Synonyms, AreForKeysAndWordsOfDecksAndAreNoneThemselves) {
  for (const Synonym& one : synonyms()) {
    EXPECT_TRUE(is_key(one.word) || is_word(one.word)) << one.word;
    EXPECT_FALSE(one.use == Synonym::Use::read && is_word(one.other)) << one.other;
  }
}

TEST(Synonyms, AreReadAndNotWritten) {
  const std::string text = deck_of_all_words(), other = in_other_words(text);
  const Deck deck = read_deck_text(text, "deck.toml");
  const std::string written = to_toml(deck);
  EXPECT_EQ(read_deck_text(other, "deck.toml"), deck);
  EXPECT_EQ(to_toml(read_deck_text(other, "deck.toml")), written);
  for (const Synonym& one : synonyms()) {
    if (one.use != Synonym::Use::read) continue;
    const std::string word(one.other), wanted(one.word);
    EXPECT_EQ(written.find("\n" + word + " = "), std::string::npos) << word;
    EXPECT_EQ(written.find("\"" + word + "\""), std::string::npos) << word;
    const bool is_used =
        other.find("\"" + word + "\"") != std::string::npos || other.find(word + " = ") != std::string::npos;
    EXPECT_TRUE(is_used) << word << " is not in the deck of this test";
  }
}

TEST(Synonyms, MaySetValuesOfDecksThatHaveTheOtherKey) {
  const std::string now = deck_of_all_words(), before = in_other_words(now);
  const auto with = [](const std::string& text, const std::string& assignment) {
    return read_deck_text(text, "deck.toml", {assignment});
  };
  for (const std::string& text : {now, before}) {
    EXPECT_EQ(with(text, "path.land.lambda=[0.25]").path.output_at,
              with(text, "path.output_at.lambda=[0.25]").path.output_at);
    EXPECT_EQ(with(text, "path.land.lambda=[0.25]").path.output_at.at(1).values, std::vector{0.25});
    EXPECT_EQ(with(text, "wall.1.acts_on='axis'").walls[1].contact_surface, ContactSurface::axis);
    EXPECT_EQ(with(text, "wall.slope.contact_surface='axis'").walls[1].contact_surface, ContactSurface::axis);
    EXPECT_EQ(with(text, "path.branches='follow'").path.branches, BranchPolicy::most_stable);
    EXPECT_EQ(with(text, "curve={ event = { kind = 'limit-point' }, over = 'path.step', range = [-1.0, 1.0] }")
                  .curve->parameter,
              "path.step");
  }
  const Value root = parse_deck(before, "deck.toml");
  EXPECT_EQ(written_key(root, "path.land.lambda.0"), "path.output_at.lambda.0");
  EXPECT_EQ(written_key(root, "wall.bore.outline.keep"), "wall.6.outline.structure");
  EXPECT_EQ(std::get<DeckPart>(part_of(root, "path.search_tries")).value->integer, 7);
}

TEST(Synonyms, AreNoneWhereKeysAreNames) {
  const std::string text = replaced(column_deck, "[member.column]", "[member.keep]");
  const Deck deck = read_deck_text(text, "deck.toml", {"member.keep.elements=4"});
  ASSERT_EQ(deck.members.size(), 1U);
  EXPECT_EQ(deck.members[0].name, "keep");
  EXPECT_EQ(deck.members[0].elements, 4);
  EXPECT_EQ(written_key(parse_deck(text, "deck.toml"), "member.keep.elements"), "member.keep.elements");
}

TEST(Synonyms, BesideTheKeyThatTheyAreReadAsAreReported) {
  EXPECT_EQ(problem_of(std::string(column_deck) + "[path]\njumps = true\nlanding = false\n"),
            "\"landing\" is not a key of this table; did you mean jumps?");
}

}  // namespace arcwall::deck::synonyms_test
