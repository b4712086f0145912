#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// The length of a strand between a tracked point and an end up to which contact may come, or another one up to which
/// the body lies on the wall. Behind the bound the contact has passed to the end, or the stretch on the wall has
/// gathered there; an open point is given up: a tip watches on, and a hinged end opens no gap.
class TailBound final : public BoundOfKind<BoundKind::tail> {
 public:
  TailBound(Index strand, bool last, std::size_t point) : strand_(strand), last_(last), point_(point) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

  Index strand() const { return strand_; }
  bool last() const { return last_; }

  /// Whether what becomes short is a stretch on the wall up to a support, at which it gathers.
  bool gathers_at_support(const SlidingSetting& setting, const SlidingState& at) const;

  /// Whether it is a free span at a plane of symmetry, from which the whole body has zones on both sides.
  bool closes_at_plane(const SlidingSetting& setting, const SlidingState& at) const;

  std::size_t point() const { return point_; }

 private:
  // Whether the end is on a plane of symmetry that the point's obstacle crosses at right angles.
  bool is_at_plane(const SlidingSetting& setting, const SlidingState& at) const;

  Index strand_;
  bool last_;
  std::size_t point_;
};

}  // namespace arcwall::sliding
