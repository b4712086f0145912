#include "apps/output/run_warnings.hpp"

#include <gtest/gtest.h>

#include "apps/output/result_json.hpp"
#include "apps/output/walls_between_nodes.hpp"
#include "tests/apps/cli/program_fixture.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::run_warnings_test {

using namespace test::tables;
namespace {

// A pinned column under a constant thrust along its axis, and a growing force across it. Euler's load is
// π² EI/L² = π² · 2.1e4 · 0.1⁴/12 / 2² = 0.43181 kN.
std::string column(double thrust) {
  return R"(
title = "A column"
units = { length = "cm", force = "kN" }
material.steel = { E = 2.1e4 }
section.square = { shape = "rectangle", width = 0.1, height = 0.1 }
point = { left = [0.0, 0.0], right = [2.0, 0.0] }
support = { left = ["x", "z"], right = ["z"] }
[member.column]
from = "left"
to = "right"
theory = "euler-bernoulli"
material = "steel"
section = "square"
elements = 8
[[load]]
at = "right"
force = [-)" +
         std::to_string(thrust) + R"(, 0.0]
constant = true
[[load]]
at = "column:0.5"
force = [0.0, -0.001]
[path]
step = 0.01
stop = { lambda = [-1.0, 0.02] }
)";
}

TEST(RunWarnings, AnUnstableStartUnderConstantLoadsIsTold) {
  const test::TracedDeck below(column(0.4)), above(column(0.5)), far_above(column(2.0));  // 4 · 0.43 = 1.73
  EXPECT_EQ(warning_of_start(below.model(), below.record()), "");
  EXPECT_NE(warning_of_start(above.model(), above.record()).find("a state with 1 unstable direction:"),
            std::string::npos);
  EXPECT_NE(warning_of_start(far_above.model(), far_above.record()).find("2 unstable directions:"), std::string::npos);
  const auto result = result_json(above.model(), {}, above.record(), {}, 0);
  EXPECT_EQ(result["warnings"].back(), warning_of_start(above.model(), above.record()));
}

// A bar of length 2 cm and EA = 1e-8 kN under 0.5 kN is 1e8 cm longer; the column bends by 2e-12 cm.
TEST(RunWarnings, UnitsThatDoNotFitAreTold) {
  std::string stiff = column(0.4);
  stiff.replace(stiff.find("2.1e4"), 5, "2.1e13");
  const test::TracedDeck still(stiff), right(column(0.4)),
      soft(title("A bar") + units("cm", "kN") + material("steel", 1.0e-8) + general_section("square", 1.0, 1.0) +
           points({{"left", 0.0, 0.0}, {"right", 2.0, 0.0}}) + supports({{"left", "x z"}, {"right", "z"}}) +
           member("bar", "left", "right", "truss", 1, R"(strain = "engineering")", "steel", "square") +
           force("right", 1.0, 0.0) + path("step = 0.5; max_points = 5"));
  EXPECT_EQ(warning_of_units(right.model(), right.record()), "");
  EXPECT_TRUE(warning_of_units(still.model(), still.record()).starts_with("the structure has moved by no more than "));
  EXPECT_TRUE(
      warning_of_units(soft.model(), soft.record())
          .starts_with("a first step of λ as the deck has it would move the structure by 5.0e+07 times its size"))
      << warning_of_units(soft.model(), soft.record());
  const auto result = result_json(still.model(), {}, still.record(), {}, 0);
  EXPECT_EQ(result["warnings"].back(), warning_of_units(still.model(), still.record()));
}

// A bar that is held at both ends and heated does not move; one that only a wall holds falls 5 mm onto it.
TEST(RunWarnings, WhatDoesNotMoveOrIsNotHeldTellsNothingOfUnits) {
  const std::string steel = title("A strip") + units("mm", "N") + material("steel", 2.1e5, "expansion = 1.2e-5") +
                            rectangle("flat", 20.0, 2.0) + points({{"left", 0.0, 0.0}, {"right", 400.0, 0.0}}) +
                            member("strip", "left", "right", "elastica", 8, "", "steel", "flat");
  const std::string to_one = path("step = 0.5; stop = { lambda = [-0.1, 1.0] }");
  const test::TracedDeck heated(steel + supports({{"left", "x z rotation"}, {"right", "x z rotation"}}) +
                                table("[[load]]", R"(on = "strip"; temperature = 1.0)") + to_one),
      falling(steel + supports({{"left", "x rotation"}}) + force("left", 0.0, -1000.0) +
              wall("peg",
                   R"(contact_surface = "axis"; outline = { type = "circle", centre = [0.0, -10.0], radius = 5.0 })") +
              to_one);
  EXPECT_EQ(warning_of_units(heated.model(), heated.record()), "");
  EXPECT_EQ(warning_of_units(falling.model(), falling.record()), "");
}

class RunWarningsTest : public ProgramTest {};

TEST_F(RunWarningsTest, RunPrintsItOnce) {
  put(work() / "column.toml", column(0.5));
  const Outcome outcome = run("run column.toml --quiet");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  expect_in("warning: the constant loads and movements lead to a state with 1 unstable direction:", outcome.err);
  EXPECT_EQ(outcome.err.find("warning:", outcome.err.find("warning:") + 1), std::string::npos) << outcome.err;
}

}  // namespace
// The column that has jumped into three arcs turns by some 2 rad from support to support.
TEST(WarningOfBent, NamesBranchesWhoseElementsTurnFar) {
  const std::string deck(test::example("channel"));
  const test::TracedDeck coarse(deck, {"member.column.elements=8", "path.jumps=false"});
  EXPECT_NE(warning_of_bent(coarse.model(), coarse.record()).find("branch 0 elements turn"), std::string::npos);
  const test::TracedDeck fine(deck, {"path.jumps=false"});
  EXPECT_EQ(warning_of_bent(fine.model(), fine.record()), "");
}

// A beam of weight 120 on three rollers, the middle one lower. With 20 elements the outer rollers lie between nodes,
// and the beam falls past them; with 24 there is a node above each of them.
TEST(RunWarnings, ARollerBetweenNodesIsTold) {
  const auto deck = [](int elements) {
    return R"(
title = "Beam on three rollers"
units = { length = "mm", force = "N" }
material.steel = { E = 2.1e5, nu = 0.3 }
section.b = { shape = "rectangle", width = 40.0, height = 20.0 }
point = { a = [0.0, 0.0], b = [2400.0, 0.0] }
path = { step = 10.0, stop = { lambda = [-10.0, 100.0] } }
load = [{ on = "beam", distributed = [0.0, -0.05], constant = true }, { at = "beam:0.75", force = [0.0, -1.0] }]
support.a = ["x"]
member.beam = { from = "a", to = "b", theory = "reissner", material = "steel", section = "b", elements = )" +
           std::to_string(elements) + R"( }
wall = [{ name = "r1", outline = { type = "circle", centre = [200.0, -60.0], radius = 50.0 } },
 { name = "r2", outline = { type = "circle", centre = [1200.0, -62.0], radius = 50.0 } },
 { name = "r3", outline = { type = "circle", centre = [2200.0, -60.0], radius = 50.0 } }]
)";
  };
  const test::TracedDeck coarse(deck(20)), fine(deck(24));
  EXPECT_NE(warning_of_walls_between_nodes(coarse.model(), coarse.record()).find("beam is inside r1 by"),
            std::string::npos);
  EXPECT_EQ(warning_of_walls_between_nodes(fine.model(), fine.record()), "");
}

}  // namespace arcwall::run_warnings_test
