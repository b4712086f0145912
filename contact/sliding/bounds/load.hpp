#pragma once

#include "contact/sliding/part_loads.hpp"
#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// The room between a tracked point and a point load that has a node: half an element. Behind the bound the load acts
/// inside an element, so that the point may come to it and pass it.
class LoadAheadBound final : public BoundOfSegment<BoundKind::load_ahead> {
 public:
  using BoundOfSegment::BoundOfSegment;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

/// The reverse: behind the bound, at three quarters of an element from the nearest tracked point, a load that acts
/// inside an element has a node again.
class LoadBehindBound final : public BoundOfKind<BoundKind::load_behind> {
 public:
  LoadBehindBound(Index strand, Index load) : strand_(strand), load_(load) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  Index strand_, load_;
};

/// The elements between the edge of a part that lies on a wall and a load that acts inside an element beside it. Behind
/// the bound the part hands the load on to the wall; one without pressure is then meshed as a pressed one.
class LoadBesidePartBound final : public BoundOfPartLoad<BoundKind::load_beside_part> {
 public:
  using BoundOfPartLoad::BoundOfPartLoad;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

/// The reverse: the elements between a load that a pressed part hands on and the nearest edge of the part. A little
/// behind the edge, where the bound is, the load acts on the member.
class LoadInPartBound final : public BoundOfPartLoad<BoundKind::load_in_part> {
 public:
  using BoundOfPartLoad::BoundOfPartLoad;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

/// The force with which a load presses a part that hands it on. Behind the bound it would pull, and the part lifts off.
class LoadPressesBound final : public BoundOfPartLoad<BoundKind::load_presses> {
 public:
  using BoundOfPartLoad::BoundOfPartLoad;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
