#include "apps/converge/convergence_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/result_json.hpp"
#include "apps/output/shown_number.hpp"
#include "apps/output/text_table.hpp"
#include "core/printable.hpp"
#include "model/event_names.hpp"
#include "model/regular_file.hpp"
#include "model/version.hpp"

namespace arcwall {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

namespace {

TableColumn figure(std::string title) { return {std::move(title), TableColumn::Side::right}; }

OrderedJson number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? OrderedJson(*value) : OrderedJson(nullptr);
}

OrderedJson mesh_json(const Convergence& study, const MeshRun& mesh) {
  OrderedJson elements = OrderedJson::object();
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) elements[study.members[i]] = mesh.elements[i];
  OrderedJson ends = OrderedJson::array();
  for (const RecordBranch& branch : mesh.record.branches)
    ends.push_back(branch.end ? end_json(*branch.end) : OrderedJson(nullptr));
  OrderedJson json{
      {"times", mesh.times}, {"elements", elements}, {"points", mesh.record.points.size()}, {"ends", ends}};
  if (!mesh.problem.empty()) json["problem"] = mesh.problem;
  return json;
}

// `uncertainty` and the values by mesh have names of their own for λ.
OrderedJson value_json(const ConvergedValue& one, const char* values, const char* uncertainty) {
  OrderedJson json;
  json[values] = OrderedJson::array();
  for (const auto& value : one.on_mesh) json[values].push_back(number(value));
  json["order"] = number(one.limit.order);
  json["irregular"] = one.limit.irregular.empty() ? OrderedJson(nullptr) : OrderedJson(one.limit.irregular);
  json["extrapolated"] = number(one.limit.value);
  json["error"] = number(one.limit.error);
  json[uncertainty] = number(one.uncertainty);
  if (one.penalty) json["penalty"] = number(one.penalty);
  json["error_of_deck"] = number(one.error_of_deck);
  return json;
}

bool is_known(const ConvergedValue& one) {
  return std::any_of(one.on_mesh.begin(), one.on_mesh.end(), [](const auto& value) { return value.has_value(); });
}

OrderedJson event_json(const Convergence& study, const ConvergedEvent& one) {
  OrderedJson json;
  json["kind"] = to_text(one.event.kind);
  json["number"] = one.number;
  json["what"] = event_detail(one.event);
  json.update(value_json(one.lambda, "lambda", "lambda_uncertainty"));
  json["monitors"] = OrderedJson::object();
  for (std::size_t i = 0; i < one.monitors.size(); ++i)
    if (is_known(one.monitors[i]))
      json["monitors"][study.columns[i].name] = value_json(one.monitors[i], "values", "uncertainty");
  return json;
}

// `½` and whole numbers as they are written.
std::string times_text(double times) { return shown_number(times, 4) + " ×"; }

std::string mesh_table(const Convergence& study) {
  std::vector<std::vector<std::string>> rows;
  for (const MeshRun& mesh : study.meshes) {
    std::string elements, ends;
    for (std::size_t i = 0; i < mesh.elements.size(); ++i)
      elements += fmt::format("{}{}: {}", i > 0 ? ", " : "", study.members[i], mesh.elements[i]);
    for (const RecordBranch& branch : mesh.record.branches)
      if (branch.end) ends += (ends.empty() ? "" : "; ") + how_it_ended(*branch.end);
    rows.push_back({times_text(mesh.times), elements, std::to_string(mesh.record.points.size()),
                    mesh.problem.empty() ? ends : mesh.problem});
  }
  return text_table({figure("mesh"), {"elements"}, figure("points"), {"ended"}}, rows);
}

void add_cells(const ConvergedValue& one, std::vector<std::string>& row) {
  for (const auto& value : one.on_mesh) row.push_back(value ? shown_number(*value, 10) : "none");
  row.push_back(one.limit.order ? shown_number(*one.limit.order, 3) : "");
  row.push_back(shown_number(one.limit.value, 10));
  row.push_back(one.limit.error ? shown_number(*one.limit.error, 2) : "unknown");
  row.push_back(one.error_of_deck ? shown_number(*one.error_of_deck, 2) : "");
  row.push_back(one.limit.irregular);
}

// Of λ, or of the monitors.
enum class Tabulated { lambda, monitors };

std::string event_table(const Convergence& study, Tabulated what) {
  const bool of_monitors = what == Tabulated::monitors;
  std::vector<TableColumn> columns{{"kind"}, figure("no."), {of_monitors ? "monitor" : "what"}};
  for (const MeshRun& mesh : study.meshes) columns.push_back(figure(times_text(mesh.times)));
  for (const char* title : {"order", of_monitors ? "value" : "λ", "± error", "± deck mesh"})
    columns.push_back(figure(title));
  columns.push_back({"irregular"});
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const ConvergedEvent& one, const std::string& which, const ConvergedValue& value) {
    add_cells(value, rows.emplace_back(std::vector<std::string>{std::string(to_text(one.event.kind)),
                                                                std::to_string(one.number), which}));
  };
  for (const ConvergedEvent& one : study.events) {
    if (!of_monitors) add(one, event_detail(one.event), one.lambda);
    for (std::size_t i = 0; of_monitors && i < one.monitors.size(); ++i)
      if (is_known(one.monitors[i])) add(one, study.columns[i].name, one.monitors[i]);
  }
  return rows.empty() ? "" : text_table(columns, rows);
}

// The file of an earlier study; null where it is none that can be read, or of another deck.
Json study_in(const std::filesystem::path& folder, const StudiedDeck& of) {
  std::error_code ignored;
  const std::filesystem::path file = folder / "convergence.json";
  if (!std::filesystem::is_regular_file(file, ignored)) return nullptr;
  const Json json = Json::parse(bytes_of_regular_file(file), nullptr, false);
  if (!json.is_object() || !json.contains("deck") || !json.contains("events") || !json["events"].is_array())
    return nullptr;
  const Json& deck = json["deck"];
  const bool same = deck.is_object() && deck.value("crc32", Json()) == crc32_text(of.text) &&
                    deck.value("set", Json()) == Json(of.assignments) && json.value("own_mesh", Json()).is_number();
  return same ? json : Json(nullptr);
}

}  // namespace

OrderedJson convergence_json(const Convergence& study, const StudiedDeck& of) {
  OrderedJson json;
  json["deck"] = deck_json({study.deck, of.path, crc32_text(of.text)}, study.title, of.assignments);
  json["version"] = program_version();
  json["factor"] = study.factor;
  json["own_mesh"] = study.own_mesh;
  json["notes"] = study.notes;
  json["meshes"] = OrderedJson::array();
  for (const MeshRun& mesh : study.meshes) json["meshes"].push_back(mesh_json(study, mesh));
  json["events"] = OrderedJson::array();
  for (const ConvergedEvent& one : study.events) json["events"].push_back(event_json(study, one));
  return json;
}

std::string convergence_text(const Convergence& study) {
  std::string text = study.title.empty() ? "" : printable(study.title) + "\n";
  text += fmt::format("{}, trace-path {}\n\n", printable(study.deck), program_version());
  text += mesh_table(study) + "\n";
  for (const std::string& note : study.notes) text += printable(note) + "\n";
  if (!study.notes.empty()) text += "\n";
  if (study.events.empty()) return text + "No mesh has an event.\n";
  text += event_table(study, Tabulated::lambda) +
          "\nλ is extrapolated where the order is known, else that of the finest mesh; ± deck mesh is the error on "
          "the deck's mesh.\n";
  const std::string monitors = event_table(study, Tabulated::monitors);
  return text + (monitors.empty() ? "" : "\nMonitors at the events\n\n" + monitors);
}

std::string error_bars_text(const std::filesystem::path& folder, const Record& record, const StudiedDeck& of) {
  const Json study = study_in(folder, of);
  if (study.is_null()) return "";
  const auto mesh = study["own_mesh"].get<std::size_t>();
  std::vector<std::vector<std::string>> rows;
  for (const RecordEvent& event : record.events)
    for (const Json& one : study["events"]) {
      const Json lambdas = one.value("lambda", Json::array()), error = one.value("error_of_deck", Json());
      const bool known = lambdas.is_array() && mesh < lambdas.size() && lambdas[mesh].is_number() && error.is_number();
      if (!known || one.value("kind", Json()) != std::string(to_text(event.kind))) continue;
      if (std::abs(lambdas[mesh].get<double>() - event.lambda) >
          1e-9 * std::abs(event.lambda) + event.lambda_uncertainty)
        continue;
      const Json irregular = one.value("irregular", Json());
      rows.push_back({std::to_string(event.id), shown_number(event.lambda, 10), shown_number(error.get<double>(), 2),
                      irregular.is_string() ? irregular.get<std::string>() : ""});
      break;
    }
  if (rows.empty()) return "";
  return "\nError bars of convergence.json\n\n" +
         text_table({figure("id"), figure("λ"), figure("± error"), {"irregular"}}, rows);
}

}  // namespace arcwall
