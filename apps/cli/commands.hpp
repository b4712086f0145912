#pragma once

#include <string>
#include <vector>

#include "apps/cli/options.hpp"
#include "apps/output/exit_status.hpp"

namespace arcwall {

/// A command of the program. Data goes to standard output, everything else to standard error.
struct Command {
  CommandDescription description{};
  ExitStatus (*run)(const Options& options) = nullptr;
};

Command run_command();
Command resume_command();
Command report_command();
Command verify_command();
Command converge_command();
Command curve_command();
Command explore_command();
Command check_command();
Command examples_command();

/// The commands of one word, in the order of the help.
std::vector<Command> commands();

/// The commands that follow the word `sweep`; their names begin with it.
std::vector<Command> sweep_commands();

/// What `sweep` does, for the list of commands.
extern const char* const sweep_summary;

/// The option `--set`, which several commands take.
OptionDescription set_option();

}  // namespace arcwall
