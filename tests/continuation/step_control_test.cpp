#include "continuation/step/step_control.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace arcwall::step_control_test {

namespace {

const StepOptions options{.min = 1e-3, .max = 1.0, .wanted_iterations = 4, .wanted_turn = 0.2};

}  // namespace

TEST(StepControl, GrowsByTheRootOfWantedOverUsedIterationsAtMostTwice) {
  StepControl two(options, 0.1), one(options, 0.1), four(options, 0.1);
  two.succeeded(2, 0.0, 0.1);
  EXPECT_NEAR(two.length(), 0.1 * std::sqrt(2.0), 1e-15);
  one.succeeded(1, 0.0, 0.1);
  EXPECT_NEAR(one.length(), 0.2, 1e-15);
  four.succeeded(4, 0.0, 0.1);
  EXPECT_NEAR(four.length(), 0.1, 1e-15);
}

TEST(StepControl, ShrinksWithManyIterationsAndWithATurningTangentAtMostToAQuarter) {
  StepControl slow(options, 0.1), turning(options, 0.1), sharp(options, 0.1);
  slow.succeeded(8, 0.0, 0.1);
  EXPECT_NEAR(slow.length(), 0.1 / std::sqrt(2.0), 1e-15);
  turning.succeeded(4, 0.4, 0.1);
  EXPECT_NEAR(turning.length(), 0.05, 1e-15);
  sharp.succeeded(4, 100.0, 0.1);
  EXPECT_NEAR(sharp.length(), 0.025, 1e-15);
}

TEST(StepControl, LimitsTheMotionOfTheStructure) {
  StepControl step(options, 5.0);
  EXPECT_EQ(step.length(), 1.0);
  step.succeeded(1, 0.0, 1.0);
  step.limit(0.1, 0.1);
  EXPECT_EQ(step.length(), 2.0);
  step.limit(0.5, 0.1);
  EXPECT_NEAR(step.length(), std::sqrt(3.0), 1e-15);
  step.limit(0.8, 0.1);
  EXPECT_EQ(step.length(), 1.0);
  step.restart(7.0);
  EXPECT_EQ(step.length(), 1.0);
}

TEST(StepControl, LimitsTheChangeOfLambdaWhereOneIsAskedFor) {
  StepOptions asked = options;
  asked.max_lambda = 3.0;
  StepControl step(asked, 1.0);
  step.succeeded(1, 0.0, 1.0);
  step.limit(0.0, -2.0);
  EXPECT_EQ(step.length(), 1.5);
}

TEST(StepControl, HalvesAfterAFailureUntilItIsTooShort) {
  StepControl step(options, 0.1);
  step.failed(0.1);
  EXPECT_EQ(step.length(), 0.05);
  EXPECT_FALSE(step.too_short());
  for (int i = 0; i < 6; ++i) step.failed(step.length());
  EXPECT_TRUE(step.too_short());
  step.restart(1e-9);
  EXPECT_EQ(step.length(), options.min);
  EXPECT_FALSE(step.too_short());
}

TEST(StepControl, AStepThatAnEventCutShortDoesNotShrinkTheNext) {
  StepControl step(options, 0.4);
  step.succeeded(4, 0.0, 1e-4);
  EXPECT_EQ(step.length(), 0.4);
}

}  // namespace arcwall::step_control_test
