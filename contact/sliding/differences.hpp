#pragma once

#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

/// The derivative of a function of a change at no change, by central differences of fourth order.
template <class Function>
double derivative(const Function& f, double step) {
  return (8.0 * (f(step) - f(-step)) - (f(2.0 * step) - f(-2.0 * step))) / (12.0 * step);
}

/// The same of second order, to ten digits: of a function without round-off in steps of 1e-5.
template <class Function>
double derivative_by_two(const Function& f, double step) {
  return (f(step) - f(-step)) / (2.0 * step);
}

}  // namespace arcwall::sliding
