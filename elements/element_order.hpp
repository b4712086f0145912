#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/algebra/assembly.hpp"
#include "elements/classic_beam_lanes.hpp"
#include "elements/element_list.hpp"

namespace arcwall {

/// The order in which the elements of a structure are added up: classic beams four at a time, then the others. It is
/// always the same, so that the sums are the same to the last bit.
struct ElementOrder {
  struct Four {
    std::array<std::int32_t, Lanes::count> elements;
    std::uint32_t beams;  ///< which of ElementOrder::beams
    bool shifted;         ///< BlockAssembly::are_shifted()
  };

  std::vector<Four> fours;              ///< classic beams side by side
  std::vector<ClassicBeamLanes> beams;  ///< what these are: fours that are alike share it
  std::vector<Index> others;            ///< elements one by one
};

ElementOrder element_order(const ElementList& elements, const BlockAssembly& assembly);

}  // namespace arcwall
