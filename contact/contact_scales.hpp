#pragma once

#include "core/types.hpp"

namespace arcwall {

/// Scales that make guards of order 1, and what is none beside them.
struct ContactScales {
  double length = 1.0;  ///< of gaps [length]
  double force = 1.0;   ///< of contact forces [force]
  /// Of forces that λ brings [force], where that is less than `force`: round-off of slender members may make that more.
  double driven = infinity;
  double slack = 0.0;  ///< a force that is none: what springs that hold loose bodies may exert [force]
};

}  // namespace arcwall
