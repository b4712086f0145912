// Places of a mesh that slides, and what the body has there.
#include <algorithm>

#include "core/unit_tangent.hpp"
#include "elements/sliding_mesh.hpp"

namespace arcwall {

// Of the element on that side: its end moment M, loads included, and the force along the axis N there, with the sign ±
// of what the element does to the node before or behind it.
//
//   curvature = κ₀ ± M/EI,   stretch = 1 + e ± N/EA,   N = f·t
//
// κ₀ and e with what temperatures make.
AxisStrain SlidingStructureMesh::strain_of(const Response& response, Index strand, Index position, At side,
                                           const MeshState& now) const {
  const ElementBeside of = beside(position, side);
  const SlidingStructure::Run& described = structure_.at(strand);
  const Vec2 t = unit_tangent(node(strand, position, now).angle);
  const MaterialPoint here{.strand = strand, .s = coordinate(strand, position, now.s)};
  const SectionStiffness section = structure_.stiffness(here);
  const double EA = of.sign * section.EA, EI = of.sign * section.EI;
  const auto force = response.force.segment<2>(of.place);
  return {.curvature = structure_.natural_curvature(here, now.lambda) + response.force[of.turn()] / EI,
          .stretch = 1.0 + described.thermal.strain.at(now.lambda) + force.dot(t) / EA};
}

AxisStrain SlidingStructureMesh::node_strain(Index strand, Index position, At side, const MeshState& now) const {
  const Index e = beside(position, side).element;
  return strain_of(with_end_forces(respond(strand, e, now, false), strand, e, now), strand, position, side, now);
}

AxisStrainGradient SlidingStructureMesh::node_strain_gradient(Index strand, Index position, At side,
                                                              const MeshState& now) const {
  const ElementBeside of = beside(position, side);
  const Index e = of.element, place = of.place, turn = of.turn(), n = unknowns(), m = breakpoints();
  const SlidingStructure::Run& described = structure_.at(strand);
  const SectionStiffness section = structure_.stiffness({.strand = strand, .s = coordinate(strand, position, now.s)});
  const double EA = of.sign * section.EA, EI = of.sign * section.EI;
  const Response response = with_end_forces(respond(strand, e, now, true), strand, e, now);
  const Vec2 t = unit_tangent(node(strand, position, now).angle);
  const auto force = response.force.segment<2>(place);
  AxisStrainGradient strain{strain_of(response, strand, position, side, now)};

  const Six curvature_dx = response.stiffness.row(turn).transpose() / EI;
  Six stretch_dx = response.stiffness.middleRows<2>(place).transpose() * t / EA;
  stretch_dx[turn] += force.dot(perp(t)) / EA;
  strain.curvature_dx = strain.stretch_dx = Vector::Zero(n);
  strain.curvature_ds = strain.stretch_ds = Vector::Zero(m);
  const auto to = assembly_.unknowns(mesh_of(strand).first_element + e);
  for (std::size_t i = 0; i < 6; ++i)
    if (to[i] != held) {
      strain.curvature_dx[to[i]] += curvature_dx[static_cast<Index>(i)];
      strain.stretch_dx[to[i]] += stretch_dx[static_cast<Index>(i)];
    }
  if (const Straight* const straight = straight_at(strand, e)) {
    AxialResponse axial;
    respond_straight(*straight, now, &axial);
    strain.curvature_dx[straight->force] += axial.by_ends[turn] / EI;
    strain.stretch_dx[straight->force] += axial.by_ends.segment<2>(place).dot(t) / EA;
  }
  for_each_rate(strand, e, response, [&](Index j, const Six& rate) {
    strain.curvature_ds[j] += rate[turn] / EI;
    strain.stretch_ds[j] += rate.segment<2>(place).dot(t) / EA;
  });
  strain.curvature_dlambda = described.thermal.curvature.proportional + response.force_lambda[turn] / EI;
  strain.stretch_dlambda = described.thermal.strain.proportional + response.force_lambda.segment<2>(place).dot(t) / EA;
  return strain;
}

AxisStrainGradient SlidingStructureMesh::strain_gradient(Index k, At side, const MeshState& now) const {
  const auto [strand, position] = breakpoint(k);
  const double S = coordinate(strand, position, now.s), step = 1e-5 * structure_.at(strand).length;
  const auto natural = [&, strand = strand](double at) {
    return structure_.natural_curvature({.strand = strand, .s = at}, now.lambda);
  };
  AxisStrainGradient strain = node_strain_gradient(strand, position, side, now);
  strain.curvature_ds[k] += (natural(S + step) - natural(S - step)) / (2.0 * step);
  const MaterialPoint here{.strand = strand, .s = S};
  const SectionStiffness section = structure_.stiffness(here), rate = structure_.stiffness(here, 1);
  const double free = 1.0 + structure_.at(strand).thermal.strain.at(now.lambda);
  strain.curvature_ds[k] -= (strain.curvature - natural(S)) * rate.EI / section.EI;
  strain.stretch_ds[k] -= (strain.stretch - free) * rate.EA / section.EA;
  return strain;
}

SlidingMesh::EndForces SlidingStructureMesh::end_forces(Index strand, Index position, const MeshState& now) const {
  const Six force = with_end_forces(respond(strand, position, now, false), strand, position, now).force;
  return {force.head<3>(), force.tail<3>()};
}

std::vector<SlidingMesh::PointLoad> SlidingStructureMesh::point_loads_in(Index strand, Index position,
                                                                         const MeshState& now) const {
  std::vector<PointLoad> loads;
  for (const InnerLoad& load : inner_loads_)
    if (load.strand == strand && element_of(load, now) == position)
      loads.push_back({.s = load.s, .force = load.load->at(now.lambda).value, .on_wall = load.first != held});
  std::sort(loads.begin(), loads.end(), [](const PointLoad& a, const PointLoad& b) { return a.s < b.s; });
  return loads;
}

Index SlidingStructureMesh::element_at(const MaterialPoint& point, const MeshState& now) const {
  const auto& places = mesh_of(point.strand).nodes;
  Index low = 0, high = static_cast<Index>(places.size()) - 1;
  while (high - low > 1) {
    const Index middle = (low + high) / 2;
    (places[static_cast<std::size_t>(middle)].at(now.s) <= point.s ? low : high) = middle;
  }
  return low;
}

AxisPlace SlidingStructureMesh::place(const MaterialPoint& point, const MeshState& now) const {
  const Index e = element_at(point, now);
  const double S1 = coordinate(point.strand, e, now.s), S2 = coordinate(point.strand, e + 1, now.s);
  return inside(point.strand, e, (point.s - S1) / (S2 - S1), now);
}

AxisPlace SlidingStructureMesh::inside(Index strand, Index position, double fraction, const MeshState& now) const {
  if (fraction <= 0.0) return node(strand, position, now);
  if (fraction >= 1.0) return node(strand, position + 1, now);
  const Ends at = ends(strand, position, now);
  AxisPlace place;
  if (axial_force(strand, position))
    return {.position = (1.0 - fraction) * at.first + fraction * at.second,
            .angle = (1.0 - fraction) * at.angle1 + fraction * at.angle2};
  with_beam(strand, reference(strand, position, now), now.lambda, [&](const auto& beam) {
    const BeamPlace local = beam.place(at.between(), fraction);
    place = {.position = at.first + local.offset, .angle = local.angle};
  });
  return place;
}

SlidingMesh::PlaceGradient SlidingStructureMesh::place_gradient(const MaterialPoint& point,
                                                                const MeshState& now) const {
  const Index e = element_at(point, now), m = breakpoints();
  const double S1 = coordinate(point.strand, e, now.s), S2 = coordinate(point.strand, e + 1, now.s);
  PlaceGradient gradient;
  gradient.dx.setZero(3, unknowns());
  gradient.ds.setZero(3, m);
  const Ends at = ends(point.strand, e, now);
  const auto to = assembly_.unknowns(mesh_of(point.strand).first_element + e);
  if (axial_force(point.strand, e)) {
    const double second = (point.s - S1) / (S2 - S1);
    for (Index row = 0; row < 3; ++row)
      for (const auto& [place, part] : {std::pair(row, 1.0 - second), std::pair(row + 3, second)})
        gradient.dx(row, to[static_cast<std::size_t>(place)]) += part;
  } else {
    with_beam(point.strand, reference(point.strand, e, now), now.lambda, [&](const auto& beam) {
      const BeamPlace local = beam.place(at.between(), (point.s - S1) / (S2 - S1));
      for (int row = 0; row < 3; ++row) {
        StretchLoad::Vector6 d =
            at_ends(Eigen::Vector4d(row < 2 ? local.offset_gradient.row(row) : local.angle_gradient));
        if (row < 2) d[row] += 1.0;
        for (std::size_t i = 0; i < 6; ++i)
          if (to[i] != held) gradient.dx(row, to[i]) += d[static_cast<Index>(i)];
        gradient.dlambda[row] = d.dot(end_rates(point.strand, e));
      }
    });
  }
  // By s the mesh moves under the place: differences, as the element may be another one.
  for (Index k = 0; k < m; ++k) {
    const double step = 1e-6 * structure_.at(point.strand).length;
    Vector forward = now.s, backward = now.s;
    forward[k] += step;
    backward[k] -= step;
    const AxisPlace a = place(point, {now.x, forward, now.lambda}), b = place(point, {now.x, backward, now.lambda});
    gradient.ds.col(k) << (a.position - b.position) / (2.0 * step), (a.angle - b.angle) / (2.0 * step);
  }
  return gradient;
}

Vector SlidingStructureMesh::transferred(const MeshState& now, const SlidingMesh& to, const Vector& s_to) const {
  Vector moved(to.unknowns());
  for (Index r = 0; r < structure_.strands(); ++r)
    for (Index i = 0; i < to.nodes(r); ++i) {
      const NodeUnknowns unknowns = to.node_unknowns(r, i);
      const bool first = i == 0, last = i + 1 == to.nodes(r);
      if (first || last) {
        const auto& dof = structure_.at(r).ends[first ? 0 : 1].dof;
        for (std::size_t j = 0; j < 3; ++j)
          if (unknowns[j] != held) moved[unknowns[j]] = anchor(dof[j], now);
      } else {
        const AxisPlace at = place({.strand = r, .s = to.coordinate(r, i, s_to)}, now);
        moved[unknowns[0]] = at.position.x();
        moved[unknowns[1]] = at.position.y();
        moved[unknowns[2]] = at.angle;
      }
      if (const auto force = last ? std::nullopt : to.axial_force(r, i)) {
        const Index e = element_at({.strand = r, .s = to.coordinate(r, i, s_to)}, now);
        const double free = 1.0 + structure_.at(r).thermal.strain.at(now.lambda);
        moved[*force] = structure_.at(r).section.EA() * (node_strain(r, e, At::behind, now).stretch - free);
      }
    }
  return moved;
}

}  // namespace arcwall
