#include "continuation/explorer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "continuation/corners/entered_branch.hpp"
#include "continuation/events/branch_point.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/stability.hpp"
#include "continuation/stops.hpp"
#include "core/nearly_equal.hpp"
#include "core/turns.hpp"

namespace arcwall {

// A way off a branch point that was tried.
struct TriedWay {
  int sign = 1;
  std::optional<EnteredBranch> entered{};  // of one in a corner, in place of `way`
  WayOff way{};
  SteppedOff step{};
  double energy = 0.0;
  StabilityCount count{};
};

namespace {

constexpr double same_branch_point = 1e-6;  // two located branch points in the path metric
constexpr double arriving = 1e-5;           // by so much a branch may end before the branch point that it joins

std::vector<TriedWay> tried_ways(const System& system, const TraceOptions& trace, const BranchPoint& point,
                                 const Metric& metric, double distance) {
  Corrector corrector(system, trace.corrector, std::abs(trace.step.first), trace.factorization);
  StabilityCounter counter(system, corrector.factorized(), trace.guard_tolerance, trace.factorization);
  std::vector<TriedWay> ways;
  for (const int sign : {1, -1}) {
    TriedWay tried{.sign = sign, .way = way_off(metric, point, sign)};
    if (point.at_corner) {
      tried.entered = enter_branch(system, corrector, metric, point, sign, distance, trace.guard_tolerance);
      if (!tried.entered) continue;
      // Mirror images are compared at one distance.
      const double entered_at = tried.entered->distance;
      if (!ways.empty() && entered_at < distance) return tried_ways(system, trace, point, metric, entered_at);
      distance = entered_at;
      tried.step = {.state = tried.entered->first, .distance = tried.entered->distance};
    } else {
      auto step = step_off(system, corrector, metric, point, tried.way, distance, trace.guard_tolerance);
      if (!step) continue;
      tried.step = std::move(*step);
    }
    tried.energy = system.energy(tried.step.state);
    tried.count = counter.count(tried.step.state, std::nullopt);
    ways.push_back(std::move(tried));
  }
  return ways;
}

bool enters_a_wall(const System& system, const State& state) {
  const Vector guards = system.guards(state);
  const auto contacts = static_cast<Index>(state.active_set.contacts());
  return (guards.head(contacts).array() < 0.0).any() || system.penetrated_place(state, 0.0);
}

// How far along a direction the first wall is entered, of its length; 0 if none is.
double distance_to_wall(const System& system, const State& from, const Direction& along) {
  constexpr double nearest = 1e-4, growth = 1.25;
  for (double s = nearest; s <= 1.0; s *= growth) {
    if (!enters_a_wall(system, moved(from, along, s))) continue;
    double free = s / growth, inside = s;
    while (inside - free > 0.1 * same_value * inside)
      (enters_a_wall(system, moved(from, along, 0.5 * (free + inside))) ? inside : free) = 0.5 * (free + inside);
    return inside;
  }
  return 0.0;
}

// Whether the walls and the energy far along a mode are those far against it. Beside the point all walls that are not
// touched yet, and laws of springs, are symmetric.
bool mirrored_far_away(const System& system, const Metric& metric, const State& a, const State& b) {
  constexpr double alike = 1e-6;  // relative difference: branch points are located to 1e-8
  if (a.active_set != b.active_set) return true;
  const Direction across = difference(a, b);
  const State middle = moved(b, across, 0.5);
  const Direction to = unit(metric, across), back = reversed(to);
  const auto same_energy = [&](double s) {
    return equal_within(alike, system.energy(moved(middle, to, s)), system.energy(moved(middle, back, s)));
  };
  return equal_within(alike, distance_to_wall(system, middle, to), distance_to_wall(system, middle, back)) &&
         same_energy(0.01) && same_energy(0.1) && same_energy(1.0);
}

// Both sides of a symmetric branch point at the same distance have the same load and energy.
bool mirror_images(const System& system, const Metric& metric, const std::vector<TriedWay>& ways) {
  if (ways.size() != 2) return false;
  const State &a = ways[0].step.state, &b = ways[1].step.state;
  return nearly_equal(a.lambda, b.lambda) && nearly_equal(ways[0].energy, ways[1].energy) &&
         mirrored_far_away(system, metric, a, b);
}

// Whether the structure follows a way off a stable branch, along which λ goes on as the load does: else it jumps.
bool is_followed(const BranchPoint& point, const TriedWay& way, double first_step) {
  return way.count.unstable == Index{0} && (way.step.state.lambda - point.state.lambda) * first_step > 0.0;
}

// The event at which a stable structure loses its stability; of several the one at which λ turns or branches meet.
const Event* loss_of_stability(const std::vector<Event>& events) {
  const Event* found = nullptr;
  for (const Event& event : events) {
    const bool is_inside = event.kind != EventKind::start && event.kind != EventKind::end && !event.unconfirmed;
    if (!is_inside || event.unstable_before != Index{0} || event.unstable_after.value_or(0) == 0) continue;
    const bool singular = event.kind == EventKind::limit_point || event.kind == EventKind::contact_limit_point ||
                          event.kind == EventKind::branch_point;
    if (found == nullptr || singular) found = &event;
  }
  return found;
}

// No farther than where the way is known to be free: the first step must not find a wall ahead, for whose sake its
// start, at which K is singular, would be described anew.
BranchStart start_along(const Event& event, const TriedWay& tried) {
  const BranchPoint& point = *event.branching;
  if (tried.entered) return {.state = event.state, .entered = tried.entered};
  BranchStart start{.state = point.state};
  start.state.active_set = tried.step.state.active_set;
  start.forward = tried.way.forward;
  start.mode = tried.way.across;
  start.distance = tried.step.distance;
  return start;
}

BranchStart start_along(const System& system, const Event& event, const BranchPoint::Way& way, double distance) {
  BranchStart start{.state = system.with_active_set(event.branching->state, way.active_set), .distance = distance};
  start.forward = start.mode = way.direction;
  return start;
}

// Layouts that were made on other branches mean other unknowns, in which a place cannot be found again; it has its
// load, its energy and its contacts, and so has its mirror image.
bool is_same_on_another_layout(const System& system, const State& a, const State& b) {
  return a.active_set.layout() != b.active_set.layout() && a.active_set.closed_count() == b.active_set.closed_count() &&
         nearly_equal(a.lambda, b.lambda) && nearly_equal(system.energy(a), system.energy(b));
}

bool is_known(const System& system, const std::vector<KnownPoint>& known, const BranchPoint& point,
              const Metric& metric) {
  return std::any_of(known.begin(), known.end(), [&](const KnownPoint& other) {
    if (other.state.active_set == point.state.active_set)
      return metric.distance(turned_towards(system, point.state, other.state), point.state) <= same_branch_point;
    return is_same_on_another_layout(system, other.state, point.state);
  });
}

}  // namespace

std::optional<int> preferred_sense(const std::vector<std::shared_ptr<const Observable>>& preference, const State& state,
                                   const Vector& direction, const Metric& metric) {
  constexpr double changes = 1e-6;  // of the distance stepped
  for (const auto& quantity : preference) {
    const Row row = quantity->gradient(state);
    const double norm = metric.dual_norm(row);
    const double rate = norm > 0.0 ? row.dx.dot(direction) / norm : 0.0;
    if (std::abs(rate) > changes) return rate > 0.0 ? 1 : -1;
  }
  return std::nullopt;
}

Explorer::Explorer(const System& system, State start, TraceOptions trace, std::vector<Watch> watched,
                   ExploreOptions options)
    : system_(system), trace_(std::move(trace)), watched_(std::move(watched)), options_(std::move(options)) {
  trace_.every_direction = trace_.every_direction || options_.policy == BranchPolicy::all;
  queue_.push_back({.start = {.state = std::move(start)}, .record = {}});
}

std::optional<Explorer::Step> Explorer::next() {
  std::optional<BranchEnd> ends;
  for (;;) {
    if (stopped_) return std::nullopt;
    if (lost_ && !not_left_ && !tracer_->end()) jump(*lost_);
    if (!tracer_) {
      if (queue_.empty()) return std::nullopt;
      Queued queued = std::move(queue_.front());
      queue_.pop_front();
      current_ = static_cast<int>(branches_.size());
      queued.record.id = current_;
      queued.start.known = known_;
      branches_.push_back(queued.record);
      ends = std::move(queued.ends);
      tracer_ = make_tracer(std::move(queued.start));
    }
    if (auto arc = tracer_->next()) {
      lambda_scale_ = tracer_->lambda_scale();
      if (ends) tracer_->stop(*ends);
      if (not_left_) look_behind(*std::exchange(not_left_, std::nullopt), *arc);
      for (const Event& event : arc->events)
        if (event.branching) look_at(event);
      look_for_loss(*arc);
      return Step{.branch = current_, .arc = std::move(*arc)};
    }
    branches_[static_cast<std::size_t>(current_)].end = tracer_->end();
    if (const auto& end = tracer_->end(); end->reason == EndReason::reached_branch && end->partner)
      drop_arrived_at(*end->partner);
    tracer_.reset();
    not_left_.reset();
    lost_.reset();
    was_stable_ = false;
  }
}

void Explorer::begin_at(State found, int sense) {
  queue_.push_back(
      {.start = {.state = std::move(found), .sense = sense, .lambda_scale = lambda_scale_}, .record = {.found = true}});
}

// Of the branch under way.
std::unique_ptr<Tracer> Explorer::make_tracer(BranchStart start) const {
  TraceOptions options = trace_;
  options.stay = options.stay || here().found;
  return std::make_unique<Tracer>(system_, std::move(start), std::move(options), watched_);
}

void Explorer::stop(const BranchEnd& end) {
  if (tracer_) branches_[static_cast<std::size_t>(current_)].end = tracer_->end().value_or(end);
  stopped_ = true;
}

// A branch point was located on the branch under way: decide who goes on.
void Explorer::look_at(const Event& event) {
  const BranchPoint& point = *event.branching;
  if (event.unconfirmed) return;
  if (!system_.slipping(point.state.active_set).empty()) return;  // a mode would have to slip against its friction
  const Metric metric(system_.weights(point.state.active_set), lambda_scale_);
  if (is_known(system_, known_, point, metric)) return;
  known_.push_back({.state = point.state, .branch = current_});
  if (tracer_->end() && tracer_->end()->reason == EndReason::stop) return;
  if (options_.policy == BranchPolicy::primary || point.multiplicity > 1 || point.mesh_artefact) return;
  if (point.ways.empty() && point.mode.dx.size() == 0) return;
  if (options_.policy == BranchPolicy::all && here().depth >= options_.depth) return;
  const bool mirror_ahead = point.ends_its_own_branch();
  if (!point.ways.empty() && !mirror_ahead) {
    if (takes_every_way())
      for (const BranchPoint::Way& way : point.ways)
        enqueue(event, start_along(system_, event, way, options_.distance), 1, false);
    return;  // the tracer has taken the one that `most_stable` or `jump` wants
  }
  const bool ahead_is_stable = event.unstable_after == Index{0} && !mirror_ahead;
  const bool nothing_is_known = system_.counted_directions(point.state.active_set) == CountedDirections::some;
  if (!takes_every_way() && (ahead_is_stable || nothing_is_known)) return;

  const std::vector<TriedWay> ways = tried_ways(system_, trace_, point, metric, options_.distance);
  if (!ways.empty())
    leave(event, point, ways);
  else if (!point.at_corner)
    not_left_ = event;
  else
    stop_unstable();
}

// A branch point that no step leaves, and the next arc. The branch may begin in a corner right behind it, where
// contact spreads: in the continuum both are one place.
void Explorer::look_behind(const Event& event, const Arc& arc) {
  constexpr double of_mesh = 1e-3;  // between a branch point and a corner that are one but for the mesh [path metric]
  const State& before = event.branching->state;
  const bool spreads = std::any_of(arc.events.begin(), arc.events.end(), [&](const Event& next) {
    const bool grows = next.kind == EventKind::contact_spreads || next.kind == EventKind::contact_splits;
    return grows && next.state.active_set == before.active_set &&
           Metric(system_.weights(before.active_set), lambda_scale_).distance(next.state, before) <= of_mesh;
  });
  const PathPoint& behind = tracer_->here();
  if (!spreads || tracer_->end() || behind.state.active_set == before.active_set) return stop_unstable();
  const Metric metric(system_.weights(behind.state.active_set), lambda_scale_);
  Corrector corrector(system_, trace_.corrector, std::abs(trace_.step.first), trace_.factorization);
  BranchPoint corner = branch_point_before(system_, corrector, metric, behind);
  corner.at_corner = true;
  std::vector<TriedWay> ways;
  if (corner.mode.dx.size() > 0) ways = tried_ways(system_, trace_, corner, metric, options_.distance);
  if (ways.empty()) return stop_unstable();
  leave(event, corner, ways);
}

// Who wants the stable way is told that none was found.
void Explorer::stop_unstable() {
  if (!takes_every_way() && !tracer_->end() && !lost_)
    tracer_->stop({.reason = EndReason::min_step,
                   .detail = "the path is unstable beyond a branch point, and switching to the other branch failed"});
}

// Where the structure is to jump, it leaves a branch that loses its stability before the next arc: what leads off a
// branch point may be found one arc later.
void Explorer::look_for_loss(const Arc& arc) {
  if (options_.policy != BranchPolicy::jump || takes_every_way() || tracer_->end() || lost_) return;
  if (const Event* const lost = loss_of_stability(arc.events))
    lost_ = *lost;
  else if (was_stable_ && arc.to.count.stability == Stability::unstable)
    tracer_->stop({.reason = EndReason::unstable,
                   .detail = "the structure became unstable before this point, at no event that says where"});
  was_stable_ = was_stable_ || arc.to.count.stability == Stability::stable;
}

// At constant λ, which then goes on as it did.
void Explorer::jump(const Event& lost) {
  JumpEnd end = options_.jump(lost, tracer_->here());
  if (!end.state) return tracer_->stop({.reason = EndReason::unstable, .detail = std::move(end.why_none)});
  const auto next = static_cast<int>(branches_.size());
  auto ends = stop_at_bounds(trace_, lost.state, *end.state);
  if (!ends) ends = stop_at_contacts(trace_, lost.state.active_set, end.state->active_set);
  queue_.push_front({.start = {.state = std::move(*end.state), .lambda_scale = lambda_scale_},
                     .record = {.parent = current_, .depth = here().depth, .after_jump = true},
                     .ends = std::move(ends)});
  tracer_->stop({.reason = EndReason::jumped, .detail = detail_of_partner(EndReason::jumped, next), .partner = next});
}

// Decides which of the ways off a branch point are traced. `point` is where they leave: that of the event, or a corner
// right behind it.
void Explorer::leave(const Event& event, const BranchPoint& point, const std::vector<TriedWay>& ways) {
  const Metric metric(system_.weights(point.state.active_set), lambda_scale_);
  const bool mirror_ahead = point.ends_its_own_branch();
  const bool mirror_image = mirror_images(system_, metric, ways);
  const int preferred = preferred_sense(options_.preference, point.state, point.other.dx, metric)
                            .value_or(ways.front().sign);  // along the mode, whose largest component is positive
  if (takes_every_way()) {
    for (const TriedWay& way : ways)
      if (!mirror_image || way.sign == preferred) enqueue(event, start_along(event, way), way.sign, mirror_image);
    if (mirror_ahead)
      tracer_->stop(
          {.reason = EndReason::reached_branch, .detail = "joins the branch from which it and its mirror image leave"});
    return;
  }
  // `most_stable` and `jump`: the way with fewest unstable directions; of equals the preferred side
  const auto rank = [&](const TriedWay& way) {
    return std::pair(way.count.unstable.value_or(std::numeric_limits<Index>::max()), way.sign == preferred ? 0 : 1);
  };
  const TriedWay& best = *std::min_element(ways.begin(), ways.end(),
                                           [&](const TriedWay& a, const TriedWay& b) { return rank(a) < rank(b); });
  if (options_.policy == BranchPolicy::jump && event.unstable_before == Index{0} &&
      !is_followed(point, best, trace_.step.first))
    return;
  enqueue(event, start_along(event, best), best.sign, mirror_image);
  const auto next = static_cast<int>(branches_.size());
  tracer_->stop({.reason = EndReason::switched_branch,
                 .detail = detail_of_partner(EndReason::switched_branch, next),
                 .partner = next});
}

void Explorer::enqueue(const Event& event, BranchStart start, int sign, bool mirror_image) {
  start.lambda_scale = lambda_scale_;
  queue_.push_back({.start = std::move(start),
                    .record = {.parent = current_,
                               .origin = event.branching,
                               .depth = here().depth + 1,
                               .sign = sign,
                               .mirror_image = mirror_image}});
}

// The branch under way ended at a branch point of this other one: the way off that point by which it came, or whose
// mirror image it came, is traced already.
void Explorer::drop_arrived_at(int other) {
  if (!tracer_->before()) return;
  const State &last = tracer_->here().state, &before = tracer_->before()->state;
  const Metric metric(system_.weights(last.active_set), lambda_scale_);
  const Direction step = difference(last, before);
  std::erase_if(queue_, [&](const Queued& queued) {
    if (queued.record.parent != other || queued.start.state.active_set != last.active_set || !queued.start.forward)
      return false;
    const State point = turned_towards(system_, last, queued.start.state);
    const Direction arrival = difference(point, before);
    const double length = metric.norm(arrival);
    if (length > metric.norm(step) + arriving) return false;  // not in this step
    const double cosine = metric.inner(arrival, *queued.start.forward) / length;
    return cosine < -0.5 || (queued.record.mirror_image && cosine > 0.5);
  });
}

}  // namespace arcwall
