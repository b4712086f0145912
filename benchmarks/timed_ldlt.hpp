#pragma once

#include "core/types.hpp"

namespace arcwall::bench {

/// What the factorizations of this process took. Programs that link `timed_ldlt` have the libraries' calls of
/// Ldlt::factorize and Ldlt::solve go by here (GNU ld's --wrap), so that nothing is timed in the libraries themselves.
struct LdltTimes {
  double factorization = 0.0;  ///< [s]
  double solution = 0.0;       ///< [s]
  Index factorizations = 0, solutions = 0;
  Index columns = 0;  ///< right-hand sides

  LdltTimes operator-(const LdltTimes& before) const {
    return {.factorization = factorization - before.factorization,
            .solution = solution - before.solution,
            .factorizations = factorizations - before.factorizations,
            .solutions = solutions - before.solutions,
            .columns = columns - before.columns};
  }
};

/// Sums since the process began.
const LdltTimes& ldlt_times();

}  // namespace arcwall::bench
