#include "core/root_find.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

namespace arcwall {

namespace {

// v(t) = v0 + d0 t + c t² + e t³ from end values and slopes (Hermite).
struct Cubic {
  double v0, d0, c, e;

  Cubic(double v_0, double d_0, double v_1, double d_1)
      : v0(v_0), d0(d_0), c(3.0 * (v_1 - v_0) - 2.0 * d_0 - d_1), e(2.0 * (v_0 - v_1) + d_0 + d_1) {}

  double operator()(double t) const { return v0 + t * (d0 + t * (c + t * e)); }

  // Zeros of v′ inside (0, 1), in order: they cut [0, 1] into monotone parts.
  std::vector<double> turning_points() const {
    std::vector<double> found;
    const double a = 3.0 * e, b = 2.0 * c, discriminant = b * b - 4.0 * a * d0;
    if (discriminant < 0.0) return found;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    if (a != 0.0) found.push_back(q / a);
    if (q != 0.0) found.push_back(d0 / q);
    std::erase_if(found, [](double t) { return !(t > 0.0 && t < 1.0); });
    std::sort(found.begin(), found.end());
    return found;
  }
};

double bisected(const Cubic& v, double a, double b) {
  const bool rising = v(b) > v(a);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (a + b);
    ((v(middle) > 0.0) == rising ? b : a) = middle;
  }
  return 0.5 * (a + b);
}

}  // namespace

std::optional<Root> bracketed_root(const std::function<std::optional<double>(double)>& f, double a, double fa, double b,
                                   double fb, double tolerance, int max_evaluations) {
  bool failed = false;
  double best = std::abs(fa) < std::abs(fb) ? a : b, least = std::min(std::abs(fa), std::abs(fb));
  const auto value = [&](double t) {
    const std::optional<double> v = f(t);
    failed = failed || !v || !std::isfinite(*v);
    if (failed) return 0.0;  // a zero stops the search at once
    if (std::abs(*v) < least) {
      least = std::abs(*v);
      best = t;
    }
    return *v;
  };
  if (fa == 0.0) return Root{.at = a, .half_width = 0.0};
  if (fb == 0.0) return Root{.at = b, .half_width = 0.0};
  if ((fa < 0.0) == (fb < 0.0)) return std::nullopt;
  const auto narrow = [&](double left, double right) { return std::abs(right - left) <= tolerance; };
  auto evaluations = static_cast<std::uintmax_t>(max_evaluations);
  const auto [left, right] = a < b ? boost::math::tools::toms748_solve(value, a, b, fa, fb, narrow, evaluations)
                                   : boost::math::tools::toms748_solve(value, b, a, fb, fa, narrow, evaluations);
  if (failed) return std::nullopt;
  // A value near zero far from the bracket says nothing: f may touch zero elsewhere.
  const double middle = 0.5 * (left + right);
  return Root{.at = best >= left && best <= right ? best : middle, .half_width = 0.5 * (right - left)};
}

std::optional<double> first_cubic_zero(double v0, double d0, double v1, double d1) {
  const Cubic v(v0, d0, v1, d1);
  std::vector<double> ends = v.turning_points();
  ends.push_back(1.0);
  double from = 0.0, value = v0;
  if (value == 0.0) value = d0;  // the sign just after the start
  for (const double to : ends) {
    const double next = to == 1.0 ? v1 : v(to);
    if (value != 0.0 && (next == 0.0 || (next > 0.0) != (value > 0.0))) return next == 0.0 ? to : bisected(v, from, to);
    from = to;
    value = next;
  }
  return std::nullopt;
}

std::optional<double> cubic_turn(double v0, double d0, double v1, double d1) {
  if (!(d0 * d1 < 0.0)) return std::nullopt;
  const std::vector<double> turns = Cubic(v0, d0, v1, d1).turning_points();
  return turns.size() == 1 ? std::optional(turns.front()) : std::nullopt;
}

double least_cubic_value(double v0, double d0, double v1, double d1) {
  const Cubic v(v0, d0, v1, d1);
  double least = std::min(v0, v1);
  for (const double t : v.turning_points()) least = std::min(least, v(t));
  return least;
}

}  // namespace arcwall
