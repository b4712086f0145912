// Contact with friction at many nodes: which of them stick and which slip is found where loads turn, by closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/apps/loading/loading_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::loading_test {

using namespace test::tables;

namespace {

double monitored_at_end(const TracedDeck& run, std::size_t which) { return run.record().points.back().monitors[which]; }

// A rail of 10 m that its weight presses on a rough floor; w = 10 kN/m, μ = 0.5.
std::string rail(int elements, const std::string& support, const std::string& loads, const std::string& stages) {
  return fmt::format(R"(
title = "Rail on a rough floor"
units = {{ length = "m", force = "N" }}
material.m = {{ E = 2e11, expansion = 1e-5 }}
section.s = {{ shape = "rectangle", width = 0.1, height = 0.1 }}
point = {{ a = [0.0, 0.0], b = [10.0, 0.0] }}
{}
path = {{ branches = "primary" }}
member.rail = {{ from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = {} }}
wall = [{{ name = "floor", side = "below", contact_surface = "axis", profile = {{ type = "flat", z = 0.0 }}, friction = 0.5 }}]
monitor = [{{ name = "x", at = "b", component = "x" }}, {{ name = "N", at = "rail:0.5", component = "axial-force" }}]
[[load]]
on = "rail"
distributed = [0.0, -1.0e4]
constant = true
{}
{})",
                     support, elements, loads, stages);
}

}  // namespace

// Heated by T its ends slip over the length EA α T/(μ w) = 2 m each, which grow by α T · 2 m/2; cooled by T half of
// that takes itself back, and the middle bears nothing. Half of it at a plane of symmetry does the same.
TEST(RoughFloor, ARailIsHeatedAndCooledSlow) {
  const std::string heat = "[[load]]\non = \"rail\"\ntemperature = 1.0\n",
                    stages = stage("heat", "load.1", 0.01, -1.0, 0.5) + stage("cool", "load.1", -0.01, -0.5, 1.0);
  for (const int elements : {20, 40, 60}) {
    const TracedDeck whole(rail(elements, "", heat, stages));
    ASSERT_EQ(whole.record().points.back().lambda, -0.5) << elements;
    const double end = 1e-5 * 0.5 * 2.0 / 4.0, element = 10.0 / elements / 2.0;
    EXPECT_NEAR(monitored_at_end(whole, 0), end, 0.5 * element * element * end) << elements;
    EXPECT_NEAR(monitored_at_end(whole, 1), 0.0, 1e-6) << elements;
    expect_confirmed(whole);
  }
  const TracedDeck half(rail(60, "support = { a = \"symmetry-x\" }", heat, stages));
  ASSERT_EQ(half.record().points.back().lambda, -0.5);
}

// Pulled at one end by F = 40 kN it slips over F/(μ w) = 8 m and comes out by F²/(2 EA μ w) = 0.08 mm; pushed back by
// as much it comes to the same on the other side.
TEST(RoughFloor, ARailIsPulledAndPushedSlow) {
  const std::string pull = "[[load]]\nat = \"b\"\nforce = [400.0, 0.0]\n",
                    stages = stage("pull", "load.1", 1.0, -1.0, 100.0) + stage("push", "load.1", -1.0, -200.0, 1.0);
  for (const int elements : {30, 40}) {
    const TracedDeck run(rail(elements, "support = { a = [\"x\"] }", pull, stages));
    ASSERT_EQ(run.record().points.back().lambda, -200.0) << elements;
    const double F = 4.0e4, out = F * F / (2.0 * 2e9 * 5e3);
    EXPECT_NEAR(monitored_at_end(run, 0), -out, 5e-3 * out) << elements;
    expect_confirmed(run);
  }
}

// Two blocks of steel in series with springs of 100 N/m, which are softer by 2e7: each end of each slips at 3 N.
TEST(RoughFloor, StiffBlocksSlipOneEndAfterTheOther) {
  const TracedDeck run(
      title("Blocks in series") + units("m", "N") + material("m", 2e11) + rectangle("block", 0.1, 0.1) +
      general_section("spring", 5e-10, 1e-10) +
      points({{"a", 0.0, 0.0}, {"b", 1.0, 0.0}, {"c", 2.0, 0.0}, {"e", 3.0, 0.0}, {"d", 4.0, 0.0}}) +
      path(R"(branches = "primary"; stop = { lambda = [-2.0, 2.0] })") +
      member("p", "a", "b", "euler-bernoulli", 1, "", "m", "block") +
      member("q", "c", "e", "euler-bernoulli", 1, "", "m", "block") +
      member("k1", "b", "c", "truss", 1, R"(strain = "engineering")", "m", "spring") +
      member("k2", "e", "d", "truss", 1, R"(strain = "engineering")", "m", "spring") +
      distributed("p", 0.0, -20.0, constant) + distributed("q", 0.0, -20.0, constant) +
      prescribed("d", "x = 0.5; z = 0.0") +
      flat_wall("floor", "below", 0.0, R"(contact_surface = "axis"; members = ["p", "q"]; friction = 0.3)"));
  const auto slips = events_of(run, EventKind::contact_slips);
  ASSERT_EQ(slips.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const double pulled = 3.0 * double(i + 1), held_back = i < 2 ? 0.0 : 6.0;  // of the blocks, of the one behind
    const double way = pulled / 100.0 + (i < 2 ? 0.0 : (pulled - held_back) / 100.0);
    EXPECT_NEAR(slips[i].lambda, way / 0.5, 1e-4 * way) << i;
  }
  EXPECT_EQ(run.record().points.back().lambda, 2.0);
  expect_confirmed(run);
}

// An A-frame whose feet slip apart until its ridge lies on the floor: what touches there holds from then on.
TEST(RoughFloor, AFrameCollapsesOnItsFloor) {
  const TracedDeck run(title("A-frame collapses") + material("m", 2e9) + general_section("s", 0.01, 1e-6) +
                       points({{"a", -1.0, 0.0}, {"t", 0.0, 1.0}, {"b", 1.0, 0.0}}) +
                       path("step = 1.0; stop = { lambda = [-1.0, 60.0] }") + bar("l", "a", "t") + bar("r", "t", "b") +
                       table("[[spring]]", R"(between = ["a", "b"]; stiffness = { x = 20.0 })") +
                       flat_wall("floor", "below", 0.0, rough(0.4)) + monitor("ridge", "t", "z") +
                       force("a", 0.0, -10.0, constant) + force("b", 0.0, -12.0, constant) + force("t", 0.0, -1.0));
  EXPECT_EQ(run.record().points.back().lambda, 60.0);
  EXPECT_NEAR(monitored_at_end(run, 0), -1.0, 1e-12);
  EXPECT_EQ(run.record().points.back().count.unstable, Index{0});
  expect_confirmed(run);
}

// Blocks in series by springs, on a slope that is steeper than their friction holds, are pushed up by a support and
// drawn down again. The state at the end of each stage has the least of elastic energy, work of the weights and μ N |u
// − u₀|, u₀ from the stage before: every block moves one way in a stage.
TEST(RoughFloor, BlocksOnASlopeArePushedUpAndDrawnDown) {
  constexpr int n = 8;
  constexpr double stiffness = 40.0, mu = 0.3, slope = 0.37;
  const double per_length = 1.0 / std::sqrt(1.0 + slope * slope);
  const std::vector<double> weights{0.7, 1.25, 1.36, 0.97, 1.1, 0.8, 1.3, 0.5};
  std::string text = fmt::format(R"(
title = "Blocks on a slope"
material.m = {{ E = {} }}
section.s = {{ shape = "general", A = 1.0, I = 1.0 }}
wall = [{{ name = "hill", side = "below", contact_surface = "axis", profile = {{ type = "line", z = 0.0, slope = {} }}, friction = {} }}]
monitor = [{{ name = "last", at = "p{}", component = "x" }}]
path = {{ branches = "primary" }}
[point]
p0 = [0.0, 0.0]
)",
                                 stiffness / per_length, slope, mu, n);
  std::string members;
  for (int i = 1; i <= n; ++i) {
    text += fmt::format("p{} = [{}.0, {:.17g}]\n", i, i, slope * i);
    members += fmt::format(
        "[member.m{}]\nfrom = \"p{}\"\nto = \"p{}\"\ntheory = \"truss\"\nstrain = \"engineering\"\n"
        "material = \"m\"\nsection = \"s\"\nelements = 1\n[[load]]\nat = \"p{}\"\n"
        "force = [0.0, -{}]\nconstant = true\n",
        i, i - 1, i, i, weights[static_cast<std::size_t>(i - 1)]);
  }
  const double up = 0.32, down = 0.42;
  text += members +
          fmt::format("[[prescribed]]\nat = \"p0\"\nx = {:.17g}\nz = {:.17g}\n", per_length, slope * per_length) +
          stage("up", "prescribed.0", 0.01, -9.0, up) + stage("down", "prescribed.0", -0.01, -down, 9.0);

  std::vector<double> u(n + 1, 0.0);
  const auto least = [&](double driven) {
    const std::vector<double> from = u;
    u[0] = driven;
    for (int sweep = 0; sweep < 20000; ++sweep)
      for (std::size_t i = 1; i <= n; ++i) {
        const double weight = weights[i - 1], held = mu * weight * per_length;
        const double k = i < n ? 2.0 * stiffness : stiffness;
        const double pull = stiffness * (u[i - 1] + (i < n ? u[i + 1] : 0.0)) - weight * slope * per_length;
        const double excess = pull - k * from[i];
        u[i] = from[i] + (excess > held ? excess - held : excess < -held ? excess + held : 0.0) / k;
      }
  };
  least(0.0);
  least(up);
  least(up - down);
  const TracedDeck run(text);
  ASSERT_EQ(run.record().points.back().lambda, -down);
  EXPECT_NEAR(monitored_at_end(run, 0), u[n] * per_length, 1e-7);
  expect_confirmed(run);
}

}  // namespace arcwall::loading_test
