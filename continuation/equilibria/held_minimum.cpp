#include "continuation/equilibria/held_minimum.hpp"

#include <cmath>

#include "core/algebra/assembly.hpp"

namespace arcwall {

namespace {

constexpr int most_iterations = 25, most_changes = 60;
constexpr int changes_at_once = 12;         // of contacts; then one after the other
constexpr double contact_violated = 1e-10;  // [scale of guards]
constexpr double far_correction = 10.0;     // of a correction [path metric]
constexpr double exact_with_drag = 0.05;    // of the motion: the last correction of a motion with drag
constexpr double misled = 0.5;              // of the predicted motion: its error, with drag
constexpr double rounded = 1e-14;           // of a correction, that is round-off [path metric]
constexpr double rigid = 1e8;               // times the own stiffness of a degree of freedom that keeps its value

void toggle(ActiveSet& active_set, Index j) {
  std::uint8_t& closed = active_set[static_cast<std::size_t>(j)];
  closed = closed == 0 ? 1 : 0;
}

// Of a lower triangle: where columns begin with it, nothing is searched.
double& diagonal_entry(SparseMatrix& K, Index i) {
  const SparseIndex first = K.outerIndexPtr()[i];
  return first < K.outerIndexPtr()[i + 1] && K.innerIndexPtr()[first] == i ? K.valuePtr()[first] : K.coeffRef(i, i);
}

}  // namespace

HeldMinimum::HeldMinimum(const UnilateralSystem& system, const MakeFactorization& make, Index& factorizations)
    : system_(system), solver_(make()), left_(factorizations) {}

std::optional<State> HeldMinimum::free(const State& start, double arrived) { return find(start, {.arrived = arrived}); }

std::optional<State> HeldMinimum::with_held(Index dof, const State& start, double arrived) {
  return find(start, {.dof = dof, .arrived = arrived});
}

std::optional<State> HeldMinimum::with_drag(double mu, const State& start) {
  return find(start, {.mu = mu, .arrived = rounded});
}

std::optional<State> HeldMinimum::find(const State& start, const Hold& hold) {
  State state = start;
  for (int change = 0; change < most_changes; ++change) {
    if (!newton(start, hold, state)) return std::nullopt;
    const auto active_set = next_active_set(state, change);
    if (!active_set) return state;
    state = system_.with_active_set(state, *active_set);
  }
  return std::nullopt;
}

bool HeldMinimum::newton(const State& from, const Hold& hold, State& state) {
  const Vector weights = system_.weights(state.active_set), began = state.x;
  const Index multipliers = system_.multiplier_count(state.active_set);
  Vector predicted;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto step = correction(from, hold, state, weights);
    if (!step) return false;
    state.x += *step;
    const double length = motion(weights, multipliers, *step);
    if (length > far_correction) return false;
    if (length <= hold.arrived) return true;
    if (hold.mu <= 0.0) continue;
    if (iteration == 0) predicted = *step;
    const Vector moved = state.x - began;
    if (motion(weights, multipliers, moved - predicted) > misled * motion(weights, multipliers, predicted))
      return false;
    if (iteration > 0 && length <= exact_with_drag * motion(weights, multipliers, moved)) return true;
  }
  return false;
}

// Newton's. Empty if the stiffness of what is held is not positive definite on the motions that the closed contacts
// allow.
std::optional<Vector> HeldMinimum::correction(const State& from, const Hold& hold, const State& state,
                                              const Vector& weights) {
  if (left_-- <= 0) return std::nullopt;
  system_.linearize(state, now_);
  const Index multipliers = system_.multiplier_count(state.active_set), n = now_.F.size() - multipliers;
  if (hold.mu > 0.0) {
    now_.F.head(n) += hold.mu * weights.head(n).cwiseProduct(state.x.head(n) - from.x.head(n));
    for (Index i = 0; i < n; ++i) diagonal_entry(now_.K, i) += hold.mu * weights[i];
  }
  if (hold.dof) {
    now_.F[*hold.dof] = 0.0;
    now_.K.coeffRef(*hold.dof, *hold.dof) += rigid * std::abs(now_.K.coeff(*hold.dof, *hold.dof));
  }
  if (!all_finite(now_.F)) return std::nullopt;
  const FactorStatus status =
      solver_->factorize(now_.K, {.multipliers = multipliers, .same_pattern = pattern_.is_of(now_)});
  const auto inertia = solver_->inertia();
  if (status != FactorStatus::ok || !inertia || inertia->negative != multipliers) return std::nullopt;
  Matrix step = -now_.F;
  solver_->solve(step);
  if (!all_finite(step)) return std::nullopt;
  return step.col(0);
}

// The contacts to be changed: all that are wrong, later the worst alone. Empty if none is.
std::optional<ActiveSet> HeldMinimum::next_active_set(const State& state, int change) const {
  const Vector guards = system_.guards(state);
  ActiveSet active_set = state.active_set;
  std::optional<Index> worst;
  for (Index j = 0; j < static_cast<Index>(active_set.size()); ++j) {
    if (!(guards[j] < -contact_violated) || system_.enforcement(state.active_set, j).two_sided) continue;
    if (!worst || guards[j] < guards[*worst]) worst = j;
    if (change < changes_at_once) toggle(active_set, j);
  }
  if (!worst) return std::nullopt;
  if (change >= changes_at_once) toggle(active_set, *worst);
  return active_set;
}

double motion(const Vector& weights, Index multipliers, const Vector& change) {
  const Index n = weights.size() - multipliers;
  return std::sqrt((weights.head(n).array() * change.head(n).array().square()).sum());
}

double motion_between(const UnilateralSystem& system, const State& a, const State& b) {
  const Index n = system.size(a.active_set) - system.multiplier_count(a.active_set);
  return motion(system.weights(a.active_set).head(n), 0, a.x.head(n) - b.x.head(n));
}

}  // namespace arcwall
