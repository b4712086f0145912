#include "core/bordered_residual.hpp"

#include <cmath>

namespace arcwall {

BorderedResidual::BorderedResidual(const Linearization& equations, double sign, const Vector& f,
                                   const Eigen::Ref<const Vector>& dx, double dlambda)
    : equations_(equations), f_(f), dx_(dx), dlambda_(dlambda) {
  const Index n = equations_.K.cols(), m = equations_.B.cols();
  r_ = sign * f_;
  if (dlambda_ != 0.0) r_ -= equations_.F_lambda * dlambda_;
  r_.head(n).noalias() -= equations_.K.selfadjointView<Eigen::Lower>() * dx_.head(n);
  if (m == 0) return;
  r_.head(n).noalias() -= equations_.B * dx_.tail(m);
  r_.tail(m).noalias() -= equations_.C * dx_;
}

// The terms of the diagonal alone are some of them, and often enough.
bool BorderedResidual::is_small() const {
  constexpr double good = 1e-10;  // of f
  const Index n = equations_.K.cols();
  const double size = r_.norm();
  if (size <= good * f_.norm()) return true;
  if (size <= rounding * equations_.K.diagonal().cwiseProduct(dx_.head(n)).norm()) return true;
  return size <= rounding * terms().norm();
}

Vector BorderedResidual::terms() const {
  const SparseMatrix& K = equations_.K;
  const Index n = K.cols(), m = equations_.B.cols();
  Vector terms = f_.cwiseAbs() + equations_.F_lambda.cwiseAbs() * std::abs(dlambda_);
  for (Index column = 0; column < n; ++column)
    for (SparseMatrix::InnerIterator entry(K, column); entry; ++entry) {
      terms[entry.row()] += std::abs(entry.value() * dx_[column]);
      if (entry.row() != column) terms[column] += std::abs(entry.value() * dx_[entry.row()]);
    }
  if (m == 0) return terms;
  terms.head(n) += equations_.B.cwiseAbs() * dx_.tail(m).cwiseAbs();
  terms.tail(m) += equations_.C.cwiseAbs() * dx_.cwiseAbs();
  return terms;
}

}  // namespace arcwall
