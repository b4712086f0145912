#pragma once

#include <string>
#include <vector>

#include "model/record.hpp"

namespace arcwall {

/// What a run answers, a sentence each: "Snaps at λ = 6.63, from mid = 0.19 cm to mid = -0.15 cm; releases 0.36 kN cm;
/// snaps back at λ = 4.57." One for each jump, or one that every point is stable. Empty where neither is known.
std::vector<std::string> answers(const Record& record);

}  // namespace arcwall
