#pragma once

#include "continuation/metric.hpp"
#include "continuation/path_point.hpp"

namespace arcwall {

/// The stretch between two points of one active set, with cubic interpolation from values and rates at its ends.
class Segment {
 public:
  /// All three must outlive the segment.
  Segment(const Metric& metric, const PathPoint& from, const PathPoint& to)
      : metric_(metric), from_(from), to_(to), length_(metric.distance(to.state, from.state)) {}

  const PathPoint& from() const { return from_; }
  const PathPoint& to() const { return to_; }
  Direction chord() const { return difference(to_.state, from_.state); }
  double length() const { return length_; }
  double cosine(const Direction& tangent) const { return metric_.inner(chord(), tangent) / length_; }

  /// Whether its ends follow each other along the path, which hardly bends over so short a way: the chord has the sense
  /// of both tangents. If not they lie on branches that pass each other, as those of an imperfect pitchfork do.
  bool follows_the_path() const;

  /// The state at fraction t of the chord, by Hermite's cubic.
  State at(double t) const;

  /// The first fraction in (0, 1] at which a quantity with these end values and rates along the path vanishes; a start
  /// within `noise` of zero does not count.
  std::optional<double> first_zero(double v0, double rate0, double v1, double rate1, double noise) const;

 private:
  const Metric& metric_;
  const PathPoint& from_;
  const PathPoint& to_;
  double length_;
};

}  // namespace arcwall
