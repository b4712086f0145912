#pragma once

#include <optional>
#include <vector>

#include "continuation/event_curves/system_family.hpp"
#include "continuation/metric.hpp"
#include "core/algebra/bordered_solver.hpp"
#include "core/linearization.hpp"

namespace arcwall {

/// A member of a family and what it counts in the derivative by κ: dQ/dκ = Σ weight · Q(member).
struct WeightedMember {
  SystemFamily::Member member{};
  double weight = 0.0;  ///< [1/κ]
  double few = 0.0;     ///< the weight of a derivative from three members alone, for what Newton's method alone needs
  double kappa = 0.0;
  Vector F{};  ///< its residual, where that is known
};

/// What makes a point of a path an event, beside equilibrium with the event's contacts (docs/theory.md, section 14).
enum class Criterion {
  turning,   ///< the rate along the path of λ, or of a monitor, is zero
  value,     ///< a monitor, or λ, has a value
  guard,     ///< a guard is zero
  crossing,  ///< ∂F/∂x is singular, and F_λ does no work along its left null vector
};

/// One scalar equation of an event, with its derivatives.
struct EventEquation {
  double value = 0.0;  ///< of order 1 where it does not hold
  Row row{};           ///< by (x, λ)
  double by_kappa = 0.0;
};

/// The border (f, r) of
///
///     A = [ J    f  ]
///         [ rᵀ  r_λ ],    J = ∂F/∂x
///
/// which is regular near an event where J is singular. The event's equations do not depend on it, but for their scale.
struct EventBorder {
  Vector column{};     ///< f of a crossing, and of a limit point near one [force]; empty: f is F_λ
  Row row{};           ///< r
  double scale = 1.0;  ///< of the equation of what turns
};

/// The border at a state near an event; empty if it cannot be told what is singular there. `before`: the direction of
/// the path at a neighbouring event, if that is known, so that directions keep their sense.
std::optional<EventBorder> event_border(Criterion criterion, const SystemFamily::Member& at, const Metric& metric,
                                        const MakeFactorization& make, const Direction* before = nullptr);

/// The equation m = value of what passes a value.
EventEquation passed_value(const SystemFamily::Member& at, double value, const EventBorder& border,
                           const std::vector<WeightedMember>& samples);

/// The direction of unit length of the path through the event, of a crossing of the one on which λ varies; empty where
/// A is singular.
std::optional<Direction> path_direction(Criterion criterion, const SystemFamily::Member& at, const EventBorder& border,
                                        const Metric& metric, const MakeFactorization& make);

/// The equations of an event that is no change of contact: one for what turns, two for a crossing. `equations` are
/// those at the member's state; samples whose equations are needed have their residual then. Empty where A is singular.
std::optional<std::vector<EventEquation>> singular_equations(Criterion criterion, const SystemFamily::Member& at,
                                                             const EventBorder& border, Linearization& equations,
                                                             std::vector<WeightedMember>& samples, const Metric& metric,
                                                             const MakeFactorization& make);

/// The cosine between the border and what is singular at a state, at least of what A's solutions show: near zero A is
/// nearly singular and another border is due. Zero where A is singular.
double border_fits(const SystemFamily::Member& at, const EventBorder& border, const Metric& metric,
                   const MakeFactorization& make);

}  // namespace arcwall
