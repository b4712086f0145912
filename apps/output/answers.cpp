#include "apps/output/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/output/events_text.hpp"
#include "apps/output/load_text.hpp"
#include "apps/output/report_data.hpp"
#include "apps/output/report_head.hpp"
#include "apps/output/roundoff.hpp"
#include "apps/output/shown_number.hpp"

namespace arcwall {

namespace {

constexpr int digits_of_answers = 5;

// `mid = 0.19245 cm`, of the first monitor, with its round-off; empty without monitors.
std::string state_text(const Record& record, double zero, const std::vector<double>& monitors) {
  if (monitors.empty()) return "";
  const RecordColumn& column = record.columns.front();
  const double value = without_roundoff(monitors.front(), zero);
  return shown_name(column.name) + " = " + with_unit(shown_number(value, digits_of_answers), shown_name(column.unit));
}

std::string energy_text(const Record& record, double energy) {
  return with_unit(shown_number(energy, digits_of_answers), shown_name(record.energy_unit));
}

std::string destination_text(const Record& record, double zero, const RecordJump& jump) {
  std::string text;
  if (const std::string state = state_text(record, zero, jump.monitors); !state.empty()) text += " to " + state;
  return text + "; releases " + energy_text(record, jump.energy_released);
}

std::string after_jump(const Record& record, const RecordJump& jump) {
  if (!jump.on_return) return "";
  std::string text = "; snaps back at λ = " + shown_number(jump.on_return->lambda, digits_of_answers);
  if (jump.energy_dissipated) text += "; the cycle dissipates " + energy_text(record, *jump.energy_dissipated);
  return text;
}

std::string answer(const Record& record, double zero, const RecordEvent& event) {
  const RecordJump& jump = *event.jump;
  const std::string lambda = "λ = " + shown_lambda(event, digits_of_answers);
  if (jump.destinations.empty() && !jump.reason.empty())
    return fmt::format("Loses stability at {}; the state after it is not known: {}.", lambda, jump.why);
  const std::string state = state_text(record, zero, event.monitors);
  std::string text = fmt::format("Snaps at {}{}", lambda, state.empty() ? "" : ", from " + state);
  if (jump.destinations.empty()) return text + destination_text(record, zero, jump) + after_jump(record, jump) + ".";
  for (const RecordJump& one : jump.destinations)
    text += (&one == &jump.destinations.front() ? "" : ", or") + destination_text(record, zero, one);
  return text + ".";
}

bool is_stable(const RecordPoint& point) { return point.count.stability == Stability::stable; }

bool loses_stability(const RecordEvent& event) { return event.unstable_before == 0 && event.unstable_after > 0; }

// `0.78109 N at λ = 3.627`. Between two points without an event a monitor may be greater: fewer digits are sure.
std::string value_text(const Record& record, std::size_t monitor, const RecordPoint& point) {
  constexpr int digits_of_points = 3;
  const auto is_there = [&](const RecordEvent& event) {
    return event.branch == point.branch && event.step == point.step;
  };
  const auto event = std::find_if(record.events.begin(), record.events.end(), is_there);
  const bool is_event = event != record.events.end();
  const std::string value = shown_number(point.monitors[monitor], is_event ? digits_of_answers : digits_of_points);
  return with_unit(value, shown_name(record.columns[monitor].unit)) + " at λ = " +
         (is_event ? shown_lambda(*event, digits_of_answers) : shown_number(point.lambda, digits_of_points));
}

// The greatest force and the least of a stage, in the order of the path; empty without a force.
std::string force_answer(const Record& record, std::size_t force, Index stage) {
  const double zero = roundoff(record)[force];
  const RecordPoint *greatest = nullptr, *least = nullptr;
  for (const RecordPoint& point : record.points) {
    if (record.stage_number(point.branch) != stage) continue;
    const double value = point.monitors[force];
    if (value > (greatest == nullptr ? zero : greatest->monitors[force])) greatest = &point;
    if (value < (least == nullptr ? -zero : least->monitors[force])) least = &point;
  }
  std::vector<std::pair<const RecordPoint*, const char*>> ways;
  if (greatest != nullptr) ways.emplace_back(greatest, "rises to ");
  if (least != nullptr) ways.emplace_back(least, "falls to ");
  if (ways.empty()) return "";
  std::sort(ways.begin(), ways.end());
  std::string text = record.stages.empty() ? "" : shown_name(record.stages[static_cast<std::size_t>(stage)]) + ": ";
  text += shown_name(record.columns[force].name) + " ";
  for (const auto& [point, way] : ways)
    text += (point == ways.front().first ? "" : " and ") + (way + value_text(record, force, *point));
  return text + ".";
}

// Of a run without jumps.
std::string stability_answer(const Record& record, double zero, bool with_state) {
  const auto loss = std::find_if(record.events.begin(), record.events.end(), loses_stability);
  if (loss != record.events.end())
    return fmt::format("Loses stability at λ = {}, at a {}.", shown_lambda(*loss, digits_of_answers),
                       words(loss->kind));
  if (record.points.empty() || !std::all_of(record.points.begin(), record.points.end(), is_stable)) return "";
  const RecordPoint& last = record.points.back();
  const std::string state = with_state ? state_text(record, zero, last.monitors) : "";
  return fmt::format("Stable at every point, to λ = {}{}.", shown_number(last.lambda, digits_of_answers),
                     state.empty() ? "" : ", where " + state);
}

}  // namespace

std::vector<std::string> answers(const Record& record, std::optional<std::size_t> force) {
  std::vector<std::string> all;
  const auto add = [&](const std::string& sentence) {
    if (!sentence.empty()) all.push_back(sentence);
  };
  const double zero = record.columns.empty() ? 0.0 : roundoff(record).front();
  for (const RecordEvent& event : record.events)
    if (event.jump) add(answer(record, zero, event));
  const bool jumps = !all.empty();
  const auto stages = std::max<std::size_t>(record.stages.size(), 1);
  for (std::size_t stage = 0; force && stage < stages; ++stage)
    add(force_answer(record, *force, static_cast<Index>(stage)));
  if (!jumps) add(stability_answer(record, zero, !force));
  return all;
}

}  // namespace arcwall
