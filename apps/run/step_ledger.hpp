#pragma once

#include <string>

#include "apps/study.hpp"
#include "continuation/step/step_attempt.hpp"

namespace arcwall {

/// A line of steps.jsonl: an attempted step of a branch, and why it was accepted or cut back.
std::string ledger_line(const Study& study, Index branch, const StepAttempt& attempt);

}  // namespace arcwall
