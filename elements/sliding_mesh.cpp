#include "elements/sliding_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "elements/turning_sets.hpp"

namespace arcwall {

SlidingStructureMesh::SlidingStructureMesh(const SlidingStructure& structure, ElementsPerSegment cut)
    : structure_(structure), cut_(std::move(cut)) {
  assert(static_cast<Index>(cut_.size()) == structure.strands());
  Index unknowns = 0, first_element = 0, node_count = 0, rotations = 0;
  unknown_of_dof_.assign(structure.dofs_.size(), held);
  const auto number_anchor = [&](const SlidingStructure::End& end) {
    for (const Index dof : end.dof) {
      Index& unknown = unknown_of_dof_[static_cast<std::size_t>(dof)];
      if (structure.nodal_.is_held(dof) || unknown != held) continue;
      unknown = unknowns++;
    }
  };
  for (Index r = 0; r < structure.strands(); ++r) {
    const SlidingStructure::Run& strand = structure.at(r);
    const std::vector<MeshSegment>& segments = cut_[static_cast<std::size_t>(r)];
    MeshedRun meshed{.first_element = first_element};
    number_anchor(strand.ends[0]);
    std::vector<Index> load_nodes(strand.point_loads.size(), held);
    std::vector<std::pair<Index, Index>> handed_on(strand.point_loads.size(), {held, held});  // elements
    SegmentEnd a;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const int n = segments[i].elements;
      const Index load = segments[i].load;
      assert(n >= 1);
      const bool last = i + 1 == segments.size(), at_load = segments[i].ends_at_load();
      SegmentEnd b{.breakpoint = held, .fixed = strand.length};
      if (at_load) {
        b.fixed = strand.load_places[static_cast<std::size_t>(load)];
      } else if (!last) {
        b.breakpoint = static_cast<Index>(breakpoints_.size());
      }
      for (int k = 0; k < n; ++k) meshed.nodes.push_back(interpolated(a, b, double(k) / n));
      meshed.pressed.insert(meshed.pressed.end(), static_cast<std::size_t>(n), segments[i].pressed);
      for (const Index inside : segments[i].handed_on)
        handed_on[static_cast<std::size_t>(inside)] = {meshed.elements, meshed.elements + n - 1};
      if (segments[i].straight) straights_.push_back({.strand = r, .position = meshed.elements, .force = held});
      meshed.elements += n;
      if (at_load) load_nodes[static_cast<std::size_t>(load)] = meshed.elements;
      if (b.breakpoint != held) breakpoints_.emplace_back(r, meshed.elements);
      a = b;
    }
    meshed.nodes.push_back({.constant = strand.length});
    first_element += meshed.elements;
    meshed.first_inner = unknowns;
    for (std::size_t i = 0; i < load_nodes.size(); ++i) {
      const SlidingStructure::PointLoad& load = strand.point_loads[i];
      const double s = strand.load_places[i];
      if (load_nodes[i] == held) {
        inner_loads_.push_back({.strand = r,
                                .s = s,
                                .load = &load,
                                .rest = structure.undeformed({.strand = r, .s = s}, true).position,
                                .first = handed_on[i].first,
                                .last = handed_on[i].second});
        continue;
      }
      for (std::size_t j = 0; j < 2; ++j)
        unknown_of_dof_[static_cast<std::size_t>(load.dof[j])] =
            unknowns + 3 * (load_nodes[i] - 1) + static_cast<Index>(j);
    }
    unknowns += 3 * (meshed.elements - 1);
    number_anchor(strand.ends[1]);
    node_count += meshed.elements + 1;
    rotations += meshed.elements + 1;
    runs_.push_back(std::move(meshed));
  }
  const Index nodal = unknowns;
  for (Straight& straight : straights_) straight.force = unknowns++;
  IndexLists blocks;
  for (Index r = 0; r < structure.strands(); ++r)
    for (Index e = 0; e < mesh_of(r).elements; ++e) {
      const NodeUnknowns first = node_unknowns(r, e), second = node_unknowns(r, e + 1);
      blocks.push_back({first[0], first[1], first[2], second[0], second[1], second[2]});
      if (const auto force = axial_force(r, e)) blocks.back().push_back(*force);
    }
  for (const NodalTerms::Spring& spring : structure.nodal_.springs())
    blocks.push_back({unknown(spring.first), unknown(spring.second)});
  for (const NodalTerms::LawSpring& spring : structure.nodal_.law_springs())
    if (spring.first) blocks.push_back({unknown(*spring.first), unknown(spring.second)});
  // An axial force is eliminated with the node behind it, and couples with the next one as that does.
  for (const Straight& straight : straights_) {
    const NodeUnknowns next = node_unknowns(straight.strand, straight.position + 2);
    blocks.push_back({straight.force, next[0], next[1], next[2]});
  }
  assembly_ = BlockAssembly(unknowns, blocks);
  number_fours();

  // Means over all nodes, held ones included: they count as zeros.
  const double L = structure.length_scale_;
  displacement_weight_ = 1.0 / (double(node_count) * L * L);
  rotation_weight_ = 1.0 / double(rotations);
  metric_.weights = Vector::Zero(unknowns);
  metric_.weights.head(nodal).setConstant(displacement_weight_);
  for (Index r = 0; r < structure.strands(); ++r)
    for (Index i = 0; i < nodes(r); ++i)
      if (const Index turn = node_unknowns(r, i)[2]; turn != held) metric_.weights[turn] = rotation_weight_;
  metric_.squared_motion_by_lambda = squared_motion_by_lambda();
  metric_.turning_sets = turning_sets();
}

// Rotations of inner nodes are sets by themselves, those of ends what supports and springs make of them.
std::vector<Index> SlidingStructureMesh::turning_sets() const {
  TurningSets of_dofs(structure_.dofs_.size());
  of_dofs.add(structure_.nodal_);
  std::vector<Index> sets(static_cast<std::size_t>(unknowns()), -1);
  const auto first_of_inner = static_cast<Index>(structure_.dofs_.size()) + 1;
  for (Index r = 0; r < structure_.strands(); ++r)
    for (Index i = 0; i < nodes(r); ++i) {
      const Index turn = node_unknowns(r, i)[2];
      if (turn == held) continue;
      const bool inner = i > 0 && i + 1 < nodes(r);
      sets[static_cast<std::size_t>(turn)] =
          inner ? first_of_inner + turn : of_dofs.of(structure_.at(r).ends[i == 0 ? 0 : 1].dof[2]);
    }
  return sets;
}

double SlidingStructureMesh::squared_motion_by_lambda() const {
  double sum = 0.0;
  structure_.nodal_.for_each_moved_support([&](Index dof, double rate) {
    const bool turns = structure_.dofs_[static_cast<std::size_t>(dof)].dof == Dof::rotation;
    sum += (turns ? rotation_weight_ : displacement_weight_) * rate * rate;
  });
  double heat = 0.0;
  for (const SlidingStructure::Run& strand : structure_.runs_)
    heat = std::max({heat, std::abs(strand.thermal.strain.proportional),
                     std::abs(strand.thermal.curvature.proportional) * structure_.length_scale_});
  return sum + heat * heat;
}

SlidingStructureMesh::Coordinate SlidingStructureMesh::interpolated(const SegmentEnd& a, const SegmentEnd& b,
                                                                    double r) {
  Coordinate place;
  const auto add = [&](std::size_t j, const SegmentEnd& end, double weight) {
    if (end.breakpoint == held) {
      place.constant += weight * end.fixed;
    } else {
      place.breakpoint[j] = end.breakpoint;
      place.weight[j] = weight;
    }
  };
  add(0, a, 1.0 - r);
  add(1, b, r);
  return place;
}

double SlidingStructureMesh::coordinate(Index strand, Index position, const Eigen::Ref<const Vector>& s) const {
  return mesh_of(strand).nodes[static_cast<std::size_t>(position)].at(s);
}

NodeUnknowns SlidingStructureMesh::node_unknowns(Index strand, Index position) const {
  const MeshedRun& meshed = mesh_of(strand);
  if (position > 0 && position < meshed.elements) {
    const Index first = meshed.first_inner + 3 * (position - 1);
    return {first, first + 1, first + 2};
  }
  const auto& dof = structure_.at(strand).ends[position == 0 ? 0 : 1].dof;
  return {unknown(dof[0]), unknown(dof[1]), unknown(dof[2])};
}

// Position or rotation of a joint's degree of freedom.
double SlidingStructureMesh::anchor(Index dof, const MeshState& now) const {
  if (const Index i = unknown(dof); i != held) return now.x[i];
  return structure_.rest_value(dof) + structure_.nodal_.support(dof).at(now.lambda);
}

Eigen::Vector3d SlidingStructureMesh::node_rate(Index strand, Index position) const {
  if (position > 0 && position < mesh_of(strand).elements) return Eigen::Vector3d::Zero();
  const auto& dof = structure_.at(strand).ends[position == 0 ? 0 : 1].dof;
  return {structure_.held_rate(dof[0]), structure_.held_rate(dof[1]), structure_.held_rate(dof[2])};
}

SlidingStructureMesh::Six SlidingStructureMesh::end_rates(Index strand, Index position) const {
  Six rates;
  rates << node_rate(strand, position), node_rate(strand, position + 1);
  return rates;
}

bool SlidingStructureMesh::has_displaced_end(Index strand, Index position) const {
  const auto is_displaced = [&](std::size_t end) {
    const auto& dof = structure_.at(strand).ends[end].dof;
    return std::any_of(dof.begin(), dof.end(), [&](Index f) { return structure_.nodal_.is_displaced(f); });
  };
  return (position == 0 && is_displaced(0)) || (position + 1 == mesh_of(strand).elements && is_displaced(1));
}

AxisPlace SlidingStructureMesh::node(Index strand, Index position, const MeshState& now) const {
  const MeshedRun& meshed = mesh_of(strand);
  if (position > 0 && position < meshed.elements) {
    const Index first = meshed.first_inner + 3 * (position - 1);
    return {.position = {now.x[first], now.x[first + 1]}, .angle = now.x[first + 2]};
  }
  const SlidingStructure::Run& described = structure_.at(strand);
  const auto& end = described.ends[position == 0 ? 0 : 1];
  return {.position = {anchor(end.dof[0], now), anchor(end.dof[1], now)}, .angle = end.angle + anchor(end.dof[2], now)};
}

SlidingStructureMesh::Ends SlidingStructureMesh::ends(Index strand, Index position, const MeshState& now) const {
  const AxisPlace a = node(strand, position, now), b = node(strand, position + 1, now);
  return {.first = a.position, .second = b.position, .angle1 = a.angle, .angle2 = b.angle};
}

StretchReference SlidingStructureMesh::reference(Index strand, Index position, const MeshState& now) const {
  const SlidingStructure::Run& described = structure_.at(strand);
  using Inside = DividedPart::Inside;
  return stretch_reference(*described.shape, described.offset + coordinate(strand, position, now.s),
                           described.offset + coordinate(strand, position + 1, now.s),
                           described.theory == Theory::elastica || described.section.taper ||
                                   !described.thermal.is_zero() || described.load_turns()
                               ? Inside::wanted
                               : Inside::left_out);
}

SlidingStructureMesh::Response SlidingStructureMesh::respond(Index strand, Index position, const MeshState& now,
                                                             bool with_rates) const {
  Response out = respond_unloaded(strand, position, now, with_rates);
  for (const InnerLoad& load : inner_loads_)
    if (load.strand == strand && element_of(load, now) == position) out += respond(load, position, now, with_rates);
  return out;
}

SlidingStructureMesh::Response SlidingStructureMesh::respond_unloaded(Index strand, Index position,
                                                                      const MeshState& now, bool with_rates) const {
  if (const Straight* const straight = straight_at(strand, position)) return respond_straight(*straight, now, nullptr);
  const SlidingStructure::Run& described = structure_.at(strand);
  const Ends at = ends(strand, position, now);
  const StretchReference stretch = reference(strand, position, now);
  BeamResponse beam_response;
  with_beam(strand, stretch, now.lambda,
            [&](const auto& beam) { beam.respond(at.between(), with_rates, beam_response); });
  Response out{.energy = beam_response.energy,
               .force = at_ends(beam_response.force),
               .stiffness = at_ends(beam_response.stiffness),
               .force_rate = {at_ends(beam_response.force_rate[0]), at_ends(beam_response.force_rate[1])}};
  if (!described.thermal.is_zero())
    out.force_lambda = heat_rate(stretch, described.slender(), described.thermal, now.lambda, at.between());
  if (!described.loads.empty()) add_loads(strand, position, stretch, at, now, out);
  if (described.has_foundation()) {
    const MaterialPoint first{.strand = strand, .s = coordinate(strand, position, now.s)};
    add_foundation(described, stretch, structure_.undeformed(first, true).position, at, out);
  }
  if (!described.pressure.is_zero()) add_pressure(strand, position, at, now, out);
  if (has_displaced_end(strand, position)) out.force_lambda += out.stiffness * end_rates(strand, position);
  return out;
}

// Derivatives of the place of a load by x1, z1, angle1, x2, z2, angle2 of the element between S1 and S2 that it is in.
SlidingStructureMesh::PlaceByEnds SlidingStructureMesh::place_by_ends(const InnerLoad& load, const Ends& at, double S1,
                                                                      double S2, double lambda, Vec2* place) const {
  const SlidingStructure::Run& described = structure_.at(load.strand);
  const ImperfectAxis& shape = *described.shape;
  const double from = described.offset + S1, here = described.offset + load.s, to = described.offset + S2;
  PlaceByEnds by_ends;
  with_beam(load.strand, stretch_reference(shape, from, to), lambda, [&](const auto& beam) {
    const BeamPlace local = beam.place(at.between(), shape.length(from, here) / shape.length(from, to));
    if (place != nullptr) *place = at.first + local.offset;
    for (Index row = 0; row < 2; ++row) {
      by_ends.row(row) = at_ends(Eigen::Vector4d(local.offset_gradient.row(row))).transpose();
      by_ends(row, row) += 1.0;
    }
  });
  return by_ends;
}

// The nearest element that is not pressed, of a load that is not handed on though the edge of a part has just passed
// it.
Index SlidingStructureMesh::outside_pressed(const InnerLoad& load, Index position, const MeshState& now) const {
  const std::vector<bool>& pressed = mesh_of(load.strand).pressed;
  const auto is_pressed = [&](Index e) {
    return e >= 0 && e < static_cast<Index>(pressed.size()) && pressed[static_cast<std::size_t>(e)];
  };
  if (!is_pressed(position)) return position;
  Index before = position, behind = position;
  while (is_pressed(before)) --before;
  while (is_pressed(behind)) ++behind;
  if (before < 0) return behind < static_cast<Index>(pressed.size()) ? behind : position;
  if (behind == static_cast<Index>(pressed.size())) return before;
  const double from = coordinate(load.strand, before + 1, now.s), to = coordinate(load.strand, behind, now.s);
  return load.s - from < to - load.s ? before : behind;
}

// A part that is pressed on an obstacle hands a load on to it, and is not bent by it.
SlidingStructureMesh::PlaceByEnds SlidingStructureMesh::place_on_chord(const InnerLoad& load, const Ends& at, double S1,
                                                                       double S2, Vec2* place) {
  const double second = (load.s - S1) / (S2 - S1), first = 1.0 - second;
  if (place != nullptr) *place = first * at.first + second * at.second;
  PlaceByEnds by_ends = PlaceByEnds::Zero();
  by_ends.leftCols<2>() = first * Eigen::Matrix2d::Identity();
  by_ends.middleCols<2>(3) = second * Eigen::Matrix2d::Identity();
  return by_ends;
}

// The potential −P·(r − r₀), r the place of the load in the shape of the element, or between its nodes where these are
// pressed on an obstacle. Its second derivatives are central differences: they have no more than their part in K and
// ∂F/∂s, to which ten digits are exact.
SlidingStructureMesh::Response SlidingStructureMesh::respond(const InnerLoad& load, Index position,
                                                             const MeshState& now, bool with_rates) const {
  constexpr double step = 1e-5;
  const Index strand = load.strand;
  const Ends at = ends(strand, position, now);
  const double S1 = coordinate(strand, position, now.s), S2 = coordinate(strand, position + 1, now.s);
  const SlidingBody::PointForce driven = load.load->at(now.lambda);
  const Vec2& P = driven.value;
  const bool pressed = load.first != held;
  const auto by_ends_at = [&](const Ends& ends, double from, double to, double lambda, Vec2* place) {
    return pressed ? place_on_chord(load, ends, from, to, place) : place_by_ends(load, ends, from, to, lambda, place);
  };
  Vec2 place;
  const PlaceByEnds by_ends = by_ends_at(at, S1, S2, now.lambda, &place);
  Response out{.energy = -P.dot(place - load.rest),
               .force = -by_ends.transpose() * P,
               .force_lambda = -by_ends.transpose() * driven.rate};
  const auto force_at = [&](const Ends& ends, double from, double to, double lambda) {
    return Six(-by_ends_at(ends, from, to, lambda, nullptr).transpose() * P);
  };
  const auto force = [&](const Ends& ends, double from, double to) { return force_at(ends, from, to, now.lambda); };
  const double length = S2 - S1;
  const ThermalStrain& thermal = structure_.at(strand).thermal;
  const double heat = std::abs(thermal.strain.proportional) + length * std::abs(thermal.curvature.proportional);
  if (heat > 0.0) {
    const double by = step / heat;
    out.force_lambda += (force_at(at, S1, S2, now.lambda + by) - force_at(at, S1, S2, now.lambda - by)) / (2.0 * by);
  }
  for (Index i = 0; i < 6; ++i) {
    const double by = i % 3 == 2 ? step : step * length;
    const auto moved = [&](double way) {
      Ends ends = at;
      (i < 3 ? ends.first : ends.second) += i % 3 == 2 ? Vec2(0.0, 0.0) : Vec2(way * by * Vec2::Unit(i % 3));
      if (i == 2) ends.angle1 += way * by;
      if (i == 5) ends.angle2 += way * by;
      return force(ends, S1, S2);
    };
    const Six column = (moved(1.0) - moved(-1.0)) / (2.0 * by);
    out.stiffness.col(i) += 0.5 * column;
    out.stiffness.row(i) += 0.5 * column.transpose();
  }
  if (has_displaced_end(strand, position)) out.force_lambda += out.stiffness * end_rates(strand, position);
  if (!with_rates) return out;
  const double by = step * length;
  out.force_rate[0] = (force(at, S1 + by, S2) - force(at, S1 - by, S2)) / (2.0 * by);
  out.force_rate[1] = (force(at, S1, S2 + by) - force(at, S1, S2 - by)) / (2.0 * by);
  return out;
}

void SlidingStructureMesh::residual(const MeshState& now, Eigen::Ref<Vector> F) const {
  F.setZero();
  structure_.nodal_.add_forces(
      now.lambda, [this](Index dof) { return unknown(dof); },
      [&](Index dof) { return structure_.value(*this, now, dof); }, F.data());
  add_fours(now, F, nullptr);
  for (const auto& [r, e] : others_) add_forces(r, e, respond_unloaded(r, e, now, false), F);
  for (const Straight& straight : straights_) add_straight(straight, now, F, nullptr);
  for (const InnerLoad& load : inner_loads_) {
    const Index e = element_of(load, now);
    add_forces(load.strand, e, respond(load, e, now, false), F);
  }
}

void SlidingStructureMesh::add_forces(Index strand, Index position, const Response& response,
                                      Eigen::Ref<Vector> F) const {
  const auto to = assembly_.unknowns(mesh_of(strand).first_element + position);
  for (std::size_t i = 0; i < 6; ++i)
    if (to[i] != held) F[to[i]] += response.force[static_cast<Index>(i)];
}

void SlidingStructureMesh::linearize(const MeshState& now, Linearization& out) const {
  const Index n = unknowns(), m = breakpoints();
  if (out.K.cols() != n || !out.pattern_of) out.K = assembly_.pattern();
  std::fill(out.K.valuePtr(), out.K.valuePtr() + out.K.nonZeros(), 0.0);
  out.F.setZero(n);
  out.F_lambda.setZero(n);
  out.B.setZero(n, m);
  structure_.nodal_.linearize(
      now.lambda, [this](Index dof) { return unknown(dof); },
      [&](Index dof) { return structure_.value(*this, now, dof); }, out);
  add_fours(now, out.F, &out);
  for (const auto& [r, e] : others_) add(r, e, respond_unloaded(r, e, now, m > 0), nullptr, out);
  for (const Straight& straight : straights_) add_straight(straight, now, out.F, &out);
  for (const InnerLoad& load : inner_loads_) {
    const Index e = element_of(load, now);
    add(load.strand, e, respond(load, e, now, m > 0), nullptr, out);
  }
}

void SlidingStructureMesh::add(Index strand, Index position, const Response& response, const AxialResponse* axial,
                               Linearization& out) const {
  const Index block = mesh_of(strand).first_element + position;
  const auto to = assembly_.unknowns(block);
  add_forces(strand, position, response, out.F);
  for (std::size_t i = 0; i < 6; ++i)
    if (to[i] != held) out.F_lambda[to[i]] += response.force_lambda[static_cast<Index>(i)];
  if (straight_at(strand, position) == nullptr) {
    assembly_.add(block, {response.stiffness.data(), 36}, 1.0, out.K.valuePtr());
  } else {
    Eigen::Matrix<double, 7, 7> K = Eigen::Matrix<double, 7, 7>::Zero();
    K.topLeftCorner<6, 6>() = response.stiffness;
    if (axial != nullptr) {
      K.topRightCorner<6, 1>() = axial->by_ends;
      K.bottomRows<1>() << axial->by_ends.transpose(), axial->by_itself;
    }
    assembly_.add(block, {K.data(), 49}, 1.0, out.K.valuePtr());
  }
  for_each_rate(strand, position, response, [&](Index k, const Six& rate) {
    for (std::size_t i = 0; i < 6; ++i)
      if (to[i] != held) out.B(to[i], k) += rate[static_cast<Index>(i)];
  });
}

double SlidingStructureMesh::energy(const MeshState& now) const {
  double energy = energy_of_fours(now);
  for (const auto& [r, e] : others_) energy += respond_unloaded(r, e, now, false).energy;
  for (const Straight& straight : straights_) energy += respond_straight(straight, now, nullptr).energy;
  for (const InnerLoad& load : inner_loads_) energy += respond(load, element_of(load, now), now, false).energy;
  return energy + structure_.nodal_.energy(now.lambda, [&](Index dof) { return structure_.value(*this, now, dof); });
}

SlidingMesh::EndLoad SlidingStructureMesh::load_on_end(Index strand, bool last, const MeshState& now) const {
  const auto unknown_of = [this](Index of) { return unknown(of); };
  const auto displacement_of = [&](Index of) { return structure_.value(*this, now, of); };
  EndLoad load;
  for (std::size_t i = 0; i < 2; ++i) {
    const Index dof = structure_.at(strand).ends[last ? 1 : 0].dof[i];
    load.dx[i] = Vector::Zero(unknowns());
    const auto row = static_cast<Index>(i);
    load.force[row] =
        structure_.nodal_.force_on(dof, now.lambda, unknown_of, displacement_of, load.dx[i], load.dlambda[row]);
  }
  return load;
}

SlidingStructure::Reaction SlidingStructureMesh::reaction(const MeshState& now, Index dof) const {
  SlidingStructure::Reaction reaction{.dx = Vector::Zero(unknowns()), .ds = Vector::Zero(breakpoints())};
  if (unknown(dof) != held) return reaction;
  const NodalTerms& terms = structure_.nodal_;
  const auto displacement_of = [&](Index of) { return structure_.value(*this, now, of); };
  reaction.value = terms.support_force(dof, now.lambda, displacement_of);
  terms.add_support_force_gradient(
      dof, now.lambda, [this](Index of) { return unknown(of); }, displacement_of, reaction.dx, reaction.dlambda);
  for (Index r = 0; r < structure_.strands(); ++r)
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& dofs = structure_.at(r).ends[end].dof;
      const auto here = std::find(dofs.begin(), dofs.end(), dof);
      if (here == dofs.end()) continue;
      const Index row = (end == 0 ? 0 : 3) + static_cast<Index>(here - dofs.begin());
      const Index e = end == 0 ? 0 : mesh_of(r).elements - 1;
      const Response response = respond(r, e, now, true);
      reaction.value += response.force[row];
      reaction.dlambda += response.force_lambda[row];
      const auto to = assembly_.unknowns(mesh_of(r).first_element + e);
      for (std::size_t i = 0; i < 6; ++i)
        if (to[i] != held) reaction.dx[to[i]] += response.stiffness(row, static_cast<Index>(i));
      for_each_rate(r, e, response, [&](Index k, const Six& rate) { reaction.ds[k] += rate[row]; });
    }
  return reaction;
}

}  // namespace arcwall
