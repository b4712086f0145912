#include "apps/verify/passages.hpp"

#include <algorithm>
#include <cmath>

#include "apps/verify/sliding_touches.hpp"

namespace arcwall::verify {

namespace {

// A strand as a wall sees it.
struct SeenStrand {
  const Sliding& at;
  const PlainWall& wall;
  Index strand;

  Vec2 place(Index element, double fraction) const {
    return wall.at_rest(at.mesh.inside(strand, element, fraction, at.now).position);
  }
};

double angle_between(const Vec2& a, const Vec2& b) { return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)); }

// By which angle a part of an element goes round a place, its ends being `a` and `b`: what is not far from the place
// for its length is looked at in halves.
double angle_round(const SeenStrand& seen, const Vec2& place, Index element, double from, double to, int halvings) {
  const Vec2 a = seen.place(element, from) - place, b = seen.place(element, to) - place;
  if (halvings == 0 || std::min(a.norm(), b.norm()) > (b - a).norm()) return angle_between(a, b);
  const double middle = 0.5 * (from + to);
  return angle_round(seen, place, element, from, middle, halvings - 1) +
         angle_round(seen, place, element, middle, to, halvings - 1);
}

double angle_round(const SeenStrand& seen, const Vec2& place) {
  constexpr int halvings = 30;  // to round-off
  double angle = 0.0;
  for (Index e = 0; e + 1 < seen.at.mesh.nodes(seen.strand); ++e)
    angle += angle_round(seen, place, e, 0.0, 1.0, halvings);
  return angle;
}

// How often the way forth along one and back along the other goes round a place.
long rounds(const SeenStrand& forth, const SeenStrand& back, const Vec2& place) {
  const auto first = [&](const SeenStrand& seen) { return Vec2(seen.place(0, 0.0) - place); };
  const auto last = [&](const SeenStrand& seen) {
    return Vec2(seen.place(seen.at.mesh.nodes(seen.strand) - 2, 1.0) - place);
  };
  const double angle = angle_round(forth, place) + angle_between(last(forth), last(back)) - angle_round(back, place) -
                       angle_between(first(forth), first(back));
  return std::lround(angle / (2.0 * pi));
}

}  // namespace

void check_passages(const Model& model, const std::vector<PlainWall>& walls, const RecordPoint& from,
                    const RecordPoint& to, Findings& findings) {
  if (model.sliding() == nullptr) return;
  const Sliding before{.model = model, .state = from.state}, behind{.model = model, .state = to.state};
  for (const PlainWall& wall : walls) {
    const auto inside = wall.innermost();
    if (!inside) continue;
    for (Index strand = 0; strand < before.body.strands(); ++strand) {
      const std::string member = before.body.label({.strand = strand, .s = 0.5 * before.body.length(strand)}).first;
      if (!wall.concerns(member)) continue;
      const PlainWall wall_before = wall.at(from.state.lambda), wall_behind = wall.at(to.state.lambda);
      findings.require("no wall is passed through between two points",
                       rounds({before, wall_before, strand}, {behind, wall_behind, strand}, *inside) == 0,
                       member + " passes through " + wall.deck().name + " after the point before");
    }
  }
}

}  // namespace arcwall::verify
