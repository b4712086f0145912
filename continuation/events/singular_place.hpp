#pragma once

#include "continuation/path_point.hpp"

namespace arcwall {

/// A place of an arc where K is singular, or λ′ zero, or nearly so.
struct SingularPlace {
  PathPoint point{};
  double t = 0.0;           ///< as a fraction of the segment's chord
  double half_width = 0.0;  ///< likewise, of what is left uncertain
  double rate = 0.0;        ///< of the eigenvalue that passes zero, by t; of several the least; 0 where it is not known
  Index change = 0;         ///< of the number of negative eigenvalues across it
  Index multiplicity = 1;   ///< of the zero eigenvalue
  bool at_limit = false;    ///< λ turns there, too
  bool touches = false;     ///< zero is reached without a change of sign, as nearly as can be told
};

}  // namespace arcwall
