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

/// Decks with friction, and what is read off their runs.
namespace arcwall::friction_test {

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

inline const std::string bars = R"(
[material.m]
E = 210.0
[section.s]
shape = "general"
A = 1.0
I = 1.0
[support]
A = ["z"]
[[prescribed]]
at = "A"
x = 1.0
[[wall]]
name = "floor"
side = "below"
contact_surface = "axis"
profile = { type = "flat", z = 0.0 }
friction = 0.3
[[monitor]]
name = "F"
at = "A"
component = "reaction-x"
)";

inline std::string bar(const std::string& name, const std::string& from, const std::string& to) {
  return fmt::format(
      "[member.{}]\nfrom = \"{}\"\nto = \"{}\"\ntheory = \"truss\"\nstrain = \"engineering\"\n"
      "material = \"m\"\nsection = \"s\"\nelements = 1\n",
      name, from, to);
}

inline std::string weight(const std::string& at, double weight) {
  return fmt::format("[[load]]\nat = \"{}\"\nforce = [0.0, {}]\nconstant = true\n", at, -weight);
}

inline std::string stage(const std::string& name, const std::string& drives, double step, double low, double high) {
  return fmt::format("[[stage]]\nname = \"{}\"\ndrives = [\"{}\"]\nstep = {}\nstop = {{ lambda = [{}, {}] }}\n", name,
                     drives, step, low, high);
}

// A block of weight 1 on a spring of stiffness 21, dragged to and fro.
inline std::string block(double friction) {
  std::string text = bars + "[point]\nA = [0.0, 0.0]\nB = [10.0, 0.0]\n" + bar("bar", "A", "B") + weight("B", 1.0) +
                     stage("out", "prescribed.0", 0.005, -1.0, 0.05) +
                     stage("back", "prescribed.0", -0.005, -0.1, 1.0) +
                     stage("again", "prescribed.0", 0.005, -1.0, 0.1);
  text.replace(text.find("friction = 0.3"), 14, fmt::format("friction = {}", friction));
  return text;
}

// A node at the origin on springs k_x = 1, k_z = 10, on a rough incline of 40°, pressed down by λ from 0 to 1, then
// pulled by λ < 0 along x.
inline std::string incline(double friction) {
  const double angle = 40.0 * std::numbers::pi / 180.0;
  return fmt::format(R"(
[material.m]
E = 1e-9
[section.s]
shape = "general"
A = 1.0
I = 1.0
[point]
O = [0.0, 0.0]
far = [0.0, 1.0]
[support]
far = ["x", "z"]
[[spring]]
at = "O"
stiffness = {{ x = 1.0, z = 10.0 }}
[[load]]
at = "O"
force = [0.0, -1.0]
[[load]]
at = "O"
force = [1.0, 0.0]
[[wall]]
name = "slope"
members = ["bar"]
contact_surface = "axis"
outline = {{ type = "half-plane", point = [0.0, 0.0], normal = [{}, {}] }}
friction = {}
[[monitor]]
name = "x"
at = "O"
component = "x"
)",
                     -std::sin(angle), std::cos(angle), friction) +
         bar("bar", "O", "far") + stage("press", "load.0", 0.1, -1.0, 1.0) + stage("pull", "load.1", -0.02, -0.4, 1.0);
}

// A strip that a clamp at (0, sin 60°) points down to a floor, whose tip touches it at rest; the clamp goes down.
inline std::string strip(double friction, const std::string& stages, const std::string& drag = "") {
  return fmt::format(R"(
[material.m]
E = 10000.0
[section.s]
shape = "general"
A = 1.0
I = 1e-4
[point]
clamp = [0.0, 0.8660254037844386]
tip = [0.5, 0.0]
[member]
strip = {{ from = "clamp", to = "tip", theory = "elastica", material = "m", section = "s", elements = 20 }}
[support]
{}
[[prescribed]]
at = "clamp"
z = -1.0
[[wall]]
name = "floor"
side = "below"
contact_surface = "axis"
profile = {{ type = "flat", z = 0.0 }}
friction = {}
[[monitor]]
name = "x"
at = "tip"
component = "x"
[[monitor]]
name = "T"
wall = "floor"
component = "force-x"
[[monitor]]
name = "p"
wall = "floor"
component = "force-z"
)",
                     drag.empty() ? "clamp = [\"x\", \"rotation\"]" : "clamp = [\"rotation\"]", friction) +
         drag + stages;
}

// A pinned column, EI = 0.175 and EA = 210, under the load λ between rough walls at ±0.15. A deviation of 1e-9 makes it
// buckle upwards.
inline std::string column(double friction, const std::string& stages, const std::string& more = "") {
  return fmt::format(R"(
[material.m]
E = 210.0
[section.s]
shape = "general"
A = 1.0
I = 8.333333333333333e-4
[point]
left = [0.0, 0.0]
right = [2.0, 0.0]
[member.column]
from = "left"
to = "right"
theory = "elastica"
material = "m"
section = "s"
elements = 20
imperfection = [{{ shape = "sine", amplitude = 1e-9, waves = 1 }}]
[support]
left = ["x", "z"]
right = ["z"]
[contact]
points = "moving"
[[load]]
at = "right"
force = [-1.0, 0.0]
[[wall]]
name = "upper"
side = "above"
contact_surface = "axis"
profile = {{ type = "flat", z = 0.15 }}
friction = {0}
[[wall]]
name = "lower"
side = "below"
contact_surface = "axis"
profile = {{ type = "flat", z = -0.15 }}
friction = {0}
[[monitor]]
name = "shortening"
at = "right"
component = "x"
sign = -1
[[monitor]]
name = "p"
wall = "upper"
component = "force-z"
sign = -1
)",
                     friction) +
         more + stages;
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
