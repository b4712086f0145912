// Where the number of negative eigenvalues changes inside a segment.
#include "continuation/events/singular_locator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/path_tolerances.hpp"
#include "core/root_find.hpp"

namespace arcwall {

namespace {

constexpr double short_segment = 1e-4;  // on which the nearest of the path's own points has to do [path metric]
constexpr double on_the_path = 1e-8;    // relative residual of an interpolated point, or …
constexpr double as_converged = 10.0;   // … over the greatest of the converged points beside it, which is round-off

// An interval of the chord in which the count changes.
struct CountBracket {
  double from = 0.0, to = 1.0;
  Index before, after;

  double middle() const { return 0.5 * (from + to); }

  /// How many eigenvalues change their sign.
  Index changes() const { return std::abs(after - before); }
};

// Halves a bracket once more; false where no sample or no count is to be had.
bool halve(SegmentSamples& on, CountBracket& bracket) {
  const double t = bracket.middle();
  const auto sample = sample_at(on, t);
  if (!sample || !sample->negative) return false;
  if (*sample->negative == bracket.before) {
    bracket.from = t;
  } else {
    bracket.to = t;
    bracket.after = *sample->negative;
  }
  return true;
}

// A few halvings by the count, towards the first change.
std::optional<CountBracket> bisect(SegmentSamples& on, Index before, Index after) {
  CountBracket bracket{.before = before, .after = after};
  for (int halving = 0; halving < 4 && halve(on, bracket); ++halving) {
  }
  const bool none = on.seen.empty();
  return none ? std::nullopt : std::optional(bracket);
}

// Zeros of the eigenvalues of S in the bracket, as many as the number of negative ones changes by. Where a sample lies
// on the singular point its count is round-off, so that the zero may lie a little outside.
std::vector<SingularPlace> roots(const InterpolatedTestMatrix& S, const SegmentSamples& on,
                                 const CountBracket& bracket) {
  constexpr double reach = 3.0;     // of the spread
  constexpr double outside = 1e-3;  // of the bracket
  const double L = on.segment.length(), ignored = coincidence_tolerance / L;
  const double margin = outside * (bracket.to - bracket.from);
  const double from = std::max({bracket.from - margin, ignored, S.centre() - reach * S.spread()});
  const double to = std::min(bracket.to + margin, S.centre() + reach * S.spread());
  const Vector first = S.eigenvalues(from), last = S.eigenvalues(to);
  const Index n0 = (first.array() < 0.0).count(), n1 = (last.array() < 0.0).count();
  const bool falls = bracket.after > bracket.before;
  if (n0 == n1 || (n1 > n0) != falls) return {};
  struct Zero {
    double t, rate;
  };
  std::vector<Zero> zeros;
  for (Index j = std::min(n0, n1); j < std::max(n0, n1); ++j) {
    const auto eigenvalue = [&](double t) -> std::optional<double> { return S.eigenvalues(t)[j]; };
    if (const auto root = bracketed_root(eigenvalue, from, first[j], to, last[j], 1e-14))
      zeros.push_back({.t = std::min(root->at, 1.0), .rate = S.rate(root->at, j)});
  }
  std::sort(zeros.begin(), zeros.end(), [](const Zero& a, const Zero& b) { return a.t < b.t; });
  std::vector<SingularPlace> places;
  for (const Zero& zero : zeros) {
    if (!places.empty() && (zero.t - places.back().t) * L <= coincidence_tolerance) {
      SingularPlace& same = places.back();
      ++same.multiplicity;
      same.change += falls ? 1 : -1;
      same.rate = std::min(same.rate, zero.rate);
    } else {
      places.push_back({.point = S.point(zero.t, on.metric), .t = zero.t, .rate = zero.rate, .change = falls ? 1 : -1});
    }
  }
  return places;
}

std::vector<SingularPlace> nearest_sample(const std::vector<PathSample>& seen, const CountBracket& bracket) {
  const double t = bracket.middle();
  const auto nearer = [t](const PathSample& a, const PathSample& b) { return std::abs(a.t - t) < std::abs(b.t - t); };
  const auto nearest = std::min_element(seen.begin(), seen.end(), nearer);
  if (nearest == seen.end()) return {};
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

enum class Joined { yes, no, unknown };

// Whether the points on both sides of a bracket follow each other along the path as it is halved. Where they do not,
// they lie on branches that pass each other, and nothing is singular there. Unknown where the path has no point, or no
// count, in the middle.
Joined joined(SegmentSamples& on, CountBracket bracket) {
  constexpr double bent_by_roundoff = 1e-6;  // brackets below it may be [path metric]
  constexpr int most_halvings = 30;
  const auto at = [&](double t, const PathPoint& end) {
    PathPoint point{.state = end.state, .tangent = end.tangent};
    for (const PathSample& sample : on.seen)
      if (sample.t == t) point = {.state = sample.state, .tangent = sample.tangent};
    return point;
  };
  for (int halving = 0; halving < most_halvings; ++halving) {
    const PathPoint before = at(bracket.from, on.segment.from()), after = at(bracket.to, on.segment.to());
    const Segment inner(on.metric, before, after);
    if (inner.length() <= bent_by_roundoff) return Joined::yes;
    if (!inner.follows_the_path()) return Joined::no;
    if (!halve(on, bracket)) return Joined::unknown;
  }
  return Joined::unknown;
}

enum class Lies { on_path, doubtful, off };

// An interpolated point by its residual, which is round-off where those of the converged points beside it are as large.
Lies lies(SegmentSamples& on, const PathPoint& point) {
  double converged = std::max(on.segment.from().residual, on.segment.to().residual);
  for (const PathSample& sample : on.seen) converged = std::max(converged, sample.residual);
  const double residual = on.corrector.inspect(point.state, on.metric, point.tangent).residual;
  if (residual <= 3.0 * converged) return Lies::on_path;
  return residual <= std::max(on_the_path, as_converged * converged) ? Lies::doubtful : Lies::off;
}

// The end of a bracket as a point of the path.
PathPoint point_at(const SegmentSamples& on, double t) {
  if (t == 0.0) return on.segment.from();
  if (t == 1.0) return on.segment.to();
  const auto sample = std::find_if(on.seen.begin(), on.seen.end(), [t](const PathSample& seen) { return seen.t == t; });
  return {.state = sample->state, .tangent = sample->tangent, .residual = sample->residual};
}

// Places of a bracket as fractions of the segment that it is a part of.
std::vector<SingularPlace> on_whole_segment(const SegmentSamples& on, const CountBracket& bracket,
                                            std::vector<SingularPlace> places) {
  const Direction chord = on.segment.chord();
  const double squared = on.metric.inner(chord, chord), part = bracket.to - bracket.from;
  for (SingularPlace& place : places) {
    place.t = on.metric.inner(difference(place.point.state, on.segment.from().state), chord) / squared;
    place.half_width *= part;
    place.rate /= part;
  }
  return places;
}

// Whether the counts right before and right behind the places, where they can be told, differ by what changes there,
// and that is the bracket's whole change.
bool explain(SegmentSamples& on, const CountBracket& bracket, const std::vector<SingularPlace>& places) {
  constexpr double beside = 1e-3;  // of the bracket
  Index change = 0;
  for (const SingularPlace& place : places) change += place.change;
  if (change != bracket.after - bracket.before) return false;
  const double distance = beside * (bracket.to - bracket.from);
  const auto counts = [&](double t, Index expected) {
    if (t <= bracket.from || t >= bracket.to) return true;
    const auto sample = sample_at(on, t);
    return !sample || !sample->negative || *sample->negative == expected;
  };
  return counts(places.front().t - distance, bracket.before) && counts(places.back().t + distance, bracket.after);
}

}  // namespace

// Newton's method is at a loss on the branch point itself, where K is singular, and the nearer the less sure. So S is
// interpolated from points at a distance, which shrinks from one matrix to the next as long as all goes well. Where
// counts contradict what S shows, and where the bracket begins with the segment, so that it is long beside the place's
// distance from there, it is searched as a segment of its own.
std::vector<SingularPlace> find_count_changes(Corrector& corrector, const Segment& segment, const Metric& metric,
                                              Index before, Index after) {
  SegmentSamples on{.corrector = corrector, .segment = segment, .metric = metric};
  const auto bracket = bisect(on, before, after);
  // No point of the path between the ends: they may lie on different branches, which shorter steps will show.
  if (!bracket) return {};
  on.changes = bracket->changes();
  on.turns = segment.from().tangent.dlambda * segment.to().tangent.dlambda < 0.0;
  on.pairs = std::max(on.pairs, on.changes + 1);
  const bool falls = bracket->after > bracket->before;  // below zero
  const Index order = falls ? bracket->before + 1 : bracket->before;
  double t = bracket->middle(), half_width = 0.5 * (bracket->to - bracket->from);
  std::vector<SingularPlace> found;
  for (const double spread : {0.04, 0.01}) {
    const auto S = test_matrix_around(on, t, spread, Vanishing::eigenvalue, order);
    if (!S) break;
    auto next = roots(*S, on, *bracket);
    if (next.empty() || std::abs(next.front().t - t) > 2.0 * half_width) break;
    half_width = std::max(1e-3 * std::abs(next.front().t - t), 1e-12);
    t = next.front().t;
    found = std::move(next);
  }
  const Lies there = found.empty() || half_width > 0.01 ? Lies::off : lies(on, found.front().point);
  const bool telling = segment.length() > short_segment;
  const bool agrees = !found.empty() && explain(on, *bracket, found);
  const bool contradicted = !agrees && (bracket->changes() > 1 || !found.empty());
  const bool near_start = bracket->from == 0.0;
  if (telling && (contradicted || near_start) && bracket->to - bracket->from < 1.0) {
    const PathPoint first = point_at(on, bracket->from), last = point_at(on, bracket->to);
    return on_whole_segment(
        on, *bracket,
        find_count_changes(corrector, Segment(metric, first, last), metric, bracket->before, bracket->after));
  }
  if ((there == Lies::off || !agrees) && telling) return {};
  const Joined sides = joined(on, *bracket);
  if (sides == Joined::no || (sides == Joined::unknown && there != Lies::on_path)) return {};
  // Where the path bends too sharply to be interpolated, shorter steps show more, and at last the nearest of its own
  // points has to do.
  if (there == Lies::off || !agrees) return nearest_sample(on.seen, *bracket);
  for (SingularPlace& place : found) place.half_width = half_width;
  return found;
}

}  // namespace arcwall
