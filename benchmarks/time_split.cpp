// Where the time of a path goes, and its memory:
//
//   time_split lee ELEMENTS | star UNKNOWNS | frame UNKNOWNS
//   time_split deck NAME FILE SIZE [KEY=VALUE …]
//
// A deck's NAME and SIZE are only printed.
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "apps/deck/reader.hpp"
#include "apps/study.hpp"
#include "benchmarks/figures.hpp"
#include "benchmarks/models.hpp"
#include "benchmarks/timed_ldlt.hpp"
#include "benchmarks/timed_system.hpp"
#include "continuation/explorer.hpp"
#include "core/error.hpp"

namespace {

using namespace arcwall;
using namespace arcwall::bench;

// What is traced, whatever it was made from.
struct Task {
  const System& system;
  State start;
  TraceOptions options;
  std::vector<Watch> watched{};
  ExploreOptions explore{};
  Index elements = 0;
  Index nodes = 0;
};

// What arcs without events took, so that steps with and without closed contacts can be compared.
struct StepCosts {
  std::vector<double> open{}, closed{};  // CPU per linearization [s]
};

struct Tally {
  int points = 0, iterations = 0, events = 0, contact_changes = 0, points_past_limit = 0;
  Index attempted = 0;  // linearizations of the steps themselves, those that failed included
  double first_limit = 0.0;
};

double peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void add(const Arc& arc, Tally& tally) {
  ++tally.points;
  tally.iterations += arc.to.iterations;
  if (tally.first_limit != 0.0) ++tally.points_past_limit;
  for (const Event& event : arc.events) {
    ++tally.events;
    tally.contact_changes += !event.guards.empty();
    if (event.kind == EventKind::limit_point && tally.first_limit == 0.0) tally.first_limit = event.state.lambda;
  }
}

void trace(const std::string& work, long size, const Task& task) {
  const TimedSystem system(task.system);
  TraceOptions options = task.options;
  Tally tally;
  StepCosts step_costs;
  options.ledger = [&](const StepAttempt& attempt) { tally.attempted += attempt.iterations + 1; };
  const LdltTimes before = ldlt_times();
  double seconds = 0.0;
  {
    const ScopedTimer timer(seconds);
    Explorer explorer(system, task.start, options, task.watched, task.explore);
    double last = cpu_seconds();
    Index linearizations = 0;
    while (const auto step = explorer.next()) {
      const double now = cpu_seconds();
      const Index used = system.times().linearizations - linearizations;
      auto& costs = step->arc.to.state.piece.closed_count() > 0 ? step_costs.closed : step_costs.open;
      if (step->arc.events.empty() && used > 0) costs.push_back((now - last) / double(used));
      last = now;
      linearizations = system.times().linearizations;
      add(step->arc, tally);
    }
  }
  const LdltTimes& ldlt = ldlt_times();
  const double factorization = ldlt.factorization - before.factorization, solution = ldlt.solution - before.solution;
  const double known = system.times().assembly + system.times().side_conditions + factorization + solution;

  const auto print = [&](const char* figure, const char* unit, double value) {
    print_figure(work, size, figure, unit, value);
  };
  print("path", "s", seconds);
  print("share assembly", "", system.times().assembly / seconds);
  print("share factorization", "", factorization / seconds);
  print("share solution", "", solution / seconds);
  print("share side conditions", "", system.times().side_conditions / seconds);
  print("share rest", "", 1.0 - known / seconds);
  print("elements", "", double(task.elements));
  print("nodes", "", double(task.nodes));
  print("unknowns", "", double(task.start.x.size()));
  print("points", "", tally.points);
  print("points past the limit point", "", tally.points_past_limit);
  print("iterations", "", tally.iterations);
  print("events", "", tally.events);
  print("contact changes", "", tally.contact_changes);
  print("first limit", "", tally.first_limit);
  print("linearizations", "", double(system.times().linearizations));
  print("linearizations of steps", "", double(tally.attempted));
  print("factorizations", "", double(ldlt.factorizations - before.factorizations));
  print("solutions", "", double(ldlt.solutions - before.solutions));
  print("right-hand sides", "", double(ldlt.columns - before.columns));
  print("per iteration and element", "us", 1e6 * seconds / (double(tally.iterations) * double(task.elements)));
  print("per linearization and element", "us",
        1e6 * seconds / (double(system.times().linearizations) * double(task.elements)));
  print("per factorization and element", "us",
        1e6 * factorization / (double(ldlt.factorizations - before.factorizations) * double(task.elements)));
  if (!step_costs.closed.empty()) {
    print("per linearization with open contacts", "us", 1e6 * median(step_costs.open));
    print("per linearization with closed contacts", "us", 1e6 * median(step_costs.closed));
  }
  print("peak memory", "kB", peak_kilobytes());
}

void trace_model(const std::string& work, long size, Model (*make)(Index)) {
  const Model model = make(size);
  TraceOptions options{.step = {.first = model.first_step}};
  options.landmarks.push_back({.quantity = model.down, .value = model.end, .stops = true, .label = "down"});
  trace(work, size,
        {.system = *model.structure,
         .start = rest(*model.structure),
         .options = options,
         .elements = model.elements,
         .nodes = model.structure->node_count()});
}

int trace_deck(const std::string& name, const std::string& file, long size,
               const std::vector<std::string>& assignments) {
  const Study study(deck::read_deck(file, assignments));
  std::string reason;
  const auto start = study.start(reason);
  if (!start) {
    std::cerr << "time_split: " << reason << "\n";
    return 1;
  }
  trace(name, size,
        {.system = study.system(),
         .start = *start,
         .options = study.options(),
         .watched = study.watched(),
         .explore = study.explore(),
         .elements = study.structure().element_count(),
         .nodes = study.structure().node_count()});
  return 0;
}

constexpr int star_arms = 20;

Model lee(Index elements) { return lee_frame(static_cast<int>(elements)); }
Model star(Index unknowns) { return star_of_arches(star_arms, static_cast<int>(unknowns / (3 * star_arms))); }
Model frame(Index unknowns) { return square_frame(square_side(unknowns)); }

int run(const std::vector<std::string>& words) {
  const std::string work = words.size() >= 2 ? words[0] : "";
  if (work == "deck" && words.size() >= 4)
    return trace_deck(words[1], words[2], std::atol(words[3].c_str()), {words.begin() + 4, words.end()});
  const long size = words.size() == 2 ? std::atol(words[1].c_str()) : 0;
  Model (*const make)(Index) = work == "lee" ? lee : work == "star" ? star : work == "frame" ? frame : nullptr;
  if (make == nullptr || size < 10) {
    std::cerr
        << "usage: time_split lee ELEMENTS | star UNKNOWNS | frame UNKNOWNS | deck NAME FILE SIZE [KEY=VALUE …]\n";
    return 2;
  }
  trace_model(work, size, make);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run({arguments + 1, arguments + count});
  } catch (const std::exception& problem) {
    std::cerr << "time_split: " << problem.what() << "\n";
    return 1;
  }
}
