#include "model/deck/key_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "core/text.hpp"
#include "model/deck/synonyms.hpp"

namespace arcwall::deck {

namespace {

std::vector<std::string> keys_of(const Value& root, std::string_view table) {
  std::vector<std::string> keys;
  const Value* found = find(root, table);
  if (found == nullptr || found->kind != Value::Kind::table) return keys;
  for (const Value& item : found->items) keys.push_back(item.key);
  return keys;
}

// Those of an array of tables.
std::vector<std::string> names_of(const Value& root, std::string_view array) {
  std::vector<std::string> names;
  if (const Value* tables = find(root, array))
    for (const Value& table : tables->items) {
      const Value* name = find(table, "name");
      if (name != nullptr && name->kind == Value::Kind::string) names.push_back(name->string);
    }
  return names;
}

std::optional<double> number_from(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The word that another one is read as, or the other one itself.
std::string current_word(const std::string& other, const std::vector<std::string>& words) {
  std::string word = read_as(other, words);
  return word.empty() ? other : word;
}

// The names that may stand where one of a kind is wanted, and what is said of others.
struct Candidates {
  const NameList& names;
  const char* otherwise;
};

Candidates candidates(const Names& names, Named of) {
  switch (of) {
    case Named::material:
      return {names.materials, "is not a material of this deck"};
    case Named::section:
      return {names.sections, "is not a section of this deck"};
    case Named::point:
      return {names.points, "is not a point of this deck"};
    case Named::member:
      return {names.members, "is not a member of this deck"};
    case Named::wall:
      return {names.walls, "is not a wall of this deck"};
    case Named::spring:
      return {names.springs, "is not the name of a spring of this deck"};
    case Named::monitor:
      return {names.monitors, "is not a monitor of this deck"};
    case Named::column:
      break;
  }
  return {names.columns, "is neither lambda nor a monitor"};
}

}  // namespace

Names names_in(const Value& root) {
  std::vector<std::string> columns = names_of(root, "monitor");
  columns.emplace_back("lambda");
  return {.materials = NameList(keys_of(root, "material")),
          .sections = NameList(keys_of(root, "section")),
          .points = NameList(keys_of(root, "point")),
          .members = NameList(keys_of(root, "member")),
          .walls = NameList(names_of(root, "wall")),
          .springs = NameList(names_of(root, "spring")),
          .monitors = NameList(names_of(root, "monitor")),
          .columns = NameList(std::move(columns))};
}

bool ends_a_member(const Deck& deck, const std::string& point) {
  return std::any_of(deck.members.begin(), deck.members.end(), [&point](const Member& member) {
    return member.from == point || member.to == point || member.from.empty() || member.to.empty();
  });
}

// --- values ---------------------------------------------------------------------------------------------------------

bool KeyReader::declare(const Key& key, const Target& target, const Declared& declared) {
  const auto [text, presence] = std::pair(key.name, key.presence);
  if (const auto* number = std::get_if<std::optional<double>*>(&target))
    return table_.number(text, presence, declared.required, **number);
  if (const auto* integer = std::get_if<std::optional<int>*>(&target))
    return table_.integer(text, presence, declared.range, **integer);
  if (const auto* flag = std::get_if<bool*>(&target)) return table_.flag(text, presence, **flag);
  if (const auto* vector = std::get_if<Vector*>(&target)) return table_.vector(text, presence, **vector);
  if (const auto* numbers = std::get_if<std::vector<double>*>(&target))
    return table_.numbers(text, presence, **numbers);
  if (const auto* at = std::get_if<Place*>(&target)) return place(key, **at);
  if (const auto* one = std::get_if<std::optional<std::string>*>(&target)) return word(key, declared.words, **one);
  if (const auto* some = std::get_if<std::vector<std::string>*>(&target)) return list(key, declared, **some);
  std::string& value = *std::get<std::string*>(target);
  return declared.name_of ? name(key, *declared.name_of, value) : table_.text(text, presence, value);
}

bool KeyReader::word(const Key& key, const std::vector<std::string>& words, std::optional<std::string>& value) {
  Reference found;
  if (!table_.reference(key.name, key.presence, found)) return false;
  const std::string read = current_word(found.text, words);
  const bool known = contains(words, read);
  if (known) {
    value = read;
  } else {
    table_.report_unknown(found, table_.path_of(key.name), "is not one of the words for this key", words);
  }
  return known;
}

// Words, names or any texts.
bool KeyReader::list(const Key& key, const Declared& declared, std::vector<std::string>& values) {
  const Value* array = table_.find(key.name, key.presence);
  if (array == nullptr) return false;
  if (declared.empty == EmptyList::means_none && array->kind == Value::Kind::array && array->items.empty()) return true;
  std::vector<Reference> found;
  bool right = table_.references(key.name, key.presence, found);
  const std::string path = table_.path_of(key.name);
  for (Reference& one : found) {
    if (!declared.any_text && !declared.name_of) one.text = current_word(one.text, declared.words);
    const bool known = declared.any_text || (declared.name_of ? is_one_of(one, path, *declared.name_of)
                                                              : contains(declared.words, one.text));
    if (known) values.push_back(one.text);
    if (!known && !declared.name_of) table_.report_unknown(one, path, std::string(declared.unknown), declared.words);
    right = right && known;
  }
  return right;
}

// --- references -----------------------------------------------------------------------------------------------------

bool KeyReader::is_one_of(const Reference& found, const std::string& path, Named of) {
  const auto [names, otherwise] = candidates(names_, of);
  const bool known = names.contains(found.text);
  const std::string member = found.text.substr(0, found.text.find(':'));
  if (!known && of == Named::point && member.size() < found.text.size() && names_.members.contains(member)) {
    table_.findings().add(found.position, path, in_quotes(found.text, 60) + " " + otherwise + ", but inside a member",
                          "divide member " + member + " there: add a point, at which one member ends and one begins");
  } else if (!known && of == Named::spring && names.all().empty()) {
    table_.findings().add(
        found.position, path, in_quotes(found.text, 60) + " " + otherwise,
        "give the [[spring]] that is meant a name, as in name = \"" + found.text.substr(0, 60) + "\"");
  } else if (!known) {
    table_.report_unknown(found, path, otherwise, names.all());
  }
  return known;
}

bool KeyReader::name(const Key& key, Named of, std::string& value) {
  Reference found;
  if (!table_.reference(key.name, key.presence, found)) return false;
  const bool known = is_one_of(found, table_.path_of(key.name), of);
  if (known) value = found.text;
  return known;
}

bool KeyReader::refers(const Key& key, Named of) {
  return is_one_of({std::string(key.name), key.position}, table_.path_of(key.name), of);
}

bool KeyReader::place(const Key& key, Place& value) {
  Reference found;
  if (!table_.reference(key.name, key.presence, found)) return false;
  const std::size_t colon = found.text.find(':');
  if (colon == std::string::npos) return point(key.name, found, value);

  const Place at{.name = found.text.substr(0, colon),
                 .fraction = number_from(found.text.substr(colon + 1)),
                 .position = found.position};
  if (!is_one_of({at.name, found.position}, table_.path_of(key.name), Named::member)) return false;
  if (!at.fraction || *at.fraction < 0.0 || *at.fraction > 1.0) {
    table_.report(key.name, in_quotes(found.text, 60) + " has no fraction between 0 and 1",
                  "write it as in " + at.name + ":0.5");
    return false;
  }
  if (!is_node(key.name, at)) return false;
  value = at;
  return true;
}

bool KeyReader::point(std::string_view key, const Reference& found, Place& value) {
  if (!names_.points.contains(found.text)) {
    std::vector<std::string> places = names_.points.all();
    for (const std::string& member : names_.members.all()) places.push_back(member + ":0.5");
    table_.report_unknown(found, table_.path_of(key), "is neither a point nor member:fraction", places);
    return false;
  }
  if (!ends_a_member(deck_, found.text)) {
    table_.report(key, "no member ends at point " + found.text,
                  "name a point at the end of a member, or member:fraction");
    return false;
  }
  value = {.name = found.text, .position = found.position};
  return true;
}

// The fraction must be one of 0, 1/n, 2/n, …, 1 with n the number of elements.
bool KeyReader::is_node(std::string_view key, const Place& at) {
  constexpr double tolerance = 1e-9;  // of the member's length; a fraction written with nine digits is good enough
  const Member* member = deck::find(deck_.members, at.name);
  if (member == nullptr || member->elements < 1) return true;  // reported where the member is read
  const double n = member->elements;
  const double position = *at.fraction * n;
  if (std::abs(std::round(position) - position) <= tolerance * n) return true;
  const double below = std::floor(position);
  table_.report(key, in_quotes(to_text(at)) + " is not a node: " + at.name + " has " + round_trip(n) + " elements",
                "the nearest are " + to_text({.name = at.name, .fraction = below / n}) + " and " +
                    to_text({.name = at.name, .fraction = (below + 1.0) / n}));
  return false;
}

// --- tables ---------------------------------------------------------------------------------------------------------

bool KeyReader::table(const Key& key, Form form, const std::function<void(Keys&)>& keys_of_table, std::string_view) {
  auto found = table_.table(key.name, key.presence, form == Form::only_element ? ".0" : "");
  if (!found) return false;
  KeyReader reader(*found, names_, deck_);
  keys_of_table(reader);
  reader.finish();
  return true;
}

bool KeyReader::each_table(const Key& key, ListForm form, const std::vector<std::string>&, const UseTable& use,
                           std::string_view) {
  const std::size_t findings_before = table_.findings().count();
  for (Cursor& table : form == ListForm::array ? table_.tables(key.name) : table_.named_tables(key.name)) {
    KeyReader reader(table, names_, deck_);
    use(reader, {.name = table.name(), .position = table.position()});
    reader.finish();
  }
  return table_.findings().count() == findings_before;
}

void KeyReader::each_entry(const std::vector<std::string>&, const std::vector<std::string_view>& without,
                           const UseKey& use) {
  for (const Value& item : table_.value().items) {
    if (std::find(without.begin(), without.end(), item.key) != without.end()) continue;
    Key key(item.key, Presence::required);
    key.position = item.key_position;
    use(key, {.name = item.key, .position = item.key_position});
  }
}

// --- choices and checks ---------------------------------------------------------------------------------------------

void KeyReader::when_chosen(std::string_view key, bool, const DeclareKeys& keys) {
  if (table_.find(key, Presence::optional) != nullptr) keys();
}

bool KeyReader::applies(bool condition, const char* key, const std::string& message, const std::string& cure) {
  if (!condition && table_.find(key, Presence::optional) != nullptr) table_.report(key, message, cure);
  return condition;
}

bool KeyReader::holds_array(std::string_view key) const {
  const Value* found = find(table_.value(), key);
  return found != nullptr && found->kind == Value::Kind::array;
}

bool KeyReader::holds_table(std::string_view key) const {
  const Value* found = find(table_.value(), key);
  return found != nullptr && found->kind == Value::Kind::table;
}

void KeyReader::report(std::string_view key, const std::string& message, const std::string& cure) {
  table_.report(key, message, cure);
}

void KeyReader::report_key(const Key& key, const std::string& message, const std::string& cure) {
  table_.findings().add(key.position, table_.path_of(key.name), message, cure);
}

void KeyReader::ignore(std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) table_.find(key, Presence::optional);
}

void KeyReader::finish() {
  if (is_complete_) table_.finish();
}

}  // namespace arcwall::deck
