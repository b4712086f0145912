// Compiled without fused operations: the sums here know the round-off of each.
#include "core/algebra/quadratic_form.hpp"

#include <limits>

namespace arcwall {

// Sums of products with twice the digits (Ogita, Rump and Oishi 2005): each product and each sum is known with its
// rounding error, and the errors are summed besides.
QuadraticForm quadratic_form(const SparseMatrix& K, const Eigen::Ref<const Vector>& v) {
  double high = 0.0, low = 0.0, magnitude = 0.0;
  for (Index column = 0; column < K.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(K, column); entry; ++entry) {
      const double k = entry.value(), at_row = v[entry.row()];
      const double at_column = entry.row() == column ? v[column] : 2.0 * v[column];  // K's other triangle, too
      const double product = k * at_row, product_error = std::fma(k, at_row, -product);
      const double term = product * at_column, term_error = std::fma(product, at_column, -term);
      const double sum = high + term, part = sum - high;
      low += ((high - (sum - part)) + (term - part)) + (term_error + product_error * at_column);
      high = sum;
      magnitude += std::abs(term);
    }
  return {.value = high + low, .roundoff = std::numeric_limits<double>::epsilon() * magnitude};
}

}  // namespace arcwall
