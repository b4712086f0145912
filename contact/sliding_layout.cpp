#include "contact/sliding_layout.hpp"

namespace arcwall {

SlidingContactLayout::SlidingContactLayout(const SlidingBody& body, std::shared_ptr<const SlidingMesh> mesh,
                                           std::vector<Point> points, const Vector& s)
    : mesh_(std::move(mesh)), points_(std::move(points)), origin_(s) {
  Index point = 0;
  for (Index strand = 0; strand < body.strands(); ++strand) {
    const std::vector<int>& elements = mesh_->elements_per_segment()[static_cast<std::size_t>(strand)];
    Index position = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const bool first = i == 0, last = i + 1 == elements.size();
      const Span span = first ? Span::free : points_[static_cast<std::size_t>(point - 1)].behind;
      segments_.push_back({.strand = strand,
                           .first_point = first ? -1 : point - 1,
                           .last_point = last ? -1 : point,
                           .elements = elements[i],
                           .span = span});
      if (span == Span::pressed)
        for (Index node = position + 1; node < position + elements[i]; ++node)
          held_.push_back({.strand = strand,
                           .position = node,
                           .obstacle = points_[static_cast<std::size_t>(point - 1)].obstacle,
                           .segment = segments_.size() - 1});
      position += elements[i];
      if (!last) ++point;
    }
  }

  for (std::size_t k = 0; k < points_.size(); ++k)
    if (!lies_beside(k)) limits_.push_back({.bound = Bound::curvature, .which = k});
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& segment = segments_[i];
    const bool between = segment.first_point >= 0 && segment.last_point >= 0;
    if (between && points_[static_cast<std::size_t>(segment.first_point)].obstacle ==
                       points_[static_cast<std::size_t>(segment.last_point)].obstacle) {
      limits_.push_back({.bound = Bound::length, .which = static_cast<std::size_t>(segment.first_point)});
    } else if (segment.first_point >= 0 || segment.last_point >= 0) {
      limits_.push_back({.bound = Bound::room, .which = i});
    }
    if (points_.empty()) continue;
    if (segment.span == Span::flat) {
      limits_.push_back({.bound = segment.elements == 1 ? Bound::half_wave : Bound::straight, .which = i});
      continue;
    }
    limits_.push_back({.bound = Bound::coarse, .which = i});
    const auto [from, to] = ends(body, segment, s);
    if (segment.elements > 1 && body.elements_between(segment.strand, from, to) > 1.2 * finest * segment.elements)
      limits_.push_back({.bound = Bound::fine, .which = i});
  }
  for (std::size_t i = 0; i < held_.size(); ++i) limits_.push_back({.bound = Bound::pressure, .which = i});
  for (Index strand = 0; strand < body.strands(); ++strand)
    for (const bool last : {false, true}) {
      if (body.end_is_held(strand, last)) continue;
      for (const Bound bound : {Bound::lies, Bound::upright})
        limits_.push_back({.bound = bound, .which = 2 * static_cast<std::size_t>(strand) + (last ? 1 : 0)});
    }
}

SlidingContactLayout::Span SlidingContactLayout::span_before(std::size_t point) const {
  const auto strand = [this](std::size_t k) { return mesh_->breakpoint(static_cast<Index>(k)).first; };
  return point == 0 || strand(point) != strand(point - 1) ? Span::free : points_[point - 1].behind;
}

bool SlidingContactLayout::parts_pressed(std::size_t point) const {
  if (points_[point].behind != Span::free || point + 1 == points_.size()) return false;
  return span_before(point) == Span::pressed || points_[point + 1].behind == Span::pressed;
}

std::pair<double, double> SlidingContactLayout::ends(const SlidingBody& body, const Segment& segment,
                                                     const Vector& s) const {
  return {segment.first_point < 0 ? 0.0 : s[segment.first_point],
          segment.last_point < 0 ? body.length(segment.strand) : s[segment.last_point]};
}

}  // namespace arcwall
