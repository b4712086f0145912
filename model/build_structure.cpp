#include "model/build_structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "elements/mechanism.hpp"
#include "model/build_compliant_walls.hpp"

namespace arcwall {

namespace {

Vec2 vec(const deck::Vector& v) { return {v.x, v.z}; }

std::unique_ptr<Axis> make_axis(const deck::Member& member, const Vec2& from, const Vec2& to) {
  struct Maker {
    const Vec2 &from, &to;
    std::unique_ptr<Axis> operator()(const deck::Straight&) const { return straight_axis(from, to); }
    std::unique_ptr<Axis> operator()(const deck::Arc& arc) const { return arc_axis(from, vec(arc.via), to); }
    std::unique_ptr<Axis> operator()(const deck::SineAxis& sine) const {
      return sine_axis(from, to, sine.rise, sine.waves);
    }
    std::unique_ptr<Axis> operator()(const deck::Curve& curve) const {
      std::vector<Vec2> points;
      for (std::size_t i = 0; i < curve.x.size(); ++i) points.emplace_back(curve.x[i], curve.z[i]);
      return spline_axis(points);
    }
  };
  return std::visit(Maker{from, to}, member.axis);
}

// Shear area over area of the exact theory: Cowper's (1966) for no lateral contraction, of which 5/6 for the rectangle
// is the best known. A ring of the radii's ratio m has 6 (1 + m²)² / (7 (1 + m²)² + 20 m²): 6/7 for a circle, ½ for a
// thin tube. A general section counts as a rectangle.
double shear_correction(const deck::Section& section, double fraction) {
  struct Correction {
    static double ring(double m) {
      const double square = (1.0 + m * m) * (1.0 + m * m);
      return 6.0 * square / (7.0 * square + 20.0 * m * m);
    }
    double operator()(const deck::Rectangle&) const { return 5.0 / 6.0; }
    double operator()(const deck::Circle&) const { return ring(0.0); }
    double operator()(const deck::Tube& tube) const {
      const auto at = [&](double from, const std::optional<double>& to) {
        return from + fraction * (to.value_or(from) - from);
      };
      return ring(1.0 - at(tube.thickness, tube.thickness_to) / at(tube.radius, tube.radius_to));
    }
    double operator()(const deck::General&) const { return 5.0 / 6.0; }
    double operator()(const deck::SectionTable&) const { return 5.0 / 6.0; }
    double fraction;
  };
  return section.shear_correction.value_or(std::visit(Correction{fraction}, section.shape));
}

std::vector<SectionPoint> section_points(const deck::Section& section) {
  struct Points {
    std::vector<SectionPoint> operator()(const deck::Rectangle& of) const {
      return rectangle_points(of.width, of.height);
    }
    std::vector<SectionPoint> operator()(const deck::Circle& of) const { return circle_points(of.radius); }
    std::vector<SectionPoint> operator()(const deck::Tube& of) const { return tube_points(of.radius, of.thickness); }
    std::vector<SectionPoint> operator()(const deck::General&) const { return {}; }  // refused by the reader
    std::vector<SectionPoint> operator()(const deck::SectionTable&) const { return {}; }
  };
  return std::visit(Points{}, section.shape);
}

SectionSizes sizes_of(const deck::Section& section, double fraction) {
  const deck::SectionProperties properties = deck::properties(section, fraction);
  return {.A = properties.A,
          .I = properties.I,
          .height = properties.height.value_or(0.0),
          .shear_area = properties.shear_area.value_or(shear_correction(section, fraction) * properties.A)};
}

std::shared_ptr<const SectionTaper> taper_of(const deck::Section& section) {
  if (!deck::tapers(section)) return nullptr;
  std::vector<double> breaks{0.0, 1.0};
  if (const auto* table = std::get_if<deck::SectionTable>(&section.shape)) breaks = table->at;
  if (std::holds_alternative<deck::Tube>(section.shape)) {  // its shear correction is no polynomial
    constexpr int parts = 16;
    breaks.clear();
    for (int i = 0; i <= parts; ++i) breaks.push_back(double(i) / parts);
  }
  return std::make_shared<SectionTaper>(std::move(breaks),
                                        [&](double fraction) { return sizes_of(section, fraction); });
}

Section section_of(const deck::Deck& deck, const deck::Member& member) {
  const deck::Section& described = *deck::find(deck.sections, member.section);
  const deck::Material& material = *deck::find(deck.materials, member.material);
  const deck::SectionProperties properties = deck::properties(described, 0.5);
  Section section{
      .E = material.E, .A = properties.A, .I = properties.I, .height = properties.height, .taper = taper_of(described)};
  const bool essenburg = member.theory == Theory::essenburg;
  if (member.theory != Theory::reissner && !essenburg) return section;
  section.G = material.E / (2.0 * (1.0 + material.nu.value()));
  if (essenburg) {
    section.shear_area = described.shear_correction.value_or(1.0) * properties.A;
    section.points = section_points(described);
    return section;
  }
  section.shear_area = sizes_of(described, 0.5).shear_area;
  return section;
}

// What can move without strain does not depend on how stiff a member is in bending and shear, but shows best where both
// are as stiff as the axis: in a thin beam shear is far stiffer than bending.
Section balanced(Section section, double length) {
  section.taper = nullptr;
  section.I = section.A * length * length;
  section.G = section.E;
  section.shear_area = section.A;
  return section;
}

// A section of finite height needs an axis that bends less: at the centre of curvature its fibres would meet.
void check_curvature(const deck::Member& member, const MemberDescription& description, double unit,
                     DeckProblems& problems) {
  const ImperfectAxis shape(*description.axis, description.imperfection);
  const int places = 2 * member.elements;
  for (int i = 0; i <= places; ++i) {
    const DeviatedPoint at = shape.along(description.axis->length() * i / places);
    const double radius = std::abs(at.speed / at.turning);
    if (radius > 0.5 * description.section.height.value()) continue;
    problems.add(
        member.position, "member." + member.name,
        fmt::format("at {} of its length the axis has a radius of {:.4g}, less than half the height of section {}",
                    double(i) / places, unit * radius, member.section),
        "bend the axis less, or take theory \"euler-bernoulli\" or \"elastica\"");
    return;
  }
}

// Stiffnesses of an element, over their units, and its length against the coordinates and the height of its section,
// which are only so fine.
void check_magnitudes(const deck::Member& member, const MemberDescription& description, const Places& places,
                      const deck::Frame& frame, DeckProblems& problems) {
  const double h = description.axis->length() / member.elements;
  const double EA = description.section.EA();
  const double EI = member.theory == Theory::truss ? EA * h * h : description.section.EI();
  const bool shears = member.theory == Theory::reissner || member.theory == Theory::essenburg;
  const double GA = shears ? description.section.GA() : EA;
  const auto far = [&](const std::string& name) {
    return frame.place(places.ends.at(name)).cwiseAbs().maxCoeff() / frame.factor();
  };
  const double height = description.section.height.value_or(0.0);
  const bool is_long_enough = h > 1e-12 * std::max({far(member.from), far(member.to), height});
  const auto is_usable = [](double value) { return value > 1e-100 && value < 1e100; };
  if (is_long_enough && is_usable(h) && is_usable(EA / h) && is_usable(GA / h) && is_usable(EI / h) &&
      is_usable(EI / (h * h * h)))
    return;
  problems.add(
      member.position, "member." + member.name,
      fmt::format("with elements of length {:.4g}, EA = {:.4g} and EI = {:.4g} its stiffness cannot be computed "
                  "with numbers of 16 digits",
                  frame.factor() * h, EA, frame.factor(2) * EI),
      "choose units in which lengths and forces are nearer to 1, and an origin near the structure");
}

// A deviation that is as large as the member itself makes another structure of it, and a very large one makes lengths
// that are not numbers.
void check_imperfections(const deck::Member& member, const MemberDescription& description, double unit,
                         DeckProblems& problems) {
  const double length = description.axis->length();
  for (const deck::Imperfection& wave : member.imperfections)
    if (!(std::abs(wave.amplitude) < length))
      problems.add(wave.position, "member." + member.name + ".imperfection",
                   fmt::format("an amplitude of {:.4g} is as large as the member is long, {:.4g}",
                               unit * wave.amplitude, unit * length),
                   "an imperfection is a small part of the length, often 1/1000; give a bent axis by \"sine\" or "
                   "\"curve\"");
}

// As few as show what holds the member: the nodes at which springs stand are among them, and a foundation, which may
// hold a bent axis by its middle, has one inside.
int fewest_elements(const deck::Deck& deck, const deck::Member& member) {
  int fewest = 1;
  for (const deck::Spring& spring : deck.springs) {
    const auto* ground = std::get_if<deck::GroundSpring>(&spring.kind);
    if (ground != nullptr && ground->at.fraction && ground->at.name == member.name) return member.elements;
    const auto* along = std::get_if<deck::Foundation>(&spring.kind);
    if (along != nullptr && along->member == member.name) fewest = 2;
  }
  return fewest;
}

// As told, or the coarsest model, which is to find out what moves without strain.
MemberDescription description_of(const deck::Deck& deck, const deck::Member& member, bool coarse,
                                 const StructureOfDeck& out) {
  const Theory theory = member.theory;
  MemberDescription description{.name = member.name,
                                .from = out.places.joints.at(member.from),
                                .to = out.places.joints.at(member.to),
                                .theory = theory,
                                .order = member.order.value_or(2),
                                .quadratic = member.along,
                                .strain = member.strain,
                                .section = section_of(deck, member),
                                .elements = coarse ? fewest_elements(deck, member) : member.elements,
                                .hinge_from = member.hinge_from,
                                .hinge_to = member.hinge_to};
  description.axis = make_axis(member, out.places.ends.at(member.from), out.places.ends.at(member.to));
  // A classic element moves without strain where one of the elastica does, and takes any bend of its axis; an exact
  // one where one of Essenburg's does, whose thickness has a stiffness of its own.
  if (coarse && theory == Theory::elastica) description.theory = Theory::euler_bernoulli;
  if (coarse && theory == Theory::essenburg) description.theory = Theory::reissner;
  if (coarse && description.theory == Theory::reissner)
    description.section = balanced(description.section, description.axis->length());
  for (const deck::Imperfection& wave : member.imperfections)
    description.imperfection.push_back({.amplitude = wave.amplitude, .waves = wave.waves});
  return description;
}

// No member is built of numbers that are out of range: its stiffness may be zero.
void add_members(const deck::Deck& deck, bool coarse, DeckProblems& problems, StructureOfDeck& out) {
  std::vector<MemberDescription> descriptions;
  descriptions.reserve(deck.members.size());
  out.builder.expect_members(deck.members.size());
  for (const deck::Member& member : deck.members) {
    descriptions.push_back(description_of(deck, member, coarse, out));
    if (coarse) continue;
    check_magnitudes(member, descriptions.back(), out.places, deck.frame, problems);
    check_imperfections(member, descriptions.back(), deck.frame.factor(), problems);
  }
  problems.raise();
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    const deck::Member& member = deck.members[i];
    if (descriptions[i].theory == Theory::truss && member.elements > 1)
      problems.add(
          member.position, "member." + member.name + ".elements",
          fmt::format("a truss of {} elements is a chain of hinges that can move without strain", member.elements),
          "use elements = 1, or theory = \"euler-bernoulli\"");
    if (member.theory == Theory::essenburg) check_curvature(member, descriptions[i], deck.frame.factor(), problems);
    out.places.members[member.name] = out.builder.add_member(std::move(descriptions[i]));
  }
}

void fix_thickness(const deck::Support& support, Dof direction, DeckProblems& problems, StructureOfDeck& out) {
  const std::vector<ThicknessDofs> ends = out.builder.thickness(out.places.joints.at(support.point));
  for (const ThicknessDofs& end : ends) out.builder.fix(direction == Dof::thickness ? end.e : end.xi);
  if (ends.empty())
    problems.add(support.position, "support." + support.point,
                 "no member of theory \"essenburg\" ends at \"" + support.point + "\": there is no thickness to fix",
                 "leave out \"thickness\" and \"thickness2\"");
}

void add_support(const deck::Support& support, DeckProblems& problems, StructureOfDeck& out) {
  const Index joint = out.places.joints.at(support.point);
  for (const Dof direction : support.directions) {
    const std::string key = "support." + support.point;
    switch (direction) {
      case Dof::x:
        out.builder.fix(out.builder.dof(joint, Dof::x));
        break;
      case Dof::z:
        out.builder.fix(out.builder.dof(joint, Dof::z));
        break;
      case Dof::rotation:
        if (const auto rotation = out.builder.shared_rotation(joint)) {
          out.builder.fix(*rotation);
        } else {
          problems.add(support.position, key, "no member end at \"" + support.point + "\" has a rotation to fix",
                       "leave out \"rotation\", or join a beam there without a hinge");
        }
        break;
      case Dof::thickness:
      case Dof::thickness2:
        fix_thickness(support, direction, problems, out);
        break;
    }
  }
}

// Displacements and rotation of a node; that of a joint is the one that its rigidly joined member ends share.
struct NodeDofs {
  Index x, z;
  std::optional<Index> rotation;
};

NodeDofs dofs_at(const StructureBuilder& builder, Index node, std::optional<Index> rotation) {
  return {.x = builder.dof(node, Dof::x), .z = builder.dof(node, Dof::z), .rotation = rotation};
}

NodeDofs dofs_of_joint(const StructureOfDeck& of, const std::string& point) {
  const Index joint = of.places.joints.at(point);
  return dofs_at(of.builder, joint, of.builder.shared_rotation(joint));
}

// A fraction is a node of the deck's mesh.
std::optional<NodeDofs> dofs_at(const StructureOfDeck& of, const deck::Place& place) {
  if (!place.fraction) return dofs_of_joint(of, place.name);
  const auto member = of.places.members.find(place.name);
  if (member == of.places.members.end()) return std::nullopt;
  const MemberMesh& mesh = of.builder.mesh(member->second);
  const auto k = static_cast<std::size_t>(std::lround(*place.fraction * double(mesh.nodes.size() - 1)));
  return dofs_at(of.builder, mesh.nodes[k], mesh.rotations[k]);
}

// In the coarsest model loads inside members play no part.
void add_point_load(const deck::Load& load, const deck::PointLoad& action, bool coarse, DeckProblems& problems,
                    StructureOfDeck& out) {
  const LoadKind kind = load.constant ? LoadKind::constant : LoadKind::proportional;
  if (action.at.fraction && coarse) return;
  const auto dofs = dofs_at(out, action.at);
  if (!dofs) return;
  out.builder.add_load(dofs->x, action.force.x, kind);
  out.builder.add_load(dofs->z, action.force.z, kind);
  if (action.has_force) out.builder.expect_load(dofs->x);
  if (action.moment == 0.0 && !action.has_moment) return;
  if (dofs->rotation) {
    out.builder.add_load(*dofs->rotation, action.moment, kind);
    if (action.has_moment) out.builder.expect_load(*dofs->rotation);
  } else {
    problems.add(action.at.position, "load.moment", "nothing at \"" + to_text(action.at) + "\" can take a moment",
                 "put the moment where a beam is joined without a hinge");
  }
}

Driven driven(const deck::Load& load, double value) {
  return load.constant ? Driven{.constant = value} : Driven{.proportional = value};
}

// Hotter on the left the section bends to the right.
void add_heat(const deck::Deck& deck, const deck::Load& load, const deck::Heat& heat, StructureOfDeck& out) {
  const deck::Member& member = *deck::find(deck.members, heat.member);
  const double expansion = deck::find(deck.materials, member.material)->expansion.value();
  out.builder.add_thermal_strain(
      out.places.members.at(heat.member),
      {.strain = driven(load, expansion * heat.temperature), .curvature = driven(load, -expansion * heat.gradient)});
}

void add_loads(const deck::Deck& deck, bool coarse, DeckProblems& problems, StructureOfDeck& out) {
  for (const deck::Load& load : deck.loads) {
    if (const auto* at_point = std::get_if<deck::PointLoad>(&load.action)) {
      add_point_load(load, *at_point, coarse, problems, out);
    } else if (const auto* heat = std::get_if<deck::Heat>(&load.action)) {
      if (!coarse && out.places.members.contains(heat->member)) add_heat(deck, load, *heat, out);
    } else if (const auto* pressure = std::get_if<deck::Pressure>(&load.action)) {
      if (!coarse && out.places.members.contains(pressure->member))
        out.builder.add_pressure(out.places.members.at(pressure->member), driven(load, pressure->pressure));
    } else {
      const auto& on_member = std::get<deck::MemberLoad>(load.action);
      if (!out.places.members.contains(on_member.member)) continue;
      const Index member = out.places.members.at(on_member.member);
      out.builder.add_distributed_load(member, on_member.along(out.builder.length_of(member)),
                                       load.constant ? LoadKind::constant : LoadKind::proportional);
    }
  }
}

// --- movements of supports ------------------------------------------------------------------------------------------

// Movements of one direction add.
template <class Joined>
void move_supports(const deck::Deck& deck, const Joined& joined, DeckProblems& problems, StructureOfDeck& out) {
  std::map<Index, Driven> moved;
  for (const deck::Prescribed& one : deck.prescribed) {
    if (!joined(one.point, one.position, "prescribed.at")) continue;
    const NodeDofs dofs = dofs_of_joint(out, one.point);
    const auto move = [&](Index dof, double value) {
      if (!one.holds) return out.builder.expect_hold(dof);
      moved[dof] += one.constant ? Driven{.constant = value} : Driven{.proportional = value};
    };
    if (one.x) move(dofs.x, *one.x);
    if (one.z) move(dofs.z, *one.z);
    if (!one.rotation) continue;
    if (dofs.rotation) {
      move(*dofs.rotation, *one.rotation);
    } else {
      problems.add(one.position, "prescribed.rotation", "no member end at \"" + one.point + "\" has a rotation",
                   "leave out rotation, or join a beam there without a hinge");
    }
  }
  for (const auto& [dof, value] : moved) out.builder.fix(dof, value);
}

// --- pressure -------------------------------------------------------------------------------------------------------

void check_pressure(const deck::Deck& deck, DeckProblems& problems, const StructureOfDeck& of) {
  const auto open = of.builder.open_pressed_joint();
  if (!open) return;
  std::string point;
  for (const auto& [name, node] : of.places.joints)
    if (node == *open) point = name;
  for (const deck::Load& load : deck.loads) {
    const auto* pressure = std::get_if<deck::Pressure>(&load.action);
    const deck::Member* member = pressure == nullptr ? nullptr : deck::find(deck.members, pressure->member);
    if (member == nullptr || (member->from != point && member->to != point)) continue;
    return problems.add(
        load.position, "load.pressure",
        fmt::format("the pressure on {} ends at \"{}\", which is free in x and z: its work depends on "
                    "the way that point goes, so that there is no energy and a motion that grows "
                    "without a singular stiffness (flutter) would not be seen",
                    member->name, point),
        "hold the point in x or z, press the members that continue there alike, close the ring, or take "
        "a dead load, distributed");
  }
}

// --- springs --------------------------------------------------------------------------------------------------------

void report_no_rotation(const deck::Spring& spring, const std::string& place, bool by_law, DeckProblems& problems) {
  problems.add(spring.position, by_law ? "spring.law.direction" : "spring.stiffness.rotation",
               "no member end at \"" + place + "\" has a rotation",
               "leave out rotation, or join a beam there without a hinge");
}

std::optional<Index> dof_in(const NodeDofs& dofs, Dof direction) {
  if (direction == Dof::rotation) return dofs.rotation;
  return direction == Dof::x ? dofs.x : dofs.z;
}

// What moves without strain depends on how the spring begins alone.
void add_law(const deck::TableLaw& table, std::optional<Index> first, Index second, bool coarse, StructureOfDeck& out) {
  auto law = std::make_shared<const SpringLaw>(table.law());
  if (!coarse) return out.builder.add_spring(first, second, std::move(law));
  const double stiffness = law->at(0.0).stiffness;
  if (stiffness <= 0.0) return;
  if (first) return out.builder.add_spring(*first, second, stiffness);
  out.builder.add_ground_stiffness(second, stiffness);
}

void add_spring(const deck::Spring& spring, const deck::GroundSpring& ground, bool coarse, DeckProblems& problems,
                StructureOfDeck& out) {
  const auto dofs = dofs_at(out, ground.at);
  if (!dofs) return;
  if (ground.law) {
    const auto dof = dof_in(*dofs, ground.law->direction);
    if (!dof) return report_no_rotation(spring, to_text(ground.at), true, problems);
    return add_law(*ground.law, std::nullopt, *dof, coarse, out);
  }
  const auto add = [&](Index dof, double stiffness) {
    if (stiffness > 0.0) out.builder.add_ground_stiffness(dof, stiffness);
  };
  add(dofs->x, ground.stiffness.x);
  add(dofs->z, ground.stiffness.z);
  if (dofs->rotation) return add(*dofs->rotation, ground.stiffness.rotation);
  if (ground.stiffness.rotation > 0.0) report_no_rotation(spring, to_text(ground.at), false, problems);
}

void add_spring(const deck::Spring& spring, const deck::PointToPointSpring& between, bool coarse,
                DeckProblems& problems, StructureOfDeck& out) {
  const NodeDofs first = dofs_of_joint(out, between.points[0]);
  const NodeDofs second = dofs_of_joint(out, between.points[1]);
  if (between.law) {
    const auto a = dof_in(first, between.law->direction), b = dof_in(second, between.law->direction);
    if (!a || !b) return report_no_rotation(spring, a ? between.points[1] : between.points[0], true, problems);
    return add_law(*between.law, *a, *b, coarse, out);
  }
  const auto add = [&](Index a, Index b, double stiffness) {
    if (stiffness > 0.0) out.builder.add_spring(a, b, stiffness);
  };
  add(first.x, second.x, between.stiffness.x);
  add(first.z, second.z, between.stiffness.z);
  if (first.rotation && second.rotation) return add(*first.rotation, *second.rotation, between.stiffness.rotation);
  if (between.stiffness.rotation > 0.0)
    report_no_rotation(spring, first.rotation ? between.points[1] : between.points[0], false, problems);
}

// What moves without strain does not depend on how the springs are spread between the nodes.
void add_foundation(const deck::Deck& deck, const deck::Spring& spring, const deck::Foundation& foundation, bool coarse,
                    DeckProblems& problems, StructureOfDeck& out) {
  const auto member = out.places.members.find(foundation.member);
  if (member == out.places.members.end()) return;
  if (deck::find(deck.members, foundation.member)->theory == Theory::truss)
    return problems.add(
        spring.position, "spring.on",
        "member \"" + foundation.member + "\" is a truss, which cannot carry the forces of a foundation",
        "use theory \"euler-bernoulli\" or \"elastica\", or springs at its ends");
  Vec2 stiffness(foundation.x, foundation.z);
  if (foundation.law) {
    auto law = std::make_shared<const SpringLaw>(foundation.law->law());
    if (!coarse) return out.builder.add_foundation(member->second, foundation.law->direction, std::move(law));
    stiffness[foundation.law->direction == Dof::x ? 0 : 1] = law->at(0.0).stiffness;
  }
  if (!coarse) return out.builder.add_foundation(member->second, stiffness);
  for (const Index node : out.builder.mesh(member->second).nodes) {
    if (stiffness.x() > 0.0) out.builder.add_ground_stiffness(out.builder.dof(node, Dof::x), stiffness.x());
    if (stiffness.y() > 0.0) out.builder.add_ground_stiffness(out.builder.dof(node, Dof::z), stiffness.y());
  }
}

// The points at which a spring stands.
std::vector<std::string> points_of(const deck::Spring& spring) {
  if (const auto* between = std::get_if<deck::PointToPointSpring>(&spring.kind)) return between->points;
  const auto* ground = std::get_if<deck::GroundSpring>(&spring.kind);
  if (ground == nullptr || ground->at.fraction) return {};
  return {ground->at.name};
}

template <class Joined>
void add_springs(const deck::Deck& deck, bool coarse, const Joined& joined, DeckProblems& problems,
                 StructureOfDeck& out) {
  for (const deck::Spring& spring : deck.springs) {
    const std::vector<std::string> points = points_of(spring);
    const auto is_joined = [&](const std::string& point) { return joined(point, spring.position, "spring"); };
    if (!std::all_of(points.begin(), points.end(), is_joined)) continue;
    if (const auto* along = std::get_if<deck::Foundation>(&spring.kind)) {
      add_foundation(deck, spring, *along, coarse, problems, out);
    } else if (const auto* ground = std::get_if<deck::GroundSpring>(&spring.kind)) {
      add_spring(spring, *ground, coarse, problems, out);
    } else {
      add_spring(spring, std::get<deck::PointToPointSpring>(spring.kind), coarse, problems, out);
    }
  }
}

}  // namespace

Places::Node Places::find(const deck::Place& place, const std::vector<MemberMesh>& meshes) const {
  if (!place.fraction) return {.node = joints.at(place.name)};
  const MemberMesh& mesh = meshes[static_cast<std::size_t>(members.at(place.name))];
  const auto k = static_cast<std::size_t>(std::lround(*place.fraction * double(mesh.nodes.size() - 1)));
  return {.node = mesh.nodes[k], .member = &mesh, .position = k};
}

StructureOfDeck describe_structure(const deck::Deck& deck, DeckProblems& problems, Mesh mesh) {
  const bool coarse = mesh == Mesh::coarsest;
  StructureOfDeck out;
  // Points that no member joins stay out: they would be nodes without stiffness.
  std::unordered_map<std::string_view, Vec2> points;
  for (const deck::Point& point : deck.points) points.emplace(point.name, vec(point.at));
  for (const deck::Member& member : deck.members)
    for (const std::string& name : {member.from, member.to}) {
      if (!out.places.ends.emplace(name, points.at(name)).second) continue;
      out.places.joints[name] = out.builder.add_joint(points.at(name));
    }
  add_members(deck, coarse, problems, out);
  const auto joined = [&](const std::string& name, const deck::Position& position, const std::string& key) {
    if (out.places.joints.contains(name)) return true;
    problems.add(position, key, "no member is joined to point \"" + name + "\"", "join a member there or leave it out");
    return false;
  };
  for (const deck::Support& support : deck.supports)
    if (joined(support.point, support.position, "support." + support.point)) add_support(support, problems, out);
  move_supports(deck, joined, problems, out);
  bool places_are_known = true;
  for (const deck::Load& load : deck.loads)
    if (const auto* action = std::get_if<deck::PointLoad>(&load.action); action != nullptr && !action->at.fraction)
      places_are_known = joined(action->at.name, action->at.position, "load.at") && places_are_known;
  if (places_are_known) add_loads(deck, coarse, problems, out);
  add_springs(deck, coarse, joined, problems, out);
  if (!coarse)
    for (const CompliantWallOfMember& wall :
         compliant_walls(deck, [&](Index m) -> const MemberMesh& { return out.builder.mesh(m); }))
      out.builder.add_wall(wall.contact.member, wall.pressure);
  if (!coarse) check_pressure(deck, problems, out);
  for (const auto& [name, joint] : out.places.joints)
    if (const auto rotation = out.builder.shared_rotation(joint)) out.places.rotations[name] = *rotation;
  return out;
}

void check_mechanism(const deck::Deck& deck, DeckProblems& problems) {
  DeckProblems ignored(deck.source);
  const StructureOfDeck coarse = describe_structure(deck, ignored, Mesh::coarsest);
  const auto mechanism = find_mechanism(*coarse.builder.build());
  if (!mechanism) return;
  std::string where = "inside a member";
  for (const auto& [name, node] : coarse.places.joints)
    if (node == mechanism->node) where = "at point \"" + name + "\"";
  const auto direction = [&] {
    switch (mechanism->dof) {
      case Dof::x:
        return "in x";
      case Dof::z:
        return "in z";
      case Dof::rotation:
        return "in rotation";
      case Dof::thickness:
      case Dof::thickness2:
        return "in thickness";
    }
    return "";
  }();
  const deck::Position position =
      deck.supports.empty() ? deck.members.front().position : deck.supports.front().position;
  problems.add(position, "support",
               fmt::format("the structure is a mechanism: it can move without strain, most {} {}", where, direction),
               "add a support or a spring, or remove a hinge");
}

}  // namespace arcwall
