#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "elements/axis_load.hpp"
#include "elements/classic_beam.hpp"
#include "elements/distributed_load.hpp"
#include "elements/elastica_beam.hpp"
#include "elements/essenburg_beam.hpp"
#include "elements/foundation.hpp"
#include "elements/heated_beam.hpp"
#include "elements/pressure.hpp"
#include "elements/reissner_beam.hpp"
#include "elements/structure.hpp"
#include "elements/unit_tangent.hpp"

namespace arcwall {

namespace {

// Element k of a member and what its stress-free shape is made of.
struct Stretch {
  const MemberDescription& member;
  const ImperfectAxis& shape;
  const MemberMesh& mesh;
  std::size_t k;

  // Arc length of the axis without imperfection at a fraction of the element.
  double at(double fraction) const { return (double(k) + fraction) / count() * member.axis->length(); }
  double count() const { return double(mesh.nodes.size() - 1); }

  bool is_like_all_others() const { return shape.is_straight() && shape.deviations().empty(); }

  // Between the nodes as they are: joints may differ from the axis' ends by its round-off. Elements that are alike are
  // so to the last digit.
  Vec2 chord() const {
    if (is_like_all_others()) return (mesh.shape.back().position - mesh.shape.front().position) / count();
    return mesh.shape[k + 1].position - mesh.shape[k].position;
  }
};

BeamReference beam_reference(const Stretch& stretch) {
  const AxisPoint first = stretch.mesh.shape[stretch.k], second = stretch.mesh.shape[stretch.k + 1];
  const Vec2 chord = stretch.chord();
  const double direction = std::atan2(chord.y(), chord.x());
  const auto against_chord = [&](double angle) { return std::remainder(angle - direction, 2.0 * pi); };
  return {.chord = chord,
          .length = stretch.shape.length(stretch.at(0.0), stretch.at(1.0)),
          .slope1 = against_chord(first.angle),
          .slope2 = against_chord(second.angle)};
}

StretchReference slender_reference(const Stretch& stretch) {
  StretchReference reference = stretch_reference(stretch.shape, stretch.at(0.0), stretch.at(1.0));
  reference.chord = stretch.chord();
  return reference;
}

// From its first node, so that places far from the origin keep their digits.
ExactBeamReference exact_reference(const Stretch& stretch) {
  const AxisPoints& nodes = stretch.mesh.shape;
  ExactBeamReference reference{.nodes = {Vec2::Zero()}, .arcs = {0.0}};
  const auto add = [&](const Vec2& position, double fraction) {
    reference.nodes.push_back(position - nodes[stretch.k].position);
    reference.arcs.push_back(stretch.shape.length(stretch.at(0.0), stretch.at(fraction)));
  };
  if (stretch.member.order == 2) add(stretch.shape.at(stretch.at(0.5)).position, 0.5);
  add(nodes[stretch.k + 1].position, 1.0);
  return reference;
}

bool has_middle_nodes(const MemberDescription& member) {
  return (member.theory == Theory::exact || member.theory == Theory::essenburg) && member.order == 2;
}

EssenburgReference essenburg_reference(const Stretch& stretch) {
  const MemberMesh& mesh = stretch.mesh;
  const Vec2 origin = mesh.shape[stretch.k].position;
  EssenburgReference reference;
  const auto add = [&](const AxisPoint& axis, const AxisPoint& shape) {
    const MemberSection section{.axis = axis, .shape = shape, .quadratic = stretch.member.quadratic};
    reference.nodes.push_back(shape.position - origin);
    reference.sections.push_back(section.kinematics());
  };
  add(mesh.axis[stretch.k], mesh.shape[stretch.k]);
  if (stretch.member.order == 2) add(mesh.middle_axis[stretch.k], mesh.middle_shape[stretch.k]);
  add(mesh.axis[stretch.k + 1], mesh.shape[stretch.k + 1]);
  return reference;
}

EssenburgStiffness essenburg_stiffness(const Section& section) {
  return {.E = section.E,
          .nu = 0.5 * section.E / section.G - 1.0,
          .shear_correction = section.shear_area / section.A,
          .points = section.points};
}

// What a ramp makes of a value: its constant part grows with λ, the other is left out.
Driven ramp_of(const Driven& value) { return {.constant = 0.0, .proportional = value.constant}; }

// Under temperatures.
std::unique_ptr<Element> make_heated_element(const Stretch& stretch, const ThermalStrain& thermal) {
  const Section& section = stretch.member.section;
  SlenderSection slender{.EA = section.EA(), .EI = section.EI()};
  if (stretch.member.theory == Theory::elastica)
    slender.order = stretch.member.order == 6 ? ElasticaOrder::six : ElasticaOrder::four;
  switch (stretch.member.theory) {
    case Theory::classic:
    case Theory::elastica:
      return std::make_unique<HeatedBeam>(slender_reference(stretch), slender, thermal);
    case Theory::exact:
      return std::make_unique<HeatedReissnerBeam>(
          exact_reference(stretch), ExactBeamStiffness{.EA = section.EA(), .GA = section.GA(), .EI = section.EI()},
          thermal);
    case Theory::truss:
      return std::make_unique<HeatedTruss>(beam_reference(stretch).chord, section.EA(), stretch.member.strain,
                                           thermal.strain);
    case Theory::essenburg:
      break;
  }
  return nullptr;
}

std::unique_ptr<Element> make_element(const Stretch& stretch) {
  const Section& section = stretch.member.section;
  switch (stretch.member.theory) {
    case Theory::classic:
      return std::make_unique<ClassicBeam>(beam_reference(stretch), section.EA(), section.EI());
    case Theory::elastica:
      return std::make_unique<ElasticaBeam>(slender_reference(stretch), section.EA(), section.EI(),
                                            stretch.member.order == 6 ? ElasticaOrder::six : ElasticaOrder::four);
    case Theory::exact:
      return std::make_unique<ReissnerBeam>(
          exact_reference(stretch), ExactBeamStiffness{.EA = section.EA(), .GA = section.GA(), .EI = section.EI()});
    case Theory::essenburg:
      return std::make_unique<EssenburgBeam>(essenburg_reference(stretch), essenburg_stiffness(section));
    case Theory::truss:
      return std::make_unique<Truss>(beam_reference(stretch).chord, section.EA(), stretch.member.strain);
  }
  return nullptr;
}

// Of a member, in turn. Those that are alike are one object, where it knows no more of its place than the chord.
void add_elements(const MemberDescription& member, const MemberMesh& mesh, const ThermalStrain& thermal,
                  ElementList& elements) {
  const ImperfectAxis shape(*member.axis, member.imperfection);
  const auto element = [&](std::size_t k) { return Stretch{.member = member, .shape = shape, .mesh = mesh, .k = k}; };
  const std::size_t count = mesh.nodes.size() - 1;
  const auto make = [&](std::size_t k) {
    return thermal.is_zero() ? make_element(element(k)) : make_heated_element(element(k), thermal);
  };
  const bool knows_places = member.theory == Theory::exact || member.theory == Theory::essenburg;
  if (!knows_places && element(0).is_like_all_others())
    elements.add(make(0), count);
  else
    for (std::size_t k = 0; k < count; ++k) elements.add(make(k));
}

std::unique_ptr<Element> make_load(const Stretch& stretch, const Vec2& load) {
  switch (stretch.member.theory) {
    case Theory::classic:
    case Theory::elastica:
      return std::make_unique<BeamDistributedLoad>(beam_reference(stretch), load);
    case Theory::exact:
      return std::make_unique<ExactDistributedLoad>(exact_reference(stretch), load);
    case Theory::essenburg:
      return std::make_unique<ExactDistributedLoad>(exact_reference(stretch), load, EssenburgBeam::unknowns_a_node);
    case Theory::truss:
      return std::make_unique<TrussDistributedLoad>(beam_reference(stretch).length * load);
  }
  return nullptr;
}

// Along and across the stress-free axis, in x and z at a fraction of the element.
Vec2 turned_load(const Stretch& stretch, const Vec2& load, double fraction) {
  const Vec2 t = unit_tangent(stretch.shape.at(stretch.at(fraction)).angle);
  return load.x() * t + load.y() * perp(t);
}

// The same along and across the stress-free axis.
std::unique_ptr<Element> make_axis_load(const Stretch& stretch, const Vec2& load) {
  const auto turned = [&](double fraction) { return turned_load(stretch, load, fraction); };
  switch (stretch.member.theory) {
    case Theory::classic:
    case Theory::elastica:
      return std::make_unique<BeamAxisLoad>(slender_reference(stretch), load);
    case Theory::exact:
      return std::make_unique<ExactDistributedLoad>(exact_reference(stretch), turned);
    case Theory::essenburg:
      return std::make_unique<ExactDistributedLoad>(exact_reference(stretch), turned, EssenburgBeam::unknowns_a_node);
    case Theory::truss:
      return std::make_unique<TrussDistributedLoad>(beam_reference(stretch).length * turned(0.5));
  }
  return nullptr;
}

std::unique_ptr<Element> make_foundation(const Stretch& stretch, const FoundationLaw& law) {
  switch (stretch.member.theory) {
    case Theory::classic:
    case Theory::elastica:
      return std::make_unique<BeamFoundation>(slender_reference(stretch), law);
    case Theory::exact:
      return std::make_unique<ExactFoundation>(exact_reference(stretch), law);
    case Theory::essenburg:
      return std::make_unique<ExactFoundation>(exact_reference(stretch), law, EssenburgBeam::unknowns_a_node);
    case Theory::truss:
      break;
  }
  return nullptr;
}

std::unique_ptr<Element> make_pressure(const Stretch& stretch, const Vec2& origin) {
  const Vec2 first = stretch.mesh.shape[stretch.k].position - origin;
  switch (stretch.member.theory) {
    case Theory::classic:
    case Theory::elastica:
      return std::make_unique<BeamPressure>(beam_reference(stretch), first);
    case Theory::exact:
      return std::make_unique<ExactPressure>(exact_reference(stretch), first);
    case Theory::essenburg:
      return std::make_unique<ExactPressure>(exact_reference(stretch), first, EssenburgBeam::unknowns_a_node);
    case Theory::truss:
      break;
  }
  return nullptr;
}

}  // namespace

Index StructureBuilder::add_joint(const Vec2& position) { return add_node(position); }

Index StructureBuilder::add_node(const Vec2& position) {
  const auto node = static_cast<Index>(positions_.size());
  positions_.push_back(position);
  shared_rotation_.push_back(std::nullopt);
  first_freedom_.push_back(add_freedom(node, Freedom::x));
  add_freedom(node, Freedom::z);
  return node;
}

Index StructureBuilder::add_freedom(Index node, Freedom which) {
  freedoms_.push_back({.node = static_cast<std::int32_t>(node), .freedom = which});
  return static_cast<Index>(freedoms_.size()) - 1;
}

Index StructureBuilder::end_rotation(Index joint, bool hinged) {
  if (hinged) return add_freedom(joint, Freedom::rotation);
  auto& shared = shared_rotation_[static_cast<std::size_t>(joint)];
  if (!shared) shared = add_freedom(joint, Freedom::rotation);
  return *shared;
}

ThicknessFreedoms StructureBuilder::add_thickness(Index node) {
  const Index e = add_freedom(node, Freedom::thickness);
  return {.e = e, .xi = add_freedom(node, Freedom::thickness2)};
}

// A beam that goes on straight with the same section has one thickness at its joint.
ThicknessFreedoms StructureBuilder::end_thickness(Index joint, const MemberDescription& member, double angle,
                                                  bool hinged) {
  constexpr double straight = 1e-9;  // [rad]
  const double height = member.section.height.value_or(0.0);
  for (const EndThickness& other : end_thickness_)
    if (other.joint == joint && !other.hinged && !hinged && other.height == height &&
        other.quadratic == member.quadratic && std::abs(std::remainder(other.angle - angle, 2.0 * pi)) <= straight)
      return other.freedoms;
  end_thickness_.push_back({.joint = joint,
                            .hinged = hinged,
                            .angle = angle,
                            .height = height,
                            .quadratic = member.quadratic,
                            .freedoms = add_thickness(joint)});
  return end_thickness_.back().freedoms;
}

std::vector<ThicknessFreedoms> StructureBuilder::thickness(Index joint) const {
  std::vector<ThicknessFreedoms> all;
  for (const EndThickness& end : end_thickness_)
    if (end.joint == joint) all.push_back(end.freedoms);
  return all;
}

Index StructureBuilder::add_member(MemberDescription member) {
  assert(member.elements >= 1 && member.axis != nullptr);
  assert(member.theory != Theory::exact || ((member.order == 1 || member.order == 2) && member.section.GA() > 0.0));
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
      rotation =
          first || last ? end_rotation(mesh.nodes.back(), hinged) : add_freedom(mesh.nodes.back(), Freedom::rotation);
    mesh.rotations.push_back(rotation);
    if (thickens)
      mesh.thickness.push_back(first || last ? end_thickness(mesh.nodes.back(), member, place.angle, hinged)
                                             : add_thickness(mesh.nodes.back()));
  }
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
  mesh.middle_rotations.push_back(add_freedom(mesh.middle_nodes.back(), Freedom::rotation));
  if (member.theory != Theory::essenburg) return;
  mesh.middle_thickness.push_back(add_thickness(mesh.middle_nodes.back()));
  mesh.middle_axis.push_back(member.axis->at(s));
  mesh.middle_shape.push_back(point);
}

void StructureBuilder::add_load(Index freedom, double value, LoadKind kind) {
  nodal_.add_load(freedom, kind == LoadKind::proportional ? Driven{.proportional = value} : Driven{.constant = value});
}

void StructureBuilder::add_distributed_load(Index member, const Vec2& load, LoadKind kind, LoadFrame frame) {
  distributed_loads_.push_back({.member = member, .load = load, .kind = kind, .frame = frame});
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
      ends.push_back({.x = freedom(joint, Freedom::x),
                      .z = freedom(joint, Freedom::z),
                      .rest = positions_[node] - origin(),
                      .excess = excess[node]});
  }
  return ends;
}

std::optional<Index> StructureBuilder::open_pressed_joint() const {
  for (const NodalTerms::PressedEnd& end : pressed_ends())
    if (!nodal_.is_held(end.x) && !nodal_.is_held(end.z)) return freedoms_[static_cast<std::size_t>(end.x)].node;
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

void StructureBuilder::add_foundation(Index member, Freedom direction, std::shared_ptr<const SpringLaw> law) {
  assert(descriptions_[static_cast<std::size_t>(member)].theory != Theory::truss);
  assert(direction == Freedom::x || direction == Freedom::z);
  foundations_[static_cast<std::size_t>(member)].add(direction == Freedom::x ? 0 : 1, std::move(law));
}

void StructureBuilder::add_element(std::shared_ptr<const Element> element, std::vector<Index> freedoms) {
  added_elements_.push_back({.element = std::move(element), .freedoms = std::move(freedoms)});
}

std::vector<Index> StructureBuilder::element_freedoms(const MemberMesh& mesh, std::size_t k) const {
  std::vector<Index> freedoms;
  const auto add = [&](Index node, std::optional<Index> rotation, const std::vector<ThicknessFreedoms>& thickness,
                       std::size_t at) {
    freedoms.push_back(freedom(node, Freedom::x));
    freedoms.push_back(freedom(node, Freedom::z));
    if (rotation) freedoms.push_back(*rotation);
    if (!thickness.empty()) freedoms.insert(freedoms.end(), {thickness[at].e, thickness[at].xi});
  };
  add(mesh.nodes[k], mesh.rotations[k], mesh.thickness, k);
  if (!mesh.middle_nodes.empty()) add(mesh.middle_nodes[k], mesh.middle_rotations[k], mesh.middle_thickness, k);
  add(mesh.nodes[k + 1], mesh.rotations[k + 1], mesh.thickness, k + 1);
  return freedoms;
}

double StructureBuilder::force_scale(const NodalTerms& terms, double length) const {
  return terms.greatest_proportional_load([&](Index freedom) {
    return freedoms_[static_cast<std::size_t>(freedom)].freedom == Freedom::rotation ? length : 1.0;
  });
}

std::vector<bool> StructureBuilder::nodes_with_terms() const {
  std::vector<bool> found(positions_.size(), false);
  for (std::size_t i = 0; i < freedoms_.size(); ++i) {
    const auto freedom = static_cast<Index>(i);
    if (!nodal_.load(freedom).is_zero() || nodal_.is_held(freedom) || nodal_.ground_stiffness(freedom) != 0.0)
      found[static_cast<std::size_t>(freedoms_[i].node)] = true;
  }
  for (const NodalTerms::Spring& spring : nodal_.springs())
    for (const Index freedom : {spring.first, spring.second})
      found[static_cast<std::size_t>(freedoms_[static_cast<std::size_t>(freedom)].node)] = true;
  for (const NodalTerms::LawSpring& spring : nodal_.law_springs())
    for (const Index freedom : {spring.first.value_or(spring.second), spring.second})
      found[static_cast<std::size_t>(freedoms_[static_cast<std::size_t>(freedom)].node)] = true;
  return found;
}

bool StructureBuilder::carries_force_alone(Index node, Index rotation) const {
  const auto is_free = [&](Index freedom) {
    const auto joins = [&](const NodalTerms::Spring& spring) {
      return spring.first == freedom || spring.second == freedom;
    };
    const auto& springs = nodal_.springs();
    const auto& others = nodal_.law_springs();
    const auto has = [&](const NodalTerms::LawSpring& spring) { return spring.joins(freedom); };
    if (std::any_of(others.begin(), others.end(), has)) return false;
    return !nodal_.is_held(freedom) && nodal_.ground_stiffness(freedom) == 0.0 &&
           std::none_of(springs.begin(), springs.end(), joins);
  };
  return is_free(freedom(node, Freedom::x)) && is_free(freedom(node, Freedom::z)) && is_free(rotation) &&
         nodal_.load(rotation).is_zero();
}

std::unique_ptr<Structure> StructureBuilder::build(bool ramp) const {
  const auto proportional = [&](LoadKind kind) {
    return ramp ? kind == LoadKind::constant : kind == LoadKind::proportional;
  };

  // Unknowns are numbered along the members, so that neighbours stay near.
  std::vector<std::int32_t> unknown_of_freedom(freedoms_.size(), -1), freedom_of_unknown;
  const auto number = [&](Index freedom) {
    auto& unknown = unknown_of_freedom[static_cast<std::size_t>(freedom)];
    if (unknown >= 0 || nodal_.is_held(freedom)) return;
    unknown = static_cast<std::int32_t>(freedom_of_unknown.size());
    freedom_of_unknown.push_back(static_cast<std::int32_t>(freedom));
  };
  ShiftedLists freedoms_of_elements;
  IndexLists blocks;
  const auto add_block = [&](std::vector<Index> of_element) {
    freedoms_of_elements.add(of_element);
    for (Index& freedom : of_element) {
      number(freedom);
      freedom = unknown_of_freedom[static_cast<std::size_t>(freedom)];
    }
    blocks.push_back(std::move(of_element));
  };
  for (const MemberMesh& mesh : meshes_)
    for (std::size_t k = 0; k + 1 < mesh.nodes.size(); ++k) add_block(element_freedoms(mesh, k));
  for (const AddedElement& added : added_elements_) add_block(added.freedoms);
  for (const NodalTerms::Spring& spring : nodal_.springs()) add_block({spring.first, spring.second});
  for (const NodalTerms::LawSpring& spring : nodal_.law_springs())
    if (spring.first) add_block({*spring.first, spring.second});

  auto structure = std::unique_ptr<Structure>(new Structure(static_cast<Index>(freedom_of_unknown.size()), blocks));
  structure->positions_ = positions_;
  structure->first_freedom_ = first_freedom_;
  structure->members_ = meshes_;
  freedom_of_unknown.shrink_to_fit();
  freedoms_of_elements.complete();
  structure->unknown_of_freedom_ = std::move(unknown_of_freedom);
  structure->freedom_of_unknown_ = std::move(freedom_of_unknown);
  structure->meaning_of_freedom_ = freedoms_;
  structure->element_freedoms_ = std::move(freedoms_of_elements);
  structure->length_scale_ = box_diagonal(positions_);

  const std::vector<ThermalStrain> thermal = thermal_of(ramp);
  std::vector<Index> first_element;
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    first_element.push_back(static_cast<Index>(structure->elements_.size()));
    add_elements(descriptions_[m], meshes_[m], thermal[m], structure->elements_);
  }
  structure->first_added_ = static_cast<Index>(structure->elements_.size());
  for (const AddedElement& added : added_elements_) structure->elements_.add(added.element);
  structure->elements_.shrink_to_fit();
  structure->nodal_ = nodal_terms(ramp);
  structure->arrange();

  structure->force_scale_ = force_scale(structure->nodal_, structure->length_scale_);
  for (const DistributedLoad& load : distributed_loads_) {
    if (ramp && load.kind == LoadKind::proportional) continue;
    const auto m = static_cast<std::size_t>(load.member);
    const MemberDescription& member = descriptions_[m];
    const ImperfectAxis shape(*member.axis, member.imperfection);
    const Driven factor = proportional(load.kind) ? Driven{.proportional = 1.0} : Driven{.constant = 1.0};
    for (std::size_t k = 0; k + 1 < meshes_[m].nodes.size(); ++k) {
      const Stretch stretch{.member = member, .shape = shape, .mesh = meshes_[m], .k = k};
      structure->element_loads_.push_back(
          {.potential = std::make_shared<DrivenLoad>(
               load.frame == LoadFrame::member ? make_axis_load(stretch, load.load) : make_load(stretch, load.load),
               factor),
           .element = first_element[m] + static_cast<Index>(k)});
    }
    if (proportional(load.kind))
      structure->force_scale_ = std::max(structure->force_scale_, load.load.norm() * member.axis->length());
  }
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    const double strain = std::abs(thermal[m].strain.proportional), bend = std::abs(thermal[m].curvature.proportional);
    const double L = structure->length_scale_;
    const Section& section = descriptions_[m].section;
    structure->heat_rate_ = std::max({structure->heat_rate_, strain, bend * L});
    structure->force_scale_ = std::max({structure->force_scale_, section.EA() * strain, section.EI() * bend / L});
  }
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    if (foundations_[m].is_zero()) continue;
    const MemberDescription& member = descriptions_[m];
    const ImperfectAxis shape(*member.axis, member.imperfection);
    for (std::size_t k = 0; k + 1 < meshes_[m].nodes.size(); ++k)
      structure->element_loads_.push_back(
          {.potential =
               make_foundation({.member = member, .shape = shape, .mesh = meshes_[m], .k = k}, foundations_[m]),
           .element = first_element[m] + static_cast<Index>(k),
           .is_grounded = true});
  }
  const std::vector<Driven> pressures = pressures_of(ramp);
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    if (pressures[m].is_zero()) continue;
    const MemberDescription& member = descriptions_[m];
    const ImperfectAxis shape(*member.axis, member.imperfection);
    for (std::size_t k = 0; k + 1 < meshes_[m].nodes.size(); ++k)
      structure->element_loads_.push_back(
          {.potential = std::make_shared<DrivenLoad>(
               make_pressure({.member = member, .shape = shape, .mesh = meshes_[m], .k = k}, origin()), pressures[m]),
           .element = first_element[m] + static_cast<Index>(k)});
    structure->force_scale_ =
        std::max(structure->force_scale_, std::abs(pressures[m].proportional) * member.axis->length());
  }

  std::vector<std::uint32_t>& loads = structure->loads_by_element_;
  loads.resize(structure->element_loads_.size());
  std::iota(loads.begin(), loads.end(), 0U);
  const auto element_of = [&](std::uint32_t load) { return structure->element_loads_[load].element; };
  std::stable_sort(loads.begin(), loads.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return element_of(a) < element_of(b); });
  if (!loads.empty()) structure->first_load_of_element_.push_back(0);
  auto behind = loads.begin();
  for (Index e = 0; e < structure->element_count() && !loads.empty(); ++e) {
    behind = std::find_if(behind, loads.end(), [&](std::uint32_t load) { return element_of(load) > e; });
    structure->first_load_of_element_.push_back(static_cast<std::uint32_t>(behind - loads.begin()));
  }

  const auto is_rotation = [](const Structure::Meaning& meaning) { return meaning.freedom == Freedom::rotation; };
  structure->rotations_ = static_cast<double>(std::count_if(freedoms_.begin(), freedoms_.end(), is_rotation));
  return structure;
}

}  // namespace arcwall
