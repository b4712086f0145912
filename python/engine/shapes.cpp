#include "python/engine/shapes.hpp"

namespace arcwall::python {

namespace {

py::array_t<double> member_array(const MemberShape& member) {
  constexpr py::ssize_t columns = 9;
  py::array_t<double> array({static_cast<py::ssize_t>(member.points.size()), columns});
  double* to = array.mutable_data();
  for (const ShapePoint& at : member.points)
    for (const double value : {at.fraction, at.position.x(), at.position.y(), at.displacement.x(), at.displacement.y(),
                               at.angle, at.rotation, at.axial_force, at.moment})
      *to++ = value;
  return array;
}

py::array_t<double> line_array(const std::vector<Vec2>& line) {
  py::array_t<double> array({static_cast<py::ssize_t>(line.size()), py::ssize_t{2}});
  double* to = array.mutable_data();
  for (const Vec2& at : line) {
    *to++ = at.x();
    *to++ = at.y();
  }
  return array;
}

}  // namespace

py::tuple label(const ContactLabel& label) { return py::make_tuple(label.wall, label.member, label.fraction); }

std::pair<py::dict, py::list> shape_parts(const Shape& shape) {
  py::dict members;
  py::list contacts;
  for (const MemberShape& member : shape.members) members[py::str(member.member)] = member_array(member);
  for (const ContactMark& mark : shape.contacts)
    contacts.append(py::make_tuple(label(mark.label), mark.position.x(), mark.position.y(), mark.force.x(),
                                   mark.force.y(), mark.pressure));
  return {members, contacts};
}

py::dict walls_at(const Model& model, double lambda) {
  py::dict walls;
  for (const WallShape& wall : wall_shapes(model, lambda))
    walls[py::str(wall.name)] = py::make_tuple(line_array(wall.line), wall.side == Side::above ? "above" : "below");
  return walls;
}

}  // namespace arcwall::python
