#include "contact/sliding/bounds/curvature.hpp"

#include "contact/sliding/bending.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/spreading.hpp"

namespace arcwall::sliding {

namespace {

// Curvature of an open point over its gap, both scaled, below which it is given up; the more, the farther it is from
// its wall: a node that no contact needs makes the mesh of a symmetric body unsymmetric.
constexpr double flatness = 0.5, far_off = 0.003;

double allowed_gap(double gap) { return flatness * gap * (1.0 + gap * gap / (far_off * far_off)); }
double allowed_gap_slope(double gap) { return flatness * (1.0 + 3.0 * gap * gap / (far_off * far_off)); }

}  // namespace

double CurvatureBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const double bend = curvature_gap(setting, at, point_) * setting.scales.length;
  if (at.is_closed(point_)) return bend;
  const double gap = face_gap(setting, touch_of_contact(setting, at.layout, point_), at);
  return bend - allowed_gap(gap / setting.scales.length);
}

Row CurvatureBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  curvature_gap_gradient(setting, at, point_).add_to(row, setting.scales.length, at.index);
  if (at.is_closed(point_)) return row;
  const Touch touch = touch_of_contact(setting, at.layout, point_);
  const NodeFunction gap = touch_gap(setting, touch, at).gap;
  const double by_gap = -allowed_gap_slope(gap.value / setting.scales.length) / setting.scales.length;
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), by_gap * gap.gradient, row.dx);
  row.dlambda += by_gap * gap.rate;
  return row;
}

std::vector<Transition> CurvatureBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                    const Arrival& arrival) const {
  if (at.is_closed(point_)) return points_to_lines(setting, at, arrival);
  return {without_point(setting, at, arrival.forward, point_)};
}

}  // namespace arcwall::sliding
