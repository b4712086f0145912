#pragma once

#include <string>

#include "apps/output/files.hpp"
#include "apps/output/shape_pictures.hpp"
#include "model/record.hpp"

namespace arcwall {

/// One state, whose shape this is, as VTK's XML format for unstructured grids has it: a poly line a member. The deck's
/// z is the second axis.
std::string shape_vtu(const Model& model, const RecordPoint& point, const Shape& shape);

/// The walls, a poly line each.
std::string walls_vtu(const std::vector<WallShape>& walls);

/// Writes shapes/NNNN.vtu, one a point of the record, shapes/walls.vtu of a deck with walls, and shapes.pvd, which
/// lists them, into the folder; then removes the files that a longer run has left in shapes/. `drawn`: shapes that are
/// known already. Throws OutputError.
void write_shapes(const OutputFolder& folder, const Model& model, const Record& record, const DrawnScenes& drawn = {});

/// Removes those of an earlier run from shapes/, and shapes/ itself unless something else is in it.
void remove_shapes(const OutputFolder& folder);

}  // namespace arcwall
