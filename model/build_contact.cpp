#include "model/build_contact.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "contact/profile.hpp"
#include "core/text.hpp"
#include "elements/member_point.hpp"

namespace arcwall {

namespace {

// Offsets from the axis of the points that may touch: 0, or the face whose normal looks at the wall; both of a section
// that stands across it.
std::vector<double> offsets(const deck::Wall& wall, const MemberMesh& mesh, const MemberSection& section) {
  if (wall.acts_on == deck::ActsOn::axis) return {0.0};
  const double up = std::cos(section.shape.angle) * (wall.side == Side::above ? 1.0 : -1.0);
  const double half = 0.5 * mesh.height.value();
  constexpr double level = 1e-9;
  if (std::abs(up) <= level) return {half, -half};
  return {up > 0.0 ? half : -half};
}

// The deepest penetration of one wall at rest.
struct Penetration {
  double depth = 0.0;
  ContactLabel label{};
  bool everywhere = true;  ///< of all points that might touch
};

std::string how_to_part(const deck::Wall& wall, const Penetration& found) {
  const std::string apart = "move the wall or the member apart";
  if (!found.everywhere) return apart;
  const bool above = wall.side == Side::above;
  return fmt::format("side = \"{}\" means that the structure stays {} the wall: is \"{}\" meant? Else {}",
                     above ? "above" : "below", above ? "below" : "above", above ? "below" : "above", apart);
}

// A point of the structure that touches a wall at rest.
struct TouchAtRest {
  const deck::Wall* wall;
  Index node;
  ContactLabel label{};
  Vec2 normal{};  ///< of the wall, into the free side
};

// Two walls that touch a node from both sides hold it before any load. Contact that is open until a load closes it does
// not know that: stability would be that of the free structure.
void refuse_what_is_held_between_walls(const std::vector<TouchAtRest>& touches, DeckProblems& problems) {
  constexpr double opposite = -0.5;  // cosine between the normals
  std::vector<std::pair<const deck::Wall*, const deck::Wall*>> refused;
  for (const TouchAtRest& a : touches)
    for (const TouchAtRest& b : touches) {
      if (&a >= &b || a.node != b.node || a.normal.dot(b.normal) > opposite) continue;
      if (std::find(refused.begin(), refused.end(), std::pair(a.wall, b.wall)) != refused.end()) continue;
      refused.emplace_back(a.wall, b.wall);
      problems.add(
          b.wall->position, "wall." + b.wall->name,
          fmt::format("member \"{}\" touches walls \"{}\" and \"{}\" from both sides at the start, at {}:{:.4g}: "
                      "such walls hold it without a force, and contact that is closed before any load is not "
                      "modelled",
                      b.label.member, a.wall->name, b.wall->name, b.label.member, b.label.fraction),
          "leave a clearance, or let supports hold the member");
    }
}

std::unique_ptr<Profile> profile_of(const deck::Wall& wall) {
  struct Maker {
    Side side;
    std::unique_ptr<Profile> operator()(const deck::FlatProfile& p) const { return flat_profile(p.z); }
    std::unique_ptr<Profile> operator()(const deck::LineProfile& p) const { return line_profile(p.z, p.slope); }
    std::unique_ptr<Profile> operator()(const deck::CircleProfile& p) const {
      return circle_profile({p.centre.x, p.centre.z}, p.radius, side);
    }
    std::unique_ptr<Profile> operator()(const deck::ParabolaProfile& p) const {
      return parabola_profile({p.apex.x, p.apex.z}, p.curvature);
    }
    std::unique_ptr<Profile> operator()(const deck::SplineProfile& p) const { return spline_profile(p.x, p.z); }
  };
  return std::visit(Maker{wall.side}, wall.profile);
}

}  // namespace

RigidMotion motion_of(const deck::Wall& wall) {
  if (!wall.motion) return {};
  const deck::WallMotion& motion = *wall.motion;
  return {.way = {motion.x, motion.z}, .turn = motion.rotation, .about = {motion.about.x, motion.about.z}};
}

std::shared_ptr<const Obstacle> obstacle_of(const deck::Wall& wall) {
  std::shared_ptr<const Obstacle> at_rest = obstacle(profile_of(wall), wall.side);
  const RigidMotion motion = motion_of(wall);
  if (motion.is_none()) return at_rest;
  return std::make_shared<MovingObstacle>(std::move(at_rest), motion);
}

bool concerns(const deck::Wall& wall, const std::string& member) {
  return wall.members.empty() || std::find(wall.members.begin(), wall.members.end(), member) != wall.members.end();
}

std::vector<Candidate> contact_candidates(const deck::Deck& deck, const Structure& structure, DeckProblems& problems) {
  std::vector<Candidate> candidates;
  std::vector<TouchAtRest> touches;
  const double round_off = 1e-12 * structure.length_scale();
  const State rest{.x = Vector::Zero(structure.size({}))};
  for (const deck::Wall& wall : deck.walls) {
    const std::shared_ptr<const Obstacle> obstacle = obstacle_of(wall);
    std::vector<std::pair<Index, Vec2>> taken;  // node and place: members that meet share a point
    Penetration deepest;
    for (const MemberMesh& mesh : structure.members()) {
      if (!concerns(wall, mesh.name)) continue;
      if (wall.acts_on == deck::ActsOn::face && !mesh.rotations.front()) {
        problems.add(wall.position, "wall.acts_on",
                     "member \"" + mesh.name + "\" is a truss and has no faces that turn", "use acts_on = \"axis\"");
        continue;
      }
      for (const MemberSection& section : mesh.contact_sections())
        for (const double offset : offsets(wall, mesh, section)) {
          auto point = std::make_unique<MemberPoint>(structure, section, offset);
          const Vec2 place = point->position(rest);
          const auto same = [&](const auto& other) {
            return other.first == section.node && (other.second - place).norm() <= 1e-12 * structure.length_scale();
          };
          if (std::any_of(taken.begin(), taken.end(), same)) continue;
          taken.emplace_back(section.node, place);
          const bool movable = !point->unknowns().empty();
          Candidate candidate(
              std::move(point), obstacle,
              {.wall = wall.name, .member = mesh.name, .fraction = section.fraction, .tributary = section.tributary});
          const double gap = candidate.gap(rest);
          deepest.everywhere = deepest.everywhere && gap < 0.0;
          if (-gap > deepest.depth) {
            deepest.depth = -gap;
            deepest.label = candidate.label();
          }
          if (!movable) continue;
          if (std::abs(gap) <= round_off)
            touches.push_back(
                {.wall = &wall, .node = section.node, .label = candidate.label(), .normal = candidate.normal(rest)});
          candidates.push_back(std::move(candidate));
        }
    }
    if (deepest.depth > round_off)
      problems.add(wall.position, "wall." + wall.name,
                   fmt::format("member \"{}\" is inside the wall at the start: node {}:{:.4g} by {:.4g}",
                               deepest.label.member, deepest.label.member, deepest.label.fraction, deepest.depth),
                   how_to_part(wall, deepest));
  }
  refuse_what_is_held_between_walls(touches, problems);
  return candidates;
}

bool same_walls(const deck::Deck& deck, const std::string& a, const std::string& b) {
  return std::all_of(deck.walls.begin(), deck.walls.end(),
                     [&](const deck::Wall& wall) { return concerns(wall, a) == concerns(wall, b); });
}

std::vector<SlidingObstacle> sliding_obstacles(const deck::Deck& deck, const SlidingStructure& structure) {
  std::vector<SlidingObstacle> obstacles;
  for (const deck::Wall& wall : deck.walls) {
    SlidingObstacle obstacle{
        .name = wall.name, .surface = obstacle_of(wall), .on_face = wall.acts_on == deck::ActsOn::face};
    for (Index strand = 0; strand < structure.strands(); ++strand)
      obstacle.strands.push_back(concerns(wall, structure.label({.strand = strand, .s = 0.0}).first) ? 1 : 0);
    obstacles.push_back(std::move(obstacle));
  }
  return obstacles;
}

}  // namespace arcwall
