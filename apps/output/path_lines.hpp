#pragma once

#include <cstddef>
#include <vector>

#include "model/record.hpp"

namespace arcwall {

/// A part of a branch along which the stability is the same: the points first … last of the record, at least two.
struct PathLine {
  Index branch = 0;
  Stability stability = Stability::stable;
  std::size_t first = 0, last = 0;
};

/// The branches of a record as lines, in their order. An event's point belongs to the lines on both sides, whose
/// stability is that before and after it.
std::vector<PathLine> path_lines(const Record& record);

/// Where the points of branch i begin; one entry more than branches.
std::vector<std::size_t> first_points(const Record& record);

/// The index of the point that an event lies on.
std::size_t point_of(const RecordEvent& event, const std::vector<std::size_t>& first_points);

}  // namespace arcwall
