#include "apps/sweep/load_map.hpp"

#include <gtest/gtest.h>

#include "apps/sweep/case_result.hpp"
#include "apps/sweep/map_axis.hpp"

namespace arcwall::sweep::load_map_test {
namespace {

std::size_t count(const std::string& part, const std::string& text) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(MapAxis, NumbersKeepTheirDistances) {
  const MapAxis axis({4, 1.0, 2}, AxisScale::by_extent);
  EXPECT_NEAR(axis.place(4) - axis.place(2), 2.0 * (axis.place(2) - axis.place(1)), 1e-12);
  EXPECT_EQ(axis.ticks().size(), 3u);
}

// As loads of cases that differ in the step alone: one value, with room around it.
TEST(MapAxis, NumbersThatAreTheSameToRoundOffAreOne) {
  const MapAxis axis({37.9198012951, 37.91980129510001}, AxisScale::linear);
  EXPECT_NEAR(axis.place(37.9198012951), 0.5, 1e-9);
  EXPECT_GE(axis.ticks().size(), 4u);
}

TEST(MapAxis, ADecadeOfPositiveNumbersIsLogarithmic) {
  const MapAxis axis({0.1, 1, 10}, AxisScale::by_extent);
  EXPECT_NEAR(axis.place(10) - axis.place(1), axis.place(1) - axis.place(0.1), 1e-12);
  const MapAxis linear({0.1, 1, 10}, AxisScale::linear);
  EXPECT_NEAR(linear.place(10) - linear.place(1), 10.0 * (linear.place(1) - linear.place(0.1)), 1e-12);
}

TEST(MapAxis, TextsStandOneBesideTheOther) {
  const MapAxis axis({"classic", 3, "exact"}, AxisScale::by_extent);
  EXPECT_NEAR(axis.place("classic"), 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(axis.place("exact"), 5.0 / 6.0, 1e-12);
  EXPECT_EQ(axis.ticks()[0].text, "classic");
}

TEST(MapAxis, ManyValuesHaveRoundTicks) {
  std::vector<Json> values;
  for (int i = 0; i <= 100; ++i) values.emplace_back(0.137 + 0.01 * i);
  std::vector<std::string> texts;
  for (const Tick& tick : MapAxis(values, AxisScale::linear).ticks()) texts.push_back(tick.text);
  EXPECT_EQ(texts, (std::vector<std::string>{"0.2", "0.4", "0.6", "0.8", "1"}));
}

LoadMap map_of(int nx, int ny) {
  LoadMap map{.titles = {.x = "x", .y = "y", .load = "load"}};
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) map.points.push_back({.number = i * ny + j, .x = i, .y = j, .load = i + j});
  return map;
}

TEST(LoadMap, AFullGridHasCellsAndAnythingElsePoints) {
  LoadMap map = map_of(3, 4);
  EXPECT_EQ(count("<title>case", svg(map)), 12u);
  EXPECT_EQ(count("<circle", svg(map)), 0u);
  map.points.pop_back();
  EXPECT_EQ(count("<circle", svg(map)), 11u);
}

TEST(LoadMap, OneKeyHasTheLoadsOverIt) {
  LoadMap map = map_of(5, 1);
  map.titles.y.clear();
  map.points.back().load.reset();
  EXPECT_EQ(count("<circle", svg(map)), 5u);
  EXPECT_EQ(count("no such event", svg(map)), 1u);
}

TEST(LoadMap, FailedCasesAreCrossed) {
  LoadMap map = map_of(2, 2);
  EXPECT_EQ(count("#d33", svg(map)), 0u);
  map.points[1].failed = true;
  EXPECT_EQ(count("#d33", svg(map)), 1u);
}

TEST(LoadMap, NoTextOfTheSweepIsMarkup) {
  LoadMap map = map_of(2, 2);
  map.titles.x = "</title><script>alert('&')</script>";
  map.points[0].x = "<b>";
  EXPECT_EQ(count("<script", svg(map)), 0u);
  EXPECT_EQ(count("<b>", svg(map)), 0u);
}

TEST(LoadMap, EqualLoadsAreDrawn) {
  LoadMap map = map_of(2, 2);
  for (MapPoint& point : map.points) point.load = 1.5;
  EXPECT_EQ(count("nan", svg(map)), 0u);
  EXPECT_EQ(count("inf", svg(map)), 0u);
}

TEST(LoadMap, SaysWhatItsLoadsAreTimes) {
  LoadMap map{.titles = {.x = "k", .load = "λ of the snap", .unit = "2 kN"}};
  map.points.push_back({.x = 1.0, .load = 3.0});
  map.points.push_back({.number = 1, .x = 2.0, .load = 4.0});
  EXPECT_EQ(count("λ of the snap, times 2 kN</text>", svg(map)), 1u);  // the axis
  map.titles.y = "l";
  for (MapPoint& point : map.points) point.y = 1.0;
  EXPECT_EQ(count("λ of the snap, times 2 kN</text>", svg(map)), 1u);  // the bar of colours
}

// A case that ended early has told its snap, if it had one; a limit on points may have cut it off before another.
TEST(CaseResult, AnEarlyEndBehindTheSnapIsNoFailure) {
  const Json snap{{"kind", "limit-point"}, {"lambda", 2.0}, {"unstable_before", 0}, {"unstable_after", 1}};
  const Json touch{{"kind", "contact-closes"}, {"lambda", 1.0}, {"unstable_before", 0}, {"unstable_after", 0}};
  EXPECT_FALSE((CaseResult{.there = true, .status = 3, .events = {touch, snap}}.failed()));
  EXPECT_TRUE((CaseResult{.there = true, .status = 3, .events = {touch}}.failed()));
  EXPECT_TRUE((CaseResult{.there = true, .status = 6, .events = {touch, snap}}.failed()));
  EXPECT_TRUE((CaseResult{.there = true, .events = {touch, snap}}.failed()));
  EXPECT_FALSE((CaseResult{.there = true, .status = 0}.failed()));
}

}  // namespace
}  // namespace arcwall::sweep::load_map_test
