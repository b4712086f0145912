#include "apps/verify/shown_values.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/verify/section_point.hpp"

namespace arcwall::verify {

namespace {

// --- gaps -----------------------------------------------------------------------------------------------------------

// A node of a member.
struct NodeOfMember {
  std::size_t member = 0, node = 0;
};

// The one that a place means; of a point the first at an end of a member that the wall concerns.
std::optional<NodeOfMember> node_of(const Model& model, const deck::Place& place, const PlainWall& wall) {
  const std::vector<deck::Member>& members = model.deck().members;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const std::size_t last = model.structure().members()[m].nodes.size() - 1;
    if (place.fraction && members[m].name == place.name)
      return NodeOfMember{m, static_cast<std::size_t>(std::lround(*place.fraction * double(last)))};
    if (place.fraction || !wall.concerns(members[m].name)) continue;
    if (members[m].from == place.name) return NodeOfMember{m, 0};
    if (members[m].to == place.name) return NodeOfMember{m, last};
  }
  return std::nullopt;
}

// The faces of a section that look at the wall: one, or both of a section that stands across it.
std::vector<double> offsets_of(const PlainWall& wall, double half_height, double angle) {
  if (wall.deck().contact_surface == deck::ContactSurface::axis || wall.has_outline()) return {0.0};
  constexpr double level = 1e-9;
  const double up = -wall.side() * std::cos(angle);
  if (std::abs(up) <= level) return {half_height, -half_height};
  return {std::copysign(half_height, up)};
}

double gap_on_nodes(const Model& model, const State& state, const PlainWall& wall, const NodeOfMember& at) {
  const Structure& structure = model.structure();
  const MemberMesh& mesh = structure.members()[at.member];
  const MemberSection section = mesh.section(at.node);
  const double half = 0.5 * mesh.height_at(mesh.fraction(at.node)).value_or(0.0);
  std::vector<Index> dofs{structure.dof(section.node, Dof::x), structure.dof(section.node, Dof::z)};
  if (section.rotation) dofs.push_back(*section.rotation);
  if (section.thickness) dofs.insert(dofs.end(), {section.thickness->e, section.thickness->xi});
  Vector u(static_cast<Index>(dofs.size()));
  for (std::size_t i = 0; i < dofs.size(); ++i) u[static_cast<Index>(i)] = structure.value(state, dofs[i]);
  SectionPoint point{.node = structure.position(section.node),
                     .shape_angle = section.shape.angle,
                     .axis_angle = section.axis.angle,
                     .along_director = section.quadratic == QuadraticTerm::director};
  double least = infinity;
  for (const double offset : offsets_of(wall, half, section.shape.angle)) {
    point.offset = offset;
    least = std::min(least, wall.gap_to(point.at(u), half));
  }
  return least;
}

double gap_on_strand(const Model& model, const State& state, const PlainWall& wall, const NodeOfMember& at) {
  const SlidingStructure& body = *model.sliding_structure();
  const MemberMesh& mesh = model.structure().members()[at.member];
  const MaterialPoint point = body.find(mesh.name, mesh.fraction(at.node));
  const AxisPlace axis = mesh_of(state).place(point, mesh_state_of(state));
  const double half = body.half_height(point.strand);
  double least = infinity;
  for (const double offset : offsets_of(wall, half, body.undeformed(point, true).angle))
    least =
        std::min(least, wall.gap_to(axis.position + offset * Vec2(-std::sin(axis.angle), std::cos(axis.angle)), half));
  return least;
}

std::optional<double> gap(const PointAtHand& at, const deck::Monitor& monitor) {
  std::optional<double> least;
  for (const PlainWall& wall : at.walls) {  // a wall may have parts
    if (wall.deck().name != monitor.wall) continue;
    const auto node = node_of(at.model, monitor.at, wall);
    if (!node) return std::nullopt;
    const double gap = at.model.sliding() != nullptr ? gap_on_strand(at.model, at.point.state, wall, *node)
                                                     : gap_on_nodes(at.model, at.point.state, wall, *node);
    least = std::min(gap, least.value_or(infinity));
  }
  return least;
}

// --- springs --------------------------------------------------------------------------------------------------------

Dof direction_of(deck::Component component) {
  if (component == deck::Component::force_x) return Dof::x;
  return component == deck::Component::force_z ? Dof::z : Dof::rotation;
}

double pressure_of(const deck::Foundation& foundation, const Vec2& displacement) {
  if (!foundation.law) return std::hypot(foundation.x * displacement.x(), foundation.z * displacement.y());
  const bool along_x = foundation.law->direction == Dof::x;
  return std::abs(table_force(*foundation.law, along_x ? displacement.x() : displacement.y()));
}

std::size_t index_of_member(const Model& model, const std::string& name) {
  const std::vector<deck::Member>& members = model.deck().members;
  return static_cast<std::size_t>(deck::find(members, name) - members.data());
}

// --- section forces -------------------------------------------------------------------------------------------------

// What the part behind a section exerts on the part before it [force].
Vec2 section_force(const ShapePoint& at) {
  const Vec2 along(std::cos(at.angle), std::sin(at.angle));
  return at.axial_force * along + at.shear_force * Vec2(-along.y(), along.x());
}

// Loads and springs all along a member.
bool is_loaded_along(const deck::Deck& deck, const std::string& member) {
  const bool by_load = std::any_of(deck.loads.begin(), deck.loads.end(), [&](const deck::Load& load) {
    const auto* along = std::get_if<deck::MemberLoad>(&load.action);
    const auto* pressure = std::get_if<deck::Pressure>(&load.action);
    return (along != nullptr && along->member == member) || (pressure != nullptr && pressure->member == member);
  });
  return by_load || std::any_of(deck.springs.begin(), deck.springs.end(), [&](const deck::Spring& spring) {
           const auto* foundation = std::get_if<deck::Foundation>(&spring.kind);
           return foundation != nullptr && foundation->member == member;
         });
}

bool is_place(const deck::Place& a, const deck::Place& b) { return a.name == b.name && a.fraction == b.fraction; }

bool has_spring_at(const deck::Deck& deck, const deck::Place& place) {
  return std::any_of(deck.springs.begin(), deck.springs.end(), [&](const deck::Spring& spring) {
    const auto* to_ground = std::get_if<deck::GroundSpring>(&spring.kind);
    return to_ground != nullptr && is_place(to_ground->at, place);
  });
}

// What the forces on both sides of a node may be off by along x and z, the stiffest elements beside it.
Vec2 uncertainty_of_jump(const PointAtHand& at) {
  const Vector off = uncertainty(at);
  Vec2 most = Vec2::Zero();
  for (const Potential& potential : at.potentials)
    if (potential.unknowns.size() >= 4) most = most.cwiseMax(made_by(potential, off).head<2>());
  return 2.0 * most;
}

// Whether a compliant wall may press a member between two places: what it lists are edges and middles of elements.
bool may_press_between(const Touches& touches, const std::string& member, double from, double to) {
  bool before = false, behind = false;
  for (const ContactPoint& contact : touches.of_compliant_walls) {
    if (contact.label.member != member) continue;
    before = before || contact.label.fraction <= to;
    behind = behind || contact.label.fraction >= from;
  }
  return before && behind;
}

// A contact between two places of a member, or on both sides of them with one wall, which may be one zone.
bool may_touch_between(const Touches& touches, const std::string& member, double from, double to) {
  std::set<std::string> before, behind;
  for (const Touch& touch : touches.all) {
    if (!touch.closed || touch.label.member != member) continue;
    if (touch.label.fraction >= from && touch.label.fraction <= to) return true;
    (touch.label.fraction < from ? before : behind).insert(touch.label.wall);
  }
  return std::any_of(before.begin(), before.end(), [&](const std::string& wall) { return behind.contains(wall); });
}

}  // namespace

void check_point_loads(const PointAtHand& at, Findings& findings) {
  constexpr double same_place = 1e-9, same = 1e-7;  // of the largest force of the member
  const Model& model = at.model;
  const deck::Deck& deck = model.deck();
  const Vec2 may_be_off = uncertainty_of_jump(at);
  for (const deck::Load& load : deck.loads) {
    const auto* point_load = std::get_if<deck::PointLoad>(&load.action);
    if (point_load == nullptr || !point_load->at.fraction) continue;
    const deck::Place& place = point_load->at;
    const double fraction = *place.fraction;
    if (is_loaded_along(deck, place.name) || has_spring_at(deck, place)) continue;
    Vec2 sum = Vec2::Zero();
    for (const deck::Load& other : deck.loads)
      if (const auto* there = std::get_if<deck::PointLoad>(&other.action);
          there != nullptr && is_place(there->at, place))
        sum += (other.constant ? 1.0 : at.point.lambda) * Vec2(there->force.x, there->force.z);
    const std::vector<ShapePoint> shape = model.body().shape(index_of_member(model, place.name), at.point.state);
    const auto behind = std::find_if(shape.begin(), shape.end(),
                                     [&](const ShapePoint& one) { return one.fraction > fraction + same_place; });
    const auto before = std::find_if(shape.rbegin(), shape.rend(),
                                     [&](const ShapePoint& one) { return one.fraction < fraction - same_place; });
    if (behind == shape.end() || before == shape.rend()) continue;
    const double first = before->fraction - same_place, last = behind->fraction + same_place;
    if (may_touch_between(at.touches, place.name, first, last)) continue;
    // An element tells its section forces by those at its ends, wherever it is pressed.
    const double element =
        1.0 / double(model.structure().members()[index_of_member(model, place.name)].nodes.size() - 1);
    if (may_press_between(at.touches, place.name, first - element, last + element)) continue;
    double most = sum.norm();
    for (const ShapePoint& one : shape) most = std::max(most, section_force(one).norm());
    const Vec2 off = section_force(*before) - section_force(*behind) - sum;
    for (const Index i : {0, 1})
      findings.compare("section forces jump by point loads", std::abs(off[i]), same * most + may_be_off[i],
                       (i == 0 ? "x at " : "z at ") + to_text(place));
  }
}

std::optional<double> own_value(const PointAtHand& at, const deck::Monitor& monitor) {
  if (monitor.component == deck::Component::gap) return gap(at, monitor);
  if (monitor.of() != deck::Monitored::spring || is_pressure(monitor.component)) return std::nullopt;
  const deck::Spring& spring = *deck::find(at.model.deck().springs, monitor.spring);
  return spring_force(at.model, at.point.state, spring, direction_of(monitor.component));
}

namespace {

double between(double from, const std::optional<double>& to, double t) {
  return (1.0 - t) * from + t * to.value_or(from);
}

// Area and section modulus by formulas of their own.
std::pair<double, double> area_and_modulus(const deck::Section& section, double t) {
  if (const auto* of = std::get_if<deck::Rectangle>(&section.shape)) {
    const double b = between(of->width, of->width_to, t), h = between(of->height, of->height_to, t);
    return {b * h, b * h * h / 6.0};
  }
  if (const auto* of = std::get_if<deck::Circle>(&section.shape)) {
    const double r = between(of->radius, of->radius_to, t);
    return {pi * r * r, pi * std::pow(r, 3) / 4.0};
  }
  if (const auto* of = std::get_if<deck::Tube>(&section.shape)) {
    const double R = between(of->radius, of->radius_to, t), r = R - between(of->thickness, of->thickness_to, t);
    return {pi * (R * R - r * r), pi * (std::pow(R, 4) - std::pow(r, 4)) / (4.0 * R)};
  }
  if (const auto* of = std::get_if<deck::General>(&section.shape))
    return {of->A, of->height ? 2.0 * of->I / *of->height : infinity};
  const auto& table = std::get<deck::SectionTable>(section.shape);
  std::size_t k = 1;
  while (k + 1 < table.at.size() && table.at[k] < t) ++k;
  const double part = (t - table.at[k - 1]) / (table.at[k] - table.at[k - 1]);
  const auto value = [&](const std::vector<double>& of) { return between(of[k - 1], of[k], part); };
  return {value(table.A), table.height.empty() ? infinity : 2.0 * value(table.I) / value(table.height)};
}

}  // namespace

std::vector<OuterFibres> outer_fibres(const deck::Deck& deck, const deck::Monitor& monitor) {
  std::vector<OuterFibres> all;
  for (std::size_t m = 0; m < deck.members.size(); ++m) {
    const deck::Member& member = deck.members[m];
    if (!monitor.member.empty() && member.name != monitor.member) continue;
    const deck::Section& section = *deck::find(deck.sections, member.section);
    OuterFibres fibres{.member = m};
    fibres.section = [&section, bends = member.theory != Theory::truss](double fraction) {
      const auto [area, modulus] = area_and_modulus(section, fraction);
      return std::pair(area, bends ? modulus : infinity);
    };
    if (monitor.component == deck::Component::utilisation)
      fibres.unit = deck::find(deck.materials, member.material)->allowable.value_or(infinity);
    all.push_back(fibres);
  }
  return all;
}

void check_greatest(const PointAtHand& at, const deck::Monitor& monitor, double shown, double roundoff,
                    Findings& findings) {
  constexpr double same = 1e-9;  // of the value: that of the place that is shown, where several have nearly as much
  const Model& model = at.model;
  double most = 0.0, least = infinity;
  const auto look_along = [&](std::size_t member, const auto& quantity) {
    for (const ShapePoint& point : model.body().shape(member, at.point.state)) {
      most = std::max(most, quantity(point));
      least = std::min(least, quantity(point));
    }
  };
  if (monitor.component == deck::Component::max_moment) {
    look_along(index_of_member(model, monitor.member), [](const ShapePoint& point) { return std::abs(point.moment); });
  } else if (is_stress(monitor.component)) {
    for (const OuterFibres& fibres : outer_fibres(model.deck(), monitor))
      look_along(fibres.member, [&](const ShapePoint& point) {
        return fibres.exertion(point.axial_force, point.moment, point.fraction);
      });
  } else {
    const auto& foundation = std::get<deck::Foundation>(deck::find(model.deck().springs, monitor.spring)->kind);
    look_along(index_of_member(model, foundation.member),
               [&](const ShapePoint& point) { return pressure_of(foundation, point.displacement); });
  }
  const double allowed = same * std::abs(shown) + roundoff;
  if (monitor.component == deck::Component::least_pressure)
    return findings.compare("minimum along a member", shown - least, allowed, "monitor " + monitor.name);
  if (monitor.component == deck::Component::mean_pressure)
    return findings.compare("mean along a member", std::max(shown - most, least - shown), allowed,
                            "monitor " + monitor.name);
  findings.compare("maximum along a member", most - shown, allowed, "monitor " + monitor.name);
}

}  // namespace arcwall::verify
