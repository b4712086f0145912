#pragma once

#include <utility>

#include "model/shape.hpp"
#include "python/engine/python.hpp"

namespace arcwall::python {

/// Wall, member and fraction.
py::tuple label(const ContactLabel& label);

/// Members by their names, each an array with a row a point (fraction, x, z, ux, uz, angle, rotation, axial force,
/// moment); contacts, each its label, x, z, the force along x and z, and the pressure or None.
std::pair<py::dict, py::list> shape_parts(const Shape& shape);

/// The walls at λ by their names: an array of shape (points, 2) with x and z, and the side.
py::dict walls_at(const Model& model, double lambda);

}  // namespace arcwall::python
