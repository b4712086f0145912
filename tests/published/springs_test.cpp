#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/root_find.hpp"
#include "tests/support/branch.hpp"
#include "tests/support/models.hpp"

// Pinned columns on springs under a dead load P: first branch points of the straight column. A section has EA = 210 and
// EI = 0.175, the length is 2 [kN, cm]. While P compresses it, the axis is λ̂ = 1 − P/EA times as long, so that bending
// has the wave number k of λ̂ P = EI k² by stress-free length, and springs across count for 1/λ̂ as much.
namespace arcwall::springs_test {

namespace {

constexpr double EA = 210.0, EI = 0.175, L = 2.0;
constexpr double euler = pi * pi * EI / (L * L);

double shrink(double P) { return 1.0 - P / EA; }
double wave_number(double P) { return std::sqrt(shrink(P) * P / EI); }

double zero_of(const std::function<double(double)>& f, double a, double b) {
  const auto root = bracketed_root(f, a, f(a), b, f(b), 1e-15);
  EXPECT_TRUE(root.has_value());
  return root ? root->at : 0.0;
}

// Load at which EI q² λ̂⁰ … a wave number q alone buckles: EI q² = λ̂ P.
double load_of(double q, double stiffness = 0.0) {
  return zero_of([&](double P) { return EI * q * q - shrink(P) * P + shrink(P) * shrink(P) * stiffness / (q * q); },
                 0.0, 20.0);
}

struct Springs {
  double middle = 0.0, ends = 0.0;  // across in the middle; against rotation at both ends
  double foundation = 0.0;
};

double first_branch_point(const Springs& springs, Theory theory, int elements) {
  StructureBuilder builder;
  const Vec2 at[] = {{0.0, 0.0}, {L, 0.0}};
  for (const Vec2& position : at) builder.add_joint(position);
  builder.add_member({.name = "column",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis(at[0], at[1]),
                      .theory = theory,
                      .order = theory == Theory::elastica ? 6 : 2,
                      .section = test::section_of(EA, EI),
                      .elements = elements});
  builder.fix(builder.dof(0, Dof::x));
  for (const Index end : {0, 1}) {
    builder.fix(builder.dof(end, Dof::z));
    if (springs.ends > 0.0) builder.add_ground_stiffness(builder.shared_rotation(end).value(), springs.ends);
  }
  const Index middle = builder.dof(builder.mesh(0).nodes[static_cast<std::size_t>(elements / 2)], Dof::z);
  if (springs.middle > 0.0) builder.add_ground_stiffness(middle, springs.middle);
  if (springs.foundation > 0.0) builder.add_foundation(0, {0.0, springs.foundation});
  builder.add_load(builder.dof(1, Dof::x), -1.0, LoadKind::proportional);
  const auto structure = builder.build();
  TraceOptions options;
  options.step.first = 0.05;
  options.stay = true;
  options.target_values.push_back(test::stop_at_lambda(3.0));
  const test::Branch branch = test::trace(*structure, options);
  const auto found = events_of(branch, EventKind::branch_point);
  return found.empty() ? 0.0 : found.front().state.lambda;
}

}  // namespace

// By statics of each half, with u = k L/2: (λ̂ c/2P) (L/2 − tan u/k) = 1. With c = 4 P/(λ̂ L) where λ̂ P is four times
// Euler's load, the column buckles in two waves, which leave the spring alone.
TEST(ColumnOnSprings, BucklesOverASpringInItsMiddleAsStaticsSay) {
  const double two_waves = load_of(2.0 * pi / L), stiff_enough = 4.0 * two_waves / (shrink(two_waves) * L);
  for (const double part : {0.25, 0.5, 0.9}) {
    SCOPED_TRACE(part);
    const double c = part * stiff_enough;
    const auto statics = [&](double P) {
      const double k = wave_number(P);
      return shrink(P) * c / (2.0 * P) * (0.5 * L * std::cos(0.5 * k * L) - std::sin(0.5 * k * L) / k) -
             std::cos(0.5 * k * L);
    };
    const double expected = zero_of(statics, euler * 1.0001, two_waves * 0.9999);
    EXPECT_NEAR(first_branch_point({.middle = c}, Theory::elastica, 20), expected, 1e-8 * expected);
    EXPECT_NEAR(first_branch_point({.middle = c}, Theory::euler_bernoulli, 80), expected, 1e-6 * expected);
  }
  EXPECT_NEAR(first_branch_point({.middle = 1.1 * stiff_enough}, Theory::elastica, 20), two_waves, 1e-8 * two_waves);
}

// A spring acts at nodes and leaves the elements' order; a foundation is of order 4 in those of either theory.
TEST(ColumnOnSprings, ConvergesWithItsOrder) {
  const auto least_order = [](const Springs& springs, Theory theory, double exact) {
    std::vector<double> errors;
    for (const int elements : {4, 8, 16})
      errors.push_back(std::abs(first_branch_point(springs, theory, elements) / exact - 1.0));
    EXPECT_GT(errors.back(), 1e-12);
    return std::log2(std::max(errors[1], 1e-300) / std::max(errors[2], 1e-11));
  };
  const auto statics = [&](double P) {
    const double k = wave_number(P);
    return std::sin(0.5 * k * L) + EI * k / 0.5 * std::cos(0.5 * k * L);
  };
  const double at_ends = zero_of(statics, euler * 1.0001, 4.0 * euler);
  EXPECT_GT(least_order({.ends = 0.5}, Theory::elastica, at_ends), 5.0);
  EXPECT_GT(least_order({.ends = 0.5}, Theory::euler_bernoulli, at_ends), 3.5);
  const double founded = std::min(load_of(pi / L, 5.0), load_of(2.0 * pi / L, 5.0));
  EXPECT_GT(least_order({.foundation = 5.0}, Theory::elastica, founded), 3.5);
  EXPECT_GT(least_order({.foundation = 5.0}, Theory::euler_bernoulli, founded), 3.5);
}

// Alike at both ends: tan(k L/2) = −EI k/c, from c = 0 (Euler) to ∞ (clamped).
TEST(ColumnOnSprings, BucklesBetweenSpringsAtItsEndsAsStaticsSay) {
  for (const double c : {0.1, 0.5, 3.0}) {
    SCOPED_TRACE(c);
    const auto statics = [&](double P) {
      const double k = wave_number(P);
      return std::sin(0.5 * k * L) + EI * k / c * std::cos(0.5 * k * L);
    };
    const double expected = zero_of(statics, euler * 1.0001, 4.0 * euler);
    EXPECT_NEAR(first_branch_point({.ends = c}, Theory::elastica, 20), expected, 1e-8 * expected);
  }
}

// EI q² − λ̂ P + λ̂² k/q² = 0 for m half waves, q = m π/L: the least of all m.
TEST(ColumnOnSprings, BucklesOnAFoundationInTheWaveOfLeastLoad) {
  for (const double k : {0.5, 5.0, 9.0}) {
    SCOPED_TRACE(k);
    double expected = infinity;
    for (int m = 1; m <= 4; ++m) expected = std::min(expected, load_of(m * pi / L, k));
    EXPECT_NEAR(first_branch_point({.foundation = k}, Theory::elastica, 40), expected, 1e-6 * expected);
    EXPECT_NEAR(first_branch_point({.foundation = k}, Theory::euler_bernoulli, 80), expected, 1e-6 * expected);
  }
}

}  // namespace arcwall::springs_test
