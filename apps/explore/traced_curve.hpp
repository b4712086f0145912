#pragma once

#include <string>

#include "apps/explore/traced_page.hpp"

namespace arcwall::explore {

/// Follows an event of a deck over a number of it and gives lines: `{"progress": …}` and `{"curve": …}` with what was
/// traced so far now and then, and last the curve with `"ended": true`, or what is wrong. `request`: JSON with the
/// deck's `text`, the event's `kind` and `number`, the `parameter`, and the ends `low` and `high` of its range. `file`:
/// as of an EditedDeck. After that time [s] the curve is stopped.
void trace_to_curve(const std::string& file, const std::string& request, double most_seconds, const LineSink& give);

}  // namespace arcwall::explore
