#include "apps/cli/call_options.hpp"

#include <iostream>
#include <string>

#include "core/text.hpp"

namespace arcwall {

std::vector<OptionDescription> call_options() {
  return {{"max-points", "N", "stop after N points (exit status 6); resume continues"},
          {"max-time", "SECONDS", "stop after this time (exit status 6); resume continues"},
          {"checkpoint-pause", "SECONDS", "time between two checkpoints, 0 for one at each point (default: 5)"},
          {"scratch", "", "for results that a program reads at once: no final checkpoint, nothing flushed to the disk"},
          {"json", "", "print points, events and end as one JSON object per line"},
          {"no-pictures", "", "write neither report.html nor shapes (trace-path report writes the page later)"},
          {"quiet", "", "print neither progress nor the table of events"}};
}

CallOptions call_options(const Options& options) {
  CallOptions call{.max_points = options.count("max-points"), .max_seconds = options.seconds("max-time")};
  if (const auto pause = options.pause("checkpoint-pause"))
    call.checkpoint_pause = std::chrono::duration<double>(*pause);
  call.scratch = options.has("scratch");
  if (options.has("no-pictures")) call.pictures = CallOptions::Pictures::left_out;
  if (options.has("quiet")) call.report = CallOptions::Report::none;
  if (options.has("json")) call.report = CallOptions::Report::json_lines;
  if (!options.has("quiet") && !options.has("json")) call.progress = progress_wanted();
  return call;
}

std::optional<BranchEnd> limit_met(const CallOptions& options, int points, const Stopwatch& watch,
                                   const InterruptGuard& interrupts) {
  if (interrupts.interrupted()) return BranchEnd{.reason = EndReason::interrupted, .detail = "by a signal"};
  if (!std::cout)
    return BranchEnd{.reason = EndReason::interrupted, .detail = "standard output can no longer be written"};
  if (options.max_seconds && watch.seconds() >= *options.max_seconds)
    return BranchEnd{.reason = EndReason::max_time, .detail = round_trip(*options.max_seconds) + " s"};
  if (options.max_points && points >= *options.max_points)
    return BranchEnd{.reason = EndReason::max_points, .detail = std::to_string(points) + " points"};
  return std::nullopt;
}

}  // namespace arcwall
