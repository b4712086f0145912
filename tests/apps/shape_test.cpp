#include "model/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "apps/cli/example_decks.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::shape_test {

using namespace test::tables;

namespace {

using test::TracedDeck;

// A cantilever of length 2 along x with a force across its tip, up to λ = 1.
std::string cantilever(const std::string& theory, const std::string& more = "", const std::string& load = R"(
at = "tip"
force = [-0.3, -1.0]
)") {
  return R"(
title = "Cantilever"
[material.m]
E = 1e4
nu = 0.3
[section.s]
shape = "rectangle"
width = 1.0
height = 0.1
[point]
clamp = [1.0, 0.5]
tip = [3.0, 0.5]
[member.beam]
from = "clamp"
to = "tip"
material = "m"
section = "s"
elements = 8
theory = ")" +
         theory + "\"\n" + more + R"(
[support]
clamp = ["x", "z", "rotation"]
[[load]]
)" + load +
         path("step = 0.1; output_at = { lambda = [1.0] }; stop = { lambda = [-1.0, 1.0] }") +
         monitor("tip", "tip", "z") + monitor("turn", "beam:1", "rotation") +
         monitor("moment", "clamp", "reaction-moment") + monitor("push", "clamp", "reaction-x");
}

const std::vector<std::pair<std::string, std::string>> theories{{"euler-bernoulli", ""},
                                                                {"elastica", "order = 4"},
                                                                {"elastica", "order = 6"},
                                                                {"reissner", "order = 1"},
                                                                {"reissner", "order = 2"},
                                                                {"essenburg", "order = 1\nalong = \"director\""},
                                                                {"essenburg", "order = 2\nalong = \"director\""}};

void for_each_theory(const std::function<void(const std::string&, const std::string&)>& visit) {
  for (const auto& [theory, order] : theories) {
    SCOPED_TRACE(theory + " " + order);
    visit(theory, order);
  }
}

}  // namespace

// Without `along = "director"` the theory of Essenburg is not indifferent to rotations, and no balance holds exactly.
// The tip's force P and its lever arm are all that a section carries: M = (r_tip − r) × P, and along the section's
// normal N = P·t. Nodal forces are as exact as equilibrium.
TEST(Shape, TheForcesOfACantileverAreItsTipsLeverAndForce) {
  for_each_theory([](const std::string& theory, const std::string& order) {
    const TracedDeck traced(cantilever(theory, order));
    const std::vector<ShapePoint> points = shape_of(traced.model(), traced.last()).members.at(0).points;
    ASSERT_GE(points.size(), 41u);
    const Vec2 force(-0.3, -1.0), tip = points.back().position;
    EXPECT_LT(tip.y(), 0.0) << "bends far";
    for (const ShapePoint& point : points) {
      EXPECT_NEAR(point.moment, cross(tip - point.position, force), 1e-7) << point.fraction;
      EXPECT_NEAR(point.axial_force, force.dot(Vec2(std::cos(point.rotation), std::sin(point.rotation))), 1e-7);
    }
    const auto& monitors = traced.record().points.back().monitors;
    EXPECT_NEAR(tip.y() - 0.5, monitors[0], 1e-12);
    EXPECT_NEAR(points.back().rotation, monitors[1], 1e-12);
    EXPECT_NEAR(points.front().moment, -monitors[2], 1e-7) << "the support's moment is the other way";
    EXPECT_NEAR(points.front().axial_force, -monitors[3], 1e-7);
  });
}

// The elements' law, by what an inextensible, unshearable beam would do: the axis' curvature is M/EI.
TEST(Shape, TheMomentIsTheCurvatureTimesTheStiffness) {
  for (const std::string theory : {"euler-bernoulli", "elastica"}) {
    const TracedDeck traced(cantilever(theory));
    const std::vector<ShapePoint> points = shape_of(traced.model(), traced.last()).members.at(0).points;
    const double EI = 1e4 * 0.1 * 0.1 * 0.1 / 12.0;
    for (std::size_t k = 0; k + 10 < points.size(); k += 5) {  // from node to node: eight elements in forty parts
      const double turned = points[k + 10].rotation - points[k].rotation, ds = 2.0 * 10.0 / 40.0;
      const double mean = (points[k].moment + 4.0 * points[k + 5].moment + points[k + 10].moment) / 6.0;  // Simpson
      EXPECT_NEAR(EI * turned / ds, mean, 2e-4) << theory << " " << points[k].fraction;
    }
  }
}

// M = −q (L − x)²/2 and N = 0 of a cantilever under its weight, for small deflections: q L³/EI = 0.01.
TEST(Shape, AWeightBendsACantileverByAParabola) {
  for_each_theory([](const std::string& theory, const std::string& order) {
    const TracedDeck traced(cantilever(theory, order, "on = \"beam\"\ndistributed = [0.0, -1e-3]\n"));
    const std::vector<ShapePoint> points = shape_of(traced.model(), traced.last()).members.at(0).points;
    for (const ShapePoint& point : points) {
      const double left = 2.0 * (1.0 - point.fraction);
      EXPECT_NEAR(point.moment, -0.5e-3 * left * left, 1e-5 * 2e-3) << point.fraction;
      EXPECT_NEAR(point.axial_force, 0.0, 4e-2 * 2e-3);
    }
  });
}

TEST(Shape, ForcesJumpAtALoadOnly) {
  for_each_theory([](const std::string& theory, const std::string& order) {
    const TracedDeck traced(cantilever(theory, order, "at = \"beam:0.5\"\nforce = [0.2, 0.0]\nmoment = 0.05\n"));
    const std::vector<ShapePoint> points = shape_of(traced.model(), traced.last()).members.at(0).points;
    int twice = 0;
    for (std::size_t k = 1; k < points.size(); ++k)
      if (points[k].fraction == points[k - 1].fraction) {
        ++twice;
        EXPECT_DOUBLE_EQ(points[k].fraction, 0.5);
        EXPECT_NEAR(points[k].moment - points[k - 1].moment, -0.05, 1e-8);
      } else {
        EXPECT_NEAR(points[k].moment, points[k - 1].moment, 2e-3);
      }
    EXPECT_EQ(twice, 1);
    EXPECT_NEAR(points.back().moment, 0.0, 1e-8);
  });
}

// Two bars under a load at their apex, which carries 2 N sin of their slope, whatever the strain.
TEST(Shape, BarsCarryTheLoadAlongThemselves) {
  for (const std::string strain : {"green", "engineering", "log"}) {
    const TracedDeck traced(title("Two bars") + material("m", 1e3) + general_section("s", 1.0, 1.0) +
                                points({{"a", -1.0, 0.0}, {"b", 0.0, 1.0}, {"c", 1.0, 0.0}}) +
                                supports({{"a", "x z"}, {"c", "x z"}}) +
                                path("step = 0.1; stop = { lambda = [-1.0, 1.0] }") +
                                member("ab", "a", "b", "truss", 1, R"(strain = "STRAIN")") +
                                member("bc", "b", "c", "truss", 1, R"(strain = "STRAIN")") + force("b", 0.0, -60.0) +
                                monitor("down", "b", "z"),
                            {"member.ab.strain=\"" + strain + "\"", "member.bc.strain=\"" + strain + "\""});
    const Shape shape = shape_of(traced.model(), traced.last());
    ASSERT_EQ(shape.members.size(), 2u);
    for (const MemberShape& member : shape.members)
      for (const ShapePoint& point : member.points) {
        const Vec2 chord = member.points.back().position - member.points.front().position;
        EXPECT_NEAR(-2.0 * point.axial_force * std::abs(chord.y()) / chord.norm(), 60.0, 1e-8) << strain;
        EXPECT_NEAR(point.moment, 0.0, 1e-12);
      }
  }
}

TEST(Shape, NothingIsDisplacedOrStressedAtRest) {
  for (const ExampleDeck& example : example_decks()) {
    SCOPED_TRACE(std::string(example.name));
    const Model model(deck::read_deck_text(example.text, "deck.toml"));
    std::string reason;
    const State rest = model.start(reason).value();
    const double L = model.structure().length_scale();
    for (const MemberShape& member : shape_of(model, rest).members) {
      EXPECT_EQ(member.points.front().fraction, 0.0);
      EXPECT_EQ(member.points.back().fraction, 1.0);
      for (const ShapePoint& point : member.points) {
        EXPECT_LE(point.displacement.norm(), 1e-14 * L);
        EXPECT_NEAR(point.rotation, 0.0, 1e-13);
      }
    }
  }
}

// All that acts behind a section holds its moment: the wall's forces at their places and the end's, of which the
// support's part is what makes M vanish at the other end, a hinge. At the ends of a pressed part that slides the mesh
// leaves moments to the wall that fall with h² (docs/theory.md, section 8): 3.2e-4 of the greatest M here, measured.
TEST(Shape, MomentsAreThoseOfTheWallsForces) {
  const auto check = [](std::string_view deck, const std::string& points, const Vec2& load, double end_moment) {
    const TracedDeck traced(deck, {"contact.points=\"" + points + "\""});
    std::size_t most = 0;
    for (const RecordPoint& at : traced.record().points) {
      const Shape shape = shape_of(traced.model(), at.state);
      most = std::max(most, shape.contacts.size());
      const std::vector<ShapePoint>& beam = shape.members.at(0).points;
      const Vec2 end = beam.back().position;
      const auto moment = [&](const ShapePoint& point, double support) {
        double sum = at.lambda * end_moment + cross(end - point.position, at.lambda * load + Vec2(0.0, support));
        for (const ContactMark& mark : shape.contacts)
          if (mark.label.fraction > point.fraction) sum += cross(mark.position - point.position, mark.force);
        return sum;
      };
      const double without = moment(beam.front(), 0.0) - beam.front().moment;
      const double support = -without / (moment(beam.front(), 1.0) - moment(beam.front(), 0.0));
      double scale = 0.0, worst = 0.0;
      for (const ShapePoint& point : beam) {
        const auto here = [&](const ContactMark& mark) {
          return std::abs(mark.label.fraction - point.fraction) < 1e-9;
        };
        if (std::any_of(shape.contacts.begin(), shape.contacts.end(), here)) continue;  // before or behind it
        scale = std::max(scale, std::abs(point.moment));
        worst = std::max(worst, std::abs(point.moment - moment(point, support)));
      }
      const auto pressed = [](const ContactMark& mark) { return mark.pressure.has_value(); };
      const bool leaves_moments =
          points == "moving" && std::any_of(shape.contacts.begin(), shape.contacts.end(), pressed);
      EXPECT_LE(worst, (leaves_moments ? 4e-4 : 1e-7) * std::max(scale, 1e-6)) << points << ", lambda = " << at.lambda;
      if (::testing::Test::HasFailure()) return most;
    }
    return most;
  };
  for (const ExampleDeck& example : example_decks())
    for (const std::string points : {"nodes", "moving"}) {
      SCOPED_TRACE(std::string(example.name) + ", " + points);
      if (example.name == "channel") {
        EXPECT_GE(check(example.text, points, {-1.0, 0.0}, 0.0), 2u);
      }
      if (example.name == "cylinder") {
        EXPECT_GE(check(example.text, points, {0.0, 0.0}, 1.0), 3u);
      }
    }
}

TEST(Shape, WallsAreDrawnWhereTheStructureMayCome) {
  for (const ExampleDeck& example : example_decks()) {
    if (example.name != "cylinder") continue;
    const Model model(deck::read_deck_text(example.text, "deck.toml"));
    const std::vector<WallShape> walls = wall_shapes(model);
    ASSERT_EQ(walls.size(), 1u);
    EXPECT_EQ(walls[0].name, "cylinder");
    EXPECT_EQ(walls[0].side, Side::below);
    ASSERT_GE(walls[0].line.size(), 100u);
    for (const Vec2& point : walls[0].line) EXPECT_NEAR((point - Vec2(0.0, -20.55)).norm(), 20.0, 1e-12);
    EXPECT_LE(walls[0].line.front().x(), -10.0);
    EXPECT_GE(walls[0].line.back().x(), 10.0);
  }
}

}  // namespace arcwall::shape_test
