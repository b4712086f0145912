#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/derivative_check.hpp"
#include "tests/model/compliant_decks.hpp"
#include "tests/support/dense.hpp"

// Compliant walls: pressure by penetration, integrated along members.
namespace arcwall::compliant_test {

namespace {

std::string pushed_strip(const std::string& radius) {
  return R"toml(
title = "Strip pushed by a compliant roller"
material.steel = { E = 2.1e5 }
section.s = { shape = "rectangle", width = 10.0, height = 1.0 }
contact = { method = "compliant", law = { stiffness = 50.0 } }
point = { a = [0.0, 0.0], b = [200.0, 0.0] }
support = { a = ["x", "z", "rotation"], b = ["z", "rotation"] }
path = { step = 0.1, stop = { lambda = [-1.0, 40.0] } }
monitor = [{ name = "mid", at = "c:0.5", component = "z" }, { name = "f", wall = "peg", component = "force-z" }]
member.c = { from = "a", to = "b", theory = "elastica", material = "steel", section = "s", elements = 20 }
[[wall]]
name = "peg"
motion = { z = 1.0 }
outline = { type = "circle", centre = [120.0, -10.0], radius = )toml" +
         radius + " }\n";
}

}  // namespace

// --- derivatives ----------------------------------------------------------------------------------------------------

namespace {

// A bent strip of two elements, free at its right end, among walls that λ moves and turns.
std::string among_walls(const std::string& theory, const std::string& surface, const std::string& law) {
  const std::string touches = fmt::format("contact_surface = \"{}\"; ", surface);
  const bool has_no_faces = surface == "face" && theory.find("essenburg") != std::string::npos;
  return title("Among walls") + units("m", "N") + material("m", 100.0, "nu = 0.3") + rectangle("s", 1.0, 0.3) +
         points({{"left", 0.0, 0.0}, {"right", 2.0, 0.2}}) +
         member("strip", "left", "right", theory, 2, imperfection({{2, 0.05}})) + supports({{"left", "x z rotation"}}) +
         force("right", 0.0, -1.0) +
         wall("bed", touches +
                         "side = \"below\"; "
                         "profile = { type = \"parabola\", apex = [1.0, -0.16], curvature = -0.05 }; "
                         "motion = { x = 0.2, z = 0.3, rotation = 0.1, about = [1.0, 0.0] }") +
         wall("peg", (has_no_faces ? on_axis + "; " : touches) +
                         "outline = { type = \"circle\", centre = [1.3, 1.9], radius = 1.5 }; motion = { z = -0.2 }") +
         contact("method = \"compliant\"; law = " + law);
}

const std::vector<std::string> theories{"euler-bernoulli",     "elastica; order = 6",  "reissner; order = 1",
                                        "reissner; order = 2", "essenburg; order = 1", "essenburg; order = 2"};

}  // namespace

// Differences of fourth order over 5e-5, at random states. The least gap of two elements or faces has a kink where both
// are equal: there differences are wrong. K leaves out how edges move Gauss's points, an error of the quadrature: 3e-7
// with a depth of 0.1 on these two elements.
TEST(CompliantWalls, HaveRightDerivatives) {
  const std::vector<std::string> laws{
      "{ stiffness = 50.0 }", "{ stiffness = 50.0, depth = 0.3 }",
      "{ penetration = [0.0, 0.05, 0.2, 0.5], pressure = [0.0, 2.0, 20.0, 90.0], interpolation = \"smooth\" }",
      "{ penetration = [0.0, 0.1, 0.2], pressure = [0.0, 2.0, 20.0] }"};
  test::Numbers numbers(17);
  int pressed = 0, states = 0, smooth = 0;
  for (const std::string& theory : theories)
    for (const std::string surface : {"axis", "face"})
      for (const std::string& law : laws) {
        SCOPED_TRACE(theory + ", " + surface + ", " + law);
        const Session session = make_session({.deck = "walls.toml", .deck_text = among_walls(theory, surface, law)});
        const System& system = session.model().system();
        for (int i = 0; i < 6; ++i) {
          State state{
              .x = 0.15 * numbers.vector(system.size({})), .lambda = numbers(), .active_set = system.open_active_set()};
          for (std::size_t j = 0; j < state.active_set.size(); ++j) state.active_set[j] = i % 4 == 3 ? 0 : 1;
          const CompliantContact& contact = *session.model().compliant();
          pressed += contact.force(state, 0) + contact.force(state, 1) > 0.0 ? 1 : 0;
          const DerivativeReport report = check_derivatives(system, state, 5e-5);
          EXPECT_LE(report.K, 1e-7);
          EXPECT_LE(report.F_lambda, 1e-7);
          EXPECT_LE(report.energy, 1e-7);
          EXPECT_LE(report.consistency, 1e-13);
          ++states;
          smooth += report.guard_gradient <= 1e-9 ? 1 : 0;
        }
      }
  EXPECT_GT(pressed, states / 7);
  EXPECT_GT(smooth, 9 * states / 10);
}

// --- convergence ----------------------------------------------------------------------------------------------------

namespace {

// The force of the bed at λ = 1.
double force_of_bed(const std::string& theory, const std::string& surface, int elements) {
  std::string deck = beam_over_bed(theory, elements, 0.4, "height = 1e-5; shear_area = 1.0");
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"E = 10000000.0", "E = 1e7\nnu = 0.3"},
                                 {"contact_surface = \"axis\"", "contact_surface = \"" + surface + "\""}})
    deck.replace(deck.find(from), from.size(), to);
  return last(traced(deck), 1);
}

}  // namespace

// The edges of contact are inside elements. Differences from a mesh of 96: those of slender beams are at once beside
// what the ends of contact in this or that element make.
TEST(CompliantWalls, HaveForcesOfOrderTwoInTheMeshSlow) {
  for (const std::string theory :
       {"euler-bernoulli", "elastica; order = 4", "elastica; order = 6", "reissner; order = 1", "reissner; order = 2"})
    for (const std::string surface : {"axis", "face"}) {
      const double finest = force_of_bed(theory, surface, 96);
      const double coarse = std::abs(force_of_bed(theory, surface, 12) - finest);
      const double finer = std::abs(force_of_bed(theory, surface, 24) - finest);
      EXPECT_LE(finer, std::max(coarse / 3.7, 1e-6 * finest)) << theory << surface;
    }
}

// --- the rigid limit ------------------------------------------------------------------------------------------------

// The load of a snap on walls that are ten times as stiff, twice: how far it is from that of rigid walls falls as the
// root of the compliance, as the length does in which contact turns the column. Forces on a rigid floor at the ends of
// a zone have a lever of that length alone: k^(−3/4).
TEST(CompliantWalls, TendToRigidOnesSlow) {
  const auto run_of = [](const std::string& file, std::vector<std::string> assignments) {
    assignments.insert(assignments.end(), {"path.jumps=false", "path.stop.event=\"limit-point\""});
    Session run = open_session(std::string(EXAMPLES) + "/" + file, assignments);
    while (run.next() != nullptr) {
    }
    return run;
  };
  const auto off = [&](const std::string& file, const std::string& mesh, std::size_t monitor) {
    const auto value = [&](const std::vector<std::string>& law) {
      std::vector<std::string> assignments = law;
      assignments.push_back(mesh);
      const Session run = run_of(file, assignments);
      const auto snaps = events_of(run.record(), EventKind::limit_point);
      return snaps.empty() ? last(run, monitor) : snaps.front().lambda;
    };
    const double rigid = value({});
    std::vector<double> errors;
    for (const char* stiffness : {"1e5", "1e6", "1e7"})
      errors.push_back(std::abs(
          value({"contact.method=\"compliant\"", fmt::format("contact.law={{stiffness={}}}", stiffness)}) - rigid));
    return errors;
  };
  const std::vector<double> snap = off("channel.toml", "member.column.elements=160", 0);
  EXPECT_NEAR(std::log10(snap[1] / snap[2]), 0.5, 0.06);
  const std::vector<double> reaction = off("foundation.toml", "member.beam.elements=160", 1);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(std::log10(reaction[i] / reaction[i + 1]), 0.75, 0.03);
}

// --- invariances ----------------------------------------------------------------------------------------------------

// In other units, and upside down.
TEST(CompliantWalls, DoNotDependOnUnitsNorOnTheSide) {
  const std::string deck = column_in_channel("elastica", 16, 50.0);
  const Session run = traced(deck);
  std::string other = deck;
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(other.find(from), std::string::npos) << from;
    other.replace(other.find(from), from.size(), to);
  };
  // cm and kN → m and N: lengths by 1e-2, forces by 1e3, E by 1e7, the law by 1e7; loads by λ in kN stay.
  replace("length = \"cm\"", "length = \"m\"");
  replace("force = \"kN\"", "force = \"N\"");
  replace("E = 21000.0", "E = 2.1e11");
  replace("width = 0.1", "width = 0.001");
  replace("height = 0.1", "height = 0.001");
  replace("right = [2.0, 0.0]", "right = [0.02, 0.0]");
  replace("amplitude = 0.002", "amplitude = -2.0e-5");
  replace("amplitude = 0.0003", "amplitude = -3.0e-6");
  replace("force = [-1.0, 0.0]", "force = [-1000.0, 0.0]");
  replace("side = \"above\"", "side = \"below\"");
  replace("z = 0.15", "z = -0.0015");
  replace("stiffness = 50", "stiffness = 5e8");
  const Session mirrored = traced(other);
  ASSERT_EQ(run.events().size(), mirrored.events().size());
  for (std::size_t i = 0; i < run.events().size(); ++i) {
    EXPECT_EQ(run.events()[i].kind, mirrored.events()[i].kind);
    EXPECT_NEAR(run.events()[i].lambda, mirrored.events()[i].lambda, 1e-9);
    EXPECT_NEAR(run.events()[i].monitors[0], -100.0 * mirrored.events()[i].monitors[0], 1e-7);
    EXPECT_NEAR(run.events()[i].monitors[1], -1e-3 * mirrored.events()[i].monitors[1], 1e-7);
  }
}

// --- a wall that moves, and what is told ----------------------------------------------------------------------------

// A floor comes up under a beam and goes back down in a second stage.
TEST(CompliantWalls, AreTouchedAndLeftAsTheyMove) {
  std::string deck = beam_over_bed("euler-bernoulli", 20, 0.0);
  deck.replace(deck.find("[contact]"), 0, "motion = { z = 3e-4 }\n");
  deck.replace(deck.find("[[load]]"), deck.find("[[wall]]") - deck.find("[[load]]"), "");
  deck.replace(
      deck.find("[path]"), deck.find("[[monitor]]") - deck.find("[path]"),
      "[path]\n[[stage]]\nname = \"up\"\ndrives = [\"wall.bed\"]\nstep = 0.1\nstop = { lambda = [-0.1, 1.0] }\n"
      "[[stage]]\nname = \"down\"\ndrives = [\"wall.bed\"]\nstep = -0.1\nstop = { lambda = [-1.0, 0.1] }\n");
  const Session run = traced(deck);
  const auto closes = events_of(record(run), EventKind::contact_closes),
             opens = events_of(record(run), EventKind::contact_opens);
  ASSERT_EQ(closes.size(), 1U);
  ASSERT_EQ(opens.size(), 1U);
  EXPECT_NEAR(closes[0].lambda, 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(opens[0].lambda, -2.0 / 3.0, 1e-9);
  double most = 0.0;
  for (const RecordPoint& point : run.points()) {
    double sum = 0.0;
    for (const RecordForce& contact : point.forces) sum += contact.force;
    EXPECT_NEAR(sum, point.monitors[1], 1e-9 * std::max(1.0, sum));
    EXPECT_TRUE(point.forces.empty() || point.contacts == 1);
    most = std::max(most, sum);
  }
  EXPECT_GT(most, 0.1);
  EXPECT_EQ(last(run, 1), 0.0);
}

// The rates of a touch by the place of the wall, on which the stiffness has no influence, and of a snap by the
// stiffness, against runs beside.
TEST(CompliantWalls, KnowHowLoadsDependOnThem) {
  const std::string deck = column_in_channel("elastica", 24, 500.0);
  const auto load = [&](EventKind kind, const std::string& assignment) {
    return event_of(record(traced(deck, {assignment})), kind).lambda;
  };
  const Session run = traced(deck, {"path.sensitivity=[\"contact.law.stiffness\",\"wall.upper.profile.z\"]"});
  const auto rate = [&](EventKind kind, std::size_t key) {
    const RecordSensitivity& of = event_of(record(run), kind).sensitivity.at(key);
    EXPECT_TRUE(of.slope) << of.why_none;
    return of.slope.value_or(0.0);
  };
  const double snap = (load(EventKind::limit_point, "contact.law.stiffness=501") -
                       load(EventKind::limit_point, "contact.law.stiffness=499")) /
                      2.0;
  const double touch = (load(EventKind::contact_closes, "wall.upper.profile.z=0.1501") -
                        load(EventKind::contact_closes, "wall.upper.profile.z=0.1499")) /
                       2e-4;
  EXPECT_NEAR(rate(EventKind::limit_point, 0), snap, 1e-4 * std::abs(snap));
  EXPECT_NEAR(rate(EventKind::contact_closes, 0), 0.0, 1e-9);
  EXPECT_NEAR(rate(EventKind::contact_closes, 1), touch, 1e-4 * std::abs(touch));
}

// A wall of its own law, and laws of walls that are rigid.
TEST(CompliantWalls, MayHaveLawsOfTheirOwn) {
  const std::string deck = beam_over_bed("euler-bernoulli", 20, 0.4);
  std::string own = deck;
  own.replace(own.find("law = { stiffness = 1e5 }"), 25, "");
  own.replace(own.find("[contact]"), 0, "law = { stiffness = 1e5 }\n");
  EXPECT_EQ(last(traced(deck), 1), last(traced(own), 1));
  EXPECT_EQ(last(traced(deck, {"contact.law.stiffness=2e5"}), 1), last(traced(own, {"wall.bed.law.stiffness=2e5"}), 1));
  EXPECT_GT(last(traced(deck, {"contact.law.stiffness=2e5"}), 1), last(traced(deck), 1));
}

// A roller that moves through a strip within one step would leave it without force. It pushes the strip by as much in
// short steps and long ones: at 40, 32.14 in the middle with 223.5, where a rigid roller pushes with 246.9. One of
// radius 1 cannot bear that, and a path on which its centre would pass the strip ends.
TEST(CompliantWalls, DoNotMoveThroughAMemberInOneStep) {
  for (const std::string step : {"0.1", "1.0", "5.0"}) {
    SCOPED_TRACE(step);
    const Session run = traced(pushed_strip("3.0"), {"path.step=" + step});
    EXPECT_EQ(run.points().back().lambda, 40.0);
    EXPECT_NEAR(last(run, 0), 32.14, 0.01);
    EXPECT_NEAR(last(run, 1), 223.5, 0.1);
    EXPECT_LT(traced(pushed_strip("1.0"), {"path.step=" + step}).points().back().lambda, 40.0);
  }
}

}  // namespace arcwall::compliant_test
