#include "core/algebra/block_tridiagonal/lane_places.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace arcwall {

void LanePlaces::add(std::vector<Place> places) {
  Record record{};
  for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
    std::int32_t first = std::numeric_limits<std::int32_t>::max();
    for (const Place& place : places)
      if (place.from[lane] >= 0) first = std::min(first, place.from[lane]);
    record.first[lane] = first < std::numeric_limits<std::int32_t>::max() ? first : 0;
  }
  const auto is_whole = [](const Place& place) {
    return std::all_of(place.from.begin(), place.from.end(), [](std::int32_t from) { return from >= 0; });
  };
  const auto others = std::stable_partition(places.begin(), places.end(), is_whole);
  std::vector<Offset> offsets;
  for (const Place& place : places) {
    Offset offset{.at = static_cast<std::int32_t>(place.at), .from = place.from};
    for (std::size_t lane = 0; lane < Lanes::count; ++lane)
      if (offset.from[lane] >= 0) offset.from[lane] -= record.first[lane];
    offsets.push_back(offset);
  }
  const auto [shape, is_new] = known_.try_emplace(offsets, static_cast<std::int32_t>(shapes_.size()));
  if (is_new) {
    const auto begin = static_cast<std::int32_t>(offsets_.size());
    offsets_.insert(offsets_.end(), offsets.begin(), offsets.end());
    shapes_.push_back({.begin = begin,
                       .end = begin + static_cast<std::int32_t>(others - places.begin()),
                       .end_of_others = static_cast<std::int32_t>(offsets_.size())});
  }
  record.shape = shape->second;
  records_.push_back(record);
}

}  // namespace arcwall
