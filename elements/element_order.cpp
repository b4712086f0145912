#include "elements/element_order.hpp"

#include <utility>

namespace arcwall {

ElementOrder element_order(const ElementList& elements, const BlockAssembly& assembly,
                           const std::function<bool(Index)>& is_displaced) {
  ElementOrder order;
  std::array<std::int32_t, Lanes::count> waiting{};
  std::array<const ClassicBeam*, Lanes::count> beams{}, last{};
  std::size_t count = 0;
  for (Index e = 0; e < static_cast<Index>(elements.size()); ++e) {
    if (elements[e].depends_on_lambda() || is_displaced(e)) {
      order.driven.push_back(e);
      continue;
    }
    const auto* beam = dynamic_cast<const ClassicBeam*>(&elements[e]);
    if (beam == nullptr) {
      order.others.push_back(e);
      continue;
    }
    waiting[count] = static_cast<std::int32_t>(e);
    beams[count++] = beam;
    if (count < waiting.size()) continue;
    if (std::exchange(last, beams) != beams) order.beams.emplace_back(beams);
    order.fours.push_back({.elements = waiting,
                           .beams = static_cast<std::uint32_t>(order.beams.size() - 1),
                           .shifted = assembly.are_shifted(waiting)});
    count = 0;
  }
  order.others.insert(order.others.end(), waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count));
  order.fours.shrink_to_fit();
  order.beams.shrink_to_fit();
  return order;
}

}  // namespace arcwall
