// Whole runs of decks, each of a kind that was once answered wrongly without a word: a bound that was jumped over, a
// stop that was passed through, a singular point that was found twice, a path that turned round. What is expected comes
// from elsewhere, as is said at each deck. "Shooting": the boundary value problem of the extensible elastica, θ′ =
// M/EI, (x′, z′) = (1 + N/EA)(cos θ, sin θ), M′ = −(1 + N/EA) Q, by Runge-Kutta's method of order 4 from one end to the
// touch and on to the other, with what is not known there and the touch by Newton's method; all digits given stay with
// half the steps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "apps/output/exit_status.hpp"
#include "model/event_names.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::deck_answers_test {

using namespace test::tables;
namespace {

struct Scene {
  EventKind kind{};
  double lambda = 0.0, tolerance = 0.0;
};

struct Answer {
  std::string name{};
  std::string deck{};
  std::vector<Scene> scenes{};
  ExitStatus status = ExitStatus::success;
};

std::ostream& operator<<(std::ostream& out, const Answer& answer) { return out << answer.name; }

// Pure bending until the touch: κ = M/EI with (1 − cos κL/2)/κ = 0.125. At the spreading by shooting from the left end
// to the middle, where θ and M vanish. The bound lies between that and the first point behind it.
constexpr const char* bound_behind_spread = R"toml(
title = "A strip bent onto a floor, with a bound just behind the spreading of the touch"
units = { length = "cm", force = "kN" }
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.3, height = 0.15 }
point = { a = [0.0, 0.0], b = [3.0, 0.0] }
member.strip = { from = "a", to = "b", theory = "euler-bernoulli", material = "steel", section = "s", elements = 36 }
support = { a = ["x", "z"], b = ["z"] }
load = [{ at = "a", moment = -1.0 }, { at = "b", moment = 1.0 }]
wall = [{ name = "floor", side = "below", profile = { type = "flat", z = -0.2 } }]
monitor = [{ name = "mid", at = "strip:0.5", component = "z" }]
path = { step = 0.1, stop = { lambda = [-1.0, 0.593] } }
)toml";

// Shooting; at the spreading the axis has the curvature of the curve at 0.2 above the parabola. The elements' error is
// below 5e-7.
constexpr const char* hollow = R"toml(
title = "A guided beam pressed into a hollow"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 1.2, height = 0.4 }
point = { a = [0.0, 0.0], b = [12.0, 0.0] }
member.beam = { from = "a", to = "b", theory = "euler-bernoulli", material = "steel", section = "s", elements = 48 }
support = { a = ["x", "z", "rotation"], b = ["z", "rotation"] }
load = [{ on = "beam", distributed = [0.0, -2.0] }]
wall = [{ name = "hollow", side = "below", profile = { type = "parabola", apex = [4.8, -1.4], curvature = 0.012 } }]
monitor = [{ name = "mid", at = "beam:0.5", component = "z" }]
path = { step = 0.1, stop = { lambda = [-1.0, 4.38] } }
)toml";

// Shooting: the axis is 0.027 from the pin's centre.
constexpr const char* pin = R"toml(
title = "A strip bent onto a pin that is thinner than an element is long"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.05, height = 0.03 }
point = { clamp = [0.0, 0.0], tip = [2.0, 0.0] }
member.strip = { from = "clamp", to = "tip", theory = "euler-bernoulli", material = "steel", section = "s", elements = 16 }
support = { clamp = ["x", "z", "rotation"] }
load = [{ at = "tip", force = [0.0, -5e-4] }]
wall = [{ name = "pin", side = "below", profile = { type = "circle", centre = [1.1, -0.2], radius = 0.012 } }]
monitor = [{ name = "tip", at = "tip", component = "z" }]
path = { step = 0.1, stop = { lambda = [-1.0, 4.0] } }
)toml";

// Shooting: the axis is 0.365 from the stop's centre. `verify` holds though the gap beyond the stop is infinite.
constexpr const char* stop = R"toml(
title = "A strip bent onto a round stop that is shorter than itself"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.05, height = 0.03 }
point = { clamp = [0.0, 0.0], tip = [2.0, 0.0] }
member.strip = { from = "clamp", to = "tip", theory = "euler-bernoulli", material = "steel", section = "s", elements = 32 }
support = { clamp = ["x", "z", "rotation"] }
load = [{ at = "tip", force = [0.0, -5e-4] }]
wall = [{ name = "stop", side = "below", profile = { type = "circle", centre = [1.1, -0.45], radius = 0.35 } }]
monitor = [{ name = "tip", at = "tip", component = "z" }]
path = { step = 0.1, stop = { lambda = [-1.0, 4.0] } }
)toml";

// From a run with four times the elements and steps of at most 0.03. `verify` holds on a curved wall, too.
const std::string hump =
    title("A portal whose beam is bent onto a hump") + material("steel", 2.1e4) + rectangle("s", 0.3, 0.12) +
    points({{"a", 0.0, 0.0}, {"b", 0.0, 12.0}, {"c", 14.0, 12.0}, {"e", 14.0, 0.0}}) +
    supports({{"a", "x z"}, {"e", "x z"}}) + force("beam:0.4375", 0.0, -0.14) + force("b", 0.005, 0.0) +
    monitor("sway", "b", "x") + path("step = 0.05; stop = { lambda = [-1.0, 2.0], sway = [-9.0, 9.0] }") +
    member("west", "a", "b", "euler-bernoulli", 10, "", "steel") +
    member("beam", "b", "c", "euler-bernoulli", 16, "", "steel") +
    member("east", "c", "e", "euler-bernoulli", 10, "", "steel") +
    wall(
        "hump",
        R"(side = "below"; profile = { type = "parabola", apex = [6.6, 11.2], curvature = -0.16 }; members = ["beam"])");

// From a run with four times the elements and steps of at most 0.03. The limit point is none besides a branch point.
const std::string wavy_column =
    title("A column of a wavy shape between a flat and a sloping wall") + material("steel", 2.1e4) +
    rectangle("s", 0.8, 0.2) + points({{"foot", 0.0, 0.0}, {"head", 26.0, 0.0}}) +
    supports({{"foot", "x z rotation"}, {"head", "z"}}) + force("head", -0.35, 0.0) +
    monitor("mid", "column:0.5", "z") + monitor("shortening", "head", "x", flipped) +
    path("step = 0.02; stop = { lambda = [-1.0, 12.0], shortening = [-5.0, 18.0] }") +
    member("column", "foot", "head", "elastica", 48, imperfection({{2, -0.16}}), "steel") +
    flat_wall("above", "above", 1.15) +
    wall("below", R"(side = "below"; profile = { type = "line", z = -1.2, slope = -0.01 })");

// From a run with four times the elements and steps of at most 0.03. Each limit point is found once.
constexpr const char* unequal_toggle = R"toml(
title = "An unequal toggle that snaps onto a nearly flat floor"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 2.0, height = 0.3 }
point = { a = [0.0, 0.0], top = [15.0, 0.82], b = [40.0, 0.0] }
support = { a = ["x", "z", "rotation"], b = ["x", "z", "rotation"] }
load = [{ at = "top", force = [0.0, -0.2] }]
wall = [{ name = "floor", side = "below", profile = { type = "line", z = -0.28, slope = -0.0004 } }]
monitor = [{ name = "down", at = "top", component = "z", sign = -1 }]
path = { step = 0.05, stop = { lambda = [-3.0, 3.0], down = [-1.6, 3.2] } }
[member]
west = { from = "a", to = "top", theory = "elastica", material = "steel", section = "s", elements = 20 }
east = { from = "top", to = "b", theory = "elastica", material = "steel", section = "s", elements = 20 }
)toml";

// P (1 − P/EA) = π² EI/L² at the branch point. Then shooting from the foot to the middle, where θ vanishes, and M where
// the touch spreads. The elements' error is (π/60)⁴/720 of the load at the branch point.
const std::string slender_column =
    title("A slender column between far walls") + material("steel", 2.1e4) + rectangle("s", 0.6, 0.1) +
    points({{"foot", 0.0, 0.0}, {"head", 20.0, 0.0}}) +
    member("column", "foot", "head", "euler-bernoulli", 60, "", "steel") + supports({{"foot", "x z"}, {"head", "z"}}) +
    force("head", -0.02, 0.0) + monitor("mid", "column:0.5", "z") +
    path("step = 0.05; stop = { lambda = [-1.0, 8.0] }") + flat_wall("above", "above", 0.9, on_axis) +
    flat_wall("below", "below", -2.0, on_axis);

// The nose touches the ramp, and leaves it, where z = −1.2 on both: the base has gone 5 ∓ √8, and the spring of 0.2/80
// alone holds it. In between shooting from the base over the corner to the nose, pushed by the ramp at right angles;
// the limit points are the greatest and the least load over the way.
constexpr const char* snap_fit = R"toml(
title = "A hook with a nose, pushed over a ramp"
units = { length = "mm", force = "N" }
material = { plastic = { E = 2000.0 }, soft = { E = 1.0 } }
section.hook = { shape = "rectangle", width = 6.0, height = 1.2 }
section.spring = { shape = "general", A = 0.2, I = 1.0 }
point = { base = [0.0, 0.0], tip = [18.0, 0.0], nose = [18.0, -1.2], anchor = [-80.0, 0.0] }
support = { base = ["z", "rotation"], anchor = ["x", "z"] }
wall = [{ name = "ramp", side = "below", contact_surface = "axis", members = ["nose"], profile = { type = "parabola", apex = [23.0, -0.4], curvature = -0.2 } }]
load = [{ at = "base", force = [1.0, 0.0] }]
monitor = [{ name = "push", at = "base", component = "x" }]
path = { step = 0.01, stop = { push = [-0.1, 11.0] } }
[member]
beam = { from = "base", to = "tip", theory = "euler-bernoulli", material = "plastic", section = "hook", elements = 24 }
nose = { from = "tip", to = "nose", theory = "euler-bernoulli", material = "plastic", section = "hook", elements = 4 }
spring = { from = "anchor", to = "base", theory = "euler-bernoulli", hinge = ["from", "to"], material = "soft", section = "spring", elements = 1 }
)toml";

// From a run with four times the elements and steps of at most 0.02. λ falls to the end, and no event is met twice.
const std::string rounded_walls =
    title("A nearly straight column between two rounded walls") + material("steel", 2.1e4) + rectangle("s", 0.6, 0.36) +
    points({{"foot", 0.0, 0.0}, {"head", 15.0, 0.0}}) + supports({{"foot", "x z"}, {"head", "z"}}) +
    force("head", -2.2, 0.0) + monitor("mid", "column:0.5", "z") + monitor("shortening", "head", "x", flipped) +
    path("step = 0.05; stop = { lambda = [-1.0, 11.0], shortening = [-3.0, 4.6] }") +
    member("column", "foot", "head", "euler-bernoulli", 80, imperfection({{1, 0.0015}, {2, 0.004}}), "steel") +
    wall("above", R"(side = "above"; profile = { type = "circle", centre = [8.9, 12.2], radius = 11.7 })") +
    wall("below", R"(side = "below"; profile = { type = "circle", centre = [5.9, -37.7], radius = 37.2 })");

std::vector<Answer> answers() {
  using enum EventKind;
  return {
      {.name = "BoundBehindTheSpreadOfATouch",
       .deck = bound_behind_spread,
       .scenes = {{start, 0.0, 0.0},
                  {contact_closes, 0.197333493878, 1e-9},
                  {contact_spreads, 0.590114169368, 1e-9},
                  {end, 0.593, 1e-12}}},
      {.name = "BoundBehindTheSpreadOnAHollow",
       .deck = hollow,
       .scenes = {{start, 0.0, 0.0},
                  {contact_closes, 1.551512783396, 1e-7},
                  {contact_spreads, 4.351675758387, 1e-6},
                  {end, 4.38, 1e-12}}},
      {.name = "APinThatIsThinnerThanAnElementIsLong",
       .deck = pin,
       .scenes = {{start, 0.0, 0.0}, {contact_closes, 0.836313387175, 1e-9}, {end, 4.0, 1e-12}}},
      {.name = "AStopThatIsShorterThanTheStrip",
       .deck = stop,
       .scenes = {{start, 0.0, 0.0}, {contact_closes, 0.392388749406, 1e-9}, {end, 4.0, 1e-12}}},
      {.name = "AHumpBelowAPortal",
       .deck = hump,
       .scenes = {{start, 0.0, 0.0},
                  {contact_closes, 0.12138026843, 1e-7},
                  {contact_spreads, 0.90723048652, 5e-6},
                  {end, 2.0, 1e-12}}},
      {.name = "ALimitPointBehindATouch",
       .deck = wavy_column,
       .scenes = {{start, 0.0, 0.0},
                  {contact_closes, 0.82837836392, 1e-8},
                  {limit_point, 2.77728845302, 1e-8},
                  {contact_closes, 2.76650766654, 1e-8},
                  {contact_limit_point, 2.76650766654, 1e-8},
                  {contact_spreads, 9.81136209588, 2e-7},
                  {end, 12.0, 1e-11}}},
      {.name = "LimitPointsOfAToggleOnAFloor",
       .deck = unequal_toggle,
       .scenes = {{start, 0.0, 0.0},
                  {limit_point, 1.28480255068, 1e-8},
                  {contact_closes, 0.99039786869, 1e-8},
                  {contact_limit_point, 0.99039786869, 1e-8},
                  {limit_point, 1.95208937770, 1e-8},
                  {limit_point, 1.93697670626, 1e-8},
                  {contact_closes, 2.43169520344, 1e-8},
                  {end, 3.0, 1e-12}}},
      {.name = "ASlenderColumnBetweenFarWalls",
       .deck = slender_column,
       .scenes = {{start, 0.0, 0.0},
                  {branch_point, 1.295412214037, 3e-8},
                  {end, 1.295412214037, 3e-8},
                  {start, 1.295412214037, 3e-8},
                  {contact_closes, 1.298667818904, 3e-8},
                  {contact_spreads, 5.166114071656, 2e-6},
                  {end, 8.0, 1e-11}}},
      {.name = "AHookThatSnapsOverARamp",
       .deck = snap_fit,
       .scenes = {{start, 0.0, 0.0},
                  {contact_closes, 0.005428932188, 1e-11},
                  {limit_point, 0.165562149049, 1e-9},
                  {limit_point, -0.134360821944, 1e-9},
                  {contact_opens, 0.019571067812, 1e-11},
                  {end, 0.0275, 1e-12}}},
      {.name = "ANearlyStraightColumnBetweenRoundedWalls",
       .deck = rounded_walls,
       .scenes = {{start, 0.0, 1e-30},
                  {contact_closes, 0.97345708766, 2e-8},
                  {limit_point, 4.10286565879, 3e-7},
                  {contact_closes, 4.09323619354, 3e-7},
                  {contact_limit_point, 4.09323619354, 3e-7},
                  {limit_point, 6.92947226130, 2e-6},
                  {contact_opens, 2.89295209827, 2e-7},
                  {contact_closes, 0.85162185885, 3e-7},
                  {end, 0.76091249825, 2e-6}}},
  };
}

class DeckAnswers : public testing::TestWithParam<Answer> {};

TEST_P(DeckAnswers, HoldAndAreVerified) {
  const auto& [name, deck, scenes, status] = GetParam();
  const test::TracedDeck traced(deck);
  const Record& record = traced.record();
  std::string told;
  for (const RecordEvent& event : record.events) told += std::string(to_text(event.kind)) + " ";
  std::string expected;
  for (const Scene& scene : scenes) expected += std::string(to_text(scene.kind)) + " ";
  ASSERT_EQ(told, expected);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    EXPECT_NEAR(record.events[i].lambda, scenes[i].lambda, scenes[i].tolerance) << to_text(scenes[i].kind);
  EXPECT_EQ(exit_status(record.branches.back().end.value().reason), status);
  test::expect_verified(traced);
}

INSTANTIATE_TEST_SUITE_P(Decks, DeckAnswers, testing::ValuesIn(answers()),
                         [](const auto& answer) { return answer.param.name; });

// --- columns in channels, arches above floors: shooting from a support to the middle
// -----------------------------------

const std::string materials = R"toml(
material.m = { E = 21000.0 }
section.s = { shape = "rectangle", width = 0.1, height = 0.1 }
)toml";

// A straight column of length 2 between walls that its axis may touch at a distance g: at the touch θ = 0 and z = g in
// the middle, where contact spreads M = 0 as well.
TEST(PerfectColumn, TouchesAndSpreadsInChannelsOfAnyWidth) {
  struct Case {
    double gap, touch, spreads;
  };
  for (const Case& one : {Case{0.05, 0.433020940042, 1.73995167965}, Case{0.1, 0.434031065441, 1.73488787057},
                          Case{0.2, 0.438187297779, 1.71393008407}, Case{0.25, 0.441433401966, 1.69740715034}}) {
    SCOPED_TRACE(one.gap);
    const std::string deck = "title = \"A straight column\"" + materials +
                             fmt::format(R"toml(
point = {{ A = [0.0, 0.0], B = [2.0, 0.0] }}
support = {{ A = ["x", "z"], B = ["z"] }}
load = [{{ at = "B", force = [-1.0, 0.0] }}]
path = {{ step = 0.05, jumps = false, stop = {{ lambda = [-1.0, 2.0] }} }}
wall = [
  {{ name = "upper", side = "above", contact_surface = "axis", profile = {{ type = "flat", z = {0} }} }},
  {{ name = "lower", side = "below", contact_surface = "axis", profile = {{ type = "flat", z = -{0} }} }},
]
member.c = {{ from = "A", to = "B", theory = "elastica", elements = 20, material = "m", section = "s" }}
)toml",
                                         one.gap);
    const test::TracedDeck traced(deck);
    EXPECT_NEAR(event_of(traced, EventKind::contact_closes).lambda, one.touch, 1e-8);
    EXPECT_NEAR(event_of(traced, EventKind::contact_spreads).lambda, one.spreads, 1e-7);
  }
}

// A pinned sine arch of span 2 under a force on its crown, and a floor 0.02 below its ends. What the arch of that
// height carries is what the floor does not: it is the load at the touch, and less than that of the limit point by the
// force on the floor behind the fall.
TEST(SineArch, FallsFromItsLimitPointOntoAFloor) {
  struct Case {
    double rise, limit, touch;
  };
  for (const Case& one : {Case{0.08, 0.10502374698, 0.068455396147}, Case{0.1, 0.17024981411, 0.067908233099},
                          Case{0.12, 0.26229387761, 0.062487729642}}) {
    SCOPED_TRACE(one.rise);
    const std::string deck = "title = \"An arch above a floor\"" + materials +
                             fmt::format(R"toml(
point = {{ l = [0.0, 0.0], r = [2.0, 0.0] }}
support = {{ l = ["x", "z"], r = ["x", "z"] }}
load = [{{ at = "arch:0.5", force = [0.0, -1.0] }}]
path = {{ step = 0.01, branches = "primary", jumps = true, stop = {{ lambda = [-0.5, 0.5] }} }}
wall = [{{ name = "floor", side = "below", contact_surface = "axis", profile = {{ type = "flat", z = -0.02 }} }}]
member.arch = {{ from = "l", to = "r", sine = {{ rise = {}, waves = 1 }}, theory = "elastica", elements = 20, material = "m", section = "s" }}
)toml",
                                         one.rise);
    const test::TracedDeck traced(deck);
    const RecordEvent& limit = event_of(traced, EventKind::limit_point);
    EXPECT_NEAR(limit.lambda, one.limit, 1e-8);
    EXPECT_NEAR(event_of(traced, EventKind::contact_closes).lambda, one.touch, 1e-8);
    ASSERT_TRUE(limit.jump && limit.jump->reason.empty());
    EXPECT_EQ(limit.jump->contact_pattern, "floor");
    ASSERT_EQ(limit.jump->contacts.size(), 1U);
    EXPECT_NEAR(limit.jump->contacts[0].force, one.limit - one.touch, 2e-8);
    // Taken back, the load goes into the floor alone, and nothing moves until that lets go; the highest arch sways
    // before.
    if (one.rise < 0.12) {
      ASSERT_TRUE(limit.jump->on_return);
      EXPECT_NEAR(limit.jump->on_return->lambda, one.touch, 1e-8);
    }
  }
}

// A clamped toggle sways and comes back upright, where its path ends at a pitchfork on the upright one, which is stable
// from there on and comes down onto a floor with both halves at once. Shooting from a clamp to the top, which stays
// upright: θ = 0 where the face is on the floor.
TEST(SwayingToggle, ComesBackUprightAndLandsWithBothHalves) {
  constexpr double touch = 0.723459463513;
  for (const std::string step : {"0.05", "0.0125", "0.005"}) {
    SCOPED_TRACE(step);
    const test::TracedDeck traced(
        title("A clamped toggle above a floor") + material("m", 2.1e4) + rectangle("s", 1.0, 0.3) +
            points({{"a", 0.0, 0.0}, {"top", 10.0, 0.85}, {"b", 20.0, 0.0}}) +
            supports({{"a", "x z rotation"}, {"b", "x z rotation"}}) + member("west", "a", "top", "elastica", 20) +
            member("east", "top", "b", "elastica", 20) + force("top", 0.0, -1.0) + flat_wall("floor", "below", -0.63) +
            monitor("down", "top", "z", flipped) + path("step = 0.05; jumps = false; stop = { lambda = [-3.0, 3.0] }"),
        {"path.step=" + step});
    const Record& record = traced.record();
    ASSERT_EQ(record.branches.size(), 3U);
    EXPECT_EQ(record.branches.back().end.value().reason, EndReason::stop);
    EXPECT_NEAR(record.points.back().lambda, 3.0, 1e-12);
    const RecordEvent& jump = event_of(traced, EventKind::contact_closes);
    EXPECT_EQ(jump.contacts.size(), 2U);
    EXPECT_NEAR(jump.lambda, touch, 1e-8);
    EXPECT_EQ(jump.unstable_before, 0);
    EXPECT_EQ(jump.unstable_after, 0);
  }
}

}  // namespace
// Nothing but the wedge moves two equal fingers. Its circle is as far from the axes as the tips' radius at λ = 15 −
// √(7.25² − 5²), for both at once, and each then bends as one finger alone.
TEST(TwoFingers, AreSpreadByOneWedgeTogether) {
  const std::string fingers = R"toml(
title = "Two equal fingers that a wedge spreads"
material.steel = { E = 2.0e5 }
section.s = { shape = "rectangle", width = 5.0, height = 0.5 }
point = { a = [0.0, 5.0], b = [30.0, 5.0], c = [0.0, -5.0], d = [30.0, -5.0] }
member.up = { from = "a", to = "b", theory = "elastica", material = "steel", section = "s", elements = 10 }
member.down = { from = "c", to = "d", theory = "elastica", material = "steel", section = "s", elements = 10 }
support = { a = ["x", "z", "rotation"], c = ["x", "z", "rotation"] }
wall = [{ name = "wedge", outline = { type = "circle", centre = [45.0, 0.0], radius = 7.0 }, motion = { x = -1.0 } }]
monitor = [{ name = "up", at = "b", component = "z" }, { name = "down", at = "d", component = "z", sign = -1 }]
path = { step = 0.5, stop = { lambda = [-1.0, 12.0] } }
)toml";
  const test::TracedDeck both(fingers);
  const test::TracedDeck alone(fingers, {"wall.wedge.members=[\"up\"]"});
  const double touch = 15.0 - std::sqrt(7.25 * 7.25 - 25.0);
  const RecordEvent& closes = event_of(both, EventKind::contact_closes);
  EXPECT_NEAR(closes.lambda, touch, 1e-9);
  EXPECT_EQ(closes.contacts.size(), 2U);
  EXPECT_NEAR(event_of(alone, EventKind::contact_closes).lambda, touch, 1e-9);
  const RecordPoint &end = both.record().points.back(), &of_one = alone.record().points.back();
  EXPECT_EQ(end.lambda, 12.0);
  for (const double opened : end.monitors) EXPECT_NEAR(opened, of_one.monitors[0], 1e-9);
  test::expect_whole(both);
}

}  // namespace arcwall::deck_answers_test
