// Buckling loads of straight slender structures, whose axial stiffness is up to 10¹⁰ times the load: the loads do not
// depend on the step, nor on walls that nothing touches. Closed forms and characteristic equations of linear stability
// theory (Timoshenko and Gere, Theory of Elastic Stability, sections 2.1 to 2.4 and 2.14); the elastica that stretches
// has P (1 − P/EA) in place of P.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "core/root_find.hpp"
#include "core/types.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::slender_structures_test {

using namespace test::tables;
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// A straight structure that λ presses, without steps, bounds and walls.
struct Structure {
  std::string name, deck;
  double euler = 0.0;        // P (1 − c P/EA)
  double accuracy = 0.0;     // relative, of its elements
  double flexibility = 1.0;  // c: 1 − EA/GA where it shears
  double least_EA = 1e4;     // from which on the formula is as accurate
  double height = 0.0;       // of the structure above z = 0
  double elements = 0.0;     // of a column whose nodes stand at such heights
};

void PrintTo(const Structure& structure, std::ostream* out) { *out << structure.name; }

// Beside the structure.
std::string flat_walls(double height, double distance) {
  return fmt::format(R"toml(
wall = [{{ name = "up", side = "above", contact_surface = "axis", profile = {{ type = "flat", z = {} }} }},
        {{ name = "low", side = "below", contact_surface = "axis", profile = {{ type = "flat", z = {} }} }}]
)toml",
                     height + distance, -distance);
}

// EI = 1 and L = 1.
Structure column(const std::string& name, const std::string& supports, double euler, const std::string& theory,
                 int elements, double accuracy) {
  return {.name = name + " " + theory,
          .deck = fmt::format(R"toml(
point = {{ a = [0.0, 0.0], b = [1.0, 0.0] }}
support = {{ {} }}
member.c = {{ from = "a", to = "b", theory = "{}", material = "m", section = "s", elements = {} }}
load = [{{ at = "b", force = [-1.0, 0.0] }}]
)toml",
                              supports, theory, elements),
          .euler = euler,
          .accuracy = accuracy};
}

// Two sections, of which the upper one has a quarter of the inertia: tan(k₁/2)/k₁ + tan(k₂/2)/k₂ = 0, k₂ = 2 k₁.
Structure stepped_column() {
  // With u = k₁/2: tan u + tan(2u)/2 = 0, so tan² u = 2.
  const double u = std::atan(std::sqrt(2.0));
  return {.name = "stepped column",
          .deck = R"toml(
point = { a = [0.0, 0.0], m = [0.5, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "z"], b = ["z"] }
section.thin = { shape = "general", A = {A}, I = 0.25 }
member.low = { from = "a", to = "m", theory = "elastica", material = "m", section = "s", elements = 12 }
member.high = { from = "m", to = "b", theory = "elastica", material = "m", section = "thin", elements = 12 }
load = [{ at = "b", force = [-1.0, 0.0] }]
)toml",
          .euler = 4.0 * u * u,
          .accuracy = 1e-6};
}

// Pinned feet, a beam of the columns' length and stiffness: it sways at k tan k = 6.
Structure portal() {
  const auto f = [](double k) { return std::optional(k * std::sin(k) - 6.0 * std::cos(k)); };
  const double k = bracketed_root(f, 1.0, *f(1.0), 1.5, *f(1.5), 1e-15)->at;
  return {.name = "portal",
          .deck = R"toml(
point = { a = [0.0, 0.0], b = [0.0, 1.0], c = [1.0, 1.0], d = [1.0, 0.0] }
support = { a = ["x", "z"], d = ["x", "z"] }
member.left = { from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = 10 }
member.beam = { from = "b", to = "c", theory = "elastica", material = "m", section = "s", elements = 10 }
member.right = { from = "c", to = "d", theory = "elastica", material = "m", section = "s", elements = 10 }
load = [{ at = "b", force = [0.0, -1.0] }, { at = "c", force = [0.0, -1.0] }]
)toml",
          .euler = k * k,
          .accuracy = 1e-6,
          .least_EA = 1e8,
          .height = 1.0,
          .elements = 10.0};
}

std::vector<Structure> structures() {
  Structure exact = column("pinned", R"(a = ["x", "z"], b = ["z"])", pi * pi, "reissner", 24, 1e-5);
  exact.flexibility = 1.0 - 2.0 * (1.0 + 0.25) * 6.0 / 5.0;
  const double pinned_clamped = 20.190728556426629;  // tan k = k
  const std::string pinned = R"(a = ["x", "z"], b = ["z"])",
                    clamped = R"(a = ["x", "z", "rotation"], b = ["z", "rotation"])",
                    propped = R"(a = ["x", "z", "rotation"], b = ["z"])", free = R"(a = ["x", "z", "rotation"])";
  return {column("pinned", pinned, pi * pi, "elastica", 16, 1e-6),
          column("pinned", pinned, pi * pi, "euler-bernoulli", 64, 1e-5),
          exact,
          column("clamped", clamped, 4.0 * pi * pi, "elastica", 24, 1e-6),
          column("clamped", clamped, 4.0 * pi * pi, "euler-bernoulli", 64, 1e-5),
          column("propped", propped, pinned_clamped, "elastica", 24, 1e-6),
          column("cantilever", free, 0.25 * pi * pi, "elastica", 12, 1e-6),
          stepped_column(),
          portal()};
}

std::vector<double> branch_points(const std::string& text) {
  Session session = make_session({.deck = "slender.toml", .deck_text = text});
  while (session.next() != nullptr) {
  }
  std::vector<double> found;
  for (const RecordEvent& event : session.events())
    if (event.kind == EventKind::branch_point) found.push_back(event.lambda);
  return found;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what)) text.replace(at, what.size(), by);
  return text;
}

}  // namespace

class SlenderStructure : public testing::TestWithParam<Structure> {};

TEST_P(SlenderStructure, BucklesAtItsLoadWhateverItsSlendernessStepAndWallsSlow) {
  const Structure& structure = GetParam();
  for (const double EA : {1e4, 1e6, 1e8, 1e10}) {
    if (EA < structure.least_EA) continue;
    for (const double step : {0.01, 0.2, 0.37})
      for (const double distance : {infinity, 0.01, 1e3}) {
        const double c = structure.flexibility / EA;
        const double load = 2.0 * structure.euler / (1.0 + std::sqrt(1.0 - 4.0 * c * structure.euler));
        const std::string walls = distance < infinity ? flat_walls(structure.height, distance) : "";
        SCOPED_TRACE(fmt::format("EA {:g}, step {} P, walls at a distance of {}", EA, step, distance));
        const auto found = branch_points(fmt::format(R"toml(
title = "slender"
path = {{ step = {}, branches = "primary", stop = {{ lambda = [-1.0, {}] }} }}
material.m = {{ E = 1.0, nu = 0.25 }}
section.s = {{ shape = "general", A = {}, I = 1.0 }}
)toml",
                                                     step * load, 1.02 * load, EA) +
                                         replaced(structure.deck, "{A}", fmt::format("{}", EA)) + walls);
        ASSERT_EQ(found.size(), 1U);
        // A mesh on which contact slides stores positions: ε of the height in one of them is a force of ε EA n.
        const double stored = walls.empty() ? 0.0 : epsilon * EA * structure.elements / load;
        EXPECT_NEAR(found[0] / load, 1.0, structure.accuracy + 4.0 * stored);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SlenderStructure, testing::ValuesIn(structures()));

// EA L²/EI of 3e20: several eigenvalues are zero to the last digit beside contacts that slide, and the path ends early.
// It ends in a sentence all the same: modes of such a place have all unknowns, the places of the contacts among them.
TEST(SlenderStructures, EndsWhereNothingButRoundOffIsLeft) {
  Session run = make_session(
      {.deck = "deck.toml",
       .deck_text = title("a column of 5e8 in a channel") + material("steel", 21000.0) + rectangle("square", 0.1, 0.1) +
                    points({{"left", 0.0, 0.0}, {"right", 540343167.201976, 0.0}}) +
                    supports({{"left", "x z"}, {"right", "z"}}) + force("right", -1.0, 0.0) + channel(0.2) +
                    path("step = 0.05; jumps = false; stop = { lambda = [-1.0, 9.0] }") +
                    member("column", "left", "right", "euler-bernoulli", 4, imperfection({{1, 0.002}, {3, 3e-4}}),
                           "steel", "square")});
  ASSERT_TRUE(run.begin()) << run.problem();
  while (run.next() != nullptr) {
  }
  EXPECT_NE(run.record().branches.back().end->reason, EndReason::stop);
  EXPECT_FALSE(run.record().branches.back().end->detail.empty());
}

}  // namespace arcwall::slender_structures_test
