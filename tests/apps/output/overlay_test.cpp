#include "apps/output/overlay.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "tests/apps/output/sample_record.hpp"

namespace arcwall::overlay_test {
namespace {

const std::vector<RecordColumn> columns{{.name = "mid"}, {.name = "tip"}};

std::string refusal(const std::string& text) {
  try {
    measured_points(text, "test.csv", columns);
  } catch (const InputError& problem) {
    return problem.what();
  }
  return {};
}

TEST(Overlay, OfARunHasItsColumnsAndWhereBranchesBegin) {
  const Record record = sample_record();
  const Overlay overlay = overlay_of(record, "coarse");
  EXPECT_EQ(overlay.values.at("lambda").size(), record.points.size());
  EXPECT_EQ(overlay.values.at("mid")[1], record.points[1].monitors[0]);
  EXPECT_EQ(overlay.firsts.size(), record.branches.size());
  EXPECT_EQ(overlay.firsts.front(), 0u);
}

TEST(Overlay, MeasuredPointsAreReadByTheirNames) {
  const Overlay overlay = measured_points("mid [cm], λ ,remark\r\n0.5,1e-3,7\n\n1.5,,8\n", "folder/test.csv", columns);
  EXPECT_EQ(overlay.name, "test.csv");
  EXPECT_TRUE(overlay.measured);
  EXPECT_EQ(overlay.values.at("mid"), (std::vector<double>{0.5, 1.5}));
  EXPECT_EQ(overlay.values.at("lambda")[0], 1e-3);
  EXPECT_TRUE(std::isnan(overlay.values.at("lambda")[1]));
  EXPECT_FALSE(overlay.values.contains("remark"));
}

TEST(Overlay, MeasuredPointsThatAreNoneAreRefusedWithTheirLine) {
  EXPECT_NE(refusal("mid;lambda\n1;2\n").find("test.csv:1: names fewer than two columns"), std::string::npos);
  EXPECT_NE(refusal("mid,lambda\n1,2\n1,two\n").find("test.csv:3: \"two\" is no number"), std::string::npos);
  EXPECT_NE(refusal("mid,lambda\n1,5,2\n").find("test.csv:2: has 3 cells instead of 2"), std::string::npos);
  EXPECT_NE(refusal("mid,lambda\n").find("has no line with numbers"), std::string::npos);
  EXPECT_NE(refusal("").find("is empty"), std::string::npos);
}

// RFC 4180.
TEST(Overlay, MeasuredPointsMayStandInQuotes) {
  const Overlay overlay = measured_points(
      "lambda,\"mid [a,b]\",\"re\"\"mark\" \r\n\"0.1\", \"0.01\",\"two\nlines, \"\"quoted\"\"\"\r\n0.2,0.02,\"\"\n",
      "test.csv", columns);
  EXPECT_EQ(overlay.values.at("lambda"), (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(overlay.values.at("mid"), (std::vector<double>{0.01, 0.02}));
  EXPECT_NE(refusal("mid,lambda\n\"1\n2\",\"3\n4").find("test.csv:3: has a cell whose quotes are not closed"),
            std::string::npos);
  EXPECT_NE(refusal("mid,lambda\n\"1\"x,2\n").find("test.csv:2: has a quote within a cell"), std::string::npos);
  EXPECT_NE(refusal("mid,lambda,note\n1,2,\"a\nb\"\n1,two,3\n").find("test.csv:4: \"two\" is no number"),
            std::string::npos);
}

}  // namespace
}  // namespace arcwall::overlay_test
