#include "apps/output/shown_number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace arcwall {

namespace {

// Of the first digit: −3 for 0.00104.
int exponent(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)))); }

double power_of_ten(int exponent) { return std::pow(10.0, exponent); }

// A number and what is uncertain of it, both whole multiples of a power of ten, the latter less than ten of them.
struct Rounded {
  double value = 0.0, uncertain = 0.0;
  int last = 0;  // exponent of the last digit
};

Rounded rounded(double value, double half_width) {
  constexpr double roundoff = 1e-6;  // of the last digit
  Rounded result{.last = exponent(half_width)};
  for (;; ++result.last) {
    const double unit = power_of_ten(result.last);
    const double whole = std::round(value / unit);
    const double uncertain = std::ceil((half_width + std::abs(value - whole * unit)) / unit - roundoff);
    result.value = whole == 0.0 ? 0.0 : whole * unit;
    result.uncertain = uncertain * unit;
    if (uncertain < 10.0) return result;
  }
}

std::string with_uncertainty(double value, double half_width, int digits) {
  const Rounded shown = rounded(value, half_width);
  if (shown.value == 0.0) return fmt::format("0 ± {:.1g}", shown.uncertain);
  const int first = std::max(exponent(shown.value), exponent(shown.uncertain));
  if (first >= -4 && first < digits)
    return fmt::format("{:.{}f} ± {:.{}f}", shown.value, std::max(-shown.last, 0), shown.uncertain,
                       std::max(-shown.last, 0));
  const double unit = power_of_ten(first);
  const int places = std::max(first - shown.last, 0);
  return fmt::format("({:.{}f} ± {:.{}f})e{:+03d}", shown.value / unit, places, shown.uncertain / unit, places, first);
}

}  // namespace

// −0 is a number that people take for a mistake.
std::string shown_number(double value, int digits) {
  return fmt::format("{:.{}g}", value == 0.0 ? 0.0 : value, digits);
}

std::string shown_uncertain(double value, double half_width, int digits) {
  if (!std::isfinite(value) || half_width <= 0.0) return shown_number(value, digits);
  if (!std::isfinite(half_width)) return "?";
  if (is_marked_uncertain(value, half_width)) return with_uncertainty(value, half_width, digits);
  const int last = static_cast<int>(std::ceil(std::log10(2.0 * half_width)));
  return shown_number(value, std::clamp(exponent(value) - last + 1, 1, digits));
}

bool is_marked_uncertain(double value, double half_width) {
  constexpr double marked = 1e-6;
  return half_width > marked * std::abs(value);
}

}  // namespace arcwall
