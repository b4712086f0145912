#include "apps/explore/deck_numbers.hpp"

#include <algorithm>
#include <cmath>

#include "apps/output/key_names.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/toml_source.hpp"
#include "model/deck/value.hpp"

namespace arcwall::explore {

namespace {

using deck::Value;

constexpr std::string_view of_variables = "variables.";

std::string text_of(const Value& table, std::string_view key) {
  const Value* const found = deck::find(table, key);
  return found != nullptr && found->kind == Value::Kind::string ? found->string : "";
}

class Collector {
 public:
  Collector(deck::Units units, std::size_t most) : units_(std::move(units)), most_(most) {}

  // `indexed`: the key with indices for names.
  void collect(const Value& value, const std::string& key, const std::string& indexed) {
    if (numbers_.size() == most_) return;
    if (value.kind == Value::Kind::table)
      for (const Value& item : value.items)
        if (deck::is_name(item.key)) collect(item, key_of(key, item.key), key_of(indexed, item.key));
    if (value.kind == Value::Kind::array)
      for (std::size_t i = 0; i < value.items.size(); ++i)
        collect(value.items[i], key_of(key, part_of_key(value, i)), key_of(indexed, std::to_string(i)));
    const bool integer = value.kind == Value::Kind::integer;
    if ((!integer && value.kind != Value::Kind::number) || !std::isfinite(value.number)) return;
    std::string unit = deck::unit_of_key(indexed, units_);
    const bool whole = integer && unit.empty() && !key.starts_with(of_variables);
    numbers_.push_back(
        {.key = key, .unit = std::move(unit), .value = value.number, .whole = whole, .position = value.position});
  }

  std::vector<WrittenNumber> numbers() && {
    std::stable_partition(numbers_.begin(), numbers_.end(),
                          [](const WrittenNumber& number) { return number.key.starts_with(of_variables); });
    return std::move(numbers_);
  }

 private:
  deck::Units units_;
  std::size_t most_;
  std::vector<WrittenNumber> numbers_{};
};

}  // namespace

std::vector<WrittenNumber> written_numbers(std::string_view text, const std::string& file, std::size_t most) {
  const Value root = deck::parse_deck(text, file);
  deck::Units units;
  if (const Value* const named = deck::find(root, "units"); named != nullptr && named->kind == Value::Kind::table)
    units = {.length = text_of(*named, "length"), .force = text_of(*named, "force")};
  Collector collector(units, most);
  collector.collect(root, "", "");
  return std::move(collector).numbers();
}

}  // namespace arcwall::explore
