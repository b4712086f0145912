#pragma once

#include <optional>
#include <utility>

#include "core/linearization.hpp"

namespace arcwall {

/// Whether K of a linearization has the pattern of the one that was asked for last: as long as a linearization stays
/// where it is and on one active set, so does its pattern.
class LastPattern {
 public:
  bool is_of(const Linearization& now) {
    Seen seen{.rows = now.K.innerIndexPtr(), .nonzeros = now.K.nonZeros(), .active_set = now.pattern_of};
    const bool same = seen.active_set && seen == last_;
    last_ = std::move(seen);
    return same;
  }

 private:
  struct Seen {
    const SparseIndex* rows = nullptr;
    Index nonzeros = 0;
    std::optional<ActiveSet> active_set{};
    bool operator==(const Seen&) const = default;
  };
  Seen last_{};
};

}  // namespace arcwall
