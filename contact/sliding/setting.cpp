#include "contact/sliding/setting.hpp"

#include <algorithm>
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
        const StrandEnd first = body.first_of_joint(strand, last, !obstacles[w].on_face);
        const auto same = std::find_if(ends.begin(), ends.end(), [&](const FreeEnd& end) {
          return end.obstacle == w && end.strand == first.strand && end.last == first.last;
        });
        if (same != ends.end()) {
          same->joined.push_back({.strand = strand, .last = last});
          continue;
        }
        FreeEnd end{.strand = strand, .last = last, .obstacle = w};
        const double along = std::cos(mesh.node(strand, end.position(mesh), rest).angle);
        if (std::abs(along) > vertical) end.travel = std::copysign(1.0, along);
        ends.push_back(end);
      }
  return ends;
}

}  // namespace arcwall
