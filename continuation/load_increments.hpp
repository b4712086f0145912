#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "continuation/metric.hpp"
#include "continuation/path_point.hpp"
#include "core/algebra/factorization.hpp"
#include "core/linearization.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

class BorderedSolver;

/// Takes load increments without iteration (Selke and Kikuchi, eqs. 11 to 14; docs/theory.md, section 10):
///
///     K(x_t) Δx = λ_{t+1} f − f_int(x_t) + contact        at the configuration x_t
///
/// The residual of an increment enters the next one, so results depend on the increments. Each increment changes the
/// active set until the linear complementarity conditions hold, if possible. Tracer solves the equations themselves.
class LoadIncrements {
 public:
  /// `system` must outlive this. `advance` sets a state as the system's reference configuration after an increment.
  /// `lambda_scale`: λ₀ of Metric. `make` creates the factorization of K.
  LoadIncrements(const UnilateralSystem& system, State start, double lambda_scale,
                 std::function<void(const State&)> advance, const MakeFactorization& make = make_ldlt);
  LoadIncrements(LoadIncrements&&) noexcept;
  ~LoadIncrements();

  /// Returns the arc of length zero at the start, with its event.
  Arc start();

  /// Takes one increment to `lambda` and returns it. Empty if it fails: see end().
  std::optional<Arc> to(double lambda);

  const std::optional<BranchEnd>& end() const { return end_; }

  /// Returns the number of increments without an active set that satisfies the complementarity conditions.
  int unsettled() const { return unsettled_; }

  /// Repeats an increment of an earlier run by its end state; call it in the original order.
  void repeat(const State& state) { advance_(state); }

  /// Writes or reads the other variable state, as Tracer::serialize().
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(last_, unsettled_, end_);
  }

 private:
  struct Increment {
    State from{};  // on the active set that holds behind the increment
    Vector dx{};
    Index negative = 0;  // eigenvalues of K
  };
  std::optional<Increment> solve(double lambda);
  std::optional<Increment> solve_on(const ActiveSet& active_set, double lambda);
  std::vector<Index> violated(const Increment& increment) const;
  PathPoint point(const Increment& increment, double lambda);
  std::vector<Event> changes(const ActiveSet& before, const PathPoint& after, double lambda_before) const;

  const UnilateralSystem& system_;
  std::function<void(const State&)> advance_;
  double lambda_scale_;
  PathPoint last_{};
  Linearization now_;
  std::unique_ptr<BorderedSolver> solver_;
  int unsettled_ = 0;
  std::optional<BranchEnd> end_;
};

}  // namespace arcwall
