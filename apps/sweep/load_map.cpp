#include "apps/sweep/load_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "apps/output/markup.hpp"
#include "apps/sweep/case_list.hpp"
#include "apps/sweep/map_axis.hpp"

namespace arcwall::sweep {

namespace {

// Pixels. The plot's corner is at (left, top).
constexpr double left = 90.0, top = 16.0, plot_width = 520.0, plot_height = 380.0;
constexpr double bar_left = left + plot_width + 30.0, bar_width = 16.0;
constexpr double width = bar_left + bar_width + 90.0, height = top + plot_height + 60.0;

using Colour = std::array<double, 3>;  // 0 … 255

// Viridis, by Nathaniel Smith and Stéfan van der Walt (public domain), at nine places.
constexpr std::array<Colour, 9> viridis{{{68, 1, 84},
                                         {72, 40, 120},
                                         {62, 74, 137},
                                         {49, 104, 142},
                                         {38, 130, 142},
                                         {31, 158, 137},
                                         {53, 183, 121},
                                         {109, 205, 89},
                                         {253, 231, 37}}};

Colour colour_at(double fraction) {
  const double at = std::clamp(fraction, 0.0, 1.0) * (viridis.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  Colour mixed{};
  for (std::size_t k = 0; k < 3; ++k)
    mixed[k] = viridis[i][k] + (at - static_cast<double>(i)) * (viridis[i + 1][k] - viridis[i][k]);
  return mixed;
}

std::string text_of(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", static_cast<int>(std::lround(colour[0])),
                     static_cast<int>(std::lround(colour[1])), static_cast<int>(std::lround(colour[2])));
}

bool is_light(const Colour& colour) { return 0.3 * colour[0] + 0.6 * colour[1] + 0.1 * colour[2] > 128.0; }

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

std::string text(double x, double y, const std::string& anchor, const std::string& content) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x, y, anchor,
                     escaped(plain(content))) +
         "\n";
}

std::string tip(const LoadMap& map, const MapPoint& point) {
  std::string content = fmt::format("case {}\n{} = {}", point.number, map.x_title, label(point.x));
  if (!map.y_title.empty()) content += fmt::format("\n{} = {}", map.y_title, label(point.y));
  content += "\n" + (point.load ? map.load_title + " " + short_number(*point.load) : "no such event");
  return "<title>" + escaped(plain(content) + (point.failed ? "\nfailed" : "")) + "</title>";
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
        y_(map.y_title.empty() ? MapAxis(loads(map), AxisScale::linear)
                               : MapAxis(values(map, &MapPoint::y), AxisScale::by_extent)),
        loads_(range_of(loads(map))) {}

  std::string svg() const {
    std::string body = frame();
    if (map_.y_title.empty()) {
      for (const MapPoint& point : map_.points) body += mark(point, point.load ? Json(*point.load) : Json());
    } else {
      const bool cells = is_grid();
      for (const MapPoint& point : map_.points) body += cells ? cell(point) : mark(point, point.y);
      body += colour_bar();
    }
    return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {:.0f} {:.0f}" role="img" fill="none">)",
                       width, height) +
           "\n<title>" + escaped(plain(map_.load_title)) + "</title>\n" + body + "</svg>\n";
  }

 private:
  double x_at(double fraction) const { return left + fraction * plot_width; }
  double y_at(double fraction) const { return top + (1.0 - fraction) * plot_height; }

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

  std::string frame() const {
    std::string result;
    for (const Tick& tick : x_.ticks())
      result += fmt::format(R"(<path d="M{0:.1f} {1:.1f}v5" stroke="currentColor"/>)", x_at(tick.at), y_at(0.0)) +
                text(x_at(tick.at), y_at(0.0) + 20.0, "middle", tick.text);
    for (const Tick& tick : y_.ticks())
      result += fmt::format(R"(<path d="M{:.1f} {:.1f}h-5" stroke="currentColor"/>)", left, y_at(tick.at)) +
                text(left - 9.0, y_at(tick.at) + 4.0, "end", tick.text);
    result += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" stroke="currentColor"/>)", left, top,
                          plot_width, plot_height) +
              "\n" + text(left + plot_width / 2.0, height - 12.0, "middle", map_.x_title);
    return result + upright(16.0, map_.y_title.empty() ? load_axis() : map_.y_title);
  }

  std::string load_axis() const {
    return map_.load_title + (map_.load_unit.empty() ? "" : ", times " + map_.load_unit);
  }

  static std::string upright(double x, const std::string& title) {
    return fmt::format(R"svg(<g transform="translate({:.0f} {:.1f}) rotate(-90)">)svg", x, top + plot_height / 2.0) +
           text(0.0, 0.0, "middle", title) + "</g>\n";
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
    const double cell_width = x_at(across.high) - x_at(across.low), cell_height = y_at(up.low) - y_at(up.high);
    const double x = x_at(across.low), y = y_at(up.high), middle = x + cell_width / 2.0, centre = y + cell_height / 2.0;
    std::string result = "<g>" + tip(map_, point);
    result += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}" stroke="#8884"/>)", x,
                          y, cell_width, cell_height, point.load ? text_of(colour(*point.load)) : "#8882");
    if (point.failed) result += cross(middle, centre);
    if (point.load && !point.failed && cell_width > 46.0 && cell_height > 16.0)
      result += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle" fill="{}">{:.4g}</text>)", middle,
                            centre + 4.0, is_light(colour(*point.load)) ? "#000" : "#fff", *point.load);
    return result + "</g>\n";
  }

  // A case at its place; where a load is drawn over one key and there is none, on the lower edge.
  std::string mark(const MapPoint& point, const Json& y) const {
    const double x = x_at(x_.place(point.x)), z = y.is_null() ? y_at(0.0) : y_at(y_.place(y));
    std::string result = "<g>" + tip(map_, point);
    result +=
        fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="5" fill="{}" stroke="currentColor" stroke-width="0.5"/>)", x,
                    z, point.load ? text_of(colour(*point.load)) : "#8882");
    if (point.failed) result += cross(x, z);
    return result + "</g>\n";
  }

  static std::string cross(double x, double y) {
    return fmt::format(R"(<path d="M{:.1f} {:.1f}l10 10m0 -10l-10 10" stroke="#d33" stroke-width="2"/>)", x - 5.0,
                       y - 5.0);
  }

  std::string colour_bar() const {
    constexpr int steps = 40;
    std::string result;
    for (int i = 0; i < steps; ++i)
      result += fmt::format(R"(<rect x="{}" y="{:.2f}" width="{}" height="{:.2f}" fill="{}"/>)", bar_left,
                            y_at((i + 1.0) / steps), bar_width, plot_height / steps + 0.5,
                            text_of(colour_at((i + 0.5) / steps)));
    for (const double fraction : {0.0, 0.25, 0.5, 0.75, 1.0})
      result += text(bar_left + bar_width + 6.0, y_at(fraction) + 4.0, "start",
                     short_number(loads_.low + fraction * (loads_.high - loads_.low)));
    return result + upright(width - 8.0, load_axis());
  }

  const LoadMap& map_;
  MapAxis x_, y_;
  Extent loads_;
};

}  // namespace

std::string svg(const LoadMap& map) { return Drawing(map).svg(); }

}  // namespace arcwall::sweep
