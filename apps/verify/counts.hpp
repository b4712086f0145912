#pragma once

#include <optional>

#include "apps/verify/point_checks.hpp"

namespace arcwall::verify {

/// Which eigenvalues of a stiffness whose diagonal is one are as good as zero. Where a degree of freedom may itself be
/// critical its diagonal cannot be made one: an entry that is less than a part of what its elements contribute is
/// compared with that part.
struct ZeroEigenvalue {
  double least = 0.0;     ///< those up to it
  double of_next = 0.0;   ///< and those up to this part of the second smallest
  double of_parts = 0.0;  ///< the part; 0 where no degree of freedom is critical by itself
};

/// Dense eigenvalues are computed of no more unknowns: they cost the cube.
inline constexpr Index most_of_dense = 2000;

/// How many negative eigenvalues the second variation may have: some are as good as zero, some contacts carry nothing.
struct CountRange {
  Index least = 0, most = 0;
};

/// By two factorizations of what is left of the stiffness where closed contacts stay closed, shifted by what is as good
/// as zero in both senses. Where that depends on the eigenvalues themselves, or a factorization is not accurate, by
/// dense eigenvalues. Where a contact lies as near as places are sure to where its wall's curvature jumps, of either
/// curvature. Empty of more unknowns than dense eigenvalues are computed for.
std::optional<CountRange> unstable_range(const PointAtHand& at, const ZeroEigenvalue& zero);

/// The same where the forces of the supports that λ moves are dead loads, and λ one more unknown. Empty, too, where λ
/// drives anything else, where the mesh slides, and where a held node is in contact.
std::optional<CountRange> unstable_load_control_range(const PointAtHand& at, const ZeroEigenvalue& zero);

/// Whether supports are all that λ drives, on a mesh that does not slide.
bool is_driven_by_supports_alone(const Model& model);

}  // namespace arcwall::verify
