#include "continuation/event_curves/event_derivative.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/event_curves/sample_differences.hpp"

namespace arcwall {

namespace {

constexpr int most_passes = 12;           // of the rate of F along the change of the equilibrium,
constexpr double nearly_followed = 1e-6;  // of it, below which round-off may stop that
constexpr double moves_no_more = 1e-11;   // or of what a step of the number changes,
constexpr double followed_to = 1e-12;     // of which as much is left
constexpr double vanishing = 1e-8;        // guards below this are zero at the event, which is landed on
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

EventDerivative too_far() {
  EventDerivative none_here = no_derivative("the structure is not followed to other values, even near by");
  none_here.steps_too_long = true;
  none_here.off = infinity;
  return none_here;
}

}  // namespace

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
  const bool arrives = arc.arrives && arc.arrives->state.active_set == event.state.active_set;
  const Direction& along = arrives ? arc.arrives->tangent : arc.to.tangent;
  const bool begun = condition_ == Condition::crossing ? begin_crossing(*crossing) : begin_regular(along);
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
      const SettledRate of = bend(kernel_[static_cast<std::size_t>(i)], kernel_[static_cast<std::size_t>(j)]);
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
SettledRate EventDerivatives::bend(const Direction& k, const Direction& d) {
  return with_best_step(step_on_one_piece(d, longest_difference), difference_halvings,
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
  if (!why_none_.empty()) return no_derivative(why_none_);
  for (SystemSample& sample : samples) open_those_without_force(*sample.system, guards_, sample.state.active_set);
  const bool crosses = condition_ == Condition::crossing;
  if (crosses && !persists(samples))
    return no_derivative("the branch point does not persist: for other values the branches do not meet");
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

}  // namespace arcwall
