#pragma once

#include "benchmarks/figures.hpp"
#include "core/system.hpp"

namespace arcwall::bench {

/// Whether the parts of a path are timed. A look at the clock takes 0.3 us.
inline bool times_parts = true;

/// Adds the CPU time of a scope to a sum [s], if parts are timed.
class ScopedTimer {
 public:
  explicit ScopedTimer(double& sum) : sum_(sum) {}
  ~ScopedTimer() {
    if (times_parts) sum_ += cpu_seconds() - start_;
  }
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;

 private:
  double& sum_;
  double start_ = times_parts ? cpu_seconds() : 0.0;
};

/// Another system, with the time that its functions take.
class TimedSystem final : public System {
 public:
  struct Times {
    double assembly = 0.0;         ///< F, K, F_λ and weights [s]
    double side_conditions = 0.0;  ///< gaps, contact forces, what lies behind validity bounds [s]
    Index linearizations = 0;
  };

  /// `inner` must outlive this.
  explicit TimedSystem(const System& inner) : inner_(inner) {}

  const Times& times() const { return times_; }

  /// Whether these right-hand sides are those of an iteration of Newton's method, −F foremost, at the last equations;
  /// at each of them once.
  bool is_newton(const Eigen::Ref<const Matrix>& X) const {
    if (X.rows() > last_F_.size() || X.cols() == 0 || X.col(0) != -last_F_.head(X.rows())) return false;
    last_F_.resize(0);
    return true;
  }

  Dimensions dimensions(const ActiveSet& active_set) const override { return inner_.dimensions(active_set); }
  void residual(const State& state, Eigen::Ref<Vector> F) const override {
    const ScopedTimer timer(times_.assembly);
    inner_.residual(state, F);
  }
  void linearize(const State& state, Linearization& out) const override {
    ++times_.linearizations;
    {
      const ScopedTimer timer(times_.assembly);
      inner_.linearize(state, out);
    }
    if (times_parts) last_F_ = out.F;
  }
  double energy(const State& state) const override { return inner_.energy(state); }
  StateMetric metric(const ActiveSet& active_set) const override {
    const ScopedTimer timer(times_.assembly);
    return inner_.metric(active_set);
  }
  ActiveSet open_active_set() const override { return inner_.open_active_set(); }

  Vector guards(const State& state) const override {
    const ScopedTimer timer(times_.side_conditions);
    return inner_.guards(state);
  }
  Row guard_gradient(const State& state, Index j) const override {
    const ScopedTimer timer(times_.side_conditions);
    return inner_.guard_gradient(state, j);
  }
  GuardsAlong guards_along(const State& state, const Direction& direction) const override {
    const ScopedTimer timer(times_.side_conditions);
    return inner_.guards_along(state, direction);
  }
  double guard(const State& state, Index j) const override {
    const ScopedTimer timer(times_.side_conditions);
    return inner_.guard(state, j);
  }
  Vector unit_force(const State& state, Index j) const override { return inner_.unit_force(state, j); }
  Enforcement enforcement(const ActiveSet& active_set, Index j) const override {
    return inner_.enforcement(active_set, j);
  }
  CountedDirections counted_directions(const ActiveSet& active_set) const override {
    return inner_.counted_directions(active_set);
  }
  Vector transfer(const Vector& x, const ActiveSet& from, const ActiveSet& to) const override {
    return inner_.transfer(x, from, to);
  }
  std::vector<Transition> transitions(const State& state, const Direction& forward, Index bound,
                                      double tolerance) const override {
    const ScopedTimer timer(times_.side_conditions);
    return inner_.transitions(state, forward, bound, tolerance);
  }
  StepVerdict check(const CheckedStep& step) const override {
    const ScopedTimer timer(times_.side_conditions);
    return inner_.check(step);
  }
  std::optional<std::string> penetrated_place(const State& state, double margin) const override {
    const ScopedTimer timer(times_.side_conditions);
    return inner_.penetrated_place(state, margin);
  }
  std::string watched_place(const State& state, Index j) const override { return inner_.watched_place(state, j); }
  Index separate_contacts(const ActiveSet& active_set) const override { return inner_.separate_contacts(active_set); }
  std::optional<PathKink> kink_between(const State& from, const State& to) const override {
    return inner_.kink_between(from, to);
  }
  ActiveSet canonical_active_set(const State& state) const override {
    const ScopedTimer timer(times_.side_conditions);
    return inner_.canonical_active_set(state);
  }

 private:
  const System& inner_;
  mutable Times times_;
  mutable Vector last_F_;  // none where the iteration with it has been seen
};

}  // namespace arcwall::bench
