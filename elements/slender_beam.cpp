#include "elements/slender_beam.hpp"

#include <cmath>
#include <limits>

namespace arcwall {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

}  // namespace

// A point at the fraction f of the length, ∫ v ds from S₁ = f ∫ v ds from S₁ to S₂, moves with the ends at the rates
//
//   ∂s/∂S₁ = (1 − f) v₁/v,     ∂s/∂S₂ = f v₂/v
StretchReference stretch_reference(const ImperfectAxis& shape, double from, double to, DividedPart::Inside inside) {
  static_assert(StretchReference::samples == DividedPart::points);
  const DividedPart part = shape.divided(from, to, inside);
  const DeviatedPoint &first = part.at.front(), &last = part.at.back();
  StretchReference stretch{.length = part.length, .chord = part.chord, .ends = {from, to}};
  for (std::size_t k = 0; k < part.at.size(); ++k) {
    const bool end = k == 0 || k + 1 == part.at.size();
    if (!end && inside == DividedPart::Inside::left_out) {
      stretch.angles[k] = stretch.angle_rate[0][k] = stretch.angle_rate[1][k] = not_known;
      continue;
    }
    const double fraction = double(k) / double(part.at.size() - 1);
    const DeviatedPoint& point = part.at[k];
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
