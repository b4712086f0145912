#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "core/lanes.hpp"
#include "core/types.hpp"

namespace arcwall {

/// Where numbers that stand somewhere in an array go in lanes: each record has some places, and each place a number a
/// lane. Records that differ by a shift of what they take alone, as those of a chain of like groups do, share the
/// list: what is looked up is small beside what is moved.
class LanePlaces {
 public:
  static constexpr std::int32_t none = -1;    ///< nothing goes there: zero stands there
  static constexpr std::int32_t filled = -2;  ///< nor there: the filling does

  /// A place in a record and the indices in the array of what goes there.
  struct Place {
    Index at;
    std::array<std::int32_t, Lanes::count> from;
  };

  /// The next record.
  void add(std::vector<Place> places);

  /// No record follows.
  void complete() { known_.clear(); }

  /// From an array to a record's places, `step` apart, times a factor.
  void gather(Index record, const double* from, double filling, double factor, Index step, Lanes* to) const {
    const Record& at = records_[static_cast<std::size_t>(record)];
    const Shape& shape = shapes_[static_cast<std::size_t>(at.shape)];
    const double *a = from + at.first[0], *b = from + at.first[1], *c = from + at.first[2], *d = from + at.first[3];
    for (std::int32_t i = shape.begin; i < shape.end; ++i) {
      const Offset& place = offsets_[static_cast<std::size_t>(i)];
      const auto& o = place.from;
      to[place.at * step] = factor * Lanes(a[o[0]], b[o[1]], c[o[2]], d[o[3]]);
    }
    for (std::int32_t i = shape.end; i < shape.end_of_others; ++i) {
      const Offset& place = offsets_[static_cast<std::size_t>(i)];
      for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
        const std::int32_t offset = place.from[lane];
        const double value = offset >= 0 ? from[at.first[lane] + offset] : offset == none ? 0.0 : filling;
        to[place.at * step].set(static_cast<int>(lane), factor * value);
      }
    }
  }

  /// And back, where something came from.
  void scatter(Index record, const Lanes* from, Index step, double* to) const {
    const Record& at = records_[static_cast<std::size_t>(record)];
    const Shape& shape = shapes_[static_cast<std::size_t>(at.shape)];
    for (std::int32_t i = shape.begin; i < shape.end_of_others; ++i) {
      const Offset& place = offsets_[static_cast<std::size_t>(i)];
      for (std::size_t lane = 0; lane < Lanes::count; ++lane)
        if (i < shape.end || place.from[lane] >= 0)
          to[at.first[lane] + place.from[lane]] = from[place.at * step][static_cast<int>(lane)];
    }
  }

  /// Asks memory for what records from `begin` to before `end` take from an array, if that follows each other there.
  void ask_ahead(Index begin, Index end, const double* array) const {
    constexpr std::int32_t per_line = 8, most = 64;  // most: numbers a record
    const auto& from = records_[static_cast<std::size_t>(begin)].first;
    const auto& to = records_[static_cast<std::size_t>(end)].first;
    const auto limit = static_cast<std::int32_t>(end - begin) * most;
    for (std::size_t lane = 0; lane < Lanes::count; ++lane)
      for (std::int32_t i = 0; i < std::min(to[lane] - from[lane], limit); i += per_line)
        __builtin_prefetch(array + from[lane] + i);
  }

 private:
  struct Record {
    std::array<std::int32_t, Lanes::count> first;
    std::int32_t shape;
  };
  struct Offset {
    std::int32_t at;
    std::array<std::int32_t, Lanes::count> from;  // the first one of the lane, or `none` or `filled`

    auto operator<=>(const Offset&) const = default;
  };
  // Those that have a number for each lane, and the others.
  struct Shape {
    std::int32_t begin, end, end_of_others;
  };

  std::vector<Record> records_;
  std::vector<Shape> shapes_;
  std::vector<Offset> offsets_;
  std::map<std::vector<Offset>, std::int32_t> known_;  // shapes
};

}  // namespace arcwall
