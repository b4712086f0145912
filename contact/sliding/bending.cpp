#include "contact/sliding/bending.hpp"

#include <cmath>

namespace arcwall::sliding {

namespace {

// Where the body does not lie on the wall; before a point contact.
SlidingMesh::At free_side(const SlidingContactLayout& on, std::size_t point) {
  return on.span_before(point) == SlidingContactLayout::Span::free ? SlidingMesh::At::before : SlidingMesh::At::behind;
}

AxisStrain strain_of_free_side(const SlidingState& at, std::size_t point) {
  return at.mesh.strain(static_cast<Index>(point), free_side(at.layout, point), at.now);
}

Vec2 normal(double angle) { return {-std::sin(angle), std::cos(angle)}; }

}  // namespace

void CurvatureGap::add_to(Row& row, double factor, const SlidingUnknowns& index) const {
  row.dx.head(index.nodes) += factor * dx;
  row.dx.tail(index.points) += factor * ds;
  row.dlambda += factor * dlambda;
}

// ± (κ − Λ κ̂): κ the body's curvature and Λ its stretch by stress-free length, κ̂ the curvature of the curve at the
// face's distance from the wall, on which the axis would lie. Travel against x turns the sign of κ.
namespace {

CurvatureGap gap_of_curvatures(const SlidingSetting& setting, const SlidingState& at, const Touch& touch,
                               const AxisStrain& strain) {
  const AxisPlace axis = touch.axis(at);
  const double along = travel(axis), offset = along * touch.offset;
  const Obstacle& obstacle = *setting.obstacles[touch.obstacle].surface;
  const double side = sign_of(obstacle.side());
  const LinearField wall = obstacle.curvature(face(touch.offset, axis), at.now.lambda);
  const double shrink = 1.0 / (1.0 + touch.offset * wall.value);
  const double parallel = wall.value * shrink;

  CurvatureGap out{.value = side * (along * strain.curvature - strain.stretch * parallel)};
  out.dx = side * (along * strain.curvature_dx - parallel * strain.stretch_dx);
  out.ds = side * (along * strain.curvature_ds - parallel * strain.stretch_ds);
  out.dlambda = side * (along * strain.curvature_dlambda - parallel * strain.stretch_dlambda);
  const double by_wall = -side * strain.stretch * shrink * shrink;
  const double by_angle = -offset * (wall.x * std::cos(axis.angle) + wall.z * std::sin(axis.angle));
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), by_wall * Eigen::Vector3d(wall.x, wall.z, by_angle),
              out.dx);
  out.dlambda += by_wall * wall.rate;
  return out;
}

}  // namespace

CurvatureGap curvature_gap(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  return gap_of_curvatures(setting, at, touch_of_contact(setting, at.layout, point), strain_of_free_side(at, point));
}

CurvatureGap end_curvature_gap(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  return gap_of_curvatures(setting, at, touch_of_end(setting, at.layout, end),
                           at.mesh.end_strain(end.strand, end.last, at.now));
}

double obstacle_curvature(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Touch touch = touch_of_contact(setting, at.layout, point);
  return setting.obstacles[touch.obstacle].surface->curvature(touch.axis(at).position, at.now.lambda).value;
}

// ± [EI (κ̂″ − κ₀″) + P κ̂ − q·n], q the load along the body. Its sign says whether the body lies on the wall there,
// its vanishing that it does so by itself.
double holding_pressure(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const SlidingBody& body = setting.body;
  const Touch touch = touch_of_contact(setting, at.layout, point);
  const AxisPlace axis = touch.axis(at);
  const double along = travel(axis);
  const double L = body.length(touch.strand), step = 0.01 * L, S = at.s(static_cast<Index>(point));
  const Obstacle& obstacle = *setting.obstacles[touch.obstacle].surface;
  const auto second = [step](const auto& f) { return (f(1.0) - 2.0 * f(0.0) + f(-1.0)) / (step * step); };
  const double natural = second(
      [&](double i) { return body.natural_curvature({.strand = touch.strand, .s = S + i * step}, at.now.lambda); });
  const auto wall = [&](double i) {
    const Vec2 there = axis.position + i * step * Vec2(std::cos(axis.angle), std::sin(axis.angle));
    return obstacle.faces(there, at.now.lambda) ? obstacle.curvature(there, at.now.lambda).value : 0.0;
  };
  const double EI = body.bending_stiffness(touch.strand), EA = body.axial_stiffness(touch.strand);
  const double free = body.free_strain(touch.strand, at.now.lambda).value;
  const double thrust = -EA * (strain_of_free_side(at, point).stretch - 1.0 - free);
  const Vec2 up = along * normal(axis.angle);
  const Vec2 load = body.load({.strand = touch.strand, .s = S}, axis.position, at.now.lambda);
  const double q =
      sign_of(obstacle.side()) * (EI * (second(wall) - along * natural) + thrust * wall(0.0) - load.dot(up));
  const double noise = 1e-7 * EI / (L * L * L);
  return std::abs(q) > noise ? q : 0.0;
}

bool lies_by_itself(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  return holding_pressure(setting, at, point) == 0.0 && obstacle_curvature(setting, at, point) == 0.0;
}

Vector border_rates(const SlidingSetting& setting, const SlidingState& at) {
  constexpr double touching = 1e-9;  // a line is about to form, or has just vanished
  Vector rates = Vector::Zero(at.index.points);
  for (Index k = 0; k < rates.size(); ++k) {
    const auto point = static_cast<std::size_t>(k);
    if (at.layout.lies_beside(point)) continue;
    const Touch touch = touch_of_contact(setting, at.layout, point);
    const AxisStrain strain = strain_of_free_side(at, point);
    const AxisPlace axis = touch.axis(at);
    const Vec2 along = strain.stretch * Vec2(std::cos(axis.angle), std::sin(axis.angle));
    const double rate =
        touch_gap(setting, touch, at).tilt.gradient.dot(Eigen::Vector3d(along.x(), along.y(), strain.curvature));
    const double opening = sign_of(setting.obstacles[touch.obstacle].surface->side()) * travel(axis) * rate;
    if (opening * setting.scales.length > touching) rates[k] = -rate;
  }
  return rates;
}

}  // namespace arcwall::sliding
