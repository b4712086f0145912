#include "apps/explore/deck_numbers.hpp"

#include <gtest/gtest.h>

#include "apps/output/key_names.hpp"
#include "core/error.hpp"
#include "model/deck/numbers.hpp"
#include "model/deck/toml_source.hpp"
#include "tests/apps/traced_deck.hpp"

namespace arcwall::deck_numbers_test {
namespace {

using explore::WrittenNumber;

constexpr std::string_view text = R"(units = { length = "mm", force = "N" }
member.strip = { elements = 4, imperfection = [{ shape = "sine", amplitude = 1e-3, waves = 1 }] }
wall = [
  { name = "upper", profile = { z = 2 } },
  { name = "same", profile = { z = inf } }, { name = "same", profile = { z = 4.5 } },
]
path.jumps = true
"quoted key" = 7
[variables]
gap = 3
)";

std::vector<std::string> words(const std::vector<WrittenNumber>& numbers) {
  std::vector<std::string> all;
  for (const WrittenNumber& one : numbers)
    all.push_back(one.key + " [" + one.unit + "] " + std::to_string(one.position.line) + ":" +
                  std::to_string(one.position.column) + (one.whole ? " whole" : ""));
  return all;
}

TEST(DeckNumbers, HaveKeysUnitsAndPlacesVariablesFirst) {
  EXPECT_EQ(words(explore::written_numbers(text, "deck.toml", 100)),
            (std::vector<std::string>{"variables.gap [] 10:7", "member.strip.elements [] 2:29 whole",
                                      "member.strip.imperfection.0.amplitude [mm] 2:78",
                                      "member.strip.imperfection.0.waves [] 2:92 whole",
                                      "wall.upper.profile.z [mm] 4:37", "wall.2.profile.z [mm] 5:78"}));
}

TEST(DeckNumbers, AreAtMostAsManyAsAreAskedFor) {
  EXPECT_EQ(explore::written_numbers(text, "deck.toml", 2).size(), 2u);
}

TEST(DeckNumbers, NeedATextThatIsToml) { EXPECT_THROW(explore::written_numbers("a = [", "deck.toml", 10), InputError); }

// As --set, sweeps and sensitivities find them.
TEST(DeckNumbers, OfAnExampleAreKeysOfSet) {
  const std::string channel(test::example("channel"));
  const deck::Value root = deck::parse_deck(channel, "channel.toml");
  const std::vector<WrittenNumber> numbers = explore::written_numbers(channel, "channel.toml", 100);
  EXPECT_GT(numbers.size(), 20u);
  for (const WrittenNumber& number : numbers) {
    const auto part = deck::part_of(root, number.key);
    ASSERT_TRUE(std::holds_alternative<deck::DeckPart>(part)) << number.key;
    EXPECT_EQ(std::get<deck::DeckPart>(part).value->number, number.value) << number.key;
  }
}

// A name that two tables have stays an index, and so does what a key that is not there has.
TEST(KeyNames, NamesOfTablesTakeThePlacesOfTheirIndices) {
  const deck::Value root = deck::parse_deck(text, "deck.toml");
  EXPECT_EQ(with_names(root, "wall.0.profile.z"), "wall.upper.profile.z");
  EXPECT_EQ(with_names(root, "wall.upper.profile.z"), "wall.upper.profile.z");
  EXPECT_EQ(with_names(root, "wall.2.profile.z"), "wall.2.profile.z");
  EXPECT_EQ(with_names(root, "member.strip.imperfection.0.amplitude"), "member.strip.imperfection.0.amplitude");
  EXPECT_EQ(with_names(root, "wall.9.profile.z"), "wall.9.profile.z");
}

}  // namespace
}  // namespace arcwall::deck_numbers_test
