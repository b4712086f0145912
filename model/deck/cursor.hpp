#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "model/deck/value.hpp"
#include "model/deck/words.hpp"

namespace arcwall::deck {

class Arithmetic;

/// Collects everything that is wrong with one deck.
class Findings {
 public:
  /// `source` must outlive this.
  explicit Findings(const Source& source) : source_(source) {}

  void add(const Position& position, std::string key, std::string message, std::string cure = {});

  std::size_t count() const { return diagnostics_.size(); }

  /// InputError with all that was added, by their order in the text; returns if there is nothing. What is wrong in the
  /// same words in several places, as a name that nothing has, is one error, which names the lines of the others.
  void throw_if_any() const;

  /// The same of what others follow from: it comes before all others.
  void add_first(const Position& position, std::string key, std::string message, std::string cure);

  /// The same of a table, whose own keys then have no errors: they would follow from this one.
  void add_for_all_of(const std::string& table, const Position& position, std::string key, std::string message,
                      std::string cure);

 private:
  const Source& source_;
  std::vector<Diagnostic> first_{}, diagnostics_{};
  std::vector<std::string> explained_{};  // tables
};

/// What a finite number must satisfy, in code and in words.
struct Requirement {
  bool (*holds)(double);
  const char* words;
  const char* violated = nullptr;   ///< said of a number that does not; null: that it is out of range
  const char* no_number = nullptr;  ///< said of a word in place of the number; null: as of every formula
};

inline constexpr Requirement any_number{[](double) { return true; }, "a number"};
inline constexpr Requirement positive{[](double v) { return v > 0.0; }, "a number greater than 0"};
inline constexpr Requirement not_negative{[](double v) { return v >= 0.0; }, "a number of at least 0"};
inline constexpr Requirement coefficient_of_friction{
    [](double v) { return v >= 0.0; }, "a number of at least 0",
    "friction must not be negative: it is the ratio of the greatest friction force to the contact force",
    "friction is a number, e.g. 0.3; for a contact that never slips give a large one, e.g. 1e3"};
inline constexpr Requirement not_zero{[](double v) { return v != 0.0; }, "a number other than 0"};

struct IntegerRange {
  int low = 0;
  int high = std::numeric_limits<int>::max();
};

enum class Presence { required, optional };

/// A text of the deck that names something.
struct Reference {
  std::string text{};
  Position position{};
};

/// Reads one table of the deck. Every function marks its key as known, reports what is wrong with its value and returns
/// true, having set the target, only if the value is there and right.
class Cursor {
 public:
  /// `table` is a table; `path` is its dotted key. Texts in place of numbers are formulas if there is arithmetic. All
  /// references must outlive this.
  Cursor(const Value& table, std::string path, Findings& findings, Arithmetic* arithmetic = nullptr);

  /// The value, or null; a missing required key is reported.
  const Value* find(std::string_view key, Presence presence);

  bool number(std::string_view key, Presence presence, const Requirement& requirement, double& target);
  bool number(std::string_view key, Presence presence, const Requirement& requirement, std::optional<double>& target);
  bool integer(std::string_view key, Presence presence, const IntegerRange& range, int& target);
  bool integer(std::string_view key, Presence presence, const IntegerRange& range, std::optional<int>& target);
  bool flag(std::string_view key, Presence presence, bool& target);
  bool text(std::string_view key, Presence presence, std::string& target);
  bool reference(std::string_view key, Presence presence, Reference& target);
  bool vector(std::string_view key, Presence presence, Vector& target);  ///< [x, z]
  bool numbers(std::string_view key, Presence presence, std::vector<double>& target);
  bool references(std::string_view key, Presence presence,
                  std::vector<Reference>& target);  ///< at least one, each once

  /// One of a list of words.
  template <class Enum, std::size_t count>
  bool word(std::string_view key, Presence presence, const Words<Enum, count>& words, Enum& target) {
    Reference found;
    if (!reference(key, presence, found)) return false;
    const std::optional<Enum> value = from_text(words, found.text);
    if (value) {
      target = *value;
    } else {
      report_unknown(found, path_of(key), "is not one of the words for this key", texts(words));
    }
    return value.has_value();
  }

  /// `index`: what the paths of its keys have behind its own.
  std::optional<Cursor> table(std::string_view key, Presence presence, const std::string& index = {});

  /// The tables of an array of tables, in their order; empty if the key is not there.
  std::vector<Cursor> tables(std::string_view key);

  /// The tables in a table whose keys are names, like [member.NAME], in their order.
  std::vector<Cursor> named_tables(std::string_view key);

  /// Reports every key that was not asked for. Call it last.
  void finish();

  /// Reports about the value of `key`, or about the table itself where it is not there.
  void report(std::string_view key, std::string message, std::string cure = {});

  /// Reports that `found` is not among `candidates` and proposes the nearest.
  void report_unknown(const Reference& found, const std::string& path, const std::string& message,
                      const std::vector<std::string>& candidates);

  bool has(std::string_view key) const { return deck::find(value_, key) != nullptr; }
  const Value& value() const { return value_; }
  const std::string& name() const { return value_.key; }
  Position position() const;  ///< of the key where it has one, else of the table
  const std::string& path() const { return path_; }
  std::string path_of(std::string_view key) const;
  Findings& findings() { return findings_; }

 private:
  const Value* lookup(std::string_view key);
  std::optional<double> number_in(const Value& value, const std::string& path, const Requirement& requirement,
                                  const std::string& wanted);
  bool accept(const Value& value, Value::Kind kind, const std::string& path, const std::string& wanted);
  const Value* find_of_kind(std::string_view key, Presence presence, Value::Kind kind, const std::string& wanted);

  const Value& value_;
  std::string path_;
  Findings& findings_;
  Arithmetic* arithmetic_;
  std::vector<std::string> known_{};  // every key that was asked for, there or not
  std::vector<bool> is_known_;        // for each item of the table
  std::size_t next_ = 0;              // keys are mostly asked for in their order, which makes long tables fast
};

/// As a message lists them; cut where it gets long.
std::string listed(const std::vector<std::string>& words);

}  // namespace arcwall::deck
