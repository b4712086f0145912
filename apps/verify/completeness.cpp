#include "apps/verify/completeness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "core/text.hpp"

namespace arcwall::verify {

std::size_t change_before(std::span<const RecordPoint> points, std::size_t point,
                          const std::function<bool(Index)>& makes_stretch) {
  const auto has_contacts_of = [&](std::size_t i) {
    return points[i].branch == points[point].branch &&
           points[i].state.active_set.layout() == points[point].state.active_set.layout();
  };
  for (std::size_t i = point; i > 0 && has_contacts_of(i - 1); --i)
    if (points[i - 1].event) return makes_stretch(points[i - 1].step) ? i - 1 : point;
  return point;
}

namespace {

const std::string complete = "the list of events is complete";

// The points and events of one branch, both in their order.
struct Branch {
  Index id = 0;
  std::span<const RecordPoint> points{};
  std::vector<ListedEvent> events{};

  template <class Predicate>
  bool has_event(Index from, Index to, const Predicate& predicate) const {
    return std::any_of(events.begin(), events.end(), [&](const ListedEvent& event) {
      return event.step >= from && event.step <= to && predicate(event);
    });
  }
};

std::vector<Branch> branches_of(const Record& record, const std::vector<ListedEvent>& events) {
  std::vector<Branch> branches;
  for (auto first = record.points.begin(); first != record.points.end();) {
    const auto last =
        std::find_if(first, record.points.end(), [&](const auto& p) { return p.branch != first->branch; });
    Branch& branch = branches.emplace_back(Branch{.id = first->branch, .points = {first, last}});
    for (const ListedEvent& event : events)
      if (event.branch == branch.id) branch.events.push_back(event);
    first = last;
  }
  return branches;
}

// --- unstable directions --------------------------------------------------------------------------------------------

// From an event to the next the count is one: what the first left, what the points between have, what the next found.
// Where a branch begins on another, or a contact has no force, several counts are right.
void check_counts(const Branch& branch, Findings& findings) {
  for (std::size_t i = 0; i + 1 < branch.events.size(); ++i) {
    const ListedEvent &from = branch.events[i], &to = branch.events[i + 1];
    const bool begins = from.kind == "start" && branch.id > 0;
    std::optional<Index> count;
    if (!begins) count = from.unstable_after;
    Index since = from.step;
    for (const RecordPoint& point : branch.points) {
      if (point.step <= from.step || point.step >= to.step || !point.count.unstable ||
          point.count.stability == Stability::undecided)
        continue;
      findings.at("events.json", branch.id, point.step);
      findings.require(complete, !count || *count == *point.count.unstable,
                       fmt::format("unstable goes from {} to {} between steps {} and {} without an event",
                                   count.value_or(0), *point.count.unstable, since, point.step));
      count = point.count.unstable;
      since = point.step;
    }
    const bool together = from.step == to.step && to.unstable_before == from.unstable_before;  // of one change
    findings.at("events.json", branch.id, to.step);
    findings.require(complete, !count || !to.unstable_before || *count == *to.unstable_before || together,
                     fmt::format("unstable_before is {}, and {} since the event before", to.unstable_before.value_or(0),
                                 count.value_or(0)));
  }
}

// A branch that ends where another goes on does so at a branch point.
void check_switch(const Branch& branch, const Record& record, Findings& findings) {
  const auto& end = record.branches[static_cast<std::size_t>(branch.id)].end;
  if (!end || end->reason != EndReason::switched_branch) return;
  const Index last = branch.points.back().step;
  findings.at("events.json", branch.id, last);
  findings.require(complete,
                   branch.has_event(last, last, [](const ListedEvent& event) { return event.kind == "branch-point"; }),
                   "the branch continues as another without a branch-point");
}

// A branch that ends in a jump ends where it loses its stability, and another begins at the same λ with less energy.
void check_jump(const Branch& branch, const Record& record, Findings& findings) {
  const auto& end = record.branches[static_cast<std::size_t>(branch.id)].end;
  if (!end || end->reason != EndReason::jumped) return;
  const auto lost = std::find_if(branch.events.begin(), branch.events.end(), [](const ListedEvent& event) {
    return event.unstable_before == Index{0} && event.unstable_after.value_or(0) > 0;
  });
  const auto next = std::find_if(record.points.begin(), record.points.end(), [&](const RecordPoint& point) {
    return end->partner && point.branch == *end->partner && point.step == 0;
  });
  findings.at("events.json", branch.id, branch.points.back().step);
  findings.require(complete, lost != branch.events.end(),
                   "the structure jumps without an event at which it loses its stability");
  findings.require(complete, next != record.points.end(), "the structure jumps, and no branch begins after the jump");
  if (lost == branch.events.end() || next == record.points.end()) return;
  const RecordPoint& from = branch.points[static_cast<std::size_t>(lost->step - branch.points.front().step)];
  findings.at("events.json", next->branch, next->step);
  findings.require(complete, next->lambda == from.lambda, "a jump changes λ");
  findings.require(complete, next->energy < from.energy, "a jump increases the energy");
  findings.require(complete, next->count.unstable == Index{0}, "a jump ends at an unstable equilibrium");
}

// --- contacts -------------------------------------------------------------------------------------------------------

bool is_contact_event(const ListedEvent& event) {
  return event.kind.starts_with("contact") && event.kind != "contact-limit-point";
}

// How contacts are told apart: those of nodes by their place, those that slide by their wall, with how many there are,
// those of compliant walls by wall and member.
enum class Contacting { at_nodes, sliding, compliant };
using Contacts = std::map<std::string, Index>;

Contacting contacting(const Model& model) {
  if (model.compliant() != nullptr) return Contacting::compliant;
  return model.sliding() != nullptr ? Contacting::sliding : Contacting::at_nodes;
}

std::string name_of(const ContactLabel& label, Contacting how) {
  switch (how) {
    case Contacting::at_nodes:
      return label.wall + " at " + label.member + ":" + round_trip(label.fraction);
    case Contacting::sliding:
      return label.wall;
    case Contacting::compliant:
      return label.wall + " at " + label.member;
  }
  return {};
}

// Compliant walls may be touched without a force.
Contacts contacts_of(const RecordPoint& point, const Model& model) {
  Contacts contacts;
  const Contacting how = contacting(model);
  if (how != Contacting::compliant) {
    for (const RecordForce& force : point.forces) ++contacts[name_of(force.label, how)];
    return contacts;
  }
  for (std::size_t j = 0; j < point.state.active_set.contacts(); ++j)
    if (point.state.active_set[j] != 0)
      ++contacts[name_of(model.compliant()->contact(point.state, static_cast<Index>(j)).label, how)];
  return contacts;
}

std::set<std::string> changed(const Contacts& from, const Contacts& to) {
  std::set<std::string> names;
  const auto add = [&](const Contacts& all, const Contacts& others) {
    for (const auto& [name, count] : all)
      if (const auto other = others.find(name); other == others.end() || other->second != count) names.insert(name);
  };
  add(from, to);
  add(to, from);
  return names;
}

bool names(const ListedEvent& event, const std::string& contact, Contacting how) {
  return is_contact_event(event) &&
         std::any_of(event.contacts.begin(), event.contacts.end(),
                     [&](const ContactLabel& label) { return name_of(label, how) == contact; });
}

// A branch may leave its first point, where it begins on another, by a change of contact; and the stretch that a change
// makes may be there later only.
void check_contact_changes(const Branch& branch, const Model& model, Findings& findings) {
  const Contacting how = contacting(model);
  const auto makes_stretch = [&](Index step) {
    return branch.has_event(step, step, [](const ListedEvent& event) {
      return event.kind == "contact-spreads" || event.kind == "contact-splits" || event.kind == "contact-opens";
    });
  };
  for (std::size_t i = 0; i + 1 < branch.points.size(); ++i) {
    const RecordPoint &from = branch.points[i], &to = branch.points[i + 1];
    if (branch.id > 0 && from.step == 0) continue;
    const RecordPoint& since =
        how == Contacting::sliding ? branch.points[change_before(branch.points, i, makes_stretch)] : from;
    findings.at("events.json", branch.id, to.step);
    for (const std::string& name : changed(contacts_of(from, model), contacts_of(to, model)))
      findings.require(
          complete,
          branch.has_event(since.step, to.step, [&](const ListedEvent& event) { return names(event, name, how); }),
          fmt::format("the contacts with {} change between steps {} and {} without an event", name, from.step,
                      to.step));
  }
}

// --- turning points -------------------------------------------------------------------------------------------------

// Something whose turning points are events.
struct Turning {
  std::string name{}, kind{};
  std::vector<double> values{};     // one a point
  std::vector<double> uncertain{};  // likewise
  double roundoff = 0.0;
};

bool is_turn(const ListedEvent& event, const Turning& of) {
  if (event.unconfirmed) return false;
  if (of.kind == "turning-point") return event.kind == of.kind && event.monitor == of.name;
  return event.kind == "limit-point" || event.kind == "contact-limit-point" || event.kind == "branch-point";
}

// A turn at a point shows in the differences to its neighbours, where they are more than what is uncertain.
void check_turns(const Branch& branch, const Turning& of, EventSearch search, Findings& findings) {
  const Index later = search == EventSearch::detect ? 1 : 0;  // events stand at the end of the step that has them
  for (std::size_t i = 1; i + 1 < branch.points.size(); ++i) {
    const double before = of.values[i] - of.values[i - 1], after = of.values[i + 1] - of.values[i];
    const double least = of.roundoff + of.uncertain[i - 1] + of.uncertain[i] + of.uncertain[i + 1];
    if (std::min(std::abs(before), std::abs(after)) <= least) continue;
    const Index step = branch.points[i].step;
    const auto turns = [&](const ListedEvent& event) { return is_turn(event, of); };
    findings.at("events.json", branch.id, step);
    if (before * after < 0.0)
      findings.require(complete, branch.has_event(step, step + later, turns),
                       fmt::format("{} has a maximum or minimum at step {} without an event", of.name, step));
    else if (search == EventSearch::locate)
      findings.require(
          complete,
          !branch.has_event(step, step,
                            [&](const ListedEvent& event) { return turns(event) && event.kind != "branch-point"; }),
          fmt::format("{} has no maximum or minimum at step {}, although an event is there", of.name, step));
  }
}

// What a new mesh may move λ by, of its greatest value: the error of the elements, which is seen nowhere else.
constexpr double moved_by_mesh = 1e-3;

// Whether the unknowns at a point mean something else than at the one before, though no contact has changed: the same
// path is followed on another mesh.
bool is_remeshed(const Branch& branch, std::size_t i) {
  const RecordPoint &before = branch.points[i - 1], &point = branch.points[i];
  return before.state.active_set.layout() != point.state.active_set.layout() &&
         !branch.has_event(before.step, point.step, is_contact_event);
}

// Whether the mesh gets a node where it touches, or parts on a wall join, or one gathers to a point: that is known on
// the active set ahead alone, so that the points before may lie beyond it by the error of the elements.
bool is_known_ahead(const Branch& branch, std::size_t i) {
  const RecordPoint &before = branch.points[i - 1], &point = branch.points[i];
  return before.state.active_set.layout() != point.state.active_set.layout() &&
         branch.has_event(point.step, point.step, [](const ListedEvent& event) {
           return event.kind == "contact-closes" || event.kind == "contact-shrinks" || event.kind == "contacts-merge";
         });
}

std::vector<double> uncertainty_of_lambda(const Branch& branch) {
  std::vector<double> uncertain(branch.points.size(), 0.0);
  double greatest = 0.0;
  for (const RecordPoint& point : branch.points) greatest = std::max(greatest, std::abs(point.lambda));
  for (std::size_t i = 1; i < uncertain.size(); ++i)
    if (is_remeshed(branch, i) || is_known_ahead(branch, i)) uncertain[i] = moved_by_mesh * greatest;
  for (const ListedEvent& event : branch.events)
    if (const auto i = static_cast<std::size_t>(event.step - branch.points[0].step); i < uncertain.size())
      uncertain[i] = std::max(uncertain[i], event.lambda_uncertainty);
  return uncertain;
}

// Values are those of converged points: 10⁻⁹ of the greatest is more than is left where two singular points coincide
// (2·10⁻¹⁰ seen).
Turning turning(const Branch& branch, std::string name, std::string kind, double (*value)(const RecordPoint&, Index),
                Index which) {
  Turning of{.name = std::move(name), .kind = std::move(kind)};
  for (const RecordPoint& point : branch.points) {
    of.values.push_back(value(point, which));
    of.roundoff = std::max(of.roundoff, 1e-9 * std::abs(of.values.back()));
  }
  of.uncertain.assign(of.values.size(), 0.0);
  return of;
}

void check_turning_points(const Branch& branch, const Record& record, const Model& model, Findings& findings) {
  const EventSearch search = model.deck().path.events;
  if (search == EventSearch::none) return;
  Turning lambda = turning(
      branch, "λ", "limit-point", [](const RecordPoint& point, Index) { return point.lambda; }, 0);
  lambda.uncertain = uncertainty_of_lambda(branch);
  check_turns(branch, lambda, search, findings);
  for (std::size_t m = 0; m < record.columns.size(); ++m) {
    const std::string& name = record.columns[m].name;
    const auto& watched = model.deck().path.watch;
    if (std::find(watched.begin(), watched.end(), name) == watched.end()) continue;
    const auto value = [](const RecordPoint& point, Index which) {
      return point.monitors[static_cast<std::size_t>(which)];
    };
    check_turns(branch, turning(branch, name, "turning-point", value, static_cast<Index>(m)), search, findings);
  }
}

// --- values that are passed -----------------------------------------------------------------------------------------

// A watched value is met where it is passed; where it is met already at the point before, it was an event there.
void check_passed_value(const Branch& branch, const std::string& name, double passed, double roundoff,
                        const std::function<double(const RecordPoint&)>& value, Findings& findings) {
  constexpr double relative = 1e-11;
  for (std::size_t i = 0; i + 1 < branch.points.size(); ++i) {
    const double before = value(branch.points[i]) - passed, after = value(branch.points[i + 1]) - passed;
    const double zero = std::max(relative * std::max({std::abs(passed), std::abs(before), std::abs(after)}), roundoff);
    if (!(std::abs(before) > zero) || std::isnan(after)) continue;
    const Index step = branch.points[i + 1].step;
    const bool is_event = branch.has_event(step, step, [&](const ListedEvent& event) {
      return event.kind == "value-crossing" && event.monitor == name && event.value == passed;
    });
    const bool is_passed = std::abs(after) <= zero || before * after < 0.0;
    findings.at("events.json", branch.id, step);
    findings.require(complete, is_event == is_passed,
                     fmt::format("{} {} {} at step {}, {} an event", name, is_passed ? "passes" : "does not pass",
                                 round_trip(passed), step, is_passed ? "without" : "in spite of"));
  }
}

void check_passed_values(const Branch& branch, const Record& record, const Model& model, Findings& findings) {
  const auto check = [&](const std::string& name, double passed) {
    const auto column = std::find_if(record.columns.begin(), record.columns.end(),
                                     [&](const RecordColumn& one) { return one.name == name; });
    const MonitorColumn* const here = deck::find(model.monitors(), name);
    check_passed_value(
        branch, name, passed, here != nullptr ? here->roundoff : 0.0,
        [&](const RecordPoint& point) {
          return column == record.columns.end()
                     ? point.lambda
                     : point.monitors[static_cast<std::size_t>(column - record.columns.begin())];
        },
        findings);
  };
  for (const std::string& name : model.deck().path.watch_zero) check(name, 0.0);
  for (const deck::OutputValues& watched : model.deck().path.watch_values)
    for (const double passed : watched.values) check(watched.name, passed);
}

// --- bounds ---------------------------------------------------------------------------------------------------------

// The path ends on a bound that it comes to from inside.
void check_bounds(const Branch& branch, const Record& record, const Model& model, Findings& findings) {
  for (const deck::StopBounds& bounds : model.deck().path.stop.bounds) {
    const auto column = std::find_if(record.columns.begin(), record.columns.end(),
                                     [&](const RecordColumn& one) { return one.name == bounds.name; });
    const auto value = [&](const RecordPoint& point) {
      return column == record.columns.end() ? point.lambda
                                            : point.monitors[static_cast<std::size_t>(column - record.columns.begin())];
    };
    const double first = value(branch.points[0]);
    if (!(first >= bounds.low && first <= bounds.high)) continue;
    for (const RecordPoint& point : branch.points) {
      findings.at("path.csv", branch.id, point.step);
      const double beyond = std::max(bounds.low - value(point), value(point) - bounds.high);
      findings.compare("no point is beyond path.stop", beyond,
                       1e-10 * std::max(std::abs(bounds.low), std::abs(bounds.high)), bounds.name);
    }
  }
}

}  // namespace

void check_completeness(const std::vector<ListedEvent>& events, const Record& record, const Model& model,
                        Findings& findings) {
  for (const Branch& branch : branches_of(record, events)) {
    const Model& here = model.at_stage(record.stage_number(branch.id));
    if (model.deck().path.events != EventSearch::none) check_counts(branch, findings);
    check_switch(branch, record, findings);
    check_jump(branch, record, findings);
    check_contact_changes(branch, here, findings);
    check_turning_points(branch, record, here, findings);
    if (!here.in_increments()) check_passed_values(branch, record, here, findings);
    check_bounds(branch, record, here, findings);
  }
}

}  // namespace arcwall::verify
