#include <algorithm>

#include "contact/sliding/bounds/clamp.hpp"
#include "contact/sliding/bounds/curvature.hpp"
#include "contact/sliding/bounds/edge_presses.hpp"
#include "contact/sliding/bounds/element_size.hpp"
#include "contact/sliding/bounds/end_stays.hpp"
#include "contact/sliding/bounds/flat_part.hpp"
#include "contact/sliding/bounds/free_end.hpp"
#include "contact/sliding/bounds/friction.hpp"
#include "contact/sliding/bounds/holding_moment.hpp"
#include "contact/sliding/bounds/length.hpp"
#include "contact/sliding/bounds/load.hpp"
#include "contact/sliding/bounds/neutral.hpp"
#include "contact/sliding/bounds/pinch.hpp"
#include "contact/sliding/bounds/pressure.hpp"
#include "contact/sliding/bounds/pulling_jump.hpp"
#include "contact/sliding/bounds/room.hpp"
#include "contact/sliding/bounds/straight_end.hpp"
#include "contact/sliding/bounds/tail.hpp"
#include "contact/sliding/bounds/tip_presses.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

namespace {

using Bounds = std::vector<std::unique_ptr<const ValidityBound>>;
using Span = SlidingContactLayout::Span;

template <class Bound, class... Place>
void add_if(bool there_is_one, Bounds& to, Place... place) {
  if (there_is_one) to.push_back(std::make_unique<Bound>(place...));
}

// Whether the part between an end of a strand and the point nearest to it may become as short as a tail.
bool has_tail(const SlidingBody& body, const SlidingContactLayout& on, Index strand, bool last) {
  return on.point_at_end(strand, last) &&
         (body.lets_contact_come(strand, last) || on.span_at_end(strand, last) != Span::free);
}

void add_of_segment(const SlidingBody& body, const SlidingContactLayout& on, std::size_t i, Bounds& to) {
  const SlidingContactLayout::Segment& segment = on.segments()[i];
  const bool touched = segment.first_point >= 0 || segment.last_point >= 0;
  const auto is_held = [&](Index point, bool last) { return point >= 0 || body.is_on_plane(segment.strand, last); };
  const bool between_points =
      segment.has_point() && is_held(segment.first_point, false) && is_held(segment.last_point, true);
  const bool flat = segment.span == Span::flat && between_points;
  const bool to_load = touched && (segment.first_load >= 0 || segment.last_load >= 0);
  add_if<LengthBound>(on.joins_one_obstacle(segment), to, static_cast<std::size_t>(segment.first_point));
  add_if<LoadAheadBound>(to_load, to, i);
  const bool is_tail = (segment.first_point < 0 && has_tail(body, on, segment.strand, false)) ||
                       (segment.last_point < 0 && has_tail(body, on, segment.strand, true));
  add_if<RoomBound>(touched && !to_load && !is_tail && !on.joins_one_obstacle(segment), to, i);
  add_if<HalfWaveBound>(flat && segment.elements == 1, to, i);
  add_if<StraightBound>(flat && segment.elements > 1, to, i);
  const bool at_plane = between_points && (segment.first_point < 0 || segment.last_point < 0);
  add_if<LoadedPartBound>(segment.span == Span::pressed && between_points && (at_plane || on.hands_loads_on(i)), to, i);
  if (flat || on.points().empty()) return;
  add_if<CoarseBound>(true, to, i);
  add_if<FineBound>(FineBound::is_needed(body, on, segment), to, i);
}

// Of point loads that act inside elements.
void add_of_inner_loads(const SlidingBody& body, const SlidingContactLayout& on, Index strand, Bounds& to) {
  for (std::size_t i = 0; i < body.point_loads(strand).size(); ++i) {
    const auto load = static_cast<Index>(i);
    if (on.has_node(strand, load)) continue;
    bool is_handed_on = false;
    for (std::size_t j = 0; j < on.segments().size(); ++j) {
      const SlidingContactLayout::Segment& part = on.segments()[j];
      if (part.strand != strand || part.span == Span::free) continue;
      const PartLoad on_part{.strand = strand, .load = load, .segment = j};
      const bool inside = on.hands_on(j, load);
      add_if<LoadBesidePartBound>(!inside && part.has_point(), to, on_part);
      add_if<LoadInPartBound>(inside && part.has_point(), to, on_part);
      add_if<LoadPressesBound>(inside, to, on_part);
      is_handed_on = is_handed_on || inside;
    }
    add_if<LoadBehindBound>(!is_handed_on, to, strand, load);
  }
}

}  // namespace

std::vector<std::unique_ptr<const ValidityBound>> validity_bounds(const SlidingBody& body,
                                                                  const SlidingContactLayout& on) {
  Bounds bounds;
  for (std::size_t k = 0; k < on.points().size(); ++k)
    add_if<CurvatureBound>(!on.lies_beside(k) && !on.points()[k].is_pinched(), bounds, k);
  for (std::size_t k = 0; k < on.points().size(); ++k) add_if<PullingJumpBound>(on.lies_pressed(k), bounds, k);
  for (std::size_t k = 0; k < on.points().size(); ++k) add_if<EdgePressesBound>(on.lies_pressed(k), bounds, k);
  for (const std::size_t k : on.pinched_points())
    for (const auto side : {SlidingMesh::At::before, SlidingMesh::At::behind})
      for (const bool other : {false, true}) add_if<PinchBound>(true, bounds, k, side, other);
  for (std::size_t i = 0; i < on.segments().size(); ++i) add_of_segment(body, on, i, bounds);
  std::vector<std::size_t> changing;
  for (std::size_t i = 0; i < on.segments().size(); ++i)
    if (on.segments()[i].has_point()) changing.push_back(i);
  for (const std::size_t i : changing)
    for (const std::size_t j : changing)
      if (UnlikeBound::is_needed(body, on, i, j)) bounds.push_back(std::make_unique<UnlikeBound>(body, on, i, j));
  for (Index strand = 0; strand < body.strands(); ++strand) add_of_inner_loads(body, on, strand, bounds);
  for (std::size_t i = 0; i < on.pressed_nodes().size(); ++i) add_if<PressureBound>(true, bounds, i);
  for (std::size_t i = 0; i < on.pressed_tips().size(); ++i) {
    const SlidingContactLayout::PressedTip& tip = on.pressed_tips()[i];
    const bool last = tip.position > 0, free = body.is_tip(tip.strand, last);
    add_if<HoldingMomentBound>(free || body.is_hinged(tip.strand, last), bounds, i);
    add_if<HoldingMomentBound>(free, bounds, i, HoldingMomentBound::Against::lifting);
    add_if<TipPressesBound>(free, bounds, tip.strand, last);
  }
  for (std::size_t i = 0; i < on.neutral_spans().size(); ++i) add_if<NeutralBound>(true, bounds, i);
  for (Index strand = 0; strand < body.strands(); ++strand)
    for (const bool last : {false, true}) {
      const bool on_plane = body.is_on_plane(strand, last), free = !body.end_is_held(strand, last) || on_plane;
      add_if<LiesDownBound>(free || body.is_on_roller(strand, last), bounds, strand, last);
      add_if<UprightBound>(free, bounds, strand, last);
      add_if<EndStaysBound>(!free && on.lies_on(strand).has_value(), bounds, strand, last);
      add_if<StraightEndBound>(on.lies_on(strand).has_value(), bounds, strand, last);
      add_if<ClampBound>(body.is_clamped(strand, last) || body.is_hinged(strand, last) || on_plane, bounds, strand,
                         last);
      add_if<TipPressesBound>(on_plane && on.span_at_end(strand, last) == Span::pressed, bounds, strand, last);
      add_if<TailBound>(has_tail(body, on, strand, last), bounds, strand, last,
                        on.point_at_end(strand, last).value_or(0));
    }
  for (std::size_t j = 0; j < on.points().size() + on.end_rubbings().size(); ++j) {
    if (on.rubbing(j).mode != ContactMode::sticks) continue;
    for (const ContactMode beyond : {ContactMode::slips_backward, ContactMode::slips_forward})
      add_if<FrictionBound>(true, bounds, j, beyond);
    add_if<RollingBound>(j < on.points().size(), bounds, j);
  }
  return bounds;
}

bool is_reached(const ValidityBound& bound, const SlidingSetting& setting, const SlidingState& at,
                const Arrival& arrival) {
  if (&bound == arrival.at_hand) return true;
  const double value = bound.value(setting, at);
  if (value > std::max(reached_nearly, 10.0 * arrival.tolerance)) return false;
  return value <= std::min(reached_surely, 10.0 * arrival.tolerance) ||
         value + reached_within * apply(bound.gradient(setting, at), arrival.forward) <= 0.0;
}

}  // namespace arcwall::sliding
