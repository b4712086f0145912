#include "answers/jumps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "answers/contact_pattern.hpp"
#include "answers/mirror_images.hpp"
#include "answers/path_at_lambda.hpp"
#include "continuation/equilibria/descent.hpp"
#include "continuation/equilibria/energy_valley.hpp"
#include "continuation/equilibria/equilibrium_at.hpp"
#include "continuation/tracer.hpp"
#include "model/deck_mesh.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

// Off the event, where no valley leads away from it, along the path behind it or the critical modes [path metric].
constexpr double pushes[] = {1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
constexpr double along_mode = 0.01;   // of a state on the critical mode, which tells its direction alone [path metric]
constexpr double energy_lost = 1e-9;  // of the energy: a descent that has left the event

// Falls take no more time than tracing, and about a second more: that is so many factorizations over the number of
// unknowns. With members of theory Essenburg one of them costs some ten times as much as with others.
constexpr double more_work = 4e5, more_work_for_essenburg = 1e5;
constexpr const char* took_too_long = "the time limit of the jumps was met: twice the time of the tracing";
constexpr const char* not_of_path =
    "its state lies on no traced branch, and with moving contact points it was not found there";
constexpr const char* several_modes =
    "several modes become unstable at once, as of equal parts: imperfections decide where the structure moves";
constexpr const char* no_rest = "the motion did not come to rest";
constexpr const char* between_nodes =
    "the motion leads to a wall that fits between two nodes of the mesh, on which it is computed: give the members "
    "more "
    "elements";

// Stable equilibria of a record at a λ, but not beside the event at point `but` if it is one of the record's.
std::vector<OnPath> stable_at(const Model& model, const Record& record, double lambda,
                              const std::optional<std::size_t>& but) {
  std::vector<OnPath> found;
  for (const std::size_t i : crossings(record, lambda)) {
    const RecordPoint &a = record.points[i], &b = record.points[i + 1];
    if (record.stage_number(a.branch) != model.stage()) continue;
    const bool stable = a.count.stability == Stability::stable || b.count.stability == Stability::stable;
    if (!stable || (but && (i == *but || i + 1 == *but))) continue;
    auto there = at_crossing(model, record, i, lambda);
    if (there && there->unstable == 0) found.push_back(std::move(*there));
  }
  return found;
}

void tell_state(const Model& model, const State& state, RecordJump& jump) {
  jump.lambda = state.lambda;
  jump.state = state;
  for (const MonitorColumn& column : model.monitors()) jump.monitors.push_back(column.quantity->value(state));
  jump.contacts = stretches_of(model, state);
  jump.contact_pattern = contact_pattern_of(jump.contacts);
  jump.energy = model.energy(state);
}

// --- one fall -------------------------------------------------------------------------------------------------------

// Where a stable structure loses its stability.
struct Loss {
  EventKind kind = EventKind::limit_point;
  Index modes = 1;  // that become unstable
  State at{};
  double energy = 0.0;
  std::optional<State> behind{};       // a state of the path, or of a branch that leaves it there, just behind
  double sense = 1.0;                  // −1: on the other side
  std::optional<std::size_t> point{};  // of the record
};

// Of an event of a record or of a tracer.
bool loses_stability(const auto& event) {
  const bool is_inside = event.kind != EventKind::start && event.kind != EventKind::end;
  return is_inside && !event.unconfirmed && event.unstable_before == 0 && event.unstable_after.value_or(0) > 0;
}

// In either direction of the path, as one side of the event is stable.
Index modes_lost(const RecordEvent& event) {
  return std::max(event.unstable_before.value_or(0), event.unstable_after.value_or(0));
}

std::shared_ptr<RecordJump> not_found(double lambda, const char* why) {
  return std::make_shared<RecordJump>(RecordJump{.reason = "not_found", .why = why, .lambda = lambda});
}

// The outcome of a fall.
struct Fallen {
  std::shared_ptr<RecordJump> jump{};  // null: it stays beside the event
  State rest{};                        // where it ends, if `jump` has no reason against it
};

class Falls {
 public:
  // `factorizations`: that falls may take; empty: as many as they need.
  Falls(const Model& model, const Record& record, std::optional<Index> factorizations)
      : model_(model),
        record_(record),
        mesh_(model),
        left_(factorizations.value_or(std::numeric_limits<Index>::max())) {}

  // Where the structure falls to from an event at a point of the record; null where it stays beside a branch point.
  // From a branch point in both senses.
  std::shared_ptr<const RecordJump> from(const RecordEvent& event, std::size_t point) {
    if (!mesh_.is_complete()) return not_found(event.lambda, "the deck's mesh has unknowns that its contact does not");
    if (is_followed(event, point)) return nullptr;
    const Loss loss = recorded(event, point, 1);
    if (!loss.behind) return not_found(event.lambda, "no direction is known in which the structure leaves the event");
    std::vector<Fallen> ends = fall_in_each_sense(loss);
    for (Fallen& end : ends)
      if (end.jump && end.jump->reason.empty()) add_way_back(event, point, end.rest, *end.jump);
    return told(loss, ends);
  }

  // Where the structure falls to from a loss of stability that a tracer has located; `behind`: its path behind it.
  Fall beyond(const Event& event, const PathPoint& behind) {
    if (!mesh_.is_complete())
      return {.jump = not_found(event.state.lambda, "the deck's mesh has unknowns that its contact does not")};
    Loss loss{
        .kind = event.kind, .modes = *event.unstable_after, .at = event.state, .energy = model_.energy(event.state)};
    if (event.branching && event.branching->mode.dx.size() == event.branching->state.x.size()) {
      const BranchPoint& point = *event.branching;
      const Metric metric(model_.system().weights(point.state.active_set), 1.0);
      loss.behind = moved(point.state, point.mode, along_mode);
      loss.sense = preferred_sense(model_.explore().preference, point.state, point.mode.dx, metric).value_or(1);
    } else {
      loss.behind = moved(behind.state, behind.tangent, along_mode);
    }
    std::vector<Fallen> ends = fall_in_each_sense(loss);
    Fall fall{.jump = told(loss, ends)};
    if (!fall.jump) fall.jump = not_found(event.state.lambda, "the structure stays beside the branch point");
    if (ends.size() == 1 && fall.jump->reason.empty()) fall.state = std::move(ends.front().rest);
    return fall;
  }

  // The way back of a jump from which the run went on.
  void add_way_back(const RecordEvent& event, std::size_t point, RecordJump& jump) {
    add_way_back(event, point, record_.points[jump.point].state, jump);
  }

  // The event at a point that is stable on the side one comes from and unstable behind.
  // Of several the one at which λ turns, else one that is no change of contact.
  const RecordEvent* loss_at(std::size_t point, int direction) const {
    const RecordEvent* found = nullptr;
    for (const RecordEvent& event : record_.events) {
      if (event.branch != record_.points[point].branch || event.step != record_.points[point].step) continue;
      const auto &here = direction > 0 ? event.unstable_before : event.unstable_after,
                 &behind = direction > 0 ? event.unstable_after : event.unstable_before;
      if (event.kind == EventKind::start || event.kind == EventKind::end || here != 0 || behind.value_or(0) == 0)
        continue;
      const bool turns = event.kind == EventKind::limit_point || event.kind == EventKind::contact_limit_point;
      if (found == nullptr || turns || changes_contact(found->kind)) found = &event;
    }
    return found;
  }

 private:
  // Whether a traced branch that leaves an event is stable and goes on as λ did: the structure follows it.
  bool is_followed(const RecordEvent& event, std::size_t point) const {
    const double ahead = point > 0 ? event.lambda - record_.points[point - 1].lambda : 0.0;
    return std::any_of(event.branches.begin(), event.branches.end(), [&](Index branch) {
      const auto next = std::find_if(record_.points.begin(), record_.points.end(),
                                     [&](const RecordPoint& one) { return one.branch == branch && one.step > 0; });
      return next != record_.points.end() && next->count.stability == Stability::stable &&
             (next->lambda - event.lambda) * ahead > 0.0;
    });
  }

  // From a branch point in both senses of its mode, the loss's first, unless they lead to the same.
  std::vector<Fallen> fall_in_each_sense(const Loss& loss) {
    Fallen first = fall(loss);
    if (loss.kind != EventKind::branch_point) return {first};
    Loss opposite = loss;
    opposite.sense = -loss.sense;
    Fallen other = fall(opposite);
    if (!first.jump || !other.jump) return {first.jump ? first : other};
    if (other.jump->why == took_too_long) return {first};  // of which nothing is known
    if (first.jump->why == took_too_long) return {other};
    if (first.jump->reason == other.jump->reason && (!first.jump->reason.empty() || are_alike(first, other)))
      return {first};
    return {first, other};
  }

  // Null where the structure stays beside a branch point.
  static std::shared_ptr<const RecordJump> told(const Loss& loss, const std::vector<Fallen>& ends) {
    if (ends.size() == 1) {
      if (ends.front().jump || loss.kind == EventKind::branch_point) return ends.front().jump;
      return not_found(loss.at.lambda, "pushed along its path, the structure returned to the event");
    }
    auto several = std::make_shared<RecordJump>();
    several->reason = "two_destinations";
    several->why = "the senses of the mode lead to different ends";
    several->lambda = loss.at.lambda;
    for (const Fallen& end : ends) several->destinations.push_back(*end.jump);
    return several;
  }

  // Whether two jumps are one state, or images of each other in a mirror.
  bool are_alike(const Fallen& first, const Fallen& second) const {
    constexpr double same_energy = 1e-6;  // of the energy
    const RecordJump &a = *first.jump, &b = *second.jump;
    if (std::abs(a.energy - b.energy) > same_energy * std::max(std::abs(a.energy), std::abs(b.energy))) return false;
    const Vector x = mesh_.unknowns(first.rest), y = mesh_.unknowns(second.rest);
    if (mesh_.distance(x, y) <= mesh_.same_of_nodes()) return true;
    const std::vector<Vector> images = MirrorImages(model_.structure()).of(mesh_.state(x, a.lambda));
    return std::any_of(images.begin(), images.end(),
                       [&](const Vector& image) { return mesh_.distance(image, y) <= mesh_.same_of_nodes(); });
  }

  // Whether a state is so far from an event that it says where the path goes on.
  bool is_behind(const State& state, const State& event) const {
    constexpr double apart = 1e-6;
    return mesh_.distance(mesh_.unknowns(state), mesh_.unknowns(event)) > apart;
  }

  // An event at a point of the record, of which the points in the direction `onwards` are behind it.
  Loss recorded(const RecordEvent& event, std::size_t point, int onwards) const {
    const RecordPoint& here = record_.points[point];
    Loss loss{.kind = event.kind, .modes = modes_lost(event), .at = here.state, .energy = here.energy, .point = point};
    loss.at.lambda = event.lambda;
    for (auto i = static_cast<std::ptrdiff_t>(point) + onwards;
         i >= 0 && i < static_cast<std::ptrdiff_t>(record_.points.size()); i += onwards) {
      const RecordPoint& next = record_.points[static_cast<std::size_t>(i)];
      const auto& leaving = event.branches;
      if (next.branch != event.branch && std::find(leaving.begin(), leaving.end(), next.branch) == leaving.end()) break;
      if (!is_behind(next.state, here.state)) continue;
      loss.behind = next.state;
      if (event.kind == EventKind::branch_point && next.branch == event.branch) push_along_mode(event, loss);
      break;
    }
    if (!loss.behind) push_beyond_end(event, point, onwards, loss);
    return loss;
  }

  // No state of the path says where it leaves the event: along the mode of a branch point, else on from where it came.
  void push_beyond_end(const RecordEvent& event, std::size_t point, int onwards, Loss& loss) const {
    if (event.kind == EventKind::branch_point) return push_along_mode(event, loss);
    const RecordPoint& here = record_.points[point];
    for (auto i = static_cast<std::ptrdiff_t>(point) - onwards;
         i >= 0 && i < static_cast<std::ptrdiff_t>(record_.points.size()); i -= onwards) {
      const RecordPoint& before = record_.points[static_cast<std::size_t>(i)];
      if (before.branch != event.branch) return;
      if (!is_behind(before.state, here.state)) continue;
      loss.behind = before.state;
      loss.sense = -1.0;
      return;
    }
  }

  // The path goes on through the branch point, along which a perfect structure would stay as it is.
  void push_along_mode(const RecordEvent& event, Loss& loss) const {
    for (const RecordBranchPoint& one : record_.branch_points) {
      if (one.event != event.id || one.point->mode.dx.size() != one.point->state.x.size()) continue;
      loss.behind = moved(one.point->state, one.point->mode, along_mode);
    }
  }

  // The first one on the way from a stable state to a λ.
  std::optional<Loss> traced(const State& from, double lambda) {
    Tracer tracer(model_.system(), from, options_towards(model_, from, lambda));
    std::optional<Loss> found;
    while (const auto arc = tracer.next()) {
      left_ -= arc->to.iterations + 1;
      if (left_ <= 0) return std::nullopt;
      if (found) {
        if (!found->behind && !is_behind(arc->to.state, found->at)) continue;
        if (!found->behind) found->behind = arc->to.state;
        return found;
      }
      if (model_.adrift(arc->to.state)) return std::nullopt;
      for (const Event& event : arc->events) {
        if (!loses_stability(event)) continue;
        found = Loss{.kind = event.kind,
                     .modes = *event.unstable_after,
                     .at = event.state,
                     .energy = model_.energy(event.state)};
        if (event.branching && event.branching->mode.dx.size() == event.state.x.size())
          found->behind = moved(event.state, event.branching->mode, along_mode);
      }
    }
    return std::nullopt;
  }

  Fallen fall(const Loss& loss) {
    if (!loss.behind) return {};
    const Vector start = mesh_.unknowns(loss.at), behind = loss.sense * (mesh_.unknowns(*loss.behind) - start);
    const State event = mesh_.state(start, loss.at.lambda);
    const Valley valley = follow_valley(mesh_.system(), {.state = event, .towards = behind, .kind = kind_of(loss.kind)},
                                        model_.options().factorization, left_);
    if (valley.end == ValleyEnd::cut_off) return fallen_not(loss, took_too_long);
    if (valley.end == ValleyEnd::leads_back) return {};
    if (valley.end == ValleyEnd::unclear && loss.modes > 1) return fallen_not(loss, several_modes);
    Fallen fallen{};
    if (valley.end == ValleyEnd::leads_away)
      if (const auto end = fall_from(loss, valley.state)) {
        fallen = *end;
        if (fallen.jump->why != not_of_path) return fallen;  // else nodes hold what moving contact does not
      }
    for (const double push : pushes) {
      const Vector pushed = start + push / mesh_.length(behind) * behind;
      const State beside = mesh_.state(pushed, loss.at.lambda);
      if (passes_a_wall(mesh_.system(), event, beside)) break;
      const auto end = fall_from(loss, beside, mesh_.system().energy(event));
      if (!end) continue;
      fallen = *end;
      const std::string& why = fallen.jump->why;
      if (why != no_rest && why != between_nodes && why != not_of_path) break;
    }
    return fallen;
  }

  static LostState::Kind kind_of(EventKind kind) {
    if (kind == EventKind::branch_point) return LostState::Kind::branch_point;
    return kind == EventKind::limit_point ? LostState::Kind::limit_point : LostState::Kind::contact_change;
  }

  static Fallen fallen_not(const Loss& loss, const char* why) { return {.jump = not_found(loss.at.lambda, why)}; }

  // Where a motion from a state beside the event ends. Empty where it returns to the event: where it comes to rest at
  // the event itself, which nodes may hold, or where its energy at rest is not below `above`, if that is given.
  std::optional<Fallen> fall_from(const Loss& loss, const State& beside, std::optional<double> above = {}) {
    const Descent descent = descend(mesh_.system(), beside, model_.options().factorization, left_);
    switch (descent.end) {
      case DescentEnd::falls_away:
        return Fallen{
            .jump = std::make_shared<RecordJump>(RecordJump{.reason = "no_equilibrium",
                                                            .why = "the structure finds no equilibrium at this load",
                                                            .lambda = loss.at.lambda})};
      case DescentEnd::cut_off:
        return fallen_not(loss, took_too_long);
      case DescentEnd::not_found:
        return fallen_not(loss, descent.meets_wall ? between_nodes : no_rest);
      case DescentEnd::at_rest:
        break;
    }
    const double energy = mesh_.system().energy(descent.state);
    if (above && !(*above - energy > energy_lost * std::max(std::abs(*above), std::abs(energy)))) return std::nullopt;
    Fallen fallen{.jump = std::make_shared<RecordJump>(RecordJump{.lambda = loss.at.lambda}), .rest = descent.state};
    settle(loss, fallen.rest, *fallen.jump);
    if (fallen.jump->reason.empty() && is_event(loss, fallen)) return std::nullopt;
    return fallen;
  }

  // Whether a state at rest is that of the event, but for what nodes and moving contact differ by.
  bool is_event(const Loss& loss, const Fallen& fallen) const {
    const Vector at = mesh_.unknowns(loss.at);
    const double of_mesh = mesh_.system().energy(mesh_.state(at, loss.at.lambda)) - loss.energy;
    const double least =
        std::max(std::abs(of_mesh), energy_lost * std::max(std::abs(loss.energy), std::abs(fallen.jump->energy)));
    return fallen.jump->energy_released <= least &&
           mesh_.distance(mesh_.unknowns(fallen.rest), at) <= mesh_.same_on_path();
  }

  // The state at rest in the path's own formulation, counted.
  void settle(const Loss& loss, State& rest, RecordJump& jump) const {
    const std::optional<State> found = in_path_formulation(rest);
    const Vector x = found ? mesh_.unknowns(*found) : rest.x.head(mesh_.size());
    const OnPath* nearest = nullptr;
    const std::vector<OnPath> stable = stable_at(model_, record_, loss.at.lambda, loss.point);
    double least = found ? mesh_.same_on_path() : mesh_.same_of_nodes();
    for (const OnPath& one : stable) {
      const double far = mesh_.distance(mesh_.unknowns(one.state), x);
      if (far > least) continue;
      least = far;
      nearest = &one;
    }
    if (nearest != nullptr) {
      jump.on_branch = record_.points[nearest->point].branch;
      jump.arc = nearest->arc;
      jump.point = nearest->point;
      rest = nearest->state;
    } else if (found) {
      rest = *found;
    } else {
      jump.reason = "not_found";
      jump.why = not_of_path;
      return;
    }
    tell_state(model_, rest, jump);
    jump.unstable = 0;
    jump.energy_released = loss.energy - jump.energy;
  }

  // The same stable state in the path's own formulation.
  std::optional<State> in_path_formulation(const State& rest) const {
    if (model_.sliding() == nullptr) return model_.with_kinks(rest);
    const Vector x = rest.x.head(mesh_.size());
    for (const State& guess : mesh_.in_path_formulation(rest)) {
      const auto found = equilibrium_at_lambda(model_.system(), guess, model_.options());
      if (found && found->count.unstable == 0 &&
          mesh_.distance(mesh_.unknowns(found->state), x) <= mesh_.same_of_nodes())
        return found->state;
    }
    return std::nullopt;
  }

  // λ, which increased by `ahead` on the way to the event, goes back from the state at rest, and the structure falls
  // again where that loses its stability.
  void add_way_back(const RecordEvent& event, std::size_t point, const State& rest, RecordJump& jump) {
    const double ahead = point > 0 ? event.lambda - record_.points[point - 1].lambda : 0.0;
    if (ahead == 0.0) return;
    const bool is_passed = jump.on_branch && !record_.branches[static_cast<std::size_t>(*jump.on_branch)].after_jump;
    const std::optional<Loss> lost = is_passed ? recorded_back(jump, ahead) : traced(rest, far_back(event, ahead));
    if (!lost) return;
    auto way = std::make_shared<RecordReturn>();
    way->lambda = lost->at.lambda;
    way->kind = lost->kind;
    for (const MonitorColumn& column : model_.monitors()) way->monitors.push_back(column.quantity->value(lost->at));
    const Fallen again = fall(*lost);
    way->jump = again.jump;
    if (again.jump && again.jump->reason.empty() && is_before(event, *again.jump, again.rest))
      jump.energy_dissipated = jump.energy_released + again.jump->energy_released;
    jump.on_return = std::move(way);
  }

  // The first loss of stability on the branch of a jump, with λ going against `ahead`.
  std::optional<Loss> recorded_back(const RecordJump& jump, double ahead) const {
    const RecordPoint &a = record_.points[jump.point], &b = record_.points[jump.point + 1];
    const int back = (b.lambda - a.lambda) * ahead > 0.0 ? -1 : 1;  // along the record
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(jump.point) + (back > 0 ? 1 : 0);
    for (std::ptrdiff_t i = first; i >= 0 && i < static_cast<std::ptrdiff_t>(record_.points.size()); i += back) {
      const auto k = static_cast<std::size_t>(i);
      if (record_.points[k].branch != *jump.on_branch) return std::nullopt;
      if (const RecordEvent* const lost = loss_at(k, back)) return recorded(*lost, k, back);
    }
    return std::nullopt;
  }

  // λ beyond which no loss of stability is sought: from the event against `ahead` two and a half times as far as from
  // the beginning of its branch, or of the one from which the structure jumped to it.
  double far_back(const RecordEvent& event, double ahead) const {
    Index branch = event.branch;
    const auto of_record = [&](Index id) -> const RecordBranch& {
      return record_.branches[static_cast<std::size_t>(id)];
    };
    while (of_record(branch).after_jump && of_record(branch).parent) branch = *of_record(branch).parent;
    return event.lambda - std::copysign(2.5 * std::abs(event.lambda - first_point(branch).lambda), ahead);
  }

  const RecordPoint& first_point(Index branch) const {
    return *std::find_if(record_.points.begin(), record_.points.end(),
                         [&](const RecordPoint& point) { return point.branch == branch; });
  }

  // Whether a structure is again on the way to an event, so that the loop closes: on its branch before it, or where the
  // branch's first point is reached by λ alone, as the structure is stable up to there.
  bool is_before(const RecordEvent& event, const RecordJump& jump, const State& state) const {
    constexpr double same = 1e-6;
    if (jump.on_branch) return jump.on_branch == event.branch && jump.arc <= event.arc;
    const RecordPoint& first = first_point(event.branch);
    const auto there = at_lambda(model_, state, first.lambda, Follow::stable_path);
    return there && mesh_.distance(mesh_.unknowns(there->state), mesh_.unknowns(first.state)) <= same;
  }

  const Model& model_;
  const Record& record_;
  DeckMesh mesh_;
  Index left_;  // factorizations that falls may still take
};

// Of the falls of a run, beside its tracing.
Index work_allowed(const Model& model, const Record& record) {
  constexpr Index besides = 2;  // of a step: at its end, and where events are located
  constexpr Index cheaper = 2;  // factorizations of a fall for one of tracing, which does more with it
  const auto& members = model.deck().members;
  const bool essenburg = std::any_of(members.begin(), members.end(),
                                     [](const deck::Member& one) { return one.theory == Theory::essenburg; });
  auto work = static_cast<Index>((essenburg ? more_work_for_essenburg : more_work) /
                                 static_cast<double>(std::max(DeckMesh(model).size(), Index{1})));
  for (const RecordPoint& point : record.points)
    if (record.stage_number(point.branch) == model.stage()) work += cheaper * (point.iterations + besides);
  return work;
}

// The number of the event's point in the record.
std::optional<std::size_t> point_of(const Record& record, const RecordEvent& event) {
  for (std::size_t i = 0; i < record.points.size(); ++i)
    if (record.points[i].branch == event.branch && record.points[i].step == event.step) return i;
  return std::nullopt;
}

}  // namespace

Fall fall_beyond(const Model& model, const Event& lost, const PathPoint& behind) {
  const Record nothing_traced;
  return Falls(model, nothing_traced, std::nullopt).beyond(lost, behind);
}

void add_jumps(const Model& model, Record& record) {
  if (!model.whole_deck().path.jumps || model.in_increments()) return;
  std::optional<Falls> of;
  Index stage = -1;
  for (RecordEvent& event : record.events) {
    const auto point = loses_stability(event) ? point_of(record, event) : std::nullopt;
    if (!point) continue;
    if (model.system().has_friction()) {
      event.jump =
          std::make_shared<const RecordJump>(RecordJump{.reason = "not_found",
                                                        .why = "it jumps; where it comes to rest depends on the motion",
                                                        .lambda = event.lambda,
                                                        .point = *point});
      continue;
    }
    if (const Index now = record.stage_number(event.branch); std::exchange(stage, now) != now)
      of.emplace(model.at_stage(now), record, work_allowed(model.at_stage(now), record));
    if (event.jump) {
      RecordJump jump = *event.jump;
      if (jump.on_branch) of->add_way_back(event, *point, jump);
      event.jump = std::make_shared<const RecordJump>(std::move(jump));
      continue;
    }
    if (!changes_contact(event.kind) || of->loss_at(*point, 1) == &event) event.jump = of->from(event, *point);
  }
}

}  // namespace arcwall
