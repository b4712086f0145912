#include "apps/cli/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <new>

#include "apps/cli/commands.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "core/text.hpp"
#include "model/version.hpp"

namespace arcwall {

namespace {

// A title, then what each command does.
std::string listed(const std::vector<std::pair<std::string, std::string>>& commands) {
  std::string text = "\ncommands\n";
  for (const auto& [name, summary] : commands) text += fmt::format("  {:<8}  {}\n", name, summary);
  return text;
}

std::string last_word(const std::string& name) { return name.substr(name.rfind(' ') + 1); }

std::string top_help() {
  std::string text =
      "  trace-path run deck.toml --out results\n\n"
      "Traces equilibrium paths of beams, frames and trusses in contact with rigid obstacles.\n"
      "usage: trace-path COMMAND …, or trace-path DECK, which is trace-path run DECK\n";
  std::vector<std::pair<std::string, std::string>> rows;
  for (const Command& command : commands()) rows.emplace_back(command.description.name, command.description.summary);
  rows.emplace_back("sweep", sweep_summary);
  text += listed(rows) +
          "\n"
          "trace-path COMMAND --help shows the options; trace-path --version shows the version.\n"
          "trace-path examples lists decks to start from.\n";
  return text;
}

std::string sweep_help() {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const Command& command : sweep_commands())
    rows.emplace_back(last_word(command.description.name), command.description.summary);
  return fmt::format(
      "  trace-path sweep plan sweep.toml --out study\n  trace-path sweep run study --jobs 4\n"
      "  trace-path sweep collect study\n\n{}\nusage: trace-path sweep COMMAND …\n{}\n"
      "trace-path sweep COMMAND --help shows the options.\n",
      sweep_summary, listed(rows));
}

std::string version_text() { return "trace-path " + program_version() + "\n"; }

bool looks_like_a_deck(const std::string& word) {
  std::error_code ignored;
  return word.find_first_of("./") != std::string::npos || std::filesystem::exists(word, ignored);
}

// Before a command only --help and --version can stand.
[[noreturn]] void fail_on_option(const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  const auto& of_run = run_command().description.options;
  for (const OptionDescription& option : of_run) {
    if ("--" + option.name == name)
      throw InputError(fmt::format("{} stands before the command; write trace-path run DECK {} …", name, name));
  }
  throw InputError(
      fmt::format("unknown option {}{}; see trace-path --help", name, suggestion(name, {"--help", "--version"})));
}

[[noreturn]] void fail_on_word(const std::string& word) {
  std::vector<std::string> names;
  for (const Command& command : commands()) names.push_back(command.description.name);
  names.emplace_back("sweep");
  const std::string near = nearest(word, names);
  throw InputError(fmt::format("{} is no command and no deck{}; commands are {}", word.empty() ? "\"\"" : word,
                               near.empty() ? "" : " (did you mean " + near + "?)", fmt::join(names, ", ")));
}

ExitStatus run(const Command& command, const std::vector<std::string>& arguments) {
  const Options options(command.description, arguments);
  if (options.has("help")) {
    std::cout << help_text(command.description);
    return ExitStatus::success;
  }
  if (options.has("version")) {
    std::cout << version_text();
    return ExitStatus::success;
  }
  return command.run(options);
}

// `sweep` and what follows it.
ExitStatus run_sweep(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    std::cerr << sweep_help();
    return ExitStatus::wrong_input;
  }
  const std::string& word = arguments.front();
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  std::vector<std::string> names;
  for (const Command& command : sweep_commands()) {
    names.push_back(last_word(command.description.name));
    if (names.back() == word) return run(command, rest);
  }
  if (word == "--help" || word == "--version") {
    if (!rest.empty()) throw InputError("unexpected argument " + rest.front() + " after " + word);
    std::cout << (word == "--help" ? sweep_help() : version_text());
    return ExitStatus::success;
  }
  if (word.starts_with("-"))
    throw InputError(
        fmt::format("{} stands before the command; write trace-path sweep {} …", word, fmt::join(names, "|")));
  throw InputError(fmt::format("{} is no command of sweep{}; commands are {}", word.empty() ? "\"\"" : word,
                               suggestion(word, names), fmt::join(names, ", ")));
}

ExitStatus dispatch(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    std::cerr << top_help();
    return ExitStatus::wrong_input;
  }
  const std::string& word = arguments.front();
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  for (const Command& command : commands()) {
    if (command.description.name == word) return run(command, rest);
  }
  if (word == "sweep") return run_sweep(rest);
  if (word == "--help" || word == "--version") {
    if (!rest.empty()) throw InputError("unexpected argument " + rest.front() + " after " + word);
    std::cout << (word == "--help" ? top_help() : version_text());
    return ExitStatus::success;
  }
  if (word.starts_with("-")) fail_on_option(word);
  if (!looks_like_a_deck(word)) fail_on_word(word);
  return run(run_command(), arguments);
}

}  // namespace

std::vector<Command> commands() {
  return {run_command(),   resume_command(),  report_command(), verify_command(),  converge_command(),
          curve_command(), explore_command(), check_command(),  examples_command()};
}

ExitStatus run_program(const std::vector<std::string>& arguments) {
  const ExitStatus status = dispatch(arguments);
  if (!std::cout.flush()) throw OutputError("standard output cannot be written");
  return status;
}

ExitStatus report(const std::exception& problem) {
  if (const auto* input = dynamic_cast<const InputError*>(&problem)) {
    for (const Diagnostic& diagnostic : input->diagnostics())
      std::cerr << "error: " << printable(to_text(diagnostic)) << "\n";
    return ExitStatus::wrong_input;
  }
  if (dynamic_cast<const OutputError*>(&problem) != nullptr) {
    std::cerr << "error: " << printable(problem.what()) << "\n";
    return ExitStatus::file_error;
  }
  if (dynamic_cast<const std::bad_alloc*>(&problem) != nullptr) {
    std::cerr << "error: memory ran out; use fewer elements or a machine with more memory. A run that has written a "
                 "checkpoint goes on from there with trace-path resume DIR\n";
    return ExitStatus::out_of_memory;
  }
  std::cerr << "error: internal error: " << problem.what()
            << "\nThis is a defect of the program; please report it with the deck that led to it.\n";
  return ExitStatus::internal_error;
}

}  // namespace arcwall
