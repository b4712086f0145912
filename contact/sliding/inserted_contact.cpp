#include "contact/sliding/inserted_contact.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/bounds/curvature.hpp"
#include "contact/sliding/bounds/room.hpp"
#include "contact/sliding/least_gaps.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/spans.hpp"

namespace arcwall::sliding {

namespace {

// Whether a point of the layout follows a least gap already.
bool is_followed(const SlidingSetting& setting, const SlidingState& at, const LeastGap& gap) {
  for (std::size_t k = 0; k < at.layout.points().size(); ++k) {
    const auto point = static_cast<Index>(k);
    if (at.layout.points()[k].obstacle == gap.obstacle && at.mesh.breakpoint(point).first == gap.at.strand &&
        std::abs(at.s(point) - gap.at.s) < shortest_span(setting.body, gap.at.strand))
      return true;
  }
  return false;
}

const SlidingContactLayout::Segment* segment_of(const SlidingSetting& setting, const SlidingState& at,
                                                const MaterialPoint& place) {
  for (const SlidingContactLayout::Segment& segment : at.layout.segments()) {
    const auto [from, to] = at.layout.ends(setting.body, segment, at.now.s);
    if (segment.strand == place.strand && from <= place.s && place.s < to) return &segment;
  }
  return nullptr;
}

// How many elements a segment has before and behind a point that is inserted, by where this will touch, roughly.
struct Elements {
  int before, behind;
};

Elements elements_beside(const SlidingSetting& setting, const SlidingState& at,
                         const SlidingContactLayout::Segment& segment, const LeastGap& start,
                         const LeastGap& violated) {
  const double fallen = start.gap - violated.gap;
  const double part = fallen > 0.0 ? std::clamp(start.gap / fallen, 0.0, 2.0) : 0.0;
  const double touch = start.at.s + part * (violated.at.s - start.at.s);
  const auto [a, b] = at.layout.ends(setting.body, segment, at.now.s);
  const int elements = std::max(2, segment.elements);
  const int first = std::clamp(static_cast<int>(std::lround(elements * (touch - a) / (b - a) - 1e-3)), 1, elements - 1);
  const auto at_least = [&](double from, double to) {
    return static_cast<int>(std::ceil(setting.body.elements_between(segment.strand, from, to) / coarsest));
  };
  return {.before = std::max(first, at_least(a, start.at.s)),
          .behind = std::max(elements - first, at_least(start.at.s, b))};
}

// Whether an inserted point would be given up at once: its least gap is shallow, or it is cramped beside the end of the
// member, a load or a contact with another wall.
bool is_unfit(const SlidingSetting& setting, const State& state, std::size_t point) {
  const SlidingState at(state);
  return std::any_of(at.layout.bounds().begin(), at.layout.bounds().end(), [&](const auto& bound) {
    const auto* curvature = dynamic_cast<const CurvatureBound*>(bound.get());
    const bool is_its_own = curvature != nullptr && curvature->point() == point;
    const bool is_room = dynamic_cast<const RoomBound*>(bound.get()) != nullptr;
    return (is_its_own || is_room) && bound->value(setting, at) <= 0.0;
  });
}

}  // namespace

std::optional<Transition> with_inserted_contact(const SlidingSetting& setting, const SlidingState& from,
                                                const Direction& forward, const SlidingState& to, double margin) {
  const auto violated = deepest_unwatched(setting, to, margin);
  if (!violated) return std::nullopt;
  const Index strand = violated->at.strand;
  const auto start = nearest_least_gap(setting, from, *violated);
  const double nearby = 0.25 * setting.body.length(strand);
  if (!start || std::abs(start->at.s - violated->at.s) > nearby) return std::nullopt;
  if (is_followed(setting, from, *start)) return std::nullopt;
  const auto* segment = segment_of(setting, from, start->at);
  if (segment == nullptr) return std::nullopt;
  const auto elements = elements_beside(setting, from, *segment, *start, *violated);
  std::size_t point = 0;
  Transition transition = remeshed(setting, from, forward, [&](LayoutEdit& edit, const SlidingState& at) {
    // The point follows the least gap, which may move along the member much faster than the body moves.
    const double s = nearest_least_gap(setting, at, *violated).value_or(*start).at.s;
    point = edit.insert({.point = {.obstacle = start->obstacle}, .strand = strand, .s = s}, elements.before,
                        elements.behind);
  });
  if (is_unfit(setting, transition.guess, point)) return std::nullopt;
  return transition;
}

}  // namespace arcwall::sliding
