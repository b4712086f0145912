#include "benchmarks/timed_ldlt.hpp"

#include "benchmarks/timed_system.hpp"
#include "core/ldlt.hpp"

// As GNU ld's --wrap wants it: calls of the mangled name go to __wrap_…, __real_… is the library's function. A member
// function is called like a function with the object's address in front (Itanium C++ ABI).
#define ARCWALL_FACTORIZE "_ZN7arcwall4Ldlt9factorizeERKN5Eigen12SparseMatrixIdLi0ElEE"
#define ARCWALL_SOLVE                                                                           \
  "_ZNK7arcwall4Ldlt5solveEN5Eigen3RefINS1_6MatrixIdLin1ELin1ELi0ELin1ELin1EEELi0ENS1_11OuterS" \
  "trideILin1EEEEE"

namespace arcwall::bench {

namespace {

LdltTimes times;

}  // namespace

const LdltTimes& ldlt_times() { return times; }

FactorStatus real_factorize(Ldlt* self, const SparseMatrix& matrix) __asm__("__real_" ARCWALL_FACTORIZE);
void real_solve(const Ldlt* self, Eigen::Ref<Matrix> X) __asm__("__real_" ARCWALL_SOLVE);

FactorStatus timed_factorize(Ldlt* self, const SparseMatrix& matrix) __asm__("__wrap_" ARCWALL_FACTORIZE);
void timed_solve(const Ldlt* self, Eigen::Ref<Matrix> X) __asm__("__wrap_" ARCWALL_SOLVE);

FactorStatus timed_factorize(Ldlt* self, const SparseMatrix& matrix) {
  const ScopedTimer timer(times.factorization);
  ++times.factorizations;
  return real_factorize(self, matrix);
}

void timed_solve(const Ldlt* self, Eigen::Ref<Matrix> X) {
  const ScopedTimer timer(times.solution);
  ++times.solutions;
  times.columns += X.cols();
  real_solve(self, X);
}

}  // namespace arcwall::bench
