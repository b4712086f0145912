#include "contact/sliding/curved_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

// The coordinate along a surface that is nearest to another of all that are the same place.
double nearest_round(const Obstacle& surface, double along, double to) {
  const double period = surface.period();
  return period > 0.0 ? to + std::remainder(along - to, period) : along;
}

// The face at a place inside an element: the gap, and how the gap would change along the element if the
// face were on the surface. That rate, the sine of the angle between them, vanishes where they are parallel.
struct FacePlace {
  double fraction = 0.0;
  double gap = infinity;  // where it faces nothing
  double rate = 0.0;
};

class Face {
 public:
  explicit Face(const ElementBesideSurface& element)
      : element_(element),
        surface_(*element.setting.obstacles[element.obstacle].surface),
        offset_(element.setting.face_offset(element.obstacle, element.strand)) {}

  const Obstacle& surface() const { return surface_; }

  // Of a closed surface it follows what the element faces at its first node.
  double along(double fraction) const {
    return nearest_round(surface_, surface_.along(face(offset_, axis(fraction)), lambda()), middle());
  }

  FacePlace place(double fraction) const {
    const AxisPlace on = axis(fraction);
    const Vec2 at = face(offset_, on);
    FacePlace out{.fraction = fraction};
    if (!surface_.faces(at, lambda())) return out;
    out.gap = surface_.gap_slope(at, lambda()).value;
    out.rate = sign_of(surface_.side()) * std::sin(on.angle - surface_.direction(at, lambda()).value);
    return out;
  }

  // Whether the body may come to the surface between two places and turn back: it does so by a small part of the
  // element.
  bool is_near(const FacePlace& a, const FacePlace& b) const {
    constexpr double part = 0.05;
    return std::min(a.gap, b.gap) < part * (coordinate(1) - coordinate(0));
  }

  // The fraction at which the element faces a place of the surface; such a place lies between its ends.
  double facing(double along_there) const {
    constexpr double enough = 1e-12;  // of the element
    const double range = element_.to - element_.from;
    double t0 = 0.0, v0 = element_.from - along_there, t = -v0 / range;
    for (int i = 0; i < 12; ++i) {
      const double v = along(t) - along_there;
      if (std::abs(v) <= enough * std::abs(range) || v == v0) break;
      const double next = std::clamp(t - v * (t - t0) / (v - v0), 0.0, 1.0);
      t0 = std::exchange(t, next);
      v0 = v;
    }
    return t;
  }

 private:
  AxisPlace axis(double fraction) const {
    return element_.at.mesh.inside(element_.strand, element_.node, fraction, element_.at.now);
  }
  double coordinate(Index end) const {
    return element_.at.mesh.coordinate(element_.strand, element_.node + end, element_.at.now.s);
  }
  double lambda() const { return element_.at.now.lambda; }
  double middle() const { return 0.5 * (element_.from + element_.to); }

  const ElementBesideSurface& element_;
  const Obstacle& surface_;
  double offset_;
};

// Calls visit(first, last, shift) for the knots between the ends of an element, less a shift: of a closed surface once
// for each round of which it sees part.
template <typename Visit>
void for_each_round(const ElementBesideSurface& element, const Visit& visit) {
  const Obstacle& surface = *element.setting.obstacles[element.obstacle].surface;
  const std::vector<double>& all = surface.knots();
  if (all.empty()) return;
  const auto [low, high] = std::minmax(element.from, element.to);
  const double period = surface.period();
  const auto round_of = [&](double along) { return period > 0.0 ? std::floor((along - all.front()) / period) : 0.0; };
  for (double round = round_of(low); round <= round_of(high); ++round) {
    const double shift = round * period;
    visit(std::upper_bound(all.begin(), all.end(), low - shift), std::lower_bound(all.begin(), all.end(), high - shift),
          shift);
  }
}

// The knots that an element faces, in its own order.
std::vector<double> faced_knots(const ElementBesideSurface& element) {
  std::vector<double> knots;
  for_each_round(element, [&](auto first, auto last, double shift) {
    for (; first < last; ++first) knots.push_back(*first + shift);
  });
  if (element.from > element.to) std::reverse(knots.begin(), knots.end());
  return knots;
}

// The root of the rate between two places with a change of its sign, by regula falsi (Illinois).
FacePlace parallel_between(const Face& face, FacePlace a, FacePlace b) {
  constexpr double enough = 1e-10;  // of the element
  double weight_a = 1.0, weight_b = 1.0;
  for (int i = 0; i < 60 && b.fraction - a.fraction > enough; ++i) {
    if (a.rate == 0.0) return a;
    if (b.rate == 0.0) return b;
    const double rate_a = weight_a * a.rate, rate_b = weight_b * b.rate;
    const FacePlace c = face.place((a.fraction * rate_b - b.fraction * rate_a) / (rate_b - rate_a));
    if (c.rate < 0.0) {
      a = c;
      weight_a = 1.0;
      weight_b *= 0.5;
    } else {
      b = c;
      weight_b = 1.0;
      weight_a *= 0.5;
    }
  }
  return -a.rate < b.rate ? a : b;
}

// Pairs of places between two cuts from one to the next of which the rate goes over from − to +. Where it has one sign
// at both the body may turn away and back between, as beside a contact at a rounded corner whose flank comes near: then
// three places between them are looked at, too.
std::vector<std::pair<FacePlace, FacePlace>> brackets(const Face& face, const FacePlace& from, const FacePlace& to) {
  std::vector<std::pair<FacePlace, FacePlace>> found;
  const auto take = [&](const FacePlace& a, const FacePlace& b) {
    if (!std::isfinite(a.gap) || !std::isfinite(b.gap)) return;
    if (a.rate <= 0.0 && b.rate >= 0.0 && a.rate != b.rate) found.emplace_back(a, b);
  };
  if (!face.is_near(from, to) || (from.rate > 0.0) != (to.rate > 0.0)) {
    take(from, to);
    return found;
  }
  constexpr int parts = 4;
  FacePlace a = from;
  for (int i = 1; i <= parts; ++i) {
    const FacePlace b =
        i == parts ? to : face.place(from.fraction + (to.fraction - from.fraction) * double(i) / double(parts));
    take(a, b);
    a = b;
  }
  return found;
}

}  // namespace

ElementBesideSurface beside_surface(const SlidingSetting& setting, const SlidingState& at, Index strand, Index node,
                                    std::size_t obstacle, const Vec2& first_face, const Vec2& last_face) {
  const Obstacle& surface = *setting.obstacles[obstacle].surface;
  const double from = surface.along(first_face, at.now.lambda), to = surface.along(last_face, at.now.lambda);
  return {.setting = setting,
          .at = at,
          .strand = strand,
          .node = node,
          .obstacle = obstacle,
          .from = from,
          .to = nearest_round(surface, to, from)};
}

bool faces_knots(const ElementBesideSurface& element) {
  const Obstacle& surface = *element.setting.obstacles[element.obstacle].surface;
  const std::vector<double> faced = faced_knots(element);
  if (faced.size() != 1 || !surface.is_smooth()) return !faced.empty();
  const auto is_end = [&](double knot) { return faced.front() == knot && surface.period() == 0.0; };
  return is_end(surface.knots().front()) || is_end(surface.knots().back());
}

std::vector<PlaceInElement> parallel_places(const ElementBesideSurface& element, TouchingEnds leave_out) {
  const Face face(element);
  const std::vector<double> knots = faced_knots(element);
  std::vector<FacePlace> cuts{face.place(0.0)};
  for (const double knot : knots) cuts.push_back(face.place(face.facing(knot)));
  if (knots.empty()) cuts.push_back(face.place(0.5));
  cuts.push_back(face.place(1.0));

  std::vector<PlaceInElement> found;
  const std::size_t first = leave_out.first ? 1 : 0, last = cuts.size() - (leave_out.last ? 2 : 1);
  for (std::size_t i = first; i < last; ++i)
    for (const auto& [a, b] : brackets(face, cuts[i], cuts[i + 1])) {
      const FacePlace least = parallel_between(face, a, b);
      found.push_back({.fraction = least.fraction, .gap = least.gap});
    }
  return found;
}

std::vector<PlaceInElement> places_entered_at_ends(const ElementBesideSurface& element) {
  const Face face(element);
  const std::vector<double>& all = face.surface().knots();
  std::vector<PlaceInElement> found;
  if (face.surface().period() > 0.0) return found;
  for (const double knot : faced_knots(element)) {
    if (knot != all.front() && knot != all.back()) continue;
    const FacePlace end = face.place(face.facing(knot));
    const double into = (knot == all.front()) == (element.from < element.to) ? 1.0 : -1.0;  // the surface
    if (end.gap < 0.0 && into * end.rate >= 0.0) found.push_back({.fraction = end.fraction, .gap = end.gap});
  }
  return found;
}

double least_gap_at_knots(const ElementBesideSurface& element) {
  const Face face(element);
  double least = infinity;
  for (const double knot : faced_knots(element)) least = std::min(least, face.place(face.facing(knot)).gap);
  return least;
}

}  // namespace arcwall::sliding
