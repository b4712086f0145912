#include "model/model.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "continuation/tracer.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/model/deck/sample_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::model_test {

using namespace test::tables;
namespace {

std::vector<Diagnostic> problems_of(const std::string& text) {
  try {
    const Model model(deck::read_deck_text(text, "odd.toml"));
  } catch (const InputError& error) {
    return error.diagnostics();
  }
  return {};
}

// A beam with a load at its middle comes down on a round floor at 0.42 of its length.
struct Descent {
  std::optional<double> touch{};  // λ
  BranchEnd end{};
};

Descent descent(int elements) {
  const Model model(deck::read_deck_text(R"toml(
title = "A beam on a round floor"
material.steel = { E = 1.0e4 }
section.bar = { shape = "rectangle", width = 1.0, height = 0.1 }
point = { left = [0.0, 0.0], right = [20.0, 0.0] }
support = { left = ["x", "z"], right = ["x", "z"] }
load = [{ at = "beam:0.5", force = [-0.3, -1.0] }]
path = { step = 0.001, stop = { lambda = [-0.06, 0.06] } }
[member.beam]
from = "left"
to = "right"
theory = "euler-bernoulli"
material = "steel"
section = "bar"
imperfection = { shape = "sine", amplitude = -0.1, waves = 1 }
[[wall]]
name = "floor"
side = "below"
profile = { type = "circle", centre = [8.0, -30.25], radius = 30.0 }
)toml",
                                         "floor.toml", {"member.beam.elements=" + std::to_string(elements)}));
  std::string reason;
  Tracer tracer(model.system(), model.start(reason).value(), model.options());
  Descent found;
  while (const auto arc = tracer.next())
    for (const Event& event : arc->events)
      if (event.kind == EventKind::contact_closes) found.touch = event.state.lambda;
  found.end = tracer.end().value();
  return found;
}

// Of 16 elements the last before the load is 1.3 long where the touch begins to be followed: it must be two.
TEST(Model, ATouchBesideALoadIsFollowedWithElementsThatAreShortEnough) {
  const Descent coarse = descent(16), fine = descent(40);
  EXPECT_EQ(coarse.end.reason, EndReason::stop) << coarse.end.detail;
  EXPECT_EQ(fine.end.reason, EndReason::stop);
  ASSERT_TRUE(coarse.touch && fine.touch);
  EXPECT_NEAR(*coarse.touch, *fine.touch, 1e-4 * *fine.touch);  // measured: 4.6·10⁻⁵
}

// Of four elements one has its end at the load and the touch in its nearer half.
TEST(Model, ATouchBesideALoadIsFoundOnFewElements) {
  const Descent fine = descent(40);
  ASSERT_TRUE(fine.touch);
  for (const auto& [elements, error] : {std::pair(4, 0.02), std::pair(8, 0.001)}) {  // measured: 0.0156 and 0.0009
    const Descent found = descent(elements);
    EXPECT_EQ(found.end.reason, EndReason::stop) << found.end.detail;
    ASSERT_TRUE(found.touch) << elements;
    EXPECT_NEAR(*found.touch, *fine.touch, error * *fine.touch) << elements;
  }
}

// Two members in line are meshed as one: their joint has no unknowns of its own.
TEST(Model, MonitorsOfAJointBetweenMembersInLineAreThoseOfTheirEnds) {
  const Model model(deck::read_deck_text(
      title("A beam of two members") + material("steel", 1.0e4) + rectangle("bar", 1.0, 0.1) +
          points({{"left", 0.0, 0.0}, {"middle", 8.0, 0.0}, {"right", 20.0, 0.0}}) +
          supports({{"left", "x z"}, {"right", "z"}}) + force("middle", 0.0, -0.01) +
          path("step = 0.1; stop = { lambda = [-1.0, 1.0] }") +
          member("a", "left", "middle", "euler-bernoulli", 4, "", "steel", "bar") +
          member("b", "middle", "right", "euler-bernoulli", 6, "", "steel", "bar") + flat_wall("floor", "below", -5.0) +
          monitor("joint-turns", "middle", "rotation") + monitor("member-turns", "a:1.0", "rotation") +
          monitor("joint-falls", "middle", "z") + monitor("member-falls", "b:0.0", "z"),
      "line.toml"));
  ASSERT_NE(model.sliding(), nullptr);
  std::string reason;
  Tracer tracer(model.system(), model.start(reason).value(), model.options());
  State last;
  while (const auto arc = tracer.next()) last = arc->to.state;
  const auto value = [&](std::size_t i) { return model.monitors()[i].quantity->value(last); };
  EXPECT_LT(value(0), -0.01);
  EXPECT_DOUBLE_EQ(value(0), value(1));
  EXPECT_LT(value(2), -0.1);
  EXPECT_DOUBLE_EQ(value(2), value(3));
}

// Each alone is a number, but powers and quotients of them are not, or the length of an element is lost in the digits
// of its coordinates.
TEST(Model, RefusesSizesWhoseStiffnessIsBeyondNumbers) {
  const std::pair<const char*, const char*> changes[] = {
      {"A = [0.0, 0.0]", "A = [-1.7976931348623157e308, 0.0]"},
      {"B = [2.0, 0.0]", "B = [2e-60, 0.0]"},
      {"E = 2.1e4", "E = 1e300"},
      {"E = 2.1e4", "E = 5e-324"},
      {"height = 0.2", "height = 1e-40"},
      {"A = [0.0, 0.0]\nB = [2.0, 0.0]", "A = [1e15, 0.0]\nB = [1e15, 2.0]"},
  };
  ASSERT_TRUE(problems_of(std::string(deck::column_deck)).empty());
  for (const auto& [from, to] : changes) {
    const auto found = problems_of(deck::replaced(deck::column_deck, from, to));
    ASSERT_EQ(found.size(), 1u) << to;
    EXPECT_EQ(found.front().key, "member.column") << to;
    EXPECT_NE(found.front().message.find("cannot be computed"), std::string::npos) << to_text(found.front());
  }
}

// An imperfection as long as its member is none, and one much longer makes lengths that are not numbers.
TEST(Model, RefusesAnImperfectionAsLargeAsItsMember) {
  const auto with_amplitude = [](const std::string& amplitude) {
    return deck::replaced(
        deck::column_deck, "theory = \"euler-bernoulli\"",
        "theory = \"euler-bernoulli\"\nimperfection = { shape = \"sine\", amplitude = " + amplitude + ", waves = 3 }");
  };
  ASSERT_TRUE(problems_of(with_amplitude("-0.2")).empty());
  for (const char* amplitude : {"2.0", "-7.2e307"}) {
    const auto found = problems_of(with_amplitude(amplitude));
    ASSERT_EQ(found.size(), 1U) << amplitude;
    EXPECT_EQ(found.front().key, "member.column.imperfection");
    EXPECT_NE(found.front().message.find("as large as the member is long"), std::string::npos);
  }
}

// So is its length, against the height of the section.
TEST(Model, RefusesAnElementWithoutLengthBesideItsHeight) {
  const std::string deck = deck::replaced(deck::replaced(deck::column_deck, "E = 2.1e4", "E = 2.1e4\nnu = 0.3"),
                                          "theory = \"euler-bernoulli\"", "theory = \"essenburg\"");
  ASSERT_TRUE(problems_of(deck).empty());
  const auto found = problems_of(deck::replaced(deck, "B = [2.0, 0.0]", "B = [2e-22, 0.0]"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().key, "member.column");
}

// The shear stiffness is looked at where there is one.
TEST(Model, RefusesAShearStiffnessBeyondNumbers) {
  const std::string deck = deck::replaced(deck::replaced(deck::column_deck, "E = 2.1e4", "E = 2.1e4\nnu = 0.3"),
                                          "theory = \"euler-bernoulli\"", "theory = \"reissner\"");
  ASSERT_TRUE(problems_of(deck).empty());
  const std::string soft = deck::replaced(deck, "height = 0.2", "height = 0.2\nshear_correction = 1e-200");
  const std::string none = deck::replaced(soft, "E = 2.1e4", "E = 1e-200");  // the product is zero
  for (const std::string& text : {soft, none}) {
    const auto found = problems_of(text);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front().key, "member.column");
  }
}

std::string deck_with_wall(const std::string& side, const std::string& profile) {
  std::string text(deck::column_deck);
  text += "[[wall]]\nname = \"w\"\nside = \"";
  text += side;
  text += "\"\nprofile = { ";
  text += profile;
  return text += " }\n";
}

std::string said_of_wall(const std::string& side) {
  const auto found = problems_of(deck_with_wall(side, "type = \"flat\", z = 0.5"));
  return found.empty() ? "" : to_text(found.front());
}

TEST(Model, ASideThatIsTheWrongOneIsGuessed) {
  EXPECT_EQ(said_of_wall("above"), "");
  EXPECT_EQ(said_of_wall("below"),
            "odd.toml:30:1: wall.w: member \"column\" is inside the wall at the start: node column:0 by 0.6; side = "
            "\"below\" means that the structure stays above the wall: is \"above\" meant? Else move the wall, or "
            "give it an interference");
}

TEST(Model, AWallThatIsEnteredInPartIsOnTheRightSide) {
  const std::string deck = deck_with_wall("above", "type = \"line\", z = 0.6, slope = -0.3333333333333333");
  const auto found = problems_of(deck);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().cure, "move the wall, or give it an interference");
  EXPECT_NE(found.front().message.find("node column:1 by 0.1581"), std::string::npos) << found.front().message;
}

}  // namespace
std::string said_of(const std::string& deck) {
  std::string text;
  for (const Diagnostic& problem : problems_of(deck)) text += to_text(problem) + "\n";
  return text;
}

// What the structure decides: a hinge, a support, elements.
TEST(Model, RefusesMovementsAndSpringsOfWhatIsNotThere) {
  const std::string column(deck::column_deck);
  const std::string hinged = deck::replaced(column, "elements = 80", "elements = 80\nhinge = [\"to\"]");
  EXPECT_NE(said_of(hinged + "[[prescribed]]\nat = \"B\"\nrotation = 0.1\n")
                .find("odd.toml:31:1: prescribed.rotation: no member end at \"B\" has a rotation"),
            std::string::npos);
  EXPECT_NE(said_of(hinged + "[[spring]]\nat = \"B\"\nlaw = { direction = \"rotation\", displacement = [0.0, 1.0], "
                             "force = [0.0, 1.0] }\n")
                .find("odd.toml:31:1: spring.law.direction: no member end at \"B\" has a rotation"),
            std::string::npos);
  EXPECT_NE(said_of(deck::replaced(column, "force = [-1.0, 0.0]", "force = [0.0, 1.0]"))
                .find("odd.toml:27:1: load: what λ multiplies acts on directions that are held"),
            std::string::npos);
  EXPECT_NE(said_of(column + "[path]\nmethod = \"displacement\"\ncontrol = { at = \"B\", component = \"z\" }\n")
                .find("\"B\" is held in that direction, so that it cannot be controlled"),
            std::string::npos);
  EXPECT_EQ(said_of(column + "[path]\nmethod = \"displacement\"\ncontrol = { at = \"B\", component = \"x\" }\n"), "");
}

TEST(Model, WarnsOfAStartOutsideTheBoundsOfLambda) {
  const auto warned = [](const std::string& path) {
    const auto warnings = Model(deck::read_deck_text(std::string(deck::column_deck) + path, "odd.toml", {})).warnings();
    return warnings.empty() ? "" : warnings.front();
  };
  EXPECT_EQ(warned("[path]\nstop = { lambda = [0.0, 1.0] }\n"), "");
  EXPECT_EQ(warned("[path]\nstep = -0.1\nstop = { lambda = [-1.0, 0.0] }\n"), "");
  EXPECT_NE(warned("[path]\nstep = -0.1\nstop = { lambda = [0.0, 1.0] }\n").find("at once, since step = -0.1"),
            std::string::npos);
  EXPECT_NE(warned("[path]\nstop = { lambda = [0.5, 1.0] }\n").find("outside of stop.lambda = [0.5, 1]"),
            std::string::npos);
}

// Bifurcations are followed only where they are located.
TEST(Model, WarnsOfBranchesThatNoEventStarts) {
  const auto warned = [](const std::string& path) {
    const std::string text = std::string(deck::column_deck) + "[path]\nstop = { lambda = [-1.0, 1.0] }\n" + path;
    const auto warnings = Model(deck::read_deck_text(text, "odd.toml", {})).warnings();
    return warnings.empty() ? "" : warnings.front();
  };
  for (const char* found : {"branches = \"all\"\n", "events = \"detect\"\nbranches = \"primary\"\n"})
    EXPECT_EQ(warned(found), "");
  EXPECT_NE(warned("events = \"none\"\nbranches = \"all\"\n").find("branches = \"all\" has no effect"),
            std::string::npos);
  EXPECT_NE(warned("events = \"detect\"\n").find("events = \"detect\" locates no bifurcations"), std::string::npos);
}

TEST(Model, ADepthInAWallHasItsUnit) {
  const std::string text =
      "units = { length = \"cm\", force = \"kN\" }\n" + deck_with_wall("below", "type = \"flat\", z = 0.5");
  const auto found = problems_of(text);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found.front().message.find("node column:0 by 0.6 cm"), std::string::npos) << found.front().message;
}

// A deck whose author forgot its bounds, and decks with one bound each.
TEST(Model, WarnsOfAPathThatNothingEnds) {
  const auto warnings = [](const std::string& path) {
    const std::string text = title("A beam") + path + "\n" + material("steel", 1.0e4) + rectangle("bar", 1.0, 0.1) +
                             points({{"left", 0.0, 0.0}, {"right", 20.0, 0.0}}) +
                             supports({{"left", "x z"}, {"right", "x z"}}) + force("beam:0.5", 0.0, -1.0) +
                             member("beam", "left", "right", "euler-bernoulli", 4, "", "steel", "bar") +
                             monitor("w", "beam:0.5", "z");
    return Model(deck::read_deck_text(text, "beam.toml", {})).warnings();
  };
  for (const char* endless :
       {"", "path = { step = 0.1 }", "path = { output_at = { lambda = [0.4] } }", "path.stop = {}"}) {
    ASSERT_EQ(warnings(endless).size(), 1u) << endless;
    EXPECT_NE(warnings(endless)[0].find("path.max_points = 5000, the default"), std::string::npos)
        << warnings(endless)[0];
  }
  for (const char* bounded :
       {"path = { max_points = 5000 }", "path.stop = { lambda = [-1.0, 10.0] }", "path.stop = { w = [-1.0, 10.0] }",
        "path.stop = { contacts = 2 }", "path.stop = { event = \"limit-point\" }",
        "path = { method = \"incremental\", output_at = { lambda = [0.4] } }"})
    EXPECT_TRUE(warnings(bounded).empty()) << bounded;
}

// Between two points Hermite's cubic 2 (s + s² − s³) is off the line 2 s by 2 s² (1 − s): 8/27 at s = 2/3.
// A spring at a point has straight pieces unless asked.
TEST(Model, WarnsOfAFoundationsLawThatIsSmoothUnasked) {
  const auto warned = [](const std::string& where, const std::string& interpolation) {
    const std::string law = "[[spring]]\nname = \"bed\"\n" + where +
                            "\nlaw = { direction = \"x\", displacement = [-0.1, 0.0, 0.1], force = [-2.0, 0.0, 2.0]" +
                            interpolation + " }\n[path]\nstop = { lambda = [-1.0, 1.0] }\n";
    const auto warnings = Model(deck::read_deck_text(std::string(deck::column_deck) + law, "odd.toml", {})).warnings();
    return warnings.empty() ? "" : warnings.front();
  };
  const std::string along = "on = \"column\"", at = "at = \"B\"", unasked = warned(along, "");
  EXPECT_NE(unasked.find("the law of spring \"bed\" is smooth between its points"), std::string::npos) << unasked;
  EXPECT_NE(unasked.find("it is 15 % of its maximum force off"), std::string::npos) << unasked;
  EXPECT_EQ(warned(along, ", interpolation = \"smooth\""), "");
  for (const std::string interpolation : {"", ", interpolation = \"smooth\"", ", interpolation = \"linear\""})
    EXPECT_EQ(warned(at, interpolation), "") << interpolation;
}

}  // namespace arcwall::model_test
