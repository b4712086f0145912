#pragma once

#include "core/types.hpp"

namespace arcwall {

/// Where a step ends because a guard is zero there: the active set changes.
struct Landing {
  Index guard = 0;
  double slack = 0.0;     ///< by how much other guards are violated there: those within it belong to the change
  bool singular = false;  ///< whether the equations are singular there, as they are before a continuum of equilibria

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(guard, slack, singular);
  }
};

}  // namespace arcwall
