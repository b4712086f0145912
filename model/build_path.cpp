#include "model/build_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "model/deck/words.hpp"

namespace arcwall {

namespace {

PathMethod path_method(deck::PathMethod method) {
  switch (method) {
    case deck::PathMethod::load:
      return PathMethod::load;
    case deck::PathMethod::displacement:
      return PathMethod::displacement;
    case deck::PathMethod::riks:
      return PathMethod::riks;
    case deck::PathMethod::normal_plane:
      return PathMethod::normal_plane;
    case deck::PathMethod::cylindrical:
      return PathMethod::cylindrical;
    case deck::PathMethod::spherical:
      return PathMethod::spherical;
    case deck::PathMethod::pseudo_arclength:
      return PathMethod::pseudo_arclength;
    case deck::PathMethod::incremental:  // has no steps along the path
      break;
  }
  return PathMethod::spherical;
}

// Whether the direction is held and nothing moves it with λ.
bool is_at_rest(const Measured& from, const deck::Control& control) {
  const Structure& structure = from.structure;
  const Places::Node place = from.places.find(control.at, structure.members());
  std::optional<Index> dof;
  if (control.component == deck::Component::x) dof = structure.dof(place.node, Dof::x);
  if (control.component == deck::Component::z) dof = structure.dof(place.node, Dof::z);
  if (!dof || structure.unknown(*dof)) return false;
  bool moved = false;
  structure.nodal_terms().for_each_moved_support([&](Index one, double rate) {
    if (one == *dof && rate != 0.0) moved = true;
  });
  return !moved;
}

}  // namespace

std::vector<double> load_levels(const deck::Path& path) {
  std::vector<double> levels;
  double from = 0.0;
  for (const deck::OutputValues& output : path.output_at) {
    if (output.name != "lambda") continue;
    for (const double value : output.values) {
      // A level that round-off alone keeps from being met needs no increment of its own.
      const int parts = std::max(1, static_cast<int>(std::ceil(std::abs((value - from) / path.step) - 1e-9)));
      for (int i = 1; i < parts; ++i) levels.push_back(from + (value - from) * i / parts);
      levels.push_back(value);
      from = value;
    }
  }
  return levels;
}

TraceOptions trace_options(const deck::Deck& deck, const Measured& from, const std::vector<MonitorColumn>& monitors,
                           DeckProblems& problems) {
  const deck::Path& path = deck.path;
  TraceOptions options;
  options.method = path_method(path.method);
  options.events = path.events;
  options.step.first = path.step;
  options.step.min = path.min_step;
  options.step.max = path.max_step;
  options.max_points = path.max_points;
  options.stay = path.branches != BranchPolicy::most_stable && path.branches != BranchPolicy::jump;
  if (path.control) {
    options.control = shown_at(from, path.control->at, path.control->component);
    if (!options.control)
      problems.add(path.control->at.position, "path.control",
                   "\"" + to_text(path.control->at) + "\" cannot be controlled so",
                   "name a component that the place has");
    if (options.control && is_at_rest(from, *path.control))
      problems.add(path.control->at.position, "path.control",
                   "\"" + to_text(path.control->at) + "\" is held in that direction, so that it cannot be controlled",
                   "name a direction that is free, or that λ moves");
  }
  enum class At { output, stop, event };
  const auto mark = [&](const std::string& name, double value, At at) {
    const MonitorColumn* const column = deck::find(monitors, name);
    if (column != nullptr &&
        (column->component == deck::Component::dissipation || column->component == deck::Component::friction_use))
      return problems.add(path.position, "path",
                          "no value of \"" + name + "\" can be solved for: it is read off points",
                          "name λ or another monitor");
    if (column != nullptr || name == "lambda")
      options.target_values.push_back(
          {.quantity = column != nullptr ? column->quantity : std::make_shared<ParameterValue>(),
           .value = value,
           .roundoff = column != nullptr ? column->roundoff : 0.0,
           .stops = at == At::stop,
           .label = name + " = " + round_trip(value),
           .event = at == At::event ? name : ""});
  };
  for (const deck::OutputValues& output : path.output_at)
    for (const double value : output.values) mark(output.name, value, At::output);
  for (const std::string& name : path.watch_zero) mark(name, 0.0, At::event);
  for (const deck::OutputValues& watched : path.watch_values)
    for (const double value : watched.values) mark(watched.name, value, At::event);
  for (const deck::StopBounds& bounds : path.stop.bounds) {
    mark(bounds.name, bounds.low, At::stop);
    mark(bounds.name, bounds.high, At::stop);
  }
  if (path.stop.contacts) options.stop_contacts = *path.stop.contacts;
  for (const EventKind event : path.stop.events)
    options.stop_events.push_back({.kind = event, .label = "event = " + deck::text_of(deck::stop_event_words, event)});
  return options;
}

}  // namespace arcwall
