// Points of walls that are lists, files and scans with noise.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/cubic_spline.hpp"
#include "core/text.hpp"
#include "model/deck/given_points.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/smoothing.hpp"
#include "model/deck/writer.hpp"
#include "tests/model/deck/bad_decks.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::deck::given_points_test {

namespace {

namespace fs = std::filesystem;

std::string column_with(const std::string& shape) {
  return std::string(column_deck) + "\n[[wall]]\nname = \"w\"\n" + shape + "\n";
}

class GivenPointsTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "scans"); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }

  std::string error_of(const std::string& deck) const {
    try {
      read_deck(put("deck.toml", deck));
    } catch (const InputError& error) {
      EXPECT_EQ(error.diagnostics().size(), 1U) << bad_decks_test::all_of(error.diagnostics());
      std::string text = to_text(error.diagnostics().front());
      for (std::size_t at = text.find(folder_.string()); at != std::string::npos; at = text.find(folder_.string()))
        text.erase(at, folder_.string().size() + 1);
      return text;
    }
    return "none";
  }

  fs::path folder_ = fs::temp_directory_path() / ("given_points_" + std::to_string(::getpid()));
};

const std::string lists = "side = \"above\"\nprofile = { type = \"spline\", x = [0.0, 1.0, 2.0], z = [0.5, 0.6, 0.5] }";

// The greatest distance of points from a line with many vertices.
double farthest(const std::vector<Vec2>& points, const std::vector<Vec2>& line) {
  double greatest = 0.0;
  for (const Vec2& p : points) {
    double least = 1e300;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Vec2 side = line[i + 1] - line[i];
      const double ahead = std::clamp((p - line[i]).dot(side) / side.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - line[i] - ahead * side).norm());
    }
    greatest = std::max(greatest, least);
  }
  return greatest;
}

std::vector<Vec2> scan_of_circle(double radius, double from, double to, std::size_t count, double noise) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-noise, noise);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
    const double r = radius + off(random);
    points.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return points;
}

}  // namespace

TEST_F(GivenPointsTest, AreThoseOfTwoLists) {
  const Deck deck = read_deck_text(column_with(lists), "d");
  const std::string of_points = "side = \"above\"\nprofile = { type = \"spline\", points = ";
  EXPECT_EQ(read_deck_text(column_with(of_points + "[[0.0, 0.5], [1.0, 0.6], [2, 0.5]] }"), "d"), deck);
  for (const char* text :
       {"0,0.5\n1,0.6\n2,0.5\n", "x,z\n0.0; 0.5\r\n\n# top\n1\t6e-1\n2 0.5 # end", "\n0,0.5\n1,0.6\n2,0.5"}) {
    put("scans/a.csv", text);
    EXPECT_EQ(read_deck(put("deck.toml", column_with(of_points + "\"scans/a.csv\" }"))), deck) << text;
  }
  const Deck with_variable =
      read_deck_text(column_with(of_points + "[[0.0, \"h\"], [1.0, 0.6], [2.0, \"h\"]] }\n[variables]\nh = 0.5"), "d");
  EXPECT_EQ(with_variable.walls, deck.walls);
  EXPECT_EQ(read_deck_text(to_toml(with_variable), "d"), with_variable);
}

// The text of the deck then needs the file no more, and lines stay where they were.
TEST_F(GivenPointsTest, OfAFileStandInTheTextThatIsRun) {
  put("scans/a.csv", "0,0\n0.125,-0.5\n0.3,-0.5\n");
  const std::string shape =
      "contact_surface = \"axis\"\noutline.type = \"curve\"\noutline.points = 'scans/a.csv' # é\n";
  const std::string file = put("deck.toml", "# é λ\n" + column_with(shape));
  const std::string text = read_deck_file(file);
  EXPECT_NE(text.find("outline.points = [[0, 0], [0.125, -0.5], [0.3, -0.5]] # é\n"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), std::count(column_deck.begin(), column_deck.end(), '\n') + 8);
  const Deck deck = read_deck(file);
  fs::remove_all(folder_ / "scans");
  EXPECT_EQ(read_deck_text(text, "elsewhere.toml"), deck);
  EXPECT_EQ(std::get<CurveOutline>(*deck.walls.at(0).outline).z, (std::vector<double>{0.0, -0.5, -0.5}));
}

TEST_F(GivenPointsTest, ThatAreWrongAreSaid) {
  const std::string spline = "side = \"above\"\nprofile = { type = \"spline\", points = ";
  const auto of_file = [&](const std::string& text) {
    put("a.csv", text);
    return error_of(column_with(spline + "\"a.csv\" }"));
  };
  const std::string at = "deck.toml:34:39: wall.0.profile.points: ";
  EXPECT_EQ(of_file("0,1\n1,a\n"),
            at + "a.csv:2 has no two numbers in \"1,a\"; write x and z with decimal points, and a "
                 "comma between them");
  EXPECT_EQ(of_file("x,z\ny\n"),
            at + "a.csv:2 has no two numbers in \"y\"; write x and z with decimal points, and a comma "
                 "between them");
  EXPECT_EQ(of_file("0,5;1,5\n"),
            at + "a.csv:1 has no two numbers in \"0,5;1,5\"; write x and z with decimal points, and a "
                 "comma between them");
  EXPECT_EQ(of_file(""), at + "a.csv has fewer than 2 points; give a line with x and z for each");
  EXPECT_EQ(error_of(column_with(spline + "\"none.csv\" }")),
            at + "none.csv there is no such file; name the file from the folder of the deck");
  EXPECT_EQ(error_of(column_with(spline + "[[0, 1], [2]] }")),
            at + "an array of 2 is no list of points; give [[x, z], …], or the name of a CSV file in quotes");
  EXPECT_EQ(error_of(column_with(spline + "[[0, 1], [2, 1]], x = [1.0] }")),
            at + "stand beside x and z; keep one of them");
  EXPECT_EQ(error_of(column_with(spline + "[[0, 1], [2, 1]], smoothing = 0 }")),
            "deck.toml:34:69: wall.0.profile.smoothing: 0 is no tolerance; give a number greater than 0");
  EXPECT_EQ(
      error_of(column_with(spline + "[[0, 1], [1, 0], [2, 1]], smoothing = 1e-9 }")),
      "deck.toml:34:77: wall.0.profile.smoothing: no curve with a third of the points stays within 1e-09 of them; give "
      "a greater tolerance, or leave out smoothing");
  EXPECT_NE(error_of(column_with("outline = { type = \"polyline\", points = [[0, 1], [1, 0]], smoothing = 0.1 }"))
                .find("not a key"),
            std::string::npos);
}

// Half a circle, and a whole one, with noise: the curve is within the tolerance of all points and bends like the
// circle.
TEST(Smoothing, OfACircleWithNoiseIsACircle) {
  const double pi = std::numbers::pi, noise = 1e-3, tolerance = 2e-3;
  for (const bool is_ring : {false, true}) {
    std::vector<Vec2> scan = scan_of_circle(1.0, 0.0, is_ring ? 2.0 * pi : pi, 801, noise);
    if (is_ring) scan.pop_back();
    const auto found = smoothed(scan, tolerance, is_ring ? AlongPoints::ring : AlongPoints::chord);
    ASSERT_TRUE(found);
    EXPECT_LT(found->size(), 20U);
    std::vector<Vec2> around = *found;
    const std::size_t count = found->size(), first = is_ring ? count : 0, last = is_ring ? 2 * count : count - 1;
    if (is_ring) {
      around.insert(around.end(), found->begin(), found->end());
      around.insert(around.end(), found->begin(), found->end());
    }
    std::vector<double> s{0.0}, x, z;
    for (std::size_t i = 1; i < around.size(); ++i) s.push_back(s.back() + (around[i] - around[i - 1]).norm());
    for (const Vec2& p : around) x.push_back(p.x()), z.push_back(p.y());
    const CubicSpline of_x(s, x), of_z(s, z);
    std::vector<Vec2> line;
    for (int i = 0; i <= 1000; ++i) {
      const double t = s[first] + (s[last] - s[first]) * i / 1000.0;
      const auto a = of_x.at(t), b = of_z.at(t);
      line.emplace_back(a[0], b[0]);
      EXPECT_NEAR(line.back().norm(), 1.0, tolerance);
      const double curvature = (a[1] * b[2] - b[1] * a[2]) / std::pow(std::hypot(a[1], b[1]), 3);
      if (is_ring || (i > 100 && i < 900)) {
        EXPECT_NEAR(curvature, 1.0, 0.1);
      }
    }
    EXPECT_LE(farthest(scan, line), tolerance + 1e-5);  // the sag of the line's chords is 5e-6
  }
}

// A cubic is reached exactly, whatever the tolerance.
TEST(Smoothing, OfACubicIsTheCubic) {
  std::vector<Vec2> points;
  const auto cubic = [](double x) { return 0.3 - x + 0.5 * x * x - 0.2 * x * x * x; };
  for (int i = 0; i <= 30; ++i) points.emplace_back(0.1 * i, cubic(0.1 * i));
  const auto found = smoothed(points, 1e-12, AlongPoints::x);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->size(), 4U);
  for (const Vec2& p : *found) EXPECT_NEAR(p.y(), cubic(p.x()), 1e-13);
}

// A beam pressed onto a hump: a scan with noise of 1e-4 has the events of the hump itself, at loads that differ by no
// more than the tolerance does from the clearance of 0.02.
TEST(Smoothing, LeavesTheEventsOfTheWallItself) {
  const std::string beam = R"toml(
title = "A beam above a hump"
material.m = { E = 21000.0 }
section.s = { shape = "rectangle", width = 0.1, height = 0.1 }
point = { A = [0.0, 0.0], B = [2.0, 0.0] }
support = { A = ["x", "z"], B = ["z"] }
load = [{ on = "beam", distributed = [0.0, -1.0] }]
path = { step = 0.02, stop.lambda = [-0.1, 0.3] }
member.beam = { from = "A", to = "B", theory = "elastica", elements = 16, material = "m", section = "s" }
monitor = [{ name = "mid", at = "beam:0.5", component = "z" }]
wall = [{ name = "hump", side = "below", contact_surface = "axis", profile = )toml";
  const Session exact = test::traced(beam + "{ type = \"parabola\", apex = [1.0, -0.02], curvature = -0.05 } }]\n");
  std::mt19937 random(11);
  std::uniform_real_distribution<double> off(-1e-4, 1e-4);
  std::string points;
  for (int i = 0; i <= 400; ++i) {
    const double x = -0.1 + 2.2 * i / 400.0;
    points += (i > 0 ? ", [" : "[") + round_trip(x) + ", " +
              round_trip(-0.02 - 0.025 * (x - 1.0) * (x - 1.0) + off(random)) + "]";
  }
  const Session scanned =
      test::traced(beam + "{ type = \"spline\", points = [" + points + "], smoothing = 2e-4 } }]\n");
  const auto &expected = exact.record().events, &found = scanned.record().events;
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_GE(found.size(), 3U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].kind, expected[i].kind);
    EXPECT_NEAR(found[i].lambda, expected[i].lambda, 0.02 * std::abs(expected[i].lambda));
  }
}

}  // namespace arcwall::deck::given_points_test
