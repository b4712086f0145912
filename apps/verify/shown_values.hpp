#pragma once

#include <optional>

#include "apps/verify/point_checks.hpp"

namespace arcwall::verify {

/// What a monitor should show at a point by formulas of its own, from the deck's walls and springs and from where the
/// structure is, without the deck's sign; empty of one whose value is read off the structure itself.
std::optional<double> own_value(const PointAtHand& at, const deck::Monitor& monitor);

/// No section that a picture of the point shows carries more than the greatest moment or pressure along its member.
void check_greatest(const PointAtHand& at, const deck::Monitor& monitor, double shown, double roundoff,
                    Findings& findings);

}  // namespace arcwall::verify
