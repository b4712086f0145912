#pragma once

#include <string>
#include <vector>

#include "answers/event_curve.hpp"
#include "apps/output/load_text.hpp"

namespace arcwall {

/// report.html of a curve: λ and the monitors over the number, and the shape at some points. `loads`: what λ
/// multiplies.
std::string curve_html(const EventCurve& curve, const std::vector<LoadText>& loads);

/// Its first chart alone, λ over the number, as an element for other pages.
std::string curve_picture(const EventCurve& curve, const std::vector<LoadText>& loads);

}  // namespace arcwall
