#include "tests/published/path_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/convergence.hpp"

namespace arcwall::test {

namespace {

// Points of the kinds that occur among the expected ones.
std::vector<PathEvent> comparable(const PathModel& model, const Branch& branch,
                                  const std::vector<PathEvent>& expected) {
  std::vector<PathEvent> found = points_of(model, branch);
  std::erase_if(found, [&](const PathEvent& point) {
    return std::none_of(expected.begin(), expected.end(), [&](const PathEvent& e) { return e.kind == point.kind; });
  });
  return found;
}

// The greatest |λ| and displacement.
struct Scales {
  double lambda = 0.0, way = 0.0;
};

Scales scales_of(const std::vector<PathEvent>& points) {
  Scales scales;
  for (const PathEvent& point : points) {
    scales.lambda = std::max(scales.lambda, std::abs(point.lambda));
    scales.way = std::max(scales.way, point.displacement.norm());
  }
  return scales;
}

// One point on all meshes, coarsest first.
void expect_point_converges(const std::vector<PathEvent>& meshes, const PathEvent& expected, const BeamTheory& theory,
                            const Scales& scales, const Precision& precision) {
  const double order = theory.convergence;
  std::vector<double> lambdas, xs, zs, in_lambda, distances;
  for (const PathEvent& point : meshes) {
    lambdas.push_back(point.lambda);
    xs.push_back(point.displacement.x());
    zs.push_back(point.displacement.y());
    in_lambda.push_back((point.lambda - expected.lambda) / scales.lambda);
    distances.push_back(std::hypot(in_lambda.back(), (point.displacement - expected.displacement).norm() / scales.way));
  }
  if (expected.kind != EventKind::turning_point) expect_order(in_lambda, order);
  expect_order(distances, order, precision.noise);
  EXPECT_NEAR(extrapolated(lambdas, order), expected.lambda, precision.limit_in_lambda * scales.lambda);
  EXPECT_NEAR(extrapolated(xs, order), expected.displacement.x(), precision.limit_in_displacement * scales.way);
  EXPECT_NEAR(extrapolated(zs, order), expected.displacement.y(), precision.limit_in_displacement * scales.way);
}

}  // namespace

Branch traced(const PathModel& model) { return trace(*model.structure, model.options(), model.watched()); }

std::vector<PathEvent> points_of(const PathModel& model, const Branch& branch) {
  std::vector<PathEvent> found;
  for (const Event& event : events_of(branch))
    if (event.kind == EventKind::limit_point || event.kind == EventKind::turning_point ||
        event.kind == EventKind::branch_point)
      found.push_back({.kind = event.kind,
                       .lambda = event.state.lambda,
                       .displacement = displacement_of(*model.structure, event.state, model.loaded)});
  return found;
}

void expect_points(const PathModel& model, const Branch& branch, const std::vector<PathEvent>& expected,
                   double in_lambda, double in_displacement) {
  const std::vector<PathEvent> found = comparable(model, branch, expected);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE("point " + std::to_string(i));
    EXPECT_EQ(found[i].kind, expected[i].kind);
    EXPECT_NEAR(found[i].lambda, expected[i].lambda, in_lambda);
    EXPECT_NEAR(found[i].displacement.x(), expected[i].displacement.x(), in_displacement);
    EXPECT_NEAR(found[i].displacement.y(), expected[i].displacement.y(), in_displacement);
  }
}

void expect_points_converge(const BeamTheory& theory, int coarsest,
                            const std::function<PathModel(int, const BeamTheory&)>& model,
                            const std::vector<PathEvent>& expected, const Precision& precision) {
  SCOPED_TRACE(theory.name);
  std::vector<std::vector<PathEvent>> found(expected.size());  // each point on all meshes
  for (const int finer : {1, 2, 4, 8}) {
    const PathModel mesh = model(coarsest * finer, theory);
    const std::vector<PathEvent> points = comparable(mesh, traced(mesh), expected);
    ASSERT_EQ(points.size(), expected.size()) << coarsest * finer << " elements";
    for (std::size_t i = 0; i < points.size(); ++i) found[i].push_back(points[i]);
  }
  const Scales scales = scales_of(expected);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE("point " + std::to_string(i));
    expect_point_converges(found[i], expected[i], theory, scales, precision);
  }
}

}  // namespace arcwall::test
