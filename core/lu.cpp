#include "core/lu.hpp"

#include <umfpack.h>

#include <cassert>
#include <cstring>
#include <utility>
#include <vector>

namespace arcwall {

struct Lu::Implementation {
  SparseMatrix matrix;
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

  const SuiteSparse_long* columns() const { return reinterpret_cast<const SuiteSparse_long*>(matrix.outerIndexPtr()); }
  const SuiteSparse_long* rows() const { return reinterpret_cast<const SuiteSparse_long*>(matrix.innerIndexPtr()); }

  bool same_pattern(const SparseMatrix& A) const {
    return symbolic != nullptr && A.cols() == matrix.cols() && A.nonZeros() == matrix.nonZeros() &&
           std::memcmp(A.outerIndexPtr(), matrix.outerIndexPtr(),
                       static_cast<std::size_t>(A.cols() + 1) * sizeof(Index)) == 0 &&
           std::memcmp(A.innerIndexPtr(), matrix.innerIndexPtr(),
                       static_cast<std::size_t>(A.nonZeros()) * sizeof(Index)) == 0;
  }
};

Lu::Lu() : implementation_(std::make_unique<Implementation>()) {}
Lu::~Lu() = default;
Lu::Lu(Lu&&) noexcept = default;
Lu& Lu::operator=(Lu&&) noexcept = default;

FactorStatus Lu::factorize(const SparseMatrix& A) {
  Implementation& self = *implementation_;
  assert(A.isCompressed() && A.rows() == A.cols());
  umfpack_dl_free_numeric(&self.numeric);
  if (!Eigen::Map<const Vector>(A.valuePtr(), A.nonZeros()).allFinite()) return FactorStatus::not_finite;
  const bool known = self.same_pattern(A);
  self.matrix = A;
  if (!known) {
    umfpack_dl_free_symbolic(&self.symbolic);
    if (umfpack_dl_symbolic(A.rows(), A.cols(), self.columns(), self.rows(), self.matrix.valuePtr(), &self.symbolic,
                            self.control, nullptr) != UMFPACK_OK)
      return FactorStatus::singular;
  }
  const auto status = umfpack_dl_numeric(self.columns(), self.rows(), self.matrix.valuePtr(), self.symbolic,
                                         &self.numeric, self.control, nullptr);
  if (status == UMFPACK_OK) return FactorStatus::ok;
  umfpack_dl_free_numeric(&self.numeric);
  return FactorStatus::singular;
}

void Lu::solve(Eigen::Ref<Matrix> X) const {
  const Implementation& self = *implementation_;
  assert(self.numeric != nullptr);
  Vector solution(X.rows());
  for (Index j = 0; j < X.cols(); ++j) {
    umfpack_dl_solve(UMFPACK_A, self.columns(), self.rows(), self.matrix.valuePtr(), solution.data(), X.col(j).data(),
                     self.numeric, self.control, nullptr);
    X.col(j) = solution;
  }
}

}  // namespace arcwall
