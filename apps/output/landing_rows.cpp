#include "apps/output/landing_rows.hpp"

#include <cmath>

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

void add_jump(const std::vector<double>& from, const RecordLanding& landing, std::vector<Jump>& list) {
  for (const RecordLanding& one : landing.several) add_jump(from, one, list);
  if (!landing.reason.empty()) return;
  list.push_back({.lambda = landing.lambda, .from = from, .to = landing.monitors});
  if (landing.back && landing.back->landing) add_jump(landing.back->monitors, *landing.back->landing, list);
}

}  // namespace

std::vector<TableColumn> landing_columns(const Record& record) {
  const auto figure = [](std::string title) { return TableColumn{std::move(title), TableColumn::Side::right}; };
  std::vector<TableColumn> columns{figure("id"), figure("λ"), {"falls to"}};
  for (const RecordColumn& column : record.columns)
    columns.push_back(figure(column.name + (column.unit.empty() ? "" : " [" + column.unit + "]")));
  for (const char* title : {"released", "back at λ", "lost in the loop"}) columns.push_back(figure(title));
  return columns;
}

namespace {

std::vector<std::string> landing_row(const Record& record, const RecordEvent& event, const RecordLanding& landing) {
  std::vector<std::string> row{std::to_string(event.id), shown_lambda(event, 8)};
  const std::string on = landing.on_branch ? "branch " + std::to_string(*landing.on_branch) : "off the branches";
  row.push_back(landing.reason.empty() ? on + (landing.word.empty() ? "" : ": " + landing.word)
                                       : landing.reason + ": " + landing.why);
  for (std::size_t i = 0; i < record.columns.size(); ++i)
    row.push_back(i < landing.monitors.size() ? shown_number(landing.monitors[i], 6) : "");
  row.push_back(landing.reason.empty() ? shown_number(landing.released, 6) : "");
  row.push_back(landing.back ? shown_number(landing.back->lambda, 8) : "");
  row.push_back(landing.loop ? shown_number(*landing.loop, 6) : "");
  return row;
}

}  // namespace

std::vector<std::vector<std::string>> landing_rows(const Record& record) {
  std::vector<std::vector<std::string>> rows;
  for (const RecordEvent& event : record.events) {
    if (!event.landing) continue;
    if (event.landing->several.empty()) rows.push_back(landing_row(record, event, *event.landing));
    for (const RecordLanding& one : event.landing->several) rows.push_back(landing_row(record, event, one));
  }
  return rows;
}

OrderedJson landing_json(const Record& record, const RecordLanding& landing) {
  OrderedJson json;
  json["lambda"] = json_number(landing.lambda);
  if (!landing.reason.empty()) {
    json["reason"] = landing.reason;
    json["why"] = landing.why;
    for (const RecordLanding& one : landing.several) json["several"].push_back(landing_json(record, one));
    return json;
  }
  json["monitors"] = monitors_json(record, landing.monitors);
  json["contacts"] = OrderedJson::array();
  for (const RecordStretch& one : landing.contacts)
    json["contacts"].push_back({{"wall", one.label.wall},
                                {"member", one.label.member},
                                {"fraction", json_number(one.label.fraction)},
                                {"kind", one.is_line ? "line" : "point"},
                                {"force", json_number(one.force)}});
  json["word"] = landing.word;
  json["energy"] = json_number(landing.energy);
  json["unstable"] = landing.unstable ? OrderedJson(*landing.unstable) : OrderedJson(nullptr);
  json["released"] = json_number(landing.released);
  if (landing.on_branch) {
    json["on_branch"] = *landing.on_branch;
    json["arc"] = json_number(landing.arc);
  }
  if (landing.back) {
    json["back"] = {{"lambda", json_number(landing.back->lambda)},
                    {"kind", to_text(landing.back->kind)},
                    {"monitors", monitors_json(record, landing.back->monitors)}};
    if (landing.back->landing) json["back"]["landing"] = landing_json(record, *landing.back->landing);
  }
  if (landing.loop) json["loop"] = json_number(*landing.loop);
  return json;
}

std::vector<Jump> jumps(const Record& record) {
  std::vector<Jump> list;
  for (const RecordEvent& event : record.events)
    if (event.landing) add_jump(event.monitors, *event.landing, list);
  return list;
}

}  // namespace arcwall
