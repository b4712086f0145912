#include "apps/output/report_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/output/event_marks.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/jump_rows.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/path_lines.hpp"
#include "apps/output/report_data.hpp"
#include "apps/output/report_head.hpp"
#include "apps/output/roundoff.hpp"
#include "apps/output/shown_number.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

std::string event_text(const Record& record, const RecordEvent& event, const std::vector<double>& zero) {
  const std::string detail = plain(event_detail(event), 200);
  std::string text = fmt::format("{}: {}{}{}, λ = {}", event.id, words(event.kind), detail.empty() ? "" : " – ", detail,
                                 shown_lambda(event, 8));
  for (std::size_t i = 0; i < record.columns.size(); ++i)
    text += fmt::format(", {} = {}", shown_name(record.columns[i].name),
                        shown_number(without_roundoff(event.monitors[i], zero[i]), 6));
  return text;
}

// Other runs, each line of which is a branch, and measured points.
void add_overlays(const ReportContent& content, const std::string& across, Chart& chart) {
  for (std::size_t i = 0; i < content.overlays.size(); ++i) {
    const Overlay& overlay = content.overlays[i];
    const auto x = overlay.values.find(across), y = overlay.values.find("lambda");
    if (x == overlay.values.end() || y == overlay.values.end()) continue;
    for (std::size_t k = 0; k < x->second.size(); ++k) {
      const bool begins = std::find(overlay.firsts.begin(), overlay.firsts.end(), k) != overlay.firsts.end();
      if (overlay.measured || begins) chart.lines.push_back({.colour = overlay_colour(i)});
      const Vec2 at(x->second[k], y->second[k]);
      ChartLine& line = chart.lines.back();
      line.points.push_back(at);
      if (overlay.measured) line.points.push_back(at);  // a line of no length, which its round ends make a dot
      if (!overlay.measured && !begins) line.steps.push_back(cubic_step(overlay, k, across, "lambda"));
    }
  }
}

// The derivatives at the ends of a step along which a quantity that changes by `chord` is known to be monotone: Fritsch
// and Carlson (1980). One of the other sense is that behind a kink; the parabola of the other one takes its place.
void keep_monotone(double chord, double& begin, double& end) {
  const double first = begin, last = end;
  if (first * chord < 0.0) begin = 2.0 * chord - last;
  if (last * chord < 0.0) end = 2.0 * chord - first;
  const double least = std::min(0.0, 3.0 * chord), most = std::max(0.0, 3.0 * chord);
  begin = std::clamp(begin, least, most);
  end = std::clamp(end, least, most);
}

// λ is monotone between points, and so are monitors whose turning points are known.
void keep_monotone(const ReportContent& content, const std::string& across, ChartLine& line) {
  const auto& known = content.turning_known;
  const bool is_known = std::find(known.begin(), known.end(), across) != known.end();
  for (std::size_t i = 0; i < line.steps.size(); ++i) {
    if (!line.steps[i]) continue;
    const Vec2 chord = line.points[i + 1] - line.points[i];
    CubicStep& step = *line.steps[i];
    if (is_known) keep_monotone(chord.x(), step.begin.x(), step.end.x());
    keep_monotone(chord.y(), step.begin.y(), step.end.y());
  }
}

// The same with its axes exchanged.
void exchange_axes(Chart& chart) {
  const auto exchange = [](Vec2& one) { std::swap(one.x(), one.y()); };
  std::swap(chart.across, chart.up);
  for (ChartLine& line : chart.lines) {
    for (Vec2& point : line.points) exchange(point);
    for (std::optional<CubicStep>& step : line.steps) {
      if (!step) continue;
      exchange(step->begin);
      exchange(step->end);
    }
  }
  for (ChartMark& mark : chart.marks) exchange(mark.at);
}

}  // namespace

Chart path_chart(const Record& record, const ReportContent& content, std::optional<std::size_t> monitor) {
  const auto across = [&](const RecordPoint& point) { return monitor ? point.monitors[*monitor] : point.arc; };
  const std::string axis = monitor ? shown_title(record.columns[*monitor]) : "arc length";
  Chart result{.name = "Load factor over " + axis, .across = axis, .up = title_of_lambda(content.loads)};
  for (const PathLine& line : path_lines(record)) {
    ChartLine& added = result.lines.emplace_back();
    added.colour = branch_colour(line.branch);
    added.stability = line.stability;
    for (std::size_t i = line.first; i <= line.last; ++i) {
      added.points.emplace_back(across(record.points[i]), record.points[i].lambda);
      if (i > line.first) added.steps.push_back(cubic_step(record, i, monitor));
    }
    keep_monotone(content, monitor ? record.columns[*monitor].name : "", added);
  }
  if (monitor) add_overlays(content, record.columns[*monitor].name, result);
  if (monitor)
    for (const Jump& jump : jumps(record))
      result.lines.push_back({.points = {{jump.from[*monitor], jump.lambda}, {jump.to[*monitor], jump.lambda}},
                              .colour = jump_colour,
                              .is_arrow = true});
  const std::vector<std::size_t> first = first_points(record);
  const std::vector<double> zero = roundoff(record);
  for (const RecordEvent& event : record.events) {
    const std::size_t point = point_of(event, first);
    result.marks.push_back({.at = {across(record.points[point]), event.lambda},
                            .kind = event.kind,
                            .text = event_text(record, event, zero),
                            .point = point});
  }
  if (monitor && is_movement(content.loads)) {
    exchange_axes(result);
    result.name = axis + " over " + result.across;
  }
  return result;
}
std::string legend_of_lines(const Record& record, const std::vector<Overlay>& overlays) {
  std::string text = "<ul class=\"legend\">";
  std::set<Stability> met;
  for (const PathLine& line : path_lines(record)) met.insert(line.stability);
  if (record.branches.size() > 1) {
    constexpr std::size_t most = 12;
    for (std::size_t i = 0; i < std::min(record.branches.size(), most); ++i)
      text +=
          fmt::format("<li>{}branch {}{}</li>", svg_line(branch_colour(static_cast<Index>(i)), Stability::stable), i,
                      record.stages.empty() ? "" : ", " + escaped(shown_name(record.stage_of(static_cast<Index>(i)))));
    if (record.branches.size() > most) text += "<li>… colours repeat</li>";
  }
  for (const Stability stability : met)
    text += fmt::format("<li>{}{}</li>", svg_line(record.branches.size() > 1 ? "#555" : branch_colour(0), stability),
                        to_text(stability));
  for (std::size_t i = 0; i < overlays.size(); ++i)
    text += fmt::format("<li>{}{}{}</li>", svg_line(overlay_colour(i), Stability::stable),
                        overlays[i].measured ? "measured: " : "", escaped(shown_name(overlays[i].name)));
  if (!jumps(record).empty()) text += fmt::format("<li>{}jump at constant λ</li>", svg_arrow(jump_colour));
  return text + "</ul>";
}

std::string legend(const Record& record, const std::vector<Overlay>& overlays) {
  std::string text = legend_of_lines(record, overlays) + "<ul class=\"legend\">";
  std::set<EventKind> kinds;
  for (const RecordEvent& event : record.events) kinds.insert(event.kind);
  for (const EventKind kind : kinds)
    text += fmt::format("<li>{}<span><b>{}</b> {}</span></li>", svg_mark(kind), words(kind), meaning(kind));
  return text + "</ul>";
}

}  // namespace arcwall
