#include "tests/model/deck/deck_page.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include "model/deck/key_list.hpp"
#include "model/deck/synonyms.hpp"

namespace arcwall::deck::test {

namespace {

using Kind = DeclaredKey::Kind;

std::string code(const std::string& text) { return "`" + text + "`"; }

// `[force/length²]`
std::string unit_of(const DeclaredKey& key) {
  const std::string unit = unit_text(key.unit, {.length = "length", .force = "force"});
  return unit.empty() ? "" : "[" + unit + "]";
}

std::string key_text(const DeclaredKey& key, const std::vector<DeclaredKey>& all) {
  const std::string inner = key.path() + (key.kind == Kind::array_of_tables ? ".#" : "");
  std::string keys;
  for (const DeclaredKey& other : all)
    if (other.table == inner && other.option.empty() && other.name != "*")
      keys += (keys.empty() ? "" : ", ") + other.name + " = …";
  return code(key.name + (keys.empty() ? "" : " = { " + keys + " }"));
}

std::string default_of(const DeclaredKey& key) {
  if (key.required || key.otherwise.empty()) return "";
  return key.otherwise_in_words ? key.otherwise : code(key.otherwise);
}

std::string row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += cell.empty() ? " |" : " " + cell + " |";
  return text + "\n";
}

std::string keys_of(const std::string& table) {
  const std::vector<DeclaredKey> all = declared_keys();
  std::string text = row({"key", "default", "meaning"}) + row({"---", "---", "---"});
  for (const DeclaredKey& key : all) {
    const bool has_header = key.kind == Kind::table || (table.empty() && key.kind != Kind::value);
    if (key.table != table || !key.option.empty() || key.name == "*" || has_header) continue;
    const std::string unit = unit_of(key);
    text += row(
        {key_text(key, all), default_of(key), key.meaning + (key.meaning.empty() || unit.empty() ? "" : " ") + unit});
  }
  return text;
}

std::string options_of(const std::string& table) {
  const std::vector<DeclaredKey> all = declared_keys();
  struct Option {
    std::string word, keys, meaning;
  };
  std::vector<Option> options;
  const DeclaredKey* chosen_by = nullptr;
  for (const DeclaredKey& key : all) {
    if (key.table != table) continue;
    if (key.option.empty()) {
      if (!key.words.empty() && options.empty()) chosen_by = &key;
      continue;
    }
    if (options.empty() || options.back().word != key.option) options.push_back({key.option, "", key.option_meaning});
    std::string& keys = options.back().keys;
    keys += std::string(keys.empty() ? "" : ", ") + (key.required ? "" : "optional ") + code(key.name);
    if (!key.meaning.empty()) keys += " (" + key.meaning + ")";
  }
  if (chosen_by == nullptr) return "no options\n";
  const bool meanings =
      std::any_of(options.begin(), options.end(), [](const Option& option) { return !option.meaning.empty(); });
  std::vector<std::string> head{code(chosen_by->name), "keys"};
  if (meanings) head.push_back(chosen_by->meaning);
  std::string text = row(head) + row(std::vector<std::string>(head.size(), "---"));
  for (const Option& option : options) {
    std::vector<std::string> cells{code("\"" + option.word + "\""), option.keys};
    if (meanings) cells.push_back(option.meaning);
    text += row(cells);
  }
  return text;
}

// Words and keys that are read as others.
std::string other_words() {
  std::string text = row({"read as", "other word"}) + row({"---", "---"});
  for (const Synonym& one : synonyms())
    if (one.use == Synonym::Use::read) text += row({code(std::string(one.word)), code(std::string(one.other))});
  return text;
}

// What stands between two markers.
std::string block(const std::string& marker) {
  if (marker == "other words") return other_words();
  const std::string table = marker.substr(marker.find(" of ") + 4);
  if (marker.starts_with("options")) return options_of(table);
  return keys_of(table == "deck" ? "" : table);
}

}  // namespace

std::string with_tables_of_keys(const std::string& page) {
  constexpr std::string_view open = "<!-- ", close = " -->", end = "<!-- end of keys -->";
  std::istringstream lines(page);
  std::string text;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == end) inside = false;
    if (!inside) text += line + "\n";
    if (line == end || !line.starts_with(open) || !line.ends_with(close)) continue;
    inside = true;
    text += block(line.substr(open.size(), line.size() - open.size() - close.size()));
  }
  return text;
}

}  // namespace arcwall::deck::test
