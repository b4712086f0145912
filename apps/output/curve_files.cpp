#include "apps/output/curve_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>

#include "apps/output/csv.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/report_parts.hpp"
#include "apps/output/result_json.hpp"
#include "apps/output/shown_number.hpp"
#include "apps/output/svg_chart.hpp"
#include "apps/output/text_table.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/event_names.hpp"
#include "model/version.hpp"

namespace arcwall {

using OrderedJson = nlohmann::ordered_json;

namespace {

std::string cell(const std::optional<double>& value) { return value ? round_trip(*value) : ""; }
std::string cell(const std::optional<Index>& value) { return value ? std::to_string(*value) : ""; }

OrderedJson number(double value) { return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr); }

const CurvePoint& point_of(const EventCurve& curve, const CurveSpecial& special) { return curve.points[special.point]; }

OrderedJson special_json(const EventCurve& curve, const CurveSpecial& special) {
  const CurvePoint& point = point_of(curve, special);
  OrderedJson monitors = OrderedJson::object();
  for (std::size_t i = 0; i < point.monitors.size(); ++i) monitors[curve.columns[i].name] = number(point.monitors[i]);
  OrderedJson json;
  json["kind"] = to_text(special.kind);
  json["point"] = special.point;
  json["key"] = number(point.key);
  json["lambda"] = number(point.lambda);
  json["monitors"] = std::move(monitors);
  json["why"] = special.why;
  const bool is_end = special.kind == CurveSpecialKind::begins || special.kind == CurveSpecialKind::ends;
  if (is_end) json["reason"] = to_text(special.reason);
  return json;
}

std::string what(const EventCurve& curve) {
  return fmt::format("{} {} over {}", to_text(curve.event), curve.number, curve.key);
}

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
    const CurvePoint& point = point_of(curve, special);
    chart.marks.push_back(
        {.at = {point.key, value(point, which)},
         .kind = mark_of(special.kind),
         .text = fmt::format("{} at {}: {}", to_text(special.kind), shown_number(point.key, 8), special.why),
         .point = special.point});
  }
  return chart;
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

struct Box {
  Vec2 low = Vec2::Constant(infinity), high = Vec2::Constant(-infinity);
};

Box box_of(const EventCurve& curve, const std::set<std::size_t>& points) {
  Box box;
  for (const std::size_t i : points)
    for (const MemberShape& member : curve.points[i].shape.members)
      for (const ShapePoint& point : member.points) {
        box.low = box.low.cwiseMin(point.position);
        box.high = box.high.cwiseMax(point.position);
      }
  return box;
}

// The axes of the members, with a dot at each contact.
std::string shape_svg(const CurvePoint& point, const Box& box) {
  constexpr double wide = 300.0, margin = 6.0, most_stretch = 6.0, flat = 0.25;
  const Vec2 size = (box.high - box.low).cwiseMax(1e-9 * (box.high - box.low).norm() + 1e-300);
  const double scale = (wide - 2.0 * margin) / size.x();
  const double stretch = std::clamp(flat * size.x() / size.y(), 1.0, most_stretch);
  const double high = std::min(scale * stretch * size.y(), wide) + 2.0 * margin;
  const double up = (high - 2.0 * margin) / size.y();
  const auto x = [&](const Vec2& at) { return margin + scale * (at.x() - box.low.x()); };
  const auto y = [&](const Vec2& at) { return high - margin - up * (at.y() - box.low.y()); };
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {:.0f} {:.1f}\" width=\"{:.0f}\" role=\"img\" aria-label=\"shape\">", wide, high, wide);
  for (const MemberShape& member : point.shape.members) {
    std::string line;
    for (const ShapePoint& one : member.points) line += fmt::format("{:.1f},{:.1f} ", x(one.position), y(one.position));
    svg += "<polyline fill=\"none\" stroke=\"#1c1f23\" stroke-width=\"1.6\" points=\"" + line + "\"/>";
  }
  for (const ContactMark& contact : point.shape.contacts)
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"#d55e00\"/>", x(contact.position),
                       y(contact.position));
  return svg + "</svg>";
}

std::string shapes_html(const EventCurve& curve) {
  const std::set<std::size_t> points = drawn_points(curve);
  const Box box = box_of(curve, points);
  std::string html;
  for (const std::size_t i : points) {
    const CurvePoint& point = curve.points[i];
    std::string name;
    for (const CurveSpecial& special : curve.specials)
      if (special.point == i) name += (name.empty() ? "" : ", ") + std::string(to_text(special.kind));
    html += "<figure>" + shape_svg(point, box) + "<figcaption class=\"note\">" +
            escaped(fmt::format("{}{} = {}, λ = {}", name.empty() ? "" : name + ": ", curve.key,
                                shown_number(point.key, 6), shown_number(point.lambda, 7))) +
            "</figcaption></figure>\n";
  }
  return html;
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
  return "<table><thead><tr><th>" + escaped(curve.key) + "</th><th>before → behind the event</th></tr></thead><tbody>" +
         rows + "</tbody></table>";
}

std::vector<std::vector<std::string>> special_rows(const EventCurve& curve) {
  std::vector<std::vector<std::string>> rows;
  for (const CurveSpecial& special : curve.specials) {
    const CurvePoint& point = point_of(curve, special);
    rows.push_back(
        {std::string(to_text(special.kind)), shown_number(point.key, 12), shown_number(point.lambda, 12), special.why});
  }
  return rows;
}

std::string specials_html(const EventCurve& curve) {
  std::string html = "<table><thead><tr><th>special point</th><th class=\"figure\">" + escaped(curve.key) +
                     "</th><th class=\"figure\">λ</th><th>why</th></tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : special_rows(curve))
    html += fmt::format("<tr><td>{}</td><td class=\"figure\">{}</td><td class=\"figure\">{}</td><td>{}</td></tr>\n",
                        row[0], row[1], row[2], escaped(row[3]));
  return html + "</tbody></table>";
}

}  // namespace

std::string curve_csv(const EventCurve& curve, UnitLabels labels) {
  std::string text = "point,arc," + csv_title("key", curve.key_unit, labels) + ",lambda";
  for (const RecordColumn& column : curve.columns) text += "," + csv_title(column.name, column.unit, labels);
  text += ",slope,unstable_before,unstable_after,contacts\n";
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const CurvePoint& point = curve.points[i];
    text +=
        std::to_string(i) + "," + round_trip(point.arc) + "," + round_trip(point.key) + "," + round_trip(point.lambda);
    for (const double value : point.monitors) text += "," + round_trip(value);
    text += "," + cell(point.slope) + "," + cell(point.unstable_before) + "," + cell(point.unstable_after) + "," +
            std::to_string(point.contacts) + "\n";
  }
  return text;
}

OrderedJson curve_json(const EventCurve& curve, std::string_view deck_text,
                       const std::vector<std::string>& assignments) {
  OrderedJson json;
  json["deck"] = {{"file", curve.deck}, {"title", curve.title}, {"crc32", crc32_text(deck_text)}, {"set", assignments}};
  json["version"] = program_version();
  json["event"] = {{"kind", to_text(curve.event)}, {"number", curve.number}};
  json["over"] = curve.key;
  json["unit"] = curve.key_unit;
  json["value"] = curve.own_value;
  json["points"] = curve.points.size();
  json["specials"] = OrderedJson::array();
  for (const CurveSpecial& special : curve.specials) json["specials"].push_back(special_json(curve, special));
  return json;
}

NamedTexts curve_files(const EventCurve& curve, UnitLabels labels, std::string_view deck_text,
                       const std::vector<std::string>& assignments) {
  return {{"curve.csv", curve_csv(curve, labels)},
          {"report.html", curve_html(curve)},
          {"curve.json", to_text(curve_json(curve, deck_text, assignments), JsonLayout::lines)}};
}

void require_no_run(const std::filesystem::path& folder, Foreign foreign) {
  std::error_code ignored;
  if (foreign == Foreign::overwrite || !std::filesystem::exists(folder / "result.json", ignored)) return;
  throw OutputError(folder.string() +
                    ": is the folder of a run, whose report.html the curve's would replace: name another folder with "
                    "--out, or write over it with --force");
}

std::string curve_text(const EventCurve& curve) {
  return fmt::format("{}: {} points\n\n", what(curve), curve.points.size()) +
         text_table({{"special point"}, {"number", TableColumn::Side::right}, {"λ", TableColumn::Side::right}, {"why"}},
                    special_rows(curve));
}

std::string curve_html(const EventCurve& curve) {
  const std::string title = curve.title.empty() ? curve.deck : curve.title;
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src "
      "data:\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" "
      "href=\"data:,\">\n";
  html += "<title>" + escaped(title) + "</title>\n<style>\n" + std::string(report_parts().style) +
          "</style>\n</head>\n<body>\n<header>\n<h1>" + escaped(title) + "</h1>\n<p class=\"outcome\">" +
          escaped(what(curve)) + "</p>\n</header>\n<main>\n";
  html += "<section>\n<h2>Load factor of the event</h2>\n" + svg_chart(chart_of(curve, "λ", lambda_of, 0)) +
          "<p class=\"note\">Solid: the path is stable on one side of the event. Dashed: on neither. Dotted: not "
          "counted.</p>\n" +
          specials_html(curve) + sides_html(curve) + "</section>\n<section>\n<h2>Shapes</h2>\n<div class=\"views\">\n" +
          shapes_html(curve) + "</div>\n</section>\n";
  for (std::size_t i = 0; i < curve.columns.size(); ++i) {
    const RecordColumn& column = curve.columns[i];
    const std::string up = column.name + (column.unit.empty() ? "" : " [" + column.unit + "]");
    html +=
        "<section>\n<h2>" + escaped(up) + "</h2>\n" + svg_chart(chart_of(curve, up, monitor_of, i)) + "</section>\n";
  }
  return html + "</main>\n<footer>trace-path " + program_version() + "</footer>\n</body>\n</html>\n";
}

std::string curve_picture(const EventCurve& curve) { return framed_chart(chart_of(curve, "λ", lambda_of, 0)); }

OrderedJson worst_json(const deck::Deck& deck, const WorstCombination& worst, std::string_view deck_text,
                       const std::vector<std::string>& assignments) {
  const std::string file = deck.source.file.substr(deck.source.file.rfind('/') + 1);
  OrderedJson json;
  json["deck"] = {{"file", file}, {"title", deck.title}, {"crc32", crc32_text(deck_text)}, {"set", assignments}};
  json["version"] = program_version();
  json["event"] = {{"kind", to_text(deck.curve->event)}, {"number", deck.curve->number}};
  json["radius"] = *deck.curve->radius;
  json["own_lambda"] = number(worst.own_lambda);
  json["lambda"] = number(worst.lambda);
  json["settled"] = worst.settled;
  json["runs"] = worst.runs;
  json["worst"] = OrderedJson::array();
  for (std::size_t i = 0; i < worst.keys.size(); ++i)
    json["worst"].push_back({{"key", worst.keys[i]},
                             {"own", number(worst.own[i])},
                             {"value", number(worst.values[i])},
                             {"slope", number(worst.slopes[i])}});
  return json;
}

std::string worst_text(const deck::Deck& deck, const WorstCombination& worst) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < worst.keys.size(); ++i)
    rows.push_back({worst.keys[i], shown_number(worst.own[i], 8), shown_number(worst.values[i], 8),
                    shown_number(worst.slopes[i], 6)});
  const auto figure = [](const char* title) { return TableColumn{title, TableColumn::Side::right}; };
  return fmt::format("{} {}: λ falls from {} to {} within a radius of {}{}\n\n", to_text(deck.curve->event),
                     deck.curve->number, shown_number(worst.own_lambda, 10), shown_number(worst.lambda, 10),
                     shown_number(*deck.curve->radius, 6),
                     worst.settled ? "" : " (the direction has not settled; this is the lowest found)") +
         text_table({{"number"}, figure("own"), figure("worst"), figure("dλ/dn")}, rows);
}

ExitStatus curve_status(const EventCurve& curve) {
  ExitStatus status = ExitStatus::success;
  for (const CurveSpecial& special : curve.specials) {
    if (special.kind != CurveSpecialKind::begins && special.kind != CurveSpecialKind::ends) continue;
    const ExitStatus one = exit_status(special.reason);
    if (one == ExitStatus::interrupted) return one;
    if (status == ExitStatus::success || one == ExitStatus::limit_met)
      status = one == ExitStatus::success ? status : one;
  }
  return status;
}

}  // namespace arcwall
