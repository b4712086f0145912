#pragma once

#include <cmath>

// What GCC and clang need to be told so that a formula in lanes becomes vector instructions: to leave no call in it.
#define ARCWALL_IN_PLACE [[gnu::always_inline]] inline

namespace arcwall {

/// Four numbers side by side, which share every operation: formulas that are written for any `Real` evaluate four
/// elements at once with it.
struct alignas(32) Lanes {
  static constexpr int count = 4;
  using Four [[gnu::vector_size(32)]] = double;  // aligned to 16 or 32 by the target: so Lanes says it
  typedef double AnyFour __attribute__((vector_size(32), aligned(8), may_alias));

  Four four;

  Lanes() = default;
  ARCWALL_IN_PLACE Lanes(double all) : four{all, all, all, all} {}  // NOLINT: constants stand in formulas
  ARCWALL_IN_PLACE explicit Lanes(const Four& numbers) : four(numbers) {}

  /// Four numbers that follow each other, of any alignment.
  ARCWALL_IN_PLACE static Lanes load(const double* from) {
    Lanes loaded;
    loaded.four = *reinterpret_cast<const AnyFour*>(from);
    return loaded;
  }
  ARCWALL_IN_PLACE void store(double* to) const { *reinterpret_cast<AnyFour*>(to) = four; }

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

inline double arc_tangent(double y, double x) { return std::atan2(y, x); }
ARCWALL_IN_PLACE Lanes arc_tangent(const Lanes& y, const Lanes& x) {
  Lanes angle;
  for (int lane = 0; lane < Lanes::count; ++lane) angle.four[lane] = std::atan2(y.four[lane], x.four[lane]);
  return angle;
}

}  // namespace arcwall
