#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/algebra/assembly.hpp"
#include "elements/classic_beam_lanes.hpp"
#include "elements/element_list.hpp"

namespace arcwall {

/// The order in which the elements of a structure are added up: classic beams four at a time, then the others. It is
/// always the same, so that the sums are the same to the last bit. Elements that λ drives stand apart.
struct ElementOrder {
  struct Four {
    std::array<std::int32_t, Lanes::count> elements;
    std::uint32_t beams;  ///< which of ElementOrder::beams
    bool shifted;         ///< BlockAssembly::are_shifted()
  };

  std::vector<Four> fours;              ///< classic beams side by side
  std::vector<ClassicBeamLanes> beams;  ///< what these are: fours that are alike share it
  std::vector<Index> others;            ///< elements one by one
  std::vector<Index>
      driven;  ///< one by one, too: those that depend on λ, or whose held degrees of freedom are not at 0
};

/// `is_displaced(e)`: whether a support gives a degree of freedom of element e another value than 0.
ElementOrder element_order(const ElementList& elements, const BlockAssembly& assembly,
                           const std::function<bool(Index)>& is_displaced);

}  // namespace arcwall
