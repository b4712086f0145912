#include "apps/output/wall_pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

namespace arcwall::wall_pictures_test {
namespace {

const Vec2 size(100'000.0, 60'000.0);

// The polygons of `M10 20l5-3 4 4z`.
std::vector<std::vector<Vec2>> polygons(const std::string& data) {
  std::vector<std::vector<Vec2>> all;
  std::string text;
  for (const char c : data) text += c == '-' ? std::string(" -") : std::string(1, c);
  std::istringstream stream(text);
  Vec2 here = Vec2::Zero();
  for (char c = 0; stream >> c;) {
    if (c == 'M') {
      all.emplace_back();
      here = Vec2::Zero();
    }
    if (c == 'z' || c == 'M' || c == 'l') {
      if (c == 'z') continue;
    } else {
      stream.unget();
    }
    double x = 0.0, y = 0.0;
    stream >> x >> y;
    here += Vec2(x, y);
    all.back().push_back(here);
  }
  return all;
}

// By the rule `nonzero`.
bool is_filled(const std::string& data, const Vec2& at) {
  int winding = 0;
  for (const auto& polygon : polygons(data))
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.y() <= at.y()) == (b.y() <= at.y())) continue;
      const double x = a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (x > at.x()) winding += b.y() > a.y() ? 1 : -1;
    }
  return winding != 0;
}

std::vector<Vec2> circle(double radius, double sense) {
  std::vector<Vec2> points;
  for (int i = 0; i < 72; ++i) {
    const double angle = sense * i * std::numbers::pi / 36.0;
    points.emplace_back(50'000.0 + radius * std::cos(angle), 30'000.0 + radius * std::sin(angle));
  }
  return points;
}

std::string body(const PlacedWall& wall) { return wall_pictures({wall}, size).front().body; }

// With y down an increasing angle runs clockwise, which has the inside on the right.
TEST(WallPictures, APegIsADiscAndABoreIsAHole) {
  const std::string peg = body({.line = circle(10'000.0, 1.0), .closed = true});
  EXPECT_TRUE(is_filled(peg, {50'000.0, 30'000.0}));
  EXPECT_TRUE(is_filled(peg, {59'000.0, 30'000.0}));
  EXPECT_FALSE(is_filled(peg, {61'000.0, 30'000.0}));

  const std::string bore = body({.line = circle(10'000.0, -1.0), .closed = true});
  EXPECT_FALSE(is_filled(bore, {50'000.0, 30'000.0}));
  EXPECT_FALSE(is_filled(bore, {59'000.0, 30'000.0}));
  EXPECT_TRUE(is_filled(bore, {61'000.0, 30'000.0}));
  EXPECT_TRUE(is_filled(bore, {99'000.0, 1'000.0}));
}

TEST(WallPictures, ABoreLargerThanThePictureLeavesItFree) {
  const std::string bore = body({.line = circle(200'000.0, -1.0), .closed = true});
  for (const Vec2& at : {Vec2(1'000.0, 1'000.0), Vec2(50'000.0, 30'000.0), Vec2(99'000.0, 59'000.0)})
    EXPECT_FALSE(is_filled(bore, at));
  const std::string peg = body({.line = circle(200'000.0, 1.0), .closed = true});
  EXPECT_TRUE(is_filled(peg, {50'000.0, 30'000.0}));
}

TEST(WallPictures, AProfileIsSolidToTheBorder) {
  const PlacedWall floor{
      .line = {{-900'000.0, 40'000.0}, {30'000.0, 40'000.0}, {50'000.0, 20'000.0}, {900'000.0, 40'000.0}},
      .behind = Vec2(0.0, 1.0)};
  const std::string data = body(floor);
  EXPECT_TRUE(is_filled(data, {50'000.0, 21'000.0}));
  EXPECT_TRUE(is_filled(data, {50'000.0, 59'999.0}));
  EXPECT_TRUE(is_filled(data, {1.0, 59'999.0}));
  EXPECT_FALSE(is_filled(data, {50'000.0, 19'000.0}));
  EXPECT_FALSE(is_filled(data, {1.0, 39'000.0}));
  for (const auto& polygon : polygons(data))
    for (const Vec2& point : polygon) EXPECT_LE(point.cwiseAbs().maxCoeff(), 106'000.0);
}

// To the right of a line that goes down (y) is the left of the picture.
TEST(WallPictures, AnOpenOutlineIsABandOnItsRight) {
  const std::string data = body({.line = {{50'000.0, 10'000.0}, {50'000.0, 50'000.0}}});
  EXPECT_TRUE(is_filled(data, {49'000.0, 30'000.0}));
  EXPECT_FALSE(is_filled(data, {51'000.0, 30'000.0}));
  EXPECT_FALSE(is_filled(data, {45'000.0, 30'000.0}));
  EXPECT_FALSE(is_filled(data, {49'000.0, 9'000.0}));
}

// A wedge whose arms are nearer to each other than the band is thick: all of it is solid, nothing beside it.
TEST(WallPictures, AThinSolidIsFilledBetweenItsSides) {
  const std::string solid = body({.line = {{20'000.0, 29'000.0}, {80'000.0, 30'000.0}, {20'000.0, 31'000.0}}});
  for (double x = 22'000.0; x < 60'000.0; x += 1'300.0) {
    const double half = (80'000.0 - x) / 60'000.0 * 1'000.0;
    for (const double part : {-0.9, -0.4, 0.4, 0.9}) EXPECT_TRUE(is_filled(solid, {x, 30'000.0 + part * half})) << x;
    for (const double part : {-1.3, 1.3}) EXPECT_FALSE(is_filled(solid, {x, 30'000.0 + part * half})) << x;
  }
}

// Two walls back to back, 1 000 units apart: neither reaches over the other.
TEST(WallPictures, BandsOfTwoWallsDoNotReachOverEachOther) {
  const PlacedWall left{.line = {{50'000.0, 50'000.0}, {50'000.0, 10'000.0}}},
      right{.line = {{51'000.0, 10'000.0}, {51'000.0, 50'000.0}}};
  const auto pictures = wall_pictures({left, right}, size);
  for (const WallPicture& picture : pictures) {
    EXPECT_FALSE(is_filled(picture.body, {49'800.0, 30'000.0}));
    EXPECT_FALSE(is_filled(picture.body, {51'200.0, 30'000.0}));
  }
  EXPECT_TRUE(is_filled(pictures[0].body, {50'300.0, 30'000.0}));
  EXPECT_TRUE(is_filled(pictures[1].body, {50'700.0, 30'000.0}));
}

TEST(WallPictures, WhatIsOutOfThePictureIsNotDrawn) {
  const auto pictures = wall_pictures({{.line = {{500'000.0, 0.0}, {600'000.0, 10'000.0}}}}, size);
  EXPECT_EQ(pictures.front().surface, "");
  EXPECT_EQ(pictures.front().body, "");
  EXPECT_EQ(wall_pictures({{.line = {{1.0, 1.0}}}}, size).front().body, "");
}

}  // namespace
}  // namespace arcwall::wall_pictures_test
