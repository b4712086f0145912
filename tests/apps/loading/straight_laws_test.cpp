#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/apps/loading/loading_decks.hpp"

// Springs whose laws are straight pieces, against the closed form of each piece.
namespace arcwall::loading_test {

namespace {

constexpr double EA = 0.01;  // of bars of length 1 that lie across the load

// A bar of Green's strain across its spring and load: λ = f(w) + ½ EA w³ downwards.
double bar(double w) { return 0.5 * EA * w * w * w; }

std::string bars(const std::vector<std::string>& tips) {
  std::string text =
      fmt::format("title = \"Bars\"\nmaterial.m.E = {}\nsection.s = {{ shape = \"general\", A = 1.0, I = 1.0 }}\n", EA);
  for (const std::string& tip : tips)
    text += fmt::format(
        "point.o{0} = [0.0, 0.0]\npoint.{0} = [1.0, 0.0]\nsupport.o{0} = [\"x\", \"z\"]\nsupport.{0} = [\"x\"]\n"
        "member.m{0} = {{ from = \"o{0}\", to = \"{0}\", theory = \"truss\", elements = 1, material = \"m\", section = "
        "\"s\" }}\n",
        tip);
  for (const std::string& tip : tips)
    text += fmt::format("[[monitor]]\nname = \"{0}\"\nat = \"{0}\"\ncomponent = \"z\"\nsign = -1\n", tip);
  return text;
}

std::string ground(const std::string& at, const std::string& u, const std::string& force) {
  return fmt::format(
      "[[spring]]\nname = \"{0}\"\nat = \"{0}\"\nlaw = {{ direction = \"z\", displacement = [{1}], force = [{2}], "
      "interpolation = \"linear\" }}\n",
      at, u, force);
}

std::string down(const std::string& at) { return fmt::format("[[load]]\nat = \"{}\"\nforce = [0.0, -1.0]\n", at); }

// Rises to 0.7 at 0.2, falls to 0.2 at 0.5, rises to 1.2 at 1.
std::string softening(const std::string& at) {
  return ground(at, "-1.0, -0.5, -0.2, 0.0, 0.2, 0.5, 1.0", "-1.2, -0.2, -0.7, 0.0, 0.7, 0.2, 1.2");
}

double softening_force(double w) {
  if (w <= 0.2) return 3.5 * w;
  if (w <= 0.5) return 0.7 - 0.5 / 0.3 * (w - 0.2);
  return w <= 1.0 ? 0.2 + 2.0 * (w - 0.5) : 1.2;
}

std::string path_to(double step, double max_step, const std::string& stop, const std::string& more = "") {
  return fmt::format("[path]\nstep = {}\nmax_step = {}\n{}\n[path.stop]\n{}\n", step, max_step, more, stop);
}

const RecordPoint* point_with(const TracedDeck& traced, std::size_t monitor, double value) {
  const auto& points = traced.record().points;
  const auto found = std::find_if(points.begin(), points.end(), [&](const RecordPoint& point) {
    return std::abs(point.monitors[monitor] - value) < 1e-9;
  });
  return found == points.end() ? nullptr : &*found;
}

}  // namespace

// A law of points on a line is a stiffness, up to where it ends: 3 EI/L³ + 10 of the tip in small slopes.
TEST(StraightLaws, AreWhatPointsMeanUnasked) {
  const auto tip = [](const std::string& spring) {
    const TracedDeck traced(R"(
title = "Cantilever on a spring"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1000.0, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "z", "rotation"] }
member.s = { from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = 8 }
load = [{ at = "b", force = [0.0, -1.0] }]
monitor = [{ name = "tip", at = "b", component = "z" }]
path = { step = 0.05, stop = { lambda = [-0.1, 0.2] } }
[[spring]]
at = "b"
)" + spring);
    return traced.record().points.back().monitors[0];
  };
  const double stiff = tip("stiffness = { z = 10.0 }");
  EXPECT_NEAR(stiff, -0.2 / 13.0, 1e-5);
  const std::string law = "law = { direction = \"z\", displacement = [-0.05, 0.0, 0.05], force = [-0.5, 0.0, 0.5]";
  EXPECT_NEAR(tip(law + " }"), stiff, 1e-12);
  EXPECT_GT(std::abs(tip(law + ", interpolation = \"smooth\" }") - stiff), 1e-4);
}

TEST(StraightLaws, MakeLimitPointsAtTheirKinksWhateverTheStep) {
  for (const double max_step : {0.02, 0.2, 1.0, 10.0}) {
    SCOPED_TRACE(max_step);
    const TracedDeck traced(bars({"b"}) + softening("b") + down("b") + path_to(0.05, max_step, "b = [-2.0, 1.2]"));
    const auto limits = events_of(traced, EventKind::contact_limit_point);
    ASSERT_EQ(limits.size(), 2u);
    EXPECT_TRUE(events_of(traced, EventKind::limit_point).empty());
    EXPECT_NEAR(limits[0].monitors[0], 0.2, 1e-9);
    EXPECT_NEAR(limits[0].lambda, 0.7 + bar(0.2), 1e-9);
    EXPECT_EQ(limits[0].unstable_before, 0);
    EXPECT_EQ(limits[0].unstable_after, 1);
    EXPECT_NEAR(limits[1].monitors[0], 0.5, 1e-9);
    EXPECT_NEAR(limits[1].lambda, 0.2 + bar(0.5), 1e-9);
    EXPECT_EQ(limits[1].unstable_before, 1);
    EXPECT_EQ(limits[1].unstable_after, 0);
    for (const RecordPoint& point : traced.record().points)
      EXPECT_NEAR(point.lambda, softening_force(point.monitors[0]) + bar(point.monitors[0]), 1e-9);
    EXPECT_NE(point_with(traced, 0, 1.0), nullptr) << "the kink behind which the spring yields is not met";
    expect_confirmed(traced);
  }
}

// The law is odd: downwards and upwards the same, and back over its kinks.
TEST(StraightLaws, ArePassedInBothSenses) {
  const TracedDeck up(bars({"b"}) + softening("b") + down("b") + path_to(-0.05, 0.3, "b = [-1.2, 2.0]"));
  const auto limits = events_of(up, EventKind::contact_limit_point);
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_NEAR(limits[0].lambda, -0.7 - bar(0.2), 1e-9);
  EXPECT_NEAR(limits[1].lambda, -0.2 - bar(0.5), 1e-9);

  // Held, beside a bar that is free, pushed down in the first stage, brought back in the second.
  const TracedDeck back(bars({"b", "c"}) + softening("b") + "[[spring]]\nat = \"c\"\nstiffness = { z = 1.0 }\n" +
                        "[[prescribed]]\nat = \"b\"\nz = -1.0\n"
                        "[[monitor]]\nname = \"force\"\nspring = \"b\"\ncomponent = \"force-z\"\n"
                        "[[monitor]]\nname = \"support\"\nat = \"b\"\ncomponent = \"reaction-z\"\n"
                        "[[stage]]\nname = \"down\"\ndrives = [\"prescribed.0\"]\nstep = 0.05\nmax_step = 0.3\nstop = "
                        "{ lambda = [-2.0, 0.8] }\n"
                        "[[stage]]\nname = \"up\"\ndrives = [\"prescribed.0\"]\nstep = -0.05\nmax_step = 0.3\nstop = { "
                        "lambda = [-0.8, 1.0] }\n");
  for (const RecordPoint& point : back.record().points) {
    EXPECT_NEAR(point.monitors[2], -softening_force(point.monitors[0]), 1e-9);
    EXPECT_NEAR(point.monitors[3], point.monitors[2] - bar(point.monitors[0]), 1e-9);
    EXPECT_EQ(point.count.unstable, 0);
  }
  for (const double kink : {0.2, 0.5}) EXPECT_NE(point_with(back, 0, kink), nullptr) << kink;
  EXPECT_NEAR(back.record().points.back().monitors[0], 0.0, 1e-9);
  expect_confirmed(back);
}

// A gap that closes at −0.1 and none upwards: λ grows with the second stiffness at once, and falls with the first.
TEST(StraightLaws, MayHaveAKinkAtRest) {
  for (const double sense : {1.0, -1.0}) {
    const TracedDeck traced(bars({"b"}) + ground("b", "-1.0, 0.0, 1.0", "-3.0, 0.0, 1.0") + down("b") +
                            path_to(0.05 * sense, 0.5, "b = [-0.9, 0.9]"));
    for (const RecordPoint& point : traced.record().points) {
      const double w = point.monitors[0];
      EXPECT_NEAR(point.lambda, (w > 0.0 ? 3.0 : 1.0) * w + bar(w), 1e-9);
      EXPECT_EQ(point.count.unstable, 0);
    }
    EXPECT_NEAR(std::abs(traced.record().points.back().monitors[0]), 0.9, 1e-9);
    expect_confirmed(traced);
  }
}

// Two bars that know nothing of each other, with one load: both kinks are met at once.
TEST(StraightLaws, OfAlikeSpringsHaveTheirKinksTogether) {
  const std::string hardening = "-1.0, -0.2, 0.0, 0.2, 1.0", forces = "-3.0, -0.2, 0.0, 0.2, 3.0";
  for (const double max_step : {0.05, 1.0}) {
    const TracedDeck traced(bars({"a", "b"}) + ground("a", hardening, forces) + ground("b", hardening, forces) +
                            down("a") + down("b") + path_to(0.05, max_step, "a = [-2.0, 0.8]"));
    for (const RecordPoint& point : traced.record().points) {
      const double w = point.monitors[0];
      EXPECT_NEAR(point.monitors[1], w, 1e-9);
      EXPECT_NEAR(point.lambda, (w < 0.2 ? w : 0.2 + 3.5 * (w - 0.2)) + bar(w), 1e-9);
    }
    EXPECT_NE(point_with(traced, 0, 0.2), nullptr);
    expect_confirmed(traced);
  }
}

// Of two alike springs that soften one softens and the other goes back: one unstable direction, not two. Either may,
// so that branches leave there; λ turns.
TEST(StraightLaws, OfAlikeSpringsThatSoftenBifurcateAtTheirKinks) {
  for (const double max_step : {0.05, 1.0}) {
    const TracedDeck traced(bars({"a", "b"}) + softening("a") + softening("b") + down("a") + down("b") +
                            path_to(0.05, max_step, "lambda = [-1.0, 2.0]\na = [-2.0, 0.4]\nb = [-2.0, 0.4]"));
    const auto& limit = event_of(traced, EventKind::contact_limit_point);
    EXPECT_NEAR(limit.lambda, 0.7 + bar(0.2), 1e-9);
    EXPECT_EQ(limit.unstable_after, 1);
    EXPECT_EQ(event_of(traced, EventKind::branch_point).branch_type, BranchType::one_sided);
    for (const RecordPoint& point : traced.record().points)
      for (const std::size_t i : {0u, 1u})
        EXPECT_NEAR(point.lambda, softening_force(point.monitors[i]) + bar(point.monitors[i]), 1e-9);
    expect_confirmed(traced);
  }
}

// Between two points the difference of the displacements counts.
TEST(StraightLaws, ActBetweenPoints) {
  const TracedDeck traced(
      bars({"a", "b"}) + "[[spring]]\nat = \"a\"\nstiffness = { z = 2.0 }\n" +
      "[[spring]]\nbetween = [\"a\", \"b\"]\nlaw = { direction = \"z\", displacement = [-0.6, -0.2, "
      "0.0, 0.2], force = [-0.3, -0.7, 0.0, 0.7], interpolation = \"linear\" }\n" +
      down("b") + path_to(0.05, 0.5, "b = [-2.0, 0.9]"));
  const auto& limit = event_of(traced, EventKind::contact_limit_point);
  // The spring has 0.7 where b has moved by 0.2 against a; the bar of b bears its own part.
  const double a = limit.monitors[0], b = limit.monitors[1];
  EXPECT_NEAR(b - a, 0.2, 1e-9);
  EXPECT_NEAR(2.0 * a + bar(a), 0.7, 1e-9);
  EXPECT_NEAR(limit.lambda, 0.7 + bar(b), 1e-9);
  expect_confirmed(traced);
}

// A constant load that takes the spring over its first kink before the path begins.
TEST(StraightLaws, AreFollowedWhileConstantLoadsGrow) {
  const TracedDeck traced(bars({"b"}) + ground("b", "-1.0, -0.2, 0.0, 1.0", "-3.0, -0.2, 0.0, 1.0") +
                          "[[load]]\nat = \"b\"\nforce = [0.0, -0.9]\nconstant = true\n" + down("b") +
                          path_to(0.05, 0.5, "lambda = [-1.0, 1.0]"));
  for (const RecordPoint& point : traced.record().points) {
    const double w = point.monitors[0];
    EXPECT_NEAR(0.9 + point.lambda, 0.2 + 3.5 * (w - 0.2) + bar(w), 1e-9);
  }
  expect_confirmed(traced);
}

// By the force at the softening kink λ moves as the law says: λ = F + ½ EA u³.
TEST(StraightLaws, HaveSensitivitiesAtTheirKinks) {
  const TracedDeck traced(bars({"b"}) + softening("b") + down("b") +
                          path_to(0.05, 0.5, "b = [-2.0, 0.8]", "sensitivity = [\"material.m.E\"]"));
  const auto& limit = event_of(traced, EventKind::contact_limit_point);
  ASSERT_EQ(limit.sensitivity.size(), 1u);
  ASSERT_TRUE(limit.sensitivity[0].slope);
  EXPECT_NEAR(*limit.sensitivity[0].slope, bar(0.2) / EA, 1e-9);
}

// A moment turns the end of a cantilever against a spring whose law has kinks, until the end touches a ceiling: contact
// at moving points and at nodes of a finer mesh agree.
TEST(StraightLaws, OfARotationGoBesideMovingContact) {
  const std::string deck = R"(
title = "A turned end below a ceiling"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e4, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "z", "rotation"] }
member.l = { from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 8 }
load = [{ at = "b", moment = 2.0 }]
monitor = [{ name = "turns", at = "b", component = "rotation" }]
path = { step = 0.05, stop = { lambda = [-2.0, 1.0] } }
spring = [{ at = "b", law = { direction = "rotation", displacement = [-1.0, -0.1, 0.0, 0.1, 1.0], force = [-4.0, -1.0, 0.0, 1.0, 1.9] } }]
wall = [{ name = "ceiling", contact_surface = "axis", outline = { type = "half-plane", point = [0.0, 0.15], normal = [0.0, -1.0] } }]
)";
  const TracedDeck moving(deck), nodes(deck, {"contact.points=\"nodes\"", "member.l.elements=64"});
  EXPECT_EQ(moving.record().points.back().lambda, 1.0);
  EXPECT_EQ(events_of(moving, EventKind::contact_closes).size(), 1u);
  EXPECT_NEAR(moving.record().points.back().monitors.at(0), nodes.record().points.back().monitors.at(0), 1e-4);
  expect_confirmed(moving);
}

}  // namespace arcwall::loading_test
