#include "apps/output/jump_rows.hpp"

#include <cmath>
#include <utility>

#include "apps/output/events_text.hpp"
#include "apps/output/shown_number.hpp"
#include "model/event_names.hpp"

namespace arcwall {

using OrderedJson = nlohmann::ordered_json;

namespace {

OrderedJson json_number(double value) { return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr); }

OrderedJson monitors_json(const Record& record, const std::vector<double>& values) {
  OrderedJson json = OrderedJson::object();
  for (std::size_t i = 0; i < values.size(); ++i) json[record.columns[i].name] = json_number(values[i]);
  return json;
}

void add_jump(const RecordEvent& event, const std::vector<double>& from, const RecordJump& jump, bool returns,
              std::vector<Jump>& list) {
  for (const RecordJump& one : jump.destinations) add_jump(event, from, one, returns, list);
  if (!jump.reason.empty()) return;
  list.push_back(
      {.lambda = jump.lambda, .from = from, .to = jump.monitors, .event = &event, .end = &jump, .returns = returns});
  if (jump.on_return && jump.on_return->jump)
    add_jump(event, jump.on_return->monitors, *jump.on_return->jump, true, list);
}

}  // namespace

std::vector<TableColumn> jump_columns(const Record& record) {
  const auto figure = [](std::string title) { return TableColumn{std::move(title), TableColumn::Side::right}; };
  std::vector<TableColumn> columns{figure("id"), figure("λ"), {"jumps to"}};
  for (const RecordColumn& column : record.columns)
    columns.push_back(figure(column.name + (column.unit.empty() ? "" : " [" + column.unit + "]")));
  for (const char* title : {"energy released", "returns at λ", "dissipated"}) columns.push_back(figure(title));
  return columns;
}

namespace {

// In the order of the rows.
std::vector<std::pair<const RecordEvent*, const RecordJump*>> jumps_of_events(const Record& record) {
  std::vector<std::pair<const RecordEvent*, const RecordJump*>> list;
  for (const RecordEvent& event : record.events) {
    if (!event.jump) continue;
    if (event.jump->destinations.empty()) list.emplace_back(&event, event.jump.get());
    for (const RecordJump& one : event.jump->destinations) list.emplace_back(&event, &one);
  }
  return list;
}

// `branch 0 near step 12`
std::string place_of(const Record& record, const RecordJump& jump) {
  if (!jump.on_branch) return "off the branches";
  const RecordPoint* nearest = nullptr;
  const auto distance = [&](const RecordPoint& point) { return std::abs(point.arc - jump.arc); };
  for (const RecordPoint& point : record.points)
    if (point.branch == *jump.on_branch && (nearest == nullptr || distance(point) < distance(*nearest)))
      nearest = &point;
  const std::string branch = "branch " + std::to_string(*jump.on_branch);
  return nearest == nullptr ? branch : branch + " near step " + std::to_string(nearest->step);
}

std::vector<std::string> jump_row(const Record& record, const RecordEvent& event, const RecordJump& jump) {
  std::vector<std::string> row{std::to_string(event.id), shown_lambda(event, 8)};
  row.push_back(jump.reason.empty()
                    ? place_of(record, jump) + (jump.contact_pattern.empty() ? "" : ": " + jump.contact_pattern)
                    : jump.reason + ": " + jump.why);
  for (std::size_t i = 0; i < record.columns.size(); ++i)
    row.push_back(i < jump.monitors.size() ? shown_number(jump.monitors[i], 6) : "");
  row.push_back(jump.reason.empty() ? shown_number(jump.energy_released, 6) : "");
  row.push_back(jump.on_return ? shown_number(jump.on_return->lambda, 8) : "");
  row.push_back(jump.energy_dissipated ? shown_number(*jump.energy_dissipated, 6) : "");
  return row;
}

}  // namespace

std::vector<std::vector<std::string>> jump_rows(const Record& record) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [event, jump] : jumps_of_events(record)) rows.push_back(jump_row(record, *event, *jump));
  return rows;
}

std::vector<const RecordJump*> jumps_of_rows(const Record& record) {
  std::vector<const RecordJump*> rows;
  for (const auto& [event, jump] : jumps_of_events(record)) rows.push_back(jump);
  return rows;
}

OrderedJson jump_json(const Record& record, const RecordJump& jump) {
  OrderedJson json;
  json["lambda"] = json_number(jump.lambda);
  if (!jump.reason.empty()) {
    json["reason"] = jump.reason;
    json["why"] = jump.why;
    for (const RecordJump& one : jump.destinations) json["two_destinations"].push_back(jump_json(record, one));
    return json;
  }
  json["monitors"] = monitors_json(record, jump.monitors);
  json["contacts"] = OrderedJson::array();
  for (const RecordStretch& one : jump.contacts)
    json["contacts"].push_back({{"wall", one.label.wall},
                                {"member", one.label.member},
                                {"fraction", json_number(one.label.fraction)},
                                {"kind", one.is_zone ? "zone" : "point"},
                                {"force", json_number(one.force)}});
  json["contact_pattern"] = jump.contact_pattern;
  json["energy"] = json_number(jump.energy);
  json["unstable"] = jump.unstable ? OrderedJson(*jump.unstable) : OrderedJson(nullptr);
  json["energy_released"] = json_number(jump.energy_released);
  if (jump.on_branch) {
    json["on_branch"] = *jump.on_branch;
    json["arc"] = json_number(jump.arc);
  }
  if (jump.on_return) {
    json["return"] = {{"lambda", json_number(jump.on_return->lambda)},
                      {"kind", to_text(jump.on_return->kind)},
                      {"monitors", monitors_json(record, jump.on_return->monitors)}};
    if (jump.on_return->jump) json["return"]["jump"] = jump_json(record, *jump.on_return->jump);
  }
  if (jump.energy_dissipated) json["energy_dissipated"] = json_number(*jump.energy_dissipated);
  return json;
}

std::vector<Jump> jumps(const Record& record) {
  std::vector<Jump> list;
  for (const RecordEvent& event : record.events)
    if (event.jump) add_jump(event, event.monitors, *event.jump, false, list);
  return list;
}

}  // namespace arcwall
