// Where the edge of a part that is pressed on a spline comes to a point of it, at which the rate of the wall's
// curvature jumps: the beam would need a force EI J there, and where that pulls an arch opens (section 8.4 of
// docs/theory.md).
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/model/traced_session.hpp"

namespace arcwall::spline_points_test {
namespace {

struct Column {
  int elements = 40;
  std::string theory = "euler-bernoulli";
  bool mirrored = false;  // in the x-axis
  bool reversed = false;  // the member runs from the right end to the left one
};

std::string number(double value) { return std::to_string(value); }

// Clamped at its left end, uneven, and pressed on the cubics of a floor. The part that lies right of a point at x =
// 0.85 grows to the left and shrinks again. Across the axis all is so small (slopes are below 0.004) that the linear
// theory of beam columns holds to some 1e-5.
std::string deck(const Column& column) {
  const double up = column.mirrored ? -1.0 : 1.0, left = column.reversed ? -up : up;
  std::string z;
  for (const double height : {-0.0033, -0.00344, -0.004, -0.00317, -0.00321, -0.00322, -0.0039, -0.00417})
    z += (z.empty() ? "" : ", ") + number(up * height);
  const auto side = [&](bool below) { return std::string(below != column.mirrored ? "below" : "above"); };
  return "title = \"a column on a spline\"\n"
         "material.m = { E = 2.1e7, nu = 0.3 }\n"
         "section.s = { shape = \"rectangle\", width = 0.023, height = 0.0005 }\n"
         "point = { left = [0.0, 0.0], right = [1.4, 0.0] }\n"
         "support = { left = [\"x\", \"z\", \"rotation\"], right = [\"z\"] }\n"
         "member.column = { " +
         std::string(column.reversed ? "from = \"right\", to = \"left\"" : "from = \"left\", to = \"right\"") +
         ", theory = \"" + column.theory +
         "\", material = \"m\", section = \"s\", elements = " + std::to_string(column.elements) +
         ", imperfection = [{ shape = \"sine\", waves = 1, amplitude = " + number(-0.000106 * left) +
         " }, { shape = \"sine\", waves = 3, amplitude = " + number(0.000012 * left) +
         " }] }\n"
         "load = [{ at = \"right\", force = [-5.6e-5, 0.0] }]\n"
         "wall = [{ name = \"floor\", side = \"" +
         side(true) +
         "\", profile = { type = \"spline\", x = [-0.35, -0.05, 0.25, 0.55, 0.85, 1.15, 1.45, 1.75], z = [" + z +
         "] } }, { name = \"ceiling\", side = \"" + side(false) +
         "\", profile = { type = \"line\", z = " + number(0.00294 * up) + ", slope = " + number(0.00029 * up) +
         " } }]\n"
         "path = { step = 0.05, stop = { lambda = [-1.0, 5.4] } }\n";
}

// Left of the point the column is a beam column of its own, which is clamped at one end and at the other lies with its
// slope and its curvature on the parallel of the floor's face at x = 0.85. With q² = P/EI and the imperfection w₀ its
// deflection is w = A sin qx + B cos qx + C x + D + Σ a_n α_n²/(α_n² − q²) sin α_n x, α_n = nπ/L; the three conditions
// at the point and two at the clamp give A to D and P = 5.6e-5 λ. Solved by bisection apart from this program.
constexpr double opens = 3.297300, closes = 4.671278;

// The floor's third derivative jumps there by −0.2015311, where its second one is 0.0104099.
constexpr double jump = 0.2015311, curvature = 0.0104099, EI = 2.1e7 * 0.023 * 0.0005 * 0.0005 * 0.0005 / 12.0;

}  // namespace

// It used to open later, by 0.35 % of λ on every mesh, and two limit points were told before that.
TEST(SplinePoints, APartOpensAndClosesWhereItsEdgeComesToOneSlow) {
  for (const Column& column : std::vector<Column>{{},
                                                  {.elements = 29},
                                                  {.theory = "elastica"},
                                                  {.elements = 56, .mirrored = true},
                                                  {.elements = 56, .reversed = true},
                                                  {.theory = "elastica", .mirrored = true, .reversed = true}}) {
    SCOPED_TRACE(deck(column));
    const Session run = test::traced(deck(column));
    EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
    std::vector<EventKind> kinds;
    for (const RecordEvent& event : run.events()) kinds.push_back(event.kind);
    const std::vector<EventKind> expected{EventKind::start, EventKind::contact_closes, EventKind::contact_spreads,
                                          EventKind::contact_splits, EventKind::contact_shrinks};
    ASSERT_GE(kinds.size(), expected.size());
    kinds.resize(expected.size());
    EXPECT_EQ(kinds, expected);
    const RecordEvent& opening = test::event_of(run.record(), EventKind::contact_splits);
    const RecordEvent& closing = test::event_of(run.record(), EventKind::contacts_merge);
    EXPECT_NEAR(opening.lambda, opens, 6e-5 * opens);
    EXPECT_NEAR(closing.lambda, closes, 6e-5 * closes);
    ASSERT_EQ(opening.contacts.size(), 1U);
    EXPECT_NEAR(opening.contacts[0].x, 0.85, 1e-5);
    ASSERT_EQ(closing.contacts.size(), 1U);
    EXPECT_NEAR(closing.contacts[0].x, 0.85, 1e-5);
  }
}

TEST(SplinePoints, PartsOpenAndCloseWithTheOrderOfTheElements) {
  std::vector<double> opening, closing;
  for (const int elements : {20, 40, 80}) {
    const Session run = test::traced(deck({.elements = elements}));
    opening.push_back(test::event_of(run.record(), EventKind::contact_splits).lambda);
    closing.push_back(test::event_of(run.record(), EventKind::contacts_merge).lambda);
  }
  for (const std::vector<double>& lambda : {opening, closing}) {
    const double order = std::log2((lambda[0] - lambda[1]) / (lambda[1] - lambda[2]));
    EXPECT_NEAR(order, 4.0, 0.3);
  }
}

// Over the pressure p̄ = P κ − EI w₀⁗ that the floor would press with there, an arch of length d has its point δ beyond
// the spline's: p̄ d³ = 12 EI J δ² (1 − δ/d), and as the arch is longer the pressure along it is another, by d/L.
TEST(SplinePoints, AnArchIsAsLongAsWhatPullsAndWhatPressesSay) {
  const Session run = test::traced(deck({.elements = 80}), {"path.stop.lambda=[-1.0, 3.305]"});
  const double lambda = test::event_of(run.record(), EventKind::contact_splits).lambda;
  int seen = 0;
  for (const RecordPoint& point : run.points()) {
    if (!(point.lambda > lambda) || point.forces.size() != 3) continue;
    double uneven = 0.0;  // w₀⁗
    for (const auto& [waves, amplitude] : {std::pair(1.0, -0.000106), std::pair(3.0, 0.000012)})
      uneven += amplitude * std::pow(waves * pi / 1.4, 4) * std::sin(waves * pi * 0.85 / 1.4);
    const double pressure = 5.6e-5 * point.lambda * curvature - EI * uneven;
    const double d = point.forces[1].x - point.forces[0].x, beyond = 0.85 - point.forces[0].x;
    EXPECT_NEAR(pressure * d * d * d / (12.0 * EI * jump * beyond * beyond * (1.0 - beyond / d)), 1.0, 8.0 * d / 1.4);
    ++seen;
  }
  EXPECT_GE(seen, 10);
}

}  // namespace arcwall::spline_points_test
