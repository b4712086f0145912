// Point loads inside parts that are pressed on walls. The references are closed forms of the linear theory of beams,
// which flat members follow to the square of the slope.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "tests/model/traced_session.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::part_loads_test {

using namespace test::tables;
namespace {

using test::traced;

constexpr double EI = 2.0, length = 1.0;

// A beam on or above a floor; `support` and `place`: of a monitor of its height.
std::string over_floor(const std::string& support, const std::string& wall, const std::string& place) {
  return R"toml(
title = "A beam over a floor"
material.m = { E = 1.0, nu = 0.3 }
section.s = { shape = "general", A = 100000.0, I = 2.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
member.beam = { from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 40 }
support = )toml" +
         support + "\nwall = [{ name = \"floor\", side = \"below\", contact_surface = \"axis\", profile = " + wall +
         " }]\nmonitor = [{ name = \"height\", at = \"beam:" + place +
         "\", component = \"z\" }, { name = \"floor\", wall = \"floor\", component = \"force-z\" }]\n";
}

// Of its own weight q = 1, without supports but one along it; its middle is watched.
std::string strip(const std::string& rest) {
  return over_floor("{ a = [\"x\"] }", "{ type = \"flat\", z = 0.0 }", "0.5") + rest + "\n";
}

// Between supports at its ends; its quarter is watched.
std::string beam(const std::string& wall, const std::string& rest) {
  return over_floor("{ a = [\"x\", \"z\"], b = [\"z\"] }", wall, "0.25") + rest + "\n";
}

std::vector<double> loads_of(const Session& run, EventKind kind) {
  std::vector<double> loads;
  for (const RecordEvent& event : run.events())
    if (event.kind == kind) loads.push_back(event.lambda);
  return loads;
}

std::vector<double> monitors_at(const Session& run, double lambda) {
  for (const RecordPoint& point : run.points())
    if (point.lambda == lambda) return point.monitors;
  ADD_FAILURE() << "the path has no point at " << lambda;
  return run.points().front().monitors;
}

void expect_stop(const Session& run) {
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop) << run.record().branches.back().end->detail;
}

}  // namespace

// Lifted in its middle by P, a strip of weight q leaves the floor over 2a from the first: without slope and curvature
// at the edges, P = 4/3 q a, the middle at q a⁴/72EI. At a = L/2 it stands on its ends, which it leaves at P = q L.
TEST(PartLoads, AStripIsLiftedInItsMiddle) {
  for (const std::string theory : {"euler-bernoulli", "elastica"}) {
    SCOPED_TRACE(theory);
    const Session run = traced(strip("load = [{ on = \"beam\", distributed = [0.0, -1.0], constant = true }, "
                                     "{ at = \"beam:0.5\", force = [0.0, 1.0] }]\n"
                                     "path = { step = 0.02, stop = { lambda = [-1.0, 0.9] } }"),
                               {"member.beam.theory = \"" + theory + "\""});
    expect_stop(run);
    const auto splits = loads_of(run, EventKind::contact_splits), gathers = loads_of(run, EventKind::contact_shrinks);
    ASSERT_EQ(splits.size(), 1U);
    ASSERT_EQ(gathers.size(), 1U);
    EXPECT_NEAR(splits[0], 0.0, 1e-3);  // the shortest free span that is looked for
    EXPECT_NEAR(gathers[0], 2.0 / 3.0, 1e-5);
    int lifted = 0;
    for (const RecordPoint& point : run.points()) {
      EXPECT_EQ(point.count.stability, Stability::stable);
      EXPECT_NEAR(point.monitors[1], 1.0 - point.lambda, 1e-9);
      if (point.lambda >= gathers[0]) continue;
      const double a = 0.75 * point.lambda, middle = std::pow(a, 4) / (72.0 * EI);
      EXPECT_NEAR(point.monitors[0], middle, 1e-4 * middle + 1e-12);
      ++lifted;
    }
    EXPECT_GT(lifted, 5);
  }
}

// A load that presses is handed on to the floor, and nothing else changes.
TEST(PartLoads, AStripThatIsPressedStaysWhereItIs) {
  for (const std::string place : {"0.5", "0.4875", "0.3"}) {
    SCOPED_TRACE(place);
    const Session run = traced(strip("load = [{ on = \"beam\", distributed = [0.0, -1.0], constant = true }, "
                                     "{ at = \"beam:" +
                                     place +
                                     "\", force = [0.0, -1.0] }]\n"
                                     "path = { step = 0.2, stop = { lambda = [-1.0, 5.0] } }"),
                               {"member.beam.elements = 80"});
    expect_stop(run);
    EXPECT_EQ(run.events().size(), 2U);
    for (const RecordPoint& point : run.points()) {
      EXPECT_NEAR(point.monitors[0], 0.0, 1e-12);
      EXPECT_NEAR(point.monitors[1], 1.0 + point.lambda, 1e-9);
    }
  }
}

// Under q a beam lies on a floor at depth d but for c at both ends, d = q c⁴/24 EI. The edge passes a load there, which
// from then on has no part in where the beam is but for the mesh, which remembers where the edge has been.
TEST(PartLoads, TheEdgeOfAPartPassesALoad) {
  constexpr double depth = 1e-3, force = 0.05, place = 0.7;
  const double passes = 24.0 * EI * depth / std::pow(length - place, 4);
  for (const std::string theory : {"euler-bernoulli", "elastica"})
    for (const std::string elements : {"20", "40"}) {
      SCOPED_TRACE(theory + " " + elements);
      const auto run_with = [&](double load) {
        return traced(
            beam("{ type = \"flat\", z = " + round_trip(-depth) + " }",
                 "load = [{ on = \"beam\", distributed = [0.0, -1.0] }, "
                 "{ at = \"beam:0.7\", force = [0.0, " +
                     round_trip(-load) +
                     "], constant = true }]\n"
                     "path = { step = 0.1, output_at = { lambda = [8.0, 10.0] }, stop = { lambda = [-1.0, 12.0] } }"),
            {"member.beam.theory = \"" + theory + "\"", "member.beam.elements = " + elements});
      };
      const Session loaded = run_with(force), unloaded = run_with(0.0);
      expect_stop(loaded);
      expect_stop(unloaded);
      EXPECT_EQ(loads_of(loaded, EventKind::contact_spreads).size(), 1U);
      EXPECT_TRUE(loads_of(loaded, EventKind::contact_opens).empty());
      int compared = 0;
      for (const RecordPoint& point : loaded.points()) {
        if (point.lambda < 1.05 * passes) continue;
        const double c = std::pow(24.0 * EI * depth / point.lambda, 0.25);
        EXPECT_NEAR(point.monitors[1], point.lambda * (length - c) + force, 1e-4 * point.lambda);
        for (const RecordPoint& other : unloaded.points())
          if (other.lambda == point.lambda) {
            EXPECT_NEAR(point.monitors[0], other.monitors[0], 2e-7 * depth);
            ++compared;
          }
      }
      EXPECT_GE(compared, 2);
    }
}

// A force that is large beside the weight presses the beam down first; the edge of the part comes to it with nearly all
// of its force, and goes on behind it many times as fast.
TEST(PartLoads, TheEdgeOfAPartPassesALoadThatIsLarge) {
  for (const double force : {0.5, 5.0}) {
    SCOPED_TRACE(force);
    const auto run_with = [&](double load) {
      return traced(
          beam("{ type = \"flat\", z = -0.001 }",
               "load = [{ on = \"beam\", distributed = [0.0, -1.0] }, { at = \"beam:0.7\", force = [0.0, " +
                   round_trip(-load) +
                   "], constant = true }]\n"
                   "path = { step = 0.1, output_at = { lambda = [10.0] }, stop = { lambda = [-1.0, 12.0] } }"));
    };
    const Session loaded = run_with(force), unloaded = run_with(0.0);
    expect_stop(loaded);
    expect_stop(unloaded);
    EXPECT_NEAR(monitors_at(loaded, 10.0)[0], monitors_at(unloaded, 10.0)[0], 1e-9);
    EXPECT_NEAR(monitors_at(loaded, 10.0)[1], monitors_at(unloaded, 10.0)[1] + force, 1e-5);
  }
}

// On a floor that is curved, too, a load in the middle is borne by the floor below it.
TEST(PartLoads, ACurvedFloorBearsALoadInTheMiddle) {
  const std::string parabola = "{ type = \"parabola\", apex = [0.5, -0.002], curvature = 0.004 }";
  const auto run_with = [&](double load) {
    return traced(
        beam(parabola, "load = [{ on = \"beam\", distributed = [0.0, -1.0] }, { at = \"beam:0.5\", force = [0.0, " +
                           round_trip(-load) +
                           "], constant = true }]\n"
                           "path = { step = 0.1, output_at = { lambda = [10.0] }, stop = { lambda = [-1.0, 12.0] } }"));
  };
  const Session loaded = run_with(0.05), unloaded = run_with(0.0);
  expect_stop(loaded);
  expect_stop(unloaded);
  EXPECT_EQ(loads_of(loaded, EventKind::contact_spreads).size(), 1U);
  EXPECT_NEAR(monitors_at(loaded, 10.0)[0], monitors_at(unloaded, 10.0)[0], 1e-9);
  EXPECT_NEAR(monitors_at(loaded, 10.0)[1], monitors_at(unloaded, 10.0)[1] + 0.05, 1e-8);
}

// Without weight the part needs no pressure. Under end moments m a beam lies on a floor at depth d but for c at both
// ends, d = m c²/6EI: its part begins under a load in the middle at c = L/2, whatever the load is. With loads at a
// distance a from the ends it begins where c passes L/2 in
//
//   r = (F (c − a) − m)/c,   EI d = m c²/2 + r c³/3 − F (c³/3 − a c²/2 + a³/6),
//
// and loads that the edges have passed have no part in where the beam is. The floor bears F and −2 r.
TEST(PartLoads, APartWithoutPressureHandsLoadsOn) {
  constexpr double depth = 1e-3, force = 0.5;  // m = λ, F = λ/2
  const std::string floor = "{ type = \"flat\", z = " + round_trip(-depth) + " }";
  const std::string moments = "load = [{ at = \"a\", moment = -1.0 }, { at = \"b\", moment = 1.0 }, ";
  const std::string rest = "path = { step = 0.05, stop = { lambda = [-1.0, 0.3] } }";
  struct Loads {
    const char* where;
    int number;
    double spreads;
  };
  const auto spreads_at = [&](double a) {
    const double c = 0.5 * length, r = (force * (c - a) - 1.0) / c;
    const double bends = c * c / 2.0 + r * std::pow(c, 3) / 3.0 -
                         force * (std::pow(c, 3) / 3.0 - a * c * c / 2.0 + std::pow(a, 3) / 6.0);
    return EI * depth / bends;
  };
  const Loads cases[] = {
      {"{ at = \"beam:0.5\", force = [0.0, -0.5] }]\n", 1, spreads_at(0.5)},
      {"{ at = \"beam:0.45\", force = [0.0, -0.5] }, { at = \"beam:0.55\", force = [0.0, -0.5] }]\n", 2,
       spreads_at(0.45)},
  };
  for (const std::string theory : {"euler-bernoulli", "elastica"})
    for (const Loads& loads : cases) {
      SCOPED_TRACE(theory + " " + loads.where);
      const Session run =
          traced(beam(floor, moments + loads.where + rest), {"member.beam.theory = \"" + theory + "\""});
      expect_stop(run);
      const auto spreads = loads_of(run, EventKind::contact_spreads);
      ASSERT_EQ(spreads.size(), 1U);
      EXPECT_NEAR(spreads[0], loads.spreads, 2e-4 * loads.spreads);
      int lying = 0;
      for (const RecordPoint& point : run.points()) {
        const double m = point.lambda, c = std::sqrt(6.0 * EI * depth / m);
        if (c > 0.44) continue;
        EXPECT_EQ(point.count.stability, Stability::stable);
        const double borne = loads.number * force * m + 2.0 * m / c;
        EXPECT_NEAR(point.monitors[1], borne, 2e-4 * borne) << m;
        ++lying;
      }
      EXPECT_GT(lying, 3);
    }
}

// Under thrust such a part buckles between its load and its edges. The ends of a pinned column are free over half a
// wave, so that each half of the part is a whole wave long at 36 π² EI/L² = P (1 − P/EA); the nodes pressed on the wall
// would hide that, and the path ends there.
TEST(PartLoads, APartWithoutPressureBucklesBesideItsLoad) {
  const Session run =
      traced(title("A pinned column that a load in the middle holds on a wall") + material("m", 1.0) +
             general_section("s", 100000.0, 2.0) + points({{"a", 0.0, 0.0}, {"b", 1.0, 0.0}}) +
             supports({{"a", "x z"}, {"b", "z"}}) + force("b", -100.0, 0.0) + force("beam:0.5", 0.0, -0.1) +
             flat_wall("floor", "below", -0.02, on_axis) + path("step = 0.05; stop = { lambda = [-1.0, 10.0] }") +
             member("beam", "a", "b", "euler-bernoulli", 40));
  ASSERT_EQ(loads_of(run, EventKind::contact_spreads).size(), 1U);
  const BranchEnd& end = *run.record().branches.back().end;
  EXPECT_EQ(end.reason, EndReason::not_modelled);
  EXPECT_NE(end.detail.find("buckles beside a point load"), std::string::npos) << end.detail;
  const double euler = 36.0 * M_PI * M_PI * EI, P = 100.0 * run.points().back().lambda;
  EXPECT_NEAR(P * (1.0 - P / 1e5), euler, 2e-3 * euler);
}

// A nearly straight column under thrust lies on a wall between two points and arches off it between them. Where one of
// the points comes to a load, the body stays on the wall under the load: a third point there bears
// nearly all of it, on any mesh and with any step.
TEST(PartLoads, ALoadUnderAnArchIsBorneByTheWall) {
  const std::string column =
      title("A clamped column under thrust, with a load across") + material("m", 21000.0) + rectangle("s", 1.0, 0.37) +
      points({{"a", 0.0, 0.0}, {"b", 19.2, 0.0}}) + supports({{"a", "x z rotation"}, {"b", "z rotation"}}) +
      force("b", -21.0, 0.0) + force("beam:0.4", 0.0, -0.19) + flat_wall("floor", "below", -0.43, on_axis) +
      monitor("mid", "beam:0.5", "z") + wall_monitor("floor", "floor", "force-z") +
      path("step = 0.05; stop = { lambda = [-1.0, 4.0] }") +
      member("beam", "a", "b", "euler-bernoulli", 40, imperfection({{1, -0.0015}, {2, -0.00045}, {3, -0.001}}));
  const auto with_step = [&](const std::string& change) { return traced(column, {change}); };
  const Session first = with_step("path.step=0.05");
  expect_stop(first);
  const auto expected = loads_of(first, EventKind::contact_splits);
  ASSERT_EQ(expected.size(), 2U);
  for (const std::string change : {"path.step=0.0125", "member.beam.elements=80"}) {
    SCOPED_TRACE(change);
    const Session run = with_step(change);
    expect_stop(run);
    const auto splits = loads_of(run, EventKind::contact_splits);
    ASSERT_EQ(splits.size(), 2U);
    for (std::size_t i = 0; i < splits.size(); ++i) EXPECT_NEAR(splits[i], expected[i], 5e-5 * expected[i]);
    EXPECT_NEAR(run.points().back().monitors[1], first.points().back().monitors[1], 1e-5 * 12.06);
  }
  // Contact at nodes, of which some on both sides of the load are closed, bears the same to the square of their
  // distance.
  const Session nodes = traced(column, {"contact.points=\"nodes\"", "member.beam.elements=80"});
  expect_stop(nodes);
  EXPECT_NEAR(first.points().back().monitors[1], nodes.points().back().monitors[1], 1e-4 * 12.06);
}

// A column, clamped at both ends, that a load across presses on a wall. Its flat part takes the load in, or begins
// under it; from there on both spans beside it are neutral, and nothing shows the load. Their ends by shooting, apart
// from this program: the elastica with extension from the clamp without moment, with the slope zero at the height of
// the wall. Where the
// span that the load had left was not held, the equations told nothing but noise about it, and hundreds of branch
// points that do not exist were reported; where contact spread under the load the run was refused.
TEST(PartLoads, AFlatPartBetweenNeutralSpansTakesALoadInSlow) {
  constexpr double edge = 0.4220027174, force = 2.7066673557;  // at λ = 5.59
  const std::string column =
      "title = \"a clamped column pressed on a wall by a load across\"\n"
      "material.steel = { E = 2.1e4 }\n"
      "section.s = { shape = \"rectangle\", width = 0.4666, height = 0.3457 }\n"
      "point = { left = [0.0, 0.0], right = [20.776, 0.0] }\n"
      "support = { left = [\"x\", \"z\", \"rotation\"], right = [\"z\", \"rotation\"] }\n"
      "wall = [{ name = \"upper\", side = \"above\", profile = { type = \"flat\", z = 1.5163 } }]\n"
      "path = { step = 0.05, jumps = false, stop = { lambda = [-1.0, 5.59] } }\n"
      "member.column = { from = \"left\", to = \"right\", theory = \"elastica\", material = \"steel\", section = "
      "\"s\", "
      "elements = 70 }\n";
  for (const std::string place : {"column:0.45714285714285713", "column:0.5"}) {
    for (const std::string elements : {"70", "140"}) {
      SCOPED_TRACE(place + " " + elements);
      const Session run = traced(column + "load = [{ at = \"right\", force = [-3.087, 0.0] }, { at = \"" + place +
                                     "\", force = [0.0, 0.0994] }]\n",
                                 {"member.column.elements=" + elements});
      expect_stop(run);
      EXPECT_EQ(loads_of(run, EventKind::contact_spreads).size(), 1U);
      EXPECT_TRUE(loads_of(run, EventKind::branch_point).empty());
      const auto& contacts = run.points().back().forces;
      ASSERT_EQ(contacts.size(), 2U);
      EXPECT_NEAR(contacts[0].label.fraction, edge, 1e-9);
      EXPECT_NEAR(contacts[1].label.fraction, 1.0 - edge, 1e-9);
      for (const auto& contact : contacts) EXPECT_NEAR(contact.force, force, 1e-8);
    }
  }
}

// A column, clamped at both ends, that a load across presses on a wall. Where its touch spreads the span on the one
// side of that is neutral, so that the stiffness is singular at the change, which has no count. Beside it runs a second
// branch, on which the touch spreads at 4.0872 on its other side; one step goes from the touch to behind both. The
// change by shooting, apart from this program: the elastica with extension, with the slope and the moment zero at the
// touch; there it is known to a few times 1e-7 only, for the equations are singular.
TEST(PartLoads, AStepOntoASingularChangeStaysOnItsBranch) {
  for (const std::string stop : {"4.04", "4.2", "6.0"}) {
    for (const std::string step : {"0.05", "0.02"}) {
      SCOPED_TRACE(stop + " " + step);
      const Session run = traced(
          "title = \"a clamped column pressed on a wall by a load across\"\n"
          "material.steel = { E = 2.1e4 }\n"
          "section.s = { shape = \"rectangle\", width = 0.47214503473831626, height = 0.1129935550875601 }\n"
          "point = { left = [0.0, 0.0], right = [9.088660665769945, 0.0] }\n"
          "support = { left = [\"x\", \"z\", \"rotation\"], right = [\"z\", \"rotation\"] }\n"
          "load = [{ at = \"right\", force = [-0.5696845655527032, 0.0] }, { at = \"column:0.6739130434782609\", "
          "force = [0.0, 0.0013523928961930217], constant = true }]\n"
          "wall = [{ name = \"upper\", side = \"above\", profile = { type = \"flat\", z = 0.45136463458248754 } }]\n"
          "member.column = { from = \"left\", to = \"right\", theory = \"elastica\", material = \"steel\", section = "
          "\"s\", elements = 46 }\n",
          {"path.step=" + step, "path.stop={ lambda = [-1.0, " + stop + "] }"});
      expect_stop(run);
      const std::vector<double> spreads = loads_of(run, EventKind::contact_spreads);
      ASSERT_EQ(spreads.size(), 1U);
      EXPECT_NEAR(spreads.front(), 3.9017532, 5e-7);
    }
  }
}

}  // namespace arcwall::part_loads_test
