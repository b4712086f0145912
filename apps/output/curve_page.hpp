#pragma once

#include <string>

#include "model/event_curve.hpp"

namespace arcwall {

/// report.html of a curve: λ and the monitors over the number, and the shape at some points.
std::string curve_html(const EventCurve& curve);

/// Its first chart alone, λ over the number, as an element for other pages.
std::string curve_picture(const EventCurve& curve);

}  // namespace arcwall
