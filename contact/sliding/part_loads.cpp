#include "contact/sliding/part_loads.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

const SlidingContactLayout::Segment& part_of(const SlidingState& at, std::size_t segment) {
  return at.layout.segments()[segment];
}

// Of the obstacle, at the face of a place of the axis.
Vec2 normal_at(const SlidingSetting& setting, std::size_t obstacle, Index strand, const AxisPlace& axis,
               double lambda) {
  return setting.obstacles[obstacle].surface->normal(face(setting.face_offset(obstacle, strand), axis), lambda);
}

MaterialPoint here(const SlidingSetting& setting, const PartLoad& load) {
  return {.strand = load.strand, .s = place_of(setting, load)};
}

// visit(node, force, rate) for the pressed nodes that bear a load: what it adds to theirs, and the derivative by λ.
template <class Visit>
void for_each_share(const SlidingSetting& setting, const SlidingState& at, std::size_t segment, const Visit& visit) {
  const SlidingContactLayout::Segment& part = part_of(at, segment);
  const std::size_t obstacle = obstacle_of_part(at, segment);
  const Index begin = part.first_point < 0 ? 0 : at.mesh.breakpoint(part.first_point).second;
  const auto [from, to] = at.layout.ends(setting.body, part, at.now.s);
  for (std::size_t i = 0; i < setting.body.point_loads(part.strand).size(); ++i) {
    const PartLoad load{.strand = part.strand, .load = static_cast<Index>(i), .segment = segment};
    if (!at.layout.hands_on(segment, load.load)) continue;
    const auto [force, rate] = setting.body.point_load(part.strand, load.load, at.now.lambda);
    const double along = (place_of(setting, load) - from) / (to - from) * part.elements;
    const Index first = std::clamp<Index>(static_cast<Index>(std::floor(along)), 0, part.elements - 1);
    for (const Index node : {first, first + 1}) {
      if (node == 0 || node == part.elements) continue;  // the ends of the part
      const double weight = 1.0 - std::abs(along - double(node));
      const Vec2 n =
          normal_at(setting, obstacle, part.strand, at.mesh.node(part.strand, begin + node, at.now), at.now.lambda);
      visit(node - 1, -weight * force.dot(n), -weight * rate.dot(n));
    }
  }
}

}  // namespace

std::size_t obstacle_of_part(const SlidingState& at, std::size_t segment) {
  const SlidingContactLayout::Segment& part = part_of(at, segment);
  return part.has_point() ? at.layout.points()[part.end_point()].obstacle : at.layout.lies_on(part.strand).value();
}

double place_of(const SlidingSetting& setting, const PartLoad& load) {
  return setting.body.point_loads(load.strand)[static_cast<std::size_t>(load.load)];
}

double push(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load) {
  const AxisPlace axis = at.mesh.place(here(setting, load), at.now);
  const Vec2 n = normal_at(setting, obstacle_of_part(at, load.segment), load.strand, axis, at.now.lambda);
  return -setting.body.point_load(load.strand, load.load, at.now.lambda).value.dot(n);
}

// The normal changes along the obstacle, and with λ where that moves.
Row push_gradient(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load) {
  constexpr double step = 1e-5;  // of the length scale, and of λ
  const std::size_t obstacle = obstacle_of_part(at, load.segment);
  const AxisPlace axis = at.mesh.place(here(setting, load), at.now);
  const SlidingBody::PointForce driven = setting.body.point_load(load.strand, load.load, at.now.lambda);
  const auto slope = [&](const Vec2& by_place, double by_angle, double by_lambda, double size) {
    const auto moved = [&](double way) {
      const AxisPlace there{.position = axis.position + way * by_place, .angle = axis.angle + way * by_angle};
      return normal_at(setting, obstacle, load.strand, there, at.now.lambda + way * by_lambda);
    };
    return -driven.value.dot(moved(1.0) - moved(-1.0)) / (2.0 * size);
  };
  const double length = step * setting.scales.length;
  const Eigen::RowVector3d by_axis(slope({length, 0.0}, 0.0, 0.0, length), slope({0.0, length}, 0.0, 0.0, length),
                                   slope({0.0, 0.0}, step, 0.0, step));
  const SlidingMesh::PlaceGradient moves = at.mesh.place_gradient(here(setting, load), at.now);
  Row row = at.no_slope();
  row.dx.head(at.index.nodes) = (by_axis * moves.dx).transpose();
  row.dx.tail(at.index.points) = (by_axis * moves.ds).transpose();
  row.dlambda = by_axis * moves.dlambda + slope({0.0, 0.0}, 0.0, step, step);
  row.dlambda -= driven.rate.dot(normal_at(setting, obstacle, load.strand, axis, at.now.lambda));
  return row;
}

Vector forces_of_loads(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  Vector forces = Vector::Zero(part_of(at, segment).elements - 1);
  for_each_share(setting, at, segment, [&](Index node, double force, double) { forces[node] += force; });
  return forces;
}

Vector forces_of_loads_rate(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  Vector rates = Vector::Zero(part_of(at, segment).elements - 1);
  for_each_share(setting, at, segment, [&](Index node, double, double rate) { rates[node] += rate; });
  return rates;
}

}  // namespace arcwall::sliding
