#pragma once

namespace arcwall {

/// Options of the corrector (Newton's method). All lengths in the path metric.
struct CorrectorOptions {
  double tolerance = 1e-12;  ///< of the remaining distance, estimated from the last two corrections
  double straight = 1e-4;    ///< part of a first correction that may be left
  double inexact = 1e-6;     ///< part of any correction that may be left: derivatives are as exact as that
  double stagnation = 1e-9;  ///< corrections below this that no longer decrease are round-off
  double divergence = 3.0;   ///< a correction longer than this times the one before ends the attempt
  double small = 1e-3;       ///< but not one below this part of the step: a first one may be small by chance
  int max_iterations = 10;
  int patient_iterations = 40;  ///< of correct_patiently()
  double unsettled = 0.0;       ///< a last correction that short is round-off, too: where a state is known no better
};

}  // namespace arcwall
