#pragma once

#include <vector>

#include "model/record.hpp"

/// What round-off leaves of zero is shown as zero to people; tables for programs have it as it is.
namespace arcwall {

/// Of each monitor, below which size a value is round-off: far below the greatest of all monitors with its unit.
std::vector<double> roundoff(const Record& record);

/// 0 in place of round-off.
double without_roundoff(double value, double roundoff);

}  // namespace arcwall
