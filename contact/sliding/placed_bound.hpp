#pragma once

#include "contact/sliding/part_loads.hpp"
#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// A tracked point, and what touches it.
BoundPlace place_of_point(const SlidingState& at, std::size_t point);

/// A tracked point at an end of a segment, or the first end of one that has none.
BoundPlace place_of_segment(const SlidingSetting& setting, const SlidingState& at, std::size_t segment);

/// An end of a strand, and what it touches or lies on.
BoundPlace place_of_end(const SlidingSetting& setting, const SlidingState& at, const StrandEnd& end);

/// A bound of a tracked point.
template <BoundKind of>
class BoundOfPoint : public BoundOfKind<of> {
 public:
  explicit BoundOfPoint(std::size_t point) : point_(point) {}
  std::size_t point() const { return point_; }
  BoundPlace place(const SlidingSetting&, const SlidingState& at) const override { return place_of_point(at, point_); }

 protected:
  std::size_t point_;
};

/// A bound of a segment.
template <BoundKind of>
class BoundOfSegment : public BoundOfKind<of> {
 public:
  explicit BoundOfSegment(std::size_t segment) : segment_(segment) {}
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override {
    return place_of_segment(setting, at, segment_);
  }

 protected:
  std::size_t segment_;
};

/// A bound of an end of a strand.
template <BoundKind of>
class BoundOfEnd : public BoundOfKind<of> {
 public:
  BoundOfEnd(Index strand, bool last) : strand_(strand), last_(last) {}
  Index strand() const { return strand_; }
  bool last() const { return last_; }
  StrandEnd end() const { return {.strand = strand_, .last = last_}; }
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override {
    return place_of_end(setting, at, end());
  }

 protected:
  Index strand_;
  bool last_;
};

/// A bound of a point load and a part that lies on an obstacle.
template <BoundKind of>
class BoundOfPartLoad : public BoundOfKind<of> {
 public:
  explicit BoundOfPartLoad(const PartLoad& load) : load_(load) {}
  const PartLoad& load() const { return load_; }
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override {
    return {.at = {.strand = load_.strand, .s = place_of(setting, load_)},
            .obstacle = obstacle_of_part(at, load_.segment)};
  }

 protected:
  PartLoad load_;
};

}  // namespace arcwall::sliding
