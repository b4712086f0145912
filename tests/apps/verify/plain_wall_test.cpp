#include "apps/verify/plain_wall.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "model/build_contact.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/traced_deck.hpp"

namespace arcwall::verify::plain_wall_test {

// Formulas of its own: the same gaps as tracing has.
TEST(PlainWall, HasTheGapsOfTheWallsThatAreTraced) {
  const std::vector<decltype(deck::Wall::profile)> profiles{
      deck::FlatProfile{0.3},
      deck::LineProfile{0.1, -0.4},
      deck::CircleProfile{{0.2, 1.0}, 3.0},
      deck::ParabolaProfile{{-0.1, 0.5}, 0.7},
      deck::SplineProfile{{-2.0, 2.0}, {0.1, 0.4}},
      deck::SplineProfile{{-2.0, 0.3, 2.0}, {0.1, 0.7, 0.4}},
      deck::SplineProfile{{-2.0, -0.9, 0.1, 0.5, 2.0}, {0.1, 0.6, 0.2, 0.9, 0.4}}};
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> x(-1.9, 1.9), z(-1.0, 1.0);
  for (const auto& profile : profiles)
    for (const Side side : {Side::above, Side::below}) {
      const deck::WallMotion motion{.x = 0.3, .z = -0.2, .rotation = 0.4, .about = {.x = 0.1, .z = 0.5}};
      const deck::Wall wall{.name = "wall", .side = side, .profile = profile, .motion = motion};
      const PlainWall at_rest(wall);
      const auto traced = obstacle_of(wall);
      for (const double lambda : {0.0, 0.3})
        for (int i = 0; i < 50; ++i) {
          const PlainWall plain = at_rest.at(lambda);
          const Vec2 at = motion_of(wall).moved({x(generator), z(generator)}, lambda);
          EXPECT_NEAR(plain.gap(at), traced->gap(at, lambda).value, 1e-13);
          EXPECT_NEAR(plain.slope_angle(at), traced->direction(at, lambda).value, 1e-13);
          EXPECT_NEAR(plain.curvature(at), traced->curvature(at, lambda).value, 1e-11);
        }
    }
}

// Where the cubics of a spline meet, to both sides of each knot, and beyond what is rounded there.
TEST(PlainWall, RoundsKnotsAsTheWallsThatAreTracedAre) {
  const std::vector<double> x{-2.0, -0.9, 0.1, 0.5, 2.0};
  const deck::Wall wall{
      .name = "wall", .side = Side::below, .profile = deck::SplineProfile{x, {0.1, 0.6, 0.2, 0.9, 0.4}}};
  const PlainWall plain(wall);
  const auto traced = obstacle_of(wall);
  for (std::size_t knot = 1; knot + 1 < x.size(); ++knot)
    for (const double off : {-1e-3, -3.9e-6, -2e-6, 0.0, 1.5e-6, 3.8e-6, 1e-3}) {
      const Vec2 at(x[knot] + off, 0.7);
      EXPECT_NEAR(plain.gap(at), traced->gap(at, 0.0).value, 1e-13);
      EXPECT_NEAR(plain.slope_angle(at), traced->direction(at, 0.0).value, 1e-13);
      EXPECT_NEAR(plain.curvature(at), traced->curvature(at, 0.0).value, 1e-11);
    }
}

// Outlines of all types, touched by axes.
TEST(PlainWall, HasTheGapsOfTheOutlinesThatAreTraced) {
  const std::vector<double> x{-1.5, 0.1, 1.4, 0.3, -0.9}, z{-1.0, -0.4, -1.2, 1.1, 0.8};
  const auto points = []<class Outline>(Outline of, std::vector<double> x_of, std::vector<double> z_of, bool closed,
                                        Keep keep) {
    of.x = std::move(x_of);
    of.z = std::move(z_of);
    of.closed = closed;
    of.keep = keep;
    return deck::Outline(of);
  };
  std::vector<std::pair<deck::Outline, std::vector<double>>> outlines{
      {deck::HalfPlaneOutline{{0.1, -0.2}, {-0.3, 0.8}}, {0.0}},
      {points(deck::PolylineOutline{}, {-1.5, 0.1, 1.4}, {-0.6, 0.2, -0.5}, false, Keep::outside), {0.0}},
      {points(deck::PolylineOutline{}, x, z, false, Keep::outside), {0.1}},
      {points(deck::CurveOutline{}, x, z, false, Keep::outside), {0.0}},
      {points(deck::CurveOutline{}, {-1.5, 1.4}, {-0.6, 0.2}, false, Keep::outside), {0.0}}};
  for (const Keep keep : {Keep::outside, Keep::inside}) {
    outlines.push_back({deck::CircleOutline{{0.1, 0.2}, 0.9, keep}, {0.0}});
    outlines.push_back({deck::EllipseOutline{{0.1, 0.2}, {0.5, 1.1}, 0.4, keep}, {0.0}});
    outlines.push_back({points(deck::PolylineOutline{}, x, z, true, keep), {0.15}});
    outlines.push_back({points(deck::CurveOutline{}, x, z, true, keep), {0.0}});
  }
  for (const Keep keep : {Keep::outside, Keep::inside})
    outlines.push_back({points(deck::PolylineOutline{}, x, z, true, keep), {0.08, 0.15, 0.05, 0.2, 0.1}});
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> anywhere(-2.0, 2.0);
  for (const auto& [outline, radii] : outlines) {
    const deck::WallMotion motion{.x = 0.3, .z = -0.2, .rotation = 0.4, .about = {.x = 0.1, .z = 0.5}};
    const bool is_list = radii.size() > 1;
    const deck::Wall wall{.name = "wall",
                          .outline = outline,
                          .corner_radius = is_list ? 0.0 : radii.front(),
                          .corner_radii = is_list ? radii : std::vector<double>{},
                          .motion = motion};
    const PlainWall at_rest(wall);
    const auto traced = obstacle_of(wall);
    for (const double lambda : {0.0, 0.3})
      for (int i = 0; i < 100; ++i) {
        const PlainWall plain = at_rest.at(lambda);
        const Vec2 at = motion_of(wall).moved({anywhere(generator), anywhere(generator)}, lambda);
        ASSERT_EQ(plain.faces(at), traced->faces(at, lambda));
        if (!plain.faces(at)) continue;
        const double gap = plain.gap(at);
        EXPECT_NEAR(gap, traced->gap(at, lambda).value, 1e-12);
        EXPECT_NEAR(std::remainder(plain.slope_angle(at) - traced->direction(at, lambda).value, 2.0 * pi), 0.0, 1e-10);
        if (!std::isfinite(plain.curvature(at))) continue;
        EXPECT_NEAR(plain.curvature(at), traced->curvature(at, lambda).value,
                    1e-8 * std::max(1.0, std::abs(plain.curvature(at))));
      }
  }
}

// --- falsified runs -------------------------------------------------------------------------------------------------

}  // namespace arcwall::verify::plain_wall_test
