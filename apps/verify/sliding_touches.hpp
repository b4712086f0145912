#pragma once

#include "apps/verify/moved_unknowns.hpp"
#include "apps/verify/touches.hpp"

namespace arcwall::verify {

/// An element that turns farther does not tell how the body bends [rad].
constexpr double most_turn = 0.3;

/// A node of a mesh that slides.
struct SlidingNode {
  Index strand = 0, position = 0;
};

/// A sliding state with what stands in it.
struct Sliding {
  const Model& model;
  const State& state;
  const SlidingStructure& body = *model.sliding_structure();
  const SlidingContactLayout& on = sliding_layout(state.active_set);
  const SlidingMesh& mesh = on.mesh();
  MeshState now = mesh_state_of(state);
  MovedUnknowns x{Vector(now.x)};

  /// Where the node's unknowns are held its place is still known.
  AxisPlace place(const SlidingNode& node, const NodeFunction& function, const Vector& u) const {
    return x.with(function.unknowns, u, [&](const Vector& moved) {
      return mesh.node(node.strand, node.position, {moved, now.s, now.lambda});
    });
  }

  NodeFunction unknowns(const SlidingNode& node) const {
    const NodeUnknowns indices = mesh.node_unknowns(node.strand, node.position);
    NodeFunction function{.unknowns = {indices.begin(), indices.end()}, .at = Vector::Zero(3)};
    function.steps = Vector::Constant(3, touch_difference);
    function.steps.head<2>() *= body.length_scale();
    for (std::size_t i = 0; i < 3; ++i)
      if (indices[i] >= 0) function.at[static_cast<Index>(i)] = now.x[indices[i]];
    return function;
  }
};

/// Of the axis or the face that looks at the wall: its normal along the wall's or against it, with the direction of
/// travel.
Vec2 face_towards(const PlainWall& wall, double half_height, const AxisPlace& place);

/// What touches, may touch, or is tangent to a wall on a mesh that slides.
Touches sliding_touches(const Model& model, const std::vector<PlainWall>& walls, const State& state);

}  // namespace arcwall::verify
