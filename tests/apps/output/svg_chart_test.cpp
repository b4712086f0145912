#include "apps/output/svg_chart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "apps/output/event_marks.hpp"

namespace arcwall::svg_chart_test {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

// The numbers of an attribute.
std::vector<double> numbers(const std::string& svg, const std::string& attribute) {
  std::smatch match;
  std::regex_search(svg, match, std::regex(attribute + "=\"([^\"]*)\""));
  std::istringstream stream(match[1].str());
  return {std::istream_iterator<double>(stream), std::istream_iterator<double>()};
}

Chart chart_of(std::vector<Vec2> points) {
  return {.name = "test", .across = "x", .up = "y", .lines = {{.points = std::move(points), .colour = "#000"}}};
}

TEST(Ticks, AreRoundAndInside) {
  EXPECT_EQ(ticks(0.0, 10.0), (std::vector<double>{0.0, 2.0, 4.0, 6.0, 8.0, 10.0}));
  EXPECT_EQ(ticks(-1.0, 1.0), (std::vector<double>{-1.0, -0.8, -0.6000000000000001, -0.4, -0.2, 0.0, 0.2, 0.4,
                                                   0.6000000000000001, 0.8, 1.0}));
  EXPECT_EQ(ticks(1e6, 3.5e6), (std::vector<double>{1e6, 1.5e6, 2e6, 2.5e6, 3e6, 3.5e6}));
}

TEST(Ticks, AreFourToElevenWhateverTheRange) {
  for (const double high : {1.001, 1.0, 2.0, 3.0, 4.9, 7.0, 9.99, 1e-7, 1e300, 1e-300}) {
    for (const double low : {0.0, -0.3 * high, 0.5 * high}) {
      const std::size_t many = ticks(low, high).size();
      EXPECT_GE(many, 4u) << low << " … " << high;
      EXPECT_LE(many, 11u) << low << " … " << high;
    }
  }
}

// Multiples that digits do not tell apart were gone through for ever.
TEST(Ticks, AreNoneWhereTheEndsDifferByRoundOff) {
  EXPECT_TRUE(ticks(1.0, std::nextafter(1.0, 2.0)).empty());
  EXPECT_TRUE(ticks(-38.1, std::nextafter(-38.1, 0.0)).empty());
}

// The attributes tell a script where a value is drawn: the first point of the line is there.
TEST(SvgChart, SaysWhereItsValuesAre) {
  const std::string svg = svg_chart(chart_of({{1.0, -2.0}, {3.0, 6.0}}));

  const auto across = numbers(svg, "data-across"), up = numbers(svg, "data-up");
  ASSERT_EQ(across.size(), 4u);
  ASSERT_EQ(up.size(), 4u);
  const auto place = [](const std::vector<double>& scale, double value) {
    return scale[2] + (value - scale[0]) / (scale[1] - scale[0]) * (scale[3] - scale[2]);
  };
  std::smatch line;
  ASSERT_TRUE(std::regex_search(svg, line, std::regex("class=\"line\"[^>]* d=\"M([0-9.]+) ([0-9.]+)L")));
  EXPECT_NEAR(std::stod(line[1]), place(across, 1.0), 0.051);
  EXPECT_NEAR(std::stod(line[2]), place(up, -2.0), 0.051);
  EXPECT_LT(across[0], 1.0);
  EXPECT_GT(across[1], 3.0);
  EXPECT_GT(up[2], up[3]);  // y points down
}

TEST(SvgChart, TellsStabilitiesApart) {
  Chart chart = chart_of({{0.0, 0.0}, {1.0, 1.0}});
  EXPECT_EQ(count(svg_chart(chart), "stroke-dasharray"), 0u);
  chart.lines[0].stability = Stability::unstable;
  const std::string dashed = svg_chart(chart);
  chart.lines[0].stability = Stability::undecided;
  const std::string dotted = svg_chart(chart);
  EXPECT_EQ(count(dashed, "stroke-dasharray"), 1u);
  EXPECT_EQ(count(dotted, "stroke-dasharray"), 1u);
  EXPECT_NE(dashed, dotted);
}

// The head's tip is the last point of the line, and its corners lie before it.
TEST(SvgChart, AnArrowHasItsHeadAtTheEnd) {
  Chart chart = chart_of({{0.0, 1.0}, {3.0, 1.0}});
  chart.lines[0].is_arrow = true;
  const std::string svg = svg_chart(chart);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      svg, found, std::regex("d=\"M([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)M([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)L")));
  EXPECT_EQ(found[7], found[3]);
  EXPECT_EQ(found[8], found[4]);
  EXPECT_LT(std::stod(found[5]), std::stod(found[3]));
  EXPECT_NE(found[6], found[4]);
  chart.lines[0].points.pop_back();
  EXPECT_EQ(svg_chart(chart).find("nan"), std::string::npos);
}

TEST(SvgChart, StepsThatCannotBeSeenAreLeftOut) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 100'000; ++i) points.emplace_back(i * 1e-5, 0.5 * i * 1e-5);
  EXPECT_LT(svg_chart(chart_of(points)).size(), 40'000u);
}

TEST(SvgChart, WhatIsNotFiniteInterruptsTheLine) {
  Chart chart = chart_of({{0.0, 0.0}, {1.0, 1.0}, {std::nan(""), 2.0}, {3.0, infinity}, {4.0, 4.0}, {5.0, 5.0}});
  chart.marks = {{.at = {1.0, 1.0}}, {.at = {infinity, 1.0}}};

  const std::string svg = svg_chart(chart);

  std::smatch line;
  ASSERT_TRUE(std::regex_search(svg, line, std::regex("class=\"line\"[^>]* d=\"([^\"]*)\"")));
  EXPECT_EQ(count(line[1], "M"), 2u);
  EXPECT_EQ(count(svg, "class=\"open mark\""), 1u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(SvgChart, OnePointOrNoneHasARangeAllTheSame) {
  for (const auto& points : {std::vector<Vec2>{}, std::vector<Vec2>{{2.0, 0.0}}}) {
    const auto across = numbers(svg_chart(chart_of(points)), "data-across");
    ASSERT_EQ(across.size(), 4u);
    EXPECT_LT(across[0], across[1]);
  }
}

TEST(SvgChart, TextsAreNoMarkup) {
  Chart chart = chart_of({{0.0, 0.0}, {1.0, 1.0}});
  chart.name = chart.across = chart.up = "<b \"&'>";
  chart.marks = {{.text = "<script>"}};

  const std::string svg = svg_chart(chart);

  EXPECT_EQ(count(svg, "&lt;b &quot;&amp;&#39;&gt;"), 3u);
  EXPECT_EQ(count(svg, "<script>"), 0u);
}

TEST(EventMarks, NoTwoKindsLookAlike) {
  const auto look = [](EventKind kind) { return svg_mark(kind); };
  for (int i = 0; i <= static_cast<int>(EventKind::user); ++i) {
    EXPECT_FALSE(meaning(static_cast<EventKind>(i)).empty());
    for (int j = 0; j < i; ++j) EXPECT_NE(look(static_cast<EventKind>(i)), look(static_cast<EventKind>(j)));
  }
}

}  // namespace
}  // namespace arcwall::svg_chart_test
