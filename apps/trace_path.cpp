#include <unistd.h>

#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/interrupt.hpp"
#include "apps/cli/program.hpp"
#include "apps/cli/terminal_text.hpp"

int main(int argc, char** argv) {
  arcwall::let_writes_fail();
  const arcwall::PrintableStream messages(std::cerr);
  std::optional<arcwall::PrintableStream> output;
  if (::isatty(STDOUT_FILENO) == 1) output.emplace(std::cout);
  try {
    return static_cast<int>(arcwall::run_program(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc)));
  } catch (const std::exception& problem) {
    return static_cast<int>(arcwall::report(problem));
  }
}
