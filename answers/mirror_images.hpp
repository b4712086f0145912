#pragma once

#include <vector>

#include "model/model.hpp"

namespace arcwall {

/// Shapes of a structure seen in a mirror: across the upright and the level line through its middle, and both.
class MirrorImages {
 public:
  /// Of the deck's mesh. `structure` must outlive this.
  explicit MirrorImages(const Structure& structure);

  /// The images of a state of the structure, whichever contacts it has, by its unknowns. They stand where supports hold
  /// the structure. Those of an equilibrium are equilibria where all that the structure meets is symmetric, too; else
  /// they may be near some. Empty where the mesh is its own image in no mirror.
  std::vector<Vector> of(const State& state) const;

 private:
  struct Mirror {
    Vec2 factors = Vec2::Ones();   // of the coordinates
    std::vector<Index> partner{};  // whose image each node is
  };
  // What a node can do, in the same order for nodes alike.
  struct NodeDof {
    Index dof = 0;
    Dof kind = Dof::x;
  };

  std::vector<Index> partners(const Vec2& factors) const;
  Vec2 mirrored(const Mirror& mirror, const Vec2& place) const;
  Vec2 shift_to_supports(const Mirror& mirror, const State& state) const;
  Vector image(const Mirror& mirror, const State& state) const;

  const Structure& structure_;
  Vec2 middle_ = Vec2::Zero();
  std::vector<std::vector<NodeDof>> dofs_;  // of each node
  std::vector<Mirror> mirrors_;
};

}  // namespace arcwall
