#include "elements/slender_beam.hpp"

#include <cmath>

namespace arcwall {

// A point at S₁ + f (S₂ − S₁) moves with S₁ at the rate 1 − f and with S₂ at the rate f.
StretchReference stretch_reference(const ImperfectAxis& shape, double from, double to) {
  StretchReference stretch{.length = shape.length(from, to), .chord = shape.chord(from, to)};
  for (int k = 0; k < StretchReference::samples; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double fraction = double(k) / (StretchReference::samples - 1);
    const DeviatedPoint point = shape.along(from + fraction * (to - from));
    stretch.angles[i] = point.angle;
    stretch.angle_rate[0][i] = (1.0 - fraction) * point.turning;
    stretch.angle_rate[1][i] = fraction * point.turning;
    const bool first = k == 0, last = k == StretchReference::samples - 1;
    if (!first && !last) continue;
    const double rate = first ? -point.speed : point.speed;
    stretch.length_rate[first ? 0 : 1] = rate;
    stretch.chord_rate[first ? 0 : 1] = rate * Vec2(std::cos(point.angle), std::sin(point.angle));
  }
  return stretch;
}

}  // namespace arcwall
