#include "apps/output/shape_svg.hpp"

#include <fmt/format.h>

namespace arcwall {

std::string view_box(const ShapePictures& shapes) { return fmt::format("0 0 {} {}", shapes.width, shapes.height); }

// A path may be drawn twice: a member as its body and its axis.
std::string shape_paths(const ShapePictures& shapes, const ShapePicture& picture) {
  std::string text;
  for (std::size_t i = 0; i < picture.paths.size(); ++i) {
    const std::string data = fmt::format("data-path=\"{}\" d=\"{}\"", i, picture.paths[i]);
    if (shapes.thickness[i] > 0.0)
      text += fmt::format("<path class=\"band\" stroke-width=\"{}\" {}/>", shapes.thickness[i], data);
    text += fmt::format("<path class=\"{}\" {}/>", shapes.classes[i], data);
  }
  return text;
}

// At the picture itself, or its angles would be believed.
std::string stretch_note(const ShapePictures& shapes) {
  if (shapes.stretch <= 1.0) return "";
  return fmt::format("<p class=\"note\">Vertical scale exaggerated {} times.</p>", shapes.stretch);
}

}  // namespace arcwall
