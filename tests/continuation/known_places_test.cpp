// A branch that comes back to where it began, where rotations count whole turns.
#include <gtest/gtest.h>

#include <cmath>

#include "continuation/tracer.hpp"
#include "tests/support/toys.hpp"

namespace arcwall::known_places_test {
namespace {

// A rigid pendulum of unit weight and length under the moment λ at its hinge: sin x = λ.
struct Pendulum : test::SmoothToy {
  bool counts_turns = false;  // as a spring at the hinge would

  explicit Pendulum(bool counts) : counts_turns(counts) {
    potential = [](const Vector& x, double lambda) { return 1.0 - std::cos(x[0]) - lambda * x[0]; };
    F = [](const Vector& x, double lambda) { return test::scalar(std::sin(x[0]) - lambda); };
    K = [](const Vector& x, double) { return test::scalar_matrix(std::cos(x[0])); };
    F_lambda = [](const Vector&, double) { return test::scalar(-1.0); };
  }
  StateMetric metric(const ActiveSet&) const override {
    return {.weights = Vector::Ones(1), .turning_sets = counts_turns ? std::vector<Index>() : std::vector<Index>{0}};
  }
};

BranchEnd end_of(const Pendulum& pendulum, State& last) {
  TraceOptions options;
  options.step.first = 0.1;
  options.step.max = 0.3;
  options.max_points = 200;
  Tracer tracer(pendulum, BranchStart{.state = {.x = Vector::Zero(1)}}, options);
  while (const auto arc = tracer.next()) last = arc->to.state;
  return tracer.end().value();
}

}  // namespace

TEST(KnownPlaces, CloseALoopAfterAWholeTurn) {
  State last;
  EXPECT_EQ(end_of(Pendulum(false), last).reason, EndReason::closed_loop);
  EXPECT_NEAR(last.x[0], 2.0 * pi, 0.31);
}

TEST(KnownPlaces, AreLeftWhereTurnsCount) {
  State last;
  EXPECT_EQ(end_of(Pendulum(true), last).reason, EndReason::max_points);
  EXPECT_GT(last.x[0], 4.0 * pi);
}

}  // namespace arcwall::known_places_test
