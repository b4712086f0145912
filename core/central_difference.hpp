#pragma once

#include <array>

namespace arcwall {

/// Where a function is evaluated for its derivative, in steps h, and what its value counts.
struct DifferencePlace {
  int offset = 0;
  double weight = 0.0;
  double coarse_weight = 0.0;  ///< in the difference of the fourth order, which tells how long steps may be
};

/// Central differences of the sixth order: f′ = Σ weight f(offset · h)/h, off by h⁶ f⁽⁷⁾/140. Steps may so be long, and
/// round-off, which grows with 1/h, stays small.
inline constexpr std::array<DifferencePlace, 6> central_difference{{{1, 0.75, 2.0 / 3.0},
                                                                    {-1, -0.75, -2.0 / 3.0},
                                                                    {2, -0.15, -1.0 / 12.0},
                                                                    {-2, 0.15, 1.0 / 12.0},
                                                                    {3, 1.0 / 60.0, 0.0},
                                                                    {-3, -1.0 / 60.0, 0.0}}};

}  // namespace arcwall
