#include "model/deck/syntax_hints.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/toml_source.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::deck::syntax_hints_test {

namespace {

// What is said about a text that is not TOML; empty if it is.
std::string said_of(const std::string& text) {
  try {
    parse_toml(text, "s.toml");
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().size(), 1u);
    return to_text(error.diagnostics().front());
  }
  return {};
}

std::string said_of_value(const std::string& value) { return said_of("a = 1\nb = " + value + "\nc = 2\n"); }

}  // namespace

TEST(TomlSlips, TextWithoutQuotes) {
  EXPECT_EQ(said_of_value("classic"), "s.toml:2:5: a text without quotes; write \"classic\"");
  EXPECT_EQ(said_of_value("Buckling in a channel  # so"),
            "s.toml:2:5: a text without quotes; write \"Buckling in a channel\"");
  EXPECT_EQ(said_of_value("[\"x\", rotation]"), "s.toml:2:11: a text without quotes; write \"rotation\"");
  EXPECT_EQ(said_of_value("{ type = flat, z = 1.0 }"), "s.toml:2:14: a text without quotes; write \"flat\"");
  EXPECT_EQ(said_of_value("\"classic"), "s.toml:2:5: a text without its closing quote; add \"");
}

// In a table on one line the comma ends the value.
TEST(TomlSlips, DecimalCommasInTables) {
  EXPECT_EQ(said_of_value("{ z = 2,5 }"), "s.toml:2:11: a decimal comma in 2,5; write 2.5");
  EXPECT_EQ(said_of_value("{ z = -2,5e-3, n = 1 }"), "s.toml:2:11: a decimal comma in -2,5e-3; write -2.5e-3");
  EXPECT_EQ(said_of_value("{ z = 2, n = 1 }"), "");
}

TEST(TomlSlips, WordsForTrueAndFalse) {
  EXPECT_EQ(said_of_value("True"), "s.toml:2:5: True is no value; write true");
  EXPECT_EQ(said_of_value("no"), "s.toml:2:5: no is no value; write false");
}

TEST(TomlSlips, NumbersAsOthersWriteThem) {
  EXPECT_EQ(said_of_value("2,1e4"), "s.toml:2:5: a decimal comma in 2,1e4; write 2.1e4");
  EXPECT_EQ(said_of_value("-0,5 # m"), "s.toml:2:5: a decimal comma in -0,5; write -0.5");
  EXPECT_EQ(said_of_value(".5"), "s.toml:2:5: a point without a digit on both sides in .5; write 0.5");
  EXPECT_EQ(said_of_value("5."), "s.toml:2:5: a point without a digit on both sides in 5.; write 5.0");
  EXPECT_EQ(said_of_value("2.1e4 kN"),
            "s.toml:2:5: a number with a unit, \"2.1e4 kN\"; write the number alone; labels of units stand in [units]");
  EXPECT_EQ(said_of_value("1/3"), "s.toml:2:5: a deck does not calculate: \"1/3\" is no number; write its value");
}

TEST(TomlSlips, BracketsThatAreMissing) {
  EXPECT_EQ(said_of_value("[1.0, 2.0"), "s.toml:2:5: the array that begins here is not closed; add ]");
  EXPECT_EQ(said_of_value("[ # ]\n  [1.0, 2.0],\n  [3.0, 4.0]"),
            "s.toml:2:5: the array that begins here is not closed; add ]");
  EXPECT_EQ(said_of("[material.steel\nE = 1\n"), "s.toml:1:16: the table header is not closed; write [material.steel]");
  EXPECT_EQ(said_of("[[load]\nat = 1\n"), "s.toml:1:8: the table header is not closed; write [[load]]");
}

TEST(TomlSlips, KeysAndHeaders) {
  EXPECT_EQ(said_of("a = 1\ntheory: \"classic\"\n"), "s.toml:2:7: a key and no = behind it; write theory = …");
  EXPECT_EQ(said_of("title\n"), "s.toml:1:6: a key without a value; write key = value");
  EXPECT_EQ(said_of("[wall]\nname = 1\n[wall]\nname = 2\n"),
            "s.toml:3:1: a second [wall]; begin each, the first too, with [[wall]]");
}

// Columns count characters, not bytes.
TEST(TomlSlips, PlacesBehindOtherLetters) {
  EXPECT_EQ(said_of("a = \"é λ\"\n\"ü\" = classic\n"), "s.toml:2:7: a text without quotes; write \"classic\"");
}

// Whatever is cut off a deck, there is a diagnostic or a deck, never anything else.
TEST(TomlSlips, AnyTextIsLookedAtWithoutHarm) {
  const std::string text(full_deck);
  constexpr std::size_t sizes[] = {1, 2, 7};
  for (std::size_t i = 0; i < text.size(); i += 3) {
    std::string cut = text;
    cut.erase(i, sizes[i / 3 % std::size(sizes)]);
    try {
      read_deck_text(cut, "cut.toml");
    } catch (const InputError& error) {
      EXPECT_FALSE(error.diagnostics().front().message.empty());
    }
  }
}

}  // namespace arcwall::deck::syntax_hints_test
