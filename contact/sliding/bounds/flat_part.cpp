#include "contact/sliding/bounds/flat_part.hpp"

#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/spans.hpp"

namespace arcwall::sliding {

namespace {

constexpr double shortest_flat = 0.8;  // of a half wave, below which a flat part has one element

// (k d/π)² of a flat part, its length in half waves, squared: k² = P λ/EI is the wave number of a straight part under
// the thrust P = EA (1 + e − λ), λ its stretch and e that without force.
double squared_half_waves(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  const Index k = part.last_point;
  const double d = at.s(k) - at.s(k - 1), stretch = at.mesh.strain(k, SlidingMesh::At::before, at.now).stretch;
  const double EA = setting.body.axial_stiffness(part.strand), EI = setting.body.bending_stiffness(part.strand);
  const double free = 1.0 + setting.body.free_strain(part.strand, at.now.lambda).value;
  return EA * (free - stretch) * stretch / EI * d * d / (pi * pi);
}

Row squared_half_waves_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t segment,
                                double sign) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  const Index k = part.last_point;
  const AxisStrain strain = at.mesh.strain(k, SlidingMesh::At::before, at.now);
  const double EA = setting.body.axial_stiffness(part.strand), EI = setting.body.bending_stiffness(part.strand);
  const double d = at.s(k) - at.s(k - 1), factor = sign * EA / EI / (pi * pi), stretch = strain.stretch;
  const SlidingBody::FreeStrain heat = setting.body.free_strain(part.strand, at.now.lambda);
  const double free = 1.0 + heat.value, by_stretch = factor * (free - 2.0 * stretch) * d * d;
  Row row = at.no_slope();
  row.dx.head(at.index.nodes) = by_stretch * strain.stretch_dx;
  row.dx.tail(at.index.points) = by_stretch * strain.stretch_ds;
  row.dlambda = by_stretch * strain.stretch_dlambda + factor * heat.rate * stretch * d * d;
  row.dx[at.index.coordinate(k)] += factor * (free - stretch) * stretch * 2.0 * d;
  row.dx[at.index.coordinate(k - 1)] -= factor * (free - stretch) * stretch * 2.0 * d;
  return row;
}

}  // namespace

double HalfWaveBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return 1.0 - squared_half_waves(setting, at, segment_);
}

Row HalfWaveBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return squared_half_waves_gradient(setting, at, segment_, -1.0);
}

std::vector<Transition> HalfWaveBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                   const Arrival& arrival) const {
  const Index strand = at.layout.segments()[segment_].strand;
  const int elements = elements_asked(setting.body, strand, 0.0, setting.body.length(strand), 8);
  return {with_elements(setting, at, arrival.forward, segment_, elements)};
}

double StraightBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return squared_half_waves(setting, at, segment_) - shortest_flat * shortest_flat;
}

Row StraightBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return squared_half_waves_gradient(setting, at, segment_, 1.0);
}

std::vector<Transition> StraightBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                   const Arrival& arrival) const {
  return {with_elements(setting, at, arrival.forward, segment_, 1)};
}

}  // namespace arcwall::sliding
