#pragma once

#include <type_traits>

/// Derivatives by central differences of order 4.
namespace arcwall::verify {

/// f′(0).
template <class Function>
auto derivative(const Function& f, double step) {
  using Value = std::decay_t<decltype(f(step))>;
  const Value p1 = f(step), m1 = f(-step), p2 = f(2.0 * step), m2 = f(-2.0 * step);
  return Value((8.0 * (p1 - m1) - (p2 - m2)) / (12.0 * step));
}

/// f″(0).
template <class Function>
double second_derivative(const Function& f, double step) {
  return (16.0 * (f(step) + f(-step)) - (f(2.0 * step) + f(-2.0 * step)) - 30.0 * f(0.0)) / (12.0 * step * step);
}

}  // namespace arcwall::verify
