#include "continuation/events/singular_locator.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>

#include "continuation/path_tolerances.hpp"
#include "core/root_find.hpp"

namespace arcwall {

namespace {

constexpr double short_segment = 1e-4;  // on which the nearest of the path's own points has to do [path metric]
constexpr double on_the_path = 1e-8;    // relative residual of an interpolated point
constexpr double touching = 1e-8;       // what falls below this part of its value at a distance of 1 touches zero
constexpr double at_the_end = 1e-5;     // a touch so near behind the end of a segment belongs to it [path metric]
constexpr double resolved = 1e-12;      // likewise, of what is below zero beyond doubt

// What a mode's eigenvalue, or λ′, looks like near its least value.
struct Valley {
  double t = 0.0;       // place
  double value = 0.0;   // there; negative: on the other side of zero
  double at_one = 0.0;  // extrapolated to a distance of 1 in the path metric
};

// The least value of f on [a, b], which has one there, by golden section.
double least_at(const std::function<double(double)>& f, double a, double b) {
  constexpr double golden = 0.6180339887498949, narrow = 1e-10;
  double left = b - golden * (b - a), right = a + golden * (b - a), f_left = f(left), f_right = f(right);
  while (b - a > narrow) {
    if (f_left < f_right) {
      b = right;
      right = left;
      f_right = f_left;
      f_left = f(left = b - golden * (b - a));
    } else {
      a = left;
      left = right;
      f_left = f_right;
      f_right = f(right = a + golden * (b - a));
    }
  }
  return f_left < f_right ? left : right;
}

// Directions that Q of (1) below makes of columns, with t_λ taken not negative.
Matrix without_fold(const Matrix& columns, const Metric& metric, const Direction& t) {
  const double along = std::abs(t.dlambda) / metric.lambda_scale();
  return columns - t.dx * (metric.weights().cwiseProduct(t.dx).transpose() * columns) / (1.0 + along);
}

}  // namespace

// Four points of the path around a place and, by the cubic through its values there, a smooth symmetric matrix S that
// is singular in the places looked for. For branch points it is
//
//   S = (Cᵀ W K⁻¹ W C)⁻¹,     C = Q B,     Q = I − t_x t_xᵀ W/(1 + t_λ)                                         (1)
//
// t the unit tangent, t_λ over λ₀ and not negative at the first point, B the critical modes at one of the points. Q has
// the eigenvalue t_λ along t_x: at a limit point it takes out of K⁻¹ what is infinite there.
class SingularLocator::Level {
 public:
  static constexpr std::size_t nodes = 4;

  Level(double centre, double spread, std::vector<Sample> samples, std::array<Matrix, nodes> values)
      : centre_(centre), spread_(spread), samples_(std::move(samples)), values_(std::move(values)) {}

  double centre() const { return centre_; }
  double spread() const { return spread_; }

  /// Ascending.
  Vector eigenvalues(double t) const {
    const auto weight = weights(t);
    Matrix S = weight[0] * values_[0];
    for (std::size_t i = 1; i < nodes; ++i) S += weight[i] * values_[i];
    return Eigen::SelfAdjointEigenSolver<Matrix>(S, Eigen::EigenvaluesOnly).eigenvalues();
  }

  Index negative(double t) const { return (eigenvalues(t).array() < 0.0).count(); }

  PathPoint point(double t, const Metric& metric) const {
    const auto weight = weights(t);
    PathPoint point;
    point.state = samples_[0].state;
    point.tangent = samples_[0].tangent;
    point.state.x *= weight[0];
    point.state.lambda *= weight[0];
    point.tangent.dx *= weight[0];
    point.tangent.dlambda *= weight[0];
    for (std::size_t i = 1; i < nodes; ++i) {
      point.state.x += weight[i] * samples_[i].state.x;
      point.state.lambda += weight[i] * samples_[i].state.lambda;
      point.tangent.dx += weight[i] * samples_[i].tangent.dx;
      point.tangent.dlambda += weight[i] * samples_[i].tangent.dlambda;
    }
    for (const Sample& sample : samples_) point.iterations = std::max(point.iterations, sample.iterations);
    point.tangent = unit(metric, std::move(point.tangent));
    return point;
  }

 private:
  // Values of Lagrange's polynomials on the nodes.
  std::array<double, nodes> weights(double t) const {
    std::array<double, nodes> value;
    for (std::size_t i = 0; i < nodes; ++i) {
      value[i] = 1.0;
      for (std::size_t j = 0; j < nodes; ++j)
        if (j != i) value[i] *= (t - samples_[j].t) / (samples_[i].t - samples_[j].t);
    }
    return value;
  }

  double centre_, spread_;
  std::vector<Sample> samples_;
  std::array<Matrix, nodes> values_;
};

// Newton's method is at a loss on the branch point itself, where K is singular, and the nearer the less sure. So S is
// interpolated from points at a distance, which shrinks from level to level as long as all goes well.
std::vector<SingularPlace> SingularLocator::changes(const Segment& segment, const Metric& metric, Index before,
                                                    Index after) {
  seen_.clear();
  const auto bracket = bisect(segment, metric, before, after);
  const bool is_short = segment.length() <= short_segment;
  // No point of the path between the ends: they may lie on different branches, which shorter steps will show.
  if (!bracket) return {};
  const Index order = std::max(bracket->before, bracket->after);
  double t = 0.5 * (bracket->from + bracket->to), half_width = 0.5 * (bracket->to - bracket->from);
  std::vector<SingularPlace> found;
  for (const double spread : {0.04, 0.01}) {
    const auto level = level_at(segment, metric, t, spread, What::eigenvalue, order);
    if (!level) break;
    auto next = roots(*level, segment, metric, *bracket);
    if (next.empty() || std::abs(next.front().t - t) > 2.0 * half_width) break;
    half_width = std::max(1e-3 * std::abs(next.front().t - t), 1e-12);
    t = next.front().t;
    found = std::move(next);
  }
  // Where the path bends too sharply to be interpolated, shorter steps will show more, and at last the nearest of its
  // own points has to do.
  if (found.empty() || half_width > 0.01 || !lies_on_path(found.front().point, metric))
    return is_short ? nearest_sample(*bracket) : std::vector<SingularPlace>{};
  for (SingularPlace& place : found) place.half_width = half_width;
  return found;
}

// A few halvings by the count, towards the first change.
std::optional<SingularLocator::Bracket> SingularLocator::bisect(const Segment& segment, const Metric& metric,
                                                                Index before, Index after) {
  Bracket bracket{.before = before, .after = after};
  for (int halving = 0; halving < 4; ++halving) {
    const double t = 0.5 * (bracket.from + bracket.to);
    const auto sample = sample_at(segment, metric, t);
    if (!sample && halving == 0) return std::nullopt;
    if (!sample || !sample->negative) break;
    if (*sample->negative == before) {
      bracket.from = t;
    } else {
      bracket.to = t;
      bracket.after = *sample->negative;
    }
  }
  return bracket;
}

// Zeros of the eigenvalues of S in the bracket, as many as the number of negative ones changes by.
std::vector<SingularPlace> SingularLocator::roots(const Level& level, const Segment& segment, const Metric& metric,
                                                  const Bracket& bracket) const {
  constexpr double reach = 3.0;  // of the spread
  const double ignored = coincidence_tolerance / segment.length();
  const double from = std::max({bracket.from, ignored, level.centre() - reach * level.spread()});
  const double to = std::min(bracket.to, level.centre() + reach * level.spread());
  const Vector first = level.eigenvalues(from), last = level.eigenvalues(to);
  const Index n0 = (first.array() < 0.0).count(), n1 = (last.array() < 0.0).count();
  const bool falls = bracket.after > bracket.before;
  if (n0 == n1 || (n1 > n0) != falls) return {};
  std::vector<double> zeros;
  for (Index j = std::min(n0, n1); j < std::max(n0, n1); ++j) {
    const auto eigenvalue = [&](double t) -> std::optional<double> { return level.eigenvalues(t)[j]; };
    if (const auto root = bracketed_root(eigenvalue, from, first[j], to, last[j], 1e-14)) zeros.push_back(root->at);
  }
  std::sort(zeros.begin(), zeros.end());
  std::vector<SingularPlace> places;
  for (const double t : zeros) {
    if (!places.empty() && (t - places.back().t) * segment.length() <= coincidence_tolerance) {
      ++places.back().multiplicity;
      places.back().change += falls ? 1 : -1;
    } else {
      places.push_back({.point = level.point(t, metric), .t = t, .change = falls ? 1 : -1});
    }
  }
  return places;
}

std::vector<SingularPlace> SingularLocator::nearest_sample(const Bracket& bracket) const {
  const double t = 0.5 * (bracket.from + bracket.to);
  const auto nearer = [t](const Sample& a, const Sample& b) { return std::abs(a.t - t) < std::abs(b.t - t); };
  const auto nearest = std::min_element(seen_.begin(), seen_.end(), nearer);
  if (nearest == seen_.end()) return {};
  const Index change = bracket.after - bracket.before;
  SingularPlace place{.point = {},
                      .t = nearest->t,
                      .half_width = std::abs(nearest->t - t) + 0.5 * (bracket.to - bracket.from),
                      .change = change,
                      .multiplicity = std::abs(change)};
  place.point.state = nearest->state;
  place.point.tangent = nearest->tangent;
  place.point.iterations = nearest->iterations;
  return {place};
}

std::optional<std::vector<SingularPlace>> SingularLocator::touches(const Segment& segment, const Metric& metric,
                                                                   What what, bool from_singular, double noise) {
  constexpr double margin = 0.02;  // what is at the very end is seen from both sides
  const double L = segment.length();
  std::vector<SingularPlace> none;
  std::optional<Level> level;
  Valley valley{.t = 0.5};
  double reach = 0.5 + margin;
  Index outside = 0;
  const auto side = [&](double t) {  // least magnitude of an eigenvalue, negative where the count is another
    const Vector values = level->eigenvalues(t);
    const double least = values.cwiseAbs().minCoeff();
    return (values.array() < 0.0).count() == outside ? least : -least;
  };
  for (const double spread : {0.25, 0.06, 0.01}) {
    level = level_at(segment, metric, valley.t, spread, what, 0);
    if (!level) return std::nullopt;
    const double first = from_singular ? 10.0 * coincidence_tolerance / L : -margin;
    const double from = std::max(first, valley.t - reach), to = std::min(1.0 + margin, valley.t + reach);
    outside = level->negative(from);
    if (level->negative(to) != outside) return std::nullopt;
    constexpr int cells = 60;
    int lowest = 0;
    double least = infinity;
    for (int i = 0; i <= cells; ++i)
      if (const double value = side(from + (to - from) * i / cells); value < least) {
        least = value;
        lowest = i;
      }
    if (lowest == 0 || lowest == cells) return none;
    valley.t = least_at(side, from + (to - from) * (lowest - 1) / cells, from + (to - from) * (lowest + 1) / cells);
    valley.value = side(valley.t);
    reach = 2.0 * spread;
    // Two places far apart: shorter steps part them.
    if (valley.value < 0.0 && (side(valley.t - reach) < 0.0 || side(valley.t + reach) < 0.0)) return std::nullopt;
  }
  // Like s near a crossing of two eigenvalues, like s² near the least value of one.
  const double s = level->spread(), near = std::abs(side(valley.t + s) - valley.value),
               far = std::abs(side(valley.t + 2.0 * s) - valley.value);
  const bool crossing = far < 3.0 * near;
  valley.at_one = near / (crossing ? s * L : s * s * L * L);
  const double owed = at_the_end / L;  // the place is not sure, but one of two steps that meet there must report it
  if (valley.value > std::max(touching * valley.at_one, noise) || valley.t <= owed || valley.t > 1.0 + owed)
    return none;

  const auto place_at = [&](double t) {
    return SingularPlace{.point = level->point(t, metric), .t = t, .half_width = 1e-12};
  };
  std::vector<SingularPlace> places;
  const auto value = [&](double t) -> std::optional<double> { return side(t); };
  if (valley.value < -std::max(resolved * valley.at_one, noise)) {
    const double left = valley.t - 2.0 * s, right = valley.t + 2.0 * s;
    const auto first = bracketed_root(value, left, side(left), valley.t, valley.value, 1e-14);
    const auto second = bracketed_root(value, valley.t, valley.value, right, side(right), 1e-14);
    if (!first || !second) return std::nullopt;
    if ((second->at - first->at) * L > coincidence_tolerance) {
      const Index change = level->negative(valley.t) - outside;
      places = {place_at(first->at), place_at(second->at)};
      places[0].change = change;
      places[1].change = -change;
      places[0].multiplicity = places[1].multiplicity = std::abs(change);
      return places;
    }
  }
  places = {place_at(valley.t)};
  places[0].multiplicity = std::max<Index>(
      1, (level->eigenvalues(valley.t).array().abs() <= std::max(touching, 2.0 * coincidence_tolerance) * valley.at_one)
             .count());
  places[0].touches = places[0].multiplicity == 1;
  return places;
}

// The path across the chord at t. A point far from the interpolated one lies on another branch.
std::optional<SingularLocator::Sample> SingularLocator::sample_at(const Segment& segment, const Metric& metric,
                                                                  double t) {
  const double L = segment.length();
  const ChordPlaneConstraint plane(metric, segment.from().state, segment.to().state, t);
  const State guess = segment.at(t);
  const Direction& forward = segment.from().tangent;
  CorrectorResult at = corrector_.correct(guess, plane, metric, forward, 1e-2 * L);
  if (!at.converged() || metric.distance(at.state, guess) > 0.05 * L) return std::nullopt;
  if (!at.negative) at.negative = corrector_.count_here(at.state, at.nearest);
  if (metric.inner(at.tangent, forward) < 0.0) at.tangent = reversed(std::move(at.tangent));
  Sample sample{.t = t,
                .state = std::move(at.state),
                .tangent = std::move(at.tangent),
                .iterations = at.iterations,
                .negative = at.negative};
  seen_.push_back(sample);
  return sample;
}

std::optional<SingularLocator::Level> SingularLocator::level_at(const Segment& segment, const Metric& metric,
                                                                double centre, double spread, What what, Index order) {
  constexpr double margin = 2e-3;  // the ends may be singular
  const double half = 1.5 * spread + margin, middle = std::clamp(centre, half, 1.0 - half);
  const std::array<double, Level::nodes> offsets{-1.5, -0.5, 0.5, 1.5};
  const std::array<std::size_t, Level::nodes> inner_first{1, 2, 0, 3};  // the modes are those of the first
  std::vector<std::optional<Sample>> samples(Level::nodes);
  std::array<Matrix, Level::nodes> values;
  Matrix modes;
  for (const std::size_t i : inner_first) {
    samples[i] = sample_at(segment, metric, middle + spread * offsets[i]);
    if (!samples[i]) return std::nullopt;
    const auto value = test_matrix(*samples[i], metric, what, order, modes);
    if (!value || !value->allFinite()) return std::nullopt;
    values[i] = *value;
  }
  std::vector<Sample> all;
  for (auto& sample : samples) all.push_back(std::move(*sample));
  return Level(middle, spread, std::move(all), std::move(values));
}

// S of (1) at the sample reached last; `modes` are set if they are empty.
std::optional<Matrix> SingularLocator::test_matrix(const Sample& sample, const Metric& metric, What what, Index order,
                                                   Matrix& modes) {
  if (what == What::turning) return Matrix::Constant(1, 1, sample.tangent.dlambda / metric.lambda_scale());
  if (corrector_.factorized().equations().B.cols() > 0) {
    // Of the eigenvalues nearest zero: the greatest negative one if `order` is negative already, else the least
    // positive.
    constexpr Index nearest = 4;
    const auto eigen = corrector_.near_null(sample.state, metric.weights(), nearest);
    if (!eigen || !sample.negative) return std::nullopt;
    const bool negative = *sample.negative >= order;
    double value = 0.0;
    for (const double candidate : eigen->values)
      if ((candidate < 0.0) == negative && (value == 0.0 || std::abs(candidate) < std::abs(value))) value = candidate;
    if (value == 0.0) return std::nullopt;
    return Matrix::Constant(1, 1, value);
  }
  if (modes.cols() == 0) modes = critical_modes(sample, metric);
  if (modes.cols() == 0) return std::nullopt;
  const Matrix C = metric.weights().asDiagonal() * without_fold(modes, metric, sample.tangent);
  const auto moved = corrector_.responses(C);
  if (!moved) return std::nullopt;
  const Matrix inverse = C.transpose() * *moved;
  return Matrix((0.5 * (inverse + inverse.transpose())).inverse());
}

// The modes at the sample reached last whose eigenvalues, with Q of (1), are near zero.
Matrix SingularLocator::critical_modes(const Sample& sample, const Metric& metric) const {
  constexpr Index nearest = 4;
  constexpr double near = 50.0;  // times the least eigenvalue
  const Vector& W = metric.weights();
  const auto pairs =
      corrector_.near_null(sample.state, W, nearest, Convergence::loose);  // (1) holds for any modes near these
  if (!pairs || pairs->vectors->cols() == 0 || !pairs->vectors->allFinite()) return {};
  const Matrix C = W.asDiagonal() * without_fold(*pairs->vectors, metric, sample.tangent);
  const auto moved = corrector_.responses(C);
  if (!moved) return {};
  const Matrix inverse = C.transpose() * *moved;
  const Eigen::SelfAdjointEigenSolver<Matrix> axes(0.5 * (inverse + inverse.transpose()));
  const Vector size = axes.eigenvalues().cwiseAbs();
  std::vector<Index> critical;
  for (Index j = 0; j < size.size(); ++j)
    if (near * size[j] >= size.maxCoeff()) critical.push_back(j);
  return *pairs->vectors * axes.eigenvectors()(Eigen::all, critical);
}

bool SingularLocator::lies_on_path(const PathPoint& point, const Metric& metric) {
  return corrector_.inspect(point.state, metric, point.tangent).residual <= on_the_path;
}

}  // namespace arcwall
