#include "model/deck/cursor.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/text.hpp"
#include "model/deck/arithmetic.hpp"
#include "model/deck/synonyms.hpp"

namespace arcwall::deck {

namespace {

constexpr std::size_t longest_name_compared = 100;  // the distance of two words costs the product of their lengths

// `2,5` and `2.5` as texts: the number that is meant; empty if none is.
std::string number_in_quotes(const Value& value) {
  if (value.kind != Value::Kind::string || value.string.empty()) return {};
  std::string text = value.string;
  std::replace(text.begin(), text.end(), ',', '.');
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  return read.ec == std::errc() && read.ptr == end && std::isfinite(number) ? text : std::string();
}

// `[2,0, 0,5]`: the two numbers that are meant; empty if these are not four whole ones.
std::string without_decimal_commas(const Value& array) {
  if (array.items.size() != 4) return {};
  for (std::size_t i = 0; i < array.items.size(); ++i)
    if (array.items[i].kind != Value::Kind::integer || (i % 2 == 1 && array.items[i].integer < 0)) return {};
  const auto part = [&](std::size_t i) { return std::to_string(array.items[i].integer); };
  return "[" + part(0) + "." + part(1) + ", " + part(2) + "." + part(3) + "]";
}

std::string range_words(const IntegerRange& range) {
  const std::string from = "an integer of at least " + std::to_string(range.low);
  return range.high == std::numeric_limits<int>::max() ? from : from + " and at most " + std::to_string(range.high);
}

}  // namespace

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), most); ++i) {
    if (i > 0) text += ", ";
    text += words[i];
  }
  return words.size() > most ? text + ", …" : text;
}

void Findings::add(const Position& position, std::string key, std::string message, std::string cure) {
  diagnostics_.push_back(diagnostic_at(source_, position, std::move(key), std::move(message), std::move(cure)));
}

void Findings::add_first(const Position& position, std::string key, std::string message, std::string cure) {
  first_.push_back(diagnostic_at(source_, position, std::move(key), std::move(message), std::move(cure)));
}

void Findings::add_for_all_of(const std::string& table, const Position& position, std::string key, std::string message,
                              std::string cure) {
  explained_.push_back(table + ".");
  add_first(position, std::move(key), std::move(message), std::move(cure));
}

namespace {

std::string last_word(const std::string& key) { return key.substr(key.rfind('.') + 1); }

// A value that is wrong wherever it stands: a name that nothing has, a word that is none.
bool is_same_cause(const Diagnostic& a, const Diagnostic& b) {
  return a.message.starts_with('"') && a.file == b.file && a.message == b.message && a.cure == b.cure &&
         last_word(a.key) == last_word(b.key);
}

// Of several with one cause the first, with the lines of the others.
std::vector<Diagnostic> one_for_each_cause(const std::vector<Diagnostic>& all) {
  constexpr std::size_t most_lines = 5;
  struct Cause {
    Diagnostic first{};
    std::vector<int> lines{};  // of the others
  };
  std::vector<Cause> causes;
  std::map<std::string, std::size_t> of_message;  // of the causes: there can be as many errors as members
  for (const Diagnostic& one : all) {
    const auto [known, is_new] = of_message.try_emplace(last_word(one.key) + one.message, causes.size());
    if (is_new || !is_same_cause(causes[known->second].first, one))
      causes.push_back({.first = one});
    else
      causes[known->second].lines.push_back(one.line);
  }
  std::vector<Diagnostic> result;
  for (Cause& cause : causes) {
    const std::vector<int>& lines = cause.lines;
    if (!lines.empty()) {
      std::string where;
      for (std::size_t i = 0; i < std::min(lines.size(), most_lines); ++i)
        where += (i == 0 ? "" : ", ") + std::to_string(lines[i]);
      cause.first.message += lines.size() == 1 ? " (in line " + where + ", too)"
                                               : " (in " + std::to_string(lines.size()) + " more places, too: lines " +
                                                     where + (lines.size() > most_lines ? ", …)" : ")");
    }
    result.push_back(std::move(cause.first));
  }
  return result;
}

}  // namespace

void Findings::throw_if_any() const {
  if (first_.empty() && diagnostics_.empty()) return;
  const auto stands_before = [](const Diagnostic& a, const Diagnostic& b) {
    return std::tuple(a.line == 0, a.line, a.column) < std::tuple(b.line == 0, b.line, b.column);
  };
  const auto is_explained = [&](const Diagnostic& one) {
    return std::any_of(explained_.begin(), explained_.end(),
                       [&](const std::string& table) { return one.key.starts_with(table); });
  };
  std::vector<Diagnostic> in_order = first_, others = diagnostics_;
  std::erase_if(others, is_explained);
  std::stable_sort(in_order.begin(), in_order.end(), stands_before);
  std::stable_sort(others.begin(), others.end(), stands_before);
  in_order.insert(in_order.end(), others.begin(), others.end());
  throw InputError(one_for_each_cause(in_order));
}

Cursor::Cursor(const Value& table, std::string path, Findings& findings, Arithmetic* arithmetic)
    : value_(table),
      path_(std::move(path)),
      findings_(findings),
      arithmetic_(arithmetic),
      is_known_(table.items.size(), false) {}

const Value* Cursor::find(std::string_view key, Presence presence) {
  known_.emplace_back(key);
  const Value* found = lookup(key);
  if (found == nullptr && presence == Presence::required) {
    findings_.add(position(), path_of(key), "is missing", "add " + std::string(key));
  }
  return found;
}

const Value* Cursor::find_of_kind(std::string_view key, Presence presence, Value::Kind kind,
                                  const std::string& wanted) {
  const Value* found = find(key, presence);
  if (found == nullptr || found->kind == kind) return found;
  accept(*found, kind, path_of(key), wanted);
  return nullptr;
}

bool Cursor::accept(const Value& value, Value::Kind kind, const std::string& path, const std::string& wanted) {
  if (value.kind != kind) findings_.add(value.position, path, shown(value) + " is of the wrong type", "give " + wanted);
  return value.kind == kind;
}

std::optional<double> Cursor::number_in(const Value& value, const std::string& path, const Requirement& requirement,
                                        const std::string& wanted) {
  const bool is_number = value.kind == Value::Kind::integer || value.kind == Value::Kind::number;
  if (is_number && std::isfinite(value.number) && requirement.holds(value.number)) return value.number;
  if (value.kind == Value::Kind::string && requirement.no_number != nullptr && is_name(value.string) &&
      number_in_quotes(value).empty() && !(arithmetic_ != nullptr && arithmetic_->may_mean_a_variable(value.string))) {
    findings_.add(value.position, path, requirement.no_number, "");
    return std::nullopt;
  }
  std::string cure = "give " + wanted;
  const std::string number_meant = number_in_quotes(value);
  if (!number_meant.empty()) cure = "write " + number_meant + " without quotes";
  const bool has_decimal_comma = !number_meant.empty() && value.string.find(',') != std::string::npos;
  const bool is_formula = arithmetic_ != nullptr && value.kind == Value::Kind::string && !has_decimal_comma;
  const std::optional<double> number = is_formula ? arithmetic_->number(value, path, findings_) : value.number;
  if (!number) return std::nullopt;
  const std::string text = is_formula ? shown(value) + " = " + round_trip(*number) : shown(value);
  if (!is_formula && !is_number) {
    findings_.add(value.position, path, text + " is of the wrong type", cure);
  } else if (!std::isfinite(*number)) {
    findings_.add(value.position, path, text + " is not a finite number", cure);
  } else if (!requirement.holds(*number)) {
    if (requirement.violated != nullptr)
      findings_.add(value.position, path, requirement.violated, "");
    else
      findings_.add(value.position, path, text + " is out of range", cure);
  } else {
    return number;
  }
  return std::nullopt;
}

bool Cursor::number(std::string_view key, Presence presence, const Requirement& requirement, double& target) {
  const Value* found = find(key, presence);
  if (found == nullptr) return false;
  const std::optional<double> number = number_in(*found, path_of(key), requirement, requirement.words);
  if (number) target = *number;
  return number.has_value();
}

bool Cursor::number(std::string_view key, Presence presence, const Requirement& requirement,
                    std::optional<double>& target) {
  double value = 0.0;
  const bool right = number(key, presence, requirement, value);
  if (right) target = value;
  return right;
}

bool Cursor::integer(std::string_view key, Presence presence, const IntegerRange& range, int& target) {
  const Value* found = find(key, presence);
  if (found == nullptr) return false;
  const bool is_formula = arithmetic_ != nullptr && found->kind == Value::Kind::string;
  if (!is_formula && !accept(*found, Value::Kind::integer, path_of(key), range_words(range))) return false;
  const std::optional<double> number = number_in(*found, path_of(key), any_number, range_words(range));
  if (!number) return false;
  const bool is_whole = std::trunc(*number) == *number;
  const bool right = is_whole && *number >= range.low && *number <= range.high;
  if (right) {
    target = static_cast<int>(*number);
  } else {
    const std::string text = is_formula ? shown(*found) + " = " + round_trip(*number) : shown(*found);
    findings_.add(found->position, path_of(key), text + (is_whole ? " is out of range" : " is no whole number"),
                  "give " + range_words(range));
  }
  return right;
}

bool Cursor::integer(std::string_view key, Presence presence, const IntegerRange& range, std::optional<int>& target) {
  int value = 0;
  const bool right = integer(key, presence, range, value);
  if (right) target = value;
  return right;
}

bool Cursor::flag(std::string_view key, Presence presence, bool& target) {
  const Value* found = find_of_kind(key, presence, Value::Kind::boolean, "true or false");
  if (found != nullptr) target = found->boolean;
  return found != nullptr;
}

bool Cursor::text(std::string_view key, Presence presence, std::string& target) {
  const Value* found = find_of_kind(key, presence, Value::Kind::string, "text in quotes");
  if (found != nullptr) target = found->string;
  return found != nullptr;
}

bool Cursor::reference(std::string_view key, Presence presence, Reference& target) {
  const Value* found = find_of_kind(key, presence, Value::Kind::string, "text in quotes");
  if (found != nullptr) target = {found->string, found->position};
  return found != nullptr;
}

bool Cursor::vector(std::string_view key, Presence presence, Vector& target) {
  const std::string wanted = "two numbers [x, z]";
  const Value* found = find_of_kind(key, presence, Value::Kind::array, wanted);
  if (found == nullptr) return false;
  if (found->items.size() != 2) {
    const std::string numbers = without_decimal_commas(*found);
    findings_.add(found->position, path_of(key), shown(*found) + " has the wrong length",
                  numbers.empty() ? "give " + wanted : "a decimal comma parts two numbers; write " + numbers);
    return false;
  }
  const auto x = number_in(found->items[0], path_of(key) + ".0", any_number, any_number.words);
  const auto z = number_in(found->items[1], path_of(key) + ".1", any_number, any_number.words);
  if (x && z) target = {*x, *z};
  return x && z;
}

bool Cursor::numbers(std::string_view key, Presence presence, std::vector<double>& target) {
  const Value* found = find_of_kind(key, presence, Value::Kind::array, "an array of numbers");
  if (found == nullptr) return false;
  bool right = true;
  std::vector<double> values;
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const auto number =
        number_in(found->items[i], path_of(key) + "." + std::to_string(i), any_number, any_number.words);
    right = right && number;
    values.push_back(number.value_or(0.0));
  }
  if (values.empty()) {
    findings_.add(found->position, path_of(key), "the array is empty", "give at least one number");
    return false;
  }
  if (right) target = std::move(values);
  return right;
}

bool Cursor::references(std::string_view key, Presence presence, std::vector<Reference>& target) {
  const Value* found = find_of_kind(key, presence, Value::Kind::array, "an array of texts in quotes");
  if (found == nullptr) return false;
  if (found->items.empty()) {
    findings_.add(found->position, path_of(key), "the array is empty", "name at least one");
    return false;
  }
  bool right = true;
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const Value& item = found->items[i];
    const std::string path = path_of(key) + "." + std::to_string(i);
    if (!accept(item, Value::Kind::string, path, "text in quotes")) {
      right = false;
      continue;
    }
    const bool again = std::any_of(target.begin(), target.end(),
                                   [&item](const Reference& earlier) { return earlier.text == item.string; });
    if (again) {
      findings_.add(item.position, path, shown(item) + " is named twice", "name it once");
      right = false;
    } else {
      target.push_back({item.string, item.position});
    }
  }
  return right;
}

std::optional<Cursor> Cursor::table(std::string_view key, Presence presence, const std::string& index) {
  const Value* found = find_of_kind(key, presence, Value::Kind::table, "a table");
  if (found == nullptr) return std::nullopt;
  return Cursor(*found, path_of(key) + index, findings_, arithmetic_);
}

std::vector<Cursor> Cursor::tables(std::string_view key) {
  const Value* found =
      find_of_kind(key, Presence::optional, Value::Kind::array, "an array of tables [[" + path_of(key) + "]]");
  std::vector<Cursor> result;
  if (found == nullptr) return result;
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const std::string path = path_of(key) + "." + std::to_string(i);
    if (accept(found->items[i], Value::Kind::table, path, "a table"))
      result.emplace_back(found->items[i], path, findings_, arithmetic_);
  }
  return result;
}

std::vector<Cursor> Cursor::named_tables(std::string_view key) {
  std::vector<Cursor> result;
  auto group = table(key, Presence::optional);
  if (!group) return result;
  for (const Value& item : group->value().items) {
    const std::string path = group->path_of(item.key);
    if (!is_name(item.key)) {
      findings_.add(item.key_position, path, "is no name", "use letters, digits, _ and - only");
    }
    if (accept(item, Value::Kind::table, path, "a table [" + path_of(key) + ".NAME]")) {
      result.emplace_back(item, path, findings_, arithmetic_);
    }
  }
  return result;
}

const Value* Cursor::lookup(std::string_view key) {
  const Value* found =
      next_ < value_.items.size() && value_.items[next_].key == key ? &value_.items[next_] : deck::find(value_, key);
  if (found == nullptr) return nullptr;
  const auto index = static_cast<std::size_t>(found - value_.items.data());
  is_known_[index] = true;
  next_ = index + 1;
  return found;
}

void Cursor::finish() {
  if (std::find(is_known_.begin(), is_known_.end(), false) == is_known_.end()) return;
  std::set<std::string_view> seen;
  std::vector<std::string> known;
  for (const std::string& key : known_)
    if (seen.insert(key).second) known.push_back(key);
  for (std::size_t i = 0; i < value_.items.size(); ++i) {
    const Value& item = value_.items[i];
    if (is_known_[i]) continue;
    report_unknown({item.key, item.key_position}, path_of(item.key), "is not a key of this table", known);
  }
}

void Cursor::report(std::string_view key, std::string message, std::string cure) {
  const Value* found = deck::find(value_, key);
  findings_.add(found != nullptr ? found->position : position(), path_of(key), std::move(message), std::move(cure));
}

void Cursor::report_unknown(const Reference& found, const std::string& path, const std::string& message,
                            const std::vector<std::string>& candidates) {
  std::string near = meant_by(found.text, candidates);
  if (near.empty() && found.text.size() <= longest_name_compared) near = nearest_meant(found.text, candidates);
  std::string cure = candidates.empty() ? "there is none" : "known are " + listed(candidates);
  if (!near.empty()) cure = "did you mean " + near + "?";
  findings_.add(found.position, path, in_quotes(found.text, longest_name_compared) + " " + message, std::move(cure));
}

Position Cursor::position() const { return value_.key.empty() ? value_.position : value_.key_position; }

std::string Cursor::path_of(std::string_view key) const { return (path_.empty() ? "" : path_ + ".") + key_text(key); }

}  // namespace arcwall::deck
