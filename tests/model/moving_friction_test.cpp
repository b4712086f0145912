#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "tests/model/friction_decks.hpp"
#include "tests/support/deck_tables.hpp"

// Friction at contact points that move along members. References by shooting with steps of order 8, checked by
// collocation.
namespace arcwall::friction_test {

using namespace test::tables;

namespace {

// Half of a beam, EI = 1 and EA = 1e4, over a round prop of radius 0.2 at 1 from its centre, which goes down by λ.
std::string bent_beam(double friction, const std::string& stages, int elements = 30) {
  return material("m", 10000.0) + general_section("s", 1.0, 1e-4) + points({{"centre", 0.0, 0.0}, {"end", 1.5, 0.0}}) +
         member("beam", "centre", "end", "elastica", elements) + supports({{"centre", "x rotation"}}) +
         prescribed("centre", "z = -1.0") + moving_contact +
         wall(
             "prop",
             fmt::format(
                 R"(contact_surface = "axis"; outline = {{ type = "circle", centre = [1.0, -0.2], radius = 0.2 }}; friction = {})",
                 friction)) +
         monitor("P", "centre", "reaction-z") + stages;
}

const std::string in_and_back = stage("in", "prescribed.0", 0.001, -1.0, 0.6) +
                                stage("back", "prescribed.0", -0.001, -0.5, 1.0) +
                                "[path]\noutput_at = { lambda = [0.1, 0.2, 0.3, 0.4, 0.5, -0.1, -0.2, -0.3, -0.4] }\n";

}  // namespace

// The beam rolls over the prop, then slips inwards; on the way back it rolls, then slips outwards.
TEST(MovingFriction, BeamOverRoundProps) {
  const Session session = run_of(bent_beam(0.3, in_and_back));
  EXPECT_EQ(reason(session), EndReason::stop);
  expect_law(session);
  const auto in = lambdas(session, EventKind::contact_slips, 0), back = lambdas(session, EventKind::contact_slips, 1);
  ASSERT_EQ(in.size(), 1U);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_NEAR(in.front(), 1.49969388e-4, 1e-9);  // own shooting, eight anchors on the roll
  EXPECT_NEAR(0.6 + back.front(), 0.596692575, 1e-8);
  // Twice the force at the centre.
  const std::vector<double> force_in{0.648673676650, 1.331371955603, 1.945562121396, 2.405206656104, 2.665522828421},
      force_back{0.603002120971, 1.145358119487, 1.535480323667, 1.717023127801, 1.684448030222};
  for (std::size_t i = 0; i < 5; ++i) {
    const double lambda = 0.1 * double(i + 1);
    EXPECT_NEAR(2.0 * std::abs(point_at(session, 0, lambda).monitors[0]), force_in[i], 1e-6);
    EXPECT_NEAR(2.0 * std::abs(point_at(session, 1, lambda - 0.6).monitors[0]), force_back[i], 1e-6);
  }
  EXPECT_NEAR(lost_until(point_at(session, 0, 0.6)) - lost_until(point_at(session, 0, 0.1)), 0.5 * 0.13847353620889,
              1e-6);
  EXPECT_NEAR(lost_until(point_at(session, 1, -0.5)) - lost_until(point_at(session, 1, -0.1)), 0.5 * 0.09257615591439,
              1e-6);
}

// On faces, at half the height 0.01732 from the axis, friction has a lever: the beam slips outwards, rolls, then slips
// inwards.
TEST(MovingFriction, BeamOverPropsOnItsFace) {
  const double height = std::sqrt(12e-4);
  std::string text = bent_beam(0.3, stage("in", "prescribed.0", 0.001, -1.0, 0.1));
  const auto replace = [&](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("shape = \"general\"\nA = 1.0\nI = 0.0001",
          fmt::format("shape = \"rectangle\"\nwidth = {:.17g}\nheight = {:.17g}", 1.0 / height, height));
  replace("contact_surface = \"axis\"\noutline = { type = \"circle\", centre = [1.0, -0.2], radius = 0.2 }",
          fmt::format("side = \"below\"\nprofile = {{ type = \"circle\", centre = [1.0, {:.17g}], radius = 0.2 }}",
                      -0.2 - 0.5 * height));
  const Session session = run_of(text);
  expect_law(session);
  const auto sticks = lambdas(session, EventKind::contact_sticks, 0),
             slips = lambdas(session, EventKind::contact_slips, 0);
  ASSERT_EQ(sticks.size(), 1U);
  ASSERT_EQ(slips.size(), 1U);
  EXPECT_NEAR(sticks.front(), 0.0215743381828, 1e-9);
  EXPECT_NEAR(slips.front(), 0.0250239350, 2e-7);  // of second order in L/2000
  EXPECT_EQ(session.points()[2].forces.front().friction->mode, ContactMode::slips_forward);
  EXPECT_TRUE(slips_back(session.points().back()));
}

// What touches slips at once: a touch that rolls would need T = 3.6 p. It spreads where the bending moment at the
// contact vanishes.
TEST(MovingFriction, ColumnSlipsUntilItsContactSpreads) {
  const std::vector<std::pair<double, double>> spreads{
      {0.05, 1.739660111834}, {0.1, 1.753185122457}, {0.2, 1.780749199922}};
  for (const auto& [friction, lambda] : spreads) {
    const Session session = run_of(column(friction, stage("on", "load.0", 0.05, -1.0, 2.0)));
    const auto found = lambdas(session, EventKind::contact_spreads, 0);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found.front(), lambda, 1e-6);
    const RecordForce& contact = point_at(session, 0, found.front()).forces.front();
    EXPECT_EQ(contact.friction->mode, ContactMode::slips_forward);  // along the tangent, which runs to the left
    EXPECT_NEAR(contact.friction->force, -friction * contact.force, 1e-12);
    expect_law(session);
  }
}

TEST(MovingFriction, ColumnRollsBackBeforeItSlips) {
  const std::string text =
      column(0.2, stage("on", "load.0", 0.05, -1.0, 1.2) + stage("back", "load.0", -0.02, -0.9, 5.0));
  const Session session = run_of(text);
  expect_law(session);
  const auto touches = lambdas(session, EventKind::contact_closes, 0),
             slips = lambdas(session, EventKind::contact_slips, 1),
             opens = lambdas(session, EventKind::contact_opens, 1);
  ASSERT_EQ(touches.size(), 1U);
  ASSERT_EQ(slips.size(), 1U);
  ASSERT_EQ(opens.size(), 1U);
  EXPECT_NEAR(touches.front(), 0.435739888353, 1e-7);
  EXPECT_NEAR(1.2 + slips.front(), 1.06971182, 1e-7);
  EXPECT_NEAR(1.2 + opens.front(), 0.435739888353, 1e-7);
  EXPECT_NEAR(point_at(session, 0, 1.2).monitors[1], 0.288600247292, 1e-7);
  EXPECT_NEAR(point_at(session, 0, 1.2).monitors[0], 0.041721272133, 1e-7);
  for (const std::size_t killed : {std::size_t{12}, session.points().size() / 2, session.points().size() - 6})
    expect_resumed(text, session, killed);
}

TEST(MovingFriction, StepsAndMethodsDoNotChangeTheEvents) {
  const std::string text = bent_beam(0.3, in_and_back);
  const auto changes = [](const std::string& deck) {
    const Session session = run_of(deck);
    auto found = lambdas(session, EventKind::contact_slips, 0);
    for (const double lambda : lambdas(session, EventKind::contact_slips, 1)) found.push_back(lambda);
    return found;
  };
  const std::vector<double> expected = changes(text);
  ASSERT_EQ(expected.size(), 2U);
  for (const char* const options :
       {"max_step = 0.05", "max_step = 0.01", "method = \"riks\"", "method = \"normal-plane\""}) {
    const std::vector<double> found = changes(text + options + "\n");
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0], expected[0], 1e-10);
    EXPECT_NEAR(found[1], expected[1], 1e-8);
  }
}

// A ring between plates needs no friction: where N = 0 a contact rolls, and nothing changes its shape. Its weak
// springs, 1e-5 of its stiffness, are all that friction bears. Both contacts spread together.
TEST(MovingFriction, RingRollsBetweenRoughPlates) {
  const std::vector<double> forces{0.625382563985, 1.174293567876, 1.666264845603};
  for (const double sideways : {0.0, 0.5}) {
    const Session session = run_of(
        material("m", 1e5) + general_section("s", 1.0, 1e-5) + points({{"west", -1.0, 0.0}, {"east", 1.0, 0.0}}) +
        member("under", "west", "east", "elastica", 20, "via = [0.0, -1.0]") +
        member("over", "east", "west", "elastica", 20, "via = [0.0, 1.0]") + moving_contact +
        flat_wall("floor", "below", -1.0, rough(0.3)) +
        flat_wall(
            "plate", "above", 1.0,
            fmt::format(R"(contact_surface = "axis"; motion = {{ x = {}, z = -1.0 }}; friction = 0.3)", sideways)) +
        wall_monitor("F", "plate", "force-z", flipped) +
        path(
            R"(step = 0.01; branches = "primary"; stop = { lambda = [-1.0, 0.6] }; output_at = { lambda = [0.1, 0.2, 0.3] })"));
    const auto spreads = lambdas(session, EventKind::contact_spreads, 0);
    EXPECT_NEAR(spreads.empty() ? session.points().back().lambda : spreads.front(), 0.564473204895, 1e-6);
    EXPECT_TRUE(lambdas(session, EventKind::contact_slips, 0).empty());
    for (std::size_t i = 0; i < 3; ++i) {
      const RecordPoint& point = point_at(session, 0, 0.1 * double(i + 1));
      EXPECT_NEAR(point.monitors[0], forces[i], 3e-6);
      ASSERT_EQ(point.forces.size(), 2U);
      for (const RecordForce& contact : point.forces) {
        EXPECT_EQ(contact.friction->mode, ContactMode::sticks);
        EXPECT_LE(std::abs(contact.friction->force), 1e-5 * contact.force);
      }
    }
  }
}

// Where a face lies on a rough wall the path ends with a reason; and no place but an end has a slip of its own.
TEST(MovingFriction, WhatIsNotModelledIsRefused) {
  const std::string bad =
      column(0.2, "[[monitor]]\nname = \"slip\"\nwall = \"upper\"\nat = \"column:0.5\"\ncomponent = \"slip\"\n");
  EXPECT_THROW(session_of(bad), InputError);
  std::string faces = column(0.2, stage("on", "load.0", 0.05, -1.0, 3.0));
  for (const std::string surface = "contact_surface = \"axis\"\n"; faces.find(surface) != std::string::npos;)
    faces.erase(faces.find(surface), surface.size());
  const std::string shape = "shape = \"general\"\nA = 1.0\nI = 0.0008333333333333333";
  faces.replace(faces.find(shape), shape.size(), "shape = \"rectangle\"\nwidth = 10.0\nheight = 0.1");
  const Session ended = run_of(faces);
  EXPECT_EQ(reason(ended), EndReason::not_modelled);
  EXPECT_NE(ended.record().branches.back().end->detail.find("with its face"), std::string::npos);
}

}  // namespace arcwall::friction_test
