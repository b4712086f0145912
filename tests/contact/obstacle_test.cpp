#include "contact/obstacle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "contact/moving_obstacle.hpp"
#include "contact/outline.hpp"
#include "core/unit_tangent.hpp"
#include "tests/contact/contact_models.hpp"

namespace arcwall::obstacle_test {

namespace {

constexpr double step = 1e-3;

struct Named {
  std::string name;
  std::shared_ptr<const Obstacle> obstacle;
};

// All kinds of walls on both sides: at rest, and moved and turned by λ.
std::vector<Named> all_obstacles() {
  std::vector<Named> all;
  for (const bool moves : {false, true})
    for (std::size_t kind = 0; test::TestWall wall : test::all_walls(false)) {
      if (moves) wall.motion = {.way = {0.3, -0.4}, .turn = 0.2, .about = {0.5, -0.1}};
      all.push_back({"wall " + std::to_string(kind++) + (moves ? " that moves" : " at rest"), wall.obstacle()});
    }
  return all;
}

// Outlines of all types beside the same places, for an axis or for a body of half the height 0.3.
std::vector<Named> all_outlines() {
  std::vector<std::pair<std::string, std::shared_ptr<const Outline>>> outlines;
  const auto add = [&](std::string name, std::unique_ptr<Outline> outline) {
    outlines.emplace_back(std::move(name), std::move(outline));
  };
  add("half-plane", half_plane_outline({0.3, -0.8}, {-0.4, 2.0}));
  add("circle", circle_outline({1.5, -6.0}, 5.0, Keep::outside));
  add("bore", circle_outline({0.6, 0.3}, 4.0, Keep::inside));
  add("ellipse", ellipse_outline({0.8, -4.1}, {3.0, 2.0}, 0.4, Keep::outside));
  add("oval bore", ellipse_outline({0.8, 0.3}, {7.0, 5.0}, -0.3, Keep::inside));
  add("curve", curve_outline({{-3.0, -1.6}, {-0.5, -1.2}, {1.5, -0.9}, {3.5, -1.1}, {6.0, -1.7}}));
  add("closed curve",
      closed_curve_outline({{-2.0, -1.0}, {1.0, -1.3}, {4.0, -1.1}, {5.0, -6.0}, {-4.0, -5.0}}, Keep::outside));
  add("lumen", closed_curve_outline({{-5.0, 0.0}, {-1.0, 5.0}, {4.0, 5.5}, {6.0, -0.3}, {1.0, -6.0}}, Keep::inside));
  add("polyline", polyline_outline({{-4.0, -3.0}, {1.0, -0.6}, {7.0, -3.4}}, 0.5));
  add("corner", polyline_outline({{-1.0, -9.0}, {1.0, -2.0}, {2.4, -9.0}}, 0.0));
  add("hollow", polyline_outline({{-6.0, 4.0}, {1.2, -4.0}, {9.0, 5.5}}, 7.0));
  add("box", closed_polyline_outline({{-6.0, -5.0}, {-6.0, 6.0}, {8.0, 6.0}, {8.0, -5.0}}, 1.0, Keep::inside));
  std::vector<Named> all;
  for (const auto& [name, outline] : outlines)
    for (const double half_height : {0.0, 0.3}) {
      if (name == "corner" && half_height == 0.0) continue;  // on which no axis may lie
      const std::string kind = name + (half_height > 0.0 ? " off its face" : "");
      all.push_back({kind, obstacle(outline, half_height)});
      if (outline->is_smooth() && outline->curvature_rate_jumps().empty())
        all.push_back({kind + " that comes to its place", obstacle(outline, half_height, 0.25)});
      const RigidMotion motion{.way = {0.03, -0.04}, .turn = 0.02, .about = {0.5, -0.1}};
      all.push_back({kind + " that moves", std::make_shared<MovingObstacle>(obstacle(outline, half_height), motion)});
    }
  return all;
}

std::vector<Named> walls_and_outlines() {
  std::vector<Named> all = all_obstacles();
  for (Named& named : all_outlines()) all.push_back(std::move(named));
  return all;
}

// Places that all of them face, off the surface on either side; none is at the knots of the splines.
std::vector<Vec2> places() { return {{0.13, 0.2}, {0.87, -0.35}, {1.71, 0.9}, {1.21, -1.4}, {2.2, 1.3}}; }

// The central difference of fourth order of a function at 0.
template <typename Function>
double difference(const Function& f) {
  return (8.0 * (f(step) - f(-step)) - (f(2.0 * step) - f(-2.0 * step))) / (12.0 * step);
}

// Those of a function of x, z and λ.
struct Differences {
  double x, z, rate;
};

template <typename Function>
Differences differences(const Function& f, const Vec2& at, double lambda) {
  const Vec2 dx(1.0, 0.0), dz(0.0, 1.0);
  return {.x = difference([&](double by) { return f(at + by * dx, lambda); }),
          .z = difference([&](double by) { return f(at + by * dz, lambda); }),
          .rate = difference([&](double by) { return f(at, lambda + by); })};
}

// Differences of fourth order and step 1e-3: truncation 1e-12 by thirty times the fifth derivatives, round-off 1e-12.
constexpr double tolerance = 1e-9;

// `ask` gives the field at a position and λ.
template <typename Ask>
void expect_derivatives(const Ask& ask, const Vec2& at, double lambda) {
  const QuadraticField field = ask(at, lambda);
  const auto of = [&](auto member) {
    return differences([&](const Vec2& r, double l) { return ask(r, l).*member; }, at, lambda);
  };
  const Differences value = of(&QuadraticField::value), x = of(&QuadraticField::x), z = of(&QuadraticField::z);
  EXPECT_NEAR(value.x, field.x, tolerance);
  EXPECT_NEAR(value.z, field.z, tolerance);
  EXPECT_NEAR(value.rate, field.rate, tolerance);
  EXPECT_NEAR(x.x, field.xx, tolerance);
  EXPECT_NEAR(x.z, field.xz, tolerance);
  EXPECT_NEAR(z.x, field.xz, tolerance);
  EXPECT_NEAR(z.z, field.zz, tolerance);
  EXPECT_NEAR(x.rate, field.x_rate, tolerance);
  EXPECT_NEAR(z.rate, field.z_rate, tolerance);
}

}  // namespace

TEST(Obstacle, DerivativesAreThoseOfTheValues) {
  for (const auto& [name, obstacle] : walls_and_outlines())
    for (const Vec2& at : places()) {
      SCOPED_TRACE(name);
      const double lambda = 0.7;
      ASSERT_TRUE(obstacle->faces(at, lambda));
      expect_derivatives([&o = obstacle](const Vec2& r, double l) { return o->gap(r, l); }, at, lambda);
      expect_derivatives([&o = obstacle](const Vec2& r, double l) { return o->direction(r, l); }, at, lambda);
      const LinearField bend = obstacle->curvature(at, lambda);
      const Differences found =
          differences([&o = obstacle](const Vec2& r, double l) { return o->curvature(r, l).value; }, at, lambda);
      EXPECT_NEAR(found.x, bend.x, tolerance);
      EXPECT_NEAR(found.z, bend.z, tolerance);
      EXPECT_NEAR(found.rate, bend.rate, tolerance);
    }
}

TEST(Obstacle, TheSlopeOfTheGapIsThatOfTheGap) {
  for (const auto& [name, obstacle] : walls_and_outlines())
    for (const Vec2& at : places()) {
      SCOPED_TRACE(name);
      const QuadraticField gap = obstacle->gap(at, 0.7);
      const LinearField slope = obstacle->gap_slope(at, 0.7);
      EXPECT_EQ(slope.value, gap.value);
      EXPECT_NEAR(slope.x, gap.x, 1e-14);
      EXPECT_NEAR(slope.z, gap.z, 1e-14);
      EXPECT_NEAR(slope.rate, gap.rate, 1e-14);
    }
}

// On the surface the gradient is the unit normal to the surface's direction on the free side, and the direction turns
// by the curvature with the length of the surface.
TEST(Obstacle, GradientDirectionAndCurvatureBelongTogetherOnTheSurface) {
  for (const auto& [name, obstacle] : walls_and_outlines())
    for (Vec2 at : places()) {
      SCOPED_TRACE(name);
      const double lambda = 0.7;
      for (int i = 0; i < 30; ++i) at -= obstacle->gap(at, lambda).value * obstacle->normal(at, lambda);
      const QuadraticField gap = obstacle->gap(at, lambda);
      ASSERT_NEAR(gap.value, 0.0, 1e-14);
      const double angle = obstacle->direction(at, lambda).value;
      const Vec2 along(std::cos(angle), std::sin(angle));
      const Vec2 into_the_free = sign_of(obstacle->side()) * perp(along);
      EXPECT_LE((Vec2(gap.x, gap.z) - into_the_free).norm(), 1e-13);
      EXPECT_LE((obstacle->normal(at, lambda) - into_the_free).norm(), 1e-13);
      const Obstacle& on = *obstacle;
      const auto turned = [&](double s) { return on.direction(at + s * along, lambda).value; };
      EXPECT_NEAR(difference(turned), obstacle->curvature(at, lambda).value, tolerance);
      const auto bent = [&](double s) {
        const Vec2 beside = at + s * along + 0.5 * on.curvature(at, lambda).value * s * s * perp(along);
        const LinearField bend = on.curvature(beside, lambda);
        return Vec2(bend.x, bend.z).dot(unit_tangent(on.direction(beside, lambda).value));
      };
      EXPECT_NEAR(difference(bent), on.curvature_second(at, lambda), 10.0 * tolerance);
    }
}

TEST(Obstacle, OutlinesLieOnTheSurfaceWithinTheirReach) {
  for (const auto& [name, obstacle] : all_obstacles()) {
    SCOPED_TRACE(name);
    if (name.ends_with("moves")) continue;
    const std::vector<Vec2> line = obstacle->outline(0.1, 2.4, 0.0);
    ASSERT_GE(line.size(), 2U);
    EXPECT_NEAR(line.front().x(), 0.1, 1e-15);
    EXPECT_NEAR(line.back().x(), 2.4, 1e-15);
    for (const Vec2& point : line) EXPECT_NEAR(obstacle->gap(point, 0.0).value, 0.0, 1e-14);
  }
  // A circle has none at x = 9; all of it is shown then.
  const auto disc = obstacle(circle_profile({1.0, 0.0}, 2.0, Side::below), Side::below);
  EXPECT_NEAR(disc->outline(8.0, 9.0, 0.0).front().x(), -1.0, 1e-5);
  EXPECT_NEAR(disc->outline(8.0, 9.0, 0.0).back().x(), 3.0, 1e-5);
}

TEST(Obstacle, BeyondItsEndThereIsNoGap) {
  const auto disc = obstacle(circle_profile({1.0, 0.0}, 2.0, Side::below), Side::below);
  const LinearField beyond = disc->gap_slope({3.5, 1.0}, 0.0);
  EXPECT_FALSE(disc->faces({3.5, 1.0}, 0.0));
  EXPECT_EQ(beyond.value, infinity);
  EXPECT_EQ(beyond.x, 0.0);
  EXPECT_EQ(beyond.z, 0.0);
}

namespace {

// The derivative of the curvature along the surface, a little beside a place of it.
double curvature_rate(const Obstacle& of, const Vec2& at, const Vec2& tangent) {
  const LinearField bend = of.curvature(at, 0.0);
  return bend.x * tangent.x() + bend.z * tangent.y();
}

}  // namespace

// At the points of splines but for the ends and those beside them, where the cubics are the same: there nothing jumps.
// A spline is smooth between, so that its rates on both sides of a place differ by the jump and what they change by
// over the way of 2e-4 (thirty times that).
TEST(Obstacle, TellsWhereTheRateOfItsCurvatureJumps) {
  const std::vector<double> x{-2.0, -1.1, 0.0, 0.7, 2.0, 2.6}, z{-1.0, -1.3, -0.8, -0.9, -1.2, -1.1};
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.emplace_back(x[i], z[i]);
  std::vector<Named> splines{{"below", obstacle(spline_profile(x, z), Side::below)},
                             {"above", obstacle(spline_profile(x, z), Side::above)}};
  for (const double half_height : {0.0, 0.05})
    splines.push_back({"curve", obstacle(std::shared_ptr<const Outline>(curve_outline(points)), half_height)});
  for (const auto& [name, spline] : splines) {
    SCOPED_TRACE(name);
    const auto jumps = spline->curvature_rate_jumps();
    ASSERT_EQ(jumps.size(), x.size() - 2);
    for (std::size_t i = 0; i < jumps.size(); ++i) {
      const CurvatureRateJump& jump = jumps[i];
      EXPECT_NEAR(spline->gap(jump.place, 0.0).value, 0.0, 1e-14);
      EXPECT_NEAR(
          std::remainder(spline->direction(jump.place, 0.0).value - std::atan2(jump.tangent.y(), jump.tangent.x()),
                         2.0 * pi),
          0.0, 1e-12);
      const double aside = 1e-4;
      ASSERT_LT(jump.half_width, aside);
      const double found = curvature_rate(*spline, jump.place + aside * jump.tangent, jump.tangent) -
                           curvature_rate(*spline, jump.place - aside * jump.tangent, jump.tangent);
      const bool is_inner = i > 0 && i + 1 < jumps.size();
      EXPECT_NEAR(found, jump.jump, 6e-3);
      if (is_inner) {
        EXPECT_GT(std::abs(jump.jump), 0.5);
      } else {
        EXPECT_NEAR(jump.jump, 0.0, 1e-10);
      }
    }
  }
  for (const auto& [name, outline] : all_outlines()) {
    const bool is_spline = name.find("curve") != std::string::npos || name.find("lumen") != std::string::npos;
    EXPECT_EQ(outline->curvature_rate_jumps().empty(), !is_spline) << name;
  }
}

TEST(Obstacle, TellsHowFarAPlaceIsBeyondAJump) {
  for (const auto& [name, obstacle] : walls_and_outlines())
    for (const CurvatureRateJump& jump : obstacle->curvature_rate_jumps()) {
      SCOPED_TRACE(name);
      const double lambda = 0.7;
      const Vec2 at = jump.place + Vec2(0.2, 0.1);
      const auto value = [&o = obstacle, &jump](const Vec2& r, double l) { return o->beyond(jump, r, l).value; };
      EXPECT_NEAR(obstacle->beyond(jump, at, lambda).value,
                  jump.tangent.dot(obstacle->seen_at_rest(at, lambda) - jump.place), 1e-14);
      const Differences found = differences(value, at, lambda);
      EXPECT_NEAR(found.x, obstacle->beyond(jump, at, lambda).x, tolerance);
      EXPECT_NEAR(found.z, obstacle->beyond(jump, at, lambda).z, tolerance);
      EXPECT_NEAR(found.rate, obstacle->beyond(jump, at, lambda).rate, tolerance);
    }
}

}  // namespace arcwall::obstacle_test
