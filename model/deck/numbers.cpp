#include "model/deck/numbers.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "core/text.hpp"
#include "model/deck/arithmetic.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/synonyms.hpp"
#include "model/deck/toml_source.hpp"
#include "model/deck/value.hpp"
#include "model/deck/writer.hpp"

namespace arcwall::deck {

namespace {

std::vector<std::string> split_at_dots(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// A part of a table or an array, and what its key has for it in a deck that is written.
struct Step {
  const Value* to = nullptr;
  std::string written{};
};

// `table`: the key of `from`.
Step step_into(const Value& from, const std::string& table, const std::string& part) {
  if (from.kind == Value::Kind::table) {
    const std::string key = current_key(table, part);
    return {.to = find(from, key), .written = key};
  }
  if (from.kind != Value::Kind::array) return {};
  const Value* const element = element_of(from, part);
  if (element != nullptr) return {.to = element, .written = std::to_string(element - from.items.data())};
  // An array of one table may be that table.
  if (from.items.size() != 1 || from.items.front().kind != Value::Kind::table) return {};
  const Step inner = step_into(from.items.front(), table + ".0", part);
  return {.to = inner.to, .written = "0." + inner.written};
}

NoNumber no_such_part(const Value& from, const std::string& before, const std::string& part) {
  std::vector<std::string> known;
  for (const Value& item : from.items) {
    const Value* const name = item.kind == Value::Kind::table ? find(item, "name") : nullptr;
    if (!item.key.empty()) known.push_back(item.key);
    if (item.key.empty() && name != nullptr) known.push_back(name->string);
  }
  const std::string near = nearest(part, known);
  return {.message = "names nothing: there is no " + in_quotes(part, 60) + (before.empty() ? "" : " in " + before),
          .cure = near.empty() ? "name a number of the deck, as in material.steel.E or wall.upper.profile.z"
                               : "did you mean " + in_quotes(near, 60) + "?"};
}

Dimension unit_of(const std::string& key) {
  for (const DeclaredKey& declared : declared_keys())
    if (declared.kind == DeclaredKey::Kind::value && declared.is(key)) return declared.unit;
  return unit::none;
}

}  // namespace

std::variant<DeckPart, NoNumber> part_of(const Value& root, const std::string& key) {
  const Value* at = &root;
  std::string written, before;
  for (const std::string& part : with_table_of_variables(root, split_at_dots(key))) {
    const Step next = step_into(*at, written, part);
    if (next.to == nullptr) return no_such_part(*at, before, part);
    at = next.to;
    written += (written.empty() ? "" : ".") + next.written;
    before += (before.empty() ? "" : ".") + part;
  }
  return DeckPart{.value = at, .key = written};
}

std::string written_key(const Value& root, const std::string& key) {
  const Value* at = &root;
  std::string written;
  for (const std::string& part : with_table_of_variables(root, split_at_dots(key))) {
    const Step next = at == nullptr ? Step() : step_into(*at, written, part);
    at = next.to;
    written += (written.empty() ? "" : ".") + (at == nullptr ? part : next.written);
  }
  return written;
}

namespace {

constexpr std::string_view of_variables = "variables.";

std::variant<DeckNumber, NoNumber> number_in(const Value& root, const std::string& key) {
  const auto part = part_of(root, key);
  if (const auto* none = std::get_if<NoNumber>(&part)) return *none;
  const auto& [at, written] = std::get<DeckPart>(part);
  if (at->kind == Value::Kind::integer)
    return NoNumber{.message = "is a whole number, which does not change by degrees",
                    .cure = "name a number that does"};
  if (at->kind != Value::Kind::number)
    return NoNumber{.message = "is no number",
                    .cure = at->kind == Value::Kind::array || at->kind == Value::Kind::table
                                ? "name a part of it; elements of an array count from 0"
                                : "name a number of the deck, as in material.steel.E"};
  return DeckNumber{.key = written, .value = at->number, .unit = unit_of(written)};
}

}  // namespace

// The whole document is asked where nothing is there, for what would be right, and for variables.
std::variant<DeckNumber, NoNumber> number_of(const Deck& deck, const std::string& key) {
  Deck numbers = deck;
  numbers.formulas.clear();
  Value root = parse_toml(to_toml(numbers, key.substr(0, key.find('.'))), deck.source.file);
  auto found = number_in(root, key);
  if (std::holds_alternative<NoNumber>(found)) {
    root = parse_toml(to_toml(numbers), deck.source.file);
    found = number_in(root, key);
  }
  auto* const number = std::get_if<DeckNumber>(&found);
  if (number == nullptr || !number->key.starts_with(of_variables)) return found;
  root = parse_toml(to_toml(numbers), deck.source.file);
  for (const auto& [other, slope] : slopes_of_formulas(deck, number->key.substr(of_variables.size())))
    if (auto entered = number_in(root, other); !other.starts_with(of_variables))
      if (auto* const one = std::get_if<DeckNumber>(&entered)) number->enters.emplace_back(std::move(*one), slope);
  return found;
}

Deck with_number(const Deck& deck, const DeckNumber& number, double value) {
  return with_number(to_toml(deck), deck.source.file, number, value);
}

Deck with_number(const std::string& text, const std::string& file, const DeckNumber& number, double value) {
  return read_deck_text(text, file, {number.key + "=" + round_trip(value)});
}

}  // namespace arcwall::deck
