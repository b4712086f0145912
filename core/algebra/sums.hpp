#pragma once

#include <array>
#include <cstddef>

#include "core/lanes.hpp"

namespace arcwall {

/// Where entries of vectors are read or written: four at a time, and one by one at the end. Factors that all entries
/// share are spread before: in the loop each would be put together anew.
struct FourEntries {
  Index first;

  ARCWALL_IN_PLACE Lanes operator()(const double* entries) const { return Lanes::load(entries + first); }
  ARCWALL_IN_PLACE void set(double* entries, const Lanes& value) const { value.store(entries + first); }
  ARCWALL_IN_PLACE const Lanes& operator()(const Lanes& spread) const { return spread; }
};
struct OneEntry {
  Index place;

  double operator()(const double* entries) const { return entries[place]; }
  void set(double* entries, double value) const { entries[place] = value; }
  double operator()(const Lanes& spread) const { return spread[0]; }
};

/// `step(at)` for all entries, `at` being one of the above: what several expressions would read several times over.
template <class Step>
ARCWALL_IN_PLACE void for_entries(Index count, const Step& step) {
  Index i = 0;
  for (; i + Lanes::count <= count; i += Lanes::count) step(FourEntries{i});
  for (; i < count; ++i) step(OneEntry{i});
}

/// Several sums over all entries in one pass: `add(at, sums)` adds the terms of the entries there.
template <std::size_t N, class Add>
ARCWALL_IN_PLACE std::array<double, N> sums_over(Index count, const Add& add) {
  std::array<Lanes, N> four;
  four.fill(Lanes(0.0));
  Index i = 0;
  for (; i + Lanes::count <= count; i += Lanes::count) add(FourEntries{i}, four);
  std::array<double, N> sums;
  for (std::size_t k = 0; k < N; ++k) sums[k] = (four[k][0] + four[k][1]) + (four[k][2] + four[k][3]);
  for (; i < count; ++i) add(OneEntry{i}, sums);
  return sums;
}

}  // namespace arcwall
