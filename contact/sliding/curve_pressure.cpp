#include "contact/sliding/curve_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "contact/sliding/differences.hpp"
#include "contact/sliding/part_loads.hpp"
#include "contact/sliding/tolerances.hpp"
#include "contact/sliding/touch.hpp"
#include "core/unit_tangent.hpp"

namespace arcwall::sliding {

namespace {

// What the pressure at a place depends on.
struct HeldPlace {
  Touch touch;
  double s;       // material coordinate [length]
  Vec2 position;  // of the axis
  double angle;   // of the axis [rad]
  double travel;  // 1 where the axis runs with the obstacle's surface, −1 where it runs against it
  double stretch, lambda;

  AxisPlace axis() const { return {.position = position, .angle = angle}; }
};

// The curve on which the axis lies, by its own length in the direction of the body; > 0 where it turns to the left.
struct AxisCurve {
  double curvature = 0.0, first = 0.0, second = 0.0;
};

// A curve at the distance d to the left of another has κ w, κ′ w³ and κ″ w⁴ + 3 κ′² d w⁵, with w = 1/(1 − κ d). Beyond
// an end of the obstacle, where no contact stays, it is taken for straight.
AxisCurve axis_curve(const Obstacle& obstacle, const HeldPlace& held) {
  const Vec2 place = face(held.touch.offset, held.axis());
  if (!obstacle.faces(place, held.lambda)) return {};
  const LinearField wall = obstacle.curvature(place, held.lambda);
  const double slope = held.travel * unit_tangent(held.angle).dot(Vec2(wall.x, wall.z));
  const double second = obstacle.curvature_second(place, held.lambda);
  const double d = -held.touch.offset, w = 1.0 / (1.0 - wall.value * d), w3 = w * w * w;
  return {.curvature = held.travel * wall.value * w,
          .first = slope * w3,
          .second = held.travel * (second * w + 3.0 * slope * slope * d * w * w) * w3};
}

// How the curvature that the axis has without force changes along it.
struct NaturalCurvature {
  double value, first, second;
};

NaturalCurvature natural_curvature(const SlidingBody& body, const HeldPlace& held) {
  const MaterialPoint here{.strand = held.touch.strand, .s = held.s};
  return {.value = body.natural_curvature(here, held.lambda),
          .first = body.natural_curvature_derivative(here, 1),
          .second = body.natural_curvature_derivative(here, 2)};
}

// ± [(M′/Λ)′ − κ N − q·n] with M = EI (κ − κ₀), κ = Λ κ̂ and N = EA (Λ − 1 − ε₀). Along the body N′ = κ V − q·t with
// V = −M′/Λ, by which Λ changes. EI and EA may change along it, too.
double pressure_on_curve(const SlidingSetting& setting, const HeldPlace& held, const NaturalCurvature& natural) {
  const SlidingBody& body = setting.body;
  const Obstacle& obstacle = *setting.obstacles[held.touch.obstacle].surface;
  const Index strand = held.touch.strand;
  const MaterialPoint here{.strand = strand, .s = held.s};
  const SectionStiffness section = body.stiffness(here), section_first = body.stiffness(here, 1),
                         section_second = body.stiffness(here, 2);
  const double L = held.stretch, strain = L - 1.0 - body.free_strain(strand, held.lambda).value;
  const Vec2 t = unit_tangent(held.angle);
  const Vec2 load = body.load(here, held.axis(), L, held.lambda);
  const AxisCurve curve = axis_curve(obstacle, held);

  const double curvature = L * curve.curvature, first = L * L * curve.first, second = L * L * L * curve.second;
  const double bends = curvature - natural.value;
  const auto moment_first = [&](double first_by) { return section.EI * first_by + section_first.EI * bends; };
  const auto moment_second = [&](double first_by, double second_by) {
    return section.EI * second_by + 2.0 * section_first.EI * first_by + section_second.EI * bends;
  };
  const double shear = -moment_first(first - natural.first) / L;
  const double shear_first = -moment_second(first - natural.first, second - natural.second) / L;
  const double stretch_first = (curvature * shear - load.dot(t) - section_first.EA * strain) / section.EA;
  const double stretch_second =
      (first * shear + curvature * shear_first - 2.0 * section_first.EA * stretch_first - section_second.EA * strain) /
      section.EA;
  const double bends_first = first + stretch_first * curve.curvature - natural.first;
  const double bends_second =
      second + 3.0 * L * stretch_first * curve.first + stretch_second * curve.curvature - natural.second;
  const double by_bending =
      (moment_second(bends_first, bends_second) - moment_first(bends_first) * stretch_first / L) / L;
  const double force = section.EA * strain;
  return sign_of(obstacle.side()) * held.travel * (by_bending - curvature * force - load.dot(perp(t)));
}

// How fast a place and what is there moves.
struct HeldRate {
  Vec2 position;
  double angle, s, stretch, lambda;
};

double by_stretch(const SlidingSetting& setting, const HeldPlace& held, const NaturalCurvature& natural) {
  const auto stretched = [&](double d) {
    HeldPlace there = held;
    there.stretch += d;
    return pressure_on_curve(setting, there, natural);
  };
  return derivative_by_two(stretched, difference_step_on_wall);
}

// Along the direction in which a place moves. The stretch stands apart: slender bodies change theirs by so little that
// their force would be lost in round-off.
double pressure_rate(const SlidingSetting& setting, const HeldPlace& held, const HeldRate& rate) {
  const double length = setting.body.length(held.touch.strand);
  const double of_stretch = by_stretch(setting, held, natural_curvature(setting.body, held)) * rate.stretch;
  const double fastest = std::max(
      {rate.position.norm() / (difference_step_on_wall * length), std::abs(rate.angle) / difference_step_on_wall,
       std::abs(rate.s) / (difference_step_on_wall * length), std::abs(rate.lambda) / difference_step_on_wall});
  if (fastest == 0.0) return of_stretch;
  const auto moved = [&](double d) {
    HeldPlace there = held;
    there.position += d * rate.position;
    there.angle += d * rate.angle;
    there.s += d * rate.s;
    there.lambda += d * rate.lambda;
    return there;
  };
  const auto pressure = [&](double d) {
    const HeldPlace there = moved(d);
    return pressure_on_curve(setting, there, natural_curvature(setting.body, there));
  };
  return of_stretch + derivative_by_two(pressure, 1.0 / fastest);
}

struct Gradient {
  Eigen::Vector3d node = Eigen::Vector3d::Zero();  // by x and z of the axis and by its angle
  double stretch = 0.0, s = 0.0, lambda = 0.0;
};

Gradient pressure_gradient(const SlidingSetting& setting, const HeldPlace& held) {
  const double length = setting.body.length(held.touch.strand);
  const NaturalCurvature natural = natural_curvature(setting.body, held);
  const auto by = [&](double step, const auto& move) {
    const auto moved = [&](double d) {
      HeldPlace there = held;
      move(there, d);
      return pressure_on_curve(setting, there, there.s == held.s ? natural : natural_curvature(setting.body, there));
    };
    return derivative_by_two(moved, step);
  };
  return {.node = {by(difference_step_on_wall * length, [](HeldPlace& there, double d) { there.position.x() += d; }),
                   by(difference_step_on_wall * length, [](HeldPlace& there, double d) { there.position.y() += d; }),
                   by(difference_step_on_wall, [](HeldPlace& there, double d) { there.angle += d; })},
          .stretch = by_stretch(setting, held, natural),
          .s = by(difference_step_on_wall * length, [](HeldPlace& there, double d) { there.s += d; }),
          .lambda = by(difference_step_on_wall, [](HeldPlace& there, double d) { there.lambda += d; })};
}

HeldPlace held_place(const SlidingSetting& setting, const SlidingState& at, const Touch& touch, double s,
                     double stretch) {
  const AxisPlace axis = touch.axis(at);
  const Obstacle& obstacle = *setting.obstacles[touch.obstacle].surface;
  return {.touch = touch,
          .s = s,
          .position = axis.position,
          .angle = axis.angle,
          .travel = travel(obstacle, face(touch.offset, axis), axis.angle, at.now.lambda),
          .stretch = stretch,
          .lambda = at.now.lambda};
}

}  // namespace

CurvePressure::CurvePressure(const SlidingSetting& setting, const SlidingState& at, std::size_t segment)
    : setting_(setting),
      at_(at),
      segment_(segment),
      part_(at.layout.segments()[segment]),
      obstacle_(obstacle_of_part(at, segment)),
      first_position_(part_.first_point < 0 ? 0 : at.mesh.breakpoint(part_.first_point).second) {
  std::tie(from_, to_) = at.layout.ends(setting.body, part_, at.now.s);
}

double CurvePressure::stretch(Index place) const {
  const auto of = [&](SlidingMesh::At side) {
    return at_.mesh.node_strain(part_.strand, position(place), side, at_.now).stretch;
  };
  if (place == 0) return of(SlidingMesh::At::behind);
  if (place == part_.elements) return of(SlidingMesh::At::before);
  return 0.5 * (of(SlidingMesh::At::before) + of(SlidingMesh::At::behind));
}

AxisStrainGradient CurvePressure::stretch_gradient(Index place) const {
  const auto of = [&](SlidingMesh::At side) {
    return at_.mesh.node_strain_gradient(part_.strand, position(place), side, at_.now);
  };
  if (place == 0) return of(SlidingMesh::At::behind);
  AxisStrainGradient strain = of(SlidingMesh::At::before);
  if (place == part_.elements) return strain;
  const AxisStrainGradient behind = of(SlidingMesh::At::behind);
  strain.stretch = 0.5 * (strain.stretch + behind.stretch);
  strain.stretch_dx = 0.5 * (strain.stretch_dx + behind.stretch_dx);
  strain.stretch_ds = 0.5 * (strain.stretch_ds + behind.stretch_ds);
  strain.stretch_dlambda = 0.5 * (strain.stretch_dlambda + behind.stretch_dlambda);
  return strain;
}

double CurvePressure::pressure(Index place) const {
  return at_.pressures.at(segment_, place, [&] {
    const HeldPlace held = held_place(setting_, at_, touch(place), coordinate(double(place)), stretch(place));
    return pressure_on_curve(setting_, held, natural_curvature(setting_.body, held));
  });
}

double CurvePressure::rate(Index place, const SlidingMotion& motion) const {
  return motion.pressure_rates.at(segment_, place, [&] {
    const AxisStrainGradient strain = stretch_gradient(place);
    const HeldPlace held = held_place(setting_, at_, touch(place), coordinate(double(place)), strain.stretch);
    const Vector& dx = motion.direction.dx;
    const auto by = [&](Index unknown) { return unknown >= 0 ? dx[unknown] : 0.0; };
    const auto by_point = [&](Index point) { return point >= 0 ? dx[at_.index.coordinate(point)] : 0.0; };
    const NodeUnknowns unknowns = at_.mesh.node_unknowns(part_.strand, position(place));
    const double r = double(place) / part_.elements;
    return pressure_rate(
        setting_, held,
        {.position = {by(unknowns[0]), by(unknowns[1])},
         .angle = by(unknowns[2]),
         .s = (1.0 - r) * by_point(part_.first_point) + r * by_point(part_.last_point),
         .stretch = strain.stretch_dx.dot(dx.head(at_.index.nodes)) + strain.stretch_ds.dot(dx.tail(at_.index.points)) +
                    strain.stretch_dlambda * motion.direction.dlambda,
         .lambda = motion.direction.dlambda});
  });
}

void CurvePressure::add_gradient(Index place, double factor, Row& row) const {
  const AxisStrainGradient strain = stretch_gradient(place);
  const Gradient by =
      pressure_gradient(setting_, held_place(setting_, at_, touch(place), coordinate(double(place)), strain.stretch));
  row.dx.head(at_.index.nodes) += factor * by.stretch * strain.stretch_dx;
  row.dx.tail(at_.index.points) += factor * by.stretch * strain.stretch_ds;
  add_at_node(at_.mesh.node_unknowns(part_.strand, position(place)), factor * by.node, row.dx);
  const double r = double(place) / part_.elements;
  if (part_.first_point >= 0) row.dx[at_.index.coordinate(part_.first_point)] += (1.0 - r) * factor * by.s;
  if (part_.last_point >= 0) row.dx[at_.index.coordinate(part_.last_point)] += r * factor * by.s;
  row.dlambda += factor * (by.lambda + by.stretch * strain.stretch_dlambda);
}

double CurvePressure::pressure_between(double place) const {
  const Index first = before(place);
  const double t = place - double(first);
  return (1.0 - t) * pressure(first) + t * pressure(first + 1);
}

void CurvePressure::add_gradient_between(double place, double factor, Row& row) const {
  const Index first = before(place);
  const double t = place - double(first);
  add_gradient(first, (1.0 - t) * factor, row);
  add_gradient(first + 1, t * factor, row);
}

double CurvePressure::slope_between(double place) const {
  const Index first = before(place);
  return pressure(first + 1) - pressure(first);
}

void CurvePressure::add_element_gradient(double factor, Row& row) const {
  if (part_.first_point >= 0) row.dx[at_.index.coordinate(part_.first_point)] -= factor / part_.elements;
  if (part_.last_point >= 0) row.dx[at_.index.coordinate(part_.last_point)] += factor / part_.elements;
}

Touch CurvePressure::touch(Index place) const {
  return {.strand = part_.strand,
          .position = position(place),
          .obstacle = obstacle_,
          .offset = setting_.face_offset(obstacle_, part_.strand)};
}

}  // namespace arcwall::sliding
