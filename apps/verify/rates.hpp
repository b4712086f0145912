#pragma once

#include <vector>

#include "apps/verify/findings.hpp"
#include "continuation/trace_options.hpp"
#include "model/record.hpp"

namespace arcwall::verify {

/// Whether the rates of watched monitors, by whose sign their turning points are found, are those of their values:
/// derivatives along the way to the next point of the active set against differences.
void check_rates(const std::vector<Watch>& watched, const std::vector<RecordPoint>& points, std::size_t number,
                 Findings& findings);

}  // namespace arcwall::verify
