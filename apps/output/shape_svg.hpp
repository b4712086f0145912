#pragma once

#include <string>

#include "apps/output/shape_pictures.hpp"

namespace arcwall {

/// The viewBox of all pictures.
std::string view_box(const ShapePictures& shapes);

/// The <path> elements of a picture, without the walls that stand still.
std::string shape_paths(const ShapePictures& shapes, const ShapePicture& picture);

/// A sentence where heights are drawn larger than lengths, as a <p> element; else empty.
std::string stretch_note(const ShapePictures& shapes);

}  // namespace arcwall
