#pragma once

#include <string>

#include "continuation/step/step_attempt.hpp"
#include "model/model.hpp"

namespace arcwall {

/// A line of steps.jsonl: an attempted step of a branch, and why it was accepted or cut back.
std::string ledger_line(const Model& model, Index branch, const StepAttempt& attempt);

}  // namespace arcwall
