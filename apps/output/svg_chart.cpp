#include "apps/output/svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/event_marks.hpp"
#include "apps/output/markup.hpp"

namespace arcwall {

namespace {

constexpr double width = 720.0, height = 440.0;
constexpr double left = 84.0, right = 704.0, top = 14.0, bottom = 384.0;  // of the plotted area
constexpr double mark_radius = 5.5;

// Values on one axis, and where they are drawn.
struct Scale {
  double low = 0.0, high = 1.0;
  double low_place = 0.0, high_place = 1.0;

  double place(double value) const { return low_place + (value - low) / (high - low) * (high_place - low_place); }
};

struct Scales {
  Scale across{}, up{};

  Vec2 place(const Vec2& at) const { return {across.place(at.x()), up.place(at.y())}; }
};

// The range of the values with some room beyond them.
Scale scale_of(const Chart& chart, int axis, double low_place, double high_place) {
  double low = infinity, high = -infinity;
  for (const ChartLine& line : chart.lines) {
    for (const Vec2& point : line.points) {
      if (!point.allFinite()) continue;
      low = std::min(low, point[axis]);
      high = std::max(high, point[axis]);
    }
  }
  if (low > high) low = high = 0.0;
  // Of values that are the same to round-off the differences say nothing.
  const double least_range = 1e-9 * std::max(std::abs(low), std::abs(high));
  const double room = high - low > least_range ? 0.04 * (high - low) : std::max(0.5 * std::abs(high), 1e-9);
  return {.low = low - room, .high = high + room, .low_place = low_place, .high_place = high_place};
}

std::string range_text(const Scale& scale) {
  return fmt::format("{} {} {} {}", scale.low, scale.high, scale.low_place, scale.high_place);
}

std::string_view dashes(Stability stability) {
  switch (stability) {
    case Stability::stable:
      return "";
    case Stability::unstable:
      return " stroke-dasharray=\"8 5\"";
    case Stability::undecided:
      return " stroke-dasharray=\"1.5 4\"";
  }
  return "";
}

std::string tick_label(double value) {
  std::string text = fmt::format("{:.6g}", value == 0.0 ? 0.0 : value);
  return text.starts_with('-') ? "−" + text.substr(1) : text;
}

std::string grid(const Scales& scales) {
  std::string lines, labels;
  for (const double value : ticks(scales.across.low, scales.across.high)) {
    const double x = scales.across.place(value);
    lines += fmt::format("M{:.1f} {}V{}", x, top, bottom);
    labels += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x, bottom + 20.0,
                          tick_label(value));
  }
  for (const double value : ticks(scales.up.low, scales.up.high)) {
    const double y = scales.up.place(value);
    lines += fmt::format("M{} {:.1f}H{}", left, y, right);
    labels += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", left - 8.0, y + 4.5,
                          tick_label(value));
  }
  return fmt::format("<path class=\"grid\" d=\"{}\"/>{}", lines, labels);
}

// A step to `to` as a cubic of Bézier.
std::string cubic_data(const Vec2& from, const CubicStep& step, const Vec2& to, const Scales& scales) {
  const Vec2 first = scales.place(from + step.begin / 3.0), second = scales.place(to - step.end / 3.0);
  return fmt::format("C{:.1f} {:.1f} {:.1f} {:.1f} ", first.x(), first.y(), second.x(), second.y());
}

// Steps that cannot be seen are left out.
std::string line_data(const ChartLine& line, const Scales& scales) {
  constexpr double least_step = 0.3;
  const std::vector<Vec2>& points = line.points;
  std::string data;
  bool goes_on = false;
  std::size_t drawn = 0;  // the last point
  Vec2 last = Vec2::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      goes_on = false;
      continue;
    }
    const Vec2 place = scales.place(points[i]);
    const bool at_end = i + 1 == points.size();
    if (goes_on && !at_end && (place - last).norm() < least_step) continue;
    const bool is_cubic = goes_on && drawn + 1 == i && drawn < line.steps.size() && line.steps[drawn];
    data += is_cubic ? cubic_data(points[drawn], *line.steps[drawn], points[i], scales) : goes_on ? "L" : "M";
    data += fmt::format("{:.1f} {:.1f}", place.x(), place.y());
    last = place;
    drawn = i;
    goes_on = true;
  }
  return data;
}

// The head of an arrow that ends at `tip`; empty if its direction is not defined.
std::string head_of_arrow(const Vec2& tail, const Vec2& tip) {
  constexpr double length = 9.0, half_width = 4.5;
  const Vec2 along = (tip - tail).normalized(), across(-along.y(), along.x());
  if (!along.allFinite() || along.isZero(0.0)) return "";
  const Vec2 left_corner = tip - length * along + half_width * across;
  const Vec2 right_corner = tip - length * along - half_width * across;
  return fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}", left_corner.x(), left_corner.y(), tip.x(), tip.y(),
                     right_corner.x(), right_corner.y());
}

std::string mark_outline(const EventMark& mark, const Vec2& place, double radius) {
  std::string data;
  for (const Vec2& corner : mark.outline)
    data += fmt::format("{}{:.1f} {:.1f}", data.empty() ? "M" : "L", place.x() + radius * mark.size * corner.x(),
                        place.y() - radius * mark.size * corner.y());
  return fmt::format("class=\"{}\" d=\"{}Z\"", mark.filled ? "mark" : "open mark", data);
}

std::string marks(const Chart& chart, const Scales& scales) {
  std::string text;
  std::vector<ChartMark> by_size = chart.marks;  // a small mark stands on a large one
  std::stable_sort(by_size.begin(), by_size.end(),
                   [](const ChartMark& a, const ChartMark& b) { return mark_of(a.kind).size > mark_of(b.kind).size; });
  for (const ChartMark& mark : by_size) {
    if (!mark.at.allFinite()) continue;
    text += fmt::format("<path {} data-point=\"{}\"><title>{}</title></path>",
                        mark_outline(mark_of(mark.kind), scales.place(mark.at), mark_radius), mark.point,
                        escaped(mark.text));
  }
  return text;
}

}  // namespace

std::vector<double> ticks(double low, double high) {
  const double rough = (high - low) / 6.0;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double part = rough / decade;
  const double step = decade * (part < 1.5 ? 1.0 : part < 3.5 ? 2.0 : part < 7.5 ? 5.0 : 10.0);
  std::vector<double> result;
  // Where the digits do not tell the multiples apart there are none.
  const double first = std::ceil(low / step);
  if (!(first + 1.0 > first && first - 1.0 < first)) return result;
  for (double k = first; k * step <= high; k += 1.0) result.push_back(k * step);
  return result;
}

std::string svg_chart(const Chart& chart) {
  const Scales scales{.across = scale_of(chart, 0, left, right), .up = scale_of(chart, 1, bottom, top)};
  std::string lines;
  for (const ChartLine& line : chart.lines)
    lines += fmt::format(
        "<path class=\"line\" stroke=\"{}\"{} d=\"{}\"/>", line.colour, dashes(line.stability),
        line_data(line, scales) +
            (line.is_arrow ? head_of_arrow(scales.place(line.points.front()), scales.place(line.points.back())) : ""));
  return fmt::format(
      "<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" data-across=\"{}\" data-up=\"{}\">{}"
      "<text class=\"axis\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>"
      "<text class=\"axis\" transform=\"translate(18 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>{}{}</svg>",
      width, height, escaped(chart.name), range_text(scales.across), range_text(scales.up), grid(scales),
      0.5 * (left + right), bottom + 46.0, escaped(chart.across), 0.5 * (top + bottom), escaped(chart.up), lines,
      marks(chart, scales));
}

// The rules of page.css for charts, for this element alone: the page around it has others.
std::string framed_chart(const Chart& chart, const std::string& below) {
  constexpr std::string_view style =
      "<style>.arcwall{max-width:720px;background:#fff;color:#1c1f23}.arcwall svg{display:block}"
      ".arcwall svg.chart text{font:13px sans-serif;fill:#5b6470}.arcwall svg.chart "
      "text.axis{fill:#1c1f23;font-size:14px}"
      ".arcwall .grid{stroke:#e8eaed;fill:none}.arcwall .line{fill:none;stroke-width:2.2;stroke-linejoin:round}"
      ".arcwall .mark{fill:#1c1f23;stroke:#1c1f23;stroke-width:1.4}.arcwall .open.mark{fill:#fff}"
      ".arcwall .legend{list-style:none;margin:6px 0 0;padding:0;display:flex;flex-wrap:wrap;gap:3px "
      "18px;font-size:13px}"
      ".arcwall .legend li{display:flex;align-items:center;gap:6px}.arcwall .key{width:16px;height:16px}"
      ".arcwall .key.wide{width:40px}</style>";
  return fmt::format("<div class=\"arcwall\">{}{}{}</div>", style, svg_chart(chart), below);
}

std::string svg_mark(EventKind kind) {
  return fmt::format("<svg class=\"key\" viewBox=\"0 0 16 16\" aria-hidden=\"true\"><path {}/></svg>",
                     mark_outline(mark_of(kind), {8.0, 8.0}, mark_of(kind).size > 1.0 ? 4.0 : mark_radius));
}

std::string svg_line(const std::string& colour, Stability stability) {
  return fmt::format(
      "<svg class=\"key wide\" viewBox=\"0 0 40 16\" aria-hidden=\"true\"><path class=\"line\" stroke=\"{}\"{} "
      "d=\"M1 8H39\"/></svg>",
      colour, dashes(stability));
}

std::string svg_arrow(const std::string& colour) {
  return fmt::format(
      "<svg class=\"key wide\" viewBox=\"0 0 40 16\" aria-hidden=\"true\"><path class=\"line\" stroke=\"{}\" "
      "d=\"M1 8H39{}\"/></svg>",
      colour, head_of_arrow({1.0, 8.0}, {39.0, 8.0}));
}

}  // namespace arcwall
