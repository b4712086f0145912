#include "elements/element_order.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace arcwall {

namespace {

constexpr std::size_t large = 2000;  // elements whose evaluation takes many times as long as to wake a thread

ElementOrder::Part part_of(const ElementList& elements, const BlockAssembly& assembly,
                           const std::vector<Index>& which) {
  ElementOrder::Part part;
  std::array<std::int32_t, Lanes::count> waiting{};
  std::array<const ClassicBeam*, Lanes::count> beams{}, last{};
  std::size_t count = 0;
  for (const Index e : which) {
    const auto* beam = dynamic_cast<const ClassicBeam*>(&elements[e]);
    if (beam == nullptr) {
      part.others.push_back(e);
      continue;
    }
    waiting[count] = static_cast<std::int32_t>(e);
    beams[count++] = beam;
    if (count < waiting.size()) continue;
    if (std::exchange(last, beams) != beams) part.beams.emplace_back(beams);
    part.fours.push_back({.elements = waiting,
                          .beams = static_cast<std::uint32_t>(part.beams.size() - 1),
                          .shifted = assembly.are_shifted(waiting)});
    count = 0;
  }
  part.others.insert(part.others.end(), waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count));
  part.fours.shrink_to_fit();
  part.beams.shrink_to_fit();
  return part;
}

// The half of the elements that comes first along the longer side of the box around all.
std::vector<bool> first_half(const std::vector<Vec2>& middles) {
  Vec2 least = middles.front(), greatest = least;
  for (const Vec2& middle : middles) {
    least = least.cwiseMin(middle);
    greatest = greatest.cwiseMax(middle);
  }
  const Index along = greatest.y() - least.y() > greatest.x() - least.x() ? 1 : 0;
  std::vector<std::size_t> sorted(middles.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  const auto half = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), half, sorted.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(middles[a][along], a) < std::pair(middles[b][along], b);
  });
  std::vector<bool> first(middles.size(), false);
  for (auto i = sorted.begin(); i != half; ++i) first[*i] = true;
  return first;
}

}  // namespace

ElementOrder element_order(const ElementList& elements, const BlockAssembly& assembly,
                           const std::vector<Vec2>& middles) {
  std::vector<Index> first(elements.size()), second, last;
  std::iota(first.begin(), first.end(), Index{0});
  if (elements.size() >= large) {
    const std::vector<bool> in_first = first_half(middles);
    const auto middle = std::stable_partition(first.begin(), first.end(),
                                              [&](Index e) { return in_first[static_cast<std::size_t>(e)]; });
    std::vector<bool> touched(static_cast<std::size_t>(assembly.unknown_count()), false);
    for (auto e = first.begin(); e != middle; ++e) {
      const ShiftedIndices unknowns = assembly.unknowns(*e);
      for (std::size_t i = 0; i < unknowns.size(); ++i)
        if (unknowns[i] >= 0) touched[static_cast<std::size_t>(unknowns[i])] = true;
    }
    for (auto e = middle; e != first.end(); ++e) {
      const bool shares =
          assembly.unknowns(*e).any([&](Index i) { return i >= 0 && touched[static_cast<std::size_t>(i)]; });
      (shares ? last : second).push_back(*e);
    }
    first.erase(middle, first.end());
  }
  return {.first = part_of(elements, assembly, first),
          .second = part_of(elements, assembly, second),
          .last = part_of(elements, assembly, last)};
}

}  // namespace arcwall
