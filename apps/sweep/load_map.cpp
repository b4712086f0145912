#include "apps/sweep/load_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/output/svg_chart.hpp"
#include "apps/sweep/contour.hpp"
#include "apps/sweep/map_axis.hpp"
#include "apps/sweep/plot_frame.hpp"

namespace arcwall::sweep {

namespace {

constexpr double bar_width = 16.0;

std::vector<Json> values(const LoadMap& map, Json MapPoint::*which) {
  std::vector<Json> result;
  for (const MapPoint& point : map.points) result.push_back(point.*which);
  return result;
}

// Of the loads that there are; {0} if there is none.
std::vector<Json> loads(const LoadMap& map) {
  std::vector<Json> result;
  for (const MapPoint& point : map.points)
    if (point.load) result.emplace_back(*point.load);
  return result.empty() ? std::vector<Json>{0.0} : result;
}

struct Extent {
  double low = 0.0, high = 0.0;
};

Extent range_of(const std::vector<Json>& numbers) {
  Extent range{.low = numbers.front().get<double>(), .high = numbers.front().get<double>()};
  for (const Json& number : numbers) {
    range.low = std::min(range.low, number.get<double>());
    range.high = std::max(range.high, number.get<double>());
  }
  return range;
}

class Drawing {
 public:
  explicit Drawing(const LoadMap& map)
      : map_(map),
        x_(values(map, &MapPoint::x), AxisScale::by_extent),
        y_(map.titles.y.empty() ? MapAxis(loads(map), AxisScale::linear)
                                : MapAxis(values(map, &MapPoint::y), AxisScale::by_extent)),
        loads_(range_of(loads(map))) {}

  std::string svg() const {
    const bool over_one_key = map_.titles.y.empty();
    std::string body = frame(
        area_, x_, y_, {.x_title = map_.titles.x, .y_title = over_one_key ? load_axis(map_.titles) : map_.titles.y});
    const bool cells = !over_one_key && is_grid();
    for (const MapPoint& point : map_.points)
      body += cells          ? cell(point)
              : over_one_key ? mark(point, point.load ? Json(*point.load) : Json())
                             : mark(point, point.y);
    if (cells) body += contours();
    if (!over_one_key) body += colour_bar();
    return picture(bar_left() + bar_width + 90.0, area_.top + area_.height + 60.0, map_.titles.load, body);
  }

 private:
  double bar_left() const { return area_.left + area_.width + 30.0; }

  // Every combination of the values once, and few enough to be seen.
  bool is_grid() const {
    constexpr std::size_t most_cells = 80;
    const std::size_t nx = x_.distinct().size(), ny = y_.distinct().size();
    if (nx > most_cells || ny > most_cells || nx * ny != map_.points.size()) return false;
    std::set<std::pair<double, double>> places;
    for (const MapPoint& point : map_.points) places.emplace(x_.place(point.x), y_.place(point.y));
    return places.size() == map_.points.size();
  }

  Colour colour(double load) const {
    return colour_at(loads_.high > loads_.low ? (load - loads_.low) / (loads_.high - loads_.low) : 0.5);
  }

  // From half way to the neighbour before to half way to the one behind.
  static Extent extent(const MapAxis& axis, const Json& value) {
    const std::vector<Json>& all = axis.distinct();
    const auto here = std::find(all.begin(), all.end(), value);
    const double at = axis.place(value);
    return {.low = here == all.begin() ? 0.0 : 0.5 * (at + axis.place(*(here - 1))),
            .high = here + 1 == all.end() ? 1.0 : 0.5 * (at + axis.place(*(here + 1)))};
  }

  std::string cell(const MapPoint& point) const {
    const Extent across = extent(x_, point.x), up = extent(y_, point.y);
    const double cell_width = area_.x_at(across.high) - area_.x_at(across.low),
                 cell_height = area_.y_at(up.low) - area_.y_at(up.high);
    const double x = area_.x_at(across.low), y = area_.y_at(up.high), middle = x + cell_width / 2.0,
                 centre = y + cell_height / 2.0;
    std::string drawn =
        fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}" stroke="#8884"/>)", x, y,
                    cell_width, cell_height, point.load ? text_of(colour(*point.load)) : "#8882");
    if (point.failed) drawn += cross(middle, centre);
    if (point.load && !point.failed && cell_width > 46.0 && cell_height > 16.0)
      drawn += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle" fill="{}">{:.4g}</text>)", middle,
                           centre + 4.0, is_light(colour(*point.load)) ? "#000" : "#fff", *point.load);
    return pointed_at(tip(map_.titles, point), point.link, drawn);
  }

  // Lines of equal load at round values, named on the bar of colours by the same ticks.
  std::string contours() const {
    constexpr std::size_t least = 4;
    const std::vector<Json>&xs = x_.distinct(), &ys = y_.distinct();
    if (!x_.has_numbers() || !y_.has_numbers() || xs.size() < least || ys.size() < least) return "";
    GridValues grid{.values = std::vector<std::optional<double>>(xs.size() * ys.size())};
    for (const Json& x : xs) grid.x.push_back(x_.place(x));
    for (const Json& y : ys) grid.y.push_back(y_.place(y));
    for (const MapPoint& point : map_.points) {
      const auto i = std::find(xs.begin(), xs.end(), point.x) - xs.begin();
      const auto j = std::find(ys.begin(), ys.end(), point.y) - ys.begin();
      if (!point.failed)
        grid.values[static_cast<std::size_t>(i) * ys.size() + static_cast<std::size_t>(j)] = point.load;
    }
    std::string ways;
    for (const double level : levels())
      for (const ContourPart& part : contour(grid, level))
        ways += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", area_.x_at(part.from.x()), area_.y_at(part.from.y()),
                            area_.x_at(part.to.x()), area_.y_at(part.to.y()));
    if (ways.empty()) return "";
    return "<path class=\"contour\" d=\"" + ways +
           "\" stroke=\"#000a\" stroke-width=\"1.2\" pointer-events=\"none\"/>\n";
  }

  std::vector<double> levels() const {
    return loads_.high > loads_.low ? arcwall::ticks(loads_.low, loads_.high) : std::vector<double>{};
  }

  // A case at its place; where a load is drawn over one key and there is none, on the lower edge.
  std::string mark(const MapPoint& point, const Json& y) const {
    const double x = area_.x_at(x_.place(point.x)), z = y.is_null() ? area_.y_at(0.0) : area_.y_at(y_.place(y));
    std::string drawn =
        fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="5" fill="{}" stroke="currentColor" stroke-width="0.5"/>)", x,
                    z, point.load ? text_of(colour(*point.load)) : "#8882");
    if (point.failed) drawn += cross(x, z);
    return pointed_at(tip(map_.titles, point), point.link, drawn);
  }

  std::string colour_bar() const {
    constexpr int steps = 40;
    std::string result;
    for (int i = 0; i < steps; ++i)
      result += fmt::format(R"(<rect x="{}" y="{:.2f}" width="{}" height="{:.2f}" fill="{}"/>)", bar_left(),
                            area_.y_at((i + 1.0) / steps), bar_width, area_.height / steps + 0.5,
                            text_of(colour_at((i + 0.5) / steps)));
    const double range = loads_.high - loads_.low;
    if (range <= 0.0)
      return result + text(bar_left() + bar_width + 6.0, area_.y_at(0.5) + 4.0, "start", short_number(loads_.low));
    for (const double level : levels()) {
      const double y = area_.y_at((level - loads_.low) / range);
      result += fmt::format(R"(<path d="M{:.1f} {:.1f}h{:.1f}" stroke="#000a"/>)", bar_left(), y, bar_width) +
                text(bar_left() + bar_width + 6.0, y + 4.0, "start", short_number(level));
    }
    return result + upright(bar_left() + bar_width + 82.0, area_.top + area_.height / 2.0, load_axis(map_.titles));
  }

  const LoadMap& map_;
  MapAxis x_, y_;
  Extent loads_;
  PlotArea area_{};
};

}  // namespace

std::string svg(const LoadMap& map) { return Drawing(map).svg(); }

}  // namespace arcwall::sweep
