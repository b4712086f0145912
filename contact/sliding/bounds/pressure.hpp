#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// The least pressure around a pressed node: behind the bound the part has lifted off inside. A part that needs no
/// pressure, and only hands loads on, stays.
class PressureBound final : public BoundOfKind<BoundKind::pressure> {
 public:
  explicit PressureBound(std::size_t node) : node_(node) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  double rate(const SlidingSetting& setting, const SlidingMotion& motion) const override;
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

  /// The pressed node.
  std::size_t node() const { return node_; }

 private:
  std::size_t node_;
};

}  // namespace arcwall::sliding
