#pragma once

#include <array>
#include <utility>

namespace arcwall {

/// Gauss's rule of eight points on [−1, 1]: its positive places and their weights.
inline constexpr std::array<std::pair<double, double>, 4> gauss_points{{{0.18343464249564980, 0.36268378337836198},
                                                                        {0.52553240991632899, 0.31370664587788729},
                                                                        {0.79666647741362674, 0.22238103445337447},
                                                                        {0.96028985649753623, 0.10122853629037626}}};

}  // namespace arcwall
