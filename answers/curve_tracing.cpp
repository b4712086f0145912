#include "answers/curve_tracing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "model/checkpoint/archive.hpp"
#include "model/checkpoint/parts.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/value.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

constexpr double steps_of_range = 100.0, longest_step = 0.04;  // of a curve [path metric]

// Reports all that is wrong.
deck::DeckNumber number_that_varies(const deck::Deck& deck) {
  const Model checked(deck);
  require_curve(deck);
  return std::get<deck::DeckNumber>(deck::number_of(deck, deck.curve->parameter));
}

// At a cusp the critical eigenvalue's rate along the path vanishes, too, and what tells a second mode with it.
void drop_crossings_at_cusps(EventCurve& curve) {
  constexpr double near = 1e-3;  // [path metric]
  const auto is_at_cusp = [&](const CurveSpecial& one) {
    return one.kind == CurveSpecialKind::crossing &&
           std::any_of(curve.specials.begin(), curve.specials.end(), [&](const CurveSpecial& other) {
             return other.kind == CurveSpecialKind::cusp &&
                    std::abs(curve.points[other.point].arc - curve.points[one.point].arc) <= near;
           });
  };
  std::vector<CurveSpecial> left;
  for (CurveSpecial& special : curve.specials)
    if (!is_at_cusp(special)) left.push_back(special);
  curve.specials = std::move(left);
}

EventCurve described(const deck::Deck& deck, const Model& model, const deck::DeckNumber& number) {
  EventCurve curve{.deck = deck.source.file.substr(deck.source.file.rfind('/') + 1),
                   .title = deck.title,
                   .key = deck.curve->parameter,
                   .key_unit = deck::unit_text(number.unit, deck.units),
                   .event = deck.curve->event,
                   .number = deck.curve->number,
                   .own_value = number.value};
  for (const MonitorColumn& column : model.monitors())
    curve.columns.push_back({column.name, column.unit, column.roundoff});
  return curve;
}

// Both sides begin at the same point, which is once in the curve.
template <typename Side>
void join(Side low, Side high, EventCurve& curve) {
  const std::size_t before = low.points.empty() ? 0 : low.points.size() - 1;
  const double length = low.points.empty() ? 0.0 : low.points.back().arc;
  for (std::size_t i = low.points.size(); i-- > (high.points.empty() ? 0 : 1);) {
    low.points[i].arc = length - low.points[i].arc;
    curve.points.push_back(std::move(low.points[i]));
  }
  for (CurvePoint& point : high.points) {
    point.arc += length;
    curve.points.push_back(std::move(point));
  }
  for (CurveSpecial& special : low.specials) {
    special.point = before - special.point;
    curve.specials.push_back(std::move(special));
  }
  for (CurveSpecial& special : high.specials) {
    special.point += before;
    curve.specials.push_back(std::move(special));
  }
  std::stable_sort(curve.specials.begin(), curve.specials.end(),
                   [](const CurveSpecial& a, const CurveSpecial& b) { return a.point < b.point; });
  drop_crossings_at_cusps(curve);
}

}  // namespace

CurveTracing::CurveTracing(const deck::Deck& deck)
    : deck_(deck),
      number_(number_that_varies(deck)),
      family_(deck, number_),
      hunt_(std::make_unique<EventHunt>(family_.own(), deck.curve->event, deck.curve->number)) {}

CurveTracing::~CurveTracing() = default;

// --- the event of the path ------------------------------------------------------------------------------------------

namespace {

bool is_watched(EventKind kind) { return kind == EventKind::turning_point || kind == EventKind::value_crossing; }

}  // namespace

void CurveTracing::take_event(const FoundEvent& found) {
  const auto event = followed(family_.own().system(), found, problem_);
  if (!event) return;
  const double first = std::abs(family_.own().options().step.first);
  followed_ = {.event = *event,
               .watched = is_watched(asked().event) ? found.event.label : "",
               .lambda_scale = std::max(std::abs(found.event.state.lambda), first),
               .counts = {found.event.unstable_before, found.event.unstable_after}};
  make_system();
  auto start = system_->of_event(found.event.state, number_.value);
  if (start)
    start_ = std::move(*start);
  else
    problem_ = "the equations are singular at the event";
}

void CurveTracing::make_system() {
  if (!followed_.watched.empty()) family_.set_watched(followed_.watched);
  system_ = std::make_unique<EventSystem>(family_, followed_.event, followed_.lambda_scale,
                                          family_.own().options().factorization);
  reader_ = std::make_unique<CurveReader>(family_, *system_);
}

// --- the curve ------------------------------------------------------------------------------------------------------

bool CurveTracing::has_room(Stage stage) const {
  return stage == Stage::less ? number_.value > asked().range[0] : number_.value < asked().range[1];
}

TraceOptions CurveTracing::trace_options() const {
  const double width = asked().range[1] - asked().range[0];
  TraceOptions options;
  options.factorization = family_.own().options().factorization;
  options.step.first = sign() * asked().step.value_or(width / steps_of_range);
  options.step.max = longest_step;
  options.step.max_lambda = longest_step * width;
  options.lambda_scale = width;
  options.max_points = asked().max_points;
  const auto key = std::make_shared<ParameterValue>();
  for (const double bound : asked().range)
    options.target_values.push_back({.quantity = key, .value = bound, .stops = true, .label = "range"});
  for (const double value : asked().output_at)
    if (value != asked().range[0] && value != asked().range[1])
      options.target_values.push_back({.quantity = key, .value = value});
  const double scale = std::abs(reader_->crossing_value(start_));
  // Each point is asked about several times, as the end of one step and the start of the next.
  const auto known = std::make_shared<std::array<std::pair<State, double>, 2>>();
  const auto value = [this, scale, known](const PathPoint& point) {
    for (const auto& [state, found] : *known)
      if (state == point.state) return found;
    std::swap((*known)[0], (*known)[1]);
    (*known)[0] = {point.state, reader_->crossing_value(point.state) / scale};
    return (*known)[0].second;
  };
  if (scale > 0.0) options.detectors.push_back({.kind = EventKind::user, .label = "crossing", .value = value});
  return options;
}

void CurveTracing::go_on_to(Stage stage) {
  while (stage != Stage::ended && !has_room(stage)) stage = stage == Stage::less ? Stage::greater : Stage::ended;
  stage_ = stage;
  if (stage == Stage::ended) return;
  counts_ = followed_.counts;
  family_.recall_problem({});
  tracer_ = std::make_unique<Tracer>(*system_, start_, trace_options());
}

bool CurveTracing::advance() {
  if (stage_ == Stage::path && !stopped_) {
    if (hunt_->advance()) return true;
    problem_ = hunt_->problem();
    if (const auto& found = hunt_->found()) take_event(*found);
    go_on_to(problem_.empty() ? Stage::less : Stage::ended);
    hunt_.reset();
  }
  while (stage_ != Stage::ended && !stopped_) {
    if (advance_side()) return true;
    go_on_to(stage_ == Stage::less ? Stage::greater : Stage::ended);
  }
  return false;
}

// One more point of the side under way.
bool CurveTracing::advance_side() {
  const auto arc = tracer_->next();
  if (!arc) {
    if (!side().points.empty()) add_end(side(), *tracer_->end(), sign());
    tracer_.reset();
    return false;
  }
  CurvePoint point = reader_->read_off(arc->to, counts_);
  for (const Event& event : arc->events)
    if (event.kind == EventKind::limit_point || event.kind == EventKind::user)
      side().specials.push_back(special(event, side().points.size()));
  if (!arc->events.empty() && arc->events.back().kind == EventKind::limit_point) {
    point.slope.reset();
    for (std::optional<double>& slope : point.slopes) slope.reset();
  }
  side().points.push_back(std::move(point));
  return true;
}

void CurveTracing::stop(const BranchEnd& end) {
  if (!has_ended()) stopped_ = end;
}

CurveSpecial CurveTracing::special(const Event& event, std::size_t point) const {
  if (event.kind == EventKind::limit_point)
    return {.kind = CurveSpecialKind::cusp, .point = point, .why = "the number turns"};
  const bool contact = system_->event().criterion == Criterion::guard;
  return {.kind = CurveSpecialKind::crossing,
          .point = point,
          .why = contact ? "a limit point meets the change of contact" : "a second mode is critical"};
}

void CurveTracing::add_end(Side& side, const BranchEnd& end, double sign) const {
  const std::size_t last = side.points.size() - 1;
  CurveSpecial special{.kind = sign > 0.0 ? CurveSpecialKind::ends : CurveSpecialKind::begins,
                       .point = last,
                       .why = end.detail,
                       .reason = end.reason};
  const bool deck_is_wrong = !family_.problem().empty() && end.reason != EndReason::stop &&
                             end.reason != EndReason::max_points && end.reason != EndReason::max_time &&
                             end.reason != EndReason::interrupted;
  if (end.reason == EndReason::stop) special.why = "the range ends";
  if (end.reason == EndReason::not_modelled && !end.detail.empty() && !deck_is_wrong) {
    side.specials.push_back({.kind = CurveSpecialKind::crossing, .point = last, .why = end.detail});
    special.reason = EndReason::stop;
  }
  if (deck_is_wrong) special.why += fmt::format(" (beyond: {})", family_.problem());
  side.specials.push_back(std::move(special));
}

// --- what it came to ------------------------------------------------------------------------------------------------

EventCurve CurveTracing::curve() const {
  EventCurve curve = described(deck_, family_.own(), number_);
  curve.problem = problem_;
  if (stage_ == Stage::path && stopped_) curve.problem = "stopped before the event was found";
  if (!curve.problem.empty()) return curve;
  Side less = less_, greater = greater_;
  if (stopped_ && tracer_) {
    Side& of = stage_ == Stage::less ? less : greater;
    if (!of.points.empty()) add_end(of, *stopped_, sign());
  }
  join(std::move(less), std::move(greater), curve);
  if (curve.points.empty())
    curve.problem = !family_.problem().empty() ? family_.problem()
                    : stopped_                 ? "stopped at the event"
                               : "the event's equations are singular: it does not move with this number alone";
  else
    add_ends(curve);
  return curve;
}

// Where the deck's own value is a bound of the range, or the side beyond it was not begun.
void CurveTracing::add_ends(EventCurve& curve) const {
  const auto has = [&](CurveSpecialKind kind) {
    return std::any_of(curve.specials.begin(), curve.specials.end(),
                       [&](const CurveSpecial& one) { return one.kind == kind; });
  };
  const auto end = [&](CurveSpecialKind kind, Stage stage, std::size_t point) {
    if (stopped_ && has_room(stage))
      return CurveSpecial{.kind = kind, .point = point, .why = stopped_->detail, .reason = stopped_->reason};
    return CurveSpecial{.kind = kind, .point = point, .why = "the range ends", .reason = EndReason::stop};
  };
  if (!has(CurveSpecialKind::begins))
    curve.specials.insert(curve.specials.begin(), end(CurveSpecialKind::begins, Stage::less, 0));
  if (!has(CurveSpecialKind::ends))
    curve.specials.push_back(end(CurveSpecialKind::ends, Stage::greater, curve.points.size() - 1));
}

// --- keeping it -----------------------------------------------------------------------------------------------------

constexpr std::int64_t greatest(Criterion) { return static_cast<std::int64_t>(Criterion::crossing); }
constexpr std::int64_t greatest(CurveSpecialKind) { return static_cast<std::int64_t>(CurveSpecialKind::crossing); }

// Without what pictures show, which follows from the state.
template <typename Archive>
void parts(Archive& archive, CurvePoint& point) {
  archive(point.arc, point.key, point.lambda, point.monitors, point.slope, point.slopes, point.unstable_before,
          point.unstable_after, point.contacts, point.state);
}

template <typename Archive>
void parts(Archive& archive, CurveSpecial& special) {
  archive(special.kind, special.point, special.why, special.reason);
}

template <typename Archive>
void CurveTracing::Followed::serialize(Archive& archive) {
  archive(event.criterion, event.guards, event.value, watched, lambda_scale, counts.before, counts.after);
}

// That points and specials belong together, and what follows from the points alone.
bool CurveTracing::complete(Side& side) const {
  const std::size_t monitors = family_.own().monitors().size();
  for (CurvePoint& point : side.points) {
    const auto member = family_.at(point.key, point.state);
    if (!member || point.monitors.size() != monitors || point.slopes.size() != monitors) return false;
    add_scenery(*family_.model(point.key), member->state, point);
  }
  return std::all_of(side.specials.begin(), side.specials.end(),
                     [&](const CurveSpecial& special) { return special.point < side.points.size(); });
}

template <typename Archive>
void CurveTracing::visit(Archive& archive) {
  auto stage = static_cast<Index>(stage_);
  archive(stage, problem_);
  archive.require(stage >= 0 && stage <= static_cast<Index>(Stage::ended));
  stage_ = static_cast<Stage>(stage);
  if (stage_ == Stage::path) return hunt_->serialize(archive);
  if (!problem_.empty()) return archive.require(has_ended());
  archive(followed_);
  if constexpr (Archive::reads) {
    archive.require(followed_.lambda_scale > 0.0);
    make_system();
    hunt_.reset();
  }
  archive.set_event(system_.get());
  std::string beyond = family_.problem();
  archive(start_, less_, greater_, counts_.before, counts_.after, beyond);
  if constexpr (Archive::reads) archive.require(has_event(start_) && complete(less_) && complete(greater_));
  if (!has_ended()) {
    if constexpr (Archive::reads) tracer_ = std::make_unique<Tracer>(*system_, start_, trace_options());
    tracer_->serialize(archive);
  }
  if constexpr (Archive::reads) family_.recall_problem(std::move(beyond));
}

// Whether a state read is one of the curve's, with the guards that vanish there.
bool CurveTracing::has_event(const State& state) const {
  const Index guards = system_->guard_count(state.active_set);
  const auto& list = followed_.event.guards;
  return system_->at(state).has_value() && (followed_.event.criterion != Criterion::guard || !list.empty()) &&
         std::all_of(list.begin(), list.end(), [&](Index j) { return j >= 0 && j < guards; });
}

void CurveTracing::serialize(ArchiveWriter& archive) { visit(archive); }
void CurveTracing::serialize(ArchiveReader& archive) { visit(archive); }

}  // namespace arcwall
