#include "benchmarks/timed_solvers.hpp"

#include "benchmarks/timed_system.hpp"
#include "core/algebra/bordered_solver.hpp"
#include "core/algebra/ldlt.hpp"

// As GNU ld's --wrap wants it: calls of the mangled name go to __wrap_…, __real_… is the library's function. A member
// function is called like a function with the object's address in front (Itanium C++ ABI).
#define ARCWALL_FACTORIZE "_ZN7arcwall4Ldlt9factorizeERKN5Eigen12SparseMatrixIdLi0EiEE"
#define ARCWALL_SOLVE                                                                           \
  "_ZNK7arcwall4Ldlt5solveEN5Eigen3RefINS1_6MatrixIdLin1ELin1ELi0ELin1ELin1EEELi0ENS1_11OuterS" \
  "trideILin1EEEEE"
#define ARCWALL_LINE                                                                        \
  "_ZN7arcwall14BorderedSolver4lineERKNS_3RowERKN5Eigen6MatrixIdLin1ELi1ELi0ELin1ELi1EEERN" \
  "S_15EquilibriumLineE"

namespace arcwall::bench {

namespace {

SolverTimes times;

}  // namespace

const SolverTimes& solver_times() { return times; }

FactorStatus real_factorize(Ldlt* self, const SparseMatrix& matrix) __asm__("__real_" ARCWALL_FACTORIZE);
void real_solve(const Ldlt* self, Eigen::Ref<Matrix> X) __asm__("__real_" ARCWALL_SOLVE);

std::optional<LineProducts> real_line(BorderedSolver* self, const Row& border, const Vector& weights,
                                      EquilibriumLine& out) __asm__("__real_" ARCWALL_LINE);

FactorStatus timed_factorize(Ldlt* self, const SparseMatrix& matrix) __asm__("__wrap_" ARCWALL_FACTORIZE);
void timed_solve(const Ldlt* self, Eigen::Ref<Matrix> X) __asm__("__wrap_" ARCWALL_SOLVE);
std::optional<LineProducts> counted_line(BorderedSolver* self, const Row& border, const Vector& weights,
                                         EquilibriumLine& out) __asm__("__wrap_" ARCWALL_LINE);

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

// A line is found once an iteration.
std::optional<LineProducts> counted_line(BorderedSolver* self, const Row& border, const Vector& weights,
                                         EquilibriumLine& out) {
  ++times.iterations;
  return real_line(self, border, weights, out);
}

}  // namespace arcwall::bench
