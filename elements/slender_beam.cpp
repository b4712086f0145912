#include "elements/slender_beam.hpp"

#include <cmath>

namespace arcwall {

// A point at the fraction f of the length, ∫ v ds from S₁ = f ∫ v ds from S₁ to S₂, moves with the ends at the rates
//
//   ∂s/∂S₁ = (1 − f) v₁/v,     ∂s/∂S₂ = f v₂/v
StretchReference stretch_reference(const ImperfectAxis& shape, double from, double to) {
  constexpr std::size_t samples = StretchReference::samples;
  StretchReference stretch{.length = shape.length(from, to), .chord = shape.chord(from, to)};
  const DeviatedPoint first = shape.along(from), last = shape.along(to);
  for (std::size_t k = 0; k < samples; ++k) {
    const double fraction = double(k) / double(samples - 1);
    const bool inside = k > 0 && k + 1 < samples;
    const DeviatedPoint point =
        inside ? shape.along(shape.coordinate_at(from, fraction * stretch.length, from + fraction * (to - from)))
               : (k == 0 ? first : last);
    stretch.angles[k] = point.angle;
    stretch.angle_rate[0][k] = (1.0 - fraction) * first.speed / point.speed * point.turning;
    stretch.angle_rate[1][k] = fraction * last.speed / point.speed * point.turning;
  }
  stretch.length_rate = {-first.speed, last.speed};
  stretch.chord_rate = {-first.speed * Vec2(std::cos(first.angle), std::sin(first.angle)),
                        last.speed * Vec2(std::cos(last.angle), std::sin(last.angle))};
  return stretch;
}

}  // namespace arcwall
