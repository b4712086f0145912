#include "contact/constraint_force.hpp"

#include <algorithm>
#include <cassert>

namespace arcwall {

namespace {

// The value of an entry that the pattern has.
double& entry(SparseMatrix& A, Index row, Index column) {
  const SparseIndex* first = A.innerIndexPtr() + A.outerIndexPtr()[column];
  const SparseIndex* last = A.innerIndexPtr() + A.outerIndexPtr()[column + 1];
  const SparseIndex* at = std::lower_bound(first, last, row);
  assert(at != last && *at == row);
  return A.valuePtr()[at - A.innerIndexPtr()];
}

}  // namespace

void add_force(const ConstraintForce& force, const Gap& f, Eigen::Ref<Vector> F) {
  for (std::size_t i = 0; i < force.unknowns.size(); ++i)
    F[force.unknowns[i]] -= force.t * f.gradient[static_cast<Index>(i)];
}

void add_force(const ConstraintForce& force, const Gap& f, double value, Linearization& out) {
  const auto& unknowns = force.unknowns;
  const double t = force.t, r = force.stiffness;
  out.F[force.row] = value;
  out.F_lambda[force.row] = -f.rate;
  entry(out.K, force.row, force.row) = -force.compliance;
  for (Index a = 0; a < static_cast<Index>(unknowns.size()); ++a) {
    const Index column = unknowns[static_cast<std::size_t>(a)];
    out.F[column] -= t * f.gradient[a];
    out.F_lambda[column] += r * f.rate * f.gradient[a] - t * f.gradient_rate[a];
    entry(out.K, force.row, column) = -f.gradient[a];
    for (Index b = 0; b < static_cast<Index>(unknowns.size()); ++b) {
      const Index row = unknowns[static_cast<std::size_t>(b)];
      const double stiffness = r * f.gradient[b] * f.gradient[a] - t * f.hessian(b, a);
      if (row < column || stiffness == 0.0) continue;
      entry(out.K, row, column) += stiffness;
      out.ground.push_back({.row = row, .column = column, .stiffness = stiffness});
    }
  }
}

}  // namespace arcwall
