#include "contact/sliding/bending.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/differences.hpp"
#include "contact/sliding/tolerances.hpp"
#include "core/unit_tangent.hpp"

namespace arcwall::sliding {

namespace {

// Where the body does not lie on the wall; before a point contact.
SlidingMesh::At free_side(const SlidingContactLayout& on, std::size_t point) {
  return on.span_before(point) == SlidingContactLayout::Span::free ? SlidingMesh::At::before : SlidingMesh::At::behind;
}

AxisStrain strain_of_free_side(const SlidingState& at, std::size_t point) {
  return at.mesh.strain(static_cast<Index>(point), free_side(at.layout, point), at.now);
}

AxisStrainGradient strain_gradient_of_free_side(const SlidingState& at, std::size_t point) {
  return at.mesh.strain_gradient(static_cast<Index>(point), free_side(at.layout, point), at.now);
}

}  // namespace

void CurvatureGap::add_to(Row& row, double factor, const SlidingUnknowns& index) const {
  row.dx.head(index.nodes) += factor * dx;
  row.dx.tail(index.points) += factor * ds;
  row.dlambda += factor * dlambda;
}

namespace {

// How much the direction of a wall's surface turns along the surface, as a place off it sees that: of an outline the
// curvature of the parallel curve through the place.
LinearField turn_seen_from(const Obstacle& obstacle, const Vec2& place, double lambda) {
  const QuadraticField direction = obstacle.direction(place, lambda);
  const double c = std::cos(direction.value), s = std::sin(direction.value);
  const double across = c * direction.z - s * direction.x;
  return {.value = c * direction.x + s * direction.z,
          .x = c * direction.xx + s * direction.xz + across * direction.x,
          .z = c * direction.xz + s * direction.zz + across * direction.z,
          .rate = c * direction.x_rate + s * direction.z_rate + across * direction.rate};
}

// The wall at a touch, and the curve at the face's distance from it, on which the axis would lie. A point that is open
// follows the least gap, where the face runs as the wall that it sees from there.
struct FacedWall {
  AxisPlace axis;
  double side, along;     // ± 1: of the wall, and of the body's travel along it
  LinearField curvature;  // of the wall
  double parallel;        // curvature of the curve

  FacedWall(const SlidingSetting& setting, const SlidingState& at, const Touch& touch, bool touches = true)
      : axis(touch.axis(at)) {
    const Obstacle& obstacle = *setting.obstacles[touch.obstacle].surface;
    const Vec2 place = face(touch.offset, axis);
    side = sign_of(obstacle.side());
    along = travel(obstacle, place, axis.angle, at.now.lambda);
    curvature = touches ? obstacle.curvature(place, at.now.lambda) : turn_seen_from(obstacle, place, at.now.lambda);
    parallel = parallel_curvature(touch.offset, curvature.value);
  }

  // ± (κ − Λ κ̂): κ the body's curvature and Λ its stretch by stress-free length, κ̂ the curvature of the curve. Travel
  // against x turns the sign of κ.
  double gap(const AxisStrain& strain) const { return side * (along * strain.curvature - strain.stretch * parallel); }
};

CurvatureGap gap_gradient(const SlidingState& at, const Touch& touch, const FacedWall& faced,
                          const AxisStrainGradient& strain) {
  const auto& [axis, side, along, wall, parallel] = faced;
  const double offset = along * touch.offset, shrink = 1.0 / (1.0 + touch.offset * wall.value);

  CurvatureGap out{.value = faced.gap(strain)};
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

double gap_of_curvatures(const SlidingSetting& setting, const SlidingState& at, const Touch& touch,
                         const AxisStrain& strain) {
  return FacedWall(setting, at, touch).gap(strain);
}

CurvatureGap gap_of_curvatures_gradient(const SlidingSetting& setting, const SlidingState& at, const Touch& touch,
                                        const AxisStrainGradient& strain) {
  return gap_gradient(at, touch, FacedWall(setting, at, touch), strain);
}

namespace {

// The side that bends nearest to the obstacle: friction makes thrust and, on faces, curvature jump.
SlidingMesh::At nearest_side(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  using enum SlidingMesh::At;
  if (!at.rubs(point) || at.layout.lies_beside(point)) return free_side(at.layout, point);
  const Touch touch = touch_of_contact(setting, at.layout, point);
  const auto gap = [&](SlidingMesh::At side) {
    return gap_of_curvatures(setting, at, touch, at.mesh.strain(static_cast<Index>(point), side, at.now));
  };
  return gap(behind) < gap(before) ? behind : before;
}

}  // namespace

double curvature_gap(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const SlidingMesh::At side = nearest_side(setting, at, point);
  const FacedWall faced(setting, at, touch_of_contact(setting, at.layout, point), at.is_closed(point));
  return faced.gap(at.mesh.strain(static_cast<Index>(point), side, at.now));
}

CurvatureGap curvature_gap_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const SlidingMesh::At side = nearest_side(setting, at, point);
  const Touch touch = touch_of_contact(setting, at.layout, point);
  return gap_gradient(at, touch, FacedWall(setting, at, touch, at.is_closed(point)),
                      at.mesh.strain_gradient(static_cast<Index>(point), side, at.now));
}

double end_curvature_gap(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  return gap_of_curvatures(setting, at, touch_of_end(setting, at.layout, end),
                           at.mesh.end_strain(end.strand, end.last, at.now));
}

CurvatureGap end_curvature_gap_gradient(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  return gap_of_curvatures_gradient(setting, at, touch_of_end(setting, at.layout, end),
                                    at.mesh.end_strain_gradient(end.strand, end.last, at.now));
}

double slide_by_tilt(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  const Touch touch = touch_of_end(setting, at.layout, end);
  const FacedWall faced(setting, at, touch);
  const AxisStrain strain = at.mesh.end_strain(end.strand, end.last, at.now);
  const double curvature = faced.along * strain.curvature, of_face = strain.stretch - touch.offset * curvature;
  const double opening = faced.side * (curvature - of_face * faced.curvature.value);
  return opening > 0.0 ? of_face / opening : 0.0;
}

double obstacle_curvature(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  return obstacle_curvature(setting, at, touch_of_contact(setting, at.layout, point));
}

double obstacle_curvature(const SlidingSetting& setting, const SlidingState& at, const Touch& touch) {
  return setting.obstacles[touch.obstacle].surface->curvature(touch.axis(at).position, at.now.lambda).value;
}

namespace {

Vec2 place_ahead(const AxisPlace& axis, double stretch, double ahead) {
  return axis.position + ahead * stretch * unit_tangent(axis.angle);
}

}  // namespace

bool obstacle_is_straight(const SlidingSetting& setting, const SlidingState& at, std::size_t point, double ahead) {
  return obstacle_is_straight(setting, at, touch_of_contact(setting, at.layout, point), ahead);
}

bool obstacle_is_straight(const SlidingSetting& setting, const SlidingState& at, const Touch& touch, double ahead) {
  const AxisPlace axis = touch.axis(at);
  const Obstacle& obstacle = *setting.obstacles[touch.obstacle].surface;
  const auto is_straight = [&](double part) {
    const Vec2 there = place_ahead(axis, 1.0, part * ahead);
    return !obstacle.faces(there, at.now.lambda) || obstacle.curvature(there, at.now.lambda).value == 0.0;
  };
  return is_straight(0.0) && (ahead == 0.0 || (is_straight(0.5) && is_straight(1.0)));
}

namespace {

// What the body has on the free side of a point, or at an end of a strand.
AxisStrain strain_at(const SlidingState& at, const Touch& touch, std::optional<Index> point) {
  return point ? strain_of_free_side(at, static_cast<std::size_t>(*point))
               : at.mesh.end_strain(touch.strand, touch.position > 0, at.now);
}

AxisStrainGradient strain_gradient_at(const SlidingState& at, const Touch& touch, std::optional<Index> point) {
  return point ? strain_gradient_of_free_side(at, static_cast<std::size_t>(*point))
               : at.mesh.end_strain_gradient(touch.strand, touch.position > 0, at.now);
}

HeldAxis held_axis_of(const SlidingSetting& setting, const SlidingState& at, const Touch& touch,
                      std::optional<Index> point) {
  const AxisPlace axis = touch.axis(at);
  return {
      .touch = touch,
      .point = point,
      .s = point ? at.s(*point) : at.mesh.coordinate(touch.strand, touch.position, at.now.s),
      .position = axis.position,
      .angle = axis.angle,
      .travel = travel(*setting.obstacles[touch.obstacle].surface, face(touch.offset, axis), axis.angle, at.now.lambda),
      .stretch = strain_at(at, touch, point).stretch,
      .lambda = at.now.lambda};
}

}  // namespace

HeldAxis held_axis(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  return held_axis_of(setting, at, touch_of_contact(setting, at.layout, point), static_cast<Index>(point));
}

HeldAxis held_axis_at_end(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  return held_axis_of(setting, at, touch_of_end(setting, at.layout, end), std::nullopt);
}

HeldAxis held_axis(const SlidingSetting& setting, const SlidingState& at, const SlidingContactLayout::Segment& part) {
  if (part.has_point()) return held_axis(setting, at, part.end_point());
  return held_axis_at_end(setting, at, {.strand = part.strand, .obstacle = at.layout.lies_on(part.strand).value()});
}

namespace {

// What acts along a held body so far ahead [force/length].
Vec2 load_on(const SlidingSetting& setting, const HeldAxis& held, double ahead) {
  const AxisPlace axis{.position = place_ahead({.position = held.position, .angle = held.angle}, held.stretch, ahead),
                       .angle = held.angle};
  return setting.body.load({.strand = held.touch.strand, .s = held.s + ahead}, axis, held.stretch, held.lambda);
}

}  // namespace

namespace {

// (EI κ₀)″ at a place.
double natural_moment_second(const SlidingBody& body, const MaterialPoint& here, double lambda) {
  const double by_curvature = body.bending_stiffness(here) * body.natural_curvature_derivative(here, 2);
  const double EI_first = body.stiffness(here, 1).EI, EI_second = body.stiffness(here, 2).EI;
  if (EI_first == 0.0 && EI_second == 0.0) return by_curvature;
  return by_curvature + 2.0 * EI_first * body.natural_curvature_derivative(here, 1) +
         EI_second * body.natural_curvature(here, lambda);
}

// (EI κ₀)′
double natural_moment_first(const SlidingBody& body, const MaterialPoint& here, double lambda) {
  return body.bending_stiffness(here) * body.natural_curvature_derivative(here, 1) +
         body.stiffness(here, 1).EI * body.natural_curvature(here, lambda);
}

}  // namespace

// ∓ ((EI κ₀)″/Λ + q·n), q the load along the body.
double required_pressure_on_straight_wall(const SlidingSetting& setting, const HeldAxis& held, double ahead) {
  const SlidingBody& body = setting.body;
  const MaterialPoint here{.strand = held.touch.strand, .s = held.s + ahead};
  const double bending = natural_moment_second(body, here, held.lambda) / held.stretch;
  const double side = sign_of(setting.obstacles[held.touch.obstacle].surface->side());
  return -side * held.travel * (bending + load_on(setting, held, ahead).dot(perp(unit_tangent(held.angle))));
}

double bent_onto_end(const SlidingSetting& setting, const HeldAxis& held, bool last) {
  const double shear =
      natural_moment_first(setting.body, {.strand = held.touch.strand, .s = held.s}, held.lambda) / held.stretch;
  const double side = sign_of(setting.obstacles[held.touch.obstacle].surface->side());
  return (last ? 1.0 : -1.0) * side * held.travel * shear;
}

Row bent_onto_end_gradient(const SlidingSetting& setting, const SlidingState& at, const HeldAxis& held, bool last) {
  const double by_stretch = -bent_onto_end(setting, held, last) / held.stretch;
  const auto at_lambda = [&](double d) {
    HeldAxis there = held;
    there.lambda += d;
    return bent_onto_end(setting, there, last);
  };
  const AxisStrainGradient strain = strain_gradient_at(at, held.touch, held.point);
  Row row = at.no_slope();
  row.dx.head(at.index.nodes) += by_stretch * strain.stretch_dx;
  row.dx.tail(at.index.points) += by_stretch * strain.stretch_ds;
  row.dlambda = derivative(at_lambda, difference_step) + by_stretch * strain.stretch_dlambda;
  return row;
}

bool pressure_vanishes_for_all_lambda(const SlidingSetting& setting, const HeldAxis& held, double ahead) {
  const double length = setting.body.length(held.touch.strand);
  const auto is_zero = [&](double lambda) {
    HeldAxis there = held;
    there.lambda = lambda;
    double greatest = 0.0;
    for (const double fraction : {0.0, 0.5, 1.0})
      greatest =
          std::max(greatest, std::abs(required_pressure_on_straight_wall(setting, there, fraction * length - held.s)));
    return std::abs(required_pressure_on_straight_wall(setting, there, ahead)) <= zero_rate * greatest;
  };
  return is_zero(held.lambda - 1.0) && is_zero(held.lambda) && is_zero(held.lambda + 1.0);
}

// ± [(EI κ_w)″ − (EI κ₀)″/Λ + P κ_w − q·n], p̄ of (8.7). Its sign says whether the body lies on the wall there, its
// vanishing that it does so by itself.
double required_pressure(const SlidingSetting& setting, const HeldAxis& held, double ahead) {
  const SlidingBody& body = setting.body;
  const Index strand = held.touch.strand;
  const Obstacle& obstacle = *setting.obstacles[held.touch.obstacle].surface;
  const auto wall = [&](double farther) {
    const Vec2 there = place_ahead({.position = held.position, .angle = held.angle}, 1.0, ahead + farther);
    return obstacle.faces(there, held.lambda) ? obstacle.curvature(there, held.lambda).value : 0.0;
  };
  const double step = 0.01 * body.length(strand);
  const double wall_second = (wall(step) - 2.0 * wall(0.0) + wall(-step)) / (step * step);
  const double wall_first = (wall(step) - wall(-step)) / (2.0 * step);
  const double strain = held.stretch - 1.0 - body.free_strain(strand, held.lambda).value;
  const MaterialPoint here{.strand = strand, .s = held.s + ahead};
  const SectionStiffness now = body.stiffness(here);
  const double by_wall = now.EI * wall_second + 2.0 * body.stiffness(here, 1).EI * wall_first +
                         body.stiffness(here, 2).EI * wall(0.0) - now.EA * strain * wall(0.0);
  return required_pressure_on_straight_wall(setting, held, ahead) + sign_of(obstacle.side()) * by_wall;
}

double required_pressure_slope_on_straight_wall(const SlidingSetting& setting, const HeldAxis& held, double ahead) {
  return derivative([&](double d) { return required_pressure_on_straight_wall(setting, held, ahead + d); },
                    difference_step * setting.body.length(held.touch.strand));
}

// The place stays, so that the point comes nearer to it as it moves on.
Row straight_pressure_gradient(const SlidingSetting& setting, const SlidingState& at, const HeldAxis& held,
                               double ahead) {
  const double length = setting.body.length(held.touch.strand);
  const auto by = [&](double scale, const auto& move) {
    const auto moved = [&](double d) {
      HeldAxis there = held;
      move(there, d);
      return required_pressure_on_straight_wall(setting, there, ahead);
    };
    return derivative(moved, difference_step * scale);
  };
  const double by_x = by(length, [](HeldAxis& there, double d) { there.position.x() += d; });
  const double by_z = by(length, [](HeldAxis& there, double d) { there.position.y() += d; });
  const double by_angle = by(1.0, [](HeldAxis& there, double d) { there.angle += d; });
  const double by_stretch = by(1.0, [](HeldAxis& there, double d) { there.stretch += d; });
  const double by_s = by(length, [](HeldAxis& there, double d) { there.s += d; });
  const double by_lambda = by(1.0, [](HeldAxis& there, double d) { there.lambda += d; });

  const Touch& touch = held.touch;
  const AxisStrainGradient strain = strain_gradient_at(at, touch, held.point);
  Row row = at.no_slope();
  row.dx.head(at.index.nodes) += by_stretch * strain.stretch_dx;
  row.dx.tail(at.index.points) += by_stretch * strain.stretch_ds;
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), Eigen::Vector3d(by_x, by_z, by_angle), row.dx);
  if (held.point)
    row.dx[at.index.coordinate(*held.point)] += by_s - required_pressure_slope_on_straight_wall(setting, held, ahead);
  row.dlambda = by_lambda + by_stretch * strain.stretch_dlambda;
  return row;
}

namespace {

// As if it were parallel to its obstacle already. A guess of what is to lie is not; a load along the obstacle would
// press it.
HeldAxis laid_axis(const SlidingSetting& setting, const SlidingState& at, HeldAxis held) {
  held.angle -= touch_gap(setting, held.touch, at).tilt.value;
  return held;
}

}  // namespace

double required_pressure_above_roundoff(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  return required_pressure_above_roundoff(setting, at, held_axis(setting, at, point));
}

double required_pressure_above_roundoff(const SlidingSetting& setting, const SlidingState& at, const HeldAxis& held) {
  const Index strand = held.touch.strand;
  const double L = setting.body.length(strand),
               noise = 1e-7 * setting.body.bending_stiffness({strand, held.s}) / (L * L * L);
  const double q = required_pressure(setting, laid_axis(setting, at, held), 0.0);
  return std::abs(q) > noise ? q : 0.0;
}

// What acts along the body is linear in λ, and the same but for round-off of its direction where λ does not drive it.
double required_pressure_rate_above_roundoff(const SlidingSetting& setting, const SlidingState& at,
                                             const HeldAxis& held) {
  HeldAxis less = laid_axis(setting, at, held), more = less;
  less.lambda -= 1.0;
  more.lambda += 1.0;
  const double rate = 0.5 * (required_pressure_on_straight_wall(setting, more, 0.0) -
                             required_pressure_on_straight_wall(setting, less, 0.0));
  const double of_load = 0.5 * (load_on(setting, more, 0.0) - load_on(setting, less, 0.0)).norm();
  return std::abs(rate) > zero_rate * of_load ? rate : 0.0;
}

double required_pressure_rate_above_roundoff(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  return required_pressure_rate_above_roundoff(setting, at, held_axis(setting, at, point));
}

bool lies_by_itself(const SlidingSetting& setting, const SlidingState& at, const HeldAxis& held) {
  return required_pressure_above_roundoff(setting, at, held) == 0.0 &&
         required_pressure_rate_above_roundoff(setting, at, held) == 0.0 &&
         obstacle_curvature(setting, at, held.touch) == 0.0;
}

bool lies_by_itself(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  return lies_by_itself(setting, at, held_axis(setting, at, point));
}

bool lies_without_elements(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const HeldAxis held = held_axis(setting, at, point);
  const SlidingObstacle& obstacle = setting.obstacles[held.touch.obstacle];
  const MaterialPoint here{.strand = held.touch.strand, .s = held.s};
  const SectionStiffness rate = setting.body.stiffness(here, 1);
  const double L = setting.body.length(here.strand);
  const bool is_uniform = rate.EA == 0.0 && rate.EI == 0.0 &&
                          std::abs(setting.body.natural_curvature_derivative(here, 1)) * L * L <= zero_rate;
  const auto is_loaded = [&](double lambda) {
    HeldAxis there = held;
    there.lambda = lambda;
    return load_on(setting, there, 0.0).norm() > 0.0;
  };
  return lies_by_itself(setting, at, held) && obstacle.surface->knots().empty() &&
         obstacle.friction(here.strand) == 0.0 && is_uniform && !is_loaded(held.lambda - 1.0) &&
         !is_loaded(held.lambda) && !is_loaded(held.lambda + 1.0);
}

Vector border_rates(const SlidingSetting& setting, const SlidingState& at) {
  Vector rates = Vector::Zero(at.index.points);
  for (Index k = 0; k < rates.size(); ++k) {
    const auto point = static_cast<std::size_t>(k);
    const bool is_edge = at.layout.lies_beside(point) && at.is_closed(point);  // not of an open point inside a zone
    if (is_edge || at.layout.points()[point].is_pinched()) continue;
    const Touch touch = touch_of_contact(setting, at.layout, point);
    const AxisStrain strain = strain_of_free_side(at, point);
    const AxisPlace axis = touch.axis(at);
    const Vec2 along = strain.stretch * unit_tangent(axis.angle);
    const double rate =
        touch_gap(setting, touch, at).tilt.gradient.dot(Eigen::Vector3d(along.x(), along.y(), strain.curvature));
    const Obstacle& surface = *setting.obstacles[touch.obstacle].surface;
    const double opening =
        sign_of(surface.side()) * travel(surface, face(touch.offset, axis), axis.angle, at.now.lambda) * rate;
    if (opening * setting.scales.length > touching_at_rest) rates[k] = -rate;
  }
  return rates;
}

}  // namespace arcwall::sliding
