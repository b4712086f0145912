#pragma once

#include <string_view>
#include <vector>

#include "continuation/path_point.hpp"
#include "core/types.hpp"

namespace arcwall {

/// How an event looks in a chart.
struct EventMark {
  std::string_view symbol{};    ///< plotly's name of the outline
  std::vector<Vec2> outline{};  ///< a polygon about the origin, of radius about 1, y upwards
  double size = 1.0;            ///< to multiply it with
  bool filled = false;
};

EventMark mark_of(EventKind kind);

/// What happens there, in a few words.
std::string_view meaning(EventKind kind);

}  // namespace arcwall
