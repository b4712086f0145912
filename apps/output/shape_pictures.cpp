#include "apps/output/shape_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "apps/output/jump_rows.hpp"
#include "apps/output/path_lines.hpp"
#include "apps/output/picture_signs.hpp"
#include "apps/output/wall_pictures.hpp"

namespace arcwall {

namespace {

constexpr double longer_side = longer_side_of_pictures;
constexpr double margin = 0.08;  // of the longer side
// Parts of the longer side. What is drawn outwards from the structure stays in the margin.
constexpr double longest_force = 0.14, longest_load = 0.07;
constexpr double thinnest_band = 0.006;
// Deflections between these can be drawn larger: twice at least, and what is below is round-off.
constexpr double greatest_enlarged = 0.25, least_enlarged = 1e-8;

struct Box {
  Vec2 low = Vec2::Constant(infinity), high = Vec2::Constant(-infinity);

  void include(const Vec2& point) {
    if (!point.allFinite()) return;
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  Vec2 size() const { return high - low; }
};

// The part of a line, along which x ascends, between two values of x.
std::vector<Vec2> between(const std::vector<Vec2>& line, double low, double high) {
  std::vector<Vec2> part;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 &a = line[i - 1], &b = line[i];
    if (b.x() < low || a.x() > high || !(b.x() > a.x())) continue;
    for (const double x : {std::max(a.x(), low), std::min(b.x(), high)})
      part.emplace_back(x, a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y()));
  }
  return part;
}

// The points of a line, in whatever direction it runs.
std::vector<Vec2> beside(const std::vector<Vec2>& line, double low, double high) {
  std::vector<Vec2> part;
  for (const Vec2& point : line)
    if (point.x() >= low && point.x() <= high) part.push_back(point);
  return part;
}

// What the structure sweeps over, and the walls that are near.
Box box_of(const std::vector<Scene>& scenes, const Setting& setting) {
  Box swept;
  for (const Scene& scene : scenes) {
    for (std::size_t m = 0; m < scene.shape.members.size(); ++m) {
      const Vec2 around = Vec2::Constant(m < setting.heights.size() ? 0.5 * setting.heights[m] : 0.0);
      for (const ShapePoint& point : scene.shape.members[m].points) {
        swept.include(point.position - around);
        swept.include(point.position + around);
      }
    }
  }
  if (swept.low.x() > swept.high.x()) return {.low = Vec2::Zero(), .high = Vec2::Ones()};
  const double reach = 0.2 * swept.size().norm();
  Box box = swept;
  const auto include = [&](const std::vector<WallShape>& walls) {
    for (const WallShape& wall : walls)
      for (const Vec2& point : wall.is_outline ? beside(wall.line, swept.low.x() - reach, swept.high.x() + reach)
                                               : between(wall.line, swept.low.x(), swept.high.x()))
        if (point.y() > swept.low.y() - reach && point.y() < swept.high.y() + reach) box.include(point);
  };
  include(setting.walls);
  for (const Scene& scene : scenes) include(scene.walls);
  return box;
}

// 1, or a round number that makes something to see of what is long and flat.
double stretch_of(const Vec2& size) {
  constexpr double flat = 6.0, wanted = 4.0;
  if (size.y() <= 0.0 || size.x() < flat * size.y()) return 1.0;
  const double most = size.x() / (wanted * size.y());
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  const double part = most / decade;
  return decade * (part < 2.0 ? 1.0 : part < 5.0 ? 2.0 : 5.0);
}

// Forces that have the longest arrows.
struct Greatest {
  double wall = 0.0, load = 0.0, moment = 0.0;
};

Greatest greatest_forces(const std::vector<Scene>& scenes) {
  Greatest greatest;
  for (const Scene& scene : scenes) {
    for (const ContactMark& contact : scene.shape.contacts)
      greatest.wall = std::max(greatest.wall, contact.force.norm());
    for (const AppliedLoad& load : scene.loads) {
      greatest.load = std::max(greatest.load, load.force.norm());
      greatest.moment = std::max(greatest.moment, std::abs(load.moment));
    }
  }
  return greatest;
}

// From the plane to the picture.
class Frame {
 public:
  Frame(const Box& box, double stretch) : stretch_(stretch), corner_(box.low.x(), box.high.y()) {
    const Vec2 size = stretched(box.size());
    const double longer = std::max({size.x(), size.y(), 1e-300});
    scale_ = longer_side * (1.0 - 2.0 * margin) / longer;
    size_ = (scale_ * size).array().round() + 2.0 * margin * longer_side;
  }

  const Vec2& size() const { return size_; }

  // Of what lies nearly flat; 0 if it cannot be told from a line.
  double thickness(double height) const {
    const double drawn = std::round(scale_ * stretch_ * height);
    return drawn < thinnest_band * longer_side ? 0.0 : drawn;
  }

  Vec2 place(const Vec2& point) const {
    const Vec2 offset = scale_ * stretched(point - corner_);
    return (Vec2(offset.x(), -offset.y()).array() + margin * longer_side).round();
  }

  // Of a displacement.
  Vec2 way(const Vec2& move) const { return scale_ * Vec2(move.x(), -stretch_ * move.y()); }

  // In the picture too a force stands upright on its wall.
  Vec2 wall_arrow(const Vec2& force, double greatest) const {
    return arrow({stretch_ * force.x(), -force.y()}, force.norm() / greatest, longest_force);
  }

  Vec2 load_arrow(const Vec2& force, double greatest) const {
    return arrow({force.x(), -force.y()}, force.norm() / greatest, longest_load);
  }

 private:
  Vec2 stretched(const Vec2& v) const { return {v.x(), stretch_ * v.y()}; }

  static Vec2 arrow(const Vec2& direction, double part, double longest) {
    if (!(part > 0.0) || !std::isfinite(part)) return Vec2::Zero();
    return longest * longer_side * part * direction.normalized();
  }

  double stretch_, scale_ = 1.0;
  Vec2 corner_, size_;
};

std::string member_data(const Frame& frame, const MemberShape& member) {
  std::vector<Vec2> places;
  for (const ShapePoint& point : member.points)
    if (point.position.allFinite()) places.push_back(frame.place(point.position));
  return path_data(places);
}

// The displacements of the same points, in a unit that keeps their digits where they are small.
std::string moves_data(const Frame& frame, const MemberShape& member, double unit) {
  std::vector<Vec2> moves;
  for (const ShapePoint& point : member.points)
    if (point.position.allFinite()) moves.push_back((frame.way(point.displacement) / unit).array().round());
  return path_data(moves);
}

double greatest_move(const Frame& frame, const std::vector<Scene>& scenes) {
  double greatest = 0.0;
  for (const Scene& scene : scenes)
    for (const MemberShape& member : scene.shape.members)
      for (const ShapePoint& point : member.points)
        if (point.position.allFinite()) greatest = std::max(greatest, frame.way(point.displacement).norm());
  return greatest;
}

double unit_of_moves(double greatest) {
  constexpr double steps = 2000.0;
  const double part = greatest / longer_side;
  return part > least_enlarged && part <= greatest_enlarged ? greatest / steps : 0.0;
}

std::vector<std::string> classes_of(const Scene& scene) {
  std::vector<std::string> classes(scene.shape.members.size(), "member");
  classes.insert(classes.end(),
                 {"moving-surface", "moving", "springs", "supports", "loads", "forces", "touches", "friction"});
  return classes;
}

std::vector<WallPicture> drawn_walls(const Frame& frame, const std::vector<WallShape>& walls) {
  std::vector<PlacedWall> placed;
  for (const WallShape& wall : walls) {
    PlacedWall& added = placed.emplace_back(PlacedWall{.closed = wall.closed});
    for (const Vec2& point : wall.whole) added.line.push_back(frame.place(point));
    if (wall.behind) added.behind = frame.way(*wall.behind).normalized();
  }
  return wall_pictures(placed, frame.size());
}

// Where a section force has its maximum and its minimum.
std::set<std::size_t> extremes(const std::vector<ShapePoint>& points) {
  std::set<std::size_t> places;
  for (const auto force : {&ShapePoint::axial_force, &ShapePoint::shear_force, &ShapePoint::moment}) {
    const auto [least, most] = std::minmax_element(
        points.begin(), points.end(), [&](const ShapePoint& a, const ShapePoint& b) { return a.*force < b.*force; });
    for (const auto place : {least, most}) places.insert(static_cast<std::size_t>(place - points.begin()));
  }
  return places;
}

// At most so many samples of each member, of equal parts; its extremes are kept, and both sides where a force jumps.
std::vector<std::vector<ForceSample>> sampled_forces(const Shape& shape, std::size_t most) {
  std::vector<std::vector<ForceSample>> forces;
  for (const MemberShape& member : shape.members) {
    std::vector<ForceSample>& samples = forces.emplace_back();
    const auto& points = member.points;
    const std::size_t every = std::max<std::size_t>((points.size() + most - 1) / most, 1);
    const auto same_place = [&](std::size_t i, std::size_t j) { return points[i].fraction == points[j].fraction; };
    const std::set<std::size_t> kept = extremes(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool jumps = (i > 0 && same_place(i, i - 1)) || (i + 1 < points.size() && same_place(i, i + 1));
      if (i % every != 0 && i + 1 != points.size() && !jumps && !kept.contains(i)) continue;
      samples.push_back({.at = i,
                         .fraction = points[i].fraction,
                         .axial_force = points[i].axial_force,
                         .shear_force = points[i].shear_force,
                         .moment = points[i].moment});
    }
  }
  return forces;
}

// The friction force.
Vec2 along_wall(const ContactMark& contact) {
  return contact.friction ? Vec2(contact.friction->force * contact.friction->tangent) : Vec2(0.0, 0.0);
}

// A dot, or the square of a contact that sticks by friction; their lines are thick.
std::string touch_data(const Vec2& place, const ContactMark& contact) {
  const bool sticks = contact.friction && contact.friction->mode == ContactMode::sticks;
  if (!sticks) return fmt::format("M{:.0f} {:.0f}h0", place.x(), place.y());
  constexpr double half = 4.0;
  return fmt::format("M{:.0f} {:.0f}h{:.0f}v{:.0f}h{:.0f}z", place.x() - half, place.y() - half, 2.0 * half, 2.0 * half,
                     -2.0 * half);
}

// The paths in the order of classes_of().
ShapePicture picture_of(const Frame& frame, const Greatest& greatest, std::size_t point, const Scene& scene) {
  std::string surfaces, bodies, springs, supports, loads, forces, touches, friction;
  for (const WallPicture& wall : drawn_walls(frame, scene.walls)) {
    surfaces += wall.surface;
    bodies += wall.body;
  }
  for (const DrawnSpring& spring : scene.springs) {
    const auto to = spring.to ? std::optional(frame.place(*spring.to)) : std::nullopt;
    springs += spring_data(frame.place(spring.at), to, spring);
  }
  for (const HeldPoint& held : scene.supports) supports += support_data(frame.place(held.at), held);
  for (const AppliedLoad& load : scene.loads) {
    const Vec2 place = frame.place(load.at), way = frame.load_arrow(load.force, greatest.load);
    loads += arrow_data(place - way, way) + moment_data(place, load.moment / greatest.moment);
  }
  for (const ContactMark& contact : scene.shape.contacts) {
    const Vec2 place = frame.place(contact.position);
    touches += touch_data(place, contact);
    const Vec2 along = along_wall(contact);
    forces += arrow_data(place, frame.wall_arrow(contact.force - along, greatest.wall));
    if (!along.isZero()) friction += arrow_data(place, frame.wall_arrow(along, greatest.wall));
  }
  ShapePicture picture{.point = point, .contacts = scene.shape.contacts};
  for (const MemberShape& member : scene.shape.members) picture.paths.push_back(member_data(frame, member));
  picture.paths.insert(picture.paths.end(), {surfaces, bodies, springs, supports, loads, forces, touches, friction});
  return picture;
}

// --- what acts from outside -----------------------------------------------------------------------------------------

Vec2 position_at(const MemberShape& member, double fraction) {
  const auto behind = std::lower_bound(member.points.begin(), member.points.end(), fraction,
                                       [](const ShapePoint& point, double at) { return point.fraction < at; });
  if (behind == member.points.begin()) return behind->position;
  if (behind == member.points.end()) return member.points.back().position;
  const ShapePoint& before = *(behind - 1);
  const double part = (fraction - before.fraction) / (behind->fraction - before.fraction);
  return before.position + part * (behind->position - before.position);
}

// Where a point of the deck or of a member is; nowhere if no member has it.
std::optional<Vec2> position_of(const deck::Deck& deck, const Shape& shape, const deck::Place& place) {
  for (std::size_t m = 0; m < deck.members.size(); ++m) {
    const deck::Member& member = deck.members[m];
    if (shape.members[m].points.empty()) continue;
    if (place.fraction && member.name == place.name) return position_at(shape.members[m], *place.fraction);
    if (!place.fraction && member.from == place.name) return shape.members[m].points.front().position;
    if (!place.fraction && member.to == place.name) return shape.members[m].points.back().position;
  }
  return std::nullopt;
}

// What is spread over a member stands at a few of its points; `load_at(shape, fraction)`.
template <class LoadAt>
void add_spread_load(const deck::Deck& deck, const std::string& member, const LoadAt& load_at, Scene& to) {
  constexpr int arrows = 9;
  for (std::size_t m = 0; m < deck.members.size(); ++m) {
    const MemberShape& shape = to.shape.members[m];
    if (deck.members[m].name != member || shape.points.empty()) continue;
    for (int i = 0; i < arrows; ++i) {
      const double fraction = (i + 0.5) / arrows;
      to.loads.push_back({.at = position_at(shape, fraction), .force = load_at(shape, fraction)});
    }
  }
}

// It acts as the axis lies at rest.
void add_load(const Model& model, const deck::MemberLoad& load, double factor, Scene& to) {
  const auto everywhere = [&](const MemberShape& shape, double fraction) -> Vec2 {
    const auto& members = model.structure().members();
    const MemberMesh& mesh = members[static_cast<std::size_t>(&shape - to.shape.members.data())];
    const double elements = double(mesh.nodes.size() - 1);
    const double angle = mesh.shape[static_cast<std::size_t>(std::lround(fraction * elements))].angle;
    return factor * load.along(1.0).at(fraction, angle);
  };
  add_spread_load(model.deck(), load.member, everywhere, to);
}

void add_load(const deck::Deck& deck, const deck::Pressure& load, double factor, Scene& to) {
  constexpr double beside = 0.02;
  const auto across = [&](const MemberShape& shape, double fraction) {
    const Vec2 along = position_at(shape, fraction + beside) - position_at(shape, fraction - beside);
    return Vec2(-factor * load.pressure * perp(along.normalized()));
  };
  add_spread_load(deck, load.member, across, to);
}

void add_spring(const deck::Deck& deck, const deck::Spring& spring, Scene& to) {
  if (const auto* along = std::get_if<deck::Foundation>(&spring.kind)) {
    constexpr int drawn = 9;
    const auto acts = [&](double stiffness, Dof direction) {
      return along->law ? along->law->direction == direction : stiffness > 0.0;
    };
    for (int i = 0; i < drawn; ++i)
      if (const auto at = position_of(deck, to.shape, {.name = along->member, .fraction = (i + 0.5) / drawn}))
        to.springs.push_back({.at = *at, .x = acts(along->x, Dof::x), .z = acts(along->z, Dof::z)});
    return;
  }
  const auto add = [&](const deck::Place& from, const deck::Place* other, const deck::Stiffness& k,
                       const std::optional<deck::TableLaw>& law) {
    const auto at = position_of(deck, to.shape, from);
    if (!at) return;
    const auto acts = [&](double stiffness, Dof direction) {
      return law ? law->direction == direction : stiffness > 0.0;
    };
    to.springs.push_back(
        {.at = *at, .x = acts(k.x, Dof::x), .z = acts(k.z, Dof::z), .rotation = acts(k.rotation, Dof::rotation)});
    if (other != nullptr) to.springs.back().to = position_of(deck, to.shape, *other);
  };
  if (const auto* ground = std::get_if<deck::GroundSpring>(&spring.kind)) {
    add(ground->at, nullptr, ground->stiffness, ground->law);
  } else {
    const auto& between = std::get<deck::PointToPointSpring>(spring.kind);
    const deck::Place second{.name = between.points[1]};
    add({.name = between.points[0]}, &second, between.stiffness, between.law);
  }
}

// The directions that supports hold, at rest or moved, in the order of the deck.
std::vector<std::pair<std::string, HeldPoint>> held_points(const deck::Deck& deck) {
  std::vector<std::pair<std::string, HeldPoint>> points;
  const auto at = [&](const std::string& point) -> HeldPoint& {
    const auto found =
        std::find_if(points.begin(), points.end(), [&](const auto& other) { return other.first == point; });
    return found != points.end() ? found->second : points.emplace_back(point, HeldPoint{}).second;
  };
  for (const deck::Support& support : deck.supports)
    for (const Dof direction : support.directions) {
      HeldPoint& held = at(support.point);
      held.x = held.x || direction == Dof::x;
      held.z = held.z || direction == Dof::z;
      held.rotation = held.rotation || direction == Dof::rotation;
    }
  for (const deck::Prescribed& moved : deck.prescribed) {
    if (!moved.holds) continue;
    HeldPoint& held = at(moved.point);
    held.x = held.x || moved.x;
    held.z = held.z || moved.z;
    held.rotation = held.rotation || moved.rotation;
  }
  return points;
}

std::vector<DrawnMember> drawn_members(const deck::Deck& deck) {
  std::vector<DrawnMember> members;
  for (const deck::Member& member : deck.members) {
    DrawnMember& drawn = members.emplace_back(DrawnMember{.name = member.name, .from = member.from, .to = member.to});
    const deck::Section* section = find(deck.sections, member.section);
    const deck::Material* material = find(deck.materials, member.material);
    if (section == nullptr || material == nullptr) continue;
    const auto at = [section, E = material->E, bends = member.theory != Theory::truss](double fraction) {
      const deck::SectionProperties of = properties(*section, fraction);
      if (!bends) return DrawnSection{.A = of.A};
      return DrawnSection{.A = of.A, .I = of.I, .EI = E * of.I, .half_height = 0.5 * of.height.value_or(0.0)};
    };
    drawn.allowable = material->allowable.value_or(0.0);
    drawn.section = at(0.0);
    if (tapers(*section)) drawn.section_at = at;
  }
  return members;
}

}  // namespace

std::vector<std::size_t> points_to_draw(const Record& record, std::size_t most) {
  const std::size_t count = record.points.size();
  const std::vector<std::size_t> first = first_points(record);
  std::set<std::size_t> events;
  for (const RecordEvent& event : record.events) events.insert(point_of(event, first));
  std::set<std::size_t> drawn;
  if (2 * events.size() <= most) drawn = events;
  const std::size_t room = std::max<std::size_t>(most - drawn.size(), 1);
  const std::size_t every = count <= most ? 1 : (count + room - 1) / room;
  for (std::size_t b = 0; b + 1 < first.size(); ++b) {
    for (std::size_t i = first[b]; i < first[b + 1]; i += every) drawn.insert(i);
    if (first[b] < first[b + 1]) drawn.insert(first[b + 1] - 1);
  }
  return {drawn.begin(), drawn.end()};
}

Scene scene_of(const Model& model, const State& state) {
  const deck::Deck& deck = model.deck();
  const deck::Frame& frame = model.frame();
  Scene scene{.shape = shape_of(model, state)};
  for (const deck::Load& load : deck.loads) {
    const double factor = load.constant ? 1.0 : state.lambda, by_length = factor * frame.factor(-1);
    if (const auto* spread = std::get_if<deck::MemberLoad>(&load.action)) add_load(model, *spread, by_length, scene);
    if (const auto* pressure = std::get_if<deck::Pressure>(&load.action)) add_load(deck, *pressure, by_length, scene);
    const auto* single = std::get_if<deck::PointLoad>(&load.action);
    const auto at = single == nullptr ? std::nullopt : position_of(deck, scene.shape, single->at);
    if (at)
      scene.loads.push_back({.at = *at,
                             .force = factor * Vec2(single->force.x, single->force.z),
                             .moment = factor * frame.factor() * single->moment});
  }
  for (WallShape& wall : wall_shapes(model, state.lambda))
    if (wall.moves) scene.walls.push_back(std::move(wall));
  for (const deck::Spring& spring : deck.springs) add_spring(deck, spring, scene);
  for (const auto& [point, held] : held_points(deck)) {
    const auto at = position_of(deck, scene.shape, {.name = point});
    if (!at || !(held.x || held.z || held.rotation)) continue;
    scene.supports.push_back(held);
    scene.supports.back().at = *at;
  }
  return scene;
}

const Shape* DrawnScenes::shape_at(std::size_t point) const {
  const auto found = std::lower_bound(points.begin(), points.end(), point);
  return found != points.end() && *found == point ? &scenes[static_cast<std::size_t>(found - points.begin())].shape
                                                  : nullptr;
}

DrawnScenes scenes_to_draw(const Model& model, const Record& record) {
  constexpr std::size_t most_coordinates = 400'000;  // about 4 MB
  if (record.points.empty()) return {};
  const auto scene_in = [&](Index branch, const State& state) {
    return scene_of(model.at_stage(record.stage_number(branch)), state);
  };
  const auto scene_at = [&](const RecordPoint& point) { return scene_in(point.branch, point.state); };
  Scene first = scene_at(record.points.front());
  std::size_t per_shape = 1;
  for (const MemberShape& member : first.shape.members) per_shape += member.points.size();
  DrawnScenes drawn{.points = points_to_draw(record, std::max<std::size_t>(most_coordinates / per_shape, 2))};
  for (const std::size_t point : drawn.points)
    drawn.scenes.push_back(point == 0 ? std::move(first) : scene_at(record.points[point]));
  for (const Jump& jump : jumps(record)) drawn.scenes.push_back(scene_in(jump.event->branch, jump.end->state));
  return drawn;
}

Setting setting_of(const Model& model) {
  std::vector<WallShape> walls = wall_shapes(model);
  std::erase_if(walls, [](const WallShape& wall) { return wall.moves; });
  return {.walls = std::move(walls),
          .heights = section_heights(model.whole_deck()),
          .members = drawn_members(model.whole_deck())};
}

ShapePictures draw(const DrawnScenes& drawn, const Setting& setting) {
  const auto& [points, scenes] = drawn;
  if (scenes.empty()) return {};
  const Box box = box_of(scenes, setting);
  const Greatest greatest = greatest_forces(scenes);
  const Frame frame(box, stretch_of(box.size()));
  ShapePictures result{.width = frame.size().x(),
                       .height = frame.size().y(),
                       .stretch = stretch_of(box.size()),
                       .greatest_force = greatest.wall,
                       .greatest_move = greatest_move(frame, scenes),
                       .classes = classes_of(scenes.front())};
  result.move_unit = unit_of_moves(result.greatest_move);
  result.thickness.resize(result.classes.size(), 0.0);
  for (std::size_t m = 0; m < setting.heights.size(); ++m) result.thickness[m] = frame.thickness(setting.heights[m]);
  for (const WallPicture& wall : drawn_walls(frame, setting.walls)) {
    result.surfaces.push_back(wall.surface);
    result.bodies.push_back(wall.body);
  }
  constexpr std::size_t finest = 81, coarsest = 9, most_samples = 80'000;  // about 3 MB
  const std::size_t lines = std::max<std::size_t>(scenes.size() * scenes.front().shape.members.size(), 1);
  const std::size_t samples = std::min(finest, most_samples / lines);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const bool is_of_the_path = i < points.size();
    std::vector<ShapePicture>& list = is_of_the_path ? result.pictures : result.after_jumps;
    ShapePicture& added = list.emplace_back(picture_of(frame, greatest, is_of_the_path ? points[i] : 0, scenes[i]));
    if (samples >= coarsest) added.forces = sampled_forces(scenes[i].shape, samples);
    if (result.move_unit > 0.0)
      for (const MemberShape& member : scenes[i].shape.members)
        added.moves.push_back(moves_data(frame, member, result.move_unit));
  }
  result.members = setting.members;
  for (const WallShape& wall : setting.walls) result.walls.push_back({.name = wall.name, .members = wall.members});
  return result;
}

}  // namespace arcwall
