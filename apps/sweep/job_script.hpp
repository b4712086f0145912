#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace arcwall::sweep {

/// What runs the cases where one process that starts others is not enough.
enum class Engine { parallel, slurm };

struct JobScript {
  std::filesystem::path program{};  ///< absolute
  std::filesystem::path folder{};   ///< of the sweep, absolute
  int cases = 1;
  std::optional<int> jobs{};   ///< at a time; empty: what the engine takes by itself
  std::optional<int> tasks{};  ///< among which the cases are shared; empty: as many as cases, at most 1000
  std::string time{}, memory{}, partition{}, log{};  ///< of a task, as Slurm takes them; empty: what it takes by itself
  bool records = false;                              ///< results are kept as records
  std::vector<std::string> options{};                ///< of `trace-path run`
};

/// Text as one word of a POSIX shell, whatever its characters.
std::string shell_word(const std::string& text);

/// A shell script that runs every case that has no results yet; it may be run again, and while another one runs.
std::string script(Engine engine, const JobScript& job);

}  // namespace arcwall::sweep
