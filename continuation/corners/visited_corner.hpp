#pragma once

#include <vector>

#include "core/state.hpp"

namespace arcwall {

/// A change of contacts that the branch has met, and the ways by which it came and went.
struct VisitedCorner {
  State corner{};                 ///< with all contacts open
  double arc = 0.0;               ///< of the branch where it was there last
  std::vector<Direction> ways{};  ///< outward, of unit length, with all contacts open

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(corner, arc, ways);
    for (const Direction& way : ways) archive.require(way.dx.size() == corner.x.size());
  }
};

}  // namespace arcwall
