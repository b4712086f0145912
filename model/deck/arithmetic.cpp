#include "model/deck/arithmetic.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/text.hpp"
#include "model/deck/cursor.hpp"

namespace arcwall::deck {

namespace {

constexpr std::size_t most_of_a_formula = 60;
constexpr std::ptrdiff_t most_named = 10;  // variables of a cycle

bool holds_number(const Value& value) {
  return value.kind == Value::Kind::integer || value.kind == Value::Kind::number;
}

}  // namespace

Arithmetic::Arithmetic(const Value& root) {
  const Value* const table = find(root, "variables");
  if (table == nullptr || table->kind != Value::Kind::table) return;
  for (const Value& item : table->items) {
    Variable& variable = variables_[item.key];
    variable.given = &item;
    if (holds_number(item) && std::isfinite(item.number)) variable.value = item.number;
  }
  compute_variables();
}

// In an order in which each variable comes after those that it uses.
void Arithmetic::compute_variables() {
  std::map<std::string, std::size_t> waits_for;
  std::vector<std::string> ready;
  for (auto& [name, variable] : variables_) {
    if (variable.given->kind == Value::Kind::string)
      for (std::string& used : names_in_formula(variable.given->string))
        if (variables_.contains(used)) variable.uses.push_back(std::move(used));
    for (const std::string& used : variable.uses) variables_.at(used).users.push_back(name);
    waits_for[name] = variable.uses.size();
    if (variable.uses.empty()) ready.push_back(name);
  }
  while (!ready.empty()) {
    Variable& variable = variables_.at(ready.back());
    ready.pop_back();
    variable.is_computed = true;
    if (variable.given->kind == Value::Kind::string) variable.value = outcome(variable.given->string).result.value;
    for (const std::string& user : variable.users)
      if (--waits_for[user] == 0) ready.push_back(user);
  }
}

// What a variable waits for that has not been computed leads into a cycle.
void Arithmetic::report_cycles(Findings& findings) const {
  std::set<std::string> seen;
  const auto waits = [&](const std::string& name) { return !variables_.at(name).is_computed; };
  for (const auto& [start, variable] : variables_) {
    std::vector<std::string> chain;
    std::string at = start;
    while (waits(at) && seen.insert(at).second) {
      chain.push_back(at);
      const std::vector<std::string>& uses = variables_.at(at).uses;
      at = *std::find_if(uses.begin(), uses.end(), waits);
    }
    const auto begin = std::find(chain.begin(), chain.end(), at);
    if (begin == chain.end()) continue;
    const auto shown = begin + std::min(most_named, chain.end() - begin);
    std::string words;
    for (auto one = begin; one != shown; ++one) words += *one + " uses ";
    findings.add(variables_.at(at).given->position, "variables." + at,
                 "is computed from itself: " + words + (shown == chain.end() ? at : "…"), "give one of them a number");
  }
}

std::vector<std::string> Arithmetic::known_words() const {
  std::vector<std::string> known = words_of_formulas();
  for (const auto& [name, variable] : variables_) known.push_back(name);
  return known;
}

bool Arithmetic::may_mean_a_variable(const std::string& word) const {
  const std::vector<std::string> known = known_words();
  return std::find(known.begin(), known.end(), word) != known.end() || !nearest(word, known).empty();
}

Arithmetic::Outcome Arithmetic::outcome(const std::string& formula) const {
  Outcome outcome;
  std::string unknown;
  outcome.result = evaluate(formula, [&](const std::string& name) {
    const auto found = variables_.find(name);
    outcome.follows = found != variables_.end() && !found->second.value;
    if (found == variables_.end()) unknown = name;
    return found == variables_.end() ? std::nullopt : found->second.value;
  });
  if (unknown.empty() || unknown.size() > most_of_a_formula) return outcome;
  const std::string near = nearest(unknown, known_words());
  outcome.result.cure =
      near.empty() ? "add " + unknown + " to [variables], or write a number" : "did you mean " + near + "?";
  return outcome;
}

std::optional<double> Arithmetic::number(const Value& formula, const std::string& key, Findings& findings) {
  const Outcome found = outcome(formula.string);
  const auto& [value, problem, cure] = found.result;
  if (value) formulas_[key] = {.text = formula.string, .value = *value};
  if (!value && !found.follows)
    findings.add(formula.position, key, in_quotes(formula.string, most_of_a_formula) + " " + problem, cure);
  return value;
}

std::map<std::string, double> slopes_of_formulas(const Deck& deck, const std::string& variable) {
  constexpr double change = 1e-6;
  const auto values_with = [&](double of_variable) {
    Value root, table{.key = "variables"};
    for (const deck::Variable& one : deck.variables) {
      const auto formula = deck.formulas.find("variables." + one.name);
      Value& item = table.items.emplace_back(Value{.kind = Value::Kind::number, .key = one.name, .number = one.value});
      if (one.name == variable) {
        item.number = of_variable;
      } else if (formula != deck.formulas.end()) {
        item.kind = Value::Kind::string;
        item.string = formula->second.text;
      }
    }
    root.items.push_back(std::move(table));
    Arithmetic arithmetic(root);
    Findings ignored(deck.source);
    for (const auto& [key, formula] : deck.formulas)
      arithmetic.number({.kind = Value::Kind::string, .string = formula.text}, key, ignored);
    return arithmetic.formulas();
  };
  const Variable* const own = find(deck.variables, variable);
  const double value = own == nullptr ? 0.0 : own->value, h = change * (value == 0.0 ? 1.0 : std::abs(value));
  const Formulas low = values_with(value - h), high = values_with(value + h);
  std::map<std::string, double> slopes;
  for (const auto& [key, formula] : high)
    if (const auto other = low.find(key); other != low.end() && other->second.value != formula.value)
      slopes[key] = (formula.value - other->second.value) / (2.0 * h);
  return slopes;
}

}  // namespace arcwall::deck
