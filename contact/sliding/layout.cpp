#include "contact/sliding/layout.hpp"

#include <algorithm>

#include "contact/sliding/validity_bound.hpp"

namespace arcwall {

SlidingContactLayout::SlidingContactLayout(const SlidingBody& body, std::shared_ptr<const SlidingMesh> mesh,
                                           std::vector<Point> points, const Vector& s, Lying lying, EndRubbings ends)
    : body_(&body),
      mesh_(std::move(mesh)),
      points_(std::move(points)),
      lying_(std::move(lying)),
      end_rubbings_(std::move(ends)),
      origin_(s) {
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (points_[k].is_pinched()) pinched_points_.push_back(k);
  Index first_point = 0;
  for (Index strand = 0; strand < body.strands(); ++strand) first_point = add_segments(body, strand, first_point);
  bounds_ = sliding::validity_bounds(body, *this);
}

SlidingContactLayout::~SlidingContactLayout() = default;

// Tells the first point of the next strand.
Index SlidingContactLayout::add_segments(const SlidingBody& body, Index strand, Index next_point) {
  Index position = 0, before = -1, load_before = -1;  // the point or load where the segment begins
  const std::vector<MeshSegment>& segments = mesh_->elements_per_segment()[static_cast<std::size_t>(strand)];
  Point touching;  // the last point before the segment, or what lies before the first one
  if (std::count_if(segments.begin(), segments.end(), [](const MeshSegment& at) { return !at.ends_at_load(); }) > 1) {
    const Point& first = points_[static_cast<std::size_t>(next_point)];
    touching = {.obstacle = first.obstacle, .behind = first.before, .neutral_behind = first.neutral_before};
  } else if (const auto obstacle = lies_on(strand)) {
    touching = {.obstacle = *obstacle, .behind = Span::pressed};
  }
  const auto may_turn = [&](bool last) { return body.is_tip(strand, last) || body.is_hinged(strand, last); };
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const int elements = segments[i].elements;
    const Index load = segments[i].load;
    const bool to_point = i + 1 < segments.size() && !segments[i].ends_at_load();
    const Index point = to_point ? next_point++ : -1;
    segments_.push_back({.strand = strand,
                         .first_point = before,
                         .last_point = point,
                         .first_load = load_before,
                         .last_load = load,
                         .elements = elements,
                         .span = touching.behind,
                         .place = i});
    if (touching.neutral_behind && elements % 2 == 0 && load_before < 0 && load < 0)
      neutral_spans_.push_back({.strand = strand,
                                .middle = position + elements / 2,
                                .end = i == 0 ? 0 : mesh_->nodes(strand) - 1,
                                .first_point = before,
                                .last_point = point});
    if (touching.behind == Span::pressed)
      for (Index node = position + 1; node < position + elements; ++node)
        pressed_nodes_.push_back(
            {.strand = strand, .position = node, .obstacle = touching.obstacle, .segment = segments_.size() - 1});
    if (touching.behind == Span::pressed && i == 0 && may_turn(false))
      pressed_tips_.push_back({.strand = strand, .position = 0, .obstacle = touching.obstacle});
    position += elements;
    if (touching.behind == Span::pressed && !to_point && i + 1 == segments.size() && may_turn(true))
      pressed_tips_.push_back({.strand = strand, .position = position, .obstacle = touching.obstacle});
    if (to_point) touching = points_[static_cast<std::size_t>(point)];
    before = point;
    load_before = load;
  }
  return next_point;
}

bool SlidingContactLayout::has_node(Index strand, Index load) const {
  return std::any_of(segments_.begin(), segments_.end(),
                     [&](const Segment& segment) { return segment.strand == strand && segment.last_load == load; });
}

bool SlidingContactLayout::is_loose(const NeutralSpan& span) const {
  if (!span.joins_points()) return false;
  const auto joins_flat = [&](const Segment& segment, Index first, Index last) {
    return segment.strand == span.strand && segment.span == Span::flat && segment.first_point == first &&
           segment.last_point == last;
  };
  const auto has_part = [&](Index first, Index last) {
    return std::any_of(segments_.begin(), segments_.end(),
                       [&](const Segment& segment) { return joins_flat(segment, first, last); });
  };
  return span.first_point > 0 && has_part(span.first_point - 1, span.first_point) &&
         has_part(span.last_point, span.last_point + 1);
}

bool SlidingContactLayout::joins_one_obstacle(const Segment& segment) const {
  if (segment.first_point < 0 || segment.last_point < 0) return false;
  const Point& first = points_[static_cast<std::size_t>(segment.first_point)];
  const Point& last = points_[static_cast<std::size_t>(segment.last_point)];
  return first.obstacle == last.obstacle && !first.is_pinched() && !last.is_pinched();
}

SlidingContactLayout::Span SlidingContactLayout::span_before(std::size_t point) const {
  const auto strand = [this](std::size_t k) { return mesh_->breakpoint(static_cast<Index>(k)).first; };
  return point == 0 || strand(point) != strand(point - 1) ? points_[point].before : points_[point - 1].behind;
}

const SlidingContactLayout::Segment& SlidingContactLayout::segment_at_end(Index strand, bool last) const {
  const auto is_on_it = [strand](const Segment& segment) { return segment.strand == strand; };
  return last ? *std::find_if(segments_.rbegin(), segments_.rend(), is_on_it)
              : *std::find_if(segments_.begin(), segments_.end(), is_on_it);
}

std::optional<std::size_t> SlidingContactLayout::point_at_end(Index strand, bool last) const {
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (mesh_->breakpoint(static_cast<Index>(k)).first == strand && (last || !found)) found = k;
  return found;
}

std::optional<std::size_t> SlidingContactLayout::pressed_up_to(const StrandEnd& end) const {
  if (span_at_end(end.strand, end.last) != Span::pressed) return std::nullopt;
  const auto point = point_at_end(end.strand, end.last);
  return point ? points_[*point].obstacle : lies_on(end.strand);
}

bool SlidingContactLayout::parts_pressed(std::size_t point) const {
  if (points_[point].behind != Span::free || point + 1 == points_.size()) return false;
  return span_before(point) == Span::pressed || points_[point + 1].behind == Span::pressed;
}

std::pair<double, double> SlidingContactLayout::ends(const SlidingBody& body, const Segment& segment,
                                                     const Eigen::Ref<const Vector>& s) const {
  const auto place = [&](Index point, Index load, double end) {
    if (point >= 0) return s[point];
    return load >= 0 ? body.point_loads(segment.strand)[static_cast<std::size_t>(load)] : end;
  };
  return {place(segment.first_point, segment.first_load, 0.0),
          place(segment.last_point, segment.last_load, body.length(segment.strand))};
}

const std::vector<Index>& SlidingContactLayout::loads_handed_on(std::size_t segment) const {
  const Segment& part = segments_[segment];
  return mesh_->elements_per_segment()[static_cast<std::size_t>(part.strand)][part.place].handed_on;
}

bool SlidingContactLayout::hands_on(std::size_t segment, Index load) const {
  const std::vector<Index>& loads = loads_handed_on(segment);
  return std::find(loads.begin(), loads.end(), load) != loads.end();
}

}  // namespace arcwall
