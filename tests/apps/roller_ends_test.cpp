// Ends on rollers that come to walls across their way.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::roller_ends_test {

namespace {

// Values of λ at which contacts close.
std::vector<double> touches_of(const test::TracedDeck& traced) {
  std::vector<double> found;
  for (const RecordEvent& event : events_of(traced, EventKind::contact_closes)) found.push_back(event.lambda);
  return found;
}

// A ceiling, and what is known of the path under it.
struct Ceiling {
  std::string profile;
  double tangent_at = 0.0;                                 // λ where the end is tangent to it
  double place = 0.0, force = 0.0, turn = 0.0, way = 0.0;  // at λ = 0.65: of the contact, and of the end
};

// A strip of length 10 (EI = 1, EA = 1e4) whose left end is pushed to the right by λ/2, while a moment λ/10 turns its
// right end down, towards which a ceiling falls. `reversed`: it runs from right to left.
std::string strip_under(const Ceiling& ceiling, bool reversed, const std::string& path) {
  return fmt::format(R"toml(
title = "A strip that is pushed under a falling ceiling"
material.m = {{ E = 1.0 }}
section.s = {{ shape = "general", A = 1e4, I = 1.0 }}
point = {{ a = [0.0, 0.0], b = [10.0, 0.0] }}
support = {{ a = ["z"], b = ["z"] }}
prescribed = [{{ at = "a", x = 0.5 }}]
load = [{{ at = "b", moment = -0.1 }}]
member.strip = {{ from = "{}", to = "{}", theory = "elastica", material = "m", section = "s", elements = 20 }}
monitor = [{{ name = "end", at = "b", component = "x" }}, {{ name = "turn", at = "b", component = "rotation" }}]
wall = [{{ name = "ceiling", side = "above", contact_surface = "axis", profile = {} }}]
[path]
step = 0.02
{})toml",
                     reversed ? "b" : "a", reversed ? "a" : "b", ceiling.profile, path);
}

// A parabola, and a line that is there at the same place. Extensible elastica shot from the left end with an 8th-order
// method (1e-12): for the end's place, and for the place and angle at a contact inside.
constexpr double touches_at = 0.102326901310, at_last = 0.65;

std::vector<Ceiling> ceilings() {
  return {{.profile = "{ type = \"parabola\", apex = [0.0, 2.02005], curvature = -0.04 }",
           .tangent_at = 0.559474043741,
           .place = 0.9856903406,
           .force = 0.2146184410,
           .turn = -0.3850052523,
           .way = 0.0495893587},
          {.profile = "{ type = \"line\", z = 4.02, slope = -0.4 }",
           .tangent_at = 0.555812724589,
           .place = 0.9862223325,
           .force = 0.2102997111,
           .turn = -0.3877117218,
           .way = 0.0487717775}};
}

}  // namespace

// A bar of length 2 and stiffness EA = 10 is pushed by λ against an upright stop 0.1 beyond its end, or 0.1 beyond what
// is half its height off it: the stop is met at λ = EA 0.1/2, and bears all that is more.
TEST(RollerEnds, AnUprightStopTakesTheRest) {
  for (const bool on_face : {false, true})
    for (const std::string theory : {"euler-bernoulli", "elastica", "truss"}) {
      if (on_face && theory == "truss") continue;
      const test::TracedDeck traced(fmt::format(R"toml(
title = "A bar against a stop"
material.m = {{ E = 10.0 }}
section.s = {{ shape = "general", A = 1.0, I = 100.0, height = 0.2 }}
point = {{ A = [0.0, 0.0], B = [2.0, 0.0] }}
member.bar = {{ from = "A", to = "B", theory = "{}", material = "m", section = "s", elements = 1 }}
support = {{ A = ["x", "z"{}], B = ["z"] }}
load = [{{ at = "B", force = [1.0, 0.0] }}]
wall = [{{ name = "stop", contact_surface = "{}", outline = {{ type = "half-plane", point = [{}, 7.0], normal = [-1.0, 0.0] }} }}]
monitor = [{{ name = "force", wall = "stop", component = "force-x" }}]
contact = {{ points = "{}" }}
path = {{ step = 0.1, stop = {{ lambda = [-1.0, 2.0] }} }}
)toml",
                                                theory, theory == "truss" ? "" : ", \"rotation\"",
                                                on_face ? "face" : "axis", on_face ? 2.2 : 2.1,
                                                theory == "elastica" ? "moving" : "nodes"));
      const std::vector<double> touches = touches_of(traced);
      ASSERT_EQ(touches.size(), 1u);
      const double expected = theory == "truss" ? 10.0 * 1.05 * 0.5 * (1.05 * 1.05 - 1.0) : 0.5;  // Green's strain
      EXPECT_NEAR(touches[0], expected, 1e-10);
      EXPECT_NEAR(traced.record().points.back().monitors[0], expected - 2.0, 1e-10);
      test::expect_whole(traced);
    }
}

// The same bar, whose end runs along z = 0 into what is not upright but crosses that line at x = 2.1: a peg, a bore, a
// rounded corner and a floor that rises. The support bears what is across.
TEST(RollerEnds, TouchWhateverCrossesTheirWay) {
  const std::string peg = R"(outline = { type = "circle", centre = [2.265831239517769, -0.25], radius = 0.3 })";
  const std::string bore =
      R"(outline = { type = "circle", centre = [0.0, 0.25], radius = 2.1148285982556614, structure = "inside" })";
  const std::string corner =
      R"(outline = { type = "polyline", x = [1.0, 2.0, 2.2], z = [-0.1, -0.1, 0.1] }, corner_radius = 0.05)";
  const std::string rise = R"(side = "below", profile = { type = "line", z = -0.42, slope = 0.2 })";
  for (const std::string& wall : {peg, bore, corner, rise}) {
    const test::TracedDeck traced(fmt::format(R"toml(
title = "A bar against what crosses its way"
material.m = {{ E = 10.0 }}
section.s = {{ shape = "general", A = 1.0, I = 100.0 }}
point = {{ A = [0.0, 0.0], B = [2.0, 0.0] }}
member.bar = {{ from = "A", to = "B", theory = "elastica", material = "m", section = "s", elements = 2 }}
support = {{ A = ["x", "z", "rotation"], B = ["z"] }}
load = [{{ at = "B", force = [1.0, 0.0] }}]
wall = [{{ name = "stop", contact_surface = "axis", {} }}]
monitor = [{{ name = "force", wall = "stop", component = "force-x" }}]
path = {{ step = 0.1, stop = {{ lambda = [-1.0, 2.0] }} }}
)toml",
                                              wall));
    const std::vector<double> touches = touches_of(traced);
    ASSERT_EQ(touches.size(), 1u) << wall;
    EXPECT_NEAR(touches[0], 0.5, 1e-10) << wall;
    EXPECT_NEAR(traced.record().points.back().monitors[0], 0.5 - 2.0, 1e-10) << wall;
    test::expect_whole(traced);
  }
}

// A bar of EA = 1000 on rollers is pushed by λ against a round stop that its end touches at rest, with a normal along
// it or leaning by 66°: before it buckles (P = 0.3155) it bears EA λ/L. What the stop presses along x the reaction
// holds.
TEST(RollerEnds, AreStoppedByRoundWallsThatTheyTouchAtRest) {
  for (const double angle : {0.0, 66.0}) {
    SCOPED_TRACE(angle);
    const double c = std::cos(angle * pi / 180.0), s = std::sin(angle * pi / 180.0);
    const test::TracedDeck traced(fmt::format(R"toml(
title = "Bar on a roller pushed against a round stop"
material.m = {{ E = 1.0 }}
section.s = {{ shape = "general", A = 1000.0, I = 1.0 }}
point = {{ a = [0.0, 0.0], b = [8.0, 0.0] }}
support = {{ a = ["z", "rotation"], b = ["z"] }}
path = {{ step = 0.0005, stop = {{ lambda = [-0.1, 0.002] }} }}
member.s = {{ from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = 16 }}
prescribed = [{{ at = "a", x = 1.0 }}]
wall = [{{ name = "stop", contact_surface = "axis", outline = {{ type = "circle", centre = [{:.17g}, {:.17g}], radius = 1.5 }} }}]
monitor = [{{ name = "push", at = "a", component = "reaction-x" }}, {{ name = "stop", wall = "stop", component = "force-x" }}]
)toml",
                                              8.0 + 1.5 * c, -1.5 * s));
    const RecordPoint& last = traced.record().points.back();
    ASSERT_DOUBLE_EQ(last.state.lambda, 0.002);
    EXPECT_NEAR(last.monitors[0], 1000.0 * 0.002 / 8.0, 1e-9);
    EXPECT_NEAR(last.monitors[1], -last.monitors[0], 1e-9);
    EXPECT_EQ(last.count.unstable, 0);
    test::expect_whole(traced);
  }
}

// A stop that reaches 0.002 beyond the end is pushed there before the path begins: EA 0.002/L again, and as much for λ.
TEST(RollerEnds, ArePushedByRoundStopsWithAnInterference) {
  const test::TracedDeck traced(R"toml(
title = "Bar on a roller behind a stop that reaches into it"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1000.0, I = 1.0 }
point = { a = [0.0, 0.0], b = [8.0, 0.0] }
support = { a = ["z", "rotation"], b = ["z"] }
path = { step = 0.0001, stop = { lambda = [-0.1, 0.0004] } }
member.s = { from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = 16 }
prescribed = [{ at = "a", x = 1.0 }]
wall = [{ name = "stop", contact_surface = "axis", interference = 0.1, outline = { type = "circle", centre = [9.498, 0.0], radius = 1.5 } }]
monitor = [{ name = "push", at = "a", component = "reaction-x" }]
)toml");
  EXPECT_NEAR(traced.record().points.front().monitors[0], 0.25, 1e-9);
  const RecordPoint& last = traced.record().points.back();
  ASSERT_DOUBLE_EQ(last.state.lambda, 0.0004);
  EXPECT_NEAR(last.monitors[0], 0.3, 1e-9);
  test::expect_whole(traced);
}

// Behind the place where the end has turned into the ceiling's direction contact lies inside.
TEST(RollerEnds, PassContactInsideWhereTheyBecomeTangent) {
  for (const Ceiling& ceiling : ceilings())
    for (const bool reversed : {false, true}) {
      SCOPED_TRACE(ceiling.profile + (reversed ? " reversed" : ""));
      const test::TracedDeck traced(strip_under(ceiling, reversed, "stop = { lambda = [-0.1, 0.65] }\n"));
      EXPECT_NEAR(event_of(traced, EventKind::contact_closes).lambda, touches_at, 1e-10);
      EXPECT_NEAR(event_of(traced, EventKind::contact_transfers).lambda, ceiling.tangent_at, 1e-9);
      const RecordPoint& last = traced.record().points.back();
      ASSERT_DOUBLE_EQ(last.state.lambda, at_last);
      EXPECT_NEAR(last.monitors[0], ceiling.way, 1e-9);
      EXPECT_NEAR(last.monitors[1], ceiling.turn, 1e-9);
      const std::vector<ContactPoint> contacts = traced.model().contacts()->closed_contacts(last.state);
      ASSERT_EQ(contacts.size(), 1u);
      EXPECT_NEAR(contacts[0].label.fraction, reversed ? 1.0 - ceiling.place : ceiling.place, 1e-9);
      EXPECT_NEAR(contacts[0].force, ceiling.force, 1e-8);
      test::expect_whole(traced);
    }
}

// Pulled back, it takes contact over from inside at the same place, and lifts off.
TEST(RollerEnds, TakeContactBackFromInside) {
  for (const Ceiling& ceiling : ceilings()) {
    SCOPED_TRACE(ceiling.profile);
    const test::TracedDeck traced(strip_under(ceiling, false, R"toml(
[[stage]]
name = "push"
drives = ["prescribed.0", "load.0"]
stop = { lambda = [-0.1, 0.65] }
[[stage]]
name = "back"
drives = ["prescribed.0", "load.0"]
step = -0.02
stop = { lambda = [-0.65, 0.1] }
)toml"));
    EXPECT_NEAR(event_of(traced, EventKind::contact_transfers, 2).lambda, ceiling.tangent_at - at_last, 1e-9);
    EXPECT_NEAR(event_of(traced, EventKind::contact_opens).lambda, touches_at - at_last, 1e-10);
    EXPECT_DOUBLE_EQ(traced.last().lambda, -at_last);
    test::expect_whole(traced);
  }
}

}  // namespace arcwall::roller_ends_test
