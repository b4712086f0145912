#pragma once

#include <functional>
#include <vector>

#include "tests/support/models.hpp"

namespace arcwall::test {

/// A located point of a path: its kind, λ, and where the loaded joint has gone.
struct PathEvent {
  EventKind kind = EventKind::limit_point;
  double lambda = 0.0;
  Vec2 displacement{};
};

/// The model's path as its options say.
Branch traced(const PathModel& model);

/// The limit points, displacement limits and branch points of a branch, in their order.
std::vector<PathEvent> points_of(const PathModel& model, const Branch& branch);

/// Those of the kinds that are expected are the expected ones, in number, order and value.
void expect_points(const PathModel& model, const Branch& branch, const std::vector<PathEvent>& expected,
                   double in_lambda, double in_displacement);

/// How well the points of a path are known.
struct Precision {
  double limit_in_lambda = 1e-7;        ///< of the extrapolated λ, as a part of the greatest |λ|
  double limit_in_displacement = 1e-7;  ///< likewise
  double noise = 1e-8;  ///< of displacements, likewise. Where a quantity is level the zero of its slope is less sure
                        ///< than its value: places of limit points are known to about the root of round-off
};

/// The points of a path over four meshes, `coarsest` · 1, 2, 4, 8, have the theory's order and extrapolate to the
/// expected ones. The order is that of λ at limit and branch points, and of the distance from the expected point, which
/// does not vanish by accident as single components may.
void expect_points_converge(const BeamTheory& theory, int coarsest,
                            const std::function<PathModel(int elements, const BeamTheory&)>& model,
                            const std::vector<PathEvent>& expected, const Precision& precision);

}  // namespace arcwall::test
