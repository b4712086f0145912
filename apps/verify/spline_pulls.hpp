#pragma once

#include <vector>

#include "apps/verify/plain_wall.hpp"
#include "model/model.hpp"

namespace arcwall::verify {

/// A point of a spline that a part pressed on the wall lies across, where the wall would have to pull: a beam that has
/// the wall's curvature needs a force EI J where the rate of that jumps by J.
struct SplinePull {
  ContactLabel label{};
  double pull = 0.0;  ///< EI |J| [force]
  double held = 0.0;  ///< what the pressure beside holds on six elements: less shows in the nodes' forces [force]
};

/// Those of a state, of walls that are profiles.
std::vector<SplinePull> spline_pulls(const Model& model, const std::vector<PlainWall>& walls, const State& state);

/// By how much each node inside a pressed part, in their order, may pull beside points of splines: what such a point
/// asks for, EI |J|, rings on both sides of its element, halved at least from node to node as in splines [force].
std::vector<double> knot_ringing(const Model& model, const std::vector<PlainWall>& walls, const State& state);

}  // namespace arcwall::verify
