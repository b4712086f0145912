#include <algorithm>

#include "apps/verify/differences.hpp"
#include "apps/verify/line_energy.hpp"
#include "apps/verify/potential_rooms.hpp"
#include "core/unit_tangent.hpp"

namespace arcwall::verify {

namespace {

// A part of a strand between two material coordinates, as a part of the member in its middle: the members that a strand
// runs through are alike, and of one line or one circle.
struct PartOfStrand {
  const PlainMember& member;
  double first, last;  // fractions of the member, descending where the strand runs against it
  Stretch stretch{};

  bool is_reversed() const { return last < first; }
};

PartOfStrand part_of_strand(const SlidingStructure& body, const PlainMembers& members, Index strand, double S1,
                            double S2) {
  const auto [name, middle] = body.label({.strand = strand, .s = 0.5 * (S1 + S2)});
  const PlainMember& member = members.named(name);
  const std::vector<SlidingStructure::MemberPart> parts = body.parts_of(name);
  const auto part = std::find_if(parts.begin(), parts.end(), [&, middle = middle](const auto& one) {
    return one.strand == strand && middle >= one.least_fraction() && middle <= one.greatest_fraction();
  });
  const double rate = (part->last_fraction - part->first_fraction) / (part->to - part->from);
  const auto fraction = [&](double S) { return part->first_fraction + rate * (S - part->from); };
  PartOfStrand out{.member = member, .first = fraction(S1), .last = fraction(S2)};
  const double L = member.length();
  if (!member.shape().deviations().empty()) {  // such a member is a strand by itself
    const DividedPart divided = member.shape().divided(out.first * L, out.last * L);
    out.stretch = {.length = divided.length, .chord = divided.chord};
    for (std::size_t k = 0; k < out.stretch.angles.size(); ++k) out.stretch.angles[k] = divided.at[k].angle;
    return out;
  }
  const auto at = [&](double S) { return body.undeformed({.strand = strand, .s = S}, true); };
  out.stretch = {.length = S2 - S1, .chord = at(S2).position - at(S1).position};
  for (std::size_t k = 0; k < out.stretch.angles.size(); ++k)
    out.stretch.angles[k] = at(S1 + double(k) / 3.0 * (S2 - S1)).angle;
  return out;
}

// A point load inside an element: −P·(r − R), with the second derivatives by differences of the first.
LocalEnergy load_inside(const SlenderElement& element, const EndsMotion& motion, double fraction, const Vec2& force,
                        const Vec2& rest) {
  const auto gradient = [&](const EndsMotion& at) {
    return Vector(-place_inside(element, at, fraction).gradient.transpose() * force);
  };
  LocalEnergy out(6);
  const Vec2 place = motion.first + place_inside(element, motion, fraction).offset;
  out.energy = -force.dot(place - rest);
  out.gradient = gradient(motion);
  constexpr double part = 1e-4;  // of the element's length, or an angle
  for (Index i = 0; i < 6; ++i) {
    const double step = i % 3 == 2 ? part : part * element.stretch.length;
    out.stiffness.col(i) = derivative(
        [&](double by) {
          EndsMotion moved = motion;
          if (i == 2) moved.turn1 += by;
          if (i == 5) moved.turn2 += by;
          if (i % 3 != 2) (i < 3 ? moved.first : moved.second)[i % 3] += by;
          return gradient(moved);
        },
        step);
  }
  out.stiffness = 0.5 * (out.stiffness + out.stiffness.transpose()).eval();
  return out;
}

// The same of one that a zone of contact hands on to the nodes beside it.
LocalEnergy load_on_chord(const Stretch& stretch, const EndsMotion& motion, double fraction, const Vec2& force,
                          const Vec2& rest) {
  LocalEnergy out(6);
  const Vec2 place = (1.0 - fraction) * motion.first + fraction * (stretch.chord + motion.second);
  out.energy = -force.dot(place - rest);
  out.gradient.head<2>() = -(1.0 - fraction) * force;
  out.gradient.segment<2>(3) = -fraction * force;
  return out;
}

// A zone without elements: N (ℓ − (1 + e) d) − ½ N² d/EA and the energy of a section that is held straight, ℓ from end
// to end in the direction of both. The last unknown is N.
LocalEnergy straight_energy(const PlainStiffness& section, const FreeDeformation& free, double d, double N,
                            const AxisPlace& first, const AxisPlace& second) {
  const double angle = 0.5 * (first.angle + second.angle);
  const Vec2 t = unit_tangent(angle), n(-t.y(), t.x()), chord = second.position - first.position;
  const double length = t.dot(chord), moment = section.EI * free.curvature;
  LocalEnergy out(7);
  out.energy = N * (length - (1.0 + free.strain) * d) - 0.5 * N * N * d / section.EA +
               moment * (0.5 * free.curvature * d - (second.angle - first.angle));
  Vector of_length(6);
  of_length << -t, 0.5 * n.dot(chord), t, 0.5 * n.dot(chord);
  out.gradient.head(6) = N * of_length;
  out.gradient[2] += moment;
  out.gradient[5] -= moment;
  out.gradient[6] = length - (1.0 + free.strain + N / section.EA) * d;
  for (const Index turn : {2, 5}) {
    for (const Index other : {2, 5}) out.stiffness(turn, other) = -0.25 * N * length;
    for (Index i = 0; i < 2; ++i)
      for (const Index end : {0, 3}) {
        const double by_both = (end == 0 ? -0.5 : 0.5) * N * n[i];
        out.stiffness(turn, end + i) += by_both;
        out.stiffness(end + i, turn) += by_both;
      }
  }
  out.stiffness.col(6).head(6) = of_length;
  out.stiffness.row(6).head(6) = of_length.transpose();
  out.stiffness(6, 6) = -d / section.EA;
  return out;
}

// What all elements of a state share.
struct SlidingElements {
  const SlidingStructure& body;
  const SlidingMesh& mesh;
  const PlainMembers& members;
  MeshState now;
  Vec2 origin;
};

LocalEnergy energy_of(const SlidingElements& of, Index strand, Index position) {
  const auto& [body, mesh, members, now, origin] = of;
  const double S1 = mesh.coordinate(strand, position, now.s), S2 = mesh.coordinate(strand, position + 1, now.s);
  const PartOfStrand part = part_of_strand(body, members, strand, S1, S2);
  FreeDeformation free = part.member.free(now.lambda);
  if (part.is_reversed()) free.curvature = -free.curvature;
  const SlenderElement element{.stretch = part.stretch,
                               .angle = part.member.axis_angle(),
                               .section = part.member.section_between(part.first, part.last),
                               .free = free};
  const AxisPlace first = mesh.node(strand, position, now), second = mesh.node(strand, position + 1, now);
  if (const auto force = mesh.axial_force(strand, position)) {
    free.curvature = body.natural_curvature({.strand = strand, .s = 0.5 * (S1 + S2)}, now.lambda);
    return straight_energy(element.section(0.5), free, S2 - S1, now.x[*force], first, second);
  }
  const Vec2 rest = body.undeformed({.strand = strand, .s = S1}, true).position;
  const EndsMotion motion{.first = first.position - rest,
                          .second = second.position - rest - part.stretch.chord,
                          .turn1 = first.angle - part.stretch.angles.front(),
                          .turn2 = second.angle - part.stretch.angles.back()};
  LocalEnergy sum = slender_energy(element, motion);
  const double L = part.member.length();
  const AlongElement along{.member = part.member, .from = part.first * L, .to = part.last * L, .lambda = now.lambda};
  if (!along.is_bare()) sum += line_energy(along, part.stretch, motion, rest - origin);
  for (const SlidingMesh::PointLoad& load : mesh.point_loads_in(strand, position, now)) {
    const Vec2 at_rest = body.undeformed({.strand = strand, .s = load.s}, true).position - rest;
    const double inside = (load.s - S1) / (S2 - S1);
    const ImperfectAxis& shape = part.member.shape();
    const auto length_to = [&](double way) {
      return shape.length(part.first * L, ((1.0 - way) * part.first + way * part.last) * L);
    };
    sum += load.on_wall ? load_on_chord(part.stretch, motion, inside, load.force, at_rest)
                        : load_inside(element, motion, length_to(inside) / length_to(1.0), load.force, at_rest);
  }
  return sum;
}

}  // namespace

std::vector<Potential> sliding_potentials(const Model& model, const PlainMembers& members, const State& state) {
  const SlidingMesh& mesh = mesh_of(state);
  const SlidingElements of{.body = *model.sliding_structure(),
                           .mesh = mesh,
                           .members = members,
                           .now = mesh_state_of(state),
                           .origin = origin_of_areas(model.structure())};
  std::vector<Potential> all;
  for (Index strand = 0; strand < of.body.strands(); ++strand)
    for (Index position = 0; position + 1 < mesh.nodes(strand); ++position) {
      Potential potential;
      for (const Index end : {position, position + 1})
        for (const Index unknown : mesh.node_unknowns(strand, end)) potential.unknowns.push_back(unknown);
      if (const auto force = mesh.axial_force(strand, position)) potential.unknowns.push_back(*force);
      static_cast<LocalEnergy&>(potential) = energy_of(of, strand, position);
      all.push_back(std::move(potential));
    }
  return all;
}

}  // namespace arcwall::verify
