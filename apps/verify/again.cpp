#include "apps/verify/again.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "answers/deck_family.hpp"
#include "answers/search.hpp"
#include "answers/sessions.hpp"
#include "core/text.hpp"
#include "model/event_names.hpp"

namespace arcwall::verify {

namespace {

std::vector<std::string> contact_names(const RecordEvent& event) {
  std::vector<std::string> names;
  for (const RecordContact& contact : event.contacts)
    names.push_back(contact.label.wall + " at " + contact.label.member);
  std::sort(names.begin(), names.end());
  return names;
}

std::string name_of(const RecordEvent& event) {
  std::string name(to_text(event.kind));
  if (event.branch_end) name += " (" + std::string(to_text(event.branch_end->reason)) + ")";
  if (event.monitor) name += " of " + *event.monitor;
  if (event.value) name += " = " + round_trip(*event.value);
  std::string list;
  for (const std::string& contact : contact_names(event)) list += (list.empty() ? " of " : ", ") + contact;
  return name + list;
}

bool is_limit(EndReason reason) {
  return reason == EndReason::max_points || reason == EndReason::max_time || reason == EndReason::interrupted;
}

// An early end, and a loop that is recognised, lie where a step happens to end.
bool has_a_place(const RecordEvent& event) {
  if (!event.branch_end) return true;
  const EndReason reason = event.branch_end->reason;
  return reason == EndReason::stop || reason == EndReason::switched_branch || reason == EndReason::jumped ||
         reason == EndReason::reached_branch;
}

struct EventsOfBranch {
  std::vector<const RecordEvent*> events{};
  bool cut = false;  // by a limit
};

// Where a branch that was found has come to what is traced already: it is seen where it passes the λ at which branches
// began, and which of two branches goes on beyond hangs on their order.
bool is_known_beyond(EndReason reason) {
  return reason == EndReason::reached_branch || reason == EndReason::closed_loop;
}

// Without the ends that limits made, or the order of branches that were found.
EventsOfBranch events_of_branch(const Record& record, Index id) {
  EventsOfBranch branch;
  const bool found = id >= 0 && comes_of_search(record, record.branches[static_cast<std::size_t>(id)]);
  for (const RecordEvent& event : record.events) {
    if (event.branch != id) continue;
    if (event.branch_end &&
        (is_limit(event.branch_end->reason) || (found && is_known_beyond(event.branch_end->reason))))
      branch.cut = true;
    else
      branch.events.push_back(&event);
  }
  return branch;
}

double range_of_lambda(const Record& record) {
  double least = infinity, greatest = -infinity;
  for (const RecordPoint& point : record.points) {
    least = std::min(least, point.lambda);
    greatest = std::max(greatest, point.lambda);
  }
  return greatest - least;
}

// What happens at one λ, as nearly as can be told, has no order: of two contacts that close together by symmetry,
// round-off says which is first.
void sort_at_one_lambda(std::vector<const RecordEvent*>& events, double allowed) {
  const auto together = [&](const RecordEvent* a, const RecordEvent* b) {
    const bool between = a->kind != EventKind::start && !b->branch_end;
    return between && std::abs(a->lambda - b->lambda) <= allowed + a->lambda_uncertainty + b->lambda_uncertainty;
  };
  for (auto first = events.begin(); first != events.end();) {
    auto last = first + 1;
    while (last != events.end() && together(*(last - 1), *last)) ++last;
    std::stable_sort(first, last, [](const auto* a, const auto* b) { return name_of(*a) < name_of(*b); });
    first = last;
  }
}

// The pairs of two lists that agree by `same`, as many as possible, in their order: a longest common subsequence.
template <class Same>
std::vector<std::pair<std::size_t, std::size_t>> paired(std::size_t m, std::size_t n, const Same& same) {
  std::vector<std::vector<std::size_t>> longest(m + 1, std::vector<std::size_t>(n + 1, 0));  // of what follows (i, j)
  for (std::size_t i = m; i-- > 0;)
    for (std::size_t j = n; j-- > 0;)
      longest[i][j] = same(i, j) ? longest[i + 1][j + 1] + 1 : std::max(longest[i + 1][j], longest[i][j + 1]);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0, j = 0; i < m && j < n;) {
    if (same(i, j))
      pairs.emplace_back(i++, j++);
    else
      longest[i + 1][j] >= longest[i][j + 1] ? ++i : ++j;
  }
  return pairs;
}

// What stands between two pairs is in one run only. Behind the last pair, a run that was stopped tells nothing.
class Comparer {
 public:
  Comparer(const Record& stored, const Record& again, double discretisation)
      : stored_(stored), again_(again), allowed_(discretisation * range_of_lambda(stored)) {}

  Comparison compare() {
    for (const bool found : {false, true}) {
      const std::vector<Index> stored = branches(stored_, found), again = branches(again_, found);
      for (std::size_t i = 0; i < std::max(stored.size(), again.size()); ++i) {
        if (found && i >= again.size())
          not_reached(stored[i]);
        else
          compare_branches(i < stored.size() ? stored[i] : -1, i < again.size() ? again[i] : -1);
      }
    }
    return std::move(comparison_);
  }

 private:
  // Those that were found, or the others, in their order.
  static std::vector<Index> branches(const Record& record, bool found) {
    std::vector<Index> ids;
    for (const RecordBranch& branch : record.branches)
      if (comes_of_search(record, branch) == found) ids.push_back(branch.id);
    return ids;
  }

  // The branches before it took the points that the second run may have, or its mesh is another one.
  void not_reached(Index id) {
    comparison_.reservations.push_back(
        fmt::format("branch {}, which a search has found, was not traced again: the other run ended before", id));
  }

  // −1: it has none
  void compare_branches(Index stored, Index again) {
    EventsOfBranch first = events_of_branch(stored_, stored), second = events_of_branch(again_, again);
    sort_at_one_lambda(first.events, allowed_);
    sort_at_one_lambda(second.events, allowed_);
    const auto pairs = paired(first.events.size(), second.events.size(), [&](std::size_t i, std::size_t j) {
      const RecordEvent &a = *first.events[i], &b = *second.events[j];
      return a.kind == b.kind && a.unconfirmed == b.unconfirmed && name_of(a) == name_of(b);
    });
    std::size_t i = 0, j = 0;
    for (const auto& [to_i, to_j] : pairs) {
      for (; i < to_i; ++i) only_in("the stored run", *first.events[i], false);
      for (; j < to_j; ++j) only_in("the run with a quarter of the step", *second.events[j], false);
      compare_lambda(*first.events[i++], *second.events[j++]);
    }
    for (; i < first.events.size(); ++i) only_in("the stored run", *first.events[i], second.cut);
    for (; j < second.events.size(); ++j) only_in("the run with a quarter of the step", *second.events[j], first.cut);
  }

  void only_in(const std::string& run, const RecordEvent& event, bool other_was_stopped) {
    const std::string what =
        fmt::format("{} on branch {} at λ = {:.10g} is in {} only", name_of(event), event.branch, event.lambda, run);
    if (event.unconfirmed)
      comparison_.reservations.push_back(what + "; it is unconfirmed");
    else if (other_was_stopped)
      comparison_.reservations.push_back(what + "; the other was stopped before");
    else
      comparison_.differences.push_back(what);
  }

  void compare_lambda(const RecordEvent& a, const RecordEvent& b) {
    if (a.unconfirmed || !has_a_place(a)) return;
    ++comparison_.same;
    const double off = std::abs(a.lambda - b.lambda), allowed = allowed_ + a.lambda_uncertainty + b.lambda_uncertainty;
    if (off * comparison_.worst_allowed >= comparison_.worst * allowed) {
      comparison_.worst = off;
      comparison_.worst_allowed = allowed;
    }
    if (!(off <= allowed))
      comparison_.differences.push_back(
          fmt::format("{} on branch {} is at λ = {:.10g}, and at {:.10g} with a quarter of the step: they differ by "
                      "{:.3g}, {:.3g} is allowed",
                      name_of(a), a.branch, a.lambda, b.lambda, off, allowed));
  }

  const Record &stored_, &again_;
  double allowed_;
  Comparison comparison_{};
};

// Where the branches of a search began, in the terms of another model of the deck; as far as its mesh is the same.
std::vector<BranchStart> found_starts(const Record& record, const Model& model) {
  std::vector<BranchStart> starts;
  for (const RecordBranch& branch : record.branches) {
    if (!branch.found) continue;
    const auto first = std::find_if(record.points.begin(), record.points.end(),
                                    [&](const RecordPoint& point) { return point.branch == branch.id; });
    if (first == record.points.end()) break;
    std::optional<State> state = state_on(model, first->state);
    if (!state) break;
    const bool falls = branch.points > 1 && (first + 1)->lambda < first->lambda;
    starts.push_back({.state = std::move(*state), .sense = falls ? -1 : 1});
  }
  return starts;
}

// With a point or an exponent, as TOML wants its floats.
std::string toml_number(double value) {
  const std::string text = round_trip(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::optional<Session> traced_again(const Session& run) {
  const deck::Path& path = run.model().deck().path;
  RunDescription shorter = run.description();
  shorter.ledger = StepLedger::none;
  const double greatest = std::max(0.25 * path.max_step, path.min_step);
  const std::size_t points = 4 * run.points().size() + 100;
  shorter.assignments.push_back("path.step=" + toml_number(0.25 * path.step));
  shorter.assignments.push_back("path.max_step=" + toml_number(greatest));
  shorter.assignments.push_back("path.max_points=" + std::to_string(points));
  // What was found began at states that Newton's method came to, which nothing else leads to: branches begin there
  // anew.
  shorter.assignments.emplace_back("path.search=false");
  shorter.assignments.emplace_back("path.jumps=false");  // falls have no steps of the path
  std::optional<Session> again = make_session(std::move(shorter));
  if (!again->begin()) return std::nullopt;
  again->trace_also(found_starts(run.record(), again->model()));
  while (again->next() != nullptr) {
  }
  return again;
}

Comparison compare(const Record& stored, const Record& again, double discretisation) {
  return Comparer(stored, again, discretisation).compare();
}

double step_discretisation(const Model& model) { return model.sliding() != nullptr ? 1e-6 : 1e-8; }

std::string to_text(const Comparison& comparison, const std::string& how) {
  std::string text = fmt::format("{}: {} events agree, λ to {:.3g} where {:.3g} is allowed\n", how, comparison.same,
                                 comparison.worst, comparison.worst_allowed);
  for (const std::string& sentence : comparison.reservations) text += "- " + sentence + "\n";
  return text;
}

}  // namespace arcwall::verify
