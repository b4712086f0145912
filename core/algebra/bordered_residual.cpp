#include "core/algebra/bordered_residual.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall {

// r and the sums of the terms' magnitudes, in one pass over K.
BorderedResidual::BorderedResidual(const Linearization& equations, double sign, const Vector& f,
                                   const Eigen::Ref<const Vector>& dx, double dlambda) {
  constexpr double good = 1e-10;  // of f
  const SparseMatrix& K = equations.K;
  const Index n = K.cols(), m = equations.B.cols();
  r_ = sign * f;
  Vector terms = f.cwiseAbs();
  if (dlambda != 0.0) {
    r_ -= equations.F_lambda * dlambda;
    terms += equations.F_lambda.cwiseAbs() * std::abs(dlambda);
  }
  for (Index column = 0; column < n; ++column) {
    const double x = dx[column];
    double sum = 0.0, magnitudes = 0.0;
    for (SparseMatrix::InnerIterator entry(K, column); entry; ++entry) {
      const double term = entry.value() * dx[entry.row()];
      sum += term;
      magnitudes += std::abs(term);
      if (entry.row() == column) continue;
      const double mirrored = entry.value() * x;
      r_[entry.row()] -= mirrored;
      terms[entry.row()] += std::abs(mirrored);
    }
    r_[column] -= sum;
    terms[column] += magnitudes;
  }
  if (m > 0) {
    r_.head(n).noalias() -= equations.B * dx.tail(m);
    r_.tail(m).noalias() -= equations.C * dx;
    terms.head(n) += equations.B.cwiseAbs() * dx.tail(m).cwiseAbs();
    terms.tail(m) += equations.C.cwiseAbs() * dx.cwiseAbs();
  }
  if (equations.N.nonZeros() > 0) {
    r_.noalias() -= equations.N * dx;
    terms.noalias() += equations.N.cwiseAbs() * dx.cwiseAbs();
  }
  size_ = r_.norm();
  small_ = std::max(good * f.norm(), rounding * terms.norm());
}

}  // namespace arcwall
