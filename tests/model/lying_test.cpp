// Members that lie on a flat wall from end to end: from the start, or after contact has spread from their hinged ends.
// The references are closed forms of the linear theory of beams, which flat members follow to the square of the slope.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "core/text.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::lying_test {
namespace {

using test::traced;

constexpr double EI = 2.0, EA = 1e5, length = 1.0, hump = 1e-3;

// A beam on two supports, the right one a roller, at the height of a floor on which all of it lies.
std::string beam(const std::string& rest) {
  return R"toml(
title = "A beam on a floor"
units = { length = "m", force = "N" }
material.m = { E = 1.0, nu = 0.3 }
section.s = { shape = "general", A = 100000.0, I = 2.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "z"], b = ["z"] }
member.beam = { from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 40 }
wall = [{ name = "floor", side = "below", contact_surface = "axis", profile = { type = "flat", z = 0.0 } }]
monitor = [
  { name = "mid", at = "beam:0.5", component = "z" },
  { name = "floor", wall = "floor", component = "force-z" },
  { name = "short", at = "b", component = "x", sign = -1 },
]
)toml" + rest +
         "\n";
}

const std::string humped = "member.beam.imperfection = { shape = \"sine\", amplitude = 1e-3, waves = 1 }";

std::vector<double> loads_of(const Session& run, EventKind kind) {
  std::vector<double> loads;
  for (const RecordEvent& event : run.events())
    if (event.kind == kind) loads.push_back(event.lambda);
  return loads;
}

void expect_stop(const Session& run) {
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop) << run.record().branches.back().end->detail;
}

const std::string load_down = "load = [{ on = \"beam\", distributed = [0.0, -1.0] }]\n";

}  // namespace

// The floor bears the load where it acts but for that of half an element at each support, and nothing bends: what the
// beam moves is round-off, which does not shorten steps.
TEST(Lying, ABeamThatIsPressedOnItsFloorStaysThere) {
  for (const std::string support : {"[\"z\"]", "[\"z\", \"rotation\"]"})
    for (const std::string theory : {"euler-bernoulli", "elastica"}) {
      SCOPED_TRACE(theory + " " + support);
      const Session run = traced(beam(load_down + "path = { step = 0.1, stop = { lambda = [-1.0, 20.0] } }"),
                                 {"support.b = " + support, "member.beam.theory = \"" + theory + "\""});
      expect_stop(run);
      EXPECT_EQ(run.events().size(), 2U);
      EXPECT_LE(run.points().size(), 25U);
      for (const RecordPoint& point : run.points()) {
        EXPECT_EQ(point.count.stability, Stability::stable);
        EXPECT_NEAR(point.monitors[0], 0.0, 1e-12);
        EXPECT_NEAR(point.monitors[1], point.lambda * (1.0 - 1.0 / 40.0), 1e-9);
      }
    }
}

// Where the weight is taken away the beam leaves the floor as a whole, and is one on two supports: 5 q L⁴/384 EI.
TEST(Lying, ABeamLeavesItsFloorWhereNothingPressesAnyMore) {
  const std::string weight =
      "load = [{ on = \"beam\", distributed = [0.0, -1.0], constant = true }, "
      "{ on = \"beam\", distributed = [0.0, 1.0] }]\n";
  const Session run =
      traced(beam(weight + "path = { step = 0.1, output_at = { lambda = [1.1] }, stop = { lambda = [-1.0, 1.2] } }"));
  expect_stop(run);
  const auto opens = loads_of(run, EventKind::contact_opens);
  ASSERT_EQ(opens.size(), 1U);
  EXPECT_NEAR(opens[0], 1.0, 1e-9);
  for (const RecordPoint& point : run.points()) {
    const double up = std::max(point.lambda - 1.0, 0.0);
    EXPECT_NEAR(point.monitors[0], 5.0 / 384.0 * up / EI, 1e-6 * up + 1e-15);
  }
}

// A sine of amplitude A and wave number k above the floor, pressed down by q: between x = ±c from its middle it is free
// and has no slope and curvature at the edges, q c³/3EI = A k (sin kc − kc cos kc). So contact begins at the hinged
// ends where q = 24 EI A k⁴/π³, and the hump is gone at EI A k⁴.
TEST(Lying, AHumpIsPressedFlatFromItsHingedEnds) {
  const double k = pi / length, gone = EI * hump * std::pow(k, 4);
  const double begins = 24.0 / std::pow(pi, 3) * gone;
  const Session run = traced(
      beam(load_down + "path = { step = 0.05, stop = { lambda = [-1.0, " + round_trip(1.5 * gone) + "] } }"), {humped});
  expect_stop(run);
  const auto spreads = loads_of(run, EventKind::contact_spreads), merge = loads_of(run, EventKind::contacts_merge);
  ASSERT_EQ(spreads.size(), 1U);
  ASSERT_EQ(merge.size(), 1U);
  const double squared_slope = hump * hump * k * k;  // 3/2 of it is what the curvature of a sine is off by
  EXPECT_NEAR(spreads[0], begins, 4.0 * squared_slope * begins);
  EXPECT_NEAR(merge[0], gone, 4.0 * squared_slope * gone);
  EXPECT_TRUE(loads_of(run, EventKind::limit_point).empty());
  EXPECT_NEAR(run.points().back().monitors[0], 0.0, 1e-12);
}

// The same where the left end is on the roller and has come to a stop across its way, by the thrust of which nearly
// nothing changes: it touches that, and lies down on the floor.
TEST(Lying, AHumpIsPressedFlatBesideAStop) {
  const double k = pi / length, gone = EI * hump * std::pow(k, 4);
  const std::string stop =
      "{ name = \"stop\", contact_surface = \"axis\", outline = { type = \"half-plane\", point = [-1e-6, 0.0], normal "
      "= [1.0, "
      "0.0] } }";
  const Session run =
      traced(beam(load_down + "path = { step = 0.05, stop = { lambda = [-1.0, " + round_trip(1.5 * gone) + "] } }"),
             {humped, "support = { a = [\"z\"], b = [\"x\", \"z\"] }",
              "wall = [{ name = \"floor\", side = \"below\", contact_surface = \"axis\", profile = { type = \"flat\", "
              "z = 0.0 } }, " +
                  stop + "]"});
  expect_stop(run);
  const auto spreads = loads_of(run, EventKind::contact_spreads), closes = loads_of(run, EventKind::contact_closes),
             merge = loads_of(run, EventKind::contacts_merge);
  ASSERT_EQ(spreads.size(), 1U);
  ASSERT_EQ(closes.size(), 1U);
  ASSERT_EQ(merge.size(), 1U);
  EXPECT_LT(closes[0], spreads[0]);
  EXPECT_NEAR(spreads[0], 24.0 / std::pow(pi, 3) * gone, 1e-3 * gone);
  EXPECT_NEAR(merge[0], gone, 1e-3 * gone);
}

// A rail that its weight has pressed flat stays so under any thrust: its straight axis gets shorter by P/EA of its
// stress-free length L (1 + (k A)²/4).
TEST(Lying, ARailThatItsWeightPressesFlatBearsThrust) {
  const std::string loads =
      "load = [{ on = \"beam\", distributed = [0.0, -1.0], constant = true }, "
      "{ at = \"b\", force = [-1.0, 0.0] }]\n";
  const Session run = traced(beam(loads + "path = { step = 10.0, stop = { short = [-0.1, 0.05] } }"), {humped});
  expect_stop(run);
  const double stress_free = length * (1.0 + 0.25 * pi * pi * hump * hump);
  for (const RecordPoint& point : run.points()) {
    EXPECT_EQ(point.count.stability, Stability::stable);
    EXPECT_NEAR(point.monitors[0], 0.0, 1e-12);
    EXPECT_NEAR(point.monitors[2], length - stress_free * (1.0 - point.lambda / EA), 1e-9);
  }
  EXPECT_EQ(run.events().size(), 2U);
}

// Lifted by h at an end, a beam of the weight q is free over a length a with EI w⁗ = −q, w = w′ = w″ = 0 at the edge
// and no moment at the end: h = q a⁴/24 EI, with the force q a/2 at the end.
TEST(Lying, ABeamPeelsOffFromAnEndThatIsLifted) {
  const std::string lifted =
      "load = [{ on = \"beam\", distributed = [0.0, -1.0], constant = true }]\n"
      "prescribed = [{ at = \"b\", z = 1e-4 }]\n";
  const Session run = traced(
      beam(lifted + "path = { step = 0.01, output_at = { lambda = [0.25, 1.0] }, stop = { lambda = [-1.0, 1.1] } }"),
      {"monitor = [{ name = \"F\", at = \"b\", component = \"reaction-z\" }]", "support = { a = [\"x\", \"z\"] }"});
  expect_stop(run);
  ASSERT_EQ(loads_of(run, EventKind::contact_opens).size(), 1U);
  EXPECT_NEAR(loads_of(run, EventKind::contact_opens)[0], 0.0, 1e-9);
  for (const RecordPoint& point : run.points()) {
    if (point.lambda != 0.25 && point.lambda != 1.0) continue;
    const double a = std::pow(24.0 * EI * 1e-4 * point.lambda, 0.25);
    EXPECT_NEAR(point.monitors[0], 0.5 * a, 1e-5 * a);
  }
}

// By a moment M that turns the end, which stays where it is: M = q a²/4, and the end turns by q a³/24 EI.
TEST(Lying, ABeamPeelsOffFromAnEndThatAMomentTurns) {
  const std::string loads =
      "load = [{ on = \"beam\", distributed = [0.0, -1.0], constant = true }, "
      "{ at = \"b\", moment = -0.01 }]\n";
  const Session run =
      traced(beam(loads + "path = { step = 0.2, output_at = { lambda = [1.0] }, stop = { lambda = [-1.0, 1.1] } }"),
             {"monitor = [{ name = \"turn\", at = \"b\", component = \"rotation\" }]"});
  expect_stop(run);
  for (const RecordPoint& point : run.points()) {
    if (point.lambda != 1.0) continue;
    const double a = std::sqrt(4.0 * 0.01);
    EXPECT_NEAR(point.monitors[0], -a * a * a / (24.0 * EI), 1e-3 * a * a * a);
  }
}

// What is not modelled ends with a sentence.
TEST(Lying, AClampThatTurnsIsRefused) {
  const std::string turned =
      "load = [{ on = \"beam\", distributed = [0.0, -1.0], constant = true }]\n"
      "prescribed = [{ at = \"b\", rotation = -1.0 }]\n";
  Session run = make_session({.deck = "deck.toml",
                              .deck_text = beam(turned + "path = { step = 0.01, stop = { lambda = [-1.0, 1.0] } }"),
                              .assignments = {}});
  EXPECT_FALSE(run.begin());
  EXPECT_NE(run.problem().find("rests on wall \"floor\" along its whole length"), std::string::npos) << run.problem();
}

// End moments M bend a beam onto a floor at depth d; between its edges, c from the supports, it lies without pressure.
// As a load q begins to act there the floor presses: with R = M/c + q c/2 at an edge, EI d = M c²/6 + q c⁴/24, and it
// bears q (L − c) + 2 M/c. As the load pulls, the part arches off from edge to edge, clamped there: with its length l =
// L − 2c and m = q l²/12 there, EI d = (m/3 + M/6) c² − q c⁴/24, and its middle is q l⁴/384EI high.
TEST(Lying, APartWithoutPressureIsPressedOrArchesOffAsALoadBeginsToAct) {
  constexpr double depth = 1e-3, M = 0.3;
  const auto run_with = [](const std::string& down, const std::string& theory) {
    return traced(
        beam("load = [{ at = \"a\", moment = -0.3, constant = true }, { at = \"b\", moment = 0.3, constant = true }, "
             "{ on = \"beam\", distributed = [0.0, " +
             down +
             "] }]\n"
             "path = { step = 0.05, stop = { lambda = [-1.0, 2.0] } }"),
        {"wall.floor.profile.z = -1e-3", "member.beam.theory = \"" + theory + "\""});
  };
  for (const std::string theory : {"euler-bernoulli", "elastica"}) {
    SCOPED_TRACE(theory);
    const Session pressed = run_with("-1.0", theory), lifted = run_with("1.0", theory);
    expect_stop(pressed);
    expect_stop(lifted);
    for (const RecordPoint& point : pressed.points()) {
      const double q = point.lambda;
      const double root = std::sqrt(M * M / 36.0 + q * EI * depth / 6.0);
      const double c = std::sqrt(2.0 * EI * depth / (M / 6.0 + root));
      EXPECT_NEAR(point.monitors[0], -depth, 1e-9 * depth) << q;
      EXPECT_NEAR(point.monitors[1], q * (length - c) + 2.0 * M / c, 1e-3) << q;
    }
    for (const RecordPoint& point : lifted.points()) {
      const double q = point.lambda;
      double c = 0.2;
      for (int i = 0; i < 100; ++i) {
        const double l = length - 2.0 * c;
        c = std::sqrt((EI * depth + q * std::pow(c, 4) / 24.0) / (q * l * l / 36.0 + M / 6.0));
      }
      const double middle = q * std::pow(length - 2.0 * c, 4) / (384.0 * EI);
      EXPECT_NEAR(point.monitors[0] + depth, middle, 1e-3 * middle + 1e-9 * depth) << q;
    }
    EXPECT_GT(lifted.points().back().monitors[0], -0.5 * depth);
  }
}

// A floor that sinks by δ leaves a beam of weight q from both of its hinged ends: with q c⁴ = 24 EI δ it bears q (L −
// c). The part has gathered to a point at δ = q L⁴/384EI, and the floor is left at five times that.
TEST(Lying, ABeamIsLeftByAFloorThatSinks) {
  for (const std::string theory : {"euler-bernoulli", "elastica"}) {
    SCOPED_TRACE(theory);
    const Session run = traced(beam("load = [{ on = \"beam\", distributed = [0.0, -1.0], constant = true }]\n"
                                    "path = { step = 0.1, stop = { lambda = [-1.0, 8.0] } }"),
                               {"wall.floor.motion = { z = -1e-3 }", "member.beam.theory = \"" + theory + "\""});
    expect_stop(run);
    const double gathered = 1.0 / (384.0 * EI) / 1e-3, squared_slope = std::pow(1.0 / (24.0 * EI), 2);
    const auto gathers = loads_of(run, EventKind::contact_shrinks), opens = loads_of(run, EventKind::contact_opens);
    ASSERT_EQ(gathers.size(), 1U);
    ASSERT_EQ(opens.size(), 2U);
    EXPECT_NEAR(opens[0], 0.0, 1e-6);
    EXPECT_NEAR(gathers[0], gathered, 1e-4 * gathered);
    EXPECT_NEAR(opens[1], 5.0 * gathered, squared_slope * 5.0 * gathered);
    for (const RecordPoint& point : run.points()) {
      if (point.lambda <= std::max(opens[0], 0.0) || point.lambda >= gathers[0]) continue;
      const double sunk = 1e-3 * point.lambda, c = std::pow(24.0 * EI * sunk, 0.25);
      EXPECT_NEAR(point.monitors[0], -sunk, 1e-9) << point.lambda;
      EXPECT_NEAR(point.monitors[1], length - c, 1e-3) << point.lambda;
    }
  }
}

// A perfect column snaps twice in a wide channel, and the path then leads back, in a shape that is not symmetric, to
// where a flat part has buckled off the upper wall: its length is a whole wave there, k d = 2π, with k² = P Λ/EI of the
// elastica under the thrust P, whose stretch is Λ = 1 − P/EA.
TEST(Lying, APartThatHasBuckledIsFlatAgainAtItsBucklingLoadSlow) {
  const Session run = traced(R"toml(
title = "A perfect column in a wide channel"
material.m = { E = 21000.0 }
section.s = { shape = "rectangle", width = 0.1, height = 0.1 }
point = { a = [0.0, 0.0], b = [2.0, 0.0] }
support = { a = ["x", "z"], b = ["z"] }
member.column = { from = "a", to = "b", theory = "euler-bernoulli", elements = 60, material = "m", section = "s" }
load = [{ at = "b", force = [-1.0, 0.0] }]
wall = [
  { name = "upper", side = "above", profile = { type = "flat", z = 0.3 } },
  { name = "lower", side = "below", profile = { type = "flat", z = -0.3 } },
]
monitor = [{ name = "mid", at = "column:0.5", component = "z" }]
path = { step = 0.05, branches = "most-stable", stop = { lambda = [-1.0, 10.0] } }
)toml",
                             {});
  expect_stop(run);
  const auto again = std::find_if(run.events().begin(), run.events().end(), [](const RecordEvent& event) {
    return event.kind == EventKind::contacts_merge && event.contacts.size() == 2;
  });
  ASSERT_NE(again, run.events().end());
  const double column_EI = 0.175, column_EA = 210.0, column_length = 2.0, P = again->lambda;
  const double d = column_length * std::abs(again->contacts[1].label.fraction - again->contacts[0].label.fraction);
  EXPECT_NEAR(std::sqrt(P * (1.0 - P / column_EA) / column_EI) * d, 2.0 * pi, 1e-5);
}

// A heavy strip that a force lifts in its middle by F/2 beyond what its weight bears: the arch is 3F/(2q) long, and
// each of its ends presses by F/4 on the floor. The pressure beside an end is no part of that.
TEST(Lying, TheEndOfAZoneBearsItsOwnForce) {
  constexpr double q = 1e-3, F = 4e-3;
  for (const int elements : {20, 80}) {
    const Session run = traced(R"toml(
title = "A heavy strip that is lifted"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e6, I = 1.0 }
point = { a = [-10.0, 0.0], b = [10.0, 0.0] }
support = { a = ["x"] }
load = [{ on = "strip", distributed = [0.0, -1e-3], constant = true }, { at = "strip:0.5", force = [0.0, 4e-3] }]
wall = [{ name = "floor", side = "below", contact_surface = "axis", profile = { type = "flat", z = 0.0 } }]
path = { step = 0.05, branches = "primary", stop = { lambda = [-1.0, 1.0] } }
[member.strip]
from = "a"
to = "b"
theory = "euler-bernoulli"
material = "m"
section = "s"
elements = )toml" + std::to_string(elements));
    const RecordPoint& last = run.points().back();
    ASSERT_EQ(last.lambda, 1.0);
    std::vector<double> ends;
    for (const RecordForce& contact : last.forces)
      if (contact.label.fraction > 0.0 && contact.label.fraction < 1.0) ends.push_back(contact.force);
    ASSERT_EQ(ends.size(), 2u);
    for (const double force : ends) EXPECT_NEAR(force, F / 4.0, 1e-6 * F);
    // The free ends of the strip lie on the floor with pressure alone.
    for (const RecordForce& contact : last.forces)
      if (contact.label.fraction == 0.0 || contact.label.fraction == 1.0) {
        EXPECT_NEAR(contact.force, 0.0, 1e-6 * q);
      }
  }
}

}  // namespace arcwall::lying_test
