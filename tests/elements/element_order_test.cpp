#include "elements/element_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "elements/truss.hpp"
#include "tests/elements/element_checks.hpp"

namespace arcwall::element_order_test {

namespace {

using test::Numbers;

constexpr int lanes = Lanes::count;

ClassicBeam beam_of(Numbers& numbers) {
  const Vector of = numbers.vector(7);
  return {{.chord = {1.0 + 0.3 * of[0], of[1]}, .length = 1.6 + 0.3 * of[2], .slope1 = 0.4 * of[3], .slope2 = of[4]},
          200.0 + 100.0 * of[5],
          3.0 + of[6]};
}

// A row of elements from left to right, three unknowns a node; every fifth is a bar.
struct Row {
  ElementList elements{};
  IndexLists blocks{};

  explicit Row(Index count) {
    for (Index e = 0; e < count; ++e) {
      const Index i = 3 * e;
      const bool bar = e % 5 == 4;
      if (bar)
        elements.add(std::make_shared<Truss>(Vec2(1.0, 0.0), 100.0, TrussStrain::green));
      else
        elements.add(std::make_shared<ClassicBeam>(BeamReference{.chord = {1.0, 0.0}, .length = 1.0}, 100.0, 1.0));
      const Index x = e == 0 ? -1 : i, z = e == 0 ? -1 : i + 1;  // the first end is pinned
      if (bar)
        blocks.push_back({x, z, i + 3, i + 4});
      else
        blocks.push_back({x, z, i + 2, i + 3, i + 4, i + 5});
    }
  }

  BlockAssembly assembly() const { return {3 * static_cast<Index>(elements.size()) + 3, blocks}; }
  ElementOrder order() const {
    return element_order(elements, assembly(), [](Index) { return false; });
  }
};

}  // namespace

TEST(ClassicBeamLanes, HaveTheNumbersOfTheirBeamsToTheLastBit) {
  Numbers numbers(31);
  for (int round = 0; round < 50; ++round) {
    std::vector<ClassicBeam> beams;
    for (int lane = 0; lane < lanes; ++lane) beams.push_back(beam_of(numbers));
    const ClassicBeamLanes together({&beams[0], &beams[1], &beams[2], &beams[3]});
    const Vector at = (round < 25 ? 0.3 : 20.0) * numbers.vector(6 * lanes);  // several turns, too
    Lanes u[6], f[6], K[36], forces_alone[6];
    for (int lane = 0; lane < lanes; ++lane)
      for (int i = 0; i < 6; ++i) u[i].set(lane, at[6 * lane + i]);
    together.evaluate(u, f, K);
    together.evaluate(u, forces_alone, nullptr);
    for (int lane = 0; lane < lanes; ++lane) {
      double force[6], stiffness[36];
      beams[static_cast<std::size_t>(lane)].evaluate(at.data() + 6 * lane, force, stiffness);
      for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(f[i][lane], force[i]);
        EXPECT_EQ(forces_alone[i][lane], force[i]);
        for (int j = i; j < 6; ++j) EXPECT_EQ(K[j + 6 * i][lane], stiffness[j + 6 * i]);
      }
    }
  }
}

TEST(ElementOrder, BeamsStandInFoursAndTheRestAlone) {
  const ElementOrder order = Row(23).order();
  EXPECT_EQ(order.fours.size(), 4u);   // of 19 beams
  EXPECT_EQ(order.others.size(), 7u);  // 3 beams, 4 bars
  std::vector<Index> all = order.others, expected(23);
  for (const ElementOrder::Four& four : order.fours) all.insert(all.end(), four.elements.begin(), four.elements.end());
  std::iota(expected.begin(), expected.end(), Index{0});
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, expected);
}

}  // namespace arcwall::element_order_test
