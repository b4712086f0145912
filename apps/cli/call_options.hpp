#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "apps/cli/interrupt.hpp"
#include "apps/cli/options.hpp"
#include "apps/cli/progress.hpp"
#include "continuation/path_point.hpp"

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

/// Why a call goes no further though what it traces does; empty while it goes on. `points`: that it has traced.
std::optional<BranchEnd> limit_met(const CallOptions& options, int points, const Stopwatch& watch,
                                   const InterruptGuard& interrupts);

}  // namespace arcwall
