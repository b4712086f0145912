#pragma once

namespace arcwall {

/// Options of outgoing directions at an active-set change.
struct CornerOptions {
  double rate_tolerance = 1e-7;  ///< a smaller rate is zero, relative to the largest rate of its kind
  double same_direction = 1e-8;  ///< 1 − cosine below which two outgoing directions coincide
  int max_enumerated = 12;       ///< number of contacts up to which all subsets are tried; 0: see outgoing_directions()
};

}  // namespace arcwall
