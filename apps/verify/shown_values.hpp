#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "apps/verify/point_checks.hpp"

namespace arcwall::verify {

/// What a monitor should show at a point by formulas of its own, from the deck's walls and springs and from where the
/// structure is, without the deck's sign; empty of one whose value is read off the structure itself.
std::optional<double> own_value(const PointAtHand& at, const deck::Monitor& monitor);

/// The outer fibres of a member, as far as a monitor of stress is concerned.
struct OuterFibres {
  std::size_t member = 0;
  /// Area and modulus of the section at a fraction of the length, infinite for trusses [length², length³].
  std::function<std::pair<double, double>(double)> section{};
  double unit = 1.0;  ///< the stress that counts as 1 [force/length²]

  double exertion(double axial_force, double moment, double fraction) const {
    const auto [area, modulus] = section(fraction);
    return (std::abs(axial_force) / area + std::abs(moment) / modulus) / unit;
  }
};
std::vector<OuterFibres> outer_fibres(const deck::Deck& deck, const deck::Monitor& monitor);

/// The section force jumps by each point load inside a member, between the two shown places beside it. Left out:
/// members with loads or springs all along, springs at the place, and contact that may lie beside it.
void check_point_loads(const PointAtHand& at, Findings& findings);

/// No section that a picture of the point shows carries more than the greatest moment, stress or pressure along its
/// member, or less than the least pressure; the mean pressure lies between.
void check_greatest(const PointAtHand& at, const deck::Monitor& monitor, double shown, double roundoff,
                    Findings& findings);

}  // namespace arcwall::verify
