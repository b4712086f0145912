#pragma once

#include <vector>

#include "elements/sliding_structure.hpp"
#include "model/deck/deck.hpp"
#include "model/member_stretch.hpp"

/// What members carry in a state, from node to node.
namespace arcwall {

/// A member of a structure whose contacts are tied to its mesh. `member` is its index in the deck.
struct TiedMember {
  const Structure& structure;
  std::size_t member = 0;
  Theory theory = Theory::euler_bernoulli;

  int elements() const { return static_cast<int>(structure.members()[member].nodes.size()) - 1; }
};

/// One stretch for element k of a member, two of an element with a middle node.
void add_stretches(const TiedMember& member, int k, const State& state, std::vector<MemberStretch>& to);

/// The element after a node of a strand, in a state whose layout is a SlidingLayout; `from` and `to` are material
/// coordinates. One stretch, and one more for each point load inside the element.
void add_sliding_stretches(const SlidingStructure& body, Index strand, Index position, const State& state,
                           std::vector<MemberStretch>& to);

}  // namespace arcwall
