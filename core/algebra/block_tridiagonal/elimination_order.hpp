#pragma once

// The order in which chain_elimination.cpp eliminates. Not installed.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include "core/lanes.hpp"

namespace arcwall::elimination {

// A group that goes, at a distance from its two neighbours; those at and beyond `length` are the one group there.
struct Going {
  Index group, distance, length;

  Index before() const { return group - distance; }
  Index behind() const { return std::min(group + distance, length); }
  bool is_last() const { return group + distance >= length; }
  // Whether the group before it goes before the one behind: their coupling belongs to that one.
  bool before_goes_first() const { return is_last() || (before() / (2 * distance)) % 2 == 1; }
};

// The last group of a stretch that goes at a distance, where it has nothing but the end behind it and nothing that goes
// there makes it wait; empty if there is none.
ARCWALL_IN_PLACE std::optional<Going> at_end(int round, Index length) {
  const Index distance = Index{1} << round, rank = (length - 1) / distance;
  const Index group = (rank - (rank % 2 == 0)) * distance;
  if (group <= 0 || group + distance <= length) return std::nullopt;
  return Going{group, distance, length};
}

// What can go when an odd group has gone: itself at a distance of 1, then groups at greater distances.
inline int last_round(Index odd) { return std::countr_one(static_cast<std::uint64_t>(odd) >> 1U); }
ARCWALL_IN_PLACE Going after(Index odd, int round, Index length) {
  return {odd + 1 - (Index{1} << round), Index{1} << round, length};
}
inline int rounds_of(Index length) { return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(length - 1))); }

// The groups of a part [begin, end) of a chain that can go, each as soon as it can. `visit` is called at one place, as
// it is long and becomes part of this.
template <class Visit>
ARCWALL_IN_PLACE void for_each_going(Index begin, Index end, Index length, const Visit& visit) {
  for (Index odd = begin + 1; odd < end || end == length; odd += 2) {
    const bool closes = odd >= end;
    const int last = closes ? rounds_of(length) - 1 : last_round(odd);
    for (int round = closes ? 1 : 0; round <= last; ++round)
      if (const std::optional<Going> j = closes ? at_end(round, length) : after(odd, round, length)) visit(*j);
    if (closes) return;
  }
}

// The same groups, the last one that went first.
template <class Visit>
ARCWALL_IN_PLACE void for_each_gone(Index begin, Index end, Index length, const Visit& visit) {
  const Index last_odd = end - 1 - end % 2;
  for (Index odd = end == length ? last_odd + 2 : last_odd; odd > begin; odd -= 2) {
    const bool closes = odd > last_odd;
    for (int round = closes ? rounds_of(length) - 1 : last_round(odd); round >= (closes ? 1 : 0); --round)
      if (const std::optional<Going> j = closes ? at_end(round, length) : after(odd, round, length)) visit(*j);
  }
}

}  // namespace arcwall::elimination
