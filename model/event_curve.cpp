#include "model/event_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "continuation/answers/event_system.hpp"
#include "continuation/step/corrector.hpp"
#include "continuation/tracer.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/value.hpp"
#include "model/deck_family.hpp"
#include "model/event_names.hpp"
#include "model/find_event.hpp"

namespace arcwall {

namespace {

constexpr double vanishing = 1e-8;  // guards below this are zero at the event, which is landed on
constexpr double beside = 1e-4;     // of a point, where eigenvalues are counted [path metric]
constexpr double steps_of_range = 100.0, longest_step = 0.04;  // of a curve [path metric]

// --- the event of the traced path -----------------------------------------------------------------------------------

bool is_at_change(const FoundEvent& found) {
  return std::any_of(found.arc.events.begin(), found.arc.events.end(), [](const Event& one) {
    return changes_contact(one.kind) || one.kind == EventKind::contact_limit_point;
  });
}

// What changes contact there, the fastest along the path first.
std::vector<Index> vanishing_guards(const System& system, const FoundEvent& found) {
  const State& state = found.event.state;
  const Vector guards = system.guards(state);
  std::vector<Index> list;
  for (Index j = 0; j < guards.size(); ++j)
    if (std::abs(guards[j]) <= vanishing) list.push_back(j);
  if (found.arc.to.tangent.dx.size() != state.x.size() || list.size() < 2) return list;
  const Vector rates = system.guard_rates(state, found.arc.to.tangent).cwiseAbs();
  std::stable_sort(list.begin(), list.end(), [&](Index a, Index b) { return rates[a] > rates[b]; });
  return list;
}

// How the event is followed, or why it is not.
std::optional<FollowedEvent> followed(const System& system, const FoundEvent& found, std::string& problem) {
  const auto refuse = [&](const char* why) {
    problem = why;
    return std::optional<FollowedEvent>();
  };
  const Event& event = found.event;
  if (event.suspected) return refuse("the event is only suspected");
  const bool at_change = is_at_change(found);
  if (event.kind == EventKind::branch_point) {
    const BranchPoint& point = *event.branching;
    if (at_change || point.modes.empty())
      return refuse("several ways leave a change of contact there: follow that change");
    if (point.multiplicity > 1) return refuse("several modes are critical at once");
    return FollowedEvent{.criterion = Criterion::crossing};
  }
  if (at_change) {
    FollowedEvent contact{.criterion = Criterion::guard, .guards = vanishing_guards(system, found)};
    if (contact.guards.empty())
      return refuse("what changes there is not met to the last digit, since the mesh changes with it");
    return contact;
  }
  const bool crosses = std::any_of(found.arc.events.begin(), found.arc.events.end(),
                                   [](const Event& one) { return one.branching != nullptr; });
  if (crosses && event.kind == EventKind::limit_point) return refuse("several modes are critical at once");
  return FollowedEvent{.criterion = Criterion::turning};
}

// --- what is read off a point ---------------------------------------------------------------------------------------

// Negative eigenvalues and the two nearest zero, a little way along a direction.
class Beside {
 public:
  Beside(const SystemFamily::Member& at, Metric metric, const MakeFactorization& make)
      : at_(at), metric_(std::move(metric)), corrector_(*at.system, {}, metric_.lambda_scale(), make) {}

  std::optional<Index> count(const Direction& along, double distance) {
    const State here = moved(at_.state, along, distance);
    const CorrectorResult result = corrector_.inspect(here, metric_, along);
    if (!result.converged()) return std::nullopt;
    return result.negative ? result.negative : corrector_.count_here(here, result.nearest);
  }

  // (−1)ⁿ |μ₁ μ₂|, with n negative eigenvalues and the two nearest zero: continuous where these change places with
  // others.
  std::optional<double> nearest_product(const Direction& along, double distance) {
    const auto negative = count(along, distance);
    const auto pairs = corrector_.near_null(moved(at_.state, along, distance), metric_.weights(), 2);
    if (!negative || !pairs || pairs->values.size() < 2) return std::nullopt;
    return (*negative % 2 == 0 ? 1.0 : -1.0) * std::abs(pairs->values[0] * pairs->values[1]);
  }

 private:
  const SystemFamily::Member& at_;
  Metric metric_;
  Corrector corrector_;
};

// Zero where a second mode is critical: along the path that product falls by the critical eigenvalue's rate times the
// second eigenvalue. Where a contact changes, the rate of λ along the path.
double crossing_value(const EventSystem& system, const State& state, const MakeFactorization& make) {
  const auto member = system.at(state);
  const auto along = member ? system.along_path(state, *member) : std::nullopt;
  if (!along) return std::nan("");
  const Metric metric = system.metric_of(*member);
  if (system.event().criterion == Criterion::guard) return along->dlambda / metric.lambda_scale();
  if (member->turning) return 1.0;
  Beside sides(*member, metric, make);
  const auto before = sides.nearest_product(*along, -beside), after = sides.nearest_product(*along, beside);
  return before && after ? (*after - *before) / (2.0 * beside) : std::nan("");
}

// Traces the curve from the deck's own value to both sides.
class CurveTrace {
 public:
  CurveTrace(const DeckFamily& family, const EventSystem& system, const deck::EventToFollow& curve, State start,
             const std::function<bool()>& stopped)
      : family_(family), system_(system), curve_(curve), start_(std::move(start)), stopped_(stopped) {}

  // Points outwards from the start, which is the first, with specials by their number.
  struct Side {
    std::vector<CurvePoint> points{};
    std::vector<CurveSpecial> specials{};
  };

  Side side(double sign, std::pair<std::optional<Index>, std::optional<Index>> counts) {
    Side side;
    family_.forget_problem();
    const TraceOptions options = trace_options(sign);
    Tracer tracer(system_, start_, options);
    while (const auto arc = tracer.next()) {
      CurvePoint point = read_off(arc->to, counts);
      for (const Event& event : arc->events)
        if (event.kind == EventKind::limit_point || event.kind == EventKind::user)
          side.specials.push_back(special(event, side.points.size()));
      if (!arc->events.empty() && arc->events.back().kind == EventKind::limit_point) point.slope.reset();
      side.points.push_back(std::move(point));
      if (stopped_ && stopped_()) tracer.stop({.reason = EndReason::interrupted, .detail = "stopped"});
    }
    if (!side.points.empty()) add_end(side, *tracer.end(), sign);
    return side;
  }

 private:
  TraceOptions trace_options(double sign) const {
    const double width = curve_.range[1] - curve_.range[0];
    const TraceOptions& of_path = family_.own().options();
    TraceOptions options;
    options.factorization = of_path.factorization;
    options.step.first = sign * curve_.step.value_or(width / steps_of_range);
    options.step.max = longest_step;
    options.lambda_scale = width;
    options.max_points = curve_.max_points;
    const auto key = std::make_shared<ParameterValue>();
    for (const double bound : curve_.range)
      options.target_values.push_back({.quantity = key, .value = bound, .stops = true, .label = "range"});
    for (const double value : curve_.land)
      if (value != curve_.range[0] && value != curve_.range[1])
        options.target_values.push_back({.quantity = key, .value = value});
    const double scale = std::abs(crossing_value(system_, start_, of_path.factorization));
    // Each point is asked about several times, as the end of one step and the start of the next.
    const auto known = std::make_shared<std::array<std::pair<State, double>, 2>>();
    const auto value = [this, scale, known](const PathPoint& point) {
      for (const auto& [state, found] : *known)
        if (state == point.state) return found;
      std::swap((*known)[0], (*known)[1]);
      (*known)[0] = {point.state, crossing_value(system_, point.state, family_.own().options().factorization) / scale};
      return (*known)[0].second;
    };
    if (scale > 0.0) options.detectors.push_back({.kind = EventKind::user, .label = "crossing", .value = value});
    return options;
  }

  CurvePoint read_off(const PathPoint& at, std::pair<std::optional<Index>, std::optional<Index>>& counts) const {
    const State& state = at.state;
    const auto member = system_.at(state);
    const auto model = family_.model(state.lambda);
    assert(member && model);
    CurvePoint point{.arc = at.arc, .key = state.lambda, .lambda = EventSystem::lambda_of(state)};
    for (const MonitorColumn& column : model->monitors())
      point.monitors.push_back(column.quantity->value(member->state));
    const double slope = EventSystem::lambda_rate(state, at.tangent) / at.tangent.dlambda;
    if (std::isfinite(slope)) point.slope = slope;
    count_sides(state, *member, counts);
    point.unstable_before = counts.first;
    point.unstable_after = counts.second;
    point.contacts = model->closed_contacts(member->state);
    point.shape = shape_of(*model, member->state);
    return point;
  }

  // On both sides of the event, in the order that changes least from the point before.
  void count_sides(const State& state, const SystemFamily::Member& member,
                   std::pair<std::optional<Index>, std::optional<Index>>& counts) const {
    const auto along = system_.along_path(state, member);
    const auto before = std::exchange(counts, {});
    if (!along) return;
    Beside sides(member, system_.metric_of(member), family_.own().options().factorization);
    if (system_.event().criterion != Criterion::guard) {
      counts = {sides.count(*along, -beside), sides.count(*along, beside)};
    } else {
      counts.first = sides.count(*along, 0.0);
      const auto j = static_cast<std::size_t>(system_.event().guards.front());
      if (j >= member.state.piece.size()) return;
      Piece other = member.state.piece;
      other[j] = other[j] == 0 ? 1 : 0;
      const SystemFamily::Member behind{.system = member.system,
                                        .state = member.system->with_piece(member.state, other)};
      Direction there{.dx = member.system->transfer(along->dx, member.state.piece, other), .dlambda = along->dlambda};
      counts.second =
          Beside(behind, system_.metric_of(behind), family_.own().options().factorization).count(there, 0.0);
    }
    const auto off = [](const std::optional<Index>& a, const std::optional<Index>& b) {
      return a && b ? std::abs(*a - *b) : 0;
    };
    if (off(counts.second, before.first) + off(counts.first, before.second) <
        off(counts.first, before.first) + off(counts.second, before.second))
      std::swap(counts.first, counts.second);
  }

  CurveSpecial special(const Event& event, std::size_t point) const {
    if (event.kind == EventKind::limit_point)
      return {.kind = CurveSpecialKind::cusp, .point = point, .why = "the number turns"};
    const bool contact = system_.event().criterion == Criterion::guard;
    return {.kind = CurveSpecialKind::crossing,
            .point = point,
            .why = contact ? "a limit point meets the change of contact" : "a second mode is critical"};
  }

  void add_end(Side& side, const BranchEnd& end, double sign) const {
    const std::size_t last = side.points.size() - 1;
    CurveSpecial special{.kind = sign > 0.0 ? CurveSpecialKind::ends : CurveSpecialKind::begins,
                         .point = last,
                         .why = end.detail,
                         .reason = end.reason};
    const bool deck_is_wrong = !family_.problem().empty() && end.reason != EndReason::stop &&
                               end.reason != EndReason::max_points && end.reason != EndReason::interrupted;
    if (end.reason == EndReason::stop) special.why = "the range ends";
    if (end.reason == EndReason::unsupported && !end.detail.empty() && !deck_is_wrong) {
      side.specials.push_back({.kind = CurveSpecialKind::crossing, .point = last, .why = end.detail});
      special.reason = EndReason::stop;
    }
    if (deck_is_wrong) special.why += fmt::format(" (beyond: {})", family_.problem());
    side.specials.push_back(std::move(special));
  }

  const DeckFamily& family_;
  const EventSystem& system_;
  const deck::EventToFollow& curve_;
  State start_;
  const std::function<bool()>& stopped_;
};

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

// One curve from the low side to the high one; both sides begin at the same point.
void join(CurveTrace::Side low, CurveTrace::Side high, EventCurve& curve) {
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

EventCurve described(const deck::Deck& deck, const Model& model, const deck::DeckNumber& number) {
  EventCurve curve{.deck = deck.source.file.substr(deck.source.file.rfind('/') + 1),
                   .title = deck.title,
                   .key = deck.curve->over,
                   .key_unit = deck::unit_text(number.unit, deck.units),
                   .event = deck.curve->event,
                   .number = deck.curve->number,
                   .own_value = number.value};
  for (const MonitorColumn& column : model.monitors()) curve.columns.push_back({column.name, column.unit});
  return curve;
}

}  // namespace

void check_curve(const deck::Deck& deck, DeckProblems& problems) {
  if (!deck.curve) return;
  const deck::EventToFollow& curve = *deck.curve;
  const auto add = [&](const char* key, std::string message, std::string cure) {
    problems.add(curve.position, key, std::move(message), std::move(cure));
  };
  std::vector<std::string> keys = curve.worst;
  if (!curve.over.empty()) keys.push_back(curve.over);
  for (const std::string& key : keys) {
    const char* const at = curve.over.empty() ? "curve.worst" : "curve.over";
    const auto found = deck::number_of(deck, key);
    if (const auto* const none = std::get_if<deck::NoNumber>(&found))
      add(at, deck::in_quotes(key, 100) + " " + none->message, none->cure);
  }
}

void require_curve(const deck::Deck& deck) {
  DeckProblems problems(deck.source);
  const deck::EventToFollow& curve = *deck.curve;
  const auto add = [&](const char* key, std::string message, std::string cure) {
    problems.add(curve.position, key, std::move(message), std::move(cure));
  };
  if (!deck.stages.empty())
    add("curve", "events of decks with stages are not followed", "leave out [curve], or the stages");
  if (deck.path.method == deck::PathMethod::incremental)
    add("curve", "method \"incremental\" has no events that could be followed", "use method \"spherical\"");
  if (deck.path.events != EventSearch::locate)
    add("curve", "events that are not located are not followed", "write events = \"locate\"");
  if (curve.event == EventKind::displacement_limit && deck.path.watch.empty())
    add("curve.event", "no monitor is watched, so that none turns", "add watch = [\"MONITOR\"] to [path]");
  const auto number = deck::number_of(deck, curve.over);
  if (const auto* const found = std::get_if<deck::DeckNumber>(&number); found != nullptr && !curve.over.empty())
    if (found->value < curve.range[0] || found->value > curve.range[1])
      add("curve.range", fmt::format("the deck's own value of {}, {}, is outside", curve.over, found->value),
          "give a range that holds it");
  problems.raise();
}

EventCurve trace_event_curve(const deck::Deck& deck, const std::function<bool()>& stopped) {
  const Model checked(deck);  // reports all that is wrong
  require_curve(deck);
  const auto number = std::get<deck::DeckNumber>(deck::number_of(deck, deck.curve->over));
  DeckFamily family(deck, number);
  EventCurve curve = described(deck, family.own(), number);
  const auto found = find_event(family.own(), deck.curve->event, deck.curve->number, stopped, curve.problem);
  if (!found) return curve;
  const auto event = followed(family.own().system(), *found, curve.problem);
  if (!event) return curve;
  if (deck.curve->event == EventKind::displacement_limit) family.set_turning(found->event.label);
  const double first = std::abs(family.own().options().step.first);
  const EventSystem system(family, *event, std::max(std::abs(found->event.state.lambda), first),
                           family.own().options().factorization);
  const auto start = system.of_event(found->event.state, number.value);
  if (!start) {
    curve.problem = "the equations are singular at the event";
    return curve;
  }
  CurveTrace trace(family, system, *deck.curve, *start, stopped);
  const std::pair counts{found->event.unstable_before, found->event.unstable_after};
  const bool down = number.value > deck.curve->range[0], up = number.value < deck.curve->range[1];
  join(down ? trace.side(-1.0, counts) : CurveTrace::Side{}, up ? trace.side(1.0, counts) : CurveTrace::Side{}, curve);
  if (curve.points.empty()) {
    curve.problem = family.problem().empty()
                        ? "the event's equations are singular: it does not move with this number alone"
                        : family.problem();
    return curve;
  }
  const CurveSpecial at_bound{.why = "the range ends", .reason = EndReason::stop};
  if (!down) curve.specials.insert(curve.specials.begin(), at_bound)->kind = CurveSpecialKind::begins;
  if (!up) {
    curve.specials.push_back(at_bound);
    curve.specials.back().kind = CurveSpecialKind::ends;
    curve.specials.back().point = curve.points.size() - 1;
  }
  return curve;
}

std::string_view to_text(CurveSpecialKind kind) {
  switch (kind) {
    case CurveSpecialKind::begins:
      return "begins";
    case CurveSpecialKind::ends:
      return "ends";
    case CurveSpecialKind::cusp:
      return "cusp";
    case CurveSpecialKind::crossing:
      return "crossing";
  }
  assert(false);
  return "";
}

}  // namespace arcwall
