#include "contact/sliding/pinches.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/least_gaps.hpp"
#include "contact/sliding/remeshing.hpp"

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

OffPinch off_pinch(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Pinch& pinch = pinch_of(setting, at.layout, point);
  const AxisPlace axis = touch_of_contact(setting, at.layout, point).axis(at);
  OffPinch off{.across = distance(axis.position, pinch.place, pinch.normal),
               .along = distance(axis.position, pinch.place, {std::cos(pinch.angle), std::sin(pinch.angle)}),
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
  const AxisStrain strain = at.mesh.strain(k, side, at.now);
  const double EA = body.axial_stiffness(strand), EI = body.bending_stiffness(strand);
  const double N = EA * (strain.stretch - 1.0 - body.free_strain(strand, at.now.lambda).value);
  const double natural = body.natural_curvature({.strand = strand, .s = at.s(k)}, at.now.lambda);
  const double M = EI * (strain.curvature - natural);
  to.value += sign * (N * strain.stretch - 0.5 * N * N / EA + M * strain.curvature - 0.5 * M * M / EI);
  const double by_stretch = sign * EA * strain.stretch, by_curvature = sign * EI * strain.curvature;
  to.row.dx.head(at.index.nodes) += by_stretch * strain.stretch_dx + by_curvature * strain.curvature_dx;
  to.row.dx.tail(at.index.points) += by_stretch * strain.stretch_ds + by_curvature * strain.curvature_ds;
  to.row.dlambda += by_stretch * strain.stretch_dlambda + by_curvature * strain.curvature_dlambda;
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

CurvatureGap curvature_gap_beside(const SlidingSetting& setting, const SlidingState& at, std::size_t point,
                                  std::size_t obstacle, SlidingMesh::At side) {
  const auto [strand, position] = at.mesh.breakpoint(static_cast<Index>(point));
  const Touch touch{
      .strand = strand, .position = position, .obstacle = obstacle, .offset = setting.face_offset(obstacle, strand)};
  return gap_of_curvatures(setting, at, touch, at.mesh.strain(static_cast<Index>(point), side, at.now));
}

namespace {

// Where a strand at rest touches an obstacle at a point.
struct TouchAtRest {
  MaterialPoint at{};
  std::size_t obstacle = 0;
  Vec2 normal = Vec2::Zero();
};

std::vector<TouchAtRest> touches_at_rest(const SlidingSetting& setting, const SlidingState& rest) {
  constexpr double touching = 1e-9;  // of the length scale
  std::vector<TouchAtRest> touches;
  for (const LeastGap& least : least_gaps(setting, rest)) {
    const SlidingObstacle& obstacle = setting.obstacles[least.obstacle];
    if (std::abs(least.gap) > touching * setting.scales.length) continue;
    if (obstacle.surface->greatest_speed(setting.scales.length) > 0.0) continue;
    const Vec2 place = face(setting.face_offset(least.obstacle, least.at.strand), rest.mesh.place(least.at, rest.now));
    touches.push_back({.at = least.at, .obstacle = least.obstacle, .normal = obstacle.surface->normal(place, 0.0)});
  }
  return touches;
}

// Whether two touches are one place where the obstacles press against each other.
bool are_opposite(const TouchAtRest& a, const TouchAtRest& b, double length) {
  constexpr double near = 1e-6, opposite = 1e-9;  // of the length; of the normals
  return a.at.strand == b.at.strand && std::abs(a.at.s - b.at.s) <= near * length &&
         1.0 + a.normal.dot(b.normal) <= opposite;
}

}  // namespace

std::vector<Pinch> pinches_at_rest(const SlidingSetting& setting, const SlidingState& rest) {
  if (setting.obstacles.size() < 2) return {};
  const std::vector<TouchAtRest> touches = touches_at_rest(setting, rest);
  std::vector<Pinch> pinches;
  const auto is_known = [&](const TouchAtRest& touch) {
    return std::any_of(pinches.begin(), pinches.end(), [&](const Pinch& pinch) {
      const double L = setting.body.length(touch.at.strand);
      return pinch.strand == touch.at.strand && std::abs(pinch.s - touch.at.s) <= 1e-6 * L;
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
    }
  std::sort(pinches.begin(), pinches.end(),
            [](const Pinch& a, const Pinch& b) { return a.strand != b.strand ? a.strand < b.strand : a.s < b.s; });
  return pinches;
}

Piece pinched_piece(const SlidingSetting& setting, const SlidingState& rest) {
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
  return mapped_onto(setting, rest, edit, layout_of(edit)).piece;
}

}  // namespace arcwall::sliding
