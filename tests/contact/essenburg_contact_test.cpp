#include <gtest/gtest.h>

#include <cmath>

#include "tests/contact/contact_models.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/essenburg_models.hpp"

// Contact of faces whose distance from the axis changes, at nodes and middle nodes.
namespace arcwall::essenburg_contact_test {

namespace {

constexpr double height = 0.3;

// Two elements.
std::unique_ptr<Structure> beam(const test::EssenburgBeams& beams) {
  return test::contact_beam({.theory = Theory::essenburg,
                             .order = beams.order,
                             .quadratic = beams.quadratic,
                             .section = test::essenburg_section(1.0, 0.29, 1.0, height),
                             .elements = 2});
}

// Every contact closed, forces and displacements of the size of the model.
State random_state(const MultiplierContact& system, test::Numbers& numbers) {
  const ActiveSet closed(static_cast<std::size_t>(system.contact_count()), 1);
  return {.x = 0.2 * numbers.vector(system.size(closed)), .lambda = numbers(), .active_set = closed};
}

// Whether a step stays on one cubic of the spline, whose third derivative jumps at its middle knot, x = 1.5.
bool is_smooth(const MultiplierContact& system, const State& state) {
  for (Index j = 0; j < system.contact_count(); ++j)
    if (std::abs(system.candidate(j).point().position(state).x() - 1.5) < 0.01) return false;
  return true;
}

// K by differences of order six of the residual, step 1e-3.
Matrix differences(const System& system, const State& at) {
  constexpr double step = 1e-3, weight[] = {45.0, -9.0, 1.0};
  const Index n = at.x.size();
  Matrix K = Matrix::Zero(n, n);
  State moved = at;
  Vector above(n), below(n);
  for (Index i = 0; i < n; ++i) {
    for (const int k : {1, 2, 3}) {
      moved.x[i] = at.x[i] + k * step;
      system.residual(moved, above);
      moved.x[i] = at.x[i] - k * step;
      system.residual(moved, below);
      K.col(i) += weight[k - 1] * (above - below) / (60.0 * step);
    }
    moved.x[i] = at.x[i];
  }
  return K;
}

}  // namespace

// Each element against each kind of wall, a thousand random states in all.
TEST(EssenburgContact, TangentIsExactOnEveryWallSlow) {
  test::Numbers numbers(80);
  for (const test::TestWall& wall : test::all_walls(false))
    for (const QuadraticTerm quadratic : {QuadraticTerm::fixed, QuadraticTerm::director})
      for (const int order : {1, 2}) {
        const test::ContactModel model(beam({.order = order, .quadratic = quadratic}), {wall}, 0.1);
        ASSERT_EQ(model.system().contact_count(), order == 1 ? 3 : 5);
        for (int i = 0; i < 25; ++i) {
          State state = random_state(model.system(), numbers);
          while (!is_smooth(model.system(), state)) state = random_state(model.system(), numbers);
          Linearization now;
          model.system().linearize(state, now);
          const Matrix K = test::full(now.K), D = differences(model.system(), state);
          EXPECT_LE((D - K).cwiseAbs().maxCoeff(), 1e-9 * K.cwiseAbs().maxCoeff());
          EXPECT_LE((D - D.transpose()).cwiseAbs().maxCoeff(), 1e-11 * K.cwiseAbs().maxCoeff());
        }
      }
}

// A constant pressure p on a straight beam has the nodal forces p ∫N ds: with order 1 the length between the nodes,
// half of it at the ends; with order 2 Simpson's shares.
TEST(EssenburgContact, TributaryLengthsAreThoseOfAConstantPressure) {
  const test::ContactModel linear = test::EssenburgFoundation{.elements = 4, .beams = {.order = 1}}.model();
  const test::ContactModel quadratic = test::EssenburgFoundation{.elements = 2}.model();
  const auto check = [](const test::ContactModel& model, const std::vector<double>& expected) {
    const MultiplierContact& system = model.system();
    ASSERT_EQ(static_cast<std::size_t>(system.contact_count()), expected.size());
    for (std::size_t j = 0; j < expected.size(); ++j) {
      const ContactLabel& label = system.candidate(static_cast<Index>(j)).label();
      EXPECT_EQ(label.fraction, 0.25 * double(j));
      EXPECT_NEAR(label.tributary, expected[j], 1e-15);
    }
  };
  check(linear, {1.0 / 8.0, 1.0 / 4.0, 1.0 / 4.0, 1.0 / 4.0, 1.0 / 8.0});
  check(quadratic, {1.0 / 12.0, 1.0 / 3.0, 1.0 / 6.0, 1.0 / 3.0, 1.0 / 12.0});
}

TEST(EssenburgContact, PressureIsForcePerTributaryLength) {
  const test::ContactModel model = test::EssenburgFoundation{.elements = 2}.model();
  const MultiplierContact& system = model.system();
  ActiveSet active_set = system.open_active_set();
  active_set[1] = 1;
  State state{.x = Vector::Zero(system.size(active_set)), .active_set = active_set};
  state.x[*system.multiplier_index(active_set, 1)] = 2.0;
  EXPECT_NEAR(*system.contact(state, 1).pressure(), 6.0, 1e-14);
  EXPECT_EQ(*system.contact(state, 0).pressure(), 0.0);
}

}  // namespace arcwall::essenburg_contact_test
