#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "continuation/path_point.hpp"

namespace arcwall {

/// Something that happens inside a step, and where.
struct EventPlace {
  enum class What { branch_point, detector, target_value };
  friend constexpr std::int64_t greatest(What) { return static_cast<std::int64_t>(What::target_value); }

  What what = What::branch_point;
  std::size_t which = 0;    ///< of the detectors or of the target values
  double t = 0.0;           ///< as a fraction of the step: an estimate until it is located
  double half_width = 0.0;  ///< likewise, of what is left uncertain

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(what, which, t, half_width);
  }
};

/// A singular point of a step, located: a branch point, a limit point, or both at one place.
struct SingularPoint {
  EventPlace place{};
  PathPoint at{};
  Index change = 0;                                ///< of the number of negative eigenvalues across it
  std::shared_ptr<const BranchPoint> branching{};  ///< empty: a limit point alone
  bool unconfirmed = false;                        ///< zero is touched without a change of sign
  double uncertain = 0.0;                          ///< of λ, besides what the place's half width makes of it

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(place, at, change, branching, unconfirmed, uncertain);
  }
};

}  // namespace arcwall
