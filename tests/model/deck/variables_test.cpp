// Numbers that are formulas, and the variables in them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "model/deck/formula.hpp"
#include "model/deck/numbers.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/toml_source.hpp"
#include "model/deck/writer.hpp"
#include "tests/model/deck/bad_decks.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::deck::variables_test {

namespace {

using bad_decks_test::all_of;

FormulaResult with_a_of_3(const std::string& formula) {
  return evaluate(formula, [](const std::string& name) { return name == "a" ? std::optional(3.0) : std::nullopt; });
}

std::string said_of(const std::string& formula) {
  const FormulaResult result = with_a_of_3(formula);
  EXPECT_FALSE(result.value) << formula;
  return result.problem;
}

// The column with variables and with other text in place of its height.
std::string column(const std::string& variables, const std::string& height = "0.2") {
  return replaced(std::string(column_deck) + "\n[variables]\n" + variables, "height = 0.2", "height = " + height);
}

double height(const Deck& deck) { return std::get<Rectangle>(deck.sections.at(0).shape).height; }

double height_of(const std::string& text, const std::vector<std::string>& assignments = {}) {
  return height(read_deck_text(text, "deck.toml", assignments));
}

std::vector<Diagnostic> errors_of(const std::string& text, const std::vector<std::string>& assignments = {}) {
  try {
    read_deck_text(text, "deck.toml", assignments);
  } catch (const InputError& error) {
    return error.diagnostics();
  }
  return {};
}

std::string only_error(const std::string& text, const std::vector<std::string>& assignments = {}) {
  const auto errors = errors_of(text, assignments);
  EXPECT_EQ(errors.size(), 1U) << all_of(errors);
  return errors.empty() ? "" : to_text(errors.front());
}

}  // namespace

TEST(Formulas, HaveTheValuesOfArithmetic) {
  const double a = 3.0, pi = std::numbers::pi;
  const std::vector<std::pair<std::string, double>> formulas{
      {"1", 1.0},
      {" 2.5e-3 ", 2.5e-3},
      {".5", 0.5},
      {"2.", 2.0},
      {"0.1 + 0.2", 0.1 + 0.2},
      {"1 + 2 * 3", 7.0},
      {"(1 + 2) * 3", 9.0},
      {"7 - 2 - 1", 4.0},
      {"8 / 4 / 2", 1.0},
      {"2 ^ 3 ^ 2", 512.0},
      {"-2 ^ 2", -4.0},
      {"2 ^ -1", 0.5},
      {"--3 - -3", 6.0},
      {"2 * -a", -6.0},
      {"a / 2", 1.5},
      {"pi * a ^ 2", pi * 9.0},
      {"sqrt(16) + abs(-2)", 6.0},
      {"min(2, a) + max(2, a)", 5.0},
      {"atan2(1, -1)", std::atan2(1.0, -1.0)},
      {"sin(pi / 6) + cos(pi / 3) + tan(pi / 4)", std::sin(pi / 6.0) + std::cos(pi / 3.0) + std::tan(pi / 4.0)},
      {"asin(0.5) + acos(0.5) + atan(2)", std::asin(0.5) + std::acos(0.5) + std::atan(2.0)},
      {"exp(1) + ln(a) + log10(1000)", std::exp(1.0) + std::log(a) + 3.0},
  };
  for (const auto& [formula, value] : formulas) {
    const FormulaResult result = with_a_of_3(formula);
    ASSERT_TRUE(result.value) << formula << ": " << result.problem;
    EXPECT_DOUBLE_EQ(*result.value, value) << formula;
  }
}

TEST(Formulas, SayWhereTheyAreNoArithmetic) {
  for (const char* formula : {"", "  ", "a +", "(", "a * (2", "2 ^", "sqrt(", "min(1,"})
    EXPECT_EQ(said_of(formula), "ends where a number, a name or a bracket is missing") << formula;
  EXPECT_EQ(said_of("a = 2"), "is no arithmetic from \"= 2\" on");
  EXPECT_EQ(said_of("2 a"), "is no arithmetic from \"a\" on");
  EXPECT_EQ(said_of("a · 2"), "is no arithmetic from \"· 2\" on");
  EXPECT_EQ(said_of("a) + 1"), "is no arithmetic from \") + 1\" on");
  EXPECT_EQ(said_of("0x10"), "is no arithmetic from \"x10\" on");
  EXPECT_EQ(said_of("a < 2"), "is no arithmetic from \"< 2\" on");
  EXPECT_EQ(said_of("1, 2"), "is no arithmetic from \", 2\" on");
  EXPECT_EQ(said_of("1" + std::string(1, '\0')), "is no arithmetic from \"\\u0000\" on");
  EXPECT_EQ(said_of("b"), "has a name that is not in [variables]: \"b\"");
  EXPECT_EQ(said_of("nan"), "has a name that is not in [variables]: \"nan\"");
  EXPECT_EQ(said_of("sqrt"), "has a name that is not in [variables]: \"sqrt\"");
  EXPECT_EQ(said_of("system(1)"), "has no function \"system\"");
  EXPECT_EQ(said_of("min(1)"), "has 1 number for min");
  EXPECT_EQ(said_of("1e999"), "has a number out of range");
  EXPECT_EQ(said_of("1 / 0"), "is inf, not a finite number");
  EXPECT_EQ(said_of("sqrt(-1)").find("is -nan, not") == 0 || said_of("sqrt(-1)").find("is nan, not") == 0, true);
  EXPECT_EQ(said_of("10 ^ 400"), "is inf, not a finite number");
}

TEST(Formulas, HaveABoundedDepthAndLength) {
  const std::string deep = "is nested deeper than 100";
  EXPECT_EQ(said_of(std::string(500, '(') + "1"), deep);
  std::string powers = "1", calls;
  for (int i = 0; i < 300; ++i) powers += "^1";
  for (int i = 0; i < 150; ++i) calls += "abs(";
  EXPECT_EQ(said_of(powers), deep);
  EXPECT_EQ(said_of(calls), deep);
  EXPECT_EQ(said_of(std::string(1000000, '(')), "is longer than 1000 characters");
  EXPECT_EQ(with_a_of_3(std::string(998, '-') + "1").value, 1.0);
  EXPECT_EQ(with_a_of_3(std::string(99, '(') + "a" + std::string(99, ')')).value, 3.0);
}

TEST(Formulas, AnyTextIsAValueOrAProblem) {
  std::mt19937 random(7);
  const std::vector<std::string> parts{
      "a",     "1",    "2.5e3", "(",  ")",    "+", "-", "*", "/",  "^", ",",
      "sqrt(", "min(", " ",     "pi", "\xff", "=", "e", ".", "\t", "x", std::string(1, '\0')};
  for (int i = 0; i < 20000; ++i) {
    std::string formula;
    for (std::size_t length = random() % 20; length > 0; --length) formula += parts[random() % parts.size()];
    const FormulaResult result = with_a_of_3(formula);
    EXPECT_NE(result.value.has_value(), !result.problem.empty()) << formula;
    if (result.value) {
      EXPECT_TRUE(std::isfinite(*result.value)) << formula;
    }
  }
}

TEST(Variables, StandInNumbersAndInEachOther) {
  EXPECT_DOUBLE_EQ(height_of(column("gap = 5\nhalf = \"gap / 2\"", "\"half / 10\"")), 0.25);
  EXPECT_DOUBLE_EQ(height_of(column("c = \"b + 1\"\nb = \"a * 2\"\na = 0.5", "\"c\"")), 2.0);
  EXPECT_DOUBLE_EQ(height_of(column("a = 1", "\"0.25\"")), 0.25);
  const Deck deck = read_deck_text(column("n = 4\nL = 3.0\n[path.stop]\nlambda = [\"-L\", \"L / 2\"]", "\"0.1 * L\""),
                                   "d", {"member.column.elements='2 * n'", "point.B=['L', '0']"});
  EXPECT_EQ(deck.members.at(0).elements, 8);
  EXPECT_EQ(deck.points.at(1).at, (Vector{3.0, 0.0}));
  EXPECT_EQ(deck.path.stop.bounds.at(0).low, -3.0);
  EXPECT_EQ(deck.path.stop.bounds.at(0).high, 1.5);
}

TEST(Variables, AreSetByNameAndAsKeys) {
  const std::string text = column("gap = 5.0\nhalf = \"gap / 2\"", "\"half\"");
  EXPECT_EQ(height_of(text, {"variables.gap=6"}), 3.0);
  EXPECT_EQ(height_of(text, {"gap=8"}), 4.0);
  EXPECT_EQ(height_of(text, {"half='gap / 5'"}), 1.0);
  EXPECT_EQ(height_of(text, {"section.square.height=7.0", "gap=8"}), 7.0);
  EXPECT_EQ(height_of(text, {"variables.more=1.5", "section.square.height='more'"}), 1.5);
  EXPECT_EQ(written_key(parse_deck(text, "d"), "gap"), "variables.gap");
  EXPECT_EQ(written_key(parse_deck(text, "d"), "title"), "title");
}

// Every number of a deck with all keys, as a formula.
TEST(Variables, MayBeInEveryNumberAndAreWritten) {
  const Deck plain = read_deck_text(full_deck, "full.toml");
  const std::string text = to_toml(plain);
  std::string changed = text.substr(0, text.find('\n') + 1) + "variables = { one = 1.0 }\n",
              rest = text.substr(text.find('\n') + 1);
  const std::regex number(R"((= |\[|, |\n  )(-?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?)(?=[,\]\n ]))");
  std::size_t count = 0;
  std::string out;
  std::smatch match;
  while (std::regex_search(rest, match, number)) {
    out += match.prefix().str() + match[1].str() + "\"one * " + match[2].str() + "\"";
    rest = match.suffix();
    ++count;
  }
  const Deck deck = read_deck_text(changed + out + rest, "full.toml");
  EXPECT_GT(count, 150U);
  EXPECT_EQ(deck.formulas.size(), count);
  const std::string again = to_toml(deck);
  EXPECT_EQ(read_deck_text(again, "full.toml"), deck);
  std::size_t written = 0;
  for (std::size_t at = again.find("\"one * "); at != std::string::npos; at = again.find("\"one * ", at + 1)) ++written;
  EXPECT_EQ(written, count);
  Deck values = deck;
  values.formulas.clear();
  values.variables.clear();
  EXPECT_EQ(values, plain);
}

TEST(Variables, OfALoneImperfectionAreWritten) {
  const std::string text =
      replaced(column("a = 1e-4"), "elements = 80",
               "elements = 80\nimperfection = { shape = \"sine\", amplitude = \"2 * a\", waves = 1 }");
  const Deck deck = read_deck_text(text, "d");
  EXPECT_EQ(read_deck_text(to_toml(deck), "d"), deck);
  EXPECT_NE(to_toml(deck).find("amplitude = \"2 * a\""), std::string::npos);
}

TEST(Variables, AreNumbersThatVary) {
  const Deck deck = read_deck_text(column("gap = 5\nhalf = \"gap / 2\"\nshift = 0", "\"half ^ 2 + shift\""), "d");
  const DeckNumber gap = std::get<DeckNumber>(number_of(deck, "gap"));
  EXPECT_EQ(gap.key, "variables.gap");
  EXPECT_EQ(gap.value, 5.0);
  ASSERT_EQ(gap.enters.size(), 1U);
  EXPECT_EQ(gap.enters[0].first.key, "section.square.height");
  EXPECT_NEAR(gap.enters[0].second, 2.5, 1e-6);
  EXPECT_DOUBLE_EQ(height(with_number(deck, gap, 4.0)), 4.0);
  const DeckNumber half = std::get<DeckNumber>(number_of(deck, "variables.half"));
  EXPECT_DOUBLE_EQ(height(with_number(deck, half, 3.0)), 9.0);
  const DeckNumber shift = std::get<DeckNumber>(number_of(deck, "shift"));
  EXPECT_NEAR(shift.enters.at(0).second, 1.0, 1e-6);
  const DeckNumber own = std::get<DeckNumber>(number_of(deck, "section.square.height"));
  EXPECT_EQ(own.value, 6.25);
  EXPECT_DOUBLE_EQ(height(with_number(deck, own, 3.0)), 3.0);
}

TEST(Variables, ThatAreWrongAreSaid) {
  EXPECT_EQ(only_error(column("a = \"b\"\nb = \"c + 1\"\nc = \"2 * b\"\nd = \"a + b\"", "\"d\"")),
            "deck.toml:33:5: variables.b: is computed from itself: b uses c uses b; give one of them a number");
  EXPECT_EQ(only_error(column("a = \"a\"", "\"a\"")),
            "deck.toml:32:5: variables.a: is computed from itself: a uses a; give one of them a number");
  EXPECT_EQ(
      only_error(column("gap = 5", "\"gapp / 2\"")),
      "deck.toml:9:10: section.square.height: \"gapp / 2\" has a name that is not in [variables]: \"gapp\"; did you "
      "mean gap?");
  EXPECT_EQ(only_error(column("a = 1", "\"a - 2\"")),
            "deck.toml:9:10: section.square.height: \"a - 2\" = -1 is out of range; give a number greater than 0");
  EXPECT_EQ(only_error(column("a = 0", "\"1 / a\"")),
            "deck.toml:9:10: section.square.height: \"1 / a\" is inf, not a finite number; change the formula");
  EXPECT_EQ(only_error(column("a = nan", "\"a\"")),
            "deck.toml:32:5: variables.a: nan is not a finite number; give a number");
  EXPECT_EQ(
      only_error(column("a = \"2 +\"", "\"a\"")),
      "deck.toml:32:5: variables.a: \"2 +\" ends where a number, a name or a bracket is missing; write numbers, names "
      "of [variables], pi, + - * / ^ ( ), and functions such as sqrt or sin");
  EXPECT_EQ(only_error(column("n = 3"), {"member.column.elements='n / 2'"}),
            "--set member.column.elements='n / 2': member.column.elements: \"n / 2\" = 1.5 is no whole number; give an "
            "integer of at least 1 and at most 10000000");
  EXPECT_EQ(only_error(column("a = true")), "deck.toml:32:5: variables.a: true is of the wrong type; give a number");
  EXPECT_EQ(only_error(column("\"a-b\" = 1")),
            "deck.toml:32:1: variables.a-b: is no name of a variable; begin with a letter; "
            "then use letters, digits and _ only");
  EXPECT_EQ(only_error(column("sin = 1")),
            "deck.toml:32:1: variables.sin: has another meaning in formulas; give the variable another name");
  EXPECT_EQ(only_error(column("path = 1")),
            "deck.toml:32:1: variables.path: is the name of a part of the deck; give the variable another name");
  EXPECT_EQ(only_error("variables = 3\n" + std::string(column_deck)),
            "deck.toml:1:13: variables: 3 is of the wrong type; give a table");
}

// A chain that is computed and one that closes.
TEST(Variables, MayBeManyOfWhichEachUsesTheNext) {
  std::string chain = "v0 = 1\n";
  const int count = 20000;
  for (int i = count; i > 0; --i) chain += "v" + std::to_string(i) + " = \"v" + std::to_string(i - 1) + " + 1\"\n";
  const std::string last = "v" + std::to_string(count);
  EXPECT_EQ(height_of(column(chain, "\"" + last + "\"")), count + 1.0);
  const auto errors = errors_of(column(chain, "\"" + last + "\""), {"v0='" + last + "'"});
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_NE(errors[0].message.find("is computed from itself"), std::string::npos);
  EXPECT_LT(errors[0].message.size(), 400U);
}

}  // namespace arcwall::deck::variables_test
