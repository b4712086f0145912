#include "apps/output/result_json.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include "apps/output/events_json.hpp"
#include "apps/output/library_versions.hpp"
#include "apps/output/run_warnings.hpp"
#include "apps/output/search_rows.hpp"
#include "model/version.hpp"

namespace arcwall {

using OrderedJson = nlohmann::ordered_json;

std::string crc32_text(std::string_view text) {
  return fmt::format("{:08x}", ::crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

OrderedJson deck_json(const DeckIdentity& deck, const std::string& title, const std::vector<std::string>& assignments) {
  return {{"file", deck.file},
          {"title", title},
          {"path", deck.path.empty() ? OrderedJson(nullptr) : OrderedJson(deck.path)},
          {"crc32", deck.crc32},
          {"set", assignments}};
}

namespace {

constexpr int schema_version = 1;

OrderedJson model_sizes(const Model& model) {
  Index candidates = 0;
  if (model.contact() != nullptr) candidates = model.contact()->contact_count();
  if (model.compliant() != nullptr) candidates = model.compliant()->contact_count();
  return {{"nodes", model.structure().node_count()},
          {"unknowns", model.structure().size({})},
          {"contact_candidates", candidates}};
}

OrderedJson counts(const Record& record) {
  Index iterations = 0;
  for (const RecordPoint& point : record.points) iterations += point.iterations;
  return {{"branches", record.branches.size()},
          {"points", record.points.size()},
          {"events", record.events.size()},
          {"iterations", iterations}};
}

}  // namespace

OrderedJson result_json(const Model& model, const RunDescription& run, const Record& record, const RunSeconds& seconds,
                        int status) {
  OrderedJson libraries = OrderedJson::object();
  for (const auto& [name, version] : library_versions()) libraries[name] = version;
  OrderedJson branches = OrderedJson::array();
  for (const RecordBranch& branch : record.branches)
    branches.push_back({{"id", branch.id}, {"end", branch.end ? end_json(*branch.end) : OrderedJson(nullptr)}});

  OrderedJson json;
  json["schema"] = schema_version;
  json["deck"] = deck_json(identity_of(run), record.title, model.deck().source.assignments);
  json["program"] = {{"name", "trace-path"}, {"version", program_version()}};
  json["libraries"] = std::move(libraries);
  json["model"] = model_sizes(model);
  json["counts"] = counts(record);
  json["seconds"] = {{"total", seconds.total}, {"tracing", seconds.tracing}};
  json["status"] = status;
  json["warnings"] = run_warnings(model, record);
  json["branches"] = std::move(branches);
  if (model.deck().path.search) json["search"] = search_json(record);
  return json;
}

}  // namespace arcwall
