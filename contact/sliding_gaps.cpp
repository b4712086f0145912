// Gaps between the nodes of sliding contact: least gaps inside elements.
#include <algorithm>
#include <cmath>

#include "contact/layout_edit.hpp"
#include "contact/sliding_contact.hpp"
#include "core/lanes.hpp"

namespace arcwall {

using Layout_ = SlidingContactLayout;
using Span = SlidingContactLayout::Span;
using Bound = SlidingContactLayout::Bound;

namespace {

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

std::vector<Placed> placed_nodes(const SlidingMesh& mesh, Index strand, const MeshState& now) {
  const auto count = static_cast<std::size_t>(mesh.nodes(strand));
  std::vector<Placed> nodes(count);
  for (std::size_t first = 0; first < count; first += Lanes::count) {
    const std::size_t end = std::min<std::size_t>(first + Lanes::count, count);
    Lanes angle = 0.0;
    for (std::size_t i = first; i < end; ++i) {
      const AxisPlace place = mesh.node(strand, static_cast<Index>(i), now);
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

}  // namespace

// visit(Minimum) for each least gap inside an element, the gap being a cubic between its nodes. Beside contact points,
// and where the body lies on the wall, guards say all; these elements are left out unless `everywhere`.
template <typename Visit>
void SlidingContact::for_each_minimum(const State& state, bool everywhere, const Visit& visit) const {
  const Layout_& on = layout(state.piece);
  const SlidingMesh& mesh = on.mesh();
  const MeshState now = mesh_state_of(state);
  for (Index strand = 0; strand < body_.strands(); ++strand) {
    const auto concerns = [strand](const Obstacle& obstacle) {
      return obstacle.strands[static_cast<std::size_t>(strand)] != 0;
    };
    if (std::none_of(obstacles_.begin(), obstacles_.end(), concerns)) continue;
    const std::vector<Placed> nodes = placed_nodes(mesh, strand, now);
    for (std::size_t w = 0; w < obstacles_.size(); ++w) {
      if (!concerns(obstacles_[w])) continue;
      std::vector<std::uint8_t> skip(static_cast<std::size_t>(mesh.nodes(strand)), 0);  // element behind the node
      for (std::size_t k = 0; k < on.points().size() && !everywhere; ++k) {
        const auto [at, position] = mesh.breakpoint(static_cast<Index>(k));
        if (at != strand || on.points()[k].obstacle != w) continue;
        skip[static_cast<std::size_t>(position) - 1] = skip[static_cast<std::size_t>(position)] = 1;
        if (on.points()[k].behind == Span::free) continue;
        const Index last = mesh.breakpoint(static_cast<Index>(k) + 1).second;
        std::fill(skip.begin() + position, skip.begin() + last, std::uint8_t{1});
      }
      const double offset = normal_offset(w, strand);
      struct Sample {
        double gap;
        Vec2 face;
        double rate;  // of the gap, by the face moved along the tangent
      };
      const auto sample = [&](Index position) {
        const auto& [place, t] = nodes[static_cast<std::size_t>(position)];
        const double o = t.x() >= 0.0 ? offset : -offset;
        const Vec2 face = place + o * perp(t);
        Sample out{.gap = infinity, .face = face, .rate = 0.0};
        if (!obstacles_[w].profile->covers(face.x())) return out;
        const SurfaceSlope g = surface_slope(*obstacles_[w].profile, obstacles_[w].side, face);
        out.gap = g.value;
        out.rate = g.x * t.x() + g.z * t.y();
        return out;
      };
      Sample before = sample(0);
      for (Index e = 0; e + 1 < mesh.nodes(strand); ++e) {
        const Sample after = sample(e + 1);
        const double length = (after.face - before.face).norm();
        const double r0 = before.rate * length, r1 = after.rate * length;
        const bool far = std::min(before.gap, after.gap) > 0.5 * (std::abs(r0) + std::abs(r1));
        if (!skip[static_cast<std::size_t>(e)] && std::isfinite(before.gap) && std::isfinite(after.gap) &&
            (!far || everywhere))
          if (const auto least = least_inside(before.gap, r0, after.gap, r1)) {
            const double S1 = mesh.coordinate(strand, e, now.s), S2 = mesh.coordinate(strand, e + 1, now.s);
            visit(
                Minimum{.obstacle = w, .at = {.strand = strand, .s = S1 + least->at * (S2 - S1)}, .gap = least->value});
          }
        before = after;
      }
    }
  }
}

std::optional<SlidingContact::Minimum> SlidingContact::deepest(const State& state, double margin) const {
  std::optional<Minimum> deepest;
  for_each_minimum(state, false, [&](const Minimum& minimum) {
    if (minimum.gap < margin * scales_.length && (!deepest || minimum.gap < deepest->gap)) deepest = minimum;
  });
  return deepest;
}

bool SlidingContact::admissible(const State& state, double margin) const { return !deepest(state, margin); }

// Of the least gaps on the same strand and obstacle the one nearest another.
std::optional<SlidingContact::Minimum> SlidingContact::nearest(const State& state, const Minimum& other) const {
  std::optional<Minimum> nearest;
  for_each_minimum(state, true, [&](const Minimum& minimum) {
    if (minimum.obstacle != other.obstacle || minimum.at.strand != other.at.strand) return;
    if (!nearest || std::abs(minimum.at.s - other.at.s) < std::abs(nearest->at.s - other.at.s)) nearest = minimum;
  });
  return nearest;
}

// A least gap that becomes negative within the step is followed from the step's start on by an open point. It must
// exist there already.
std::optional<Transition> SlidingContact::with_inserted_contact(const State& from, const Direction& forward,
                                                                const State& to, double margin) const {
  const auto violated = deepest(to, margin);
  if (!violated) return std::nullopt;
  const auto start = nearest(from, *violated);
  const Index strand = violated->at.strand;
  if (!start || std::abs(start->at.s - violated->at.s) > 0.25 * body_.length(strand)) return std::nullopt;

  const Layout_& on = layout(from.piece);
  const Vector s = on.s_of(from);
  for (std::size_t k = 0; k < on.points().size(); ++k)
    if (on.points()[k].obstacle == start->obstacle && on.mesh().breakpoint(static_cast<Index>(k)).first == strand &&
        std::abs(s[static_cast<Index>(k)] - start->at.s) < least_span(strand))
      return std::nullopt;  // it is followed already
  const auto holds = [&](const Layout_::Segment& segment) {
    const auto [a, b] = on.ends(body_, segment, s);
    return segment.strand == strand && a <= start->at.s && start->at.s < b;
  };
  const auto at = std::find_if(on.segments().begin(), on.segments().end(), holds);
  if (at == on.segments().end()) return std::nullopt;
  // How many elements on each side: by where it will touch, roughly.
  const double fallen = start->gap - violated->gap;
  const double part = fallen > 0.0 ? std::clamp(start->gap / fallen, 0.0, 2.0) : 0.0;
  const double touch = start->at.s + part * (violated->at.s - start->at.s);
  const auto [a, b] = on.ends(body_, *at, s);
  const int elements = std::max(2, at->elements);
  const int first = std::clamp(static_cast<int>(std::lround(elements * (touch - a) / (b - a) - 1e-3)), 1, elements - 1);
  const auto at_least = [&](double begin, double end) {
    return static_cast<int>(std::ceil(body_.elements_between(strand, begin, end) / coarsest));
  };
  const int before = std::max(first, at_least(a, start->at.s));
  const int behind = std::max(elements - first, at_least(start->at.s, b));
  std::size_t k = 0;
  Transition transition = remeshed(from, forward, [&](LayoutEdit& edit) {
    k = edit.insert({.point = {.obstacle = start->obstacle}, .strand = strand, .s = start->at.s}, before, behind);
  });
  const auto& limits = layout(transition.guess.piece).limits();
  for (std::size_t l = 0; l < limits.size(); ++l) {
    const auto [bound, which] = limits[l];
    const bool shallow = bound == Bound::curvature && which == k;
    const bool cramped = bound == Bound::room;  // beside the end of the member, a load or a contact with another wall
    if ((shallow || cramped) && limit_value(transition.guess, l) <= 0.0) return std::nullopt;
  }
  return transition;
}

double SlidingContact::least_gap(const State& state, int places) const {
  const Layout_& on = layout(state.piece);
  const MeshState now = mesh_state_of(state);
  double least = infinity;
  for (std::size_t w = 0; w < obstacles_.size(); ++w)
    for (Index strand = 0; strand < body_.strands(); ++strand) {
      if (!obstacles_[w].strands[static_cast<std::size_t>(strand)]) continue;
      const Touch surface{.strand = strand, .position = 0, .obstacle = w, .offset = normal_offset(w, strand)};
      for (Index e = 0; e + 1 < on.mesh().nodes(strand); ++e)
        for (int i = 0; i <= places; ++i)
          least = std::min(least, face_gap(surface, on.mesh().inside(strand, e, double(i) / places, now)));
    }
  return least;
}

}  // namespace arcwall
