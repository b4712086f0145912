#include "continuation/equilibria/descent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/equilibria/held_minimum.hpp"

namespace arcwall {

namespace {

// All lengths in the path metric, without multipliers.
constexpr int most_steps = 1000;
constexpr int most_refused = 30;        // steps one after the other
constexpr int cautious_steps = 10;      // behind one that was refused
constexpr double longest_motion = 0.1;  // of a step
constexpr double wanted_motion = 0.08;  // the time step is chosen for it,
constexpr double longer_time = 10.0;    // but grows no faster than this,
constexpr double little_longer = 2.0;   // and than this for some steps behind one that was refused
constexpr double shorter_time = 4.0;    // where a step is refused
constexpr double at_rest = 1e-12;       // Newton's last correction at rest
constexpr double no_motion = 1e-8;      // of a step, below which rest is looked for
constexpr double far_away = 10.0;       // of the start

// The drag with which the forces at a state move it so far, if nothing else resists.
double drag_for(const UnilateralSystem& system, const State& state, double length) {
  Vector F(state.x.size());
  system.residual(state, F);
  const Vector weights = system.weights(state.active_set);
  double squared = 0.0;
  for (Index i = 0; i < weights.size(); ++i)
    if (weights[i] > 0.0) squared += F[i] * F[i] / weights[i];
  return std::sqrt(squared) / length;
}

}  // namespace

bool passes_a_wall(const System& system, const State& from, const State& to) {
  const StepVerdict verdict = system.check({.from = from, .to = to, .located = CheckedStep::LocatedEnd{}});
  return verdict.fault == StepVerdict::Fault::wall_crossed;
}

Descent descend(const System& system, const State& start, const MakeFactorization& make, Index& factorizations) {
  HeldMinimum minimum(system, make, factorizations);
  Descent descent{.state = start};
  double mu = drag_for(system, start, wanted_motion);
  int refused = 0, accepted = 0;
  for (; descent.steps < most_steps; ++descent.steps) {
    const auto next = minimum.with_drag(mu, descent.state);
    const double length = next ? motion_between(system, *next, descent.state) : infinity;
    if (factorizations <= 0) {
      descent.end = DescentEnd::cut_off;
      return descent;
    }
    const bool is_short = next && length <= longest_motion;
    const bool is_stopped = is_short && passes_a_wall(system, descent.state, *next);
    descent.meets_wall = descent.meets_wall || is_stopped;
    if (!is_short || is_stopped) {
      if (++refused > most_refused) return descent;
      mu *= shorter_time;
      continue;
    }
    descent.state = *next;
    if (motion_between(system, descent.state, start) > far_away) {
      descent.end = DescentEnd::falls_away;
      return descent;
    }
    if (length <= no_motion) {
      const auto rest = minimum.free(descent.state, at_rest);
      const bool is_near = rest && motion_between(system, *rest, descent.state) <= longest_motion;
      if (is_near && !passes_a_wall(system, descent.state, *rest)) {
        descent.end = DescentEnd::at_rest;
        descent.state = *rest;
        return descent;
      }
    }
    accepted = refused > 0 ? 0 : accepted + 1;
    const double growth = accepted < cautious_steps ? little_longer : longer_time;
    if (std::exchange(refused, 0) == 0) mu *= std::clamp(length / wanted_motion, 1.0 / growth, 1.0);
  }
  return descent;
}

}  // namespace arcwall
