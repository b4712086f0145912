#pragma once

#include <cstdint>
#include <numeric>
#include <string_view>

namespace arcwall::fuzz {

/// True for one in so many texts, and the same whenever a text is met: for what takes too long to be done with each.
inline bool is_one_in(std::uint32_t count, std::string_view text) {
  const auto add = [](std::uint32_t sum, char c) { return sum + static_cast<std::uint8_t>(c); };
  return std::accumulate(text.begin(), text.end(), std::uint32_t{0}, add) % count == 0;
}

}  // namespace arcwall::fuzz
