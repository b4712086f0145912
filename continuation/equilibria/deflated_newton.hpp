#pragma once

#include <vector>

#include "continuation/factorized_equations.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

/// How Newton's method with known solutions deflated ended.
enum class DeflatedEnd {
  arrived,    ///< at an equilibrium that was not known
  known,      ///< at one that was: it is so near to a deflated one that it is the same
  not_found,  ///< nowhere
};

struct DeflatedResult {
  DeflatedEnd end = DeflatedEnd::not_found;
  State state{};  ///< where it ended; an equilibrium if it arrived
  int iterations = 0;
};

/// Newton's method at fixed λ among obstacles that is driven off the equilibria that are known already
/// (docs/theory.md, section 16). It solves G = m(x) F(x) = 0 with
///
///     m(x) = Π_i (1 + (σ/|x − x_i|_W)²),
///
/// whose Newton step is that of F times 1/(1 − s), s being the derivative of log m along that step (Farrell, Birkisson,
/// Funke 2015). Contacts are opened and closed from step to step (the semismooth method of Farrell, Croci, Surowiec
/// 2019), for which a factor makes no difference.
class DeflatedNewton {
 public:
  /// What is done with contacts on the way.
  enum class Contacts {
    follow,  ///< opened and closed: of systems whose unknowns always mean the same, as where contact is tied to nodes
    keep,    ///< those of the guess: what it leads to may pull at contacts, or enter obstacles
  };

  /// `system` must outlive this.
  DeflatedNewton(const UnilateralSystem& system, Contacts contacts, const MakeFactorization& make)
      : system_(system), contacts_(contacts), here_(system, make) {}

  /// An equilibrium not to be found again, by its unknowns; contact forces at their end may be left out.
  void deflate(Vector known) { known_.push_back(std::move(known)); }

  /// From a guess. Of contacts that are followed it may be inside obstacles.
  DeflatedResult from(State guess);

  /// The equilibrium of which a guess is off by no more than what tells two apart, its contacts being those that touch;
  /// empty if there is none so near. Nothing drives this off known ones.
  std::optional<State> beside(const State& guess);

  /// Whether an equilibrium is a deflated one.
  bool is_known(const State& state) const;

 private:
  bool newton_step(const State& state, Vector& step);
  double factor(const State& state, const Vector& step) const;

  const UnilateralSystem& system_;
  Contacts contacts_;
  std::vector<Vector> known_;
  FactorizedEquations here_;
};

}  // namespace arcwall
