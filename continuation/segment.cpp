#include "continuation/segment.hpp"

#include <algorithm>
#include <cmath>

#include "core/root_find.hpp"

namespace arcwall {

State Segment::at(double t) const {
  const double h01 = t * t * (3.0 - 2.0 * t), h10 = t * (1.0 - t) * (1.0 - t) * length_,
               h11 = t * t * (t - 1.0) * length_;
  const State &a = from_.state, &b = to_.state;
  const Direction &u = from_.tangent, &v = to_.tangent;
  return {.x = a.x + h01 * (b.x - a.x) + (h10 * u.dx + h11 * v.dx),
          .lambda = a.lambda + h01 * (b.lambda - a.lambda) + (h10 * u.dlambda + h11 * v.dlambda),
          .active_set = a.active_set};
}

bool Segment::follows_the_path() const {
  constexpr double follows = 0.99;
  return length_ == 0.0 || std::min(cosine(from_.tangent), cosine(to_.tangent)) >= follows;
}

std::optional<double> Segment::first_zero(double v0, double rate0, double v1, double rate1, double noise) const {
  return first_cubic_zero(std::abs(v0) <= noise ? 0.0 : v0, rate0 * length_, v1, rate1 * length_);
}

}  // namespace arcwall
