#pragma once

#include "core/types.hpp"

namespace arcwall::bench {

/// What the factorizations of this process took, and Newton's iterations. Programs that link `timed_solvers` have the
/// libraries' calls of Ldlt::factorize and solve and of BorderedSolver::line go by here (GNU ld's
/// --wrap), so that nothing is timed or counted in the libraries themselves.
struct SolverTimes {
  double factorization = 0.0;  ///< with solutions that were found along [s]
  double solution = 0.0;       ///< of others [s]
  Index factorizations = 0, solutions = 0;
  Index columns = 0;     ///< right-hand sides
  Index iterations = 0;  ///< of the corrector, wherever it was used

  SolverTimes operator-(const SolverTimes& before) const {
    return {.factorization = factorization - before.factorization,
            .solution = solution - before.solution,
            .factorizations = factorizations - before.factorizations,
            .solutions = solutions - before.solutions,
            .columns = columns - before.columns,
            .iterations = iterations - before.iterations};
  }
};

/// Sums since the process began.
const SolverTimes& solver_times();

}  // namespace arcwall::bench
