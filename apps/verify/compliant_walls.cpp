#include "apps/verify/compliant_walls.hpp"

#include <algorithm>
#include <cmath>

#include "apps/verify/potentials.hpp"

namespace arcwall::verify {

namespace {

// The pressure of a law at a penetration.
double pressure_of(const deck::WallLaw& law, double penetration) {
  if (penetration <= 0.0) return 0.0;
  if (law.stiffness && law.depth) return *law.stiffness * *law.depth * (std::exp(penetration / *law.depth) - 1.0);
  if (law.stiffness) return *law.stiffness * penetration;
  return table_force({.displacement = law.penetration, .force = law.pressure, .interpolation = law.interpolation},
                     penetration);
}

// The gap of one of several walls of one name, the parts of an outline with hollow corners.
double gap_of(const std::vector<PlainWall>& walls, const std::string& name, const Vec2& place, double half) {
  double least = infinity;
  for (const PlainWall& wall : walls)
    if (wall.deck().name == name) least = std::min(least, wall.gap_to(place, half));
  return least;
}

}  // namespace

// By the midpoint rule: an edge of contact is somewhere in one of its parts.
void check_compliant_walls(const Model& model, const std::vector<PlainWall>& walls, const State& state,
                           Findings& findings) {
  const CompliantContact* const contact = model.compliant();
  if (contact == nullptr) return;
  constexpr int parts = 64;          // of an element
  constexpr double of_force = 2e-3;  // what the rule is off by
  constexpr double law_of_friction = 1e-9;
  const double touching = 1e-9 * model.structure().length_scale();
  for (Index j = 0; j < contact->contact_count(); ++j) {
    const CompliantContact::Wall& wall = contact->wall(j);
    const MemberMesh& mesh = model.structure().members()[static_cast<std::size_t>(wall.member)];
    const std::string name = wall.name + " at " + mesh.name;
    const deck::WallLaw& law = *[&] {
      const auto& own = deck::find(model.deck().walls, wall.name)->law;
      return own ? &*own : &*model.deck().contact.law;
    }();
    const bool has_parts = std::count_if(walls.begin(), walls.end(),
                                         [&](const PlainWall& one) { return one.deck().name == wall.name; }) > 1;
    if (has_parts) continue;  // each has a force of its own
    double force = 0.0, least = infinity, length = 0.0;
    for (const CompliantContact::Place& place : contact->places(state, j, parts)) {
      const double gap = gap_of(walls, wall.name, place.at, 0.5 * mesh.height_at(place.fraction).value_or(0.0));
      least = std::min(least, gap);
      force += place.length * pressure_of(law, -gap);
      length = std::max(length, place.length);
    }
    const double of_parts = 2.0 * length * pressure_of(law, -contact->nearest(state, j).gap);
    findings.compare("compliant walls press by their laws", std::abs(contact->force(state, j) - force),
                     of_force * force + of_parts + mesh.length * pressure_of(law, touching), name);
    if (const CompliantFriction* const friction = contact->elastic_friction(); friction != nullptr) {
      double T = 0.0, beyond = 0.0;
      for (const CompliantFriction::Point& point : friction->points(state)) {
        if (point.pressed->contact != static_cast<std::size_t>(j)) continue;
        T += std::abs(point.force);
        beyond = std::max(beyond, std::abs(point.force) - point.most * (1.0 + law_of_friction));
      }
      findings.compare("friction is at most μ p", beyond, 0.0, name);
      findings.compare("friction is at most μ p", T - wall.friction * force,
                       wall.friction * (of_force * force + of_parts), name);
    }
    if (state.active_set[static_cast<std::size_t>(j)] == 0)
      findings.compare("open contacts have no negative gap", -least, touching, name);
  }
}

}  // namespace arcwall::verify
