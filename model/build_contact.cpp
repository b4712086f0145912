#include "model/build_contact.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "contact/profile.hpp"
#include "core/text.hpp"
#include "elements/member_point.hpp"

namespace arcwall {

namespace {

// Half the height of a section whose faces a wall is touched by; 0 where that is the axis.
double faces_of(const deck::Wall& wall, double height) {
  return wall.contact_surface == deck::ContactSurface::axis || wall.outline ? 0.0 : 0.5 * height;
}

double height_of(const MemberMesh& mesh, double fraction) { return mesh.height_at(fraction).value_or(0.0); }

// Offsets from the axis of the points that may touch.
std::vector<double> offsets(const deck::Wall& wall, const MemberMesh& mesh, const MemberSection& section) {
  return FacedObstacle{.side = wall.side, .half_height = faces_of(wall, height_of(mesh, section.fraction))}.offsets(
      section.shape.angle);
}

// The deepest penetration of one wall at rest.
struct Penetration {
  double depth = 0.0;
  ContactLabel label{};
  bool everywhere = true;  ///< of all points before or behind the wall
};

// Which side of an outline the structure is on, and how that is changed.
std::string other_side_of(const deck::Outline& outline) {
  if (std::holds_alternative<deck::HalfPlaneOutline>(outline))
    return "the structure lies on the side of `normal`: turn that round";
  const auto is_open = [](const auto* points) { return points != nullptr && !points->closed; };
  if (is_open(std::get_if<deck::PolylineOutline>(&outline)) || is_open(std::get_if<deck::CurveOutline>(&outline)))
    return "the structure lies to the left of the outline, on the way from its first point to its last: reverse the "
           "points";
  return "the structure lies on the side of `structure`: change that";
}

std::string how_to_part(const deck::Wall& wall, const Penetration& found) {
  const std::string apart = "move the wall, or give it an interference";
  if (!found.everywhere) return apart;
  if (wall.outline) return other_side_of(*wall.outline) + " if the other side is meant. Else " + apart;
  const bool above = wall.side == Side::above;
  return fmt::format("side = \"{}\" means that the structure stays {} the wall: is \"{}\" meant? Else {}",
                     above ? "above" : "below", above ? "below" : "above", above ? "below" : "above", apart);
}

constexpr double drawn_to = 1e-6;  // of the structure's length: what the digits of a deck leave open

// A point of the structure that touches a wall at rest.
struct TouchAtRest {
  const deck::Wall* wall;
  Index node;
  std::size_t candidate;
  Vec2 place{};   ///< of the node
  Vec2 normal{};  ///< of the wall, into the free side
  bool straight;  ///< the wall
};

// Whether a motion of the structure changes a gap: supports may hold the point across the wall already.
bool changes(const Candidate& candidate, const State& rest) {
  constexpr double least = 1e-9;  // of the motion
  Gap gap;
  candidate.gap(rest, gap);
  return gap.gradient.norm() > least;
}

// The direction of a wall that is straight all along.
std::optional<Vec2> straight_direction(const deck::Wall& wall) {
  if (!wall.outline) {
    if (std::holds_alternative<deck::FlatProfile>(wall.profile)) return Vec2::UnitX();
    const auto* line = std::get_if<deck::LineProfile>(&wall.profile);
    return line ? std::optional(Vec2(1.0, line->slope)) : std::nullopt;
  }
  if (const auto* plane = std::get_if<deck::HalfPlaneOutline>(&*wall.outline))
    return Vec2(plane->normal.z, -plane->normal.x);
  if (const auto* line = std::get_if<deck::PolylineOutline>(&*wall.outline)) {
    const std::vector<Vec2> points = line->points();
    if (points.size() == 2) return points[1] - points[0];
  }
  return std::nullopt;
}

// How many ways the structure may move the point at which a wall's friction acts: at most two.
Index motions(const Candidate& candidate, const State& rest) {
  constexpr double least = 1e-9;  // of the motion
  PointKinematics at;
  candidate.rubbing_point().kinematics(rest, at);
  // The singular values of its two rows, of which the lesser keeps its digits.
  const Vector x = at.jacobian.row(0), z = at.jacobian.row(1);
  const double a = x.squaredNorm(), c = z.squaredNorm(), b = x.dot(z);
  const double greater = std::sqrt(0.5 * (a + c) + std::hypot(0.5 * (a - c), b));
  if (greater <= least) return 0;
  const Vector across = a < c ? Vector(x - b / c * z) : Vector(z - b / a * x);
  return across.norm() * std::sqrt(std::max(a, c)) / greater > least ? 2 : 1;
}

// Whether the structure may move a point along a wall, besides across it: else what holds it there bears the friction.
bool moves_along(const Candidate& candidate, const State& rest) {
  return !candidate.faces_wall(rest) || motions(candidate, rest) == 2;
}

// Whether λ moves a point along the wall that it faces. Along a wall that is curved or turns, a point slides that λ
// moves one way and that is free the other, wherever it touches.
bool is_moved_along(const deck::Wall& wall, const Candidate& candidate, const State& rest) {
  constexpr double least = 1e-9;  // of the motion
  PointKinematics at;
  candidate.rubbing_point().kinematics(rest, at);
  const double along = std::abs(cross(candidate.normal(rest), at.rate));
  const bool stays_straight = straight_direction(wall) && motion_of(wall).turn == 0.0;
  return along > least * at.rate.norm() || (!stays_straight && motions(candidate, rest) == 1 && at.rate.norm() > 0.0);
}

bool acts_on_axis(const TouchAtRest& touch) { return touch.wall->contact_surface == deck::ContactSurface::axis; }

// Why two walls that touch a node from both sides do not hold it as one contact, and what to do.
struct NotOneContact {
  std::string why, cure;
};

std::optional<NotOneContact> not_one_contact(const TouchAtRest& a, const TouchAtRest& b) {
  constexpr double parallel = 1e-12;  // square of the angle between the walls
  if (!acts_on_axis(a) || !acts_on_axis(b))
    return NotOneContact{.why = "faces between walls without clearance part from them as soon as the section turns",
                         .cure = "put both walls at the axis, with contact_surface = \"axis\", or leave a clearance"};
  const RigidMotion motion = motion_of(*a.wall);
  if (!(motion == motion_of(*b.wall)) || motion.turn != 0.0)
    return NotOneContact{.why = "walls without clearance hold a node for good only where they move together, unturned",
                         .cure = "give both walls the same motion, without a rotation, or leave a clearance"};
  if (a.straight && b.straight && 1.0 + a.normal.dot(b.normal) <= parallel) return std::nullopt;
  return NotOneContact{
      .why = "walls without clearance hold a node for good only where both are straight and parallel",
      .cure =
          "let a support hold the place, its rotation too where stops leave the axis no turn, or leave a "
          "clearance, with contact.points = \"nodes\""};
}

// Whether a place where two walls touch a node is one of those that are known.
bool is_known(const PinchedPlaces& known, const TouchAtRest& a, const TouchAtRest& b, double near) {
  return std::any_of(known.begin(), known.end(), [&](const SlidingContact::PinchedPlace& pinch) {
    const bool same = (pinch.obstacle == a.wall->name && pinch.other == b.wall->name) ||
                      (pinch.obstacle == b.wall->name && pinch.other == a.wall->name);
    return same && (pinch.place - a.place).norm() <= near;
  });
}

// Two walls that touch a node from both sides at rest hold it without a force, now and later: its candidates are made
// opposite to each other. Where the walls would part from it, contact that is closed without a force is not modelled.
void join_opposite(const std::vector<TouchAtRest>& touches, const PinchedPlaces& known, double near,
                   std::vector<Candidate>& candidates, DeckProblems& problems) {
  constexpr double opposite = -0.5;  // cosine between the normals
  std::vector<std::pair<const deck::Wall*, const deck::Wall*>> refused;
  for (const TouchAtRest& a : touches)
    for (const TouchAtRest& b : touches) {
      if (&a >= &b || a.node != b.node || a.normal.dot(b.normal) > opposite) continue;
      if (is_known(known, a, b, near)) continue;
      const auto odd = not_one_contact(a, b);
      if (!odd) {
        Candidate &first = candidates[a.candidate], &second = candidates[b.candidate];
        if (first.opposite() || second.opposite()) continue;
        first.set_opposite(static_cast<Index>(b.candidate));
        second.set_opposite(static_cast<Index>(a.candidate));
        continue;
      }
      if (std::find(refused.begin(), refused.end(), std::pair(a.wall, b.wall)) != refused.end()) continue;
      refused.emplace_back(a.wall, b.wall);
      const ContactLabel& label = candidates[b.candidate].label();
      problems.add(b.wall->position, "wall." + b.wall->name,
                   fmt::format("member \"{}\" touches walls \"{}\" and \"{}\" from both sides at the start, at "
                               "{}:{:.4g}: {}",
                               label.member, a.wall->name, b.wall->name, label.member, label.fraction, odd->why),
                   odd->cure);
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
  return {.way = {motion.x, motion.z},
          .turn = motion.rotation,
          .about = {motion.about.x, motion.about.z},
          .gone = motion.progress.constant,
          .rate = motion.progress.proportional};
}

std::vector<deck::Wall> parts_of(const deck::Wall& wall) {
  const auto* line = wall.outline ? std::get_if<deck::PolylineOutline>(&*wall.outline) : nullptr;
  if (line == nullptr) return {wall};
  std::vector<deck::Wall> parts;
  for (deck::PolylineOutline::Part& part : line->without_sharp_hollows(wall.radii())) {
    parts.push_back(wall);
    if (!part.outline.closed) part.radii = {part.radii.begin() + 1, part.radii.end() - 1};
    parts.back().outline = std::move(part.outline);
    if (!wall.corner_radii.empty()) parts.back().corner_radii = std::move(part.radii);
  }
  return parts;
}

std::vector<deck::Wall> walls_in_parts(const deck::Deck& deck) {
  std::vector<deck::Wall> walls;
  for (const deck::Wall& wall : deck.walls)
    for (deck::Wall& part : parts_of(wall)) walls.push_back(std::move(part));
  return walls;
}

std::unique_ptr<Outline> outline_of(const deck::Wall& wall) {
  struct Maker {
    const deck::Wall& wall;
    std::unique_ptr<Outline> operator()(const deck::HalfPlaneOutline& o) const {
      return half_plane_outline({o.point.x, o.point.z}, {o.normal.x, o.normal.z});
    }
    std::unique_ptr<Outline> operator()(const deck::CircleOutline& o) const {
      return circle_outline({o.centre.x, o.centre.z}, o.radius, o.keep);
    }
    std::unique_ptr<Outline> operator()(const deck::PolylineOutline& o) const {
      return o.closed ? closed_polyline_outline(o.points(), wall.radii(), o.keep)
                      : polyline_outline(o.points(), wall.radii());
    }
    std::unique_ptr<Outline> operator()(const deck::EllipseOutline& o) const {
      return ellipse_outline({o.centre.x, o.centre.z}, {o.axes.x, o.axes.z}, o.angle, o.keep);
    }
    std::unique_ptr<Outline> operator()(const deck::CurveOutline& o) const {
      return o.closed ? closed_curve_outline(o.points(), o.keep) : curve_outline(o.points());
    }
  };
  return std::visit(Maker{wall}, *wall.outline);
}

std::shared_ptr<const Obstacle> obstacle_of(const deck::Wall& wall, double half_height) {
  std::shared_ptr<const Obstacle> at_rest =
      wall.outline ? obstacle(std::shared_ptr(outline_of(wall)), half_height, wall.retracted)
                   : obstacle(profile_of(wall), wall.side);
  const RigidMotion motion = motion_of(wall);
  if (motion.is_none()) return at_rest;
  return std::make_shared<MovingObstacle>(std::move(at_rest), motion);
}

namespace {

// Whether the stress-free member lies on the line, its nodes and its tangents there.
bool lies_on(const deck::LineProfile& line, const MemberMesh& mesh) {
  constexpr double roundoff = 1e-12;  // of the member's length
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    const AxisPoint at = mesh.shape[k];
    const double off = at.position.y() - line.z - line.slope * at.position.x();
    const double turned = std::remainder(at.angle - std::atan(line.slope), pi);
    if (std::abs(off) > roundoff * mesh.length || std::abs(turned) > roundoff) return false;
  }
  return true;
}

// A support may say what the rotation of an end is.
bool is_turned_by_a_support(const deck::Deck& deck, const std::string& point) {
  return std::any_of(deck.supports.begin(), deck.supports.end(), [&](const deck::Support& support) {
    const auto& held = support.directions;
    return support.point == point && std::find(held.begin(), held.end(), Dof::rotation) != held.end();
  });
}

void hold_rotations(const deck::Deck& deck, const deck::Member& member, const MemberMesh& mesh,
                    StructureBuilder& builder) {
  const std::size_t last = mesh.rotations.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const bool held =
        (k == 0 && is_turned_by_a_support(deck, member.from)) || (k == last && is_turned_by_a_support(deck, member.to));
    if (mesh.rotations[k] && !held) builder.fix(*mesh.rotations[k]);
  }
}

}  // namespace

void hold_between_walls(const deck::Deck& deck, StructureBuilder& builder) {
  if (deck.contact.method == ContactLaw::Method::penalty || deck.contact.is_compliant()) return;
  const deck::WallsWithoutClearance without_clearance(deck);
  for (std::size_t i = 0; i < deck.walls.size(); ++i)
    for (const std::size_t k : without_clearance.beside(i)) {
      const deck::Wall &under = deck.walls[i], &over = deck.walls[k];
      const auto line = under.side == Side::below ? line_without_clearance(deck, under, over) : std::nullopt;
      if (!line) continue;
      for (std::size_t m = 0; m < deck.members.size(); ++m) {
        const deck::Member& member = deck.members[m];
        const bool turns_with_axis = member.theory == Theory::euler_bernoulli || member.theory == Theory::elastica;
        const MemberMesh& mesh = builder.mesh(static_cast<Index>(m));
        if (turns_with_axis && concerns(under, member.name) && concerns(over, member.name) && lies_on(*line, mesh))
          hold_rotations(deck, member, mesh, builder);
      }
    }
}

double kept_off(const deck::Wall& wall, double height) {
  return wall.outline && wall.contact_surface == deck::ContactSurface::face ? 0.5 * height : 0.0;
}

namespace {

bool has_sharp_corners(const deck::Wall& wall) {
  if (!wall.outline || !std::holds_alternative<deck::PolylineOutline>(*wall.outline)) return false;
  const std::vector<double> radii = wall.radii();
  const auto corners = std::get<deck::PolylineOutline>(*wall.outline).corners();
  return std::any_of(corners.begin(), corners.end(), [&](const auto& corner) { return radii[corner.point] == 0.0; });
}

// Whether a wall has a corner that is one of two knife edges.
bool has_knife_edge(const deck::Wall& wall, const PinchedPlaces& known) {
  return std::any_of(known.begin(), known.end(), [&](const SlidingContact::PinchedPlace& pinch) {
    return pinch.knife_edges && (pinch.obstacle == wall.name || pinch.other == wall.name);
  });
}

}  // namespace

bool can_touch(const deck::Wall& wall, const MemberMesh& mesh, const PinchedPlaces& known, double unit,
               DeckProblems& problems) {
  if (!wall.outline) return true;
  if (wall.contact_surface == deck::ContactSurface::face && !mesh.thickness.empty()) {
    problems.add(wall.position, "wall.contact_surface",
                 "member \"" + mesh.name + "\" changes its thickness, which the distance from an outline does not know",
                 "use contact_surface = \"axis\", or a profile");
    return false;
  }
  double height = 0.0;  // the greatest
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) height = std::max(height, height_of(mesh, mesh.fraction(k)));
  const double off = kept_off(wall, height);
  const std::vector<deck::Wall> parts = parts_of(wall);
  if (off == 0.0 && std::any_of(parts.begin(), parts.end(), has_sharp_corners) && !has_knife_edge(wall, known)) {
    problems.add(
        wall.position, "wall.corner_radius",
        "the corners of the outline are sharp, and members touch it with their axes: that is modelled only where "
        "two corners hold an axis between them from the start, as knife edges, and contact slides",
        "give a corner_radius, or let faces touch, with contact_surface = \"face\"");
    return false;
  }
  double hollow = 0.0;
  for (const deck::Wall& part : parts) hollow = std::max(hollow, outline_of(part)->sharpest_hollow());
  if (off * hollow >= 1.0) {
    problems.add(wall.position, "wall.outline",
                 fmt::format("the outline is hollow with a radius of {:.4g} somewhere, and member \"{}\" with half its "
                             "height, {:.4g}, does not fit into it",
                             unit / hollow, mesh.name, unit * off),
                 "make the outline's bends wider, or use contact_surface = \"axis\"");
    return false;
  }
  return true;
}

FacedObstacle faced_obstacle(const deck::Wall& wall, const MemberMesh& mesh, double fraction) {
  const double height = height_of(mesh, fraction);
  return {
      .obstacle = obstacle_of(wall, kept_off(wall, height)), .side = wall.side, .half_height = faces_of(wall, height)};
}

PinchedPlaces pinched_places(const deck::Deck& deck, const SlidingStructure& structure) {
  const ContactScales scales{.length = structure.length_scale(), .force = structure.force_scale()};
  return SlidingContact(structure, sliding_obstacles(deck, structure), scales).pinches();
}

std::vector<std::uint8_t> stand_for_members(const Structure& structure, const std::vector<Candidate>& candidates) {
  std::unordered_map<Index, int> ends_at;  // of each node the members' ends there
  std::unordered_map<std::string, const MemberMesh*> named;
  for (const MemberMesh& mesh : structure.members()) {
    named.emplace(mesh.name, &mesh);
    for (const Index node : {mesh.nodes.front(), mesh.nodes.back()}) ++ends_at[node];
  }
  std::vector<std::uint8_t> result;
  for (const Candidate& candidate : candidates) {
    const ContactLabel& label = candidate.label();
    const MemberMesh& mesh = *named.at(label.member);
    const bool turns = mesh.rotations.front().has_value();
    const bool at_end = label.fraction == 0.0 || label.fraction == 1.0;
    const Index node = label.fraction == 0.0 ? mesh.nodes.front() : mesh.nodes.back();
    result.push_back(turns && !(at_end && ends_at[node] == 1) ? 1 : 0);
  }
  return result;
}

std::vector<Candidate> contact_candidates(const deck::Deck& deck, const Structure& structure,
                                          const PinchedPlaces& known, DeckProblems& at_rest, DeckProblems& problems) {
  std::vector<Candidate> candidates, held;
  std::vector<TouchAtRest> touches;
  const double round_off = 1e-12 * structure.length_scale();
  const State rest{.x = Vector::Zero(structure.size({}))};
  const std::string length = deck.units.length.empty() ? "" : " " + deck.units.length;
  for (const deck::Wall& wall : deck.walls) {
    std::unordered_multimap<Index, std::pair<Vec2, double>> taken;  // of a node: members that meet share its point
    Penetration deepest;
    std::map<double, std::shared_ptr<const Obstacle>> obstacles;  // by how far axes stay off
    for (const MemberMesh& mesh : structure.members()) {
      if (!concerns(wall, mesh.name) || !can_touch(wall, mesh, known, deck.frame.factor(), at_rest)) continue;
      if (wall.contact_surface == deck::ContactSurface::face && !wall.outline && !mesh.rotations.front()) {
        at_rest.add(wall.position, "wall.contact_surface",
                    "member \"" + mesh.name + "\" is a truss and has no faces that turn",
                    "use contact_surface = \"axis\"");
        continue;
      }
      for (const MemberSection& section : mesh.contact_sections()) {
        const double off = kept_off(wall, height_of(mesh, section.fraction));
        std::shared_ptr<const Obstacle>& obstacle = obstacles[off];
        if (!obstacle) obstacle = obstacle_of(wall, off);
        for (const double offset : offsets(wall, mesh, section)) {
          auto point = std::make_unique<MemberPoint>(structure, section, offset);
          const Vec2 place = point->position(rest);
          const auto same = [&](const auto& other) {
            const auto& [there, distance] = other.second;
            return distance == off && (there - place).norm() <= 1e-12 * structure.length_scale();
          };
          const auto [first, last] = taken.equal_range(section.node);
          if (std::any_of(first, last, same)) continue;
          taken.emplace(section.node, std::pair(place, off));
          const bool movable = !point->unknowns().empty();
          Candidate candidate(
              std::move(point), obstacle,
              {.wall = wall.name, .member = mesh.name, .fraction = section.fraction, .tributary = section.tributary});
          const double gap = candidate.gap(rest);
          deepest.everywhere = deepest.everywhere && !(gap >= 0.0 && std::isfinite(gap));
          if (-gap > deepest.depth) {
            deepest.depth = -gap;
            deepest.label = candidate.label();
          }
          if (!movable) {
            held.push_back(std::move(candidate));
            continue;
          }
          const bool on_axis = deck.contact.friction_at == deck::FrictionAt::axis && offset != 0.0;
          candidate.set_friction(friction_of(deck, wall, mesh.name, section.fraction),
                                 on_axis ? std::make_unique<MemberPoint>(structure, section, 0.0) : nullptr);
          if (candidate.friction() > 0.0 && !moves_along(candidate, rest)) {
            if (is_moved_along(wall, candidate, rest))
              problems.add(
                  wall.position, "wall.friction",
                  fmt::format("a support moves {}:{:.4g} along the wall, and friction would act on the support",
                              mesh.name, section.fraction),
                  "leave out the friction of this wall on the member, or move the wall instead");
            candidate.set_friction(0.0);
          }
          if (std::abs(gap) <= round_off && changes(candidate, rest))
            touches.push_back({.wall = &wall,
                               .node = section.node,
                               .candidate = candidates.size(),
                               .place = structure.position(section.node),
                               .normal = candidate.normal(rest),
                               .straight = obstacle->knots().empty()});
          candidates.push_back(std::move(candidate));
        }
      }
    }
    const double rounded = wall.interference > 0.0 ? drawn_to * structure.length_scale() : round_off;
    if (deepest.depth > wall.interference + rounded)
      at_rest.add(
          wall.position, "wall." + wall.name,
          fmt::format("member \"{}\" is inside the wall at the start: node {}:{:.4g} by {:.9g}{}{}",
                      deepest.label.member, deepest.label.member, deepest.label.fraction,
                      deck.frame.factor() * deepest.depth, length,
                      wall.interference > 0.0 ? ", more than its interference" : ""),
          wall.interference > 0.0 ? "give it a greater interference, or move the wall" : how_to_part(wall, deepest));
  }
  join_opposite(touches, known, drawn_to * structure.length_scale(), candidates, at_rest);
  std::move(held.begin(), held.end(), std::back_inserter(candidates));
  return candidates;
}

namespace {

// Where the stress-free structure is deepest in a wall, or nearest to it.
struct LeastGap {
  double gap = infinity;
  Vec2 normal = Vec2::Zero();  ///< of the wall there, into the free side
};

// At nodes, and at places between them that divide an element into so many parts.
LeastGap least_gap(const deck::Wall& wall, const Structure& structure, int parts) {
  const State rest{.x = Vector::Zero(structure.size({}))};
  LeastGap least;
  for (const MemberMesh& mesh : structure.members()) {
    if (!concerns(wall, mesh.name)) continue;
    std::shared_ptr<const Obstacle> obstacle;
    const auto look_at = [&](const Vec2& place) {
      const LinearField gap = obstacle->gap_slope(place, 0.0);
      if (gap.value < least.gap) least = {.gap = gap.value, .normal = Vec2(gap.x, gap.z).normalized()};
    };
    std::vector<Vec2> before;
    double off = -1.0;
    for (const MemberSection& section : mesh.contact_sections()) {
      if (const double now = kept_off(wall, height_of(mesh, section.fraction)); std::exchange(off, now) != now)
        obstacle = obstacle_of(wall, now);
      std::vector<Vec2> here;
      for (const double offset : offsets(wall, mesh, section))
        here.push_back(MemberPoint(structure, section, offset).position(rest));
      for (const Vec2& place : here) look_at(place);
      for (std::size_t face = 0; face < std::min(before.size(), here.size()); ++face)
        for (int part = 1; part < parts; ++part)
          look_at(before[face] + (here[face] - before[face]) * (double(part) / parts));
      before = std::move(here);
    }
  }
  return least;
}

}  // namespace

deck::Deck with_walls_of_ramp(deck::Deck deck, const Structure& structure) {
  for (deck::Wall& wall : deck.walls) {
    wall.motion.reset();
    if (wall.interference == 0.0) continue;
    const double drawn = drawn_to * structure.length_scale();
    const bool grows = !deck::has_friction(deck) && is_enclosed(deck, wall);
    // A wall may be narrower than an element; one that grows is touched at nodes, and the chords between them are no
    // part of an arc.
    const LeastGap deepest = least_gap(wall, structure, grows ? 1 : 100);
    const double back =
        -deepest.gap <= wall.interference + drawn ? std::max(wall.interference, -deepest.gap) : wall.interference;
    if (grows)
      wall.retracted = back;
    else
      wall.motion = deck::WallMotion{.x = back * deepest.normal.x(),
                                     .z = back * deepest.normal.y(),
                                     .progress = {.constant = -1.0, .proportional = 1.0}};
  }
  return deck;
}

bool same_walls(const deck::Deck& deck, const std::string& a, const std::string& b) {
  return std::all_of(deck.walls.begin(), deck.walls.end(),
                     [&](const deck::Wall& wall) { return concerns(wall, a) == concerns(wall, b); });
}

namespace {

// A level wall lies along their way. Where a wall goes is no matter, so that the ramp and all stages of a deck have the
// same contacts.
bool may_stop_rollers(const deck::Wall& wall) {
  constexpr double level = 1e-9;  // part of a straight wall's normal in x
  const std::optional<Vec2> direction = straight_direction(wall);
  return !direction || std::abs(direction->normalized().y()) > level;
}

}  // namespace

std::vector<SlidingObstacle> sliding_obstacles(const deck::Deck& deck, const SlidingStructure& structure) {
  std::vector<SlidingObstacle> obstacles;
  for (const deck::Wall& wall : walls_in_parts(deck)) {
    // To an outline those strands that keep their axes at one distance from it.
    const auto concerned = [&](Index strand) {
      return concerns(wall, structure.label({.strand = strand, .s = 0.0}).first);
    };
    deck::Wall unmoved = wall;
    unmoved.motion.reset();
    std::vector<double> distances;
    for (Index strand = 0; strand < structure.strands(); ++strand) {
      const double off = kept_off(wall, 2.0 * structure.half_height(strand));
      if (concerned(strand) && std::find(distances.begin(), distances.end(), off) == distances.end())
        distances.push_back(off);
    }
    for (const double off : distances) {
      SlidingObstacle obstacle{.name = wall.name,
                               .surface = obstacle_of(wall, off),
                               .unmoved = obstacle_of(unmoved, off),
                               .on_face = wall.contact_surface == deck::ContactSurface::face && !wall.outline,
                               .may_stop_rollers = may_stop_rollers(wall),
                               .rubs_axis = deck.contact.friction_at == deck::FrictionAt::axis};
      for (Index strand = 0; strand < structure.strands(); ++strand) {
        const bool keeps = kept_off(wall, 2.0 * structure.half_height(strand)) == off;
        obstacle.strands.push_back(concerned(strand) && keeps ? 1 : 0);
        if (!deck::has_friction(deck)) continue;
        const auto friction_at = [&](double s) {
          const auto [member, fraction] = structure.label({.strand = strand, .s = s});
          return deck::friction_of(deck, wall, member, fraction);
        };
        const double length = structure.length(strand);
        const std::string member = structure.label({.strand = strand, .s = 0.5 * length}).first;
        obstacle.frictions.push_back(deck::friction_of(deck, wall, member, 0.5));
        obstacle.end_frictions.push_back({friction_at(0.0), friction_at(length)});
      }
      obstacles.push_back(std::move(obstacle));
    }
  }
  return obstacles;
}

}  // namespace arcwall
