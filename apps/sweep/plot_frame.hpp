#pragma once

#include <array>
#include <string>

#include "apps/sweep/map_axis.hpp"

namespace arcwall::sweep {

/// 0 … 255: red, green, blue.
using Colour = std::array<double, 3>;

/// From dark blue by green to yellow, at a fraction 0 … 1.
Colour colour_at(double fraction);
std::string text_of(const Colour& colour);
bool is_light(const Colour& colour);

/// Where the plotted area of a picture is [pixels].
struct PlotArea {
  double left = 90.0, top = 16.0, width = 520.0, height = 380.0;

  double x_at(double fraction) const { return left + fraction * width; }
  double y_at(double fraction) const { return top + (1.0 - fraction) * height; }
};

/// How much of the frame is written.
struct FrameTexts {
  std::string x_title{}, y_title{};
  bool x_labels = true, y_labels = true;  ///< at the ticks
};

/// The frame of a plotted area with ticks, their labels and the titles of the axes.
std::string frame(const PlotArea& area, const MapAxis& x, const MapAxis& y, const FrameTexts& texts);

/// Text at a place; escaped.
std::string text(double x, double y, const std::string& anchor, const std::string& content);

/// Text that reads upwards, its middle at a place.
std::string upright(double x, double y, const std::string& content);

/// The whole picture, with a name for those who cannot see it.
std::string picture(double width, double height, const std::string& name, const std::string& body);

/// The mark of a case that failed.
std::string cross(double x, double y);

}  // namespace arcwall::sweep
