#include "model/build_compliant_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcwall {

namespace {

const deck::WallLaw& law_of(const deck::Deck& deck, const deck::Wall& wall) {
  return wall.law ? *wall.law : *deck.contact.law;
}

}  // namespace

std::vector<CompliantWallOfMember> compliant_walls(const deck::Deck& deck,
                                                   const std::function<const MemberMesh&(Index)>& mesh_of) {
  std::vector<CompliantWallOfMember> walls;
  if (!deck.contact.is_compliant()) return walls;
  using Touched = CompliantWall::Touched;
  for (const deck::Wall& wall : walls_in_parts(deck)) {
    const auto law = std::make_shared<const PressureLaw>(law_of(deck, wall).law());
    deck::Wall at_rest = wall;
    at_rest.motion.reset();
    for (std::size_t m = 0; m < deck.members.size(); ++m) {
      const deck::Member& member = deck.members[m];
      if (!concerns(wall, member.name) || member.theory == Theory::truss) continue;
      const auto index = static_cast<Index>(m);
      const double off = kept_off(wall, mesh_of(index).height_at(0.5).value_or(0.0));
      const std::shared_ptr<const Obstacle> obstacle = obstacle_of(wall, off);
      const bool on_axis = wall.contact_surface == deck::ContactSurface::axis;
      walls.push_back({.contact = {.name = wall.name,
                                   .member = index,
                                   .obstacle = obstacle,
                                   .friction = deck::friction_of(deck, wall, member.name, 0.5),
                                   .tangential_stiffness = law_of(deck, wall).along()},
                       .pressure = {.gap = gap_to(obstacle),
                                    .gap_of_ramp = gap_to(obstacle_of(at_rest, off)),
                                    .law = law,
                                    .touched = on_axis        ? Touched::axis
                                               : wall.outline ? Touched::outside
                                                              : Touched::face,
                                    .kept_off = off,
                                    .is_over = wall.side == Side::above,
                                    .rubs_axis = deck.contact.friction_at == deck::FrictionAt::axis}});
    }
  }
  return walls;
}

namespace {

// Two compliant walls that touch a member from both sides at the start without a clearance.
struct WithoutClearance {
  const deck::Wall *first, *second;
  std::string member;
};

std::optional<WithoutClearance> without_clearance(const deck::Deck& deck, const CompliantContact& contact,
                                                  const State& rest, double touching) {
  constexpr double opposite = -0.5;  // cosine between the normals
  for (Index i = 0; i < contact.contact_count(); ++i)
    for (Index j = i + 1; j < contact.contact_count(); ++j) {
      const CompliantContact::Wall &a = contact.wall(i), &b = contact.wall(j);
      if (a.member != b.member || a.name == b.name) continue;
      const auto near = contact.nearest(rest, i), other = contact.nearest(rest, j);
      if (std::max(std::abs(near.gap), std::abs(other.gap)) > touching) continue;
      if (a.obstacle->normal(near.place, 0.0).dot(b.obstacle->normal(other.place, 0.0)) > opposite) continue;
      return WithoutClearance{.first = deck::find(deck.walls, a.name),
                              .second = deck::find(deck.walls, b.name),
                              .member = deck.members[static_cast<std::size_t>(a.member)].name};
    }
  return std::nullopt;
}

// What friction along members asks besides.
void check_friction_along(const deck::Deck& deck, DeckProblems& problems) {
  for (const deck::FrictionPair& pair : deck.frictions)
    if (!pair.point.empty())
      problems.add(pair.position, "friction.point",
                   "friction of compliant walls acts along members, and a point has none of its own",
                   "name the member");
  const bool on_axis = deck.contact.friction_at == deck::FrictionAt::axis;
  for (const deck::Wall& wall : deck.walls) {
    const bool rough = std::any_of(deck.members.begin(), deck.members.end(), [&](const deck::Member& member) {
      return concerns(wall, member.name) && deck::friction_of(deck, wall, member.name, 0.5) > 0.0;
    });
    if (!rough) continue;
    if (const auto& law = law_of(deck, wall); !(law.along() > 0.0))
      problems.add(wall.position, "wall.law",
                   "the law has no stiffness at penetration 0, from which that along the wall could be taken",
                   "give the law a tangential_stiffness");
    if (wall.contact_surface != deck::ContactSurface::face) continue;
    if (wall.outline)
      problems.add(wall.position, "wall.friction", "friction on faces that roll on an outline is not known",
                   "write contact_surface = \"axis\", or use a profile");
    const bool is_flat = std::holds_alternative<deck::FlatProfile>(wall.profile) ||
                         std::holds_alternative<deck::LineProfile>(wall.profile);
    if (!wall.outline && !is_flat && on_axis)
      problems.add(wall.position, "wall.friction", "friction on the axis beside a curved profile is not known",
                   "leave out contact.friction_at");
  }
}

}  // namespace

void check_compliant_walls(const deck::Deck& deck, const Structure& structure, DeckProblems& problems) {
  if (!deck.contact.is_compliant()) {
    for (const deck::Wall& wall : deck.walls)
      if (wall.law)
        problems.add(wall.position, "wall.law", "wall \"" + wall.name + "\" has a law, and walls are rigid",
                     "write contact.method = \"compliant\", or remove the law");
    return;
  }
  if (deck.path.method == deck::PathMethod::incremental)
    problems.add(deck.path.position, "path.method", "method \"incremental\" does not support compliant walls",
                 "use \"spherical\", or contact.method = \"penalty\"");
  check_friction_along(deck, problems);
  bool possible = true;
  for (const deck::Wall& wall : deck.walls) {
    if (wall.interference > 0.0)
      problems.add(wall.position, "wall.interference", "compliant walls have no interference: they begin untouched",
                   "move the wall into place in a stage, with `motion`, or use contact.method = \"multiplier\"");
    for (const MemberMesh& mesh : structure.members()) {
      if (!concerns(wall, mesh.name)) continue;
      if (mesh.rotations.front()) {
        possible = can_touch(wall, mesh, {}, deck.frame.factor(), problems) && possible;
      } else if (!wall.members.empty()) {
        problems.add(wall.position, "wall.members",
                     "member \"" + mesh.name + "\" is a truss, which cannot carry the pressure of a compliant wall",
                     "leave it out of `members`, or use contact.method = \"multiplier\"");
      } else {
        problems.add(wall.position, "wall." + wall.name,
                     "the wall is in the way of \"" + mesh.name +
                         "\", a truss, which cannot carry the pressure of a compliant wall",
                     "name other members in `members`, or use contact.method = \"multiplier\"");
      }
    }
  }
  if (!possible) return;
  std::vector<CompliantContact::Wall> walls;
  for (const CompliantWallOfMember& wall : compliant_walls(
           deck, [&](Index m) -> const MemberMesh& { return structure.members()[static_cast<std::size_t>(m)]; }))
    walls.push_back(wall.contact);
  const CompliantContact contact(structure, std::move(walls), structure.length_scale());
  const double round_off = 1e-12 * structure.length_scale();
  const State rest{.x = Vector::Zero(structure.size({}))};
  for (Index j = 0; j < contact.contact_count(); ++j) {
    const auto found = contact.nearest(rest, j);
    if (found.gap >= -round_off) continue;
    const std::string& name = contact.wall(j).name;
    const deck::Wall& wall = *deck::find(deck.walls, name);
    problems.add(wall.position, "wall." + name,
                 fmt::format("member \"{0}\" is inside the wall at the start: at {0}:{1:.4g} by {2:.9g}{3}",
                             contact.contact(rest, j).label.member, found.fraction, -deck.frame.factor() * found.gap,
                             deck.units.length.empty() ? "" : " " + deck.units.length),
                 "move the wall");
  }
  if (const auto pair = without_clearance(deck, contact, rest, round_off))
    problems.add(pair->second->position, "wall." + pair->second->name,
                 fmt::format("member \"{}\" touches walls \"{}\" and \"{}\" from both sides at the start, where the "
                             "stiffness of both is one-sided",
                             pair->member, pair->first->name, pair->second->name),
                 "leave a clearance, or write a [[spring]] with `on` and `foundation`");
}

}  // namespace arcwall
