#pragma once

namespace arcwall {

/// How exactly rates at a change of contacts are told from zero, relative to the greatest rate of their kind.
struct CornerOptions {
  double rate_tolerance = 1e-7;
  double same_direction = 1e-8;  ///< 1 − cosine below which two outgoing directions are one
  int max_enumerated = 12;       ///< contacts up to which all subsets are tried; 0: see outgoing_directions()
};

}  // namespace arcwall
