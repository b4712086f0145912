#include "model/deck/reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::deck::reader_test {

namespace {

Deck full() { return read_deck_text(full_deck, "full.toml"); }

Deck column_with(const std::string& more) { return read_deck_text(std::string(column_deck) + more, "column.toml"); }

std::vector<Diagnostic> diagnostics_of(const std::string& text, const std::vector<std::string>& assignments = {}) {
  try {
    read_deck_text(text, "bad.toml", assignments);
  } catch (const InputError& error) {
    return error.diagnostics();
  }
  return {};
}

}  // namespace

TEST(DeckReader, FillsInEveryDefault) {
  const Deck deck = read_deck_text(column_deck, "column.toml");

  EXPECT_EQ(deck.source.file, "column.toml");
  EXPECT_EQ(deck.description, "");
  EXPECT_EQ(deck.units, Units{});
  EXPECT_FALSE(deck.materials.at(0).nu);
  EXPECT_TRUE(std::holds_alternative<Straight>(deck.members.at(0).axis));
  EXPECT_FALSE(deck.members.at(0).order);
  EXPECT_FALSE(deck.members.at(0).hinge_from || deck.members.at(0).hinge_to);
  EXPECT_FALSE(deck.loads.at(0).constant);
  EXPECT_EQ(std::get<PointLoad>(deck.loads.at(0).action).moment, 0.0);
  EXPECT_EQ(deck.contact, Contact{});
  EXPECT_EQ(deck.path, Path{});
  EXPECT_TRUE(deck.walls.empty() && deck.monitors.empty());
}

TEST(DeckReader, KeepsTheOrderOfTheDeck) {
  const Deck deck = full();

  std::vector<std::string> names;
  for (const Point& point : deck.points) names.push_back(point.name);
  for (const Member& member : deck.members) names.push_back(member.name);
  for (const OutputValues& output : deck.path.output_at) names.push_back(output.name);
  for (const StopBounds& bounds : deck.path.stop.bounds) names.push_back(bounds.name);
  const std::vector<std::string> expected{"B",      "A",     "C",   "D",      "column", "arch",  "wave",
                                          "spline", "strut", "mid", "lambda", "mid",    "lambda"};
  EXPECT_EQ(names, expected);
}

TEST(DeckReader, ReadsMembersOfEveryTheory) {
  const Deck deck = full();

  const Member& column = deck.members.at(0);
  EXPECT_EQ(column.theory, Theory::euler_bernoulli);
  EXPECT_EQ(column.elements, 80);
  ASSERT_EQ(column.imperfections.size(), 2u);
  EXPECT_EQ(column.imperfections[1].amplitude, -1e-4);
  EXPECT_EQ(column.imperfections[1].waves, 3);
  EXPECT_TRUE(column.hinge_to && !column.hinge_from);
  const Member& arch = deck.members.at(1);
  EXPECT_EQ(arch.order, 1);
  EXPECT_EQ(arch.along, QuadraticTerm::director);
  EXPECT_EQ(std::get<Arc>(arch.axis), (Arc{{3.0, 0.9}}));
  const Member& wave = deck.members.at(2);
  EXPECT_EQ(wave.order, 2);
  EXPECT_EQ(std::get<SineAxis>(wave.axis), (SineAxis{0.1, 2}));
  EXPECT_EQ(wave.imperfections.size(), 1u);
  EXPECT_EQ(deck.members.at(3).order, 4);
  EXPECT_EQ(std::get<Curve>(deck.members.at(3).axis).z.at(2), 2.0);
  EXPECT_EQ(deck.members.at(4).strain, TrussStrain::log);
}

TEST(DeckReader, ReadsSupportsAndLoads) {
  const Deck deck = full();

  EXPECT_EQ(deck.supports.at(1).point, "D");
  EXPECT_EQ(deck.supports.at(1).directions, (std::vector<Dof>{Dof::z, Dof::thickness, Dof::thickness2}));
  const auto& end = std::get<PointLoad>(deck.loads.at(0).action);
  EXPECT_EQ(end.at, (Place{.name = "B"}));
  EXPECT_EQ(end.force, (Vector{-1.0, 0.5}));
  EXPECT_EQ(end.moment, 0.25);
  const auto& moment = std::get<PointLoad>(deck.loads.at(1).action);
  EXPECT_EQ(moment.at, (Place{.name = "column", .fraction = 0.25}));
  EXPECT_TRUE(deck.loads.at(1).constant);
  EXPECT_EQ(std::get<MemberLoad>(deck.loads.at(2).action), (MemberLoad{"arch", {0.0, -3.0}, LoadFrame::member}));
}

TEST(DeckReader, ReadsWallsAndContact) {
  const Deck deck = full();

  ASSERT_EQ(deck.walls.size(), 10u);
  EXPECT_EQ(deck.walls[0].side, Side::above);
  EXPECT_EQ(deck.walls[0].contact_surface, ContactSurface::axis);
  EXPECT_TRUE(deck.walls[0].members.empty());
  EXPECT_EQ(std::get<FlatProfile>(deck.walls[0].profile).z, 5.0);
  EXPECT_EQ(deck.walls[1].members, (std::vector<std::string>{"column", "arch"}));
  EXPECT_EQ(std::get<LineProfile>(deck.walls[1].profile), (LineProfile{-5.0, 0.05}));
  EXPECT_EQ(std::get<CircleProfile>(deck.walls[2].profile), (CircleProfile{{1.0, -9.0}, 4.9}));
  EXPECT_EQ(std::get<ParabolaProfile>(deck.walls[3].profile), (ParabolaProfile{{1.0, -4.0}, 0.1}));
  EXPECT_EQ(std::get<SplineProfile>(deck.walls[4].profile).x.size(), 10u);
  EXPECT_FALSE(deck.walls[4].outline);
  EXPECT_EQ(deck.walls[5].outline, Outline(HalfPlaneOutline{{20.0, 0.0}, {-1.0, 0.75}}));
  EXPECT_EQ(deck.walls[6].outline, Outline(CircleOutline{{1.0, 0.75}, 30.0, Keep::inside}));
  EXPECT_TRUE(std::get<PolylineOutline>(*deck.walls[7].outline).closed);
  EXPECT_EQ(std::get<PolylineOutline>(*deck.walls[7].outline).points().at(1), Vec2(20.0, -20.0));
  EXPECT_EQ(deck.walls[7].corner_radius, 0.125);
  EXPECT_EQ(deck.walls[8].outline, Outline(EllipseOutline{{1.0, -20.0}, {2.5, 1.25}, 0.75}));
  EXPECT_EQ(std::get<CurveOutline>(*deck.walls[9].outline).z.at(1), -38.5);
  EXPECT_EQ(deck.contact, (Contact{ContactLaw::Method::augmented, ContactPoints::nodes, 1e5, 1e-9}));
}

TEST(DeckReader, ReadsPathAndMonitors) {
  const Deck deck = full();

  EXPECT_EQ(deck.path.method, PathMethod::displacement);
  EXPECT_EQ(deck.path.output_at.at(1).values, (std::vector<double>{0.4, 0.4475}));
  ASSERT_TRUE(deck.path.control);
  EXPECT_EQ(deck.path.control->at, (Place{.name = "column", .fraction = 0.5}));
  EXPECT_EQ(deck.path.control->component, Component::x);
  EXPECT_EQ(deck.path.step, -0.5);
  EXPECT_EQ(deck.path.branches, BranchPolicy::all);
  EXPECT_EQ(deck.path.watch, (std::vector<std::string>{"mid", "end"}));
  EXPECT_EQ(deck.path.events, EventSearch::detect);
  EXPECT_EQ(deck.path.equilibrium_family, ContinuumChoice::stop);
  EXPECT_EQ(deck.path.stop.bounds.at(0).low, -0.16);
  EXPECT_EQ(deck.path.stop.contacts, 40);
  EXPECT_EQ(deck.monitors.at(0).component, Component::face_below_z);
  EXPECT_EQ(deck.monitors.at(1).sign, -1);
}

TEST(DeckReader, RemembersWhereThingsStand) {
  const Deck deck = read_deck_text(column_deck, "column.toml");

  EXPECT_EQ(deck.materials.at(0).position.line, 3);
  EXPECT_EQ(deck.members.at(0).position.line, 15);
  EXPECT_EQ(deck.members.at(0).position.column, 9);
  EXPECT_EQ(deck.supports.at(1).position.line, 25);
  EXPECT_EQ(std::get<PointLoad>(deck.loads.at(0).action).at.position.line, 28);
  const Diagnostic later = diagnostic_at(deck.source, deck.supports.at(1).position, "support.B", "is not enough");
  EXPECT_EQ(to_text(later), "column.toml:25:1: support.B: is not enough");
}

TEST(DeckReader, TakesANodeOfAMemberByAnyFractionThatIsOne) {
  const std::string monitor = "[[monitor]]\nname = \"m\"\ncomponent = \"z\"\nat = ";

  EXPECT_EQ(column_with(monitor + "\"column:0\"").monitors.at(0).at.fraction, 0.0);
  EXPECT_EQ(column_with(monitor + "\"column:1.0\"").monitors.at(0).at.fraction, 1.0);
  EXPECT_EQ(column_with(monitor + "\"column:125e-4\"").monitors.at(0).at.fraction, 0.0125);
}

TEST(DeckReader, AppliesAssignmentsInTheirOrder) {
  const Deck deck = read_deck_text(column_deck, "column.toml",
                                   {"member.column.elements=160", "member.column.elements = 40", "load.0.force=[-2, 0]",
                                    "point.B.0=3.0", "path.stop.lambda=[0, 1]", "path.method=\"riks\""});

  EXPECT_EQ(deck.members.at(0).elements, 40);
  EXPECT_EQ(deck.members.at(0).position.line, 15);
  EXPECT_EQ(std::get<PointLoad>(deck.loads.at(0).action).force, (Vector{-2.0, 0.0}));
  EXPECT_EQ(deck.points.at(1).at.x, 3.0);
  EXPECT_EQ(deck.path.stop.bounds.at(0).high, 1.0);
  EXPECT_EQ(deck.path.method, PathMethod::riks);
}

TEST(DeckReader, NamesTheAssignmentThatIsWrong) {
  const auto wrong_value = diagnostics_of(std::string(column_deck), {"title='x'", "member.column.elements=0"});
  const auto wrong_key = diagnostics_of(std::string(column_deck), {"member.column.elemnts=160"});

  ASSERT_EQ(wrong_value.size(), 1u);
  EXPECT_EQ(wrong_value[0].file, "--set member.column.elements=0");
  EXPECT_EQ(wrong_value[0].key, "member.column.elements");
  EXPECT_EQ(wrong_value[0].line, 0);
  ASSERT_EQ(wrong_key.size(), 1u);
  EXPECT_EQ(wrong_key[0].file, "--set member.column.elemnts=160");
  EXPECT_NE(wrong_key[0].cure.find("elements"), std::string::npos);
}

TEST(DeckReader, ReportsEveryErrorAtOnceInTheOrderOfTheFile) {
  std::string text = replaced(column_deck, "E = 2.1e4", "E = -1");
  text = replaced(text, "width = 0.1", "widht = 0.1");
  text = replaced(text, "elements = 80", "elements = 80.0");
  text = replaced(text, "at = \"B\"", "at = \"Q\"");

  const auto found = diagnostics_of(text);

  ASSERT_EQ(found.size(), 5u);
  EXPECT_EQ(found[0].key, "material.steel.E");
  EXPECT_EQ(found[1].key, "section.square.width");
  EXPECT_EQ(found[2].key, "section.square.widht");
  EXPECT_EQ(found[2].cure, "did you mean width?");
  EXPECT_EQ(found[3].key, "member.column.elements");
  EXPECT_EQ(found[4].key, "load.0.at");
  for (const Diagnostic& diagnostic : found) EXPECT_EQ(diagnostic.file, "bad.toml");
}

TEST(DeckReader, DoesNotReportOneErrorTwice) {
  // An impossible number of elements must not make the monitor's fraction, nor a bad point the member's length, wrong
  // too.
  std::string text = replaced(column_deck, "elements = 80", "elements = \"many\"");
  text = replaced(text, "B = [2.0, 0.0]", "B = [2.0, false]");
  text += "[[monitor]]\nname = \"m\"\ncomponent = \"z\"\nat = \"column:0.3\"\n";

  const auto found = diagnostics_of(text);

  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].key, "point.B.1");
  EXPECT_EQ(found[1].key, "member.column.elements");
}

// A name that nothing has is one error, however many members have it.
TEST(DeckReader, OneCauseIsOneError) {
  std::string text(column_deck);
  text = replaced(text, "[material.steel]", "[material.stahl]");
  const std::string member =
      text.substr(text.find("[member.column]"), text.find("[support]") - text.find("[member.column]"));
  for (const char* name : {"second", "third"})
    text += replaced(member, "[member.column]", "[member." + std::string(name) + "]");
  const auto found = diagnostics_of(text);
  const auto of_material =
      std::count_if(found.begin(), found.end(), [](const Diagnostic& one) { return one.key.ends_with(".material"); });
  ASSERT_EQ(of_material, 1);
  const auto first =
      std::find_if(found.begin(), found.end(), [](const Diagnostic& one) { return one.key.ends_with(".material"); });
  EXPECT_EQ(first->key, "member.column.material");
  EXPECT_TRUE(first->message.starts_with("\"steel\" is not a material of this deck (in 2 more places, too: lines "))
      << first->message;
}

TEST(DeckReader, UprightWallsAreToldOnceWithTheOutlineThatTheyAre) {
  const auto said_of_wall = [](const std::string& keys) {
    const auto found = diagnostics_of(std::string(column_deck) + "[[wall]]\nname = \"stop\"\n" + keys);
    EXPECT_EQ(found.size(), 1u) << keys;
    return found.empty() ? std::string() : to_text(found.front());
  };
  for (const char* keys : {"side = \"above\"\nprofile = { type = \"flat\", x = 2.0 }\n",
                           "side = \"left\"\nprofile = { type = \"flat\", z = 2.0 }\n",
                           "side = \"above\"\nprofile = { type = \"vertical\", x = 2.0 }\n",
                           "side = \"above\"\nprofile = { type = \"line\", z = 0.0, slope = inf }\n"}) {
    const std::string said = said_of_wall(keys);
    EXPECT_NE(said.find("a profile z = ψ(x) with a side above or below cannot be vertical; give the wall, in place of "
                        "profile and side, outline = { type = \"half-plane\""),
              std::string::npos)
        << said;
  }
}

// The second moments are those of every handbook; a tube of full thickness is a circle.
TEST(SectionProperties, MatchTheClosedForms) {
  constexpr double pi = std::numbers::pi;
  const SectionProperties rectangle = properties({.shape = Rectangle{0.2, 0.3}}, 0.0);
  const SectionProperties circle = properties({.shape = Circle{0.5}}, 0.0);
  const SectionProperties tube = properties({.shape = Tube{0.5, 0.1}}, 0.0);
  const SectionProperties solid = properties({.shape = Tube{0.5, 0.5}}, 0.0);
  const SectionProperties general = properties({.shape = General{6.0, 2.0, 5.0, std::nullopt}}, 0.0);

  EXPECT_DOUBLE_EQ(rectangle.A, 0.06);
  EXPECT_DOUBLE_EQ(rectangle.I, 0.2 * 0.027 / 12.0);
  EXPECT_EQ(rectangle.height, 0.3);
  EXPECT_DOUBLE_EQ(circle.A, pi * 0.25);
  EXPECT_DOUBLE_EQ(circle.I, pi * 0.0625 / 4.0);
  EXPECT_EQ(circle.height, 1.0);
  EXPECT_DOUBLE_EQ(tube.A, pi * (0.25 - 0.16));
  EXPECT_DOUBLE_EQ(tube.I, pi * (0.0625 - 0.0256) / 4.0);
  EXPECT_DOUBLE_EQ(solid.I, circle.I);
  EXPECT_EQ(general.shear_area, 5.0);
  EXPECT_FALSE(general.height);
}

}  // namespace arcwall::deck::reader_test
