// Monitors of gaps, of what is greatest along a member, and of springs, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/derivative_check.hpp"
#include "core/error.hpp"
#include "tests/apps/loading/loading_decks.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::monitors_test {

namespace {

using loading_test::expect_confirmed;
using test::said_of;
using test::TracedDeck;

// A beam of length 1 and EI = 1 in so many elements, which its load bends little enough for linear theory: to 10⁻⁸.
std::string beam(const std::string& theory, int elements, const std::string& more) {
  return fmt::format(R"toml(
title = "Beam"
material.m = {{ E = 12.0, nu = 0.3 }}
section.s = {{ shape = "rectangle", width = 1e3, height = 0.1 }}
point = {{ A = [0.0, 0.0], B = [1.0, 0.0] }}
member.beam = {{ from = "A", to = "B", {}, elements = {}, material = "m", section = "s" }}
)toml",
                     theory, elements) +
         more;
}

std::string monitor(const std::string& name, const std::string& of, const std::string& component) {
  return fmt::format("[[monitor]]\nname = \"{}\"\n{}\ncomponent = \"{}\"\n", name, of, component);
}

double value(const TracedDeck& run, const std::string& name, std::size_t point) {
  const auto& columns = run.record().columns;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == name) return run.record().points[point].monitors[i];
  ADD_FAILURE() << "no monitor is called " << name;
  return 0.0;
}

double last(const TracedDeck& run, const std::string& name) { return value(run, name, run.record().points.size() - 1); }

// Those of places apart, which jump. Steps are so short that what is greatest stays where it is.
void expect_gradients(const TracedDeck& run) {
  constexpr double step = 1e-7;
  for (const MonitorColumn& column : run.model().monitors()) {
    if (!column.is_place) {
      EXPECT_LE(check_gradient(*column.quantity, run.last(), step), 2e-6) << column.name;
    }
  }
}

const std::string far_wall = "[[wall]]\nname = \"w\"\nside = \"below\"\nprofile = { type = \"flat\", z = -50.0 }\n";
const std::string simply_supported = "support = { A = [\"x\", \"z\"], B = [\"z\"] }\n";

const std::vector<std::string> beam_theories{"theory = \"euler-bernoulli\"", "theory = \"elastica\"",
                                             "theory = \"reissner\", order = 1", "theory = \"reissner\"",
                                             "theory = \"essenburg\", along = \"director\""};

// Of two members at a point one has a hinge there: the point turns with the other, whichever the deck names first.
TEST(RotationMonitor, OfAPointIsNotThatOfAHingedEnd) {
  const std::string hinged = "[member.c]\nfrom = \"a\"\nto = \"b\"\nhinge = [\"to\"]\n",
                    stiff = "[member.d]\nfrom = \"b\"\nto = \"d\"\n",
                    common = "theory = \"euler-bernoulli\"\nmaterial = \"m\"\nsection = \"s\"\nelements = 4\n";
  for (const bool first : {true, false}) {
    const std::string members = first ? hinged + common + stiff + common : stiff + common + hinged + common;
    const test::TracedDeck traced(R"toml(
title = "A hinge beside a point that is turned"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1.0e4, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0], d = [2.0, 0.0] }
support = { a = ["x", "z", "rotation"], d = ["x", "z", "rotation"] }
prescribed = [{ at = "b", rotation = 1.0e-3 }]
path = { step = 0.1, branches = "primary", stop = { lambda = [-1.0, 1.0] } }
monitor = [{ name = "turned", at = "b", component = "rotation" }, { name = "end", at = "c:1", component = "rotation" }]
)toml" + members);
    EXPECT_NEAR(traced.record().points.back().monitors[0], 1e-3, 1e-12) << first;
    EXPECT_LT(traced.record().points.back().monitors[1], 0.0) << first;
  }
}

// The first point lies so near a bound that the step after it is longer by twelve digits.
TEST(StopBounds, AreMetBehindAPointThatAlmostMeetsThem) {
  const test::TracedDeck traced(R"toml(
title = "A step that ends almost at a bound"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1.0e4, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "z", "rotation"] }
member.c = { from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 4 }
prescribed = [{ at = "b", z = 1.0e-5 }]
monitor = [{ name = "w", at = "b", component = "z" }]
path = { step = 1.0, branches = "primary", max_points = 60, stop = { lambda = [-1.0, 1.0], w = [-1.0, 0.5] } }
)toml");
  EXPECT_EQ(traced.record().branches.back().end->reason, EndReason::stop);
  EXPECT_NEAR(traced.last().lambda, 1.0, 1e-10);
}

}  // namespace

// A load at the tip, which goes far: what the clamp carries is the load times its arm, by the places of the run.
TEST(GreatestMoment, OfACantileverIsThatOfItsClamp) {
  for (const std::string& theory : beam_theories)
    for (const bool slides : {false, true}) {
      if (slides && theory.find("euler-bernoulli") == std::string::npos && theory.find("elastica") == std::string::npos)
        continue;
      SCOPED_TRACE(theory + (slides ? ", sliding" : ""));
      const TracedDeck run(beam(theory, 6,
                                R"toml(
support = { A = ["x", "z", "rotation"] }
load = [{ at = "B", force = [-0.2, -1.0] }]
path = { step = 0.1, stop = { lambda = [-1.0, 1.0] } }
)toml" + (slides ? far_wall : "") + monitor("M", "member = \"beam\"", "max-moment") +
                                    monitor("x", "at = \"B\"", "x") + monitor("z", "at = \"B\"", "z")));
      ASSERT_EQ(run.model().sliding() != nullptr, slides);
      EXPECT_LT(last(run, "z"), -0.2) << "the beam should bend much";
      const double expected = std::abs(-1.0 * (1.0 + last(run, "x")) + 0.2 * last(run, "z"));
      EXPECT_NEAR(last(run, "M"), expected, 1e-8 * expected);
      EXPECT_EQ(last(run, "M-place"), 0.0);
      expect_gradients(run);
      expect_confirmed(run);
    }
}

// q L² / 8 in the middle, which with an odd number of elements is in none of its nodes.
TEST(GreatestMoment, OfAUniformLoadIsInTheMiddleBetweenNodes) {
  for (const std::string& theory : beam_theories) {
    SCOPED_TRACE(theory);
    const auto loaded = [&](const std::string& load) {
      return TracedDeck(beam(theory, 5, simply_supported + "load = [" + load + "]\n" + R"toml(
path = { step = 0.2, output_at = { lambda = [0.2, 0.4, 0.6, 0.8] }, stop = { lambda = [-1.0, 1.0] } }
)toml" + monitor("M", "member = \"beam\"", "max-moment")));
    };
    const TracedDeck run = loaded("{ on = \"beam\", distributed = [0.0, -1e-3] }");
    EXPECT_NEAR(last(run, "M"), 1e-3 / 8.0, 1e-7 * 1e-3);
    EXPECT_NEAR(last(run, "M-place"), 0.5, 1e-5);
    expect_confirmed(run);
    // Where it is in no node: beside equilibrium the two sides of one differ.
    expect_gradients(loaded("{ on = \"beam\", distributed = [0.0, -1.0] }, { at = \"A\", moment = 0.05 }"));
  }
}

// A uniform load q and, growing, a moment m at one end, which bends the other way. With μ = m / q L² there are
// (½ − μ)² q L² / 2 at the place ½ + μ, and m at the end, which is the greater from μ = (3 − √8) / 2 on.
TEST(GreatestMoment, JumpsFromPlaceToPlaceWithoutAJumpOfItsValue) {
  const double q = 1e-3, change = 0.5 * (3.0 - std::sqrt(8.0));
  for (const std::string& walls : {std::string(), far_wall}) {
    SCOPED_TRACE(walls);
    const TracedDeck run(beam("theory = \"elastica\"", 7, simply_supported + R"toml(
load = [{ on = "beam", distributed = [0.0, -1e-3], constant = true }, { at = "A", moment = 1e-3 }]
path = { step = 0.01, max_step = 0.005, output_at = { lambda = [0.05, 0.0857, 0.0858, 0.12] }, stop = { lambda = [-1.0, 0.12] } }
)toml" + walls + monitor("M", "member = \"beam\"", "max-moment")));
    std::size_t before = 0, behind = 0;
    for (std::size_t i = 0; i < run.record().points.size(); ++i) {
      const double mu = run.record().points[i].state.lambda;
      EXPECT_NEAR(value(run, "M", i), q * std::max(0.5 * (0.5 - mu) * (0.5 - mu), mu), 1e-6 * q) << mu;
      if (std::abs(mu - change) < 1e-6) continue;
      EXPECT_NEAR(value(run, "M-place", i), mu < change ? 0.5 + mu : 0.0, 1e-5) << mu;
      ++(mu < change ? before : behind);
    }
    EXPECT_GE(before, 3u);
    EXPECT_GE(behind, 2u);
    expect_confirmed(run);
  }
}

TEST(GreatestMoment, MayEndAPath) {
  const TracedDeck run(beam("theory = \"elastica\"", 4, R"toml(
support = { A = ["x", "z", "rotation"] }
load = [{ at = "B", force = [0.0, -1.0] }]
path = { step = 0.1, stop = { lambda = [-1.0, 10.0], M = [-1.0, 1.25] } }
)toml" + monitor("M", "member = \"beam\"", "max-moment")));
  EXPECT_NEAR(last(run, "M"), 1.25, 1e-11);
}

// A face at a clearance from a floor: in the middle, which does not turn, it is less the deflection, and 0 where it
// touches. A round wall beside it is so far as its centre, less its radius and half the height.
TEST(GapMonitor, IsTheClearanceLessTheDeflection) {
  for (const char* points : {"nodes", "moving"}) {
    SCOPED_TRACE(points);
    const TracedDeck run(beam("theory = \"elastica\"", 4,
                              simply_supported +
                                  fmt::format(R"toml(
load = [{{ on = "beam", distributed = [0.0, -1.0] }}]
path = {{ step = 0.1, max_step = 0.05, stop = {{ lambda = [-1.0, 2.0] }} }}
contact = {{ points = "{}" }}
wall = [{{ name = "floor", side = "below", profile = {{ type = "flat", z = -0.06 }} }},
        {{ name = "pin", outline = {{ type = "circle", centre = [0.5, -0.5], radius = 0.1 }} }}]
)toml",
                                              points) +
                                  monitor("floor", "at = \"beam:0.5\"\nwall = \"floor\"", "gap") +
                                  monitor("pin", "at = \"beam:0.25\"\nwall = \"pin\"", "gap") +
                                  monitor("tip", "at = \"B\"\nwall = \"floor\"", "gap") +
                                  monitor("z", "at = \"beam:0.5\"", "z") + monitor("qx", "at = \"beam:0.25\"", "x") +
                                  monitor("qz", "at = \"beam:0.25\"", "z")));
    EXPECT_GE(run.record().points.back().contacts, 1) << "it should have come down";
    for (std::size_t i = 0; i < run.record().points.size(); ++i) {
      EXPECT_NEAR(value(run, "floor", i), 0.06 - 0.05 + value(run, "z", i), 1e-9) << i;
      const double away = std::hypot(0.25 + value(run, "qx", i) - 0.5, value(run, "qz", i) + 0.5);
      EXPECT_NEAR(value(run, "pin", i), away - 0.1 - 0.05, 1e-12) << i;
    }
    EXPECT_NEAR(value(run, "floor", 0), 0.01, 1e-14);
    EXPECT_NEAR(last(run, "floor"), 0.0, 1e-9);
    EXPECT_GT(last(run, "tip"), 0.005);
    expect_gradients(run);
    expect_confirmed(run);
  }
}

// What closes is the wall's way as well: a beam that stands still, and one whose support goes along.
TEST(GapMonitor, FollowsAWallThatMoves) {
  for (const char* points : {"nodes", "moving"}) {
    SCOPED_TRACE(points);
    const TracedDeck run(beam("theory = \"euler-bernoulli\"", 4,
                              fmt::format(R"toml(
support = {{ A = ["x", "z"], B = ["z"] }}
prescribed = [{{ at = "B", z = 0.1 }}]
path = {{ step = 0.02, output_at = {{ lambda = [0.04, 0.08, 0.12, 0.16] }}, stop = {{ lambda = [-0.1, 0.2] }} }}
contact = {{ points = "{}" }}
wall = [{{ name = "press", side = "above", contact_surface = "axis", profile = {{ type = "flat", z = 0.5 }}, motion = {{ z = -1.0 }} }}]
)toml",
                                          points) +
                                  monitor("g", "at = \"beam:0.5\"\nwall = \"press\"", "gap") +
                                  monitor("z", "at = \"beam:0.5\"", "z")));
    for (std::size_t i = 0; i < run.record().points.size(); ++i)
      EXPECT_NEAR(value(run, "g", i), 0.5 - run.record().points[i].state.lambda - value(run, "z", i), 1e-12);
    expect_gradients(run);
    expect_confirmed(run);
  }
}

// A path lands on a gap, and ends on it.
TEST(GapMonitor, MayEndAPath) {
  const TracedDeck run(beam("theory = \"elastica\"", 4, simply_supported + R"toml(
load = [{ on = "beam", distributed = [0.0, -1.0] }]
path = { step = 0.1, stop = { lambda = [-1.0, 2.0], g = [0.004, 1.0] } }
wall = [{ name = "floor", side = "below", profile = { type = "flat", z = -0.06 } }]
)toml" + monitor("g", "at = \"beam:0.5\"\nwall = \"floor\"", "gap")));
  EXPECT_NEAR(last(run, "g"), 0.004, 1e-12);
}

// A circle as a profile ends at its sides; a place beyond it has no gap.
TEST(GapMonitor, IsInfiniteWhereThereIsNoWall) {
  const TracedDeck run(beam("theory = \"elastica\"", 4,
                            simply_supported + R"toml(
load = [{ on = "beam", distributed = [0.0, -0.1] }]
path = { step = 0.2, output_at = { lambda = [0.2, 0.4, 0.6, 0.8] }, stop = { lambda = [-1.0, 1.0] } }
wall = [{ name = "hill", side = "below", contact_surface = "axis", profile = { type = "circle", centre = [0.25, -1.0], radius = 0.1 } }]
)toml" + monitor("near", "at = \"beam:0.25\"\nwall = \"hill\"", "gap") +
                                monitor("far", "at = \"beam:0.75\"\nwall = \"hill\"", "gap")));
  EXPECT_NEAR(value(run, "near", 0), 0.9, 1e-14);
  EXPECT_EQ(last(run, "far"), infinity);
  expect_confirmed(run);
}

// k u of a support that gives way, and by statics half the load; a moment k φ is the load times its arm.
TEST(SpringMonitor, IsTheStiffnessTimesTheWayByStatics) {
  for (const std::string& theory : beam_theories) {
    SCOPED_TRACE(theory);
    const TracedDeck run(beam(theory, 4,
                              R"toml(
support = { A = ["x", "z"] }
spring = [{ name = "end", at = "B", stiffness = { z = 2.0 } }]
load = [{ at = "beam:0.5", force = [0.0, -1e-3] }]
path = { step = 0.2, output_at = { lambda = [0.2, 0.4, 0.6, 0.8] }, stop = { lambda = [-1.0, 1.0] } }
)toml" + monitor("F", "spring = \"end\"", "force-z") +
                                  monitor("z", "at = \"B\"", "z")));
    EXPECT_NEAR(last(run, "F"), -0.5e-3, 1e-9);
    EXPECT_EQ(last(run, "F"), 2.0 * last(run, "z"));
    expect_gradients(run);
    expect_confirmed(run);
  }
  const TracedDeck turned(beam("theory = \"elastica\"", 4,
                               R"toml(
support = { A = ["x", "z"] }
spring = [{ name = "hinge", at = "A", stiffness = { rotation = 2.0 } }]
load = [{ at = "B", force = [0.0, -1.0] }]
path = { step = 0.1, stop = { lambda = [-1.0, 1.0] } }
)toml" + far_wall + monitor("M", "spring = \"hinge\"", "moment") +
                                   monitor("x", "at = \"B\"", "x") + monitor("turn", "at = \"A\"", "rotation")));
  ASSERT_NE(turned.model().sliding(), nullptr);
  EXPECT_NEAR(last(turned, "M"), -(1.0 + last(turned, "x")), 1e-9);
  EXPECT_NEAR(last(turned, "M"), 2.0 * last(turned, "turn"), 1e-12);
  expect_gradients(turned);
  expect_confirmed(turned);
}

// Two cantilevers whose tips a spring joins, one loaded: with k = 3 EI / L³ of each, the spring carries a third of it.
// A law that is linear says the same as a stiffness.
TEST(SpringMonitor, OfTwoPointsIsThatOfTheirDifference) {
  for (const char* spring : {"stiffness = { z = 3.0 }",
                             "law = { direction = \"z\", displacement = [-0.01, -0.001, 0.0, 0.001, 0.01], "
                             "force = [-0.03, -0.003, 0.0, 0.003, 0.03] }"}) {
    SCOPED_TRACE(spring);
    const TracedDeck run(fmt::format(R"toml(
title = "Two cantilevers"
material.m = {{ E = 12.0 }}
section.s = {{ shape = "general", A = 1e3, I = {:.17g} }}
point = {{ A = [0.0, 0.0], B = [1.0, 0.0], C = [0.0, 1.0], D = [1.0, 1.0] }}
support = {{ A = ["x", "z", "rotation"], C = ["x", "z", "rotation"] }}
spring = [{{ name = "link", between = ["B", "D"], {} }}]
load = [{{ at = "D", force = [0.0, -1e-3] }}]
path = {{ step = 0.2, output_at = {{ lambda = [0.2, 0.4, 0.6, 0.8] }}, stop = {{ lambda = [-1.0, 1.0] }} }}
[member]
low = {{ from = "A", to = "B", theory = "euler-bernoulli", elements = 2, material = "m", section = "s" }}
high = {{ from = "C", to = "D", theory = "euler-bernoulli", elements = 2, material = "m", section = "s" }}
)toml",
                                     1.0 / 12.0, spring) +
                         monitor("F", "spring = \"link\"", "force-z") + monitor("b", "at = \"B\"", "z") +
                         monitor("d", "at = \"D\"", "z"));
    EXPECT_NEAR(last(run, "F"), -1e-3 / 3.0, 1e-8);
    EXPECT_NEAR(last(run, "F"), 3.0 * (last(run, "d") - last(run, "b")), 1e-12);
    expect_gradients(run);
    expect_confirmed(run);
  }
}

// A beam that lies on soil: a uniform load sinks it in by q / k, so that the soil presses with q everywhere; under a
// force in its middle the pressure there is greatest, k times the settlement.
TEST(FoundationMonitor, ShowsTheGreatestPressure) {
  for (const std::string& theory : {std::string("theory = \"euler-bernoulli\""), std::string("theory = \"elastica\""),
                                    std::string("theory = \"reissner\"")}) {
    SCOPED_TRACE(theory);
    const auto sunk = [&](const std::string& load, const std::string& walls) {
      return TracedDeck(beam(theory, 8,
                             R"toml(
support = { A = ["x"] }
spring = [{ name = "soil", on = "beam", foundation = { z = 200.0 } }]
path = { step = 0.2, output_at = { lambda = [0.2, 0.4, 0.6, 0.8] }, stop = { lambda = [-1.0, 1.0] } }
)toml" + load + walls + monitor("p", "spring = \"soil\"", "greatest-pressure") +
                                 monitor("z", "at = \"beam:0.5\"", "z")));
    };
    const TracedDeck even = sunk("load = [{ on = \"beam\", distributed = [0.0, -1e-2] }]\n", "");
    EXPECT_NEAR(last(even, "p"), 1e-2, 1e-10);
    for (const std::string& walls : {std::string(), theory.find("reissner") == std::string::npos ? far_wall : ""}) {
      const TracedDeck pressed = sunk("load = [{ at = \"beam:0.5\", force = [0.0, -1e-2] }]\n", walls);
      EXPECT_NEAR(last(pressed, "p"), -200.0 * last(pressed, "z"), 1e-9 * last(pressed, "p"));
      EXPECT_NEAR(last(pressed, "p-place"), 0.5, 1e-9);
      expect_gradients(pressed);
      expect_confirmed(pressed);
    }
  }
}

// A beam of length 1 that hardly bends, on soil, with a force F on its end: p = F (1 + 6 x), x from its middle. It is
// zero at a third of the length, 4 F at the loaded end, and its mean size is 5 F/3. With F at 5/8 of the length it is F
// (1 + 1.5 x). Under a uniform load it is the same everywhere.
TEST(FoundationMonitor, ShowsTheLeastAndTheMeanPressure) {
  const auto resting = [](const std::string& load, const std::string& theory) {
    return TracedDeck(R"toml(
title = "A stiff beam on soil"
material.m = { E = 1e7, nu = 0.0 }
section.s = { shape = "general", A = 1.0, I = 1.0 }
point = { A = [0.0, 0.0], B = [1.0, 0.0] }
support = { A = ["x"] }
spring = [{ name = "soil", on = "beam", foundation = { z = 2.0 } }]
path = { step = 0.2, output_at = { lambda = [0.2, 0.4, 0.6, 0.8] }, stop = { lambda = [-1.0, 1.0] } }
member.beam = { from = "A", to = "B", elements = 8, material = "m", section = "s", )toml" +
                      theory + " }\n" + load + monitor("most", "spring = \"soil\"", "greatest-pressure") +
                      monitor("least", "spring = \"soil\"", "least-pressure") +
                      monitor("mean", "spring = \"soil\"", "mean-pressure"));
  };
  for (const std::string theory : {"theory = \"euler-bernoulli\"", "theory = \"elastica\"", "theory = \"reissner\""}) {
    SCOPED_TRACE(theory);
    constexpr double F = 1e-4;
    const TracedDeck tilted = resting("load = [{ at = \"B\", force = [0.0, -1e-4] }]\n", theory);
    EXPECT_NEAR(last(tilted, "most"), 4.0 * F, 1e-5 * F);
    EXPECT_EQ(last(tilted, "least"), 0.0);
    EXPECT_NEAR(last(tilted, "least-place"), 1.0 / 3.0, 1e-5);
    EXPECT_NEAR(last(tilted, "mean"), 5.0 / 3.0 * F, 1e-5 * F);
    expect_confirmed(tilted);
    const TracedDeck pressed = resting("load = [{ at = \"beam:0.625\", force = [0.0, -1e-4] }]\n", theory);
    EXPECT_NEAR(last(pressed, "least"), 0.25 * F, 1e-5 * F);
    EXPECT_NEAR(last(pressed, "least-place"), 0.0, 1e-9);
    EXPECT_NEAR(last(pressed, "mean"), F, 1e-5 * F);
    expect_gradients(pressed);
    expect_confirmed(pressed);
    const TracedDeck even = resting("load = [{ on = \"beam\", distributed = [0.0, -1e-4] }]\n", theory);
    for (const char* name : {"most", "least", "mean"}) EXPECT_NEAR(last(even, name), F, 1e-10);
  }
}

TEST(NewMonitors, AreRefusedWhereThereIsNothingToShow) {
  const auto with = [](const std::string& monitor, const std::string& more = "") {
    return said_of(beam("theory = \"elastica\"", 4, simply_supported + R"toml(
load = [{ at = "beam:0.5", force = [0.0, -1e-2] }]
path = { step = 0.2, output_at = { lambda = [0.2, 0.4, 0.6, 0.8] }, stop = { lambda = [-1.0, 1.0] } }
)toml" + more + monitor));
  };
  const auto expect = [](const std::string& said, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) EXPECT_NE(said.find(part), std::string::npos) << said << "\n: " << part;
  };
  expect(with(monitor("M", "member = \"beem\"", "max-moment")), {"monitor.0.member", "did you mean beam?"});
  expect(with(monitor("F", "spring = \"s\"", "force-z")),
         {"monitor.0.spring", "give the [[spring]] that is meant a name"});
  const std::string spring = "spring = [{ name = \"end\", at = \"B\", stiffness = { x = 2.0 } }]\n";
  expect(with(monitor("F", "spring = \"ent\"", "force-x"), spring), {"monitor.0.spring", "did you mean end?"});
  expect(with(monitor("F", "spring = \"end\"", "force-z"), spring), {"monitor.0.component", "no stiffness in z"});
  expect(with(monitor("F", "spring = \"end\"", "greatest-pressure"), spring), {"end is no foundation"});
  expect(with(monitor("g", "at = \"beam:1.5\"\nwall = \"w\"", "gap"), far_wall),
         {"monitor.0.at", "no fraction between 0 and 1"});
  expect(with(monitor("g", "at = \"beam:0.5\"\nwall = \"v\"", "gap"), far_wall),
         {"monitor.0.wall", "\"v\" is not a wall of this deck"});
  expect(with(monitor("g", "at = \"beam:0.5\"\nwall = \"w\"", "z"), far_wall),
         {"monitor.0.component", "give gap, force-x or force-z"});
  expect(with(monitor("g", "at = \"beam:0.5\"", "gap"), far_wall),
         {"monitor.0.component", "gap belongs to a place and a wall"});
  // It is least where one place takes over from another, in a kink: no event has derivatives there.
  expect(said_of(deck::replaced(beam("theory = \"elastica\"", 4, simply_supported + R"toml(
load = [{ at = "beam:0.5", force = [0.0, -1e-2] }]
path = { step = 0.5, stop = { lambda = [-1.0, 1.0] } }
)toml" + monitor("M", "member = \"beam\"", "max-moment")),
                                "path = {", "path = { watch = [\"M\"],")),
         {"path.watch", "may turn where its place jumps"});
  expect(with(monitor("g", "at = \"beam:0.5\"", "max-moment")), {"belongs to a member", "write `member` instead"});
  expect(with(monitor("g", "at = \"beam:0.5\"\nmember = \"beam\"", "z")), {"both `at` and `member`"});
}

// A wall that does not concern the member; load increments, whose stresses no state tells.
TEST(NewMonitors, AreRefusedWhereTheModelHasNone) {
  const std::string two = R"toml(
title = "Two beams"
material.m = { E = 12.0 }
section.s = { shape = "general", A = 1e3, I = 0.1 }
point = { A = [0.0, 0.0], B = [1.0, 0.0], C = [2.0, 0.0] }
support = { A = ["x", "z", "rotation"] }
load = [{ at = "C", force = [0.0, -1e-3] }]
path = { step = 0.2, output_at = { lambda = [0.2, 0.4, 0.6, 0.8] }, stop = { lambda = [-1.0, 1.0] } }
wall = [{ name = "floor", side = "below", contact_surface = "axis", members = ["one"], profile = { type = "flat", z = -1.0 } }]
[member]
one = { from = "A", to = "B", theory = "euler-bernoulli", elements = 2, material = "m", section = "s" }
two = { from = "B", to = "C", theory = "euler-bernoulli", elements = 2, material = "m", section = "s" }
)toml";
  EXPECT_NE(said_of(two + monitor("g", "at = \"two:0.5\"\nwall = \"floor\"", "gap")).find("does not stand in the way"),
            std::string::npos);
  EXPECT_EQ(said_of(two + monitor("g", "at = \"B\"\nwall = \"floor\"", "gap")), "");
}

}  // namespace arcwall::monitors_test
