#pragma once

#include <string>
#include <vector>

#include "apps/output/report_content.hpp"

/// Deformed shapes of a run as elements of HTML.
namespace arcwall {

/// The group `walls`, which other pictures use.
std::string wall_paths(const ShapePictures& shapes);

/// The picture that the script moves: walls, the first shape in grey, and a shape.
std::string stage(const ShapePictures& shapes);

/// What the arrows are, and which points have shapes.
std::string shape_notes(const Record& record, const ShapePictures& shapes);

/// One event a point, and of many some that are spread evenly over the path.
std::vector<const RecordEvent*> events_of_strip(const Record& record);

/// Figures of shapes: each event is followed by the states after its jumps.
std::string strip(const Record& record, const ShapePictures& shapes, const std::vector<const RecordEvent*>& events);

}  // namespace arcwall
