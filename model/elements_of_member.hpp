#pragma once

#include <string>
#include <vector>

#include "model/member_extreme.hpp"
#include "model/section_forces.hpp"

/// The elements of a member on either kind of mesh, and differences by their unknowns.
namespace arcwall {

/// Moves of all unknowns, for differences, that are alike in the path metric; 0 of those without weight.
Vector moves_alike(const Vector& weights);

/// The same of a state whose mesh slides, its breakpoints included; 0 of contact forces.
Vector moves_alike(const SlidingStructure& structure, const State& state);

/// Of a member whose contacts are tied to its mesh.
class TiedElements final : public ElementsOfMember {
 public:
  /// The structure must outlive this.
  explicit TiedElements(const TiedMember& member);

  Index elements(const State&) const override { return member_.elements(); }
  void add_stretches(const State& state, Index element, std::vector<MemberStretch>& to) const override;
  std::vector<Step> steps(const State& state, Index element) const override;

 private:
  TiedMember member_;
  Index first_ = 0;  // element of the structure
};

/// Of a member whose mesh slides.
class SlidingElements final : public ElementsOfMember {
 public:
  /// `structure` must outlive this.
  SlidingElements(const SlidingStructure& structure, const std::string& member);

  Index elements(const State& state) const override;
  void add_stretches(const State& state, Index element, std::vector<MemberStretch>& to) const override;
  std::vector<Step> steps(const State& state, Index element) const override;

 private:
  const SlidingStructure& structure_;
  std::vector<SlidingStructure::MemberPart> parts_;
};

}  // namespace arcwall
