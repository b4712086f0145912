#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "model/deck/cursor.hpp"
#include "model/deck/deck.hpp"
#include "model/deck/words.hpp"

/// Each key of a deck is declared once, by a call that names it, its value, its unit, its range and its meaning:
///
///     keys.number("E", material.E, unit::stress, positive, "Young's modulus");
///
/// The declarations are functions of a table's `Keys`. What these are decides what the calls do: a reader of decks
/// checks and takes over what stands there (key_reader.hpp), the writer of decks writes it (writer.hpp), and a list of
/// keys takes down what is declared (key_list.hpp), for the page on decks, the units of sweeps, completion and fuzzing.
namespace arcwall::deck {

/// What a number is measured in: powers of the deck's units.
struct Dimension {
  enum class Axis { none, x, z, both };

  int force = 0, length = 0;
  Axis axis = Axis::none;  ///< of a coordinate, not of a length
};

namespace unit {
inline constexpr Dimension none{}, force{1, 0}, moment{1, 1}, energy{1, 1}, line_load{1, -1}, stress{1, -2};
inline constexpr Dimension length{0, 1}, area{0, 2}, second_moment{0, 4}, curvature{0, -1};
inline constexpr Dimension place{0, 1, Dimension::Axis::both}, place_x{0, 1, Dimension::Axis::x},
    place_z{0, 1, Dimension::Axis::z};
}  // namespace unit

/// A key of a table. One that is written as a plain text must be there.
struct Key {
  Key(const char* key) : name(key) {}
  Key(std::string_view key, Presence there, std::string_view without = {})
      : name(key), presence(there), otherwise(without) {}

  std::string_view name;
  Presence presence = Presence::required;
  std::string_view otherwise{};  ///< what the page on decks has for a default; empty: the value itself
  Position position{};           ///< of a key that is a name
};

/// A key that may be left out.
inline Key optional(const char* key, std::string_view otherwise = {}) { return {key, Presence::optional, otherwise}; }

/// What the parts of a deck that have names are; a column is `lambda` or a monitor.
enum class Named { material, section, point, member, wall, spring, monitor, column };

/// Whether an empty list stands for none, or none is said by leaving the key out.
enum class EmptyList { means_none, refused };

/// How a table is written: `[units]`, `profile.type = "flat"`, or `sine = { rise = 1.0, waves = 2 }`. One that is read
/// in place of an array is its only element.
enum class Form { header, dotted, in_line, only_element };

/// Tables of one key: `[[load]]` or `[member.NAME]`.
enum class ListForm { array, named };

/// An alternative of one_of(): the word for it, what it means, and its keys.
template <class Type>
struct Option {
  std::string_view word, meaning;
  std::function<void(Type&)> keys;
};

/// The keys of one table.
///
/// Functions that declare a key are true if it was read and its value is right; so they are false while a deck is
/// written or listed, and what depends on a value is checked where they are true. The last argument says what the key
/// means.
class Keys {
 public:
  virtual ~Keys() = default;

  // --- values -------------------------------------------------------------------------------------------------------

  template <class Number>  // double, or an optional one
  bool number(const Key& key, Number& value, const Dimension& unit, const Requirement& required,
              std::string_view meaning) {
    return through_optional<double>(value, [&](std::optional<double>& number) {
      return declare(key, &number, {.meaning = meaning, .unit = unit, .required = required});
    });
  }
  template <class Integer>  // int, or an optional one
  bool integer(const Key& key, Integer& value, const IntegerRange& range, std::string_view meaning) {
    return through_optional<int>(value, [&](std::optional<int>& integer) {
      return declare(key, &integer, {.meaning = meaning, .range = range});
    });
  }
  bool flag(const Key& key, bool& value, std::string_view meaning) {
    return declare(key, &value, {.meaning = meaning});
  }
  bool text(const Key& key, std::string& value, std::string_view meaning) {
    return declare(key, &value, {.meaning = meaning});
  }
  bool vector(const Key& key, Vector& value, const Dimension& unit, std::string_view meaning) {
    return declare(key, &value, {.meaning = meaning, .unit = unit});
  }
  bool numbers(const Key& key, std::vector<double>& values, const Dimension& unit, std::string_view meaning) {
    return declare(key, &values, {.meaning = meaning, .unit = unit});
  }

  /// The name of a part of the deck, and a list of such names.
  bool name(const Key& key, std::string& value, Named of, std::string_view meaning) {
    return declare(key, &value, {.meaning = meaning, .name_of = of});
  }
  bool names(const Key& key, std::vector<std::string>& values, Named of, EmptyList empty, std::string_view meaning) {
    return declare(key, &values, {.meaning = meaning, .name_of = of, .empty = empty});
  }

  /// A point at which a member ends, or `member:fraction`.
  bool place(const Key& key, Place& value, std::string_view meaning) {
    return declare(key, &value, {.meaning = meaning});
  }

  /// One of a list of words.
  template <class Word, class Enum, std::size_t count>  // Word: Enum, or an optional one
  bool word(const Key& key, Word& value, const Words<Enum, count>& words, std::string_view meaning) {
    return through_optional<Enum>(value, [&](std::optional<Enum>& present) {
      std::optional<std::string> text;
      if (present) text = text_of(words, *present);
      const bool right = declare(key, &text, {.meaning = meaning, .words = texts(words)});
      if (right) present = from_text(words, *text);
      return right;
    });
  }

  /// Some of a list of words, each once; others are reported as `unknown`. None is said by leaving the key out.
  template <class Enum, std::size_t count>
  bool words(const Key& key, std::vector<Enum>& values, const Words<Enum, count>& words, std::string_view unknown,
             std::string_view meaning) {
    std::vector<std::string> found;
    for (const Enum value : values) found.push_back(text_of(words, value));
    const bool right = declare(key, &found, {.meaning = meaning, .words = texts(words), .unknown = unknown});
    values.clear();
    for (const std::string& text : found) values.push_back(*from_text(words, text));
    return right;
  }

  /// Some of the texts that this deck allows, each once; others are reported as `unknown`.
  bool choices(const Key& key, std::vector<std::string>& values, const std::vector<std::string>& known,
               std::string_view unknown, std::string_view meaning) {
    return declare(key, &values, {.meaning = meaning, .words = known, .unknown = unknown});
  }

  /// Any texts, each once; an empty list is none.
  bool any_texts(const Key& key, std::vector<std::string>& values, std::string_view meaning) {
    return declare(key, &values, {.meaning = meaning, .any_text = true, .empty = EmptyList::means_none});
  }

  // --- tables -------------------------------------------------------------------------------------------------------

  /// A table of its own.
  virtual bool table(const Key& key, Form form, const std::function<void(Keys&)>& keys_of_table,
                     std::string_view meaning) = 0;

  /// An array of tables, as [[load]]. True if all of them are right.
  template <class Element, class KeysOfElement>
  bool tables(const Key& key, std::vector<Element>& list, KeysOfElement keys_of_element, std::string_view meaning) {
    const std::vector<std::string> no_names(list.size());
    return each_table(
        key, ListForm::array, no_names,
        [&](Keys& keys, const Entry& entry) {
          use_element<Element>(list, nullptr, entry, [&](Element& one) { return keys_of_element(keys, one), true; });
        },
        meaning);
  }

  /// Tables with names, as [member.NAME]. True if all of them are right.
  template <class Element, class KeysOfElement>
  bool named_tables(const Key& key, std::vector<Element>& list, KeysOfElement keys_of_element,
                    std::string_view meaning) {
    return each_table(
        key, ListForm::named, names_of(list, &Element::name),
        [&](Keys& keys, const Entry& entry) {
          use_element(list, &Element::name, entry, [&](Element& one) { return keys_of_element(keys, one), true; });
        },
        meaning);
  }

  /// The keys of a table that are names, as those of [point], without some that are not. Takes an element whose
  /// declaration is true.
  template <class Element, class KeyOfElement>
  void entries(std::vector<Element>& list, std::string Element::*name, KeyOfElement key_of_element,
               const std::vector<std::string_view>& without = {}) {
    each_entry(names_of(list, name), without, [&](const Key& key, const Entry& entry) {
      use_element(list, name, entry, [&](Element& one) { return key_of_element(key, one); });
    });
  }

  // --- choices ------------------------------------------------------------------------------------------------------

  /// A word that says which alternative the value is; further keys follow from it.
  template <class... Types>
  void one_of(const Key& key, std::variant<Types...>& value, std::string_view meaning,
              const Option<Types>&... options) {
    std::optional<std::string> word;
    ((std::holds_alternative<Types>(value) ? void(word = options.word) : void()), ...);
    const bool right = declare(key, &word, {.meaning = meaning, .words = {std::string(options.word)...}});
    if (reads() && !right) return give_up();
    const auto use = [&]<class Type>(const Option<Type>& one) {
      option(one.word, one.meaning, word == one.word, [&] { one.keys(as<Type>(value)); });
    };
    (use(options), ...);
  }

  /// An alternative, or a part that may be missing, which a key of its own tells.
  template <class Type, class Variant, class KeysOfType>
  void alternative(const char* key, Variant& value, KeysOfType keys_of_type) {
    when_chosen(key, std::holds_alternative<Type>(value), [&] { keys_of_type(as<Type>(value)); });
  }
  template <class Part, class KeysOfPart>
  void part(const char* key, std::optional<Part>& part, KeysOfPart keys_of_part) {
    when_chosen(key, part.has_value(), [&] { keys_of_part(part ? *part : part.emplace()); });
  }

  /// Whether a key belongs to what other keys have said. Where it does not, it is reported if it is there.
  virtual bool applies(bool condition, const char* key, const std::string& message, const std::string& cure) = 0;

  // --- for checks; they do nothing unless a deck is read ------------------------------------------------------------

  virtual bool reads() const { return false; }
  virtual bool has(std::string_view) const { return false; }
  virtual bool holds_array(std::string_view) const { return true; }  ///< true also while a deck is written or listed
  virtual bool holds_table(std::string_view) const { return false; }
  virtual Position position() const { return {}; }  ///< of the table

  /// Reports about the value of a key, about the table where it has none, or about the key itself.
  virtual void report(std::string_view, const std::string& /*message*/, const std::string& /*cure*/) {}
  virtual void report_key(const Key&, const std::string& /*message*/, const std::string& /*cure*/) {}

  /// Whether a key is the name of a part of the deck; reports it if it is not.
  virtual bool refers(const Key&, Named) { return false; }

  /// Keys about which nothing can be said, since the key on which they depend is wrong; and all others of the table.
  virtual void ignore(std::initializer_list<std::string_view>) {}
  virtual void give_up() {}

  // --- for a reader of the deck that is written ---------------------------------------------------------------------

  virtual bool writes() const { return false; }
  virtual bool lists() const { return false; }  ///< takes down the keys of all alternatives
  virtual void comment(const std::string&) {}

 protected:
  /// Where a value is. Texts are texts or names, lists of texts words or names.
  using Target = std::variant<std::optional<double>*, std::optional<int>*, bool*, std::string*, Vector*,
                              std::vector<double>*, Place*, std::optional<std::string>*, std::vector<std::string>*>;

  /// What a declaration says of it.
  struct Declared {
    std::string_view meaning{};
    Dimension unit{};
    Requirement required = any_number;
    IntegerRange range{};
    std::vector<std::string> words{};
    std::string_view unknown{};  ///< what is said of other words
    bool any_text = false;       ///< of a list, whose texts need not be words or names
    std::optional<Named> name_of{};
    EmptyList empty = EmptyList::refused;
  };
  virtual bool declare(const Key& key, const Target& target, const Declared& declared) = 0;

  /// The value as TOML has it; nothing if there is none. `formula_of`: what a number is written as, by its value and
  /// what its key has after the target's, `.1` in an array; empty: the number.
  using FormulaOf = std::function<std::string(const std::string&, double)>;
  static std::optional<std::string> toml_text(const Target& target, const Declared& declared,
                                              const FormulaOf& formula_of = {});

  /// One of several tables or keys.
  struct Entry {
    std::string name{};
    Position position{};
    std::optional<std::size_t> index{};  ///< in the list that is written; empty: a new one
  };

  using UseTable = std::function<void(Keys&, const Entry&)>;
  virtual bool each_table(const Key& key, ListForm form, const std::vector<std::string>& names, const UseTable& use,
                          std::string_view meaning) = 0;
  using UseKey = std::function<void(const Key&, const Entry&)>;
  virtual void each_entry(const std::vector<std::string>& names, const std::vector<std::string_view>& without,
                          const UseKey& use) = 0;

  /// Declares the keys of an option of one_of(), or of what a key of its own tells, where the value has it.
  using DeclareKeys = std::function<void()>;
  virtual void option(std::string_view /*word*/, std::string_view /*meaning*/, bool has_it, const DeclareKeys& keys) {
    if (has_it) keys();
  }
  virtual void when_chosen(std::string_view /*key*/, bool has_it, const DeclareKeys& keys) {
    if (has_it) keys();
  }

 private:
  template <class Type, class Use>
  static bool through_optional(std::optional<Type>& value, Use use) {
    return use(value);
  }
  template <class Type, class Use>
  static bool through_optional(Type& value, Use use) {
    std::optional<Type> present = value;
    const bool right = use(present);
    value = *present;
    return right;
  }

  template <class Type, class Variant>
  static Type& as(Variant& value) {
    return std::holds_alternative<Type>(value) ? std::get<Type>(value) : value.template emplace<Type>();
  }

  template <class Element>
  static std::vector<std::string> names_of(const std::vector<Element>& list, std::string Element::*name) {
    std::vector<std::string> names;
    for (const Element& element : list) names.push_back(element.*name);
    return names;
  }

  // An element of the list, or a new one, which `use` may refuse.
  template <class Element, class Use>
  static void use_element(std::vector<Element>& list, std::string Element::*name, const Entry& entry, Use use) {
    if (entry.index) return void(use(list[*entry.index]));
    Element element{};
    if (name != nullptr) element.*name = entry.name;
    element.position = entry.position;
    if (use(element)) list.push_back(std::move(element));
  }
};

}  // namespace arcwall::deck
