#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

BoundPlace place_of_point(const SlidingState& at, std::size_t point) {
  const auto k = static_cast<Index>(point);
  return {.at = {.strand = at.mesh.breakpoint(k).first, .s = at.s(k)}, .obstacle = at.layout.points()[point].obstacle};
}

BoundPlace place_of_segment(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  if (part.has_point()) return place_of_point(at, part.end_point());
  return {.at = {.strand = part.strand, .s = at.layout.ends(setting.body, part, at.now.s).first},
          .obstacle = at.layout.lies_on(part.strand)};
}

BoundPlace place_of_end(const SlidingSetting& setting, const SlidingState& at, const StrandEnd& end) {
  BoundPlace place{.at = {.strand = end.strand, .s = end.last ? setting.body.length(end.strand) : 0.0},
                   .obstacle = at.layout.lies_on(end.strand)};
  for (std::size_t j = 0; j < setting.free_ends.size() && !place.obstacle; ++j)
    if (setting.free_ends[j].is_of(end) && at.is_closed(at.layout.points().size() + j))
      place.obstacle = setting.free_ends[j].obstacle;
  const auto nearest = at.layout.point_at_end(end.strand, end.last);
  if (!place.obstacle && nearest) place.obstacle = at.layout.points()[*nearest].obstacle;
  return place;
}

}  // namespace arcwall::sliding
