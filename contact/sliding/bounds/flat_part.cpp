#include "contact/sliding/bounds/flat_part.hpp"

#include <optional>
#include <vector>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/part_loads.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/tips.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

namespace {

constexpr double shortest_flat = 0.8;    // of a half wave, below which a flat part has one element
constexpr double held_half_waves = 4.0;  // squared: a stretch whose slope is held at both ends buckles in a whole wave

// A stretch of a straight part between two points.
struct Stretch {
  double from, to;
  std::optional<Index> first, last;  ///< the tracked points at its ends; empty: a load or an end, which stays
  bool is_half = false;              ///< up to a plane of symmetry, beyond which it goes on as far

  double length() const { return (is_half ? 2.0 : 1.0) * (to - from); }
};

Stretch whole_part(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  const auto [from, to] = at.layout.ends(setting.body, part, at.now.s);
  const auto point = [](Index k) { return k >= 0 ? std::optional(k) : std::nullopt; };
  return {.from = from,
          .to = to,
          .first = point(part.first_point),
          .last = point(part.last_point),
          .is_half = part.first_point < 0 || part.last_point < 0};
}

// The longest one between the ends of a part and the point loads that it hands on.
Stretch longest_between_loads(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  const Stretch whole = whole_part(setting, at, segment);
  const std::vector<double>& places = setting.body.point_loads(at.layout.segments()[segment].strand);
  // An end on a plane of symmetry that a load presses on the wall is one of the loads.
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  const auto goes_on_beyond = [&](bool last) {
    const StrandEnd end{.strand = part.strand, .last = last};
    const auto contact = setting.number_of_end(end, obstacle_of_part(at, segment));
    return contact && !(presses_end(setting, at, setting.free_ends[*contact].seen_from(end)) > 0.0);
  };
  Stretch longest{.from = whole.from, .to = whole.from, .first = {}, .last = {}}, rest = whole;
  rest.is_half = part.first_point < 0 && goes_on_beyond(false);
  const auto take = [&](const Stretch& stretch) {
    if (stretch.length() > longest.length()) longest = stretch;
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!at.layout.hands_on(segment, static_cast<Index>(i))) continue;
    take({.from = rest.from, .to = places[i], .first = rest.first, .last = {}, .is_half = rest.is_half});
    rest.from = places[i];
    rest.first.reset();
    rest.is_half = false;
  }
  rest.is_half = rest.is_half || (part.last_point < 0 && goes_on_beyond(true));
  take(rest);
  return longest;
}

// At the end of a segment, just inside.
AxisStrain strain_in(const SlidingState& at, std::size_t segment) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  return part.last_point >= 0 ? at.mesh.strain(part.last_point, SlidingMesh::At::before, at.now)
                              : at.mesh.strain(part.first_point, SlidingMesh::At::behind, at.now);
}

AxisStrainGradient strain_gradient_in(const SlidingState& at, std::size_t segment) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  return part.last_point >= 0 ? at.mesh.strain_gradient(part.last_point, SlidingMesh::At::before, at.now)
                              : at.mesh.strain_gradient(part.first_point, SlidingMesh::At::behind, at.now);
}

// The place of that strain, and the tracked point that is there.
std::pair<MaterialPoint, Index> place_in(const SlidingState& at, std::size_t segment) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  const Index point = part.last_point >= 0 ? part.last_point : part.first_point;
  return {{.strand = part.strand, .s = at.s(point)}, point};
}

// (k d/π)² of a part of a segment, its length in half waves, squared: k² = P λ/EI is the wave number of a straight part
// under the thrust P = EA (1 + e − λ), λ its stretch and e that without force. EA and EI are those at its end.
double squared_half_waves(const SlidingSetting& setting, const SlidingState& at, std::size_t segment,
                          const Stretch& part) {
  const Index strand = at.layout.segments()[segment].strand;
  const double d = part.length(), stretch = strain_in(at, segment).stretch;
  const auto [EA, EI] = setting.body.stiffness(place_in(at, segment).first);
  const double free = 1.0 + setting.body.free_strain(strand, at.now.lambda).value;
  return EA * (free - stretch) * stretch / EI * d * d / (pi * pi);
}

Row squared_half_waves_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t segment,
                                const Stretch& part, double sign) {
  const Index strand = at.layout.segments()[segment].strand;
  const AxisStrainGradient strain = strain_gradient_in(at, segment);
  const auto [here, point] = place_in(at, segment);
  const auto [EA, EI] = setting.body.stiffness(here);
  const SectionStiffness rate = setting.body.stiffness(here, 1);
  const double d = part.length(), factor = sign * EA / EI / (pi * pi), stretch = strain.stretch;
  const SlidingBody::FreeStrain heat = setting.body.free_strain(strand, at.now.lambda);
  const double free = 1.0 + heat.value, by_stretch = factor * (free - 2.0 * stretch) * d * d;
  Row row = at.no_slope();
  row.dx.head(at.index.nodes) = by_stretch * strain.stretch_dx;
  row.dx.tail(at.index.points) = by_stretch * strain.stretch_ds;
  row.dlambda = by_stretch * strain.stretch_dlambda + factor * heat.rate * stretch * d * d;
  row.dx[at.index.coordinate(point)] += factor * (free - stretch) * stretch * d * d * (rate.EA / EA - rate.EI / EI);
  const double by_length = factor * (free - stretch) * stretch * 2.0 * d * (part.is_half ? 2.0 : 1.0);
  if (part.last) row.dx[at.index.coordinate(*part.last)] += by_length;
  if (part.first) row.dx[at.index.coordinate(*part.first)] -= by_length;
  return row;
}

}  // namespace

double HalfWaveBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return 1.0 - squared_half_waves(setting, at, segment_, whole_part(setting, at, segment_));
}

Row HalfWaveBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return squared_half_waves_gradient(setting, at, segment_, whole_part(setting, at, segment_), -1.0);
}

std::vector<Transition> HalfWaveBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                   const Arrival& arrival) const {
  const Index strand = at.layout.segments()[segment_].strand;
  const int fewest = whole_part(setting, at, segment_).is_half ? 4 : 8;
  const int elements = elements_asked(setting.body, strand, 0.0, setting.body.length(strand), fewest);
  return {with_elements(setting, at, arrival.forward, segment_, elements)};
}

double StraightBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return squared_half_waves(setting, at, segment_, whole_part(setting, at, segment_)) - shortest_flat * shortest_flat;
}

Row StraightBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return squared_half_waves_gradient(setting, at, segment_, whole_part(setting, at, segment_), 1.0);
}

std::vector<Transition> StraightBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                   const Arrival& arrival) const {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment_];
  return {remeshed(setting, at, arrival.forward, [&](LayoutEdit& edit, const SlidingState&) {
    edit.elements[static_cast<std::size_t>(part.strand)][part.place].elements = 1;
    if (part.first_point >= 0 && lies_without_elements(setting, at, static_cast<std::size_t>(part.first_point)))
      edit.straighten_behind(static_cast<std::size_t>(part.first_point));
    divide_evenly(edit);
  })};
}

// Only of parts that no pressure holds on the wall.
double LoadedPartBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  if (!part_needs_no_pressure(setting, at, segment_)) return no_guard;
  return 1.0 -
         squared_half_waves(setting, at, segment_, longest_between_loads(setting, at, segment_)) / held_half_waves;
}

Row LoadedPartBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  if (!part_needs_no_pressure(setting, at, segment_)) return at.no_slope();
  return squared_half_waves_gradient(setting, at, segment_, longest_between_loads(setting, at, segment_),
                                     -1.0 / held_half_waves);
}

std::vector<Transition> LoadedPartBound::transitions(const SlidingSetting&, const SlidingState&, const Arrival&) const {
  return {unsupported("a contact zone without pressure buckles beside a point load")};
}

}  // namespace arcwall::sliding
