#include "apps/verify/verify.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <set>

#include "apps/verify/again.hpp"
#include "apps/verify/completeness.hpp"
#include "apps/verify/plain_wall.hpp"
#include "core/text.hpp"
#include "model/build_contact.hpp"
#include "model/deck/reader.hpp"
#include "model/event_names.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"
#include "tests/apps/verify/stored_files_of.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::verify::verify_test {

using namespace test::tables;

namespace {

using test::example;
using test::TracedDeck;

void expect_confirmed(const TracedDeck& traced) {
  ASSERT_GT(traced.record().points.size(), 5u);
  const Verdict verdict = verify(traced.model(), traced.record(), stored_files_of(traced.record()), "checkpoint");
  EXPECT_FALSE(verdict.findings.first().has_value()) << to_text(*verdict.findings.first());
  for (const CheckSummary& check : verdict.findings.checks()) EXPECT_GT(check.count, 0) << check.name;
}

// A beam that its load bends onto a wall; %PROFILE and %THEORY are to be filled in.
std::string beam_on_wall(const std::string& theory, const std::string& profile, const std::string& more = "") {
  return R"(
title = "A beam on a wall"
[material.m]
E = 2.1e4
nu = 0.3
[section.s]
shape = "rectangle"
width = 1.0
height = 0.1
[point]
a = [-5.0, 0.0]
b = [5.0, 0.0]
[member.beam]
from = "a"
to = "b"
material = "m"
section = "s"
elements = 12
)" + theory +
         R"(
[support]
a = ["x", "z"]
b = ["z"]
[[load]]
on = "beam"
distributed = [0.0, -0.01]
[[load]]
at = "beam:0.5"
force = [0.0, -1e-3]
constant = true
[[wall]]
name = "floor"
side = "below"
profile = )" +
         profile + "\n" + path("step = 0.05; stop = { lambda = [-1.0, 1.0] }") + monitor("quarter", "beam:0.25", "z") +
         monitor("support", "a", "reaction-z") + more;
}

const std::string flat = R"({ type = "flat", z = -0.6 })";

}  // namespace

TEST(Verify, EveryExampleHoldsSlow) {
  for (const std::string name : {"arch", "cantilever", "channel", "cylinder", "foundation", "lee", "truss"}) {
    SCOPED_TRACE(name);
    expect_confirmed(TracedDeck(example(name)));
  }
  expect_confirmed(TracedDeck(example("thick"), {"member.beam.elements=6"}));
}

TEST(Verify, EveryContactLawHolds) {
  for (const std::string law : {R"(contact.points="nodes")", R"(contact={method="penalty",penalty=1e3})",
                                R"(contact={method="augmented",penalty=1e3})"}) {
    SCOPED_TRACE(law);
    const TracedDeck traced(example("channel"), {law, "member.column.elements=16"});
    ASSERT_GT(traced.record().points.back().contacts, 0);
    expect_confirmed(traced);
  }
}

// A column that two walls hold without clearance, rigid ones and springs; it buckles on the latter.
TEST(Verify, WallsOnBothSidesWithoutClearanceHold) {
  constexpr const char* column = R"toml(
title = "A column between walls without clearance"
material.steel = { E = 2.1e5 }
section.col = { shape = "rectangle", width = 10.0, height = 5.0 }
point = { a = [0.0, 0.0], b = [1000.0, 100.0] }
support = { a = ["x", "z", "rotation"] }
member.col = { from = "a", to = "b", theory = "euler-bernoulli", material = "steel", section = "col", elements = 20 }
load = [{ at = "b", force = [-1.0, -0.1] }, { on = "col", distributed = [0.0, -0.01], constant = true }]
wall = [
  { name = "under", side = "below", contact_surface = "axis", profile = { type = "line", z = 0.0, slope = 0.1 } },
  { name = "over", side = "above", contact_surface = "axis", profile = { type = "line", z = 0.0, slope = 0.1 } },
]
monitor = [{ name = "mid", at = "col:0.5", component = "z" }]
path = { step = 50.0, max_step = 0.005, stop = { lambda = [-10.0, 6000.0], mid = [-5.0, 5.0] } }
)toml";
  for (const std::string law :
       {"contact={}", R"(contact={method="augmented",penalty=10.0})", R"(contact={method="penalty",penalty=0.2})"}) {
    SCOPED_TRACE(law);
    const TracedDeck traced(column, {law});
    EXPECT_EQ(traced.record().points.back().contacts, 2 * 20);
    expect_confirmed(traced);
  }
}

TEST(Verify, EveryTheoryAndWallHoldsSlow) {
  for (const std::string theory :
       {"theory = \"euler-bernoulli\"", "theory = \"elastica\"\norder = 4", "theory = \"elastica\"\norder = 6",
        "theory = \"reissner\"\norder = 1", "theory = \"reissner\"\norder = 2", "theory = \"essenburg\"\norder = 1",
        "theory = \"essenburg\"\norder = 2\nalong = \"director\""}) {
    SCOPED_TRACE(theory);
    const TracedDeck traced(beam_on_wall(theory, flat));
    EXPECT_GT(traced.record().points.back().contacts, 0);
    expect_confirmed(traced);
  }
  for (const std::string profile :
       {R"({ type = "line", z = -0.6, slope = 0.02 })",
        R"({ type = "parabola", apex = [0.2, -0.5], curvature = -0.02 })",
        R"({ type = "circle", centre = [0.0, -30.5], radius = 30.0 })",
        R"({ type = "spline", x = [-6.0, -3.0, 0.0, 2.5, 6.0], z = [-0.9, -0.6, -0.5, -0.55, -0.9] })"}) {
    SCOPED_TRACE(profile);
    const TracedDeck traced(beam_on_wall("theory = \"reissner\"\norder = 2", profile));
    ASSERT_GT(traced.record().points.back().contacts, 0);
    expect_confirmed(traced);
    expect_confirmed(TracedDeck(beam_on_wall("theory = \"euler-bernoulli\"", profile)));
  }
}

namespace {

// A strip of 13 elements that its tip load bends down; a wall below is to be filled in.
std::string strip_above(const std::string& profile) {
  return R"(
title = "A strip above a wall"
material.steel = { E = 21000.0 }
section.s = { shape = "rectangle", width = 0.04, height = 0.02 }
point = { clamp = [0.0, 0.0], tip = [1.3, 0.0] }
member.strip = { from = "clamp", to = "tip", theory = "euler-bernoulli", material = "steel", section = "s", elements = 13 }
support = { clamp = ["x", "z", "rotation"] }
load = [{ at = "tip", force = [0.0, -3.3e-4] }]
monitor = [{ name = "tip", at = "tip", component = "z", sign = -1 }]
path = { step = 0.1, stop = { lambda = [-1.0, 2.0] } }
wall = [{ name = "stop", side = "below", profile = )" +
         profile + " }]\n";
}

// A portal whose beam a load bends onto a round hill; a coarse mesh.
const std::string portal_on_hill =
    title("A portal on a hill") + material("m", 2.1e4) + rectangle("s", 0.28, 0.14) +
    points({{"a", 0.0, 0.0}, {"b", 0.0, 15.0}, {"c", 16.0, 15.0}, {"e", 16.0, 0.0}}) +
    member("west", "a", "b", "euler-bernoulli", 12) + member("beam", "b", "c", "euler-bernoulli", 24) +
    member("east", "c", "e", "euler-bernoulli", 12) + supports({{"a", "x z"}, {"e", "x z"}}) +
    force("beam:0.4583333333333333", 0.0, -0.14) + force("b", 0.0045, 0.0) + monitor("sway", "b", "x") +
    path("step = 0.05; stop = { lambda = [-1.0, 2.0], sway = [-11.0, 11.0] }") +
    wall(
        "hill",
        R"(side = "below"; profile = { type = "parabola", apex = [7.8, 14.0], curvature = -0.18 }; members = ["beam"])");

}  // namespace

// Elements at the end of a wall have no gap at one of their nodes; on a curved wall elements are no part of it.
TEST(Verify, RunsOnWallsThatEndAndThatAreCurvedHold) {
  expect_confirmed(TracedDeck(strip_above(R"({ type = "circle", centre = [0.66, -0.26], radius = 0.2 })")));
  expect_confirmed(TracedDeck(portal_on_hill));
}

// A strip that is wound down a drum until its tip touches that, a thousandth of the radius from where the profile is
// vertical: the wall's normal there turns within the differences that the others are taken with.
TEST(Verify, ATouchBesideTheEndOfACircleHolds) {
  expect_confirmed(TracedDeck(R"toml(
title = "A strip wound down a circle until its tip touches"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.618, height = 0.1205 }
point = { clamp = [0.0, 0.0], tip = [27.0, 0.0] }
support = { clamp = ["x", "z", "rotation"] }
load = [{ at = "tip", moment = -0.035 }]
wall = [{ name = "drum", side = "below", profile = { type = "circle", centre = [9.42, -13.276], radius = 11.1713 } }]
path = { step = 0.1, stop = { lambda = [-1.0, 5.3] } }
member.strip = { from = "clamp", to = "tip", theory = "euler-bernoulli", material = "steel", section = "s", elements = 30 }
)toml"));
}

// At the spreading of a clamped column's touch both spans are neutral; the row there says that stability is undecided.
TEST(Verify, ANeutralSpanAtAChangeOfContactHolds) {
  expect_confirmed(TracedDeck(R"(
title = "a clamped column between walls"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 5.177260424129696, height = 2.3035284272892818 }
point = { left = [0.0, 0.0], right = [65.99690486418933, 0.0] }
member.column = { from = "left", to = "right", theory = "euler-bernoulli", material = "steel", section = "s", elements = 16 }
support = { left = ["x", "z", "rotation"], right = ["z", "rotation"] }
load = [{ at = "right", force = [-1003.7634744502974, 0.0] }]
wall = [{ name = "upper", side = "above", profile = { type = "flat", z = 2.5511640248401424 } }, { name = "lower", side = "below", profile = { type = "flat", z = -2.5511640248401424 } }]
path = { step = 0.05, jumps = false, stop = { lambda = [-1.0, 5.0] } }
)"));
}

// Both ends of a free span inside a part come together where the pressure between them is zero: on the mesh of the part
// the node there pulls by the error of its element.
TEST(Verify, APartThatClosesWhereItHasNoPressureHolds) {
  expect_confirmed(TracedDeck(R"(
title = "a sine arch pressed onto a floor"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.4437846259858828, height = 0.14367804052109273 }
point = { left = [0.0, 0.0], right = [12.840521238569345, 0.0] }
member.arch = { from = "left", to = "right", theory = "elastica", material = "steel", section = "s", elements = 20, sine = { rise = 0.6163417683782546, waves = 1 } }
support = { left = ["x", "z"], right = ["x", "z"] }
load = [{ on = "arch", distributed = [0.0, -0.013195084863219153] }]
wall = [{ name = "lower", side = "below", profile = { type = "flat", z = -0.463283826579837 } }]
path = { step = 0.05, jumps = false, branches = "primary", stop = { lambda = [-3.0, 3.0] } }
)"));
}

// Sharp corners have no normal of their own where they hold a column between them, which has turned there; it is drawn
// through them to its end, where next to nothing of it is left on one side.
TEST(Verify, KnifeEdgesPressAcrossTheAxis) {
  expect_confirmed(TracedDeck(
      title("A column between knife edges") + material("m", 1.0) + general_section("s", 1e5, 1.0) +
      points({{"a", 0.0, 0.0}, {"b", 1.0, 0.0}}) + member("column", "a", "b", "elastica", 24) +
      supports({{"a", "x z"}, {"b", "z"}}) + force("b", -1.0, 0.0) +
      wall("over",
           R"(contact_surface = "axis"; outline = { type = "polyline", x = [0.6, 0.5, 0.4], z = [0.2, 0.0, 0.2] })") +
      wall("under",
           R"(contact_surface = "axis"; outline = { type = "polyline", x = [0.4, 0.5, 0.6], z = [-0.2, 0.0, -0.2] })") +
      monitor("off", "column:0.75", "z") + path("step = 5.0; max_step = 0.05; stop = { off = [-0.6, 0.6] }")));
}

// The apex of a steep truss gives way sideways alone where its stiffness in that direction, the whole row of it, is
// zero: by round-off it is on either side of zero at the place itself.
TEST(Verify, ADofThatIsCriticalByItselfIsSeen) {
  for (const double height : {3.0, 4.0, 5.0, 6.3, 7.0, 8.0}) {
    SCOPED_TRACE(height);
    const TracedDeck traced(fmt::format(R"(
title = "A steep truss"
material.m = {{ E = 1.0 }}
section.s = {{ shape = "general", A = 1.0, I = 1.0 }}
point = {{ left = [-1.0, 0.0], top = [0.0, {0}], right = [1.0, 0.0] }}
member.a = {{ from = "left", to = "top", theory = "truss", strain = "green", material = "m", section = "s", elements = 1 }}
member.b = {{ from = "top", to = "right", theory = "truss", strain = "green", material = "m", section = "s", elements = 1 }}
support = {{ left = ["x", "z"], right = ["x", "z"] }}
load = [{{ at = "top", force = [0.0, -1.0] }}]
monitor = [{{ name = "w", at = "top", component = "z" }}]
path = {{ method = "spherical", step = 0.005, branches = "most-stable", stop = {{ w = [-{0}, 0.5] }} }}
)",
                                        height));
    EXPECT_GE(events_of(traced, EventKind::branch_point).size(), 1u);
    expect_confirmed(traced);
  }
}

// States of a strip that nothing touches, held against a peg that stands in its way between two nodes, and is a tenth
// of an element wide: the elements' ends know nothing of it.
TEST(Verify, APegBetweenTwoNodesIsSeen) {
  const TracedDeck traced(strip_above(R"({ type = "circle", centre = [0.65, -9.0], radius = 0.005 })"));
  ASSERT_EQ(traced.record().points.back().contacts, 0);
  EXPECT_GT(traced.record().points.back().monitors[0], 0.1);
  const Model with_peg(deck::read_deck_text(
      strip_above(R"({ type = "circle", centre = [0.65, -0.02], radius = 0.005 })"), "deck.toml", {}));
  const Verdict verdict = verify(with_peg, traced.record(), stored_files_of(traced.record()), "checkpoint");
  ASSERT_TRUE(verdict.findings.first().has_value());
  EXPECT_TRUE(verdict.findings.first()->what.starts_with("no wall is entered between nodes: stop at strip:0.5"))
      << verdict.findings.first()->what;
}

// A peg between two places that a strip has one after the other, both of them clear of it.
TEST(Verify, APegThatAStripPassesIsSeen) {
  const TracedDeck traced(strip_above(R"({ type = "circle", centre = [0.65, -9.0], radius = 0.005 })"),
                          {"path.step=1.0", "path.max_step=1.0"});
  const std::vector<RecordPoint>& points = traced.record().points;
  const auto depth = [&](std::size_t i) {
    const SlidingMesh& mesh = sliding_layout(points[i].state.active_set).mesh();
    return -mesh.place({.strand = 0, .s = 0.65}, mesh_state_of(points[i].state)).position.y();
  };
  std::size_t last = 1;  // of the longest step
  for (std::size_t i = 1; i < points.size(); ++i)
    if (depth(i) - depth(i - 1) > depth(last) - depth(last - 1)) last = i;
  const double between = 0.5 * (depth(last - 1) + depth(last)), radius = 0.001;
  ASSERT_GT(0.5 * (depth(last) - depth(last - 1)), 0.01 + 2.0 * radius);
  const auto verdict_beside = [&](double depth_of_peg) {
    const std::string profile = R"(side = "below", profile = {})";
    std::string deck = strip_above("{}");
    deck.replace(
        deck.find(profile), profile.size(),
        fmt::format(R"(outline = {{ type = "circle", centre = [0.65, {}], radius = {} }})", -depth_of_peg, radius));
    const Model with_peg(deck::read_deck_text(deck, "deck.toml", {}));
    return verify(with_peg, traced.record(), stored_files_of(traced.record()), "checkpoint");
  };
  const auto found = verdict_beside(between).findings.first();
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->what.starts_with("no wall is passed through between two points: strip ")) << found->what;
  EXPECT_EQ(found->step, points[last].step);
}

// What increments leave is no equilibrium, and is said not to be checked.
TEST(Verify, IncrementsAreCheckedAgainstTheirFilesAlone) {
  const TracedDeck traced(example("channel"),
                          {"path.method=\"incremental\"", "path.step=0.1", "path.output_at={lambda=[1.0, 2.0]}"});
  ASSERT_TRUE(traced.model().in_increments());
  expect_confirmed(traced);
  const Verdict verdict = verify(traced.model(), traced.record(), stored_files_of(traced.record()), "checkpoint");
  EXPECT_FALSE(has_check(verdict, "forces balance at nodes"));
  EXPECT_NE(verdict.not_checked.at(0).find("equilibrium"), std::string::npos);
  EXPECT_NE(to_text(verdict).find("- equilibrium"), std::string::npos);
}

// Differences over 10⁻⁴ of an element would compress one with EA h²/EI = 1.4·10⁵ by 14 EI/h², and it buckles at 10.
TEST(Verify, SlenderElementsDoNotBuckleInItsSteps) {
  const TracedDeck traced(title("A slender beam of a wavy shape") + material("m", 1.0) +
                          general_section("s", 2e7, 1.0) + points({{"a", 0.0, 0.0}, {"b", 1.0, 0.0}}) +
                          supports({{"a", "x z rotation"}, {"b", "z"}}) +
                          member("c", "a", "b", "elastica", 12, imperfection({{3, 0.01}})) + force("c:0.25", 0.0, 3.0) +
                          path("step = 0.1; stop = { lambda = [-0.5, 1.0] }"));
  test::expect_whole(traced);
}

}  // namespace arcwall::verify::verify_test
