#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// The contacts of a state along the members: points, and stretches that lie on a wall.
std::vector<RecordStretch> stretches_of(const Model& model, const State& state);

/// The walls of these, `upper lower upper`, with `upper=` for a stretch.
std::string contact_pattern_of(const std::vector<RecordStretch>& stretches);

}  // namespace arcwall
