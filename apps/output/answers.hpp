#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/record.hpp"

namespace arcwall {

/// What a run answers, a sentence each: "Snaps at λ = 6.63, from mid = 0.19 cm to mid = -0.15 cm; releases 0.36 kN cm;
/// snaps back at λ = 4.57." One for each jump; of a movement one for each stage, of the greatest and the least `force`,
/// which is the number of a monitor; without jumps one on stability, where it is known.
std::vector<std::string> answers(const Record& record, std::optional<std::size_t> force);

}  // namespace arcwall
