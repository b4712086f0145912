#include "continuation/events/eigenvalue_touch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "continuation/events/branch_point.hpp"
#include "core/algebra/quadratic_form.hpp"

namespace arcwall {

namespace {

constexpr double same_mode = 0.7;    // cosine above which two eigenvectors belong to one mode
constexpr double deep_dip = 0.1;     // what falls below this part of its values at both ends is looked at
constexpr double shallow_dip = 0.6;  // what a parabola does not see fall below this is not
constexpr double nothing = 1e-4;     // an eigenvalue below this part of its other value may touch zero right there

// The vector among the columns that belongs to the same mode.
std::optional<Index> same_as(const Eigen::Ref<const Vector>& mode, const Matrix& vectors, const Vector& weights) {
  if (vectors.rows() != mode.size()) return std::nullopt;
  for (Index j = 0; j < vectors.cols(); ++j)
    if (std::abs(vectors.col(j).dot(weights.cwiseProduct(mode))) > same_mode) return j;
  return std::nullopt;
}

// The least value in [0, to] of the parabola through (−before, v₋), (0, v₀), (to, v₁).
double least_of_parabola(double before, double v_before, double v0, double to, double v1) {
  const double left = (v0 - v_before) / before, right = (v1 - v0) / to;
  const double curvature = (right - left) / (before + to), slope = right - curvature * to;
  const double t = curvature > 0.0 ? std::clamp(-0.5 * slope / curvature, 0.0, to) : 0.0;
  return std::min({v0, v1, v0 + t * (slope + t * curvature)});
}

// K in the middle of a segment, which is found when first asked for.
class MidpointStiffness {
 public:
  MidpointStiffness(const System& system, const Segment& segment, const Metric& metric, Linearization& workspace)
      : system_(system), segment_(segment), metric_(metric), now_(workspace) {}

  /// The eigenvalue of a mode between those at the ends: Rayleigh's quotient of their mean, whose error is of the
  /// second order. Empty where the round-off of K's entries is greater than `least`, as on the finest meshes.
  std::optional<double> eigenvalue(const Eigen::Ref<const Vector>& from, const Eigen::Ref<const Vector>& to,
                                   double least) {
    if (!std::exchange(known_, true)) system_.linearize(segment_.at(0.5), now_);
    const double sign = metric_.inner_x(from, to) < 0.0 ? -1.0 : 1.0;
    const Vector mean = to + sign * from;
    const double squared = metric_.inner_x(mean, mean);
    if (!now_.is_symmetric()) return mean.dot(product(now_, mean).col(0)) / squared;
    const QuadraticForm form = quadratic_form(now_.K, mean);
    return form.roundoff > least * squared ? std::nullopt : std::optional(form.value / squared);
  }

 private:
  const System& system_;
  const Segment& segment_;
  const Metric& metric_;
  Linearization& now_;
  bool known_ = false;
};

// The parabola through a mode's eigenvalue at the ends and in the middle; before that costs a matrix, the one through
// those at the last three points.
bool mode_may_touch_zero(const StepOrigin& origin, const Segment& segment, Index here, Index there,
                         MidpointStiffness& midpoint) {
  const PathPoint &from = segment.from(), &to = segment.to();
  const double v0 = from.nearest.values[here], v1 = to.nearest.values[there], L = segment.length();
  if ((v0 > 0.0) != (v1 > 0.0)) return true;
  const double sign = v0 > 0.0 ? 1.0 : -1.0, least = std::min(std::abs(v0), std::abs(v1));
  if (least <= nothing * std::max(std::abs(v0), std::abs(v1))) return true;
  if (const auto& last = origin.from.before; last && last->state.active_set == from.state.active_set) {
    const double before = sign * origin.from.eigenvalues_before[here];
    const double length = Segment(origin.metric, *last, from).length();
    if (before > 0.0 && least_of_parabola(length, before, sign * v0, L, sign * v1) > shallow_dip * least) return false;
  }
  const auto v = midpoint.eigenvalue(from.nearest.vectors->col(here), to.nearest.vectors->col(there), least);
  if (!v) return false;
  const double first = least_of_parabola(0.5, sign * v1, sign * *v, 0.5, sign * v0),
               second = least_of_parabola(0.5, sign * v0, sign * *v, 0.5, sign * v1);
  return std::min(first, second) <= deep_dip * least;
}

// A mode that was not among the nearest at the start of the segment: the straight line back from its end.
bool rises_from_zero(TraceTools& tools, const Segment& segment, Index there) {
  const PathPoint& to = segment.to();
  const double v1 = to.nearest.values[there];
  const Vector mode = to.nearest.vectors->col(there);
  const double rate =
      eigenvalue_rate(tools.system, to.state, to.tangent, mode, mode, tools.workspace(to.state.active_set));
  return (v1 > 0.0) == (rate > 0.0) && std::abs(v1) <= segment.length() * std::abs(rate);
}

}  // namespace

bool may_touch_zero(TraceTools& tools, const StepOrigin& origin, const Segment& segment) {
  const NearNull &here = segment.from().nearest, &there = segment.to().nearest;
  if (segment.from().state.active_set != segment.to().state.active_set || here.values.size() == 0) return false;
  MidpointStiffness midpoint(tools.system, segment, origin.metric, tools.workspace(segment.from().state.active_set));
  for (Index j = 0; j < there.values.size(); ++j) {
    const auto i = same_as(there.vectors->col(j), *here.vectors, origin.metric.weights());
    const bool counts = i && *i >= origin.from.zero_eigenvalues;
    if (counts && mode_may_touch_zero(origin, segment, *i, j, midpoint)) return true;
    if (!i && j == 0 && rises_from_zero(tools, segment, j)) return true;
  }
  return false;
}

Vector eigenvalues_of_modes(const PathPoint& modes_at, const PathPoint& values_at, const Metric& metric) {
  const Matrix &modes = *modes_at.nearest.vectors, &others = *values_at.nearest.vectors;
  Vector values(modes.cols());
  for (Index j = 0; j < modes.cols(); ++j) {
    const auto i = same_as(modes.col(j), others, metric.weights());
    values[j] = i ? values_at.nearest.values[*i] : std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

}  // namespace arcwall
