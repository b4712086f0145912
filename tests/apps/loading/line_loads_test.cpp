// Loads along members that vary linearly or are given by length of plan, against formulas by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::line_loads_test {

using namespace test::tables;
namespace {

using test::TracedDeck;

// A cantilever along x of length 2 under a load of 1e-6 at most: EI = 1, so that w/L is so small that its square is
// below round-off of what is compared.
std::string cantilever(const std::string& theory, const std::string& load) {
  return R"toml(
title = "A cantilever"
material.m = { E = 1.0, nu = 0.0 }
section.s = { shape = "general", A = 1e4, I = 1.0 }
point = { a = [0.0, 0.0], b = [2.0, 0.0] }
support = { a = ["x", "z", "rotation"] }
path = { method = "load", step = 1.0, stop = { lambda = [-0.5, 1.0] } }
monitor = [{ name = "w", at = "b", component = "z" }, { name = "R", at = "a", component = "reaction-z" }, { name = "M", at = "a", component = "reaction-moment" }]
member.beam = { from = "a", to = "b", elements = 8, material = "m", section = "s", )toml" +
         theory + " }\n" + load;
}

void expect_last(const TracedDeck& run, double w, double R, double M, double tolerance) {
  const std::vector<double>& monitors = run.record().points.back().monitors;
  EXPECT_NEAR(monitors.at(0), w, tolerance * std::abs(w));
  EXPECT_NEAR(monitors.at(1), R, 1e-9 * std::abs(R));
  EXPECT_NEAR(std::abs(monitors.at(2)), std::abs(M), tolerance * std::abs(M));
}

constexpr double q = 1e-6, L = 2.0;

}  // namespace

// Greatest at the clamp: q L⁴/30, q L/2, q L²/6; at the tip: 11 q L⁴/120, q L/2, q L²/3.
TEST(LineLoads, OfATriangleBendACantileverAsInTheTextbook) {
  for (const char* theory : {"theory = \"euler-bernoulli\"", "theory = \"elastica\""}) {
    const TracedDeck to_tip(
        cantilever(theory, "load = [{ on = \"beam\", distributed = [0.0, -1e-6], distributed_to = [0.0, 0.0] }]\n"));
    expect_last(to_tip, -q * std::pow(L, 4) / 30.0, 0.5 * q * L, q * L * L / 6.0, 1e-8);
    test::expect_whole(to_tip);
    const TracedDeck from_clamp(
        cantilever(theory, "load = [{ on = \"beam\", distributed = [0.0, 0.0], distributed_to = [0.0, -1e-6] }]\n"));
    expect_last(from_clamp, -11.0 * q * std::pow(L, 4) / 120.0, 0.5 * q * L, q * L * L / 3.0, 1e-8);
  }
}

// Across the axis, as half constant and half driven, in two stages: the same load.
TEST(LineLoads, AddUpHoweverTheyAreBroughtOn) {
  const std::string half = "distributed = [0.0, -0.5e-6], distributed_to = [0.0, 0.0], frame = \"member\"";
  const TracedDeck constant(
      cantilever("theory = \"elastica\"",
                 "load = [{ on = \"beam\", " + half + ", constant = true }, { on = \"beam\", " + half + " }]\n"));
  expect_last(constant, -q * std::pow(L, 4) / 30.0, 0.5 * q * L, q * L * L / 6.0, 1e-8);
  const TracedDeck staged(
      cantilever("theory = \"elastica\"",
                 "load = [{ on = \"beam\", distributed = [0.0, -1e-6], distributed_to = [0.0, 0.0] }]\n"
                 "stage = [{ name = \"half\", drives = [\"load.0\"], stop = { lambda = [-0.1, 0.5] } }, { name = "
                 "\"rest\", drives = [\"load.0\"], stop = { lambda = [-0.1, 0.5] } }]\n"));
  expect_last(staged, -q * std::pow(L, 4) / 30.0, 0.5 * q * L, q * L * L / 6.0, 1e-8);
}

// With theories that are flexible in shear the support carries the same.
TEST(LineLoads, OfATriangleAreCarriedByEveryTheory) {
  for (const char* theory : {"theory = \"reissner\", order = 1", "theory = \"reissner\", order = 2"}) {
    const TracedDeck run(
        cantilever(theory, "load = [{ on = \"beam\", distributed = [0.0, 0.0], distributed_to = [0.0, -1e-6] }]\n"));
    const std::vector<double>& monitors = run.record().points.back().monitors;
    EXPECT_NEAR(monitors.at(1), 0.5 * q * L, 1e-12 * q);
    EXPECT_NEAR(std::abs(monitors.at(2)), q * L * L / 3.0, 1e-7 * q) << theory;
  }
}

// Snow of q by length of plan on a rafter of slope 3:4 and span 4: its support carries 4 q, q·4²/2 bends it there. By
// length of the axis it is 5 q and q·5·2.
TEST(LineLoads, ByLengthOfPlanAreThoseOfSnow) {
  for (const bool plan : {true, false}) {
    const TracedDeck run(fmt::format(R"toml(
title = "A rafter"
material.m = {{ E = 1.0 }}
section.s = {{ shape = "general", A = 1e4, I = 1.0 }}
point = {{ a = [0.0, 0.0], b = [4.0, 3.0] }}
support = {{ a = ["x", "z", "rotation"] }}
load = [{{ on = "beam", distributed = [0.0, -1e-6]{} }}]
path = {{ method = "load", step = 1.0, stop = {{ lambda = [-0.5, 1.0] }} }}
monitor = [{{ name = "R", at = "a", component = "reaction-z" }}, {{ name = "M", at = "a", component = "reaction-moment" }}]
member.beam = {{ from = "a", to = "b", theory = "euler-bernoulli", elements = 8, material = "m", section = "s" }}
)toml",
                                     plan ? ", per = \"x\"" : ""));
    const std::vector<double>& monitors = run.record().points.back().monitors;
    EXPECT_NEAR(monitors.at(0), plan ? 4e-6 : 5e-6, 1e-14);
    EXPECT_NEAR(std::abs(monitors.at(1)), plan ? 8e-6 : 10e-6, 1e-9);
  }
}

// A three-hinged arch of span 10 and rise 2 on a circle: snow of q by length of plan pushes its feet apart by q l²/(8
// f).
TEST(LineLoads, ByLengthOfPlanPushAThreeHingedArchAsByHand) {
  const TracedDeck run(R"toml(
title = "A three-hinged arch under snow"
material.m = { E = 1e4 }
section.s = { shape = "general", A = 1e2, I = 1e2 }
point = { left = [0.0, 0.0], crown = [5.0, 2.0], right = [10.0, 0.0] }
support = { left = ["x", "z"], right = ["x", "z"] }
load = [{ on = "a", distributed = [0.0, -1e-3], per = "x" }, { on = "b", distributed = [0.0, -1e-3], per = "x" }]
path = { method = "load", step = 1.0, stop = { lambda = [-0.5, 1.0] } }
monitor = [{ name = "H", at = "left", component = "reaction-x" }, { name = "V", at = "left", component = "reaction-z" }]
member.a = { from = "left", to = "crown", via = [2.5, 1.5553287944080996], theory = "elastica", elements = 24, material = "m", section = "s", hinge = ["to"] }
member.b = { from = "crown", to = "right", via = [7.5, 1.5553287944080996], theory = "elastica", elements = 24, material = "m", section = "s" }
)toml");
  const std::vector<double>& monitors = run.record().points.back().monitors;
  EXPECT_NEAR(monitors.at(1), 5e-3, 1e-8);
  EXPECT_NEAR(monitors.at(0), 1e-3 * 100.0 / 16.0, 1e-7);
}

// Snow on an arc of radius 2 that overhangs by 60° on both sides falls on 2·2 between its outermost places and twice 2
// (1 − cos 60°) below them: Gauss's rule leaves 3e-9.
TEST(LineLoads, ByLengthOfPlanFallOnOverhangsToo) {
  const double x = std::sqrt(3.0) / 2.0;
  for (const char* theory : {"euler-bernoulli", "elastica", "reissner", "essenburg"}) {
    const TracedDeck run(fmt::format(R"toml(
title = "Snow on an overhanging arc"
material.m = {{ E = 1e9, nu = 0.0 }}
section.s = {{ shape = "rectangle", width = 1.0, height = 0.1 }}
point = {{ a = [{}, -1.0], b = [{}, -1.0] }}
support = {{ a = ["x", "z", "rotation"], b = ["x", "z", "rotation"] }}
load = [{{ on = "beam", distributed = [0.0, -1.0], per = "x" }}]
path = {{ method = "load", step = 1.0, stop = {{ lambda = [-0.5, 1.0] }} }}
monitor = [{{ name = "A", at = "a", component = "reaction-z" }}, {{ name = "B", at = "b", component = "reaction-z" }}]
member.beam = {{ from = "a", to = "b", via = [0.0, 2.0], theory = "{}", elements = 10, material = "m", section = "s" }}
)toml",
                                     -2.0 * x, 2.0 * x, theory));
    const std::vector<double>& monitors = run.record().points.back().monitors;
    const double plan = 4.0 + 2.0 * 2.0 * (1.0 - x);
    EXPECT_NEAR(monitors.at(0) + monitors.at(1), plan, 1e-8 * plan) << theory;
  }
}

// A strip lies on a floor, heavier towards its clamp: q₀ + q₁ s from its free end, which a force F lifts. It leaves the
// floor where its moment vanishes, F = q₀ l/2 + q₁ l²/6, and its end rises by w = F l³/3 − q₀ l⁴/8 − q₁ l⁵/30 over EI.
TEST(LineLoads, ThatVaryHoldAStripOnAFloorAsByHand) {
  const TracedDeck run(title("A strip that grows heavier") + material("m", 1e4) + general_section("s", 1e2, 1e2) +
                       points({{"free", 0.0, 0.0}, {"clamp", 10.0, 0.0}}) + supports({{"clamp", "x z rotation"}}) +
                       distributed("strip", 0.0, -0.02, "distributed_to = [0.0, -0.06]; constant = true") +
                       force("free", 0.0, 0.1) + path("step = 0.2; stop = { lambda = [-0.1, 1.0] }") +
                       monitor("w", "free", "z") + member("strip", "free", "clamp", "euler-bernoulli", 20) +
                       flat_wall("floor", "below", 0.0, on_axis));
  constexpr double F = 0.1, q0 = 0.02, q1 = 0.004, EI = 1e6;
  double low = 0.0, high = 10.0;
  while (high - low > 1e-14) {
    const double l = 0.5 * (low + high);
    (0.5 * q0 * l + q1 * l * l / 6.0 < F ? low : high) = l;
  }
  const double w = (F * std::pow(low, 3) / 3.0 - q0 * std::pow(low, 4) / 8.0 - q1 * std::pow(low, 5) / 30.0) / EI;
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
  EXPECT_NEAR(run.record().points.back().monitors.at(0), w, 1e-7 * w);
  test::expect_whole(run);
}

// A load a − b s that falls to nothing at the tip presses a cantilever on a floor δ below it: its tip touches, and lies
// down at 180 EI δ/L⁴ for a. Then the strip lies from c on, with w = −δ, w′ = w″ = 0 there: a c⁴/72 − b c⁵/120 = EI δ.
// The edge bears a c/3 − b c²/4, and at the tip, where the load is zero whatever λ is, nothing acts.
TEST(LineLoads, ThatFallToNothingAtATipLayItDown) {
  constexpr double EI = 1e6, L = 10.0, delta = 1e-3, q0 = 10.0;
  for (const char* theory : {"euler-bernoulli", "elastica"}) {
    const TracedDeck run(fmt::format(R"toml(
title = "A strip under a triangle"
material.m = {{ E = 1e4 }}
section.s = {{ shape = "general", A = 1e2, I = 1e2 }}
point = {{ clamp = [0.0, 0.0], tip = [10.0, 0.0] }}
support = {{ clamp = ["x", "z", "rotation"] }}
load = [{{ on = "strip", distributed = [0.0, -10.0], distributed_to = [0.0, 0.0] }}]
path = {{ step = 0.2, stop = {{ lambda = [-0.1, 10.0] }} }}
monitor = [{{ name = "wall", wall = "floor", component = "force-z" }}, {{ name = "edge", wall = "floor", member = "strip", component = "contact-start" }}]
member.strip = {{ from = "clamp", to = "tip", theory = "{}", elements = 20, material = "m", section = "s" }}
[[wall]]
name = "floor"
side = "below"
contact_surface = "axis"
profile = {{ type = "flat", z = -1e-3 }}
)toml",
                                     theory));
    EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
    const RecordEvent& spreads = test::event_of(run, EventKind::contact_spreads);
    EXPECT_NEAR(spreads.lambda * q0, 180.0 * EI * delta / std::pow(L, 4), 1e-6 * spreads.lambda * q0);
    const RecordPoint& last = run.record().points.back();
    const double a = 10.0 * q0, b = a / L;
    double low = 0.0, high = L;
    while (high - low > 1e-13) {
      const double c = 0.5 * (low + high);
      (a * std::pow(c, 4) / 72.0 - b * std::pow(c, 5) / 120.0 < EI * delta ? low : high) = c;
    }
    const double c = low, edge = a * c / 3.0 - b * c * c / 4.0;
    EXPECT_NEAR(last.monitors.at(1), c, 1e-5 * c) << theory;
    EXPECT_NEAR(last.monitors.at(0), edge + 0.5 * b * (L - c) * (L - c), 1e-5 * edge) << theory;
    ASSERT_GE(last.forces.size(), 2u);
    EXPECT_NEAR(last.forces.front().force, edge, 1e-5 * edge);
    EXPECT_NEAR(last.forces.back().force, 0.0, 1e-7 * edge);  // at the tip
    test::expect_whole(run);
  }
}

// A strip on a floor whose weight falls to nothing at the end that a force lifts lies there from the start: q₁ s from
// its free end bends what is off by F = q₁ l²/6, and its end rises by w = F l³/3 − q₁ l⁵/30 over EI.
TEST(LineLoads, ThatFallToNothingHoldAStripOnAFloor) {
  const TracedDeck run(
      title("A strip that weighs nothing at its end") + material("m", 1e4) + general_section("s", 1e2, 1e2) +
      points({{"free", 0.0, 0.0}, {"clamp", 10.0, 0.0}}) + supports({{"clamp", "x z rotation"}}) +
      distributed("strip", 0.0, 0.0, "distributed_to = [0.0, -0.06]; constant = true") + force("free", 0.0, 0.02) +
      path("step = 0.2; stop = { lambda = [-0.1, 1.0] }") + monitor("w", "free", "z") +
      member("strip", "free", "clamp", "euler-bernoulli", 20) + flat_wall("floor", "below", 0.0, on_axis));
  constexpr double F = 0.02, q1 = 0.006, EI = 1e6;
  const double l = std::sqrt(6.0 * F / q1);
  const double w = (F * std::pow(l, 3) / 3.0 - q1 * std::pow(l, 5) / 30.0) / EI;
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
  EXPECT_NEAR(run.record().points.back().monitors.at(0), w, 1e-7 * w);
  test::expect_whole(run);
}

TEST(LineLoads, ByLengthOfPlanAreRefusedOnAVerticalMember) {
  std::string post =
      cantilever("theory = \"elastica\"", "load = [{ on = \"beam\", distributed = [0.0, -1.0], per = \"x\" }]\n");
  post.replace(post.find("b = [2.0, 0.0]"), 14, "b = [0.0, 2.0]");
  EXPECT_EQ(test::said_of(post),
            "deck.toml:10:57: load.0.per: member beam is vertical and has no length of plan: the load on it is zero; "
            "leave out per, or leave out the load");
}

TEST(LineLoads, BelongToADistributedLoad) {
  EXPECT_EQ(
      test::said_of(cantilever("theory = \"elastica\"", "load = [{ on = \"beam\", pressure = 1.0, per = \"x\" }]\n")),
      "deck.toml:10:46: load.0.per: belongs to a load that is distributed; leave it out");
  EXPECT_EQ(test::said_of(cantilever("theory = \"elastica\"",
                                     "load = [{ at = \"b\", force = [0.0, 1.0], distributed_to = [0.0, 1.0] }]\n")),
            "deck.toml:10:58: load.0.distributed_to: belongs to a load that is distributed; leave it out");
  EXPECT_EQ(test::said_of(cantilever("theory = \"elastica\"",
                                     "load = [{ on = \"beam\", distributed = [0.0, 1.0], per = \"y\" }]\n")),
            "deck.toml:10:56: load.0.per: \"y\" is not one of the words for this key; known are length, x");
}

}  // namespace arcwall::line_loads_test
