#pragma once

#include <optional>

#include "core/types.hpp"
#include "model/record.hpp"

namespace arcwall {

/// The derivatives of two quantities at the ends of a step, times the arc length of the step: with the values at the
/// ends they are the cubic of Hermite.
struct CubicStep {
  Vec2 begin = Vec2::Zero(), end = Vec2::Zero();
};

/// The step from point i − 1 to point i of a record, which are of one branch, as λ (z) over a monitor, or over the arc
/// length (x). Empty where a tangent is not known.
std::optional<CubicStep> cubic_step(const Record& record, std::size_t i, std::optional<std::size_t> monitor);

/// The derivatives just after a point.
const std::optional<RecordRates>& leaving_rates(const RecordPoint& point);

}  // namespace arcwall
