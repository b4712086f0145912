#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// Elements of a segment that have become longer than 1.25 times what the deck asks for: behind the bound there are
/// twice as many.
class CoarseBound final : public BoundOfSegment<BoundKind::coarse> {
 public:
  using BoundOfSegment::BoundOfSegment;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

/// Elements of a segment that have become shorter than 0.25 times what the deck asks for: behind the bound there are
/// half as many.
class FineBound final : public BoundOfSegment<BoundKind::fine> {
 public:
  using BoundOfSegment::BoundOfSegment;

  /// Whether a segment has this bound: not where it has one element, or where its elements are that short from the
  /// start.
  static bool is_needed(const SlidingBody& body, const SlidingContactLayout& on,
                        const SlidingContactLayout::Segment& segment);

  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

/// Two segments with unlike numbers of elements come to be of about one length: behind the bound they have the same.
class UnlikeBound final : public BoundOfKind<BoundKind::unlike> {
 public:
  UnlikeBound(const SlidingBody& body, const SlidingContactLayout& on, std::size_t longer, std::size_t shorter);

  /// Whether a layout has this bound: of segments that run in one way, the first of which is the longer one there.
  static bool is_needed(const SlidingBody& body, const SlidingContactLayout& on, std::size_t longer,
                        std::size_t shorter);

  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  std::size_t longer_, shorter_;
  double ratio_;  ///< of their lengths, where they come to be of about one length
};

/// The number of elements that the mesh asks for in a segment, and `factor` times its derivative by the coordinates of
/// the segment's ends.
double elements_wanted(const SlidingSetting& setting, const SlidingState& at, std::size_t segment);
Row elements_wanted_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t segment, double factor);

}  // namespace arcwall::sliding
