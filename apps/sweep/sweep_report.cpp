#include "apps/sweep/sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/output/load_text.hpp"
#include "apps/output/markup.hpp"
#include "model/deck/key_list.hpp"
#include "model/event_names.hpp"
#include "model/version.hpp"

namespace arcwall::sweep {

namespace {

// Without it every map is shown, one below the other.
constexpr const char* script_text =
    "const choice = document.getElementById('choice');\n"
    "const maps = [...document.querySelectorAll('figure')];\n"
    "const show = () => maps.forEach((map, i) => { map.hidden = i !== choice.selectedIndex; });\n"
    "choice.parentElement.hidden = false;\n"
    "choice.addEventListener('change', show);\n"
    "show();\n";

// SHA-256 of script_text in base64, by which the page's policy knows it; held by a test.
constexpr const char* script_hash = "v0K5RnQTi59MgAU0tt2wRJFfV4dDX0htfk7ErKMu6dI=";

constexpr const char* style_text =
    ":root { color-scheme: light dark; }\n"
    "body { font: 15px/1.45 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }\n"
    "svg { max-width: 100%; height: auto; }\n"
    "svg text { font-size: 12px; }\n"
    "svg text:not([fill]) { fill: currentColor; }\n"
    "figure { margin: 1rem 0; }\n"
    "table { border-collapse: collapse; }\n"
    "th, td { border: 1px solid #8888; padding: 0.2rem 0.6rem; text-align: left; }\n"
    "td.number { text-align: right; }\n";

struct Load {
  std::string title{};
  std::vector<std::optional<double>> values{};  // one a case
};

template <class Value>
Load load(const Collection& collection, std::string title, Value value) {
  Load result{.title = std::move(title)};
  for (const CaseResult& one : collection.results) result.values.push_back(value(one));
  return result;
}

// Kinds of the cases' events, in a fixed order.
std::vector<std::string> kinds(const Collection& collection) {
  std::vector<std::string> found;
  for (const EventKind kind :
       {EventKind::contact_closes, EventKind::contact_opens, EventKind::contact_spreads, EventKind::contact_gathers,
        EventKind::contact_passes, EventKind::limit_point, EventKind::contact_limit_point,
        EventKind::displacement_limit, EventKind::branch_point}) {
    const std::string name(to_text(kind));
    const auto has_it = [&](const CaseResult& result) { return first_load(result, {name}).has_value(); };
    if (std::any_of(collection.results.begin(), collection.results.end(), has_it)) found.push_back(name);
  }
  return found;
}

std::vector<Load> loads(const Collection& collection) {
  std::vector<Load> all{load(collection, "λ of the snap", snap_load)};
  for (const std::string& kind : kinds(collection))
    all.push_back(load(collection, "λ of the first " + kind,
                       [&](const CaseResult& result) { return first_load(result, {kind}); }));
  const auto is_empty = [](const Load& one) {
    return std::none_of(one.values.begin(), one.values.end(), [](const auto& value) { return value.has_value(); });
  };
  all.erase(std::remove_if(all.begin(), all.end(), is_empty), all.end());
  return all;
}

// A key with the unit of what it holds.
std::string key_title(const Collection& collection, const std::string& key) {
  const std::string unit = deck::unit_of_key(key, collection.deck.units);
  return key + (unit.empty() ? "" : " [" + unit + "]");
}

// What λ multiplies, where that is one thing and the same for all cases.
std::string unit_of_lambda(const Collection& collection) {
  const auto is_load = [](const Key& key) {
    return key.name.starts_with("load") || key.name.starts_with("prescribed") ||
           key.name.find(".motion") != std::string::npos;
  };
  const auto is_tied_load = [&](const Tie& tie) { return is_load(tie.key); };
  const Sweep& sweep = collection.sweep;
  if (std::any_of(sweep.keys.begin(), sweep.keys.end(), is_load)) return {};
  if (std::any_of(sweep.ties.begin(), sweep.ties.end(), is_tied_load)) return {};
  const std::vector<LoadText> varying = driven_by_lambda(collection.deck);
  return varying.size() == 1 ? plain(varying.front().size, 60) : std::string();
}

std::string overview(const Collection& collection) {
  const auto ran = std::count_if(collection.results.begin(), collection.results.end(),
                                 [](const CaseResult& result) { return result.there; });
  std::string keys;
  for (const Key& key : collection.sweep.keys) keys += (keys.empty() ? "" : ", ") + key.name;
  return fmt::format("<p>{} of {} cases of {} have been run. Varied: {}.</p>\n", ran, collection.cases.size(),
                     escaped(plain(collection.cases.front().deck)), escaped(plain(keys)));
}

std::string failure_table(const Collection& collection) {
  const std::vector<Failure> list = failures(collection);
  if (list.empty()) return "<p>Every case ended as its deck says, or early behind its snap.</p>\n";
  std::string rows;
  for (const Failure& failure : list)
    rows += fmt::format("<tr><td>{}</td><td class=\"number\">{}</td><td>{}</td></tr>\n", escaped(failure.reason),
                        failure.cases.size(), listed(failure.cases));
  return "<h2>Cases that failed, by reason</h2>\n<table>\n<tr><th>reason</th><th>cases</th><th>which</th></tr>\n" +
         rows + "</table>\n";
}

std::string maps_html(const std::vector<LoadMap>& maps) {
  if (maps.empty()) return "<p>No case has an event yet.</p>\n";
  std::string options, figures;
  for (const LoadMap& map : maps) {
    options += "<option>" + escaped(map.load_title) + "</option>\n";
    figures += "<figure>\n<figcaption>" + escaped(map.load_title) + "</figcaption>\n" + svg(map) + "</figure>\n";
  }
  return "<h2>Maps</h2>\n<p hidden><label for=\"choice\">Event: </label><select id=\"choice\">\n" + options +
         "</select></p>\n" + figures +
         "<p>Hollow: the case has no such event. Crossed: the case failed. Rest the pointer on a case to read its "
         "numbers.</p>\n<script>" +
         script_text + "</script>\n";
}

}  // namespace

std::vector<LoadMap> load_maps(const Collection& collection, const std::vector<std::string>& keys) {
  std::vector<LoadMap> maps;
  const std::string unit = unit_of_lambda(collection);
  for (const Load& one : loads(collection)) {
    LoadMap& map = maps.emplace_back(LoadMap{.x_title = key_title(collection, keys.front()),
                                             .y_title = keys.size() > 1 ? key_title(collection, keys[1]) : "",
                                             .load_title = one.title,
                                             .load_unit = unit});
    for (std::size_t i = 0; i < collection.cases.size(); ++i) {
      const CaseResult& result = collection.results[i];
      if (!result.there) continue;
      map.points.push_back({.number = collection.cases[i].number,
                            .x = value_of(collection.cases[i], keys.front()),
                            .y = keys.size() > 1 ? value_of(collection.cases[i], keys[1]) : Json(),
                            .load = one.values[i],
                            .failed = result.failed()});
    }
  }
  return maps;
}

std::string report_html(const Collection& collection, const std::vector<std::string>& keys) {
  const std::string title = escaped(plain(collection.sweep.title));
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
             "script-src 'sha256-{}'\">\n"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
             "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<h1>{}</h1>\n",
             script_hash, title, style_text, title) +
         overview(collection) + maps_html(load_maps(collection, keys)) + failure_table(collection) +
         fmt::format(
             "<p>All numbers: cases.csv (one row a case) and sweep.csv (one row an event). trace-path {}.</p>\n",
             program_version()) +
         "</body>\n</html>\n";
}

}  // namespace arcwall::sweep
