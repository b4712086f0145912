#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// What a reader of a run has to know of where its paths start: under what is constant the structure may have lost its
/// stability already. Empty where it has not, or where that is not known.
std::string warning_of_start(const Model& model, const Record& record);

/// The warnings of the deck and of the start.
std::vector<std::string> run_warnings(const Model& model, const Record& record);

}  // namespace arcwall
