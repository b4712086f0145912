#include "apps/verify/node_touches.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "apps/verify/section_point.hpp"
#include "core/unit_tangent.hpp"

namespace arcwall::verify {

namespace {

// The sections at which members may touch, looked up by the labels of contacts: one list for all of a state's.
class ContactSections {
 public:
  explicit ContactSections(const Structure& structure) {
    for (const MemberMesh& mesh : structure.members()) {
      OfMember& member = members_[mesh.name];
      member.mesh = &mesh;
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

  double half_height(const ContactLabel& label) const {
    return 0.5 * members_.at(label.member).mesh->height_at(at(label).fraction).value_or(0.0);
  }

 private:
  struct OfMember {
    const MemberMesh* mesh = nullptr;
    std::vector<MemberSection> sections{};
  };

  static bool is_before(const MemberSection& a, const MemberSection& b) { return a.fraction < b.fraction; }

  std::unordered_map<std::string, OfMember> members_;
};

NodeFunction node_unknowns(const Structure& structure, const MemberSection& section, const State& state) {
  std::vector<Index> dofs{structure.dof(section.node, Dof::x), structure.dof(section.node, Dof::z)};
  if (section.rotation) dofs.push_back(*section.rotation);
  if (section.thickness) dofs.insert(dofs.end(), {section.thickness->e, section.thickness->xi});
  NodeFunction function{.at = Vector(static_cast<Index>(dofs.size()))};
  function.steps = Vector::Constant(function.at.size(), touch_difference);
  function.steps.head<2>() *= structure.length_scale();
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    function.unknowns.push_back(structure.unknown(dofs[i]).value_or(-1));
    function.at[static_cast<Index>(i)] = structure.value(state, dofs[i]);
  }
  if (section.thickness) function.steps[4] /= structure.length_scale();
  return function;
}

// Which face touches is a choice of the model's: where both could, the one that its candidate has.
double offset_of(const Model& model, const PlainWall& wall, Index j, SectionPoint point, double half,
                 const State& rest) {
  if (wall.deck().contact_surface == deck::ContactSurface::axis || wall.has_outline()) return 0.0;
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

SectionPoint section_point(const NodeContacts& all, Index j) {
  const auto& [model, walls, state, sections, rest] = all;
  const ContactLabel& label = model.contact()->candidate(j).label();
  const MemberSection& section = sections.at(label);
  SectionPoint point{.node = model.structure().position(section.node),
                     .shape_angle = section.shape.angle,
                     .axis_angle = section.axis.angle,
                     .along_director = section.quadratic == QuadraticTerm::director};
  point.offset = offset_of(model, wall_of(walls, label.wall), j, point, sections.half_height(label), rest);
  return point;
}

Touch node_touch(const NodeContacts& all, Index j) {
  const auto& [model, walls, state, sections, rest] = all;
  const Structure& structure = model.structure();
  const ContactLabel& label = model.contact()->candidate(j).label();
  const PlainWall& wall = wall_of(walls, label.wall);
  const MemberSection& section = sections.at(label);
  const double half = sections.half_height(label);
  const SectionPoint point = section_point(all, j);
  Touch touch{.label = label, .gap = node_unknowns(structure, section, state)};
  touch.gap.of = [point, half, &wall](const Vector& u) { return wall.gap_to(point.at(u), half); };
  if (wall.has_outline())
    take_outline(
        wall, [point](const Vector& u) { return point.at(u); }, touch.gap);
  touch.place = wall.touched_by(point.at(touch.gap.at), half);
  touch.gap.resolve(wall.from_vertical(point.at(touch.gap.at)));
  const deck::Contact& contact = model.deck().contact;
  const double spring = contact.penalty.value_or(0.0) * label.tributary;
  if (contact.method == ContactLaw::Method::penalty) touch.compliance = 1.0 / spring;
  if (contact.method == ContactLaw::Method::augmented) touch.stiffness = spring;
  return touch;
}

// What two walls without clearance exert is one unknown, of either sign, which stands where the first of them does.
void read_forces(const Model& model, const State& state, Touches& touches) {
  Index next = model.structure().size({});
  for (std::size_t j = 0; j < state.active_set.contacts(); ++j) {
    Touch& touch = touches.all[j];
    touch.closed = state.active_set[j] != 0;
    const auto opposite = model.contact()->candidate(static_cast<Index>(j)).opposite();
    if (!touch.closed || (opposite && *opposite < static_cast<Index>(j))) continue;
    const double force = state.x[next++];
    touch.force = opposite ? std::max(force, 0.0) : force;
    if (opposite) touches.all[static_cast<std::size_t>(*opposite)].force = std::max(-force, 0.0);
  }
}

// Forces along the walls stand behind all forces across them. The deck gives their coefficients.
void read_friction(const NodeContacts& contacts, Touches& touches) {
  const auto& [model, walls, state, sections, rest] = contacts;
  auto next = model.structure().size({}) + state.active_set.closed_count();
  for (std::size_t j = 0; j < state.active_set.contacts(); ++j) {
    Touch& touch = touches.all[j];
    const ContactPoint told = model.contact()->contact(state, static_cast<Index>(j));
    if (!touch.closed || !told.friction) continue;
    const PlainWall& wall = wall_of(walls, touch.label.wall);
    SectionPoint point = section_point(contacts, static_cast<Index>(j));
    if (model.deck().contact.friction_at == deck::FrictionAt::axis) point.offset = 0.0;
    const double sign = wall.has_outline() || wall.deck().side == Side::below ? 1.0 : -1.0;
    const Vec2 tangent = sign * unit_tangent(wall.slope_angle(point.at(touch.gap.at)));
    FrictionAtTouch friction{
        .along = touch.gap,
        .force = state.x[next++],
        .coefficient = deck::friction_of(model.deck(), wall.deck(), touch.label.member, touch.label.fraction),
        .slips = slips(told.friction->mode),
        .slip = told.friction->slip};
    friction.along.slopes = nullptr;
    friction.along.bends = nullptr;
    friction.along.of = [point, tangent](const Vector& u) { return tangent.dot(point.at(u)); };
    touch.friction = std::move(friction);
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

}  // namespace

Touches node_touches(const Model& model, const std::vector<PlainWall>& walls, const State& state) {
  Touches touches;
  const NodeContacts contacts{.model = model, .walls = walls, .state = state};
  for (std::size_t j = 0; j < state.active_set.contacts(); ++j)
    touches.all.push_back(node_touch(contacts, static_cast<Index>(j)));
  read_forces(model, state, touches);
  if (deck::has_friction(model.deck())) read_friction(contacts, touches);
  find_opposite(model.structure().length_scale(), touches.all);
  return touches;
}

}  // namespace arcwall::verify
