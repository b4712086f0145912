#include "core/algebra/solvers/symmetric_factors.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall {

bool Pivots::add(double pivot) {
  const double magnitude = std::abs(pivot);
  (pivot < 0.0 ? signs.negative : signs.positive) += 1;
  least = std::min(least, magnitude);
  greatest = std::max(greatest, magnitude);
  return magnitude > 0.0 && magnitude < infinity;
}

void Pivots::add(const Pivots& others) {
  signs.negative += others.signs.negative;
  signs.positive += others.signs.positive;
  least = std::min(least, others.least);
  greatest = std::max(greatest, others.greatest);
}

}  // namespace arcwall
