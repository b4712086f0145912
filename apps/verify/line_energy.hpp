#pragma once

#include "apps/verify/plain_member.hpp"
#include "apps/verify/strain_energy.hpp"

// The potential of what acts along an element: dead loads, foundations and pressure.
namespace arcwall::verify {

/// What acts along a part of a member at λ.
struct AlongElement {
  const PlainMember& member;
  double from = 0.0, to = 0.0;  ///< arc lengths of the member's axis, descending where the part runs against it
  double lambda = 0.0;

  bool is_bare() const { return member.loads().empty() && member.foundations().empty() && member.pressure().is_zero(); }
};

/// On the cubic of the ends of a slender element; unknowns as in slender_energy(). `place`: of the stress-free first
/// end, from the origin of the areas under pressure.
LocalEnergy line_energy(const AlongElement& along, const Stretch& stretch, const EndsMotion& motion, const Vec2& place);

/// On the interpolated axis between nodes, of whose unknowns the first two are displacements.
LocalEnergy line_energy(const AlongElement& along, const NodesAlong& nodes, const Vector& u, const Vec2& place);

/// By linear shape functions on a bar.
LocalEnergy line_energy(const AlongElement& along, const Vec2& chord, const Vector& u);

/// Where the areas under pressure are measured from.
Vec2 origin_of_areas(const Structure& structure);

}  // namespace arcwall::verify
