#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "apps/output/report_html.hpp"
#include "continuation/explorer.hpp"
#include "core/text.hpp"
#include "model/recorder.hpp"
#include "python/engine/columns.hpp"
#include "python/engine/python_system.hpp"

namespace arcwall::python {

namespace {

// One of the unknowns.
class UnknownValue final : public Observable {
 public:
  explicit UnknownValue(Index unknown) : unknown_(unknown) {}
  double value(const State& state) const override { return state.x[unknown_]; }
  Row gradient(const State& state) const override {
    return {.dx = Vector::Unit(state.x.size(), unknown_), .dlambda = 0.0};
  }

 private:
  Index unknown_;
};

// λ, where no unknown is named.
std::shared_ptr<const Observable> quantity(std::optional<Index> unknown) {
  if (!unknown) return std::make_shared<ParameterValue>();
  return std::make_shared<UnknownValue>(*unknown);
}

std::string name_of(std::optional<Index> unknown) { return unknown ? "x[" + std::to_string(*unknown) + "]" : "lambda"; }

// A value of λ or of an unknown; whether the path ends there; and its name.
using Target = std::tuple<std::optional<Index>, double, bool, std::string>;
// A label, a function of (x, lam), and 0, 1 or −1 for any, rising and falling zeros.
using Detector = std::tuple<std::string, py::object, int>;

struct Wishes {
  double step = 0.02, least_step = 1e-8, greatest_step = 0.2;
  int max_points = 5000, depth = 2;
  std::string branches = "primary", method = "spherical";
  std::vector<Target> targets{};
  std::vector<std::string> stop_events{};
  std::vector<Detector> detectors{};
  std::vector<Index> watch{};
};

EventDetector detector_of(const Detector& wanted) {
  const auto& [label, function, direction] = wanted;
  const std::string what = "event function \"" + label + "\"";
  const auto value = [function = function, what](const PathPoint& point) {
    const double found =
        asked(function, what, point.state, [&](const py::object& of) { return number_from(of, what); });
    if (!std::isfinite(found)) raise("NotFinite", "", {.what = what + " is not finite", .state = point.state});
    return found;
  };
  const Crossing crossing = direction == 0 ? Crossing::any : direction > 0 ? Crossing::rising : Crossing::falling;
  return {.label = label, .crossing = crossing, .value = value};
}

TraceOptions trace_options(const Wishes& wishes) {
  TraceOptions options;
  options.step.first = wishes.step;
  options.step.min = wishes.least_step;
  options.step.max = wishes.greatest_step;
  options.max_points = wishes.max_points;
  if (wishes.method == "load") options.method = PathMethod::load;
  for (const auto& [unknown, value, stops, label] : wishes.targets)
    options.target_values.push_back({.quantity = quantity(unknown), .value = value, .stops = stops, .label = label});
  for (const std::string& name : wishes.stop_events) {
    const auto kind = event_kind(name);
    if (!kind) throw py::value_error("\"" + name + "\" is no kind of event");
    options.stop_events.push_back({.kind = *kind, .label = "event = " + name});
  }
  for (const Detector& detector : wishes.detectors) options.detectors.push_back(detector_of(detector));
  return options;
}

ExploreOptions explore_options(const Wishes& wishes) {
  ExploreOptions options;
  options.depth = wishes.depth;
  if (wishes.branches == "most-stable") options.policy = BranchPolicy::most_stable;
  if (wishes.branches == "all") options.policy = BranchPolicy::all;
  return options;
}

std::vector<Watch> watched(const Wishes& wishes) {
  std::vector<Watch> result;
  for (const Index unknown : wishes.watch) result.push_back({.quantity = quantity(unknown), .label = name_of(unknown)});
  return result;
}

// The paths of a system of Python's, traced point by point into a record. The interpreter's lock is held throughout:
// nearly all of the time goes into functions of Python.
class SystemRun {
 public:
  SystemRun(const py::object& system, Vector x, double lambda, Vector weights, const Wishes& wishes)
      : system_(system, std::move(weights)),
        explorer_(system_, {.x = std::move(x), .lambda = lambda}, trace_options(wishes), watched(wishes),
                  explore_options(wishes)) {}
  SystemRun(const SystemRun&) = delete;
  SystemRun& operator=(const SystemRun&) = delete;

  // At most so many points more, in that time; returns how many there were.
  Index advance(Index most_points, double most_seconds) {
    if (phase_ == Phase::tracing) throw std::runtime_error("a function of this system asks for more of its own path");
    if (phase_ == Phase::failed)
      throw std::runtime_error("this path was ended by an exception; what was traced before it is there");
    const auto begin = std::chrono::steady_clock::now();
    const auto in_time = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < most_seconds;
    };
    Index points = 0;
    while (points < most_points && (points == 0 || in_time()) && !ahead_ && whole_step()) {
      ++points;
      raise_what_waits();
    }
    if (const auto met = std::exchange(ahead_, std::nullopt)) raise("NotFinite", "no step ahead succeeds: ", *met);
    return points;
  }

  const Record& record() const { return record_; }
  bool has_ended() const { return ended_; }

  // Critical modes of the branch points, by the number of the event.
  py::dict modes() const {
    py::dict modes;
    for (const RecordBranchPoint& at : record_.branch_points)
      if (at.point->mode.dx.size() > 0) modes[py::int_(at.event)] = to_array(at.point->mode.dx);
    return modes;
  }

 private:
  enum class Phase { idle, tracing, failed };

  // What is raised inside of a step leaves it half done; between two steps a path can go on.
  bool whole_step() {
    phase_ = Phase::tracing;
    try {
      const bool more = step();
      phase_ = Phase::idle;
      return more;
    } catch (...) {
      phase_ = Phase::failed;
      throw;
    }
  }

  bool step() {
    if (ended_) return false;
    system_.take_not_finite();
    const std::optional<Explorer::Step> step = explorer_.next();
    const std::optional<NotFinite> met = system_.take_not_finite();
    if (!step) {
      finish(met);
      return false;
    }
    if (step->branch != branch_) {
      if (recorder_) end_branch(met);
      branch_ = step->branch;
      recorder_.emplace(system_, record_, branch());
    }
    if (record_.points.empty()) require_equilibrium(step->arc.to, met);
    recorder_->add(step->arc);
    // What the program's detectors found is known by their labels.
    const std::size_t first = record_.events.size() - step->arc.events.size();
    for (std::size_t i = 0; i < step->arc.events.size(); ++i)
      if (step->arc.events[i].kind == EventKind::user) record_.events[first + i].monitor = step->arc.events[i].label;
    return true;
  }

  // A branch that ended since residuals ahead are no numbers has its end in the record before that is raised.
  void end_branch(const std::optional<NotFinite>& met) {
    const BranchEnd& end = *branch().end;
    recorder_->end(end);
    const bool found_no_step =
        end.reason == EndReason::not_finite || end.reason == EndReason::min_step || end.reason == EndReason::singular;
    if (found_no_step) ahead_ = met;
  }

  // A tracer begins where it is told, and corrects the start as far as Newton's method does.
  void require_equilibrium(const PathPoint& start, const std::optional<NotFinite>& met) {
    constexpr double nearly = 1e-6;
    if (start.residual <= nearly) return;
    ended_ = true;
    if (met) raise("NoStart", no_start, *met);
    raise("NoStart", no_start + ("from x0 Newton's method finds none at lam0 = " + round_trip(start.state.lambda)) +
                         "; the relative residual is " + round_trip(start.residual));
  }

  void finish(const std::optional<NotFinite>& met) {
    ended_ = true;
    if (recorder_) return end_branch(met);
    if (met) raise("NoStart", no_start, *met);
    const BranchEnd end = explorer_.branches().front().end.value();
    raise("NoStart",
          no_start + std::string(explanation(end.reason)) + (end.detail.empty() ? "" : " (" + end.detail + ")"));
  }

  inline static const std::string no_start = "there is no equilibrium at the start: ";

  const BranchRecord& branch() const { return explorer_.branches()[static_cast<std::size_t>(branch_)]; }

  PythonSystem system_;
  Record record_{};
  Explorer explorer_;
  std::optional<Recorder> recorder_{};
  int branch_ = -1;
  bool ended_ = false;
  std::optional<NotFinite> ahead_{};  // of the branch that has just ended; to be raised
  Phase phase_ = Phase::idle;
};

}  // namespace

void bind_systems(py::module_& module) {
  py::class_<Wishes> wishes(module, "Wishes");
  wishes.def(py::init<>())
      .def_readwrite("step", &Wishes::step)
      .def_readwrite("least_step", &Wishes::least_step)
      .def_readwrite("greatest_step", &Wishes::greatest_step)
      .def_readwrite("max_points", &Wishes::max_points)
      .def_readwrite("depth", &Wishes::depth)
      .def_readwrite("branches", &Wishes::branches)
      .def_readwrite("method", &Wishes::method)
      .def_readwrite("targets", &Wishes::targets)
      .def_readwrite("stop_events", &Wishes::stop_events)
      .def_readwrite("detectors", &Wishes::detectors)
      .def_readwrite("watch", &Wishes::watch);
  py::class_<SystemRun> run(module, "SystemRun");
  run.def(py::init([](const py::object& system, const py::array_t<double>& x, double lambda,
                      const py::array_t<double>& weights, const Wishes& options) {
            return std::make_unique<SystemRun>(system, vector_from(x, x.size(), "x0"), lambda,
                                               vector_from(weights, x.size(), "weights"), options);
          }),
          py::arg("system"), py::arg("x"), py::arg("lam"), py::arg("weights"), py::arg("wishes"))
      .def("advance", &SystemRun::advance, py::arg("points"), py::arg("seconds"))
      .def("has_ended", &SystemRun::has_ended)
      .def("modes", &SystemRun::modes)
      .def(
          "curve",
          [](const SystemRun& self, std::optional<std::size_t> monitor) {
            return curve_html(self.record(), {}, monitor);
          },
          py::arg("monitor"));
  bind_record(run);
}

}  // namespace arcwall::python
