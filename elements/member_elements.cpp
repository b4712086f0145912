#include "elements/member_elements.hpp"

#include <array>
#include <cmath>

#include "core/unit_tangent.hpp"
#include "elements/classic_beam.hpp"
#include "elements/distributed_load.hpp"
#include "elements/elastica_beam.hpp"
#include "elements/essenburg_beam.hpp"
#include "elements/foundation.hpp"
#include "elements/heated_beam.hpp"
#include "elements/pressure.hpp"
#include "elements/reissner_beam.hpp"
#include "elements/wall_pressure.hpp"

namespace arcwall {

namespace {

BeamReference beam_reference(const MemberElement& at) {
  const AxisPoint first = at.mesh.shape[at.k], second = at.mesh.shape[at.k + 1];
  const Vec2 chord = at.chord();
  const double direction = std::atan2(chord.y(), chord.x());
  const auto against_chord = [&](double angle) { return std::remainder(angle - direction, 2.0 * pi); };
  return {.chord = chord,
          .length = at.shape.length(at.arc(0.0), at.arc(1.0)),
          .slope1 = against_chord(first.angle),
          .slope2 = against_chord(second.angle)};
}

StretchReference slender_reference(const MemberElement& at) {
  StretchReference reference = stretch_reference(at.shape, at.arc(0.0), at.arc(1.0));
  reference.chord = at.chord();
  return reference;
}

// From its first node, so that places far from the origin keep their digits.
ExactBeamReference exact_reference(const MemberElement& at) {
  const AxisPoints& nodes = at.mesh.shape;
  ExactBeamReference reference{.nodes = {Vec2::Zero()}, .arcs = {0.0}};
  const auto add = [&](const Vec2& position, double fraction) {
    reference.nodes.push_back(position - nodes[at.k].position);
    reference.arcs.push_back(at.shape.length(at.arc(0.0), at.arc(fraction)));
  };
  if (at.member.order == 2) add(at.shape.at(at.arc(0.5)).position, 0.5);
  add(nodes[at.k + 1].position, 1.0);
  return reference;
}

EssenburgReference essenburg_reference(const MemberElement& at) {
  const MemberMesh& mesh = at.mesh;
  const Vec2 origin = mesh.shape[at.k].position;
  EssenburgReference reference;
  const auto add = [&](const AxisPoint& axis, const AxisPoint& shape) {
    const MemberSection section{.axis = axis, .shape = shape, .quadratic = at.member.quadratic};
    reference.nodes.push_back(shape.position - origin);
    reference.sections.push_back(section.kinematics());
  };
  add(mesh.axis[at.k], mesh.shape[at.k]);
  if (at.member.order == 2) add(mesh.middle_axis[at.k], mesh.middle_shape[at.k]);
  add(mesh.axis[at.k + 1], mesh.shape[at.k + 1]);
  return reference;
}

// At a fraction of an element.
std::function<ExactBeamStiffness(double)> exact_stiffness(const MemberElement& at) {
  return [&at](double fraction) {
    const Section section = at.member.section.at((double(at.k) + fraction) / at.count());
    return ExactBeamStiffness{.EA = section.EA(), .GA = section.GA(), .EI = section.EI()};
  };
}

EssenburgStiffness essenburg_stiffness(const Section& section) {
  return {.E = section.E,
          .nu = 0.5 * section.E / section.G - 1.0,
          .shear_correction = section.shear_area / section.A,
          .points = section.points};
}

SlenderSection slender_section(const MemberElement& at) {
  return slender_section(at.member.section, at.member.theory, at.member.order, at.member.axis->length());
}

// Under temperatures.
std::unique_ptr<Element> make_heated_element(const MemberElement& at, const ThermalStrain& thermal) {
  const Section& section = at.member.section;
  switch (at.member.theory) {
    case Theory::euler_bernoulli:
    case Theory::elastica:
      return std::make_unique<HeatedBeam>(slender_reference(at), slender_section(at), thermal);
    case Theory::reissner:
      return std::make_unique<HeatedReissnerBeam>(exact_reference(at), exact_stiffness(at), thermal);
    case Theory::truss:
      return std::make_unique<HeatedTruss>(beam_reference(at).chord, section.EA(), at.member.strain, thermal.strain);
    case Theory::essenburg:
      break;
  }
  return nullptr;
}

std::unique_ptr<Element> make_element(const MemberElement& at) {
  const Section& section = at.member.section;
  switch (at.member.theory) {
    case Theory::euler_bernoulli:
      if (!section.taper) return std::make_unique<ClassicBeam>(beam_reference(at), section.EA(), section.EI());
      [[fallthrough]];
    case Theory::elastica: {
      const SlenderSection slender = slender_section(at);
      return std::make_unique<ElasticaBeam>(slender_reference(at), slender.EA, slender.EI,
                                            slender.order.value_or(ElasticaOrder::four), slender.taper);
    }
    case Theory::reissner:
      return std::make_unique<ReissnerBeam>(exact_reference(at), exact_stiffness(at));
    case Theory::essenburg:
      return std::make_unique<EssenburgBeam>(essenburg_reference(at), essenburg_stiffness(section));
    case Theory::truss:
      return std::make_unique<Truss>(beam_reference(at).chord, section.EA(), at.member.strain);
  }
  return nullptr;
}

}  // namespace

SlenderSection slender_section(const Section& section, Theory theory, int order, double length) {
  SlenderSection slender{.EA = section.EA(), .EI = section.EI()};
  if (theory == Theory::elastica) slender.order = order == 6 ? ElasticaOrder::six : ElasticaOrder::four;
  if (section.taper) slender.taper = {.sizes = section.taper, .length = length, .A = section.A, .I = section.I};
  return slender;
}

void add_elements(const MemberDescription& member, const MemberMesh& mesh, const ThermalStrain& thermal,
                  ElementList& elements) {
  const ImperfectAxis shape(*member.axis, member.imperfection);
  const auto element = [&](std::size_t k) {
    return MemberElement{.member = member, .shape = shape, .mesh = mesh, .k = k};
  };
  const std::size_t count = mesh.nodes.size() - 1;
  const auto make = [&](std::size_t k) {
    return thermal.is_zero() ? make_element(element(k)) : make_heated_element(element(k), thermal);
  };
  const bool knows_places =
      member.theory == Theory::reissner || member.theory == Theory::essenburg || member.section.taper != nullptr;
  if (!knows_places && element(0).is_like_all_others())
    elements.add(make(0), count);
  else
    for (std::size_t k = 0; k < count; ++k) elements.add(make(k));
}

std::unique_ptr<Element> make_load(const MemberElement& at, const LineLoad& load) {
  const auto along = [&](double fraction) {
    const double S = at.arc(fraction);
    return load.at(S, load.is_straight() ? 0.0 : at.shape.at(S).angle);
  };
  const auto pieces = [&] {
    return SmoothPieces(load, [&](double fraction) { return at.shape.at(at.arc(fraction)).angle; });
  };
  switch (at.member.theory) {
    case Theory::euler_bernoulli:
    case Theory::elastica:
      return std::make_unique<BeamDistributedLoad>(slender_reference(at), load, at.arc(0.0), at.arc(1.0));
    case Theory::reissner:
      return std::make_unique<ExactDistributedLoad>(exact_reference(at), along, 3, pieces());
    case Theory::essenburg:
      return std::make_unique<ExactDistributedLoad>(exact_reference(at), along, EssenburgBeam::unknowns_a_node,
                                                    pieces());
    case Theory::truss: {  // straight: the load is linear
      const Vec2 first = along(0.0), second = along(1.0);
      const double L = beam_reference(at).length;
      return std::make_unique<TrussDistributedLoad>(
          std::array<Vec2, 2>{L / 6.0 * (2.0 * first + second), L / 6.0 * (first + 2.0 * second)});
    }
  }
  return nullptr;
}

std::unique_ptr<Element> make_foundation(const MemberElement& at, const FoundationLaw& law) {
  switch (at.member.theory) {
    case Theory::euler_bernoulli:
    case Theory::elastica:
      return std::make_unique<BeamFoundation>(slender_reference(at), law);
    case Theory::reissner:
      return std::make_unique<ExactFoundation>(exact_reference(at), law);
    case Theory::essenburg:
      return std::make_unique<ExactFoundation>(exact_reference(at), law, EssenburgBeam::unknowns_a_node);
    case Theory::truss:
      break;
  }
  return nullptr;
}

namespace {

// Of a slender or shear-flexible beam, at a fraction of the element; `face`: how many half heights the line that
// touches is off the axis.
WallPressure::Node wall_node(const MemberElement& at, const CompliantWall& wall, const AxisPoint& axis,
                             const AxisPoint& shape, double fraction, double face) {
  const double member_fraction = (double(at.k) + fraction) / at.count();
  const double half = 0.5 * at.mesh.height_at(member_fraction).value_or(0.0);
  const MemberSection section{.axis = axis, .shape = shape, .quadratic = at.member.quadratic};
  double growth = 0.0;  // of the half height along the axis
  if (at.mesh.taper != nullptr && face != 0.0)
    growth = 0.5 * at.mesh.taper->at(member_fraction, 1).height / at.mesh.length;
  return {.place = shape.position,
          .section = section.kinematics(),
          .offset = face * half,
          .angle = shape.angle + std::atan(face * growth),
          .kept_off = wall.touched == CompliantWall::Touched::outside ? half - wall.kept_off : 0.0,
          .arc = at.shape.length(at.arc(0.0), at.arc(fraction))};
}

// The faces that look at a wall, as numbers of half heights: FacedObstacle::offsets() of the element's chord.
std::vector<double> faces_towards(const CompliantWall& wall, const Vec2& chord) {
  if (wall.touched != CompliantWall::Touched::face) return {0.0};
  constexpr double level = 1e-9;
  const double up = (wall.is_over ? 1.0 : -1.0) * chord.x() / chord.norm();
  if (std::abs(up) <= level) return {1.0, -1.0};
  return {up > 0.0 ? 1.0 : -1.0};
}

}  // namespace

std::vector<std::unique_ptr<Element>> make_wall_pressures(const MemberElement& at, const CompliantWall& wall,
                                                          bool ramp) {
  const MemberMesh& mesh = at.mesh;
  const bool is_slender = at.member.theory == Theory::euler_bernoulli || at.member.theory == Theory::elastica;
  std::vector<std::unique_ptr<Element>> pressures;
  const auto on_line = [&](double face) {
    std::vector<WallPressure::Node> nodes;
    const auto add = [&](const AxisPoint& axis, const AxisPoint& shape, double fraction) {
      nodes.push_back(wall_node(at, wall, axis, shape, fraction, face));
    };
    add(mesh.axis[at.k], mesh.shape[at.k], 0.0);
    if (!is_slender && at.member.order == 2) {
      const double middle = at.arc(0.5);
      add(at.member.axis->at(middle), at.shape.at(middle), 0.5);
    }
    add(mesh.axis[at.k + 1], mesh.shape[at.k + 1], 1.0);
    const int stride = at.member.theory == Theory::essenburg ? EssenburgBeam::unknowns_a_node : 3;
    return std::make_unique<WallPressure>(is_slender ? WallPressure::Shape::cubic : WallPressure::Shape::lagrange,
                                          std::move(nodes), stride, ramp ? wall.gap_of_ramp : wall.gap, wall.law);
  };
  for (const double face : faces_towards(wall, at.chord())) {
    auto pressure = on_line(face);
    if (wall.rubs_axis && face != 0.0) pressure->set_rubbing_line(on_line(0.0));
    pressures.push_back(std::move(pressure));
  }
  return pressures;
}

std::unique_ptr<Element> make_pressure(const MemberElement& at, const Vec2& origin) {
  const Vec2 first = at.mesh.shape[at.k].position - origin;
  switch (at.member.theory) {
    case Theory::euler_bernoulli:
    case Theory::elastica:
      return std::make_unique<BeamPressure>(beam_reference(at), first);
    case Theory::reissner:
      return std::make_unique<ExactPressure>(exact_reference(at), first);
    case Theory::essenburg:
      return std::make_unique<ExactPressure>(exact_reference(at), first, EssenburgBeam::unknowns_a_node);
    case Theory::truss:
      break;
  }
  return nullptr;
}

}  // namespace arcwall
