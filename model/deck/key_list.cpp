#include "model/deck/key_list.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <utility>

#include "model/deck/deck_keys.hpp"

namespace arcwall::deck {

namespace {

using Kind = DeclaredKey::Kind;

// Takes down what is declared, of every option and of one element of every list.
class KeyList final : public Keys {
 public:
  KeyList(std::vector<DeclaredKey>& list, std::string table) : list_(list), table_(std::move(table)) {}

  bool table(const Key& key, Form form, const std::function<void(Keys&)>& keys_of_table,
             std::string_view meaning) override {
    add_tables(key, form == Form::header ? Kind::table : Kind::inner_table, "", keys_of_table, meaning);
    return false;
  }
  bool applies(bool, const char*, const std::string&, const std::string&) override { return true; }
  bool lists() const override { return true; }

 protected:
  bool declare(const Key& key, const Target& target, const Declared& declared) override {
    DeclaredKey& added = add(key, Kind::value, declared.meaning);
    if (!added.required && !added.otherwise_in_words) added.otherwise = toml_text(target, declared).value_or("");
    added.unit = declared.unit;
    added.words = declared.words;
    return false;
  }

  bool each_table(const Key& key, ListForm form, const std::vector<std::string>&, const UseTable& use,
                  std::string_view meaning) override {
    const bool array = form == ListForm::array;
    add_tables(
        key, array ? Kind::array_of_tables : Kind::named_tables, array ? ".#" : ".*",
        [&](Keys& keys) { use(keys, {}); }, meaning);
    return true;
  }

  void each_entry(const std::vector<std::string>&, const std::vector<std::string_view>&, const UseKey& use) override {
    use("*", {});
  }

  void option(std::string_view word, std::string_view meaning, bool, const DeclareKeys& keys) override {
    option_ = word;
    option_meaning_ = meaning;
    keys();
    option_.clear();
    option_meaning_.clear();
  }
  void when_chosen(std::string_view, bool, const DeclareKeys& keys) override { keys(); }

 private:
  DeclaredKey& add(const Key& key, Kind kind, std::string_view meaning) {
    return list_.emplace_back(DeclaredKey{.table = table_,
                                          .name = std::string(key.name),
                                          .kind = kind,
                                          .option = option_,
                                          .option_meaning = option_meaning_,
                                          .meaning = std::string(meaning),
                                          .required = key.presence == Presence::required,
                                          .otherwise = std::string(key.otherwise),
                                          .otherwise_in_words = !key.otherwise.empty()});
  }

  void add_tables(const Key& key, Kind kind, const std::string& any, const std::function<void(Keys&)>& keys_of_table,
                  std::string_view meaning) {
    KeyList inner(list_, add(key, kind, meaning).path() + any);
    keys_of_table(inner);
  }

  std::vector<DeclaredKey>& list_;
  std::string table_, option_{}, option_meaning_{};
};

std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

bool is_index(const std::string& part) { return part.find_first_not_of("0123456789") == std::string::npos; }

// Behind a key there may be indices of its values, and an array of one table may be that table.
bool is_meant(std::span<const std::string> declared, std::span<const std::string> key) {
  if (declared.empty()) return std::all_of(key.begin(), key.end(), is_index);
  const bool any_index = declared.front() == "#";
  if (any_index && is_meant(declared.subspan(1), key)) return true;
  if (key.empty()) return false;
  const bool fits = any_index ? is_index(key.front()) : declared.front() == "*" || declared.front() == key.front();
  return fits && is_meant(declared.subspan(1), key.subspan(1));
}

std::string power(const std::string& unit, int exponent) {
  constexpr std::array<const char*, 5> raised{"", "", "²", "³", "⁴"};
  return unit + raised[static_cast<std::size_t>(std::abs(exponent))];
}

}  // namespace

bool DeclaredKey::is(const std::string& key) const { return is_meant(parts_of(path()), parts_of(key)); }

const std::vector<DeclaredKey>& declared_keys() {
  static const std::vector<DeclaredKey> all = [] {
    std::vector<DeclaredKey> list;
    Deck nothing;
    KeyList root(list, {});
    declare_keys(root, nothing);
    return list;
  }();
  return all;
}

std::string beginning(const DeclaredKey& part) {
  switch (part.kind) {
    case Kind::value:
    case Kind::inner_table:
      return part.name;
    case Kind::table:
      return "[" + part.name + "]";
    case Kind::array_of_tables:
      return "[[" + part.name + "]]";
    case Kind::named_tables:
      return "[" + part.name + ".NAME]";
  }
  return {};
}

std::string unit_text(const Dimension& dimension, const Units& units) {
  const bool lacks_length = dimension.length != 0 && units.length.empty();
  const bool lacks_force = dimension.force != 0 && units.force.empty();
  if (lacks_length || lacks_force) return {};
  if (dimension.length == 0) return dimension.force == 0 ? std::string() : units.force;
  const std::string length = power(units.length, dimension.length);
  if (dimension.force == 0) return dimension.length > 0 ? length : "1/" + length;
  return units.force + (dimension.length > 0 ? " " : "/") + length;
}

std::string unit_of_key(const std::string& key, const Units& units) {
  for (const DeclaredKey& declared : declared_keys())
    if (declared.kind == Kind::value && declared.is(key)) return unit_text(declared.unit, units);
  return {};
}

}  // namespace arcwall::deck
