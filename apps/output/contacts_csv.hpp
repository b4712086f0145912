#pragma once

#include <string>

#include "apps/output/csv.hpp"
#include "model/record.hpp"

namespace arcwall {

/// contacts.csv: a header, then one row for each closed contact of each point, in the order of path.csv.
std::string contacts_csv(const Record& record, UnitLabels labels);

}  // namespace arcwall
