#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

#include "apps/cli/options.hpp"
#include "apps/cli/progress.hpp"
#include "apps/output/exit_status.hpp"
#include "apps/output/files.hpp"
#include "apps/output/result_json.hpp"
#include "model/session.hpp"

namespace arcwall {

/// How far one call of the program goes with a run, and what it shows of it.
struct CallOptions {
  std::optional<int> max_points{};                    ///< of this call
  std::optional<double> max_seconds{};                ///< of this call
  std::chrono::duration<double> checkpoint_pause{5};  ///< at least, between two checkpoints
  bool scratch = false;  ///< no checkpoint is kept of a run that has ended, and its files are not flushed to the disk
  enum class Report { table, json_lines, none } report = Report::table;
  Progress progress = Progress::hidden;
  enum class Pictures { written, left_out } pictures = Pictures::written;  ///< report.html and the shapes
};

/// The options of the command line that these are.
std::vector<OptionDescription> call_options();
CallOptions call_options(const Options& options);

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Traces until the end, a limit or a signal, keeps checkpoints on the way and writes all files.
ExitStatus trace_and_write(Session& run, const OutputFolder& folder, const CallOptions& options,
                           const Stopwatch& since_begin);

/// Writes all files of what was traced so far, which may be a run under way: then as one that `stopped` there, though
/// the session itself goes on. The run has a point. Throws OutputError.
void write_run(Session& run, const OutputFolder& folder, const CallOptions& options, const BranchEnd& stopped,
               const RunSeconds& seconds);

}  // namespace arcwall
