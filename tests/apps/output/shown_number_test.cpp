#include "apps/output/shown_number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace arcwall::shown_number_test {
namespace {

TEST(ShownNumber, HasNoNegativeZero) {
  EXPECT_EQ(shown_number(-0.0, 6), "0");
  EXPECT_EQ(shown_number(1.0 / 3.0, 6), "0.333333");
}

TEST(ShownUncertain, WhatIsCertainHasTheDigitsThatAreAskedFor) {
  EXPECT_EQ(shown_uncertain(1.0000114728203853, 0.0, 10), "1.000011473");
  EXPECT_EQ(shown_uncertain(1.0000114728203853, 4e-16, 10), "1.000011473");
  EXPECT_EQ(shown_uncertain(1.35, 1e-15, 10), "1.35");
  EXPECT_EQ(shown_uncertain(0.0, 0.0, 10), "0");
  EXPECT_EQ(shown_uncertain(std::nan(""), 1.0, 10), "nan");
}

// Uncertain is at most half a unit of the last digit.
TEST(ShownUncertain, ShowsNoDigitThatIsNotSure) {
  EXPECT_EQ(shown_uncertain(1.23456789012, 4e-10, 10), "1.23456789");
  EXPECT_EQ(shown_uncertain(1.23456789012, 6e-9, 10), "1.2345679");
  EXPECT_EQ(shown_uncertain(1.23456789012, 5e-7, 10), "1.234568");
  EXPECT_EQ(shown_uncertain(-1234.56789, 1e-4, 10), "-1234.568");
  EXPECT_EQ(shown_uncertain(1.23456789e-5, 1e-12, 10), "1.234568e-05");
}

TEST(ShownUncertain, MarksWhatIsUncertainByMoreThanAMillionth) {
  EXPECT_FALSE(is_marked_uncertain(-2.0, 2e-6));
  EXPECT_TRUE(is_marked_uncertain(-2.0, 2.1e-6));
  EXPECT_EQ(shown_uncertain(1.0120114646, 0.038, 10), "1.01 ± 0.05");
  EXPECT_EQ(shown_uncertain(-1.0120114646, 0.00312, 10), "-1.012 ± 0.004");
  EXPECT_EQ(shown_uncertain(1.0442079, 2e-6, 10), "1.044208 ± 0.000003");
  EXPECT_EQ(shown_uncertain(1.04, 0.03, 10), "1.04 ± 0.03");
  EXPECT_EQ(shown_uncertain(1.0, 0.1, 10), "1.0 ± 0.1");
}

TEST(ShownUncertain, KeepsItsDigitWhereRoundingUpMakesAnotherOne) {
  EXPECT_EQ(shown_uncertain(1.016, 0.0093, 10), "1.02 ± 0.02");
  EXPECT_EQ(shown_uncertain(3.0, 0.95, 10), "3 ± 1");
}

TEST(ShownUncertain, HasOneExponentWhereThereAreManyZeros) {
  EXPECT_EQ(shown_uncertain(1234.0, 30.0, 10), "1230 ± 40");
  EXPECT_EQ(shown_uncertain(1.234e12, 3e10, 10), "(1.23 ± 0.04)e+12");
  EXPECT_EQ(shown_uncertain(1.04e-7, 3e-9, 10), "(1.04 ± 0.03)e-07");
  EXPECT_EQ(shown_uncertain(4e-7, 5e-6, 10), "0 ± 6e-06");
  EXPECT_EQ(shown_uncertain(0.0, 2e-13, 10), "0 ± 2e-13");
}

TEST(ShownUncertain, SaysNothingOfWhatIsNotKnownAtAll) {
  EXPECT_EQ(shown_uncertain(1.0, std::numeric_limits<double>::infinity(), 10), "?");
}

// What is said holds the number, and no more than the rounding of both calls for.
TEST(ShownUncertain, SaysAnIntervalThatHoldsTheNumber) {
  for (int i = 1; i < 400; ++i) {
    const double value = 1.0 + 0.37 * std::sin(double(i)), half_width = std::exp(-13.0 * i / 400.0);
    if (!is_marked_uncertain(value, half_width)) continue;
    double middle = 0.0, around = 0.0;
    const std::string text = shown_uncertain(value, half_width, 10);
    ASSERT_EQ(std::sscanf(text.c_str(), "%lf ± %lf", &middle, &around), 2) << text;
    const double roundoff = 1e-5 * around;
    EXPECT_LE(middle - around, value - half_width + roundoff) << text;
    EXPECT_GE(middle + around, value + half_width - roundoff) << text;
    EXPECT_LE(around, 3.0 * half_width) << text;
  }
}

}  // namespace
}  // namespace arcwall::shown_number_test
