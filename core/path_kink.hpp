#pragma once

#include <memory>

#include "core/observable.hpp"

namespace arcwall {

/// A point at which the path is continuous and its tangent is not. λ may turn there.
struct PathKink {
  /// Grows through zero at the kink; grows along the path on both sides. Null: not known.
  std::shared_ptr<const Observable> past{};
  /// One of many, over most of which a step may go as if there were none.
  bool is_slight = false;
};

}  // namespace arcwall
