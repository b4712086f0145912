#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/published/path_checks.hpp"
#include "tests/support/models.hpp"

// The elastica's element of order 6 on the published frames and arches. Its errors come down to round-off on the second
// or third mesh, so the order is that between two meshes. References as in frames_test.cpp and arches_test.cpp: the
// extensible elastica by shooting with adaptive Taylor series.
namespace arcwall::elastica_order_six_test {

namespace {

using test::BeamTheory;
using test::PathModel;

BeamTheory order_six() {
  return {.name = "elastica, order 6", .theory = Theory::elastica, .order = 6, .convergence = 6, .on_circles = 0};
}

PathModel path_of(std::unique_ptr<Structure> structure, Index loaded, double first_step, double lowest) {
  const TargetValue stop = test::stop_at(*structure, loaded, Dof::z, lowest);
  return {.structure = std::move(structure), .loaded = loaded, .first_step = first_step, .target_values = {stop}};
}

// Loads of the limit and branch points, in their order.
std::vector<double> singular_loads(const PathModel& model) {
  std::vector<double> loads;
  for (const test::PathEvent& point : points_of(model, traced(model)))
    if (point.kind != EventKind::turning_point) loads.push_back(point.lambda);
  return loads;
}

// On meshes of n and 2 n elements a member: order 6 from one to the other. On that of `finest`: 1e-9 of the greatest
// load. Where that is so fine that the round-off of K, ε EI/h³, is some percent of the error, the order is not seen.
void expect_order_six(const std::function<PathModel(int elements)>& model, int n, int finest,
                      const std::vector<double>& expected) {
  const std::vector<double> coarse = singular_loads(model(n)), fine = singular_loads(model(2 * n));
  const std::vector<double> finer = finest == 2 * n ? fine : singular_loads(model(finest));
  ASSERT_EQ(coarse.size(), expected.size());
  ASSERT_EQ(fine.size(), expected.size());
  ASSERT_EQ(finer.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE(expected[i]);
    EXPECT_NEAR(std::log2((coarse[i] - expected[i]) / (fine[i] - expected[i])), 6.0, 0.2);
    EXPECT_NEAR(finer[i], expected[i], 1e-9 * std::abs(expected[0]));
  }
}

}  // namespace

TEST(ElasticaOfOrderSix, WilliamsToggle) {
  expect_order_six([](int n) { return path_of(test::williams_toggle(n, order_six()), 1, 2.0, -0.8); }, 8, 16,
                   {33.8703851779, 31.2817744575});
}

TEST(ElasticaOfOrderSix, LeesFrame) {
  expect_order_six([](int n) { return path_of(test::lee_frame(n, order_six()), 2, 0.1, -90.0); }, 15, 30,
                   {1.855672753757, -0.941443155560});
}

TEST(ElasticaOfOrderSix, ShallowArch) {
  expect_order_six([](int n) { return path_of(test::shallow_arch(n, order_six()), 1, 100.0, -1100.0); }, 8, 16,
                   {1280.60663728179, 1279.36308536489, -477.994067635700, -435.959957550091});
}

TEST(ElasticaOfOrderSix, PinnedSemicircle) {
  expect_order_six([](int n) { return path_of(test::pinned_semicircle(n, order_six()), 1, 1.0, -150.0); }, 10, 32,
                   {20.8420786502809, 36.0888659301171});
}

TEST(ElasticaOfOrderSix, DeepArch) {
  expect_order_six([](int n) { return path_of(test::deep_arch(n, order_six()), 1, 20.0, -123.0); }, 16, 32,
                   {897.294947593916, -73.051143418756});
}

}  // namespace arcwall::elastica_order_six_test
