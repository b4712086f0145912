#include "model/deck/formula.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/text.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

constexpr std::size_t longest_formula = 1000;  // bytes
constexpr int most_nested = 100;
constexpr std::size_t most_of_formula = 60;

constexpr const char* what_formulas_have =
    "write numbers, names of [variables], pi, + - * / ^ ( ), and functions such as sqrt or sin";

struct Function {
  std::string_view name;
  std::size_t arguments;
  double (*value)(const std::vector<double>&);
};

constexpr std::array<Function, 14> functions{{
    {"sqrt", 1, [](const std::vector<double>& x) { return std::sqrt(x[0]); }},
    {"exp", 1, [](const std::vector<double>& x) { return std::exp(x[0]); }},
    {"ln", 1, [](const std::vector<double>& x) { return std::log(x[0]); }},
    {"log10", 1, [](const std::vector<double>& x) { return std::log10(x[0]); }},
    {"sin", 1, [](const std::vector<double>& x) { return std::sin(x[0]); }},
    {"cos", 1, [](const std::vector<double>& x) { return std::cos(x[0]); }},
    {"tan", 1, [](const std::vector<double>& x) { return std::tan(x[0]); }},
    {"asin", 1, [](const std::vector<double>& x) { return std::asin(x[0]); }},
    {"acos", 1, [](const std::vector<double>& x) { return std::acos(x[0]); }},
    {"atan", 1, [](const std::vector<double>& x) { return std::atan(x[0]); }},
    {"atan2", 2, [](const std::vector<double>& x) { return std::atan2(x[0], x[1]); }},
    {"abs", 1, [](const std::vector<double>& x) { return std::abs(x[0]); }},
    {"min", 2, [](const std::vector<double>& x) { return std::min(x[0], x[1]); }},
    {"max", 2, [](const std::vector<double>& x) { return std::max(x[0], x[1]); }},
}};

struct Problem {
  std::string message, cure;
};

bool is_digit_of_number(char c) { return c >= '0' && c <= '9'; }
bool is_ascii_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_in_name(char c) { return is_ascii_letter(c) || is_digit_of_number(c) || c == '_'; }

double value_of_call(const std::string& name, const std::vector<double>& arguments) {
  const auto* const found =
      std::find_if(functions.begin(), functions.end(), [&](const Function& function) { return function.name == name; });
  if (found == functions.end()) {
    std::string known;
    for (const Function& one : functions) known += (known.empty() ? "" : ", ") + std::string(one.name);
    throw Problem{"has no function " + in_quotes(name, most_of_formula), "known are " + known};
  }
  if (arguments.size() != found->arguments)
    throw Problem{
        "has " + std::to_string(arguments.size()) + (arguments.size() == 1 ? " number" : " numbers") + " for " + name,
        "give " + std::to_string(found->arguments)};
  return found->value(arguments);
}

// By recursive descent:
//
//   sum     = product { ("+" | "-") product }
//   product = signed { ("*" | "/") signed }
//   signed  = { "+" | "-" } power
//   power   = operand [ "^" signed ]
//   operand = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
class FormulaParser {
 public:
  FormulaParser(const std::string& formula, const NumberNamed& number_named)
      : rest_(formula), number_named_(number_named) {
    if (formula.size() > longest_formula)
      throw Problem{"is longer than " + std::to_string(longest_formula) + " characters",
                    "compute parts of it in [variables]"};
  }

  double value() {
    const double result = sum();
    next();
    if (!rest_.empty()) stop();
    return result;
  }

 private:
  double sum() {
    double result = product();
    while (true) {
      if (take('+'))
        result += product();
      else if (take('-'))
        result -= product();
      else
        return result;
    }
  }

  double product() {
    double result = with_sign();
    while (true) {
      if (take('*'))
        result *= with_sign();
      else if (take('/'))
        result /= with_sign();
      else
        return result;
    }
  }

  double with_sign() {
    double sign = 1.0;
    while (next() == '+' || next() == '-')
      if (take('-'))
        sign = -sign;
      else
        take('+');
    return sign * power();
  }

  double power() {
    const double base = operand();
    return take('^') ? std::pow(base, nested([this] { return with_sign(); })) : base;
  }

  double operand() {
    if (take('(')) return nested([this] { return closed(sum()); });
    if (is_ascii_letter(next())) return named();
    double number = 0.0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (!is_digit_of_number(next()) && next() != '.') stop();
    if (error == std::errc::result_out_of_range) throw Problem{"has a number out of range", "change it"};
    if (error != std::errc{}) stop();
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return number;
  }

  double named() {
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_in_name);
    const std::string name(rest_.begin(), end);
    rest_.remove_prefix(name.size());
    if (take('(')) return nested([&] { return value_of_call(name, arguments()); });
    if (name == "pi") return std::numbers::pi;
    if (const std::optional<double> number = number_named_(name)) return *number;
    throw Problem{"has a name that is not in [variables]: " + in_quotes(name, most_of_formula), what_formulas_have};
  }

  std::vector<double> arguments() {
    std::vector<double> list{sum()};
    while (take(',')) list.push_back(sum());
    closed(0.0);
    return list;
  }

  double closed(double result) {
    if (!take(')')) stop();
    return result;
  }

  // Brackets and powers call the rules above again.
  template <class Rule>
  double nested(Rule rule) {
    if (++depth_ > most_nested)
      throw Problem{"is nested deeper than " + std::to_string(most_nested), "compute parts of it in [variables]"};
    const double result = rule();
    --depth_;
    return result;
  }

  // The next character that is no space; NUL at the end.
  char next() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size()));
    return rest_.empty() ? '\0' : rest_.front();
  }

  bool take(char c) {
    const bool is_next = next() == c;
    if (is_next) rest_.remove_prefix(1);
    return is_next;
  }

  [[noreturn]] void stop() {
    next();
    throw Problem{rest_.empty() ? "ends where a number, a name or a bracket is missing"
                                : "is no arithmetic from " + in_quotes(rest_, most_of_formula) + " on",
                  what_formulas_have};
  }

  std::string_view rest_;
  const NumberNamed& number_named_;
  int depth_ = 0;
};

}  // namespace

FormulaResult evaluate(const std::string& formula, const NumberNamed& number_named) {
  try {
    const double value = FormulaParser(formula, number_named).value();
    if (std::isfinite(value)) return {.value = value};
    return {.problem = "is " + round_trip(value) + ", not a finite number", .cure = "change the formula"};
  } catch (const Problem& problem) {
    return {.problem = problem.message, .cure = problem.cure};
  }
}

std::vector<std::string> names_in_formula(const std::string& formula) {
  std::vector<std::string> names;
  try {
    const NumberNamed take_down = [&](const std::string& name) {
      names.push_back(name);
      return 1.0;
    };
    FormulaParser(formula, take_down).value();
  } catch (const Problem&) {
    names.clear();
  }
  return names;
}

const std::vector<std::string>& words_of_formulas() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> words{"pi"};
    for (const Function& function : functions) words.emplace_back(function.name);
    return words;
  }();
  return all;
}

bool is_formula_name(std::string_view text) {
  return !text.empty() && is_ascii_letter(text.front()) && std::all_of(text.begin(), text.end(), is_in_name);
}

}  // namespace arcwall::deck
