#include "apps/sweep/contour.hpp"

#include <gtest/gtest.h>

namespace arcwall::sweep::contour_test {
namespace {

template <class Function>
GridValues grid_of(Function value) {
  GridValues grid{.x = {0.0, 0.5, 1.5, 2.0}, .y = {-1.0, 0.0, 0.25}};
  for (const double x : grid.x)
    for (const double y : grid.y) grid.values.emplace_back(value(x, y));
  return grid;
}

// Of a plane the parts lie on one straight line, and together are as long as it is inside the grid.
TEST(Contour, OfAPlaneIsAStraightLine) {
  const auto plane = [](double x, double y) { return 2.0 * x - y; };
  double length = 0.0;
  for (const ContourPart& part : contour(grid_of(plane), 2.0)) {
    EXPECT_NEAR(plane(part.from.x(), part.from.y()), 2.0, 1e-14);
    EXPECT_NEAR(plane(part.to.x(), part.to.y()), 2.0, 1e-14);
    length += (part.to - part.from).norm();
  }
  EXPECT_NEAR(length, std::hypot(0.625, 1.25), 1e-14);  // from y = −1, x = 0.5 to y = 0.25, x = 1.125
}

TEST(Contour, StopsAtCellsWithoutAValue) {
  GridValues grid = grid_of([](double x, double y) { return 2.0 * x - y; });
  const std::size_t all = contour(grid, 2.0).size();
  grid.values[4].reset();  // (0.5, 0)
  EXPECT_LT(contour(grid, 2.0).size(), all);
  EXPECT_TRUE(contour(grid, 100.0).empty());
}

// A saddle: where all four sides are crossed the middle tells which of them belong together.
TEST(Contour, GoesThroughASaddleOnTheSideOfItsMiddle) {
  const auto saddle = [](double a, double b) {
    return GridValues{.x = {0.0, 1.0}, .y = {0.0, 1.0}, .values = {a, b, b, a}};
  };
  for (const double low : {0.0, 0.4}) {  // the mean is 0.5 or 0.7, below or above the level
    const auto parts = contour(saddle(1.0, low), 0.6);
    ASSERT_EQ(parts.size(), 2u);
    const bool corners_of_1_are_cut_off = low == 0.0;
    for (const ContourPart& part : parts) {
      const Vec2 middle = 0.5 * (part.from + part.to);
      EXPECT_EQ((middle.x() < 0.5) == (middle.y() < 0.5), corners_of_1_are_cut_off) << low;
    }
  }
}

}  // namespace
}  // namespace arcwall::sweep::contour_test
