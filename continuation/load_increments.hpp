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

/// Load increments without iteration, as Selke and Kikuchi take them (eqs. 11 to 14; docs/theory.md, section 10):
///
///     K(x_t) Δx = λ_{t+1} f − f_int(x_t) + contact        at the configuration x_t
///
/// What an increment leaves unbalanced, the residue R, goes into the next one, so that results depend on the
/// increments. Within an increment contacts close and open until the linear problem's side conditions hold, if they
/// can. For comparison with that scheme and for teaching: Tracer solves the equations.
class LoadIncrements {
 public:
  /// `system` must outlive this; `advance` tells it that an increment has led to a state, whose configuration is the
  /// reference of the next. `lambda_scale` as in Metric; `make`: what K is factorized by.
  LoadIncrements(const UnilateralSystem& system, State start, double lambda_scale,
                 std::function<void(const State&)> advance, const MakeFactorization& make = make_ldlt);
  LoadIncrements(LoadIncrements&&) noexcept;
  ~LoadIncrements();

  /// The state at the start, with its event.
  Arc start();

  /// One increment. Empty when it fails: see end().
  std::optional<Arc> to(double lambda);

  const std::optional<BranchEnd>& end() const { return end_; }

  /// Increments whose contacts found no set that fulfils the side conditions.
  int unsettled() const { return unsettled_; }

  /// Takes an increment that was taken before as taken, in the order in which they were.
  void repeat(const State& state) { advance_(state); }

  /// Visits what else changes, as Tracer::serialize().
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(last_, unsettled_, end_);
  }

 private:
  struct Increment {
    State from{};  // on the piece that holds behind the increment
    Vector dx{};
    Index negative = 0;  // eigenvalues of K
  };
  std::optional<Increment> solve(double lambda);
  std::optional<Increment> solve_on(const Piece& piece, double lambda);
  std::vector<Index> violated(const Increment& increment) const;
  PathPoint point(const Increment& increment, double lambda);
  std::vector<Event> changes(const Piece& before, const PathPoint& after, double lambda_before) const;

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
