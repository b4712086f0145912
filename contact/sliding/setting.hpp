#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "contact/contact_scales.hpp"
#include "contact/continuum_choice.hpp"
#include "contact/sliding_obstacle.hpp"
#include "core/sliding_body.hpp"

namespace arcwall {

/// A free end of a strand with an obstacle that may touch it, though no tangent of the body does: a contact of its own,
/// at the last node. Also an end that a support holds in z alone, with an obstacle that stands across its way in x, and
/// an end on a plane of symmetry, where the middle of the whole body touches.
struct FreeEnd {
  Index strand = 0;
  bool last = false;
  std::size_t obstacle = 0;
  double travel = 0.0;              ///< of the axis at rest: 1 with x, −1 against it, 0 where it stands upright
  std::vector<StrandEnd> joined{};  ///< ends of later strands at a joint that are the same place to the obstacle

  Index position(const SlidingMesh& mesh) const { return last ? mesh.nodes(strand) - 1 : 0; }

  /// Whether it is the contact of an end of a strand.
  bool is_of(const StrandEnd& end) const {
    return end == StrandEnd{.strand = strand, .last = last} ||
           std::find(joined.begin(), joined.end(), end) != joined.end();
  }

  /// The same contact, seen from another of its ends.
  FreeEnd seen_from(const StrandEnd& end) const {
    FreeEnd seen = *this;
    seen.strand = end.strand;
    seen.last = end.last;
    return seen;
  }
};

/// A place where two obstacles leave a strand no clearance, from one side each: the axis goes through it for good,
/// along one line if the obstacles are smooth there, at any angle between their flanks if they are knife edges. The
/// strand may slide through.
struct Pinch {
  Index strand = 0;
  double s = 0.0;                       ///< material coordinate of what is there at rest [length]
  std::size_t obstacle = 0, other = 0;  ///< the one that pushes along `normal`, and the one against it
  Vec2 place = Vec2::Zero();            ///< of the axis
  double angle = 0.0;                   ///< of the axis there, continuous along the strand at rest [rad]
  Vec2 normal = Vec2::Zero();           ///< across the axis
  std::optional<std::array<SharpCorner, 2>> knife_edges{};  ///< of both obstacles; empty where these are smooth

  bool holds_direction() const { return !knife_edges; }
};

/// A body among obstacles: all that contact which slides depends on and that stays the same along a path. The contacts
/// of an active set are the points that its layout tracks, then the free ends.
struct SlidingSetting {
  const SlidingBody& body;  ///< must outlive this
  std::vector<SlidingObstacle> obstacles{};
  ContactScales scales{};
  std::vector<FreeEnd> free_ends{};
  std::vector<FreeEnd> held_ends{};  ///< those which no contact force moves; λ may press them and obstacles together
  ContinuumChoice continuum = ContinuumChoice::symmetric;
  std::vector<Pinch> pinches{};  ///< along the strands, in their order

  /// The contact of an end of a strand with an obstacle, by its number among the free ends.
  std::optional<std::size_t> number_of_end(const StrandEnd& end, std::size_t obstacle) const {
    const auto found = std::find_if(free_ends.begin(), free_ends.end(), [&](const FreeEnd& contact) {
      return contact.obstacle == obstacle && contact.is_of(end);
    });
    if (found == free_ends.end()) return std::nullopt;
    return static_cast<std::size_t>(found - free_ends.begin());
  }

  /// How far the body's outside is from the axis where an obstacle touches it [length].
  double half_height_touched(std::size_t obstacle, Index strand) const {
    return obstacles[obstacle].on_face ? body.half_height(strand) : obstacles[obstacle].surface->half_height();
  }

  /// Of the face that looks at an obstacle from the axis, along the obstacle's normal (upwards) [length].
  double face_offset(std::size_t obstacle, Index strand) const {
    return obstacles[obstacle].face_offset(body.half_height(strand));
  }
};

/// The ends of a body that obstacles concern.
struct BodyEnds {
  std::vector<FreeEnd> free{}, held{};
};

/// Returns them; `rest`: the stress-free state of a mesh of the body.
BodyEnds ends_beside_obstacles(const SlidingBody& body, const std::vector<SlidingObstacle>& obstacles,
                               const SlidingMesh& mesh, const MeshState& rest);

}  // namespace arcwall
