#pragma once

#include <memory>
#include <vector>

#include "core/observable.hpp"
#include "elements/incremental_structure.hpp"
#include "elements/member_point.hpp"
#include "elements/sliding_structure.hpp"
#include "model/deck/deck.hpp"
#include "model/member_extreme.hpp"
#include "model/member_stretch.hpp"
#include "model/place_gap.hpp"

namespace arcwall {

/// What is read off a structure in a state: how places move, what supports exert, what members carry. It is one face
/// for the meshes that the states may have: nodes that are fixed along the members, or breakpoints that slide.
///
/// Members, nodes and degrees of freedom are those of the deck's mesh, which is Structure's.
class Body {
 public:
  virtual ~Body() = default;

  /// Displacement or rotation of a degree of freedom of a joint, from the stress-free state.
  virtual std::shared_ptr<const Observable> motion(Index dof) const = 0;

  /// The same of a member at a node of its mesh, or of one of its faces there: see MemberObservable.
  virtual std::shared_ptr<const Observable> motion(std::size_t member, std::size_t node,
                                                   MemberObservable::Component component) const = 0;

  /// What the support that holds a degree of freedom exerts on the structure [force, force·length].
  virtual std::shared_ptr<const Observable> reaction(Index dof) const = 0;

  enum class SectionForce { axial_force, moment };

  /// What a member carries at a fraction of its length; null where that is not known, which is so of load increments.
  virtual std::shared_ptr<const Observable> section_force(std::size_t member, double fraction,
                                                          SectionForce what) const = 0;

  /// The gap between a member's node and an obstacle.
  virtual std::shared_ptr<const Observable> gap(std::size_t member, std::size_t node,
                                                const FacedObstacle& obstacle) const = 0;

  /// A member from end to end, for what its sections carry; null of load increments.
  virtual std::shared_ptr<const ElementsOfMember> elements(std::size_t member) const = 0;

  /// By how much each unknown of a state is moved for a difference; 0 of what is no motion.
  virtual Vector steps(const State& state) const = 0;

  /// A member from end to end: at fixed fractions, each node of meshes that are not too fine among them, and at
  /// breakpoints.
  virtual std::vector<ShapePoint> shape(std::size_t member, const State& state) const = 0;
};

/// The body whose states are those of `structure`, or of `increments` where these are not null: its mesh has fixed
/// nodes. `theories` are those of the members. What is referred to must outlive the body.
std::unique_ptr<Body> body_of(const Structure& structure, std::vector<Theory> theories,
                              const IncrementalStructure* increments);

/// The body whose states are those of contact that slides on `sliding`. `structure` has the deck's mesh, which says
/// where members, nodes and degrees of freedom are. What is referred to must outlive the body.
std::unique_ptr<Body> body_of(const Structure& structure, const SlidingStructure& sliding);

}  // namespace arcwall
