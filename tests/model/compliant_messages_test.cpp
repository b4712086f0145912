#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/writer.hpp"
#include "tests/model/compliant_decks.hpp"

// What decks with compliant walls may say.
namespace arcwall::compliant_test {

TEST(CompliantWalls, RefuseWhatTheyAreNot) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      const Session session = make_session({.deck = "deck.toml", .deck_text = text});
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  const std::string good = beam_over_bed("euler-bernoulli", 4, 1.0);
  EXPECT_EQ(message(good), "");
  const auto expect_said = [&](const std::string& from, const std::string& to, const std::string& words) {
    std::string text = good;
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    EXPECT_NE(message(text).find(words), std::string::npos) << to << "\n" << message(text);
  };
  const std::string law = "law = { stiffness = 1e5 }";
  expect_said(law, "", "contact.law: is missing: wall \"bed\" has no law of its own");
  expect_said(law, "law = 3.0", "contact.law");
  expect_said(law, "law = {}", "the law has no stiffness");
  expect_said(law, "law = { stiffness = 0.0 }", "contact.law.stiffness");
  expect_said(law, "law = { stiffness = 1.0, depth = -1.0 }", "contact.law.depth");
  expect_said(law, "law = { stiffness = 1.0, penetration = [0.0, 1.0], pressure = [0.0, 1.0] }",
              "both a stiffness and a table");
  expect_said(law, "law = { stiffness = 1.0, interpolation = \"smooth\" }", "belongs to a table");
  expect_said(law, "law = { penetration = [0.0, 1.0], pressure = [0.0, 1.0], depth = 1.0 }",
              "belongs to a law with a stiffness");
  expect_said(law, "law = { penetration = [0.0, 1.0], pressure = [0.0] }", "2 penetrations and 1 pressures");
  expect_said(law, "law = { penetration = [0.1, 1.0], pressure = [0.0, 1.0] }", "does not begin without pressure");
  expect_said(law, "law = { penetration = [0.0, 1.0, 1.0], pressure = [0.0, 1.0, 2.0] }", "1 follows 1");
  expect_said(law, "law = { penetration = [0.0, 1.0], pressure = [0.0, -1.0] }", "walls push only");
  expect_said(law, "law = { penetration = [0.0, 1.0], pressure = [0.0, 0.0] }", "the wall has no pressure");
  expect_said(law, "law = { penetration = [0.0, 1.0], pressure = [0.0, 1.0], interpolation = \"cubic\" }",
              "interpolation");
  expect_said("method = \"compliant\"", "method = \"multiplier\"", "belongs to method \"compliant\"");
  expect_said(law, law + "\npoints = \"moving\"", "does not go with method \"compliant\"");
  expect_said(law, law + "\npenalty = 1.0", "does not go with method \"compliant\"");
  expect_said("[contact]", "interference = 0.3\n[contact]", "compliant walls have no interference");
  expect_said("z = -0.0001", "z = 0.0001", "is inside the wall at the start");
  expect_said("step = 0.1", "method = \"incremental\"\noutput_at = { lambda = [1.0] }",
              "does not support compliant walls");
  std::string truss = good;
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"euler-bernoulli", "truss"},
                                 {"elements = 4", "elements = 1"},
                                 {"at = \"beam:0.5\"\nforce", "at = \"right\"\nforce"},
                                 {"at = \"beam:0.5\"", "at = \"right\""},
                                 {"[0.0, -1.0]", "[1.0, 0.0]"}})
    truss.replace(truss.find(from), from.size(), to);
  EXPECT_NE(message(truss).find("which cannot carry the pressure of a compliant wall"), std::string::npos)
      << message(truss);
  expect_said(
      "[contact]",
      "[[wall]]\nname = \"lid\"\nside = \"above\"\ncontact_surface = \"axis\"\nprofile = { type = \"flat\", z = 0.0 }\n"
      "[[wall]]\nname = \"base\"\nside = \"below\"\ncontact_surface = \"axis\"\nprofile = { type = \"flat\", z = 0.0 "
      "}\n[contact]",
      "touches walls \"lid\" and \"base\" from both sides at the start");
  expect_said("wall = \"bed\"\ncomponent", "wall = \"bed\"\nat = \"left\"\ncomponent", "it has no force at \"left\"");
}

// A run may write its deck, with other values, and read it again.
TEST(CompliantWalls, AreReadAsTheyAreWritten) {
  for (const std::string law :
       {"{ stiffness = 1e5 }", "{ stiffness = 1e5, depth = 0.5 }",
        "{ penetration = [0.0, 1.0, 2.0], pressure = [0.0, 1.0, 3.0], interpolation = \"smooth\" }"}) {
    std::string text = beam_over_bed("euler-bernoulli", 4, 1.0);
    text.replace(text.find("{ stiffness = 1e5 }"), 19, law);
    text.insert(text.find("[contact]"), "law = " + law + "\n");
    const deck::Deck deck = deck::read_deck_text(text, "deck.toml");
    const deck::Deck again = deck::read_deck_text(deck::to_toml(deck), "deck.toml");
    EXPECT_EQ(deck.contact, again.contact);
    EXPECT_EQ(deck.walls.front().law, again.walls.front().law);
  }
}

}  // namespace arcwall::compliant_test
