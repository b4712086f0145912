#include "apps/sweep/load_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/sweep/case_list.hpp"
#include "apps/sweep/plot_frame.hpp"

namespace arcwall::sweep {

namespace {

// What a line is drawn by: λ itself, or as a part of the line's λ₀.
enum class Measure { load, part_of_reference };

std::optional<double> height_of(const LoadLine& line, const MapPoint& point, Measure measure) {
  if (!point.load) return std::nullopt;
  if (measure == Measure::load) return point.load;
  const auto reference = line.reference();
  if (!reference || *reference == 0.0) return std::nullopt;
  return *point.load / *reference;
}

std::string colour_of(std::size_t line, std::size_t lines) {
  // What is seen as a line on white and on black.
  constexpr double from = 0.3, to = 0.85;
  return text_of(
      colour_at(lines > 1 ? from + (to - from) * static_cast<double>(line) / static_cast<double>(lines - 1) : 0.4));
}

class LinesDrawing {
 public:
  LinesDrawing(const LoadLines& lines, Measure measure)
      : lines_(lines), measure_(measure), x_(keys(), AxisScale::by_extent), y_(heights(), AxisScale::linear) {}

  bool is_empty() const { return heights(/*or_zero=*/false).empty(); }

  std::string line(const LoadLine& of, const PlotArea& area, const std::string& colour) const {
    std::string way;
    bool on = false;
    for (const MapPoint& point : of.points) {
      const auto height = height_of(of, point, measure_);
      if (!height || point.failed) {
        on = false;
        continue;
      }
      way += fmt::format("{}{:.1f} {:.1f}", on ? "L" : "M", x(point, area), y(*height, area));
      on = true;
    }
    return way.empty() ? "" : fmt::format(R"(<path d="{}" stroke="{}" stroke-width="1.6"/>)", way, colour) + "\n";
  }

  std::string marks(const LoadLine& of, const PlotArea& area, const std::string& colour) const {
    std::string drawn;
    for (const MapPoint& point : of.points) {
      const auto height = height_of(of, point, measure_);
      if (!height) continue;
      const double at = x(point, area), up = y(*height, area);
      std::string mark = fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="4" fill="{}"/>)", at, up, colour);
      if (point.failed) mark += cross(at, up);
      drawn += pointed_at(tip(lines_.titles, point, of.reference()), point.link, mark);
    }
    return drawn;
  }

  std::string axes(const PlotArea& area, const FrameTexts& texts) const { return frame(area, x_, y_, texts); }

 private:
  double x(const MapPoint& point, const PlotArea& area) const { return area.x_at(x_.place(point.x)); }
  double y(double height, const PlotArea& area) const { return area.y_at(y_.place(Json(height))); }

  std::vector<Json> keys() const {
    std::vector<Json> all;
    for (const LoadLine& line : lines_.lines)
      for (const MapPoint& point : line.points) all.push_back(point.x);
    return all;
  }

  std::vector<Json> heights(bool or_zero = true) const {
    std::vector<Json> all;
    for (const LoadLine& line : lines_.lines)
      for (const MapPoint& point : line.points)
        if (const auto height = height_of(line, point, measure_)) all.emplace_back(*height);
    if (all.empty() && or_zero) all.emplace_back(0.0);
    return all;
  }

  const LoadLines& lines_;
  Measure measure_;
  MapAxis x_, y_;
};

// The names of a few lines; of many the colours go with their order.
std::string legend(const LoadLines& lines, const PlotArea& area) {
  constexpr std::size_t most = 12;
  if (lines.lines.size() < 2 || lines.lines.size() > most) return "";
  std::string result;
  for (std::size_t i = 0; i < lines.lines.size(); ++i) {
    const double y = area.top + area.height + 76.0 + 20.0 * static_cast<double>(i);
    result += fmt::format(R"(<path d="M{:.0f} {:.1f}h24" stroke="{}" stroke-width="3"/>)", area.left, y - 4.0,
                          colour_of(i, lines.lines.size())) +
              text(area.left + 32.0, y, "start", lines.lines[i].name);
  }
  return result;
}

double legend_height(const LoadLines& lines) {
  constexpr std::size_t most = 12;
  return lines.lines.size() < 2 || lines.lines.size() > most ? 0.0
                                                             : 20.0 * static_cast<double>(lines.lines.size()) + 20.0;
}

std::string chart(const LoadLines& lines, Measure measure, const std::string& title) {
  const LinesDrawing drawing(lines, measure);
  if (!has_lines(lines) || drawing.is_empty()) return "";
  const PlotArea area{.width = 460.0, .height = 320.0};
  std::string body = drawing.axes(area, {.x_title = lines.titles.x, .y_title = title});
  for (std::size_t i = 0; i < lines.lines.size(); ++i)
    body += drawing.line(lines.lines[i], area, colour_of(i, lines.lines.size()));
  for (std::size_t i = 0; i < lines.lines.size(); ++i)
    body += drawing.marks(lines.lines[i], area, colour_of(i, lines.lines.size()));
  return picture(area.left + area.width + 20.0, area.top + area.height + 60.0 + legend_height(lines), title,
                 body + legend(lines, area));
}

}  // namespace

std::optional<double> LoadLine::reference() const {
  if (points.empty()) return std::nullopt;
  const bool numbers =
      std::all_of(points.begin(), points.end(), [](const MapPoint& point) { return point.x.is_number(); });
  const auto size = [](const MapPoint& point) { return std::abs(point.x.get<double>()); };
  const auto first = numbers ? std::min_element(points.begin(), points.end(),
                                                [&](const MapPoint& a, const MapPoint& b) { return size(a) < size(b); })
                             : points.begin();
  return first->failed ? std::nullopt : first->load;
}

bool has_lines(const LoadLines& lines) {
  return std::any_of(lines.lines.begin(), lines.lines.end(),
                     [](const LoadLine& line) { return line.points.size() > 1; });
}

std::string lines_svg(const LoadLines& lines) { return chart(lines, Measure::load, load_axis(lines.titles)); }

std::string knockdown_svg(const LoadLines& lines) {
  const std::size_t name = lines.titles.load.find(' ');
  const std::string of = lines.titles.load.substr(0, name);
  return chart(lines, Measure::part_of_reference, of + "/" + of + "₀" + lines.titles.load.substr(name));
}

std::string panels_svg(const LoadLines& lines) {
  constexpr std::size_t most = 16, columns = 4;
  std::vector<Json> values;
  for (const LoadLine& line : lines.lines)
    if (!line.panel.is_null() && std::find(values.begin(), values.end(), line.panel) == values.end())
      values.push_back(line.panel);
  const LinesDrawing drawing(lines, Measure::load);
  if (values.size() < 2 || values.size() > most || !has_lines(lines) || drawing.is_empty()) return "";
  constexpr double left = 90.0, top = 34.0, width = 190.0, height = 140.0, gap = 16.0, head = 26.0;
  const std::size_t rows = (values.size() + columns - 1) / columns;
  std::string body;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t row = i / columns, column = i % columns;
    const PlotArea area{.left = left + static_cast<double>(column) * (width + gap),
                        .top = top + static_cast<double>(row) * (height + head + gap),
                        .width = width,
                        .height = height};
    const bool lowest = i + columns >= values.size();
    body += drawing.axes(area, {.x_labels = lowest, .y_labels = column == 0}) +
            text(area.left + width / 2.0, area.top - 8.0, "middle", label(values[i]));
    for (const LoadLine& line : lines.lines)
      if (line.panel != values[i]) body += drawing.line(line, area, "#8885");
    for (std::size_t k = 0; k < lines.lines.size(); ++k)
      if (lines.lines[k].panel == values[i])
        body += drawing.line(lines.lines[k], area, colour_of(k, lines.lines.size()));
  }
  const double used = static_cast<double>(std::min(values.size(), columns)) * (width + gap);
  const double bottom = top + static_cast<double>(rows) * (height + head + gap);
  body += text(left + used / 2.0, bottom + 22.0, "middle", lines.titles.x) +
          upright(16.0, (top + bottom) / 2.0, load_axis(lines.titles));
  return picture(left + used + 4.0, bottom + 36.0, lines.titles.load, body);
}

}  // namespace arcwall::sweep
