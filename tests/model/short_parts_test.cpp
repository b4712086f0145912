// What happens soon after a part has come to lie on a wall, before it has the length with which such parts are begun:
// another contact spreads, too, or the part lifts off inside.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::short_parts_test {
namespace {

const std::string steel = "[material.steel]\nE = 21000.0\nnu = 0.3\n[section.s]\nshape = \"rectangle\"\n";

std::string member(const std::string& theory, int elements) {
  return ", theory = \"" + theory + "\", material = \"steel\", section = \"s\", elements = " + std::to_string(elements);
}

// Both halves of it touch a floor that rises to one side by a hundredth, so that one spreads just after the other.
std::string toggle(int elements) {
  return "title = \"a toggle above a floor that rises to one side\"\n" + steel +
         "width = 4.7\nheight = 0.77\n"
         "[point]\na = [0.0, 0.0]\ntop = [13.5, 1.88]\nb = [27.0, 0.0]\n"
         "[support]\na = [\"x\", \"z\"]\nb = [\"x\", \"z\"]\n"
         "[member]\nwest = { from = \"a\", to = \"top\"" +
         member("euler-bernoulli", elements) + " }\neast = { from = \"top\", to = \"b\"" +
         member("euler-bernoulli", elements) +
         " }\n"
         "[[load]]\nat = \"top\"\nforce = [0.0, -57.0]\n"
         "[[wall]]\nname = \"floor\"\nside = \"below\"\nprofile = { type = \"line\", z = -1.164, slope = 0.007 }\n"
         "[path]\nstep = 0.05\nstop = { lambda = [-3.0, 3.0] }\n";
}

// Clamped on one side, uneven by three half waves, and pressed against a flat wall: so is the pressure on the part that
// lies on it, which falls through zero inside.
std::string column(int elements, double stop) {
  return "title = \"a column whose axis is uneven\"\n" + steel +
         "width = 0.12\nheight = 0.116\n"
         "[point]\nleft = [0.0, 0.0]\nright = [12.7, 0.0]\n"
         "[support]\nleft = [\"x\", \"z\", \"rotation\"]\nright = [\"z\"]\n"
         "[member]\ncolumn = { from = \"left\", to = \"right\"" +
         member("elastica", elements) +
         ", imperfection = [{ shape = \"sine\", amplitude = 0.0054, waves = 1 }, { shape = \"sine\", amplitude = "
         "0.0013, "
         "waves = 3 }] }\n"
         "[[load]]\nat = \"right\"\nforce = [-0.041, 0.0]\n"
         "[[wall]]\nname = \"upper\"\nside = \"above\"\nprofile = { type = \"flat\", z = 1.28 }\n"
         "[path]\nstep = 0.05\nstop = { lambda = [-1.0, " +
         std::to_string(stop) + "] }\n";
}

struct Traced {
  std::vector<EventKind> kinds{};  // changes of contact
  std::vector<double> lambdas{};
  EndReason end{};
};

Traced traced(const std::string& deck) {
  Session run = make_session({.deck = "deck.toml", .deck_text = deck});
  EXPECT_TRUE(run.begin()) << run.problem();
  while (run.next() != nullptr) {
  }
  Traced found{.end = run.record().branches.back().end->reason};
  for (const RecordEvent& event : run.events()) {
    const bool changes = event.kind == EventKind::contact_closes || event.kind == EventKind::contact_opens ||
                         event.kind == EventKind::contact_spreads || event.kind == EventKind::contact_shrinks ||
                         event.kind == EventKind::contact_splits || event.kind == EventKind::contacts_merge;
    if (!changes) continue;
    found.kinds.push_back(event.kind);
    found.lambdas.push_back(event.lambda);
  }
  return found;
}

// With the length that it has at first the one part lies beyond the load at which the other begins.
TEST(ShortParts, AreBegunShorterWhereAnotherContactSpreadsSoonSlow) {
  const Traced coarse = traced(toggle(28)), fine = traced(toggle(56)), finest = traced(toggle(112));
  const std::vector<EventKind> expected{EventKind::contact_closes, EventKind::contact_closes,
                                        EventKind::contact_spreads, EventKind::contact_spreads};
  for (const Traced& mesh : {coarse, fine, finest}) {
    EXPECT_EQ(mesh.end, EndReason::stop);
    ASSERT_EQ(mesh.kinds, expected);
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(fine.lambdas[i], finest.lambdas[i], 4e-7);
    EXPECT_NEAR(coarse.lambdas[i], fine.lambdas[i], 16.0 * 4e-7);
  }
  EXPECT_GT(coarse.lambdas[3], coarse.lambdas[2] + 0.01);
}

// With the length that it has at first the wall would have to pull at some of its nodes, by 5e-9 of what guards are
// measured by. That is so near to round-off that the part may begin as the one behind its next event, in which it is
// off the wall inside; then there is no such event. The last one, at which the path used to end, is the same either
// way.
TEST(ShortParts, AreNotBegunWhereTheWallWouldPull) {
  constexpr double lift_off = 4.180889138, gathered = 4.347509354;  // with 160 elements; with half the step
  const Traced whole = traced(column(80, 8.0)), fine = traced(column(160, 4.2));
  EXPECT_EQ(whole.end, EndReason::stop);
  const std::vector<EventKind> first{EventKind::contact_closes, EventKind::contact_spreads};
  ASSERT_GE(fine.kinds.size(), first.size());
  ASSERT_GE(whole.kinds.size(), 3u);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool begins_off_the_wall = whole.kinds.size() == 3 && i == 1;
    EXPECT_EQ(whole.kinds[i], begins_off_the_wall ? EventKind::contact_splits : first[i]);
    EXPECT_EQ(fine.kinds[i], first[i]);
    EXPECT_NEAR(whole.lambdas[i], fine.lambdas[i], 1e-8);
  }
  EXPECT_EQ(whole.kinds.back(), EventKind::contact_shrinks);
  EXPECT_NEAR(whole.lambdas.back(), gathered, 1e-8);
  if (whole.kinds.size() == 3) return;
  ASSERT_EQ(whole.kinds.size(), 4u);
  EXPECT_EQ(whole.kinds[2], EventKind::contact_splits);
  EXPECT_NEAR(whole.lambdas[2], lift_off, 1e-8);
}

namespace {

// Thick and clamped on both sides, between a rising ceiling and a floor that is a spline.
std::string thick_column(int elements) {
  return "title = \"a thick column between walls\"\n" + steel +
         "width = 0.753\nheight = 0.1443\n"
         "[point]\nleft = [0.0, 0.0]\nright = [3.717, 0.0]\n"
         "[support]\nleft = [\"x\", \"z\", \"rotation\"]\nright = [\"z\", \"rotation\"]\n"
         "[member]\ncolumn = { from = \"left\", to = \"right\"" +
         member("euler-bernoulli", elements) +
         ", imperfection = [{ shape = \"sine\", amplitude = -0.000425, waves = 1 }, { shape = \"sine\", amplitude = "
         "0.000558, waves = 2 }, { shape = \"sine\", amplitude = -0.00053, waves = 3 }] }\n"
         "[[load]]\nat = \"right\"\nforce = [-11.316, 0.0]\n"
         "[[wall]]\nname = \"upper\"\nside = \"above\"\ncontact_surface = \"axis\"\n"
         "profile = { type = \"line\", z = 0.075, slope = 0.01 }\n"
         "[[wall]]\nname = \"lower\"\nside = \"below\"\ncontact_surface = \"axis\"\n"
         "profile = { type = \"spline\", x = [-0.93, 0.465, 1.859, 3.253, 4.647], z = [-0.0758, -0.0819, -0.0843, "
         "-0.079, -0.0821] }\n"
         "[path]\nstep = 0.05\njumps = false\nstop = { lambda = [-1.0, 9.7] }\n";
}

}  // namespace

// A part on the floor begins at 7.677, grows up to a limit point at 8.376, becomes shorter behind it and gathers
// at 7.868. So there are two equilibria with a part of the length with which it is begun, and on a coarse mesh the one
// behind the limit point was found first: the path came back from there to where the part begins, and on to the start.
TEST(ShortParts, AreBegunOnThisSideOfTheNextLimitPoint) {
  const std::vector<EventKind> expected{EventKind::contact_closes, EventKind::contact_closes,
                                        EventKind::contact_spreads, EventKind::contact_shrinks,
                                        EventKind::contact_closes};
  const Traced coarse = traced(thick_column(16)), fine = traced(thick_column(32));
  EXPECT_EQ(coarse.end, EndReason::stop);
  EXPECT_EQ(fine.end, EndReason::stop);
  ASSERT_EQ(coarse.kinds, expected);
  ASSERT_EQ(fine.kinds, expected);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(coarse.lambdas[i], fine.lambdas[i], 5e-3) << i;
}

namespace {

// Clamped on one side and pressed against flat walls, bent by one half wave and less by three.
std::string bent_column(int elements) {
  return "title = \"a column between walls\"\n" + steel +
         "width = 1.24\nheight = 0.467\n"
         "[point]\nleft = [0.0, 0.0]\nright = [47.8, 0.0]\n"
         "[support]\nleft = [\"x\", \"z\", \"rotation\"]\nright = [\"z\"]\n"
         "[member]\ncolumn = { from = \"left\", to = \"right\"" +
         member("elastica", elements) +
         ", imperfection = [{ shape = \"sine\", amplitude = 0.0324, waves = 1 }, { shape = \"sine\", amplitude = "
         "-0.0078, waves = 3 }] }\n"
         "[[load]]\nat = \"right\"\nforce = [-1.9588, 0.0]\n"
         "[[wall]]\nname = \"upper\"\nside = \"above\"\ncontact_surface = \"axis\"\nprofile = { type = \"flat\", z = "
         "2.095 }\n"
         "[[wall]]\nname = \"lower\"\nside = \"below\"\ncontact_surface = \"axis\"\nprofile = { type = \"flat\", z = "
         "-2.095 }\n"
         "[path]\nstep = 0.05\nstop = { lambda = [-1.0, 8.0] }\n";
}

}  // namespace

// A pressed part and the arch beside it vanish together, and the force between them with the square of their length:
// long before that it is lost in round-off, and no step succeeds any more. What lies behind is a point contact, whose
// curvature says to all digits where. The finer mesh, which loses the force earlier, confirms it; and that λ goes on
// along the unstable branch, as it must while the number of unstable directions stays odd.
TEST(ShortParts, GatherWhereTheirForcesAreLostInRoundOffSlow) {
  const Traced coarse = traced(bent_column(32)), fine = traced(bent_column(64));
  const std::vector<EventKind> expected{EventKind::contact_closes, EventKind::contact_spreads,
                                        EventKind::contact_splits, EventKind::contacts_merge,
                                        EventKind::contact_closes};
  EXPECT_EQ(coarse.end, EndReason::stop);
  EXPECT_EQ(fine.end, EndReason::stop);
  ASSERT_EQ(coarse.kinds, expected);
  ASSERT_EQ(fine.kinds, expected);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(coarse.lambdas[i], fine.lambdas[i], 1e-6);
  EXPECT_LT(coarse.lambdas[4], coarse.lambdas[3]);
}

namespace {

// Clamped on one side, with a load across that presses it onto the upper wall.
std::string column_with_a_load_across(int elements) {
  return "title = \"a column with a load across\"\n" + steel +
         "width = 1.6\nheight = 0.23\n"
         "[point]\nleft = [0.0, 0.0]\nright = [64.0, 0.0]\n"
         "[support]\nleft = [\"x\", \"z\", \"rotation\"]\nright = [\"z\"]\n"
         "[member]\ncolumn = { from = \"left\", to = \"right\"" +
         member("euler-bernoulli", elements) +
         ", imperfection = [{ shape = \"sine\", amplitude = 0.0616, waves = 1 }, { shape = \"sine\", amplitude = "
         "-0.01517, waves = 3 }] }\n"
         "[[load]]\nat = \"right\"\nforce = [-0.168, 0.0]\n"
         "[[load]]\nat = \"column:0.69444444444444444\"\nforce = [0.0, 0.0057]\nconstant = true\n"
         "[[wall]]\nname = \"upper\"\nside = \"above\"\nprofile = { type = \"flat\", z = 2.4 }\n"
         "[[wall]]\nname = \"lower\"\nside = \"below\"\nprofile = { type = \"flat\", z = -2.4 }\n"
         "[[monitor]]\nname = \"shortening\"\nat = \"right\"\ncomponent = \"x\"\nsign = -1\n"
         "[path]\nstep = 0.05\njumps = false\nstop = { lambda = [-1.0, 7.8], shortening = [-12.8, 0.5] }\n";
}

}  // namespace

// A pressed part vanishes beside an arch, which closes a little later. The touch that is left of the part was not found
// from every step, and the path leapt over it to where the arch has closed, too. Both loads are those of finer meshes
// and shorter steps; along the path before it the part's length goes to zero linearly, at the first of them.
TEST(ShortParts, LeaveATouchBesideAnArchThatClosesLaterSlow) {
  for (const int elements : {72, 144})
    for (const std::string step : {"0.05", "0.03", "0.0125", "0.005"}) {
      SCOPED_TRACE(std::to_string(elements) + " elements, steps of " + step);
      const Session run = test::traced(column_with_a_load_across(elements), {"path.step=" + step});
      EXPECT_NEAR(test::event_of(run.record(), EventKind::contact_shrinks).lambda, 4.587259, 5e-6);
      EXPECT_NEAR(test::event_of(run.record(), EventKind::contacts_merge).lambda, 4.568572, 5e-6);
    }
}

namespace {

// Pushed past a circle that it lies on along a part and touches at one point beside that.
std::string column_on_a_circle(int elements) {
  return "title = \"a column between circles\"\n" + steel +
         "width = 0.575\nheight = 0.366\n"
         "[point]\nleft = [0.0, 0.0]\nright = [14.9, 0.0]\n"
         "[support]\nleft = [\"x\", \"z\"]\nright = [\"z\"]\n"
         "[member]\ncolumn = { from = \"left\", to = \"right\"" +
         member("euler-bernoulli", elements) +
         ", imperfection = [{ shape = \"sine\", amplitude = 0.00139, waves = 1 }, { shape = \"sine\", amplitude = "
         "0.004, waves = 2 }] }\n"
         "[[load]]\nat = \"right\"\nforce = [-2.21, 0.0]\n"
         "[[wall]]\nname = \"upper\"\nside = \"above\"\nprofile = { type = \"circle\", centre = [8.82, 12.2], radius = "
         "11.7 }\n"
         "[[wall]]\nname = \"lower\"\nside = \"below\"\nprofile = { type = \"circle\", centre = [5.82, -37.7], radius "
         "= "
         "37.2 }\n"
         "[[monitor]]\nname = \"shortening\"\nat = \"right\"\ncomponent = \"x\"\nsign = -1\n"
         "[path]\nstep = 0.05\njumps = false\nstop = { lambda = [-1.0, 11.3], shortening = [-2.97, 9.0] }\n";
}

}  // namespace

// The part grows towards the touch. The span between both is as long as the pressure at the part's edge over its slope,
// and goes to zero with it, while the equations tell its length by the pressure times its cube: on most meshes they
// lose it in round-off. What lies behind, one part up to the touch, begins where that is without pressure at its end,
// at one λ whatever the mesh and however short the span was allowed to become. The path used to turn back there, to
// end, or to go on at another λ.
TEST(ShortParts, JoinTheTouchBesideThemOnACircleSlow) {
  const std::vector<EventKind> expected{
      EventKind::contact_closes,  EventKind::contact_closes, EventKind::contact_opens,  EventKind::contact_closes,
      EventKind::contact_spreads, EventKind::contacts_merge, EventKind::contact_shrinks};
  for (const int elements : {40, 68, 80, 100, 136}) {
    SCOPED_TRACE(elements);
    const Traced run = traced(column_on_a_circle(elements));
    EXPECT_EQ(run.end, EndReason::stop);
    ASSERT_EQ(run.kinds, expected);
    EXPECT_NEAR(run.lambdas[5], -0.1751653, 5e-6);  // the mesh of 40 elements is off by 4e-6
    EXPECT_NEAR(run.lambdas[6], -0.7002923, 6e-6);
  }
}

namespace {

// A bistable beam of two halves with the load on their joint, that snaps onto a stop and is pressed on it.
std::string bistable(int elements) {
  const std::string of_half =
      "theory = \"euler-bernoulli\", material = \"si\", section = \"beam\", elements = " + std::to_string(elements) +
      " }\n";
  return "title = \"a bistable beam above a stop\"\nunits = { length = \"um\", force = \"uN\" }\n"
         "material.si = { E = 1.69e5 }\n"
         "section.beam = { shape = \"rectangle\", width = 25.0, height = 3.0 }\n"
         "point = { left = [0.0, 0.0], mid = [500.0, 20.0], right = [1000.0, 0.0] }\n"
         "support = { left = [\"x\", \"z\", \"rotation\"], right = [\"x\", \"z\", \"rotation\"] }\n"
         "load = [{ at = \"mid\", force = [0.0, -1.0] }]\n"
         "wall = [{ name = \"stop\", side = \"below\", profile = { type = \"flat\", z = -15.0 } }]\n"
         "path = { step = 1.0, jumps = false, stop = { lambda = [-10000.0, 10000.0] } }\n"
         "[member]\n"
         "west = { from = \"left\", to = \"mid\", curve = { x = [0, 50, 100, 150, 200, 250, 300, 350, 400, 450, 500], "
         "z = "
         "[0.0, 0.489435, 1.909830, 4.122147, 6.909830, 10.0, 13.090170, 15.877853, 18.090170, 19.510565, 20.0] }, " +
         of_half +
         "east = { from = \"mid\", to = \"right\", curve = { x = [500, 550, 600, 650, 700, 750, 800, 850, 900, 950, "
         "1000], "
         "z = [20.0, 19.510565, 18.090170, 15.877853, 13.090170, 10.0, 6.909830, 4.122147, 1.909830, 0.489435, 0.0] "
         "}, " +
         of_half;
}

}  // namespace

// Beside the load on their joint one half lies on the stop. The other half holds the joint by a moment that hardly
// changes any more, and λ makes the same by its distance from the edge, which comes as near to it as λ is large: at
// λ = 10000 to 1.5 thousandths of the half, a fifteenth to a thirtieth of its elements. Such paths used to end where an
// eighth of an element was left, or where there was no more room than that for the part to begin with.
TEST(ShortParts, EndAsNearToALoadedJointAsTheLoadIsLargeSlow) {
  for (const int elements : {20, 40}) {
    SCOPED_TRACE(elements);
    Session run = make_session({.deck = "deck.toml", .deck_text = bistable(elements)});
    ASSERT_TRUE(run.begin()) << run.problem();
    while (run.next() != nullptr) {
    }
    const Record& record = run.record();
    EXPECT_EQ(record.branches.back().end->reason, EndReason::stop);
    EXPECT_EQ(record.points.back().lambda, 10000.0);
    EXPECT_EQ(record.points.back().count.unstable, 0);
    for (const RecordPoint& point : record.points) {
      if (point.lambda < 4000.0) continue;
      ASSERT_EQ(point.forces.size(), 2u);
      const double arm = 500.0 * (1.0 - point.forces.back().label.fraction);
      EXPECT_NEAR(point.lambda * arm, 7386.0, 30.0) << point.lambda;
    }
  }
}

namespace {

constexpr const char* slender_column = R"toml(
title = "a slender column between walls"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 3.560407, height = 0.7305605 }
point = { left = [0.0, 0.0], right = [68.61481, 0.0] }
support = { left = ["x", "z"], right = ["z"] }
load = [{ at = "right", force = [-5.09296, 0.0] }]
path = { jumps = false, stop = { lambda = [-1.0, 6.0] } }
member.column = { from = "left", to = "right", theory = "elastica", material = "steel", section = "s", elements = 60, imperfection = [{ shape = "sine", amplitude = 0.006984559, waves = 2 }] }
wall = [{ name = "upper", side = "above", profile = { type = "flat", z = 1.189255 } }, { name = "lower", side = "below", profile = { type = "flat", z = -1.11863 } }]
)toml";

}  // namespace

// Behind the place where a part lifts off its end, the force there goes with the square of the arch's length and is
// lost in round-off, so that short steps do not settle. The load is that of longer steps. The walls are not equally
// far, and the column buckles to the same one from every step.
TEST(ShortParts, LiftOffWhereRoundOffHidesTheirForces) {
  for (const std::string step : {"0.02", "0.01", "0.005"}) {
    SCOPED_TRACE("steps of " + step);
    const Session run = test::traced(slender_column, {"path.step=" + step, "path.max_step=" + step});
    EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
    const RecordEvent& opens = test::event_of(run.record(), EventKind::contact_splits);
    EXPECT_EQ(opens.contacts.front().label.wall, "upper");
    EXPECT_NEAR(opens.lambda, 4.107136912, 1e-7);
  }
}

}  // namespace
namespace {

constexpr const char* arch_on_a_slope = R"toml(
title = "an arch on a sloping floor"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.2507081278174546, height = 0.05239047516796983 }
point = { left = [0.0, 0.0], right = [2.8666716415165943, 0.0] }
support = { left = ["x", "z"], right = ["x", "z"] }
load = [{ at = "arch:0.5", force = [0.0, -0.3095127653956725] }]
monitor = [{ name = "across", at = "arch:0.5", component = "x" }]
path = { step = 0.05, jumps = false, stop = { lambda = [-0.1, 3.0] } }
member.arch = { from = "left", to = "right", theory = "euler-bernoulli", material = "steel", section = "s", elements = 56, sine = { rise = 0.7318620257926984, waves = 1 } }
wall = [{ name = "floor", side = "below", profile = { type = "line", z = -0.528598812562306, slope = -0.015091592069352962 } }]
)toml";

}  // namespace

// An arch beside a part closes at a load that is near zero while that of the path has been 0.85. Steps end some
// thousandths of that before it, where round-off hides the force at the part's edge; how far that is says nothing as a
// share of the load there. The load is that of 112 elements.
TEST(ShortParts, CloseAnArchAtNextToNoLoadSlow) {
  for (const std::string step : {"0.05", "0.0125"}) {
    SCOPED_TRACE("steps of " + step);
    const Session run = test::traced(arch_on_a_slope, {"path.step=" + step});
    EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
    EXPECT_NEAR(test::event_of(run.record(), EventKind::contacts_merge).lambda, 0.0147784, 3e-6);
  }
}

}  // namespace arcwall::short_parts_test
