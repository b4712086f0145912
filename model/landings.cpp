#include "model/landings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "continuation/answers/descent.hpp"
#include "continuation/tracer.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

// All lengths in the path metric of the deck's mesh.
constexpr double is_elsewhere = 0.03;           // from the event, where a descent has left it
constexpr double is_there = 0.03;               // of the state at rest from one of the path
constexpr double pushes[] = {0.01, 0.03, 0.1};  // off the event, along the path behind it

// --- states on the deck's mesh --------------------------------------------------------------------------------------

// The unknowns of the deck's structure in states of the model, whichever mesh those have.
class DeckMesh {
 public:
  explicit DeckMesh(const Model& model) : model_(model), size_(model.structure().size({})) {
    if (model.sliding() == nullptr) return;
    const Structure& structure = model.structure();
    readings_.resize(static_cast<std::size_t>(size_));
    const auto read = [&](Index freedom, std::shared_ptr<const Observable> what) {
      if (const auto unknown = structure.unknown(freedom)) readings_[static_cast<std::size_t>(*unknown)] = what;
    };
    for (std::size_t m = 0; m < structure.members().size(); ++m) {
      const MemberMesh& mesh = structure.members()[m];
      for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
        using enum MemberObservable::Component;
        read(structure.freedom(mesh.nodes[k], Freedom::x), model.body().motion(m, k, x));
        read(structure.freedom(mesh.nodes[k], Freedom::z), model.body().motion(m, k, z));
        if (mesh.rotations[k]) read(*mesh.rotations[k], model.body().motion(m, k, rotation));
      }
    }
    rest_ = values(model.sliding()->rest());  // monitors are measured from the axis without imperfection
  }

  // Whether every unknown of the deck's mesh can be read off the model's states.
  bool is_complete() const {
    return std::all_of(readings_.begin(), readings_.end(), [](const auto& one) { return one != nullptr; });
  }

  const UnilateralSystem& system() const {
    if (model_.contact() != nullptr) return *model_.contact();
    return model_.structure();
  }

  // Without contact forces.
  State state(const State& of_model, double lambda) const {
    const Piece piece = model_.contact() != nullptr ? model_.contact()->open_piece() : Piece();
    State state{.x = Vector::Zero(system().size(piece)), .lambda = lambda, .piece = piece};
    state.x.head(size_) = unknowns(of_model);
    return state;
  }

  Vector unknowns(const State& of_model) const {
    if (readings_.empty()) return of_model.x.head(size_);
    return values(of_model) - rest_;
  }

  double distance(const Vector& a, const Vector& b) const {
    const Vector weights = model_.structure().weights({});
    return std::sqrt((weights.array() * (a - b).array().square()).sum());
  }

  Index size() const { return size_; }

 private:
  Vector values(const State& state) const {
    Vector values(size_);
    for (Index i = 0; i < size_; ++i) values[i] = readings_[static_cast<std::size_t>(i)]->value(state);
    return values;
  }

  const Model& model_;
  Index size_;
  std::vector<std::shared_ptr<const Observable>> readings_{};  // empty where states have the deck's mesh
  Vector rest_{};
};

// --- the traced path at a λ -----------------------------------------------------------------------------------------

// A stable equilibrium of the path at a λ.
struct OnPath {
  State state{};
  std::size_t point = 0;  // of the record: the last one before it
  double arc = 0.0;
  std::optional<Index> unstable{};
};

// From a point of the path to the λ, along the path.
std::optional<OnPath> at_lambda(const Model& model, const State& from, double lambda) {
  TraceOptions options = model.options();
  options.target_values = {{.quantity = std::make_shared<ParameterValue>(), .value = lambda, .stops = true}};
  options.stop_contacts.reset();
  options.stop_events.clear();
  options.detectors.clear();
  options.events = EventSearch::none;
  options.max_points = 100;
  options.step.first = std::copysign(std::abs(options.step.first), lambda - from.lambda);
  Tracer tracer(model.system(), from, options);
  OnPath found;
  while (const auto arc = tracer.next()) {
    found.state = arc->to.state;
    found.arc = arc->to.arc;
    found.unstable = arc->to.count.unstable;
  }
  const bool met = tracer.end() && tracer.end()->reason == EndReason::stop && found.state.lambda == lambda;
  return met ? std::optional(std::move(found)) : std::nullopt;
}

// Those of a record, beside the event at point `but`.
std::vector<OnPath> stable_at(const Model& model, const Record& record, double lambda, std::size_t but) {
  std::vector<OnPath> found;
  for (std::size_t i = 0; i + 1 < record.points.size(); ++i) {
    const RecordPoint &a = record.points[i], &b = record.points[i + 1];
    if (a.branch != b.branch || i == but || i + 1 == but) continue;
    const bool between = (a.lambda - lambda) * (b.lambda - lambda) <= 0.0 && a.lambda != b.lambda;
    const bool stable = a.count.stability == Stability::stable || b.count.stability == Stability::stable;
    if (!between || !stable) continue;
    // From the end that is no event: beside one the path may be singular.
    const bool backwards = a.event.has_value() && !b.event.has_value();
    auto there = at_lambda(model, backwards ? b.state : a.state, lambda);
    if (!there || there->unstable != 0) continue;
    there->point = i;
    there->arc = backwards ? b.arc - there->arc : a.arc + there->arc;
    found.push_back(std::move(*there));
  }
  return found;
}

// --- what is told of a state ----------------------------------------------------------------------------------------

// Closed contacts that are one stretch on a wall: tracked points with a part on the wall between them, or nodes that
// follow each other.
std::vector<RecordStretch> stretches_of(const Model& model, const State& state) {
  std::vector<RecordStretch> stretches;
  if (model.contacts() == nullptr) return stretches;
  const std::vector<ContactPoint> closed = model.contacts()->closed_contacts(state);
  const auto joins = [&](const ContactPoint& a, const ContactPoint& b, std::size_t k) {
    if (a.label.wall != b.label.wall || a.label.member != b.label.member) return false;
    if (model.sliding() == nullptr) {
      const double apart = std::abs(a.label.fraction - b.label.fraction) * 0.999;
      for (const MemberMesh& mesh : model.structure().members())
        if (mesh.name == a.label.member) return apart <= 1.0 / double(mesh.nodes.size() - 1);
      return false;
    }
    // The k-th closed point is the k-th of those that are closed on the piece.
    const SlidingContactLayout& layout = sliding_layout(state.piece);
    std::size_t point = 0;
    for (std::size_t seen = 0; point < layout.points().size(); ++point)
      if (state.piece[point] != 0 && seen++ == k) break;
    return point < layout.points().size() && layout.points()[point].behind != SlidingContactLayout::Span::free;
  };
  for (std::size_t k = 0; k < closed.size(); ++k) {
    const ContactPoint& contact = closed[k];
    if (k > 0 && joins(closed[k - 1], contact, k - 1)) {
      stretches.back().is_line = true;
      stretches.back().force += contact.force;
    } else {
      stretches.push_back({.label = contact.label, .force = contact.force});
    }
  }
  return stretches;
}

std::string word_of(const std::vector<RecordStretch>& stretches) {
  std::string word;
  for (const RecordStretch& one : stretches)
    word += (word.empty() ? "" : " ") + one.label.wall + (one.is_line ? "=" : "");
  return word;
}

void tell_state(const Model& model, const State& state, RecordLanding& landing) {
  landing.lambda = state.lambda;
  for (const MonitorColumn& column : model.monitors()) landing.monitors.push_back(column.quantity->value(state));
  landing.contacts = stretches_of(model, state);
  landing.word = word_of(landing.contacts);
  landing.energy = model.system().energy(state);
}

// --- one fall -------------------------------------------------------------------------------------------------------

class Falls {
 public:
  Falls(const Model& model, const Record& record) : model_(model), record_(record), mesh_(model) {}

  bool can_fall() const { return mesh_.is_complete(); }

  // Where the structure falls to from an event at a point of the record, off which it goes along the path to the points
  // in the direction `onwards`; null where it stays beside it. `depth`: how often it may go back and fall again.
  // `rest` becomes the state.
  std::shared_ptr<const RecordLanding> from(const RecordEvent& event, std::size_t point, int onwards, int depth,
                                            State& rest) const {
    const RecordPoint& at = record_.points[point];
    const Vector event_x = mesh_.unknowns(at.state);
    auto landing = std::make_shared<RecordLanding>();
    landing->lambda = event.lambda;
    bool left = false;
    for (const double push : pushes) {
      const auto start = pushed(event, point, onwards, push);
      if (!start) break;
      const Descent descent = descend(mesh_.system(), mesh_.state(at.state, event.lambda), *start);
      if (descent.end == DescentEnd::falls_away) {
        landing->reason = "falls_away";
        landing->why = "nothing holds the structure at this load";
        return landing;
      }
      // Near a branch point from which a stable branch leaves it creeps back.
      if (mesh_.distance(descent.state.x.head(mesh_.size()), event_x) <= is_elsewhere) continue;
      if (descent.end == DescentEnd::not_found) {
        landing->reason = "not_found";
        landing->why = "the descent came to no rest";
        left = true;
        continue;
      }
      rest = descent.state;
      settle(event, point, rest, *landing);
      if (landing->reason.empty() && depth > 0) add_way_back(event, point, depth, *landing);
      return landing;
    }
    return left ? landing : nullptr;
  }

 private:
  // The deck's unknowns at least so far from the event, towards the next point of the path or of a branch that leaves
  // it there.
  std::optional<Vector> pushed(const RecordEvent& event, std::size_t point, int onwards, double least) const {
    const Vector event_x = mesh_.unknowns(record_.points[point].state);
    for (auto i = static_cast<std::ptrdiff_t>(point) + onwards;
         i >= 0 && i < static_cast<std::ptrdiff_t>(record_.points.size()); i += onwards) {
      const RecordPoint& next = record_.points[static_cast<std::size_t>(i)];
      const auto& leaving = event.branches;
      if (next.branch != event.branch && std::find(leaving.begin(), leaving.end(), next.branch) == leaving.end()) break;
      const Vector x = mesh_.unknowns(next.state);
      const double far = mesh_.distance(x, event_x);
      if (far > 1e-6) return event_x + std::max(1.0, least / far) * (x - event_x);
    }
    return std::nullopt;
  }

  Descent descend(const UnilateralSystem& system, State start, const Vector& x) const {
    start.x.head(mesh_.size()) = x;
    return arcwall::descend(system, start, model_.options().factorization);
  }

  // The state at rest in the path's own formulation, counted.
  void settle(const RecordEvent& event, std::size_t point, State& rest, RecordLanding& landing) const {
    const Vector x = rest.x.head(mesh_.size());
    const OnPath* nearest = nullptr;
    const std::vector<OnPath> stable = stable_at(model_, record_, event.lambda, point);
    double least = is_there;
    for (const OnPath& one : stable) {
      const double far = mesh_.distance(mesh_.unknowns(one.state), x);
      if (far > least) continue;
      least = far;
      nearest = &one;
    }
    if (nearest != nullptr) {
      landing.on_branch = record_.points[nearest->point].branch;
      landing.arc = nearest->arc;
      landing.point = nearest->point;
    } else if (model_.sliding() != nullptr) {
      landing.reason = "not_found";
      landing.why = "it comes to rest where the traced path does not pass, and contact that slides is not begun there";
      return;
    }
    if (nearest != nullptr) rest = nearest->state;
    tell_state(model_, rest, landing);
    landing.unstable = 0;
    landing.released = record_.points[point].energy - landing.energy;
  }

  // λ goes back along the branch, and the structure falls again where that loses its stability.
  void add_way_back(const RecordEvent& event, std::size_t point, int depth, RecordLanding& landing) const {
    if (!landing.on_branch || point == 0) return;
    const double ahead = event.lambda - record_.points[point - 1].lambda;  // of λ on the way to the event
    const RecordPoint &a = record_.points[landing.point], &b = record_.points[landing.point + 1];
    const int back = (b.lambda - a.lambda) * ahead > 0.0 ? -1 : 1;  // along the record
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(landing.point) + (back > 0 ? 1 : 0);
    for (std::ptrdiff_t i = first; i >= 0 && i < static_cast<std::ptrdiff_t>(record_.points.size()); i += back) {
      const auto k = static_cast<std::size_t>(i);
      if (record_.points[k].branch != *landing.on_branch) return;
      const RecordEvent* const lost = loss_at(k, back);
      if (lost == nullptr) continue;
      auto way = std::make_shared<RecordWayBack>();
      way->lambda = lost->lambda;
      way->kind = lost->kind;
      way->monitors = lost->monitors;
      State rest;
      way->landing = from(*lost, k, back, depth - 1, rest);
      if (way->landing && way->landing->reason.empty() && is_before(event, *way->landing, rest))
        landing.loop = landing.released + way->landing->released;
      landing.back = std::move(way);
      return;
    }
  }

  // Whether a structure is again on the way to an event, so that the loop closes: on its branch before it, or where the
  // branch's first point is reached by λ alone.
  bool is_before(const RecordEvent& event, const RecordLanding& landing, const State& state) const {
    constexpr double same = 1e-6;
    if (landing.on_branch) return landing.on_branch == event.branch && landing.arc <= event.arc;
    const auto first = std::find_if(record_.points.begin(), record_.points.end(),
                                    [&](const RecordPoint& point) { return point.branch == event.branch; });
    const auto there = at_lambda(model_, state, first->lambda);
    return there && mesh_.distance(mesh_.unknowns(there->state), mesh_.unknowns(first->state)) <= same;
  }

  // The event at a point that is stable on the side one comes from and unstable behind.
  // Of several the one at which λ turns.
  const RecordEvent* loss_at(std::size_t point, int direction) const {
    const RecordEvent* found = nullptr;
    for (const RecordEvent& event : record_.events) {
      if (event.branch != record_.points[point].branch || event.step != record_.points[point].step) continue;
      const auto &here = direction > 0 ? event.unstable_before : event.unstable_after,
                 &behind = direction > 0 ? event.unstable_after : event.unstable_before;
      if (event.kind == EventKind::start || event.kind == EventKind::end || here != 0 || behind.value_or(0) == 0)
        continue;
      const bool turns = event.kind == EventKind::limit_point || event.kind == EventKind::contact_limit_point;
      if (found == nullptr || turns) found = &event;
    }
    return found;
  }

  const Model& model_;
  const Record& record_;
  DeckMesh mesh_;
};

bool loses_stability(const RecordEvent& event) {
  const bool kind = event.kind == EventKind::limit_point || event.kind == EventKind::contact_limit_point ||
                    event.kind == EventKind::branch_point;
  return kind && !event.suspected && event.unstable_before == 0 && event.unstable_after.value_or(0) > 0;
}

// The number of the event's point in the record.
std::optional<std::size_t> point_of(const Record& record, const RecordEvent& event) {
  for (std::size_t i = 0; i < record.points.size(); ++i)
    if (record.points[i].branch == event.branch && record.points[i].step == event.step) return i;
  return std::nullopt;
}

}  // namespace

void add_landings(const Model& model, Record& record) {
  const bool falls = model.whole_deck().path.landing && record.stages.empty() && !model.in_increments();
  if (!falls) return;
  const Falls of(model, record);
  for (RecordEvent& event : record.events) {
    const auto point = loses_stability(event) ? point_of(record, event) : std::nullopt;
    if (!point) continue;
    if (of.can_fall()) {
      State rest;
      event.landing = of.from(event, *point, 1, 1, rest);
    } else {
      event.landing =
          std::make_shared<RecordLanding>(RecordLanding{.reason = "not_found",
                                                        .why = "the deck's mesh has unknowns that its contact does not",
                                                        .lambda = event.lambda});
    }
  }
}

}  // namespace arcwall
