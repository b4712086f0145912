#pragma once

#include <cstddef>

#include "continuation/path_point.hpp"

namespace arcwall {

/// A point at which a target value is landed on.
struct ValuePoint {
  std::size_t which = 0;  ///< of the target values
  PathPoint at{};

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(which, at);
  }
};

}  // namespace arcwall
