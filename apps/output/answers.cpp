#include "apps/output/answers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/output/events_text.hpp"
#include "apps/output/load_text.hpp"
#include "apps/output/report_data.hpp"
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

}  // namespace

std::vector<std::string> answers(const Record& record) {
  std::vector<std::string> all;
  const double zero = record.columns.empty() ? 0.0 : roundoff(record).front();
  for (const RecordEvent& event : record.events)
    if (event.jump) all.push_back(answer(record, zero, event));
  if (all.empty() && !record.points.empty() && std::all_of(record.points.begin(), record.points.end(), is_stable))
    all.push_back(
        fmt::format("Stable at every point, to λ = {}.", shown_number(record.points.back().lambda, digits_of_answers)));
  return all;
}

}  // namespace arcwall
