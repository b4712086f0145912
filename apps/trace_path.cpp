#include <exception>
#include <string>
#include <vector>

#include "apps/cli/interrupt.hpp"
#include "apps/cli/program.hpp"

int main(int argc, char** argv) {
  arcwall::let_writes_fail();
  try {
    return static_cast<int>(arcwall::run_program(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc)));
  } catch (const std::exception& problem) {
    return static_cast<int>(arcwall::report(problem));
  }
}
