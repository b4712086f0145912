#pragma once

namespace arcwall {

/// Scales that make guards of order 1.
struct ContactScales {
  double length = 1.0;  ///< of gaps [length]
  double force = 1.0;   ///< of contact forces [force]
};

}  // namespace arcwall
