// What acts along the elements of a mesh that slides.
#include "elements/distributed_load.hpp"
#include "elements/foundation.hpp"
#include "elements/pressure.hpp"
#include "elements/sliding_mesh.hpp"

namespace arcwall {

// Adds the part of the load along the strand.
void SlidingStructureMesh::add_loads(Index strand, Index position, const StretchReference& stretch, const Ends& at,
                                     const MeshState& now, Response& out) const {
  const SlidingStructure::Run& described = structure_.at(strand);
  const double S1 = coordinate(strand, position, now.s), S2 = coordinate(strand, position + 1, now.s);
  const Vec2 rest = structure_.undeformed({.strand = strand, .s = S1}, true).position;
  for (const auto& [load, factor] : described.loads) {
    const auto response = StretchLoad(stretch, load, described.offset + S1, described.offset + S2)
                              .respond(at.first - rest, at.angle1, at.second - rest, at.angle2);
    const double now_acts = factor.at(now.lambda);
    out.energy += now_acts * response.energy;
    out.force += now_acts * response.force;
    out.stiffness += now_acts * response.stiffness;
    for (std::size_t end = 0; end < 2; ++end) out.force_rate[end] += now_acts * response.force_rate[end];
    out.force_lambda += factor.proportional * response.force;
  }
}

void SlidingStructureMesh::add_pressure(Index strand, Index position, const Ends& at, const MeshState& now,
                                        Response& out) const {
  const Vec2& origin = structure_.origin_;
  const auto at_rest = [&](Index node) {
    return structure_.undeformed({.strand = strand, .s = coordinate(strand, node, now.s)}, true);
  };
  const AxisPlace first = at_rest(position), second = at_rest(position + 1);
  const auto rest = pressure_on_stretch(first.position - origin, first.angle, second.position - origin, second.angle);
  const auto response = pressure_on_stretch(at.first - origin, at.angle1, at.second - origin, at.angle2);
  const Driven& pressure = structure_.at(strand).pressure;
  const double p = pressure.at(now.lambda);
  out.energy += p * (response.energy - rest.energy);
  out.force += p * response.force;
  out.stiffness += p * response.stiffness;
  out.force_lambda += pressure.proportional * response.force;
}

// With the forces on the ends of this element alone: what pressure on the next one cancels in their sum makes the
// stiffness unsymmetric.
SlidingStructureMesh::Response SlidingStructureMesh::with_end_forces(Response response, Index strand, Index position,
                                                                     const MeshState& now) const {
  const Driven& pressure = structure_.at(strand).pressure;
  if (pressure.is_zero()) return response;
  const Ends at = ends(strand, position, now);
  const Six rates = end_rates(strand, position);
  const double p = pressure.at(now.lambda);
  Eigen::Matrix2d turn;
  turn << 0.0, -1.0, 1.0, 0.0;
  for (const Index end : {0, 3}) {
    const double sign = end == 0 ? -1.0 : 1.0;
    const Vec2 force = sign * pressure_at_end((end == 0 ? at.first : at.second) - structure_.origin_);
    response.force.segment<2>(end) += p * force;
    response.force_lambda.segment<2>(end) +=
        pressure.proportional * force + 0.5 * sign * p * turn * rates.segment<2>(end);
    response.stiffness.block<2, 2>(end, end) += 0.5 * sign * p * turn;
  }
  return response;
}

void SlidingStructureMesh::add_foundation(const SlidingStructure::Run& strand, const StretchReference& stretch,
                                          const Vec2& first_at_rest, const Ends& at, Response& out) {
  const auto response = StretchFoundation(stretch, strand.foundation)
                            .respond(at.first - first_at_rest, at.angle1, at.second - first_at_rest, at.angle2);
  out.energy += response.energy;
  out.force += response.force;
  out.stiffness += response.stiffness;
  for (std::size_t end = 0; end < 2; ++end) out.force_rate[end] += response.force_rate[end];
}

}  // namespace arcwall
