#pragma once

#include <string>

#include "apps/output/csv.hpp"
#include "model/record.hpp"

namespace arcwall {

/// path.csv: a header, then one row a point. Numbers read back as the same double; what is unknown is empty.
std::string path_csv(const Record& record, UnitLabels labels);

}  // namespace arcwall
