#pragma once

#include <string>

#include "model/body.hpp"
#include "model/central_differences.hpp"
#include "model/section_forces.hpp"

namespace arcwall {

/// What a member carries at a place: N, tension is positive, or M, positive where it adds to the curvature seen along
/// the member. Where it jumps (a load, a wall) its value just before the place.
///
/// Gradients are central differences: exact ones would need the derivatives of all elements' end forces.
class MemberForce : public DifferencedObservable {
 public:
  using What = Body::SectionForce;

  double value(const State& state) const final;

 protected:
  explicit MemberForce(What what) : what_(what) {}

 private:
  virtual ShapePoint place(const State& state) const = 0;

  /// By how much each unknown is moved for a difference; 0 where it has no part in this.
  virtual Vector steps(const State& state) const = 0;

  Differences differences_at(const State& state) const final;

  What what_;
};

/// At a node of a member whose contacts are tied to its mesh.
class TiedMemberForce final : public MemberForce {
 public:
  /// The structure must outlive this.
  TiedMemberForce(const TiedMember& member, double fraction, What what)
      : MemberForce(what), member_(member), fraction_(fraction) {}

 private:
  ShapePoint place(const State& state) const override;
  Vector steps(const State& state) const override;

  TiedMember member_;
  double fraction_;
};

/// At a place of a member whose mesh slides.
class SlidingMemberForce final : public MemberForce {
 public:
  /// `structure` must outlive this.
  SlidingMemberForce(const SlidingStructure& structure, const std::string& member, double fraction, What what);

 private:
  ShapePoint place(const State& state) const override;
  ShapePoint place_in(Index element, const State& state) const;
  Vector steps(const State& state) const override;

  const SlidingStructure& structure_;
  MaterialPoint at_;
  double begin_ = 0.0;        // of the member on its strand
  bool is_reversed_ = false;  // the strand travels against it
};

}  // namespace arcwall
