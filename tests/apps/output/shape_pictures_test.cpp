#include "apps/output/shape_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/deck/reader.hpp"

namespace arcwall::shape_pictures_test {
namespace {

MemberShape line_of(const std::vector<Vec2>& positions) {
  MemberShape member{.member = "beam"};
  for (std::size_t i = 0; i < positions.size(); ++i)
    member.points.push_back({.fraction = double(i) / double(positions.size() - 1), .position = positions[i]});
  return member;
}

Scene scene_of_line(const std::vector<Vec2>& positions) { return {.shape = {.members = {line_of(positions)}}}; }

std::string path(const ShapePictures& pictures, std::size_t picture, const std::string& css_class) {
  for (std::size_t i = 0; i < pictures.classes.size(); ++i)
    if (pictures.classes[i] == css_class) return pictures.pictures[picture].paths[i];
  return "no such path";
}

// Two units by one: the longer side has 84 % of 10⁵ units between margins of 8 %, and z points up.
TEST(ShapePictures, CoordinatesAreWholePartsOfTheLongerSide) {
  const auto pictures = draw({{7}, {scene_of_line({{1.0, 1.0}, {2.0, 2.0}, {3.0, 1.0}})}}, {});

  EXPECT_EQ(pictures.width, 100'000.0);
  EXPECT_EQ(pictures.height, 58'000.0);
  EXPECT_EQ(pictures.stretch, 1.0);
  EXPECT_EQ(path(pictures, 0, "member"), "M8000 50000l42000-42000 42000 42000");
  EXPECT_EQ(pictures.pictures[0].point, 7u);
}

TEST(ShapePictures, AllPicturesHaveOneScale) {
  const auto pictures =
      draw({{0, 1}, {scene_of_line({{0.0, 0.0}, {1.0, 0.0}}), scene_of_line({{0.0, 0.0}, {0.0, 1.0}})}}, {});
  EXPECT_EQ(path(pictures, 0, "member"), "M8000 92000l84000 0");
  EXPECT_EQ(path(pictures, 1, "member"), "M8000 92000l0-84000");
}

TEST(ShapePictures, FlatOnesAreStretchedAndSaySo) {
  const auto pictures = draw({{0}, {scene_of_line({{0.0, 0.0}, {10.0, 0.2}})}}, {});
  EXPECT_EQ(pictures.stretch, 10.0);
  EXPECT_EQ(path(pictures, 0, "member"), "M8000 24800l84000-16800");
}

Scene moved_line(double down) {
  Scene scene = scene_of_line({{0.0, 1.0 - down}, {1.0, 1.0 - down}, {1.0, 0.0}});
  for (ShapePoint& point : scene.shape.members.front().points) point.displacement = {0.0, -down};
  scene.shape.members.front().points.back().displacement = Vec2::Zero();
  return scene;
}

// Whoever draws them larger needs their digits, which whole numbers of places have lost. In a unit of a 2000th of the
// greatest: z points up, and so down by the way.
TEST(ShapePictures, SmallDeflectionsAreKeptInAUnitOfTheirOwn) {
  const auto pictures = draw({{0, 1}, {moved_line(0.5e-6), moved_line(1e-6)}}, {});
  EXPECT_NEAR(pictures.greatest_move, 1e-6 * 84'000.0, 1e-6);
  EXPECT_NEAR(pictures.move_unit, pictures.greatest_move / 2000.0, 1e-12);
  EXPECT_EQ(pictures.pictures[0].moves, std::vector<std::string>{"M0 1000l0 0 0-1000"});
  EXPECT_EQ(pictures.pictures[1].moves, std::vector<std::string>{"M0 2000l0 0 0-2000"});
}

// Such fill the picture as they are, or are round-off.
TEST(ShapePictures, OtherDeflectionsHaveNoOtherScale) {
  for (const double down : {0.5, 1e-12, 0.0}) {
    const auto pictures = draw({{0}, {moved_line(down)}}, {});
    EXPECT_EQ(pictures.move_unit, 0.0) << down;
    EXPECT_TRUE(pictures.pictures[0].moves.empty()) << down;
  }
}

// A force of a wall stands on it; the greatest of all pictures has the longest arrow, 14 % of the longer side.
TEST(ShapePictures, ArrowsOfWallsAreToOneScale) {
  Scene weak = scene_of_line({{0.0, 0.0}, {1.0, 1.0}}), strong = weak;
  weak.shape.contacts = {{.position = {0.0, 0.0}, .force = {0.0, 1.0}}};
  strong.shape.contacts = {{.position = {0.0, 0.0}, .force = {0.0, 4.0}}};

  const auto pictures = draw({{0, 1}, {weak, strong}}, {});

  EXPECT_EQ(pictures.greatest_force, 4.0);
  EXPECT_EQ(path(pictures, 0, "touches"), "M8000 92000h0");
  EXPECT_NE(path(pictures, 0, "forces").find("L8000 88500L"), std::string::npos) << path(pictures, 0, "forces");
  EXPECT_NE(path(pictures, 1, "forces").find("L8000 78000L"), std::string::npos) << path(pictures, 1, "forces");
}

TEST(ShapePictures, WallsFarAwayDoNotShrinkThePicture) {
  const auto wall = [](double z) {
    return WallShape{.side = Side::below, .line = {{-9.0, z}, {9.0, z}}, .whole = {{-9.0, z}, {9.0, z}}};
  };
  const std::vector<Scene> scenes{scene_of_line({{0.0, 0.0}, {1.0, 1.0}})};
  EXPECT_EQ(draw({{0}, scenes}, {.walls = {wall(-0.2)}}).height, 100'000.0);
  EXPECT_LT(draw({{0}, scenes}, {.walls = {wall(-0.2)}}).width, 90'000.0);
  EXPECT_EQ(draw({{0}, scenes}, {.walls = {wall(-100.0)}}).width, 100'000.0);
  EXPECT_EQ(draw({{0}, scenes}, {.walls = {wall(-100.0)}}).surfaces.size(), 1u);
}

TEST(ShapePictures, ThickMembersHaveTheirHeight) {
  const std::vector<Scene> scenes{scene_of_line({{0.0, 0.0}, {1.0, 1.0}})};
  // 1 + 0.25 by as much on 84 000 units
  EXPECT_EQ(draw({{0}, scenes}, {.heights = {0.25}}).thickness.front(), 16'800.0);
  EXPECT_EQ(draw({{0}, scenes}, {.heights = {0.001}}).thickness.front(), 0.0);
}

TEST(ShapePictures, WhatIsNotFiniteOrEmptyIsNotDrawn) {
  EXPECT_TRUE(draw({}, {}).pictures.empty());
  EXPECT_EQ(path(draw({{0}, {scene_of_line({{infinity, 0.0}, {0.0, std::nan("")}})}}, {}), 0, "member"), "");
  EXPECT_EQ(path(draw({{0}, {scene_of_line({{1.0, 1.0}, {1.0, 1.0}})}}, {}), 0, "member"), "M8000 8000l0 0");
}

Record long_record(Index points) {
  Record record;
  record.branches = {{.id = 0, .points = points}, {.id = 1, .points = 3}};
  record.points.resize(static_cast<std::size_t>(points) + 3);
  return record;
}

// 200 points, of which a diagram has some 40: the one with the largest moment, between those, is among them.
TEST(ShapePictures, DiagramsKeepTheExtremesOfForces) {
  std::vector<Vec2> line;
  for (int i = 0; i <= 200; ++i) line.emplace_back(double(i), 0.0);
  Scene scene = scene_of_line(line);
  scene.shape.members.front().points[101].moment = -3.0;
  const auto pictures = draw({{0}, {scene}}, {});
  const auto& samples = pictures.pictures[0].forces.at(0);
  EXPECT_LT(samples.size(), 90U);
  EXPECT_TRUE(std::any_of(samples.begin(), samples.end(), [](const auto& one) { return one.moment == -3.0; }));
}

TEST(PointsToDraw, AreAllOfAFewPoints) { EXPECT_EQ(points_to_draw(long_record(7), 10).size(), 10u); }

TEST(PointsToDraw, KeepEndsAndEvents) {
  Record record = long_record(997);
  record.events.push_back({.step = 501});

  const auto points = points_to_draw(record, 100);

  const auto drawn = [&](std::size_t point) { return std::find(points.begin(), points.end(), point) != points.end(); };
  EXPECT_TRUE(drawn(0) && drawn(501) && drawn(996) && drawn(997) && drawn(999));
  EXPECT_LE(points.size(), 105u);
  EXPECT_GE(points.size(), 90u);
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end()));
}

TEST(PointsToDraw, AreFewThoughEveryPointHasAnEvent) {
  Record record = long_record(997);
  for (Index i = 0; i < 997; ++i) record.events.push_back({.step = i});
  EXPECT_LE(points_to_draw(record, 100).size(), 105u);
}

// A portal that is loaded in all ways: what acts from outside stands where the deck has it.
TEST(SceneOf, LoadsAndSupportsAreWhereTheDeckHasThem) {
  const Model model(deck::read_deck_text(R"(
title = "A portal"
material.steel = { E = 2.1e4 }
section.bar = { shape = "rectangle", width = 0.5, height = 0.25 }
point = { left = [0.0, 0.0], top = [2.0, 1.0], right = [4.0, 0.0] }
support = { left = ["x", "z", "rotation"], right = ["z"] }
[member]
west = { from = "left", to = "top", theory = "euler-bernoulli", material = "steel", section = "bar", elements = 4 }
east = { from = "top", to = "right", theory = "euler-bernoulli", material = "steel", section = "bar", elements = 4 }
[[load]]
at = "top"
force = [1.0, -2.0]
moment = 3.0
[[load]]
at = "east:0.5"
force = [0.0, -1.0]
constant = true
[[load]]
on = "west"
distributed = [0.0, -0.5]
[[monitor]]
name = "w"
at = "top"
component = "z"
[path.stop]
lambda = [-1.0, 1.0]
)",
                                         "portal.toml"));
  State state{.x = Vector::Zero(model.structure().size({})), .lambda = 2.0};

  const Scene scene = scene_of(model, state);

  ASSERT_EQ(scene.loads.size(), 11u);
  EXPECT_TRUE(scene.loads[0].at.isApprox(Vec2(2.0, 1.0)));
  EXPECT_TRUE(scene.loads[0].force.isApprox(Vec2(2.0, -4.0)));
  EXPECT_EQ(scene.loads[0].moment, 6.0);
  EXPECT_TRUE(scene.loads[1].at.isApprox(Vec2(3.0, 0.5)));
  EXPECT_TRUE(scene.loads[1].force.isApprox(Vec2(0.0, -1.0)));
  EXPECT_TRUE(scene.loads[6].at.isApprox(Vec2(1.0, 0.5)));
  EXPECT_TRUE(scene.loads[6].force.isApprox(Vec2(0.0, -1.0)));
  ASSERT_EQ(scene.supports.size(), 2u);
  EXPECT_TRUE(scene.supports[0].x && scene.supports[0].z && scene.supports[0].rotation);
  EXPECT_TRUE(scene.supports[1].at.isApprox(Vec2(4.0, 0.0)));
  EXPECT_FALSE(scene.supports[1].x || scene.supports[1].rotation);
}

}  // namespace
}  // namespace arcwall::shape_pictures_test
