#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/event_curves/sample_differences.hpp"

// What each kind of event makes of the change of the equilibrium.
namespace arcwall {

namespace {

constexpr double longest_turn = 3.2e-2;  // the same of the rate of a monitor, at equilibria along the path
constexpr int turn_halvings = 13;
constexpr double short_enough = 1e-6;    // difference of fourth and sixth order of a rate by κ, of which the latter is
                                         // much less off
constexpr double sure = 1e-4;            // by which a rate that is told may be off
constexpr double roundoff_terms = 10.0;  // of a quantity's values in what its rate is off
constexpr double negligible = 1e-9;      // of what changes a guard: it does not tell
constexpr double agreeing = 1e-6;        // relative difference of what several guards say

Direction times(double factor, const Direction& d) { return {.dx = factor * d.dx, .dlambda = factor * d.dlambda}; }

EventDerivative known(double value) {
  if (!std::isfinite(value)) return no_derivative("the equations are singular at the event");
  return {.value = value, .why_none = {}};
}

double relative(const SettledRate& one) { return one.off / std::max(std::abs(one.value), 1e-300); }

SettledRate over(const SettledRate& one, double divisor) {
  return {.value = one.value / divisor, .off = one.off / std::abs(divisor)};
}

}  // namespace

// dq/dκ of a quantity along states that move by d with κ. By its gradient it has the fewest errors of round-off, unless
// what κ does at the event's own state is no small change, by its own error or since states that follow κ tell
// something else: then these tell it.
template <typename Quantity>
SettledRate EventDerivatives::rate_of(const Row& gradient, const Direction& d, const std::vector<SystemSample>& samples,
                                      const Quantity& quantity) const {
  const Direction stays{.dx = Vector::Zero(d.dx.size()), .dlambda = 0.0};
  const auto rate = [&](const Direction& along) {
    const double value = rate_along(samples, along, quantity);
    return SettledRate{.value = value, .off = std::abs(value - rate_along(samples, along, quantity, true))};
  };
  const SettledRate following = rate(d), at_rest = rate(stays);
  const double by_gradient = apply(gradient, d) + at_rest.value;
  const bool agree = std::abs(by_gradient - following.value) <= short_enough * std::abs(following.value);
  return agree && at_rest.off <= following.off ? SettledRate{.value = by_gradient, .off = at_rest.off} : following;
}

// dm/dκ = ∂m/∂κ + ∂m/∂x · dx/dκ + ∂m/∂λ · dλ/dκ of each quantity, along the event. None of those that change by what
// is unsure in the event's motion.
std::vector<std::optional<double>> EventDerivatives::rates(const Direction& motion,
                                                           const std::vector<SystemSample>& samples,
                                                           const std::vector<Direction>& unsure) const {
  std::vector<std::optional<double>> rates(quantities_.size());
  for (std::size_t i = 0; i < quantities_.size(); ++i) {
    if (!quantities_[i].value) continue;
    const auto quantity = [i](const SystemSample& sample, const State& state) {
      return sample.quantities[i].value->value(state);
    };
    const Row gradient = quantities_[i].value->gradient(state_);
    SettledRate rate = rate_of(gradient, motion, samples, quantity);
    for (const Direction& part : unsure) rate.off += std::abs(apply(gradient, part));
    const double parts = gradient.dx.cwiseAbs().dot(motion.dx.cwiseAbs()) + std::abs(gradient.dlambda * motion.dlambda);
    rate.off = std::max(0.0, rate.off - roundoff_terms * quantities_[i].roundoff / step_of(samples));
    if (is_settled(rate, std::abs(quantities_[i].value->value(state_)) + parts * step_of(samples), samples))
      rates[i] = rate.value;
  }
  return rates;
}

// The event moves by the response, and back along the path by what is settled so far.
EventDerivative EventDerivatives::of_motion(const Response& response, const SettledRate& moves,
                                            const std::vector<SystemSample>& samples) const {
  EventDerivative found = settled(slope_of(response, moves), samples);
  if (found.value)
    found.rates = rates(along(response.d, moves.value), samples, {times(moves.off, tangent_), response.unsure});
  return found;
}

// The event moves by κ across the path and, so far, back along it.
Direction EventDerivatives::along(const Direction& response, double moves) const {
  return {.dx = response.dx - moves * tangent_.dx, .dlambda = response.dlambda - moves * tangent_.dlambda};
}

SettledRate EventDerivatives::slope_of(const Response& response, const SettledRate& moves) const {
  return {.value = response.d.dlambda - moves.value * tangent_.dlambda,
          .off = std::abs(response.unsure.dlambda) + std::abs(tangent_.dlambda) * moves.off};
}

// Along the path λ does not change: where the event moves along it matters to other quantities alone.
EventDerivative EventDerivatives::by_limit(const Response& response, const std::vector<SystemSample>& samples) {
  EventDerivative found = settled(slope_of(response, {}), samples);
  if (!found.value || quantities_.empty()) return found;
  const TurnedBy turned = turned_by(response, samples);
  const SettledRate &equilibria = turned.equilibria.moves, &equations = turned.equations.moves;
  const bool equilibria_tell = equilibria.off <= equations.off || !std::isfinite(equations.off);
  const SettledRate& moves = equilibria_tell ? equilibria : equations;
  found.off += relative(moves);
  found.steps_too_long = equilibria_tell && !(relative(turned.rate) <= short_enough);
  found.rates = rates(along(response.d, moves.value), samples, {times(moves.off, tangent_), response.unsure});
  return found;
}

// The value is passed where the path leads it back to.
EventDerivative EventDerivatives::by_value(const Response& response, const std::vector<SystemSample>& samples) const {
  const Row row = watched_->gradient(state_);
  const double rate = watched_->rate(state_, tangent_);
  if (std::abs(rate) <= negligible * metric_.dual_norm(row)) return no_derivative("the value is only touched there");
  const auto value = [](const SystemSample& sample, const State& state) { return sample.watched->value(state); };
  return of_motion(response, over(rate_of(row, response.d, samples, value), rate), samples);
}

// Where λ moves along the path by −t_λ (dg/dκ)/(dg/ds), the guard stays zero. Those that vanish together must agree,
// else they do so at this value of the number alone.
EventDerivative EventDerivatives::by_guards(const Response& response, const std::vector<SystemSample>& samples) const {
  const double size = step_of(samples);
  std::optional<SettledRate> found;
  for (const Index j : guards_) {
    const Row row = system_.guard_gradient(state_, j);
    const double rate = apply(row, tangent_);
    const auto guard = [&](const SystemSample& sample, const State& state) { return sample.system->guard(state, j); };
    const SettledRate by_number = rate_of(row, response.d, samples, guard);
    if (std::abs(rate) <= negligible && std::abs(by_number.value) * size <= negligible) continue;
    if (std::abs(rate) <= negligible) return no_derivative("a contact is only touched there");
    const SettledRate moves = over(by_number, rate);
    const double slope = slope_of(response, moves).value;
    const double other = found ? slope_of(response, *found).value : slope;
    const double scale = std::abs(slope) + std::abs(other) + negligible / size;
    if (std::abs(other - slope) > agreeing * scale)
      return no_derivative("contacts change together there, and would not for another value");
    if (!found) found = moves;
  }
  if (!found) return no_derivative("what changes there is not met to the last digit, since the mesh changes with it");
  return of_motion(response, *found, samples);
}

// The rate m′ = ∇m · t of a monitor at the equilibrium of a system near a guess that is as far along the path.
double EventDerivatives::turning_beside(Corrector& corrector, const Observable& turning, const State& guess,
                                        double along) const {
  State origin = state_;
  origin.active_set = guess.active_set;
  const PlaneConstraint plane(metric_, origin, tangent_, along);
  const CorrectorResult arrived =
      corrector.correct(guess, plane, metric_, tangent_, std::abs(along) + longest_turn, Wanted::tangent);
  if (!arrived.converged()) return std::nan("");
  const CorrectorResult there =
      corrector.inspect(arrived.state, metric_, tangent_);  // whose tangent is that of the end
  if (!there.converged()) return std::nan("");
  const double rate = turning.rate(there.state, there.tangent);
  return metric_.inner(there.tangent, tangent_) < 0.0 ? -rate : rate;
}

// The rate of m′ along the path.
SettledRate EventDerivatives::turning_along() const {
  Corrector corrector(system_, {}, lambda_scale_, factorization_);
  return with_best_step(step_on_one_piece(tangent_, longest_turn), turn_halvings, [&](double h) {
    double sum = 0.0;
    for (const DifferencePlace& place : central_difference)
      sum += place.weight / h *
             turning_beside(corrector, *watched_, moved(state_, tangent_, place.offset * h), place.offset * h);
    return sum;
  });
}

// The rate along d of the rate m′ = ∇m · t of a monitor: t changes by
//
//   J δt_x + F_λ δt_λ = −D²F[t, d] − more,    ⟨t, δt⟩ = 0
SettledRate EventDerivatives::turning_rate(const Direction& d, const Vector& more, double more_of_gradient) {
  const Row gradient = watched_->gradient(state_);
  return with_best_step(step_on_one_piece(d, longest_difference), difference_halvings, [&](double h) {
    const auto change = along_path(-second_derivative(tangent_, d, h) - more);
    if (!change) return std::nan("");
    const double of_gradient =
        difference_along(metric_, state_, d, h, [&](const State& at) { return watched_->rate(at, tangent_); });
    return apply(gradient, *change) + of_gradient + more_of_gradient;
  });
}

// m′ stays zero: where it changes by κ across the path, the event moves along the path.
EventDerivatives::Turned EventDerivatives::turned(const SettledRate& along, const SettledRate& rate,
                                                  const Response& response) const {
  const double moves = rate.value / along.value;
  const double off = (rate.off + std::abs(moves) * along.off) / std::abs(along.value);
  const SettledRate along_path{.value = moves, .off = off};
  return {.slope = slope_of(response, along_path), .moves = along_path};
}

// By equilibria beside the event and by second derivatives of the equations: axial forces of slender members drown the
// latter in round-off, the former is lost where a reaction is a small difference of great forces. Of the latter two
// steps may agree better than they are right, so that they are asked only where the former is unsure.
EventDerivatives::TurnedBy EventDerivatives::turned_by(const Response& response,
                                                       const std::vector<SystemSample>& samples) {
  SettledRate rate;
  double coarse = 0.0, of_gradient = 0.0;
  for (const SystemSample& sample : samples) {
    Corrector corrector(*sample.system, {}, lambda_scale_, factorization_);
    const double there =
        turning_beside(corrector, *sample.watched, moved(sample.state, response.d, sample.offset), 0.0);
    rate.value += sample.weight * there;
    coarse += sample.coarse_weight * there;
    of_gradient += sample.weight * sample.watched->rate(sample.state, tangent_);
  }
  rate.off = std::abs(rate.value - coarse);
  const Direction stays{.dx = Vector::Zero(response.d.dx.size()), .dlambda = 0.0};
  const auto along_tangent = [&](const SystemSample& sample, const State& state) {
    Linearization of_sample;
    return directional(*sample.system, state, tangent_, of_sample);
  };
  const Vector more = rate_along(samples, stays, along_tangent);
  SettledRate here = turning_rate(response.d, more, of_gradient);
  const auto change = along_path(more - rate_along(samples, stays, along_tangent, true));
  here.off += change ? std::abs(watched_->rate(state_, *change)) : infinity;
  return {.equilibria = turned(turning_along_, rate, response),
          .equations = turned(turning_here_, here, response),
          .rate = rate};
}

EventDerivative EventDerivatives::by_turning(const Response& response, const std::vector<SystemSample>& samples) {
  const auto [by_equilibria, by_equations, rate] = turned_by(response, samples);
  const bool equilibria_tell = by_equilibria.slope.off <= short_enough * std::abs(by_equilibria.slope.value) ||
                               by_equilibria.slope.off < by_equations.slope.off ||
                               !std::isfinite(by_equations.slope.off);
  const Turned& told = equilibria_tell ? by_equilibria : by_equations;
  EventDerivative found = settled(told.slope, samples);
  if (found.value)
    found.rates =
        rates(along(response.d, told.moves.value), samples, {times(told.moves.off, tangent_), response.unsure});
  found.steps_too_long = equilibria_tell && !(relative(rate) <= short_enough);
  return found;
}

bool EventDerivatives::is_settled(const SettledRate& rate, double of, const std::vector<SystemSample>& samples) {
  constexpr double little = 1e-9;  // of what changes by a step of the number
  return std::isfinite(rate.value) &&
         rate.off <= sure * std::abs(rate.value) + little * std::abs(of) / step_of(samples);
}

// Laws with kinks and walls whose curvature jumps have no second derivatives that differences come to.
EventDerivative EventDerivatives::settled(const SettledRate& slope, const std::vector<SystemSample>& samples) const {
  if (!is_settled(slope, state_.lambda, samples))
    return no_derivative(
        "the second derivatives of the equations are not told there, as beside a kink of a law or of a wall");
  EventDerivative found = known(slope.value);
  found.off = relative(slope);
  return found;
}

// The most work that f does along the left null vector, displacements and multipliers by themselves: the metric knows
// no lengths of the latter.
double EventDerivatives::greatest_work(const Vector& f) const {
  const Vector& weights = metric_.weights();
  const auto has_weight = weights.array() > 0.0;
  const Vector w = has_weight.select(left_, 0.0), multipliers = left_ - w;
  const double length = std::sqrt(metric_.inner_x(w, w));
  return length * metric_.dual_norm(f) + multipliers.norm() * Vector(has_weight.select(0.0, f)).norm();
}

// The two null vectors k_i of [J F_λ] remain null vectors, as wᵀ sees them, while the point moves by c k₁ + λ′ k₂ + v:
//
//   [ B₁₁ B₁₂ ] [c ]     [ wᵀ d(J k₁)/dκ ]
//   [ B₂₁ B₂₂ ] [λ′] = − [ wᵀ d(J k₂)/dκ ],    B_ij = wᵀ D²F[k_i, k_j],    J v = −F_κ,
//
// with d/dκ along x + κ v.
EventDerivative EventDerivatives::by_crossing(const Response& response, const std::vector<SystemSample>& samples) {
  const Direction& v = response.d;
  Eigen::Vector2d right, off;
  for (Index i = 0; i < 2; ++i) {
    const auto work = [&](const SystemSample& sample, const State& state) {
      Linearization of_sample;
      return left_.dot(directional(*sample.system, state, kernel_[static_cast<std::size_t>(i)], of_sample));
    };
    right[i] = rate_along(samples, v, work);
    off[i] = std::abs(right[i] - rate_along(samples, v, work, true));
  }
  const double determinant = bend_.determinant();
  const Eigen::Matrix2d B = bend_.cwiseAbs();
  const double off_determinant =
      bend_off_(0, 0) * B(1, 1) + B(0, 0) * bend_off_(1, 1) + 2.0 * B(0, 1) * bend_off_(0, 1);
  // By Cramer's rule, with the row of the other unknown.
  const auto solution = [&](Index row) {
    const Index other = 1 - row;
    const double value = -(bend_(other, other) * right[row] - bend_(row, other) * right[other]) / determinant;
    const double parts = B(other, other) * off[row] + B(row, other) * off[other] +
                         bend_off_(other, other) * std::abs(right[row]) +
                         bend_off_(row, other) * std::abs(right[other]) + std::abs(value) * off_determinant;
    return SettledRate{.value = value, .off = parts / std::abs(determinant)};
  };
  const SettledRate along_mode = solution(0), slope = solution(1);
  EventDerivative found = settled(slope, samples);
  const Direction motion{.dx = v.dx + along_mode.value * kernel_[0].dx + slope.value * kernel_[1].dx,
                         .dlambda = slope.value};
  if (found.value)
    found.rates =
        rates(motion, samples, {times(along_mode.off, kernel_[0]), times(slope.off, kernel_[1]), response.unsure});
  return found;
}

}  // namespace arcwall
