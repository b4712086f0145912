#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/beam_theories.hpp"
#include "tests/support/branch.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/models.hpp"

// Circular arches and rings of radius 1 and EI = 1 under a pressure p from outside that follows the axis. Where the
// axis does not stretch they stay circles under it and buckle at closed forms (M. Lévy 1884; Timoshenko and Gere:
// Theory of Elastic Stability, 1961, section 7.4): a ring at p = 3, an arch of half angle α that is pinned at (π/α)² −
// 1, one that is clamped at k² − 1 with k tan α cot kα = 1.
namespace arcwall::pressed_arches_test {

namespace {

enum class Ends { pinned, clamped, on_lines_of_symmetry };
enum class Load { pressure, dead_radial };

constexpr double hardly_stretching = 1e8;  // EA

// First branch point of an arch from π/2 + α to `to` on the circle, anticlockwise angles, drawn from left to right.
double first_branch_point(double from, double to, Ends ends, const test::BeamTheory& theory, int elements, double EA,
                          Load load = Load::pressure) {
  StructureBuilder builder;
  const auto on_circle = [](double angle) { return Vec2(std::cos(angle), std::sin(angle)); };
  const double places[] = {from, 0.5 * (from + to), to};
  for (const double angle : places) builder.add_joint(on_circle(angle));
  for (Index m = 0; m < 2; ++m) {
    const double a = places[m], b = places[m + 1];
    builder.add_member({.name = m == 0 ? "first" : "second",
                        .from = m,
                        .to = m + 1,
                        .axis = arc_axis(on_circle(a), on_circle(0.5 * (a + b)), on_circle(b)),
                        .theory = theory.theory,
                        .order = theory.order,
                        .section = test::section_of(EA, 1.0, EA),
                        .elements = elements / 2});
    if (load == Load::pressure) {
      builder.add_pressure(m, {.proportional = 1.0});
    } else {
      builder.add_distributed_load(m, {0.0, -1.0}, LoadKind::proportional, LoadFrame::member);
    }
  }
  const bool symmetric = ends == Ends::on_lines_of_symmetry;
  for (const Index end : {0, 2}) {
    if (!symmetric || end == 0) builder.fix(builder.dof(end, Dof::x));
    if (!symmetric || end == 2) builder.fix(builder.dof(end, Dof::z));
    if (ends != Ends::pinned) builder.fix(builder.shared_rotation(end).value());
  }
  const auto structure = builder.build();
  TraceOptions options;
  options.step.first = 0.1;
  options.stay = true;
  options.target_values.push_back(test::stop_at_lambda(10.0));
  const test::Branch branch = test::trace(*structure, options);
  const auto found = events_of(branch, EventKind::branch_point);
  return found.empty() ? 0.0 : found.front().state.lambda;
}

double half_circle(Ends ends, const test::BeamTheory& theory, int elements, double EA = hardly_stretching) {
  return first_branch_point(pi, 0.0, ends, theory, elements, EA);
}

const test::BeamTheory elastica{.name = "elastica", .theory = Theory::elastica, .order = 6};
const test::BeamTheory classic{.name = "classic", .theory = Theory::euler_bernoulli};
const test::BeamTheory exact{.name = "exact", .theory = Theory::reissner, .order = 2};

}  // namespace

// A quarter of it; its ends move along lines of symmetry, so that pressure does work on them.
TEST(PressedRing, BucklesAtThreeTimesItsBendingStiffness) {
  EXPECT_NEAR(first_branch_point(0.5 * pi, 0.0, Ends::on_lines_of_symmetry, elastica, 24, hardly_stretching), 3.0,
              2e-5);
  EXPECT_NEAR(first_branch_point(0.5 * pi, 0.0, Ends::on_lines_of_symmetry, classic, 24, hardly_stretching), 3.0, 2e-5);
}

TEST(PressedArch, BucklesAtTheClosedFormsOfAnAxisThatDoesNotStretch) {
  EXPECT_NEAR(half_circle(Ends::pinned, elastica, 48), 3.0, 2e-5);
  EXPECT_NEAR(half_circle(Ends::clamped, elastica, 48), 8.0, 1e-3);
  const double a = pi / 3.0;
  EXPECT_NEAR(first_branch_point(0.5 * pi + a, 0.5 * pi - a, Ends::pinned, elastica, 48, hardly_stretching), 8.0, 1e-4);
}

// With EA R²/EI = 10⁴ the arch flattens before it buckles. Reference: multiple shooting of the elastica.
TEST(PressedArch, ThatStretchesBucklesWithOrderFour) {
  constexpr double reference = 3.00127583475769;
  for (const test::BeamTheory& theory : {elastica, classic}) {
    SCOPED_TRACE(theory.name);
    std::vector<double> found;
    for (const int elements : {12, 24, 48}) found.push_back(half_circle(Ends::pinned, theory, elements, 1e4));
    test::expect_convergence(found, {.exact = reference, .order = 4.0});
  }
}

TEST(PressedArch, OfReissnersBeamsBucklesAlike) { EXPECT_NEAR(half_circle(Ends::pinned, exact, 48), 3.0, 1e-4); }

// Loads that stay radial as they were buckle a ring at 4 (Bresse's 3 belongs to pressure; Singer and Babcock 1970) and
// a pinned half circle at 3.271245 (the smallest root of its boundary value problem, by shooting).
TEST(DeadRadialLoad, BucklesARingAndAnArchLaterThanPressureSlow) {
  for (const test::BeamTheory& theory : {elastica, classic}) {
    SCOPED_TRACE(theory.name);
    std::vector<double> found;
    for (const int elements : {4, 8, 16})
      found.push_back(first_branch_point(0.5 * pi, 0.0, Ends::on_lines_of_symmetry, theory, elements, hardly_stretching,
                                         Load::dead_radial));
    test::expect_convergence(found, {.exact = 4.0, .order = 4.0});
  }
  EXPECT_NEAR(first_branch_point(pi, 0.0, Ends::pinned, elastica, 48, hardly_stretching, Load::dead_radial), 3.271245,
              2e-5);
  EXPECT_NEAR(first_branch_point(pi, 0.0, Ends::pinned, exact, 48, hardly_stretching, Load::dead_radial), 3.271245,
              1e-4);
}

}  // namespace arcwall::pressed_arches_test
