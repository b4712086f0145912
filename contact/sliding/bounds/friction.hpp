#pragma once

#include "contact/sliding/placed_bound.hpp"
#include "core/contact_mode.hpp"

namespace arcwall::sliding {

/// μ p ∓ T of a contact that sticks by friction, one a sense of slip: behind it the contact slips in that sense. No
/// unknowns change, so that it has no transitions.
class FrictionBound final : public BoundOfKind<BoundKind::friction> {
 public:
  /// `beyond`: the slip.
  FrictionBound(std::size_t contact, ContactMode beyond) : contact_(contact), beyond_(beyond) {}
  std::size_t contact() const { return contact_; }
  ContactMode beyond() const { return beyond_; }
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting&, const SlidingState&, const Arrival&) const override {
    return {};
  }

 private:
  std::size_t contact_;
  ContactMode beyond_;
};

/// How far a point that sticks has rolled from its anchor, over which the stretch of the body may change: there it gets
/// a new one.
class RollingBound final : public BoundOfPoint<BoundKind::rolling> {
 public:
  using BoundOfPoint::BoundOfPoint;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
