#include "tests/fuzz/mutated_deck.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/cli/example_decks.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/toml_source.hpp"
#include "model/deck/value.hpp"
#include "tests/fuzz/odd_numbers.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::fuzz {

namespace {

using deck::Value;
using Kind = Value::Kind;

// Meshes of so many elements have nodes at all the places that the decks name.
constexpr std::int64_t most_written_elements = 4;

Value* child(Value& table, std::string_view key) {
  const auto found =
      std::find_if(table.items.begin(), table.items.end(), [key](const Value& item) { return item.key == key; });
  return found == table.items.end() ? nullptr : &*found;
}

Value coarse(Value root) {
  for (Value& member : child(root, "member")->items) {
    std::int64_t& elements = child(member, "elements")->integer;
    elements = std::min(elements, most_written_elements);
  }
  return root;
}

const std::vector<Value>& base_decks() {
  static const std::vector<Value> decks = [] {
    std::vector<Value> result;
    for (const ExampleDeck& example : example_decks())
      result.push_back(coarse(deck::parse_toml(example.text, std::string(example.name))));
    result.push_back(coarse(deck::parse_toml(deck::column_deck, "column")));
    result.push_back(coarse(deck::parse_toml(deck::full_deck, "full")));
    return result;
  }();
  return decks;
}

// Of all choices that a deck has.
const std::vector<std::string>& words() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> result;
    for (const deck::DeclaredKey& key : deck::declared_keys())
      result.insert(result.end(), key.words.begin(), key.words.end());
    return result;
  }();
  return all;
}

// The parts of a table or array, those of its parts among them.
void collect(Value& parent, std::vector<Value*>& parts) {
  for (Value& value : parent.items) {
    parts.push_back(&value);
    collect(value, parts);
  }
}

bool is_number(const Value& value) { return value.kind == Kind::integer || value.kind == Kind::number; }

/// Changes a deck, one edit after the other, as the data say.
class Editor {
 public:
  Editor(Value& root, FuzzedDataProvider& data) : root_(root), data_(data) {}

  void edit() {
    switch (data_.ConsumeIntegralInRange(0, 9)) {
      case 0:
        return remove();
      case 1:
        return repeat();
      case 2:
        return scale();
      case 3:
        return take_from_another();
      default:
        return change();
    }
  }

 private:
  // Any part, or null if the deck has none left.
  Value* any_part() {
    std::vector<Value*> parts;
    collect(root_, parts);
    return parts.empty() ? nullptr : one_of(parts, data_);
  }

  // A table or an array that is not empty, or null.
  Value* any_list() {
    std::vector<Value*> parts{&root_};
    collect(root_, parts);
    std::erase_if(parts, [](const Value* part) { return part->items.empty(); });
    return parts.empty() ? nullptr : one_of(parts, data_);
  }

  std::size_t any_item(const Value& list) {
    return data_.ConsumeIntegralInRange<std::size_t>(0, list.items.size() - 1);
  }

  void remove() {
    if (Value* list = any_list()) list->items.erase(list->items.begin() + static_cast<std::ptrdiff_t>(any_item(*list)));
  }

  // In a table the copy has another key.
  void repeat() {
    Value* list = any_list();
    if (list == nullptr) return;
    Value copy = list->items[any_item(*list)];
    if (list->kind == Kind::table) copy.key = "copy" + std::to_string(list->items.size());
    list->items.push_back(std::move(copy));
  }

  // All numbers of a part, by the same factor.
  void scale() {
    Value* list = any_list();
    if (list == nullptr) return;
    std::vector<Value*> parts;
    collect(*list, parts);
    const double factor = std::pow(10.0, data_.ConsumeFloatingPointInRange(-12.0, 12.0));
    for (Value* part : parts)
      if (part->kind == Kind::number) part->number *= factor;
  }

  // A table of the root with its parts, as another deck has it.
  void take_from_another() {
    const Value& taken = one_of(one_of(base_decks(), data_).items, data_);
    Value* mine = child(root_, taken.key);
    if (mine == nullptr) {
      root_.items.push_back(taken);
    } else if (data_.ConsumeBool()) {
      *mine = taken;
    } else {
      for (const Value& item : taken.items)
        if (mine->kind == Kind::array || child(*mine, item.key) == nullptr) mine->items.push_back(item);
    }
  }

  void change() {
    Value* part = any_part();
    if (part == nullptr) return;
    if (part->kind == Kind::integer) {
      part->integer = data_.ConsumeBool() ? data_.ConsumeIntegralInRange<std::int64_t>(-1, most_written_elements)
                                          : data_.ConsumeIntegral<std::int64_t>();
    } else if (is_number(*part)) {
      part->number = odd_number(part->number, data_);
    } else if (part->kind == Kind::string) {
      part->string = other_word();
    } else if (part->kind == Kind::boolean) {
      part->boolean = !part->boolean;
    }
  }

  // A word of the format, a text that stands in the deck, or a name that it declares.
  std::string other_word() {
    if (data_.ConsumeBool()) return one_of(words(), data_);
    std::vector<Value*> parts;
    collect(root_, parts);
    const Value& part = *one_of(parts, data_);
    return part.kind == Kind::string ? part.string : part.key;
  }

  Value& root_;
  FuzzedDataProvider& data_;
};

std::string toml_of(const Value& value);

std::string listed(const Value& list, bool keys) {
  std::string text;
  for (const Value& item : list.items) {
    if (!text.empty()) text += ", ";
    text += (keys ? deck::in_quotes(item.key) + " = " : "") + toml_of(item);
  }
  return text;
}

std::string number(double value) {
  const std::string text = round_trip(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string toml_of(const Value& value) {
  switch (value.kind) {
    case Kind::boolean:
      return value.boolean ? "true" : "false";
    case Kind::integer:
      return std::to_string(value.integer);
    case Kind::number:
      return number(value.number);
    case Kind::string:
      return deck::in_quotes(value.string);
    case Kind::date:
      return "1979-05-27";
    case Kind::array:
      return "[" + listed(value, false) + "]";
    case Kind::table:
      return "{ " + listed(value, true) + " }";
  }
  return {};
}

// One line a part of a part of the root: what a message names can be found.
std::string document(const Value& root) {
  std::string text;
  for (const Value& item : root.items) text += deck::in_quotes(item.key) + " = " + toml_of(item) + "\n";
  return text;
}

std::string mutated_deck(FuzzedDataProvider& data) {
  Value root = one_of(base_decks(), data);
  Editor editor(root, data);
  constexpr int most_edits = 12;
  for (int i = 0; i < most_edits && data.remaining_bytes() > 0; ++i) editor.edit();
  return document(root);
}

}  // namespace

int with_mutated_deck(const std::uint8_t* data, std::size_t size, const std::function<void(const std::string&)>& use) {
  FuzzedDataProvider provider(data, size);
  const std::string text = mutated_deck(provider);
  static const bool show = std::getenv("ARCWALL_FUZZ_SHOW") != nullptr;
  if (show) std::cout << text << std::flush;
  try {
    use(text);
  } catch (const InputError& error) {
    if (show)
      for (const Diagnostic& diagnostic : error.diagnostics()) std::cout << "# " << to_text(diagnostic) << "\n";
  }
  return 0;
}

}  // namespace arcwall::fuzz
