#include "continuation/event_curves/event_derivative.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "core/algebra/bordered_solver.hpp"
#include "core/central_difference.hpp"

namespace arcwall {

namespace {

constexpr double longest_step =
    6.4e-2;  // h of differences of J along a direction [path metric]; the best is looked for,
constexpr int halvings = 13;
constexpr double longest_turn = 3.2e-2;  // the same of the rate of a monitor, at equilibria along the path
constexpr int turn_halvings = 13;
constexpr double short_enough = 1e-6;    // difference of fourth and sixth order of a rate by κ, of which the latter is
                                         // much less off
constexpr double sure = 1e-4;            // by which a rate that is told may be off
constexpr double roundoff_terms = 10.0;  // of a quantity's values in what its rate is off
constexpr int most_passes = 12;          // of the rate of F along the change of the equilibrium,
constexpr double nearly_followed = 1e-6;  // of it, below which round-off may stop that
constexpr double moves_no_more = 1e-11;   // or of what a step of the number changes,
constexpr double followed_to = 1e-12;     // of which as much is left
constexpr double vanishing = 1e-8;        // guards below this are zero at the event, which is landed on
constexpr double negligible = 1e-9;       // of what changes a guard: it does not tell
constexpr double agreeing = 1e-6;         // relative difference of what several guards say
constexpr double persistent = 1e-6;       // of the most that it could be wᵀ F_κ is zero
constexpr double roundoff = 1e-10;        // of the loads in what a step of the number changes
constexpr double singular_beside = 1e-7;  // where K is singular to the last digit its null vectors come from beside

// Several directions leave a change of contact. On a smooth arc a branch point is one-sided where a contact forbids one
// of the two.
bool is_at_corner(const BranchPoint& point) { return point.type == BranchType::one_sided && point.modes.empty(); }

// Also where the direction that is taken keeps the old contacts.
bool is_at_change_of_contact(const Arc& arc) {
  return std::any_of(arc.events.begin(), arc.events.end(), [](const Event& event) {
    return changes_contact(event.kind) || (event.branching && is_at_corner(*event.branching));
  });
}

// Whether λ turns because a law of straight pieces comes to a kink.
bool turns_at_kink(const UnilateralSystem& system, const Event& event) {
  const ActiveSet& active_set = event.state.active_set;
  if (event.kind != EventKind::contact_limit_point || active_set.kinks() == 0) return false;
  const Vector guards = system.guards(event.state);
  const auto kinks = guards.segment(static_cast<Index>(active_set.contacts()), static_cast<Index>(active_set.kinks()));
  return kinks.cwiseAbs().minCoeff() <= vanishing;
}

// The branch point on the smooth arc's end; null if there is none.
const BranchPoint* crossing_at(const Arc& arc) {
  for (const Event& event : arc.events)
    if (event.branching && !is_at_corner(*event.branching)) return event.branching.get();
  return nullptr;
}

bool turns(const Arc& arc) {
  return std::any_of(arc.events.begin(), arc.events.end(),
                     [](const Event& event) { return event.kind == EventKind::limit_point; });
}

// A compliant wall begins to press with a length of zero: only without it are the equations smooth there.
void open_those_without_force(const UnilateralSystem& system, const std::vector<Index>& guards, ActiveSet& active_set) {
  for (const Index j : guards) {
    if (j >= static_cast<Index>(active_set.contacts())) continue;
    const Enforcement how = system.enforcement(active_set, j);
    if (!how.multiplier && how.compliance > 0.0) active_set[static_cast<std::size_t>(j)] = 0;
  }
}

// J k_x + F_λ k_λ at a state.
Vector directional(const Equations& system, const State& state, const Direction& k, Linearization& workspace) {
  system.linearize(state, workspace);
  return product(workspace, k.dx).col(0) + k.dlambda * workspace.F_lambda;
}

// dQ/dκ of a quantity of a sample's system and a state, along states that move by d with κ; `coarse`: of lower order.
template <typename Function>
auto rate_along(const std::vector<SystemSample>& samples, const Direction& d, const Function& quantity,
                bool coarse = false) {
  std::optional<std::decay_t<decltype(quantity(samples.front(), samples.front().state))>> sum;
  for (const SystemSample& sample : samples) {
    const double weight = coarse ? sample.coarse_weight : sample.weight;
    auto part = quantity(sample, moved(sample.state, d, sample.offset));
    part *= weight;
    if (sum)
      *sum += part;
    else
      sum = std::move(part);
  }
  return *sum;
}

Vector residual_rate(const std::vector<SystemSample>& samples, const Direction& d, bool coarse = false) {
  const auto residual = [](const SystemSample& sample, const State& state) {
    Vector F(state.x.size());
    sample.system->residual(state, F);
    return F;
  };
  return rate_along(samples, d, residual, coarse);
}

// Σ weight f(offset · h)/h, at states along d
template <typename Function>
auto difference_along(const Metric& metric, const State& state, const Direction& d, double part, const Function& f) {
  // Forces alone have no length, and equations are linear in them.
  const double length = metric.norm(d), h = length > 0.0 ? part / length : 1.0 / d.dx.cwiseAbs().maxCoeff();
  std::decay_t<decltype(f(state))> sum = f(state);
  sum *= 0.0;
  for (const DifferencePlace& place : central_difference)
    sum += place.weight / h * f(moved(state, d, place.offset * h));
  return sum;
}

// The length of a step of the number.
double step_of(const std::vector<SystemSample>& samples) {
  double greatest = 0.0;
  for (const SystemSample& sample : samples) greatest = std::max(greatest, std::abs(sample.weight));
  return 1.0 / greatest;
}

Direction times(double factor, const Direction& d) { return {.dx = factor * d.dx, .dlambda = factor * d.dlambda}; }

EventDerivative none(std::string why) { return {.value = std::nullopt, .why_none = std::move(why)}; }

EventDerivative too_far() {
  EventDerivative none_here = none("the structure is not followed to other values, even near by");
  none_here.steps_too_long = true;
  none_here.off = infinity;
  return none_here;
}

EventDerivative known(double value) {
  if (!std::isfinite(value)) return none("the equations are singular at the event");
  return {.value = value, .why_none = {}};
}

}  // namespace

// Long steps have an error of their own, where contacts slide over bends or elements are slender, short ones that of
// round-off: of the three steps in a row whose derivatives differ least the longest one is taken. Two may agree by
// chance.
template <typename Function>
EventDerivatives::Settled EventDerivatives::with_best_step(double longest, int halvings, const Function& derivative) {
  Settled best{.value = std::nan(""), .off = infinity};
  double longer = derivative(longest), middle = derivative(0.5 * longest);
  for (int i = 2; i <= halvings; ++i) {
    const double shorter = derivative(std::ldexp(longest, -i));
    const double off = std::max(std::abs(middle - longer), std::abs(shorter - middle));
    if (off < best.off) best = {.value = longer, .off = off};
    longer = std::exchange(middle, shorter);
  }
  return best;
}

double EventDerivatives::relative(const Settled& one) { return one.off / std::max(std::abs(one.value), 1e-300); }

EventDerivatives::Settled EventDerivatives::over(const Settled& one, double divisor) {
  return {.value = one.value / divisor, .off = one.off / std::abs(divisor)};
}

EventDerivatives::EventDerivatives(const System& system, const Arc& arc, const Event& event,
                                   std::shared_ptr<const Observable> watched, std::vector<RatedQuantity> quantities,
                                   double lambda_scale, const MakeFactorization& factorization)
    : system_(system),
      metric_(system.weights(event.state.active_set), lambda_scale),
      lambda_scale_(lambda_scale),
      factorization_(factorization),
      corrector_(system, {}, lambda_scale, factorization),
      state_(event.state),
      watched_(std::move(watched)),
      quantities_(std::move(quantities)) {
  const BranchPoint* const crossing = crossing_at(arc);
  const bool corner = is_at_change_of_contact(arc) || turns_at_kink(system, event);
  if (event.unconfirmed) {
    why_none_ = "the event is unconfirmed";
  } else if (event.kind == EventKind::value_crossing) {
    condition_ = Condition::value;
    if (corner || crossing != nullptr) why_none_ = "another event lies at the same point";
  } else if (corner) {
    condition_ = Condition::guards;
  } else if (event.kind == EventKind::contact_limit_point) {
    why_none_ = "λ turns where the mesh changes";
  } else if (crossing != nullptr) {
    condition_ = Condition::crossing;
    if (crossing->multiplicity > 1 || (turns(arc) && crossing->ways.empty()))
      why_none_ = "several modes are critical at once";
    else if (crossing->modes.empty())
      why_none_ = "the critical mode is not known";
  } else if (event.kind == EventKind::turning_point) {
    condition_ = Condition::turning;
  }
  if (!why_none_.empty()) return;
  const bool begun = condition_ == Condition::crossing ? begin_crossing(*crossing) : begin_regular(arc.to.tangent);
  if (!begun && why_none_.empty()) why_none_ = "the equations are singular at the event";
}

// Tangent and, of events of contact, the guards that vanish; of a turning monitor the rate of its rate.
bool EventDerivatives::begin_regular(const Direction& along) {
  if (along.dx.size() != state_.x.size()) return false;
  if (condition_ == Condition::guards) {
    const Vector guards = system_.guards(state_);
    for (Index j = 0; j < guards.size(); ++j)
      if (std::abs(guards[j]) <= vanishing) guards_.push_back(j);
    open_those_without_force(system_, guards_, state_.active_set);
  }
  CorrectorResult here = corrector_.inspect(state_, metric_, along);
  if (!here.converged()) return false;
  tangent_ = std::move(here.tangent);
  if (condition_ == Condition::turning || (condition_ == Condition::limit && !quantities_.empty())) {
    turning_along_ = turning_along();
    turning_here_ = turning_rate(tangent_, Vector::Zero(state_.x.size()), 0.0);
  }
  return true;
}

// The left null vector w of J and the null vectors (φ, 0) and (v, 1) of [J F_λ].
bool EventDerivatives::begin_crossing(const BranchPoint& point) {
  std::optional<NearNull> pairs;
  for (const double beside : {0.0, singular_beside, -singular_beside}) {
    const State here = moved(state_, point.along, beside);
    corrector_.inspect(here, metric_, point.along);
    if ((pairs = corrector_.near_null(here, metric_.weights(), 1))) break;
  }
  if (!pairs || pairs->vectors->cols() < 1) return false;
  left_ = corrector_.left_null(pairs->vectors->col(0));
  auto mode = corrector_.right_null(left_);
  if (!mode) return false;
  kernel_.push_back({.dx = std::move(*mode), .dlambda = 0.0});
  const Vector F_lambda = corrector_.factorized().equations().F_lambda;
  auto response = corrector_.response_across(metric_.row(kernel_.front()), -F_lambda);
  if (!response) return false;
  kernel_.push_back({.dx = std::move(*response), .dlambda = 1.0});
  load_work_ = greatest_work(F_lambda) * std::max(std::abs(state_.lambda), metric_.lambda_scale());
  for (Index i = 0; i < 2; ++i)
    for (Index j = 0; j <= i; ++j) {
      const Settled of = bend(kernel_[static_cast<std::size_t>(i)], kernel_[static_cast<std::size_t>(j)]);
      bend_(i, j) = bend_(j, i) = of.value;
      bend_off_(i, j) = bend_off_(j, i) = of.off;
    }
  return bend_.allFinite();
}

// The longest step along d [path metric] of differences that stay on one piece of the equations: those of a compliant
// contact or a spring's law are others beyond the zero of its guard.
double EventDerivatives::step_on_one_piece(const Direction& d, double longest) const {
  constexpr double steps_to_zero = 4.0;  // differences take three
  const double length = metric_.norm(d);
  if (length == 0.0) return longest;
  const GuardsAlong guards = system_.guards_along(state_, d);
  for (Index j = 0; j < static_cast<Index>(state_.active_set.size()); ++j) {
    const double distance = std::abs(guards.values[j]), rate = std::abs(guards.rates[j]) / length;
    const bool ends_piece = system_.enforcement(state_.active_set, j).compliance > 0.0 && distance > vanishing;
    if (ends_piece && steps_to_zero * longest * rate > distance) longest = distance / (steps_to_zero * rate);
  }
  return longest;
}

// D²F[k, d]
Vector EventDerivatives::second_derivative(const Direction& k, const Direction& d, double h) {
  if (metric_.norm(d) == 0.0 && d.dx.isZero(0.0)) return Vector::Zero(state_.x.size());
  return difference_along(metric_, state_, d, h,
                          [&](const State& at) { return directional(system_, at, k, workspace_); });
}

// wᵀ D²F[k, d]
EventDerivatives::Settled EventDerivatives::bend(const Direction& k, const Direction& d) {
  return with_best_step(step_on_one_piece(d, longest_step), halvings,
                        [&](double h) { return left_.dot(second_derivative(k, d, h)); });
}

// The change of the equilibrium with κ. Where that moves a support, say, F_κ at the same state strains one element
// alone, by forces that are far greater than those of the path, and no step is short enough for all digits. So the rate
// is taken again along the change that is known, until nothing is left of it:
//
//     J δ_x + F_λ δ_λ = −dF(x + κ v_x, λ + κ v_λ; κ)/dκ,    v ← v + δ
//
// What differences of a lower order would leave of it tells the error.
template <typename Solve>
std::optional<EventDerivatives::Response> EventDerivatives::followed(const std::vector<SystemSample>& samples,
                                                                     const Solve& solve) const {
  const auto done = [&](Direction& v) -> std::optional<Response> {
    const auto unsure = solve(residual_rate(samples, v, true));
    if (!unsure) return std::nullopt;
    return Response{.d = std::move(v), .unsure = *unsure};
  };
  Direction v{.dx = Vector::Zero(state_.x.size()), .dlambda = 0.0};
  const double roundoff_of_v = moves_no_more / step_of(samples);
  double before = infinity;
  for (int pass = 0; pass < most_passes; ++pass) {
    const std::optional<Direction> change = solve(-residual_rate(samples, v));
    if (!change) return std::nullopt;
    const double length = metric_.norm(*change);
    if (length <= nearly_followed * metric_.norm(v) + roundoff_of_v && !(length < 0.5 * before)) return done(v);
    v.dx += change->dx;
    v.dlambda += change->dlambda;
    if (length <= followed_to * metric_.norm(v)) return done(v);
    before = length;
  }
  return std::nullopt;
}

// Across the path:  J δx + F_λ δλ = f,  ⟨t, δ⟩ = 0
std::optional<Direction> EventDerivatives::along_path(const Vector& f) {
  return corrector_.factorized().solver().solve(metric_.row(tangent_), f, 0.0);
}

// Whether the branches meet for other values, too.
bool EventDerivatives::persists(const std::vector<SystemSample>& samples) const {
  const Vector F_kappa = residual_rate(samples, {.dx = Vector::Zero(state_.x.size()), .dlambda = 0.0});
  return std::abs(left_.dot(F_kappa)) <= persistent * greatest_work(F_kappa) + load_work_ * roundoff / step_of(samples);
}

// At the λ of a branch point, without a part along the critical mode.
std::optional<Direction> EventDerivatives::across_crossing(const Vector& f) {
  auto response = corrector_.response_across(metric_.row(kernel_.front()), f);
  if (!response) return std::nullopt;
  return Direction{.dx = std::move(*response), .dlambda = 0.0};
}

EventDerivative EventDerivatives::by(std::vector<SystemSample> samples) {
  if (!why_none_.empty()) return none(why_none_);
  for (SystemSample& sample : samples) open_those_without_force(*sample.system, guards_, sample.state.active_set);
  const bool crosses = condition_ == Condition::crossing;
  if (crosses && !persists(samples))
    return none("the branch point does not persist: for other values the branches do not meet");
  const auto response =
      followed(samples, [&](const Vector& f) { return crosses ? across_crossing(f) : along_path(f); });
  if (!response) return too_far();
  EventDerivative found = by_condition(*response, samples);
  const double untold = untold_of(found);
  found.off += untold;
  found.steps_too_long = found.steps_too_long || untold > 0.0;
  return found;
}

// What is not told counts as off by all of itself.
double EventDerivatives::untold_of(const EventDerivative& found) const {
  if (!found.value) return infinity;
  double untold = 0.0;
  for (std::size_t i = 0; i < found.rates.size(); ++i) untold += quantities_[i].value && !found.rates[i] ? 1.0 : 0.0;
  return untold;
}

EventDerivative EventDerivatives::by_condition(const Response& response, const std::vector<SystemSample>& samples) {
  switch (condition_) {
    case Condition::guards:
      return by_guards(response, samples);
    case Condition::turning:
      return by_turning(response, samples);
    case Condition::value:
      return by_value(response, samples);
    case Condition::crossing:
      return by_crossing(response, samples);
    case Condition::limit:
      break;
  }
  return by_limit(response, samples);
}

// dq/dκ of a quantity along states that move by d with κ. By its gradient it has the fewest errors of round-off, unless
// what κ does at the event's own state is no small change, by its own error or since states that follow κ tell
// something else: then these tell it.
template <typename Quantity>
EventDerivatives::Settled EventDerivatives::rate_of(const Row& gradient, const Direction& d,
                                                    const std::vector<SystemSample>& samples,
                                                    const Quantity& quantity) const {
  const Direction stays{.dx = Vector::Zero(d.dx.size()), .dlambda = 0.0};
  const auto rate = [&](const Direction& along) {
    const double value = rate_along(samples, along, quantity);
    return Settled{.value = value, .off = std::abs(value - rate_along(samples, along, quantity, true))};
  };
  const Settled following = rate(d), at_rest = rate(stays);
  const double by_gradient = apply(gradient, d) + at_rest.value;
  const bool agree = std::abs(by_gradient - following.value) <= short_enough * std::abs(following.value);
  return agree && at_rest.off <= following.off ? Settled{.value = by_gradient, .off = at_rest.off} : following;
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
    Settled rate = rate_of(gradient, motion, samples, quantity);
    for (const Direction& part : unsure) rate.off += std::abs(apply(gradient, part));
    const double parts = gradient.dx.cwiseAbs().dot(motion.dx.cwiseAbs()) + std::abs(gradient.dlambda * motion.dlambda);
    rate.off = std::max(0.0, rate.off - roundoff_terms * quantities_[i].roundoff / step_of(samples));
    if (is_settled(rate, std::abs(quantities_[i].value->value(state_)) + parts * step_of(samples), samples))
      rates[i] = rate.value;
  }
  return rates;
}

// The event moves by the response, and back along the path by what is settled so far.
EventDerivative EventDerivatives::of_motion(const Response& response, const Settled& moves,
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

EventDerivatives::Settled EventDerivatives::slope_of(const Response& response, const Settled& moves) const {
  return {.value = response.d.dlambda - moves.value * tangent_.dlambda,
          .off = std::abs(response.unsure.dlambda) + std::abs(tangent_.dlambda) * moves.off};
}

// Along the path λ does not change: where the event moves along it matters to other quantities alone.
EventDerivative EventDerivatives::by_limit(const Response& response, const std::vector<SystemSample>& samples) {
  EventDerivative found = settled(slope_of(response, {}), samples);
  if (!found.value || quantities_.empty()) return found;
  const TurnedBy turned = turned_by(response, samples);
  const Settled &equilibria = turned.equilibria.moves, &equations = turned.equations.moves;
  const bool equilibria_tell = equilibria.off <= equations.off || !std::isfinite(equations.off);
  const Settled& moves = equilibria_tell ? equilibria : equations;
  found.off += relative(moves);
  found.steps_too_long = equilibria_tell && !(relative(turned.rate) <= short_enough);
  found.rates = rates(along(response.d, moves.value), samples, {times(moves.off, tangent_), response.unsure});
  return found;
}

// The value is passed where the path leads it back to.
EventDerivative EventDerivatives::by_value(const Response& response, const std::vector<SystemSample>& samples) const {
  const Row row = watched_->gradient(state_);
  const double rate = watched_->rate(state_, tangent_);
  if (std::abs(rate) <= negligible * metric_.dual_norm(row)) return none("the value is only touched there");
  const auto value = [](const SystemSample& sample, const State& state) { return sample.watched->value(state); };
  return of_motion(response, over(rate_of(row, response.d, samples, value), rate), samples);
}

// Where λ moves along the path by −t_λ (dg/dκ)/(dg/ds), the guard stays zero. Those that vanish together must agree,
// else they do so at this value of the number alone.
EventDerivative EventDerivatives::by_guards(const Response& response, const std::vector<SystemSample>& samples) const {
  const double size = step_of(samples);
  std::optional<Settled> found;
  for (const Index j : guards_) {
    const Row row = system_.guard_gradient(state_, j);
    const double rate = apply(row, tangent_);
    const auto guard = [&](const SystemSample& sample, const State& state) { return sample.system->guard(state, j); };
    const Settled by_number = rate_of(row, response.d, samples, guard);
    if (std::abs(rate) <= negligible && std::abs(by_number.value) * size <= negligible) continue;
    if (std::abs(rate) <= negligible) return none("a contact is only touched there");
    const Settled moves = over(by_number, rate);
    const double slope = slope_of(response, moves).value;
    const double other = found ? slope_of(response, *found).value : slope;
    const double scale = std::abs(slope) + std::abs(other) + negligible / size;
    if (std::abs(other - slope) > agreeing * scale)
      return none("contacts change together there, and would not for another value");
    if (!found) found = moves;
  }
  if (!found) return none("what changes there is not met to the last digit, since the mesh changes with it");
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
EventDerivatives::Settled EventDerivatives::turning_along() const {
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
EventDerivatives::Settled EventDerivatives::turning_rate(const Direction& d, const Vector& more,
                                                         double more_of_gradient) {
  const Row gradient = watched_->gradient(state_);
  return with_best_step(step_on_one_piece(d, longest_step), halvings, [&](double h) {
    const auto change = along_path(-second_derivative(tangent_, d, h) - more);
    if (!change) return std::nan("");
    const double of_gradient =
        difference_along(metric_, state_, d, h, [&](const State& at) { return watched_->rate(at, tangent_); });
    return apply(gradient, *change) + of_gradient + more_of_gradient;
  });
}

// m′ stays zero: where it changes by κ across the path, the event moves along the path.
EventDerivatives::Turned EventDerivatives::turned(const Settled& along, const Settled& rate,
                                                  const Response& response) const {
  const double moves = rate.value / along.value;
  const double off = (rate.off + std::abs(moves) * along.off) / std::abs(along.value);
  const Settled along_path{.value = moves, .off = off};
  return {.slope = slope_of(response, along_path), .moves = along_path};
}

// By equilibria beside the event and by second derivatives of the equations: axial forces of slender members drown the
// latter in round-off, the former is lost where a reaction is a small difference of great forces. Of the latter two
// steps may agree better than they are right, so that they are asked only where the former is unsure.
EventDerivatives::TurnedBy EventDerivatives::turned_by(const Response& response,
                                                       const std::vector<SystemSample>& samples) {
  Settled rate;
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
  Settled here = turning_rate(response.d, more, of_gradient);
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

bool EventDerivatives::is_settled(const Settled& rate, double of, const std::vector<SystemSample>& samples) {
  constexpr double little = 1e-9;  // of what changes by a step of the number
  return std::isfinite(rate.value) &&
         rate.off <= sure * std::abs(rate.value) + little * std::abs(of) / step_of(samples);
}

// Laws with kinks and walls whose curvature jumps have no second derivatives that differences come to.
EventDerivative EventDerivatives::settled(const Settled& slope, const std::vector<SystemSample>& samples) const {
  if (!is_settled(slope, state_.lambda, samples))
    return none("the second derivatives of the equations are not told there, as beside a kink of a law or of a wall");
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
    return Settled{.value = value, .off = parts / std::abs(determinant)};
  };
  const Settled along_mode = solution(0), slope = solution(1);
  EventDerivative found = settled(slope, samples);
  const Direction motion{.dx = v.dx + along_mode.value * kernel_[0].dx + slope.value * kernel_[1].dx,
                         .dlambda = slope.value};
  if (found.value)
    found.rates =
        rates(motion, samples, {times(along_mode.off, kernel_[0]), times(slope.off, kernel_[1]), response.unsure});
  return found;
}

}  // namespace arcwall
