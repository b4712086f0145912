#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/algebra/assembly.hpp"
#include "elements/classic_beam_lanes.hpp"
#include "elements/element_list.hpp"

namespace arcwall {

/// The order in which the elements of a structure are added up: always the same, so that sums are, however many threads
/// there are.
struct ElementOrder {
  struct Four {
    std::array<std::int32_t, Lanes::count> elements;
    std::uint32_t beams;  ///< which of those of the part
    bool shifted;         ///< BlockAssembly::are_shifted()
  };
  struct Part {
    std::vector<Four> fours;              ///< classic beams side by side
    std::vector<ClassicBeamLanes> beams;  ///< what these are: fours that are alike share it
    std::vector<Index> others;            ///< elements one by one

    bool empty() const { return fours.empty() && others.empty(); }
  };

  /// The first two parts share no unknown; one of less than 2000 elements has all of them in the first.
  Part first, second;
  Part last;  ///< after both
};

/// `middles`: a place of each element; those of the second part lie beyond those of the first.
ElementOrder element_order(const ElementList& elements, const BlockAssembly& assembly,
                           const std::vector<Vec2>& middles);

}  // namespace arcwall
