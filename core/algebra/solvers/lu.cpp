#include "core/algebra/solvers/lu.hpp"

#include <umfpack.h>

#include <cassert>

#include "core/algebra/solvers/pattern.hpp"

namespace arcwall {

struct Lu::Implementation {
  LongPattern pattern;
  Vector values;
  void* symbolic = nullptr;
  void* numeric = nullptr;
  double control[UMFPACK_CONTROL]{};

  Implementation() { umfpack_dl_defaults(control); }
  ~Implementation() {
    umfpack_dl_free_numeric(&numeric);
    umfpack_dl_free_symbolic(&symbolic);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  const SuiteSparse_long* columns() const { return reinterpret_cast<const SuiteSparse_long*>(pattern.columns.data()); }
  const SuiteSparse_long* rows() const { return reinterpret_cast<const SuiteSparse_long*>(pattern.rows.data()); }
};

Lu::Lu() : implementation_(std::make_unique<Implementation>()) {}
Lu::~Lu() = default;
Lu::Lu(Lu&&) noexcept = default;
Lu& Lu::operator=(Lu&&) noexcept = default;

FactorStatus Lu::factorize(const SparseMatrix& A) {
  Implementation& self = *implementation_;
  assert(A.isCompressed() && A.rows() == A.cols());
  umfpack_dl_free_numeric(&self.numeric);
  self.values = Eigen::Map<const Vector>(A.valuePtr(), A.nonZeros());
  if (!self.values.allFinite()) return FactorStatus::not_finite;
  if (self.symbolic == nullptr || !self.pattern.is_of(A)) {
    self.pattern = LongPattern(A);
    umfpack_dl_free_symbolic(&self.symbolic);
    if (umfpack_dl_symbolic(A.rows(), A.cols(), self.columns(), self.rows(), self.values.data(), &self.symbolic,
                            self.control, nullptr) != UMFPACK_OK)
      return FactorStatus::singular;
  }
  const auto status = umfpack_dl_numeric(self.columns(), self.rows(), self.values.data(), self.symbolic, &self.numeric,
                                         self.control, nullptr);
  if (status == UMFPACK_OK) return FactorStatus::ok;
  umfpack_dl_free_numeric(&self.numeric);
  return FactorStatus::singular;
}

void Lu::solve(Eigen::Ref<Matrix> X) const {
  const Implementation& self = *implementation_;
  assert(self.numeric != nullptr);
  Vector solution(X.rows());
  for (Index j = 0; j < X.cols(); ++j) {
    umfpack_dl_solve(UMFPACK_A, self.columns(), self.rows(), self.values.data(), solution.data(), X.col(j).data(),
                     self.numeric, self.control, nullptr);
    X.col(j) = solution;
  }
}

}  // namespace arcwall
