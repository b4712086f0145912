#pragma once

#include "core/types.hpp"

namespace arcwall {

/// Where a step ends because a guard is zero there: the active set changes.
struct Landing {
  Index guard = 0;
  double slack = 0.0;      ///< by how much other guards are violated there: those within it belong to the change
  bool continuum = false;  ///< whether a continuum of equilibria lies behind

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(guard, slack, continuum);
  }
};

}  // namespace arcwall
