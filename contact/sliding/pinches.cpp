#include "contact/sliding/pinches.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/least_gaps.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/tolerances.hpp"
#include "core/unit_tangent.hpp"

namespace arcwall::sliding {

namespace {

const Pinch& pinch_of(const SlidingSetting& setting, const SlidingContactLayout& on, std::size_t point) {
  return setting.pinches[on.points()[point].pinch.value()];
}

// A linear function of a node's place: its distance along a direction from a place.
NodeFunction distance(const Vec2& position, const Vec2& from, const Vec2& along) {
  NodeFunction f{.value = along.dot(position - from)};
  f.gradient << along.x(), along.y(), 0.0;
  return f;
}

}  // namespace

bool holds_direction(const SlidingSetting& setting, const SlidingContactLayout& on, std::size_t point) {
  return pinch_of(setting, on, point).holds_direction();
}

OffPinch off_pinch(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Pinch& pinch = pinch_of(setting, at.layout, point);
  const AxisPlace axis = touch_of_contact(setting, at.layout, point).axis(at);
  OffPinch off{.across = distance(axis.position, pinch.place, pinch.normal),
               .along = distance(axis.position, pinch.place, unit_tangent(pinch.angle)),
               .turned = {.value = axis.angle - pinch.angle}};
  off.turned.gradient[2] = 1.0;
  return off;
}

namespace {

// E = N Λ + M κ − N²/2EA − M²/2EI with its derivatives EA Λ by the stretch and EI κ by the curvature. What the strain
// and the curvature without force contribute is the same on both sides of a point, and left out.
void add_material_energy(const SlidingSetting& setting, const SlidingState& at, std::size_t point, SlidingMesh::At side,
                         double sign, BorderEquation& to) {
  const SlidingBody& body = setting.body;
  const auto k = static_cast<Index>(point);
  const Index strand = at.mesh.breakpoint(k).first;
  const AxisStrainGradient strain = at.mesh.strain_gradient(k, side, at.now);
  const MaterialPoint here{.strand = strand, .s = at.s(k)};
  const auto [EA, EI] = body.stiffness(here);
  const double N = EA * (strain.stretch - 1.0 - body.free_strain(strand, at.now.lambda).value);
  const double natural = body.natural_curvature(here, at.now.lambda);
  const double M = EI * (strain.curvature - natural);
  to.value += sign * (N * strain.stretch - 0.5 * N * N / EA + M * strain.curvature - 0.5 * M * M / EI);
  const double by_stretch = sign * EA * strain.stretch, by_curvature = sign * EI * strain.curvature;
  to.row.dx.head(at.index.nodes) += by_stretch * strain.stretch_dx + by_curvature * strain.curvature_dx;
  to.row.dx.tail(at.index.points) += by_stretch * strain.stretch_ds + by_curvature * strain.curvature_ds;
  to.row.dlambda += by_stretch * strain.stretch_dlambda + by_curvature * strain.curvature_dlambda;
  const SectionStiffness rate = body.stiffness(here, 1);
  to.row.dx[at.index.coordinate(k)] += sign * ((N * strain.stretch - 0.5 * N * N / EA) * rate.EA / EA +
                                               (M * strain.curvature - 0.5 * M * M / EI) * rate.EI / EI);
}

}  // namespace

BorderEquation energy_by_sliding(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  BorderEquation equation{.row = at.no_slope()};
  add_material_energy(setting, at, point, SlidingMesh::At::behind, 1.0, equation);
  add_material_energy(setting, at, point, SlidingMesh::At::before, -1.0, equation);
  return equation;
}

std::vector<std::size_t> obstacles_at(const SlidingSetting& setting, const SlidingContactLayout& on,
                                      std::size_t point) {
  if (!on.is_pinched(point)) return {on.points()[point].obstacle};
  const Pinch& pinch = pinch_of(setting, on, point);
  return {pinch.obstacle, pinch.other};
}

bool touches(const SlidingSetting& setting, const SlidingContactLayout& on, std::size_t point, std::size_t obstacle) {
  if (!on.is_pinched(point)) return on.points()[point].obstacle == obstacle;
  const Pinch& pinch = pinch_of(setting, on, point);
  return pinch.obstacle == obstacle || pinch.other == obstacle;
}

CurvatureGap curvature_gap_beside(const SlidingSetting& setting, const SlidingState& at, std::size_t point, bool other,
                                  SlidingMesh::At side) {
  const auto [strand, position] = at.mesh.breakpoint(static_cast<Index>(point));
  const std::size_t obstacle = obstacles_at(setting, at.layout, point)[other ? 1 : 0];
  const Touch touch{
      .strand = strand, .position = position, .obstacle = obstacle, .offset = setting.face_offset(obstacle, strand)};
  const AxisStrainGradient strain = at.mesh.strain_gradient(static_cast<Index>(point), side, at.now);
  return gap_of_curvatures_gradient(setting, at, touch, strain);
}

namespace {

// 1 where an axis of this direction runs with the surface at a corner, −1 where it runs against it.
double sense_along(const SharpCorner& corner, const Vec2& axis) {
  return axis.dot(corner.before + corner.behind) >= 0.0 ? 1.0 : -1.0;
}

}  // namespace

// The surface turns to the right at its corner, and the body goes through it at a direction between.
FlankAngle angle_to_flank(const SlidingSetting& setting, const SlidingState& at, std::size_t point, bool other,
                          SlidingMesh::At side) {
  const SharpCorner& corner = (*pinch_of(setting, at.layout, point).knife_edges)[other ? 1 : 0];
  const Vec2 axis = unit_tangent(touch_of_contact(setting, at.layout, point).axis(at).angle);
  const Vec2 along = sense_along(corner, axis) * axis;
  if (side == SlidingMesh::At::before) return {.value = turn_between(along, corner.before), .by_rotation = -1.0};
  return {.value = turn_between(corner.behind, along), .by_rotation = 1.0};
}

// Without friction the force of knife edges is across the axis, whichever way this has turned.
PinchingForce pinching_force(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Pinch& pinch = pinch_of(setting, at.layout, point);
  const double across = at.force(point);
  if (pinch.holds_direction()) return {.value = across, .vector = across * pinch.normal};
  const auto& pinched = at.layout.pinched_points();
  const auto number = static_cast<std::size_t>(std::find(pinched.begin(), pinched.end(), point) - pinched.begin());
  const Vec2 vector = across * pinch.normal + at.state.x[at.index.force_along(number)] * unit_tangent(pinch.angle);
  Vec2 normal = perp(unit_tangent(touch_of_contact(setting, at.layout, point).axis(at).angle));
  if (normal.dot(pinch.normal) < 0.0) normal = -normal;
  return {.value = vector.dot(normal), .vector = vector};
}

namespace {

// Where a strand at rest touches an obstacle at a point: at a sharp corner, if it does so there.
struct TouchAtRest {
  MaterialPoint at{};
  std::size_t obstacle = 0;
  Vec2 normal = Vec2::Zero();
  std::optional<SharpCorner> corner{};
};

bool stands_still(const SlidingSetting& setting, std::size_t obstacle) {
  return setting.obstacles[obstacle].surface->greatest_speed(setting.scales.length) == 0.0;
}

// The place of an element whose normal goes through a position; empty where it has none.
std::optional<MaterialPoint> foot_in_element(const SlidingState& rest, Index strand, Index element,
                                             const Vec2& position) {
  constexpr double enough = 1e-14;  // of the element
  const auto ahead = [&](double fraction) {
    const AxisPlace place = rest.mesh.inside(strand, element, fraction, rest.now);
    return unit_tangent(place.angle).dot(place.position - position);
  };
  double from = 0.0, to = 1.0;
  if (ahead(from) > 0.0 || ahead(to) < 0.0) return std::nullopt;
  while (to - from > enough) {
    const double middle = 0.5 * (from + to);
    (ahead(middle) < 0.0 ? from : to) = middle;
  }
  const double first = rest.mesh.coordinate(strand, element, rest.now.s);
  const double last = rest.mesh.coordinate(strand, element + 1, rest.now.s);
  return MaterialPoint{.strand = strand, .s = first + 0.5 * (from + to) * (last - first)};
}

// Where strands at rest go through sharp corners, between the directions of their flanks.
std::vector<TouchAtRest> touches_at_corners(const SlidingSetting& setting, const SlidingState& rest, double touching) {
  std::vector<TouchAtRest> touches;
  for (std::size_t w = 0; w < setting.obstacles.size(); ++w) {
    if (!stands_still(setting, w)) continue;
    for (const SharpCorner& corner : setting.obstacles[w].surface->sharp_corners())
      for (Index strand = 0; strand < setting.body.strands(); ++strand) {
        if (!setting.obstacles[w].concerns(strand)) continue;
        for (Index element = 0; element + 1 < rest.mesh.nodes(strand); ++element) {
          const auto foot = foot_in_element(rest, strand, element, corner.place);
          if (!foot) continue;
          const AxisPlace place = rest.mesh.place(*foot, rest.now);
          const Vec2 along = sense_along(corner, unit_tangent(place.angle)) * unit_tangent(place.angle);
          if ((place.position - corner.place).norm() > touching || cross(along, corner.before) <= 0.0 ||
              cross(corner.behind, along) <= 0.0)
            continue;
          touches.push_back({.at = *foot, .obstacle = w, .normal = perp(along), .corner = corner});
        }
      }
  }
  return touches;
}

std::vector<TouchAtRest> touches_at_rest(const SlidingSetting& setting, const SlidingState& rest) {
  const double touching = touching_at_rest * setting.scales.length;
  std::vector<TouchAtRest> touches = touches_at_corners(setting, rest, touching);
  for (const LeastGap& least : least_gaps(setting, rest)) {
    const Obstacle& obstacle = *setting.obstacles[least.obstacle].surface;
    if (std::abs(least.gap) > touching || !stands_still(setting, least.obstacle)) continue;
    const Vec2 place = face(setting.face_offset(least.obstacle, least.at.strand), rest.mesh.place(least.at, rest.now));
    const std::vector<SharpCorner> corners = obstacle.sharp_corners();
    const auto is_here = [&](const SharpCorner& corner) { return (corner.place - place).norm() <= 2.0 * touching; };
    if (std::any_of(corners.begin(), corners.end(), is_here)) continue;
    touches.push_back({.at = least.at, .obstacle = least.obstacle, .normal = obstacle.normal(place, 0.0)});
  }
  return touches;
}

// Whether two touches are one place where the obstacles press against each other.
bool are_opposite(const TouchAtRest& a, const TouchAtRest& b, double length) {
  return a.at.strand == b.at.strand && std::abs(a.at.s - b.at.s) <= touching_on_path * length &&
         a.corner.has_value() == b.corner.has_value() && 1.0 + a.normal.dot(b.normal) <= exactly_parallel;
}

}  // namespace

std::vector<Pinch> pinches_at_rest(const SlidingSetting& setting, const SlidingState& rest) {
  if (setting.obstacles.size() < 2) return {};
  const std::vector<TouchAtRest> touches = touches_at_rest(setting, rest);
  std::vector<Pinch> pinches;
  const auto is_known = [&](const TouchAtRest& touch) {
    return std::any_of(pinches.begin(), pinches.end(), [&](const Pinch& pinch) {
      const double L = setting.body.length(touch.at.strand);
      return pinch.strand == touch.at.strand && std::abs(pinch.s - touch.at.s) <= touching_on_path * L;
    });
  };
  for (const TouchAtRest& a : touches)
    for (const TouchAtRest& b : touches) {
      if (a.obstacle >= b.obstacle || is_known(a)) continue;
      if (!are_opposite(a, b, setting.body.length(a.at.strand))) continue;
      const MaterialPoint middle{.strand = a.at.strand, .s = 0.5 * (a.at.s + b.at.s)};
      const AxisPlace axis = rest.mesh.place(middle, rest.now);
      pinches.push_back({.strand = middle.strand,
                         .s = middle.s,
                         .obstacle = a.obstacle,
                         .other = b.obstacle,
                         .place = axis.position,
                         .angle = axis.angle,
                         .normal = a.normal});
      if (a.corner) pinches.back().knife_edges = {*a.corner, *b.corner};
    }
  std::sort(pinches.begin(), pinches.end(),
            [](const Pinch& a, const Pinch& b) { return a.strand != b.strand ? a.strand < b.strand : a.s < b.s; });
  return pinches;
}

ActiveSet pinched_active_set(const SlidingSetting& setting, const SlidingState& rest) {
  LayoutEdit edit = edit_of(setting.body, rest);
  for (std::size_t i = 0; i < setting.pinches.size(); ++i) {
    const Pinch& pinch = setting.pinches[i];
    const LayoutEdit::Part part = edit.part_at(pinch.strand, pinch.s);
    const int all = std::max(2, edit.elements[static_cast<std::size_t>(pinch.strand)][part.place].elements);
    const int before =
        std::clamp(static_cast<int>(std::lround(all * (pinch.s - part.from) / (part.to - part.from))), 1, all - 1);
    edit.insert(
        {.point = {.obstacle = pinch.obstacle, .pinch = i}, .strand = pinch.strand, .s = pinch.s, .closed = true},
        before, all - before);
  }
  return mapped_onto(setting, rest, edit, layout_of(edit)).active_set;
}

}  // namespace arcwall::sliding
