#include "apps/sweep/plot_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/markup.hpp"

namespace arcwall::sweep {

namespace {

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

}  // namespace

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

std::string text(double x, double y, const std::string& anchor, const std::string& content) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x, y, anchor,
                     escaped(plain(content))) +
         "\n";
}

std::string upright(double x, double y, const std::string& content) {
  return fmt::format(R"svg(<g transform="translate({:.0f} {:.1f}) rotate(-90)">)svg", x, y) +
         text(0.0, 0.0, "middle", content) + "</g>\n";
}

std::string frame(const PlotArea& area, const MapAxis& x, const MapAxis& y, const FrameTexts& texts) {
  std::string result;
  for (const Tick& tick : x.ticks()) {
    result += fmt::format(R"(<path d="M{:.1f} {:.1f}v5" stroke="currentColor"/>)", area.x_at(tick.at), area.y_at(0.0));
    if (texts.x_labels) result += text(area.x_at(tick.at), area.y_at(0.0) + 20.0, "middle", tick.text);
  }
  for (const Tick& tick : y.ticks()) {
    result += fmt::format(R"(<path d="M{:.1f} {:.1f}h-5" stroke="currentColor"/>)", area.left, area.y_at(tick.at));
    if (texts.y_labels) result += text(area.left - 9.0, area.y_at(tick.at) + 4.0, "end", tick.text);
  }
  result += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" stroke="currentColor"/>)", area.left, area.top,
                        area.width, area.height) +
            "\n";
  if (!texts.x_title.empty())
    result += text(area.left + area.width / 2.0, area.top + area.height + 48.0, "middle", texts.x_title);
  if (!texts.y_title.empty()) result += upright(area.left - 74.0, area.top + area.height / 2.0, texts.y_title);
  return result;
}

std::string picture(double width, double height, const std::string& name, const std::string& body) {
  return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {:.0f} {:.0f}" role="img" fill="none">)",
                     width, height) +
         "\n<title>" + escaped(plain(name)) + "</title>\n" + body + "</svg>\n";
}

std::string cross(double x, double y) {
  return fmt::format(R"(<path d="M{:.1f} {:.1f}l10 10m0 -10l-10 10" stroke="#d33" stroke-width="2"/>)", x - 5.0,
                     y - 5.0);
}

}  // namespace arcwall::sweep
