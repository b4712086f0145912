// Movements that take hold of their points where these are as a stage begins: [[prescribed]] with from = "stage".
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "apps/output/load_text.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/writer.hpp"
#include "tests/apps/loading/loading_decks.hpp"
#include "tests/model/friction_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::grips_test {

using namespace test::tables;

using loading_test::expect_confirmed;
using test::TracedDeck;

namespace {

// A cantilever of length 1 with EI = 1 that hardly stretches, with what acts on its end b.
std::string cantilever(const std::string& more, const std::string& theory = "elastica") {
  return R"(
title = "Gripped cantilever"
[material.m]
E = 1.0
nu = 0.3
[section.s]
shape = "general"
A = 1e6
I = 1.0
[point]
a = [0.0, 0.0]
b = [1.0, 0.0]
[support]
a = ["x", "z", "rotation"]
[[load]]
at = "b"
force = [0.0, -1.0]
[member.m]
from = "a"
to = "b"
material = "m"
section = "s"
elements = 20
theory = ")" +
         theory + "\"\n" + more;
}

std::string stage(const std::string& name, const std::string& drives, double step, double low, double high) {
  return fmt::format(
      "[[stage]]\nname = \"{}\"\ndrives = [{}]\nstep = {:.17g}\nstop = {{ lambda = [{:.17g}, {:.17g}] }}\n", name,
      drives, step, low, high);
}

std::string floor_at(double z, const std::string& more = "") {
  return fmt::format(
             "[[wall]]\nname = \"floor\"\nside = \"below\"\ncontact_surface = \"axis\"\nprofile = {{ type = \"flat\", "
             "z = {:.17g} "
             "}}\n",
             z) +
         more;
}

double value_of(const TracedDeck& run, const std::string& name, const RecordPoint& point) {
  for (std::size_t i = 0; i < run.record().columns.size(); ++i)
    if (run.record().columns[i].name == name) return point.monitors[i];
  ADD_FAILURE() << "no column " << name;
  return 0.0;
}

const RecordPoint& last_of(const TracedDeck& run, const std::string& stage) {
  const RecordPoint* last = nullptr;
  for (const RecordPoint& point : run.record().points)
    if (run.record().stage_of(point.branch) == stage) last = &point;
  if (last != nullptr) return *last;
  ADD_FAILURE() << "no point of stage " << stage;
  return run.record().points.back();
}

const RecordPoint& first_of(const TracedDeck& run, const std::string& stage) {
  for (const RecordPoint& point : run.record().points)
    if (run.record().stage_of(point.branch) == stage) return point;
  ADD_FAILURE() << "no point of stage " << stage;
  return run.record().points.front();
}

// The elastica of length 1 and EI = 1 that is clamped level and drawn down at its free end by a force P across it, by
// its modulus k (Bisshopp and Drucker 1945): √P = K(k) − F(k, φ), sin φ = 1/(k √2), sink of the end 1 − 2 (E(k) − E(k,
// φ))/√P.
struct DrawnElastica {
  double force, sink;

  explicit DrawnElastica(double k) {
    const double phi = std::asin(1.0 / (k * std::numbers::sqrt2));
    const double root = std::comp_ellint_1(k) - std::ellint_1(k, phi);
    force = root * root;
    sink = 1.0 - 2.0 * (std::comp_ellint_2(k) - std::ellint_2(k, phi)) / root;
  }

  static DrawnElastica with_sink(double sink) {
    double low = 0.7072, high = 0.9999;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (DrawnElastica(middle).sink < sink ? low : high) = middle;
    }
    return DrawnElastica(low);
  }
};

const std::string grip_of_z = "[[prescribed]]\nat = \"b\"\nz = -1.0\nfrom = \"stage\"\n";
const std::string bend = stage("bend", "\"load.0\"", 0.2, -1.0, 3.0);

// Stopped after so many points and taken up again, to the last bit.
void expect_resumed_alike(const std::string& deck, const TracedDeck& whole, std::size_t stop) {
  Session run = make_session(
      {.deck = "deck.toml", .deck_text = deck, .assignments = {"path.jumps=false"}});  // as TracedDeck has it
  for (std::size_t i = 0; i < stop; ++i) ASSERT_NE(run.next(), nullptr);
  Session resumed = resume_session(run.checkpoint(), "checkpoint", Session::Resume::go_on);
  while (resumed.next() != nullptr) {
  }
  EXPECT_EQ(path_csv(resumed.record(), UnitLabels::shown), path_csv(whole.record(), UnitLabels::shown)) << stop;
  EXPECT_EQ(to_text(events_json(resumed.record()), JsonLayout::lines),
            to_text(events_json(whole.record()), JsonLayout::lines))
      << stop;
}

void expect_resumed_alike(const std::string& deck, const TracedDeck& whole) {
  const auto& points = whole.record().points;
  const auto begins = [&](const RecordPoint& point) { return whole.record().stage_number(point.branch) > 0; };
  const auto gripped = static_cast<std::size_t>(std::find_if(points.begin(), points.end(), begins) - points.begin());
  ASSERT_GT(points.size(), gripped + 2);
  for (const std::size_t stop : {gripped - 1, gripped, gripped + 1, gripped + 2, points.size() - 1})
    expect_resumed_alike(deck, whole, stop);
}

// The first problem of the gripped cantilever with these prescribed movements and stages.
std::string problem_of(const std::string& movements, const std::string& stages) {
  try {
    deck::read_deck_text(cantilever(movements + stages), "grip.toml");
  } catch (const InputError& error) {
    return to_text(error.diagnostics().front());
  }
  return "";
}

}  // namespace

// Gripped all round at its end and relieved of its force, a cantilever does not move: the grip bears what the force
// was.
TEST(Grip, BearsTheForceThatIsReleased) {
  const std::string grip = "[[prescribed]]\nat = \"b\"\nx = 0.0\nz = 0.0\nrotation = 0.0\nfrom = \"stage\"\n";
  const std::string monitors = monitor("x", "b", "x") + monitor("z", "b", "z") + monitor("turn", "b", "rotation") +
                               monitor("R", "b", "reaction-z") + monitor("H", "b", "reaction-x") +
                               monitor("M", "b", "reaction-moment");
  for (const std::string theory : {"elastica", "euler-bernoulli", "reissner", "essenburg"}) {
    SCOPED_TRACE(theory);
    const std::string walls = theory == "elastica" ? floor_at(-5.0) : "";
    std::string deck = cantilever(
        grip + monitors + walls + bend + stage("release", "\"load.0\", \"prescribed.0\"", -0.2, -3.0, 1.0), theory);
    if (theory == "essenburg") {
      deck.replace(deck.find("E = 1.0"), 7, "E = 1e3");
      deck.replace(deck.find("shape = \"general\"\nA = 1e6\nI = 1.0"), 33,
                   "shape = \"rectangle\"\nwidth = 12.0\nheight = 0.1");
    }
    const TracedDeck run(deck);
    const RecordPoint &bent = last_of(run, "bend"), &gripped = first_of(run, "release"),
                      &released = last_of(run, "release");
    ASSERT_EQ(bent.lambda, 3.0);
    ASSERT_EQ(released.lambda, -3.0);
    for (const char* place : {"x", "z", "turn"}) {
      EXPECT_NEAR(value_of(run, place, gripped), value_of(run, place, bent), 1e-12) << place;
      EXPECT_NEAR(value_of(run, place, released), value_of(run, place, bent), 1e-12) << place;
    }
    for (const char* force : {"R", "H", "M"}) {
      EXPECT_EQ(value_of(run, force, bent), 0.0) << force;
      EXPECT_NEAR(value_of(run, force, gripped), 0.0, 1e-8) << force;
    }
    EXPECT_NEAR(value_of(run, "R", released), -3.0, 1e-8);
    EXPECT_NEAR(value_of(run, "H", released), 0.0, 1e-8);
    EXPECT_NEAR(value_of(run, "M", released), 0.0, 1e-8);
    EXPECT_EQ(released.count.unstable, 0);
    expect_confirmed(run);
  }
}

// Moved on from there, its force is that of the elastica; so it is with moving contact and with contact at nodes, whose
// wall it does not touch. Relieved of its load, the end stays, and the grip bears all of it.
TEST(Grip, MovesOnFromWhereThePointWas) {
  const double more = 0.2;
  for (const std::string& contact :
       {std::string(), floor_at(-5.0), floor_at(-5.0, "[contact]\npoints = \"nodes\"\n")}) {
    SCOPED_TRACE(contact);
    std::string deck = cantilever(grip_of_z + contact + monitor("z", "b", "z") + monitor("R", "b", "reaction-z") +
                                  bend + stage("draw", "\"prescribed.0\"", 0.02, -1.0, more) +
                                  stage("release", "\"load.0\"", -0.2, -3.0, 1.0));
    deck.replace(deck.find("A = 1e6"), 7, "A = 1e8");  // it hardly stretches
    const TracedDeck run(deck);
    const RecordPoint &bent = last_of(run, "bend"), &drawn = last_of(run, "draw"), &released = last_of(run, "release");
    const double sink = -value_of(run, "z", bent);
    ASSERT_EQ(drawn.lambda, more);
    ASSERT_EQ(released.lambda, -3.0);
    EXPECT_NEAR(DrawnElastica::with_sink(sink).force, 3.0, 1e-5);
    const double force = DrawnElastica::with_sink(sink + more).force;
    EXPECT_NEAR(value_of(run, "z", drawn), -sink - more, 1e-12);
    EXPECT_NEAR(value_of(run, "R", drawn), -(force - 3.0), 1e-5 * force);
    EXPECT_NEAR(value_of(run, "z", released), -sink - more, 1e-12);
    EXPECT_NEAR(value_of(run, "R", released), -force, 1e-5 * force);
    expect_confirmed(run);
    expect_resumed_alike(deck, run);
  }
}

// A strip of two members that is pressed on a floor, and then gripped at its middle and drawn up: the same as one whose
// middle is drawn from its place at rest. Its end lies on the floor in a point and, pressed harder, along a stretch.
TEST(Grip, OfAStripOnAFloorIsThatOfAMovementFromRest) {
  const auto strip = [](const std::string& more, const std::string& contact) {
    return title("Strip pressed on a floor") + material("m", 1.0) + general_section("s", 1e5, 1.0) +
           points({{"a", 0.0, 0.0}, {"mid", 0.5, 0.0}, {"b", 1.0, 0.0}}) + member("first", "a", "mid", "elastica", 10) +
           member("second", "mid", "b", "elastica", 10) + supports({{"a", "x z rotation"}}) +
           distributed("second", 0.0, -30.0) + floor_at(-0.1, contact) + monitor("z", "mid", "z") +
           monitor("turn", "mid", "rotation") + monitor("tip", "b", "x") + monitor("R", "mid", "reaction-z") +
           "[[monitor]]\nname = \"wall\"\nwall = \"floor\"\ncomponent = \"force-z\"\n" + more;
  };
  for (const std::string points : {"", "[contact]\npoints = \"nodes\"\n"}) {
    SCOPED_TRACE(points);
    const std::string press = stage("press", "\"load.0\"", 0.02, -1.0, 1.0);
    const std::string deck = strip("[[prescribed]]\nat = \"mid\"\nz = 1.0\nfrom = \"stage\"\n" + press +
                                       stage("draw", "\"prescribed.0\"", 0.002, -1.0, 0.02),
                                   points);
    const TracedDeck gripped(deck);
    const RecordPoint &pressed = last_of(gripped, "press"), &drawn = last_of(gripped, "draw");
    ASSERT_GT(pressed.contacts, 0);
    ASSERT_EQ(drawn.lambda, 0.02);
    const double z = value_of(gripped, "z", drawn);
    EXPECT_NEAR(z, value_of(gripped, "z", pressed) + 0.02, 1e-12);
    EXPECT_NEAR(value_of(gripped, "R", first_of(gripped, "draw")), 0.0, 1e-8);
    EXPECT_EQ(first_of(gripped, "draw").contacts, pressed.contacts);
    const TracedDeck from_rest(strip(fmt::format("[[prescribed]]\nat = \"mid\"\nz = {:.17g}\n", z) +
                                         stage("draw", "\"prescribed.0\"", 0.02, -1.0, 1.0) + press,
                                     points));
    const RecordPoint& there = last_of(from_rest, "press");
    ASSERT_EQ(there.lambda, 1.0);
    for (const char* name : {"z", "turn", "tip", "R", "wall"})
      EXPECT_NEAR(value_of(gripped, name, drawn), value_of(from_rest, name, there), 1e-7) << name;
    EXPECT_EQ(drawn.contacts, there.contacts);
    expect_confirmed(gripped);
    expect_resumed_alike(deck, gripped);
  }
}

// A tip that is pressed on a floor and gripped there: what the floor bore the grip bears, and nothing moves; drawn up,
// it carries what the elastica does at its height.
TEST(Grip, OfATipOnAFloorBearsWhatTheFloorBore) {
  for (const std::string points : {"", "[contact]\npoints = \"nodes\"\n"}) {
    SCOPED_TRACE(points);
    std::string deck = cantilever(
        "[[prescribed]]\nat = \"b\"\nz = 1.0\nfrom = \"stage\"\n" + floor_at(-0.1, points) + monitor("z", "b", "z") +
        monitor("R", "b", "reaction-z") + "[[monitor]]\nname = \"wall\"\nwall = \"floor\"\ncomponent = \"force-z\"\n" +
        stage("press", "\"load.0\"", 0.1, -1.0, 0.5) + stage("draw", "\"prescribed.0\"", 0.005, -1.0, 0.05));
    const TracedDeck run(deck);
    const RecordPoint &pressed = last_of(run, "press"), &gripped = first_of(run, "draw"), &drawn = last_of(run, "draw");
    ASSERT_EQ(drawn.lambda, 0.05);
    const double at_floor = DrawnElastica::with_sink(0.1).force, above = DrawnElastica::with_sink(0.05).force;
    EXPECT_NEAR(value_of(run, "wall", pressed), 0.5 - at_floor, 1e-6);
    EXPECT_NEAR(value_of(run, "R", gripped), value_of(run, "wall", pressed), 1e-9);
    EXPECT_EQ(value_of(run, "wall", gripped), 0.0);
    EXPECT_NEAR(value_of(run, "R", drawn), 0.5 - above, 1e-6);
    expect_confirmed(run);
    expect_resumed_alike(deck, run);
  }
}

// A shallow arch whose crown a force has let snap through, gripped at the crown: stable there under either, and the
// grip draws it back through states that no dead load could hold. Beyond its limit point the count under the force that
// would hold it is one more.
TEST(Grip, HoldsWhatADeadLoadCannot) {
  const std::string deck =
      title("Two bars") + material("m", 1e4) + general_section("s", 1.0, 1.0) +
      points({{"left", -1.0, 0.0}, {"top", 0.0, 0.1}, {"right", 1.0, 0.0}}) +
      member("one", "left", "top", "truss", 1, R"(strain = "green")") +
      member("two", "top", "right", "truss", 1, R"(strain = "green")") + supports({{"left", "x z"}, {"right", "x z"}}) +
      force("top", 0.0, -1.0) + prescribed("top", R"(z = 1.0; from = "stage")") + path(R"(branches = "jump")") +
      monitor("w", "top", "z") + monitor("R", "top", "reaction-z") + stage("load", "\"load.0\"", 0.05, -1.0, 5.0) +
      stage("draw", "\"prescribed.0\"", 0.005, -1.0, 0.15) + "output_at = { lambda = [0.09, 0.11, 0.12, 0.13] }\n";
  const TracedDeck run(deck);
  const RecordPoint &loaded = last_of(run, "load"), &drawn = last_of(run, "draw");
  ASSERT_EQ(events_of(run, EventKind::limit_point).size(), 1u);
  ASSERT_EQ(loaded.lambda, 5.0);
  ASSERT_EQ(drawn.lambda, 0.15);
  ASSERT_LT(value_of(run, "w", loaded), -0.2);  // behind the jump
  // λ = EA w (w − h)(w − 2h) / L³ for Green's strain, w downwards: what the grip and the load bear together.
  const double L = std::hypot(1.0, 0.1);
  const auto force = [&](double w) { return 1e4 * w * (w - 0.1) * (w - 0.2) / (L * L * L); };
  int beyond = 0;
  for (const RecordPoint& point : run.record().points) {
    if (run.record().stage_of(point.branch) != "draw") continue;
    const double w = -value_of(run, "w", point);
    EXPECT_NEAR(value_of(run, "R", point), -(force(w) - 5.0), 1e-8);
    EXPECT_EQ(point.count.unstable, 0);
    if (!point.unstable_load_control || std::abs(w - 0.1) > 0.05) continue;
    EXPECT_EQ(*point.unstable_load_control, 1) << w;
    ++beyond;
  }
  EXPECT_GT(beyond, 3);
  expect_confirmed(run);
  expect_resumed_alike(deck, run);
}

// A strip that sticks to a rough floor by a constant weight, gripped at its end and drawn: it slips when the grip bears
// μ times the weight.
TEST(Grip, DrawsABlockThatSticks) {
  const std::string deck =
      title("Block") + material("m", 210.0) + general_section("s", 1.0, 1.0) +
      points({{"A", 0.0, 0.0}, {"B", 10.0, 0.0}}) + bar("bar", "A", "B") + supports({{"A", "z"}}) +
      table("[[spring]]", R"(at = "A"; stiffness = { x = 1.0 })") + force("B", 0.0, -1.0, constant) +
      force("A", 1.0, 0.0) + prescribed("A", R"(x = 1.0; from = "stage")") +
      flat_wall("floor", "below", 0.0, rough(0.3)) + monitor("A", "A", "x") + monitor("B", "B", "x") +
      monitor("R", "A", "reaction-x") + stage("push", "\"load.1\"", 0.02, -1.0, 0.2) +
      stage("draw", "\"prescribed.0\"", 0.001, -1.0, 0.03);
  const TracedDeck run(deck);
  const RecordPoint &pushed = last_of(run, "push"), &drawn = last_of(run, "draw");
  const double first = 0.2 / 22.0;  // by the load 0.2 against the spring and the bar, whose other end sticks
  EXPECT_NEAR(value_of(run, "A", pushed), first, 1e-10);
  EXPECT_NEAR(value_of(run, "A", drawn), first + 0.03, 1e-12);
  const auto slips = events_of(run, EventKind::contact_slips);
  ASSERT_EQ(slips.size(), 1u);
  EXPECT_NEAR(slips.front().lambda, 0.3 / 21.0 - first, 1e-10);
  EXPECT_NEAR(value_of(run, "B", drawn), first + 0.03 - 0.3 / 21.0, 1e-10);
  EXPECT_NEAR(value_of(run, "R", drawn), 0.3 + (first + 0.03) - 0.2, 1e-10);
  expect_confirmed(run);
  expect_resumed_alike(deck, run);
}

namespace {

// A strip that a clamp presses down on a rough floor, which its tip touches at rest; `more` grips the tip.
std::string pressed_strip(double friction, const std::string& more) {
  return "title = \"Strip on a rough floor\"\n" + friction_test::strip(friction, "") +
         monitor("H", "tip", "reaction-x") + "[contact]\npoints = \"moving\"\n" + more;
}

const std::string grip_of_tip = "[[prescribed]]\nat = \"tip\"\nx = 0.0\nfrom = \"stage\"\n";

}  // namespace

// What holds a tip along its wall bears the friction. A tip that has stuck is gripped without a change, and goes on as
// if a support had held it from the start.
TEST(Grip, OfATipThatSticksBearsItsFriction) {
  for (const std::string points : {"moving", "nodes"}) {
    SCOPED_TRACE(points);
    std::string deck = pressed_strip(0.8, grip_of_tip + stage("press", "\"prescribed.0\"", 0.0005, -1.0, 0.001) +
                                              stage("on", "\"prescribed.0\", \"prescribed.1\"", 0.0002, -1.0, 0.001));
    deck.replace(deck.find("points = \"moving\""), 17, "points = \"" + points + "\"");
    const TracedDeck run(deck);
    const RecordPoint &pressed = last_of(run, "press"), &gripped = first_of(run, "on"), &on = last_of(run, "on");
    ASSERT_EQ(on.lambda, 0.001);
    EXPECT_LT(value_of(run, "T", pressed), -1.0);
    EXPECT_NEAR(value_of(run, "H", gripped), value_of(run, "T", pressed), 1e-8);
    EXPECT_EQ(value_of(run, "T", gripped), 0.0);
    EXPECT_NEAR(value_of(run, "p", gripped), value_of(run, "p", pressed), 1e-8);
    std::string held = pressed_strip(0.8, stage("press", "\"prescribed.0\"", 0.0005, -1.0, 0.001) +
                                              stage("on", "\"prescribed.0\"", 0.0002, -1.0, 0.001));
    held.replace(held.find("[support]\n"), 10, "[support]\ntip = [\"x\"]\n");
    const TracedDeck from_rest(held);
    for (const std::string name : {"H", "p", "x"})
      EXPECT_NEAR(value_of(run, name, on), value_of(from_rest, name, last_of(from_rest, "on")), 1e-7) << name;
    EXPECT_EQ(on.dissipation.front(), 0.0);
    expect_confirmed(run);
    expect_resumed_alike(deck, run);
  }
}

// A tip that has slipped is gripped where it is, and leaves the floor there as the clamp goes up.
TEST(Grip, OfATipThatSlipsBearsItsFriction) {
  const std::string deck =
      pressed_strip(0.3, grip_of_tip + stage("press", "\"prescribed.0\"", 0.0005, -1.0, 0.1) +
                             stage("lift", "\"prescribed.0\", \"prescribed.1\"", -0.002, -0.12, 1.0));
  const TracedDeck run(deck);
  const RecordPoint &pressed = last_of(run, "press"), &gripped = first_of(run, "lift"), &lifted = last_of(run, "lift");
  EXPECT_NEAR(value_of(run, "p", pressed), 1.157986449610, 1e-6);
  EXPECT_NEAR(value_of(run, "H", gripped), -0.3 * 1.157986449610, 1e-6);
  EXPECT_EQ(value_of(run, "T", gripped), 0.0);
  EXPECT_NEAR(value_of(run, "x", gripped), 0.637790988438 - 0.5, 1e-7);
  ASSERT_EQ(lifted.lambda, -0.12);
  EXPECT_EQ(lifted.contacts, 0);
  EXPECT_NEAR(value_of(run, "x", lifted), value_of(run, "x", gripped), 1e-12);
  EXPECT_EQ(lifted.dissipation.front(), pressed.dissipation.front());
  expect_confirmed(run);
  expect_resumed_alike(deck, run);
}

// A movement of a tip along a rough wall would bring friction on the support alone, whichever stage drives it.
TEST(Grip, ThatDrawsATipAlongARoughWallIsRefused) {
  std::string grip = grip_of_tip;
  grip.replace(grip.find("x = 0.0"), 7, "x = 1.0");
  const std::string press = stage("press", "\"prescribed.0\"", 0.0005, -1.0, 0.001),
                    draw = stage("draw", "\"prescribed.1\"", 0.0002, -1.0, 0.001);
  EXPECT_NE(test::said_of(pressed_strip(0.3, grip + press + draw)).find("a support moves strip:1 along the wall"),
            std::string::npos);
  EXPECT_EQ(test::said_of(pressed_strip(0.0, grip + press + draw)), "");
}

// A hill is flat below the tip at rest, and the tip slides down its slope later; a floor may turn. One that stays
// straight and level it is pressed on squarely, whether the floor has ends or none.
TEST(Grip, ThatPressesATipOnARoughWallThatIsNotStraightIsRefused) {
  const auto said = [](const std::string& floor, double friction) {
    return test::said_of(
        cantilever(prescribed("b", "z = -1.0") + contact("points = \"nodes\"") +
                   wall("floor", floor + "; contact_surface = \"axis\"; friction = " + number(friction)) +
                   path("step = 0.01; stop = { lambda = [-0.1, 0.2] }")));
  };
  const std::string hill = R"(side = "below"; profile = { type = "circle", centre = [1.0, -1.05], radius = 1.0 })",
                    level = R"(side = "below"; profile = { type = "flat", z = -0.05 })",
                    with_ends = R"(outline = { type = "polyline", points = [[0.5, -0.05], [1.5, -0.05]] })";
  for (const std::string& floor : {hill, level + "; motion = { rotation = 0.1, about = [1.0, -0.05] }"}) {
    EXPECT_NE(said(floor, 0.3).find("a support moves m:1 along the wall"), std::string::npos);
    EXPECT_EQ(said(floor, 0.0), "");
  }
  for (const std::string& floor : {level, with_ends}) EXPECT_EQ(said(floor, 0.3), "");
}

// A number moves the place where a later stage grips, which is told and not left out.
TEST(Grip, HasNoSensitivityOfItsEvents) {
  const TracedDeck run(cantilever(grip_of_z + floor_at(-0.5) + monitor("z", "b", "z") +
                                  stage("bend", "\"load.0\"", 0.2, -1.0, 0.5) +
                                  stage("draw", "\"prescribed.0\"", 0.02, -1.0, 0.2) +
                                  "[path]\nsensitivity = [\"section.s.I\"]\nwatch = { value = { z = [-0.25] } }\n"));
  bool found = false;
  for (const RecordEvent& event : run.record().events)
    for (const RecordSensitivity& by : event.sensitivity) {
      if (run.record().stage_of(event.branch) != "draw") continue;
      found = true;
      EXPECT_FALSE(by.slope.has_value());
      EXPECT_NE(by.why_none.find("grips a point where an earlier one has left it"), std::string::npos) << by.why_none;
    }
  EXPECT_TRUE(found);
}

TEST(Grip, IsWrittenAsItIsRead) {
  const deck::Deck deck =
      deck::read_deck_text(cantilever(grip_of_z + bend + stage("draw", "\"prescribed.0\"", 0.02, -1.0, 0.2)), "g.toml");
  EXPECT_EQ(deck.prescribed.front().from, deck::MovedFrom::stage);
  EXPECT_EQ(deck::read_deck_text(deck::to_toml(deck), "written.toml"), deck);
  EXPECT_EQ(movement_text(deck.prescribed.front(), deck.units).text,
            "displacement in z of b -1 from where it is when its stage begins");
}

TEST(Grip, SaysWhatIsWrongWithIt) {
  const std::string draw = stage("draw", "\"prescribed.0\"", 0.02, -1.0, 0.2), stages = bend + draw;
  EXPECT_EQ(problem_of(grip_of_z, stages), "");
  const auto expect = [](const std::string& problem, const std::string& says) {
    EXPECT_NE(problem.find(says), std::string::npos) << problem;
    EXPECT_NE(problem.find("grip.toml:2"), std::string::npos) << problem;  // line 2…
  };
  expect(problem_of(grip_of_z, ""), "the deck has no stages");
  expect(problem_of(grip_of_z, draw + bend), "the first stage drives it");
  expect(problem_of(grip_of_z + "constant = true\n", bend), "is constant");
  expect(problem_of("[[prescribed]]\nat = \"b\"\nz = -1.0\nfrom = \"start\"\n", stages), "from");
  expect(problem_of(grip_of_z + "[[prescribed]]\nat = \"b\"\nz = 1.0\n",
                    bend + draw + stage("m", "\"prescribed.1\"", 0.1, -1.0, 1.0)),
         "prescribed.1 holds b in z, too");
  expect(problem_of(grip_of_z + "[[prescribed]]\nat = \"b\"\nz = 1.0\nfrom = \"stage\"\n",
                    bend + draw + stage("m", "\"prescribed.1\"", 0.1, -1.0, 1.0)),
         "prescribed.0 holds b in z, too");
  std::string supported = grip_of_z;
  supported.replace(supported.find("\"b\""), 3, "\"a\"");
  expect(problem_of(supported, stages), "support.a holds z from the start");
}

}  // namespace arcwall::grips_test
