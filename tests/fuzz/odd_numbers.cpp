#include "tests/fuzz/odd_numbers.hpp"

#include <array>

namespace arcwall::fuzz {

double odd_number(double old, FuzzedDataProvider& data) {
  static constexpr std::array values{0.0,     -0.0,   1.0,   -1.0,  0.25,  0.5,    2.0,  3.0,    1e-300,
                                     -5e-324, 1e-150, 1e-16, 1e-9,  -1e-9, 1e-6,   1e-3, 1e3,    1e6,
                                     1e9,     -1e16,  1e16,  1e150, 1e300, -1e300, 0.1,  3.1415, 100.125};
  static constexpr std::array factors{-1.0, 0.5, 2.0, 0.9, 1.1, 10.0, 0.1, 1e-3, 1e3, 1.0 + 1e-12, 1e-9, 1e9};
  switch (data.ConsumeIntegralInRange(0, 4)) {
    case 0:
      return one_of(values, data);
    case 1:
      return old * one_of(factors, data);
    case 2:
      return old + one_of(values, data);
    case 3:
      return data.ConsumeFloatingPointInRange(-10.0, 10.0);
    default:
      return data.ConsumeFloatingPoint<double>();
  }
}

}  // namespace arcwall::fuzz
