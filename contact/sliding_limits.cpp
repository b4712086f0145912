// What bounds a piece of sliding contact besides gaps and forces.
#include <algorithm>
#include <cmath>

#include "contact/sliding_contact.hpp"

namespace arcwall {

using Layout_ = SlidingContactLayout;
using Span = SlidingContactLayout::Span;
using Bound = SlidingContactLayout::Bound;

namespace {

constexpr double shortest_flat = 0.8;    // of a half wave, below which a flat part has one element
constexpr double nearly_upright = 0.02;  // cosine: beyond 0 the section's other corner touches, and nothing is smooth
constexpr double flatness = 0.5;  // curvature of an open point over its gap, both scaled, below which it is let go

// The sine of the angle between body and wall has this sign at an end where the gap grows from there on.
double outward(Side side, bool last) { return (side == Side::below) == last ? -1.0 : 1.0; }

// Forces of the nodes of a pressed part, its first and last node left out, less what the mesh adds at the ends: the
// part is a beam on knife edges at equal distances whose slope is held at its ends. To a pressure with the slope f′
// from edge to edge belong moments that miss those of the interior by a thirtieth of f′, from which a layer of forces
// decays,
//
//   −f′ r / (5 (2 − r)) · (−r)^j,   r = 2 − √3,   j nodes from the first.
//
// A cubic through four forces shows the force that an edge at the end itself would have, and f′ with the layer's own
// part in it.
constexpr Index fewest_for_ends = 4;

using Four = Eigen::Vector4d;
const Four at_end(4.0, -6.0, 4.0, -1.0);
const Four slope_at_end(-13.0 / 3.0, 19.0 / 2.0, -7.0, 11.0 / 6.0);

// (1 − layer) as a matrix: smooth forces from forces.
Matrix smoothing(Index count) {
  Matrix smooth = Matrix::Identity(count, count);
  if (count < fewest_for_ends) return smooth;
  const double r = 2.0 - std::sqrt(3.0);
  const double c = r / (5.0 * (2.0 - r));
  double layer = c / (1.0 - c * slope_at_end.dot(Four(1.0, -r, r * r, -r * r * r)));
  for (Index j = 0; j < count; ++j, layer *= -r) {
    smooth.row(j).head<4>() += layer * slope_at_end;
    smooth.row(count - 1 - j).tail<4>() += layer * slope_at_end.reverse();
  }
  return smooth;
}

}  // namespace

// Spans below this are none. Between two pressed parts the pressure that is left at the edges goes with the square of
// the span, and is lost in the error of the elements where these are much longer.
double SlidingContact::least_span(const SlidingContactLayout& on, std::size_t k) const {
  const bool between_parts = on.points()[k].behind == Span::free && on.span_before(k) == Span::pressed &&
                             on.points()[k + 1].behind == Span::pressed;
  return (between_parts ? 4.0 : 1.0) * least_span(on.mesh().breakpoint(static_cast<Index>(k)).first);
}

double SlidingContact::least_span(Index strand) const {
  const double L = body_.length(strand);
  return std::max(0.125 * L / body_.elements_between(strand, 0.0, L), 1e-3 * L);
}

// Where the force of a held node stands in x.
Index SlidingContact::held_force(const State& state, std::size_t node) const {
  return layout(state.piece).mesh().unknowns() + state.piece.closed_count() + static_cast<Index>(node);
}

// Forces of held nodes over the length of an element are pressures. Between the middles of the elements on both sides
// of a node the pressure is a parabola through three neighbours; the first and the last node see that at the end of the
// part, too.
SlidingContact::LeastPressure SlidingContact::least_pressure(const State& state, std::size_t node) const {
  const Layout_& on = layout(state.piece);
  const Layout_::Held& held = on.held()[node];
  const Layout_::Segment& segment = on.segments()[held.segment];
  const Index count = segment.elements - 1;
  const Index i = held.position - on.mesh().breakpoint(segment.first_point).second - 1;
  const std::size_t begin = node - static_cast<std::size_t>(i);
  const Matrix smooth = smoothing(count);
  const Vector force = smooth * state.x.segment(held_force(state, begin), count);
  LeastPressure least{.offset = 0.0, .first = begin, .weights = Vector::Unit(count, i)};
  if (count >= 3) {
    const Index middle = std::clamp(i, Index{1}, count - 2);
    const double slope = 0.5 * (force[middle + 1] - force[middle - 1]);
    const double bend = force[middle + 1] - 2.0 * force[middle] + force[middle - 1];
    const auto rise = [&](double t) { return t * (slope + 0.5 * t * bend); };
    const double a = double(i - middle) - 0.5, b = a + 1.0;
    double t = rise(a) < rise(b) ? a : b;
    if (bend > 0.0) t = std::clamp(-slope / bend, a, b);
    least.offset = t - double(i - middle);
    least.weights.setZero();
    least.weights.segment<3>(middle - 1) << 0.5 * t * (t - 1.0), 1.0 - t * t, 0.5 * t * (t + 1.0);
  }
  for (const bool last : {false, true}) {
    if (count < fewest_for_ends || i != (last ? count - 1 : 0)) continue;
    Vector end = Vector::Zero(count);
    last ? end.tail<4>() = at_end.reverse() : end.head<4>() = at_end;
    if (end.dot(force) >= least.weights.dot(force)) continue;
    least.weights = end;
    least.offset = last ? 1.0 : -1.0;
  }
  least.weights = smooth.transpose() * least.weights;
  return least;
}

double SlidingContact::least_pressure_around(const State& state, std::size_t node) const {
  const Layout_& on = layout(state.piece);
  const Layout_::Segment& segment = on.segments()[on.held()[node].segment];
  const Vector s = on.s_of(state);
  const LeastPressure least = least_pressure(state, node);
  const double force = least.weights.dot(state.x.segment(held_force(state, least.first), least.weights.size()));
  return force * segment.elements / (s[segment.last_point] - s[segment.first_point]);
}

double SlidingContact::least_pressure_place(const State& state, std::size_t node) const {
  const Layout_& on = layout(state.piece);
  const Layout_::Held& held = on.held()[node];
  const Layout_::Segment& segment = on.segments()[held.segment];
  const Vector s = on.s_of(state);
  const double h = (s[segment.last_point] - s[segment.first_point]) / segment.elements;
  return on.mesh().coordinate(held.strand, held.position, s) + least_pressure(state, node).offset * h;
}

// Which contact of a free end touches, if one does.
std::optional<std::size_t> SlidingContact::touching_end(const State& state, std::size_t which) const {
  const auto [strand, last] = Layout_::end_of(which);
  const std::size_t points = layout(state.piece).points().size();
  for (std::size_t j = 0; j < tied_.size(); ++j)
    if (tied_[j].strand == strand && tied_[j].last == last && state.piece[points + j]) return points + j;
  return std::nullopt;
}

double SlidingContact::limit_value(const State& state, std::size_t limit) const {
  const Layout_& on = layout(state.piece);
  const Vector s = on.s_of(state);
  const auto [bound, which] = on.limits()[limit];
  const auto asked = [&, which = which] {
    const Layout_::Segment& segment = on.segments()[which];
    const auto [from, to] = on.ends(body_, segment, s);
    return body_.elements_between(segment.strand, from, to);
  };
  switch (bound) {
    case Bound::curvature: {
      const double bend = curvature_gap(state, which).value * scales_.length;
      if (state.piece[which]) return bend;
      const Touch at = touch(on, which);
      return bend -
             flatness * face_gap(at, on.mesh().node(at.strand, at.position, mesh_state_of(state))) / scales_.length;
    }
    case Bound::length: {
      const auto k = static_cast<Index>(which);
      return (s[k + 1] - s[k] - least_span(on, which)) / scales_.length;
    }
    case Bound::coarse:
      return coarsest - asked() / on.segments()[which].elements;
    case Bound::fine:
      return asked() / on.segments()[which].elements - finest;
    case Bound::half_wave:
    case Bound::straight: {
      // (k d/π)², k² = P λ/EI the wave number of a straight part under the thrust P
      const Layout_::Segment& segment = on.segments()[which];
      const Index k = segment.last_point;
      const double d = s[k] - s[k - 1],
                   stretch = on.mesh().strain(k, SlidingMesh::At::before, mesh_state_of(state)).stretch;
      const double EA = body_.axial_stiffness(segment.strand), EI = body_.bending_stiffness(segment.strand);
      const double waves = EA * (1.0 - stretch) * stretch / EI * d * d / (pi * pi);
      return bound == Bound::half_wave ? 1.0 - waves : waves - shortest_flat * shortest_flat;
    }
    case Bound::room:
      return asked() - 0.5;
    case Bound::pressure:
      return least_pressure_around(state, which) * scales_.length / scales_.force;
    case Bound::lies: {
      // How fast the gap grows from the end on.
      const auto j = touching_end(state, which);
      if (!j) break;
      const Tied& end = tied_[*j - on.points().size()];
      return outward(obstacles_[end.obstacle].side, end.last) *
             std::sin(node_gap(touch(on, *j), mesh_state_of(state), on).angle);
    }
    case Bound::upright: {
      const auto j = touching_end(state, which);
      const Touch at = j ? touch(on, *j) : Touch{};
      if (!j || at.offset == 0.0 || tied_[*j - on.points().size()].travel == 0.0) break;
      return tied_[*j - on.points().size()].travel *
                 std::cos(on.mesh().node(at.strand, at.position, mesh_state_of(state)).angle) -
             nearly_upright;
    }
  }
  return 1.0;
}

Row SlidingContact::limit_gradient(const State& state, std::size_t limit) const {
  const Layout_& on = layout(state.piece);
  const Vector s = on.s_of(state);
  const auto [bound, which] = on.limits()[limit];
  const Index n = on.mesh().unknowns(), first_s = state.x.size() - s.size();
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  const auto by_ends = [&, which = which](double factor) {
    const Layout_::Segment& segment = on.segments()[which];
    const auto [from, to] = on.ends(body_, segment, s);
    const double step = 1e-6 * body_.length(segment.strand);
    const auto density = [&](double S) {
      return body_.elements_between(segment.strand, S - step, S + step) / (2.0 * step) * factor;
    };
    if (segment.first_point >= 0) row.dx[first_s + segment.first_point] = -density(from);
    if (segment.last_point >= 0) row.dx[first_s + segment.last_point] = density(to);
  };
  switch (bound) {
    case Bound::curvature: {
      const CurvatureGap gap = curvature_gap(state, which);
      row.dx.head(n) = scales_.length * gap.dx;
      row.dx.tail(s.size()) = scales_.length * gap.ds;
      row.dlambda = scales_.length * gap.dlambda;
      if (state.piece[which]) break;
      const Touch at = touch(on, which);
      const Eigen::Vector3d by_gap = flatness / scales_.length * node_gap(at, mesh_state_of(state), on).gap_gradient;
      const NodeUnknowns unknowns = on.mesh().node_unknowns(at.strand, at.position);
      for (std::size_t i = 0; i < 3; ++i)
        if (unknowns[i] >= 0) row.dx[unknowns[i]] -= by_gap[static_cast<Index>(i)];
      break;
    }
    case Bound::length:
      row.dx[first_s + static_cast<Index>(which)] = -1.0 / scales_.length;
      row.dx[first_s + static_cast<Index>(which) + 1] = 1.0 / scales_.length;
      break;
    case Bound::coarse:
      by_ends(-1.0 / on.segments()[which].elements);
      break;
    case Bound::fine:
      by_ends(1.0 / on.segments()[which].elements);
      break;
    case Bound::half_wave:
    case Bound::straight: {
      const Layout_::Segment& segment = on.segments()[which];
      const Index k = segment.last_point;
      const AxisStrain strain = on.mesh().strain(k, SlidingMesh::At::before, mesh_state_of(state));
      const double EA = body_.axial_stiffness(segment.strand), EI = body_.bending_stiffness(segment.strand);
      const double sign = bound == Bound::half_wave ? -1.0 : 1.0, d = s[k] - s[k - 1];
      const double factor = sign * EA / EI / (pi * pi), stretch = strain.stretch;
      const double by_stretch = factor * (1.0 - 2.0 * stretch) * d * d;
      row.dx.head(n) = by_stretch * strain.stretch_dx;
      row.dx.tail(s.size()) = by_stretch * strain.stretch_ds;
      row.dlambda = by_stretch * strain.stretch_dlambda;
      row.dx[first_s + k] += factor * (1.0 - stretch) * stretch * 2.0 * d;
      row.dx[first_s + k - 1] -= factor * (1.0 - stretch) * stretch * 2.0 * d;
      break;
    }
    case Bound::room:
      by_ends(1.0);
      break;
    case Bound::pressure: {
      // The place of the least pressure moves, which at a least one, or at the end of its range, has no part in this.
      const Layout_::Segment& segment = on.segments()[on.held()[which].segment];
      const LeastPressure least = least_pressure(state, which);
      const double span = s[segment.last_point] - s[segment.first_point];
      const double per_force = scales_.length * segment.elements / (span * scales_.force);
      const Index first = held_force(state, least.first), count = least.weights.size();
      const double p = least.weights.dot(state.x.segment(first, count));
      row.dx.segment(first, count) = per_force * least.weights;
      row.dx[first_s + segment.last_point] = -per_force * p / span;
      row.dx[first_s + segment.first_point] = per_force * p / span;
      break;
    }
    case Bound::lies: {
      const auto j = touching_end(state, which);
      if (!j) break;
      const Tied& end = tied_[*j - on.points().size()];
      const Touch at = touch(on, *j);
      const NodeGap gap = node_gap(at, mesh_state_of(state), on);
      const Eigen::Vector3d gradient =
          outward(obstacles_[end.obstacle].side, end.last) * std::cos(gap.angle) * gap.tilt_gradient;
      const NodeUnknowns unknowns = on.mesh().node_unknowns(at.strand, at.position);
      for (std::size_t i = 0; i < 3; ++i)
        if (unknowns[i] >= 0) row.dx[unknowns[i]] = gradient[static_cast<Index>(i)];
      break;
    }
    case Bound::upright: {
      const auto j = touching_end(state, which);
      const Touch at = j ? touch(on, *j) : Touch{};
      if (!j || at.offset == 0.0) break;
      const Index turn = on.mesh().node_unknowns(at.strand, at.position)[2];
      if (turn >= 0)
        row.dx[turn] = -tied_[*j - on.points().size()].travel *
                       std::sin(on.mesh().node(at.strand, at.position, mesh_state_of(state)).angle);
      break;
    }
  }
  return row;
}

}  // namespace arcwall
