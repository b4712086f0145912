#include "model/build_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "elements/member_point.hpp"
#include "model/build_contact.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/words.hpp"
#include "model/wall_force.hpp"

namespace arcwall {

namespace {

using Component = MemberObservable::Component;

std::optional<Component> member_component(deck::Component component) {
  switch (component) {
    case deck::Component::x:
      return Component::x;
    case deck::Component::z:
      return Component::z;
    case deck::Component::rotation:
      return Component::rotation;
    case deck::Component::face_above_z:
      return Component::face_above_z;
    case deck::Component::face_below_z:
      return Component::face_below_z;
    case deck::Component::reaction_x:
    case deck::Component::reaction_z:
    case deck::Component::reaction_moment:
    case deck::Component::axial_force:
    case deck::Component::moment:
    case deck::Component::force_x:
    case deck::Component::force_z:
    case deck::Component::thickness:
    case deck::Component::thickness2:
      return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Freedom> reaction_freedom(deck::Component component) {
  switch (component) {
    case deck::Component::reaction_x:
      return Freedom::x;
    case deck::Component::reaction_z:
      return Freedom::z;
    case deck::Component::reaction_moment:
      return Freedom::rotation;
    case deck::Component::x:
    case deck::Component::z:
    case deck::Component::rotation:
    case deck::Component::face_above_z:
    case deck::Component::face_below_z:
    case deck::Component::axial_force:
    case deck::Component::moment:
    case deck::Component::force_x:
    case deck::Component::force_z:
    case deck::Component::thickness:
    case deck::Component::thickness2:
      return std::nullopt;
  }
  return std::nullopt;
}

std::string unit_of(deck::Component component, const deck::Units& units) {
  switch (component) {
    case deck::Component::rotation:
      return "rad";
    case deck::Component::thickness:
      return "-";
    case deck::Component::reaction_x:
    case deck::Component::reaction_z:
    case deck::Component::axial_force:
    case deck::Component::force_x:
    case deck::Component::force_z:
      return unit_text(deck::unit::force, units);
    case deck::Component::reaction_moment:
    case deck::Component::moment:
      return unit_text(deck::unit::moment, units);
    case deck::Component::x:
    case deck::Component::z:
    case deck::Component::face_above_z:
    case deck::Component::face_below_z:
      return unit_text(deck::unit::length, units);
    case deck::Component::thickness2:
      return unit_text(deck::unit::curvature, units);
  }
  return {};
}

// The member whose end a joint is; where several meet, the first that has what is asked for.
struct End {
  const MemberMesh* mesh = nullptr;
  std::size_t position = 0;
};

std::vector<End> ends_at(const Structure& structure, Index joint) {
  std::vector<End> ends;
  for (const MemberMesh& mesh : structure.members()) {
    if (mesh.nodes.front() == joint) ends.push_back({.mesh = &mesh, .position = 0});
    if (mesh.nodes.back() == joint) ends.push_back({.mesh = &mesh, .position = mesh.nodes.size() - 1});
  }
  return ends;
}

std::size_t index_of(const MemberMesh& mesh, const Structure& structure) {
  return static_cast<std::size_t>(&mesh - structure.members().data());
}

std::optional<Index> thickness_freedom(const ThicknessFreedoms& freedoms, deck::Component component) {
  if (component == deck::Component::thickness) return freedoms.e;
  if (component == deck::Component::thickness2) return freedoms.xi;
  return std::nullopt;
}

// What the member at a place carries there; null where several meet, whose forces differ, or which has no such force.
std::shared_ptr<const Observable> member_force(const Measured& from, const std::vector<End>& at,
                                               deck::Component component) {
  const bool bends = component == deck::Component::moment;
  if (at.size() != 1) return nullptr;
  const MemberMesh& mesh = *at.front().mesh;
  const std::size_t position = at.front().position;
  if (bends && !mesh.rotations[position]) return nullptr;
  return from.body.section_force(index_of(mesh, from.structure), mesh.fraction(position),
                                 bends ? Body::SectionForce::moment : Body::SectionForce::axial_force);
}

// What a place's component is read from; null if the place has no such component.
std::shared_ptr<const Observable> observable(const Measured& from, const deck::Place& place,
                                             deck::Component component) {
  const Structure& structure = from.structure;
  const Places::Node node = from.places.find(place, structure.members());
  std::vector<End> at = ends_at(structure, node.node);
  if (node.member != nullptr) at.assign(1, End{.mesh = node.member, .position = node.position});
  if (component == deck::Component::axial_force || component == deck::Component::moment)
    return member_force(from, at, component);
  if (const auto freedom = reaction_freedom(component)) {
    if (*freedom != Freedom::rotation) return from.body.reaction(structure.freedom(node.node, *freedom));
    for (const End& end : at)
      if (const auto rotation = end.mesh->rotations[end.position]; rotation && !structure.unknown(*rotation))
        return from.body.reaction(*rotation);
    return nullptr;
  }
  for (const End& end : at)
    if (const auto thickness = end.mesh->section(end.position).thickness)
      if (const auto freedom = thickness_freedom(*thickness, component)) return from.body.motion(*freedom);
  const auto wanted = member_component(component);
  if (!wanted) return nullptr;
  const bool turns = *wanted != Component::x && *wanted != Component::z;
  const bool face = *wanted == Component::face_above_z || *wanted == Component::face_below_z;
  for (const End& end : at) {
    const auto rotation = end.mesh->rotations[end.position];
    if ((turns && !rotation) || (face && !end.mesh->height)) continue;
    // Members that meet at an angle agree on the rotation of their joint, not on the slopes of their imperfections.
    if (*wanted == Component::rotation && at.size() > 1) return from.body.motion(*rotation);
    return from.body.motion(index_of(*end.mesh, structure), end.position, *wanted);
  }
  return nullptr;
}

PathMethod path_method(deck::PathMethod method) {
  switch (method) {
    case deck::PathMethod::load:
      return PathMethod::load;
    case deck::PathMethod::displacement:
      return PathMethod::displacement;
    case deck::PathMethod::riks:
      return PathMethod::riks;
    case deck::PathMethod::normal_plane:
      return PathMethod::normal_plane;
    case deck::PathMethod::cylindrical:
      return PathMethod::cylindrical;
    case deck::PathMethod::spherical:
      return PathMethod::spherical;
    case deck::PathMethod::pseudo_arclength:
      return PathMethod::pseudo_arclength;
    case deck::PathMethod::incremental:  // has no steps along the path
      break;
  }
  return PathMethod::spherical;
}

// The resultant force of a wall; null where the deck has other problems, so that nothing is traced.
std::shared_ptr<const Observable> wall_force(const deck::Deck& deck, const Measured& from,
                                             const deck::Monitor& monitor) {
  const deck::Wall& wall = *deck::find(deck.walls, monitor.wall);
  if (from.contacts == nullptr || from.system == nullptr) return std::make_shared<ParameterValue>();
  const WallForce::What what = monitor.component == deck::Component::force_x   ? WallForce::What::x
                               : monitor.component == deck::Component::force_z ? WallForce::What::z
                                                                               : WallForce::What::moment;
  return std::make_shared<WallForce>(*from.contacts, *from.system, wall.name, what, motion_of(wall).about);
}

// Whether the direction is held and nothing moves it with λ.
bool is_at_rest(const Measured& from, const deck::Control& control) {
  const Structure& structure = from.structure;
  const Places::Node place = from.places.find(control.at, structure.members());
  std::optional<Index> freedom;
  if (control.component == deck::Component::x) freedom = structure.freedom(place.node, Freedom::x);
  if (control.component == deck::Component::z) freedom = structure.freedom(place.node, Freedom::z);
  if (!freedom || structure.unknown(*freedom)) return false;
  bool moved = false;
  structure.nodal_terms().for_each_moved_support([&](Index one, double rate) {
    if (one == *freedom && rate != 0.0) moved = true;
  });
  return !moved;
}

// A column for each direction that is moved and has no monitor of its reaction: `reaction-x-B`.
void add_reactions_of_movements(const deck::Deck& deck, const Measured& from, std::vector<MonitorColumn>& columns) {
  const auto add = [&](const std::string& point, bool moved, deck::Component component) {
    const auto is_monitored = [&](const deck::Monitor& monitor) {
      return monitor.component == component && !monitor.at.fraction && monitor.at.name == point;
    };
    if (!moved || std::any_of(deck.monitors.begin(), deck.monitors.end(), is_monitored)) return;
    std::string name = text_of(deck::component_words, component) + "-" + point;
    while (deck::find(deck.monitors, name) != nullptr) name += "-";
    const auto quantity = observable(from, {.name = point}, component);
    if (deck::find(columns, name) == nullptr && quantity)
      columns.push_back({.name = std::move(name),
                         .unit = unit_of(component, deck.units),
                         .component = component,
                         .quantity = quantity,
                         .raw = quantity});
  };
  for (const deck::Prescribed& moved : deck.prescribed) {
    add(moved.point, moved.x.has_value(), deck::Component::reaction_x);
    add(moved.point, moved.z.has_value(), deck::Component::reaction_z);
    add(moved.point, moved.rotation.has_value(), deck::Component::reaction_moment);
  }
}

}  // namespace

std::vector<MonitorColumn> monitor_columns(const deck::Deck& deck, const Measured& from, DeckProblems& problems) {
  std::vector<MonitorColumn> columns;
  for (const deck::Monitor& monitor : deck.monitors) {
    std::shared_ptr<const Observable> quantity;
    if (!monitor.wall.empty()) {
      quantity = wall_force(deck, from, monitor);
    } else if (monitor.at.fraction || from.places.joints.contains(monitor.at.name)) {
      quantity = observable(from, monitor.at, monitor.component);
    }
    if (!quantity) {
      problems.add(monitor.position, "monitor.component",
                   "\"" + to_text(monitor.at) + "\" does not have this component",
                   "rotations need a beam, faces a section with a height, reactions a support, thickness the theory "
                   "\"essenburg\"; axial-force and moment one member, which for a moment is a beam, and no load "
                   "increments");
      continue;
    }
    const auto raw = quantity;
    if (monitor.sign < 0) quantity = std::make_shared<ScaledObservable>(raw, -1.0);
    columns.push_back({.name = monitor.name,
                       .unit = unit_of(monitor.component, deck.units),
                       .component = monitor.component,
                       .quantity = std::move(quantity),
                       .raw = raw});
  }
  add_reactions_of_movements(deck, from, columns);
  return columns;
}

std::vector<double> load_levels(const deck::Path& path) {
  std::vector<double> levels;
  double from = 0.0;
  for (const deck::Landing& landing : path.land) {
    if (landing.name != "lambda") continue;
    for (const double value : landing.values) {
      // A level that round-off alone keeps from being met needs no increment of its own.
      const int parts = std::max(1, static_cast<int>(std::ceil(std::abs((value - from) / path.step) - 1e-9)));
      for (int i = 1; i < parts; ++i) levels.push_back(from + (value - from) * i / parts);
      levels.push_back(value);
      from = value;
    }
  }
  return levels;
}

TraceOptions trace_options(const deck::Deck& deck, const Measured& from, const std::vector<MonitorColumn>& monitors,
                           DeckProblems& problems) {
  const deck::Path& path = deck.path;
  TraceOptions options;
  options.method = path_method(path.method);
  options.events = path.events;
  options.step.first = path.step;
  options.step.min = path.min_step;
  options.step.max = path.max_step;
  options.max_points = path.max_points;
  options.stay = path.branches != BranchPolicy::follow;
  if (path.control) {
    options.control = observable(from, path.control->at, path.control->component);
    if (!options.control)
      problems.add(path.control->at.position, "path.control",
                   "\"" + to_text(path.control->at) + "\" cannot be controlled so",
                   "name a component that the place has");
    if (options.control && is_at_rest(from, *path.control))
      problems.add(path.control->at.position, "path.control",
                   "\"" + to_text(path.control->at) + "\" is held in that direction, so that it cannot be controlled",
                   "name a direction that is free, or that λ moves");
  }
  const auto quantity = [&](const std::string& name) -> std::shared_ptr<const Observable> {
    if (name == "lambda") return std::make_shared<ParameterValue>();
    const MonitorColumn* column = deck::find(monitors, name);
    return column != nullptr ? column->quantity : nullptr;
  };
  const auto mark = [&](const std::string& name, double value, bool stops) {
    if (auto q = quantity(name))
      options.target_values.push_back(
          {.quantity = std::move(q), .value = value, .stops = stops, .label = name + " = " + round_trip(value)});
  };
  for (const deck::Landing& landing : path.land)
    for (const double value : landing.values) mark(landing.name, value, false);
  for (const deck::StopBounds& bounds : path.stop.bounds) {
    mark(bounds.name, bounds.low, true);
    mark(bounds.name, bounds.high, true);
  }
  if (path.stop.contacts) options.stop_contacts = *path.stop.contacts;
  for (const EventKind event : path.stop.events)
    options.stop_events.push_back({.kind = event, .label = "event = " + deck::text_of(deck::stop_event_words, event)});
  return options;
}

}  // namespace arcwall
