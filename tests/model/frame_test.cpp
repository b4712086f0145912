// A model computes in coordinates of its structure's own place and size; users see their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "model/deck/frame.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/writer.hpp"
#include "model/shape.hpp"
#include "tests/model/traced_session.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::frame_test {

using namespace test::tables;

namespace {

// A portal whose loaded corner goes to a stop once its columns buckle. All coordinates have few digits.
const std::string portal = R"toml(
title = "Portal with a stop"
units = { length = "m", force = "kN" }
material.steel = { E = 2.1e8 }
section.column = { shape = "general", A = 0.01, I = 1.0e-5 }
point = { west = [0.0, 0.0], north-west = [0.0, 4.0], north-east = [4.0, 4.0], east = [4.0, 0.0] }
member.left = { from = "west", to = "north-west", theory = "elastica", material = "steel", section = "column", elements = 8 }
member.beam = { from = "north-west", to = "north-east", theory = "elastica", material = "steel", section = "column", elements = 8 }
member.right = { from = "north-east", to = "east", theory = "elastica", material = "steel", section = "column", elements = 8 }
support = { west = ["x", "z"], east = ["x", "z"] }
load = [{ at = "north-west", force = [0.0, -1.0] }, { at = "north-east", force = [0.0, -1.0] }]
wall = [{ name = "stop", contact_surface = "axis", outline = { type = "half-plane", point = [4.0625, 4.0], normal = [-1.0, 0.0] } }]
path = { step = 20.0, stop = { lambda = [-100.0, 400.0], sway = [-1.0, 1.0] } }
monitor = [{ name = "sway", at = "north-east", component = "x" }, { name = "stop", wall = "stop", component = "force-x", sign = -1 },
           { name = "knee", at = "left:1.0", component = "moment" }]
)toml";

// Of each kind of key that is a length or a place.
const std::string walls =
    title("Column between a sloping line, a spline and a polyline that turns") + material("steel", 2000.0) +
    rectangle("s", 0.5, 0.25) + points({{"a", 0.0, 0.0}, {"b", 10.0, 0.0}}) + supports({{"a", "x z"}, {"b", "z"}}) +
    force("b", -1.0, 0.0) + distributed("c", 0.0, 0.001, constant) +
    path("step = 0.1; stop = { lambda = [-1.0, 3.0] }") + monitor("mid", "c:0.5", "z") +
    table("[[monitor]]", R"(name = "gap"; at = "c:0.5"; wall = "round"; component = "gap")") +
    table("[[monitor]]", R"(name = "most"; member = "c"; component = "max-moment")") +
    table("[[spring]]", R"(at = "b"; stiffness = { x = 0.01, rotation = 0.5 })") +
    table("[[spring]]",
          R"(at = "a"; law = { direction = "rotation", displacement = [-1.0, 0.0, 1.0], force = [-0.25, 0.0, 0.5] })") +
    table("[[spring]]", R"(on = "c"; foundation = { z = 0.002 })") +
    member("c", "a", "b", "elastica", 16, imperfection({{1, 0.02}}), "steel") +
    wall("slope", R"(side = "above"; profile = { type = "line", z = 0.75, slope = 0.0625 })") +
    wall("round", R"(side = "below"; profile = { type = "circle", centre = [5.0, -6.0], radius = 5.0 })") +
    wall(
        "corner",
        R"(outline = { type = "polyline", x = [9.0, 5.0, 1.0], z = [2.0, 1.5, 2.0] }; corner_radius = 0.5; motion = { z = -0.125, rotation = 0.03125, about = [4.0, 1.0] })");

const std::string arch = R"toml(
title = "Heated arch under pressure on a curved member's springs"
material.m = { E = 4000.0, nu = 0.25, expansion = 1.0e-3 }
section.t = { shape = "tube", radius = 0.25, thickness = 0.0625 }
point = { a = [-4.0, 0.0], b = [0.0, 1.0], c = [4.0, 0.0] }
support = { a = ["x", "z"], c = ["x", "z"] }
load = [{ on = "left", pressure = 0.05 }, { on = "right", pressure = 0.05 }, { on = "right", temperature = 10.0, gradient = 4.0 }, { at = "b", force = [0.0, -1.0], moment = 0.25 }]
prescribed = [{ at = "c", x = -0.015625, constant = true }]
spring = [{ at = "b", law = { direction = "z", displacement = [-1.0, 0.0, 1.0], force = [-0.5, 0.0, 0.25] } },
          { on = "right", law = { direction = "z", displacement = [-2.0, 0.0, 2.0], force = [-0.02, 0.0, 0.02], interpolation = "smooth" } }]
path = { step = 0.1, stop.lambda = [-1.0, 4.0], max_points = 60 }
monitor = [{ name = "down", at = "b", component = "z" }, { name = "thrust", at = "a", component = "reaction-x" }, { name = "moment", at = "left:0.5", component = "moment" }]
[member.left]
from = "a"
to = "b"
theory = "reissner"
material = "m"
section = "t"
elements = 8
curve = { x = [-4.0, -2.0, 0.0], z = [0.0, 0.75, 1.0] }
[member.right]
from = "b"
to = "c"
theory = "elastica"
material = "m"
section = "t"
elements = 8
via = [2.0, 0.75]
)toml";

deck::Deck read(const std::string& text) { return deck::read_deck_text(text, "deck.toml"); }

// As if the user had written it in these coordinates.
std::string written_in(const std::string& text, const deck::Frame& frame) {
  return deck::to_toml(deck::in_frame(read(text), frame));
}

}  // namespace

TEST(Frame, IsTheUsersOwnForTheExamples) {
  for (const auto& entry : std::filesystem::directory_iterator(EXAMPLES)) {
    if (entry.path().filename().string().starts_with("sweep-")) continue;
    EXPECT_TRUE(deck::frame_of(deck::read_deck(entry.path().string())).is_users()) << entry.path();
  }
}

TEST(Frame, HasTheStructureBesideItsOriginAndOfItsSize) {
  const deck::Deck far = read(written_in(portal, {.origin = {-500000.0, 5400000.0}, .exponent = 40}));
  const deck::Frame frame = deck::frame_of(far);
  EXPECT_EQ(frame.exponent, -40);
  const deck::Deck near = deck::in_frame(far, frame);
  const deck::Vector& first = near.points.front().at;
  for (std::size_t i = 0; i < near.points.size(); ++i) {
    const deck::Vector& at = near.points[i].at;
    EXPECT_LE(std::max(std::abs(at.x), std::abs(at.z)), 8.0);
    // Not a digit is lost.
    EXPECT_EQ(std::ldexp(at.x - first.x, -40), far.points[i].at.x - far.points.front().at.x);
    EXPECT_EQ(std::ldexp(at.z - first.z, -40), far.points[i].at.z - far.points.front().at.z);
  }
}

// A conversion and its inverse change nothing: what is converted at all is so by one power of two and one shift. And it
// makes the same structure: the deck that is traced as it is, in the user's own coordinates, has the same events.
TEST(Frame, MakesTheSameStructureOfAnyDeckSlow) {
  for (const std::string& text : {portal, walls, arch}) {
    const deck::Deck original = read(text);
    deck::Deck there = deck::in_frame(original, {.origin = {-2.0, 4.0}, .exponent = 3});
    there.frame = {};
    deck::Deck back = deck::in_frame(there, {.origin = {0.25, -0.5}, .exponent = -3});
    back.frame = {};
    EXPECT_EQ(deck::to_toml(back), deck::to_toml(original));

    ASSERT_TRUE(deck::frame_of(there).is_users());
    const Session run = test::traced(text), other = test::traced(deck::to_toml(there));
    const Record& record = run.record();
    ASSERT_EQ(other.record().events.size(), record.events.size()) << record.title;
    for (std::size_t i = 0; i < record.events.size(); ++i) {
      EXPECT_EQ(other.record().events[i].kind, record.events[i].kind);
      EXPECT_NEAR(other.record().events[i].lambda, record.events[i].lambda, 1e-7 * (1.0 + record.events[i].lambda));
    }
  }
}

// Coordinates of a national grid: one part in 10⁷ of them is the way to the stop.
TEST(FarFromTheOrigin, TheEventsAreThoseBesideIt) {
  const Vec2 place(500000.0, 5400000.0);
  const Session near = test::traced(portal);
  const Session far = test::traced(written_in(portal, {.origin = {-place.x(), -place.y()}}));
  ASSERT_FALSE(far.model().frame().is_users());
  ASSERT_EQ(far.record().points.size(), near.record().points.size());
  for (std::size_t i = 0; i < near.record().points.size(); ++i) {
    const RecordPoint &a = near.record().points[i], &b = far.record().points[i];
    EXPECT_NEAR(b.lambda, a.lambda, 1e-9 * std::abs(a.lambda));
    EXPECT_EQ(b.count.unstable, a.count.unstable);
    ASSERT_EQ(b.forces.size(), a.forces.size());
    for (std::size_t k = 0; k < a.forces.size(); ++k) EXPECT_NEAR(b.forces[k].x - place.x(), a.forces[k].x, 1e-8);
  }
  EXPECT_EQ(test::events_of(far.record(), EventKind::limit_point).size(), 0U);
  const Shape shape = shape_of(far.model(), far.record().points.front().state);
  EXPECT_NEAR((shape.members[0].points.back().position - place - Vec2(0.0, 4.0)).norm(), 0.0, 1e-8);
  EXPECT_NEAR(wall_shapes(far.model())[0].line.front().x(), place.x() + 4.0625, 1e-8);
}

// In units that make its lengths 10⁻¹² the structure has the same loads, and everything else in these units.
TEST(TinyLengths, HaveTheEventsOfOrdinaryOnesSlow) {
  constexpr int e = 40;
  for (const std::string& text : {portal, walls, arch}) {
    const Session ordinary = test::traced(text), tiny = test::traced(written_in(text, {.exponent = e}),
                                                                     [&] {
                                                                       return text == portal ? std::vector<std::string>{"path.stop.sway=[-1e-12, 1e-12]"}
                                         : std::vector<std::string>{};
                                                                     }());
    ASSERT_EQ(tiny.model().frame().exponent, -e);
    ASSERT_EQ(tiny.record().points.size(), ordinary.record().points.size());
    for (std::size_t i = 0; i < ordinary.record().points.size(); ++i) {
      const RecordPoint &a = ordinary.record().points[i], &b = tiny.record().points[i];
      EXPECT_EQ(b.lambda, a.lambda);
      EXPECT_EQ(b.energy, std::ldexp(a.energy, -e));
      for (std::size_t k = 0; k < a.forces.size(); ++k) {
        EXPECT_EQ(b.forces[k].x, std::ldexp(a.forces[k].x, -e));
        EXPECT_EQ(b.forces[k].force, a.forces[k].force);
        ASSERT_EQ(b.forces[k].pressure.has_value(), a.forces[k].pressure.has_value());
        EXPECT_EQ(b.forces[k].pressure.value_or(0.0), std::ldexp(a.forces[k].pressure.value_or(0.0), e));
      }
    }
    const auto column = [&](const std::string& name) {
      const auto& columns = ordinary.record().columns;
      return static_cast<std::size_t>(
          std::find_if(columns.begin(), columns.end(), [&](const RecordColumn& one) { return one.name == name; }) -
          columns.begin());
    };
    const auto& a = ordinary.record().points.back().monitors;
    const auto& b = tiny.record().points.back().monitors;
    for (const char* length_or_moment : {"sway", "knee", "mid", "gap", "most", "down", "moment"})
      if (const std::size_t k = column(length_or_moment); k < a.size()) {
        EXPECT_EQ(b[k], std::ldexp(a[k], -e));
      }
    for (const char* other : {"stop", "thrust", "most-place"})
      if (const std::size_t k = column(other); k < a.size()) {
        EXPECT_EQ(b[k], a[k]);
      }
  }
}

}  // namespace arcwall::frame_test
