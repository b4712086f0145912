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

// A load at one of the two nodes beside it, as on a bar.
struct Share {
  Index node, position;           // among the part's pressed nodes, and in its strand
  double weight, by_from, by_to;  // and its derivatives by the coordinates of the part's ends
  SlidingBody::PointForce load;
};

// visit(share) for the pressed nodes that bear a load.
template <class Visit>
void for_each_share(const SlidingSetting& setting, const SlidingState& at, std::size_t segment, const Visit& visit) {
  const SlidingContactLayout::Segment& part = part_of(at, segment);
  const Index begin = part.first_point < 0 ? 0 : at.mesh.breakpoint(part.first_point).second;
  const auto [from, to] = at.layout.ends(setting.body, part, at.now.s);
  for (std::size_t i = 0; i < setting.body.point_loads(part.strand).size(); ++i) {
    const PartLoad load{.strand = part.strand, .load = static_cast<Index>(i), .segment = segment};
    if (!at.layout.hands_on(segment, load.load)) continue;
    const double along = (place_of(setting, load) - from) / (to - from) * part.elements;
    const Index first = std::clamp<Index>(static_cast<Index>(std::floor(along)), 0, part.elements - 1);
    for (const Index node : {first, first + 1}) {
      if (node == 0 || node == part.elements) continue;  // the ends of the part
      const double by_along = (node == first ? -1.0 : 1.0) / (to - from);
      visit(Share{.node = node - 1,
                  .position = begin + node,
                  .weight = 1.0 - std::abs(along - double(node)),
                  .by_from = -by_along * (part.elements - along),
                  .by_to = -by_along * along,
                  .load = setting.body.point_load(part.strand, load.load, at.now.lambda)});
    }
  }
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
  constexpr double step = 1e-5;  // of the length scale, and of λ
  const auto slope = [&](const Vec2& by_place, double by_angle, double by_lambda, double size) {
    const auto moved = [&](double way) {
      const AxisPlace there{.position = axis.position + way * by_place, .angle = axis.angle + way * by_angle};
      return normal_at(setting, obstacle, strand, there, lambda + way * by_lambda);
    };
    return load.value.dot(moved(1.0) - moved(-1.0)) / (2.0 * size);
  };
  const double length = step * setting.scales.length;
  const Vec2 n = normal_at(setting, obstacle, strand, axis, lambda);
  return {.value = load.value.dot(n),
          .by_axis = {slope({length, 0.0}, 0.0, 0.0, length), slope({0.0, length}, 0.0, 0.0, length),
                      slope({0.0, 0.0}, step, 0.0, step)},
          .by_lambda = slope({0.0, 0.0}, 0.0, step, step) + load.rate.dot(n)};
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

Vector forces_of_loads(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  const std::size_t obstacle = obstacle_of_part(at, segment);
  const Index strand = part_of(at, segment).strand;
  Vector forces = Vector::Zero(part_of(at, segment).elements - 1);
  for_each_share(setting, at, segment, [&](const Share& share) {
    const AxisPlace axis = at.mesh.node(strand, share.position, at.now);
    const Vec2 n = normal_at(setting, obstacle, strand, axis, at.now.lambda);
    forces[share.node] -= share.weight * share.load.value.dot(n);
  });
  return forces;
}

void add_forces_of_loads_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t segment,
                                  const Vector& factors, Row& row) {
  const SlidingContactLayout::Segment& part = part_of(at, segment);
  for_each_share(setting, at, segment, [&](const Share& share) {
    const AxisPlace axis = at.mesh.node(part.strand, share.position, at.now);
    const AlongNormal force =
        along_normal(setting, obstacle_of_part(at, segment), part.strand, axis, at.now.lambda, share.load);
    const double factor = -factors[share.node], weight = factor * share.weight;
    add_at_node(at.mesh.node_unknowns(part.strand, share.position), weight * force.by_axis.transpose(), row.dx);
    if (part.first_point >= 0) row.dx[at.index.coordinate(part.first_point)] += factor * share.by_from * force.value;
    if (part.last_point >= 0) row.dx[at.index.coordinate(part.last_point)] += factor * share.by_to * force.value;
    row.dlambda += weight * force.by_lambda;
  });
}

}  // namespace arcwall::sliding
