#include "model/member_extreme.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/root_find.hpp"
#include "elements/shape_functions.hpp"

namespace arcwall {

namespace {

constexpr double exceeds = 1e-10;

// The quartic through the values at five places of equal spacing. Moments along a stretch are one, since its axis is
// cubic and its load constant.
class Quartic {
 public:
  Quartic(const std::function<double(double)>& f, double from, double to) : from_(from), width_(0.25 * (to - from)) {
    for (std::size_t i = 0; i < places; ++i) differences_[i] = f(from + width_ * double(i));
    for (std::size_t order = 1; order < places; ++order)
      for (std::size_t i = places; i-- > order;)
        differences_[i] = (differences_[i] - differences_[i - 1]) / double(order);
  }

  // By the place over the spacing: Newton's form c0 + t (c1 + (t − 1) (c2 + …)), differentiated.
  double slope(double place) const {
    const double t = (place - from_) / width_;
    double value = 0.0, slope = 0.0;
    for (std::size_t i = places; i-- > 0;) {
      slope = value + (t - double(i)) * slope;
      value = differences_[i] + (t - double(i)) * value;
    }
    return slope;
  }

 private:
  static constexpr std::size_t places = 5;
  double from_, width_;
  std::array<double, places> differences_{};
};

// Where a function turns between two places.
std::vector<double> turns(const std::function<double(double)>& f, double from, double to) {
  constexpr int parts = 8;
  constexpr double tolerance = 1e-14;
  const Quartic quartic(f, from, to);
  const auto slope = [&](double place) { return std::optional(quartic.slope(place)); };
  std::vector<double> found;
  double a = from, slope_a = quartic.slope(a);
  for (int i = 1; i <= parts; ++i) {
    const double b = from + (to - from) * i / parts, slope_b = quartic.slope(b);
    if (slope_a * slope_b < 0.0)
      if (const auto root = bracketed_root(slope, a, slope_a, b, slope_b, tolerance)) found.push_back(root->at);
    a = b;
    slope_a = slope_b;
  }
  return found;
}

// Where it changes its sign between two places, with those at which it turns between them.
std::vector<double> zeros(const std::function<double(double)>& f, double from, double to,
                          const std::vector<double>& turns) {
  constexpr double tolerance = 1e-14;
  const auto at = [&](double place) { return std::optional(f(place)); };
  std::vector<double> places{from}, found;
  places.insert(places.end(), turns.begin(), turns.end());
  places.push_back(to);
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double a = f(places[i]), b = f(places[i + 1]);
    if (a * b < 0.0)
      if (const auto root = bracketed_root(at, places[i], a, places[i + 1], b, tolerance)) found.push_back(root->at);
  }
  return found;
}

// The part of a stretch that belongs to the member.
std::pair<double, double> within_member(const MemberStretch& stretch) {
  const auto xi = [&](double fraction) { return (fraction - stretch.from) / (stretch.to - stretch.from); };
  return {std::clamp(xi(0.0), 0.0, 1.0), std::clamp(xi(1.0), 0.0, 1.0)};
}

double fraction_at(const MemberStretch& stretch, double xi) {
  return std::clamp(stretch.from + xi * (stretch.to - stretch.from), 0.0, 1.0);
}

// The part from ξ = `from` to `to`, divided at the kinks in it.
std::vector<double> between_kinks(const MemberStretch& stretch, const std::vector<double>& kinks, double from,
                                  double to) {
  std::vector<double> places{from};
  for (const double kink : kinks) {
    const double xi = (kink - stretch.from) / (stretch.to - stretch.from);
    if (xi > from && xi < to) places.push_back(xi);
  }
  places.push_back(to);
  return places;
}

}  // namespace

void MemberExtreme::look_in(const MemberStretch& stretch, Found& extreme, Index element, std::size_t number) const {
  const auto [from, to] = within_member(stretch);
  if (!(from < to)) return;
  const auto is_beyond = [&](double value, double other) {
    return which_ == Which::greatest ? value > other * (1.0 + exceeds) : value < other * (1.0 - exceeds);
  };
  const auto consider = [&](double signed_value, std::size_t quantity, double xi, Found::Kind kind) {
    const double value = std::abs(signed_value);
    if (extreme.value && !is_beyond(value, *extreme.value)) return;
    extreme = {.value = value,
               .sign = signed_value < 0.0 ? -1.0 : 1.0,
               .fraction = fraction_at(stretch, xi),
               .quantity = quantity,
               .element = element,
               .stretch = number,
               .xi = xi,
               .kind = kind};
  };
  const std::vector<double> smooth = between_kinks(stretch, of_.kinks, from, to);
  for (std::size_t i = 0; i < of_.quantities.size(); ++i) {
    const auto f = [&](double xi) { return of_.quantities[i](stretch, xi); };
    consider(f(from), i, from, from > 0.0 ? Found::Kind::fixed : Found::Kind::node);
    for (std::size_t part = 0; part + 1 < smooth.size(); ++part) {
      const double begin = smooth[part], end = smooth[part + 1];
      const std::vector<double> turning = turns(f, begin, end);
      for (const double xi : turning) consider(f(xi), i, xi, Found::Kind::inside);
      if (which_ == Which::least)
        for (const double xi : zeros(f, begin, end, turning)) consider(0.0, i, xi, Found::Kind::inside);
      consider(f(end), i, end, end < 1.0 ? Found::Kind::fixed : Found::Kind::node);
    }
  }
}

MemberExtreme::Found MemberExtreme::extreme(const State& state) const {
  Found found;
  std::vector<MemberStretch> stretches;
  for (Index element = 0; element < member_->elements(state); ++element) {
    stretches.clear();
    member_->add_stretches(state, element, stretches);
    for (std::size_t i = 0; i < stretches.size(); ++i) look_in(stretches[i], found, element, i);
  }
  return found;
}

double MemberExtreme::value(const State& state) const {
  const Found found = extreme(state);
  const double value = found.value.value_or(0.0);
  if (what_ == What::value) return value;
  return value > of_.negligible || which_ == Which::least ? found.fraction : 0.0;
}

// What it was asked for at the place that was found, in a state beside it: a node goes along with the mesh, an end of
// the member stays, and so does what turns, but for its fraction, which is that of the turn nearest to it; so does a
// kink of a section.
double MemberExtreme::again(const State& state, const Found& found) const {
  std::vector<MemberStretch> stretches;
  member_->add_stretches(state, found.element, stretches);
  const MemberStretch& stretch = stretches[std::min(found.stretch, stretches.size() - 1)];  // a load may leave it
  double xi = found.xi;
  if (found.kind == Found::Kind::fixed) xi = (found.fraction - stretch.from) / (stretch.to - stretch.from);
  const SectionQuantity& quantity = of_.quantities[found.quantity];
  const bool is_zero = found.value == 0.0 && found.kind == Found::Kind::inside;
  if (what_ == What::value) return is_zero ? 0.0 : found.sign * quantity(stretch, xi);
  if (found.kind == Found::Kind::inside) {
    const auto [from, to] = within_member(stretch);
    const auto f = [&](double at) { return quantity(stretch, at); };
    std::vector<double> places = turns(f, from, to);
    if (is_zero) places = zeros(f, from, to, places);
    const auto nearer = [&](double a, double b) { return std::abs(a - found.xi) < std::abs(b - found.xi); };
    if (!places.empty()) xi = *std::min_element(places.begin(), places.end(), nearer);
  }
  return fraction_at(stretch, xi);
}

DifferencedObservable::Differences MemberExtreme::differences_at(const State& state) const {
  const Found found = extreme(state);
  Vector steps = Vector::Zero(state.x.size());
  for (const ElementsOfMember::Step& step : member_->steps(state, found.element)) steps[step.unknown] = step.size;
  return {.steps = std::move(steps), .value = [this, found](const State& moved) { return again(moved, found); }};
}

// ∫ |f| over the element, by the fraction of the member: Gauss's rule between zeros, exact for the cubic axis of a
// foundation of one stiffness.
double MemberMean::part_of(const State& state, Index element) const {
  std::vector<MemberStretch> stretches;
  member_->add_stretches(state, element, stretches);
  const GaussRule rule = gauss_rule(3);
  double sum = 0.0;
  for (const MemberStretch& stretch : stretches) {
    const auto [from, to] = within_member(stretch);
    if (!(from < to)) continue;
    const auto f = [&](double xi) { return quantity_(stretch, xi); };
    std::vector<double> places = zeros(f, from, to, turns(f, from, to));
    places.insert(places.begin(), from);
    places.push_back(to);
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      const double half = 0.5 * (places[i + 1] - places[i]);
      for (std::size_t g = 0; g < 3; ++g)
        sum += (stretch.to - stretch.from) * half * rule.weight[g] * std::abs(f(places[i] + half * (1.0 + rule.xi[g])));
    }
  }
  return sum;
}

double MemberMean::value(const State& state) const {
  double sum = 0.0;
  for (Index element = 0; element < member_->elements(state); ++element) sum += part_of(state, element);
  return sum;
}

double MemberMean::rate(const State& state, const Direction& direction) const {
  Vector steps = Vector::Zero(state.x.size());
  for (Index element = 0; element < member_->elements(state); ++element)
    for (const ElementsOfMember::Step& step : member_->steps(state, element)) steps[step.unknown] = step.size;
  return central_difference_along(state, direction, steps, [&](const State& moved) { return value(moved); });
}

Row MemberMean::gradient(const State& state) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  for (Index element = 0; element < member_->elements(state); ++element) {
    Vector steps = Vector::Zero(state.x.size());
    for (const ElementsOfMember::Step& step : member_->steps(state, element)) steps[step.unknown] = step.size;
    const Row part = central_differences(state, steps, [&](const State& moved) { return part_of(moved, element); });
    row.dx += part.dx;
    row.dlambda += part.dlambda;
  }
  return row;
}

std::size_t GreatestOfMembers::greatest(const State& state) const {
  std::size_t greatest = 0;
  double most = values_.front()->value(state);
  for (std::size_t i = 1; i < values_.size(); ++i)
    if (const double value = values_[i]->value(state); value > most * (1.0 + exceeds)) {
      greatest = i;
      most = value;
    }
  return greatest;
}

}  // namespace arcwall
