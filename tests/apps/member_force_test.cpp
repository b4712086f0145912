#include "model/member_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/derivative_check.hpp"
#include "core/error.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/model/deck/sample_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::member_force_test {

using namespace test::tables;

namespace {

using test::TracedDeck;

// A cantilever along x with the force (−0.3, −1) at its tip, and what it carries in the clamp and in its middle.
std::string clamped_strip(const std::string& theory, const std::string& more = "") {
  std::string deck = R"(
title = "Cantilever"
material.m = { E = 1e4, nu = 0.3 }
section.s = { shape = "rectangle", width = 1.0, height = 0.1 }
point = { clamp = [1.0, 0.5], tip = [3.0, 0.5] }
support.clamp = ["x", "z", "rotation"]
[member.beam]
from = "clamp"
to = "tip"
material = "m"
section = "s"
elements = 8
)" + theory + "\n" + force("tip", -0.3, -1.0) +
                     path("step = 0.1; stop = { lambda = [-1.0, 1.0] }") + more;
  deck += monitor("N0", "clamp", "axial-force") + monitor("M0", "beam:0", "moment");
  deck += monitor("N", "beam:0.5", "axial-force") + monitor("M", "beam:0.5", "moment");
  deck += monitor("Rx", "clamp", "reaction-x") + monitor("Rm", "clamp", "reaction-moment");
  for (const char* component : {"x", "z"})
    deck += monitor(std::string("tip") + component, "tip", component) +
            monitor(std::string("mid") + component, "beam:0.5", component);
  return deck + monitor("turn", "beam:0.5", "rotation");
}

const std::string far_wall = "[[wall]]\nname = \"w\"\nside = \"below\"\nprofile = { type = \"flat\", z = -50.0 }\n";

double last(const TracedDeck& run, const std::string& name) {
  for (std::size_t i = 0; i < run.record().columns.size(); ++i)
    if (run.record().columns[i].name == name) return run.record().points.back().monitors[i];
  ADD_FAILURE() << name;
  return 0.0;
}

// A clamped strip over a floor at a thousandth of its length 10, under the force 1 at a place of it. EI = 1.
std::string strip_over_floor(const std::string& elements, const std::string& place, const std::string& load) {
  return R"(
title = "A strip between clamps, pressed onto a floor"
material.m = { E = 1.2e5 }
section.s = { shape = "rectangle", width = 0.1, height = 0.1 }
point = { a = [0.0, 0.0], b = [10.0, 0.0] }
support = { a = ["x", "z", "rotation"], b = ["z", "rotation"] }
member.beam = { from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = )" +
         elements + R"( }
load = [{ at = "beam:)" +
         place + R"(", force = [0.0, -1.0] }]
wall = [{ name = "floor", side = "below", contact_surface = "axis", profile = { type = "flat", z = -0.01 } }]
path = { step = 0.1, stop = { lambda = [-1.0, )" +
         load + "] } }\n" + monitor("M0", "beam:0", "moment") + monitor("M", "beam:" + place, "moment") +
         monitor("M1", "beam:1", "moment") + monitor("R", "a", "reaction-z") +
         "[[monitor]]\nname = \"most\"\nmember = \"beam\"\ncomponent = \"max-moment\"\n";
}

// Equilibrium of the cut-off part, with the places where the run has them.
void expect_balance(const TracedDeck& run) {
  const Vec2 F(-0.3, -1.0);
  const Vec2 arm(1.0 + last(run, "tipx") - last(run, "midx"), last(run, "tipz") - last(run, "midz"));
  const double turn = last(run, "turn");
  EXPECT_LT(turn, -0.3) << "the strip should bend much";
  EXPECT_NEAR(last(run, "M"), arm.x() * F.y() - arm.y() * F.x(), 1e-8);
  EXPECT_NEAR(last(run, "N"), F.x() * std::cos(turn) + F.y() * std::sin(turn), 1e-8);
  EXPECT_NEAR(last(run, "M0"), -last(run, "Rm"), 1e-8);
  EXPECT_NEAR(last(run, "N0"), 0.3 * -1.0, 1e-8);
  EXPECT_NEAR(last(run, "N0"), -last(run, "Rx"), 1e-8);
}

void expect_gradients(const TracedDeck& run) {
  for (const MonitorColumn& column : run.model().monitors())
    EXPECT_LE(check_gradient(*column.quantity, run.last()), 1e-6) << column.name;
}

std::string said_of(const std::string& deck) {
  try {
    const TracedDeck run(deck);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST(MemberForce, BalancesWhatIsCutOff) {
  for (const char* theory :
       {"theory = \"euler-bernoulli\"", "theory = \"elastica\"", "theory = \"reissner\"\norder = 1",
        "theory = \"reissner\"", "theory = \"essenburg\"\nalong = \"director\""}) {
    SCOPED_TRACE(theory);
    expect_balance(TracedDeck(clamped_strip(theory)));
  }
}

TEST(MemberForce, BalancesOnAMeshThatSlides) {
  for (const char* theory : {"theory = \"euler-bernoulli\"", "theory = \"elastica\""}) {
    SCOPED_TRACE(theory);
    const TracedDeck run(clamped_strip(theory, far_wall));
    ASSERT_NE(run.model().sliding(), nullptr);
    expect_balance(run);
  }
}

// Once the middle rests on the floor it bears all that is added: |M| stays P L/8 = 24 EI g/L² at the clamps and there,
// though the contact lies where the load does.
TEST(MemberForce, StaysWhereTheFloorBearsTheLoad) {
  constexpr double most = 24.0 * 0.01 / 100.0;
  for (const char* elements : {"10", "40"}) {
    SCOPED_TRACE(elements);
    const TracedDeck run(strip_over_floor(elements, "0.5", "3.0"));
    ASSERT_EQ(run.record().points.back().forces.size(), 1U);
    EXPECT_NEAR(last(run, "most"), most, 1e-4 * most);
    EXPECT_NEAR(last(run, "M"), most, 1e-4 * most);
    EXPECT_NEAR(last(run, "M0"), -most, 1e-4 * most);
  }
}

// A load and a contact within one element: M is piecewise linear in between, by the reactions and by hand.
TEST(MemberForce, BalancesBesideAPointLoadInsideAnElement) {
  constexpr double a = 4.0;
  for (const char* load : {"0.004", "0.02", "3.0"}) {
    SCOPED_TRACE(load);
    const TracedDeck run(strip_over_floor("10", "0.4", load));
    const auto& end = run.record().points.back();
    ASSERT_EQ(end.forces.size(), 1U);
    const double c = 10.0 * end.forces[0].label.fraction;
    EXPECT_GT(c, a);
    EXPECT_LT(c, a + 0.6);
    const double at_load = last(run, "M0") + a * last(run, "R");
    const double at_contact = last(run, "M0") + c * last(run, "R") - (c - a) * end.lambda;
    EXPECT_NEAR(last(run, "M"), at_load, 1e-4 * at_load);
    const double most = std::max({at_load, at_contact, -last(run, "M0"), -last(run, "M1")});
    EXPECT_NEAR(last(run, "most"), most, 1e-4 * most);
  }
}

TEST(MemberForce, HasGradients) {
  expect_gradients(TracedDeck(clamped_strip("theory = \"euler-bernoulli\"")));
  expect_gradients(TracedDeck(clamped_strip("theory = \"reissner\"")));
  expect_gradients(TracedDeck(clamped_strip("theory = \"euler-bernoulli\"", far_wall)));
}

TEST(MemberForce, HasGradientsAtAPointLoadInsideAnElement) {
  const TracedDeck run(strip_over_floor("10", "0.4", "0.004"));
  const MonitorColumn& at_load = run.model().monitors()[1];
  ASSERT_EQ(at_load.name, "M");
  EXPECT_LE(check_gradient(*at_load.quantity, run.last()), 1e-6);
}

TEST(MemberForce, CanStopAPath) {
  const std::string deck = clamped_strip("theory = \"euler-bernoulli\"");
  const TracedDeck run(deck::replaced(deck, "lambda = [-1.0, 1.0]", "lambda = [-1.0, 1.0], M = [-0.4, 0.4]"));
  EXPECT_NEAR(last(run, "M"), -0.4, 1e-12);
}

TEST(MemberForce, IsRefusedWhereItIsNotOne) {
  const std::string second =
      member("more", "tip", "clamp", "euler-bernoulli", 8, "via = [2.0, 2.0]") + table("[[load]]", "");
  const std::string both = deck::replaced(clamped_strip("theory = \"euler-bernoulli\""), "[[load]]", second);
  EXPECT_NE(said_of(both).find("does not have this component"), std::string::npos);
}

}  // namespace arcwall::member_force_test
