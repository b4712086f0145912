#include "elements/sliding_structure.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/unit_tangent.hpp"
#include "elements/member_elements.hpp"
#include "elements/sliding_mesh.hpp"

namespace arcwall {

double SlidingStructure::elements_between(Index strand, double from, double to) const {
  double count = 0.0;
  for (const Part& part : at(strand).parts)
    count += std::max(0.0, std::min(to, part.to) - std::max(from, part.from)) * part.elements / (part.to - part.from);
  return count;
}

SlenderSection SlidingStructure::Run::slender() const {
  return slender_section(section, theory, order, axis->length());
}

SectionStiffness SlidingStructure::stiffness(const MaterialPoint& point, int derivative) const {
  const Run& strand = at(point.strand);
  const Section& section = strand.section;
  if (!section.taper) return derivative == 0 ? SectionStiffness{section.EA(), section.EI()} : SectionStiffness{};
  const double L = strand.axis->length(), scale = section.E * std::pow(L, -derivative);
  const SectionSizes sizes =
      section.taper->at((strand.offset + std::clamp(point.s, 0.0, strand.length)) / L, derivative);
  return {.EA = scale * sizes.A, .EI = scale * sizes.I};
}

double SlidingStructure::natural_curvature(const MaterialPoint& point, double lambda) const {
  const Run& strand = runs_[static_cast<std::size_t>(point.strand)];
  const DeviatedPoint place = strand.shape->along(strand.offset + std::clamp(point.s, 0.0, strand.length));
  return place.turning / place.speed + strand.thermal.curvature.at(lambda);
}

// By central differences over nine points, from which it is extrapolated at the ends of the strand. κ and the speed v,
// by which the curve is longer than its axis, are functions of the axis' arc length a: dκ/dS = κ_a/v,
// d²κ/dS² = (κ_aa − κ_a v_a/v)/v².
// Temperatures are the same all along a strand.
double SlidingStructure::natural_curvature_derivative(const MaterialPoint& point, int derivative) const {
  using Nine = Eigen::Matrix<double, 9, 1>;
  static const Nine first = (Nine() << 3.0, -32.0, 168.0, -672.0, 0.0, 672.0, -168.0, 32.0, -3.0).finished() / 840.0;
  static const Nine second =
      (Nine() << -9.0, 128.0, -1008.0, 8064.0, -14350.0, 8064.0, -1008.0, 128.0, -9.0).finished() / 5040.0;
  static const Nine third = (Nine() << -7.0, 72.0, -338.0, 488.0, 0.0, -488.0, 338.0, -72.0, 7.0).finished() / 240.0;
  static const Nine fourth =
      (Nine() << 7.0, -96.0, 676.0, -1952.0, 2730.0, -1952.0, 676.0, -96.0, 7.0).finished() / 240.0;
  const Run& strand = runs_[static_cast<std::size_t>(point.strand)];
  const double h = (derivative == 1 ? 0.001 : 0.015) * strand.length;
  const double centre = std::clamp(point.s, 4.0 * h, strand.length - 4.0 * h), t = (point.s - centre) / h;
  Nine curvature, speed;
  for (Index i = 0; i < 9; ++i) {
    const DeviatedPoint place = strand.shape->along(strand.offset + centre + double(i - 4) * h);
    curvature[i] = place.turning / place.speed;
    speed[i] = place.speed;
  }
  const double half = 0.5 * t * t;
  const double v = speed[4] + (t * first + half * second).dot(speed);
  const Nine third_order = half * t / 3.0 * fourth;
  const double curvature_a = (first + t * second + half * third + third_order).dot(curvature) / h;
  if (derivative == 1) return curvature_a / v;
  const double v_a = (first + t * second + half * third).dot(speed) / h;
  const double curvature_aa = (second + t * third + half * fourth).dot(curvature) / (h * h);
  return (curvature_aa - curvature_a * v_a / v) / (v * v);
}

StrandEnd SlidingStructure::first_of_joint(Index strand, bool last, bool on_axis) const {
  constexpr double in_line = 0.05;  // [rad]
  const auto dofs = [&](const StrandEnd& end) { return at(end.strand).ends[end.last ? 1 : 0].dof; };
  const auto angle = [&](const StrandEnd& end) {
    return undeformed({.strand = end.strand, .s = end.last ? length(end.strand) : 0.0}, true).angle;
  };
  const StrandEnd here{.strand = strand, .last = last};
  const auto is_same = [&](const StrandEnd& other) {
    if (dofs(other) != dofs(here)) return false;
    return on_axis || (half_height(other.strand) == half_height(strand) &&
                       std::abs(std::remainder(angle(other) - angle(here), pi)) <= in_line);
  };
  const std::vector<StrandEnd>& ends = ends_at(dofs(here)[1]);
  return *std::find_if(ends.begin(), ends.end(), is_same);
}

bool SlidingStructure::is_tip(Index strand, bool last) const {
  const End& end = at(strand).ends[last ? 1 : 0];
  return ends_at(end.dof[1]).size() == 1 && !nodal_.is_held(end.dof[1]) && !nodal_.is_held(end.dof[2]);
}

std::optional<StrandEnd> SlidingStructure::joined_end(Index strand, bool last) const {
  const End& end = at(strand).ends[last ? 1 : 0];
  const std::vector<StrandEnd>& ends = ends_at(end.dof[1]);
  if (ends.size() != 2 || nodal_.is_held(end.dof[1]) || nodal_.is_held(end.dof[2])) return std::nullopt;
  const StrandEnd other = ends[ends[0] == StrandEnd{.strand = strand, .last = last} ? 1 : 0];
  const bool turn_together = at(other.strand).ends[other.last ? 1 : 0].dof == end.dof;
  return turn_together ? std::optional(other) : std::nullopt;
}

bool SlidingStructure::is_hinged(Index strand, bool last) const {
  const End& end = at(strand).ends[last ? 1 : 0];
  return ends_at(end.dof[1]).size() == 1 && nodal_.is_held(end.dof[1]) && !nodal_.is_held(end.dof[2]);
}

bool SlidingStructure::is_on_plane(Index strand, bool last) const {
  const End& end = at(strand).ends[last ? 1 : 0];
  const bool holds_x = nodal_.is_held(end.dof[0]), holds_z = nodal_.is_held(end.dof[1]);
  if (holds_x == holds_z || !nodal_.is_held(end.dof[2])) return false;
  const Vec2 along = unit_tangent(undeformed({.strand = strand, .s = last ? length(strand) : 0.0}, true).angle);
  return (std::abs(along.x()) > std::abs(along.y())) == holds_x;
}

Vec2 SlidingStructure::load(const MaterialPoint& point, const AxisPlace& place, double stretch, double lambda) const {
  const Run& strand = at(point.strand);
  Vec2 load = Vec2::Zero();
  const double angle = strand.load_turns() ? undeformed(point, true).angle : 0.0;
  for (const auto& [along, factor] : strand.loads) load += factor.at(lambda) * along.at(strand.offset + point.s, angle);
  if (!strand.pressure.is_zero()) load -= strand.pressure.at(lambda) * stretch * perp(unit_tangent(place.angle));
  if (!strand.has_foundation()) return load;
  return load - strand.foundation.at(place.position - undeformed(point, true).position).force;
}

// A place at a joint is one of the member before it: round-off must not choose between its two names.
std::pair<std::string, double> SlidingStructure::label(const MaterialPoint& point) const {
  constexpr double at_joint = 1e-7;  // of a part's length
  const std::vector<Part>& parts = at(point.strand).parts;
  const auto along = [&](const Part& part) { return (point.s - part.from) / (part.to - part.from); };
  auto part = std::find_if(parts.begin(), parts.end(), [&](const Part& one) { return along(one) <= 1.0 + at_joint; });
  if (part == parts.end()) --part;
  const double t = std::clamp(along(*part), 0.0, 1.0);
  return {part->member, part->first_fraction + t * (part->last_fraction - part->first_fraction)};
}

std::optional<MaterialPoint> SlidingStructure::inside(Index dof) const {
  const Index node = dofs_[static_cast<std::size_t>(dof)].node;
  for (Index r = 0; r < strands(); ++r)
    for (const InnerJoint& joint : at(r).joints)
      if (joint.node == node) return MaterialPoint{.strand = r, .s = joint.s};
  return std::nullopt;
}

SlidingStructure::MemberPart SlidingStructure::part_at(const std::string& member, double fraction) const {
  for (const MemberPart& part : parts_of(member))
    if (fraction <= part.greatest_fraction() && fraction >= part.least_fraction()) return part;
  throw std::out_of_range("no member " + member + " has a place at the fraction " + std::to_string(fraction));
}

std::vector<SlidingStructure::MemberPart> SlidingStructure::parts_of(const std::string& member) const {
  std::vector<MemberPart> parts;
  for (Index r = 0; r < strands(); ++r)
    for (const Part& part : at(r).parts)
      if (part.member == member)
        parts.push_back({.strand = r,
                         .from = part.from,
                         .to = part.to,
                         .first_fraction = part.first_fraction,
                         .last_fraction = part.last_fraction});
  std::sort(parts.begin(), parts.end(),
            [](const MemberPart& a, const MemberPart& b) { return a.least_fraction() < b.least_fraction(); });
  return parts;
}

AxisPlace SlidingStructure::undeformed(const MaterialPoint& point, bool imperfect) const {
  const Run& strand = at(point.strand);
  const AxisPoint place =
      imperfect ? strand.shape->at(strand.offset + point.s) : strand.axis->at(strand.offset + point.s);
  return {.position = place.position, .angle = place.angle};
}

std::shared_ptr<const SlidingMesh> SlidingStructure::mesh(const ElementsPerSegment& cut) const {
  return std::make_shared<SlidingStructureMesh>(*this, cut);
}

Vector SlidingStructure::rest(const SlidingMesh& mesh, const Vector& s) const {
  Vector x = Vector::Zero(mesh.unknowns());
  for (Index r = 0; r < strands(); ++r)
    for (Index i = 0; i < mesh.nodes(r); ++i) {
      const NodeUnknowns unknowns = mesh.node_unknowns(r, i);
      const bool inner = i > 0 && i + 1 < mesh.nodes(r);
      const AxisPlace place = undeformed({.strand = r, .s = mesh.coordinate(r, i, s)}, true);
      const auto set = [&](std::size_t which, double value) {
        if (unknowns[which] >= 0) x[unknowns[which]] = value;
      };
      // Joints are where they were put, free of the axis' round-off; their rotations start from zero.
      const Vec2 position = inner ? place.position
                                  : positions_[static_cast<std::size_t>(
                                        dofs_[static_cast<std::size_t>(at(r).ends[i == 0 ? 0 : 1].dof[0])].node)];
      set(0, position.x());
      set(1, position.y());
      set(2, inner ? place.angle : 0.0);
    }
  return x;
}

std::optional<Index> SlidingStructure::unknown(const SlidingMesh& mesh, Index dof) const {
  const Index i = static_cast<const SlidingStructureMesh&>(mesh).unknown(dof);
  return i < 0 ? std::nullopt : std::optional(i);
}

double SlidingStructure::value(const SlidingMesh& mesh, const MeshState& now, Index dof) const {
  const auto i = unknown(mesh, dof);
  return i ? now.x[*i] - rest_value(dof) : nodal_.support(dof).at(now.lambda);
}

double SlidingStructure::rest_value(Index dof) const {
  const Structure::Meaning& meaning = dofs_[static_cast<std::size_t>(dof)];
  const Vec2& position = positions_[static_cast<std::size_t>(meaning.node)];
  switch (meaning.dof) {
    case Dof::x:
      return position.x();
    case Dof::z:
      return position.y();
    case Dof::rotation:
    case Dof::thickness:
    case Dof::thickness2:
      return 0.0;
  }
  return 0.0;
}

SlidingStructure::Reaction SlidingStructure::reaction(const SlidingMesh& mesh, const MeshState& now, Index dof) const {
  return static_cast<const SlidingStructureMesh&>(mesh).reaction(now, dof);
}

bool StructureBuilder::can_slide() const {
  const auto is_slender = [](const MemberDescription& member) {
    return member.theory == Theory::euler_bernoulli || member.theory == Theory::elastica;
  };
  return added_elements_.empty() && std::all_of(descriptions_.begin(), descriptions_.end(), is_slender);
}

// A member is cut into strands where more than a force acts inside it; strands that continue each other along one line
// or circle are joined again.
std::unique_ptr<SlidingStructure> StructureBuilder::build_sliding(bool ramp,
                                                                  const SlidingStructure::Alike& alike) const {
  auto structure = std::unique_ptr<SlidingStructure>(new SlidingStructure());
  structure->positions_ = positions_;
  structure->first_dof_ = first_dof_;
  structure->dofs_ = dofs_;
  structure->nodal_ = nodal_terms(ramp);
  structure->origin_ = origin();
  structure->length_scale_ = box_diagonal(positions_);
  structure->force_scale_ = force_scale(structure->nodal_, structure->length_scale_);
  const std::vector<ThermalStrain> thermal = thermal_of(ramp);
  const std::vector<Driven> pressures = pressures_of(ramp);
  const std::vector<bool> with_terms = nodes_with_terms();
  for (std::size_t m = 0; m < descriptions_.size(); ++m) {
    const MemberDescription& member = descriptions_[m];
    const MemberMesh& mesh = meshes_[m];
    SlidingStructure::Run strand{.axis = member.axis,
                                 .shape = std::make_shared<ImperfectAxis>(*member.axis, member.imperfection),
                                 .perfect = member.imperfection.empty(),
                                 .theory = member.theory,
                                 .order = member.order,
                                 .section = member.section,
                                 .loads = loads_along(static_cast<Index>(m), ramp),
                                 .foundation = foundations_[m],
                                 .pressure = pressures[m],
                                 .thermal = thermal[m]};
    structure->force_scale_ =
        std::max(structure->force_scale_, std::abs(pressures[m].proportional) * member.axis->length());
    for (const DrivenLineLoad& load : strand.loads)
      structure->force_scale_ = std::max(structure->force_scale_, load.greatest_force(member.axis->length()));
    const auto end_at = [&](std::size_t node) {
      return SlidingStructure::End{
          .dof = {dof(mesh.nodes[node], Dof::x), dof(mesh.nodes[node], Dof::z), *mesh.rotations[node]},
          .angle = mesh.shape[node].angle};
    };
    const auto last = mesh.nodes.size() - 1;
    const auto coordinate = [&](std::size_t k) { return member.axis->length() * mesh.fraction(k); };
    std::vector<std::size_t> loaded;  // nodes of the part on which forces act
    std::size_t from = 0;
    for (std::size_t to = 1; to <= last; ++to) {
      if (to < last && !with_terms[static_cast<std::size_t>(mesh.nodes[to])]) continue;
      if (to < last && carries_force_alone(mesh.nodes[to], *mesh.rotations[to])) {
        loaded.push_back(to);
        continue;
      }
      SlidingStructure::Run part = strand;
      part.offset = coordinate(from);
      for (const std::size_t k : loaded) {
        part.point_loads.push_back(structure->point_load(mesh.nodes[k]));
        part.load_places.push_back(coordinate(k) - part.offset);
      }
      loaded.clear();
      part.length = member.axis->length() * mesh.fraction(to) - part.offset;
      part.parts = {{.member = member.name,
                     .from = 0.0,
                     .to = part.length,
                     .first_fraction = mesh.fraction(from),
                     .last_fraction = mesh.fraction(to),
                     .elements = double(to - from)}};
      part.ends = {end_at(from), end_at(to)};
      structure->runs_.push_back(std::move(part));
      from = to;
    }
  }
  structure->join_runs(
      with_terms, [this](Index node, Index rotation) { return carries_force_alone(node, rotation); }, alike);
  for (SlidingStructure::Run& strand : structure->runs_)
    if (strand.theory == Theory::euler_bernoulli && strand.shape->is_straight() && strand.loads.empty() &&
        !strand.has_foundation() && strand.pressure.is_zero() && strand.thermal.is_zero() && !strand.section.taper)
      strand.beams.emplace(*strand.shape, strand.section.EA(), strand.section.EI());
  return structure;
}

SlidingStructure::PointLoad SlidingStructure::point_load(Index node) const {
  const std::array<Index, 2> dofs{dof(node, Dof::x), dof(node, Dof::z)};
  return {.dof = dofs, .force = {nodal_.load(dofs[0]), nodal_.load(dofs[1])}};
}

}  // namespace arcwall
