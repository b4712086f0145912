// A perfect column buckles to either side. Both halves of the pitchfork are alike near it, and mirror images only if
// the walls are.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/model/traced_session.hpp"

namespace arcwall::mirror_images_test {
namespace {

using test::traced;

// EI = 85333.3, L = 100, so that the Euler load is 84.22; contact is on the axis.
std::string column(const std::string& walls, const std::string& contact) {
  return R"toml(
title = "A perfect column"
material.m = { E = 2.0e5 }
section.s = { shape = "rectangle", width = 10.0, height = 0.8 }
point = { a = [0.0, 0.0], b = [100.0, 0.0] }
support = { a = ["x", "z"], b = ["z"] }
load = [{ at = "b", force = [-1.0, 0.0] }]
member.m = { from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = 24 }
path = { step = 10.0, branches = "all", jumps = false, stop = { lambda = [-10.0, 120.0], sh = [-1.0, 10.0] } }
monitor = [{ name = "mid", at = "m:0.5", component = "z" }, { name = "sh", at = "b", component = "x", sign = -1 }]
)toml" + contact +
         "\nwall = [" + walls + "]\n";
}

std::string wall(const std::string& side, double z) {
  return "{ name = \"" + side + "\", side = \"" + side +
         "\", contact_surface = \"axis\", profile = { type = \"flat\", z = " + std::to_string(z) + " } }";
}

}  // namespace

TEST(MirrorImages, AreOfBothSidesWhereWallsAre) {
  for (const std::string contact : {"", "contact = { points = \"nodes\" }"}) {
    SCOPED_TRACE(contact);
    const Session run = traced(column(wall("above", 3.0) + ", " + wall("below", -3.0), contact));
    ASSERT_EQ(run.record().branches.size(), 2U);
    EXPECT_TRUE(run.record().branches[1].mirror_image);
  }
}

// An inextensible elastica whose middle is w aside has P/P_E = 1 + (π w/L)²/8 to the fourth order of w.
TEST(MirrorImages, AreNotOfSidesWithOtherWalls) {
  const double euler = 84.225;
  const auto touches = [&](double w) { return euler * (1.0 + std::pow(M_PI * w / 100.0, 2) / 8.0); };
  for (const std::string contact : {"", "contact = { points = \"nodes\" }"}) {
    SCOPED_TRACE(contact);
    const Session both = traced(column(wall("above", 3.0) + ", " + wall("below", -2.5), contact));
    std::vector<double> touched;
    for (const RecordEvent& event : test::events_of(both.record(), EventKind::contact_closes))
      if (std::abs(event.monitors[0]) < 3.1) touched.push_back(event.lambda);
    ASSERT_GE(touched.size(), 2U);
    EXPECT_NEAR(touched[0], touches(3.0), 1e-4 * euler);
    EXPECT_NEAR(touched[1], touches(2.5), 1e-4 * euler);

    const Session one = traced(column(wall("above", 3.0), contact));
    ASSERT_EQ(one.record().branches.size(), 3U);
    EXPECT_LT(one.record().points.back().monitors[0], -10.0);
  }
}

}  // namespace arcwall::mirror_images_test
