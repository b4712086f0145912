#pragma once

#include <optional>
#include <vector>

#include "continuation/events/interpolated_test_matrix.hpp"
#include "continuation/events/singular_place.hpp"

namespace arcwall {

/// The first places, in their order, where the number of negative eigenvalues changes along a segment: `before` and
/// `after` at its ends, not equal. Limit points are among them. Empty if the ends do not seem to belong to one arc;
/// shorter steps will show more.
std::vector<SingularPlace> find_count_changes(Corrector& corrector, const Segment& segment, const Metric& metric,
                                              Index before, Index after);

/// The places of a segment where something comes to zero and goes back, or two eigenvalues pass zero in opposite
/// senses: one place that touches, or two in order. None if it stays clear of zero. `from_singular`: the segment's
/// start is singular, which does not count. `noise`: values below this have no sign. Nothing if the search fails.
std::optional<std::vector<SingularPlace>> find_touches(Corrector& corrector, const Segment& segment,
                                                       const Metric& metric, Vanishing what, bool from_singular,
                                                       double noise);

}  // namespace arcwall
