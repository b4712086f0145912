#include "continuation/stability.hpp"

#include <utility>

#include "core/algebra/sliding_stability.hpp"
#include "core/algebra/slip_stiffness.hpp"
#include "core/algebra/test_function.hpp"
#include "core/algebra/unsymmetric_stability.hpp"

namespace arcwall {

// n₋ = n₋(K) + n₋(T) with what a border holds (Haynsworth 1968).
std::optional<Index> negative_eigenvalues(const Equations& system, const State& state, const BorderedSolver& solver,
                                          const Linearization& now, const NearNull& nearest) {
  if (system.counted_directions(state.active_set) == CountedDirections::none) return std::nullopt;
  const Index multipliers = system.multiplier_count(state.active_set);
  if (now.N.nonZeros() > 0) return negative_real_parts(solver, now);
  if (now.B.cols() == 0) {
    const Vector weights = system.weights(state.active_set);
    const auto negative = negative_count(solver.inner(), now.K, weights, multipliers, nearest, solver.make());
    return negative ? std::optional(*negative - multipliers) : std::nullopt;
  }
  const auto inertia = solver.inner().inertia();
  if (!inertia || !solver.inner_is_regular()) return std::nullopt;
  const auto let_go = sliding_resistance(solver, now).negative();
  if (!let_go) return std::nullopt;
  const Index slips = now.slip_senses.size() > 0 ? negative_real_eigenvalues(slip_stiffness(solver, now)) : Index{0};
  return inertia->negative - multipliers + *let_go + slips;
}

ActiveSet strictly_active(const UnilateralSystem& system, const State& state, double force_tolerance) {
  ActiveSet active_set = state.active_set;
  for (std::size_t j = 0; j < active_set.size(); ++j) {
    const Enforcement how = system.enforcement(state.active_set, static_cast<Index>(j));
    if (how.two_sided || !how.multiplier) continue;
    if (state.x[*how.multiplier] <= force_tolerance * how.force_scale) active_set[j] = 0;
  }
  return active_set;
}

void StabilityCounter::track_from(const NearNull& nearest) {
  start_ = &nearest;
  last_.reset();
}

// With degenerate contacts W the motions allowed are the cone {v : G_S v = 0, G_W v ≥ 0}. It lies inside {G_S v = 0},
// so a count of 0 there means stable; it contains {G_S v = 0, G_W v = 0}, so a count above 0 there means unstable.
StabilityCount StabilityCounter::count(const State& state, std::optional<Index> negative_held) {
  const ActiveSet strong = strictly_active(system_, state, force_tolerance_);
  if (!negative_held) negative_held = negative_on(state);
  const std::optional<Index> unstable =
      strong == state.active_set ? negative_held : negative_on(system_.with_active_set(state, strong));
  StabilityCount count{.unstable = unstable};
  if (unstable && *unstable == 0) count.stability = Stability::stable;
  if (negative_held && *negative_held > 0) count.stability = Stability::unstable;
  if (slipping(strong) > 1) count.stability = stability_of_slips(system_.with_active_set(state, strong));
  if (system_.history() != nullptr)
    if (const auto stability = stability_with_slips(state)) count.stability = *stability;
  if (system_.counted_directions(state.active_set) != CountedDirections::some) return count;
  return {.stability = count.stability == Stability::unstable ? Stability::unstable : Stability::undecided};
}

Index StabilityCounter::slipping(const ActiveSet& active_set) const {
  return static_cast<Index>(system_.slipping(active_set).size());
}

// With one slip the count tells: it goes on by itself where D < 0. With more it may be that no slip starts though D has
// a negative eigenvalue, or that there is none and a slip with the inertia of the structure releases energy.
Stability StabilityCounter::stability_of_slips(const State& state) {
  if (own_.linearize_at(state) != FactorStatus::ok || !own_.solver().inner_is_regular()) return Stability::undecided;
  const auto inertia = own_.solver().inner().inertia();
  if (!inertia) return Stability::undecided;
  const auto let_go = sliding_resistance(own_.solver(), own_.equations()).negative();
  if (!let_go) return Stability::undecided;
  if (inertia->negative + *let_go > system_.multiplier_count(state.active_set)) return Stability::unstable;
  switch (slip_stability(slip_stiffness(own_.solver(), own_.equations()))) {
    case SlipStability::stable:
      return Stability::stable;
    case SlipStability::unstable:
      return Stability::unstable;
    case SlipStability::undecided:
      break;
  }
  return Stability::undecided;
}

// Of points that elastic friction holds: a motion in which none slips on releases energy where K has a negative
// eigenvalue; none does where the least work of all is positive. Empty where nothing slips.
std::optional<Stability> StabilityCounter::stability_with_slips(const State& state) {
  const FactorStatus status = own_.linearize_at(state);
  if (own_.equations().N.nonZeros() == 0) return std::nullopt;
  const auto held = own_.solver().inner().inertia();
  if (status != FactorStatus::ok || !held) return Stability::undecided;
  if (held->negative > 0) return Stability::unstable;
  return work_is_positive(own_.solver(), own_.equations()) ? Stability::stable : Stability::undecided;
}

std::optional<Index> StabilityCounter::negative_on(const State& state) {
  if (system_.counted_directions(state.active_set) == CountedDirections::none) return std::nullopt;
  if (last_ != state) remember(state, counted_on(state));
  return last_negative_;
}

void StabilityCounter::remember(const State& state, std::optional<Index> negative) {
  last_ = state;
  last_negative_ = negative;
}

std::optional<Index> StabilityCounter::counted_on(const State& state) {
  const bool shares = shared_.is_on(state.active_set);
  FactorizedEquations& at = shares ? shared_ : own_;
  if (!shares && start_ != nullptr) own_.track_from(*std::exchange(start_, nullptr));
  const FactorStatus status = at.linearize_at(state);
  const bool regular = status == FactorStatus::ok, bordered = !at.equations().is_symmetric();
  if (status == FactorStatus::not_finite || (bordered && !regular)) return std::nullopt;
  NearNull nearest;
  if (regular && !bordered) {
    const Vector weights = system_.weights(state.active_set);
    Matrix columns = at.tracker().right_hand_sides(weights);
    at.solver().inner().solve(columns);
    nearest = at.tracker().advance(weights, columns);
  }
  return negative_eigenvalues(system_, state, at.solver(), at.equations(), nearest);
}

}  // namespace arcwall
