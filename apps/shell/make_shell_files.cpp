#include <exception>
#include <filesystem>
#include <iostream>

#include "apps/output/files.hpp"
#include "apps/shell/shell_files.hpp"

// make_shell_files DIR: writes the completion and the man page when the program is built.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_shell_files DIR\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    arcwall::write_whole(folder / "trace-path.bash", arcwall::bash_completion());
    arcwall::write_whole(folder / "trace-path.1", arcwall::man_page());
  } catch (const std::exception& problem) {
    std::cerr << "error: " << problem.what() << "\n";
    return 1;
  }
}
