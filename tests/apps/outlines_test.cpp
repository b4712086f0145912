// Runs of decks whose walls are outlines in the plane. What is expected comes from closed forms, from boundary value
// problems solved by shooting (see deck_answers_test.cpp), or from the same structure turned in the plane, whose
// answers must be the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "model/event_names.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::outlines_test {

namespace {

std::vector<double> lambdas_of(const test::TracedDeck& traced, EventKind kind) {
  std::vector<double> found;
  for (const RecordEvent& event : traced.record().events)
    if (event.kind == kind) found.push_back(event.lambda);
  return found;
}

// A clamped strip (EI = L = 1, EA = 1e5) under a dead load across at its end, in a plane turned by an angle.
struct Strip {
  double angle = 0.0;
  bool reversed = false;  // it runs from the free end to the clamp
  std::string theory = "elastica";
  double to = 0.5;  // the greatest λ

  std::string point(double x, double z) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return fmt::format("[{:.17g}, {:.17g}]", c * x - s * z, s * x + c * z);
  }
  std::string deck(const std::string& outline, const std::string& more = "") const {
    return fmt::format(R"toml(
title = "A strip"
material.m = {{ E = 1.0 }}
section.s = {{ shape = "general", A = 1e5, I = 1.0, height = 0.04 }}
point = {{ A = [0.0, 0.0], B = {} }}
member.strip = {{ from = "{}", to = "{}", theory = "{}", material = "m", section = "s", elements = 40 }}
support = {{ A = ["x", "z", "rotation"] }}
load = [{{ at = "B", force = {} }}]
wall = [{{ name = "wall", outline = {{ {} }}, {} }}]
monitor = [{{ name = "x", at = "B", component = "x" }}, {{ name = "z", at = "B", component = "z" }}]
path = {{ step = 0.02, output_at = {{ lambda = [0.4162012388637268] }}, stop = {{ lambda = [-0.1, {}] }} }}
)toml",
                       point(1.0, 0.0), reversed ? "B" : "A", reversed ? "A" : "B", theory, point(0.0, -1.0), outline,
                       more.empty() ? "contact_surface = \"axis\"" : more, to);
  }

  // By how far the end has moved across, at the value that is landed on.
  double sag(const test::TracedDeck& traced) const {
    for (const RecordPoint& at : traced.record().points)
      if (std::abs(at.state.lambda - 0.4162012388637268) < 1e-12)
        return std::cos(angle) * at.monitors[1] - std::sin(angle) * at.monitors[0];
    ADD_FAILURE() << "not landed";
    return 0.0;
  }
};

std::vector<Strip> turned_strips() {
  std::vector<Strip> all;
  for (const double angle : {0.0, 0.6, 0.5 * pi, 2.2, pi, -1.9})
    for (const bool reversed : {false, true}) all.push_back({.angle = angle, .reversed = reversed});
  return all;
}

}  // namespace

// Shooting: touch at 0.2081006194318634; at twice that the end is at -0.07814581171568506.
TEST(Outlines, APegIsTouchedFromAnySideSlow) {
  for (const Strip& strip : turned_strips()) {
    SCOPED_TRACE(fmt::format("turned by {}{}", strip.angle, strip.reversed ? ", reversed" : ""));
    const test::TracedDeck traced(strip.deck("type = \"circle\", radius = 0.02, centre = " + strip.point(0.6, -0.05)));
    const std::vector<double> touches = lambdas_of(traced, EventKind::contact_closes);
    ASSERT_EQ(touches.size(), 1u);
    EXPECT_NEAR(touches[0], 0.2081006194318634, 1e-8);
    EXPECT_NEAR(strip.sag(traced), -0.07814581171568506, 1e-8);
    test::expect_whole(traced);
  }
}

// A peg of radius 0.02 about the same centre, touched by the axis, is one of radius 0.005 touched by faces 0.015 off
// it, or an ellipse or a curve of the same shape; and the sharp corner of a wedge touched by faces 0.02 off the axis.
TEST(Outlines, TheSamePegIsOneOfManyShapes) {
  const Strip strip{};
  const auto touch_and_sag = [&](const std::string& outline, const std::string& more) {
    const test::TracedDeck traced(strip.deck(outline, more));
    test::expect_whole(traced);
    const std::vector<double> touches = lambdas_of(traced, EventKind::contact_closes);
    EXPECT_EQ(touches.size(), 1u);
    EXPECT_NEAR(touches.at(0), 0.2081006194318634, 1e-8) << outline;
    EXPECT_NEAR(strip.sag(traced), -0.07814581171568506, 1e-8) << outline;
  };
  const std::string axis = "contact_surface = \"axis\"", face = "contact_surface = \"face\"";
  touch_and_sag("type = \"ellipse\", centre = [0.6, -0.05], axes = [0.02, 0.02], angle = 0.3", axis);
  touch_and_sag("type = \"polyline\", x = [0.5, 0.6, 0.7], z = [-1.05, -0.05, -1.05]", face);
  touch_and_sag(
      "type = \"polyline\", x = [0.5, 0.6, 0.7], z = [-0.1217157287525381, -0.0217157287525381, -0.1217157287525381]",
      axis + ", corner_radius = 0.02");
}

// A step that would end on the other side of the peg is cut back, and so is one in which the end of the strip would
// jump over a narrow ramp that comes along: it is met where it is as high as the end, at a way of 0.3.
TEST(Outlines, NothingIsJumpedOver) {
  const Strip strip{};
  const auto with_long_steps = [](std::string deck) {
    deck.replace(deck.find("step = 0.02"), 11, "step = 2.0, max_step = 3.0");
    return deck;
  };
  const test::TracedDeck peg(with_long_steps(strip.deck("type = \"circle\", radius = 0.02, centre = [0.6, -0.05]")));
  ASSERT_EQ(lambdas_of(peg, EventKind::contact_closes).size(), 1u);
  EXPECT_NEAR(lambdas_of(peg, EventKind::contact_closes)[0], 0.2081006194318634, 1e-8);
  const test::TracedDeck ramp(R"toml(
title = "A ramp that runs under the end of a strip"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e5, I = 1.0 }
point = { A = [0.0, 0.0], B = [1.0, 0.0], T = [1.0, -0.2] }
member.arm = { from = "A", to = "B", theory = "elastica", material = "m", section = "s", elements = 10 }
member.hook = { from = "B", to = "T", theory = "elastica", material = "m", section = "s", elements = 2 }
support = { A = ["x", "z", "rotation"] }
wall = [{ name = "ramp", contact_surface = "axis", corner_radius = 0.01, motion = { x = -1.0 }, outline = { type = "polyline", x = [1.2, 1.4, 1.6], z = [-0.3, -0.1, -0.3] } }]
monitor = [{ name = "push", wall = "ramp", component = "force-x" }]
path = { step = 1.0, max_step = 3.0, stop = { lambda = [-0.1, 0.45] } }
)toml");
  ASSERT_GE(lambdas_of(ramp, EventKind::contact_closes).size(), 1u);
  EXPECT_NEAR(lambdas_of(ramp, EventKind::contact_closes)[0], 0.3, 1e-8);
}

// The end comes down on a floor 0.1 below it; every other way round it does so at the same loads, and lies down
// likewise.
TEST(Outlines, AFloorMayStandUprightSlow) {
  std::vector<std::vector<double>> found;
  for (Strip strip : turned_strips()) {
    SCOPED_TRACE(fmt::format("turned by {}", strip.angle));
    strip.to = 4.0;
    const test::TracedDeck traced(
        strip.deck("type = \"half-plane\", point = " + strip.point(0.3, -0.1) + ", normal = " + strip.point(0.0, 2.0)));
    test::expect_whole(traced);
    std::vector<double> lambdas;
    for (const RecordEvent& event : traced.record().events) lambdas.push_back(event.lambda);
    found.push_back(lambdas);
    ASSERT_EQ(lambdas.size(), found.front().size());
    for (std::size_t i = 0; i < lambdas.size(); ++i) EXPECT_NEAR(lambdas[i], found.front()[i], 1e-8);
  }
}

// A moment at its right end bends a beam against a rounded corner above it. The contact leaves the arc at λ = 1.1536
// and slides along the line behind it, where the path has a kink of 0.8 rad. Reference: extensible elastica shot from B
// with an 8th-order method (1e-12) for the place and angle at a contact on the line, and at the clamp.
TEST(Outlines, AContactSlidesOffARoundedCorner) {
  const test::TracedDeck traced(R"toml(
title = "A beam on a rounded corner"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e5, I = 1.0 }
point = { A = [0.0, 0.0], B = [1.0, 0.0] }
support = { A = ["x", "z", "rotation"], B = ["z"] }
member.beam = { from = "A", to = "B", theory = "elastica", elements = 16, material = "m", section = "s" }
load = [{ at = "B", moment = -1.0 }]
wall = [{ name = "corner", contact_surface = "axis", corner_radius = 0.05, outline = { type = "polyline", x = [1.3, 0.45, -0.2], z = [0.098, 0.03, 0.16] } }]
monitor = [{ name = "turn", at = "B", component = "rotation" }]
path = { step = 0.1, stop = { lambda = [-1.0, 3.0] } }
)toml");
  const RecordPoint& last = traced.record().points.back();
  EXPECT_EQ(last.lambda, 3.0);
  EXPECT_NEAR(last.monitors[0], -0.5043694046905773, 1e-9);
  ASSERT_EQ(last.forces.size(), 1u);
  EXPECT_NEAR(last.forces[0].label.fraction, 0.635523134815197, 1e-8);
  EXPECT_NEAR(last.forces[0].force, 7.04046966599791, 1e-7);
  test::expect_whole(traced);
}

// A beam that a load presses up to the corner of a roof is drawn off it by another. The place where it is nearest
// slides along the corner's arc until that goes over into a line, from which the beam turns away: there is no such
// place behind it. What follows is the beam's without a roof.
TEST(Outlines, APointThatHasLeftARoundedCornerIsGivenUpAtItsEnd) {
  const auto drawn_off = [](const std::string& wall) {
    return test::TracedDeck(R"toml(
title = "Drawn off a rounded corner"
material.m = { E = 100.0 }
section.s = { shape = "general", A = 40000.0, I = 1.0, height = 0.75 }
point = { A = [0.0, 0.0], B = [25.0, 0.0] }
support = { A = ["x", "z", "rotation"], B = ["z"] }
member.c = { from = "A", to = "B", theory = "elastica", elements = 16, material = "m", section = "s" }
load = [{ at = "c:0.4375", force = [0.0, -0.75] }, { at = "c:0.4375", force = [0.0, 1.2], constant = true }]
path = { step = 0.03, stop = { lambda = [-0.5, 3.0] } }
monitor = [{ name = "z", at = "c:0.4375", component = "z" }]
)toml" + wall);
  };
  const test::TracedDeck roofed = drawn_off(
      "wall = [{ name = \"roof\", corner_radius = 1.25, outline = { type = \"polyline\", x = [32.6, 15.6, -7.5], "
      "z = [1.17, 0.75, 2.87] } }]");
  EXPECT_EQ(test::events_of(roofed, EventKind::contact_opens).size(), 1u);
  const RecordPoint& last = roofed.record().points.back();
  EXPECT_EQ(last.lambda, 3.0);
  EXPECT_NEAR(last.monitors[0], drawn_off("").record().points.back().monitors[0], 1e-9);
  test::expect_whole(roofed);
}

// A beam is pressed up to the rounded corner of a roof, and to a flank of it beside the corner: one element has both.
// Its gap opens from the corner on, and closes again before the next node. References: shot from end to end with an
// 8th-order method (1e-12), extensible elastica of EA L²/EI = 1e5, tangent to the arc and to the flank.
TEST(Outlines, AFlankIsTouchedBesideItsCorner) {
  for (const int elements : {20, 40}) {
    SCOPED_TRACE(elements);
    const test::TracedDeck traced(fmt::format(R"toml(
title = "A corner and its flank"
material.m = {{ E = 1.0 }}
section.s = {{ shape = "general", A = 1e5, I = 1.0, height = 0.02 }}
point = {{ a = [0.0, 0.0], b = [1.0, 0.0] }}
support = {{ a = ["x", "z"], b = ["z"] }}
member.c = {{ from = "a", to = "b", theory = "elastica", elements = {}, material = "m", section = "s" }}
load = [{{ at = "c:0.65", force = [0.0, 1.0] }}, {{ at = "b", moment = -0.159 }}]
wall = [{{ name = "roof", corner_radius = 0.1, outline = {{ type = "polyline", x = [1.5, 0.5868302681222064, -0.5], z = [0.059694341712240626, 0.02, 0.21139200880436135] }} }}]
path = {{ step = 0.1, stop = {{ lambda = [-0.5, 6.0] }} }}
)toml",
                                              elements));
    const RecordEvent& touches = test::event_of(traced, EventKind::contact_closes, 2);
    const double error = elements == 20 ? 1e-5 : 1e-8;
    EXPECT_NEAR(touches.lambda, 5.254083423357, error);
    ASSERT_EQ(touches.contacts.size(), 1u);
    EXPECT_NEAR(touches.contacts[0].label.fraction, 0.6254357201, error);
    test::expect_whole(traced);
  }
}

// A beam of a frame is pressed up to a roof, on one side of the roof's rounded corner and at the corner. The arch
// between vanishes, and the edge of the pressed part goes back along the roof: from then on it does not matter where
// the corner is.
TEST(Outlines, APartJoinsThePointAtARoundedCorner) {
  const auto beside = [](const std::string& corner) {
    return test::TracedDeck(R"toml(
title = "A part beside a rounded corner"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1.76e5, I = 1.0, height = 0.465 }
point = { a = [0.0, 0.0], e = [0.0, 12.7], f = [15.5, 12.7], b = [15.5, 0.0] }
support = { a = ["x", "z", "rotation"], b = ["x", "z"] }
member.c = { from = "a", to = "e", theory = "euler-bernoulli", material = "m", section = "s", elements = 16 }
member.d = { from = "e", to = "f", theory = "euler-bernoulli", material = "m", section = "s", elements = 16 }
member.g = { from = "f", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 16 }
load = [{ at = "e", moment = 0.1386 }, { on = "d", distributed = [0.0, 0.003818], constant = true }, { at = "d:0.125", force = [0.0, 0.02842], constant = true }]
path = { step = 0.1, stop = { lambda = [-0.5, 3.0] } }
monitor = [{ name = "z", at = "d:0.125", component = "z" }]
wall = [{ name = "roof", corner_radius = 0.8, outline = { type = "polyline", )toml" +
                            corner + " } }]\n");
  };
  const test::TracedDeck near = beside("x = [20.0, 6.2, -4.6], z = [14.85, 13.2, 13.65]");
  const test::TracedDeck far = beside("x = [20.0, 7.0, -4.6], z = [15.2, 13.166666666666666, 13.65]");
  const auto gathers = EventKind::contact_shrinks;
  EXPECT_LT(test::event_of(far, EventKind::contacts_merge).lambda,
            test::event_of(near, EventKind::contacts_merge).lambda);
  EXPECT_NEAR(test::event_of(near, gathers).lambda, test::event_of(far, gathers).lambda, 1e-10);
  EXPECT_EQ(near.record().points.back().lambda, 3.0);
  EXPECT_NEAR(near.record().points.back().monitors[0], far.record().points.back().monitors[0], 1e-10);
  test::expect_whole(near);
}

// A uniform load q across a clamped strip brings its tip to a ceiling c above it, lays it down, and lays the strip on
// the ceiling from there, whatever the direction of the whole. In small slopes, with EI = L = 1: q = 8 c, 72 c, and
// from then on a⁴ = 72 c/q for the length a that is free.
TEST(Outlines, AStripIsLaidOnASlopingCeilingAsOnALevelOne) {
  constexpr double c = 1e-3;
  for (const double angle : {0.0, 0.003, 0.3}) {
    SCOPED_TRACE(angle);
    const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
    const test::TracedDeck traced(fmt::format(R"toml(
title = "A strip laid on a ceiling"
material.m = {{ E = 1.0 }}
section.s = {{ shape = "general", A = 1e6, I = 1.0 }}
point = {{ a = [0.0, 0.0], b = [{:.17g}, {:.17g}] }}
support = {{ a = ["x", "z", "rotation"] }}
member.c = {{ from = "a", to = "b", theory = "elastica", elements = 16, material = "m", section = "s" }}
load = [{{ on = "c", distributed = [{:.17g}, {:.17g}] }}]
wall = [{{ name = "ceiling", contact_surface = "axis", outline = {{ type = "half-plane", point = [{:.17g}, {:.17g}], normal = [{:.17g}, {:.17g}] }} }}]
path = {{ step = 0.2, stop = {{ lambda = [-1.0, 27.0] }} }}
)toml",
                                              along.x(), along.y(), 8.0 * c * across.x(), 8.0 * c * across.y(),
                                              c * across.x(), c * across.y(), -across.x(), -across.y()));
    const std::vector<double> touches = lambdas_of(traced, EventKind::contact_closes);
    const std::vector<double> spreads = lambdas_of(traced, EventKind::contact_spreads);
    ASSERT_EQ(touches.size(), 1u);
    ASSERT_EQ(spreads.size(), 1u);
    EXPECT_NEAR(touches[0], 1.0, 1e-5);
    EXPECT_NEAR(spreads[0], 9.0, 1e-4);
    const std::vector<RecordPoint>& points = traced.record().points;
    EXPECT_LT(points.size(), 60u);
    ASSERT_FALSE(points.back().forces.empty());
    EXPECT_NEAR(points.back().forces[0].label.fraction, std::pow(1.0 / 3.0, 0.25), 1e-5);
    test::expect_whole(traced);
  }
}

// The least gap of this curve runs to the end of the strip: a point that follows it is given up L/1000 from there, and
// is not inserted and given up at the same place again and again.
TEST(Outlines, APointThatIsGivenUpAtATipIsNotInsertedAgain) {
  const Strip strip{.to = 3.0};
  const test::TracedDeck traced(
      strip.deck("type = \"curve\", x = [-0.5, 0.0, 0.45, 0.95, 1.5], z = [-0.3, -0.2, -0.1, -0.15, -0.3]"));
  EXPECT_LT(traced.record().points.size(), 100u);
}

namespace {

std::string problem_of(const std::string& deck) {
  try {
    test::TracedDeck traced(deck);
  } catch (const InputError& error) {
    std::string all;
    for (const Diagnostic& diagnostic : error.diagnostics()) all += to_text(diagnostic) + "\n";
    return all;
  }
  return "none";
}

}  // namespace

TEST(Outlines, WhatTheyCannotDoIsSaid) {
  const Strip strip{};
  const std::string faces = "contact_surface = \"face\"";
  EXPECT_NE(
      problem_of(strip.deck("type = \"circle\", centre = [0.5, 0.0], radius = 0.02, structure = \"inside\"", faces))
          .find("does not fit into it"),
      std::string::npos);
  EXPECT_NE(problem_of(strip.deck("type = \"polyline\", x = [0.5, 0.6, 0.7], z = [-1.0, -0.2, -1.0]"))
                .find("the corners of the outline are sharp"),
            std::string::npos);
  EXPECT_NE(problem_of(strip.deck("type = \"circle\", centre = [0.6125, 0.001], radius = 0.005"))
                .find("is inside the wall at the start: at strip:0.6125, between nodes, by 0.004"),
            std::string::npos);
  EXPECT_NE(problem_of(strip.deck("type = \"circle\", centre = [0.6, -0.05], radius = 0.2"))
                .find("member \"strip\" is inside the wall at the start: node strip:0.6 by 0.15; move the wall, "
                      "or give it an interference"),
            std::string::npos);
}

// A floor that is shorter than the strip, drawn from right to left, and others whose free side is the other one.
TEST(Outlines, AStripOnTheOtherSideIsToldHowToChangeIt) {
  const Strip strip{};
  const auto says = [&](const std::string& outline, const std::string& cure) {
    EXPECT_NE(problem_of(strip.deck(outline)).find(cure + " if the other side is meant. Else move the wall"),
              std::string::npos)
        << problem_of(strip.deck(outline));
  };
  says(
      "type = \"polyline\", x = [0.8, 0.2], z = [-0.1, -0.1]",
      "the structure lies to the left of the outline, on the way from its first point to its last: reverse the points");
  says("type = \"curve\", x = [0.8, 0.5, 0.2], z = [-0.1, -0.11, -0.1]", "reverse the points");
  says("type = \"half-plane\", point = [0.0, -0.1], normal = [0.0, -1.0]",
       "the structure lies on the side of `normal`: turn that round");
  says("type = \"circle\", centre = [0.5, 0.0], radius = 5.0",
       "the structure lies on the side of `structure`: change that");
}

// A strip that bends around a peg comes with its end under it. The upper arc of a circle alone has no face below, where
// the strip would be inside: the run ends there and says so, with contact that slides and at nodes. Nothing is in the
// way of the same strip around the whole circle.
TEST(Outlines, AnEndThatComesUnderAnArcIsNamedAndGoesOnBelowACircle) {
  const auto bent = [](const std::string& wall, const std::string& contact) {
    return test::TracedDeck(fmt::format(R"toml(
title = "a strip that a moment bends around a peg"
material.steel = {{ E = 2.1e4 }}
section.s = {{ shape = "rectangle", width = 0.06780454806702974, height = 0.01257320420341675 }}
point = {{ clamp = [0.0, 0.0], tip = [1.8764310217021987, 0.0] }}
support = {{ clamp = ["x", "z", "rotation"] }}
load = [{{ at = "tip", moment = -6.284520997532813e-05 }}]
path = {{ step = 0.1, jumps = false, stop = {{ lambda = [-1.0, 6.9] }} }}
member.strip = {{ from = "clamp", to = "tip", theory = "elastica", material = "steel", section = "s", elements = 30 }}
wall = [{{ name = "peg", {} = {{ type = "circle", centre = [0.9158244608564969, -0.3736809701065393], radius = 0.086608979312623 }} }}]
{}
)toml",
                                        wall, contact));
  };
  for (const std::string contact : {"", "contact.points = \"nodes\""}) {
    SCOPED_TRACE(contact);
    const test::TracedDeck above = bent("side = \"below\", profile", contact);
    const BranchEnd& end = above.record().branches.back().end.value();
    EXPECT_EQ(end.reason, EndReason::wall_end);
    EXPECT_NE(end.detail.find("a closed outline has one all around"), std::string::npos);
    EXPECT_NEAR(above.record().points.back().lambda, contact.empty() ? 6.22404 : 6.08707, 1e-4);
  }
  test::expect_whole(bent("outline", ""));
}

// The same where a bend of the member comes under the arc first, between its nodes: the last points were 0.02 inside.
TEST(Outlines, ABendThatComesUnderAnArcIsNamed) {
  const auto frame = [](const std::string& wall) {
    return test::TracedDeck(fmt::format(R"toml(
title = "an L frame with a stop under its beam"
material.steel = {{ E = 2.1e4 }}
section.s = {{ shape = "rectangle", width = 0.5658144514342969, height = 0.0716386204570734 }}
point = {{ foot = [0.0, 0.0], corner = [0.0, 4.101117927065021], end = [4.341436281473455, 4.101117927065021] }}
support = {{ foot = ["x", "z", "rotation"], end = ["x", "z", "rotation"] }}
load = [{{ at = "beam:0.041666666666666664", force = [0.0, -0.38629301870089927] }}]
path = {{ step = 0.05, jumps = false, stop = {{ lambda = [-1.0, 3.55] }} }}
member.column = {{ from = "foot", to = "corner", theory = "euler-bernoulli", material = "steel", section = "s", elements = 24 }}
member.beam = {{ from = "corner", to = "end", theory = "euler-bernoulli", material = "steel", section = "s", elements = 48 }}
wall = [{{ name = "stop", members = ["beam"], {} = {{ type = "circle", centre = [3.319576553721003, 3.3335537581040793], radius = 0.3569767408623584 }} }}]
)toml",
                                        wall));
  };
  const test::TracedDeck above = frame("side = \"below\", profile");
  EXPECT_EQ(above.record().branches.back().end->reason, EndReason::wall_end);
  test::expect_verified(above);
}

}  // namespace arcwall::outlines_test
