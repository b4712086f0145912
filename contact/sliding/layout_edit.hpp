#pragma once

#include <cstdint>
#include <vector>

#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// A layout to be changed: its points, where they are and what they bear, and the elements between them.
struct LayoutEdit {
  ElementsPerSegment elements{};
  std::vector<SlidingContactLayout::Point> points{};
  std::vector<Index> strands{};        ///< of the points, ascending
  std::vector<std::uint8_t> closed{};  ///< of the points
  std::vector<double> forces{};        ///< of the points; those of open ones do not matter
  Vector s{};                          ///< of the points

  /// Elements of the segment before a point, and of that behind it.
  int& elements_before(std::size_t point) { return segment(point); }
  int& elements_behind(std::size_t point) { return segment(point, 1); }

  double& place(std::size_t point) { return s[static_cast<Index>(point)]; }

  /// A place with a point of its own.
  struct Entry {
    SlidingContactLayout::Point point{};
    Index strand = 0;
    double s = 0.0;
    bool closed = false;
    double force = 0.0;
  };

  /// The segment in which the entry falls becomes two of these numbers of elements; which point it is now.
  std::size_t insert(const Entry& entry, int elements_before, int elements_behind);

  /// The segments before and behind a point become one with so many elements.
  void erase(std::size_t point, int of_both);

 private:
  int& segment(std::size_t point, std::size_t beyond = 0);
};

/// The layout of a state, with what its points bear, before any change.
LayoutEdit edit_of(const SlidingState& at);

/// The layout that has been made of one.
std::shared_ptr<const SlidingContactLayout> layout_of(const SlidingBody& body, const LayoutEdit& edit);

}  // namespace arcwall::sliding
