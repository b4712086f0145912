// How the tracer leaves a change of contact: the rays, the choice between them, and the events that are reported.
#include <algorithm>
#include <cassert>
#include <limits>

#include "continuation/path_tolerances.hpp"
#include "continuation/tracer.hpp"

namespace arcwall {

namespace {

constexpr int max_standing = 50;
constexpr double same_way = 1.0 - 1e-6;  // cosine above which two directions are one

// Of a transition that is an event.
EventKind kind_of(Transition::Change change) {
  switch (change) {
    case Transition::Change::spreads:
      return EventKind::contact_spreads;
    case Transition::Change::gathers:
      return EventKind::contact_gathers;
    case Transition::Change::splits:
      return EventKind::contact_opens;
    case Transition::Change::joins:
      return EventKind::contact_closes;
    case Transition::Change::remeshed:
    case Transition::Change::continuum:
    case Transition::Change::unsupported:
      break;
  }
  assert(false);
  return EventKind::user;
}

// Whether there is a piece behind, or only a reason to end.
bool leads_on(Transition::Change change) {
  return change != Transition::Change::continuum && change != Transition::Change::unsupported;
}

// Behind none of these a point was found.
BranchEnd end_before(const std::vector<Transition>& transitions) {
  if (transitions.empty() || leads_on(transitions.back().change))
    return {.reason = EndReason::singular, .detail = "behind a change of contact"};
  const Transition& last = transitions.back();
  const bool continuum = last.change == Transition::Change::continuum;
  return {.reason = continuum ? EndReason::continuum : EndReason::unsupported,
          .detail = last.detail,
          .continuum = last.continuum};
}

// Whether the first point on the piece ahead lies a little beyond the corner, with a new stretch of some length.
bool begins_with_length(Transition::Change change) {
  return change == Transition::Change::spreads || change == Transition::Change::splits;
}

}  // namespace

// Leaves a corner by one of its rays; `at` becomes the same point on that ray's piece. False, and the branch ends, if
// there is none.
bool Tracer::turn_corner(PathPoint& at, Index landed, double slack, std::vector<Event>& events) {
  if (standing_ > max_standing) {
    end_ = {.reason = EndReason::no_ray, .detail = "the contacts keep changing at one point; try a finer mesh"};
    return false;
  }
  const PathPoint before = at;
  std::vector<Index> degenerate =
      degenerate_contacts(at.guards, at.state.piece, std::max(options_.guard_tolerance, 2.0 * slack));
  if (landed >= 0 && std::find(degenerate.begin(), degenerate.end(), landed) == degenerate.end())
    degenerate.push_back(landed);
  std::optional<Index> unstable;
  const auto ray = choose(rays_of(system_, at.state, degenerate, options_.corner, corner_), at, unstable);
  if (!ray) return false;
  const State state = system_.with_piece(at.state, ray->piece);
  const Metric metric(system_.weights(ray->piece), metric_.lambda_scale());
  CorrectorResult result = corrector_.inspect(state, metric, ray->direction);
  if (!result.converged()) {
    end_ = {.reason = EndReason::singular, .detail = "behind a change of contact"};
    return false;
  }
  metric_ = metric;
  const double arc = at.arc;
  const int iterations = at.iterations;
  at = point_of(std::move(result), ray->direction);
  decide_count(at);
  at.arc = arc;
  at.iterations = iterations;
  if (!unstable) unstable = held_by(*ray, before.state) == ray->piece ? at.held : count_along(*ray, before.state);
  if (before.held) counter_.remember(before.state, before.held);  // often the strongly closed ones are those of before
  at.count = counter_.count(at.state, at.held);
  if (unstable) at.count.unstable = unstable;
  add_corner_events(before, at, events);
  if (!others_.empty() && points_ > 0) events.push_back(one_sided_branch_point(before, at));
  return true;
}

// Passes from one piece to another at a limit; `at` becomes a point of the piece ahead, or `ahead_` does and `at` stays
// the last point of the piece behind. False, and the branch ends, where nothing can be followed.
bool Tracer::pass_limit(PathPoint& at, Index limit, double slack, std::vector<Event>& events) {
  const double tolerance = std::max(options_.guard_tolerance, 2.0 * slack);
  const std::vector<Transition> transitions = system_.transitions(at.state, at.tangent, limit, tolerance);
  std::optional<PathPoint> after;
  const Transition* entered = enter_any(transitions, at, after);
  if (!entered) {
    end_ = end_before(transitions);
    return false;
  }
  const Transition& transition = *entered;
  Event event{.state = at.state,
              .arc = at.arc,
              .residual = at.residual,
              .unstable_before = after_.unstable,
              .unstable_after = after->count.unstable,
              .guards = transition.contacts};
  if (transition.change == Transition::Change::remeshed) {
    add_turns(*after, event, events);
    at = std::move(*after);
    return pass_shifted_limit(at, events);
  }
  event.kind = kind_of(transition.change);
  const bool grows = begins_with_length(transition.change);
  if (!grows) {
    event.state = after->state;
    event.residual = after->residual;
  }
  events.push_back(event);
  event.guards.clear();
  add_turns(*after, event, events);
  if (grows) {
    held_ = after->held;
    after_ = after->count;
    ahead_ = Arc{.to = std::move(*after), .events = {}};
    return false;
  }
  at = std::move(*after);
  return true;
}

// Limits that are reached together are passed one after the other, and those behind the first may have been shifted
// past their zero by the new mesh.
bool Tracer::pass_shifted_limit(PathPoint& at, std::vector<Event>& events) {
  const auto contacts = static_cast<Index>(at.state.piece.size());
  if (at.guards.size() == contacts) return true;
  Index limit = 0;
  if (at.guards.tail(at.guards.size() - contacts).minCoeff(&limit) >= -options_.guard_tolerance) return true;
  if (++standing_ > max_standing) {
    end_ = {.reason = EndReason::no_ray, .detail = "the mesh keeps changing at one point; try a finer one"};
    return false;
  }
  return pass_limit(at, contacts + limit, 0.0, events);
}

// The first of the transitions behind which a point is found; all are tried again with patience where none is: of a
// nearly perfect structure hardly more than the sum of the lengths of straight contacts is determined, and corrections
// swing before they settle.
const Transition* Tracer::enter_any(const std::vector<Transition>& transitions, const PathPoint& from,
                                    std::optional<PathPoint>& after) {
  for (const Effort effort : {Effort::usual, Effort::patient})
    for (const Transition& transition : transitions) {
      if (!leads_on(transition.change)) break;
      after = enter(transition, from, effort);
      if (after) return &transition;
    }
  return nullptr;
}

// The first point on the piece ahead, with its metric.
std::optional<PathPoint> Tracer::enter(const Transition& transition, const PathPoint& from, Effort effort) {
  constexpr double distance = 0.1;  // a generous guess [path metric]
  constexpr double slack = 1e-6;    // of guards that were near zero on the piece behind, too
  const Metric metric(system_.weights(transition.guess.piece), metric_.lambda_scale());
  const bool oriented = metric.norm(transition.forward) > 0.0;
  const Direction along =
      oriented ? transition.forward : Direction{.dx = Vector::Zero(transition.guess.x.size()), .dlambda = 1.0};
  const auto corrected = [&](const PathConstraint& constraint) {
    return effort == Effort::patient
               ? corrector_.correct_patiently(transition.guess, constraint, metric, along, distance)
               : corrector_.correct(transition.guess, constraint, metric, along, distance);
  };
  CorrectorResult result = transition.quantity ? corrected(ValueConstraint(*transition.quantity, transition.value))
                                               : corrected(PlaneConstraint(metric, transition.guess, along, 0.0));
  last_failure_ = result.status;
  if (!result.converged() || !system_.admissible(result.state, -penetration_tolerance)) return std::nullopt;
  if (transition.change != Transition::Change::remeshed && (system_.guards(result.state).array() < -slack).any())
    return std::nullopt;
  if (transition.quantity && apply(transition.quantity->gradient(result.state), result.tangent) < 0.0)
    result.tangent = reversed(std::move(result.tangent));
  const Direction forward = transition.quantity ? result.tangent : along;
  metric_ = metric;
  PathPoint to = point_of(std::move(result), forward);
  to.arc = from.arc + (begins_with_length(transition.change)
                           ? std::abs(to.state.lambda - from.state.lambda) / metric_.lambda_scale()
                           : 0.0);
  decide_count(to);
  to.count = counter_.count(to.state, to.held);
  return to;
}

// The step's start in the unknowns of a piece whose guards see what the step's end violates; the step is tried again.
void Tracer::refine(const State& violated, double margin) {
  const auto transition = system_.with_inserted_contact(here_.state, here_.tangent, violated, margin);
  if (!transition) return;
  auto here = enter(*transition, here_);
  if (!here) return;
  here->arc = here_.arc;
  go_to(std::move(*here));
  before_.reset();
  held_ = here_.held;
  after_ = here_.count;
  refined_ = true;
}

// Several rays leave: each of those not taken begins a branch of its own.
Event Tracer::one_sided_branch_point(const PathPoint& before, const PathPoint& after) const {
  auto point = std::make_shared<BranchPoint>();
  point->type = BranchType::one_sided;
  point->state = after.state;
  point->along = after.tangent;
  point->discretisation = options_.node_contacts;
  for (const Ray& ray : others_) {
    const Metric metric(system_.weights(ray.piece), metric_.lambda_scale());
    point->rays.push_back({.piece = ray.piece, .direction = unit(metric, ray.direction)});
  }
  return {.kind = EventKind::branch_point,
          .state = after.state,
          .arc = after.arc,
          .residual = before.residual,
          .unstable_before = after_.unstable,
          .unstable_after = after.count.unstable,
          .branching = std::move(point)};
}

// A direction with all contacts open, of unit length: how the structure moves.
Direction Tracer::open_direction(const Direction& direction, const Piece& piece) const {
  const Piece open = piece.all_open();
  const Metric metric(system_.weights(open), metric_.lambda_scale());
  return unit(metric, {.dx = system_.transfer(direction.dx, piece, open), .dlambda = direction.dlambda});
}

// The contacts that hold along a ray: those with a force, and those that get one.
Piece Tracer::held_by(const Ray& ray, const State& corner) const {
  Piece piece = strictly_active(system_, corner, options_.guard_tolerance);
  for (std::size_t j = 0; j < piece.size(); ++j)
    if (ray.loading[j]) piece[j] = 1;
  return piece;
}

std::optional<Index> Tracer::count_along(const Ray& ray, const State& corner) {
  return counter_.negative_on(system_.with_piece(corner, held_by(ray, corner)));
}

// Of the rays that were not taken before: the stable one; of several the one nearest the incoming direction; if none is
// stable, the one with fewest unstable directions that leaves the old piece (docs/theory.md, section 4). `unstable`:
// its count, if there was a choice.
std::optional<Ray> Tracer::choose(std::vector<Ray> rays, const PathPoint& at, std::optional<Index>& unstable) {
  const Piece open = at.state.piece.all_open();
  const Metric metric(system_.weights(open), metric_.lambda_scale());
  const State here = system_.with_piece(at.state, open);
  const Direction incoming = open_direction(at.tangent, at.state.piece);
  const auto way = [&](const Ray& ray) { return open_direction(ray.direction, ray.piece); };

  const auto known = [&](const Visited& v) {
    return std::abs(v.corner.lambda - here.lambda) <= coincidence_tolerance * metric.lambda_scale() &&
           v.corner.piece == here.piece && metric.distance(v.corner, here) <= coincidence_tolerance;
  };
  auto visited = std::find_if(visited_.begin(), visited_.end(), known);
  if (visited == visited_.end()) visited = visited_.insert(visited_.end(), {.corner = here, .ways = {}});
  const bool again = !visited->ways.empty();
  visited->ways.push_back(reversed(incoming));
  std::erase_if(rays, [&](const Ray& ray) {
    const Direction direction = way(ray);
    const auto taken = [&](const Direction& d) { return metric.inner(d, direction) > same_way; };
    return std::any_of(visited->ways.begin(), visited->ways.end(), taken);
  });
  if (rays.empty()) {
    end_ = again ? BranchEnd{.reason = EndReason::closed_loop, .detail = "the branch came back to a change of contact"}
                 : BranchEnd{.reason = EndReason::no_ray, .detail = "no equilibrium leaves the change of contact"};
    return std::nullopt;
  }
  struct Rank {
    bool unstable, continues;  // a continuation of the old piece only where nothing else leaves
    Index count;
    double backward;
    auto operator<=>(const Rank&) const = default;
  };
  if (rays.size() == 1) {
    visited->ways.push_back(way(rays.front()));
    others_.clear();
    return std::move(rays.front());
  }
  std::optional<Ray> best;
  Rank best_rank{};
  int stable = 0;
  std::size_t chosen = 0;
  for (Ray& ray : rays) {
    const std::optional<Index> count = count_along(ray, at.state);
    const Index negative = count.value_or(std::numeric_limits<Index>::max());
    const bool continues = ray.piece == at.state.piece;
    stable += negative == 0;
    const Rank rank{.unstable = negative > 0,
                    .continues = negative > 0 && continues != options_.stay,
                    .count = negative,
                    .backward = -metric.inner(way(ray), incoming)};
    if (best && !(rank < best_rank)) continue;
    best_rank = rank;
    best = ray;
    chosen = static_cast<std::size_t>(&ray - rays.data());
    unstable = count;
  }
  visited->ways.push_back(way(*best));
  rays.erase(rays.begin() + static_cast<std::ptrdiff_t>(chosen));
  if (stable == 1 && !options_.every_ray) rays.clear();  // the path had no choice
  others_ = std::move(rays);
  return best;
}

void Tracer::add_corner_events(const PathPoint& before, const PathPoint& after, std::vector<Event>& events) const {
  Event event{.state = after.state,
              .arc = after.arc,
              .residual = before.residual,
              .localised = 0.0,
              .unstable_before = after_.unstable,
              .unstable_after = after.count.unstable};
  for (const EventKind kind : {EventKind::contact_closes, EventKind::contact_opens}) {
    event.kind = kind;
    event.guards.clear();
    for (std::size_t j = 0; j < after.state.piece.size(); ++j)
      if (before.state.piece[j] != after.state.piece[j] &&
          (after.state.piece[j] != 0) == (kind == EventKind::contact_closes))
        event.guards.push_back(static_cast<Index>(j));
    if (!event.guards.empty()) events.push_back(event);
  }
  if (points_ > 0) add_turns(after, event, events);
}

// λ or a monitor turns at a corner.
void Tracer::add_turns(const PathPoint& after, Event event, std::vector<Event>& events) const {
  const std::vector<int> now = signs_at(after);
  for (std::size_t i = 0; i < detectors_.size(); ++i) {
    if (now[i] * signs_[i] >= 0) continue;
    event.kind = detectors_[i].kind == EventKind::limit_point ? EventKind::contact_limit_point : detectors_[i].kind;
    event.label = detectors_[i].label;
    events.push_back(event);
  }
}

}  // namespace arcwall
