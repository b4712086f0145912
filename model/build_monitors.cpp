#include "model/build_monitors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/deck/key_list.hpp"
#include "model/deck/words.hpp"

namespace arcwall {

namespace {

deck::Dimension dimension_of(deck::Component component) {
  switch (component) {
    case deck::Component::rotation:
    case deck::Component::thickness:
    case deck::Component::utilisation:
    case deck::Component::friction_use:
      return deck::unit::none;
    case deck::Component::dissipation:
      return deck::unit::energy;
    case deck::Component::reaction_x:
    case deck::Component::reaction_z:
    case deck::Component::axial_force:
    case deck::Component::force_x:
    case deck::Component::force_z:
    case deck::Component::friction_force:
      return deck::unit::force;
    case deck::Component::reaction_moment:
    case deck::Component::moment:
    case deck::Component::max_moment:
      return deck::unit::moment;
    case deck::Component::max_stress:
      return deck::unit::stress;
    case deck::Component::greatest_pressure:
    case deck::Component::least_pressure:
    case deck::Component::mean_pressure:
      return deck::unit::line_load;
    case deck::Component::x:
    case deck::Component::z:
    case deck::Component::gap:
    case deck::Component::slip:
    case deck::Component::contact_start:
    case deck::Component::contact_end:
    case deck::Component::face_above_z:
    case deck::Component::face_below_z:
      return deck::unit::length;
    case deck::Component::thickness2:
      return deck::unit::curvature;
  }
  return deck::unit::none;
}

std::shared_ptr<const Observable> in_users_unit(std::shared_ptr<const Observable> quantity, double factor) {
  return factor == 1.0 ? std::move(quantity) : std::make_shared<ScaledObservable>(std::move(quantity), factor);
}

// The coordinate x of a place.
class UsersX final : public Observable {
 public:
  UsersX(std::shared_ptr<const Observable> here, const deck::Frame& frame) : here_(std::move(here)), frame_(frame) {}
  double value(const State& state) const override { return frame_.place({here_->value(state), 0.0}).x(); }
  Row gradient(const State& state) const override {
    Row row = here_->gradient(state);
    row.dx *= frame_.factor();
    row.dlambda *= frame_.factor();
    return row;
  }
  double rate(const State& state, const Direction& direction) const override {
    return frame_.factor() * here_->rate(state, direction);
  }

 private:
  std::shared_ptr<const Observable> here_;
  deck::Frame frame_;
};

// A monitor of the component, without its quantity.
MonitorColumn column_of(std::string name, deck::Component component, const deck::Deck& deck) {
  const deck::Dimension dimension = dimension_of(component);
  std::string unit = unit_text(dimension, deck.units);
  if (component == deck::Component::rotation) unit = "rad";
  if (component == deck::Component::thickness || component == deck::Component::utilisation ||
      component == deck::Component::friction_use)
    unit = "-";
  return {.name = std::move(name),
          .unit = std::move(unit),
          .component = component,
          .factor = deck.frame.factor(dimension.length)};
}

// What a monitor shows, without its sign; null, with or without a problem of its own, if it has nothing to show.
std::shared_ptr<const Observable> shown_by(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
                                           DeckProblems& problems) {
  if (is_extreme(monitor.component)) return greatest(deck, from, monitor, OfGreatest::value);
  if (monitor.component == deck::Component::mean_pressure) return mean(deck, from, monitor);
  if (monitor.component == deck::Component::dissipation) return friction_power(from, monitor);
  switch (monitor.of()) {
    case deck::Monitored::wall:
      return shown_on_wall(deck, from, monitor, problems);
    case deck::Monitored::gap:
      return shown_between(deck, from, monitor, problems);
    case deck::Monitored::spring:
      return spring_force(deck, from, monitor);
    case deck::Monitored::place:
    case deck::Monitored::member:
    case deck::Monitored::structure:
      break;
  }
  const bool is_there = monitor.at.fraction || from.places.joints.contains(monitor.at.name);
  return is_there ? shown_at(from, monitor.at, monitor.component) : nullptr;
}

std::string shown_name(const deck::Monitor& monitor) {
  if (!monitor.member.empty()) return monitor.member;
  if (monitor.of() == deck::Monitored::structure) return "structure";
  return monitor.spring.empty() ? to_text(monitor.at) : monitor.spring;
}

// Where the greatest is: NAME-place, a fraction of the member, and of all members NAME-member, its number.
void add_place(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
               std::vector<MonitorColumn>& columns) {
  const auto add = [&](const char* ending, OfGreatest what) {
    std::string name = monitor.name + ending;
    while (deck::find(deck.monitors, name) != nullptr) name += "-";
    columns.push_back({.name = std::move(name),
                       .unit = "-",
                       .component = monitor.component,
                       .quantity = greatest(deck, from, monitor, what),
                       .is_place = true});
  };
  add("-place", OfGreatest::place);
  if (monitor.of() == deck::Monitored::structure) add("-member", OfGreatest::member);
}

// Where an edge of contact is now: NAME-x.
void add_x(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
           std::vector<MonitorColumn>& columns) {
  std::string name = monitor.name + "-x";
  while (deck::find(deck.monitors, name) != nullptr) name += "-";
  MonitorColumn& column = columns.emplace_back(column_of(std::move(name), monitor.component, deck));
  column.raw = contact_edge(from, monitor, ContactEdge::What::x);
  column.quantity = std::make_shared<UsersX>(column.raw, deck.frame);
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
    const auto quantity = shown_at(from, {.name = point}, component);
    if (deck::find(columns, name) != nullptr || !quantity) return;
    MonitorColumn& column = columns.emplace_back(column_of(std::move(name), component, deck));
    column.raw = quantity;
    column.quantity = in_users_unit(quantity, column.factor);
  };
  for (const deck::Prescribed& moved : deck.prescribed) {
    add(moved.point, moved.x.has_value(), deck::Component::reaction_x);
    add(moved.point, moved.z.has_value(), deck::Component::reaction_z);
    add(moved.point, moved.rotation.has_value(), deck::Component::reaction_moment);
  }
}

}  // namespace

Watch::Kind kind_of(const MonitorColumn& column, const deck::Deck& deck) {
  switch (column.component) {
    case deck::Component::x:
    case deck::Component::z:
    case deck::Component::rotation:
    case deck::Component::face_above_z:
    case deck::Component::face_below_z:
    case deck::Component::slip:
    case deck::Component::gap:
    case deck::Component::contact_start:
    case deck::Component::contact_end:
    case deck::Component::thickness:
    case deck::Component::thickness2:
      return Watch::Kind::motion;
    case deck::Component::force_x:
    case deck::Component::force_z:
    case deck::Component::moment: {
      const deck::Monitor* monitor = deck::find(deck.monitors, column.name);
      const bool of_wall = monitor != nullptr && !monitor->wall.empty();
      return of_wall ? Watch::Kind::contact_force : Watch::Kind::inner_force;
    }
    case deck::Component::friction_force:
    case deck::Component::friction_use:
    case deck::Component::dissipation:
      return Watch::Kind::contact_force;
    case deck::Component::reaction_x:
    case deck::Component::reaction_z:
    case deck::Component::reaction_moment:
    case deck::Component::axial_force:
    case deck::Component::max_moment:
    case deck::Component::max_stress:
    case deck::Component::utilisation:
    case deck::Component::greatest_pressure:
    case deck::Component::least_pressure:
    case deck::Component::mean_pressure:
      return Watch::Kind::inner_force;
  }
  return Watch::Kind::motion;
}

bool is_of_section_forces(deck::Component component) {
  return component == deck::Component::axial_force || component == deck::Component::moment || is_extreme(component) ||
         component == deck::Component::mean_pressure;
}

namespace {

// What nodal forces, which are small differences of great ones, and places, to the corrector's tolerance, leave of
// zero.
double roundoff_of(const deck::Deck& deck, const Measured& from, const MonitorColumn& column) {
  constexpr double of_forces = 10.0, of_places = 1e-12;
  if (deck::is_stress(column.component)) {
    double most = 0.0;
    if (const deck::Monitor* const monitor = deck::find(deck.monitors, column.name))
      for (const AlongMember& along : along_members(deck, from, *monitor))
        most = std::max(most, of_forces * along.of.negligible);
    return most;
  }
  const deck::Dimension unit = dimension_of(column.component);
  return (unit.force != 0 ? of_forces * from.structure.force_roundoff() : of_places) *
         std::pow(from.structure.length_scale(), unit.length);
}

}  // namespace

std::vector<MonitorColumn> monitor_columns(const deck::Deck& deck, const Measured& from, DeckProblems& problems) {
  std::vector<MonitorColumn> columns;
  for (const deck::Monitor& monitor : deck.monitors) {
    const std::size_t problems_before = problems.count();
    std::shared_ptr<const Observable> quantity = shown_by(deck, from, monitor, problems);
    if (!quantity) {
      if (problems.count() > problems_before) continue;
      if (deck.path.method == deck::PathMethod::incremental && is_of_section_forces(monitor.component)) {
        problems.add(monitor.position, "monitor.component",
                     deck::text_of(deck::component_words, monitor.component) +
                         " is not available with load increments (method \"incremental\")",
                     "remove the monitor, or use another method");
        continue;
      }
      problems.add(monitor.position, "monitor.component",
                   "\"" + shown_name(monitor) + "\" does not have this component",
                   "a rotation needs a beam, a face a section with a height, a reaction a support in its direction, "
                   "reaction-moment "
                   "one of the rotation, thickness the theory \"essenburg\"; axial-force and moment need one member, "
                   "and moment a beam");
      continue;
    }
    MonitorColumn& column = columns.emplace_back(column_of(monitor.name, monitor.component, deck));
    column.raw = quantity;
    column.quantity = in_users_unit(std::move(quantity), monitor.sign * column.factor);
    if (is_extreme(monitor.component)) add_place(deck, from, monitor, columns);
    if (is_contact_edge(monitor.component)) add_x(deck, from, monitor, columns);
  }
  add_reactions_of_movements(deck, from, columns);
  for (MonitorColumn& column : columns) column.roundoff = column.factor * roundoff_of(deck, from, column);
  return columns;
}

}  // namespace arcwall
