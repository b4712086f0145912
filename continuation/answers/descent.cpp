#include "continuation/answers/descent.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/algebra/assembly.hpp"
#include "core/linearization.hpp"

namespace arcwall {

namespace {

// All lengths in the path metric, without multipliers.
constexpr int most_steps = 1000, most_iterations = 25, most_changes = 60;
constexpr int changes_at_once = 12;         // of contacts; then one after the other
constexpr double longest_motion = 0.1;      // of the motion
constexpr double wanted_motion = 0.08;      // the time step is chosen for it,
constexpr double longer_time = 10.0;        // but grows no faster than this
constexpr double newton_arrived = 1e-12;    // of Newton's last correction at rest,
constexpr double newton_near = 1e-3;        // and on the way, where the next step begins anew
constexpr double no_motion = 1e-8;          // of a step, below which rest is looked for
constexpr double contact_violated = 1e-10;  // [scale of guards]
constexpr double far_away = 10.0;           // of the start

// One step of the motion, or with μ = 0 rest itself.
class HeldMinimum {
 public:
  HeldMinimum(const UnilateralSystem& system, const MakeFactorization& make, Index& factorizations)
      : system_(system), solver_(make()), left_(factorizations) {}

  // The minimum of Π + ½ μ |x − from|²_W near `from` among the obstacles; empty if there is none near, or the way to it
  // is not convex.
  std::optional<State> find(const State& from, double mu) {
    State state = from;
    for (int change = 0; change < most_changes; ++change) {
      if (!minimise(from, mu, state)) return std::nullopt;
      const auto active_set = next_active_set(state, change);
      if (!active_set) return state;
      state = system_.with_active_set(state, *active_set);
    }
    return std::nullopt;
  }

 private:
  bool minimise(const State& from, double mu, State& state) {
    const Vector weights = system_.weights(state.active_set);
    const Index multipliers = system_.multiplier_count(state.active_set), n = weights.size() - multipliers;
    const double arrived = mu > 0.0 ? newton_near : newton_arrived;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      if (left_-- <= 0) return false;
      system_.linearize(state, now_);
      const Vector held = mu * weights.head(n).cwiseProduct(state.x.head(n) - from.x.head(n));
      now_.F.head(n) += held;
      for (Index i = 0; mu > 0.0 && i < n; ++i) now_.K.coeffRef(i, i) += mu * weights[i];
      if (!all_finite(now_.F)) return false;
      const FactorStatus status = solver_->factorize(now_.K, {.multipliers = multipliers});
      const auto inertia = solver_->inertia();
      if (status != FactorStatus::ok || !inertia || inertia->negative != multipliers) return false;
      Matrix step = -now_.F;
      solver_->solve(step);
      if (!all_finite(step)) return false;
      state.x += step.col(0);
      const double length = std::sqrt((weights.array() * step.col(0).array().square()).sum());
      if (length > far_away) return false;
      if (length <= arrived) return true;
    }
    return false;
  }

  // The contacts to be changed: all that are wrong, later the worst alone. Empty if none is.
  std::optional<ActiveSet> next_active_set(const State& state, int change) const {
    const Vector guards = system_.guards(state);
    ActiveSet active_set = state.active_set;
    std::optional<Index> worst;
    for (Index j = 0; j < static_cast<Index>(active_set.size()); ++j) {
      if (!(guards[j] < -contact_violated) || system_.is_two_sided(state.active_set, j)) continue;
      if (!worst || guards[j] < guards[*worst]) worst = j;
      if (change < changes_at_once) toggle(active_set, j);
    }
    if (!worst) return std::nullopt;
    if (change >= changes_at_once) toggle(active_set, *worst);
    return active_set;
  }

  static void toggle(ActiveSet& active_set, Index j) {
    std::uint8_t& closed = active_set[static_cast<std::size_t>(j)];
    closed = closed == 0 ? 1 : 0;
  }

  const UnilateralSystem& system_;
  Linearization now_;
  std::unique_ptr<Factorization> solver_;
  Index& left_;
};

double distance(const UnilateralSystem& system, const State& a, const State& b) {
  const Vector weights = system.weights(a.active_set);
  const Index n = weights.size() - system.multiplier_count(a.active_set);
  const auto dx = (a.x.head(n) - b.x.head(n)).array();
  return std::sqrt((weights.head(n).array() * dx.square()).sum());
}

// The greatest stiffness of a degree of freedom by itself.
double greatest_stiffness(const UnilateralSystem& system, const State& state) {
  Linearization at;
  system.linearize(state, at);
  const Vector weights = system.weights(state.active_set), diagonal = at.K.diagonal();
  double greatest = 0.0;
  for (Index i = 0; i < weights.size(); ++i)
    if (weights[i] > 0.0) greatest = std::max(greatest, std::abs(diagonal[i]) / weights[i]);
  return greatest;
}

}  // namespace

Descent descend(const UnilateralSystem& system, const State& start, const MakeFactorization& make,
                Index& factorizations) {
  HeldMinimum minimum(system, make, factorizations);
  Descent descent{.state = start};
  const double greatest = greatest_stiffness(system, start), least = 1e-12 * greatest;
  double mu = 1e-4 * greatest;
  for (; descent.steps < most_steps; ++descent.steps) {
    const auto next = minimum.find(descent.state, mu);
    const double length = next ? distance(system, *next, descent.state) : infinity;
    if (factorizations <= 0) {
      descent.end = DescentEnd::cut_off;
      return descent;
    }
    if (!next || length > longest_motion) {
      if (mu > 10.0 * greatest) return descent;
      mu *= 4.0;
      continue;
    }
    descent.state = *next;
    if (distance(system, descent.state, start) > far_away) {
      descent.end = DescentEnd::falls_away;
      return descent;
    }
    if (length <= no_motion || mu <= least) {
      const auto rest = minimum.find(descent.state, 0.0);
      if (rest && distance(system, *rest, descent.state) <= longest_motion) {
        descent.end = DescentEnd::at_rest;
        descent.state = *rest;
        return descent;
      }
      if (mu <= least) return descent;
    }
    mu = std::max(std::clamp(length / wanted_motion, 1.0 / longer_time, 1.0) * mu, least);
  }
  return descent;
}

}  // namespace arcwall
