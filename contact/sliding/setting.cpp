#include "contact/sliding/setting.hpp"

#include <cmath>
#include <map>
#include <tuple>

#include "contact/sliding/tolerances.hpp"
#include "contact/sliding/touch.hpp"
#include "core/unit_tangent.hpp"

namespace arcwall {

namespace {

// Of an end that a support holds in z; `at`: its axis in the stress-free shape. What bears the end from the start is
// its support, but for a wall that is across its way or at an angle with the body.
bool roller_touches(const SlidingObstacle& obstacle, const AxisPlace& at, double half_height, double near) {
  constexpr double across = 0.5;  // part of the wall's normal in x
  if (!obstacle.may_stop_rollers) return false;
  const LinearField gap = obstacle.unmoved->gap_slope(sliding::face(obstacle.face_offset(half_height), at), 0.0);
  if (gap.value > near) return true;
  const bool crosses = std::abs(Vec2(gap.x, gap.z).dot(unit_tangent(at.angle))) > sliding::nearly_parallel;
  return std::abs(gap.x) > (crosses ? sliding::exactly_parallel : across);
}

}  // namespace

BodyEnds ends_beside_obstacles(const SlidingBody& body, const std::vector<SlidingObstacle>& obstacles,
                               const SlidingMesh& mesh, const MeshState& rest) {
  std::vector<FreeEnd> ends, held;
  std::map<std::tuple<std::size_t, Index, bool>, std::size_t> known;  // obstacle, strand, last: which of the ends
  for (Index strand = 0; strand < body.strands(); ++strand)
    for (std::size_t w = 0; w < obstacles.size(); ++w)
      for (const bool last : {false, true}) {
        FreeEnd end{.strand = strand, .last = last, .obstacle = w};
        const AxisPlace at = mesh.node(strand, end.position(mesh), rest);
        const bool slides = mesh.node_unknowns(strand, end.position(mesh))[0] >= 0;
        const bool may_touch = !body.end_is_held(strand, last) || body.is_on_plane(strand, last) ||
                               (slides && roller_touches(obstacles[w], at, body.half_height(strand),
                                                         sliding::touching_at_rest * body.length(strand)));
        if (!obstacles[w].concerns(strand)) continue;
        if (!may_touch) {
          held.push_back(end);
          continue;
        }
        const StrandEnd first = body.first_of_joint(strand, last, !obstacles[w].on_face);
        const auto same = known.find({w, first.strand, first.last});
        if (same != known.end()) {
          ends[same->second].joined.push_back({.strand = strand, .last = last});
          continue;
        }
        const double along = std::cos(at.angle);
        if (std::abs(along) > sliding::nearly_parallel) end.travel = std::copysign(1.0, along);
        known[{w, strand, last}] = ends.size();
        ends.push_back(end);
      }
  return {.free = std::move(ends), .held = std::move(held)};
}

}  // namespace arcwall
