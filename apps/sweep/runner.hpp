#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/sweep/case_list.hpp"
#include "apps/sweep/case_records.hpp"
#include "apps/sweep/child.hpp"
#include "model/run_description.hpp"

namespace arcwall::sweep {

/// Where results are kept: in a folder for each case, or as records.
enum class Keep { folders, records };

/// How the cases of a planned sweep are run.
struct RunRequest {
  std::filesystem::path folder{};        ///< of the sweep
  std::filesystem::path program{};       ///< trace-path
  ChildBody body{};                      ///< in place of the program, where it is given
  int jobs = 1;                          ///< processes at a time
  Traced traced = Traced::path;          ///< of each case, by `trace-path run` or `trace-path curve`
  bool jumps = false;                    ///< jumps are looked for where the deck does not say
  std::vector<std::string> options{};    ///< of that command, besides those of the case
  std::optional<double> most_seconds{};  ///< of one case
  double patience = 10.0;                ///< a case that does not stop is killed that long after it should have [s]
  Keep keep = Keep::folders;
  Part part{};  ///< the share of the cases that is run
};

/// Which cases are run though they have results.
enum class Rerun { none, failed, all };

/// How far a sweep has got.
struct RunCounts {
  int ran = 0;       ///< cases whose results were added, whatever they are
  int failed = 0;    ///< of these: a status other than 0
  int complete = 0;  ///< that had results already
  int busy = 0;      ///< that another process is running
  bool interrupted = false;
};

/// Runs the cases of the request's part, or one of them, that have no results yet, each in a process of its own, so
/// that a crash costs one case. SIGINT and SIGTERM end it: what is being run stops with a checkpoint, and goes on from
/// there in the next call with the same options. Cases that a full disk, too little memory or a kill has hindered are
/// run again. `progress` is called when something has changed. Throws OutputError, InputError.
RunCounts run_cases(const RunRequest& request, std::optional<int> one, Rerun rerun,
                    const std::function<void(const RunCounts&)>& progress);

/// What is known of a case's run besides its outputs; in the case's folder.
inline constexpr const char* case_file_name = "case.json";
inline constexpr const char* messages_file_name = "messages.txt";

}  // namespace arcwall::sweep
