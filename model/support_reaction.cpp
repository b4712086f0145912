#include "model/support_reaction.hpp"

#include <string>
#include <utility>
#include <vector>

#include "model/compliant_contact.hpp"
#include "model/wall_force.hpp"

namespace arcwall {

namespace {

// A force of the structure, with what kinks of spring laws do to its derivative.
std::shared_ptr<const Observable> structural_reaction(const Measured& from, Index dof) {
  auto reaction = from.body.reaction(dof);
  if (from.kinked == nullptr || from.structure.unknown(dof)) return reaction;
  std::vector<KinkedForce::Part> parts;
  const auto& springs = from.structure.nodal_terms().law_springs();
  for (std::size_t i = 0; i < springs.size(); ++i)
    if (springs[i].joins(dof)) parts.push_back({.spring = i, .sign = springs[i].sign(dof)});
  if (parts.empty()) return reaction;
  return std::make_shared<KinkedForce>(*from.kinked, std::move(reaction), std::move(parts));
}

// A node of a member whose motion a degree of freedom is.
struct HeldNode {
  std::string member{};
  double fraction = 0.0;
  Index node = 0;
  Dof direction = Dof::x;
};

std::vector<HeldNode> nodes_moved_by(const Structure& structure, Index dof) {
  std::vector<HeldNode> found;
  for (const MemberMesh& mesh : structure.members())
    for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
      const auto add = [&](Dof direction) {
        found.push_back(
            {.member = mesh.name, .fraction = mesh.fraction(k), .node = mesh.nodes[k], .direction = direction});
      };
      for (const Dof direction : {Dof::x, Dof::z})
        if (structure.dof(mesh.nodes[k], direction) == dof) add(direction);
      if (mesh.rotations[k] == dof) add(Dof::rotation);
    }
  return found;
}

// What walls exert on a node: their force along x or z, or their moment about the node, wherever that has moved.
class WallsAtNode final : public Observable {
 public:
  WallsAtNode(const ContactQuery& contacts, ContactsOfWall of, const Vec2& at_rest, Dof direction,
              std::shared_ptr<const Observable> moved_x, std::shared_ptr<const Observable> moved_z)
      : x_(contacts, of, WallForce::What::x),
        z_(contacts, of, WallForce::What::z),
        moment_(contacts, std::move(of), WallForce::What::moment, at_rest),
        direction_(direction),
        moved_x_(std::move(moved_x)),
        moved_z_(std::move(moved_z)) {}

  double value(const State& state) const override {
    if (direction_ == Dof::x) return x_.value(state);
    if (direction_ == Dof::z) return z_.value(state);
    return moment_.value(state) - moved_x_->value(state) * z_.value(state) + moved_z_->value(state) * x_.value(state);
  }

  Row gradient(const State& state) const override {
    if (direction_ == Dof::x) return x_.gradient(state);
    if (direction_ == Dof::z) return z_.gradient(state);
    Row row = moment_.gradient(state);
    const auto add = [&](double factor, const Row& of) {
      row.dx += factor * of.dx;
      row.dlambda += factor * of.dlambda;
    };
    add(-moved_x_->value(state), z_.gradient(state));
    add(-z_.value(state), moved_x_->gradient(state));
    add(moved_z_->value(state), x_.gradient(state));
    add(x_.value(state), moved_z_->gradient(state));
    return row;
  }

 private:
  WallForce x_, z_, moment_;
  Dof direction_;
  std::shared_ptr<const Observable> moved_x_, moved_z_;  // displacements of the node
};

// A quantity less others.
class Less final : public Observable {
 public:
  Less(std::shared_ptr<const Observable> whole, std::vector<WallsAtNode> parts)
      : whole_(std::move(whole)), parts_(std::move(parts)) {}

  double value(const State& state) const override {
    double value = whole_->value(state);
    for (const WallsAtNode& part : parts_) value -= part.value(state);
    return value;
  }

  Row gradient(const State& state) const override {
    Row row = whole_->gradient(state);
    for (const WallsAtNode& part : parts_) {
      const Row of = part.gradient(state);
      row.dx -= of.dx;
      row.dlambda -= of.dlambda;
    }
    return row;
  }

 private:
  std::shared_ptr<const Observable> whole_;
  std::vector<WallsAtNode> parts_;
};

// A force of the structure less what friction of compliant walls exerts along its degree of freedom.
class LessFriction final : public Observable {
 public:
  LessFriction(std::shared_ptr<const Observable> whole, const CompliantFriction& friction, Index dof)
      : whole_(std::move(whole)), friction_(friction), dof_(dof) {}

  double value(const State& state) const override { return whole_->value(state) - friction_.force_on(state, dof_); }

  Row gradient(const State& state) const override {
    Row row = whole_->gradient(state);
    const Row of = friction_.force_on_gradient(state, dof_);
    row.dx -= of.dx;
    row.dlambda -= of.dlambda;
    return row;
  }

 private:
  std::shared_ptr<const Observable> whole_;
  const CompliantFriction& friction_;
  Index dof_;
};

}  // namespace

std::shared_ptr<const Observable> support_reaction(const Measured& from, Index dof) {
  const Structure& structure = from.structure;
  auto reaction = structural_reaction(from, dof);
  const auto* const compliant = dynamic_cast<const CompliantContact*>(from.contacts);
  if (compliant != nullptr && compliant->elastic_friction() != nullptr && !structure.unknown(dof))
    return std::make_shared<LessFriction>(std::move(reaction), *compliant->elastic_friction(), dof);
  if (structure.unknown(dof) || !from.walls_are_rigid) return reaction;
  std::vector<WallsAtNode> walls;
  for (const HeldNode& held : nodes_moved_by(structure, dof))
    walls.emplace_back(*from.contacts, ContactsOfWall{.member = held.member, .fraction = held.fraction},
                       structure.position(held.node), held.direction,
                       from.body.motion(structure.dof(held.node, Dof::x)),
                       from.body.motion(structure.dof(held.node, Dof::z)));
  return std::make_shared<Less>(std::move(reaction), std::move(walls));
}

}  // namespace arcwall
