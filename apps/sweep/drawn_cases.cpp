#include "apps/sweep/drawn_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/load_text.hpp"
#include "apps/output/markup.hpp"
#include "apps/sweep/case_folder.hpp"
#include "apps/sweep/case_list.hpp"
#include "apps/sweep/map_axis.hpp"
#include "model/deck/key_list.hpp"

namespace arcwall::sweep {

namespace {

// Points of all maps of a page: each is drawn on a map and on four charts of lines, which is some 2 kB.
constexpr std::size_t most_points = 2000;

// A key with the unit of what it holds.
std::string key_title(const Collection& collection, const std::string& key) {
  const std::string unit = deck::unit_of_key(key, collection.deck().units);
  return key + (unit.empty() ? "" : " [" + unit + "]");
}

// What λ multiplies, where that is one thing and the same for all cases.
std::string unit_of_lambda(const Collection& collection) {
  const auto is_load = [](const Key& key) {
    return key.name.starts_with("load") || key.name.starts_with("prescribed") ||
           key.name.find(".motion") != std::string::npos;
  };
  const auto is_tied_load = [&](const Tie& tie) { return is_load(tie.key); };
  const Sweep& sweep = collection.sweep();
  if (std::any_of(sweep.keys.begin(), sweep.keys.end(), is_load)) return {};
  if (std::any_of(sweep.ties.begin(), sweep.ties.end(), is_tied_load)) return {};
  const std::vector<LoadText> varying = driven_by_lambda(collection.deck());
  return varying.size() == 1 ? plain(varying.front().size, 60) : std::string();
}

bool has_page(const Collection& collection, int number) {
  std::error_code ignored;
  const auto folder = collection.results().folder(number);
  return folder && std::filesystem::exists(*folder / "report.html", ignored);
}

bool less_by_x(const MapPoint& a, const MapPoint& b) {
  return a.x.is_number() && b.x.is_number() && a.x.get<double>() < b.x.get<double>();
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

DrawnCases::DrawnCases(const Collection& collection, const Overview& of_all, const std::vector<std::string>& keys,
                       const std::vector<std::string>& monitors)
    : collection_(collection), order_(keys), loads_(load_kinds(of_all, monitors)) {
  for (const Key& key : collection.sweep().keys)
    if (std::find(keys.begin(), keys.end(), key.name) == keys.end()) order_.push_back(key.name);
  for (const std::string& key : order_) order_titles_.push_back(key_title(collection, key));
  titles_ = {
      .x = order_titles_.front(), .y = keys.size() > 1 ? order_titles_[1] : "", .unit = unit_of_lambda(collection)};
  if (collection.deck().curve)
    curves_.titles = {
        .x = key_title(collection, collection.deck().curve->parameter), .load = "λ of the event", .unit = titles_.unit};
  for (const std::string& key : keys) {
    const auto found = of_all.keys.find(key);
    ranges_.push_back(found == of_all.keys.end() ? KeyRange() : found->second);
  }
  const std::size_t of_each_load = most_points / std::max<std::size_t>(loads_.size(), 1);
  are_means_ = collection.size() > of_each_load;
  constexpr int fewest = 8;
  parts_ =
      std::max(fewest, static_cast<int>(std::min<double>(KeyRange::most_distinct, std::sqrt(double(of_each_load)))));
}

// Where the key has few values these, else the middle of one of its equal parts.
Json DrawnCases::near(std::size_t key, const Json& value) const {
  const KeyRange& range = ranges_[key];
  if (static_cast<int>(range.distinct.size()) <= parts_ || !range.numbers) return value;
  const double part = (range.high - range.low) / parts_;
  const double at = std::floor((value.get<double>() - range.low) / part);
  return range.low + (std::clamp(at, 0.0, parts_ - 1.0) + 0.5) * part;
}

void DrawnCases::add_curve(const Case& one, const CaseResult& result) {
  constexpr std::size_t most_curves = 40, most_of_each = 40;
  if (result.curve.size() < 2 || curves_.lines.size() >= most_curves) return;
  std::string name;
  for (const std::string& key : order_) name += (name.empty() ? "" : ", ") + key + " = " + label(value_of(one, key));
  LoadLine& line = curves_.lines.emplace_back(LoadLine{.name = name});
  const std::size_t drawn = std::min(result.curve.size(), most_of_each);
  for (std::size_t i = 0; i < drawn; ++i) {
    const auto [key, lambda] = result.curve[i * (result.curve.size() - 1) / (drawn - 1)];
    line.points.push_back({.number = one.number, .x = key, .load = lambda, .note = name});
  }
}

void DrawnCases::add(const Case& one, const CaseResult& result) {
  if (!result.there) return;
  add_curve(one, result);
  std::vector<std::optional<double>> of_case;
  for (const LoadKind& kind : loads_) of_case.push_back(kind.of(result));
  if (!are_means_) {
    One& added = cases_.emplace_back(One{.number = one.number,
                                         .loads = std::move(of_case),
                                         .failed = result.failed(),
                                         .has_page = has_page(collection_, one.number)});
    for (const std::string& key : order_) added.values.push_back(value_of(one, key));
    return;
  }
  const auto at = [&](std::size_t key) { return key < keys_drawn() ? near(key, value_of(one, order_[key])) : Json(); };
  Mean& mean = means_[{at(0), at(1)}];
  mean.loads.resize(loads_.size());
  ++mean.cases;
  mean.failed += result.failed() ? 1 : 0;
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    if (!of_case[i]) continue;
    Mean::Load& load = mean.loads[i];
    ++load.count;
    load.sum += *of_case[i];
    load.low = std::min(load.low, *of_case[i]);
    load.high = std::max(load.high, *of_case[i]);
  }
}

std::string DrawnCases::note(const One& one, std::size_t first) const {
  std::string text;
  for (std::size_t i = first; i < order_.size(); ++i)
    text += (text.empty() ? "" : "\n") + order_[i] + " = " + label(one.values[i]);
  return text;
}

MapPoint DrawnCases::point(const One& one, std::size_t load, std::size_t first_noted) const {
  return {.number = one.number,
          .x = one.values[0],
          .y = keys_drawn() > 1 ? one.values[1] : Json(),
          .load = one.loads[load],
          .failed = one.failed,
          .note = note(one, first_noted),
          .link = one.has_page ? fmt::format("cases/{:05}/report.html", one.number) : ""};
}

MapPoint DrawnCases::point(const std::pair<Json, Json>& at, const Mean& mean, std::size_t load) const {
  const Mean::Load& of = mean.loads[load];
  MapPoint point{.x = at.first, .y = at.second, .cases = std::max(mean.cases, 2)};
  if (of.count > 0) {
    point.load = of.sum / of.count;
    point.note =
        fmt::format("{} of them have one, from {} to {}", of.count, short_number(of.low), short_number(of.high));
  }
  if (mean.failed > 0) point.note += fmt::format("{}{} of them failed", point.note.empty() ? "" : "\n", mean.failed);
  return point;
}

// λ multiplies something; a monitor is what it is.
MapTitles DrawnCases::titles_of(std::size_t load) const {
  MapTitles titles = titles_;
  titles.load = loads_[load].title;
  if (!loads_[load].monitor.empty()) titles.unit.clear();
  return titles;
}

LoadMap DrawnCases::map(std::size_t load) const {
  LoadMap map{.titles = titles_of(load)};
  for (const One& one : cases_) map.points.push_back(point(one, load, keys_drawn()));
  for (const auto& [at, mean] : means_) map.points.push_back(point(at, mean, load));
  return map;
}

LoadLines DrawnCases::lines(std::size_t load, std::size_t key) const {
  const std::size_t other = 1 - key;
  const auto turned = [&](MapPoint point) {
    if (key == 1) std::swap(point.x, point.y);
    return point;
  };
  LoadLines lines{.titles = titles_of(load)};
  if (key == 1) std::swap(lines.titles.x, lines.titles.y);
  std::map<std::vector<std::string>, std::size_t> place;  // of the values of the other keys
  const auto line_of = [&](const std::vector<std::string>& others, const std::string& name,
                           const Json& panel) -> LoadLine& {
    const auto [found, is_new] = place.try_emplace(others, lines.lines.size());
    if (is_new) lines.lines.push_back({.name = name, .panel = panel});
    return lines.lines[found->second];
  };
  for (const One& one : cases_) {
    std::vector<std::string> others;
    std::string name;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (i == key) continue;
      others.push_back(one.values[i].dump());
      name += (name.empty() ? "" : ", ") + order_[i] + " = " + label(one.values[i]);
    }
    const Json panel = keys_drawn() > 1 ? one.values[other] : Json();
    line_of(others, name, panel).points.push_back(turned(point(one, load, keys_drawn())));
  }
  for (const auto& [at, mean] : means_) {
    const Json& across = key == 0 ? at.second : at.first;
    line_of({across.dump()}, keys_drawn() > 1 ? order_[other] + " = " + label(across) : "", across)
        .points.push_back(turned(point(at, mean, load)));
  }
  for (LoadLine& line : lines.lines) std::stable_sort(line.points.begin(), line.points.end(), less_by_x);
  return lines;
}

}  // namespace arcwall::sweep
