#pragma once

#include <optional>
#include <string>

#include "apps/sweep/design.hpp"

namespace arcwall::sweep {

/// A case on a map or on a line, or all cases of a small part of a map.
struct MapPoint {
  int number = 0;
  Json x{}, y{};                 ///< values of the varied keys; y is not looked at with one key
  std::optional<double> load{};  ///< empty: the case has no such event
  bool failed = false;
  std::string note{};  ///< what else is said of it: the values of other keys; may be empty
  std::string link{};  ///< to the report of the case; empty: there is none
  int cases = 1;       ///< more than 1: so many cases near x and y, whose mean load it has
};

/// What the axes of a map and its loads are called.
struct MapTitles {
  std::string x{};
  std::string y{};     ///< empty: one key alone
  std::string load{};  ///< `λ of the snap`
  std::string unit{};  ///< of the loads: what λ multiplies; may be empty
};

/// A point in words, as an element <title>: its case, the values, the load, and how it compares with λ₀ where that is
/// given.
std::string tip(const MapTitles& titles, const MapPoint& point, std::optional<double> reference = {});

/// A mark inside <g>, which says the tip, and which a click follows where the point has a link.
std::string pointed_at(const std::string& tip, const std::string& link, const std::string& mark);

/// `λ of the snap, times 2 kN`.
std::string load_axis(const MapTitles& titles);

}  // namespace arcwall::sweep
