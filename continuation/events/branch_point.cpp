#include "continuation/events/branch_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuation/path_tolerances.hpp"
#include "core/algebra/near_null.hpp"

namespace arcwall {

namespace {

constexpr double negligible = 1e-6;  // ratio of two coefficients below which the first is zero
constexpr double rate_step = 1e-3;   // h of differences for a rate [path metric]

constexpr double shortest_step_off = 1e-9;  // one that is no longer cannot be told from none [path metric]
constexpr int most_failures = 12;           // of steps off, those aside that only a wall ahead makes shorter

// Algebraic branching equation a α² + 2 b α β = 0 for tangents α φ + β t, t the tangent we came along:
//   α = 0 (the old branch) or α : β = −2 b : a.
void find_other_tangent(const Equations& system, const Metric& metric, const Vector& left, BranchPoint& point) {
  Linearization beside;
  const double b = eigenvalue_rate(system, point.state, point.along, left, point.mode.dx, beside);
  const double a = eigenvalue_rate(system, point.state, point.mode, left, point.mode.dx, beside);
  const bool symmetric =
      std::abs(a) <= std::max(negligible * std::abs(b), eigenvalue_rate_roundoff(left, point.mode.dx, beside));
  point.type = symmetric ? BranchType::pitchfork : BranchType::transcritical;
  Direction other = point.mode;
  if (!symmetric) {
    const double beta = -a / (2.0 * b);
    other.dx += beta * point.along.dx;
    other.dlambda += beta * point.along.dlambda;
  }
  point.other = unit(metric, std::move(other));
}

// The way from a branch point to where a step off it leads. Beyond a wall at some distance a shorter step may fit
// before it; what is violated from the branch point on is so however short the step.
enum class Way { is_free, ends_at_a_wall, is_closed };

Way way_to(const System& system, const State& from, const State& to, double guard_tolerance) {
  constexpr double distant = penetration_tolerance;
  if (system.guard_count(to.active_set) > 0) {
    const Vector guards = system.guards(to);
    const auto violated = guards.array() < -guard_tolerance;
    if (violated.any()) {
      const bool wall_ahead =
          to.active_set == from.active_set && (!violated || system.guards(from).array() > distant).all();
      return wall_ahead ? Way::ends_at_a_wall : Way::is_closed;
    }
  }
  if (!system.penetrated_place(to, -penetration_tolerance)) return Way::is_free;
  return !system.penetrated_place(from, distant) ? Way::ends_at_a_wall : Way::is_closed;
}

// Of two null vectors at a limit point the combination that is no motion along the path.
Matrix across(const Matrix& vectors, const Metric& metric, const Direction& along) {
  const Index size = vectors.rows();
  const Vector part = vectors.transpose() * metric.weights().head(size).cwiseProduct(along.dx.head(size));
  return vectors * Vector{{-part[1], part[0]}} / part.norm();
}

// Of the pairs nearest zero the first that is negative.
std::optional<NearNull> nearest_negative(const Corrector& corrector, const State& here, const Vector& weights) {
  for (const Index looked_at : {2, 4, 8, 16}) {
    const auto pairs = corrector.near_null(here, weights, looked_at);
    if (!pairs) return std::nullopt;
    for (Index j = 0; j < pairs->values.size(); ++j)
      if (pairs->values[j] < 0.0)
        return NearNull{.values = pairs->values.segment(j, 1), .vectors = Matrix(pairs->vectors->col(j))};
  }
  return std::nullopt;
}

// The right null vectors that go with left ones, in the path metric; empty if one is not found.
std::vector<Vector> modes_of(Corrector& corrector, const NearNull& pairs, Index count) {
  std::vector<Vector> modes;
  for (Index j = 0; j < count; ++j) {
    auto mode = corrector.right_null(corrector.left_null(pairs.vectors->col(j)));
    if (!mode) return {};
    modes.push_back(std::move(*mode));
  }
  return modes;
}

// The mode's largest component is positive: the first of those that are equal but for round-off, as both ends of a
// half wave turn.
void add_modes(BranchPoint& point, std::vector<Vector> modes, const Vector& weights) {
  constexpr double equal = 1.0 - 1e-4;
  for (Vector& mode : modes) {
    const Vector sizes = mode.cwiseProduct(weights.cwiseSqrt()).cwiseAbs();
    const double least = equal * sizes.maxCoeff();
    const auto largest = std::find_if(sizes.begin(), sizes.end(), [&](double size) { return size >= least; });
    if (mode[largest - sizes.begin()] < 0.0) mode = -mode;
    point.modes.push_back({.dx = std::move(mode), .dlambda = 0.0});
  }
  point.mode = point.modes.front();
}

}  // namespace

// ψᵀ (J(x + h d) − J(x − h d)) φ / 2h, ψ and φ the left and right null vectors of J = ∂F/∂x.
double eigenvalue_rate(const Equations& system, const State& state, const Direction& d, const Vector& left,
                       const Vector& mode, Linearization& workspace) {
  double rate = 0.0;
  for (const double sign : {1.0, -1.0}) {
    system.linearize(moved(state, d, sign * rate_step), workspace);
    rate += sign * left.dot(product(workspace, mode).col(0)) / (2.0 * rate_step);
  }
  return rate;
}

// The entries of K are rounded independently of each other: their errors add as roots of squares do. Added by size they
// would hide rates on fine meshes, as EI/h³ grows.
double eigenvalue_rate_roundoff(const Vector& left, const Vector& mode, const Linearization& workspace) {
  const Index n = workspace.K.cols();
  const Vector by_row = workspace.K.cwiseAbs2().selfadjointView<Eigen::Lower>() * mode.head(n).cwiseAbs2();
  const double squared = left.head(n).cwiseAbs2().dot(by_row);
  return 10.0 * std::numeric_limits<double>::epsilon() * std::sqrt(squared) / rate_step;
}

BranchPoint branch_point_at(const Equations& system, Corrector& corrector, const Metric& metric,
                            const SingularPlace& place) {
  BranchPoint point{.type = BranchType::multiple,
                    .state = place.point.state,
                    .along = place.point.tangent,
                    .multiplicity = place.multiplicity,
                    .change = place.change};
  const Vector& weights = metric.weights();
  // Where K is singular to the last digit its null vectors come from beside.
  constexpr double beside = 1e-7;  // [path metric]
  std::optional<NearNull> pairs;
  for (const double along : {0.0, beside, -beside}) {
    const State here = moved(point.state, point.along, along);
    corrector.inspect(here, metric, point.along);
    if ((pairs = corrector.near_null(here, weights, place.multiplicity + (place.at_limit ? 1 : 0)))) break;
  }
  if (pairs && place.at_limit && pairs->vectors->cols() == 2)
    pairs->vectors = across(*pairs->vectors, metric, point.along);
  if (!pairs || pairs->vectors->cols() < place.multiplicity) return point;
  std::vector<Vector> modes = modes_of(corrector, *pairs, place.multiplicity);
  if (modes.empty()) return point;
  add_modes(point, std::move(modes), weights);
  if (place.multiplicity == 1 && !place.touches)
    find_other_tangent(system, metric, corrector.left_null(pairs->vectors->col(0)), point);
  return point;
}

BranchPoint branch_point_before(const Equations& system, Corrector& corrector, const Metric& metric,
                                const PathPoint& behind) {
  BranchPoint point{
      .type = BranchType::multiple, .state = behind.state, .along = behind.tangent, .multiplicity = 1, .change = 1};
  corrector.inspect(point.state, metric, point.along);
  const auto pair = nearest_negative(corrector, point.state, metric.weights());
  std::vector<Vector> modes = pair ? modes_of(corrector, *pair, 1) : std::vector<Vector>{};
  if (modes.empty()) return point;
  modes.front() = unit(metric, {.dx = modes.front(), .dlambda = 0.0}).dx;
  add_modes(point, std::move(modes), metric.weights());
  find_other_tangent(system, metric, corrector.left_null(pair->vectors->col(0)), point);
  return point;
}

void find_crossing_branch(Corrector& corrector, const Metric& metric, BranchPoint& point) {
  constexpr double along = 0.99;  // cosine between the path and the mode
  constexpr double work = 1e-3;   // of the load along the mode, which symmetry makes vanish, over its greatest
  if (point.mode.dx.size() == 0) return;
  corrector.inspect(point.state, metric, point.along);
  const Vector& mode = point.mode.dx;
  const double length = metric.norm(point.mode);
  const double cosine =
      metric.inner_x(point.mode, point.along) / (length * std::sqrt(metric.inner_x(point.along, point.along)));
  const Vector& F_lambda = corrector.factorized().equations().F_lambda;
  const double of_greatest = F_lambda.dot(mode) / (length * metric.dual_norm(F_lambda));
  if (!(std::abs(cosine) > along && std::abs(of_greatest) < work)) return;
  auto y = corrector.response_across(metric.row(point.mode), -F_lambda);
  if (!y) return;
  point.type = BranchType::pitchfork;
  point.other = unit(metric, {.dx = std::move(*y), .dlambda = 1.0});
  for (const Direction& direction : {point.other, reversed(point.other)})
    point.ways.push_back({.active_set = point.state.active_set, .direction = direction});
}

WayOff way_off(const Metric& metric, const BranchPoint& point, int sign) {
  const Direction forward = sign > 0 ? point.other : reversed(point.other);
  if (point.type == BranchType::pitchfork) return {.forward = forward, .across = forward};
  const double part = metric.inner(forward, point.along) / metric.inner(point.along, point.along);
  Direction across = forward;
  across.dx -= part * point.along.dx;
  across.dlambda -= part * point.along.dlambda;
  return {.forward = forward, .across = std::move(across)};
}

double roundoff_width(Corrector& corrector, const Metric& metric, const SingularPlace& place,
                      const BranchPoint& point) {
  const BorderedSolver& solver = corrector.factorized().solver();
  if (place.rate <= 0.0 || !solver.inner_is_regular()) return 0.0;
  const Index size = corrector.factorized().equations().K.cols();
  const Vector weights = metric.weights().head(size);
  double unsure = 0.0;  // of μ in K φ = μ W φ
  for (const Direction& mode : point.modes) {
    const Vector phi = mode.dx.head(size);
    unsure = std::max(unsure, solver.inner().roundoff(phi) / weights.dot(phi.cwiseAbs2()));
  }
  return std::min(unsure / place.rate, 1.0);
}

std::optional<SteppedOff> step_off(const System& system, Corrector& corrector, const Metric& metric,
                                   const BranchPoint& point, const WayOff& way, double distance,
                                   double guard_tolerance) {
  for (int failures = 0; failures < most_failures && distance > shortest_step_off; distance *= 0.5) {
    const double offset = distance * metric.inner(way.forward, way.across);
    const PlaneConstraint plane(metric, point.state, way.across, offset);
    CorrectorResult at =
        corrector.correct(moved(point.state, way.forward, distance), plane, metric, way.forward, distance);
    if (at.converged()) {
      at.state.active_set = system.canonical_active_set(at.state);
      const Way to = way_to(system, point.state, at.state, guard_tolerance);
      if (to == Way::ends_at_a_wall) continue;
      const Direction chord = difference(at.state, point.state);
      const bool leaves = metric.inner(chord, way.forward) >= std::abs(metric.inner(chord, point.along));
      if (to == Way::is_free && leaves && metric.norm(chord) <= 2.0 * distance) {
        Direction tangent = metric.inner(at.tangent, chord) >= 0.0 ? at.tangent : reversed(at.tangent);
        return SteppedOff{.state = std::move(at.state), .tangent = std::move(tangent), .distance = distance};
      }
    }
    ++failures;
  }
  return std::nullopt;
}

}  // namespace arcwall
