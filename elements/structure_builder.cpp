#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "elements/distributed_load.hpp"
#include "elements/member_elements.hpp"
#include "elements/structure.hpp"
#include "elements/turning_sets.hpp"

namespace arcwall {

namespace {

// What a ramp makes of a value: its constant part grows with λ, the other is left out.
Driven ramp_of(const Driven& value) { return {.constant = 0.0, .proportional = value.constant}; }

bool has_middle_nodes(const MemberDescription& member) {
  return (member.theory == Theory::reissner || member.theory == Theory::essenburg) && member.order == 2;
}

}  // namespace

Index StructureBuilder::add_joint(const Vec2& position) { return add_node(position); }

Index StructureBuilder::add_node(const Vec2& position) {
  const auto node = static_cast<Index>(positions_.size());
  positions_.push_back(position);
  shared_rotation_.push_back(std::nullopt);
  first_dof_.push_back(add_dof(node, Dof::x));
  add_dof(node, Dof::z);
  return node;
}

Index StructureBuilder::add_dof(Index node, Dof which) {
  dofs_.push_back({.node = static_cast<std::int32_t>(node), .dof = which});
  return static_cast<Index>(dofs_.size()) - 1;
}

Index StructureBuilder::end_rotation(Index joint, bool hinged) {
  if (hinged) return add_dof(joint, Dof::rotation);
  auto& shared = shared_rotation_[static_cast<std::size_t>(joint)];
  if (!shared) shared = add_dof(joint, Dof::rotation);
  return *shared;
}

ThicknessDofs StructureBuilder::add_thickness(Index node) {
  const Index e = add_dof(node, Dof::thickness);
  return {.e = e, .xi = add_dof(node, Dof::thickness2)};
}

// A beam that goes on straight with the same section has one thickness at its joint.
ThicknessDofs StructureBuilder::end_thickness(Index joint, const MemberDescription& member, double angle, bool hinged) {
  constexpr double straight = 1e-9;  // [rad]
  const double height = member.section.height.value_or(0.0);
  for (const EndThickness& other : end_thickness_)
    if (other.joint == joint && !other.hinged && !hinged && other.height == height &&
        other.quadratic == member.quadratic && std::abs(std::remainder(other.angle - angle, 2.0 * pi)) <= straight)
      return other.dofs;
  end_thickness_.push_back({.joint = joint,
                            .hinged = hinged,
                            .angle = angle,
                            .height = height,
                            .quadratic = member.quadratic,
                            .dofs = add_thickness(joint)});
  return end_thickness_.back().dofs;
}

std::vector<ThicknessDofs> StructureBuilder::thickness(Index joint) const {
  std::vector<ThicknessDofs> all;
  for (const EndThickness& end : end_thickness_)
    if (end.joint == joint) all.push_back(end.dofs);
  return all;
}

void StructureBuilder::expect_members(std::size_t count) {
  descriptions_.reserve(count);
  meshes_.reserve(count);
  first_element_.reserve(count);
  foundations_.reserve(count);
  thermal_.reserve(count);
  pressures_.reserve(count);
}

Index StructureBuilder::add_member(MemberDescription member) {
  assert(member.elements >= 1 && member.axis != nullptr);
  assert(member.theory != Theory::reissner || ((member.order == 1 || member.order == 2) && member.section.GA() > 0.0));
  assert(member.theory != Theory::essenburg ||
         ((member.order == 1 || member.order == 2) && member.section.GA() > 0.0 && !member.section.points.empty()));
  assert(member.theory != Theory::elastica || member.order == 4 || member.order == 6);
  const ImperfectAxis shape(*member.axis, member.imperfection);
  const auto points = [&](const std::vector<SineDeviation>& deviations) {
    const auto joint = [&](Index node) { return positions_[static_cast<std::size_t>(node)]; };
    return AxisPoints(member.axis, deviations, member.elements, joint(member.from), joint(member.to));
  };
  const bool rotates = member.theory != Theory::truss, thickens = member.theory == Theory::essenburg;
  MemberMesh mesh{.name = member.name,
                  .axis = points({}),
                  .shape = points(member.imperfection),
                  .height = member.section.height,
                  .taper = member.section.taper,
                  .length = member.axis->length(),
                  .quadratic = member.quadratic};
  for (int k = 0; k <= member.elements; ++k) {
    const bool first = k == 0, last = k == member.elements;
    if (has_middle_nodes(member) && !first) add_middle_node(member, shape, k - 1, mesh);
    const AxisPoint place = mesh.shape[static_cast<std::size_t>(k)];
    mesh.nodes.push_back(first ? member.from : last ? member.to : add_node(place.position));
    const bool hinged = (first && member.hinge_from) || (last && member.hinge_to);
    std::optional<Index> rotation;
    if (rotates)
      rotation = first || last ? end_rotation(mesh.nodes.back(), hinged) : add_dof(mesh.nodes.back(), Dof::rotation);
    mesh.rotations.push_back(rotation);
    if (thickens)
      mesh.thickness.push_back(first || last ? end_thickness(mesh.nodes.back(), member, place.angle, hinged)
                                             : add_thickness(mesh.nodes.back()));
  }
  first_element_.push_back(meshes_.empty() ? 0 : first_element_.back() + descriptions_.back().elements);
  meshes_.push_back(std::move(mesh));
  descriptions_.push_back(std::move(member));
  foundations_.emplace_back();
  thermal_.emplace_back();
  pressures_.emplace_back();
  return static_cast<Index>(meshes_.size()) - 1;
}

void StructureBuilder::add_middle_node(const MemberDescription& member, const ImperfectAxis& shape, int element,
                                       MemberMesh& mesh) {
  const double s = mesh.length * (element + 0.5) / member.elements;
  const AxisPoint point = shape.at(s);
  mesh.middle_nodes.push_back(add_node(point.position));
  mesh.middle_rotations.push_back(add_dof(mesh.middle_nodes.back(), Dof::rotation));
  if (member.theory != Theory::essenburg) return;
  mesh.middle_thickness.push_back(add_thickness(mesh.middle_nodes.back()));
  mesh.middle_axis.push_back(member.axis->at(s));
  mesh.middle_shape.push_back(point);
}

void StructureBuilder::add_load(Index dof, double value, LoadKind kind) {
  nodal_.add_load(dof, kind == LoadKind::proportional ? Driven{.proportional = value} : Driven{.constant = value});
}

void StructureBuilder::add_distributed_load(Index member, const LineLoad& load, LoadKind kind) {
  distributed_loads_.push_back({.member = member, .load = load, .kind = kind});
}

void StructureBuilder::add_thermal_strain(Index member, const ThermalStrain& thermal) {
  assert(descriptions_[static_cast<std::size_t>(member)].theory != Theory::essenburg);
  thermal_[static_cast<std::size_t>(member)] += thermal;
}

// Of a ramp the constant parts grow with λ and the others are left out.
std::vector<ThermalStrain> StructureBuilder::thermal_of(bool ramp) const {
  std::vector<ThermalStrain> thermal = thermal_;
  for (ThermalStrain& one : thermal)
    if (ramp) one = {.strain = ramp_of(one.strain), .curvature = ramp_of(one.curvature)};
  return thermal;
}

void StructureBuilder::add_pressure(Index member, const Driven& pressure) {
  assert(descriptions_[static_cast<std::size_t>(member)].theory != Theory::truss);
  pressures_[static_cast<std::size_t>(member)] += pressure;
}

std::vector<Driven> StructureBuilder::pressures_of(bool ramp) const {
  std::vector<Driven> pressures = pressures_;
  for (Driven& pressure : pressures)
    if (ramp) pressure = ramp_of(pressure);
  return pressures;
}

std::vector<NodalTerms::PressedEnd> StructureBuilder::pressed_ends() const {
  std::vector<Driven> excess(positions_.size());
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    const auto [constant, proportional] = pressures_[m];
    excess[static_cast<std::size_t>(meshes_[m].nodes.back())] += pressures_[m];
    excess[static_cast<std::size_t>(meshes_[m].nodes.front())] +=
        {.constant = -constant, .proportional = -proportional};
  }
  std::vector<NodalTerms::PressedEnd> ends;
  for (std::size_t node = 0; node < excess.size(); ++node) {
    const auto joint = static_cast<Index>(node);
    if (!excess[node].is_zero())
      ends.push_back({.x = dof(joint, Dof::x),
                      .z = dof(joint, Dof::z),
                      .rest = positions_[node] - origin(),
                      .excess = excess[node]});
  }
  return ends;
}

std::optional<Index> StructureBuilder::open_pressed_joint() const {
  for (const NodalTerms::PressedEnd& end : pressed_ends())
    if (!nodal_.is_held(end.x) && !nodal_.is_held(end.z)) return dofs_[static_cast<std::size_t>(end.x)].node;
  return std::nullopt;
}

NodalTerms StructureBuilder::nodal_terms(bool ramp) const {
  NodalTerms terms = nodal_;
  for (const NodalTerms::PressedEnd& end : pressed_ends()) terms.add_pressed_end(end);
  return ramp ? terms.ramp() : terms;
}

void StructureBuilder::add_foundation(Index member, const Vec2& stiffness) {
  assert(descriptions_[static_cast<std::size_t>(member)].theory != Theory::truss);
  foundations_[static_cast<std::size_t>(member)].add(stiffness);
}

void StructureBuilder::add_foundation(Index member, Dof direction, std::shared_ptr<const SpringLaw> law) {
  assert(descriptions_[static_cast<std::size_t>(member)].theory != Theory::truss);
  assert(direction == Dof::x || direction == Dof::z);
  foundations_[static_cast<std::size_t>(member)].add(direction == Dof::x ? 0 : 1, std::move(law));
}

void StructureBuilder::add_element(std::shared_ptr<const Element> element, std::vector<Index> dofs) {
  added_elements_.push_back({.element = std::move(element), .dofs = std::move(dofs)});
}

std::vector<Index> StructureBuilder::element_dofs(const MemberMesh& mesh, std::size_t k) const {
  std::vector<Index> dofs;
  const auto add = [&](Index node, std::optional<Index> rotation, const std::vector<ThicknessDofs>& thickness,
                       std::size_t at) {
    dofs.push_back(dof(node, Dof::x));
    dofs.push_back(dof(node, Dof::z));
    if (rotation) dofs.push_back(*rotation);
    if (!thickness.empty()) dofs.insert(dofs.end(), {thickness[at].e, thickness[at].xi});
  };
  add(mesh.nodes[k], mesh.rotations[k], mesh.thickness, k);
  if (!mesh.middle_nodes.empty()) add(mesh.middle_nodes[k], mesh.middle_rotations[k], mesh.middle_thickness, k);
  add(mesh.nodes[k + 1], mesh.rotations[k + 1], mesh.thickness, k + 1);
  return dofs;
}

double StructureBuilder::force_scale(const NodalTerms& terms, double length) const {
  return terms.greatest_proportional_load(
      [&](Index dof) { return dofs_[static_cast<std::size_t>(dof)].dof == Dof::rotation ? length : 1.0; });
}

std::vector<bool> StructureBuilder::nodes_with_terms() const {
  std::vector<bool> found(positions_.size(), false);
  for (std::size_t i = 0; i < dofs_.size(); ++i) {
    const auto dof = static_cast<Index>(i);
    if (!nodal_.load(dof).is_zero() || expected_loads_.contains(dof) || is_ever_held(dof) ||
        nodal_.ground_stiffness(dof) != 0.0)
      found[static_cast<std::size_t>(dofs_[i].node)] = true;
  }
  for (const NodalTerms::Spring& spring : nodal_.springs())
    for (const Index dof : {spring.first, spring.second})
      found[static_cast<std::size_t>(dofs_[static_cast<std::size_t>(dof)].node)] = true;
  for (const NodalTerms::LawSpring& spring : nodal_.law_springs())
    for (const Index dof : {spring.first.value_or(spring.second), spring.second})
      found[static_cast<std::size_t>(dofs_[static_cast<std::size_t>(dof)].node)] = true;
  return found;
}

bool StructureBuilder::carries_force_alone(Index node, Index rotation) const {
  const auto is_free = [&](Index dof) {
    const auto joins = [&](const NodalTerms::Spring& spring) { return spring.first == dof || spring.second == dof; };
    const auto& springs = nodal_.springs();
    const auto& others = nodal_.law_springs();
    const auto has = [&](const NodalTerms::LawSpring& spring) { return spring.joins(dof); };
    if (std::any_of(others.begin(), others.end(), has)) return false;
    return !is_ever_held(dof) && nodal_.ground_stiffness(dof) == 0.0 &&
           std::none_of(springs.begin(), springs.end(), joins);
  };
  return is_free(dof(node, Dof::x)) && is_free(dof(node, Dof::z)) && is_free(rotation) &&
         nodal_.load(rotation).is_zero() && !expected_loads_.contains(rotation);
}

// Of each degree of freedom the set with which it may turn; −1 of those that do not.
std::vector<std::int32_t> StructureBuilder::turning_sets() const {
  TurningSets sets(dofs_.size());
  sets.add(nodal_);
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    const MemberMesh& mesh = meshes_[m];
    const bool is_slender =
        descriptions_[m].theory == Theory::euler_bernoulli || descriptions_[m].theory == Theory::elastica;
    if (is_slender) continue;
    for (const auto& rotation : mesh.rotations)
      if (rotation) sets.join(*rotation, *mesh.rotations.front());
    for (const Index rotation : mesh.middle_rotations) sets.join(rotation, *mesh.rotations.front());
  }
  for (const AddedElement& added : added_elements_)
    for (const Index dof : added.dofs) sets.hold(dof);
  std::vector<std::int32_t> result(dofs_.size(), -1);
  for (std::size_t i = 0; i < result.size(); ++i)
    if (dofs_[i].dof == Dof::rotation) result[i] = static_cast<std::int32_t>(sets.of(static_cast<Index>(i)));
  return result;
}

// The structure without elements, loads and supports: its unknowns are numbered along the members, so that neighbours
// stay near.
std::unique_ptr<Structure> StructureBuilder::numbered() const {
  std::vector<std::int32_t> unknown_of_dof(dofs_.size(), -1), dof_of_unknown;
  const auto number = [&](Index dof) {
    auto& unknown = unknown_of_dof[static_cast<std::size_t>(dof)];
    if (unknown >= 0 || nodal_.is_held(dof)) return;
    unknown = static_cast<std::int32_t>(dof_of_unknown.size());
    dof_of_unknown.push_back(static_cast<std::int32_t>(dof));
  };
  ShiftedLists dofs_of_elements;
  IndexLists blocks;
  const auto add_block = [&](std::vector<Index> of_element) {
    dofs_of_elements.add(of_element);
    for (Index& dof : of_element) {
      number(dof);
      dof = unknown_of_dof[static_cast<std::size_t>(dof)];
    }
    blocks.push_back(std::move(of_element));
  };
  for (const MemberMesh& mesh : meshes_)
    for (std::size_t k = 0; k + 1 < mesh.nodes.size(); ++k) add_block(element_dofs(mesh, k));
  for (const AddedElement& added : added_elements_) add_block(added.dofs);
  for (const NodalTerms::Spring& spring : nodal_.springs()) add_block({spring.first, spring.second});
  for (const NodalTerms::LawSpring& spring : nodal_.law_springs())
    if (spring.first) add_block({*spring.first, spring.second});

  auto structure = std::unique_ptr<Structure>(new Structure(static_cast<Index>(dof_of_unknown.size()), blocks));
  structure->positions_ = positions_;
  structure->first_dof_ = first_dof_;
  structure->members_ = meshes_;
  dof_of_unknown.shrink_to_fit();
  dofs_of_elements.complete();
  structure->unknown_of_dof_ = std::move(unknown_of_dof);
  structure->dof_of_unknown_ = std::move(dof_of_unknown);
  structure->meaning_of_dof_ = dofs_;
  structure->element_dofs_ = std::move(dofs_of_elements);
  structure->held_later_ = expected_holds_;
  structure->length_scale_ = box_diagonal(positions_);
  const auto is_rotation = [](const Structure::Meaning& meaning) { return meaning.dof == Dof::rotation; };
  structure->rotations_ = static_cast<double>(std::count_if(dofs_.begin(), dofs_.end(), is_rotation));
  return structure;
}

// Adds what `make` gives for each element of a member to the loads of elements.
template <class Make>
void StructureBuilder::add_along(Structure& structure, std::size_t m, const Make& make, bool is_grounded) const {
  const MemberDescription& member = descriptions_[m];
  const ImperfectAxis shape(*member.axis, member.imperfection);
  for (std::size_t k = 0; k + 1 < meshes_[m].nodes.size(); ++k)
    structure.element_loads_.push_back(
        {.potential = make(MemberElement{.member = member, .shape = shape, .mesh = meshes_[m], .k = k}),
         .element = first_element_[m] + static_cast<Index>(k),
         .is_grounded = is_grounded});
}

std::vector<DrivenLineLoad> StructureBuilder::loads_along(Index member, bool ramp) const {
  std::vector<DrivenLineLoad> loads;
  for (const DistributedLoad& one : distributed_loads_) {
    if (one.member != member || (ramp && one.kind == LoadKind::proportional)) continue;
    const bool varies = one.kind == (ramp ? LoadKind::constant : LoadKind::proportional);
    combine({.load = one.load, .factor = varies ? Driven{.proportional = 1.0} : Driven{.constant = 1.0}}, loads);
  }
  return loads;
}

void StructureBuilder::add_dead_loads(Structure& structure, bool ramp) const {
  for (std::size_t m = 0; m < meshes_.size(); ++m)
    for (const DrivenLineLoad& one : loads_along(static_cast<Index>(m), ramp)) {
      add_along(structure, m, [&](const MemberElement& at) {
        return std::make_shared<DrivenLoad>(make_load(at, one.load), one.factor);
      });
      structure.force_scale_ = std::max(structure.force_scale_, one.greatest_force(descriptions_[m].axis->length()));
    }
}

void StructureBuilder::add_foundations(Structure& structure) const {
  for (std::size_t m = 0; m < meshes_.size(); ++m)
    if (!foundations_[m].is_zero())
      add_along(
          structure, m, [&](const MemberElement& at) { return make_foundation(at, foundations_[m]); }, true);
}

void StructureBuilder::add_pressures(Structure& structure, bool ramp) const {
  const std::vector<Driven> pressures = pressures_of(ramp);
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    if (pressures[m].is_zero()) continue;
    add_along(structure, m, [&](const MemberElement& at) {
      return std::make_shared<DrivenLoad>(make_pressure(at, origin()), pressures[m]);
    });
    structure.force_scale_ =
        std::max(structure.force_scale_, std::abs(pressures[m].proportional) * descriptions_[m].axis->length());
  }
}

void StructureBuilder::add_wall(Index member, CompliantWall wall) {
  assert(descriptions_[static_cast<std::size_t>(member)].theory != Theory::truss);
  walls_.push_back({.member = member, .wall = std::move(wall)});
}

void StructureBuilder::add_walls(Structure& structure, bool ramp) const {
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const auto m = static_cast<std::size_t>(walls_[i].member);
    const MemberDescription& member = descriptions_[m];
    const ImperfectAxis shape(*member.axis, member.imperfection);
    for (std::size_t k = 0; k + 1 < meshes_[m].nodes.size(); ++k)
      for (auto& pressure :
           make_wall_pressures({.member = member, .shape = shape, .mesh = meshes_[m], .k = k}, walls_[i].wall, ramp))
        structure.element_loads_.push_back({.potential = std::move(pressure),
                                            .element = first_element_[m] + static_cast<Index>(k),
                                            .is_grounded = true,
                                            .wall = static_cast<std::uint32_t>(i)});
  }
}

// The rate of heat, and the force that it would take to hold the members against it.
void StructureBuilder::scale_by_heat(Structure& structure, const std::vector<ThermalStrain>& thermal) const {
  const double L = structure.length_scale_;
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    const double strain = std::abs(thermal[m].strain.proportional), bend = std::abs(thermal[m].curvature.proportional);
    const Section& section = descriptions_[m].section;
    structure.heat_rate_ = std::max({structure.heat_rate_, strain, bend * L});
    structure.force_scale_ = std::max({structure.force_scale_, section.EA() * strain, section.EI() * bend / L});
  }
}

// Sorts the loads of elements by their elements: see Structure::loads_of_element().
void StructureBuilder::sort_loads(Structure& structure) {
  std::vector<std::uint32_t>& loads = structure.loads_by_element_;
  loads.resize(structure.element_loads_.size());
  std::iota(loads.begin(), loads.end(), 0U);
  const auto element_of = [&](std::uint32_t load) { return structure.element_loads_[load].element; };
  std::stable_sort(loads.begin(), loads.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return element_of(a) < element_of(b); });
  if (!loads.empty()) structure.first_load_of_element_.push_back(0);
  auto behind = loads.begin();
  for (Index e = 0; e < structure.element_count() && !loads.empty(); ++e) {
    behind = std::find_if(behind, loads.end(), [&](std::uint32_t load) { return element_of(load) > e; });
    structure.first_load_of_element_.push_back(static_cast<std::uint32_t>(behind - loads.begin()));
  }
}

std::unique_ptr<Structure> StructureBuilder::build(bool ramp) const {
  std::unique_ptr<Structure> structure = numbered();
  const std::vector<ThermalStrain> thermal = thermal_of(ramp);
  for (std::size_t m = 0; m < meshes_.size(); ++m)
    add_elements(descriptions_[m], meshes_[m], thermal[m], structure->elements_);
  structure->first_added_ = static_cast<Index>(structure->elements_.size());
  for (const AddedElement& added : added_elements_) structure->elements_.add(added.element);
  structure->elements_.shrink_to_fit();
  structure->nodal_ = nodal_terms(ramp);
  structure->arrange();

  structure->force_scale_ = force_scale(structure->nodal_, structure->length_scale_);
  scale_by_heat(*structure, thermal);
  add_dead_loads(*structure, ramp);
  add_foundations(*structure);
  add_pressures(*structure, ramp);
  add_walls(*structure, ramp);
  sort_loads(*structure);
  structure->metric_ = structure->made_metric(turning_sets());
  return structure;
}

}  // namespace arcwall
