#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// Elements of a segment that have become longer than 1.25 times what the deck asks for: behind the bound there are
/// twice as many.
class CoarseBound final : public ValidityBound {
 public:
  explicit CoarseBound(std::size_t segment) : segment_(segment) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  std::size_t segment_;
};

/// Elements of a segment that have become shorter than 0.25 times what the deck asks for: behind the bound there are
/// half as many.
class FineBound final : public ValidityBound {
 public:
  explicit FineBound(std::size_t segment) : segment_(segment) {}

  /// Whether a segment has this bound: not where it has one element, or where its elements are that short from the
  /// start.
  static bool is_needed(const SlidingBody& body, const SlidingContactLayout& on,
                        const SlidingContactLayout::Segment& segment);

  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  std::size_t segment_;
};

/// The number of elements that the mesh asks for in a segment, and `factor` times its derivative by the coordinates of
/// the segment's ends.
double elements_wanted(const SlidingSetting& setting, const SlidingState& at, std::size_t segment);
Row elements_wanted_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t segment, double factor);

}  // namespace arcwall::sliding
