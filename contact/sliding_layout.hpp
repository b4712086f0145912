#pragma once

#include <memory>
#include <vector>

#include "core/sliding_body.hpp"

namespace arcwall {

/// What the unknowns of sliding contact mean: the mesh, which of its breakpoints touch what, where the body lies on a
/// wall between two of them, and what bounds the piece besides.
class SlidingContactLayout final : public SlidingLayout {
 public:
  /// How the body runs on behind a point.
  enum class Span {
    free,     ///< off the wall, or to the end
    flat,     ///< on the wall up to the next point, straight and without pressure
    pressed,  ///< on the wall up to the next point; the nodes between are held
  };

  /// A tracked point: one a breakpoint of the mesh.
  struct Point {
    std::size_t obstacle = 0;
    Span behind = Span::free;
  };

  /// A node inside a pressed part, which is a segment.
  struct Held {
    Index strand, position;
    std::size_t obstacle, segment;
  };

  /// A stretch between breakpoints; −1: the end of the strand.
  struct Segment {
    Index strand, first_point, last_point;
    int elements;
    Span span;
  };

  /// What bounds a piece besides gaps and forces.
  enum class Bound {
    curvature,  ///< of point `which`: a point contact becomes a line, or a least gap is shallow
    length,     ///< of the span behind point `which`: a line becomes a point
    coarse,     ///< of segment `which`: more elements are needed
    fine,       ///< fewer
    half_wave,  ///< of the flat segment `which`: long enough to need elements of its own
    straight,   ///< short enough to need none
    room,       ///< of segment `which`: a contact reaches the end of its member, or one on another wall
    pressure,   ///< around the held node `which`
    lies,       ///< of the free end `which` that touches: before it lies on the wall
    upright,    ///< likewise: before it stands against the wall, where its section's other corner would touch
  };
  struct Limit {
    Bound bound;
    std::size_t which;
  };

  /// `s` where the layout begins: meshes that are too fine from the start are let be.
  SlidingContactLayout(const SlidingBody& body, std::shared_ptr<const SlidingMesh> mesh, std::vector<Point> points,
                       const Vector& s);

  const SlidingMesh& mesh() const override { return *mesh_; }
  const std::shared_ptr<const SlidingMesh>& shared_mesh() const { return mesh_; }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<Held>& held() const { return held_; }
  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Limit>& limits() const { return limits_; }

  /// `s` where it began.
  const Vector& origin() const { return origin_; }

  /// A free end as a limit's `which`: 2 strand + 1 for the last.
  static std::pair<Index, bool> end_of(std::size_t which) { return {static_cast<Index>(which / 2), which % 2 == 1}; }

  Vector s_of(const State& state) const { return state.x.tail(mesh_->breakpoints()); }

  /// How the body runs up to a point.
  Span span_before(std::size_t point) const;

  /// Whether the stretch behind a point is free with a pressed part on one side.
  bool parts_pressed(std::size_t point) const;

  /// Whether a point is the end of a pressed part.
  bool lies_pressed(std::size_t point) const {
    return points_[point].behind == Span::pressed || span_before(point) == Span::pressed;
  }

  /// Whether the body lies on the wall on one side of a point.
  bool lies_beside(std::size_t point) const {
    return points_[point].behind != Span::free || span_before(point) != Span::free;
  }

  /// Material coordinates of a segment's ends.
  std::pair<double, double> ends(const SlidingBody& body, const Segment& segment, const Vector& s) const;

 private:
  std::shared_ptr<const SlidingMesh> mesh_;
  std::vector<Point> points_;
  std::vector<Held> held_;
  std::vector<Segment> segments_;
  std::vector<Limit> limits_;
  Vector origin_;
};

/// Sizes of elements, relative to those asked for, at which a segment is meshed anew.
constexpr double coarsest = 1.25, finest = 0.25;

}  // namespace arcwall
