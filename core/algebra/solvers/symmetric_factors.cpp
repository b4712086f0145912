#include "core/algebra/solvers/symmetric_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

double SymmetricFactors::growth(const SparseMatrix& A) const { return pivots_.greatest / A.coeffs().abs().maxCoeff(); }

double SymmetricFactors::roundoff(const Eigen::Ref<const Vector>& v) const {
  return std::numeric_limits<double>::epsilon() * weighted(v);
}

bool SymmetricFactors::is_finite(const SparseMatrix& A) { return all_finite(A.coeffs()); }

}  // namespace arcwall
