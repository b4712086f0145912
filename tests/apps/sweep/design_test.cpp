#include "apps/sweep/design.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace arcwall::sweep::design_test {
namespace {

TEST(Design, ARangeHasItsEndsAndTheDecimalsOnePutsDown) {
  const Range range{.from = 0.1, .to = 0.7};
  EXPECT_EQ(values(range, 7), (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}));
  EXPECT_EQ(values({.from = -0.3, .to = 0.3}, 7)[3], 0.0);
}

TEST(Design, ALogarithmicRangeHasEqualRatios) {
  EXPECT_EQ(values({.from = 1e-4, .to = 1e-1, .spacing = Spacing::log}, 4),
            (std::vector<double>{1e-4, 1e-3, 1e-2, 1e-1}));
  EXPECT_EQ(values({.from = -100.0, .to = -1.0, .spacing = Spacing::log}, 3),
            (std::vector<double>{-100.0, -10.0, -1.0}));
}

TEST(Design, WholeNumbersAreIntegers) {
  EXPECT_EQ(number(40.0).dump(), "40");
  EXPECT_EQ(number(100000.0).dump(), "100000");
  EXPECT_EQ(number(0.5).dump(), "0.5");
  EXPECT_TRUE(number(1e300).is_number_float());
}

TEST(Design, AGridHasEveryCombinationTheLastKeyFastest) {
  const auto rows = grid({{1, 2}, {"a"}, {true, false, 7}});
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0], (std::vector<Json>{1, "a", true}));
  EXPECT_EQ(rows[1], (std::vector<Json>{1, "a", false}));
  EXPECT_EQ(rows[5], (std::vector<Json>{2, "a", 7}));
}

// A sample in every part of every range, wherever the parts are.
TEST(Design, ALatinHypercubeHasOneSampleInEachPart) {
  const std::vector<Range> ranges{
      {.from = 0.1, .to = 0.9}, {.from = 5.0, .to = -3.0}, {.from = 1e-6, .to = 1e2, .spacing = Spacing::log}};
  for (const int samples : {2, 7, 100}) {
    const auto rows = latin_hypercube(ranges, samples, 42);
    ASSERT_EQ(rows.size(), static_cast<std::size_t>(samples));
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      const Range& range = ranges[k];
      std::set<int> parts;
      for (const auto& row : rows) {
        const double value = row[k].get<double>();
        const double fraction = range.spacing == Spacing::log
                                    ? std::log(value / range.from) / std::log(range.to / range.from)
                                    : (value - range.from) / (range.to - range.from);
        parts.insert(static_cast<int>(std::floor(fraction * samples)));
      }
      EXPECT_EQ(parts.size(), rows.size());
      EXPECT_EQ(*parts.begin(), 0);
      EXPECT_EQ(*parts.rbegin(), samples - 1);
    }
  }
}

TEST(Design, TheSeedDecidesASample) {
  const std::vector<Range> ranges{{.from = 0.0, .to = 1.0}, {.from = 2.0, .to = 3.0}};
  EXPECT_EQ(latin_hypercube(ranges, 50, 1), latin_hypercube(ranges, 50, 1));
  EXPECT_NE(latin_hypercube(ranges, 50, 1), latin_hypercube(ranges, 50, 2));
}

TEST(Design, AFurtherRangeLeavesTheFirstAlone) {
  const Range first{.from = 0.0, .to = 1.0}, second{.from = 2.0, .to = 3.0};
  const auto alone = latin_hypercube({first}, 20, 5), both = latin_hypercube({first, second}, 20, 5);
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(alone[i][0], both[i][0]);
}

// From an implementation in Python of Matsumoto and Nishimura's generator (its 10000th number of the default seed is
// that of the C++ standard) and of the mapping as design.hpp describes it.
TEST(Design, ASampleIsTheSameOnEveryMachine) {
  const auto rows = latin_hypercube({{.from = 0.0, .to = 4.0}}, 4, 0);
  std::vector<double> found;
  for (const auto& row : rows) found.push_back(row[0].get<double>());
  EXPECT_EQ(found, (std::vector<double>{0.597494662695, 1.54228496999, 3.05715979147, 2.63152837451}));
}

}  // namespace
}  // namespace arcwall::sweep::design_test
