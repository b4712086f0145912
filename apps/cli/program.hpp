#pragma once

#include <exception>
#include <string>
#include <vector>

#include "apps/output/exit_status.hpp"

namespace arcwall {

/// The whole program. `arguments` are those after its own name. Throws InputError and OutputError.
ExitStatus run_program(const std::vector<std::string>& arguments);

/// Says on standard error what went wrong, one line a diagnostic, and returns the status that goes with it.
ExitStatus report(const std::exception& problem);

}  // namespace arcwall
