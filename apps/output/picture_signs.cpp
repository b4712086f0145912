#include "apps/output/picture_signs.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace arcwall {

namespace {

constexpr double longer_side = longer_side_of_pictures;
// Parts of the longer side. What is drawn outwards from the structure stays in the margin.
constexpr double arrow_head = 0.018;
constexpr double support_size = 0.02;
constexpr double spring_length = 0.05, spring_width = 0.012;
constexpr double moment_radius = 0.035;

// A line that goes to and fro.
std::string zigzag_data(const Vec2& from, const Vec2& to) {
  const Vec2 way = to - from;
  if (way.norm() < 1.0) return "";
  const Vec2 across = spring_width * longer_side * perp(way.normalized());
  std::vector<Vec2> places{from};
  constexpr int turns = 6;
  for (int i = 0; i <= turns; ++i) {
    const double side = i == 0 || i == turns ? 0.0 : i % 2 == 0 ? -0.5 : 0.5;
    places.push_back((from + (0.2 + 0.6 * i / turns) * way + side * across).array().round());
  }
  places.push_back(to);
  return path_data(places);
}

}  // namespace

std::string path_data(const std::vector<Vec2>& places) {
  std::string data;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec2 way = i == 0 ? places[0] : Vec2(places[i] - places[i - 1]);
    const bool apart = i > 1 && way.x() >= 0.0;
    data += i == 0 ? "M" : i == 1 ? "l" : apart ? " " : "";
    fmt::format_to(std::back_inserter(data), FMT_COMPILE("{}{}{}"), std::lround(way.x()), way.y() < 0.0 ? "" : " ",
                   std::lround(way.y()));
  }
  return data;
}

std::string arrow_data(const Vec2& from, const Vec2& way) {
  const double length = way.norm();
  if (length < 1.0) return "";
  const Vec2 along = way / length, tip = from + way;
  const double head = std::min(arrow_head * longer_side, length);
  const Vec2 across = 0.4 * head * perp(along), neck = tip - head * along;
  const Vec2 one = neck + across, other = neck - across;
  return fmt::format("M{:.0f} {:.0f}L{:.0f} {:.0f}M{:.0f} {:.0f}L{:.0f} {:.0f}L{:.0f} {:.0f}Z", from.x(), from.y(),
                     neck.x(), neck.y(), one.x(), one.y(), tip.x(), tip.y(), other.x(), other.y());
}

std::string moment_data(const Vec2& at, double part) {
  if (!(std::abs(part) > 0.0) || !std::isfinite(part)) return "";
  const double radius = moment_radius * longer_side, angle = 1.5 * pi * part;
  const Vec2 outwards(std::cos(angle), -std::sin(angle));
  const Vec2 end = at + radius * outwards;
  const Vec2 along = (part > 0.0 ? -1.0 : 1.0) * perp(outwards);
  const double head = arrow_head * longer_side;
  const auto arc = [&](bool clockwise, const Vec2& to) {
    return fmt::format("A{:.0f} {:.0f} 0 {} {} {:.0f} {:.0f}", radius, radius, std::abs(angle) > pi ? 1 : 0,
                       clockwise ? 1 : 0, to.x(), to.y());
  };
  const Vec2 begin = at + Vec2(radius, 0.0);  // there and back, or the arc would be filled
  return fmt::format("M{:.0f} {:.0f}", begin.x(), begin.y()) + arc(part < 0.0, end) + arc(part > 0.0, begin) +
         arrow_data(end - 0.5 * head * along, head * along);
}

std::string support_data(const Vec2& at, const HeldPoint& held) {
  const double size = support_size * longer_side;
  if (held.rotation)
    return fmt::format("M{:.0f} {:.0f}h{:.0f}v{:.0f}h{:.0f}z", at.x() - 0.5 * size, at.y() - 0.5 * size, size, size,
                       -size);
  const bool upright = held.z;  // else it lies on its side
  const auto place = [&](double across, double away) {
    return upright ? Vec2(at.x() + across * size, at.y() + away * size)
                   : Vec2(at.x() - away * size, at.y() + across * size);
  };
  const Vec2 one = place(-0.6, 1.0), other = place(0.6, 1.0);
  std::string data = fmt::format("M{:.0f} {:.0f}L{:.0f} {:.0f}L{:.0f} {:.0f}Z", at.x(), at.y(), one.x(), one.y(),
                                 other.x(), other.y());
  if (held.x && held.z) return data;
  const Vec2 first = place(-0.8, 1.35), last = place(0.8, 1.35);
  return data + fmt::format("M{:.0f} {:.0f}L{:.0f} {:.0f}", first.x(), first.y(), last.x(), last.y());
}

std::string spring_data(const Vec2& at, const std::optional<Vec2>& to, const DrawnSpring& spring) {
  std::string data;
  if (to && (spring.x || spring.z)) data += zigzag_data(at, *to);
  const double length = spring_length * longer_side;
  if (!to && spring.x) data += zigzag_data(at, at - Vec2(length, 0.0));
  if (!to && spring.z) data += zigzag_data(at, at + Vec2(0.0, length));
  if (!spring.rotation) return data;
  const double radius = spring_width * longer_side;
  return data + fmt::format("M{0:.0f} {1:.0f}a{2:.0f} {2:.0f} 0 1 0 {3:.0f} 0a{2:.0f} {2:.0f} 0 1 0 -{3:.0f} 0",
                            at.x() - radius, at.y(), radius, 2.0 * radius);
}

}  // namespace arcwall
