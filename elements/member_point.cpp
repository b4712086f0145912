#include "elements/member_point.hpp"

#include <cassert>
#include <cmath>

namespace arcwall {

namespace {

Vec2 normal(double angle) { return {-std::sin(angle), std::cos(angle)}; }

double offset_of(const MemberMesh& mesh, MemberObservable::Component component) {
  switch (component) {
    case MemberObservable::Component::face_above_z:
      return 0.5 * mesh.height.value();
    case MemberObservable::Component::face_below_z:
      return -0.5 * mesh.height.value();
    case MemberObservable::Component::x:
    case MemberObservable::Component::z:
    case MemberObservable::Component::rotation:
      return 0.0;
  }
  return 0.0;
}

}  // namespace

MemberPoint::MemberPoint(const Structure& structure, const MemberMesh& mesh, std::size_t node, double offset)
    : structure_(structure), node_(mesh.nodes[node]), angle_(mesh.shape[node].angle), offset_(offset) {
  const auto column = [&](Index freedom) -> std::optional<Index> {
    const auto unknown = structure.unknown(freedom);
    if (!unknown) return std::nullopt;
    unknowns_.push_back(*unknown);
    return static_cast<Index>(unknowns_.size()) - 1;
  };
  x_ = column(structure.freedom(node_, Freedom::x));
  z_ = column(structure.freedom(node_, Freedom::z));
  if (offset_ == 0.0) return;
  assert(mesh.rotations[node]);
  rotation_ = mesh.rotations[node];
  turn_ = column(*rotation_);
}

Vec2 MemberPoint::position(const Vector& x) const {
  const Vec2 axis = structure_.current(x, node_);
  return rotation_ ? Vec2(axis + offset_ * normal(angle_ + structure_.value(x, *rotation_))) : axis;
}

// r + o n(φ):  ∂n/∂φ = −t,  ∂²n/∂φ² = −n
void MemberPoint::kinematics(const Vector& x, PointKinematics& out) const {
  const auto n = static_cast<Index>(unknowns_.size());
  out.jacobian.setZero(2, n);
  for (auto& second : out.curvature) second.setZero(n, n);
  out.position = position(x);
  if (x_) out.jacobian(0, *x_) = 1.0;
  if (z_) out.jacobian(1, *z_) = 1.0;
  if (!turn_) return;
  const Vec2 arm = offset_ * normal(angle_ + structure_.value(x, *rotation_));
  out.jacobian.col(*turn_) = perp(arm);
  out.curvature[0](*turn_, *turn_) = -arm.x();
  out.curvature[1](*turn_, *turn_) = -arm.y();
}

MemberObservable::MemberObservable(const Structure& structure, const MemberMesh& mesh, std::size_t node,
                                   Component component)
    : structure_(structure),
      component_(component),
      point_(structure, mesh, node, offset_of(mesh, component)),
      rotation_(mesh.rotations[node]) {
  const AxisPoint& axis = mesh.axis[node];
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
      origin_ = axis.position.y() + offset_of(mesh, component) * normal(axis.angle).y();
      break;
  }
}

double MemberObservable::value(const State& state) const {
  if (component_ == Component::rotation) return structure_.value(state.x, rotation_.value()) - origin_;
  return point_.position(state.x)[component_ == Component::x ? 0 : 1] - origin_;
}

Row MemberObservable::gradient(const State& state) const {
  if (component_ == Component::rotation) return FreedomObservable(structure_, rotation_.value()).gradient(state);
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  PointKinematics kinematics;
  point_.kinematics(state.x, kinematics);
  const int coordinate = component_ == Component::x ? 0 : 1;
  for (std::size_t i = 0; i < point_.unknowns().size(); ++i)
    row.dx[point_.unknowns()[i]] = kinematics.jacobian(coordinate, static_cast<Index>(i));
  return row;
}

Row FreedomObservable::gradient(const State& state) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  if (const auto unknown = structure_.unknown(freedom_)) row.dx[*unknown] = 1.0;
  return row;
}

}  // namespace arcwall
