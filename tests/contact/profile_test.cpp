#include "contact/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace arcwall::profile_test {

namespace {

struct Named {
  const char* name;
  std::unique_ptr<Profile> profile;
  double from, to;
};

std::vector<Named> all_profiles() {
  std::vector<Named> all;
  all.push_back({"flat", flat_profile(0.3), -2.0, 2.0});
  all.push_back({"line", line_profile(0.3, -0.7), -2.0, 2.0});
  all.push_back({"parabola", parabola_profile({0.4, -1.0}, 0.8), -2.0, 2.0});
  all.push_back({"circle below", circle_profile({0.5, -3.0}, 2.0, Side::below), -1.2, 2.2});
  all.push_back({"circle above", circle_profile({0.5, 3.0}, 2.0, Side::above), -1.2, 2.2});
  all.push_back({"spline", spline_profile({-2.0, -1.1, 0.0, 0.7, 2.0}, {0.1, -0.2, 0.3, 0.2, -0.4}), -1.99, 1.99});
  return all;
}

}  // namespace

// Central differences of step 1e-5: truncation 1e-10 times higher derivatives (up to a few hundred near the ends of the
// circles), round-off 1e-11. A spline's third derivative jumps at its knots, which the points avoid.
TEST(Profile, EachDerivativeIsThatOfTheOneBefore) {
  constexpr double step = 1e-5;
  for (const Named& named : all_profiles()) {
    SCOPED_TRACE(named.name);
    for (int i = 0; i <= 30; ++i) {
      const double x = named.from + (named.to - named.from) * (i + 0.37) / 31.0;
      ASSERT_TRUE(named.profile->covers(x));
      const Height at = named.profile->at(x), a = named.profile->at(x + step), b = named.profile->at(x - step);
      const double scale = 1.0 + std::abs(at.third) + std::abs(at.second);
      EXPECT_NEAR((a.value - b.value) / (2.0 * step), at.first, 1e-8 * scale);
      EXPECT_NEAR((a.first - b.first) / (2.0 * step), at.second, 1e-8 * scale);
      EXPECT_NEAR((a.second - b.second) / (2.0 * step), at.third, 1e-6 * scale);
    }
  }
}

TEST(Profile, HeightsAreThoseOfTheirFormulas) {
  EXPECT_EQ(flat_profile(0.3)->at(17.0).value, 0.3);
  EXPECT_NEAR(line_profile(0.3, -0.5)->at(2.0).value, -0.7, 1e-16);
  EXPECT_NEAR(parabola_profile({1.0, -2.0}, 4.0)->at(1.5).value, -1.5, 1e-15);
  EXPECT_NEAR(spline_profile({0.0, 1.0, 3.0}, {1.0, 2.0, 10.0})->at(2.0).value, 5.0, 1e-14);  // 1 + x²
}

TEST(Profile, ACircleBelowShowsItsUpperArcAndOneAboveItsLower) {
  EXPECT_NEAR(circle_profile({1.0, -2.0}, 5.0, Side::below)->at(4.0).value, -2.0 + 4.0, 1e-14);
  EXPECT_NEAR(circle_profile({1.0, 2.0}, 5.0, Side::above)->at(4.0).value, 2.0 - 4.0, 1e-14);
  EXPECT_LT(circle_profile({1.0, -2.0}, 5.0, Side::below)->at(1.0).second, 0.0);
}

TEST(Profile, CirclesAndSplinesEndOthersDoNot) {
  const auto circle = circle_profile({1.0, 0.0}, 2.0, Side::below);
  EXPECT_TRUE(circle->covers(2.99));
  EXPECT_FALSE(circle->covers(3.0));
  EXPECT_FALSE(circle->covers(-1.5));
  const auto spline = spline_profile({0.0, 1.0, 2.0, 3.0}, {0.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(spline->covers(0.0));
  EXPECT_TRUE(spline->covers(3.0));
  EXPECT_FALSE(spline->covers(-1e-9));
  EXPECT_FALSE(spline->covers(3.1));
  EXPECT_TRUE(flat_profile(0.0)->covers(1e9));
  EXPECT_TRUE(line_profile(0.0, 1.0)->covers(-1e9));
  EXPECT_TRUE(parabola_profile({0.0, 0.0}, 1.0)->covers(1e9));
}

}  // namespace arcwall::profile_test
