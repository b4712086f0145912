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
#include "tests/apps/verify/stored_files_of.hpp"

namespace arcwall::verify::verify_test {

namespace {

using test::example;
using test::TracedDeck;

void expect_confirmed(const TracedDeck& traced) {
  ASSERT_GT(traced.record().points.size(), 5u);
  const Verdict verdict = verify(traced.model(), traced.record(), stored_files_of(traced.record()), "checkpoint");
  EXPECT_FALSE(verdict.findings.first().has_value()) << to_text(*verdict.findings.first());
  for (const CheckSummary& check : verdict.findings.checks()) EXPECT_GT(check.count, 0) << check.name;
}

// A record of one point, cut out of a run.
void expect_confirmed_point(const TracedDeck& traced, const Record& record) {
  const Verdict verdict = verify(traced.model(), record, stored_files_of(record), "checkpoint");
  EXPECT_FALSE(verdict.findings.first().has_value()) << to_text(*verdict.findings.first());
}

bool has_check(const Verdict& verdict, const std::string& name) {
  const auto& checks = verdict.findings.checks();
  return std::any_of(checks.begin(), checks.end(), [&](const CheckSummary& check) { return check.name == name; });
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
         profile + R"(
[path]
step = 0.05
[path.stop]
lambda = [-1.0, 1.0]
[[monitor]]
name = "quarter"
at = "beam:0.25"
component = "z"
[[monitor]]
name = "support"
at = "a"
component = "reaction-z"
)" + more;
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
member.col = { from = "a", to = "b", theory = "classic", material = "steel", section = "col", elements = 20 }
load = [{ at = "b", force = [-1.0, -0.1] }, { on = "col", distributed = [0.0, -0.01], constant = true }]
wall = [
  { name = "under", side = "below", acts_on = "axis", profile = { type = "line", z = 0.0, slope = 0.1 } },
  { name = "over", side = "above", acts_on = "axis", profile = { type = "line", z = 0.0, slope = 0.1 } },
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
       {"theory = \"classic\"", "theory = \"elastica\"\norder = 4", "theory = \"elastica\"\norder = 6",
        "theory = \"exact\"\norder = 1", "theory = \"exact\"\norder = 2", "theory = \"essenburg\"\norder = 1",
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
    const TracedDeck traced(beam_on_wall("theory = \"exact\"\norder = 2", profile));
    ASSERT_GT(traced.record().points.back().contacts, 0);
    expect_confirmed(traced);
    expect_confirmed(TracedDeck(beam_on_wall("theory = \"classic\"", profile)));
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
member.strip = { from = "clamp", to = "tip", theory = "classic", material = "steel", section = "s", elements = 13 }
support = { clamp = ["x", "z", "rotation"] }
load = [{ at = "tip", force = [0.0, -3.3e-4] }]
monitor = [{ name = "tip", at = "tip", component = "z", sign = -1 }]
path = { step = 0.1, stop = { lambda = [-1.0, 2.0] } }
wall = [{ name = "stop", side = "below", profile = )" +
         profile + " }]\n";
}

// A portal whose beam a load bends onto a round hill; a coarse mesh.
constexpr std::string_view portal_on_hill = R"(
title = "A portal on a hill"
material.m = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.28, height = 0.14 }
point = { a = [0.0, 0.0], b = [0.0, 15.0], c = [16.0, 15.0], e = [16.0, 0.0] }
member.west = { from = "a", to = "b", theory = "classic", material = "m", section = "s", elements = 12 }
member.beam = { from = "b", to = "c", theory = "classic", material = "m", section = "s", elements = 24 }
member.east = { from = "c", to = "e", theory = "classic", material = "m", section = "s", elements = 12 }
support = { a = ["x", "z"], e = ["x", "z"] }
load = [{ at = "beam:0.4583333333333333", force = [0.0, -0.14] }, { at = "b", force = [0.0045, 0.0] }]
monitor = [{ name = "sway", at = "b", component = "x" }]
path = { step = 0.05, stop = { lambda = [-1.0, 2.0], sway = [-11.0, 11.0] } }
[[wall]]
name = "hill"
side = "below"
profile = { type = "parabola", apex = [7.8, 14.0], curvature = -0.18 }
members = ["beam"]
)";

}  // namespace

// Elements at the end of a wall have no gap at one of their nodes; on a curved wall elements are no part of it.
TEST(Verify, RunsOnWallsThatEndAndThatAreCurvedHold) {
  expect_confirmed(TracedDeck(strip_above(R"({ type = "circle", centre = [0.66, -0.26], radius = 0.2 })")));
  expect_confirmed(TracedDeck(portal_on_hill));
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

// What increments leave is no equilibrium, and is said not to be checked.
TEST(Verify, IncrementsAreCheckedAgainstTheirFilesAlone) {
  const TracedDeck traced(example("channel"),
                          {"path.method=\"incremental\"", "path.step=0.1", "path.land={lambda=[1.0, 2.0]}"});
  ASSERT_TRUE(traced.model().in_increments());
  expect_confirmed(traced);
  const Verdict verdict = verify(traced.model(), traced.record(), stored_files_of(traced.record()), "checkpoint");
  EXPECT_FALSE(has_check(verdict, "forces balance at nodes"));
  EXPECT_NE(verdict.not_checked.at(0).find("equilibrium"), std::string::npos);
  EXPECT_NE(to_text(verdict).find("- equilibrium"), std::string::npos);
}

// Formulas of its own: the same gaps as tracing has.
TEST(PlainWall, HasTheGapsOfTheWallsThatAreTraced) {
  const std::vector<decltype(deck::Wall::profile)> profiles{
      deck::FlatProfile{0.3},
      deck::LineProfile{0.1, -0.4},
      deck::CircleProfile{{0.2, 1.0}, 3.0},
      deck::ParabolaProfile{{-0.1, 0.5}, 0.7},
      deck::SplineProfile{{-2.0, 2.0}, {0.1, 0.4}},
      deck::SplineProfile{{-2.0, 0.3, 2.0}, {0.1, 0.7, 0.4}},
      deck::SplineProfile{{-2.0, -0.9, 0.1, 0.5, 2.0}, {0.1, 0.6, 0.2, 0.9, 0.4}}};
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> x(-1.9, 1.9), z(-1.0, 1.0);
  for (const auto& profile : profiles)
    for (const Side side : {Side::above, Side::below}) {
      const deck::WallMotion motion{.x = 0.3, .z = -0.2, .rotation = 0.4, .about = {.x = 0.1, .z = 0.5}};
      const deck::Wall wall{.name = "wall", .side = side, .profile = profile, .motion = motion};
      const PlainWall at_rest(wall);
      const auto traced = obstacle_of(wall);
      for (const double lambda : {0.0, 0.3})
        for (int i = 0; i < 50; ++i) {
          const PlainWall plain = at_rest.at(lambda);
          const Vec2 at = motion_of(wall).moved({x(generator), z(generator)}, lambda);
          EXPECT_NEAR(plain.gap(at), traced->gap(at, lambda).value, 1e-13);
          EXPECT_NEAR(plain.slope_angle(at), traced->direction(at, lambda).value, 1e-13);
          EXPECT_NEAR(plain.curvature(at), traced->curvature(at, lambda).value, 1e-11);
        }
    }
}

// Where the cubics of a spline meet, to both sides of each knot, and beyond what is rounded there.
TEST(PlainWall, RoundsKnotsAsTheWallsThatAreTracedAre) {
  const std::vector<double> x{-2.0, -0.9, 0.1, 0.5, 2.0};
  const deck::Wall wall{
      .name = "wall", .side = Side::below, .profile = deck::SplineProfile{x, {0.1, 0.6, 0.2, 0.9, 0.4}}};
  const PlainWall plain(wall);
  const auto traced = obstacle_of(wall);
  for (std::size_t knot = 1; knot + 1 < x.size(); ++knot)
    for (const double off : {-1e-3, -3.9e-6, -2e-6, 0.0, 1.5e-6, 3.8e-6, 1e-3}) {
      const Vec2 at(x[knot] + off, 0.7);
      EXPECT_NEAR(plain.gap(at), traced->gap(at, 0.0).value, 1e-13);
      EXPECT_NEAR(plain.slope_angle(at), traced->direction(at, 0.0).value, 1e-13);
      EXPECT_NEAR(plain.curvature(at), traced->curvature(at, 0.0).value, 1e-11);
    }
}

// Outlines of all types, touched by axes.
TEST(PlainWall, HasTheGapsOfTheOutlinesThatAreTraced) {
  const std::vector<double> x{-1.5, 0.1, 1.4, 0.3, -0.9}, z{-1.0, -0.4, -1.2, 1.1, 0.8};
  const auto points = []<class Outline>(Outline of, std::vector<double> x_of, std::vector<double> z_of, bool closed,
                                        Keep keep) {
    of.x = std::move(x_of);
    of.z = std::move(z_of);
    of.closed = closed;
    of.keep = keep;
    return deck::Outline(of);
  };
  std::vector<std::pair<deck::Outline, double>> outlines{
      {deck::HalfPlaneOutline{{0.1, -0.2}, {-0.3, 0.8}}, 0.0},
      {points(deck::PolylineOutline{}, {-1.5, 0.1, 1.4}, {-0.6, 0.2, -0.5}, false, Keep::outside), 0.0},
      {points(deck::PolylineOutline{}, x, z, false, Keep::outside), 0.1},
      {points(deck::CurveOutline{}, x, z, false, Keep::outside), 0.0},
      {points(deck::CurveOutline{}, {-1.5, 1.4}, {-0.6, 0.2}, false, Keep::outside), 0.0}};
  for (const Keep keep : {Keep::outside, Keep::inside}) {
    outlines.push_back({deck::CircleOutline{{0.1, 0.2}, 0.9, keep}, 0.0});
    outlines.push_back({deck::EllipseOutline{{0.1, 0.2}, {0.5, 1.1}, 0.4, keep}, 0.0});
    outlines.push_back({points(deck::PolylineOutline{}, x, z, true, keep), 0.15});
    outlines.push_back({points(deck::CurveOutline{}, x, z, true, keep), 0.0});
  }
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> anywhere(-2.0, 2.0);
  for (const auto& [outline, corner_radius] : outlines) {
    const deck::WallMotion motion{.x = 0.3, .z = -0.2, .rotation = 0.4, .about = {.x = 0.1, .z = 0.5}};
    const deck::Wall wall{.name = "wall", .outline = outline, .corner_radius = corner_radius, .motion = motion};
    const PlainWall at_rest(wall);
    const auto traced = obstacle_of(wall);
    for (const double lambda : {0.0, 0.3})
      for (int i = 0; i < 100; ++i) {
        const PlainWall plain = at_rest.at(lambda);
        const Vec2 at = motion_of(wall).moved({anywhere(generator), anywhere(generator)}, lambda);
        ASSERT_EQ(plain.faces(at), traced->faces(at, lambda));
        if (!plain.faces(at)) continue;
        const double gap = plain.gap(at);
        EXPECT_NEAR(gap, traced->gap(at, lambda).value, 1e-12);
        EXPECT_NEAR(std::remainder(plain.slope_angle(at) - traced->direction(at, lambda).value, 2.0 * pi), 0.0, 1e-10);
        if (!std::isfinite(plain.curvature(at))) continue;
        EXPECT_NEAR(plain.curvature(at), traced->curvature(at, lambda).value,
                    1e-8 * std::max(1.0, std::abs(plain.curvature(at))));
      }
  }
}

// --- falsified runs -------------------------------------------------------------------------------------------------

namespace {

class FalsifiedRun : public testing::Test {
 protected:
  FalsifiedRun() : traced_(example("channel"), {"contact.points=\"nodes\"", "member.column.elements=16"}) {}

  // The point before the last that carries contact forces and has no event.
  std::size_t pressed_point() const {
    const auto& points = traced_.record().points;
    for (std::size_t i = points.size(); i-- > 0;)
      if (points[i].contacts > 0 && !points[i].event) return i;
    ADD_FAILURE() << "no point in contact";
    return 0;
  }

  // The verdict on a record whose states differ from what its files say.
  Failure first_failure(const std::function<void(Record&)>& change) const {
    Record record = traced_.record();
    change(record);
    return failure(record, stored_files_of(traced_.record()));
  }

  // With one text in a file replaced by another, where it stands last.
  Failure first_failure(std::string StoredFiles::*file, const std::string& text, const std::string& by) const {
    StoredFiles files = stored_files_of(traced_.record());
    const auto at = (files.*file).rfind(text);
    EXPECT_NE(at, std::string::npos) << text;
    (files.*file).replace(at, text.size(), by);
    return failure(traced_.record(), files);
  }

  Failure failure(const Record& record, const StoredFiles& files) const {
    const Verdict verdict = verify(traced_.model(), record, files, "checkpoint");
    EXPECT_TRUE(verdict.findings.first().has_value()) << "not caught";
    return verdict.findings.first().value_or(Failure{});
  }

  Index structure_unknowns() const { return traced_.model().structure().size({}); }

  TracedDeck traced_;
};

// Another digit at the end of a number.
std::string with_other_digit(std::string number) {
  number.back() = number.back() == '5' ? '6' : '5';
  return number;
}

}  // namespace

TEST_F(FalsifiedRun, ADisplacementOffByAMillionthIsCaught) {
  const std::size_t where = pressed_point();
  const Failure first = first_failure([&](Record& record) { record.points[where].state.x[4] += 1e-6; });
  EXPECT_EQ(first.file, "checkpoint");
  EXPECT_EQ(first.step, traced_.record().points[where].step);
  EXPECT_EQ(first.what, "forces balance at nodes: x at column:0.0625") << "the first that the stretch pulls at";
}

TEST_F(FalsifiedRun, AContactThatPullsIsCaught) {
  const std::size_t where = pressed_point();
  const Failure first =
      first_failure([&](Record& record) { record.points[where].state.x[structure_unknowns()] *= -1.0; });
  EXPECT_EQ(first.file, "checkpoint");
  EXPECT_EQ(first.step, traced_.record().points[where].step);
  EXPECT_NE(first.what.find("contact forces push: "), std::string::npos) << first.what;
}

TEST_F(FalsifiedRun, AContactForceThatDoesNotBalanceIsCaught) {
  const Failure first = first_failure(
      [&](Record& record) { record.points[pressed_point()].state.x[structure_unknowns()] *= 1.0 + 1e-4; });
  EXPECT_NE(first.what.find("contact forces balance: "), std::string::npos) << first.what;
}

TEST_F(FalsifiedRun, APenetrationIsCaught) {
  const std::size_t where = pressed_point();
  const Structure& structure = traced_.model().structure();
  // The middle of the column moved through both walls, 0.2 away.
  const Index w = *structure.unknown(structure.freedom(structure.members()[0].nodes[8], Freedom::z));
  for (const double by : {1.0, -1.0}) {
    const Failure first = first_failure([&](Record& record) { record.points[where].state.x[w] += by; });
    EXPECT_EQ(first.step, traced_.record().points[where].step);
    EXPECT_TRUE(first.what.find("closed contacts touch") == 0 || first.what.find("open contacts are outside") == 0)
        << first.what;
  }
}

TEST_F(FalsifiedRun, ACountOffByOneIsCaught) {
  for (const int by : {-1, 1}) {
    Record record = traced_.record();
    const std::size_t where = pressed_point();
    record.points[where].count.unstable = *record.points[where].count.unstable + by;
    const Failure first = failure(record, stored_files_of(record));
    EXPECT_EQ(first.file, "path.csv");
    EXPECT_EQ(first.step, record.points[where].step);
    EXPECT_NE(first.what.find("unstable directions"), std::string::npos) << first.what;
  }
}

// Lee's frame with its loaded point moved: under the force that it has there it loses stability at the greatest force,
// with its movement given where that turns.
TEST(FalsifiedMovedRun, ACountUnderDeadLoadsOffByOneIsCaughtSlow) {
  std::string text(example("lee"));
  const std::string load = "[[load]]\nat = \"loaded\"\nforce = [0.0, -1.0]";
  text.replace(text.find(load), load.size(), "[[prescribed]]\nat = \"loaded\"\nz = -90.0");
  const TracedDeck traced(text);
  const Record& record = traced.record();
  const Verdict verdict = verify(traced.model(), record, stored_files_of(record), "checkpoint");
  EXPECT_FALSE(verdict.findings.first().has_value()) << to_text(*verdict.findings.first());
  EXPECT_TRUE(has_check(verdict, "unstable directions under dead loads"));
  std::set<Index> counts;
  for (std::size_t i = 1; i < record.points.size(); i += 5) {
    if (!record.points[i].unstable_dead || record.points[i].event) continue;
    counts.insert(*record.points[i].unstable_dead - *record.points[i].count.unstable);
    for (const int by : {-1, 1}) {
      Record falsified = record;
      falsified.points[i].unstable_dead = *record.points[i].unstable_dead + by;
      const Verdict found = verify(traced.model(), falsified, stored_files_of(falsified), "checkpoint");
      ASSERT_TRUE(found.findings.first().has_value()) << i;
      EXPECT_NE(found.findings.first()->what.find("unstable_dead is"), std::string::npos) << i;
    }
  }
  EXPECT_EQ(counts, (std::set<Index>{0, 1}));
}

TEST_F(FalsifiedRun, ADigitOfPathCsvIsCaught) {
  const RecordPoint& last = traced_.record().points.back();
  const auto caught = [&](double number, const std::string& what) {
    const std::string text = round_trip(number);
    const Failure first =
        first_failure(&StoredFiles::path_csv, text, with_other_digit(text.substr(0, 7)) + text.substr(7));
    EXPECT_EQ(first.file, "path.csv");
    EXPECT_EQ(first.step, last.step);
    EXPECT_EQ(first.what, "path.csv tells the states: " + what);
    EXPECT_GT(first.value.value(), first.bound.value());
  };
  caught(last.arc, "arc");
  caught(last.monitors[1], "monitor shortening");
  caught(last.energy, "energy");
  const Failure lambda = first_failure(&StoredFiles::path_csv, "," + round_trip(last.lambda) + ",",
                                       "," + round_trip(std::nextafter(last.lambda, 0.0)) + ",");
  EXPECT_EQ(lambda.what, "path.csv tells the states: lambda");
  EXPECT_EQ(first_failure(&StoredFiles::path_csv, ",end\n", ",\n").what,
            "path.csv tells the states: event is \"\" instead of \"end\"");
}

TEST_F(FalsifiedRun, ADigitOfContactsCsvIsCaught) {
  const RecordForce& last = traced_.record().points.back().forces.back();
  const std::string force = round_trip(last.force);
  const Failure first =
      first_failure(&StoredFiles::contacts_csv, force, with_other_digit(force.substr(0, 8)) + force.substr(8));
  EXPECT_EQ(first.file, "contacts.csv");
  EXPECT_NE(first.what.find("force of " + last.label.wall), std::string::npos) << first.what;
  const Failure wall = first_failure(&StoredFiles::contacts_csv, last.label.wall, "other");
  EXPECT_NE(wall.what.find("wall of "), std::string::npos) << wall.what;
}

TEST_F(FalsifiedRun, AnEventThatSaysSomethingElseIsCaught) {
  const Failure lambda = first_failure(&StoredFiles::events_json, "\"lambda\": ", "\"lambda\": 1");
  EXPECT_EQ(lambda.file, "events.json");
  EXPECT_EQ(lambda.what, "events.json tells the states: lambda");
  const Failure count = first_failure(&StoredFiles::events_json, "\"unstable_before\": 0", "\"unstable_before\": 1");
  EXPECT_EQ(count.file, "events.json");
  EXPECT_NE(count.what.find("unstable_before is 1"), std::string::npos) << count.what;
  EXPECT_EQ(first_failure(&StoredFiles::events_json, "\"events\"", "\"others\"").what,
            "events.json tells the states: it cannot be read");
}

TEST_F(FalsifiedRun, AMissingRowIsCaught) {
  StoredFiles files = stored_files_of(traced_.record());
  files.path_csv.erase(files.path_csv.rfind('\n', files.path_csv.size() - 2) + 1);
  const Failure first = failure(traced_.record(), files);
  EXPECT_EQ(first.file, "path.csv");
  EXPECT_NE(first.what.find("rows"), std::string::npos) << first.what;
}

TEST_F(FalsifiedRun, AStateThatIsNotFiniteIsCaught) {
  const Failure first =
      first_failure([](Record& record) { record.points[3].state.x[2] = std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_EQ(first.step, 3);
  EXPECT_EQ(first.what, "states are finite and whole: its unknowns");
}

// With contact that slides: a place moved along the member is no longer tangent. The record is cut down to one point.
TEST(FalsifiedSlidingRun, APlaceAMomentAndAPenetrationAreCaught) {
  const TracedDeck traced(example("channel"), {"member.column.elements=16"});
  Record record = traced.record();
  const auto pressed = [](const RecordPoint& at) { return at.contacts > 0 && !at.event; };
  const auto where = std::find_if(record.points.begin(), record.points.end(), pressed);
  ASSERT_NE(where, record.points.end());
  const RecordPoint point = *where;
  record.points = {point};
  record.events.clear();
  record.branches[0].points = 1;
  record.branches[0].least_lambda = record.branches[0].greatest_lambda = point.lambda;
  expect_confirmed_point(traced, record);

  const State& state = point.state;
  const auto caught = [&](Index unknown, double by) {
    Record falsified = record;
    falsified.points[0].state.x[unknown] += by;
    const Verdict verdict = verify(traced.model(), falsified, stored_files_of(record), "checkpoint");
    EXPECT_TRUE(verdict.findings.first().has_value());
    const std::string what = verdict.findings.first().value_or(Failure{}).what;
    return what.substr(0, what.find(':'));
  };
  const auto& on = static_cast<const SlidingContactLayout&>(*state.piece.layout());
  const Index size = state.x.size(), m = on.mesh().breakpoints();
  const auto [run, position] = on.mesh().breakpoint(0);
  const NodeUnknowns touching = on.mesh().node_unknowns(run, position);
  EXPECT_EQ(caught(size - m, 1e-6), "forces balance at nodes") << "a place";
  EXPECT_EQ(caught(size - 2 * m, 1e-6), "no moment holds a contact");
  EXPECT_EQ(caught(touching[2], 1e-6), "contacts that slide are tangent");
  EXPECT_EQ(caught(touching[1], 1e-3), "closed contacts touch");
}

// --- the list of events
// -----------------------------------------------------------------------------------------------

namespace {

std::vector<ListedEvent> listed_events(const Record& record) {
  std::vector<ListedEvent> list;
  for (const RecordEvent& event : record.events) {
    list.push_back({.kind = std::string(to_text(event.kind)),
                    .branch = event.branch,
                    .step = event.step,
                    .unstable_before = event.unstable_before,
                    .unstable_after = event.unstable_after,
                    .localised = event.localised,
                    .suspected = event.suspected,
                    .monitor = event.monitor.value_or("")});
    for (const RecordContact& contact : event.contacts) list.back().contacts.push_back(contact.label);
  }
  return list;
}

std::optional<Failure> incompleteness(const TracedDeck& traced, const std::vector<ListedEvent>& events,
                                      const Record& record) {
  Findings findings;
  check_completeness(events, record, traced.model(), findings);
  return findings.first();
}

// Decks whose events are of all kinds but spreads.
std::vector<TracedDeck> decks_with_events() {
  std::vector<TracedDeck> decks;
  decks.emplace_back(example("channel"));
  decks.emplace_back(example("channel"),
                     std::vector<std::string>{"contact.points=\"nodes\"", "member.column.elements=16"});
  decks.emplace_back(example("arch"));
  decks.emplace_back(example("cylinder"));
  decks.emplace_back(example("foundation"));
  decks.emplace_back(example("lee"), std::vector<std::string>{"path.watch=[\"down\", \"right\"]"});
  decks.emplace_back(example("truss"));
  return decks;
}

}  // namespace

// Whichever event is taken out of a right list, what it told is missed: but for one-sided branch points, where
// all that changes is told by the change of contact.
TEST(EventList, EveryEventThatIsRemovedIsMissed) {
  std::set<std::string> kinds;
  for (const TracedDeck& traced : decks_with_events()) {
    SCOPED_TRACE(traced.record().title);
    const std::vector<ListedEvent> events = listed_events(traced.record());
    ASSERT_FALSE(incompleteness(traced, events, traced.record()).has_value())
        << to_text(*incompleteness(traced, events, traced.record()));
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (events[i].kind == "start" || events[i].kind == "end" || events[i].suspected) continue;
      const bool one_sided = events[i].kind == "branch-point" && events[i - 1].step == events[i].step;
      if (one_sided) continue;  // the points beside it know of the change of contact alone
      kinds.insert(events[i].kind);
      std::vector<ListedEvent> fewer = events;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      const auto failure = incompleteness(traced, fewer, traced.record());
      EXPECT_TRUE(failure.has_value()) << events[i].kind << " at step " << events[i].step << " is not missed";
      if (!failure) continue;
      EXPECT_TRUE(failure->what.starts_with("the list of events is complete: ")) << failure->what;
    }
  }
  for (const char* kind : {"contact-closes", "contact-opens", "contact-spreads", "limit-point", "displacement-limit"})
    EXPECT_TRUE(kinds.contains(kind)) << kind;
}

TEST(EventList, AnEventThatIsNoneIsSeen) {
  const TracedDeck traced(example("lee"));
  std::vector<ListedEvent> events = listed_events(traced.record());
  const auto limit =
      std::find_if(events.begin(), events.end(), [](const ListedEvent& event) { return event.kind == "limit-point"; });
  ASSERT_NE(limit, events.end());
  ListedEvent false_one = *limit;
  false_one.step -= 2;
  false_one.unstable_after = false_one.unstable_before;
  events.insert(limit, false_one);
  const auto failure = incompleteness(traced, events, traced.record());
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->step, false_one.step);
  EXPECT_NE(failure->what.find("λ does not turn"), std::string::npos) << failure->what;
}

TEST(EventList, ARowMovedFlippedOrBeyondTheBoundIsSeen) {
  const TracedDeck traced(example("arch"));
  const std::vector<ListedEvent> events = listed_events(traced.record());
  const auto no_event = [](const RecordPoint& point) { return point.step > 1 && !point.event; };
  const auto where =
      static_cast<std::size_t>(std::find_if(traced.record().points.begin(), traced.record().points.end(), no_event) -
                               traced.record().points.begin());
  const auto caught = [&](const std::function<void(RecordPoint&)>& change) {
    Record record = traced.record();
    change(record.points[where]);
    return incompleteness(traced, events, record).value_or(Failure{}).what;
  };
  const RecordPoint &before = traced.record().points[where - 1], &at = traced.record().points[where];
  EXPECT_NE(caught([](RecordPoint& point) { ++*point.count.unstable; }).find("without an event"), std::string::npos);
  // Beside the point before it, and a little beyond: λ turns twice.
  EXPECT_NE(caught([&](RecordPoint& point) {
              point.lambda = before.lambda - 0.1 * (at.lambda - before.lambda);
            }).find("λ turns at step"),
            std::string::npos);
  EXPECT_NE(caught([](RecordPoint& point) { point.lambda = 1e3; }).find("turns at step"), std::string::npos);
  Record record = traced.record();
  const deck::StopBounds& bounds = traced.model().deck().path.stop.bounds.front();
  ASSERT_EQ(bounds.name, "lambda");
  record.points.back().lambda = bounds.high + 1e-3;
  EXPECT_EQ(incompleteness(traced, events, record).value_or(Failure{}).what, "no point is beyond path.stop: lambda");
}

// --- traced again
// -----------------------------------------------------------------------------------------------------

TEST(TracedAgain, RightRunsAgree) {
  for (const TracedDeck& traced : decks_with_events()) {
    SCOPED_TRACE(traced.record().title);
    const auto again = traced_again(traced.session());
    ASSERT_TRUE(again.has_value());
    EXPECT_GT(again->points().size(), traced.record().points.size());
    const Comparison comparison = compare(traced.record(), again->record(), step_discretisation(traced.model()));
    EXPECT_TRUE(comparison.differences.empty()) << comparison.differences.front();
    EXPECT_GE(comparison.same, 2);
    EXPECT_GT(comparison.worst_allowed, 0.0);
  }
}

TEST(TracedAgain, AnEventInOneRunOnlyIsNamedWithItsPlace) {
  const TracedDeck traced(example("channel"));
  Record record = traced.record();
  const auto touch = std::find_if(record.events.begin(), record.events.end(),
                                  [](const RecordEvent& event) { return event.kind == EventKind::contact_closes; });
  ASSERT_NE(touch, record.events.end());
  const std::string place = fmt::format("λ = {:.10g}", touch->lambda);
  record.events.erase(touch);
  for (const bool stored_lacks_it : {true, false}) {
    const Comparison comparison =
        stored_lacks_it ? compare(record, traced.record(), 1e-6) : compare(traced.record(), record, 1e-6);
    ASSERT_EQ(comparison.differences.size(), 1u);
    const std::string& what = comparison.differences.front();
    EXPECT_TRUE(what.starts_with("contact-closes of ")) << what;
    EXPECT_NE(what.find(place), std::string::npos) << what;
    EXPECT_NE(what.find(stored_lacks_it ? "in the run with a quarter of the step only" : "in the stored run only"),
              std::string::npos)
        << what;
  }
}

TEST(TracedAgain, AnEventElsewhereAnotherEndAndAnotherContactAreSeen) {
  const TracedDeck traced(example("channel"));
  const auto differences = [&](const std::function<void(Record&)>& change) {
    Record record = traced.record();
    change(record);
    return compare(record, traced.record(), 1e-6).differences.size();
  };
  const double range = traced.record().branches[0].greatest_lambda - traced.record().branches[0].least_lambda;
  EXPECT_EQ(differences([&](Record& record) { record.events[1].lambda += 0.9e-6 * range; }), 0u);
  EXPECT_EQ(differences([&](Record& record) { record.events[1].lambda += 1.1e-6 * range; }), 1u);
  EXPECT_EQ(differences([&](Record& record) {
              record.events[1].lambda += 1.1e-6 * range;
              record.events[1].localised = 1e-6 * range;
            }),
            0u)
      << "what is said to be uncertain";
  EXPECT_EQ(differences([](Record& record) { record.events.back().branch_end->reason = EndReason::min_step; }), 2u);
  const auto with_contact = [](const RecordEvent& event) { return !event.contacts.empty(); };
  EXPECT_EQ(differences([&](Record& record) {
              std::find_if(record.events.begin(), record.events.end(), with_contact)->contacts[0].label.wall = "other";
            }),
            2u);
  EXPECT_EQ(differences([](Record& record) { record.events.insert(record.events.begin() + 1, record.events[1]); }), 1u);
}

// Two contacts that close at one λ by symmetry come in the order that round-off gives.
TEST(TracedAgain, EventsAtOneLambdaHaveNoOrder) {
  const TracedDeck traced(example("channel"));
  Record one = traced.record();
  one.events.insert(one.events.begin() + 2, one.events[1]);
  Record other = one;
  one.events[1].contacts.front().label.wall = other.events[2].contacts.front().label.wall = "left";
  EXPECT_TRUE(compare(one, other, 1e-6).differences.empty());
  one.events[1].lambda -= 1e-3;
  one.events[2].lambda += 1e-3;
  EXPECT_FALSE(compare(one, other, 1e-6).differences.empty());
}

// Suspected events, and what follows where a limit ended a run, are told but prove nothing.
TEST(TracedAgain, WhatIsSuspectedOrCutOffIsReserved) {
  const TracedDeck traced(example("channel"));
  Record record = traced.record();
  record.events.insert(record.events.begin() + 1, RecordEvent{.kind = EventKind::limit_point, .suspected = true});
  record.events.back().branch_end->reason = EndReason::max_points;
  const Comparison comparison = compare(record, traced.record(), 1e-6);
  EXPECT_TRUE(comparison.differences.empty()) << comparison.differences.front();
  ASSERT_EQ(comparison.reservations.size(), 2u);
  EXPECT_NE(comparison.reservations[0].find("suspected"), std::string::npos);
  EXPECT_NE(comparison.reservations[1].find("stopped before"), std::string::npos);
}

}  // namespace arcwall::verify::verify_test
