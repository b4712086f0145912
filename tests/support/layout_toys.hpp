#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "core/system.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::test {

/// A layout that says by a number what the unknowns are.
struct NumberedLayout final : Layout {
  explicit NumberedLayout(int n) : number(n) {}
  int number;
};

/// The verdict on a step of a system that inserts a contact, as a layout of this number, wherever it is penetrated.
inline StepVerdict inserted_layout(const System& system, const CheckedStep& step, int number) {
  if (!step.located || !system.penetrated_place(step.to, step.located->gap_seen)) return {};
  StepVerdict verdict;
  if (step.located->from != nullptr) {
    State guess = step.from;
    guess.active_set = ActiveSet(0, 0, std::make_shared<NumberedLayout>(number));
    verdict.restarts.push_back(
        {.change = Transition::Change::remeshed, .guess = std::move(guess), .forward = *step.located->from});
  }
  if (system.penetrated_place(step.to, -step.located->penetration)) verdict.fault = StepVerdict::Fault::penetration;
  return verdict;
}

/// A system whose unknowns change behind validity bounds. Its active sets are told apart by the number of their layout.
class LayoutToy : public System {
 public:
  State state_on(int layout, Vector x, double lambda) const {
    return {.x = std::move(x), .lambda = lambda, .active_set = active_sets_[static_cast<std::size_t>(layout)]};
  }
  static int layout_of(const ActiveSet& active_set) {
    return static_cast<const NumberedLayout&>(*active_set.layout()).number;
  }

  ActiveSet open_active_set() const override { return active_sets_[0]; }

 protected:
  /// As many closed contacts on each of the two layouts.
  LayoutToy(std::size_t first, std::size_t second)
      : active_sets_{ActiveSet(first, 1, std::make_shared<NumberedLayout>(0)),
                     ActiveSet(second, 1, std::make_shared<NumberedLayout>(1))} {}

  std::array<ActiveSet, 2> active_sets_;
};

/// A point contact that spreads to a span of the length d. The point serves while x ≤ 1, the span while d ≥ ½ d₀; its
/// first point has d = d₀:
///
///     point:  V = ½ x² − λ x                               x = λ
///     span:   V = ½ x² − λ x − c d³ (x − 1) + ⅜ c d⁴       d = 2 (x − 1),   λ = x − c d³
///
/// Both meet at x = λ = 1 with two derivatives, as contacts do. λ turns on the span at x − 1 = 1/√(24 c).
class SpreadingToy final : public LayoutToy {
 public:
  SpreadingToy(double factor, double first_length) : LayoutToy(1, 2), c(factor), d0(first_length) {}

  double lambda_on_span(double x) const { return x - 8.0 * c * std::pow(x - 1.0, 3); }
  State on_span(double x) const { return state_on(1, Vector{{x, 2.0 * (x - 1.0)}}, lambda_on_span(x)); }

  Dimensions dimensions(const ActiveSet& active_set) const override {
    return {.unknowns = 1 + layout_of(active_set), .bounds = 1};
  }
  Index separate_contacts(const ActiveSet&) const override { return 1; }  // the span is a contact zone
  void residual(const State& s, Eigen::Ref<Vector> F) const override {
    F[0] = s.x[0] - s.lambda;
    if (layout_of(s.active_set) == 0) return;
    const double d = s.x[1];
    F[0] -= c * d * d * d;
    F[1] = 1.5 * c * d * d * (d - 2.0 * (s.x[0] - 1.0));
  }
  void linearize(const State& s, Linearization& out) const override {
    const Index n = s.x.size();
    Matrix K = Matrix::Identity(n, n);
    if (n == 2) {
      const double d = s.x[1];
      K(0, 1) = K(1, 0) = -3.0 * c * d * d;
      K(1, 1) = 4.5 * c * d * d - 6.0 * c * d * (s.x[0] - 1.0);
    }
    out.F.resize(n);
    residual(s, out.F);
    out.F_lambda = -Vector::Unit(n, 0);
    out.K = lower_triangle(K, -1.0);
    out.pattern_of = s.active_set;
  }
  double energy(const State& s) const override {
    const double rest = 0.5 * s.x[0] * s.x[0] - s.lambda * s.x[0];
    if (s.x.size() == 1) return rest;
    return rest - c * std::pow(s.x[1], 3) * (s.x[0] - 1.0) + 0.375 * c * std::pow(s.x[1], 4);
  }

  Vector guards(const State& s) const override {
    Vector all = Vector::Ones(guard_count(s.active_set));  // contacts hold
    all[all.size() - 1] = s.x.size() == 1 ? 1.0 - s.x[0] : s.x[1] - 0.5 * d0;
    return all;
  }
  Row guard_gradient(const State& s, Index j) const override {
    Row row{.dx = Vector::Zero(s.x.size()), .dlambda = 0.0};
    if (j + 1 == guard_count(s.active_set)) row.dx[s.x.size() - 1] = s.x.size() == 1 ? -1.0 : 1.0;
    return row;
  }
  std::vector<Transition> transitions(const State& s, const Direction&, Index, double) const override {
    Transition to;
    to.value = s.x.size() == 1 ? d0 : 0.0;
    if (s.x.size() == 1) {
      to.change = Transition::Change::spreads;
      to.guess = state_on(1, Vector{{s.x[0], d0}}, s.lambda);
      to.quantity = std::make_shared<Length>();
    } else {
      to.change = Transition::Change::gathers;
      to.guess = state_on(0, s.x.head(1), s.lambda);
      to.quantity = std::make_shared<Room>();
    }
    return {to};
  }

  const double c, d0;

 private:
  struct Length final : Observable {
    double value(const State& s) const override { return s.x[1]; }
    Row gradient(const State&) const override { return {.dx = Vector::Unit(2, 1), .dlambda = 0.0}; }
  };
  struct Room final : Observable {
    double value(const State& s) const override { return 1.0 - s.x[0]; }
    Row gradient(const State&) const override { return {.dx = -Vector::Unit(1, 0), .dlambda = 0.0}; }
  };
};

/// A mesh that changes at x = 1: x = λ before, x = λ + error behind, the error being that of the second mesh. Both
/// active sets have one closed contact.
class RemeshingToy final : public LayoutToy {
 public:
  explicit RemeshingToy(double error_behind) : LayoutToy(1, 1), error(error_behind) {}

  Dimensions dimensions(const ActiveSet&) const override { return {.unknowns = 1, .bounds = 1}; }
  void residual(const State& s, Eigen::Ref<Vector> F) const override {
    F[0] = s.x[0] - s.lambda - (layout_of(s.active_set) == 0 ? 0.0 : error);
  }
  void linearize(const State& s, Linearization& out) const override {
    out.F.resize(1);
    residual(s, out.F);
    out.F_lambda = -Vector::Ones(1);
    out.K = lower_triangle(Matrix::Identity(1, 1), -1.0);
    out.pattern_of = s.active_set;
  }
  double energy(const State& s) const override { return 0.5 * s.x[0] * s.x[0] - s.lambda * s.x[0]; }

  Vector guards(const State& s) const override {
    return Vector{{1.0, layout_of(s.active_set) == 0 ? 1.0 - s.x[0] : 1.0}};
  }
  Row guard_gradient(const State& s, Index j) const override {
    return {.dx = Vector::Constant(1, j == 1 && layout_of(s.active_set) == 0 ? -1.0 : 0.0), .dlambda = 0.0};
  }
  std::vector<Transition> transitions(const State& s, const Direction& forward, Index, double) const override {
    return {{.change = Transition::Change::remeshed, .guess = state_on(1, s.x, s.lambda), .forward = forward}};
  }

  const double error;
};

/// A fold at x = 0, λ = 0 behind which an obstacle at x = 0.03 is seen on another mesh alone, on which all has moved by
/// the error of that mesh: (x − error)² + λ = 0. The count at x = 0 is there that of one side or the other.
class RemeshedFoldToy final : public System {
 public:
  explicit RemeshedFoldToy(double error_behind) : error(error_behind) {}

  Dimensions dimensions(const ActiveSet&) const override { return {.unknowns = 1}; }
  void residual(const State& s, Eigen::Ref<Vector> F) const override { F[0] = off(s) * off(s) + s.lambda; }
  void linearize(const State& s, Linearization& out) const override {
    out.F.resize(1);
    residual(s, out.F);
    out.F_lambda = Vector::Ones(1);
    out.K = lower_triangle(Matrix::Constant(1, 1, 2.0 * off(s)), -1.0);
    out.pattern_of = s.active_set;
  }
  double energy(const State& s) const override { return std::pow(off(s), 3) / 3.0 + s.lambda * s.x[0]; }
  std::optional<std::string> penetrated_place(const State& s, double margin) const override {
    return is_new(s) || 0.03 - s.x[0] >= margin ? std::nullopt : std::optional<std::string>(std::string());
  }
  StepVerdict check(const CheckedStep& step) const override { return inserted_layout(*this, step, 1); }

  const double error;

 private:
  static bool is_new(const State& s) { return s.active_set.layout() != nullptr; }
  double off(const State& s) const { return s.x[0] - (is_new(s) ? error : 0.0); }
};

/// x = λ, which enters an obstacle from x = 1 on that no guard sees, however often contacts are inserted to see it.
class BlindToy final : public System {
 public:
  mutable int inserted = 0;  ///< how often a contact was asked for

  Dimensions dimensions(const ActiveSet&) const override { return {.unknowns = 1}; }
  void residual(const State& s, Eigen::Ref<Vector> F) const override { F[0] = s.x[0] - s.lambda; }
  void linearize(const State& s, Linearization& out) const override {
    out.F.resize(1);
    residual(s, out.F);
    out.F_lambda = -Vector::Ones(1);
    out.K = lower_triangle(Matrix::Identity(1, 1), -1.0);
    out.pattern_of = s.active_set;
  }
  double energy(const State& s) const override { return 0.5 * s.x[0] * s.x[0] - s.lambda * s.x[0]; }
  std::optional<std::string> penetrated_place(const State& s, double margin) const override {
    return 1.0 - s.x[0] >= margin ? std::nullopt : std::optional<std::string>(std::string());
  }
  StepVerdict check(const CheckedStep& step) const override {
    const StepVerdict verdict = inserted_layout(*this, step, inserted + 1);
    inserted += static_cast<int>(verdict.restarts.size());
    return verdict;
  }
};

}  // namespace arcwall::test
