#include "contact/sliding/least_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

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

// Which elements of a strand, by their first node, lie beside a contact point with an obstacle, or on the obstacle.
std::vector<std::uint8_t> watched_elements(const SlidingState& at, Index strand, std::size_t obstacle) {
  std::vector<std::uint8_t> watched(static_cast<std::size_t>(at.mesh.nodes(strand)), 0);
  const auto& points = at.layout.points();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto [on, position] = at.mesh.breakpoint(static_cast<Index>(k));
    if (on != strand || points[k].obstacle != obstacle) continue;
    watched[static_cast<std::size_t>(position) - 1] = watched[static_cast<std::size_t>(position)] = 1;
    if (points[k].behind == Span::free) continue;
    const Index last = at.mesh.breakpoint(static_cast<Index>(k) + 1).second;
    std::fill(watched.begin() + position, watched.begin() + last, std::uint8_t{1});
  }
  return watched;
}

enum class Which { unwatched, all };

// visit(LeastGap) for each element of a strand that has one, the gap being a cubic between its nodes. Where only the
// unwatched ones are asked for, elements that are far from the obstacle for their slopes are passed over, too.
template <typename Visit>
void for_each_on_strand(const SlidingSetting& setting, const SlidingState& at, Index strand, std::size_t obstacle,
                        const std::vector<Placed>& nodes, Which which, const Visit& visit) {
  const double offset = setting.face_offset(obstacle, strand);
  std::vector<std::uint8_t> watched(nodes.size(), 0);
  if (which == Which::unwatched) watched = watched_elements(at, strand, obstacle);
  Sample before = sampled(setting.obstacles[obstacle], offset, nodes[0], at.now.lambda);
  for (std::size_t e = 0; e + 1 < nodes.size(); ++e) {
    const Sample after = sampled(setting.obstacles[obstacle], offset, nodes[e + 1], at.now.lambda);
    const double length = (after.face - before.face).norm();
    const double r0 = before.rate * length, r1 = after.rate * length;
    const bool far = std::min(before.gap, after.gap) > 0.5 * (std::abs(r0) + std::abs(r1));
    if (!watched[e] && std::isfinite(before.gap) && std::isfinite(after.gap) && (!far || which == Which::all))
      if (const auto least = least_inside(before.gap, r0, after.gap, r1)) {
        const auto node = static_cast<Index>(e);
        const double S1 = at.mesh.coordinate(strand, node, at.now.s),
                     S2 = at.mesh.coordinate(strand, node + 1, at.now.s);
        visit(LeastGap{
            .obstacle = obstacle, .at = {.strand = strand, .s = S1 + least->at * (S2 - S1)}, .gap = least->value});
      }
    before = after;
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

}  // namespace

std::optional<LeastGap> deepest_unwatched(const SlidingSetting& setting, const SlidingState& at, double margin) {
  std::optional<LeastGap> deepest;
  for_each_least_gap(setting, at, Which::unwatched, [&](const LeastGap& least) {
    if (least.gap < margin * setting.scales.length && (!deepest || least.gap < deepest->gap)) deepest = least;
  });
  return deepest;
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

double sampled_least_gap(const SlidingSetting& setting, const SlidingState& at, int places) {
  double least = infinity;
  for (std::size_t w = 0; w < setting.obstacles.size(); ++w)
    for (Index strand = 0; strand < setting.body.strands(); ++strand) {
      if (!setting.obstacles[w].concerns(strand)) continue;
      const double offset = setting.face_offset(w, strand);
      for (Index e = 0; e + 1 < at.mesh.nodes(strand); ++e)
        for (int i = 0; i <= places; ++i)
          least = std::min(least, face_gap(setting.obstacles[w], offset,
                                           at.mesh.inside(strand, e, double(i) / places, at.now), at.now.lambda));
    }
  return least;
}

}  // namespace arcwall::sliding
