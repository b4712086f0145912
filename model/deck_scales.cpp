#include "model/deck_scales.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/tracer.hpp"
#include "model/build_contact.hpp"
#include "model/loose_bodies.hpp"

namespace arcwall {

namespace {

// The greatest force by which supports that λ moves begin to move the structure, moments over its length [force].
double force_of_movements(const Structure& structure) {
  if (structure.metric({}).squared_motion_by_lambda == 0.0) return 0.0;
  const auto start = Tracer(structure, {.x = Vector::Zero(structure.size({}))}, {}).next();
  if (!start) return 0.0;
  const Direction& tangent = start->to.tangent;
  double greatest = 0.0;
  structure.nodal_terms().for_each_moved_support([&](Index dof, double) {
    const Row row = structure.reaction_gradient(start->to.state, dof);
    const double rate = std::abs(row.dx.dot(tangent.dx) / tangent.dlambda + row.dlambda);
    const bool turns = structure.meaning_of_dof(dof).dof == Dof::rotation;
    greatest = std::max(greatest, turns ? rate / structure.length_scale() : rate);
  });
  return greatest;
}

// The force that the most flexible member has against a wall that λ moves [force].
double force_of_walls(const deck::Deck& deck, const Structure& structure) {
  double speed = 0.0;
  for (const deck::Wall& wall : deck.walls)
    speed = std::max(speed, obstacle_of(wall)->greatest_speed(structure.length_scale()));
  return speed > 0.0 ? softest_stiffness(deck, structure) * speed : 0.0;
}

}  // namespace

ContactScales contact_scales(const deck::Deck& deck, const Structure& structure, const Structure& held,
                             double first_step) {
  constexpr double steps = 10.0;
  const double tolerance = TraceOptions{}.guard_tolerance;
  const double force = std::max({structure.force_scale(), force_of_movements(held), force_of_walls(deck, structure)});
  const double driven = std::max(steps * force * std::abs(first_step), 1e-300);
  return {.length = structure.length_scale(),
          .force = std::max(driven, structure.force_roundoff() / tolerance),
          .driven = driven};
}

double mesh_error_of_forces(const ContactScales& scales) {
  const double known = 10.0 * TraceOptions{}.guard_tolerance;
  return std::max(mesh_error * std::min(1.0, scales.driven / scales.force), known);
}

}  // namespace arcwall
