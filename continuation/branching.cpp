#include "continuation/branching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/near_null.hpp"
#include "core/root_find.hpp"

namespace arcwall {

namespace {

constexpr double between = 1e-9;  // penetration between contacts, in the scale of guards, that is let pass
constexpr double noise = 1e-6;    // ratio of two coefficients below which the first is zero

// Values of Lagrange's polynomials on `nodes` at t.
std::array<double, 4> lagrange(const std::array<double, 4>& nodes, double t) {
  std::array<double, 4> value;
  for (std::size_t i = 0; i < 4; ++i) {
    value[i] = 1.0;
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) value[i] *= (t - nodes[j]) / (nodes[i] - nodes[j]);
  }
  return value;
}

// ψᵀ (J(x + h d) − J(x − h d)) φ / 2h, ψ and φ the left and right null vectors of J = ∂F/∂x: how fast the eigenvalue
// changes along a direction, and the round-off of that.
struct Rate {
  double value = 0.0, roundoff = 0.0;
};

Rate eigenvalue_rate(const System& system, const State& state, const Direction& d, const Vector& left,
                     const Vector& mode) {
  constexpr double h = 1e-3;  // [path metric]
  Linearization now;
  Rate rate;
  for (const double sign : {1.0, -1.0}) {
    system.linearize(moved(state, d, sign * h), now);
    rate.value += sign * left.dot(product(now, mode).col(0)) / (2.0 * h);
  }
  const Vector size = left.head(now.K.cols()).cwiseAbs();
  rate.roundoff = 10.0 * std::numeric_limits<double>::epsilon() *
                  size.dot(now.K.cwiseAbs().selfadjointView<Eigen::Lower>() * size) / h;
  return rate;
}

}  // namespace

// Newton's method is at a loss on the branch point itself, where K is singular, and the nearer the less sure. So the
// eigenvalue is interpolated from points at a distance, which shrinks from level to level as long as all goes well.
std::optional<PathPoint> BranchPointLocator::locate(const Segment& segment, const Metric& metric, Index before,
                                                    Index after, BranchPoint& out) {
  const Index order = std::max(before, after);  // the eigenvalue, counted from the least, that changes sign
  constexpr double short_segment = 1e-4;        // [path metric]
  seen_.clear();
  Estimate best = bisect(segment, metric, order, after > before);
  // No point of the path between the ends: they may lie on different branches, which shorter steps will show.
  if (best.uncertainty == 1.0 && segment.length() > short_segment) return std::nullopt;
  for (const double spread : {0.04, 0.01}) {
    auto next = interpolate(segment, metric, best.t, spread, order);
    if (!next || std::abs(next->t - best.t) > best.uncertainty) break;
    next->uncertainty = std::max(1e-3 * std::abs(next->t - best.t), 1e-12);
    best = std::move(*next);
  }
  out.localised = best.uncertainty * std::abs(segment.chord().dlambda);
  PathPoint point = std::move(best.point);
  // Where the path bends too sharply to be interpolated, shorter steps will show more, and at last the nearest of its
  // own points has to do.
  constexpr double on_the_path = 1e-8;
  if (!(corrector_.inspect(point.state, metric, point.tangent).residual <= on_the_path) || best.uncertainty > 0.01) {
    if (segment.length() > short_segment) return std::nullopt;
    const auto nearest = std::min_element(seen_.begin(), seen_.end(), [&](const Seen& a, const Seen& b) {
      return std::abs(a.t - best.t) < std::abs(b.t - best.t);
    });
    if (nearest == seen_.end()) return std::nullopt;
    out.localised = std::max(out.localised, std::abs((nearest->t - best.t) * segment.chord().dlambda));
    point.state = nearest->sample.state;
    point.tangent = nearest->sample.tangent;
  }

  const Vector weights = system_.weights(point.state.piece);
  corrector_.inspect(point.state, metric, point.tangent);
  const auto multiplicity = static_cast<Index>(std::abs(after - before));
  const auto modes = corrector_.near_null(weights, multiplicity);
  out.state = point.state;
  out.along = point.tangent;
  out.multiplicity = multiplicity;
  if (!modes || modes->vectors.cols() < multiplicity) return point;
  Vector left = Vector::Zero(weights.size());
  left.head(modes->vectors.rows()) = modes->vectors.col(0);
  const auto right = corrector_.right_null(left);
  if (!right) return point;
  Vector mode = *right;
  Index largest = 0;
  mode.cwiseProduct(weights.cwiseSqrt()).cwiseAbs().maxCoeff(&largest);
  if (mode[largest] < 0.0) mode = -mode;  // the mode's largest component is positive
  out.mode = {.dx = mode, .dlambda = 0.0};

  // Algebraic branching equation a α² + 2 b α β = 0 for tangents α φ + β t, t the tangent we came along:
  //   α = 0 (the old branch) or α : β = −2 b : a.
  const Rate a = eigenvalue_rate(system_, point.state, out.mode, left, mode);
  const Rate b = eigenvalue_rate(system_, point.state, out.along, left, mode);
  const bool symmetric = std::abs(a.value) <= std::max(noise * std::abs(b.value), a.roundoff);
  out.type = symmetric ? BranchType::symmetric : BranchType::asymmetric;
  Direction other = out.mode;
  if (!symmetric) {
    const double beta = -a.value / (2.0 * b.value);
    other.dx += beta * out.along.dx;
    other.dlambda += beta * out.along.dlambda;
  }
  out.other = unit(metric, std::move(other));
  return point;
}

// A few halvings by the sign of the eigenvalue, then the straight line through the ends of what is left.
BranchPointLocator::Estimate BranchPointLocator::bisect(const Segment& segment, const Metric& metric, Index order,
                                                        bool falls) {
  struct End {
    double t;
    Sample sample;
  };
  std::optional<End> low, high;
  double from = 0.0, to = 1.0;
  for (int halving = 0; halving < 4; ++halving) {
    const double t = 0.5 * (from + to);
    auto sample = sample_at(segment, metric, t, order);
    if (!sample) break;
    const bool before = (sample->eigenvalue > 0.0) == falls;
    (before ? low : high) = End{.t = t, .sample = std::move(*sample)};
    (before ? from : to) = t;
  }
  // The point is one of the path's own: the equations hold there, if not quite the vanishing of the eigenvalue.
  Estimate estimate{.t = 0.5 * (from + to), .uncertainty = to - from, .point = {}};
  if (low && high) {
    const double v0 = low->sample.eigenvalue, v1 = high->sample.eigenvalue;
    estimate.t = low->t + (high->t - low->t) * v0 / (v0 - v1);
  }
  if (const auto& end = low ? low : high) {
    estimate.point.state = end->sample.state;
    estimate.point.tangent = end->sample.tangent;
    estimate.point.iterations = end->sample.iterations;
  } else {
    estimate.point.state = segment.from().state;
    estimate.point.tangent = segment.from().tangent;
  }
  return estimate;
}

// The zero of the cubic through four samples around t, and the state there by the same cubic.
std::optional<BranchPointLocator::Estimate> BranchPointLocator::interpolate(const Segment& segment,
                                                                            const Metric& metric, double t,
                                                                            double spread, Index order) {
  const double middle = std::clamp(t, 1.5 * spread, 1.0 - 1.5 * spread);
  std::array<double, 4> nodes;
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < 4; ++i) {
    nodes[i] = middle + spread * (double(i) - 1.5);
    auto sample = sample_at(segment, metric, nodes[i], order);
    if (!sample) return std::nullopt;
    samples.push_back(std::move(*sample));
  }
  const auto eigenvalue = [&](double s) -> std::optional<double> {
    const auto weight = lagrange(nodes, s);
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) sum += weight[i] * samples[i].eigenvalue;
    return sum;
  };
  const double low = std::max(0.0, nodes[0] - spread), high = std::min(1.0, nodes[3] + spread);
  const auto root = bracketed_root(eigenvalue, low, *eigenvalue(low), high, *eigenvalue(high), 1e-14);
  if (!root) return std::nullopt;

  Estimate estimate{.t = root->at, .uncertainty = 1.0, .point = {}};
  PathPoint& point = estimate.point;
  point.state = {.x = Vector::Zero(samples[0].state.x.size()), .lambda = 0.0, .piece = samples[0].state.piece};
  point.tangent = {.dx = Vector::Zero(point.state.x.size()), .dlambda = 0.0};
  const auto weight = lagrange(nodes, root->at);
  for (std::size_t i = 0; i < 4; ++i) {
    point.state.x += weight[i] * samples[i].state.x;
    point.state.lambda += weight[i] * samples[i].state.lambda;
    point.tangent.dx += weight[i] * samples[i].tangent.dx;
    point.tangent.dlambda += weight[i] * samples[i].tangent.dlambda;
    point.iterations = std::max(point.iterations, samples[i].iterations);
  }
  point.tangent = unit(metric, std::move(point.tangent));
  return estimate;
}

// The path across the chord at t. A point far from the interpolated one lies on another branch.
std::optional<BranchPointLocator::Sample> BranchPointLocator::sample_at(const Segment& segment, const Metric& metric,
                                                                        double t, Index order) {
  const double L = segment.length();
  const PlaneConstraint plane(metric, segment.from().state, segment.chord(), t * L * L);
  const State guess = segment.at(t);
  CorrectorResult at = corrector_.correct(guess, plane, metric, segment.from().tangent, 1e-2 * L);
  if (!at.converged() || metric.norm(difference(at.state, guess)) > 0.05 * L) return std::nullopt;
  auto sample = sampled(std::move(at), metric, segment.from().tangent, order);
  if (sample) seen_.push_back({.t = t, .sample = *sample});
  return sample;
}

// Of the eigenvalues nearest zero: the greatest negative one if `order` is negative already, else the least positive.
std::optional<BranchPointLocator::Sample> BranchPointLocator::sampled(CorrectorResult at, const Metric& metric,
                                                                      const Direction& forward, Index order) {
  constexpr Index nearest = 4;
  if (!at.converged() || !at.negative) return std::nullopt;
  const auto eigen = corrector_.near_null(system_.weights(at.state.piece), nearest);
  if (!eigen) return std::nullopt;
  const bool negative = *at.negative >= order;
  double value = 0.0;
  for (const double candidate : eigen->values)
    if ((candidate < 0.0) == negative && (value == 0.0 || std::abs(candidate) < std::abs(value))) value = candidate;
  if (value == 0.0) return std::nullopt;
  if (metric.inner(at.tangent, forward) < 0.0) at.tangent = reversed(std::move(at.tangent));
  return Sample{
      .state = std::move(at.state), .tangent = std::move(at.tangent), .eigenvalue = value, .iterations = at.iterations};
}

std::optional<SteppedOff> step_off(const System& system, Corrector& corrector, const Metric& metric,
                                   const BranchPoint& point, int sign, double distance, double guard_tolerance) {
  constexpr int halvings = 12;
  for (int attempt = 0; attempt < halvings; ++attempt, distance *= 0.5) {
    const double offset = sign * distance * metric.inner(point.other, point.mode);
    const PlaneConstraint plane(metric, point.state, point.mode, offset);
    CorrectorResult at =
        corrector.correct(moved(point.state, point.other, sign * distance), plane, metric, point.other, distance);
    if (!at.converged()) continue;
    at.state.piece = system.settled(at.state);
    if (system.guard_count(at.state.piece) > 0 && (system.guards(at.state).array() < -guard_tolerance).any()) continue;
    if (!system.admissible(at.state, -between)) continue;
    const Direction chord = difference(at.state, point.state);
    if (metric.norm(chord) > 2.0 * distance) continue;
    Direction tangent = metric.inner(at.tangent, chord) >= 0.0 ? at.tangent : reversed(at.tangent);
    return SteppedOff{.state = std::move(at.state), .tangent = std::move(tangent)};
  }
  return std::nullopt;
}

}  // namespace arcwall
