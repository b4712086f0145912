// Members that continue each other are one strand whichever of their ends meet: what is read off them is theirs.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/apps/loading/loading_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::strands_test {

using namespace test::tables;

namespace {

using loading_test::expect_confirmed;
using test::TracedDeck;

// A beam of length 2 on two supports above a floor, bent down by loads of all kinds; `right` is its right half.
std::string beam(const std::string& right, const std::string& loads, const std::string& monitors) {
  return R"(
title = "Beam"
material.m = { E = 1.0, expansion = 1e-2 }
section.s = { shape = "rectangle", width = 12.0, height = 1.0 }
point = { A = [0.0, 0.0], C = [10.0, 0.0], B = [20.0, 0.0] }
support = { A = ["x", "z"], B = ["z"] }
[member]
left = { from = "A", to = "C", theory = "elastica", material = "m", section = "s", elements = 10 }
right = { )" +
         right + R"(, theory = "elastica", material = "m", section = "s", elements = 10 }
[[wall]]
name = "floor"
side = "below"
profile = { type = "flat", z = -0.8 }
[path]
step = 0.02
output_at = { lambda = [0.1, 1.0] }
stop = { lambda = [-0.1, 1.0] }
)" + loads +
         table("[[load]]", R"(on = "left"; pressure = 2e-3)") + distributed("left", 1e-4, 1e-3, R"(frame = "member")") +
         table("[[load]]", R"(on = "left"; gradient = 0.05)") + monitors;
}

const std::string onwards = table("[[load]]", R"(on = "right"; pressure = 2e-3)") +
                            distributed("right", 1e-4, 1e-3, R"(frame = "member")") +
                            table("[[load]]", R"(on = "right"; gradient = 0.05)");

const std::string backwards = table("[[load]]", R"(on = "right"; pressure = -2e-3)") +
                              distributed("right", -1e-4, -1e-3, R"(frame = "member")") +
                              table("[[load]]", R"(on = "right"; gradient = -0.05)");

std::string monitors_at(double fraction, bool reversed) {
  const auto at = fmt::format("at = \"right:{}\"", reversed ? 1.0 - fraction : fraction);
  const std::string sign = reversed ? "sign = -1\n" : "";
  std::string all;
  const auto add = [&](const std::string& name, const std::string& component, bool turns) {
    all +=
        fmt::format("[[monitor]]\nname = \"{}\"\n{}\ncomponent = \"{}\"\n{}", name, at, component, turns ? sign : "");
  };
  add("z", "z", false);
  add("x", "x", false);
  add("rotation", "rotation", false);
  add("upper", reversed ? "face-below-z" : "face-above-z", false);
  add("lower", reversed ? "face-above-z" : "face-below-z", false);
  add("N", "axial-force", false);
  add("M", "moment", true);
  return all;
}

}  // namespace

TEST(Strands, RunThroughMembersOfEitherDirection) {
  const std::string forth = "from = \"C\", to = \"B\"", back = "from = \"B\", to = \"C\"";
  for (const double fraction : {0.3, 0.5}) {
    const TracedDeck one(beam(forth, onwards, monitors_at(fraction, false)));
    const TracedDeck other(beam(back, backwards, monitors_at(fraction, true)));
    ASSERT_EQ(one.model().sliding_structure()->strands(), 1);
    ASSERT_EQ(other.model().sliding_structure()->strands(), 1);
    loading_test::expect_same_events(one, other, 1e-9);
    const Record &a = one.record(), &b = other.record();
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i)
      for (std::size_t m = 0; m < a.points[i].monitors.size(); ++m)
        EXPECT_NEAR(b.points[i].monitors[m], a.points[i].monitors[m], 1e-8 * (1.0 + std::abs(a.points[i].monitors[m])))
            << a.columns[m].name << " at " << a.points[i].lambda;
    expect_confirmed(other);
  }
}

// What is constant loads both halves of a beam alike, λ one of them: they are two strands from the start on, also while
// the constant loads grow. In small slopes the middle sags by 5 q L⁴/384 EI, and a load on a half moves it by half of
// that.
TEST(Strands, AreThoseOfThePathWhileConstantLoadsGrow) {
  const double q = 1e-6, EI = 1.0, L = 20.0, sag = 5.0 * q * L * L * L * L / (384.0 * EI);
  const TracedDeck traced(title("Beam") + material("m", 1.0) + rectangle("s", 12.0, 1.0) +
                          points({{"A", 0.0, 0.0}, {"C", 10.0, 0.0}, {"B", 20.0, 0.0}}) +
                          supports({{"A", "x z"}, {"B", "z"}}) + member("left", "A", "C", "elastica", 10) +
                          member("right", "C", "B", "elastica", 10) + flat_wall("floor", "below", -0.8) +
                          distributed("left", 0.0, -1e-6, constant) + distributed("right", 0.0, -1e-6, constant) +
                          distributed("right", 0.0, 1e-6) +
                          path("step = 0.05; max_step = 0.05; jumps = false; stop = { lambda = [-0.1, 1.0] }") +
                          monitor("middle", "C", "z"));
  EXPECT_NEAR(traced.record().points.front().monitors[0], -sag, 1e-3 * sag);
  EXPECT_NEAR(traced.record().points.back().monitors[0], -0.5 * sag, 1e-3 * sag);
  expect_confirmed(traced);
}

}  // namespace arcwall::strands_test
