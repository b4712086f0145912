#include "core/bordered_residual.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall {

bool BorderedResidual::is_small(const Vector& f) const {
  constexpr double good = 1e-10;  // of f
  return r.norm() <= std::max(good * f.norm(), rounding * terms.norm());
}

BorderedResidual residual_of(const Linearization& equations, const Vector& f, const Direction& solution) {
  const SparseMatrix& K = equations.K;
  const Index n = K.cols(), m = equations.B.cols();
  BorderedResidual out{.r = f - equations.F_lambda * solution.dlambda,
                       .terms = f.cwiseAbs() + equations.F_lambda.cwiseAbs() * std::abs(solution.dlambda)};
  const Vector& x = solution.dx;
  const auto take = [&](Index row, double term) {
    out.r[row] -= term;
    out.terms[row] += std::abs(term);
  };
  for (Index column = 0; column < n; ++column)
    for (SparseMatrix::InnerIterator entry(K, column); entry; ++entry) {
      take(entry.row(), entry.value() * x[column]);
      if (entry.row() != column) take(column, entry.value() * x[entry.row()]);
    }
  if (m == 0) return out;
  out.r.head(n) -= equations.B * x.tail(m);
  out.terms.head(n) += equations.B.cwiseAbs() * x.tail(m).cwiseAbs();
  out.r.tail(m) -= equations.C * x;
  out.terms.tail(m) += equations.C.cwiseAbs() * x.cwiseAbs();
  return out;
}

}  // namespace arcwall
