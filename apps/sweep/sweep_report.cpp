#include "apps/sweep/sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/filled_page.hpp"
#include "apps/output/key_names.hpp"
#include "apps/output/load_text.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/report_parts.hpp"
#include "core/error.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/toml_source.hpp"
#include "model/model.hpp"
#include "model/version.hpp"

namespace arcwall::sweep {

namespace {

// What a page of some megabytes holds, and a browser draws.
constexpr std::size_t most_cases = 20000, most_curve_points = 100000;

constexpr std::size_t most_characters = 200;  // of a name or a value

// --- names -----------------------------------------------------------------------------------------------------------

// The key with the names of walls and the like for their numbers.
std::string name_of_key(const Collection& collection, const std::string& key) {
  try {
    const std::string file = (collection.folder() / collection.deck_file()).string();
    return with_names(deck::parse_deck(deck::read_text_file(file), file), key);
  } catch (const InputError&) {
    return key;
  }
}

Json key_json(const Collection& collection, const std::string& key) {
  return {{"name", plain(name_of_key(collection, key), most_characters)},
          {"unit", plain(deck::unit_of_key(key, collection.deck().units), most_characters)}};
}

// What λ multiplies, where that is one thing and the same for all cases.
std::optional<LoadText> driven_alone(const Collection& collection) {
  const auto is_load = [](const Key& key) {
    return key.name.starts_with("load") || key.name.starts_with("prescribed") ||
           key.name.find(".motion") != std::string::npos;
  };
  const auto is_tied_load = [&](const Tie& tie) { return is_load(tie.key); };
  const Sweep& sweep = collection.sweep();
  if (std::any_of(sweep.keys.begin(), sweep.keys.end(), is_load)) return {};
  if (std::any_of(sweep.ties.begin(), sweep.ties.end(), is_tied_load)) return {};
  const std::vector<LoadText> varying = driven_by_lambda(collection.deck());
  return varying.size() == 1 ? std::optional(varying.front()) : std::nullopt;
}

std::string unit_of_monitor(const Collection& collection, const std::string& name) {
  try {
    const Model model(collection.deck());
    for (const MonitorColumn& monitor : model.monitors())
      if (monitor.name == name) return monitor.unit;
  } catch (const InputError&) {
  }
  return "";
}

// λ multiplies something; a monitor is what it is.
Json load_json(const Collection& collection, const LoadKind& load) {
  const std::string title = plain(load.title, most_characters);
  if (!load.monitor.empty()) {
    const std::string unit = plain(unit_of_monitor(collection, load.monitor), most_characters);
    return {{"title", title}, {"unit", unit}, {"axis", unit.empty() ? title : title + " [" + unit + "]"}};
  }
  const auto driven = driven_alone(collection);
  const bool is_named = driven && driven->name != LoadText().name;
  const std::string times = driven && !driven->size.empty() ? "times " + plain(driven->size, most_characters) : "";
  return {{"title", title},
          {"unit", times.empty() ? "" : "(" + times + ")"},
          {"axis",
           (is_named ? plain(driven->name, most_characters) + " " : "") + title + (times.empty() ? "" : ", " + times)}};
}

Json value_json(const Json& value) { return value.is_number() ? value : Json(plain(label(value), most_characters)); }

Json or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

// Whether a page shows a case: in as many parts of all as there are cases to show, those whose multiple of the golden
// ratio lies in one part of a turn are spread evenly, in step with no grid.
bool is_shown(int number, std::size_t of) {
  constexpr double golden = 0.6180339887498949;
  const double turn = number * golden;
  return of <= most_cases || (turn - std::floor(turn)) * static_cast<double>(of) < static_cast<double>(most_cases);
}

// What can be opened of a case: its `page`; its `folder`, of which a page can be made; or nothing.
const char* report_of(const Collection& collection, int number) {
  std::error_code ignored;
  const auto folder = collection.results().folder(number);
  if (!folder) return "";
  return std::filesystem::exists(*folder / "report.html", ignored) ? "page" : "folder";
}

// --- the page --------------------------------------------------------------------------------------------------------

std::string outcome(const Collection& collection, const Overview& of_all, const std::vector<std::string>& keys) {
  std::string varied;
  for (const std::string& key : keys) varied += (varied.empty() ? "" : ", ") + name_of_key(collection, key);
  return fmt::format("{} of {} cases of {} have been run. Varied: {}.", of_all.ran, collection.size(),
                     plain(collection.deck_file()), plain(varied));
}

std::string failure_table(const Overview& of_all) {
  if (of_all.failures.empty())
    return "<section><p>Every case ended as its deck says, or early after its snap.</p></section>";
  std::string rows;
  for (const Failure& failure : of_all.failures)
    rows += fmt::format("<tr><td>{}</td><td class=\"figure\">{}</td><td>{}</td></tr>\n", escaped(failure.reason),
                        failure.count, listed(failure));
  return "<section><h2>Cases that failed, by reason</h2>\n<div class=\"scroll\" tabindex=\"0\"><table>\n"
         "<thead><tr><th>reason</th><th class=\"figure\">cases</th><th>which</th></tr></thead>\n<tbody>" +
         rows + "</tbody></table></div></section>";
}

}  // namespace

std::optional<double> LoadKind::of(const CaseResult& result) const {
  return event.empty() ? snap_load(result, monitor) : first_load(result, {event}, monitor);
}

std::vector<LoadKind> load_kinds(const Overview& of_all, const std::vector<std::string>& monitors) {
  std::vector<LoadKind> kinds;
  const auto add = [&](const std::string& name, const std::string& monitor) {
    if (of_all.has_snaps) kinds.push_back({.title = name + " of the snap", .monitor = monitor});
    for (const std::string& kind : of_all.event_kinds)
      kinds.push_back({.title = name + " of the first " + kind, .event = kind, .monitor = monitor});
  };
  if (monitors.empty()) add("λ", "");
  for (const std::string& monitor : monitors) add(monitor, monitor);
  return kinds;
}

SweepPage::SweepPage(const Collection& collection, const Overview& of_all, const std::vector<std::string>& keys,
                     const std::vector<std::string>& monitors)
    : collection_(collection), of_all_(of_all), keys_(keys), loads_(load_kinds(of_all, monitors)) {
  for (const Key& key : collection.sweep().keys)
    if (std::find(keys.begin(), keys.end(), key.name) == keys.end()) keys_.push_back(key.name);
  values_.assign(keys_.size(), Json::array());
  of_loads_.assign(loads_.size(), Json::array());
}

void SweepPage::add(const Case& one, const CaseResult& result) {
  if (!result.there || !is_shown(one.number, collection_.size())) return;
  add_curve(result);
  numbers_.push_back(one.number);
  failed_.push_back(result.failed() ? plain(result.reason, most_characters) : "");
  reports_.push_back(report_of(collection_, one.number));
  for (std::size_t k = 0; k < keys_.size(); ++k) values_[k].push_back(value_json(value_of(one, keys_[k])));
  for (std::size_t l = 0; l < loads_.size(); ++l) of_loads_[l].push_back(or_null(loads_[l].of(result)));
}

// Whole, or not at all.
void SweepPage::add_curve(const CaseResult& result) {
  if (result.curve.size() < 2) return;
  ++curve_count_;
  if (curve_points_ + result.curve.size() > most_curve_points) return;
  curve_points_ += result.curve.size();
  Json x = Json::array(), y = Json::array();
  for (const auto& [key, lambda] : result.curve) {
    x.push_back(or_null(key));
    y.push_back(or_null(lambda));
  }
  curves_.push_back({{"index", numbers_.size()}, {"x", std::move(x)}, {"y", std::move(y)}});
}

Json SweepPage::data() const {
  Json keys = Json::array(), loads = Json::array();
  for (const std::string& key : keys_) keys.push_back(key_json(collection_, key));
  for (const LoadKind& load : loads_) loads.push_back(load_json(collection_, load));
  Json curves{{"lines", curves_}, {"count", curve_count_}};
  if (collection_.deck().curve) {
    const Json key = key_json(collection_, collection_.deck().curve->parameter);
    const std::string name = key.at("name").get<std::string>(), unit = key.at("unit").get<std::string>();
    curves["across"] = unit.empty() ? name : name + " [" + unit + "]";
    curves["up"] = load_json(collection_, {.title = "λ of the event"}).at("axis");
  }
  return {
      {"keys", std::move(keys)},
      {"loads", std::move(loads)},
      {"cases",
       {{"number", numbers_}, {"values", values_}, {"loads", of_loads_}, {"failed", failed_}, {"report", reports_}}},
      {"curves", std::move(curves)},
      {"ran", of_all_.ran}};
}

std::string SweepPage::text() const {
  const ReportParts& parts = report_parts();
  const PageFields fields{
      {"title", escaped(plain(collection_.sweep().title))},
      {"outcome", escaped(outcome(collection_, of_all_, keys_))},
      {"failures", failure_table(of_all_)},
      {"tables", fmt::format("All numbers: cases.csv (one row a case) and sweep.csv (one row {}). trace-path {}.",
                             collection_.sweep().traced == Traced::curve ? "a special point; all points in curves.csv"
                                                                         : "an event",
                             program_version())},
      {"library_note", parts.map_library.empty()
                           ? "This trace-path was built without plotly: there are no maps, only the table."
                           : "Maps are drawn with plotly.js, whose licence (MIT) is in the source of this page."},
      {"data", script_json(data())}};
  return joined_pieces(filled(
      parts.sweep, {{"style", parts.style}, {"script", parts.sweep_script}, {"library", parts.map_library}}, fields));
}

}  // namespace arcwall::sweep
