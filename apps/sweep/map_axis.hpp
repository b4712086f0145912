#pragma once

#include <string>
#include <vector>

#include "apps/sweep/design.hpp"

namespace arcwall::sweep {

/// A mark on an axis.
struct Tick {
  double at = 0.0;  ///< 0 … 1 along the axis
  std::string text{};
};

/// How numbers are drawn: by their size, or by its logarithm where they are positive and span a decade or more.
enum class AxisScale { linear, by_extent };

/// The values of a key, or loads, along one side of a map; what is no number stands one beside the other, in the order
/// of first appearance.
class MapAxis {
 public:
  /// At least one value.
  MapAxis(const std::vector<Json>& values, AxisScale scale);

  /// Along the axis, 0 … 1; the value is one of those it was made with.
  double place(const Json& value) const;

  /// Whether the values are numbers.
  bool has_numbers() const { return numbers_; }

  /// The values, each once, in the order of their places.
  const std::vector<Json>& distinct() const { return distinct_; }

  /// The values themselves where they are few and the scale is that of a key, else round numbers.
  std::vector<Tick> ticks() const;

 private:
  double scaled(double value) const;
  std::vector<Tick> round_ticks() const;

  std::vector<Json> distinct_;
  AxisScale scale_;
  bool numbers_ = false;
  bool logarithmic_ = false;
  double low_ = 0.0, high_ = 1.0;  // scaled
};

/// A number for people: at most six digits.
std::string short_number(double value);

}  // namespace arcwall::sweep
