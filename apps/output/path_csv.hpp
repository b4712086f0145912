#pragma once

#include <string>

#include "apps/output/record.hpp"

namespace arcwall {

/// Whether the header names units, as in `mid [cm]`.
enum class UnitLabels { shown, left_out };

/// path.csv: a header, then one row a point. Numbers read back as the same double; what is unknown is empty.
std::string path_csv(const Record& record, UnitLabels labels);

}  // namespace arcwall
