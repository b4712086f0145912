// Gaps, tilts and curvatures between the body and the walls, and what would hold the one on the other.
#include <cmath>

#include "contact/sliding_contact.hpp"

namespace arcwall {

using Span = SlidingContactLayout::Span;

namespace {

Vec2 normal(double angle) { return {-std::sin(angle), std::cos(angle)}; }
Vec2 tangent(double angle) { return {std::cos(angle), std::sin(angle)}; }

// Slope angle of a wall and its curvature, with derivatives by x.
struct Bend {
  double angle, angle_x, angle_xx, curvature, curvature_x;
};

Bend bend(const Profile& profile, double x) {
  const Height psi = profile.at(x);
  const double w = 1.0 + psi.first * psi.first, root = std::sqrt(w);
  return {.angle = std::atan(psi.first),
          .angle_x = psi.second / w,
          .angle_xx = psi.third / w - 2.0 * psi.first * psi.second * psi.second / (w * w),
          .curvature = psi.second / (w * root),
          .curvature_x = psi.third / (w * root) - 3.0 * psi.first * psi.second * psi.second / (w * w * root)};
}

// Where the body does not lie on the wall; before a point contact.
SlidingMesh::At free_side(const SlidingContactLayout& on, std::size_t point) {
  return on.span_before(point) == Span::free ? SlidingMesh::At::before : SlidingMesh::At::behind;
}

double sign_of(Side side) { return side == Side::below ? 1.0 : -1.0; }

}  // namespace

// The point of a section that looks at a wall: its normal looks along the wall's or against it, with the direction of
// travel.
Vec2 SlidingContact::face(double offset, const AxisPlace& place) {
  return place.position + (std::cos(place.angle) >= 0.0 ? offset : -offset) * normal(place.angle);
}

// Of the face that looks at the obstacle, along the wall's normal (upwards).
double SlidingContact::normal_offset(std::size_t obstacle, Index strand) const {
  return obstacles_[obstacle].on_face ? -sign_of(obstacles_[obstacle].side) * body_.half_height(strand) : 0.0;
}

SlidingContact::Touch SlidingContact::touch(const SlidingContactLayout& on, std::size_t j) const {
  if (j < on.points().size()) {
    const auto [strand, position] = on.mesh().breakpoint(static_cast<Index>(j));
    const std::size_t obstacle = on.points()[j].obstacle;
    return {.strand = strand, .position = position, .obstacle = obstacle, .offset = normal_offset(obstacle, strand)};
  }
  const Tied& end = tied_[j - on.points().size()];
  return {.strand = end.strand,
          .position = end.last ? on.mesh().nodes(end.strand) - 1 : 0,
          .obstacle = end.obstacle,
          .offset = normal_offset(end.obstacle, end.strand)};
}

double SlidingContact::face_gap(const Touch& touch, const AxisPlace& place) const {
  const Vec2 at = face(touch.offset, place);
  const Obstacle& obstacle = obstacles_[touch.obstacle];
  return obstacle.profile->covers(at.x()) ? surface_gap(*obstacle.profile, obstacle.side, at).value : infinity;
}

// The face r + o n(θ) with ∂n/∂θ = −t; the tilt is θ − φ(x of the face), φ the wall's slope.
SlidingContact::NodeGap SlidingContact::node_gap(const Touch& touch, const MeshState& now,
                                                 const SlidingContactLayout& on) const {
  const AxisPlace place = on.mesh().node(touch.strand, touch.position, now);
  const Obstacle& obstacle = obstacles_[touch.obstacle];
  const Vec2 n = normal(place.angle), t = tangent(place.angle);
  const double o = t.x() >= 0.0 ? touch.offset : -touch.offset;
  const Vec2 face = place.position + o * n;
  const SurfaceGap g = surface_gap(*obstacle.profile, obstacle.side, face);
  const Bend wall = bend(*obstacle.profile, face.x());

  NodeGap out;
  out.gap = g.value;
  out.angle = place.angle - wall.angle;
  out.tilt = std::remainder(out.angle, pi);
  out.gap_gradient << g.x, g.z, -o * (g.x * t.x() + g.z * t.y());
  out.tilt_gradient << -wall.angle_x, 0.0, 1.0 + wall.angle_x * o * t.x();
  const double sway = o * t.x();  // of the face against x, by angle
  out.tilt_hessian.setZero();
  out.tilt_hessian(0, 0) = -wall.angle_xx;
  out.tilt_hessian(0, 2) = out.tilt_hessian(2, 0) = wall.angle_xx * sway;
  out.tilt_hessian(2, 2) = -wall.angle_xx * sway * sway + wall.angle_x * o * n.x();
  out.gap_hessian.setZero();
  out.gap_hessian(0, 0) = g.xx;
  out.gap_hessian(0, 1) = out.gap_hessian(1, 0) = g.xz;
  out.gap_hessian(0, 2) = out.gap_hessian(2, 0) = -o * (g.xx * t.x() + g.xz * t.y());
  out.gap_hessian(1, 2) = out.gap_hessian(2, 1) = -o * g.xz * t.x();
  out.gap_hessian(2, 2) = o * o * (g.xx * t.x() * t.x() + 2.0 * g.xz * t.x() * t.y()) - o * (g.x * n.x() + g.z * n.y());
  return out;
}

// ± (κ − λ κ̂): κ the body's curvature and λ its stretch by stress-free length, κ̂ the curvature of the curve at the
// face's distance from the wall, on which the axis would lie. Travel against x turns the sign of κ.
SlidingContact::CurvatureGap SlidingContact::curvature_gap(const State& state, std::size_t k) const {
  const SlidingContactLayout& on = layout(state.piece);
  const MeshState now = mesh_state_of(state);
  const Touch at = touch(on, k);
  const AxisPlace place = on.mesh().node(at.strand, at.position, now);
  const double travel = std::cos(place.angle) >= 0.0 ? 1.0 : -1.0, offset = travel * at.offset;
  const double side = sign_of(obstacles_[at.obstacle].side);
  const AxisStrain strain = on.mesh().strain(static_cast<Index>(k), free_side(on, k), now);
  const Bend wall = bend(*obstacles_[at.obstacle].profile, (place.position + offset * normal(place.angle)).x());
  const double shrink = 1.0 / (1.0 + at.offset * wall.curvature);
  const double parallel = wall.curvature * shrink, parallel_x = wall.curvature_x * shrink * shrink;

  CurvatureGap out{.value = side * (travel * strain.curvature - strain.stretch * parallel)};
  out.dx = side * (travel * strain.curvature_dx - parallel * strain.stretch_dx);
  out.ds = side * (travel * strain.curvature_ds - parallel * strain.stretch_ds);
  out.dlambda = side * (travel * strain.curvature_dlambda - parallel * strain.stretch_dlambda);
  const NodeUnknowns unknowns = on.mesh().node_unknowns(at.strand, at.position);
  out.dx[unknowns[0]] -= side * strain.stretch * parallel_x;
  out.dx[unknowns[2]] += side * strain.stretch * parallel_x * offset * std::cos(place.angle);
  return out;
}

// In terms of a moment.
double SlidingContact::bending_gap(const State& state, std::size_t k) const {
  const Index strand = layout(state.piece).mesh().breakpoint(static_cast<Index>(k)).first;
  return body_.bending_stiffness(strand) * curvature_gap(state, k).value;
}

// Force per length that would hold the body on the wall at point k: ± [EI (κ̂″ − κ₀″) + P κ̂ − q·n], q the load along
// the body. Its sign says whether the body lies on the wall there, its vanishing that it does so by itself.
double SlidingContact::pressure(const State& state, std::size_t k) const {
  const SlidingContactLayout& on = layout(state.piece);
  const MeshState now = mesh_state_of(state);
  const Touch at = touch(on, k);
  const AxisPlace place = on.mesh().node(at.strand, at.position, now);
  const double travel = std::cos(place.angle) >= 0.0 ? 1.0 : -1.0;
  const double L = body_.length(at.strand), step = 0.01 * L, S = now.s[static_cast<Index>(k)];
  const Profile& profile = *obstacles_[at.obstacle].profile;
  const auto second = [step](const auto& f) { return (f(1.0) - 2.0 * f(0.0) + f(-1.0)) / (step * step); };
  const double natural =
      second([&](double i) { return body_.natural_curvature({.strand = at.strand, .s = S + i * step}); });
  const auto wall = [&](double i) {
    const double x_there = place.position.x() + i * step * std::cos(place.angle);
    return profile.covers(x_there) ? bend(profile, x_there).curvature : 0.0;
  };
  const double EI = body_.bending_stiffness(at.strand), EA = body_.axial_stiffness(at.strand);
  const double thrust = -EA * (on.mesh().strain(static_cast<Index>(k), free_side(on, k), now).stretch - 1.0);
  const Vec2 up = travel * normal(place.angle);
  const double q =
      sign_of(obstacles_[at.obstacle].side) *
      (EI * (second(wall) - travel * natural) + thrust * wall(0.0) - body_.load(at.strand, state.lambda).dot(up));
  const double noise = 1e-7 * EI / (L * L * L);
  return std::abs(q) > noise ? q : 0.0;
}

double SlidingContact::wall_curvature(const State& state, std::size_t k) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Touch at = touch(on, k);
  const AxisPlace place = on.mesh().node(at.strand, at.position, mesh_state_of(state));
  return bend(*obstacles_[at.obstacle].profile, place.position.x()).curvature;
}

// Whether the body needs no pressure to lie on a straight wall behind point k.
bool SlidingContact::lies_by_itself(const State& state, std::size_t k) const {
  return pressure(state, k) == 0.0 && wall_curvature(state, k) == 0.0;
}

// Of −tilt: the axis goes on by the stretch along its tangent and turns by its curvature. Where the body lies on the
// wall, and where it is about to, the tilt is held.
Vector SlidingContact::border_rates(const State& state) const {
  const SlidingContactLayout& on = layout(state.piece);
  const MeshState now = mesh_state_of(state);
  Vector rates = Vector::Zero(border_width(state.piece));
  for (Index k = 0; k < rates.size(); ++k) {
    const auto point = static_cast<std::size_t>(k);
    if (on.lies_beside(point)) continue;
    const Touch at = touch(on, point);
    const AxisStrain strain = on.mesh().strain(k, free_side(on, point), now);
    const double angle = on.mesh().node(at.strand, at.position, now).angle,
                 travel = std::cos(angle) >= 0.0 ? 1.0 : -1.0;
    const Vec2 along = strain.stretch * tangent(angle);
    const double rate =
        node_gap(at, now, on).tilt_gradient.dot(Eigen::Vector3d(along.x(), along.y(), strain.curvature));
    constexpr double touching = 1e-9;  // a line is about to form, or has just vanished
    if (sign_of(obstacles_[at.obstacle].side) * travel * rate * scales_.length > touching) rates[k] = -rate;
  }
  return rates;
}

}  // namespace arcwall
