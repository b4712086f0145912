#pragma once

#include <array>
#include <span>

/// Gauss's rules on [0, 1], of 1 to 3, 5 and 7 points.
namespace arcwall::verify {

struct RulePoint {
  double at, weight;
};

// From places and weights on [−1, 1].
inline constexpr RulePoint on_unit(double place, double weight) {
  return {.at = 0.5 * (1.0 + place), .weight = 0.5 * weight};
}

namespace gauss {

inline constexpr double second = 0.57735026918962576, third = 0.77459666924148338;
inline constexpr std::array<double, 2> fifth{0.53846931010568309, 0.90617984593866399};
inline constexpr std::array<double, 3> seventh{0.40584515137739717, 0.74153118559939444, 0.94910791234275852};

}  // namespace gauss

inline constexpr std::array<RulePoint, 1> one_point{{on_unit(0.0, 2.0)}};
inline constexpr std::array<RulePoint, 2> two_points{{on_unit(-gauss::second, 1.0), on_unit(gauss::second, 1.0)}};
inline constexpr std::array<RulePoint, 3> three_points{
    {on_unit(-gauss::third, 5.0 / 9.0), on_unit(0.0, 8.0 / 9.0), on_unit(gauss::third, 5.0 / 9.0)}};
inline constexpr std::array<RulePoint, 5> five_points{
    {on_unit(-gauss::fifth[1], 0.23692688505618909), on_unit(-gauss::fifth[0], 0.47862867049936647),
     on_unit(0.0, 0.56888888888888889), on_unit(gauss::fifth[0], 0.47862867049936647),
     on_unit(gauss::fifth[1], 0.23692688505618909)}};
inline constexpr std::array<RulePoint, 7> seven_points{
    {on_unit(-gauss::seventh[2], 0.12948496616886969), on_unit(-gauss::seventh[1], 0.27970539148927667),
     on_unit(-gauss::seventh[0], 0.38183005050511894), on_unit(0.0, 0.41795918367346939),
     on_unit(gauss::seventh[0], 0.38183005050511894), on_unit(gauss::seventh[1], 0.27970539148927667),
     on_unit(gauss::seventh[2], 0.12948496616886969)}};

/// The rule of so many points.
inline std::span<const RulePoint> gauss_rule_of(int points) {
  switch (points) {
    case 1:
      return one_point;
    case 2:
      return two_points;
    case 3:
      return three_points;
    case 5:
      return five_points;
    default:
      return seven_points;
  }
}

}  // namespace arcwall::verify
