#include "continuation/equilibria/energy_valley.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "continuation/equilibria/held_minimum.hpp"
#include "core/algebra/assembly.hpp"
#include "core/linearization.hpp"

namespace arcwall {

namespace {

constexpr double first_distance = 1e-6, last_distance = 0.1;  // along the valley [path metric]
constexpr double farther = 4.0;                               // than the distance before
constexpr double exact_of_distance = 1e-6;                    // of the distance: Newton's last correction,
constexpr double exact_at_least = 1e-12;                      // but no less than this
// The holding force grows by `farther` where it is linear in s, by its square or cube at limit and branch points. Half
// way between, by the logarithm.
constexpr double faster_than_linear = 8.0, grows = 2.0;

// The degree of freedom that a direction moves most, and the change of its value by a unit length of the direction.
struct Held {
  Index dof = 0;
  double per_length = 0.0;
};

Held most_moved(const Vector& weights, const Vector& direction) {
  Held held;
  double most = -1.0;
  for (Index i = 0; i < direction.size(); ++i) {
    const double motion = weights[i] * direction[i] * direction[i];
    if (motion <= most) continue;
    most = motion;
    held.dof = i;
  }
  const double length = motion(weights.head(direction.size()), 0, direction);
  held.per_length = length > 0.0 ? direction[held.dof] / length : 0.0;
  return held;
}

// The mode of least stiffness by two inverse iterations from a direction, with its sense.
std::optional<Vector> critical_mode(const UnilateralSystem& system, const State& state, const Vector& direction,
                                    const MakeFactorization& make) {
  constexpr double shift = 1e-10;  // of the greatest stiffness of a degree of freedom
  Linearization at;
  system.linearize(state, at);
  const Vector weights = system.weights(state.active_set);
  const Index n = direction.size();
  double greatest = 0.0;
  for (Index i = 0; i < n; ++i)
    if (weights[i] > 0.0) greatest = std::max(greatest, std::abs(at.K.coeff(i, i)) / weights[i]);
  for (Index i = 0; i < n; ++i) at.K.coeffRef(i, i) += shift * greatest * weights[i];
  const auto solver = make();
  if (solver->factorize(at.K, {.multipliers = at.F.size() - n}) != FactorStatus::ok) return std::nullopt;
  Vector mode = direction;
  for (int i = 0; i < 2; ++i) {
    Matrix right = Matrix::Zero(at.F.size(), 1);
    right.col(0).head(n) = weights.head(n).cwiseProduct(mode);
    solver->solve(right);
    if (!all_finite(right)) return std::nullopt;
    mode = right.col(0).head(n).normalized();
  }
  const double along = (weights.head(n).array() * mode.array() * direction.array()).sum();
  return along < 0.0 ? Vector(-mode) : mode;
}

}  // namespace

Valley follow_valley(const UnilateralSystem& system, const LostState& lost, const MakeFactorization& make,
                     Index& factorizations) {
  using Kind = LostState::Kind;
  HeldMinimum minimum(system, make, factorizations);
  const Vector weights = system.weights(lost.state.active_set);
  Held held = most_moved(weights, lost.towards);
  if (held.per_length == 0.0) return {};
  std::optional<State> floor = minimum.with_held(held.dof, lost.state, exact_at_least);
  if (floor && lost.kind == Kind::limit_point) {
    const auto mode = critical_mode(system, *floor, lost.towards, make);
    --factorizations;
    if (mode) held = most_moved(weights, *mode);
  }
  const auto end = [&](ValleyEnd how) {
    return Valley{.end = factorizations <= 0 ? ValleyEnd::cut_off : how, .state = floor.value_or(lost.state)};
  };
  if (!floor) return end(ValleyEnd::unclear);

  const double origin = floor->x[held.dof];
  const State beginning = *floor;
  std::array<double, 2> before{};  // the last holding forces
  for (double s = first_distance; s <= last_distance; s *= farther) {
    State guess = *floor;  // in line with what is behind
    if (floor->active_set == beginning.active_set) guess.x += (farther - 1.0) * (floor->x - beginning.x);
    guess.x[held.dof] = origin + s * held.per_length;
    auto next = minimum.with_held(held.dof, guess, std::max(exact_of_distance * s, exact_at_least));
    if (!next) return end(ValleyEnd::unclear);
    floor = std::move(next);
    Vector F(floor->x.size());
    system.residual(*floor, F);
    const double force = F[held.dof] * std::copysign(1.0, held.per_length);
    const auto grew = [&](double by) {
      return std::abs(force) > by * std::abs(before[1]) && std::abs(before[1]) > by * std::abs(before[0]) &&
             before[0] != 0.0 && std::signbit(force) == std::signbit(before[1]) &&
             std::signbit(force) == std::signbit(before[0]);
    };
    if (lost.kind == Kind::branch_point && grew(faster_than_linear))
      return end(force < 0.0 ? ValleyEnd::leads_away : ValleyEnd::leads_back);
    if (lost.kind != Kind::branch_point && force < 0.0 && grew(grows)) return end(ValleyEnd::leads_away);
    before = {before[1], force};
  }
  return end(ValleyEnd::unclear);
}

}  // namespace arcwall
