#include "apps/sweep/load_lines.hpp"

#include <gtest/gtest.h>

namespace arcwall::sweep::load_lines_test {
namespace {

std::size_t count(const std::string& part, const std::string& text) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

// Three imperfections in two channels.
LoadLines lines_of_two_channels() {
  LoadLines lines{.titles = {.x = "a [cm]", .y = "b", .load = "λ of the snap", .unit = "2 kN"}};
  for (const double b : {1.0, 2.0}) {
    LoadLine& line = lines.lines.emplace_back(LoadLine{.name = "b", .panel = b});
    for (const double a : {-0.3, 0.1, 0.2})
      line.points.push_back({.x = a, .y = b, .load = 5.0 * b - 10.0 * std::abs(a)});
  }
  return lines;
}

TEST(LoadLines, TheReferenceIsTheLoadWhereTheKeyIsNearestToZero) {
  LoadLines lines = lines_of_two_channels();
  EXPECT_EQ(lines.lines[0].reference(), 4.0);  // of a = 0.1
  EXPECT_EQ(lines.lines[1].reference(), 9.0);
  lines.lines[0].points[1].failed = true;
  EXPECT_EQ(lines.lines[0].reference(), std::nullopt);
  EXPECT_EQ((LoadLine{.points = {{.x = "classic", .load = 3.0}, {.x = "exact", .load = 2.0}}}.reference()), 3.0);
}

TEST(LoadLines, EachLineIsDrawnWithAMarkForEachCase) {
  const LoadLines lines = lines_of_two_channels();
  EXPECT_EQ(count("stroke-width=\"1.6\"", lines_svg(lines)), 2u);
  EXPECT_EQ(count("<circle", lines_svg(lines)), 6u);
  EXPECT_EQ(count("λ of the snap, times 2 kN</text>", lines_svg(lines)), 1u);
}

// In words: a = 0.2 in the first channel has 3 of the 4 of a = 0.1.
TEST(LoadLines, AMarkSaysItsCaseInWords) {
  EXPECT_EQ(count("a = 0.2 cm\nb = 1\nλ of the snap is 3, times 2 kN\n0.75 times λ₀</title>",
                  lines_svg(lines_of_two_channels())),
            1u);
}

TEST(LoadLines, KnockDownLeavesOutWhatHasNoReference) {
  LoadLines lines = lines_of_two_channels();
  EXPECT_EQ(count("<circle", knockdown_svg(lines)), 6u);
  EXPECT_EQ(count("λ/λ₀ of the snap</text>", knockdown_svg(lines)), 1u);
  lines.lines[0].points[1].load.reset();
  EXPECT_EQ(count("<circle", knockdown_svg(lines)), 3u);
  EXPECT_EQ(count("<circle", lines_svg(lines)), 5u);
}

TEST(LoadLines, FailedCasesAreCrossedAndJoinNothing) {
  LoadLines lines = lines_of_two_channels();
  lines.lines[0].points[1].failed = true;
  const std::string svg = lines_svg(lines);
  EXPECT_EQ(count("#d33", svg), 1u);
  EXPECT_EQ(count("<circle", svg), 6u);
}

TEST(LoadLines, CasesThatDifferInMoreThanTheKeyHaveNone) {
  LoadLines lines = lines_of_two_channels();
  for (LoadLine& line : lines.lines) line.points.resize(1);
  EXPECT_EQ(lines_svg(lines) + knockdown_svg(lines) + panels_svg(lines), "");
}

// Two panels with one line in colour and one in grey each.
TEST(LoadLines, EachValueOfTheSecondKeyHasAPanel) {
  const std::string svg = panels_svg(lines_of_two_channels());
  EXPECT_EQ(count("middle\">1</text>", svg) + count("middle\">2</text>", svg), 2u);
  EXPECT_EQ(count("stroke=\"#8885\" stroke-width", svg), 2u);
  EXPECT_EQ(count("stroke-width=\"1.6\"", svg), 4u);
}

TEST(LoadLines, AClickLeadsToTheReportOfACase) {
  LoadLines lines = lines_of_two_channels();
  lines.lines[0].points[0].link = "cases/00000/report.html";
  EXPECT_EQ(count("<a href=\"cases/00000/report.html\">", lines_svg(lines)), 1u);
}

}  // namespace
}  // namespace arcwall::sweep::load_lines_test
