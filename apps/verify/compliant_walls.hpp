#pragma once

#include <vector>

#include "apps/verify/findings.hpp"
#include "apps/verify/plain_wall.hpp"
#include "model/model.hpp"

namespace arcwall::verify {

/// Compliant walls at a state: what they exert, by laws, distances and a rule of integration of its own, and which of
/// them are penetrated. `walls`: where they are. Nothing for a model without them.
void check_compliant_walls(const Model& model, const std::vector<PlainWall>& walls, const State& state,
                           Findings& findings);

}  // namespace arcwall::verify
