#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/functions.hpp"
#include "tests/support/invariants.hpp"

// Several singular points in one step, and such as touch: modes beside a path of one unknown, whose stiffnesses are
// quadratics with chosen zeros (tests/support/toys.hpp).
namespace arcwall::singular_points_test {

namespace {

using test::Branch;
using test::Quadratic;
using test::SmoothToy;

constexpr double steps[] = {0.25, 1.0, 4.0};

TraceOptions until(double lambda, double step) {
  TraceOptions options;
  options.step.first *= step;
  options.step.max *= step;
  options.target_values = {test::stop_at_lambda(lambda), test::stop_at_lambda(-2.0)};
  return options;
}

// x = λ from 0 to 1, with these modes beside.
Branch along_line(const std::vector<Quadratic>& modes, double step) {
  const SmoothToy system = test::modes_beside(test::spring(1.0), modes);
  const TraceOptions options = until(1.0, step);
  const Branch branch = test::trace(system, options, test::state_beside(system, 0.0, 0.0));
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  test::expect_branch_invariants(system, branch, options);
  return branch;
}

std::vector<Event> without_ends(const Branch& branch) {
  std::vector<Event> events;
  for (const Event& event : test::events_of(branch))
    if (event.kind != EventKind::start) events.push_back(event);
  return events;
}

struct Expected {
  EventKind kind;
  double lambda;
  Index before, after;
};

void expect_events(const Branch& branch, const std::vector<Expected>& expected, double tolerance = 1e-10) {
  const auto found = without_ends(branch);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(found[i].kind, expected[i].kind);
    EXPECT_NEAR(found[i].state.lambda, expected[i].lambda, tolerance);
    EXPECT_EQ(found[i].unstable_before, expected[i].before);
    EXPECT_EQ(found[i].unstable_after, expected[i].after);
    EXPECT_FALSE(found[i].unconfirmed);
  }
}

constexpr EventKind branch_point = EventKind::branch_point, limit_point = EventKind::limit_point;

}  // namespace

TEST(ClosePairs, TwoModesThatBecomeUnstableOneJustBehindTheOther) {
  for (const double step : steps)
    for (const double d : {1e-1, 1e-3, 1e-5, 1e-7}) {
      SCOPED_TRACE(testing::Message() << "steps × " << step << ", distance " << d);
      const Branch branch = along_line({{.at = 0.5, .b = -1.0}, {.at = 0.5 + d, .b = -3.0}}, step);
      expect_events(branch, {{branch_point, 0.5, 0, 1}, {branch_point, 0.5 + d, 1, 2}});
    }
}

TEST(ClosePairs, OneModeBecomesStableAsAnotherBecomesUnstable) {
  for (const double step : steps)
    for (const double d : {1e-1, 1e-3, 1e-5, 1e-7}) {
      SCOPED_TRACE(testing::Message() << "steps × " << step << ", distance " << d);
      expect_events(along_line({{.at = 0.5, .b = -1.0}, {.at = 0.5 + d, .b = 2.0}}, step),
                    {{branch_point, 0.5, 1, 2}, {branch_point, 0.5 + d, 2, 1}});
      expect_events(along_line({{.at = 0.5 + d, .b = -1.0}, {.at = 0.5, .b = 2.0}}, step),
                    {{branch_point, 0.5, 1, 0}, {branch_point, 0.5 + d, 0, 1}});
    }
}

// The stiffness (x − 0.5)(x − 0.5 − d) is −d²/4 in between.
TEST(ClosePairs, OneModeBecomesUnstableAndStableAgain) {
  for (const double step : steps)
    for (const double d : {1e-1, 1e-3, 1e-5}) {
      SCOPED_TRACE(testing::Message() << "steps × " << step << ", distance " << d);
      expect_events(along_line({{.at = 0.5, .b = -d, .c = 1.0}}, step),
                    {{branch_point, 0.5, 0, 1}, {branch_point, 0.5 + d, 1, 0}});
    }
}

// λ = −x² has its limit point at 0; the mode's stiffness passes zero at x = ±√d, before or behind.
TEST(ClosePairs, ALimitPointAndABranchPointInOneStep) {
  for (const double step : steps)
    for (const double d : {1e-3, 1e-5, 1e-7})
      for (const double side : {1.0, -1.0}) {
        SCOPED_TRACE(testing::Message() << "steps × " << step << ", distance " << side * d);
        const SmoothToy system = test::modes_beside(test::fold(), {{.at = side * std::sqrt(d), .b = 1.0}});
        const TraceOptions options = until(1.0, step);
        const Branch branch = test::trace(system, options, test::state_beside(system, 1.0, -1.0));
        EXPECT_EQ(branch.end.reason, EndReason::stop);
        test::expect_branch_invariants(system, branch, options);
        if (side > 0.0)
          expect_events(branch, {{branch_point, -d, 0, 1}, {limit_point, 0.0, 1, 2}});
        else
          expect_events(branch, {{limit_point, 0.0, 0, 1}, {branch_point, -d, 1, 2}});
      }
}

// A truss of two bars of Green's strain, half-span 1, rise 2, whose apex at the height z is held sideways by a spring:
// λ = (h² − z²) z in units of EA/L³, with its maximum at z_l = h/√3; sideways stiffness 2 b² + z² − h² + k, so that k
// decides at which z the truss sways.
TEST(ClosePairs, ATrussThatSwaysJustBeforeItsLimitLoadOrJustBehindIt) {
  constexpr double h = 2.0, b = 1.0;
  const double at_limit = h / std::sqrt(3.0);
  const auto load = [&](double z) { return (h * h - z * z) * z; };
  for (const double step : steps)
    for (const double d : {1e-3, 1e-5, 1e-7})
      for (const double side : {1.0, -1.0}) {
        SCOPED_TRACE(testing::Message() << "steps × " << step << ", distance " << side * d);
        // λ ≈ λ_l − 3 z_l (z − z_l)²
        const double z_sway = at_limit + side * std::sqrt(d * load(at_limit) / (3.0 * at_limit));
        const SmoothToy truss = test::swaying_truss(h, b, h * h - 2.0 * b * b - z_sway * z_sway);
        TraceOptions options;
        options.step.first *= step;
        options.step.max *= step;
        options.target_values = {test::stop_at_lambda(-1.0)};
        const Branch branch = test::trace(truss, options, {.x = Vector::Zero(2), .lambda = 0.0});
        test::expect_branch_invariants(truss, branch, options);
        const Expected sway{branch_point, load(z_sway), side > 0.0 ? 0 : 1, side > 0.0 ? 1 : 2};
        const Expected limit{limit_point, load(at_limit), side > 0.0 ? 1 : 0, side > 0.0 ? 2 : 1};
        auto found = without_ends(branch);
        ASSERT_GE(found.size(), 2U);
        EXPECT_EQ(found[0].kind, side > 0.0 ? branch_point : limit_point);
        for (std::size_t i = 0; i < 2; ++i) {
          const Expected& expected = (i == 0) == (side > 0.0) ? sway : limit;
          EXPECT_EQ(found[i].kind, expected.kind);
          EXPECT_NEAR(found[i].state.lambda, expected.lambda, 1e-10);
          EXPECT_EQ(found[i].unstable_before, expected.before);
          EXPECT_EQ(found[i].unstable_after, expected.after);
        }
      }
}

TEST(ClosePairs, ALimitPointAtWhichAModeBecomesStable) {
  for (const double side : {1.0, -1.0}) {
    SCOPED_TRACE(side);
    const SmoothToy system = test::modes_beside(test::fold(), {{.at = side * 1e-3, .b = -1.0}});
    const Branch branch = test::trace(system, until(1.0, 1.0), test::state_beside(system, 1.0, -1.0));
    if (side > 0.0)
      expect_events(branch, {{branch_point, -1e-6, 1, 0}, {limit_point, 0.0, 0, 1}});
    else
      expect_events(branch, {{limit_point, 0.0, 1, 2}, {branch_point, -1e-6, 2, 1}});
  }
}

// A hilltop branch point.
TEST(ClosePairs, ABranchPointOnALimitPointIsReportedWithIt) {
  for (const double step : steps) {
    SCOPED_TRACE(step);
    const SmoothToy system = test::modes_beside(test::fold(), {{.at = 0.0, .b = 1.0}});
    const Branch branch = test::trace(system, until(1.0, step), test::state_beside(system, 1.0, -1.0));
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    expect_events(branch, {{branch_point, 0.0, 0, 2}, {limit_point, 0.0, 0, 2}});
    const Event fork = only_event(branch, branch_point);
    EXPECT_NEAR(std::abs(fork.branching->mode.dx.normalized().dot(test::mixing(2).col(1))), 1.0, 1e-6);
  }
}

TEST(DoublePoints, AreRecognisedByTheRankOfTheNullSpace) {
  for (const double step : steps) {
    SCOPED_TRACE(step);
    const Branch branch = along_line({{.at = 0.5, .b = -1.0}, {.at = 0.5, .b = -3.0}, {.at = -4.0, .a = 1.0}}, step);
    expect_events(branch, {{branch_point, 0.5, 0, 2}});
    EXPECT_EQ(only_event(branch, branch_point).branching->multiplicity, 2);
    const Branch crossing = along_line({{.at = 0.5, .b = -1.0}, {.at = 0.5, .b = 3.0}}, step);
    expect_events(crossing, {{branch_point, 0.5, 1, 1}});
    EXPECT_EQ(only_event(crossing, branch_point).branching->multiplicity, 2);
  }
}

// A rigid upright bar of length 1 on a ball with two equal springs (Augusti 1964), turned by θ₁ and θ₂, its head at
// D = √(1 − sin² θ₁ − sin² θ₂) above the ball: V = ½ (θ₁² + θ₂²) + λ D. It may fall in any direction from λ = 1 on.
TEST(DoublePoints, AColumnThatMayBuckleInTwoPlanes) {
  SmoothToy column;
  column.unknowns = 2;
  const auto height = [](const Vector& x) { return std::sqrt(1.0 - x.array().sin().square().sum()); };
  column.potential = [=](const Vector& x, double lambda) { return 0.5 * x.squaredNorm() + lambda * height(x); };
  column.F_lambda = [=](const Vector& x, double) { return Vector(-0.5 * (2.0 * x.array()).sin() / height(x)); };
  column.F = [=](const Vector& x, double lambda) { return Vector(x + lambda * column.F_lambda(x, lambda)); };
  column.K = [=](const Vector& x, double lambda) {
    const double D = height(x);
    const Vector half = 0.5 * (2.0 * x.array()).sin(), cosine = (2.0 * x.array()).cos();
    const Matrix curvature = Matrix((cosine / D).asDiagonal()) + half * half.transpose() / (D * D * D);
    return Matrix(Matrix::Identity(2, 2) - lambda * curvature);
  };
  for (const double step : steps) {
    SCOPED_TRACE(step);
    const TraceOptions options = until(1.5, step);
    const Branch branch = test::trace(column, options, {.x = Vector::Zero(2), .lambda = 0.0});
    expect_events(branch, {{branch_point, 1.0, 0, 2}});
    const Event event = only_event(branch, branch_point);
    EXPECT_EQ(event.branching->multiplicity, 2);
    EXPECT_EQ(event.branching->type, BranchType::multiple);
    ASSERT_EQ(event.branching->modes.size(), 2U);
    const Vector a = event.branching->modes[0].dx, b = event.branching->modes[1].dx;
    EXPECT_GT(std::abs(a[0] * b[1] - a[1] * b[0]), 0.9 * a.norm() * b.norm());
  }
}

TEST(Touches, AreSuspected) {
  for (const double step : steps)
    for (const double least : {0.0, 1e-12, -1e-15}) {
      SCOPED_TRACE(testing::Message() << "steps × " << step << ", least stiffness " << least);
      const Branch branch = along_line({{.at = 0.4871, .a = least, .c = 1.0}}, step);
      const Event event = only_event(branch, branch_point);
      EXPECT_TRUE(event.unconfirmed);
      EXPECT_NEAR(event.state.lambda, 0.4871, 1e-6);
      EXPECT_EQ(event.unstable_before, 0);
      EXPECT_EQ(event.unstable_after, 0);
    }
}

TEST(Touches, AreSeenByTheStepThatEndsOnThem) {
  for (const double least : {0.0, 1e-12}) {
    SCOPED_TRACE(least);
    // The steps 0.02, 0.04, 0.08, 0.16 and 0.2 end on 0.5.
    const Branch branch = along_line({{.at = 0.5, .a = least, .c = 1.0}}, 1.0);
    EXPECT_TRUE(only_event(branch, branch_point).unconfirmed);
  }
}

TEST(Touches, AreNotInventedWhereAnEigenvalueStaysClear) {
  for (const double step : steps)
    for (const double least : {1e-6, 1e-4, 1e-2}) {
      SCOPED_TRACE(testing::Message() << "steps × " << step << ", least stiffness " << least);
      expect_events(along_line({{.at = 0.4871, .a = least, .c = 1.0}}, step), {});
    }
}

// x³ + λ: λ is level at 0 without turning.
TEST(Touches, OfTheSlopeAreSuspectedLimitPoints) {
  for (const double step : steps) {
    SCOPED_TRACE(step);
    TraceOptions options = until(1.5, step);
    options.step.first = -options.step.first;
    const SmoothToy system = test::cusp(0.0);
    const Branch branch = test::trace(system, options, {.x = test::scalar(-1.0), .lambda = 1.0});
    const Event event = only_event(branch, limit_point);
    EXPECT_TRUE(event.unconfirmed);
    EXPECT_NEAR(event.state.lambda, 0.0, 1e-10);
    EXPECT_TRUE(events_of(branch, branch_point).empty());
  }
}

}  // namespace arcwall::singular_points_test
