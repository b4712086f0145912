#pragma once

#include <string>

#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// Where contact is at nodes: which member is inside a wall, as a roller that is narrower than an element, between two
/// nodes that do not touch it, while its surface turns by more than 0.3 rad from the one to the other. The wall is not
/// felt there. Empty where none is; some of the points of each branch are looked at.
std::string warning_of_walls_between_nodes(const Model& model, const Record& record);

}  // namespace arcwall
