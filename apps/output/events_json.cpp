#include "apps/output/events_json.hpp"

#include <cmath>
#include <cstddef>

#include "apps/output/event_names.hpp"
#include "apps/output/version.hpp"

namespace arcwall {

using Json = nlohmann::ordered_json;

namespace {

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json count(const std::optional<Index>& value) { return value ? Json(*value) : Json(nullptr); }

Json monitors(const Record& record, const std::vector<double>& values) {
  Json json = Json::object();
  for (std::size_t i = 0; i < values.size(); ++i) json[record.columns[i].name] = number(values[i]);
  return json;
}

Json contact(const RecordContact& contact) {
  return {{"wall", contact.label.wall},
          {"member", contact.label.member},
          {"fraction", number(contact.label.fraction)},
          {"x", number(contact.x)}};
}

Json branch(const RecordBranch& branch) {
  Json json;
  json["id"] = branch.id;
  json["parent"] = count(branch.parent);
  json["origin"] = count(branch.origin);
  json["mirrored"] = branch.mirrored;
  json["points"] = branch.points;
  json["lambda"] = Json::array({number(branch.least_lambda), number(branch.greatest_lambda)});
  json["end"] = branch.end ? end_json(*branch.end) : Json(nullptr);
  return json;
}

}  // namespace

Json events_json(const Record& record) {
  Json json;
  json["deck"] = record.deck;
  json["version"] = program_version();
  json["branches"] = Json::array();
  for (const RecordBranch& one : record.branches) json["branches"].push_back(branch(one));
  json["events"] = Json::array();
  for (const RecordEvent& event : record.events) json["events"].push_back(event_json(record, event));
  return json;
}

Json event_json(const Record& record, const RecordEvent& event) {
  Json json;
  json["id"] = event.id;
  json["kind"] = to_text(event.kind);
  json["branch"] = event.branch;
  json["step"] = event.step;
  json["arc"] = number(event.arc);
  json["lambda"] = number(event.lambda);
  json["monitors"] = monitors(record, event.monitors);
  json["unstable_before"] = count(event.unstable_before);
  json["unstable_after"] = count(event.unstable_after);
  json["residual"] = number(event.residual);
  json["localised"] = number(event.localised);
  if (changes_contact(event.kind)) {
    json["contact"] = Json::array();
    for (const RecordContact& one : event.contacts) json["contact"].push_back(contact(one));
  }
  if (event.monitor) json["monitor"] = *event.monitor;
  if (event.branch_type || event.kind == EventKind::limit_point) json["suspected"] = event.suspected;
  if (event.branch_type) {
    json["type"] = to_text(*event.branch_type);
    json["multiplicity"] = event.multiplicity;
    json["discretisation"] = event.discretisation;
    json["branches"] = event.branches;
  }
  if (!event.mode.empty()) json["mode"] = monitors(record, event.mode);
  if (event.branch_end) json.update(end_json(*event.branch_end));
  return json;
}

Json point_json(const Record& record, const RecordPoint& point) {
  Json json;
  json["branch"] = point.branch;
  json["step"] = point.step;
  json["arc"] = number(point.arc);
  json["lambda"] = number(point.lambda);
  json["monitors"] = monitors(record, point.monitors);
  json["unstable"] = count(point.count.unstable);
  json["stability"] = to_text(point.count.stability);
  json["contacts"] = point.contacts;
  json["energy"] = number(point.energy);
  json["iterations"] = point.iterations;
  json["event"] = point.event ? Json(to_text(*point.event)) : Json(nullptr);
  return json;
}

Json end_json(const BranchEnd& end) {
  Json json{{"reason", to_text(end.reason)}, {"detail", end.detail}};
  if (end.partner) json["partner"] = *end.partner;
  if (end.family) json["family"] = {{"energy", number(end.family->energy)}, {"length", number(end.family->length)}};
  return json;
}

std::string to_text(const Json& json, JsonLayout layout) {
  const int indent = layout == JsonLayout::lines ? 2 : -1;
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace arcwall
