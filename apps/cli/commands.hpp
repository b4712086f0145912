#pragma once

#include <string>
#include <vector>

#include "apps/cli/exit_status.hpp"
#include "apps/cli/options.hpp"

namespace arcwall {

/// A command of the program. Data goes to standard output, everything else to standard error.
struct Command {
  CommandDescription description{};
  ExitStatus (*run)(const Options& options) = nullptr;
};

Command run_command();
Command resume_command();
Command check_command();
Command examples_command();

/// The option `--set`, which several commands take.
OptionDescription set_option();

}  // namespace arcwall
