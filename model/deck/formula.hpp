#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace arcwall::deck {

/// The value of an arithmetic expression, or why it has none and what would be right.
struct FormulaResult {
  std::optional<double> value{};
  std::string problem{}, cure{};
};

/// The number that a name in a formula means; empty: there is no such name.
using NumberNamed = std::function<std::optional<double>(const std::string&)>;

/// Evaluates numbers, names, `pi`, `+ - * / ^ ( )` and functions. `^` binds more tightly than a sign before it and
/// groups from the right: -2^2 = -4. A result that is not finite is a problem.
FormulaResult evaluate(const std::string& formula, const NumberNamed& number_named);

/// Names in a formula, in their order and as often as it has them; empty where it is no arithmetic expression.
std::vector<std::string> names_in_formula(const std::string& formula);

/// `pi` and the functions.
const std::vector<std::string>& words_of_formulas();

/// A letter, followed by letters, digits and `_`.
bool is_formula_name(std::string_view text);

}  // namespace arcwall::deck
