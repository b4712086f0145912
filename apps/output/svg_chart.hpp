#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/path_cubics.hpp"
#include "continuation/path_point.hpp"
#include "core/types.hpp"

namespace arcwall {

/// A curve of a chart. Points that are not finite interrupt it.
struct ChartLine {
  std::vector<Vec2> points{};
  std::vector<std::optional<CubicStep>> steps{};  ///< one fewer than points, or none: the line is straight without
  std::string colour{};
  Stability stability = Stability::stable;  ///< drawn through, dashed or dotted
  bool is_arrow = false;                    ///< from the first point to the last
};

/// An event of a chart.
struct ChartMark {
  Vec2 at = Vec2::Zero();
  EventKind kind = EventKind::start;
  std::string text{};     ///< shown when pointed at
  std::size_t point = 0;  ///< which point of the record it is, for scripts
};

struct Chart {
  std::string name{};  ///< for those who cannot see it
  std::string across{}, up{};
  std::vector<ChartLine> lines{};
  std::vector<ChartMark> marks{};
};

/// Round numbers that divide an interval into four to ten parts; none where its ends differ by round-off alone.
std::vector<double> ticks(double low, double high);

/// The chart as an <svg> element. Its attributes data-across and data-up give the ranges of the values and of their
/// places in the picture: `low high low-place high-place`.
std::string svg_chart(const Chart& chart);

/// The chart with rules of style of its own, and `below` it, as a <div> element of class `arcwall` for pages that have
/// none.
std::string framed_chart(const Chart& chart, const std::string& below = {});

/// The mark of a kind of events alone, as a small <svg> element, for legends.
std::string svg_mark(EventKind kind);

/// A short line as the stability has it, as a small <svg> element, for legends.
std::string svg_line(const std::string& colour, Stability stability);

/// A short arrow, as a small <svg> element, for legends.
std::string svg_arrow(const std::string& colour);

}  // namespace arcwall
