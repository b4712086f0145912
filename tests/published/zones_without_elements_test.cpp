#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/sliding/unknowns.hpp"
#include "tests/support/branch.hpp"
#include "tests/support/models.hpp"
#include "tests/support/sliding_models.hpp"

// A pinned column of length 2 on a straight wall. Between a pin and the zone the extensible elastica has no moment at
// either end, so that the force R acts along the chord c, at the angle α to the wall. Its first integral yields with
// φ, the angle to the force, from −α to α:
//
//     ½ EI θ′² = R (cos φ − cos α) − R² (cos² φ − cos² α)/(2 EA),   l = ∫ dφ/θ′,   c = ∫ (1 − R cos φ/EA) cos φ dφ/θ′
//
// The thrust is R cos α, the wall's distance c sin α, and the zone's length 2 − 2 l.
namespace arcwall::zones_without_elements_test {

namespace {

using test::SlidingChannel;
using test::SlidingModel;

constexpr double EA = 210.0, EI = 0.175, L = 2.0, gap = 0.15;

struct Span {
  double length = 0.0, chord = 0.0;
};

// φ = α sin u takes the root out of θ′.
Span span(double alpha, double thrust) {
  const double R = thrust / std::cos(alpha);
  Span sum;
  constexpr int parts = 400;
  for (int i = 0; i < parts; ++i) {
    const double u = pi * ((i + 0.5) / parts - 0.5), phi = alpha * std::sin(u);
    const double c = std::cos(phi), c0 = std::cos(alpha);
    const double difference = 2.0 * std::sin(0.5 * (alpha + phi)) * std::sin(0.5 * (alpha - phi));  // cos φ − cos α
    const double rate = std::sqrt(2.0 * R / EI * difference * (1.0 - 0.5 * R * (c + c0) / EA));
    const double ds = alpha * std::cos(u) / rate * pi / parts;
    sum.length += ds;
    sum.chord += (1.0 - R * c / EA) * c * ds;
  }
  return sum;
}

double zone_length(double thrust) {
  double low = 1e-3, high = 1.0;
  const auto off = [&](double alpha) { return span(alpha, thrust).chord * std::sin(alpha) - gap; };
  while (high - low > 1e-15) (off(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
  return L - 2.0 * span(low, thrust).length;
}

SlidingChannel column(int elements) {
  return {.members = {{L, elements}}, .upper = gap, .lower = std::nullopt, .theory = Theory::elastica};
}

TraceOptions between(double first_step, double lambda) {
  TraceOptions options;
  options.step.first = first_step;
  options.target_values = {test::stop_at_lambda(-1.0), test::stop_at_lambda(lambda)};
  return options;
}

const State& last_of(const std::vector<test::ExploredBranch>& branches) { return branches.back().arcs.back().to.state; }

double length_of_zone(const State& state) {
  const SlidingState at(state);
  return at.s(1) - at.s(0);
}

double load_of(const std::vector<test::ExploredBranch>& branches, EventKind kind) {
  for (const Event& event : test::events_of(branches))
    if (event.kind == kind) return event.state.lambda;
  return NAN;
}

}  // namespace

TEST(ZonesWithoutElements, AreAsLongAsTheElasticaLeavesThem) {
  const std::vector<int> meshes{20, 40, 80};
  const std::vector<double> loads{1.75, 2.0, 3.0};
  std::vector<double> sizes;
  std::vector<std::vector<double>> errors(loads.size() + 1);
  for (const int elements : meshes) {
    sizes.push_back(1.0 / elements);
    const SlidingModel model = column(elements).model();
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const auto branches = test::follow(model.system(), model.system().rest(), between(0.05, loads[i]));
      const State& last = last_of(branches);
      ASSERT_EQ(last.lambda, loads[i]);
      EXPECT_EQ(mesh_of(last).axial_forces(), 1);
      errors[i].push_back(length_of_zone(last) - zone_length(loads[i]));
      if (i == 0) errors.back().push_back(zone_length(load_of(branches, EventKind::contact_spreads)));
    }
  }
  for (const std::vector<double>& of : errors) {
    EXPECT_GE(test::observed_order(sizes, of), 3.8);
    EXPECT_NEAR(of.back(), 0.0, 1e-7);
  }
}

// The point and the zone of no length are one state.
TEST(ZonesWithoutElements, EndWhereTheyBegin) {
  const SlidingModel model = column(20).model();
  const auto there = test::follow(model.system(), model.system().rest(), between(0.05, 2.0));
  const auto back = test::follow(model.system(), last_of(there), between(-0.05, 1.0));
  const double spreads = load_of(there, EventKind::contact_spreads);
  EXPECT_NEAR(load_of(back, EventKind::contact_shrinks), spreads, 1e-11);
  EXPECT_EQ(mesh_of(last_of(back)).axial_forces(), 0);
}

// Where a step from the change ends does not depend on its length.
TEST(ZonesWithoutElements, BeginWithoutALengthOfTheirOwn) {
  const SlidingModel model = column(20).model();
  const auto branches = test::follow(model.system(), model.system().rest(), between(0.05, 2.0));
  double shortest = L;
  for (const Arc& arc : branches.back().arcs)
    if (mesh_of(arc.to.state).axial_forces() == 1) shortest = std::min(shortest, length_of_zone(arc.to.state));
  EXPECT_NEAR(shortest, 0.0, 1e-12);
}

}  // namespace arcwall::zones_without_elements_test
