#include "apps/output/events_json.hpp"

#include <cmath>
#include <cstddef>

#include "apps/output/jump_rows.hpp"
#include "model/event_names.hpp"
#include "model/version.hpp"

namespace arcwall {

using OrderedJson = nlohmann::ordered_json;

namespace {

OrderedJson number(double value) { return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr); }

OrderedJson count(const std::optional<Index>& value) { return value ? OrderedJson(*value) : OrderedJson(nullptr); }

OrderedJson monitors(const Record& record, const std::vector<double>& values) {
  OrderedJson json = OrderedJson::object();
  for (std::size_t i = 0; i < values.size(); ++i) json[record.columns[i].name] = number(values[i]);
  return json;
}

OrderedJson contact(const RecordContact& contact) {
  OrderedJson json{{"wall", contact.label.wall},
                   {"member", contact.label.member},
                   {"fraction", number(contact.label.fraction)},
                   {"x", number(contact.x)}};
  if (contact.friction) {
    json["state"] = to_text(contact.friction->mode);
    json["force"] = number(contact.force.value_or(0.0));
    json["friction"] = number(contact.friction->force);
  }
  return json;
}

// The first-order ways on from a change of contacts with friction; whether there is one alone is known if all were
// tried.
void add_ways(const RecordEvent& event, OrderedJson& json) {
  if (event.ways.empty()) return;
  json["unique"] = event.all_ways_known ? OrderedJson(event.ways.size() == 1) : OrderedJson(nullptr);
  json["ways"] = OrderedJson::array();
  for (const RecordFrictionWay& way : event.ways) {
    OrderedJson told;
    told["contacts"] = OrderedJson::array();
    for (const RecordFrictionWay::Contact& one : way.contacts)
      told["contacts"].push_back({{"wall", one.label.wall},
                                  {"member", one.label.member},
                                  {"fraction", number(one.label.fraction)},
                                  {"state", to_text(one.mode)}});
    told["lambda"] = way.lambda_sense;
    told["dissipation"] = number(way.dissipation);
    told["unstable"] = count(way.unstable);
    told["taken"] = way.taken;
    json["ways"].push_back(std::move(told));
  }
}

OrderedJson family(const Continuum& continuum) {
  return {{"parts", continuum.parts}, {"energy", number(continuum.energy)}, {"length", number(continuum.length)}};
}

// Keys with their derivatives, and why those that are null are.
void add_sensitivity(const Record& record, const std::vector<RecordSensitivity>& sensitivity, OrderedJson& json) {
  if (sensitivity.empty()) return;
  OrderedJson slopes = OrderedJson::object(), of_monitors = OrderedJson::object(), reasons = OrderedJson::object();
  for (const RecordSensitivity& one : sensitivity) {
    slopes[one.key] = one.slope ? number(*one.slope) : OrderedJson(nullptr);
    for (std::size_t i = 0; i < one.rates.size(); ++i)
      if (one.rates[i]) of_monitors[one.key][record.columns[i].name] = number(*one.rates[i]);
    if (!one.slope) reasons[one.key] = one.why_none;
  }
  json["sensitivity"] = std::move(slopes);
  if (!of_monitors.empty()) json["monitor_sensitivity"] = std::move(of_monitors);
  if (!reasons.empty()) json["no_sensitivity"] = std::move(reasons);
}

OrderedJson branch(const Record& record, const RecordBranch& branch) {
  OrderedJson json;
  json["id"] = branch.id;
  if (!record.stages.empty()) json["stage"] = record.stage_of(branch.id);
  json["parent"] = count(branch.parent);
  json["origin"] = branch.found ? OrderedJson("search") : count(branch.origin);
  json["after_jump"] = branch.after_jump;
  json["mirror_image"] = branch.mirror_image;
  json["points"] = branch.points;
  json["lambda"] = OrderedJson::array({number(branch.least_lambda), number(branch.greatest_lambda)});
  json["end"] = branch.end ? end_json(*branch.end) : OrderedJson(nullptr);
  return json;
}

}  // namespace

OrderedJson events_json(const Record& record) {
  OrderedJson json;
  json["deck"] = record.deck;
  json["version"] = program_version();
  json["branches"] = OrderedJson::array();
  for (const RecordBranch& one : record.branches) json["branches"].push_back(branch(record, one));
  json["events"] = OrderedJson::array();
  for (const RecordEvent& event : record.events) json["events"].push_back(event_json(record, event));
  return json;
}

OrderedJson event_json(const Record& record, const RecordEvent& event) {
  OrderedJson json;
  json["id"] = event.id;
  json["kind"] = to_text(event.kind);
  json["branch"] = event.branch;
  if (!record.stages.empty()) json["stage"] = record.stage_of(event.branch);
  json["step"] = event.step;
  json["arc"] = number(event.arc);
  json["lambda"] = number(event.lambda);
  json["monitors"] = monitors(record, event.monitors);
  json["unstable_before"] = count(event.unstable_before);
  json["unstable_after"] = count(event.unstable_after);
  if (record.moves_supports) json["unstable_load_control"] = count(event.unstable_load_control);
  json["residual"] = number(event.residual);
  json["lambda_uncertainty"] = number(event.lambda_uncertainty);
  if (changes_contact(event.kind)) {
    json["contact"] = OrderedJson::array();
    for (const RecordContact& one : event.contacts) json["contact"].push_back(contact(one));
  }
  add_ways(event, json);
  if (event.continuum) json["family"] = family(*event.continuum);
  if (event.extremum) json["extremum"] = to_text(*event.extremum);
  if (event.monitor) json["monitor"] = *event.monitor;
  if (event.value) json["value"] = number(*event.value);
  if (event.branch_type || event.kind == EventKind::limit_point) json["unconfirmed"] = event.unconfirmed;
  if (event.branch_type) {
    json["type"] = to_text(*event.branch_type);
    json["multiplicity"] = event.multiplicity;
    json["mesh_artefact"] = event.mesh_artefact;
    json["branches"] = event.branches;
  }
  if (!event.mode.empty()) json["mode"] = monitors(record, event.mode);
  add_sensitivity(record, event.sensitivity, json);
  if (event.jump) json["jump"] = jump_json(record, *event.jump);
  if (event.branch_end) json.update(end_json(*event.branch_end));
  return json;
}

OrderedJson point_json(const Record& record, const RecordPoint& point) {
  OrderedJson json;
  json["branch"] = point.branch;
  if (!record.stages.empty()) json["stage"] = record.stage_of(point.branch);
  json["step"] = point.step;
  json["arc"] = number(point.arc);
  json["lambda"] = number(point.lambda);
  json["monitors"] = monitors(record, point.monitors);
  json["unstable"] = count(point.count.unstable);
  json["stability"] = to_text(point.count.stability);
  if (record.moves_supports) json["unstable_load_control"] = count(point.unstable_load_control);
  json["contacts"] = point.contacts;
  json["energy"] = number(point.energy);
  json["iterations"] = point.iterations;
  json["event"] = point.event ? OrderedJson(to_text(*point.event)) : OrderedJson(nullptr);
  return json;
}

OrderedJson end_json(const BranchEnd& end) {
  OrderedJson json{{"reason", to_text(end.reason)}, {"detail", end.detail}};
  if (end.partner) json["partner"] = *end.partner;
  if (end.continuum) json["family"] = family(*end.continuum);
  return json;
}

std::string to_text(const OrderedJson& json, JsonLayout layout) {
  const int indent = layout == JsonLayout::lines ? 2 : -1;
  return json.dump(indent, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace arcwall
