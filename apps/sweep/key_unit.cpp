#include "apps/sweep/key_unit.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace arcwall::sweep {

namespace {

struct Dimension {
  std::string_view key;
  int force, length;  // powers
};

constexpr std::array<Dimension, 20> dimensions{
    {{"E", 1, -2},   {"width", 0, 1},     {"height", 0, 1},     {"radius", 0, 1},     {"thickness", 0, 1},
     {"A", 0, 2},    {"I", 0, 4},         {"shear_area", 0, 2}, {"point", 0, 1},      {"via", 0, 1},
     {"rise", 0, 1}, {"amplitude", 0, 1}, {"force", 1, 0},      {"moment", 1, 1},     {"distributed", 1, -1},
     {"z", 0, 1},    {"centre", 0, 1},    {"apex", 0, 1},       {"curvature", 0, -1}, {"penalty", 1, -2}}};

std::string power(const std::string& unit, int exponent) {
  constexpr std::array<const char*, 5> raised{"", "", "²", "³", "⁴"};
  return unit + raised[static_cast<std::size_t>(std::abs(exponent))];
}

std::string unit_text(const Dimension& of, const deck::Units& units) {
  if (of.length == 0) return units.force;
  const std::string length = power(units.length, of.length);
  if (of.force == 0) return of.length > 0 ? length : "1/" + length;
  return units.force + (of.length > 0 ? " " : "/") + length;
}

std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

bool is_index(const std::string& part) { return part.find_first_not_of("0123456789") == std::string::npos; }

}  // namespace

// By the last part that is no index; of a point, whose last part is its name, by the first.
std::string unit_of_key(const std::string& key, const deck::Units& units) {
  if (units.length.empty() || units.force.empty()) return {};
  const std::vector<std::string> parts = parts_of(key);
  const auto last = std::find_if_not(parts.rbegin(), parts.rend(), is_index);
  const std::string& name = parts.front() == "point" || last == parts.rend() ? parts.front() : *last;
  const auto found =
      std::find_if(dimensions.begin(), dimensions.end(), [&](const Dimension& one) { return one.key == name; });
  return found == dimensions.end() ? std::string() : unit_text(*found, units);
}

}  // namespace arcwall::sweep
