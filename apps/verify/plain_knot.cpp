#include "apps/verify/plain_knot.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "core/types.hpp"

namespace arcwall::verify {

// The third derivative rises by ½ + (9 ξ − 5 ξ³)/8 in −1 ≤ ξ ≤ 1, where a spline's rises by 1 at ξ = 0. What it is more
// than that is integrated once, twice and three times, exactly by Gauss's rule.
RoundedKnot rounded_knot(double from_knot, double shorter) {
  constexpr double rounding = 1e-5;  // of the shorter interval
  const double w = rounding * shorter, xi = from_knot / w;
  if (!(std::abs(xi) < 1.0)) return {};
  const auto integral = [&](int times) {
    const auto rise = [&](double at) {
      const double arm = xi - at, lever = times == 1 ? 1.0 : times == 2 ? arm : 0.5 * arm * arm;
      return lever * (0.5 + (9.0 * at - 5.0 * at * at * at) / 8.0);
    };
    const double ahead = std::max(xi, 0.0), jump = times == 1   ? ahead
                                                   : times == 2 ? ahead * ahead / 2.0
                                                                : ahead * ahead * ahead / 6.0;
    return std::pow(w, times) * (boost::math::quadrature::gauss<double, 7>::integrate(rise, -1.0, xi) - jump);
  };
  return {.value = integral(3), .slope = integral(2), .second = integral(1)};
}

}  // namespace arcwall::verify
