// Where an eigenvalue or λ′ comes to zero inside a segment although nothing at its ends shows it.
#include <algorithm>
#include <cmath>
#include <functional>
#include <variant>

#include "continuation/events/singular_locator.hpp"
#include "continuation/path_tolerances.hpp"
#include "core/root_find.hpp"

namespace arcwall {

namespace {

constexpr double touching = 1e-8;    // what falls below this part of its value at a distance of 1 touches zero
constexpr double at_the_end = 1e-5;  // a touch so near behind the end of a segment belongs to it [path metric]
constexpr double resolved = 1e-12;   // likewise, of what is below zero beyond doubt

// Where what vanishes is least in magnitude.
struct MinimumEstimate {
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

// The least value of f on [a, b], near the least of those at equal distances. Empty where that stands at an end.
std::optional<double> least_inside(const std::function<double(double)>& f, double a, double b) {
  constexpr int cells = 60;
  const auto place = [&](int i) { return a + (b - a) * i / cells; };
  int lowest = 0;
  double least = infinity;
  for (int i = 0; i <= cells; ++i)
    if (const double value = f(place(i)); value < least) {
      least = value;
      lowest = i;
    }
  if (lowest == 0 || lowest == cells) return std::nullopt;
  return least_at(f, place(lowest - 1), place(lowest + 1));
}

// The nearest approach to zero on a segment.
struct Approach {
  InterpolatedTestMatrix S;
  Index outside;  // negative eigenvalues away from it
  MinimumEstimate least;

  // Least magnitude of an eigenvalue, negative where the count is another.
  double side(double t) const {
    const Vector values = S.eigenvalues(t);
    const double magnitude = values.cwiseAbs().minCoeff();
    return (values.array() < 0.0).count() == outside ? magnitude : -magnitude;
  }
};

enum class NoApproach { stays_clear, unclear };

// S is interpolated over less and less of the segment, around the least value that it showed last.
std::variant<NoApproach, Approach> nearest_approach(SegmentSamples& on, Vanishing what, bool from_singular) {
  constexpr double margin = 0.02;  // what is at the very end is seen from both sides
  std::optional<Approach> approach;
  MinimumEstimate least{.t = 0.5};
  double reach = 0.5 + margin;
  for (const double spread : {0.25, 0.06, 0.01}) {
    auto S = test_matrix_around(on, least.t, spread, what, 0);
    if (!S) return NoApproach::unclear;
    const double first = from_singular ? 10.0 * coincidence_tolerance / on.segment.length() : -margin;
    const double from = std::max(first, least.t - reach), to = std::min(1.0 + margin, least.t + reach);
    const Index outside = S->negative(from);
    if (S->negative(to) != outside) return NoApproach::unclear;
    approach.emplace(Approach{.S = std::move(*S), .outside = outside, .least = least});
    const auto side = [&](double t) { return approach->side(t); };
    const auto t = least_inside(side, from, to);
    if (!t) return NoApproach::stays_clear;
    least = {.t = *t, .value = side(*t)};
    reach = 2.0 * spread;
    // Two places far apart: shorter steps part them.
    if (least.value < 0.0 && (side(least.t - reach) < 0.0 || side(least.t + reach) < 0.0)) return NoApproach::unclear;
  }
  // Like s near a crossing of two eigenvalues, like s² near the least value of one.
  const double L = on.segment.length(), s = approach->S.spread();
  const double near = std::abs(approach->side(least.t + s) - least.value),
               far = std::abs(approach->side(least.t + 2.0 * s) - least.value);
  const bool crossing = far < 3.0 * near;
  least.at_one = near / (crossing ? s * L : s * s * L * L);
  approach->least = least;
  return std::move(*approach);
}

SingularPlace place_at(const Approach& approach, double t, const Metric& metric) {
  return {.point = approach.S.point(t, metric), .t = t, .half_width = 1e-12};
}

// What reaches beyond zero passes it twice: the two places, none if they are one. Nothing if they are not found.
std::optional<std::vector<SingularPlace>> two_crossings(const Approach& approach, const SegmentSamples& on) {
  const MinimumEstimate& least = approach.least;
  const double left = least.t - 2.0 * approach.S.spread(), right = least.t + 2.0 * approach.S.spread();
  const auto value = [&](double t) -> std::optional<double> { return approach.side(t); };
  const auto first = bracketed_root(value, left, approach.side(left), least.t, least.value, 1e-14);
  const auto second = bracketed_root(value, least.t, least.value, right, approach.side(right), 1e-14);
  if (!first || !second) return std::nullopt;
  std::vector<SingularPlace> places;
  if ((second->at - first->at) * on.segment.length() <= coincidence_tolerance) return places;
  const Index change = approach.S.negative(least.t) - approach.outside;
  places = {place_at(approach, first->at, on.metric), place_at(approach, second->at, on.metric)};
  const auto rate = [&](double t) {
    const double h = 0.1 * approach.S.spread();
    return std::abs(approach.side(t + h) - approach.side(t - h)) / (2.0 * h);
  };
  places[0].rate = rate(first->at);
  places[1].rate = rate(second->at);
  places[0].change = change;
  places[1].change = -change;
  places[0].multiplicity = places[1].multiplicity = std::abs(change);
  return places;
}

SingularPlace one_touch(const Approach& approach, const Metric& metric) {
  const MinimumEstimate& least = approach.least;
  const double zero = std::max(touching, 2.0 * coincidence_tolerance) * least.at_one;
  SingularPlace place = place_at(approach, least.t, metric);
  place.multiplicity = std::max<Index>(1, (approach.S.eigenvalues(least.t).array().abs() <= zero).count());
  place.touches = place.multiplicity == 1;
  return place;
}

}  // namespace

std::optional<std::vector<SingularPlace>> find_touches(Corrector& corrector, const Segment& segment,
                                                       const Metric& metric, Vanishing what, bool from_singular,
                                                       double noise) {
  SegmentSamples on{.corrector = corrector, .segment = segment, .metric = metric};
  const auto found = nearest_approach(on, what, from_singular);
  std::vector<SingularPlace> places;
  if (const auto* const none = std::get_if<NoApproach>(&found))
    return *none == NoApproach::stays_clear ? std::optional(places) : std::nullopt;
  const Approach& approach = std::get<Approach>(found);
  const MinimumEstimate& least = approach.least;
  // The place is not sure, but one of two steps that meet there must report it.
  const double owed = at_the_end / segment.length();
  if (least.value > std::max(touching * least.at_one, noise) || least.t <= owed || least.t > 1.0 + owed) return places;
  if (least.value < -std::max(resolved * least.at_one, noise)) {
    auto crossings = two_crossings(approach, on);
    if (!crossings || !crossings->empty()) return crossings;
  }
  places.push_back(one_touch(approach, metric));
  return places;
}

}  // namespace arcwall
