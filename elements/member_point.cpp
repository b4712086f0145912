#include "elements/member_point.hpp"

#include <cassert>

namespace arcwall {

namespace {

double offset_of(const MemberMesh& mesh, std::size_t node, MemberObservable::Component component) {
  switch (component) {
    case MemberObservable::Component::face_above_z:
      return 0.5 * mesh.height_at(mesh.fraction(node)).value();
    case MemberObservable::Component::face_below_z:
      return -0.5 * mesh.height_at(mesh.fraction(node)).value();
    case MemberObservable::Component::x:
    case MemberObservable::Component::z:
    case MemberObservable::Component::rotation:
      return 0.0;
  }
  return 0.0;
}

}  // namespace

MemberPoint::MemberPoint(const Structure& structure, const MemberSection& section, double offset)
    : structure_(structure), node_(section.node), section_(section.kinematics()), offset_(offset) {
  const auto coordinate = [&](Index dof) -> Coordinate {
    const auto unknown = structure.unknown(dof);
    if (!unknown) return {.column = std::nullopt, .rate = structure.held_rate(dof)};
    unknowns_.push_back(*unknown);
    return {.column = static_cast<Index>(unknowns_.size()) - 1};
  };
  x_ = coordinate(structure.dof(node_, Dof::x));
  z_ = coordinate(structure.dof(node_, Dof::z));
  if (offset_ == 0.0) return;
  assert(section.rotation);
  rotation_ = section.rotation;
  turn_ = coordinate(*rotation_);
  thickness_ = section.thickness;
  if (!thickness_) return;
  e_ = coordinate(thickness_->e);
  xi_ = coordinate(thickness_->xi);
}

EssenburgNode::Vectors MemberPoint::vectors(const State& state) const {
  const auto value = [&](Index dof) { return structure_.value(state, dof); };
  return section_.vectors(value(*rotation_), thickness_ ? value(thickness_->e) : 0.0,
                          thickness_ ? value(thickness_->xi) : 0.0);
}

// o d + o² q
Vec2 MemberPoint::arm(const EssenburgNode::Vectors& v) const {
  return offset_ * (section_.D + v.d_change) + offset_ * offset_ * v.q;
}

Vec2 MemberPoint::position(const State& state) const {
  const Vec2 axis = structure_.current(state, node_);
  return rotation_ ? Vec2(axis + arm(vectors(state))) : axis;
}

PointMotion MemberPoint::motion(const State& state, const Direction& direction) const {
  const auto rate = [&](const Coordinate& of) {
    return of.column ? direction.dx[unknowns_[static_cast<std::size_t>(*of.column)]] : direction.dlambda * of.rate;
  };
  PointMotion at{.position = structure_.current(state, node_), .velocity = Vec2(rate(x_), rate(z_))};
  if (!rotation_) return at;
  const EssenburgNode::Vectors v = vectors(state);
  const double o = offset_, o2 = offset_ * offset_;
  at.position += arm(v);
  at.velocity += rate(turn_) * (o * v.d_phi + o2 * v.q_phi) + rate(e_) * o * v.d_e + rate(xi_) * o2 * v.q_xi;
  return at;
}

void MemberPoint::kinematics(const State& state, PointKinematics& out) const {
  const auto n = static_cast<Index>(unknowns_.size());
  out.jacobian.setZero(2, n);
  out.jacobian_rate.setZero(2, n);
  out.rate.setZero();
  for (auto& second : out.curvature) second.setZero(n, n);
  out.position = structure_.current(state, node_);
  const auto first = [&](const Coordinate& i, const Vec2& value) {
    if (i.column) {
      out.jacobian.col(*i.column) = value;
    } else {
      out.rate += i.rate * value;
    }
  };
  first(x_, Vec2::UnitX());
  first(z_, Vec2::UnitY());
  if (!rotation_) return;
  const EssenburgNode::Vectors v = vectors(state);
  const double o = offset_, o2 = offset_ * offset_;
  out.position += arm(v);
  const auto second = [&](const Coordinate& i, const Coordinate& j, const Vec2& value) {
    if (i.column && j.column) {
      for (const int k : {0, 1}) {
        auto& of_coordinate = out.curvature[static_cast<std::size_t>(k)];
        of_coordinate(*i.column, *j.column) = of_coordinate(*j.column, *i.column) = value[k];
      }
    } else if (i.column) {
      out.jacobian_rate.col(*i.column) += j.rate * value;
    } else if (j.column) {
      out.jacobian_rate.col(*j.column) += i.rate * value;
    }
  };
  first(turn_, o * v.d_phi + o2 * v.q_phi);
  second(turn_, turn_, o * v.d_phi_phi + o2 * v.q_phi_phi);
  if (!thickness_) return;
  first(e_, o * v.d_e);
  first(xi_, o2 * v.q_xi);
  second(turn_, e_, o * v.d_phi_e);
  second(turn_, xi_, o2 * v.q_phi_xi);
}

MemberObservable::MemberObservable(const Structure& structure, const MemberMesh& mesh, std::size_t node,
                                   Component component)
    : structure_(structure),
      component_(component),
      point_(structure, mesh, node, offset_of(mesh, node, component)),
      rotation_(mesh.rotations[node]) {
  const AxisPoint axis = mesh.axis[node];
  switch (component) {
    case Component::x:
      origin_ = axis.position.x();
      break;
    case Component::z:
      origin_ = axis.position.y();
      break;
    case Component::rotation:
      origin_ = axis.angle - mesh.shape[node].angle;
      break;
    case Component::face_above_z:
    case Component::face_below_z:
      origin_ = axis.position.y() + offset_of(mesh, node, component) * axis_normal(axis.angle).y();
      break;
  }
}

double MemberObservable::value(const State& state) const {
  if (component_ == Component::rotation) return structure_.value(state, rotation_.value()) - origin_;
  return point_.position(state)[component_ == Component::x ? 0 : 1] - origin_;
}

Row MemberObservable::gradient(const State& state) const {
  if (component_ == Component::rotation) return DofObservable(structure_, rotation_.value()).gradient(state);
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  PointKinematics kinematics;
  point_.kinematics(state, kinematics);
  const int coordinate = component_ == Component::x ? 0 : 1;
  for (std::size_t i = 0; i < point_.unknowns().size(); ++i)
    row.dx[point_.unknowns()[i]] = kinematics.jacobian(coordinate, static_cast<Index>(i));
  row.dlambda = kinematics.rate[coordinate];
  return row;
}

Row DofObservable::gradient(const State& state) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  if (const auto unknown = structure_.unknown(dof_)) row.dx[*unknown] = 1.0;
  row.dlambda = structure_.held_rate(dof_);
  return row;
}

}  // namespace arcwall
