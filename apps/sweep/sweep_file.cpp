#include "apps/sweep/sweep_file.hpp"

#include <algorithm>
#include <cmath>

#include "model/deck/cursor.hpp"
#include "model/deck/toml_source.hpp"
#include "model/deck/words.hpp"

namespace arcwall::sweep {

using deck::Cursor;
using deck::Findings;
using deck::Presence;
using deck::Value;

namespace {

constexpr deck::Words<Spacing, 2> spacing_words{{{"linear", Spacing::linear}, {"log", Spacing::log}}};
constexpr deck::Words<Traced, 2> command_words{{{"run", Traced::path}, {"curve", Traced::curve}}};

// A key of the deck, with what the sweep says of it.
struct Entry {
  Key key{};
  const Value* value = nullptr;
};

// The entries of a table as dotted keys. Tables are parts of a key, unless the key is quoted as a whole or `is_leaf`
// says that they are values.
template <class IsLeaf>
void flatten(const Value& table, const std::string& path, IsLeaf is_leaf, std::vector<Entry>& entries) {
  for (const Value& item : table.items) {
    const bool whole = path.empty() && item.key.find('.') != std::string::npos;
    const std::string name = (path.empty() ? "" : path + ".") + (whole ? item.key : deck::key_text(item.key));
    if (item.kind == Value::Kind::table && !whole && !is_leaf(item)) {
      flatten(item, name, is_leaf, entries);
    } else {
      entries.push_back({.key = {.name = name, .position = item.key_position}, .value = &item});
    }
  }
}

template <class IsLeaf>
std::vector<Entry> entries_of(Cursor& table, IsLeaf is_leaf) {
  std::vector<Entry> entries;
  flatten(table.value(), "", is_leaf, entries);
  for (auto entry = entries.begin(); entry != entries.end(); ++entry) {
    const auto same = [&](const Entry& earlier) { return earlier.key.name == entry->key.name; };
    if (std::any_of(entries.begin(), entry, same))
      table.findings().add(entry->key.position, table.path() + "." + entry->key.name, "is there twice",
                           "write the key once");
  }
  return entries;
}

// A table whose entry `key` is no further table is a range or a tie, not a part of a longer key.
auto has_value(std::string_view key) {
  return [key](const Value& table) {
    const Value* found = deck::find(table, key);
    return found != nullptr && found->kind != Value::Kind::table && found->kind != Value::Kind::array;
  };
}

bool add_json(const Value& value, const std::string& path, Findings& findings, Json& target) {
  switch (value.kind) {
    case Value::Kind::boolean:
      target = value.boolean;
      return true;
    case Value::Kind::integer:
      target = value.integer;
      return true;
    case Value::Kind::number:
      target = value.number;
      if (std::isfinite(value.number)) return true;
      findings.add(value.position, path, deck::shown(value) + " is not a finite number", "give a number");
      return false;
    case Value::Kind::string:
      target = value.string;
      return true;
    case Value::Kind::date:
      findings.add(value.position, path, deck::shown(value) + " is no value of a deck", "give a number or a text");
      return false;
    case Value::Kind::array:
    case Value::Kind::table: {
      const bool array = value.kind == Value::Kind::array;
      bool right = true;
      target = array ? Json::array() : Json::object();
      for (const Value& item : value.items) {
        Json& place = array ? target.emplace_back() : target[item.key];
        right = add_json(item, path, findings, place) && right;
      }
      return right;
    }
  }
  return false;
}

bool read_range(Cursor& table, Range& range) {
  const bool from = table.number("from", Presence::required, deck::any_number, range.from);
  const bool to = table.number("to", Presence::required, deck::any_number, range.to);
  const bool spaced = table.word("spacing", Presence::optional, spacing_words, range.spacing);
  if (!from || !to || (table.has("spacing") && !spaced)) return false;
  if (range.from == range.to) {
    table.report("to", "is the same as from", "give two ends that differ");
  } else if (range.spacing == Spacing::log && !(range.from * range.to > 0.0)) {
    table.report("spacing", "\"log\" needs two ends of one sign, other than 0", "use \"linear\"");
  } else {
    return true;
  }
  return false;
}

// The values of one key of a grid: a list, or as many of a range.
std::vector<Json> grid_values(const Entry& entry, const std::string& path, Findings& findings) {
  std::vector<Json> result;
  if (entry.value->kind == Value::Kind::table) {
    Cursor table(*entry.value, path, findings);
    Range range;
    int count = 0;
    const bool right = read_range(table, range);
    const bool counted = table.integer("count", Presence::required, {.low = 2, .high = most_cases}, count);
    table.finish();
    if (right && counted)
      for (const double value : values(range, count)) result.push_back(number(value));
  } else if (entry.value->kind == Value::Kind::array) {
    for (const Value& item : entry.value->items) add_json(item, path, findings, result.emplace_back());
    if (result.empty()) findings.add(entry.value->position, path, "the list is empty", "give at least one value");
  } else {
    findings.add(entry.value->position, path, deck::shown(*entry.value) + " does not say which values",
                 "give a list, or { from, to, count }");
  }
  return result;
}

void read_grid(Cursor& table, Rows rows, Sweep& sweep) {
  std::vector<std::vector<Json>> values;
  double cases = 1.0;
  for (const Entry& entry : entries_of(table, has_value("from"))) {
    sweep.keys.push_back(entry.key);
    values.push_back(grid_values(entry, table.path() + "." + entry.key.name, table.findings()));
    cases *= static_cast<double>(values.back().size());
  }
  if (sweep.keys.empty()) table.findings().add(table.position(), table.path(), "varies no key", "name one");
  if (cases > most_cases) {
    table.findings().add(table.position(), table.path(), "has more than " + std::to_string(most_cases) + " cases",
                         "give fewer values, or use [latin_hypercube]");
  } else if (rows == Rows::made) {
    sweep.rows = grid(values);
  }
}

void read_list(std::vector<Cursor>& tables, Sweep& sweep) {
  const auto never = [](const Value&) { return false; };
  for (Cursor& table : tables) {
    const std::vector<Entry> entries = entries_of(table, never);
    if (&table == &tables.front())
      for (const Entry& entry : entries) sweep.keys.push_back(entry.key);
    std::vector<Json>& row = sweep.rows.emplace_back(sweep.keys.size());
    std::vector<bool> found(sweep.keys.size(), false);
    for (const Entry& entry : entries) {
      const auto same = [&](const Key& key) { return key.name == entry.key.name; };
      const auto at = std::find_if(sweep.keys.begin(), sweep.keys.end(), same) - sweep.keys.begin();
      const auto i = static_cast<std::size_t>(at);
      const std::string path = table.path() + "." + entry.key.name;
      if (i == row.size()) {
        table.findings().add(entry.key.position, path, "is not in the first row", "give each row the same keys");
        continue;
      }
      found[i] = true;
      add_json(*entry.value, path, table.findings(), row[i]);
    }
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!found[i])
        table.findings().add(table.position(), table.path(), "has no " + sweep.keys[i].name,
                             "give each row the same keys");
  }
  if (sweep.keys.empty() && !tables.empty())
    tables.front().findings().add(tables.front().position(), tables.front().path(), "varies no key", "name one");
}

void read_latin_hypercube(Cursor& table, Rows rows, Sweep& sweep) {
  int samples = 0, seed = 0;
  const bool counted = table.integer("samples", Presence::required, {.low = 2, .high = most_cases}, samples);
  const bool seeded = table.integer("seed", Presence::required, {}, seed);
  std::vector<Range> ranges;
  bool right = counted && seeded;
  if (auto keys = table.table("ranges", Presence::required)) {
    for (const Entry& entry : entries_of(*keys, has_value("from"))) {
      const std::string path = keys->path() + "." + entry.key.name;
      sweep.keys.push_back(entry.key);
      if (entry.value->kind != Value::Kind::table) {
        table.findings().add(entry.value->position, path, deck::shown(*entry.value) + " is no range",
                             "give { from, to }");
        right = false;
        continue;
      }
      Cursor range(*entry.value, path, table.findings());
      right = read_range(range, ranges.emplace_back()) && right;
      range.finish();
    }
    if (sweep.keys.empty()) keys->findings().add(keys->position(), keys->path(), "varies no key", "name one");
  }
  table.finish();
  if (right && rows == Rows::made) sweep.rows = latin_hypercube(ranges, samples, static_cast<std::uint64_t>(seed));
}

bool all_numbers(const Sweep& sweep, std::size_t key) {
  return std::all_of(sweep.rows.begin(), sweep.rows.end(),
                     [&](const std::vector<Json>& row) { return row[key].is_number(); });
}

void read_ties(Cursor& table, Sweep& sweep) {
  std::vector<std::string> names;
  for (const Key& key : sweep.keys) names.push_back(key.name);
  for (const Entry& entry : entries_of(table, has_value("to"))) {
    const std::string path = table.path() + "." + entry.key.name;
    if (entry.value->kind != Value::Kind::table) {
      table.findings().add(entry.value->position, path, deck::shown(*entry.value) + " does not say what it is tied to",
                           "give { to = \"key\", factor = 1.0, offset = 0.0 }");
      continue;
    }
    if (std::find(names.begin(), names.end(), entry.key.name) != names.end())
      table.findings().add(entry.key.position, path, "is varied itself", "vary it or tie it");
    Cursor tied(*entry.value, path, table.findings());
    Tie tie{.key = entry.key};
    deck::Reference to;
    if (tied.reference("to", Presence::required, to)) {
      const auto found = std::find(names.begin(), names.end(), to.text);
      tie.to = static_cast<std::size_t>(found - names.begin());
      if (found == names.end()) {
        tied.report_unknown(to, tied.path_of("to"), "is not varied", names);
      } else if (!all_numbers(sweep, tie.to)) {
        tied.report("to", to.text + " has values that are no numbers", "tie to a key with numbers");
      }
    }
    tied.number("factor", Presence::optional, deck::any_number, tie.factor);
    tied.number("offset", Presence::optional, deck::any_number, tie.offset);
    tied.finish();
    sweep.ties.push_back(std::move(tie));
  }
}

void read_design(Cursor& root, Rows rows, Sweep& sweep) {
  auto grid = root.table("grid", Presence::optional);
  auto list = root.tables("list");
  auto hypercube = root.table("latin_hypercube", Presence::optional);
  const int designs = (root.has("grid") ? 1 : 0) + (root.has("list") ? 1 : 0) + (root.has("latin_hypercube") ? 1 : 0);
  if (designs != 1)
    root.findings().add(root.position(), "", designs == 0 ? "no key is varied" : "more than one way to vary keys",
                        "give one of [grid], [[list]] and [latin_hypercube]");
  if (designs > 1) return;
  if (grid) read_grid(*grid, rows, sweep);
  read_list(list, sweep);
  if (hypercube) read_latin_hypercube(*hypercube, rows, sweep);
}

}  // namespace

Sweep read_sweep(const std::string& file, Rows rows) { return read_sweep_text(deck::read_text_file(file), file, rows); }

Sweep read_sweep_text(std::string_view text, const std::string& file_name, Rows rows) {
  const Value value = deck::parse_toml(text, file_name);
  Sweep sweep{.source = {.file = file_name}};
  Findings findings(sweep.source);
  Cursor root(value, "", findings);
  root.text("title", Presence::required, sweep.title);
  deck::Reference deck_file;
  if (root.reference("deck", Presence::required, deck_file)) {
    sweep.deck = deck_file.text;
    sweep.deck_position = deck_file.position;
  }
  root.word("command", Presence::optional, command_words, sweep.traced);
  read_design(root, rows, sweep);
  if (auto ties = root.table("tie", Presence::optional)) read_ties(*ties, sweep);
  root.finish();
  findings.throw_if_any();
  return sweep;
}

}  // namespace arcwall::sweep
