#include "apps/verify/touches.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "apps/verify/differences.hpp"
#include "apps/verify/moved_unknowns.hpp"
#include "apps/verify/section_point.hpp"
#include "core/text.hpp"

namespace arcwall::verify {

namespace {

using Span = SlidingContactLayout::Span;

constexpr double difference_step = 1e-4;  // of the structure's length, or an angle

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

const PlainWall& wall_of(const std::vector<PlainWall>& walls, const std::string& name) {
  return *std::find_if(walls.begin(), walls.end(), [&](const PlainWall& wall) { return wall.deck().name == name; });
}

// The slope of that by the place, of an outline.
Vec2 normal_of(const PlainWall& wall, const Vec2& place) {
  return wall.faces(place) ? Vec2(perp(direction(wall.slope_angle(place)))) : Vec2(Vec2::Zero());
}

// Where a member touches that has its face or its axis at a place.
Vec2 touching_place(const PlainWall& wall, const Vec2& place, double half_height) {
  const double off = wall.kept_off(half_height);
  return off > 0.0 && wall.faces(place) ? Vec2(place - off * perp(direction(wall.slope_angle(place)))) : place;
}

// --- contact at nodes -----------------------------------------------------------------------------------------------

// The sections at which members may touch, looked up by the labels of contacts: one list for all of a state's.
class ContactSections {
 public:
  explicit ContactSections(const Structure& structure) {
    for (const MemberMesh& mesh : structure.members()) {
      OfMember& member = members_[mesh.name];
      member.half_height = 0.5 * mesh.height.value_or(0.0);
      member.sections = mesh.contact_sections();
      std::stable_sort(member.sections.begin(), member.sections.end(), is_before);
    }
  }

  /// The one that a label means.
  const MemberSection& at(const ContactLabel& label) const {
    const std::vector<MemberSection>& sections = members_.at(label.member).sections;
    const auto behind =
        std::lower_bound(sections.begin(), sections.end(), MemberSection{.fraction = label.fraction}, is_before);
    if (behind == sections.begin()) return *behind;
    const auto before = behind - 1;
    if (behind == sections.end()) return *before;
    return behind->fraction - label.fraction < label.fraction - before->fraction ? *behind : *before;
  }

  double half_height(const std::string& member) const { return members_.at(member).half_height; }

 private:
  struct OfMember {
    double half_height = 0.0;
    std::vector<MemberSection> sections{};
  };

  static bool is_before(const MemberSection& a, const MemberSection& b) { return a.fraction < b.fraction; }

  std::unordered_map<std::string, OfMember> members_;
};

NodeFunction node_unknowns(const Structure& structure, const MemberSection& section, const State& state) {
  std::vector<Index> freedoms{structure.freedom(section.node, Freedom::x), structure.freedom(section.node, Freedom::z)};
  if (section.rotation) freedoms.push_back(*section.rotation);
  if (section.thickness) freedoms.insert(freedoms.end(), {section.thickness->e, section.thickness->xi});
  NodeFunction function{.at = Vector(static_cast<Index>(freedoms.size()))};
  function.steps = Vector::Constant(function.at.size(), difference_step);
  function.steps.head<2>() *= structure.length_scale();
  for (std::size_t i = 0; i < freedoms.size(); ++i) {
    function.unknowns.push_back(structure.unknown(freedoms[i]).value_or(-1));
    function.at[static_cast<Index>(i)] = structure.value(state, freedoms[i]);
  }
  if (section.thickness) function.steps[4] /= structure.length_scale();
  return function;
}

// Which face touches is a choice of the model's: where both could, the one that its candidate has.
double offset_of(const Model& model, const PlainWall& wall, Index j, SectionPoint point, double half,
                 const State& rest) {
  if (wall.deck().acts_on == deck::ActsOn::axis || wall.has_outline()) return 0.0;
  const Vec2 meant = model.contact()->candidate(j).point().position(rest);
  const auto distance = [&](double offset) {
    point.offset = offset;
    return (point.at(Vector::Zero(2)) - meant).norm();
  };
  return distance(half) < distance(-half) ? half : -half;
}

// What is the same for all contacts of a state.
struct NodeContacts {
  const Model& model;
  const std::vector<PlainWall>& walls;
  const State& state;
  ContactSections sections{model.structure()};
  State rest{.x = Vector::Zero(model.structure().size({}))};
};

Touch node_touch(const NodeContacts& all, Index j) {
  const auto& [model, walls, state, sections, rest] = all;
  const Structure& structure = model.structure();
  const ContactLabel& label = model.contact()->candidate(j).label();
  const PlainWall& wall = wall_of(walls, label.wall);
  const MemberSection& section = sections.at(label);
  const double half = sections.half_height(label.member);
  SectionPoint point{.node = structure.position(section.node),
                     .shape_angle = section.shape.angle,
                     .axis_angle = section.axis.angle,
                     .along_director = section.quadratic == QuadraticTerm::director};
  point.offset = offset_of(model, wall, j, point, half, rest);
  Touch touch{.label = label, .gap = node_unknowns(structure, section, state)};
  touch.gap.of = [point, half, &wall](const Vector& u) { return wall.gap_to(point.at(u), half); };
  if (wall.has_outline()) touch.gap.by_place = [point, &wall](const Vector& u) { return normal_of(wall, point.at(u)); };
  touch.place = touching_place(wall, point.at(touch.gap.at), half);
  const deck::Contact& contact = model.deck().contact;
  const double spring = contact.penalty.value_or(0.0) * label.tributary;
  if (contact.method == ContactLaw::Method::penalty) touch.compliance = 1.0 / spring;
  if (contact.method == ContactLaw::Method::augmented) touch.stiffness = spring;
  return touch;
}

// What two walls without clearance exert is one unknown, of either sign, which stands where the first of them does.
void read_forces(const Model& model, const State& state, Touches& touches) {
  Index next = model.structure().size({});
  for (std::size_t j = 0; j < state.piece.size(); ++j) {
    Touch& touch = touches.all[j];
    touch.closed = state.piece[j] != 0;
    const auto opposite = model.contact()->candidate(static_cast<Index>(j)).opposite();
    if (!touch.closed || (opposite && *opposite < static_cast<Index>(j))) continue;
    const double force = state.x[next++];
    touch.force = opposite ? std::max(force, 0.0) : force;
    if (opposite) touches.all[static_cast<std::size_t>(*opposite)].force = std::max(-force, 0.0);
  }
}

// Walls that touch a node from opposite sides, their gaps closed whether or not the run says so: no motion takes the
// node off both.
void find_opposite(double length, std::vector<Touch>& touches) {
  constexpr double no_gap = 1e-12, opposite = 1e-7;  // of the structure's length; of the gradients
  std::map<std::vector<Index>, std::vector<Touch*>> of_node;
  for (Touch& touch : touches)
    if (touch.closed || std::abs(touch.gap.value()) <= no_gap * length) of_node[touch.gap.unknowns].push_back(&touch);
  for (auto& [unknowns, at] : of_node)
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t j = i + 1; j < at.size(); ++j) {
        Touch &a = *at[i], &b = *at[j];
        const Vector of_a = a.gap.gradient();
        if (a.two_sided || b.two_sided || (of_a + b.gap.gradient()).norm() > opposite * of_a.norm()) continue;
        a.two_sided = b.two_sided = true;
        a.against = b.force;
        b.against = a.force;
      }
}

Touches node_touches(const Model& model, const std::vector<PlainWall>& walls, const State& state) {
  Touches touches;
  const NodeContacts contacts{.model = model, .walls = walls, .state = state};
  for (std::size_t j = 0; j < state.piece.size(); ++j)
    touches.all.push_back(node_touch(contacts, static_cast<Index>(j)));
  read_forces(model, state, touches);
  find_opposite(model.structure().length_scale(), touches.all);
  return touches;
}

// --- contact that slides --------------------------------------------------------------------------------------------

struct SlidingNode {
  Index strand = 0, position = 0;
};

// A sliding state with what stands in it.
struct Sliding {
  const Model& model;
  const State& state;
  const SlidingStructure& body = *model.sliding_structure();
  const SlidingContactLayout& on = sliding_layout(state.piece);
  const SlidingMesh& mesh = on.mesh();
  MeshState now = mesh_state_of(state);
  MovedUnknowns x{Vector(now.x)};

  // Where the node's unknowns are held its place is still known.
  AxisPlace place(const SlidingNode& node, const NodeFunction& function, const Vector& u) const {
    return x.with(function.unknowns, u, [&](const Vector& moved) {
      return mesh.node(node.strand, node.position, {moved, now.s, now.lambda});
    });
  }

  NodeFunction unknowns(const SlidingNode& node) const {
    const NodeUnknowns indices = mesh.node_unknowns(node.strand, node.position);
    NodeFunction function{.unknowns = {indices.begin(), indices.end()}, .at = Vector::Zero(3)};
    function.steps = Vector::Constant(3, difference_step);
    function.steps.head<2>() *= body.length_scale();
    for (std::size_t i = 0; i < 3; ++i)
      if (indices[i] >= 0) function.at[static_cast<Index>(i)] = now.x[indices[i]];
    return function;
  }
};

const PlainWall& wall_of_obstacle(const Sliding& at, const std::vector<PlainWall>& walls, std::size_t obstacle) {
  return wall_of(walls, at.model.sliding()->obstacles()[obstacle].name);
}

// Of the axis or the face that looks at the wall: its normal along the wall's or against it, with the direction of
// travel.
Vec2 face_towards(const PlainWall& wall, double half_height, const AxisPlace& place) {
  if (wall.deck().acts_on == deck::ActsOn::axis || wall.has_outline()) return place.position;
  const Vec2 normal = perp(direction(place.angle));
  return place.position - (normal.y() >= 0.0 ? 1.0 : -1.0) * wall.side() * half_height * normal;
}

Touch sliding_touch(const std::shared_ptr<const Sliding>& at, const PlainWall& wall, const SlidingNode& node) {
  const auto [member, fraction] =
      at->body.label({.strand = node.strand, .s = at->mesh.coordinate(node.strand, node.position, at->now.s)});
  Touch touch{.label = {.wall = wall.deck().name, .member = member, .fraction = fraction}, .gap = at->unknowns(node)};
  const double half = at->body.half_height(node.strand);
  const auto face = [=, &wall, function = touch.gap](const Vector& u) {
    return face_towards(wall, half, at->place(node, function, u));
  };
  touch.place = touching_place(wall, face(touch.gap.at), half);
  touch.gap.of = [face, half, &wall](const Vector& u) { return wall.gap_to(face(u), half); };
  if (wall.has_outline()) touch.gap.by_place = [face, &wall](const Vector& u) { return normal_of(wall, face(u)); };
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

// The spring c = p Λ_f/|κ − Λ_f κ_w| of (8.8) on the tilt, by what the element on the free side carries: κ = κ₀ + M/EI,
// Λ = 1 + N/EA. What touches a profile is the face at the offset o, stretched by Λ_f = Λ − o κ; what touches an outline
// is the axis.
std::optional<double> contact_spring(const Sliding& at, const PlainWall& wall, const SlidingNode& node,
                                     std::size_t point, double force) {
  const bool before = at.on.span_before(point) == Span::free;
  const double sign = before ? 1.0 : -1.0;
  const auto ends = at.mesh.end_forces(node.strand, before ? node.position - 1 : node.position, at.now);
  const Eigen::Vector3d& end = ends[before ? 1 : 0];
  const AxisPlace place = at.mesh.node(node.strand, node.position, at.now);
  const double s = at.mesh.coordinate(node.strand, node.position, at.now.s), half = at.body.half_height(node.strand);
  const Vec2 face = face_towards(wall, half, place);
  const double against = wall.has_outline() ? wall.slope_angle(face) : 0.0;
  const double travel = std::cos(place.angle - against) >= 0.0 ? 1.0 : -1.0;
  const double curvature = travel * (at.body.natural_curvature({.strand = node.strand, .s = s}, at.now.lambda) +
                                     sign * end[2] / at.body.bending_stiffness(node.strand));
  const double stretch = 1.0 + at.body.free_strain(node.strand, at.now.lambda).value +
                         sign * end.head<2>().dot(direction(place.angle)) / at.body.axial_stiffness(node.strand);
  const bool is_face = !wall.has_outline() && wall.deck().acts_on == deck::ActsOn::face;
  const double offset = is_face ? -wall.side() * half : 0.0;
  const double stretch_there = stretch - offset * curvature;
  const double opening = wall.side() * (curvature - stretch_there * curvature_touched(wall, face, half));
  constexpr double touching = 1e-9;  // a line is about to form, or has just vanished
  if (opening * at.body.length_scale() <= touching) return std::nullopt;
  return force * stretch_there / opening;
}

// An element that turns farther does not tell how the body bends [rad].
constexpr double most_turn = 0.3;

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
  if (!point || at->on.lies_pressed(*point)) tangency.end_of_pressed = true;
  if (!point || at->on.lies_beside(*point)) return tangency;
  if (at->on.points()[*point].is_pinched()) {  // its place is held besides, so that a couple alone holds its direction
    const double angle = wall.slope_angle(face_towards(wall, half, at->place(node, tangency.tilt, tangency.tilt.at)));
    tangency.tilt.of = [=, function = tangency.tilt](const Vector& u) {
      return std::remainder(at->place(node, function, u).angle - angle, pi);
    };
    tangency.end_of_pressed = true;
    return tangency;
  }
  tangency.spring = touch.closed ? contact_spring(*at, wall, node, *point, touch.force) : 0.0;
  tangency.unresolved = touch.closed && is_unresolved(*at, node.strand);
  return tangency;
}

// Free ends of runs, walls outside: the order in which a piece has them behind its points.
std::vector<std::pair<SlidingNode, const PlainWall*>> free_ends(const Sliding& at,
                                                                const std::vector<PlainWall>& walls) {
  std::vector<std::pair<SlidingNode, const PlainWall*>> ends;
  const auto concerns = [&](const PlainWall& wall, Index strand) {
    return wall.concerns(at.body.label({.strand = strand, .s = 0.0}).first);
  };
  for (Index strand = 0; strand < at.body.strands(); ++strand)
    for (const PlainWall& wall : walls)
      for (const bool last : {false, true}) {
        if (!concerns(wall, strand) || at.body.end_is_held(strand, last)) continue;
        const bool on_axis = wall.has_outline() || wall.deck().acts_on == deck::ActsOn::axis;
        const StrandEnd first = at.body.first_of_joint(strand, last, on_axis);
        const bool is_as_thick = wall.deck().acts_on == deck::ActsOn::axis ||
                                 at.body.half_height(first.strand) == at.body.half_height(strand);
        if (first != StrandEnd{.strand = strand, .last = last} && is_as_thick && concerns(wall, first.strand)) continue;
        ends.push_back({{.strand = strand, .position = last ? at.mesh.nodes(strand) - 1 : 0}, &wall});
      }
  return ends;
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
  const Vec2 place = pinch_of(*at, label.wall, now.position).place, axis = direction(now.angle);
  pinched.along.of = [=, function = pinched.along](const Vector& u) {
    return axis.dot(at->place(node, function, u).position - place);
  };
  return pinched;
}

// At sharp corners walls have no normal of their own: knife edges press across the axis, as it is now. What is stored
// is their force across and along the axis at rest.
void press_across(const SlidingContact::PinchedPlace& pinch, double angle, Touch& first, Touch& other,
                  Pinched& pinched) {
  const Vec2 axis = direction(angle), across = perp(axis);
  const Vec2 normal = across.dot(pinch.normal) >= 0.0 ? across : Vec2(-across);
  first.gap.by_place = [normal](const Vector&) { return normal; };
  other.gap.by_place = [normal](const Vector&) -> Vec2 { return -normal; };
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
  const Index moments = state.x.size() - 2 * at->mesh.breakpoints();
  const auto& tips = at->on.pressed_tips();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto [strand, position] = at->mesh.breakpoint(static_cast<Index>(k));
    const SlidingNode node{.strand = strand, .position = position};
    const PlainWall& wall = wall_of_obstacle(*at, walls, points[k].obstacle);
    const Touch& touch = add(wall, node, state.piece[k] != 0);
    const AxisPlace axis = at->mesh.node(strand, position, at->now);
    std::optional<SlidingContact::PinchedPlace> pinch;
    if (points[k].is_pinched()) pinch = pinch_of(*at, wall.deck().name, axis.position);
    if (!pinch || !pinch->knife_edges) {
      touches.tangencies.push_back(tangency(at, wall, touch, node, k));
      touches.tangencies.back().moment = state.x[moments + static_cast<Index>(k)];
    }
    if (!pinch) continue;
    const auto behind = std::find(pinched.begin(), pinched.end(), k);
    const Index along = moments - static_cast<Index>(tips.size()) - (pinched.end() - behind);
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
    touches.tangencies.back().moment = state.x[moments - static_cast<Index>(tips.size() - i)];
  }
  const auto ends = free_ends(*at, walls);
  for (std::size_t i = 0; i < ends.size(); ++i)
    add(*ends[i].second, ends[i].first, state.piece[points.size() + i] != 0);
  for (const SlidingContactLayout::PressedNode& node : at->on.pressed_nodes()) {
    add(wall_of_obstacle(*at, walls, node.obstacle), {.strand = node.strand, .position = node.position}, true);
    touches.all.back().listed = false;
  }
  return touches;
}

}  // namespace

Vector NodeFunction::gradient() const {
  Vector gradient = Vector::Zero(at.size());
  if (by_place) {
    const Vec2 slope = by_place(at);
    for (Index i = 0; i < 2; ++i)
      if (unknowns[static_cast<std::size_t>(i)] >= 0) gradient[i] = slope[i];
    return gradient;
  }
  for (Index i = 0; i < at.size(); ++i)
    if (unknowns[static_cast<std::size_t>(i)] >= 0)
      gradient[i] = derivative([&](double step) { return of(at + step * Vector::Unit(at.size(), i)); }, steps[i]);
  return gradient;
}

Matrix NodeFunction::hessian() const {
  const Index n = at.size();
  Matrix hessian = Matrix::Zero(n, n);
  const auto varied = [&](Index i, double by) {
    NodeFunction moved = *this;
    moved.at[i] += by;
    return moved.gradient();
  };
  for (Index i = 0; i < n; ++i)
    if (unknowns[static_cast<std::size_t>(i)] >= 0)
      hessian.col(i) = derivative([&](double step) { return varied(i, step); }, steps[i]);
  return 0.5 * (hessian + hessian.transpose());
}

Touches touches(const Model& model, const std::vector<PlainWall>& walls, const State& state) {
  if (model.sliding() != nullptr) return sliding_touches(model, walls, state);
  return model.contact() != nullptr ? node_touches(model, walls, state) : Touches{};
}

namespace {

// An element of a sliding mesh beside a wall: where its face is and how far from the wall, by fractions of the element.
struct ElementBeside {
  const Sliding& at;
  const PlainWall& wall;
  Index strand, position;

  double coordinate(Index behind) const { return at.mesh.coordinate(strand, position + behind, at.now.s); }
  double length() const { return coordinate(1) - coordinate(0); }
  AxisPlace place(double t) const { return at.mesh.inside(strand, position, t, at.now); }
  double gap(double t) const {
    const double half = at.body.half_height(strand);
    return wall.gap_to(face_towards(wall, half, place(t)), half);
  }

  std::string name(double t) const {
    const auto [member, fraction] = at.body.label({.strand = strand, .s = coordinate(0) + t * length()});
    return wall.deck().name + " at " + member + ":" + round_trip(fraction);
  }
};

// The cubic on [0, 1] that has f's values and slopes at both ends.
template <class Function>
double cubic_of_ends(const Function& f, double t) {
  constexpr double step = 1e-4;
  const double from = f(0.0), to = f(1.0);
  const double leaves = (4.0 * f(step) - 3.0 * from - f(2.0 * step)) / (2.0 * step);
  const double arrives = (3.0 * to - 4.0 * f(1.0 - step) + f(1.0 - 2.0 * step)) / (2.0 * step);
  const double r = 1.0 - t;
  return from * r * r * (1.0 + 2.0 * t) + to * t * t * (1.0 + 2.0 * r) + leaves * t * r * r - arrives * t * t * r;
}

// By how much the curvature of the element's shape differs, at most, from κ₀ + M/EI, M being carried from the moments
// at its ends by equilibrium: M = (1 − t) M₀ + t M₁ + (r − r₀ − t c) × f₀ − ½ t (1 − t) c × q l, c from end to end.
double curvature_error(const ElementBeside& beside, int places) {
  const auto& [at, wall, strand, position] = beside;
  const double length = beside.length();
  const auto ends = at.mesh.end_forces(strand, position, at.now);
  const Vec2 first = beside.place(0.0).position, chord = beside.place(1.0).position - first;
  const MaterialPoint middle{.strand = strand, .s = 0.5 * (beside.coordinate(0) + beside.coordinate(1))};
  const Vec2 load = length * at.body.load(middle, beside.place(0.5), chord.norm() / length, at.now.lambda);
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  double worst = 0.0;
  for (int i = 1; i < places; ++i) {
    const double t = double(i) / places, r = 1.0 - t, step = 0.5 / places;
    const double moment = -r * ends[0][2] + t * ends[1][2] +
                          cross(beside.place(t).position - first - t * chord, ends[0].head<2>()) -
                          0.5 * t * r * cross(chord, load);
    const double natural =
        at.body.natural_curvature({.strand = strand, .s = beside.coordinate(0) + t * length}, at.now.lambda);
    const double curvature = (beside.place(t + step).angle - beside.place(t - step).angle) / (2.0 * step * length);
    worst = std::max(worst, std::abs(curvature - natural - moment / at.body.bending_stiffness(strand)));
  }
  return worst;
}

// What the curvature of an element in a pressed part lacks: nodes bear the pressure p that the wall has all along,
// which between them bends by p l²/12 at most.
double lumped_curvature(const ElementBeside& beside) {
  const auto& [at, wall, strand, position] = beside;
  double force = 0.0;
  for (const SlidingContactLayout::PressedNode& node : at.on.pressed_nodes()) {
    if (node.strand != strand || (node.position != position && node.position != position + 1)) continue;
    const auto before = at.mesh.end_forces(strand, node.position - 1, at.now);
    const auto behind = at.mesh.end_forces(strand, node.position, at.now);
    force = std::max(force, (before[1] + behind[0]).head<2>().norm());
  }
  return force * beside.length() / (12.0 * at.body.bending_stiffness(strand));
}

// What a gap may be off by between the nodes of an element.
class ShapeAllowance {
 public:
  ShapeAllowance(const ElementBeside& beside, int places, double most_of_cubic)
      : bending_(0.5 * beside.length() * beside.length() *
                 (curvature_error(beside, places) + lumped_curvature(beside))) {
    for (int i = 1; i < places; ++i) {
      const double t = double(i) / places;
      const double off = std::abs(beside.gap(t) - cubic_of_ends([&](double f) { return beside.gap(f); }, t));
      if (std::isfinite(off)) cubic_ = std::max(cubic_, off);
    }
    cubic_ = std::min(cubic_, most_of_cubic);
  }

  // A curvature that is off by δ all along bends the middle by δ l²/8.
  double at(double t) const { return bending_ * t * (1.0 - t) + cubic_; }

 private:
  double bending_, cubic_ = 0.0;
};

// So many parts of an element that no wall is narrower than four of them.
int places_along(const PlainWall& wall, double length) {
  constexpr double least = 10.0, most = 400.0;
  return static_cast<int>(std::clamp(std::ceil(4.0 * length / wall.width()), least, most));
}

}  // namespace

Entry deepest_entry(const Model& model, const std::vector<PlainWall>& walls, const State& state, double roundoff) {
  Entry deepest{.allowed = roundoff};
  if (model.sliding() == nullptr) return deepest;
  const Sliding at{.model = model, .state = state};
  const auto look_at = [&](const ElementBeside& beside) {
    const int places = places_along(beside.wall, beside.length());
    std::optional<ShapeAllowance> allowance;
    for (int i = 0; i <= places; ++i) {
      const double t = double(i) / places, depth = -beside.gap(t);
      if (depth > roundoff && !allowance) {
        const bool turns_far = std::abs(beside.place(1.0).angle - beside.place(0.0).angle) > most_turn;
        allowance.emplace(beside, places, (turns_far ? 1e-3 : 1e-5) * at.body.length_scale());
      }
      const double allowed = roundoff + (depth > roundoff ? allowance->at(t) : 0.0);
      if (depth * deepest.allowed > deepest.depth * allowed)  // nearer to what is allowed, or beyond
        deepest = {.depth = depth, .allowed = allowed, .where = beside.name(t)};
    }
  };
  for (Index strand = 0; strand < at.body.strands(); ++strand)
    for (const PlainWall& wall : walls)
      if (wall.concerns(at.body.label({.strand = strand, .s = 0.0}).first))
        for (Index e = 0; e + 1 < at.mesh.nodes(strand); ++e)
          look_at({.at = at, .wall = wall, .strand = strand, .position = e});
  return deepest;
}

}  // namespace arcwall::verify
