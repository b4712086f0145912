#pragma once

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// What lies behind a state where the span behind a tracked point has become short: a line gathers to a point, or the
/// gap between two parts on an obstacle closes and they join. Spans of the same kind within `tolerance` of that go with
/// it.
Transition span_vanishes(const SlidingSetting& setting, const SlidingState& at, std::size_t point, double tolerance);

}  // namespace arcwall::sliding
