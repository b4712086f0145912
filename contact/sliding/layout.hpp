#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/contact_mode.hpp"
#include "core/sliding_body.hpp"

namespace arcwall {

namespace sliding {
class ValidityBound;
}

/// What the unknowns of sliding contact mean: the mesh, which of its breakpoints touch what, and where the body lies on
/// a wall between two of them. The layout also knows the bounds within which it is valid.
class SlidingContactLayout final : public SlidingLayout {
 public:
  /// How the body runs between a point and the next one, or the end of its strand.
  enum class Span {
    free,     ///< off the wall
    flat,     ///< on the wall, straight and without pressure
    pressed,  ///< on the wall; the nodes between are pressed on it
  };

  /// What a closed contact does along an obstacle with friction, and where it began to: the anchor of a stick, (18.10)
  /// of docs/theory.md. `open`: the contact has no friction, or is open.
  struct Rubbing {
    ContactMode mode = ContactMode::open;
    double w = 0.0;        ///< place on the obstacle [length]
    double s = 0.0;        ///< material coordinate [length]
    double stretch = 1.0;  ///< mean stretch of the face on both sides
    double slipped = 0.0;  ///< along the obstacle since the contact closed, up to there [length]

    bool rubs() const { return mode != ContactMode::open; }
    friend bool operator==(const Rubbing&, const Rubbing&) = default;
  };

  /// A tracked point: one a breakpoint of the mesh.
  struct Point {
    std::size_t obstacle = 0;
    Span behind = Span::free;
    Span before = Span::free;            ///< up to a strand's first point, from the strand's beginning; else free
    bool neutral_behind = false;         ///< the free span behind it is a neutral one
    bool neutral_before = false;         ///< up to a strand's first point: the free span before it is; else false
    std::optional<std::size_t> pinch{};  ///< that it is at, by its number in the setting: it touches two obstacles

    /// Of a point that waits for its first touch: the elements that the part which it divides has without it. 0: it
    /// does not wait.
    int undivided = 0;

    Rubbing rubbing{};

    bool is_pinched() const { return pinch.has_value(); }
    bool waits() const { return undivided > 0; }
  };

  /// A node inside a pressed part, which is a segment.
  struct PressedNode {
    Index strand, position;
    std::size_t obstacle, segment;
  };

  /// A tip or a hinged end up to which the body is pressed: the wall holds its slope, as it does at the other end of
  /// the part.
  struct PressedTip {
    Index strand, position;
    std::size_t obstacle;
  };

  /// A free span at both ends of which the body has neither slope nor moment: between a point and one on another wall,
  /// or a clamped end. Nothing but a force holds its middle halfway (docs/theory.md, section 8.3).
  struct NeutralSpan {
    Index strand;
    Index middle, end;              ///< positions of nodes; `end`: the clamped one, where there is one
    Index first_point, last_point;  ///< −1: a clamped end

    /// The tracked point at one of its ends: the first if both are.
    std::size_t end_point() const { return static_cast<std::size_t>(first_point >= 0 ? first_point : last_point); }
    bool joins_points() const { return first_point >= 0 && last_point >= 0; }
  };

  /// A part of a strand between tracked points, point loads that have nodes and the strand's ends. −1: no such thing
  /// at that end.
  struct Segment {
    Index strand, first_point, last_point;
    Index first_load, last_load;
    int elements;
    Span span;
    std::size_t place;  ///< among the strand's segments

    bool has_point() const { return first_point >= 0 || last_point >= 0; }

    /// The tracked point at one of its ends, of which it has one: the first if both are.
    std::size_t end_point() const { return static_cast<std::size_t>(first_point >= 0 ? first_point : last_point); }
  };

  /// Per strand the straight obstacle on which all of it is pressed, from end to end without a tracked point. May be
  /// empty: no strand is.
  using Lying = std::vector<std::optional<std::size_t>>;

  /// Of the free ends in their order. May be empty: none rubs.
  using EndRubbings = std::vector<Rubbing>;

  /// `s`: the material coordinates of the points where the layout begins. A mesh that is too fine already there is not
  /// made coarser.
  SlidingContactLayout(const SlidingBody& body, std::shared_ptr<const SlidingMesh> mesh, std::vector<Point> points,
                       const Vector& s, Lying lying = {}, EndRubbings ends = {});
  ~SlidingContactLayout() override;

  const SlidingMesh& mesh() const override { return *mesh_; }

  /// Whether it was made for this very body.
  bool is_of(const SlidingBody& body) const { return &body == body_; }
  const std::shared_ptr<const SlidingMesh>& shared_mesh() const { return mesh_; }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<PressedNode>& pressed_nodes() const { return pressed_nodes_; }
  const std::vector<PressedTip>& pressed_tips() const { return pressed_tips_; }
  const std::vector<NeutralSpan>& neutral_spans() const { return neutral_spans_; }

  /// The points at pinches, ascending.
  const std::vector<std::size_t>& pinched_points() const { return pinched_points_; }

  /// Whether a contact of an active set with this layout is a point at a pinch.
  bool is_pinched(std::size_t contact) const { return contact < points_.size() && points_[contact].is_pinched(); }

  const std::vector<Segment>& segments() const { return segments_; }

  const Lying& lying() const { return lying_; }
  const EndRubbings& end_rubbings() const { return end_rubbings_; }

  /// Of a contact of active sets with this layout: a tracked point or, behind those, a free end.
  const Rubbing& rubbing(std::size_t contact) const {
    static const Rubbing none;
    if (contact < points_.size()) return points_[contact].rubbing;
    const std::size_t end = contact - points_.size();
    return end < end_rubbings_.size() ? end_rubbings_[end] : none;
  }

  /// The obstacle on which all of a strand is pressed.
  std::optional<std::size_t> lies_on(Index strand) const {
    return lying_.empty() ? std::nullopt : lying_[static_cast<std::size_t>(strand)];
  }

  /// The bounds within which the layout is valid: guards behind those of the contacts.
  const std::vector<std::unique_ptr<const sliding::ValidityBound>>& bounds() const { return bounds_; }

  /// `s` where it began.
  const Vector& origin() const { return origin_; }

  /// Whether a neutral span lies between two flat parts that end at tracked points on both sides: it may then be
  /// anywhere between them, and only the sum of their lengths is determined.
  bool is_loose(const NeutralSpan& span) const;

  /// Whether two tracked points are the ends of a segment and touch one obstacle, and it alone.
  bool joins_one_obstacle(const Segment& segment) const;

  /// How the body runs up to a point.
  Span span_before(std::size_t point) const;

  /// How the body runs between the end of a strand and the point nearest to it; free where the strand has none.
  Span span_at_end(Index strand, bool last) const { return segment_at_end(strand, last).span; }

  /// The obstacle on which the body is pressed up to an end of a strand.
  std::optional<std::size_t> pressed_up_to(const StrandEnd& end) const;

  /// The segment between an end of a strand and what is nearest to it.
  const Segment& segment_at_end(Index strand, bool last) const;

  /// The point nearest an end of a strand; empty where the strand has none.
  std::optional<std::size_t> point_at_end(Index strand, bool last) const;

  /// Whether the part behind a point is free with a pressed part on one side.
  bool parts_pressed(std::size_t point) const;

  /// Whether a point is the end of a pressed part.
  bool lies_pressed(std::size_t point) const {
    return points_[point].behind == Span::pressed || span_before(point) == Span::pressed;
  }

  /// Whether a point load of a strand has a node; else it acts inside an element.
  bool has_node(Index strand, Index load) const;

  /// Whether a pressed part hands a point load of its strand on to its obstacle.
  bool hands_on(std::size_t segment, Index load) const;

  /// Whether it hands any on.
  bool hands_loads_on(std::size_t segment) const { return !loads_handed_on(segment).empty(); }

  /// Whether the body lies on the wall on one side of a point.
  bool lies_beside(std::size_t point) const {
    return points_[point].behind != Span::free || span_before(point) != Span::free;
  }

  /// Material coordinates of a segment's ends.
  std::pair<double, double> ends(const SlidingBody& body, const Segment& segment,
                                 const Eigen::Ref<const Vector>& s) const;

 private:
  const std::vector<Index>& loads_handed_on(std::size_t segment) const;
  Index add_segments(const SlidingBody& body, Index strand, Index next_point);

  const SlidingBody* body_;
  std::shared_ptr<const SlidingMesh> mesh_;
  std::vector<Point> points_;
  std::vector<PressedNode> pressed_nodes_;
  std::vector<PressedTip> pressed_tips_;
  std::vector<NeutralSpan> neutral_spans_;
  std::vector<std::size_t> pinched_points_;
  Lying lying_;
  EndRubbings end_rubbings_;
  std::vector<Segment> segments_;
  Vector origin_;
  std::vector<std::unique_ptr<const sliding::ValidityBound>> bounds_;
};

/// The layout of an active set of sliding contact.
inline const SlidingContactLayout& sliding_layout(const ActiveSet& active_set) {
  return static_cast<const SlidingContactLayout&>(*active_set.layout());
}

/// Whether a contact of such an active set is closed and has friction.
inline bool rubs(const ActiveSet& active_set, std::size_t contact) {
  return active_set[contact] != 0 && sliding_layout(active_set).rubbing(contact).rubs();
}

}  // namespace arcwall
