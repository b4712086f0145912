#include "continuation/load_increments.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/algebra/bordered_solver.hpp"

namespace arcwall {

namespace {

constexpr double side_tolerance = 1e-12;  // of the guards' scale
constexpr int rounds_together = 20;       // in which all contacts that violate their side conditions change
constexpr int most_rounds = 100;

}  // namespace

LoadIncrements::LoadIncrements(const UnilateralSystem& system, State start, double lambda_scale,
                               std::function<void(const State&)> advance, const MakeFactorization& make)
    : system_(system),
      advance_(std::move(advance)),
      lambda_scale_(lambda_scale),
      solver_(std::make_unique<BorderedSolver>(make)) {
  last_.state = std::move(start);
  last_.guards = system_.guards(last_.state);
  last_.count = {.unstable = 0, .stability = Stability::stable};
}

LoadIncrements::LoadIncrements(LoadIncrements&&) noexcept = default;
LoadIncrements::~LoadIncrements() = default;

Arc LoadIncrements::start() {
  Event event{.kind = EventKind::start, .state = last_.state};
  event.unstable_before = event.unstable_after = last_.count.unstable;
  return {.to = last_, .events = {std::move(event)}};
}

std::optional<Arc> LoadIncrements::to(double lambda) {
  const std::optional<Increment> increment = solve(lambda);
  if (!increment) return std::nullopt;
  const PathPoint before = std::exchange(last_, point(*increment, lambda));
  return Arc{.to = last_, .events = changes(before.state.active_set, last_, before.state.lambda)};
}

// Contacts change until none pulls and none penetrates; in the end one by one, the worst first. Where the stiffness is
// not positive there may be no such set: the next increment begins with what is violated.
std::optional<LoadIncrements::Increment> LoadIncrements::solve(double lambda) {
  ActiveSet active_set = last_.state.active_set;
  for (int round = 0;; ++round) {
    std::optional<Increment> increment = solve_on(active_set, lambda);
    if (!increment) return std::nullopt;
    std::vector<Index> wrong = violated(*increment);
    if (wrong.empty()) return increment;
    if (round == most_rounds) {
      ++unsettled_;
      return increment;
    }
    if (round >= rounds_together) wrong.erase(wrong.begin() + 1, wrong.end());
    for (const Index j : wrong) {
      auto& closed = active_set[static_cast<std::size_t>(j)];
      closed = closed ? 0 : 1;
    }
  }
}

std::optional<LoadIncrements::Increment> LoadIncrements::solve_on(const ActiveSet& active_set, double lambda) {
  Increment increment{.from = system_.with_active_set(last_.state, active_set)};
  State at = increment.from;
  at.lambda = lambda;
  system_.linearize(at, now_);
  const Index multipliers = system_.multiplier_count(active_set);
  const FactorStatus status = solver_->factorize(now_, multipliers);
  Matrix dx = -now_.F;
  if (status != FactorStatus::ok || !solver_->solve_inner(dx) || !dx.allFinite()) {
    const bool finite = status != FactorStatus::not_finite;
    end_ = BranchEnd{.reason = finite ? EndReason::singular : EndReason::not_finite,
                     .detail = "the tangent stiffness of a load increment"};
    return std::nullopt;
  }
  increment.dx = dx.col(0);
  increment.negative = solver_->inner().inertia().value_or(Inertia{}).negative - multipliers;
  return increment;
}

// The worst first.
std::vector<Index> LoadIncrements::violated(const Increment& increment) const {
  const auto [now, change] = system_.guards_along(increment.from, {.dx = increment.dx, .dlambda = 0.0});
  const Vector guards = now + change;
  std::vector<Index> wrong;
  for (Index j = 0; j < guards.size(); ++j)
    if (guards[j] < -side_tolerance) wrong.push_back(j);
  std::sort(wrong.begin(), wrong.end(), [&](Index a, Index b) { return guards[a] < guards[b]; });
  return wrong;
}

PathPoint LoadIncrements::point(const Increment& increment, double lambda) {
  PathPoint point{.state = increment.from, .iterations = 1};
  const Direction step{.dx = increment.dx, .dlambda = lambda - increment.from.lambda};
  point.state.x += step.dx;
  point.state.lambda = lambda;
  const Metric metric(system_.weights(point.state.active_set), lambda_scale_);
  point.arc = last_.arc + metric.norm(step);
  point.negative_eigenvalues = increment.negative;
  point.count = {.unstable = increment.negative,
                 .stability = increment.negative > 0 ? Stability::unstable : Stability::stable};
  advance_(point.state);
  // What is left unbalanced is the residue that the next increment takes over.
  system_.linearize(point.state, now_);
  point.residual = relative_residual(metric, now_, lambda, 1e-3 * lambda_scale_);
  point.guards = system_.guards(point.state);
  return point;
}

std::vector<Event> LoadIncrements::changes(const ActiveSet& before, const PathPoint& after,
                                           double lambda_before) const {
  std::vector<Event> events;
  for (const EventKind kind : {EventKind::contact_opens, EventKind::contact_closes}) {
    Event event{.kind = kind, .state = after.state, .arc = after.arc, .residual = after.residual};
    event.lambda_uncertainty = std::abs(after.state.lambda - lambda_before);  // it happened on the way
    event.unstable_before = event.unstable_after = after.count.unstable;
    for (std::size_t j = 0; j < before.size(); ++j)
      if (before[j] != after.state.active_set[j] &&
          (after.state.active_set[j] != 0) == (kind == EventKind::contact_closes))
        event.guards.push_back(static_cast<Index>(j));
    if (!event.guards.empty()) events.push_back(std::move(event));
  }
  return events;
}

}  // namespace arcwall
