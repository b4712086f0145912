#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "apps/output/contacts_csv.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/path_csv.hpp"
#include "apps/verify/verify.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/traced_deck.hpp"

// What λ may drive and what holds it, as decks have it: the same events whatever the units, and runs that are
// confirmed.
namespace arcwall::loading_test {

namespace {

using test::TracedDeck;

// The user's units: so many of them are 1 cm and 1 kN.
struct UnitsOf {
  double cm = 1.0, kN = 1.0;

  double stress(double value) const { return value * kN / (cm * cm); }
  double per_length(double value) const { return value * kN / cm; }
  double moment(double value) const { return value * kN * cm; }
};

constexpr UnitsOf centimetres{}, metres{.cm = 0.01, .kN = 1000.0};

// A column of length 2 and square section 0.1 in two members, pinned left and sliding right [cm, kN].
std::string column(const UnitsOf& in, const std::string& more, const std::string& theory = "elastica") {
  return fmt::format(R"(
title = "Column"
[material.m]
E = {:.17g}
nu = 0.29
[section.s]
shape = "rectangle"
width = {height:.17g}
height = {height:.17g}
[point]
A = [0.0, 0.0]
mid = [{mid:.17g}, 0.0]
B = [{end:.17g}, 0.0]
[member]
first = {{ from = "A", to = "mid", theory = "{theory}", elements = 10, material = "m", section = "s" }}
second = {{ from = "mid", to = "B", theory = "{theory}", elements = 10, material = "m", section = "s" }}
[support]
A = ["x", "z"]
B = ["z"]
)",
                     in.stress(21000.0), fmt::arg("height", 0.1 * in.cm), fmt::arg("mid", in.cm),
                     fmt::arg("end", 2.0 * in.cm), fmt::arg("theory", theory)) +
         more;
}

std::vector<RecordEvent> events_of(const TracedDeck& traced, EventKind kind) {
  std::vector<RecordEvent> found;
  for (const RecordEvent& event : traced.record().events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

// The same kinds at the same λ.
void expect_same_events(const TracedDeck& a, const TracedDeck& b, double relative) {
  const auto &first = a.record().events, &second = b.record().events;
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].kind, second[i].kind) << i;
    EXPECT_NEAR(first[i].lambda, second[i].lambda, relative * std::max(1.0, std::abs(first[i].lambda))) << i;
    EXPECT_EQ(first[i].unstable_after, second[i].unstable_after) << i;
  }
}

void expect_confirmed(const TracedDeck& traced) {
  const Record& record = traced.record();
  ASSERT_GT(record.points.size(), 5u);
  const verify::StoredFiles files{.path_csv = path_csv(record, UnitLabels::shown),
                                  .contacts_csv = record.has_walls ? contacts_csv(record, UnitLabels::shown) : "",
                                  .events_json = to_text(events_json(record), JsonLayout::lines)};
  const verify::Verdict verdict = verify::verify(traced.model(), record, files, "checkpoint");
  EXPECT_FALSE(verdict.findings.first().has_value()) << verify::to_text(*verdict.findings.first());
}

// --- springs --------------------------------------------------------------------------------------------------------

// Of every kind, in every direction.
std::string springs(const UnitsOf& in) {
  return fmt::format(R"(
[[load]]
at = "B"
force = [{:.17g}, 0.0]
[[spring]]
at = "mid"
stiffness = {{ x = {:.17g}, z = {:.17g} }}
[[spring]]
at = "first:0.5"
stiffness = {{ rotation = {:.17g} }}
[[spring]]
between = ["A", "B"]
stiffness = {{ x = {:.17g}, rotation = {:.17g} }}
[[spring]]
on = "second"
foundation = {{ x = {:.17g}, z = {:.17g} }}
[path]
step = 0.1
branches = "all"
depth = 1
[path.stop]
lambda = [-0.1, 3.0]
[[monitor]]
name = "mid"
at = "first:0.5"
component = "rotation"
)",
                     -in.kN, in.per_length(0.3), in.per_length(0.8), in.moment(0.02), in.per_length(0.7),
                     in.moment(0.05), in.stress(0.2), in.stress(0.9));
}

}  // namespace

TEST(Springs, GiveTheSameEventsInOtherUnits) {
  const TracedDeck one(column(centimetres, springs(centimetres))), other(column(metres, springs(metres)));
  ASSERT_FALSE(events_of(one, EventKind::branch_point).empty());
  expect_same_events(one, other, 1e-8);
}

TEST(Springs, AreConfirmed) {
  for (const std::string theory : {"classic", "elastica", "exact"}) {
    SCOPED_TRACE(theory);
    const TracedDeck traced(column(centimetres, springs(centimetres), theory));
    expect_confirmed(traced);
  }
}

// A force and a spring between the same places: with a wall that nothing touches the path is the one without.
TEST(Springs, ActWhereForcesDoWhateverTheMesh) {
  const std::string loaded = R"(
[[load]]
at = "B"
force = [-0.2, 0.0]
[[load]]
at = "mid"
force = [0.0, 0.05]
[[spring]]
between = ["A", "mid"]
stiffness = { z = 3.0, rotation = 0.4 }
[path]
step = 0.05
[path.stop]
lambda = [-1.0, 1.0]
[[monitor]]
name = "turn"
at = "first:0.5"
component = "rotation"
)";
  const std::string wall = R"(
[[wall]]
name = "far"
side = "below"
profile = { type = "flat", z = -50.0 }
)";
  const TracedDeck fixed(column(centimetres, loaded)), sliding(column(centimetres, loaded + wall));
  ASSERT_NE(sliding.model().sliding(), nullptr);
  const RecordPoint &a = fixed.record().points.back(), &b = sliding.record().points.back();
  EXPECT_EQ(a.lambda, 1.0);
  EXPECT_EQ(b.lambda, 1.0);
  EXPECT_GT(std::abs(a.monitors.at(0)), 1e-3);
  EXPECT_NEAR(b.monitors.at(0), a.monitors.at(0), 1e-9);
  expect_confirmed(sliding);
}

// A beam that nothing but springs holds is no mechanism.
TEST(Springs, HoldAStructureByThemselves) {
  const std::string held = springs(centimetres);
  std::string deck = column(centimetres, held);
  const std::string supports = "A = [\"x\", \"z\"]\nB = [\"z\"]\n";
  deck.replace(deck.find(supports), supports.size(), "");
  EXPECT_GT(TracedDeck(deck).record().points.size(), 5u);
  const std::size_t first = deck.find("[[spring]]"), behind = deck.find("[path]");
  EXPECT_THROW(TracedDeck(deck.substr(0, first) + deck.substr(behind)), InputError);
}

TEST(Springs, AreNotForBars) {
  const std::string text = R"(
title = "Bar"
material.m.E = 1.0
section.s = { shape = "general", A = 1.0, I = 1.0 }
point = { A = [0.0, 0.0], B = [1.0, 1.0] }
member.bar = { from = "A", to = "B", theory = "truss", elements = 1, material = "m", section = "s" }
support = { A = ["x", "z"], B = ["x"] }
load = [{ at = "B", force = [0.0, -1.0] }]
)";
  const auto problem = [&](const std::string& spring) -> std::string {
    try {
      const Model model(deck::read_deck_text(text + spring, "bar.toml"));
    } catch (const InputError& error) {
      return error.diagnostics().front().key + ": " + error.diagnostics().front().message;
    }
    return "";
  };
  EXPECT_NE(
      problem("spring = [{ on = \"bar\", foundation = { z = 1.0 } }]").find("spring.on: member \"bar\" is a truss"),
      std::string::npos);
  EXPECT_NE(problem("spring = [{ at = \"B\", stiffness = { rotation = 1.0 } }]").find("\"B\" has a rotation"),
            std::string::npos);
  EXPECT_EQ(problem("spring = [{ at = \"B\", stiffness = { z = 1.0 } }]"), "");
}

// --- movements of supports ------------------------------------------------------------------------------------------

namespace {

// The only event of its kind near a λ, as part of a run; fails the test if there is none.
RecordEvent event_near(const TracedDeck& traced, EventKind kind, double lambda) {
  const auto events = events_of(traced, kind);
  const auto nearest = std::min_element(events.begin(), events.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.lambda - lambda) < std::abs(b.lambda - lambda);
  });
  if (nearest != events.end()) return *nearest;
  ADD_FAILURE() << "no such event";
  return {.monitors = {0.0, 0.0, 0.0}};
}

// The column of Selke and Kikuchi's channel, 0.15 from both walls, with a half sine and a third harmonic; its right end
// is pushed by a support [cm, kN].
std::string shortened_channel(const UnitsOf& in, const std::string& more = "") {
  return fmt::format(R"(
title = "Column in a channel, shortened"
[material.m]
E = {E:.17g}
nu = 0.29
[section.s]
shape = "rectangle"
width = {height:.17g}
height = {height:.17g}
[point]
A = [0.0, 0.0]
B = [{length:.17g}, 0.0]
[member.column]
from = "A"
to = "B"
theory = "elastica"
elements = 40
imperfection = [{{ shape = "sine", amplitude = {first:.17g}, waves = 1 }}, {{ shape = "sine", amplitude = {third:.17g}, waves = 3 }}]
material = "m"
section = "s"
[support]
A = ["x", "z"]
B = ["z"]
[[prescribed]]
at = "B"
x = {way:.17g}
[[wall]]
name = "upper"
side = "above"
profile = {{ type = "flat", z = {wall:.17g} }}
[[wall]]
name = "lower"
side = "below"
profile = {{ type = "flat", z = -{wall:.17g} }}
[path]
step = 0.004
[path.stop]
lambda = [-0.01, 0.33]
[[monitor]]
name = "mid"
at = "column:0.5"
component = "z"
)",
                     fmt::arg("E", in.stress(21000.0)), fmt::arg("height", 0.1 * in.cm),
                     fmt::arg("length", 2.0 * in.cm), fmt::arg("first", 0.00176 * in.cm),
                     fmt::arg("third", 0.0001 * in.cm), fmt::arg("way", -in.cm), fmt::arg("wall", 0.2 * in.cm)) +
         more;
}

// An event with the force P with which the support pushes, by shooting.
struct Pushed {
  EventKind kind;
  double shortening, P;
  Index before, after;
};

}  // namespace

// Values of the extensible elastica by shooting. The load limit, at P = 6.863177634771, is no event of this path: the
// column stays stable through it and snaps at the greatest shortening.
TEST(Prescribed, AColumnInAChannelSnapsAtItsGreatestShortening) {
  const TracedDeck traced(shortened_channel(centimetres));
  for (const Pushed& expected : {Pushed{EventKind::contact_closes, 0.032143539028, 0.430672151315, 0, 0},
                                 Pushed{EventKind::contact_spreads, 0.05094848886, 1.713687836575, 0, 0},
                                 Pushed{EventKind::limit_point, 0.140743077449, 6.863020510418, 0, 1},
                                 Pushed{EventKind::limit_point, 0.13624180266, 6.211668066388, 1, 0},
                                 Pushed{EventKind::contact_closes, 0.313633947801, 4.252069687267, 0, 0}}) {
    const RecordEvent found = event_near(traced, expected.kind, expected.shortening);
    EXPECT_NEAR(found.lambda, expected.shortening, 3e-6 * expected.shortening);
    EXPECT_NEAR(-found.monitors[1], expected.P, 1e-4 * expected.P);
    EXPECT_EQ(found.unstable_before, expected.before);
    EXPECT_EQ(found.unstable_after, expected.after);
  }
  EXPECT_EQ(events_of(traced, EventKind::limit_point).size(), 2u);
}

TEST(Prescribed, GivesTheSameEventsInOtherUnits) {
  expect_same_events(TracedDeck(shortened_channel(centimetres)), TracedDeck(shortened_channel(metres)), 1e-8);
}

TEST(Prescribed, IsConfirmedWhateverTheContact) {
  expect_confirmed(TracedDeck(shortened_channel(centimetres)));
  expect_confirmed(TracedDeck(shortened_channel(centimetres, "[contact]\npoints = \"nodes\"\n")));
}

// What is moved gets a column unless a monitor has it.
TEST(Prescribed, HasItsReactionAsAColumn) {
  const auto columns = [](const std::string& more) {
    std::vector<std::string> names;
    const TracedDeck traced(shortened_channel(centimetres, more), {"path.max_points=3"});
    for (const MonitorColumn& column : traced.model().monitors())
      names.push_back(column.name + " [" + column.unit + "]");
    return names;
  };
  const std::string units = "[units]\nlength = \"cm\"\nforce = \"kN\"\n";
  EXPECT_EQ(columns(units), (std::vector<std::string>{"mid [cm]", "reaction-x-B [kN]"}));
  EXPECT_EQ(columns(units + "[[monitor]]\nname = \"P\"\nat = \"B\"\ncomponent = \"reaction-x\"\nsign = -1\n"),
            (std::vector<std::string>{"mid [cm]", "P [kN]"}));
}

// Lee's frame (E = 720, A = 6, I = 2, sides 120, the load at 24) whose loaded point is pushed down: values by two
// independent solvers, also those of the displacement limits under a dead load.
TEST(Prescribed, LeesFrameSnapsWhereItsDeflectionTurns) {
  const TracedDeck traced(R"(
title = "Lee's frame, pushed"
material.m.E = 720.0
section.s = { shape = "general", A = 6.0, I = 2.0 }
[point]
foot = [0.0, 0.0]
corner = [0.0, 120.0]
loaded = [24.0, 120.0]
end = [120.0, 120.0]
[member]
column = { from = "foot", to = "corner", theory = "elastica", elements = 20, material = "m", section = "s" }
left = { from = "corner", to = "loaded", theory = "elastica", elements = 4, material = "m", section = "s" }
right = { from = "loaded", to = "end", theory = "elastica", elements = 16, material = "m", section = "s" }
[support]
foot = ["x", "z"]
end = ["x", "z"]
[[prescribed]]
at = "loaded"
z = -1.0
[path]
step = 1.0
stop = { lambda = [-1.0, 90.0] }
)");
  const RecordEvent down = event_near(traced, EventKind::limit_point, 61.002978851425);
  EXPECT_NEAR(down.lambda, 61.002978851425, 3e-6 * down.lambda);
  EXPECT_NEAR(-down.monitors[0], 1.19441041878, 1e-5);
  EXPECT_EQ(down.unstable_before, 0);
  EXPECT_EQ(down.unstable_after, 1);
  const RecordEvent back = event_near(traced, EventKind::limit_point, 50.746251363189);
  EXPECT_NEAR(back.lambda, 50.746251363189, 3e-6 * back.lambda);
  EXPECT_NEAR(-back.monitors[0], -0.438048021661, 1e-4);
  EXPECT_EQ(back.unstable_after, 0);
  EXPECT_EQ(events_of(traced, EventKind::limit_point).size(), 2u);
  expect_confirmed(traced);
}

// A steep truss (b = 1, h = 5, Green's strain) whose apex is pushed down: it sways between z² = h² − 2b² on both sides,
// in closed form, and has no limit point at all. At rest it moves by symmetry alone, without any unknown.
TEST(Prescribed, ASteepTrussSwaysAndHasNoLimitPoint) {
  const TracedDeck traced(R"(
title = "Steep truss, pushed"
material.m.E = 1.0
section.s = { shape = "general", A = 1.0, I = 1.0 }
point = { left = [-1.0, 0.0], top = [0.0, 5.0], right = [1.0, 0.0] }
[member]
a = { from = "left", to = "top", theory = "truss", elements = 1, material = "m", section = "s" }
b = { from = "top", to = "right", theory = "truss", elements = 1, material = "m", section = "s" }
[support]
left = ["x", "z"]
right = ["x", "z"]
[[prescribed]]
at = "top"
z = -1.0
[path]
step = 0.02
branches = "primary"
stop = { lambda = [-0.5, 10.5] }
)");
  const auto sways = events_of(traced, EventKind::branch_point);
  ASSERT_EQ(sways.size(), 2u);
  EXPECT_NEAR(sways[0].lambda, 5.0 - std::sqrt(23.0), 1e-9);
  EXPECT_NEAR(-sways[0].monitors[0], 0.0723492263943, 1e-9);  // (h² − z²) z EA/L³ there
  EXPECT_EQ(sways[0].unstable_after, 1);
  EXPECT_NEAR(sways[1].lambda, 5.0 + std::sqrt(23.0), 1e-8);
  EXPECT_EQ(sways[1].unstable_after, 0);
  EXPECT_TRUE(events_of(traced, EventKind::limit_point).empty());
  expect_confirmed(traced);
}

// Held while λ varies it is there from the start: as where λ has brought it.
TEST(Prescribed, IsAppliedBeforeThePathWhereItIsConstant) {
  const std::string path =
      "[path]\nstep = 0.1\nland = { lambda = [0.2, 0.4, 0.6, 0.8] }\n[path.stop]\nlambda = [-0.1, 1.0]\n"
      "[[monitor]]\nname = \"mid\"\nat = \"mid\"\ncomponent = \"z\"\n";
  const std::string moved = "[[prescribed]]\nat = \"mid\"\nz = 0.1\nrotation = 0.2\n";
  const std::string load = "[[load]]\nat = \"B\"\nforce = [0.01, 0.0]\n";
  const TracedDeck by_lambda(column(centimetres, moved + path));
  const TracedDeck before(column(centimetres, moved + "constant = true\n" + load + path));
  const std::vector<double>& after = by_lambda.record().points.back().monitors;
  const std::vector<double>& start = before.record().points.front().monitors;
  ASSERT_EQ(start.size(), 3u);
  EXPECT_NEAR(before.record().points.front().lambda, 0.0, 1e-20);
  for (std::size_t i = 0; i < start.size(); ++i) EXPECT_NEAR(start[i], after[i], 1e-9 * (1.0 + std::abs(after[i])));
  expect_confirmed(before);
}

// --- walls that move ------------------------------------------------------------------------------------------------

namespace {

// A pinned sine arch of length 2 and square section 0.1 under a circle that is pushed down on its crown [cm, kN].
std::string indented_arch(const UnitsOf& in, double rise, double stop, const std::string& more = "") {
  return fmt::format(R"(
title = "Sine arch under a round indenter"
[material.m]
E = {E:.17g}
nu = 0.29
[section.s]
shape = "rectangle"
width = {height:.17g}
height = {height:.17g}
[point]
l = [0.0, 0.0]
r = [{length:.17g}, 0.0]
[member.arch]
from = "l"
to = "r"
sine = {{ rise = {rise:.17g}, waves = 1 }}
theory = "elastica"
elements = 40
material = "m"
section = "s"
[support]
l = ["x", "z"]
r = ["x", "z"]
[[wall]]
name = "indenter"
side = "above"
acts_on = "axis"
profile = {{ type = "circle", centre = [{radius:.17g}, {centre:.17g}], radius = {radius:.17g} }}
motion = {{ z = {way:.17g} }}
[path]
step = 0.003
branches = "primary"
watch = ["F"]
[path.stop]
lambda = [-0.01, {stop}]
[[monitor]]
name = "crown"
at = "arch:0.5"
component = "z"
[[monitor]]
name = "F"
wall = "indenter"
component = "force-z"
sign = -1
)",
                     fmt::arg("E", in.stress(21000.0)), fmt::arg("height", 0.1 * in.cm),
                     fmt::arg("length", 2.0 * in.cm), fmt::arg("rise", rise * in.cm), fmt::arg("radius", in.cm),
                     fmt::arg("centre", (1.0 + rise) * in.cm), fmt::arg("way", -in.cm), fmt::arg("stop", stop)) +
         more;
}

}  // namespace

// While it touches at one point the force is that of a dead central load at the same height of the crown; values by
// independent solvers. The force turns, but λ does not: a way does not snap.
TEST(MovingWall, PushesAFlatArchThroughWithoutASnap) {
  const TracedDeck traced(indented_arch(centimetres, 0.1, 0.17));
  const RecordEvent greatest = event_near(traced, EventKind::displacement_limit, 0.056131352628);
  EXPECT_NEAR(greatest.lambda, 0.056131352628, 2e-5 * greatest.lambda);
  EXPECT_NEAR(greatest.monitors[1], 0.17024981411406, 1e-5 * greatest.monitors[1]);
  EXPECT_NEAR(0.1 + greatest.monitors[0], 0.043868647372, 1e-5);
  const RecordEvent least = event_near(traced, EventKind::displacement_limit, 0.147704654127);
  EXPECT_NEAR(least.lambda, 0.147704654127, 2e-5 * least.lambda);
  EXPECT_NEAR(least.monitors[1], 0.039265852399, 1e-4 * least.monitors[1]);
  EXPECT_TRUE(events_of(traced, EventKind::limit_point).empty());
  expect_confirmed(traced);
  expect_same_events(traced, TracedDeck(indented_arch(metres, 0.1, 0.17)), 1e-7);
}

// A steeper arch sways; the round indenter holds it longer than a dead force, under which it sways at a crown of
// 0.1415. Value by an independent solver.
TEST(MovingWall, HoldsASteepArchByItsCurvature) {
  const TracedDeck traced(indented_arch(centimetres, 0.2, 0.2));
  const auto sways = events_of(traced, EventKind::branch_point);
  ASSERT_FALSE(sways.empty());
  EXPECT_NEAR(sways[0].lambda, 0.1024273364847, 2e-5 * sways[0].lambda);
  EXPECT_NEAR(sways[0].monitors[1], 0.8000581193, 3e-5);
  EXPECT_EQ(sways[0].unstable_before, 0);
  EXPECT_EQ(sways[0].unstable_after, 1);
}

// Contact at nodes: the same forces as the mesh becomes fine.
TEST(MovingWall, PushesAtNodesToo) {
  const TracedDeck traced(indented_arch(centimetres, 0.1, 0.05, "[contact]\npoints = \"nodes\"\n"), {"path.watch=[]"});
  expect_confirmed(traced);
  const TracedDeck sliding(indented_arch(centimetres, 0.1, 0.05), {"path.watch=[]"});
  const double at_nodes = traced.record().points.back().monitors[1];
  EXPECT_NEAR(at_nodes, sliding.record().points.back().monitors[1], 1e-4 * at_nodes);
}

// ∂Π/∂λ of a wall is its force against the way; trapezoids of the points' forces sum to the energy.
TEST(MovingWall, DoesTheWorkOfItsForce) {
  const TracedDeck traced(indented_arch(centimetres, 0.1, 0.12), {"path.max_step=0.001"});
  const auto& points = traced.record().points;
  double work = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    work += 0.5 * (points[i].monitors[1] + points[i - 1].monitors[1]) * (points[i].lambda - points[i - 1].lambda);
  EXPECT_NEAR(points.back().energy - points.front().energy, work, 1e-3 * work);
}

// A round obstacle swings up under a beam; whatever is read off it is confirmed.
TEST(MovingWall, IsConfirmedWhereItTurns) {
  const std::string swing = R"(
[[wall]]
name = "swing"
side = "below"
profile = { type = "circle", centre = [1.0, -1.06], radius = 1.0 }
motion = { x = -0.1, z = 0.1, rotation = 0.2, about = [0.5, 0.0] }
[path]
step = 0.1
[path.stop]
lambda = [-0.1, 1.0]
[[monitor]]
name = "moment"
wall = "swing"
component = "moment"
)";
  for (const std::string points : {"sliding", "nodes"}) {
    const TracedDeck traced(column(centimetres, swing), {"contact.points=\"" + points + "\""});
    EXPECT_GT(traced.record().points.back().contacts, 0) << points;
    expect_confirmed(traced);
  }
}

// --- temperatures ---------------------------------------------------------------------------------------------------

namespace {

// The same column between fixed ends, with strain λ from heat. Imperfect in the channel, or straight and alone.
std::string heated_column(const UnitsOf& in, bool in_channel, double step, double stop) {
  std::string deck = shortened_channel(in);
  const auto replace = [&](const std::string& from, const std::string& to) {
    deck.replace(deck.find(from), from.size(), to);
  };
  const auto cut = [&](const std::string& from, const std::string& to) {
    const std::size_t begin = deck.find(from);
    deck.erase(begin, deck.find(to) - begin);
  };
  replace("nu = 0.29", "nu = 0.29\nexpansion = 1e-3");
  replace("B = [\"z\"]", "B = [\"x\", \"z\"]");
  cut("[[prescribed]]", "[[wall]]");
  replace("[[wall]]", "[[load]]\non = \"column\"\ntemperature = 1e3\n[[wall]]");
  if (!in_channel) {
    cut("imperfection", "material = ");
    cut("[[wall]]", "[path]");
  }
  cut("step = 0.004", "[[monitor]]");
  replace("[path]", fmt::format("[path]\nstep = {}\n[path.stop]\nlambda = [-0.01, {}]", step, stop));
  return deck + "[[monitor]]\nname = \"P\"\nat = \"B\"\ncomponent = \"reaction-x\"\nsign = -1\n";
}

}  // namespace

// Between fixed ends a straight pinned column carries EA e without moving, and buckles at e = π² EI/(EA L²), exactly.
// Behind it the loads and amplitudes are those of the extensible elastica by quadrature.
TEST(Heat, BucklesAColumnBetweenFixedEnds) {
  const double critical = pi * pi * 0.175 / (210.0 * 4.0);
  const TracedDeck traced(
      heated_column(centimetres, false, 0.0005, 10.5 * critical),
      {fmt::format("path.land.lambda=[{:.17g},{:.17g},{:.17g}]", 1.1 * critical, 2.0 * critical, 10.0 * critical)});
  const auto buckles = events_of(traced, EventKind::branch_point);
  ASSERT_FALSE(buckles.empty());
  EXPECT_NEAR(buckles[0].lambda, critical, 1e-8 * critical);
  struct Behind {
    double times, P, amplitude;
  };
  for (const Behind& expected :
       {Behind{1.1, 0.4317505766425992, 0.01828635917709559}, Behind{2.0, 0.4313495056895574, 0.05784648299295516},
        Behind{10.0, 0.4278213335740318, 0.1740702473955694}}) {
    const auto& points = traced.record().points;
    const auto found = std::find_if(points.rbegin(), points.rend(), [&](const RecordPoint& point) {
      return std::abs(point.lambda / critical - expected.times) < 1e-9;
    });
    ASSERT_NE(found, points.rend());
    EXPECT_NEAR(found->monitors[1], expected.P, 1e-8);
    EXPECT_NEAR(std::abs(found->monitors[0]), expected.amplitude, 1e-7);
    EXPECT_EQ(found->count.unstable, Index{0});
  }
  expect_confirmed(traced);
}

// In the channel the greatest heat and the greatest force are two events; values of the extensible elastica by
// shooting.
TEST(Heat, SnapsAColumnInAChannelAtTheGreatestHeat) {
  const TracedDeck traced(heated_column(centimetres, true, 0.001, 0.15));
  for (const Pushed& expected : {Pushed{EventKind::contact_closes, 0.01581703139244, 0.423765738927, 0, 0},
                                 Pushed{EventKind::contact_spreads, 0.02483532672461, 1.671915436069, 0, 0},
                                 Pushed{EventKind::limit_point, 0.06540564515039, 6.428468994643, 0, 1},
                                 Pushed{EventKind::limit_point, 0.06348366363517, 5.829107063255, 1, 0},
                                 Pushed{EventKind::contact_closes, 0.13511293387337, 3.663834738234, 0, 0}}) {
    const RecordEvent found = event_near(traced, expected.kind, expected.shortening);
    EXPECT_NEAR(found.lambda, expected.shortening, 3e-6 * expected.shortening);
    EXPECT_NEAR(found.monitors[1], expected.P, 1e-4 * expected.P);
    EXPECT_EQ(found.unstable_after, expected.after);
  }
  expect_confirmed(traced);
  expect_same_events(traced, TracedDeck(heated_column(metres, true, 0.001, 0.15)), 1e-7);
}

TEST(Heat, NeedsAMaterialThatExpandsAndATheoryThatKnowsIt) {
  const auto problem = [](const std::string& from, const std::string& to) -> std::string {
    std::string deck = heated_column(centimetres, false, 0.001, 0.01);
    deck.replace(deck.find(from), from.size(), to);
    try {
      deck::read_deck_text(deck, "hot.toml");
    } catch (const InputError& error) {
      return error.diagnostics().front().message;
    }
    return "";
  };
  EXPECT_EQ(problem("title", "title"), "");
  EXPECT_EQ(problem("expansion = 1e-3\n", "\n"), "material m of member column has no expansion");
  EXPECT_NE(problem("theory = \"elastica\"", "theory = \"essenburg\"").find("knows no temperatures"),
            std::string::npos);
  EXPECT_NE(problem("temperature = 1e3", "temperature = 1e3\ndistributed = [1.0, 0.0]").find("together"),
            std::string::npos);
}

}  // namespace arcwall::loading_test
