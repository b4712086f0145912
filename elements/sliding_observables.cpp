// What is read off places and joints of a sliding structure.
#include <cmath>

#include "elements/sliding_structure.hpp"

namespace arcwall {

PlaceObservable::PlaceObservable(const SlidingStructure& structure, const MaterialPoint& point,
                                 MemberObservable::Component component)
    : point_(point), component_(component) {
  using Component = MemberObservable::Component;
  if (component == Component::face_above_z) offset_ = structure.half_height_at(point);
  if (component == Component::face_below_z) offset_ = -structure.half_height_at(point);
  const AxisPlace perfect = structure.undeformed(point, false);
  switch (component) {
    case Component::x:
      origin_ = perfect.position.x();
      break;
    case Component::z:
    case Component::face_above_z:
    case Component::face_below_z:
      origin_ = perfect.position.y() + offset_ * axis_normal(perfect.angle).y();
      break;
    case Component::rotation:
      origin_ = perfect.angle;
      break;
  }
}

double PlaceObservable::value(const State& state) const {
  const SlidingMesh& mesh = mesh_of(state);
  const AxisPlace at = mesh.place(point_, mesh_state_of(state));
  switch (component_) {
    case MemberObservable::Component::x:
      return at.position.x() - origin_;
    case MemberObservable::Component::z:
    case MemberObservable::Component::face_above_z:
    case MemberObservable::Component::face_below_z:
      return at.position.y() + offset_ * axis_normal(at.angle).y() - origin_;
    case MemberObservable::Component::rotation:
      return at.angle - origin_;
  }
  return 0.0;
}

Row PlaceObservable::gradient(const State& state) const {
  const SlidingMesh& mesh = mesh_of(state);
  const MeshState now = mesh_state_of(state);
  const auto gradient = mesh.place_gradient(point_, now);
  Eigen::RowVector3d row = Eigen::RowVector3d::Zero();
  switch (component_) {
    case MemberObservable::Component::x:
      row[0] = 1.0;
      break;
    case MemberObservable::Component::z:
    case MemberObservable::Component::face_above_z:
    case MemberObservable::Component::face_below_z:
      row[1] = 1.0;
      row[2] = -offset_ * std::sin(mesh.place(point_, now).angle);
      break;
    case MemberObservable::Component::rotation:
      row[2] = 1.0;
      break;
  }
  Row result{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  result.dx.head(now.x.size()) = (row * gradient.dx).transpose();
  result.dlambda = row * gradient.dlambda;
  result.dx.tail(now.s.size()) = (row * gradient.ds).transpose();
  return result;
}

double JointObservable::value(const State& state) const {
  const SlidingMesh& mesh = mesh_of(state);
  if (what_ == What::motion) return structure_.value(mesh, mesh_state_of(state), dof_);
  return structure_.reaction(mesh, mesh_state_of(state), dof_).value;
}

Row JointObservable::gradient(const State& state) const {
  const SlidingMesh& mesh = mesh_of(state);
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  if (what_ == What::motion) {
    if (const auto i = structure_.unknown(mesh, dof_)) row.dx[*i] = 1.0;
    row.dlambda = structure_.held_rate(dof_);
    return row;
  }
  const auto reaction = structure_.reaction(mesh, mesh_state_of(state), dof_);
  row.dx.head(mesh.unknowns()) = reaction.dx;
  row.dx.tail(mesh.breakpoints()) = reaction.ds;
  row.dlambda = reaction.dlambda;
  return row;
}

}  // namespace arcwall
