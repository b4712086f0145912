#include "continuation/stability.hpp"

#include "core/test_function.hpp"

namespace arcwall {

Piece strongly_closed(const System& system, const State& state, double force_tolerance) {
  Piece piece = state.piece;
  if (piece.empty()) return piece;
  const Vector guards = system.guards(state);
  for (std::size_t j = 0; j < piece.size(); ++j)
    if (piece[j] && guards[static_cast<Index>(j)] <= force_tolerance) piece[j] = 0;
  return piece;
}

// With weak contacts W the motions allowed are the cone {v : G_S v = 0, G_W v ≥ 0}. It lies inside {G_S v = 0}, so a
// count of 0 there means stable; it contains {G_S v = 0, G_W v = 0}, so a count above 0 there means unstable.
StabilityCount StabilityCounter::count(const State& state, std::optional<Index> negative_held) {
  const Piece strong = strongly_closed(system_, state, force_tolerance_);
  if (!negative_held) negative_held = negative_on(state);
  const std::optional<Index> unstable =
      strong == state.piece ? negative_held : negative_on(system_.with_piece(state, strong));
  StabilityCount count{.unstable = unstable};
  if (unstable && *unstable == 0) count.stability = Stability::stable;
  if (negative_held && *negative_held > 0) count.stability = Stability::unstable;
  return count;
}

std::optional<Index> StabilityCounter::negative_on(const State& state) {
  system_.linearize(state, now_);
  const Index multipliers = system_.multiplier_count(state.piece);
  ldlt_.set_multiplier_count(multipliers);
  const Vector weights = system_.weights(state.piece);
  NearNull nearest;
  const FactorStatus status = ldlt_.factorize(now_.K);
  if (status == FactorStatus::not_finite) return std::nullopt;
  if (status == FactorStatus::ok) {
    Matrix columns = tracker_.right_hand_sides(weights);
    ldlt_.solve(columns);
    nearest = tracker_.advance(weights, columns);
  }
  const auto negative = negative_count(ldlt_, now_.K, weights, multipliers, nearest);
  return negative ? std::optional(*negative - multipliers) : std::nullopt;
}

}  // namespace arcwall
