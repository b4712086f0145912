#include "contact/sliding/layout.hpp"

#include "contact/sliding/validity_bound.hpp"

namespace arcwall {

SlidingContactLayout::SlidingContactLayout(const SlidingBody& body, std::shared_ptr<const SlidingMesh> mesh,
                                           std::vector<Point> points, const Vector& s)
    : mesh_(std::move(mesh)), points_(std::move(points)), origin_(s) {
  for (Index strand = 0; strand < body.strands(); ++strand) add_segments(strand);
  bounds_ = sliding::validity_bounds(body, *this);
}

SlidingContactLayout::~SlidingContactLayout() = default;

void SlidingContactLayout::add_segments(Index strand) {
  Index point = segments_.empty() ? 0 : static_cast<Index>(segments_.size()) - strand;  // the next one of the strand
  Index position = 0;
  const std::vector<int>& elements = mesh_->elements_per_segment()[static_cast<std::size_t>(strand)];
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const bool first = i == 0, last = i + 1 == elements.size();
    const Point before = first ? Point{} : points_[static_cast<std::size_t>(point - 1)];
    segments_.push_back({.strand = strand,
                         .first_point = first ? -1 : point - 1,
                         .last_point = last ? -1 : point,
                         .elements = elements[i],
                         .span = before.behind});
    if (before.behind == Span::pressed)
      for (Index node = position + 1; node < position + elements[i]; ++node)
        pressed_nodes_.push_back(
            {.strand = strand, .position = node, .obstacle = before.obstacle, .segment = segments_.size() - 1});
    position += elements[i];
    if (!last) ++point;
  }
}

bool SlidingContactLayout::joins_one_obstacle(const Segment& segment) const {
  return segment.first_point >= 0 && segment.last_point >= 0 &&
         points_[static_cast<std::size_t>(segment.first_point)].obstacle ==
             points_[static_cast<std::size_t>(segment.last_point)].obstacle;
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
                                                     const Eigen::Ref<const Vector>& s) const {
  return {segment.first_point < 0 ? 0.0 : s[segment.first_point],
          segment.last_point < 0 ? body.length(segment.strand) : s[segment.last_point]};
}

}  // namespace arcwall
