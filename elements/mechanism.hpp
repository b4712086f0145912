#pragma once

#include <optional>
#include <vector>

#include "elements/structure.hpp"

namespace arcwall {

/// A motion of a structure without strain.
struct Mechanism {
  Index node;
  Dof dof;  ///< where the motion is greatest, rotations taken over half the structure's length scale
};

/// Whether a structure can begin to move from its stress-free state without strain; one such motion if it can.
///
/// This is a question of geometry alone. In a motion without strain every beam element moves as a rigid body does, and
/// those that share a rotation move as one; bars keep their lengths. What is left are the conditions between these
/// bodies at their joints and those of bars and supports: their rank is counted. So the answer does not depend on how
/// finely beams are divided, on how slender they are, or on whether a beam is written as one member or as many.
std::optional<Mechanism> find_mechanism(const Structure& structure);

/// A node and x or z.
struct NodeDirection {
  Index node;
  Dof dof;
};

struct FreeDirections {
  std::vector<NodeDirection> all{};     ///< in which some motion without strain moves those nodes
  std::vector<NodeDirection> fewest{};  ///< of these, that stop what all stop: springs there are statically determinate
};

/// The directions of those nodes in which motions without strain move them.
FreeDirections free_directions(const Structure& structure, const std::vector<Index>& nodes);

}  // namespace arcwall
