#include "contact/sliding/part_loads.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/tolerances.hpp"
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

// A force along the normal of an obstacle, and its derivatives by the place of the axis, by its angle and by λ. The
// normal changes along the obstacle, and with λ where that moves.
struct AlongNormal {
  double value = 0.0;
  Eigen::RowVector3d by_axis{};
  double by_lambda = 0.0;
};

AlongNormal along_normal(const SlidingSetting& setting, std::size_t obstacle, Index strand, const AxisPlace& axis,
                         double lambda, const SlidingBody::PointForce& load) {
  const auto slope = [&](const Vec2& by_place, double by_angle, double by_lambda, double size) {
    const auto moved = [&](double way) {
      const AxisPlace there{.position = axis.position + way * by_place, .angle = axis.angle + way * by_angle};
      return normal_at(setting, obstacle, strand, there, lambda + way * by_lambda);
    };
    return load.value.dot(moved(1.0) - moved(-1.0)) / (2.0 * size);
  };
  const double length = difference_step_on_wall * setting.scales.length;
  const Vec2 n = normal_at(setting, obstacle, strand, axis, lambda);
  return {.value = load.value.dot(n),
          .by_axis = {slope({length, 0.0}, 0.0, 0.0, length), slope({0.0, length}, 0.0, 0.0, length),
                      slope({0.0, 0.0}, difference_step_on_wall, 0.0, difference_step_on_wall)},
          .by_lambda = slope({0.0, 0.0}, 0.0, difference_step_on_wall, difference_step_on_wall) + load.rate.dot(n)};
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

Row push_gradient(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load) {
  const AxisPlace axis = at.mesh.place(here(setting, load), at.now);
  const AlongNormal force = along_normal(setting, obstacle_of_part(at, load.segment), load.strand, axis, at.now.lambda,
                                         setting.body.point_load(load.strand, load.load, at.now.lambda));
  const SlidingMesh::PlaceGradient moves = at.mesh.place_gradient(here(setting, load), at.now);
  Row row = at.no_slope();
  row.dx.head(at.index.nodes) = -(force.by_axis * moves.dx).transpose();
  row.dx.tail(at.index.points) = -(force.by_axis * moves.ds).transpose();
  row.dlambda = -force.by_axis * moves.dlambda - force.by_lambda;
  return row;
}

}  // namespace arcwall::sliding
