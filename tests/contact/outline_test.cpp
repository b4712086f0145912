#include "contact/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "contact/passing.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::outline_test {

namespace {

struct Closed {
  std::string name;
  std::shared_ptr<const Outline> outline;
};

// Closed outlines that turn sharply and hardly at all.
std::vector<Closed> closed_outlines() {
  std::vector<Closed> all;
  for (const Keep keep : {Keep::outside, Keep::inside}) {
    const std::string side = keep == Keep::inside ? " from inside" : "";
    const auto add = [&](const std::string& name, std::unique_ptr<Outline> outline) {
      all.push_back({name + side, std::move(outline)});
    };
    add("circle", circle_outline({0.3, -0.2}, 1.1, keep));
    add("ellipse", ellipse_outline({0.1, 0.2}, {2.0, 1.0}, 0.5, keep));
    add("needle", ellipse_outline({0.1, 0.2}, {1.0, 0.01}, 0.3, keep));
    add("curve", closed_curve_outline({{0.0, 0.0}, {1.0, 0.2}, {1.3, 1.0}, {0.4, 0.6}, {-0.8, 0.9}}, keep));
    add("polygon", closed_polyline_outline({{0.0, 0.0}, {1.0, 0.2}, {1.3, 1.0}, {0.4, 0.6}, {-0.8, 0.9}}, 0.05, keep));
  }
  return all;
}

// Of a polygon so fine that it is the outline to `chord` ²/(8 radius) of its sharpest bend.
double distance_to(const std::vector<Vec2>& line, const Vec2& from) {
  double least = infinity;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 side = line[i] - line[i - 1];
    const double length = side.squaredNorm();
    const double part = length > 0.0 ? std::clamp(side.dot(from - line[i - 1]) / length, 0.0, 1.0) : 0.0;
    least = std::min(least, (line[i - 1] + part * side - from).norm());
  }
  return least;
}

double winding(const std::vector<Vec2>& line, const Vec2& about) {
  double turn = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 a = line[i - 1] - about, b = line[i] - about;
    turn += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return turn / (2.0 * pi);
}

}  // namespace

// Against the polygon of the points that pictures are drawn of, which miss the outline by up to some 1e-3 in bends.
TEST(Outline, TheFootIsTheNearestPlaceFromEverywhere) {
  constexpr double drawn = 2e-3;
  test::Numbers numbers(7);
  for (const auto& [name, outline] : closed_outlines()) {
    SCOPED_TRACE(name);
    const std::vector<Vec2> line = outline->points(10.0);
    const bool from_inside = name.ends_with("inside");
    for (int i = 0; i < 3000; ++i) {
      const double far = i % 2 ? 1.0 : 3.0;
      const Vec2 place = far * Vec2(numbers(), numbers());
      const OutlineFoot foot = outline->foot(place);
      const double expected = distance_to(line, place);
      ASSERT_NEAR(std::abs(foot.distance), expected, drawn);
      if (expected < drawn) continue;
      const bool is_within = std::abs(winding(line, place)) > 0.5;
      ASSERT_EQ(foot.distance > 0.0, is_within == from_inside);
    }
  }
}

// The place at the foot is as far away as the foot says, its foot is itself, and the position stands upright on it.
TEST(Outline, FeetAreOnTheOutlineToRoundOff) {
  test::Numbers numbers(8);
  for (const auto& [name, outline] : closed_outlines()) {
    SCOPED_TRACE(name);
    for (int i = 0; i < 1000; ++i) {
      const Vec2 place = 2.0 * Vec2(numbers(), numbers());
      const OutlineFoot foot = outline->foot(place);
      const Vec2 on = place - foot.distance * perp(foot.tangent);
      ASSERT_NEAR(outline->foot(on).distance, 0.0, 1e-13);
      ASSERT_NEAR((on - place).norm(), std::abs(foot.distance), 1e-13);
    }
  }
}

// At centres and on axes of symmetry several places are equally near: one of them is told, and nothing fails. The
// nearest of an ellipse from its centre are the ends of its short axis; on the long one, from x with x a < a² − b², the
// places with cos t = x a/(a² − b²), at the distance b √(1 − x²/(a² − b²)).
TEST(Outline, OfEquallyNearPlacesOneIsTold) {
  const auto circle = circle_outline({1.0, 2.0}, 0.5, Keep::inside);
  EXPECT_NEAR(circle->foot({1.0, 2.0}).distance, 0.5, 1e-15);
  const auto ellipse = ellipse_outline({0.0, 0.0}, {2.0, 1.0}, 0.0, Keep::outside);
  EXPECT_NEAR(ellipse->foot({0.0, 0.0}).distance, -1.0, 1e-15);
  for (const double x : {0.0, 0.2, -0.7, 1.1, 1.4})
    EXPECT_NEAR(ellipse->foot({x, 0.0}).distance, -std::sqrt(1.0 - x * x / 3.0), 1e-12) << x;
  for (const double x : {1.6, -1.9, 2.0, 2.5, 30.0})
    EXPECT_NEAR(ellipse->foot({x, 0.0}).distance, std::abs(x) - 2.0, 1e-12) << x;
}

TEST(Outline, AHalfPlaneIsBehindItsPoint) {
  const auto plane = half_plane_outline({2.0, 0.0}, {-3.0, 0.0});
  EXPECT_NEAR(plane->foot({0.5, 7.0}).distance, 1.5, 1e-15);
  EXPECT_NEAR(plane->foot({2.5, -7.0}).distance, -0.5, 1e-15);
}

// A ramp of three lines: beside its corner the distance is that from the corner, or from the arc that rounds it, whose
// centre is the radius times √2 below it.
TEST(Outline, CornersPointToTheBodyOrAreRounded) {
  const std::vector<Vec2> roof{{-1.0, -1.0}, {0.0, 0.0}, {1.0, -1.0}};
  const auto sharp = polyline_outline(roof, 0.0);
  EXPECT_NEAR(sharp->foot({0.1, 2.0}).distance, std::hypot(0.1, 2.0), 1e-15);
  EXPECT_NEAR(sharp->foot({-0.5, 0.5}).distance, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(sharp->foot({0.0, -0.5}).distance, -0.5 * std::sqrt(0.5), 1e-15);
  const double radius = 0.2, centre = -radius * std::sqrt(2.0);
  const auto rounded = polyline_outline(roof, radius);
  EXPECT_NEAR(rounded->foot({0.1, 2.0}).distance, std::hypot(0.1, 2.0 - centre) - radius, 1e-15);
  EXPECT_NEAR(rounded->foot({-0.9, 0.2}).distance, 1.1 * std::sqrt(0.5), 1e-15);
  EXPECT_TRUE(rounded->foot({-2.0, -1.5}).beyond);
  EXPECT_FALSE(rounded->foot({-0.9, -0.5}).beyond);
}

// A square of 4 whose corners are rounded by arcs of their own, about centres their radius from both sides.
TEST(Outline, HasARadiusOfItsOwnAtEachCorner) {
  const std::vector<Vec2> square{{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}};
  const std::vector<double> radii{0.1, 0.2, 0.3, 0.4};
  for (const Keep keep : {Keep::outside, Keep::inside}) {
    const auto box = closed_polyline_outline(square, radii, keep);
    for (std::size_t i = 0; i < square.size(); ++i) {
      const Vec2 outwards = (square[i] - Vec2(2.0, 2.0)) / 2.0, centre = square[i] - radii[i] * outwards;
      const double far = keep == Keep::outside ? 1.5 : 0.05;
      const double gap = far - radii[i];
      EXPECT_NEAR(box->foot(centre + far * outwards.normalized()).distance, keep == Keep::outside ? gap : -gap, 1e-14);
    }
    if (keep == Keep::inside) {
      EXPECT_NEAR(box->sharpest_hollow(), 10.0, 1e-12);
    }
  }
}

// Through the corners of a regular polygon the closed curve looks the same from all of them.
TEST(Outline, AClosedCurveHasNoSeam) {
  constexpr int corners = 7;
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i)
    points.emplace_back(std::cos(2.0 * pi * i / corners), std::sin(2.0 * pi * i / corners));
  const auto ring = closed_curve_outline(points, Keep::outside);
  const auto foot_at = [&](int i, double shift) {
    const double angle = 2.0 * pi * (i + shift) / corners;
    return ring->foot(1.4 * Vec2(std::cos(angle), std::sin(angle)));
  };
  for (const double shift : {0.0, 0.1, 0.37})
    for (int i = 1; i < corners; ++i) {
      EXPECT_NEAR(foot_at(i, shift).distance, foot_at(0, shift).distance, 1e-14);
      EXPECT_NEAR(foot_at(i, shift).curvature, foot_at(0, shift).curvature, 1e-12);
    }
}

// Behind the outline, no end nearer: of a block with an open bottom as of one that is closed; of a long bed above a
// flank no deeper than it is long.
TEST(Outline, AnOpenOneHasAPlaceFarInsideToo) {
  const std::vector<Vec2> block{{0.0, -2.8}, {0.0, 0.0}, {1.0, 0.0}, {1.0, -2.8}};
  const std::vector<Vec2> bed{{-60.0, 0.0}, {-10.0, 0.0}, {-10.0, -5.0}};
  const std::vector<Vec2> arch{{-1.0, 0.0}, {-0.7, 0.7}, {0.0, 1.0}, {0.7, 0.7}, {1.0, 0.0}};
  const auto depth = [](const Outline& outline) {
    const auto core = outline.core();
    return core && !outline.foot(*core).beyond ? -outline.foot(*core).distance : 0.0;
  };
  EXPECT_GT(depth(*polyline_outline(block, 0.0)), 0.25);
  EXPECT_LE(depth(*polyline_outline(block, 0.0)), 0.5);
  EXPECT_GT(depth(*polyline_outline(bed, 0.0)), 5.0);
  EXPECT_LE(depth(*polyline_outline(bed, 0.0)), 55.0);
  EXPECT_GT(depth(*curve_outline(arch)), 0.25);
}

// However thin it is: a straight way through a fin, and one that passes its top by as much as the fin is thick.
TEST(Outline, APointDoesNotPassThroughAThinWall) {
  const double thick = 1e-4, touching = 1e-9;
  for (const bool is_closed : {false, true}) {
    const std::vector<Vec2> points{{0.0, -1.0}, {0.0, 0.0}, {thick, 0.0}, {thick, -1.0}};
    const auto fin =
        obstacle(is_closed ? std::shared_ptr<const Outline>(closed_polyline_outline(points, 0.0, Keep::outside))
                           : std::shared_ptr<const Outline>(polyline_outline(points, 0.0)));
    const auto passes = [&](const Vec2& from, const Vec2& to) {
      return point_passes_through(*fin, {.from = from, .to = to}, 0.0, 0.0, touching);
    };
    EXPECT_TRUE(passes({-1.3, -0.2}, {1.0, -0.4}));
    EXPECT_TRUE(passes({-1.3, -2.0 * thick}, {1.0, 0.0}));
    EXPECT_FALSE(passes({-1.3, thick}, {1.0, thick}));
    EXPECT_FALSE(passes({-1.3, -0.2}, {-2.0 * thick, -0.2}));
  }
}

// The angle from one end of an arc to the other, also about a place beside it that is nearer than its chord.
TEST(Outline, ALineGoesRoundAPlaceOnTheSideWhereItIs) {
  const auto arc = [](double t) { return Vec2(t - 0.5, 0.4 * t * (1.0 - t)); };  // 0.1 high
  EXPECT_NEAR(turn_about({0.0, 0.1001}, arc, 1e-9), 2.0 * std::atan2(0.5, 0.1001), 1e-12);
  EXPECT_NEAR(turn_about({0.0, 0.0999}, arc, 1e-9), 2.0 * std::atan2(0.5, 0.0999) - 2.0 * pi, 1e-12);
}

}  // namespace arcwall::outline_test
