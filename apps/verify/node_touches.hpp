#pragma once

#include "apps/verify/touches.hpp"

namespace arcwall::verify {

/// What may touch at the nodes of a structure.
Touches node_touches(const Model& model, const std::vector<PlainWall>& walls, const State& state);

}  // namespace arcwall::verify
