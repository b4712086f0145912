#include "apps/output/path_cubics.hpp"
#include "answers/sessions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tests/apps/traced_deck.hpp"

namespace arcwall::path_cubics_test {
namespace {

constexpr double h = 0.5;

// Two bars of half-span 5 and rise h, Green strain (tests/published): λ(w) and dλ/dw.
double load(double w) { return 1e5 / std::pow(25.0 + h * h, 1.5) * w * (w - h) * (w - 2.0 * h); }
double slope(double w) { return 1e5 / std::pow(25.0 + h * h, 1.5) * (3.0 * w * w - 6.0 * h * w + 2.0 * h * h); }

TEST(PathCubics, RatesAreThoseOfTheClosedForm) {
  const test::TracedDeck truss(test::example("truss"));
  constexpr double greatest_slope = 400.0;
  for (const RecordPoint& point : truss.record().points) {
    ASSERT_TRUE(point.rates);
    const double w_rate = point.rates->monitors.at(0);
    ASSERT_NE(w_rate, 0.0);
    EXPECT_NEAR(point.rates->lambda / w_rate, slope(point.monitors[0]), 1e-9 * greatest_slope) << point.monitors[0];
    EXPECT_FALSE(point.rates_after) << "no contact changes";
  }
}

// Π is stationary where nothing slips: its rate is that of its load or movement, ∂Π/∂λ, times that of λ. By how much it
// is another, in parts of the greatest rate. `by_lambda`: of a point, ∂Π/∂λ.
template <class ByLambda>
double error_of_energy_rates(const Record& record, const ByLambda& by_lambda) {
  double greatest = 0.0, error = 0.0;
  for (const RecordPoint& point : record.points)
    for (const RecordRates& rates : {point.rates.value(), leaving_rates(point).value()}) {
      greatest = std::max(greatest, std::abs(rates.energy));
      error = std::max(error, std::abs(rates.energy - by_lambda(point) * rates.lambda));
    }
  return error / greatest;
}

TEST(PathCubics, TheEnergyFollowsTheWayOfTheLoad) {
  const test::TracedDeck truss(test::example("truss"));
  const auto way = [](const RecordPoint& point) { return -point.monitors[0]; };
  EXPECT_LT(error_of_energy_rates(truss.record(), way), 1e-8);
}

// Of a mesh that moves with the contact points Π is stationary up to the error of the mesh.
TEST(PathCubics, TheEnergyFollowsTheWayOfTheLoadOverAMovingMesh) {
  const auto error = [](const std::string& elements) {
    const test::TracedDeck channel(test::example("channel"), {"member.column.elements=" + elements});
    return error_of_energy_rates(channel.record(), [](const RecordPoint& point) { return -point.monitors[1]; });
  };
  const double coarse = error("40"), fine = error("80");
  EXPECT_LT(coarse, 2e-5);
  EXPECT_LT(fine, 0.6 * coarse);
}

TEST(PathCubics, TheEnergyFollowsTheForceOnAMovedWall) {
  const test::TracedDeck run(test::example("snap-fit"));
  EXPECT_LT(error_of_energy_rates(run.record(), [](const RecordPoint& point) { return point.monitors[0]; }), 1e-8);
}

// What friction dissipates is lost.
TEST(PathCubics, TheEnergyFollowsTheForceOnAMovedWallWithoutWhatFrictionDissipates) {
  const test::TracedDeck run(test::example("snap-fit-friction"));
  double dissipated = 0.0;
  for (const RecordPoint& point : run.record().points) {
    const std::optional<RecordRates>& rates = leaving_rates(point);
    ASSERT_TRUE(rates);
    double power = 0.0;
    for (const RecordSlip& slip : point.slips) power -= slip.force * (slip.rates.w - slip.place.stretch * slip.rates.s);
    EXPECT_NEAR(rates->energy, point.monitors[0] * rates->lambda - power, 1e-6) << point.step;
    dissipated = std::max(dissipated, power);
  }
  EXPECT_GT(dissipated, 1e-3);
}

double at_half(double from, double to, double begin, double end) { return 0.5 * (from + to) + 0.125 * (begin - end); }

// Of the cubics of a run whose steps are at most so long: in the middle of steps, where they are farthest from the
// points.
double greatest_error(const std::string& longest_step) {
  const test::TracedDeck truss(test::example("truss"), {"path.max_step=" + longest_step});
  const auto& points = truss.record().points;
  double greatest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto step = cubic_step(truss.record(), i, 0);
    if (!step) return infinity;
    const RecordPoint &a = points[i - 1], &b = points[i];
    const double w = at_half(a.monitors[0], b.monitors[0], step->begin.x(), step->end.x());
    const double lambda = at_half(a.lambda, b.lambda, step->begin.y(), step->end.y());
    greatest = std::max(greatest, std::abs(lambda - load(w)));
  }
  return greatest;
}

// Cubics of Hermite have an error of fourth order in the steps: half of them leave a sixteenth.
TEST(PathCubics, ComeNearerToThePathByTheFourthOrder) {
  const double coarse = greatest_error("0.002"), fine = greatest_error("0.001");
  EXPECT_GT(fine, 0.0);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.5);
}

// Where the column comes into contact its deflection at the contact stops: the path has a kink.
TEST(PathCubics, ThePathHasAKinkWhereAContactCloses) {
  const test::TracedDeck channel(test::example("channel"));
  const Record& record = channel.record();
  const RecordEvent& closes = test::event_of(channel, EventKind::contact_closes);
  const auto at = std::find_if(record.points.begin(), record.points.end(),
                               [&](const RecordPoint& point) { return point.step == closes.step; });
  ASSERT_TRUE(at->rates && at->rates_after);
  const auto direction = [](const RecordRates& rates) { return rates.monitors[0] / std::abs(rates.lambda); };
  EXPECT_GT(direction(*at->rates), 1.0);
  EXPECT_NEAR(direction(*at->rates_after), 0.0, 1e-9);
  const auto i = static_cast<std::size_t>(at - record.points.begin());
  EXPECT_GT(cubic_step(record, i, 0)->end.x(), 0.0);
  EXPECT_NEAR(cubic_step(record, i + 1, 0)->begin.x(), 0.0, 1e-12);
}

TEST(PathCubics, AResumedRunHasTheSameRates) {
  Session run = make_session(test::TracedDeck(test::example("channel")).session().description());
  for (int i = 0; i < 20; ++i) ASSERT_NE(run.next(), nullptr);
  Session resumed = resume_session(run.checkpoint(), "checkpoint", Session::Resume::go_on);
  while (run.next() != nullptr) continue;
  while (resumed.next() != nullptr) continue;
  ASSERT_EQ(run.points().size(), resumed.points().size());
  for (std::size_t i = 0; i < run.points().size(); ++i) {
    const RecordPoint &a = run.points()[i], &b = resumed.points()[i];
    ASSERT_TRUE(a.rates && b.rates);
    EXPECT_EQ(a.rates->lambda, b.rates->lambda);
    EXPECT_EQ(a.rates->energy, b.rates->energy);
    EXPECT_EQ(a.rates->monitors, b.rates->monitors);
    EXPECT_EQ(a.rates_after.has_value(), b.rates_after.has_value());
  }
}

}  // namespace
}  // namespace arcwall::path_cubics_test
