#include "apps/sweep/design.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace arcwall::sweep {

namespace {

double rounded(double value) {
  constexpr int decimals = 11;  // behind the first digit
  std::array<char, 32> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, decimals);
  double result = 0.0;
  std::from_chars(text.data(), end.ptr, result);
  return result;
}

// Below `bound`, each with the same probability: what would favour the small ones is drawn again.
std::uint64_t below(std::uint64_t bound, std::mt19937_64& random) {
  const std::uint64_t rest = (std::mt19937_64::max() % bound + 1) % bound;  // 2⁶⁴ modulo bound
  std::uint64_t drawn = random();
  while (drawn > std::mt19937_64::max() - rest) drawn = random();
  return drawn % bound;
}

// In [0, 1): the upper 53 bits.
double fraction(std::mt19937_64& random) { return static_cast<double>(random() >> 11u) * 0x1p-53; }

// 0 … count − 1 in random order, after Fisher and Yates.
std::vector<int> shuffled(int count, std::mt19937_64& random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t left = order.size(); left > 1; --left) std::swap(order[left - 1], order[below(left, random)]);
  return order;
}

}  // namespace

double value_at(const Range& range, double fraction) {
  if (fraction == 0.0) return range.from;
  if (fraction == 1.0) return range.to;
  if (range.spacing == Spacing::linear) return rounded((1.0 - fraction) * range.from + fraction * range.to);
  return rounded(range.from * std::exp(fraction * std::log(range.to / range.from)));
}

std::vector<double> values(const Range& range, int count) {
  std::vector<double> result;
  for (int i = 0; i < count; ++i) result.push_back(value_at(range, static_cast<double>(i) / (count - 1)));
  return result;
}

Json number(double value) {
  constexpr double largest = 1e15;  // a double holds every integer up to here
  if (value == std::round(value) && std::abs(value) <= largest) return static_cast<std::int64_t>(value);
  return value;
}

std::vector<std::vector<Json>> grid(const std::vector<std::vector<Json>>& values) {
  std::vector<std::vector<Json>> rows{{}};
  for (const std::vector<Json>& of_key : values) {
    std::vector<std::vector<Json>> longer;
    for (const std::vector<Json>& row : rows)
      for (const Json& value : of_key) {
        longer.push_back(row);
        longer.back().push_back(value);
      }
    rows = std::move(longer);
  }
  return rows;
}

std::vector<std::vector<Json>> latin_hypercube(const std::vector<Range>& ranges, int samples, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<Json>> rows(static_cast<std::size_t>(samples));
  for (const Range& range : ranges) {
    const std::vector<int> part = shuffled(samples, random);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i].push_back(number(value_at(range, (part[i] + fraction(random)) / samples)));
  }
  return rows;
}

}  // namespace arcwall::sweep
