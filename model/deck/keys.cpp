#include "model/deck/keys.hpp"

#include <functional>

#include "core/text.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

using Text = std::optional<std::string>;

// With a point or an exponent, so that TOML takes it for a float.
std::string float_text(double value) {
  std::string text = round_trip(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

// A few on a line: lines stay short however long the list is.
template <class List, class ToText>
std::string array_text(const List& list, ToText to_text) {
  constexpr std::size_t most_on_a_line = 8;
  std::string text = "[";
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) text += i % most_on_a_line == 0 ? ",\n  " : ", ";
    text += to_text(list[i]);
  }
  return text + "]";
}

struct TomlText {
  bool empty_is_none;
  const std::function<std::string(const std::string&, double)>& formula_of;

  std::string number(double value, const std::string& text, const std::string& key = {}) const {
    const std::string formula = formula_of ? formula_of(key, value) : std::string();
    return formula.empty() ? text : in_quotes(formula);
  }
  std::string numbers(const std::vector<double>& values) const {
    std::size_t i = 0;
    return array_text(values,
                      [&](double value) { return number(value, float_text(value), "." + std::to_string(i++)); });
  }

  Text operator()(const std::optional<double>* value) const {
    return *value ? Text(number(**value, float_text(**value))) : Text();
  }
  Text operator()(const std::optional<int>* value) const {
    return *value ? Text(number(**value, std::to_string(**value))) : Text();
  }
  Text operator()(const bool* value) const { return *value ? "true" : "false"; }
  Text operator()(const std::string* value) const { return in_quotes(*value); }
  Text operator()(const Vector* value) const { return numbers({value->x, value->z}); }
  // An array that is there has a number.
  Text operator()(const std::vector<double>* values) const { return values->empty() ? Text() : Text(numbers(*values)); }
  Text operator()(const Place* value) const { return in_quotes(to_text(*value)); }
  Text operator()(const std::optional<std::string>* word) const { return *word ? Text(in_quotes(**word)) : Text(); }
  Text operator()(const std::vector<std::string>* texts) const {
    if (texts->empty() && empty_is_none) return {};
    return array_text(*texts, [](const std::string& text) { return in_quotes(text); });
  }
};

}  // namespace

Text Keys::toml_text(const Target& target, const Declared& declared, const FormulaOf& formula_of) {
  return std::visit(TomlText{declared.empty == EmptyList::refused, formula_of}, target);
}

}  // namespace arcwall::deck
