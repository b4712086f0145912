#include "contact/sliding/setting.hpp"

#include <cmath>

namespace arcwall {

std::vector<FreeEnd> free_ends(const SlidingBody& body, const std::vector<SlidingObstacle>& obstacles,
                               const SlidingMesh& mesh, const MeshState& rest) {
  constexpr double vertical = 1e-6;  // cosine of an axis that stands upright
  std::vector<FreeEnd> ends;
  for (Index strand = 0; strand < body.strands(); ++strand)
    for (std::size_t w = 0; w < obstacles.size(); ++w)
      for (const bool last : {false, true}) {
        if (!obstacles[w].concerns(strand) || body.end_is_held(strand, last)) continue;
        const auto same = body.same_end_before(strand, last);
        if (same && obstacles[w].concerns(same->first)) continue;
        FreeEnd end{.strand = strand, .last = last, .obstacle = w};
        const double along = std::cos(mesh.node(strand, end.position(mesh), rest).angle);
        if (std::abs(along) > vertical) end.travel = std::copysign(1.0, along);
        ends.push_back(end);
      }
  return ends;
}

}  // namespace arcwall
