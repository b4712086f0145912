#pragma once

#include <cmath>

#include "core/types.hpp"

// What GCC and clang need to be told so that a formula in lanes becomes vector instructions: to leave no call in it.
#define ARCWALL_IN_PLACE [[gnu::always_inline]] inline

namespace arcwall {

/// Four numbers side by side, which share every operation: formulas that are written for any `Real` evaluate four
/// elements at once with it.
struct alignas(32) Lanes {
  static constexpr int count = 4;
  using Four [[gnu::vector_size(32)]] = double;  // aligned to 16 or 32 by the target: so Lanes says it

  Four four;

  Lanes() = default;
  // All four at once: compilers would copy one half after the other, and wait for both to be read again.
  ARCWALL_IN_PLACE Lanes(const Lanes& other) : four(other.four) {}
  ARCWALL_IN_PLACE Lanes& operator=(const Lanes& other) {
    four = other.four;
    return *this;
  }
  ARCWALL_IN_PLACE Lanes(double all) : four{all, all, all, all} {}  // NOLINT: constants stand in formulas
  ARCWALL_IN_PLACE Lanes(double a, double b, double c, double d) : four{a, b, c, d} {}
  ARCWALL_IN_PLACE explicit Lanes(const Four& numbers) : four(numbers) {}

  double operator[](int lane) const { return four[lane]; }
  void set(int lane, double number) { four[lane] = number; }

  ARCWALL_IN_PLACE friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.four + b.four); }
  ARCWALL_IN_PLACE friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.four - b.four); }
  ARCWALL_IN_PLACE friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.four * b.four); }
  ARCWALL_IN_PLACE friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.four / b.four); }
  ARCWALL_IN_PLACE Lanes& operator+=(const Lanes& other) { return *this = *this + other; }
  ARCWALL_IN_PLACE Lanes& operator-=(const Lanes& other) { return *this = *this - other; }
  ARCWALL_IN_PLACE friend Lanes operator-(const Lanes& a) { return Lanes(-a.four); }
};

/// The last three of some and the first of others.
ARCWALL_IN_PLACE Lanes next_of(const Lanes& these, const Lanes& others) {
  return Lanes(__builtin_shufflevector(these.four, others.four, 1, 2, 3, 4));
}

#ifdef __x86_64__
/// Whether the processor has registers of four numbers. Code for those is made beside that for any processor, by
/// [[gnu::target("avx")]].
inline bool has_wide_registers() { return __builtin_cpu_supports("avx") != 0; }
#endif

// Functions that such formulas need, by names that numbers and lanes share.

/// Of magnitudes below 2⁵¹: the sum with the constant has no room for a fraction.
template <class Real>
ARCWALL_IN_PLACE Real nearest_whole(const Real& x) {
  constexpr double no_fraction = 6755399441055744.0;  // 1.5 · 2⁵²
  return (x + no_fraction) - no_fraction;
}

inline double square_root(double x) { return std::sqrt(x); }
ARCWALL_IN_PLACE Lanes square_root(const Lanes& x) {
  Lanes root;
  for (int lane = 0; lane < Lanes::count; ++lane) root.four[lane] = std::sqrt(x.four[lane]);
  return root;
}

ARCWALL_IN_PLACE Lanes magnitude(const Lanes& x) { return Lanes(x.four < 0.0 ? -x.four : x.four); }

inline double magnitude(double x) { return std::abs(x); }

/// a < b ? yes : no
inline double where_less(double a, double b, double yes, double no) { return a < b ? yes : no; }
ARCWALL_IN_PLACE Lanes where_less(const Lanes& a, const Lanes& b, const Lanes& yes, const Lanes& no) {
  return Lanes(a.four < b.four ? yes.four : no.four);
}

/// The angle of (x, y) ≠ 0, in [−π, π], to two units in the last place. The library's takes one number at a time, and
/// its variants for several are rounded in other ways.
template <class Real>
ARCWALL_IN_PLACE Real arc_tangent(const Real& y, const Real& x) {
  constexpr double tan_eighth = 0.41421356237309504880;  // tan π/8
  constexpr double pi_low = 1.2246467991473532e-16;      // what π is greater than `pi`
  // (atan t − t)/t³ in t² up to tan² π/8: the polynomial through Chebyshev's nodes, 5·10⁻¹⁸ from it.
  constexpr double c[]{-0.3333333333333333,  0.1999999999999552,  -0.14285714284666542, 0.11111111015256361,
                       -0.09090904578123903, 0.07692183190826087, -0.06664511447381948, 0.0585814891280221,
                       -0.0508544973794026,  0.03923165829558719, -0.01917688711906226};
  const Real ax = magnitude(x), ay = magnitude(y);
  const Real less = where_less(ay, ax, ay, ax), more = where_less(ay, ax, ax, ay), limit = tan_eighth * more;
  // atan t = π/4 + atan((t − 1)/(t + 1))
  const Real over = where_less(limit, less, less - more, less), under = where_less(limit, less, less + more, more);
  const Real t = over / under, z = t * t, z2 = z * z, z4 = z2 * z2;
  const Real low = (c[0] + c[1] * z) + z2 * (c[2] + c[3] * z), middle = (c[4] + c[5] * z) + z2 * (c[6] + c[7] * z);
  const Real high = (c[8] + c[9] * z) + z2 * c[10];
  const Real p = low + z4 * (middle + z4 * high);
  // The angle is turns π/4 ± atan t, with what is low added to what is low.
  const Real low_part = t * z * p;
  Real turns = where_less(limit, less, Real(1.0), Real(0.0)), sign = 1.0;
  sign = where_less(ax, ay, -sign, sign);
  turns = where_less(ax, ay, 2.0 - turns, turns);
  sign = where_less(x, Real(0.0), -sign, sign);
  turns = where_less(x, Real(0.0), 4.0 - turns, turns);
  const Real angle = 0.25 * pi * turns + (sign * t + (0.25 * pi_low * turns + sign * low_part));
  return where_less(y, Real(0.0), -angle, angle);
}

template <class Real>
struct CosineAndSine {
  Real cosine, sine;
};

/// Of an angle of magnitude up to 10⁶, to 2⁻⁵² and, while it is small, to two units in the last place.
template <class Real>
ARCWALL_IN_PLACE CosineAndSine<Real> cosine_and_sine(const Real& angle) {
  // π/2 in three parts; up to 2²⁰ quarter turns, products with the first two are exact.
  constexpr double first = 1.5707963267341256, second = 6.077100506303966e-11, third = 2.0222662487959506e-21;
  // (sin r − r)/r³ and (cos r − 1 + r²/2)/r⁴ in r² up to (π/4)²: the polynomials through Chebyshev's nodes, 1.3·10⁻¹⁷
  // and 5·10⁻¹⁹ from them where they count.
  constexpr double s[]{-0.16666666666666666,  0.008333333333330946,    -0.0001984126983675497,
                       2.755731610068312e-06, -2.5051131455447428e-08, 1.591810123167728e-10};
  constexpr double c[]{0.041666666666666664,    -0.0013888888888887395, 2.4801587298763433e-05,
                       -2.7557317270560385e-07, 2.087614602470193e-09,  -1.1382614869434128e-11};
  const Real quarters = nearest_whole(angle * (2.0 / pi));
  const Real r = ((angle - quarters * first) - quarters * second) - quarters * third, z = r * r, z2 = z * z;
  const Real sine_part = (s[0] + s[1] * z) + z2 * ((s[2] + s[3] * z) + z2 * (s[4] + s[5] * z));
  const Real cosine_part = (c[0] + c[1] * z) + z2 * ((c[2] + c[3] * z) + z2 * (c[4] + c[5] * z));
  const Real sine = r + r * (z * sine_part), cosine = 1.0 - (0.5 * z - z2 * cosine_part);
  // −2 to 2: by one quarter, each takes the other's place; then signs.
  const Real quarter = quarters - 4.0 * nearest_whole(0.25 * quarters), size = magnitude(quarter);
  const Real beside = magnitude(size - 1.0);  // of ±1
  const Real positive = where_less(size, Real(1.5), Real(1.0), Real(-1.0));
  const Real turned = where_less(quarter, Real(-0.5), Real(-1.0), Real(1.0));
  return {.cosine = where_less(beside, Real(0.5), -turned * sine, positive * cosine),
          .sine = where_less(beside, Real(0.5), turned * cosine, positive * sine)};
}

}  // namespace arcwall
