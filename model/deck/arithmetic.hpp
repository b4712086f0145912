#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/deck/deck.hpp"
#include "model/deck/formula.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

class Findings;

/// The numbers of a deck that are formulas: it computes them from the deck's variables and remembers them.
class Arithmetic {
 public:
  /// Computes the variables of a document. What is wrong with one is a problem of the formulas that use it.
  explicit Arithmetic(const Value& root);

  /// Reports variables that are computed from themselves.
  void report_cycles(Findings& findings) const;

  /// The number that a formula gives, which `key` then has. Empty, and reported, where it is wrong; not reported where
  /// that follows from a variable that is wrong.
  std::optional<double> number(const Value& formula, const std::string& key, Findings& findings);

  /// Whether a word is that of a variable, or near one: it is a formula.
  bool may_mean_a_variable(const std::string& word) const;

  /// All that number() has computed.
  const Formulas& formulas() const { return formulas_; }

 private:
  struct Variable {
    const Value* given = nullptr;
    std::optional<double> value{};  // empty: it is wrong, or not computed
    bool is_computed = false;
    std::vector<std::string> uses{}, users{};  // other variables
  };
  struct Outcome {
    FormulaResult result{};
    bool follows = false;  // from a variable that is wrong
  };

  Outcome outcome(const std::string& formula) const;
  std::vector<std::string> known_words() const;
  void compute_variables();

  std::map<std::string, Variable> variables_{};
  Formulas formulas_{};
};

/// How fast each number that is a formula changes with a variable.
std::map<std::string, double> slopes_of_formulas(const Deck& deck, const std::string& variable);

}  // namespace arcwall::deck
