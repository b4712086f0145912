#pragma once

#include <string>

#include "model/model.hpp"

namespace arcwall {

/// What a deck describes, for people: sizes, members, supports, loads, walls with their first gaps, and the path.
std::string summary(const Model& model);

}  // namespace arcwall
