#include "apps/verify/sliding_touches.hpp"

#include <algorithm>
#include <cmath>

#include "core/unit_tangent.hpp"

namespace arcwall::verify {

namespace {

using Span = SlidingContactLayout::Span;

// Of a wall in parts each is as many obstacles as the others, one after the other.
const PlainWall& wall_of_obstacle(const Sliding& at, const std::vector<PlainWall>& walls, std::size_t obstacle) {
  const auto& obstacles = at.model.sliding()->obstacles();
  const std::string& name = obstacles[obstacle].name;
  const auto is_of_wall = [&](const auto& other) { return other.name == name; };
  const auto is_part = [&](const PlainWall& wall) { return wall.deck().name == name; };
  const auto all = std::count_if(obstacles.begin(), obstacles.end(), is_of_wall);
  const auto before = std::count_if(obstacles.begin(), obstacles.begin() + static_cast<Index>(obstacle), is_of_wall);
  auto part = std::find_if(walls.begin(), walls.end(), is_part);
  part += before * std::count_if(walls.begin(), walls.end(), is_part) / all;
  return *part;
}

Touch sliding_touch(const std::shared_ptr<const Sliding>& at, const PlainWall& wall, const SlidingNode& node) {
  const auto [member, fraction] =
      at->body.label({.strand = node.strand, .s = at->mesh.coordinate(node.strand, node.position, at->now.s)});
  Touch touch{.label = {.wall = wall.deck().name, .member = member, .fraction = fraction}, .gap = at->unknowns(node)};
  const double half = at->body.half_height(node.strand);
  const auto face = [=, &wall, function = touch.gap](const Vector& u) {
    return face_towards(wall, half, at->place(node, function, u));
  };
  touch.place = wall.touched_by(face(touch.gap.at), half);
  touch.gap.resolve(wall.from_vertical(face(touch.gap.at)));
  touch.gap.of = [face, half, &wall](const Vector& u) { return wall.gap_to(face(u), half); };
  if (wall.has_outline()) take_outline(wall, face, touch.gap);
  return touch;
}

// The curvature of the curve along which what touches slides: of a face that of the wall, of an axis that of the curve
// at half the height from an outline.
double curvature_touched(const PlainWall& wall, const Vec2& face, double half_height) {
  const double surface = wall.curvature(face);  // infinite at a sharp corner
  const double off = wall.kept_off(half_height);
  if (off == 0.0) return surface;
  return std::isfinite(surface) ? surface / (1.0 - off * surface) : -1.0 / off;
}

// The spring c = p Λ_f/|κ − Λ_f κ_w| of (8.8) on the tilt, by what the element before the node, or behind it, carries:
// κ = κ₀ + M/EI, Λ = 1 + N/EA. What touches a profile is the face at the offset o, stretched by Λ_f = Λ − o κ; what
// touches an outline is the axis.
std::optional<double> contact_spring(const Sliding& at, const PlainWall& wall, const SlidingNode& node, bool before,
                                     double force) {
  const double sign = before ? 1.0 : -1.0;
  const auto ends = at.mesh.end_forces(node.strand, before ? node.position - 1 : node.position, at.now);
  const Eigen::Vector3d& end = ends[before ? 1 : 0];
  const AxisPlace place = at.mesh.node(node.strand, node.position, at.now);
  const double s = at.mesh.coordinate(node.strand, node.position, at.now.s), half = at.body.half_height(node.strand);
  const Vec2 face = face_towards(wall, half, place);
  const double against = wall.has_outline() ? wall.slope_angle(face) : 0.0;
  const double travel = std::cos(place.angle - against) >= 0.0 ? 1.0 : -1.0;
  const double curvature = travel * (at.body.natural_curvature({.strand = node.strand, .s = s}, at.now.lambda) +
                                     sign * end[2] / at.body.bending_stiffness({.strand = node.strand, .s = s}));
  const double stretch =
      1.0 + at.body.free_strain(node.strand, at.now.lambda).value +
      sign * end.head<2>().dot(unit_tangent(place.angle)) / at.body.axial_stiffness({.strand = node.strand, .s = s});
  const bool is_face = !wall.has_outline() && wall.deck().contact_surface == deck::ContactSurface::face;
  const double offset = is_face ? -wall.side() * half : 0.0;
  const double stretch_there = stretch - offset * curvature;
  const double opening = wall.side() * (curvature - stretch_there * curvature_touched(wall, face, half));
  constexpr double touching = 1e-9;  // a line is about to form, or has just vanished
  if (opening * at.body.length_scale() <= touching) return std::nullopt;
  return force * stretch_there / opening;
}

bool is_unresolved(const Sliding& at, Index strand) {
  double before = at.mesh.node(strand, 0, at.now).angle;
  for (Index position = 1; position < at.mesh.nodes(strand); ++position) {
    const double here = at.mesh.node(strand, position, at.now).angle;
    if (std::abs(here - before) > most_turn) return true;
    before = here;
  }
  return false;
}

// Of a point, or of a tip up to which the body is pressed.
Tangency tangency(const std::shared_ptr<const Sliding>& at, const PlainWall& wall, const Touch& touch,
                  const SlidingNode& node, std::optional<std::size_t> point) {
  Tangency tangency{.label = touch.label, .tilt = at->unknowns(node)};
  const double half = at->body.half_height(node.strand);
  tangency.tilt.of = [=, &wall, function = tangency.tilt](const Vector& u) {
    const AxisPlace place = at->place(node, function, u);
    return std::remainder(place.angle - wall.slope_angle(face_towards(wall, half, place)), pi);
  };
  if (wall.has_outline() && std::isfinite(wall.curvature(at->place(node, tangency.tilt, tangency.tilt.at).position)))
    tangency.tilt.slopes = [=, &wall, function = tangency.tilt](const Vector& u) {
      const Vec2 place = at->place(node, function, u).position;
      const Vec2 turn = wall.turn(place) * unit_tangent(wall.slope_angle(place));
      return Vector(Eigen::Vector3d(-turn.x(), -turn.y(), 1.0));
    };
  if (!point || at->on.lies_pressed(*point)) tangency.end_of_pressed = true;
  if (!point || at->on.lies_beside(*point)) return tangency;
  if (at->on.points()[*point].is_pinched()) {  // its place is held besides, so that a couple alone holds its direction
    const double angle = wall.slope_angle(face_towards(wall, half, at->place(node, tangency.tilt, tangency.tilt.at)));
    tangency.tilt.of = [=, function = tangency.tilt](const Vector& u) {
      return std::remainder(at->place(node, function, u).angle - angle, pi);
    };
    tangency.tilt.slopes = [](const Vector&) { return Vector(Eigen::Vector3d::UnitZ()); };
    tangency.end_of_pressed = true;
    return tangency;
  }
  tangency.spring =
      touch.closed ? contact_spring(*at, wall, node, at->on.span_before(*point) == Span::free, touch.force) : 0.0;
  tangency.unresolved = touch.closed && is_unresolved(*at, node.strand);
  return tangency;
}

// Whether a strand's end is at a joint through which the axis and the face go on as they are, before the same wall.
bool goes_on(const Sliding& at, const PlainWall& wall, Index strand, bool last) {
  constexpr double in_line = 1e-9;  // [rad]
  const auto other = at.body.joined_end(strand, last);
  if (!other) return false;
  const double s = other->last ? at.body.length(other->strand) : 0.0;
  if (!wall.concerns(at.body.label({.strand = other->strand, .s = s}).first)) return false;
  if (at.body.half_height(other->strand) != at.body.half_height(strand)) return false;
  const auto position = [&](Index of, bool end) { return end ? at.mesh.nodes(of) - 1 : Index{0}; };
  const Index here = position(strand, last), there = position(other->strand, other->last);
  const double turn = at.mesh.node(strand, here, at.now).angle - at.mesh.node(other->strand, there, at.now).angle +
                      (last == other->last ? pi : 0.0);
  return at.mesh.node_unknowns(strand, here)[2] == at.mesh.node_unknowns(other->strand, there)[2] &&
         std::abs(std::remainder(turn, 2.0 * pi)) <= in_line;
}

// Of a contact at such a joint: it slides into the one strand or the other as soon as the axis tilts.
Tangency tangency_at_joint(const std::shared_ptr<const Sliding>& at, const PlainWall& wall, const Touch& touch,
                           const SlidingNode& node, bool last) {
  Tangency passed = tangency(at, wall, touch, node, std::nullopt);
  passed.end_of_pressed = false;
  passed.spring = contact_spring(*at, wall, node, last, touch.force);
  passed.unresolved = is_unresolved(*at, node.strand);
  return passed;
}

// The pinch of a wall that is nearest a place.
SlidingContact::PinchedPlace pinch_of(const Sliding& at, const std::string& wall, const Vec2& place) {
  const auto pinches = at.model.sliding()->pinches();
  const auto distance = [&](const SlidingContact::PinchedPlace& pinch) {
    return pinch.obstacle == wall ? (pinch.place - place).norm() : infinity;
  };
  return *std::min_element(pinches.begin(), pinches.end(),
                           [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
}

// What is at a pinch of the body, and the place that it has at rest.
Pinched pinched_at(const std::shared_ptr<const Sliding>& at, const ContactLabel& label, const SlidingNode& node,
                   std::size_t point, double force) {
  Pinched pinched{.label = label, .along = at->unknowns(node), .force = force};
  pinched.coordinate = at->state.x.size() - at->mesh.breakpoints() + static_cast<Index>(point);
  const auto s = [&](Index position) { return at->mesh.coordinate(node.strand, position, at->now.s); };
  pinched.step = 1e-4 * std::min(s(node.position + 1) - s(node.position), s(node.position) - s(node.position - 1));
  const AxisPlace now = at->place(node, pinched.along, pinched.along.at);
  const Vec2 place = pinch_of(*at, label.wall, now.position).place, axis = unit_tangent(now.angle);
  pinched.along.of = [=, function = pinched.along](const Vector& u) {
    return axis.dot(at->place(node, function, u).position - place);
  };
  return pinched;
}

// At sharp corners walls have no normal of their own: knife edges press across the axis, as it is now. What is stored
// is their force across and along the axis at rest.
void press_across(const SlidingContact::PinchedPlace& pinch, double angle, Touch& first, Touch& other,
                  Pinched& pinched) {
  const Vec2 axis = unit_tangent(angle), across = perp(axis);
  const Vec2 normal = across.dot(pinch.normal) >= 0.0 ? across : Vec2(-across);
  first.gap.slopes = [normal](const Vector&) { return Vector(Eigen::Vector3d(normal.x(), normal.y(), 0.0)); };
  other.gap.slopes = [normal](const Vector&) { return Vector(Eigen::Vector3d(-normal.x(), -normal.y(), 0.0)); };
  first.gap.bends = other.gap.bends = {};
  const Vec2 force = first.force * pinch.normal + pinched.force * pinch.axis;
  first.force = force.dot(normal);
  pinched.force = force.dot(axis);
}

// One unknown is the force of both walls of a pinch, of either sign.
void part_pinching_force(Touch& first, Touch& other) {
  const double force = first.force;
  first.force = std::max(force, 0.0);
  other.force = std::max(-force, 0.0);
  first.against = other.force;
  other.against = first.force;
  first.two_sided = other.two_sided = other.closed = true;
}

// Of a closed contact with friction; the deck gives its coefficient.
FrictionAtTouch friction_at(const std::shared_ptr<const Sliding>& at, const PlainWall& wall, const Touch& touch,
                            const SlidingNode& node, std::size_t contact, double force) {
  const bool on_axis = at->model.deck().contact.friction_at == deck::FrictionAt::axis;
  const double half = at->body.half_height(node.strand);
  const auto place = [=, &wall, function = touch.gap](const Vector& u) {
    const AxisPlace axis = at->place(node, function, u);
    return on_axis ? axis.position : face_towards(wall, half, axis);
  };
  const double sign = wall.has_outline() || wall.deck().side == Side::below ? 1.0 : -1.0;
  const Vec2 tangent = sign * unit_tangent(wall.slope_angle(place(touch.gap.at)));
  const ContactPoint told = at->model.contacts()->contact(at->state, static_cast<Index>(contact));
  FrictionAtTouch friction{
      .along = touch.gap,
      .force = force,
      .coefficient = deck::friction_of(at->model.deck(), wall.deck(), touch.label.member, touch.label.fraction),
      .slips = slips(told.friction->mode),
      .slip = told.friction->slip};
  friction.along.slopes = nullptr;
  friction.along.bends = nullptr;
  friction.along.of = [place, tangent](const Vector& u) { return tangent.dot(place(u)); };
  return friction;
}

}  // namespace

Vec2 face_towards(const PlainWall& wall, double half_height, const AxisPlace& place) {
  if (wall.deck().contact_surface == deck::ContactSurface::axis || wall.has_outline()) return place.position;
  const Vec2 normal = perp(unit_tangent(place.angle));
  return place.position - (normal.y() >= 0.0 ? 1.0 : -1.0) * wall.side() * half_height * normal;
}

Touches sliding_touches(const Model& model, const std::vector<PlainWall>& walls, const State& state) {
  const auto at = std::make_shared<const Sliding>(Sliding{.model = model, .state = state});
  Touches touches;
  Index force = at->mesh.unknowns();
  const auto add = [&](const PlainWall& wall, const SlidingNode& node, bool closed) -> const Touch& {
    touches.all.push_back(sliding_touch(at, wall, node));
    touches.all.back().closed = closed;
    if (closed) touches.all.back().force = state.x[force++];
    return touches.all.back();
  };
  const auto& points = at->on.points();
  const auto& pinched = at->on.pinched_points();
  Index rubbing = 0;
  for (std::size_t j = 0; j < state.active_set.contacts(); ++j) rubbing += rubs(state.active_set, j) ? 1 : 0;
  const Index moments = state.x.size() - 2 * at->mesh.breakpoints() - rubbing;  // behind friction forces
  Index friction = moments - rubbing;
  const auto& tips = at->on.pressed_tips();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto [strand, position] = at->mesh.breakpoint(static_cast<Index>(k));
    const SlidingNode node{.strand = strand, .position = position};
    const PlainWall& wall = wall_of_obstacle(*at, walls, points[k].obstacle);
    const Touch& touch = add(wall, node, state.active_set[k] != 0);
    if (rubs(state.active_set, k))
      touches.all.back().friction = friction_at(at, wall, touch, node, k, state.x[friction++]);
    const AxisPlace axis = at->mesh.node(strand, position, at->now);
    std::optional<SlidingContact::PinchedPlace> pinch;
    if (points[k].is_pinched()) pinch = pinch_of(*at, wall.deck().name, axis.position);
    if (!pinch || !pinch->knife_edges) {
      touches.tangencies.push_back(tangency(at, wall, touch, node, k));
      touches.tangencies.back().moment = state.x[moments + static_cast<Index>(k)];
    }
    if (!pinch) continue;
    const auto behind = std::find(pinched.begin(), pinched.end(), k);
    const Index along = moments - rubbing - static_cast<Index>(tips.size()) - (pinched.end() - behind);
    touches.pinched.push_back(pinched_at(at, touch.label, node, k, state.x[along]));
    touches.all.push_back(sliding_touch(at, wall_of(walls, pinch->other), node));
    Touch &first = touches.all[touches.all.size() - 2], &other = touches.all.back();
    if (pinch->knife_edges) press_across(*pinch, axis.angle, first, other, touches.pinched.back());
    part_pinching_force(first, other);
  }
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const SlidingNode node{.strand = tips[i].strand, .position = tips[i].position};
    const PlainWall& wall = wall_of_obstacle(*at, walls, tips[i].obstacle);
    touches.tangencies.push_back(tangency(at, wall, sliding_touch(at, wall, node), node, std::nullopt));
    touches.tangencies.back().moment = state.x[moments - rubbing - static_cast<Index>(tips.size() - i)];
  }
  const auto ends = model.sliding()->ends();
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto& [strand, last, obstacle] = ends[i];
    const SlidingNode node{.strand = strand, .position = last ? at->mesh.nodes(strand) - 1 : 0};
    const PlainWall& wall = wall_of_obstacle(*at, walls, obstacle);
    const std::size_t contact = points.size() + i;
    const Touch& touch = add(wall, node, state.active_set[contact] != 0);
    if (rubs(state.active_set, contact))
      touches.all.back().friction = friction_at(at, wall, touch, node, contact, state.x[friction++]);
    if (touch.closed && goes_on(*at, wall, strand, last))
      touches.tangencies.push_back(tangency_at_joint(at, wall, touch, node, last));
  }
  for (const SlidingContactLayout::PressedNode& node : at->on.pressed_nodes()) {
    add(wall_of_obstacle(*at, walls, node.obstacle), {.strand = node.strand, .position = node.position}, true);
    touches.all.back().listed = false;
  }
  return touches;
}

}  // namespace arcwall::verify
