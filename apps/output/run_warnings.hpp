#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// What a reader of a run has to know of where its paths start: under what is constant the structure may have lost its
/// stability already. Empty where it has not, or where that is not known.
std::string warning_of_start(const Model& model, const Record& record);

/// What a reader of a run that has ended has to know where the structure has moved by less than a millionth of its
/// size, or by more than a million times its size, all along its paths: the units of lengths, forces and stiffnesses
/// hardly fit together. Empty else, and of runs that a limit or a signal cut off.
std::string warning_of_units(const Model& model, const Record& record);

/// Which branches that a search has found ended early; empty where none did. The status of a run does not tell it.
std::string warning_of_found(const Record& record);

/// On which branches an element of a member that a wall holds turns by more than 0.3 rad: there the mesh does not tell
/// what the contact's sliding does to the number of unstable directions. Empty where none does; some of the points of
/// each branch are looked at.
std::string warning_of_bent(const Model& model, const Record& record);

/// What traced paths tell: the warnings of the units, of what was found, of coarse elements and of walls between nodes.
std::vector<std::string> warnings_of_paths(const Model& model, const Record& record);

/// The warnings of the deck, of the start and of the paths.
std::vector<std::string> run_warnings(const Model& model, const Record& record);

}  // namespace arcwall
