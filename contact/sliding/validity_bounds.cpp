#include "contact/sliding/bounds/curvature.hpp"
#include "contact/sliding/bounds/element_size.hpp"
#include "contact/sliding/bounds/flat_part.hpp"
#include "contact/sliding/bounds/free_end.hpp"
#include "contact/sliding/bounds/length.hpp"
#include "contact/sliding/bounds/pressure.hpp"
#include "contact/sliding/bounds/room.hpp"

namespace arcwall::sliding {

namespace {

using Bounds = std::vector<std::unique_ptr<const ValidityBound>>;
using Span = SlidingContactLayout::Span;

template <class Bound, class... Place>
void add_if(bool there_is_one, Bounds& to, Place... place) {
  if (there_is_one) to.push_back(std::make_unique<Bound>(place...));
}

void add_of_segment(const SlidingBody& body, const SlidingContactLayout& on, std::size_t i, Bounds& to) {
  const SlidingContactLayout::Segment& segment = on.segments()[i];
  const bool flat = segment.span == Span::flat, touched = segment.first_point >= 0 || segment.last_point >= 0;
  add_if<LengthBound>(on.joins_one_obstacle(segment), to, static_cast<std::size_t>(segment.first_point));
  add_if<RoomBound>(touched && !on.joins_one_obstacle(segment), to, i);
  add_if<HalfWaveBound>(flat && segment.elements == 1, to, i);
  add_if<StraightBound>(flat && segment.elements > 1, to, i);
  if (flat || on.points().empty()) return;
  add_if<CoarseBound>(true, to, i);
  add_if<FineBound>(FineBound::is_needed(body, on, segment), to, i);
}

}  // namespace

std::vector<std::unique_ptr<const ValidityBound>> validity_bounds(const SlidingBody& body,
                                                                  const SlidingContactLayout& on) {
  Bounds bounds;
  for (std::size_t k = 0; k < on.points().size(); ++k) add_if<CurvatureBound>(!on.lies_beside(k), bounds, k);
  for (std::size_t i = 0; i < on.segments().size(); ++i) add_of_segment(body, on, i, bounds);
  for (std::size_t i = 0; i < on.pressed_nodes().size(); ++i) add_if<PressureBound>(true, bounds, i);
  for (Index strand = 0; strand < body.strands(); ++strand)
    for (const bool last : {false, true}) {
      const bool free = !body.end_is_held(strand, last);
      add_if<LiesDownBound>(free, bounds, strand, last);
      add_if<UprightBound>(free, bounds, strand, last);
    }
  return bounds;
}

}  // namespace arcwall::sliding
