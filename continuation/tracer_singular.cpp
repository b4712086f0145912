// How the tracer finds the singular points of a step: by the number of negative eigenvalues, and by eigenvalues and λ′
// that come near zero although nothing at the step's ends shows it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "continuation/tracer.hpp"
#include "core/algebra/quadratic_form.hpp"
#include "core/root_find.hpp"

namespace arcwall {

namespace {

constexpr double short_step = 1e-4;  // below which shorter steps show no more [path metric]
constexpr double same_mode = 0.7;    // cosine above which two eigenvectors belong to one mode
constexpr double deep = 0.1;         // what falls below this part of its values at both ends is looked at
constexpr double shallow = 0.6;      // what a parabola does not see fall below this is not
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

// The tangent between two; of a point where K is twice singular its own may be any.
Direction mean(const Metric& metric, const Direction& a, const Direction& b) {
  return unit(metric, {.dx = a.dx + b.dx, .dlambda = a.dlambda + b.dlambda});
}

// Where λ turns between two points beside a place where K is singular: there λ′ is blurred by what K's inverse makes of
// round-off, and its zero with it. Beside it the path is exact, and smooth.
State turning_between(const Metric& metric, const PathPoint& before, const PathPoint& after, const State& otherwise) {
  const Segment segment(metric, before, after);
  const double L = segment.length();
  const auto t =
      cubic_turn(before.state.lambda, before.tangent.dlambda * L, after.state.lambda, after.tangent.dlambda * L);
  return t ? segment.at(*t) : otherwise;
}

}  // namespace

// The first singular points of a step. False if shorter steps will show more.
bool Tracer::find_singular(const PathPoint& to, std::vector<Singular>& found) {
  const Segment segment(metric_, here_, to);
  if (hides_two_zeros(segment, -detector_noise)) return false;
  if (options_.events != EventSearch::locate) return true;
  if (!find_touching_limit(segment, found)) return false;
  if (!found.empty() || !held_ || !to.held) return true;
  const bool turns = signs_.front() * sign_of(detectors_.front().value(to)) < 0;
  return turns ? find_limit_point(to, found) : find_branch_points(to, found);
}

// λ turns. A limit point changes the count by one, right there; what else changes it are branch points: those before it
// come first, those behind it are left to the next step, and those at the same place are reported with it. How near to
// it the count is sure depends on the mesh.
bool Tracer::find_limit_point(const PathPoint& to, std::vector<Singular>& found) {
  const Segment segment(metric_, here_, to);
  Found limit{.what = Found::What::detector, .which = 0, .t = 0.5, .half_width = 0.0};
  auto at = locate(limit, to);
  if (!at) return false;
  const double L = segment.length();
  if (const Index whole = *to.held - *held_; std::abs(whole) == 1) {
    const int expected = change_at_limit(*at);
    if (expected == -whole && L > short_step) return false;
    found.push_back({.found = limit, .at = std::move(*at), .change = whole});
    return true;
  }
  std::optional<PathPoint> before, after;
  const auto count_at = [](const std::optional<PathPoint>& point, Index otherwise) {
    return point ? *point->held : otherwise;
  };
  Index change = 0;
  double distance = 0.0;
  for (const double next : {1e-4, 1e-3, 3e-5}) {
    distance = next;
    const double t0 = limit.t - distance / L, t1 = limit.t + distance / L;
    before = t0 > 0.0 ? beside(segment, t0) : std::nullopt;
    after = t1 < 1.0 ? beside(segment, t1) : std::nullopt;
    if ((t0 > 0.0 && !before) || (t1 < 1.0 && !after)) continue;
    change = count_at(after, *to.held) - count_at(before, *held_);
    if (change % 2 != 0) break;  // else there is a branch point, too
  }
  if (before && *before->held != *held_) return find_branch_points(*before, found);
  found.push_back({.found = limit, .at = std::move(*at), .change = change});
  if (std::abs(change) == 1) return true;
  if (!before || !after) {
    found.back().change = *to.held - *held_;
    return L <= short_step;
  }
  add_branch_point_at_limit(*before, *after, distance / L, found.back());
  return true;
}

// How a limit point alone changes the number of negative eigenvalues: with K t_x = −t_λ F_λ,
//
//   t_xᵀ K t_x = −t_λ F_λᵀ t_x,
//
// which passes zero with t_λ. Zero where F_λᵀ t_x vanishes nearly, as at a branch point.
int Tracer::change_at_limit(const PathPoint& at) {
  constexpr double nearly = 1e-6;
  if (!corrector_.is_at(at.state)) system_.linearize(at.state, workspace(at.state.piece));
  const Vector& F_lambda = corrector_.factorized().equations().F_lambda;
  const double work = F_lambda.dot(at.tangent.dx);
  if (std::abs(work) <= nearly * metric_.dual_norm(F_lambda)) return 0;
  return signs_.front() * work > 0.0 ? -1 : 1;
}

// λ turns and the count does not change by one: two eigenvalues pass zero, or one touches it as the branch of a
// pitchfork goes through it from one side to the other.
void Tracer::add_branch_point_at_limit(const PathPoint& before, const PathPoint& after, double half_width,
                                       Singular& limit) {
  limit.at.state = turning_between(metric_, before, after, limit.at.state);
  limit.at.tangent = mean(metric_, before.tangent, after.tangent);
  limit.at.residual = corrector_.inspect(limit.at.state, metric_, limit.at.tangent).residual;
  const auto pairs = corrector_.near_null(limit.at.state, metric_.weights(), 2);
  const auto second = [](const NearNull& nearest) { return std::abs(nearest.values[1]); };
  SingularPlace place{.point = limit.at, .t = limit.found.t, .half_width = half_width, .change = limit.change};
  place.at_limit = pairs && pairs->values.size() > 1 && after.nearest.values.size() > 1 &&
                   second(*pairs) < 0.1 * second(after.nearest);
  place.touches = !place.at_limit;
  auto branching = std::make_shared<BranchPoint>(branch_point_at(system_, corrector_, metric_, place));
  branching->localised = half_width * std::abs(limit.at.tangent.dlambda);
  branching->discretisation = made_by_nodes(limit.at.state);
  limit.branching = std::move(branching);
  limit.suspected = place.touches;
}

// A point of the path beside a limit point, with a count.
std::optional<PathPoint> Tracer::beside(const Segment& segment, double t) {
  const ChordPlaneConstraint plane(metric_, segment.from().state, segment.to().state, t);
  auto point = correct_onto(plane, segment, t);
  if (!point) return std::nullopt;
  decide_count(*point);
  return point->held ? point : std::nullopt;
}

// The count changes and λ does not turn; or an eigenvalue may have come to zero and gone back.
bool Tracer::find_branch_points(const PathPoint& to, std::vector<Singular>& found) {
  const Segment segment(metric_, here_, to);
  SingularLocator locator(system_, corrector_);
  std::vector<SingularPlace> places;
  if (*to.held != *held_) {
    places = locator.changes(segment, metric_, *held_, *to.held);
    if (places.empty()) return false;
  } else if (dips(segment)) {
    auto touches = locator.touches(segment, metric_, SingularLocator::What::eigenvalue, vanishing_ > 0, 0.0);
    if (!touches) return segment.length() <= short_step;
    places = std::move(*touches);
  }
  for (const SingularPlace& place : places) found.push_back(singular_at(place, segment.chord().dlambda));
  return true;
}

// λ′ may touch zero, or change its sign twice, and look as if it had not: then the cubic through λ at the ends comes
// near.
bool Tracer::find_touching_limit(const Segment& segment, std::vector<Singular>& found) {
  if (!hides_two_zeros(segment, deep)) return true;
  SingularLocator locator(system_, corrector_);
  const auto places = locator.touches(segment, metric_, SingularLocator::What::turning, vanishing_ > 0, detector_noise);
  if (!places || places->size() == 2) return segment.length() <= short_step;
  if (places->empty()) return true;
  const SingularPlace& place = places->front();
  found.push_back({.found = {.what = Found::What::detector, .which = 0, .t = place.t, .half_width = 0.0},
                   .at = point_at(place),
                   .change = place.change,
                   .suspected = place.touches});
  return true;
}

// Whether contacts tied to nodes may make a branch point that the continuum has not.
bool Tracer::made_by_nodes(const State& state) const {
  return options_.node_contacts && system_.multiplier_count(state.piece) > 0;
}

// With the interpolated tangent: its own may be any where K is singular.
PathPoint Tracer::point_at(const SingularPlace& place) {
  CorrectorResult result = corrector_.inspect(place.point.state, metric_, place.point.tangent);
  result.state = place.point.state;
  result.tangent = place.point.tangent;
  result.iterations = place.point.iterations;
  return point_of(std::move(result), here_.tangent);
}

Tracer::Singular Tracer::singular_at(const SingularPlace& place, double chord_dlambda) {
  auto branching = std::make_shared<BranchPoint>(branch_point_at(system_, corrector_, metric_, place));
  branching->localised = place.half_width * std::abs(chord_dlambda);
  PathPoint at = point_at(place);
  branching->discretisation = made_by_nodes(at.state);
  if (system_.multiplier_count(at.state.piece) > 0 && branching->type == BranchType::asymmetric &&
      branching->mode.dx.size() > 0) {
    // A contact may forbid one side.
    const auto open = [&](int sign) {
      return step_off(system_, corrector_, metric_, *branching, sign, start_.distance, options_.guard_tolerance)
          .has_value();
    };
    if (open(1) != open(-1)) branching->type = BranchType::one_sided;
  }
  return {.found = {.what = Found::What::branch_point, .which = 0, .t = place.t, .half_width = 0.0},
          .at = std::move(at),
          .change = place.change,
          .branching = std::move(branching),
          .suspected = place.touches};
}

// K in the middle of a segment, which is found when first asked for.
class Tracer::Middle {
 public:
  Middle(const System& system, const Segment& segment, const Metric& metric, Linearization& workspace)
      : system_(system), segment_(segment), metric_(metric), now_(workspace) {}

  /// The eigenvalue of a mode between those at the ends: Rayleigh's quotient of their mean, whose error is of the
  /// second order. Empty where the round-off of K's entries is greater than `least`, as on the finest meshes.
  std::optional<double> eigenvalue(const Eigen::Ref<const Vector>& from, const Eigen::Ref<const Vector>& to,
                                   double least) {
    if (!std::exchange(known_, true)) system_.linearize(segment_.at(0.5), now_);
    const double sign = metric_.inner_x(from, to) < 0.0 ? -1.0 : 1.0;
    const Vector mean = to + sign * from;
    const double squared = metric_.inner_x(mean, mean);
    if (now_.B.cols() > 0) return mean.dot(product(now_, mean).col(0)) / squared;
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

// Whether an eigenvalue may have come to zero inside the segment and gone back, or two have passed zero in opposite
// senses.
bool Tracer::dips(const Segment& segment) {
  const NearNull &here = segment.from().nearest, &there = segment.to().nearest;
  if (segment.from().state.piece != segment.to().state.piece || here.values.size() == 0) return false;
  Middle middle(system_, segment, metric_, workspace(segment.from().state.piece));
  for (Index j = 0; j < there.values.size(); ++j) {
    const auto i = same_as(there.vectors->col(j), *here.vectors, metric_.weights());
    if (i && *i >= vanishing_ && dips(segment, *i, j, middle)) return true;
    if (!i && j == 0 && rises_from_zero(segment, j)) return true;
  }
  return false;
}

// The parabola through a mode's eigenvalue at the ends and in the middle; before that costs a matrix, the one through
// those at the last three points.
bool Tracer::dips(const Segment& segment, Index here, Index there, Middle& middle) {
  const PathPoint &from = segment.from(), &to = segment.to();
  const double v0 = from.nearest.values[here], v1 = to.nearest.values[there], L = segment.length();
  if ((v0 > 0.0) != (v1 > 0.0)) return true;
  const double sign = v0 > 0.0 ? 1.0 : -1.0, least = std::min(std::abs(v0), std::abs(v1));
  if (least <= nothing * std::max(std::abs(v0), std::abs(v1))) return true;
  if (before_ && before_->state.piece == from.state.piece) {
    const double before = sign * values_before_[here];
    const double length = Segment(metric_, *before_, from).length();
    if (before > 0.0 && least_of_parabola(length, before, sign * v0, L, sign * v1) > shallow * least) return false;
  }
  const auto v = middle.eigenvalue(from.nearest.vectors->col(here), to.nearest.vectors->col(there), least);
  if (!v) return false;
  const double first = least_of_parabola(0.5, sign * v1, sign * *v, 0.5, sign * v0),
               second = least_of_parabola(0.5, sign * v0, sign * *v, 0.5, sign * v1);
  return std::min(first, second) <= deep * least;
}

// Of the modes nearest zero at one point their eigenvalues at another, NaN where those are not nearest there.
Vector Tracer::values_of_modes(const PathPoint& modes_at, const PathPoint& values_at) const {
  const Matrix &modes = *modes_at.nearest.vectors, &others = *values_at.nearest.vectors;
  Vector values(modes.cols());
  for (Index j = 0; j < modes.cols(); ++j) {
    const auto i = same_as(modes.col(j), others, metric_.weights());
    values[j] = i ? values_at.nearest.values[*i] : std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

// A mode that was not among the nearest at the start of the segment: the straight line back from its end.
bool Tracer::rises_from_zero(const Segment& segment, Index there) {
  const PathPoint& to = segment.to();
  const double v1 = to.nearest.values[there];
  const Vector mode = to.nearest.vectors->col(there);
  const double rate = eigenvalue_rate(system_, to.state, to.tangent, mode, mode, workspace(to.state.piece));
  return (v1 > 0.0) == (rate > 0.0) && std::abs(v1) <= segment.length() * std::abs(rate);
}

// The count just behind a singular point, where others may follow before the step's end.
StabilityCount Tracer::count_behind(const PathPoint& beyond, Index change) {
  if (beyond.held && *beyond.held == *held_ + change) return counter_.count(beyond.state, beyond.held);
  if (!after_.unstable) return {};
  const Index unstable = *after_.unstable + change;
  return {.unstable = unstable, .stability = unstable > 0 ? Stability::unstable : Stability::stable};
}

std::vector<Event> Tracer::events_of(const Singular& singular, const PathPoint& at, const PathPoint& beyond,
                                     const StabilityCount& behind, double length) const {
  std::vector<Event> events;
  if (const auto& branching = singular.branching) {
    const double roundoff = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(at.state.lambda);
    events.push_back({.kind = EventKind::branch_point,
                      .state = at.state,
                      .arc = at.arc,
                      .residual = at.residual,
                      .localised = std::max(branching->localised, roundoff),
                      .suspected = singular.suspected,
                      .unstable_before = after_.unstable,
                      .unstable_after = behind.unstable,
                      .branching = branching});
  }
  if (singular.found.what == Found::What::detector) {
    events.push_back(event_of(singular.found, at, beyond, behind, length));
    events.back().suspected = singular.suspected && !singular.branching;
  }
  return events;
}

}  // namespace arcwall
