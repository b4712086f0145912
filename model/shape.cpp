#include "model/shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "model/build_contact.hpp"

namespace arcwall {

namespace {

std::vector<ContactMark> contact_marks(const ContactQuery& contacts, const State& state);

void to_users_coordinates(const deck::Frame& frame, Shape& shape) {
  for (MemberShape& member : shape.members)
    for (ShapePoint& point : member.points) {
      point.position = frame.place(point.position);
      point.displacement *= frame.factor();
      point.moment *= frame.factor();
    }
  for (ContactMark& mark : shape.contacts) {
    mark.position = frame.place(mark.position);
    if (mark.pressure) *mark.pressure *= frame.factor(-1);
  }
}

}  // namespace

Shape shape_of(const Model& model, const State& state) {
  Shape shape;
  for (std::size_t m = 0; m < model.deck().members.size(); ++m)
    shape.members.push_back({.member = model.deck().members[m].name, .points = model.body().shape(m, state)});
  if (model.contacts() != nullptr) shape.contacts = contact_marks(*model.contacts(), state);
  to_users_coordinates(model.frame(), shape);
  return shape;
}

namespace {

// --- contacts -------------------------------------------------------------------------------------------------------

std::vector<ContactMark> contact_marks(const ContactQuery& contacts, const State& state) {
  std::vector<ContactMark> marks;
  const auto add = [&](const std::vector<ContactPoint>& points) {
    for (const ContactPoint& point : points)
      marks.push_back({.label = point.label,
                       .position = point.place,
                       .force = point.force_vector,
                       .pressure = point.pressure(),
                       .friction = point.friction});
  };
  add(contacts.closed_contacts(state));
  add(contacts.pressed_nodes(state));
  return marks;
}

// --- walls ----------------------------------------------------------------------------------------------------------

// Half as far again as the structure reaches at rest.
Eigen::AlignedBox2d reach(const Model& model) {
  Eigen::AlignedBox2d box;
  for (Index node = 0; node < model.structure().node_count(); ++node) box.extend(model.structure().position(node));
  const double margin = 0.5 * box.diagonal().norm();
  return {box.min() - Vec2::Constant(margin), box.max() + Vec2::Constant(margin)};
}

bool is_closed(const deck::Wall& wall) {
  if (!wall.outline) return false;
  if (const auto* points = std::get_if<deck::PolylineOutline>(&*wall.outline)) return points->closed;
  if (const auto* points = std::get_if<deck::CurveOutline>(&*wall.outline)) return points->closed;
  return !std::holds_alternative<deck::HalfPlaneOutline>(*wall.outline);
}

// At rest, into the solid of a wall that has no end.
std::optional<Vec2> behind(const deck::Wall& wall) {
  if (!wall.outline) return Vec2(0.0, wall.side == Side::above ? 1.0 : -1.0);
  if (const auto* plane = std::get_if<deck::HalfPlaneOutline>(&*wall.outline))
    return -Vec2(plane->normal.x, plane->normal.z).normalized();
  return std::nullopt;
}

}  // namespace

// Of a wall that climbs out of the structure's reach only what lies between its first and last place within; all of one
// that is nowhere within.
std::vector<WallShape> wall_shapes(const Model& model, double lambda) {
  const Eigen::AlignedBox2d box = reach(model);
  std::vector<WallShape> walls;
  for (const deck::Wall& wall : model.deck().walls) {
    std::vector<Vec2> line = obstacle_of(wall)->outline(box.min().x(), box.max().x(), lambda);
    std::vector<Vec2> whole;
    for (const Vec2& point : line) whole.push_back(model.frame().place(point));
    const RigidMotion motion = motion_of(wall);
    std::optional<Vec2> into = behind(wall);
    if (into) into = motion.moved(*into, lambda) - motion.moved(Vec2::Zero(), lambda);
    const auto inside = [&](const Vec2& point) { return box.contains(point); };
    auto first = std::find_if(line.begin(), line.end(), inside);
    auto last = std::find_if(line.rbegin(), line.rend(), inside).base();
    if (first == line.end() || last - first < 2) std::tie(first, last) = std::pair(line.begin(), line.end());
    std::transform(first, last, first, [&](const Vec2& point) { return model.frame().place(point); });
    walls.push_back({.name = wall.name,
                     .side = wall.side,
                     .is_outline = wall.outline.has_value(),
                     .line = {first, last},
                     .whole = std::move(whole),
                     .closed = is_closed(wall),
                     .behind = into,
                     .members = wall.members,
                     .moves = !motion.is_none()});
  }
  return walls;
}

std::vector<double> section_heights(const deck::Deck& deck) {
  std::vector<double> heights;
  for (const deck::Member& member : deck.members) {
    const deck::Section* section = find(deck.sections, member.section);
    const bool beam = member.theory != Theory::truss && section != nullptr;
    heights.push_back(beam && !height_tapers(*section) ? properties(*section, 0.0).height.value_or(0.0) : 0.0);
  }
  return heights;
}

}  // namespace arcwall
