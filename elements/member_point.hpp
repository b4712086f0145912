#pragma once

#include "core/tracked_point.hpp"
#include "elements/structure.hpp"

namespace arcwall {

/// A material point of a member's section at a node: r + o n, o the offset and n the section's normal (the axis'
/// tangent turned by +90°), which turns with the node; r + o d + o² q where the thickness changes, see EssenburgNode. o
/// = 0 is the axis, ± half the height a face.
class MemberPoint final : public TrackedPoint {
 public:
  /// `structure` must outlive this. `offset` must be 0 for members whose nodes do not rotate.
  MemberPoint(const Structure& structure, const MemberSection& section, double offset);
  MemberPoint(const Structure& structure, const MemberMesh& mesh, std::size_t node, double offset)
      : MemberPoint(structure, mesh.section(node), offset) {}

  const std::vector<Index>& unknowns() const override { return unknowns_; }
  Vec2 position(const State& state) const override;
  PointMotion motion(const State& state, const Direction& direction) const override;
  void kinematics(const State& state, PointKinematics& out) const override;

 private:
  EssenburgNode::Vectors vectors(const State& state) const;
  Vec2 arm(const EssenburgNode::Vectors& v) const;

  const Structure& structure_;
  Index node_;
  EssenburgNode section_;
  double offset_;  // [length]
  std::vector<Index> unknowns_;
  std::optional<Index> rotation_;           // degree of freedom
  std::optional<ThicknessDofs> thickness_;  // likewise
  // A coordinate of the point: its column in the derivatives, or, where a support holds it, its rate by λ.
  struct Coordinate {
    std::optional<Index> column{};
    double rate = 0.0;
  };
  Coordinate x_, z_, turn_, e_, xi_;
};

/// x, z or rotation of a member's node, measured from the axis without imperfection; or the z of one of its faces,
/// likewise.
class MemberObservable final : public Observable {
 public:
  enum class Component { x, z, rotation, face_above_z, face_below_z };

  /// `structure` must outlive this. Faces need a height, rotations a rotation.
  MemberObservable(const Structure& structure, const MemberMesh& mesh, std::size_t node, Component component);

  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  const Structure& structure_;
  Component component_;
  MemberPoint point_;
  std::optional<Index> rotation_;
  double origin_ = 0.0;  // what is subtracted
};

/// The displacement or rotation of one degree of freedom.
class DofObservable final : public Observable {
 public:
  DofObservable(const Structure& structure, Index dof) : structure_(structure), dof_(dof) {}
  double value(const State& state) const override { return structure_.value(state, dof_); }
  Row gradient(const State& state) const override;

 private:
  const Structure& structure_;
  Index dof_;
};

/// What a support does to the structure in one degree of freedom.
class ReactionObservable final : public Observable {
 public:
  ReactionObservable(const Structure& structure, Index dof) : structure_(structure), dof_(dof) {}
  double value(const State& state) const override { return structure_.reaction(state, dof_); }
  Row gradient(const State& state) const override { return structure_.reaction_gradient(state, dof_); }

 private:
  const Structure& structure_;
  Index dof_;
};

}  // namespace arcwall
