#pragma once

#include <string>

#include "apps/sweep/drawn_cases.hpp"

namespace arcwall::sweep {

/// report.html: one page that needs no network and, but for the choice of the load, no script. For each load that a
/// case has there are a map over one or two keys, lines of cases that differ in one key, and the same as parts of λ₀.
std::string report_html(const Collection& collection, const Overview& of_all, const DrawnCases& drawn);

}  // namespace arcwall::sweep
