#pragma once

#include <optional>

#include "apps/verify/findings.hpp"
#include "apps/verify/potentials.hpp"
#include "apps/verify/touches.hpp"
#include "model/record.hpp"

namespace arcwall::verify {

/// Sizes of the model that bounds are relative to.
struct Scales {
  double length = 1.0;  ///< of the structure
  double force = 1.0;   ///< of contact forces
};

/// By how much closed contacts may be off their walls, of the structure's length.
constexpr double gap_left = 1e-10;

/// A point of the record with what is known of it.
struct PointAtHand {
  const Model& model;
  const PlainMembers& members;
  const RecordPoint& point;
  const Scales& scales;
  std::vector<PlainWall> walls{};  ///< where they are at the point; `touches` refers to them
  Touches touches{};
  std::vector<Potential> potentials{};
};

/// Whether the state has as many finite unknowns as its active set asks for.
bool is_well_formed(const Model& model, const State& state);

PointAtHand at_hand(const Model& model, const PlainMembers& members, const RecordPoint& point,
                    const std::vector<PlainWall>& walls, const Scales& scales);

/// Gaps and forces: g ≥ 0 of open contacts, p ≥ 0 and g + c p = 0 of closed ones, nothing inside a wall between nodes;
/// tangency of contact that slides. `waits`: a stretch that a change of contact makes is not there yet
/// (change_before()), so that walls may be entered by 10⁻⁶ of the structure's length, and may pull as little.
void check_contacts(const PointAtHand& at, Findings& findings, bool waits = false);

/// ∂Π/∂u − Σ p ∂g/∂u = 0, and the contact forces that this leaves at each node.
void check_equilibrium(const PointAtHand& at, Findings& findings);

/// What the unknowns of the structure may be off by: the digits that they are stored with, and the distance from the
/// equilibrium that the corrector may leave.
Vector uncertainty(const PointAtHand& at);

/// The sizes of the forces that these make of one potential, by its unknowns.
Vector made_by(const Potential& potential, const Vector& off);

/// The total potential at the state.
struct Energy {
  double value = 0.0;
  double magnitude = 0.0;  ///< sum of the sizes of its parts
  double rounded = 0.0;    ///< what the last digits of the unknowns make of it
};
Energy energy(const PointAtHand& at);

}  // namespace arcwall::verify
