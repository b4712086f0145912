#include "contact/sliding/bounds/edge_presses.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/bounds/pressure.hpp"
#include "contact/sliding/lifting.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

namespace {

using Span = SlidingContactLayout::Span;

// Why the edge pulls, by the element beside it and by the length within which the body bends there.
std::string why_it_pulls(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Index strand = at.layout.mesh().breakpoint(static_cast<Index>(point)).first;
  const Index position = at.layout.mesh().breakpoint(static_cast<Index>(point)).second;
  const bool ahead = at.layout.points()[point].behind == Span::free;
  const auto coordinate = [&](Index node) { return at.mesh.coordinate(strand, node, at.now.s); };
  const double element = std::abs(coordinate(position + (ahead ? 1 : -1)) - coordinate(position));
  const double stretch =
      at.mesh.node_strain(strand, position, ahead ? SlidingMesh::At::behind : SlidingMesh::At::before, at.now).stretch;
  const double strain = stretch - 1.0 - setting.body.free_strain(strand, at.now.lambda).value;
  const SectionStiffness section = setting.body.stiffness({.strand = strand, .s = coordinate(position)});
  const double tension = section.EA * strain, length = setting.body.length(strand);
  std::ostringstream why;
  why << "the wall would have to pull at the edge of contact, which no wall does: the mesh is too coarse";
  if (tension <= 0.0) return why.str();
  const double layer = std::sqrt(section.EI / tension);
  if (layer >= element) return why.str();
  why << std::setprecision(3) << " there. The tension " << tension
      << " lets the member bend within sqrt(EI/N) = " << layer << " of the edge, and its elements are " << element
      << " long: it needs " << std::setprecision(0) << std::fixed << std::ceil(length / layer) << " elements";
  return why.str();
}

}  // namespace

bool must_press(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  return at.is_closed(point) && at.layout.lies_pressed(point) &&
         (at.layout.points()[point].behind == Span::free || at.layout.span_before(point) == Span::free) &&
         obstacle_is_straight(setting, at, point) && required_pressure_above_roundoff(setting, at, point) > 0.0;
}

double EdgePressesBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return must_press(setting, at, point_) ? at.force(point_) / setting.scales.force : no_guard;
}

Row EdgePressesBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  if (must_press(setting, at, point_)) row.dx[*at.index.force(point_)] = 1.0 / setting.scales.force;
  return row;
}

// Where the load vanishes so does the edge's force.
std::vector<Transition> EdgePressesBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                      const Arrival& arrival) const {
  if (!reached<PressureBound>(setting, at, arrival).empty()) return parts_lift_off(setting, at, arrival);
  return {unsupported(why_it_pulls(setting, at, point_))};
}

}  // namespace arcwall::sliding
