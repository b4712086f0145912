#include "apps/verify/touches.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::verify::touches_test {

namespace {

using test::TracedDeck;

constexpr double length = 10.0, height = 0.6, radius = 1.0, moment = 37.8;
constexpr double bending_stiffness = 2.1e4 * height * height * height / 12.0;

// Supported at both ends and bent by moments there, down onto a wall in the middle.
std::string bent_beam(const std::string& wall) {
  return fmt::format(R"toml(
title = "A beam that end moments bend onto a stop"
material.m = {{ E = 2.1e4 }}
section.s = {{ shape = "rectangle", width = 1.0, height = {} }}
point = {{ a = [0.0, 0.0], b = [{}, 0.0] }}
support = {{ a = ["x", "z"], b = ["z"] }}
member.beam = {{ from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = 40 }}
load = [{{ at = "a", moment = {} }}, {{ at = "b", moment = {} }}]
wall = [{{ name = "stop", {} }}]
path = {{ step = 0.1, stop = {{ lambda = [-1.0, 1.0] }} }}
)toml",
                     height, length, -moment, moment, wall);
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// The only contact of a state, with what it resists a turn of its node by, whose place is held, and with the curvature
// of the beam there by statics: the wall's force F at the place r is borne by V = −(r − a) × F/(b − a) at b, where
// nothing else acts along z, so that EI κ = M + V (x_b − x).
struct ContactOfBeam {
  double force = 0.0, stiffness = 0.0, curvature = 0.0;
};

ContactOfBeam contact_of(const TracedDeck& traced) {
  const std::vector<PlainWall> walls{PlainWall(traced.model().deck().walls.at(0))};
  const Touches found = touches(traced.model(), walls, traced.last());
  const Touch& touch = found.all.at(0);
  const Tangency& tangency = found.tangencies.at(0);
  const double tilt = tangency.tilt.gradient()[2];
  const SlidingMesh& mesh = mesh_of(traced.last());
  const MeshState now = mesh_state_of(traced.last());
  const Vec2 a = mesh.node(0, 0, now).position, b = mesh.node(0, mesh.nodes(0) - 1, now).position;
  const auto [strand, position] = mesh.breakpoint(0);
  const AxisPlace axis = mesh.node(strand, position, now);
  const Vec2 force = touch.force * perp(Vec2(std::cos(axis.angle), std::sin(axis.angle)));
  const double at_b = -cross(touch.place - a, force) / (b - a).x();
  return {.force = touch.force,
          .stiffness = tangency.spring.value() * tilt * tilt - touch.force * touch.gap.hessian()(2, 2),
          .curvature = (moment + at_b * (b - axis.position).x()) / bending_stiffness};
}

}  // namespace

// Near the contact face and stop are two circles: the beam's of the radius ρ − o about the place that its axis of the
// curvature κ = 1/ρ has at the distance ρ from the node, and the stop's, about which the axis is at the distance y. As
// the beam turns by δ about the node the centres come nearer by ρ y/(ρ + y) δ²/2, and with them the circles, whatever
// slides: the wall resists with p y/(1 + κ y), on a flat one with p/κ.
TEST(Touches, ThatSlideResistATurnAsTwoCirclesDo) {
  struct Case {
    std::string wall;
    double distance;  // y, of the axis from the centre of the stop
  };
  const double face = radius + 0.5 * height, centre = -1.0 - radius;
  const std::string as_profile = R"(side = "below", profile = )", as_outline = "outline = ";
  const auto circle = [](double z) {
    return fmt::format(R"({{ type = "circle", centre = [{}, {}], radius = {} }})", 0.5 * length, z, radius);
  };
  const std::string flat = fmt::format(R"({{ type = "flat", z = {} }})", -1.0 - 0.5 * height);
  const std::string on_axis = R"(contact_surface = "axis", )";
  for (const Case& one :
       {Case{as_profile + circle(centre - 0.5 * height), face}, Case{as_outline + circle(centre - 0.5 * height), face},
        Case{as_profile + flat, infinity}, Case{on_axis + as_profile + circle(centre), radius},
        Case{on_axis + as_outline + circle(centre), radius}}) {
    SCOPED_TRACE(one.wall);
    const TracedDeck traced(bent_beam(one.wall));
    const ContactOfBeam contact = contact_of(traced);
    ASSERT_GT(contact.force, 1.0);
    EXPECT_NEAR(contact.stiffness * (1.0 / one.distance + contact.curvature), contact.force, 1e-4 * contact.force);
  }
}

// A floor below one of two members in line: at their joint the one touches as with a free end, at any slope.
TEST(Touches, AnEndAtAJointMayTiltOnAWallOfItsOwn) {
  test::expect_whole(TracedDeck(R"toml(
title = "Beam on a stop spring with play, and a floor"
material.steel = { E = 2.1e5 }
section.s = { shape = "rectangle", width = 10.0, height = 1.0 }
point = { a = [0.0, 0.0], m = [100.0, 0.0], b = [200.0, 0.0] }
support = { a = ["x", "z"], b = ["z"] }
path = { step = 0.1, stop = { lambda = [-1.0, 10.0] } }
load = [{ on = "l", distributed = [0.0, -0.1] }, { on = "r", distributed = [0.0, -0.1] }, { at = "b", force = [-5.0, 0.0] }]
wall = [{ name = "floor", contact_surface = "axis", members = ["l"], side = "below", profile = { type = "flat", z = -2.0 } }]
monitor = [{ name = "mid", at = "m", component = "z" }, { name = "f", wall = "floor", component = "force-z" }]
[[spring]]
name = "s"
at = "m"
law = { direction = "z", displacement = [-3.0, -2.0, 0.0, 1.0], force = [-12.0, -10.0, 0.0, 0.0] }
[[spring]]
name = "t"
at = "m"
law = { direction = "rotation", displacement = [-0.02, -0.01, 0.0, 0.01, 0.02], force = [-100.0, 0.0, 0.0, 0.0, 100.0] }
[member]
l = { from = "a", to = "m", theory = "elastica", material = "steel", section = "s", elements = 10 }
r = { from = "m", to = "b", theory = "elastica", material = "steel", section = "s", elements = 10 }
)toml"));
}

}  // namespace arcwall::verify::touches_test
