#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace arcwall::verify {

/// A function of N variables at a place, with its first and second derivatives there: forward automatic
/// differentiation. What is written in jets as a formula needs no derivatives by hand, and no differences.
template <int N>
struct Jet {
  static constexpr std::size_t variables = N, pairs = static_cast<std::size_t>(N) * (N + 1) / 2;

  double value = 0.0;
  std::array<double, variables> slope{};
  std::array<double, pairs> bend{};  ///< ∂²/∂i∂j, j ≤ i, at i (i + 1)/2 + j

  Jet() = default;
  Jet(double constant) : value(constant) {}

  /// The variable of that number.
  static Jet variable(std::size_t number, double value) {
    Jet jet(value);
    jet.slope[number] = 1.0;
    return jet;
  }

  double second(std::size_t i, std::size_t j) const { return i < j ? second(j, i) : bend[i * (i + 1) / 2 + j]; }

  /// f of this jet, by f, f′ and f″ there.
  Jet mapped(double f, double first, double second) const {
    Jet out(f);
    for (std::size_t i = 0; i < variables; ++i) out.slope[i] = first * slope[i];
    for (std::size_t i = 0, k = 0; i < variables; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++k) out.bend[k] = first * bend[k] + second * slope[i] * slope[j];
    return out;
  }

  Jet& operator+=(const Jet& other) {
    value += other.value;
    for (std::size_t i = 0; i < variables; ++i) slope[i] += other.slope[i];
    for (std::size_t k = 0; k < pairs; ++k) bend[k] += other.bend[k];
    return *this;
  }
  Jet& operator*=(double factor) {
    value *= factor;
    for (double& one : slope) one *= factor;
    for (double& one : bend) one *= factor;
    return *this;
  }

  friend Jet operator+(Jet a, const Jet& b) { return a += b; }
  friend Jet operator-(Jet a) { return a *= -1.0; }
  friend Jet operator-(Jet a, Jet b) { return a += (b *= -1.0); }
  friend Jet operator*(double factor, Jet a) { return a *= factor; }
  friend Jet operator*(Jet a, double factor) { return a *= factor; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet out(a.value * b.value);
    for (std::size_t i = 0; i < variables; ++i) out.slope[i] = a.value * b.slope[i] + b.value * a.slope[i];
    for (std::size_t i = 0, k = 0; i < variables; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++k)
        out.bend[k] = a.value * b.bend[k] + b.value * a.bend[k] + a.slope[i] * b.slope[j] + a.slope[j] * b.slope[i];
    return out;
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const double inverse = 1.0 / b.value;
    return a * b.mapped(inverse, -inverse * inverse, 2.0 * inverse * inverse * inverse);
  }
};

template <int N>
Jet<N> sqrt(const Jet<N>& a) {
  const double root = std::sqrt(a.value);
  return a.mapped(root, 0.5 / root, -0.25 / (root * a.value));
}

template <int N>
Jet<N> sin(const Jet<N>& a) {
  const double sine = std::sin(a.value);
  return a.mapped(sine, std::cos(a.value), -sine);
}

template <int N>
Jet<N> cos(const Jet<N>& a) {
  const double cosine = std::cos(a.value);
  return a.mapped(cosine, -std::sin(a.value), -cosine);
}

/// ln(1 + a)
template <int N>
Jet<N> log1p(const Jet<N>& a) {
  const double inverse = 1.0 / (1.0 + a.value);
  return a.mapped(std::log1p(a.value), inverse, -inverse * inverse);
}

/// A function of M variables, each of which is a function of N others.
template <int M, int N>
Jet<N> composed(const Jet<M>& outer, const std::array<Jet<N>, static_cast<std::size_t>(M)>& inner) {
  Jet<N> out(outer.value);
  for (std::size_t a = 0; a < outer.variables; ++a) {
    for (std::size_t i = 0; i < out.variables; ++i) out.slope[i] += outer.slope[a] * inner[a].slope[i];
    std::array<double, Jet<N>::variables> turned{};  // Σ_b ∂²/∂a∂b ∂b/∂j
    for (std::size_t b = 0; b < outer.variables; ++b)
      for (std::size_t j = 0; j < out.variables; ++j) turned[j] += outer.second(a, b) * inner[b].slope[j];
    for (std::size_t i = 0, k = 0; i < out.variables; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++k)
        out.bend[k] += outer.slope[a] * inner[a].bend[k] + inner[a].slope[i] * turned[j];
  }
  return out;
}

/// The angle of (x, y), in [−π, π].
template <int N>
Jet<N> atan2(const Jet<N>& y, const Jet<N>& x) {
  const double square = x.value * x.value + y.value * y.value;
  const double cosine = x.value / square, sine = y.value / square;  // over the distance
  Jet<2> angle(std::atan2(y.value, x.value));
  angle.slope = {-sine, cosine};
  angle.bend = {2.0 * cosine * sine, sine * sine - cosine * cosine, -2.0 * cosine * sine};
  return composed<2, N>(angle, {x, y});
}

}  // namespace arcwall::verify
