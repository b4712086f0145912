#include "apps/verify/spline_pulls.hpp"

#include <algorithm>
#include <cmath>

#include "apps/verify/sliding_touches.hpp"

namespace arcwall::verify {

namespace {

// The nodes of a pressed part, from the first one inside to the last, by their positions along the strand.
struct Part {
  Index strand = 0, first = 0, last = 0;
  Index force = 0;  // of the first, in State::x
  std::size_t obstacle = 0;
};

std::vector<Part> parts_of(const Sliding& at) {
  std::vector<Part> parts;
  const auto& nodes = at.on.pressed_nodes();
  const auto closed = at.state.active_set.closed_count();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i > 0 && nodes[i].segment == nodes[i - 1].segment) {
      parts.back().last = nodes[i].position;
      continue;
    }
    parts.push_back({.strand = nodes[i].strand,
                     .first = nodes[i].position,
                     .last = nodes[i].position,
                     .force = at.mesh.unknowns() + static_cast<Index>(closed) + static_cast<Index>(i),
                     .obstacle = nodes[i].obstacle});
  }
  return parts;
}

// The mean force of the nodes on both sides of an element of a part, three on each.
double force_beside(const Sliding& at, const Part& part, Index element) {
  const Index from = std::max(part.first, element - 2), to = std::min(part.last, element + 3);
  if (from > to) return 0.0;
  return at.state.x.segment(part.force + from - part.first, to - from + 1).mean();
}

// visit(position, force) of each point of a spline that lies in an element of a part, with what it asks for there.
template <class Visit>
void for_each_knot(const Sliding& at, const PlainWall& wall, const Part& part, const Visit& visit) {
  const double half = at.body.half_height(part.strand);
  const auto x = [&](Index position) {
    return wall.profile_x(face_towards(wall, half, at.mesh.node(part.strand, position, at.now)));
  };
  for (const PlainWall::RateJump& jump : wall.rate_jumps())
    for (Index position = part.first - 1; position <= part.last; ++position)
      if ((x(position) < jump.x) != (x(position + 1) < jump.x))
        visit(position, wall.side() * jump.jump *
                            at.body.bending_stiffness(
                                {.strand = part.strand, .s = at.mesh.coordinate(part.strand, position, at.now.s)}));
}

void add_pulls(const Sliding& at, const PlainWall& wall, const Part& part, std::vector<SplinePull>& to) {
  constexpr double shown = 6.0;  // elements
  const double L = at.body.length(part.strand), asked = L / at.body.elements_between(part.strand, 0.0, L);
  const auto s = [&](Index position) { return at.mesh.coordinate(part.strand, position, at.now.s); };
  for_each_knot(at, wall, part, [&](Index position, double force) {
    const auto [member, fraction] = at.body.label({.strand = part.strand, .s = 0.5 * (s(position) + s(position + 1))});
    const double pressure = force_beside(at, part, position) / (s(position + 1) - s(position));
    to.push_back({.label = {.wall = wall.deck().name, .member = member, .fraction = fraction},
                  .pull = -force,
                  .held = shown * asked * std::max(pressure, 0.0)});
  });
}

}  // namespace

std::vector<SplinePull> spline_pulls(const Model& model, const std::vector<PlainWall>& walls, const State& state) {
  std::vector<SplinePull> pulls;
  if (model.sliding() == nullptr) return pulls;
  const Sliding at{.model = model, .state = state};
  for (const Part& part : parts_of(at))
    add_pulls(at, wall_of(walls, model.sliding()->obstacles()[part.obstacle].name), part, pulls);
  std::erase_if(pulls, [](const SplinePull& pull) { return pull.pull <= 0.0; });
  return pulls;
}

std::vector<double> knot_ringing(const Model& model, const std::vector<PlainWall>& walls, const State& state) {
  std::vector<double> ringing;
  const Sliding at{.model = model, .state = state};
  for (const Part& part : parts_of(at)) {
    const std::size_t before = ringing.size();
    ringing.resize(before + static_cast<std::size_t>(part.last - part.first + 1), 0.0);
    for_each_knot(at, wall_of(walls, model.sliding()->obstacles()[part.obstacle].name), part,
                  [&](Index element, double force) {
                    for (Index node = part.first; node <= part.last; ++node) {
                      const Index away = node <= element ? element - node : node - element - 1;
                      ringing[before + static_cast<std::size_t>(node - part.first)] +=
                          std::ldexp(std::abs(force), -static_cast<int>(away));
                    }
                  });
  }
  return ringing;
}

}  // namespace arcwall::verify
