#include "contact/sliding/least_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "contact/passing.hpp"
#include "contact/sliding/bending.hpp"
#include "contact/sliding/curved_surface.hpp"
#include "contact/sliding/pinches.hpp"
#include "contact/sliding/tolerances.hpp"
#include "contact/sliding/touch.hpp"
#include "core/lanes.hpp"

namespace arcwall::sliding {

namespace {

using Span = SlidingContactLayout::Span;

// The least value in [0, 1] of the cubic with these end values and slopes, where it has one inside.
struct Least {
  double at, value;
};

std::optional<Least> least_inside(double v0, double r0, double v1, double r1) {
  const double a = 2.0 * (v0 - v1) + r0 + r1, b = 3.0 * (v1 - v0) - 2.0 * r0 - r1;
  // v′ = r0 + 2 b t + 3 a t²; the root where v″ > 0
  double t;
  const double discriminant = b * b - 3.0 * a * r0;
  if (discriminant < 0.0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  if (b + root > 0.0) {
    t = -r0 / (b + root);
  } else {
    if (a <= 0.0) return std::nullopt;
    t = (root - b) / (3.0 * a);
  }
  constexpr double at_node = 1e-9;  // which both elements miss by round-off, or neither
  if (!(t >= -at_node && t <= 1.0 + at_node)) return std::nullopt;
  t = std::clamp(t, 0.0, 1.0);
  return Least{.at = t, .value = v0 + t * (r0 + t * (b + t * a))};
}

// Where the nodes of a strand are, and the tangents there.
struct Placed {
  Vec2 position, tangent;
};

std::vector<Placed> placed_nodes(const SlidingState& at, Index strand) {
  const auto count = static_cast<std::size_t>(at.mesh.nodes(strand));
  std::vector<Placed> nodes(count);
  for (std::size_t first = 0; first < count; first += Lanes::count) {
    const std::size_t end = std::min<std::size_t>(first + Lanes::count, count);
    Lanes angle = 0.0;
    for (std::size_t i = first; i < end; ++i) {
      const AxisPlace place = at.mesh.node(strand, static_cast<Index>(i), at.now);
      nodes[i].position = place.position;
      angle.set(static_cast<int>(i - first), place.angle);
    }
    const CosineAndSine<Lanes> turn = cosine_and_sine(angle);
    for (std::size_t i = first; i < end; ++i) {
      const auto lane = static_cast<int>(i - first);
      nodes[i].tangent = {turn.cosine[lane], turn.sine[lane]};
    }
  }
  return nodes;
}

// The gap at a node, the place of the face there, and the rate of the gap by the face moved along the tangent.
struct Sample {
  double gap = infinity;
  Vec2 face{};
  double rate = 0.0;
};

Sample sampled(const SlidingObstacle& obstacle, double offset, const Placed& node, double lambda) {
  const auto& [place, t] = node;
  const double o = t.x() >= 0.0 ? offset : -offset;
  Sample out{.face = place + o * perp(t)};
  const LinearField g = obstacle.surface->gap_slope(out.face, lambda);
  out.gap = g.value;
  out.rate = g.x * t.x() + g.z * t.y();
  return out;
}

// How an element touches an obstacle already, so that guards say all of what they watch.
struct Watched {
  bool at_first = false, at_last = false;  // a contact point is at its first or its last node
  bool along = false;                      // it lies on the obstacle

  bool anywhere() const { return at_first || at_last || along; }
};

// Whether the contact of an end on a plane of symmetry is at a least gap of the whole body, which it follows then.
bool watches_least_gap(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  if (!is_tangent_at_plane(setting, at, end)) return false;
  const auto contact = setting.number_of_end({.strand = end.strand, .last = end.last}, end.obstacle);
  if (!contact) return false;
  return at.is_closed(at.layout.points().size() + *contact) || end_curvature_gap(setting, at, end) > 0.0;
}

// Of the elements of a strand, by their first node.
std::vector<Watched> watched_elements(const SlidingSetting& setting, const SlidingState& at, Index strand,
                                      std::size_t obstacle) {
  std::vector<Watched> watched(static_cast<std::size_t>(at.mesh.nodes(strand)));
  const auto& points = at.layout.points();
  if (at.layout.lies_on(strand) == obstacle)
    for (Watched& element : watched) element.along = true;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto [on, position] = at.mesh.breakpoint(static_cast<Index>(k));
    if (on != strand || !touches(setting, at.layout, k, obstacle)) continue;
    watched[static_cast<std::size_t>(position) - 1].at_last = true;
    watched[static_cast<std::size_t>(position)].at_first = true;
    if (points[k].before != Span::free)
      for (Index e = 0; e < position; ++e) watched[static_cast<std::size_t>(e)].along = true;
    if (points[k].behind == Span::free) continue;
    const bool to_end = at.layout.point_at_end(strand, true) == k;
    const Index last = to_end ? at.mesh.nodes(strand) - 1 : at.mesh.breakpoint(static_cast<Index>(k) + 1).second;
    for (Index e = position; e < last; ++e) watched[static_cast<std::size_t>(e)].along = true;
  }
  for (const bool last : {false, true})
    if (watches_least_gap(setting, at, {.strand = strand, .last = last, .obstacle = obstacle}))
      (last ? watched.end()[-2].at_last : watched.front().at_first) = true;
  return watched;
}

enum class Which { unwatched, all };

// An element between two samples.
struct Element {
  Index node;
  const Sample &before, &after;
  Watched watched;
};

// Where it sees all of the surface that its inside faces, the gap is a cubic between its nodes. Where only unwatched
// places are asked for, elements that are far from the surface for their slopes are passed over, too. Whether there is
// such a place.
template <typename Visit>
bool visit_by_nodes(const Element& element, Which which, const Visit& visit) {
  const auto& [before, after] = std::tie(element.before, element.after);
  if (element.watched.anywhere() || !std::isfinite(before.gap) || !std::isfinite(after.gap)) return false;
  const double length = (after.face - before.face).norm();
  const double r0 = before.rate * length, r1 = after.rate * length;
  const bool far = std::min(before.gap, after.gap) > 0.5 * (std::abs(r0) + std::abs(r1));
  if (far && which == Which::unwatched) return false;
  const auto least = least_inside(before.gap, r0, after.gap, r1);
  if (least) visit(least->at, least->value);
  return least.has_value();
}

// Else by the surface's knots and tangents. Off the surface the gap may be least elsewhere than where the body is
// parallel to it: neighbours of elements with knots are asked both ways, so that no place falls between them.
template <typename Visit>
void visit_by_surface(const ElementBesideSurface& beside, const Element& element, bool at_knot, Which which,
                      const Visit& visit) {
  const auto& [before, after] = std::tie(element.before, element.after);
  if (!at_knot) {
    const double near = 2.0 * (after.face - before.face).norm();
    if (element.watched.anywhere() || !std::isfinite(before.gap) || !std::isfinite(after.gap)) return;
    if (std::min(before.gap, after.gap) > near) return;
  }
  if (element.watched.along) return;
  for (const PlaceInElement& least :
       parallel_places(beside, {.first = element.watched.at_first, .last = element.watched.at_last}))
    visit(least.fraction, least.gap);
  if (!at_knot || which == Which::all) return;
  for (const PlaceInElement& entered : places_entered_at_ends(beside)) visit(entered.fraction, entered.gap);
}

// The elements of a strand that face knots of an obstacle's surface.
std::vector<bool> elements_at_knots(const SlidingSetting& setting, const SlidingState& at, Index strand,
                                    std::size_t obstacle, const std::vector<Sample>& samples) {
  std::vector<bool> at_knots(samples.size() - 1, false);
  if (setting.obstacles[obstacle].surface->knots().empty()) return at_knots;
  for (std::size_t e = 0; e < at_knots.size(); ++e)
    at_knots[e] = faces_knots(
        beside_surface(setting, at, strand, static_cast<Index>(e), obstacle, samples[e].face, samples[e + 1].face));
  return at_knots;
}

// visit(LeastGap) for each place inside the elements of a strand where the gap is least.
template <typename Visit>
void for_each_on_strand(const SlidingSetting& setting, const SlidingState& at, Index strand, std::size_t obstacle,
                        const std::vector<Placed>& nodes, Which which, const Visit& visit) {
  const double offset = setting.face_offset(obstacle, strand), lambda = at.now.lambda;
  std::vector<Watched> watched(nodes.size());
  if (which == Which::unwatched) watched = watched_elements(setting, at, strand, obstacle);
  std::vector<Sample> samples;
  samples.reserve(nodes.size());
  for (const Placed& node : nodes) samples.push_back(sampled(setting.obstacles[obstacle], offset, node, lambda));
  const std::vector<bool> at_knots = elements_at_knots(setting, at, strand, obstacle, samples);
  for (std::size_t e = 0; e + 1 < nodes.size(); ++e) {
    const Element element{
        .node = static_cast<Index>(e), .before = samples[e], .after = samples[e + 1], .watched = watched[e]};
    const auto visit_inside = [&](double fraction, double gap) {
      const double S1 = at.mesh.coordinate(strand, element.node, at.now.s),
                   S2 = at.mesh.coordinate(strand, element.node + 1, at.now.s);
      visit(LeastGap{.obstacle = obstacle, .at = {.strand = strand, .s = S1 + fraction * (S2 - S1)}, .gap = gap});
    };
    if (!at_knots[e] && visit_by_nodes(element, which, visit_inside)) continue;
    const bool beside_knots = (e > 0 && at_knots[e - 1]) || (e + 1 < at_knots.size() && at_knots[e + 1]);
    if (!at_knots[e] && !beside_knots) continue;
    visit_by_surface(beside_surface(setting, at, strand, element.node, obstacle, samples[e].face, samples[e + 1].face),
                     element, at_knots[e], which, visit_inside);
  }
}

template <typename Visit>
void for_each_least_gap(const SlidingSetting& setting, const SlidingState& at, Which which, const Visit& visit) {
  for (Index strand = 0; strand < setting.body.strands(); ++strand) {
    std::vector<Placed> nodes;
    for (std::size_t w = 0; w < setting.obstacles.size(); ++w) {
      if (!setting.obstacles[w].concerns(strand)) continue;
      if (nodes.empty()) nodes = placed_nodes(at, strand);
      for_each_on_strand(setting, at, strand, w, nodes, which, visit);
    }
  }
}

// The end of a strand that touches an obstacle and in whose element a least gap to the same obstacle is.
std::optional<FreeEnd> touching_end_beside(const SlidingSetting& setting, const SlidingState& at,
                                           const LeastGap& least) {
  for (const bool last : {false, true}) {
    const Index inner = last ? at.mesh.nodes(least.at.strand) - 2 : 1;
    const double s = at.mesh.coordinate(least.at.strand, inner, at.now.s);
    if (last ? least.at.s < s : least.at.s > s) continue;
    for (std::size_t j = 0; j < setting.free_ends.size(); ++j) {
      const StrandEnd end{.strand = least.at.strand, .last = last};
      const bool touches = at.is_closed(at.layout.points().size() + j);
      if (touches && setting.free_ends[j].obstacle == least.obstacle && setting.free_ends[j].is_of(end))
        return setting.free_ends[j].seen_from(end);
    }
  }
  return std::nullopt;
}

// The least of the gap inside the element at an end that touches, as a quartic: gaps and slopes are those of both
// nodes, and the curvature is that of the body at the end, which that of the element's cubic is but nearly.
double least_beside_end(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  constexpr int looks = 32;
  const Index outer = end.position(at.mesh), inner = end.last ? outer - 1 : 1;
  const double offset = setting.face_offset(end.obstacle, end.strand), inwards = end.last ? -1.0 : 1.0;
  const auto sample = [&](Index position) {
    const AxisPlace axis = at.mesh.node(end.strand, position, at.now);
    const Placed node{.position = axis.position, .tangent = {std::cos(axis.angle), std::sin(axis.angle)}};
    return sampled(setting.obstacles[end.obstacle], offset, node, at.now.lambda);
  };
  const Sample from = sample(outer), to = sample(inner);
  const double length = (to.face - from.face).norm();
  const double r0 = inwards * from.rate * length, r1 = inwards * to.rate * length;
  const double bend = 0.5 * length * length * end_curvature_gap(setting, at, end);
  const double rise = to.gap - from.gap - r0 - bend, fourth = r1 - r0 - 2.0 * bend - 3.0 * rise;
  double least = to.gap;
  for (int i = 1; i < looks; ++i) {
    const double t = double(i) / looks;
    least = std::min(least, from.gap + t * (r0 + t * (bend + t * (rise - fourth + t * fourth))));
  }
  return least;
}

}  // namespace

// As an end that touches lies down, all gaps beside it come to nothing. That is watched by a guard of its own, so that
// there the body must be inside.
std::vector<LeastGap> unwatched_gaps(const SlidingSetting& setting, const SlidingState& at, double margin) {
  std::vector<LeastGap> found;
  for_each_least_gap(setting, at, Which::unwatched, [&](const LeastGap& least) {
    if (least.gap >= margin * setting.scales.length) return;
    const auto end = touching_end_beside(setting, at, least);
    if (end && least_beside_end(setting, at, *end) >= std::min(margin, penetrates_beside_end) * setting.scales.length)
      return;
    found.push_back(least);
  });
  std::stable_sort(found.begin(), found.end(), [](const LeastGap& a, const LeastGap& b) { return a.gap < b.gap; });
  return found;
}

std::vector<LeastGap> least_gaps(const SlidingSetting& setting, const SlidingState& at) {
  std::vector<LeastGap> found;
  for_each_least_gap(setting, at, Which::all, [&](const LeastGap& least) { found.push_back(least); });
  return found;
}

std::optional<LeastGap> nearest_least_gap(const SlidingSetting& setting, const SlidingState& at,
                                          const LeastGap& other) {
  std::optional<LeastGap> nearest;
  for_each_least_gap(setting, at, Which::all, [&](const LeastGap& least) {
    if (least.obstacle != other.obstacle || least.at.strand != other.at.strand) return;
    if (!nearest || std::abs(least.at.s - other.at.s) < std::abs(nearest->at.s - other.at.s)) nearest = least;
  });
  return nearest;
}

namespace {

// A strand, as an obstacle at rest sees it in a state.
struct SeenStrand {
  const SlidingState& at;
  const Obstacle& surface;
  Index strand;

  Vec2 place(Index element, double fraction) const {
    return surface.seen_at_rest(at.mesh.inside(strand, element, fraction, at.now).position, at.now.lambda);
  }
  Index elements() const { return at.mesh.nodes(strand) - 1; }
  Vec2 first() const { return place(0, 0.0); }
  Vec2 last() const { return place(elements() - 1, 1.0); }

  double turn_about(const Vec2& centre, double touching) const {
    double turn = 0.0;
    for (Index e = 0; e < elements(); ++e)
      turn += arcwall::turn_about(
          centre, [&](double fraction) { return place(e, fraction); }, touching);
    return turn;
  }
};

// Whether the way forth along a strand before and back along it behind goes round the core of an obstacle. The inside
// is connected, and neither strand is in it: so they go round all places inside as often, as far as no end passes
// through.
bool goes_round_core(const SeenStrand& before, const SeenStrand& behind, double touching) {
  const auto core = before.surface.core();
  if (!core) return false;
  const auto across = [&](const Vec2& from, const Vec2& to) { return turn_between(from - *core, to - *core); };
  const double turn = before.turn_about(*core, touching) + across(before.last(), behind.last()) -
                      behind.turn_about(*core, touching) - across(before.first(), behind.first());
  return std::abs(turn) > 0.5 * pi;  // a whole turn, or half of one where a strand is on the core
}

}  // namespace

bool passes_through(const SlidingSetting& setting, const SlidingState& from, const SlidingState& to) {
  const double touching = touching_on_path * setting.scales.length;
  for (Index strand = 0; strand < setting.body.strands(); ++strand)
    for (const SlidingObstacle& obstacle : setting.obstacles) {
      const Obstacle& surface = *obstacle.surface;
      if (!surface.has_other_sides() || !obstacle.concerns(strand)) continue;
      if (goes_round_core({from, surface, strand}, {to, surface, strand}, touching)) return true;
      for (const bool last : {false, true}) {
        const auto end = [&](const SlidingState& at) {
          return at.mesh.node(strand, last ? at.mesh.nodes(strand) - 1 : 0, at.now).position;
        };
        if (point_passes_through(surface, {.from = end(from), .to = end(to)}, from.now.lambda, to.now.lambda, touching))
          return true;
      }
    }
  return false;
}

namespace {

// A strand beside an obstacle whose surface has ends.
struct StrandBesideEnds {
  const SlidingSetting& setting;
  std::size_t obstacle;
  Index strand;

  const Obstacle& surface() const { return *setting.obstacles[obstacle].surface; }
  double gap(const AxisPlace& axis, double lambda) const {
    return face_gap(setting.obstacles[obstacle], setting.face_offset(obstacle, strand), axis, lambda);
  }
};

bool has_ends(const Obstacle& surface) {
  const std::vector<double>& knots = surface.knots();
  return !knots.empty() && surface.period() == 0.0 && (std::isfinite(knots.front()) || std::isfinite(knots.back()));
}

// Whether an element may be partly beyond an end of the surface, and partly not.
bool is_near_an_end(const StrandBesideEnds& beside, const Vec2& first, const Vec2& last, double lambda) {
  const Obstacle& surface = beside.surface();
  const double chord = (last - first).norm();
  const auto is_near = [&](const Vec2& place) {
    const double along = surface.along(place, lambda);
    return std::min(std::abs(along - surface.knots().front()), std::abs(along - surface.knots().back())) <= 2.0 * chord;
  };
  return (!surface.faces(first, lambda) || !surface.faces(last, lambda)) && (is_near(first) || is_near(last));
}

}  // namespace

// Inside an element that is partly beyond the end a bend of the body may come in first, between its nodes.
bool comes_behind_an_end(const SlidingSetting& setting, const SlidingState& from, const SlidingState& to) {
  constexpr int looks = 16;
  const double touching = touching_on_path * setting.scales.length, lambda = to.now.lambda;
  const auto comes = [&](const StrandBesideEnds& beside, Index element, double fraction) {
    const AxisPlace here = to.mesh.inside(beside.strand, element, fraction, to.now);
    if (!(beside.gap(here, lambda) < -touching)) return false;
    const double S1 = to.mesh.coordinate(beside.strand, element, to.now.s);
    const double S2 = to.mesh.coordinate(beside.strand, element + 1, to.now.s);
    const AxisPlace before = from.mesh.place({.strand = beside.strand, .s = S1 + fraction * (S2 - S1)}, from.now);
    return !std::isfinite(beside.gap(before, from.now.lambda));
  };
  for (std::size_t w = 0; w < setting.obstacles.size(); ++w) {
    const Obstacle& surface = *setting.obstacles[w].surface;
    if (!has_ends(surface)) continue;
    for (Index strand = 0; strand < setting.body.strands(); ++strand) {
      if (!setting.obstacles[w].concerns(strand)) continue;
      const StrandBesideEnds beside{.setting = setting, .obstacle = w, .strand = strand};
      Vec2 first = to.mesh.node(strand, 0, to.now).position;
      for (Index e = 0; e + 1 < to.mesh.nodes(strand); ++e) {
        const Vec2 last = to.mesh.node(strand, e + 1, to.now).position;
        const int count = is_near_an_end(beside, first, last, lambda) ? looks : 1;
        for (int i = e == 0 ? 0 : 1; i <= count; ++i)
          if (comes(beside, e, double(i) / count)) return true;
        first = last;
      }
    }
  }
  return false;
}

double sampled_least_gap(const SlidingSetting& setting, const SlidingState& at, int places) {
  double least = infinity;
  for (std::size_t w = 0; w < setting.obstacles.size(); ++w)
    for (Index strand = 0; strand < setting.body.strands(); ++strand) {
      if (!setting.obstacles[w].concerns(strand)) continue;
      const double offset = setting.face_offset(w, strand);
      for (Index e = 0; e + 1 < at.mesh.nodes(strand); ++e) {
        const auto inside = [&](double t) { return at.mesh.inside(strand, e, t, at.now); };
        for (int i = 0; i <= places; ++i)
          least = std::min(least, face_gap(setting.obstacles[w], offset, inside(double(i) / places), at.now.lambda));
        const Vec2 first = face(offset, inside(0.0)), last = face(offset, inside(1.0));
        least = std::min(least, least_gap_at_knots(beside_surface(setting, at, strand, e, w, first, last)));
      }
    }
  return least;
}

}  // namespace arcwall::sliding
