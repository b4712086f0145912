#include "apps/output/curve_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/output/curve_files.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/report_parts.hpp"
#include "apps/output/shape_svg.hpp"
#include "apps/output/shown_number.hpp"
#include "apps/output/svg_chart.hpp"
#include "model/event_names.hpp"
#include "model/version.hpp"

namespace arcwall {

namespace {

EventKind mark_of(CurveSpecialKind kind) {
  switch (kind) {
    case CurveSpecialKind::begins:
      return EventKind::start;
    case CurveSpecialKind::ends:
      return EventKind::end;
    case CurveSpecialKind::cusp:
      return EventKind::limit_point;
    case CurveSpecialKind::crossing:
      break;
  }
  return EventKind::branch_point;
}

// Solid where one side of the event is stable, dashed where none is.
Stability stability_of(const CurvePoint& point) {
  if (!point.unstable_before || !point.unstable_after) return Stability::undecided;
  return std::min(*point.unstable_before, *point.unstable_after) == 0 ? Stability::stable : Stability::unstable;
}

Chart chart_of(const EventCurve& curve, const std::string& up, double (*value)(const CurvePoint&, std::size_t),
               std::size_t which) {
  const std::string across = curve.key + (curve.key_unit.empty() ? "" : " [" + curve.key_unit + "]");
  Chart chart{.name = up + " over " + curve.key, .across = across, .up = up};
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const Stability stability = stability_of(curve.points[i]);
    const auto at = [&](std::size_t k) { return Vec2(curve.points[k].key, value(curve.points[k], which)); };
    if (chart.lines.empty() || chart.lines.back().stability != stability)
      chart.lines.push_back({.points = {at(i - 1)}, .colour = "#0072b2", .stability = stability});
    chart.lines.back().points.push_back(at(i));
  }
  for (const CurveSpecial& special : curve.specials) {
    const CurvePoint& point = curve.points[special.point];
    chart.marks.push_back(
        {.at = {point.key, value(point, which)},
         .kind = mark_of(special.kind),
         .text = fmt::format("{} at {}: {}", to_text(special.kind), shown_number(point.key, 8), special.why),
         .point = special.point});
  }
  return chart;
}

// What λ multiplies has no one size along a curve over a number of its own.
std::string title_of_lambda(const EventCurve& curve, std::vector<LoadText> loads) {
  for (LoadText& load : loads)
    if (curve.key.starts_with(load.key + ".")) load.size.clear();
  return title_of_lambda(loads);
}

double lambda_of(const CurvePoint& point, std::size_t) { return point.lambda; }
double monitor_of(const CurvePoint& point, std::size_t i) { return point.monitors[i]; }

// --- shapes ---------------------------------------------------------------------------------------------------------

// The special points and some between.
std::set<std::size_t> drawn_points(const EventCurve& curve) {
  constexpr std::size_t wanted = 8;
  std::set<std::size_t> points;
  for (const CurveSpecial& special : curve.specials) points.insert(special.point);
  for (std::size_t i = 0; i < wanted && !curve.points.empty(); ++i)
    points.insert(i * (curve.points.size() - 1) / (wanted - 1));
  return points;
}

// To one scale, with the walls where the number has put them.
ShapePictures pictures_of(const EventCurve& curve, const std::set<std::size_t>& points) {
  DrawnScenes drawn;
  for (const std::size_t i : points) {
    drawn.points.push_back(i);
    drawn.scenes.push_back({.shape = curve.points[i].shape, .walls = curve.points[i].walls});
  }
  return draw(drawn, {.heights = curve.points.empty() ? std::vector<double>{} : curve.points.front().heights});
}

std::string shapes_html(const EventCurve& curve) {
  const ShapePictures shapes = pictures_of(curve, drawn_points(curve));
  std::string html = "<div id=\"strip\">\n";
  for (const ShapePicture& picture : shapes.pictures) {
    const CurvePoint& point = curve.points[picture.point];
    std::string name;
    for (const CurveSpecial& special : curve.specials)
      if (special.point == picture.point) name += (name.empty() ? "" : ", ") + std::string(to_text(special.kind));
    html += fmt::format(
        "<figure><svg class=\"shape\" viewBox=\"{}\" role=\"img\" aria-label=\"Shape at point "
        "{}\">{}</svg><figcaption><span>{}</span>"
        "</figcaption></figure>\n",
        view_box(shapes), picture.point, shape_paths(shapes, picture),
        escaped(fmt::format("{}{} = {}, λ = {}", name.empty() ? "" : name + ": ", curve.key, shown_number(point.key, 6),
                            shown_number(point.lambda, 7))));
  }
  return html + "</div>\n" + stretch_note(shapes);
}

// --- what lies on both sides ----------------------------------------------------------------------------------------

std::string sides_text(const CurvePoint& point) {
  const auto one = [](const std::optional<Index>& count) {
    if (!count) return std::string("not counted");
    return *count == 0 ? std::string("stable") : fmt::format("{} unstable", *count);
  };
  return one(point.unstable_before) + " → " + one(point.unstable_after);
}

// Stretches with the same counts, as rows of a table.
std::string sides_html(const EventCurve& curve) {
  std::string rows;
  for (std::size_t i = 0; i < curve.points.size();) {
    std::size_t last = i;
    while (last + 1 < curve.points.size() && sides_text(curve.points[last + 1]) == sides_text(curve.points[i])) ++last;
    rows += fmt::format("<tr><td>{} … {}</td><td>{}</td></tr>\n", shown_number(curve.points[i].key, 6),
                        shown_number(curve.points[last].key, 6), escaped(sides_text(curve.points[i])));
    i = last + 1;
  }
  return "<table><thead><tr><th>" + escaped(curve.key) + "</th><th>before → after the event</th></tr></thead><tbody>" +
         rows + "</tbody></table>";
}

std::string specials_html(const EventCurve& curve) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr><th>special point</th><th class=\"figure long\">" +
      escaped(curve.key) + "</th><th class=\"figure\">λ</th><th>why</th></tr></thead><tbody>\n";
  for (const CurveSpecial& special : curve.specials) {
    const CurvePoint& point = curve.points[special.point];
    html += fmt::format("<tr><td>{}</td><td class=\"figure\">{}</td><td class=\"figure\">{}</td><td>{}</td></tr>\n",
                        to_text(special.kind), shown_number(point.key, 7), shown_number(point.lambda, 8),
                        escaped(special.why));
  }
  return html + "</tbody></table></div>";
}

std::string chart_section(const std::string& title, const Chart& chart, const std::string& below = {}) {
  return "<section>\n<h2>" + escaped(title) + "</h2>\n" + svg_chart(chart) + below + "</section>\n";
}

std::string head_of(const std::string& title) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
         "img-src "
         "data:\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" "
         "href=\"data:,\">\n<title>" +
         escaped(title) + "</title>\n<style>\n" + std::string(report_parts().style) + "</style>\n</head>\n";
}

}  // namespace

std::string curve_html(const EventCurve& curve, const std::vector<LoadText>& loads) {
  const std::string title = curve.title.empty() ? curve.deck : curve.title;
  std::string html = head_of(title) + "<body>\n<header>\n<h1>" + escaped(title) + "</h1>\n<p class=\"outcome\">" +
                     escaped(followed_event(curve)) + "</p>\n</header>\n<main>\n<div class=\"views\">\n";
  html += chart_section("Load factor of the event", chart_of(curve, title_of_lambda(curve, loads), lambda_of, 0),
                        "<p class=\"note\">Solid: the path is stable on one side of the event. Dashed: on neither. "
                        "Dotted: not counted.</p>\n");
  html += "<section>\n<h2>Special points</h2>\n" + specials_html(curve) +
          "<h2 class=\"next\">Stability on both sides of the event</h2>\n" + sides_html(curve) +
          "</section>\n</div>\n<section>\n<h2>Shapes at the event</h2>\n" + shapes_html(curve) +
          "</section>\n<div class=\"views\">\n";
  for (std::size_t i = 0; i < curve.columns.size(); ++i) {
    const RecordColumn& column = curve.columns[i];
    const std::string up = column.name + (column.unit.empty() ? "" : " [" + column.unit + "]");
    html += chart_section(up, chart_of(curve, up, monitor_of, i));
  }
  return html + "</div>\n<p class=\"note\">All numbers: curve.csv (a row a point) and curve.json. trace-path " +
         program_version() + "</p>\n</main>\n</body>\n</html>\n";
}

std::string curve_picture(const EventCurve& curve, const std::vector<LoadText>& loads) {
  return framed_chart(chart_of(curve, title_of_lambda(curve, loads), lambda_of, 0));
}

}  // namespace arcwall
