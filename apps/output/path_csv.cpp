#include "apps/output/path_csv.hpp"

#include <cmath>

#include "core/text.hpp"
#include "model/dissipation.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

std::string header(const Record& record, UnitLabels labels) {
  std::string text = "branch,step,arc,lambda";
  for (const RecordColumn& column : record.columns) text += "," + csv_title(column.name, column.unit, labels);
  text += ",unstable,stability,contacts,";
  if (record.has_friction) text += "slipping,";
  text += csv_title("energy", record.energy_unit, labels) + ",";
  if (record.has_friction) text += csv_title("dissipation", record.energy_unit, labels) + ",";
  text += "iterations,event";
  if (record.moves_supports) text += ",unstable_load_control";
  if (!record.stages.empty()) text += ",stage";
  return text + "\n";
}

std::string row(const Record& record, const RecordPoint& point) {
  std::string text = std::to_string(point.branch) + "," + std::to_string(point.step) + "," + round_trip(point.arc) +
                     "," + round_trip(point.lambda);
  for (const double value : point.monitors) text += "," + (std::isnan(value) ? "" : round_trip(value));
  text += ",";
  if (point.count.unstable) text += std::to_string(*point.count.unstable);
  text += ",";
  text += to_text(point.count.stability);
  text += "," + std::to_string(point.contacts) + ",";
  if (record.has_friction) text += std::to_string(slipping_contacts(point)) + ",";
  text += round_trip(point.energy) + ",";
  if (record.has_friction) text += round_trip(total_dissipation(point)) + ",";
  text += std::to_string(point.iterations) + ",";
  if (point.event) text += to_text(*point.event);
  if (record.moves_supports)
    text += "," + (point.unstable_load_control ? std::to_string(*point.unstable_load_control) : std::string());
  if (!record.stages.empty()) text += "," + record.stage_of(point.branch);
  return text + "\n";
}

}  // namespace

std::string path_csv(const Record& record, UnitLabels labels) {
  std::string text = header(record, labels);
  for (const RecordPoint& point : record.points) text += row(record, point);
  return text;
}

}  // namespace arcwall
