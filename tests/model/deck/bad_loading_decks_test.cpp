// What λ may drive, and what holds it: movements, walls, heat, pressure, springs and stages.
#include "tests/model/deck/bad_decks.hpp"

namespace arcwall::deck::bad_decks_test {

TEST(BadLoadingDecks, Movements) {
  expect_refused({
      {"at = \"D\"\nz = -0.5", "z = -0.5", "prescribed.0.at", "is missing", -1},
      {"at = \"D\"\nz = -0.5", "at = \"Q\"\nz = -0.5", "prescribed.0.at", "not a point of this deck"},
      {"at = \"D\"\nz = -0.5", "at = \"column:0.5\"\nz = -0.5", "prescribed.0.at", "not a point of this deck"},
      {"z = -0.5\nrotation = 0.25", "", "prescribed.0.at", "nothing is prescribed", -1},
      {"z = -0.5\nrotation = 0.25", "z = nan", "prescribed.0.z", "finite"},
      {"z = -0.5\nrotation = 0.25", "y = 1.0", "prescribed.0.y", "not a key of this table"},
  });
}

TEST(BadLoadingDecks, Springs) {
  expect_refused({
      {"between = [\"A\", \"C\"]", "", "spring.1.at", "none of `at`, `between` and `on`", -1},
      {"between = [\"A\", \"C\"]", "between = [\"A\", \"C\"]\nat = \"A\"", "spring.1.between",
       "both `at` and `between`"},
      {"between = [\"A\", \"C\"]", "between = [\"A\"]", "spring.1.between", "a spring joins two points"},
      {"between = [\"A\", \"C\"]", "between = [\"A\", \"A\"]", "spring.1.between.1", "named twice"},
      {"between = [\"A\", \"C\"]", "between = [\"A\", \"column\"]", "spring.1.between", "not a point of this deck"},
      {"x = 2.5, rotation = 0.5", "x = -2.5, rotation = 0.5", "spring.0.stiffness.x", "at least 0"},
      {"x = 2.5, rotation = 0.5", "x = 0, rotation = 0", "spring.0.stiffness", "the spring has no stiffness"},
      {"x = 2.5, rotation = 0.5", "y = 2.5", "spring.0.stiffness.y", "not a key of this table"},
      {"stiffness = { z = 0.125 }", "", "spring.1.stiffness", "is missing", -2},
      {"stiffness = { z = 0.125 }", "stiffness = 0.125", "spring.1.stiffness", "wrong type"},
      {"stiffness = { z = 0.125 }", "foundation = { z = 0.125 }", "spring.1.foundation", "a spring along a member"},
      {"foundation = { z = 3.0 }", "", "spring.2.foundation", "is missing", -2},
      {"foundation = { z = 3.0 }", "foundation = { z = 0.0 }", "spring.2.foundation", "no stiffness"},
      {"foundation = { z = 3.0 }", "foundation = { z = inf }", "spring.2.foundation.z", "finite"},
      {"foundation = { z = 3.0 }", "stiffness = { z = 3.0 }", "spring.2.stiffness", "a spring at points"},
      {"on = \"wave\"", "on = \"weave\"", "spring.2.on", "did you mean wave?"},
  });
}

TEST(BadLoadingDecks, WallsThatMoveAndTheirForces) {
  expect_refused({
      {"motion = { x = 0.5", "motion = { y = 0.5", "wall.2.motion.y", "not a key of this table"},
      {"motion = { x = 0.5", "motion = { x = inf", "wall.2.motion.x", "finite"},
      {"about = [1.0, -9.0] }", "about = 1.0 }", "wall.2.motion.about", "wrong type"},
      {"wall = \"hill\"", "", "monitor.2.at", "none of `at`, `wall`, `member` and `spring`", -2},
      {"wall = \"hill\"", "wall = \"hill\"\nat = \"D\"", "monitor.2.component",
       "and no moment; give gap, force-x or force-z", 2},
      {"wall = \"hill\"", "wall = \"hill\"\nspring = \"wave\"", "monitor.2.spring", "both `wall` and `spring`", 1},
      {"wall = \"hill\"", "wall = \"hil\"", "monitor.2.wall", "did you mean hill?"},
      {"component = \"moment\"", "component = \"rotation\"", "monitor.2.component", "a wall has no rotation"},
      {"component = \"reaction-z\"", "component = \"force-z\"", "monitor.1.component", "belongs to a wall"},
  });
}

// Movements, walls, heat, pressure and springs; words that other programs have for them.
TEST(BadLoadingDecks, WhatLambdaMayDrive) {
  expect_refused({
      {"[[prescribed]]", "[[displacement]]", "displacement", "a point is moved by [[prescribed]]"},
      {"[[prescribed]]", "[[imposed]]", "imposed", "a point is moved by [[prescribed]]"},
      {"[[prescribed]]", "[[sp]]", "sp", "moved by [[prescribed]]"},
      {"[support]", "[boundary]", "boundary", "held by [support]"},
      {"[[load]]\nat", "[[thermal]]\nat", "thermal", "heated by a [[load]] with on and temperature"},
      {"temperature = 20.0\ngradient", "thermal = 20.0\ngradient", ".thermal", "did you mean temperature?"},
      {"temperature = 20.0\ngradient", "dT = 20.0\ngradient", ".dT", "did you mean temperature?"},
      {"z = -0.5\nrotation", "uz = -0.5\nrotation", "prescribed.0.uz", "did you mean z?"},
      {"z = -0.5\nrotation = 0.25", "", "prescribed.0.at", "nothing is prescribed", -1},
      {"z = -0.5\nrotation", "z = nan\nrotation", "prescribed.0.z", "not a finite number"},
      {"z = -0.5\nrotation", "z = \"down\"\nrotation", "prescribed.0.z", "not in [variables]"},
      {"at = \"D\"\nz", "at = \"Q\"\nz", "prescribed.0.at", "\"Q\" is not a point of this deck"},
      {"temperature = 20.0\n", "temperature = \"hot\"\n", ".temperature", "not in [variables]"},
      {"temperature = 20.0\ngradient", "temperature = 20.0\nforce = [1.0, 0.0]\ngradient", ".force",
       "does not go together with a temperature", 1},
      {"pressure = -0.5", "pressure = [0.0, -0.5]", ".pressure", "wrong type"},
      {"pressure = -0.5", "pressure = inf", ".pressure", "not a finite number"},
      {"pressure = -0.5", "follower = -0.5", ".follower", "not a key of this table"},
      {"[[prescribed]]", "[[step]]", "step", "are [[stage]]"},
      {"pressure = -0.5", "pressure = -0.5\ntemperature = 3.0", ".temperature", "does not go together with a pressure",
       1},
      {"frame = \"member\"", "frame = \"local\"", ".frame", "did you mean member?"},
      {"frame = \"member\"", "frame = 1", ".frame", "wrong type"},
  });
}

// What would be taken and do nothing, or something else than was meant.
TEST(BadLoadingDecks, LoadsAndMovementsThatDoNothing) {
  expect_refused({
      {"expansion = 1.2e-5", "expansion = 0.0", "load.3.on", "expansion = 0: temperatures do nothing", elsewhere},
      {"expansion = 1.2e-5", "alpha = 1.2e-5", "material.plain.alpha", "did you mean expansion?"},
      {"expansion = 1.2e-5", "", "load.3.on", "material plain of member column has no expansion", elsewhere},
      {"on = \"column\"\ntemperature", "on = \"strut\"\ntemperature", "load.3.gradient", "a truss, which does not bend",
       2},
      {"on = \"column\"\ntemperature", "on = \"arch\"\ntemperature", "load.3.on",
       "which does not support temperatures"},
      {"on = \"column\"\ntemperature", "on = \"Q\"\ntemperature", "load.3.on", "not a member of this deck"},
      {"on = \"column\"\ntemperature", "at = \"B\"\ntemperature", "load.3.temperature", "belongs to a load on a member",
       1},
      {"on = \"column\"\npressure", "at = \"B\"\npressure", "load.4.pressure", "write `on` instead of `at`", 1},
      {"on = \"column\"\npressure", "on = \"strut\"\npressure", "load.4.on", "a truss, which cannot carry a pressure"},
      {"on = \"column\"\npressure", "on = \"colum\"\npressure", "load.4.on", "did you mean column?"},
      {"pressure = -0.5", "pressure = -0.5\nframe = \"member\"", "load.4.frame", "a load that is distributed", 1},
      {"pressure = -0.5", "", "load.4.distributed", "no distributed, pressure, temperature or gradient", -2},
      {"pressure = -0.5", "q = -0.5", "load.4.q", "did you mean distributed?"},
      {"force = [-1.0, 0.5]", "force = [-1.0, 0.5]\nframe = \"member\"", "load.0.frame", "a load that is distributed",
       1},
      {"at = \"D\"\nz", "at = \"column:0.5\"\nz", "prescribed.0.at", "divide member column there"},
      {"[[prescribed]]\nat = \"C\"", "[[prescribed]]\nat = \"D\"\nz = 0.5\n[[prescribed]]\nat = \"C\"", "prescribed",
       "prescribed.0 and prescribed.1 both move D in z"},
      {"x = 0.5, z = -1.0, rotation = 0.25, about = [1.0, -9.0]", "about = [1.0, -9.0]", "wall.2.motion",
       "the wall does not move"},
      {"about = [1.0, -9.0]", "about = \"C\"", "wall.2.motion.about", "give two numbers [x, z]"},
      {"rotation = 0.25, about", "angle = 0.25, about", "wall.2.motion.angle", "did you mean rotation?"},
      {"x = 0.5, z = -1.0, rotation", "x = inf, z = -1.0, rotation", "wall.2.motion.x", "not a finite number"},
  });
}

// Movements of one direction of which one is constant add.
TEST(BadLoadingDecks, MovementsAddWhereOneIsConstant) {
  const std::string text = replaced(column_deck, "[[load]]", "[[prescribed]]\nat = \"B\"\nx = -1.0\n[[load]]");
  const std::string constant = text + "[[prescribed]]\nat = \"B\"\nx = 0.1\nconstant = true\n";

  EXPECT_TRUE(diagnostics_of(constant).empty()) << all_of(diagnostics_of(constant));
  EXPECT_FALSE(diagnostics_of(replaced(constant, "x = -1.0", "x = -1.0\nconstant = true")).empty());
  EXPECT_FALSE(diagnostics_of(replaced(constant, "x = 0.1\nconstant = true", "x = 0.1")).empty());
  EXPECT_TRUE(diagnostics_of(replaced(constant, "x = 0.1\nconstant = true", "rotation = 0.1")).empty());
}

TEST(BadLoadingDecks, LawsOfSprings) {
  const auto said = [](const std::string& u, const std::string& force) {
    const std::string law = "law = { direction = \"x\", displacement = " + u + ", force = " + force + " }";
    return all_of(diagnostics_of(replaced(full_deck, "stiffness = { x = 2.5, rotation = 0.5 }", law)));
  };
  EXPECT_EQ(said("[-1.0, 0.0, 1.0]", "[-1.0, 0.0, 1.0]"), "");
  EXPECT_NE(said("[0.0]", "[0.0]").find("at least 2"), std::string::npos);
  EXPECT_NE(said("[0.0, 1.0]", "[0.0]").find("2 displacements and 1 forces"), std::string::npos);
  EXPECT_NE(said("[1.0, 0.0]", "[1.0, 0.0]").find("do not increase"), std::string::npos);
  EXPECT_NE(said("[0.0, 0.0, 1.0]", "[0.0, 0.0, 1.0]").find("do not increase"), std::string::npos);
  EXPECT_NE(said("[0.0, 1e-12, 1.0]", "[0.0, 1.0, 2.0]").find("are the same to 9 digits"), std::string::npos);
  EXPECT_NE(said("[0.0, 1.0]", "[0.0, 0.0]").find("the spring has no force"), std::string::npos);
  EXPECT_NE(said("[0.5, 1.0]", "[0.0, 1.0]").find("not without force at displacement 0"), std::string::npos);
  EXPECT_NE(said("[0.0, nan]", "[0.0, 1.0]").find("not a finite number"), std::string::npos);
  EXPECT_NE(said("[0.0, true]", "[0.0, 1.0]").find("wrong type"), std::string::npos);
  EXPECT_EQ(said("[0.0, 1.0]", "[0.0, 1.0], interpolation = \"linear\""), "");
  const std::string unknown = said("[0.0, 1.0]", "[0.0, 1.0], interpolation = \"cubic\"");
  EXPECT_NE(unknown.find("law.interpolation"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("known are smooth, linear"), std::string::npos) << unknown;
}

TEST(BadLoadingDecks, LawsOfFoundations) {
  const auto said = [](const std::string& keys) {
    return all_of(diagnostics_of(replaced(full_deck, "foundation = { z = 3.0 }", keys)));
  };
  const std::string law = "law = { direction = \"z\", displacement = [0.0, 1.0], force = [0.0, 1.0] }";
  EXPECT_EQ(said(law), "");
  EXPECT_NE(said(law + "\nfoundation = { z = 3.0 }").find("spring.2.foundation: does not go together with a law"),
            std::string::npos);
  EXPECT_NE(said(replaced(law, "\"z\"", "\"rotation\"")).find("spring.2.law: a foundation resists no rotation"),
            std::string::npos);
  EXPECT_NE(said(replaced(law, "[0.0, 1.0] }", "[0.0, 0.0] }")).find("spring.2.law.force: the spring has no force"),
            std::string::npos);
  EXPECT_NE(said(law + "\nstiffness = { z = 3.0 }").find("spring.2.stiffness"), std::string::npos);
  EXPECT_NE(said(replaced(law, "[0.0, 1.0] }", "[0.0, 1.0], interpolation = \"linear\" }"))
                .find("the law of a foundation cannot be linear"),
            std::string::npos);
}

TEST(BadLoadingDecks, StagesThatDoNothing) {
  const std::string moved = "[[prescribed]]\nat = \"B\"\nrotation = 1.0\n";
  const std::string first =
      "[[stage]]\nname = \"turn\"\ndrives = [\"prescribed.0\"]\nstop = { lambda = [-1.0, 1.0] }\n";
  const std::string second = "[[stage]]\nname = \"push\"\ndrives = [\"load.0\"]\n";
  const auto said = [&](const std::string& a, const std::string& b) {
    return all_of(diagnostics_of(std::string(column_deck) + moved + a + b));
  };
  const std::string drives_nothing = replaced(first, "[\"prescribed.0\"]", "[]");
  EXPECT_EQ(said(first, second), "");
  EXPECT_EQ(said(drives_nothing, second).find("no stage drives"), std::string::npos);  // said of the stage itself
  EXPECT_NE(said(drives_nothing, second).find("stage.0.drives: the array is empty"), std::string::npos);
  EXPECT_NE(said(replaced(first, "prescribed.0", "wall.w"), second).find("is nothing that λ may drive"),
            std::string::npos);
  EXPECT_NE(said(replaced(first, "stop = { lambda = [-1.0, 1.0] }\n", ""), second).find("nothing stops stage \"turn\""),
            std::string::npos);
  EXPECT_NE(said(first, "").find("no stage drives load.0"), std::string::npos);
  EXPECT_NE(
      said(first + replaced(second, "load.0", "prescribed.1") + "[[prescribed]]\nat = \"A\"\nrotation = 0.0\n", second)
          .find("stage.1.drives: nothing varies with λ in this stage"),
      std::string::npos);
  const auto visiting = [&](const std::string& values) {
    return said(replaced(first, "stop = { lambda = [-1.0, 1.0] }", "visit = " + values), second);
  };
  EXPECT_EQ(visiting("[0.05, -0.05, 0.05]"), "");
  EXPECT_NE(visiting("[0.05, 0.05]").find("visit: λ is there already (0.05 twice in a row)"), std::string::npos);
  EXPECT_NE(visiting("[0.0, 0.05]").find("visit: λ is there already (it begins at 0)"), std::string::npos);
  EXPECT_NE(visiting("[0.05]\nstop = { lambda = [-1.0, 1.0] }").find("stop: visit says already where λ ends"),
            std::string::npos);
  EXPECT_NE(
      said(replaced(first, "stop = { lambda = [-1.0, 1.0] }", "visit = [1.0]"), replaced(second, "push", "turn-1"))
          .find("stage \"turn-1\" has the name that a visit of another one has"),
      std::string::npos);
  EXPECT_NE(said(first + second, "[path]\nvisit = [1.0]\n").find("visit belongs to a deck without stages"),
            std::string::npos);
  EXPECT_NE(said(replaced(first, "drives", "active"), second).find("did you mean drives?"), std::string::npos);
}

}  // namespace arcwall::deck::bad_decks_test
