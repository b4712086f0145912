#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "tests/support/deck_tables.hpp"

/// Decks with friction, and what is read off their runs.
namespace arcwall::friction_test {

using namespace test::tables;

inline Session session_of(const std::string& text) {
  return make_session({.deck = "friction.toml", .deck_text = "title = \"Friction\"\n" + text});
}

inline Session run_of(const std::string& text) {
  Session session = session_of(text);
  while (session.next() != nullptr) {
  }
  EXPECT_EQ(session.problem(), "");
  return session;
}

inline std::vector<double> lambdas(const Session& session, EventKind kind, Index branch) {
  std::vector<double> found;
  for (const RecordEvent& event : session.events())
    if (event.kind == kind && event.branch == branch) found.push_back(event.lambda);
  return found;
}

inline EndReason reason(const Session& session) { return session.record().branches.back().end->reason; }

inline double monitor_at_end(const Session& session, std::size_t which) {
  return session.points().back().monitors[which];
}

inline void expect_law(const Session& session) {
  for (const RecordPoint& point : session.points())
    for (const RecordForce& contact : point.forces)
      if (contact.friction) {
        EXPECT_LE(std::abs(contact.friction->force),
                  contact.friction->coefficient * contact.force * (1.0 + 1e-9) + 1e-12);
      }
}

// Whether a contact slips against the wall's tangent.
inline bool slips_back(const RecordPoint& point) {
  return std::any_of(point.forces.begin(), point.forces.end(), [](const RecordForce& contact) {
    return contact.friction && contact.friction->mode == ContactMode::slips_backward;
  });
}

inline const std::string bars = material("m", 210.0) + general_section("s", 1.0, 1.0) + supports({{"A", "z"}}) +
                                prescribed("A", "x = 1.0") + flat_wall("floor", "below", 0.0, rough(0.3)) +
                                monitor("F", "A", "reaction-x");

inline std::string weight(const std::string& at, double weight) { return force(at, 0.0, -weight, constant); }

// A block of weight 1 on a spring of stiffness 21.
inline const std::string block_on_spring =
    bars + "[point]\nA = [0.0, 0.0]\nB = [10.0, 0.0]\n" + bar("bar", "A", "B") + weight("B", 1.0);

// Dragged to and fro.
inline std::string block(double friction) {
  std::string text = block_on_spring + stage("out", "prescribed.0", 0.005, -1.0, 0.05) +
                     stage("back", "prescribed.0", -0.005, -0.1, 1.0) +
                     stage("again", "prescribed.0", 0.005, -1.0, 0.1);
  text.replace(text.find("friction = 0.3"), 14, fmt::format("friction = {}", friction));
  return text;
}

// A node at the origin on springs k_x = 1, k_z = 10, on a rough incline of 40°, pressed down by λ from 0 to 1, then
// pulled by λ < 0 along x.
inline std::string incline(double friction) {
  const double angle = 40.0 * std::numbers::pi / 180.0;
  return material("m", 1e-9) + general_section("s", 1.0, 1.0) + points({{"O", 0.0, 0.0}, {"far", 0.0, 1.0}}) +
         supports({{"far", "x z"}}) + table("[[spring]]", R"(at = "O"; stiffness = { x = 1.0, z = 10.0 })") +
         force("O", 0.0, -1.0) + force("O", 1.0, 0.0) +
         wall(
             "slope",
             fmt::format(
                 R"(members = ["bar"]; contact_surface = "axis"; outline = {{ type = "half-plane", point = [0.0, 0.0], normal = [{}, {}] }}; friction = {})",
                 -std::sin(angle), std::cos(angle), friction)) +
         monitor("x", "O", "x") + bar("bar", "O", "far") + stage("press", "load.0", 0.1, -1.0, 1.0) +
         stage("pull", "load.1", -0.02, -0.4, 1.0);
}

// A strip that a clamp at (0, sin 60°) points down to a floor, whose tip touches it at rest; the clamp goes down.
inline std::string strip(double friction, const std::string& stages, const std::string& drag = "") {
  return material("m", 10000.0) + general_section("s", 1.0, 1e-4) +
         points({{"clamp", 0.0, 0.8660254037844386}, {"tip", 0.5, 0.0}}) +
         member("strip", "clamp", "tip", "elastica", 20) +
         supports({{"clamp", drag.empty() ? "x rotation" : "rotation"}}) + prescribed("clamp", "z = -1.0") +
         flat_wall("floor", "below", 0.0, rough(friction)) + monitor("x", "tip", "x") +
         wall_monitor("T", "floor", "force-x") + wall_monitor("p", "floor", "force-z") + drag + stages;
}

// A pinned column, EI = 0.175 and EA = 210, under the load λ between rough walls at ±0.15. A deviation of 1e-9 makes it
// buckle upwards.
inline std::string column(double friction, const std::string& stages, const std::string& more = "") {
  return material("m", 210.0) + general_section("s", 1.0, 8.333333333333333e-4) +
         points({{"left", 0.0, 0.0}, {"right", 2.0, 0.0}}) +
         member("column", "left", "right", "elastica", 20, imperfection({{1, 1e-9}})) +
         supports({{"left", "x z"}, {"right", "z"}}) + moving_contact + force("right", -1.0, 0.0) +
         channel(0.15, rough(friction)) + monitor("shortening", "right", "x", flipped) +
         wall_monitor("p", "upper", "force-z", flipped) + more + stages;
}

inline double lost_until(const RecordPoint& point) {
  return std::accumulate(point.dissipation.begin(), point.dissipation.end(), 0.0);
}

// Of a stage, where λ has a value.
inline const RecordPoint& point_at(const Session& session, Index stage, double lambda) {
  const RecordPoint* nearest = nullptr;
  for (const RecordPoint& point : session.points())
    if (session.record().stage_number(point.branch) == stage &&
        (nearest == nullptr || std::abs(point.lambda - lambda) < std::abs(nearest->lambda - lambda)))
      nearest = &point;
  return *nearest;
}

/// A run that is killed after so many points and taken up again is the whole run to the last bit.
inline void expect_resumed(const std::string& text, const Session& whole, std::size_t killed) {
  Session first = session_of(text);
  while (first.points().size() < killed) ASSERT_NE(first.next(), nullptr);
  Session rest = resume_session(first.checkpoint(), "checkpoint", Session::Resume::go_on);
  while (rest.next() != nullptr) {
  }
  ASSERT_EQ(rest.points().size(), whole.points().size());
  for (std::size_t i = 0; i < whole.points().size(); ++i) {
    EXPECT_EQ(rest.points()[i].lambda, whole.points()[i].lambda);
    EXPECT_EQ(rest.points()[i].state.x, whole.points()[i].state.x);
    EXPECT_EQ(rest.points()[i].dissipation, whole.points()[i].dissipation);
    EXPECT_EQ(rest.points()[i].monitors, whole.points()[i].monitors);
  }
  EXPECT_EQ(rest.events().size(), whole.events().size());
}

}  // namespace arcwall::friction_test
