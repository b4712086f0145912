#include "core/root_find.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/types.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::root_find_test {

namespace {

std::optional<double> cosine(double t) { return std::cos(t); }

double cubic(double v0, double d0, double v1, double d1, double t) {
  const double s = 1.0 - t;
  return v0 * s * s * (1.0 + 2.0 * t) + d0 * t * s * s + v1 * t * t * (3.0 - 2.0 * t) - d1 * t * t * s;
}

// End values and slopes of (t − a)(t − b)(t − c).
struct Ends {
  double v0, d0, v1, d1;
};
Ends with_zeros(double a, double b, double c) {
  const auto value = [=](double t) { return (t - a) * (t - b) * (t - c); };
  const auto slope = [=](double t) { return (t - b) * (t - c) + (t - a) * (t - c) + (t - a) * (t - b); };
  return {value(0.0), slope(0.0), value(1.0), slope(1.0)};
}

std::optional<double> first_zero(const Ends& e) { return first_cubic_zero(e.v0, e.d0, e.v1, e.d1); }

}  // namespace

TEST(BracketedRoot, FindsTheZeroInsideItsBracketFromEitherSide) {
  for (const bool reversed : {false, true}) {
    const double a = reversed ? 2.0 : 1.0, b = reversed ? 1.0 : 2.0;
    const auto root = bracketed_root(cosine, a, std::cos(a), b, std::cos(b), 1e-14);
    ASSERT_TRUE(root.has_value());
    EXPECT_NEAR(root->at, pi / 2.0, 1e-14);
    EXPECT_GE(root->half_width, 0.0);
    EXPECT_LE(root->half_width, 0.5e-14);
  }
}

TEST(BracketedRoot, AZeroAtAnEndIsTaken) {
  const auto line = [](double t) -> std::optional<double> { return t - 1.0; };
  EXPECT_EQ(bracketed_root(line, 1.0, 0.0, 2.0, 1.0, 1e-12)->at, 1.0);
  EXPECT_EQ(bracketed_root(line, 0.0, -1.0, 1.0, 0.0, 1e-12)->at, 1.0);
}

TEST(BracketedRoot, FindsAZeroOfHighMultiplicity) {
  const auto flat = [](double t) -> std::optional<double> { return std::pow(t - 0.3, 5); };
  const auto root = bracketed_root(flat, 0.0, *flat(0.0), 1.0, *flat(1.0), 1e-10, 200);
  ASSERT_TRUE(root.has_value());
  EXPECT_NEAR(root->at, 0.3, 1e-10);
}

TEST(BracketedRoot, FailsWithoutAChangeOfSign) {
  EXPECT_FALSE(bracketed_root(cosine, 0.0, 1.0, 1.0, std::cos(1.0), 1e-12).has_value());
}

TEST(BracketedRoot, FailsWhereTheFunctionDoes) {
  const auto nothing = [](double) -> std::optional<double> { return std::nullopt; };
  EXPECT_FALSE(bracketed_root(nothing, 0.0, -1.0, 1.0, 1.0, 1e-12).has_value());
  const auto no_number = [](double) -> std::optional<double> { return std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_FALSE(bracketed_root(no_number, 0.0, -1.0, 1.0, 1.0, 1e-12).has_value());
}

TEST(BracketedRoot, StopsAtTheGivenNumberOfEvaluations) {
  int evaluations = 0;
  const auto counted = [&](double t) -> std::optional<double> {
    ++evaluations;
    return std::pow(t - 0.3, 9);
  };
  const auto root = bracketed_root(counted, 0.0, -1.0, 1.0, 1.0, 0.0, 7);
  ASSERT_TRUE(root.has_value());
  EXPECT_LE(evaluations, 7);
  EXPECT_GT(root->half_width, 0.0);
}

TEST(FirstCubicZero, IsTheLeastInsideTheInterval) {
  EXPECT_NEAR(*first_zero(with_zeros(0.2, 0.5, 0.9)), 0.2, 1e-15);
  EXPECT_NEAR(*first_zero(with_zeros(-0.2, 0.5, 1.9)), 0.5, 1e-15);
  EXPECT_NEAR(*first_zero(with_zeros(0.45, 0.46, 1.9)), 0.45, 1e-13);  // both ends have the same sign
  EXPECT_FALSE(first_zero(with_zeros(-1.0, -2.0, 1.5)).has_value());
}

TEST(FirstCubicZero, AZeroAtTheStartDoesNotCount) {
  EXPECT_FALSE(first_zero(with_zeros(0.0, 2.0, 3.0)).has_value());
  EXPECT_NEAR(*first_zero(with_zeros(0.0, 0.7, 3.0)), 0.7, 1e-15);
  EXPECT_FALSE(first_cubic_zero(0.0, 0.0, 0.0, 0.0).has_value());
}

TEST(FirstCubicZero, AZeroAtTheEndCounts) {
  EXPECT_EQ(first_cubic_zero(1.0, -1.0, 0.0, -1.0), 1.0);
  EXPECT_FALSE(first_cubic_zero(1.0, -1.0, 1e-3, -1.0).has_value());
}

TEST(FirstCubicZero, AgreesWithAFineSearchOnManyCubics) {
  test::Numbers numbers(10);
  constexpr int parts = 4000;
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const double v0 = numbers(), d0 = 6.0 * numbers(), v1 = numbers(), d1 = 6.0 * numbers();
    std::optional<double> before;  // the end of the part that holds the first change of sign
    for (int k = 1; k <= parts && !before; ++k)
      if (cubic(v0, d0, v1, d1, double(k) / parts) * v0 <= 0.0) before = double(k) / parts;
    const auto zero = first_cubic_zero(v0, d0, v1, d1);
    if (before) {
      ++found;
      ASSERT_TRUE(zero.has_value());
      EXPECT_LE(*zero, *before + 1e-12);
    }
    if (zero) {
      EXPECT_NEAR(cubic(v0, d0, v1, d1, *zero), 0.0, 1e-13);
    }
  }
  EXPECT_GT(found, 100);
}

TEST(CubicTurn, IsWhereTheSlopeVanishesIfThoseAtTheEndsDiffer) {
  test::Numbers numbers(12);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const double v0 = numbers(), d0 = 6.0 * numbers(), v1 = numbers(), d1 = 6.0 * numbers();
    const auto turn = cubic_turn(v0, d0, v1, d1);
    ASSERT_EQ(turn.has_value(), d0 * d1 < 0.0);
    if (!turn) continue;
    ++found;
    constexpr double h = 1e-4;
    EXPECT_TRUE(*turn > 0.0 && *turn < 1.0);
    // The third derivative is below 96.
    EXPECT_NEAR(cubic(v0, d0, v1, d1, *turn + h), cubic(v0, d0, v1, d1, *turn - h), 96.0 / 3.0 * h * h * h + 1e-14);
  }
  EXPECT_GT(found, 100);
  EXPECT_EQ(cubic_turn(0.0, 1.0, 0.0, -1.0), 0.5);
}

TEST(LeastCubicValue, IsTheLeastOfAFineSearch) {
  test::Numbers numbers(11);
  for (int i = 0; i < 300; ++i) {
    const double v0 = numbers(), d0 = 6.0 * numbers(), v1 = numbers(), d1 = 6.0 * numbers();
    double least = infinity;
    constexpr int parts = 2000;
    for (int k = 0; k <= parts; ++k) least = std::min(least, cubic(v0, d0, v1, d1, double(k) / parts));
    const double found = least_cubic_value(v0, d0, v1, d1);
    EXPECT_LE(found, least + 1e-14);
    // The second derivative is below 60, so a search in steps of 1/2000 is off by at most 60/8 of its square.
    EXPECT_GE(found, least - 7.5 / (double(parts) * parts));
  }
}

}  // namespace arcwall::root_find_test
