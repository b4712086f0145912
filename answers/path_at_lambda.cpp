#include "answers/path_at_lambda.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "continuation/tracer.hpp"

namespace arcwall {

TraceOptions options_towards(const Model& model, const State& from, double lambda) {
  TraceOptions options = model.options();
  options.target_values = {{.quantity = std::make_shared<ParameterValue>(), .value = lambda, .stops = true}};
  options.stop_contacts.reset();
  options.stop_events.clear();
  options.detectors.clear();
  options.max_points = TraceOptions{}.max_points;
  options.step.first = std::copysign(std::abs(options.step.first), lambda - from.lambda);
  return options;
}

std::optional<OnPath> at_lambda(const Model& model, const State& from, double lambda, Follow follow) {
  TraceOptions options = options_towards(model, from, lambda);
  options.events = EventSearch::none;
  options.max_points = 100;
  Tracer tracer(model.system(), from, options);
  OnPath found;
  while (const auto arc = tracer.next()) {
    if (follow == Follow::stable_path && arc->to.count.unstable.value_or(0) > 0) return std::nullopt;
    found.state = arc->to.state;
    found.arc = arc->to.arc;
    found.unstable = arc->to.count.unstable;
  }
  const bool met = tracer.end() && tracer.end()->reason == EndReason::stop && found.state.lambda == lambda;
  return met ? std::optional(std::move(found)) : std::nullopt;
}

std::vector<std::size_t> crossings(const Record& record, double lambda) {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i + 1 < record.points.size(); ++i) {
    const RecordPoint &a = record.points[i], &b = record.points[i + 1];
    const bool between = (a.lambda - lambda) * (b.lambda - lambda) <= 0.0 && a.lambda != b.lambda;
    if (a.branch == b.branch && between) points.push_back(i);
  }
  return points;
}

std::optional<OnPath> at_crossing(const Model& model, const Record& record, std::size_t point, double lambda) {
  const RecordPoint &a = record.points[point], &b = record.points[point + 1];
  // From the end that is no event: beside one the path may be singular.
  const bool backwards = a.event.has_value() && !b.event.has_value();
  auto there = at_lambda(model, backwards ? b.state : a.state, lambda);
  if (!there) return there;
  there->point = point;
  there->arc = backwards ? b.arc - there->arc : a.arc + there->arc;
  return there;
}

}  // namespace arcwall
