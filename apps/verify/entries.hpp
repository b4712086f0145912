#pragma once

#include <string>
#include <vector>

#include "apps/verify/plain_wall.hpp"
#include "model/model.hpp"

namespace arcwall::verify {

/// How deep a member is inside a wall between its nodes, where that is most for what is allowed there.
struct Entry {
  double depth = -infinity;  ///< negative outside; −∞ where no wall has a surface [length]
  double allowed = 0.0;      ///< [length]
  std::string where{};       ///< `wall at member:fraction`
};

/// Of members on meshes that slide, at ten places of each element or more, so that no wall is narrower than four parts.
///
/// `roundoff` is always allowed. Between nodes an element's shape may be off by what its curvature differs from that of
/// the moment which it carries, and a gap by what it differs from the cubic that tracing takes for it, up to 10⁻⁵ of
/// the structure's length.
Entry deepest_entry(const Model& model, const std::vector<PlainWall>& walls, const State& state, double roundoff);

}  // namespace arcwall::verify
