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
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/figures.hpp"
#include "benchmarks/models.hpp"
#include "benchmarks/timed_solvers.hpp"
#include "benchmarks/timed_system.hpp"
#include "continuation/explorer.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/model.hpp"

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
  int most_past_limit = std::numeric_limits<int>::max();  // points
};

// What arcs without events took, so that steps with and without closed contacts can be compared.
struct StepCosts {
  // CPU per linearization, and per linearization and unknown [s]: meshes that follow contacts have more elements.
  struct Costs {
    std::vector<double> whole{}, by_unknown{};
  };
  Costs open{}, closed{};
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

struct Measured {
  Index unknowns = 0;  // at the start
  Tally tally{};
  StepCosts step_costs{};
  double seconds = 0.0;    // of the whole path
  double all_parts = 0.0;  // likewise, of the one whose parts were timed
  TimedSystem::Times system{};
  SolverTimes ldlt{};
};

Measured traced(const Task& task, State start_at) {
  const TimedSystem system(task.system);
  Measured measured{.unknowns = start_at.x.size()};
  TraceOptions options = task.options;
  options.ledger = [&](const StepAttempt& attempt) { measured.tally.attempted += attempt.iterations + 1; };
  options.factorization = [&] { return std::make_unique<TimedFactorization>(system, measured.ldlt); };
  {
    const double start = cpu_seconds();
    Explorer explorer(system, std::move(start_at), options, task.watched, task.explore);
    double last = cpu_seconds();
    Index linearizations = 0;
    while (measured.tally.points_past_limit < task.most_past_limit) {
      const auto step = explorer.next();
      if (!step) break;
      const double now = cpu_seconds();
      const Index used = system.times().linearizations - linearizations;
      const State& to = step->arc.to.state;
      StepCosts::Costs& costs =
          to.active_set.closed_count() > 0 ? measured.step_costs.closed : measured.step_costs.open;
      if (step->arc.events.empty() && used > 0) {
        costs.whole.push_back((now - last) / double(used));
        costs.by_unknown.push_back(costs.whole.back() / double(to.x.size()));
      }
      last = now;
      linearizations = system.times().linearizations;
      add(step->arc, measured.tally);
    }
    measured.seconds = measured.all_parts = cpu_seconds() - start;
  }
  measured.system = system.times();
  return measured;
}

void print(const std::string& work, long size, const Task& task, const Measured& measured) {
  const Tally& tally = measured.tally;
  const TimedSystem::Times& system = measured.system;
  const SolverTimes& ldlt = measured.ldlt;
  const double seconds = measured.seconds;
  const auto figure = [&](const char* name, const char* unit, double value) {
    print_figure(work, size, name, unit, value);
  };
  const auto share = [&](const char* name, double part) { figure(name, "", part / measured.all_parts); };
  const auto count = [&](const char* name, auto value) { figure(name, "", double(value)); };
  const auto per_element = [&](const char* name, double sum, auto times) {
    figure(name, "us", 1e6 * sum / (double(times) * double(task.elements)));
  };

  figure("path", "s", seconds);
  share("share assembly", system.assembly);
  share("share factorization", ldlt.factorization);
  share("share solution", ldlt.solution);
  share("share side conditions", system.side_conditions);
  share("share rest",
        measured.all_parts - system.assembly - system.side_conditions - ldlt.factorization - ldlt.solution);
  count("elements", task.elements);
  count("nodes", task.nodes);
  count("unknowns", measured.unknowns);
  count("points", tally.points);
  count("points past the limit point", tally.points_past_limit);
  count("iterations", tally.iterations);
  count("events", tally.events);
  count("contact changes", tally.contact_changes);
  count("first limit", tally.first_limit);
  count("iterations in all", ldlt.iterations);
  count("linearizations", system.linearizations);
  count("linearizations of steps", tally.attempted);
  count("factorizations", ldlt.factorizations);
  count("solutions", ldlt.solutions);
  count("right-hand sides", ldlt.columns);
  per_element("per iteration and element", seconds, ldlt.iterations);
  per_element("per iteration of accepted steps and element", seconds, tally.iterations);
  per_element("per linearization and element", seconds, system.linearizations);
  per_element("per factorization and element", ldlt.factorization, ldlt.factorizations);
  const auto costs = [&](const std::string& of, const StepCosts::Costs& all) {
    figure(("per linearization with " + of).c_str(), "us", 1e6 * median(all.whole));
    figure(("per linearization and unknown with " + of).c_str(), "us", 1e6 * median(all.by_unknown));
  };
  if (!measured.step_costs.closed.whole.empty()) {
    costs("open contacts", measured.step_costs.open);
    costs("closed contacts", measured.step_costs.closed);
  }
  figure("peak memory", "kB", peak_kilobytes());
}

// Where looking at the clock would count, or the first steps of a process, the path is traced without it before, more
// than once; of these the least time.
void trace(const std::string& work, long size, Task task) {
  constexpr Index small = 5000;
  constexpr int times = 5;
  constexpr double slow = 2.0;  // [s]: once is enough
  times_parts = false;
  double untouched = infinity;
  for (int round = 0; round < times && task.elements <= small; ++round) {
    untouched = std::min(untouched, traced(task, task.start).seconds);
    if (untouched > slow) break;
  }
  times_parts = true;
  Measured measured = traced(task, std::move(task.start));  // the path alone holds states
  if (task.elements <= small) measured.seconds = untouched;
  print(work, size, task, measured);
}

// Of stars and frames what lies around the first limit point is wanted: in large ones others follow it close by.
void trace_model(const std::string& work, long size, bench::Model (*make)(Index), int most_past_limit) {
  const bench::Model model = make(size);
  TraceOptions options{.step = {.first = model.first_step}};
  options.target_values.push_back({.quantity = model.down, .value = model.end, .stops = true, .label = "down"});
  trace(work, size,
        {.system = *model.structure,
         .start = rest(*model.structure),
         .options = options,
         .elements = model.elements,
         .nodes = model.structure->node_count(),
         .most_past_limit = most_past_limit});
}

int trace_deck(const std::string& name, const std::string& file, long size,
               const std::vector<std::string>& assignments) {
  const arcwall::Model model(deck::read_deck(file, assignments));
  std::string reason;
  const auto start = model.start(reason);
  if (!start) {
    std::cerr << "time_split: " << reason << "\n";
    return 1;
  }
  trace(name, size,
        {.system = model.system(),
         .start = *start,
         .options = model.options(),
         .watched = model.watched(),
         .explore = model.explore(),
         .elements = model.structure().element_count(),
         .nodes = model.structure().node_count()});
  return 0;
}

constexpr int arm_elements = 100;  // more would only make K of single arms worse conditioned

bench::Model lee(Index elements) { return lee_frame(static_cast<int>(elements)); }
bench::Model star(Index unknowns) {
  return star_of_arches(static_cast<int>(unknowns / (3 * arm_elements)), arm_elements);
}
bench::Model frame(Index unknowns) { return square_frame(square_side(unknowns)); }

int run(const std::vector<std::string>& words) {
  const std::string work = words.size() >= 2 ? words[0] : "";
  if (work == "deck" && words.size() >= 4)
    return trace_deck(words[1], words[2], std::atol(words[3].c_str()), {words.begin() + 4, words.end()});
  const long size = words.size() == 2 ? std::atol(words[1].c_str()) : 0;
  bench::Model (*const make)(Index) = work == "lee" ? lee : work == "star" ? star : work == "frame" ? frame : nullptr;
  if (make == nullptr || size < 10) {
    std::cerr
        << "usage: time_split lee ELEMENTS | star UNKNOWNS | frame UNKNOWNS | deck NAME FILE SIZE [KEY=VALUE …]\n";
    return 2;
  }
  constexpr int shown = 12, all = std::numeric_limits<int>::max();
  trace_model(work, size, make, work == "lee" ? all : shown);
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
