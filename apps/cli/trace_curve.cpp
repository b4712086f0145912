#include "apps/cli/trace_curve.hpp"

#include <fmt/format.h>

#include <iostream>

#include "apps/cli/checkpoint_keeper.hpp"
#include "apps/output/curve_files.hpp"
#include "core/error.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

// Until the curve has its ends or a limit is met. The last checkpoint knows nothing of ends that came from outside.
std::optional<BranchEnd> trace(CurveSession& session, CheckpointKeeper& checkpoints, const CallOptions& options,
                               const InterruptGuard& interrupts) {
  const Stopwatch watch;
  ProgressLine progress(options.progress);
  std::optional<BranchEnd> stopped;
  for (int points = 1; session.tracing().advance(); ++points) {
    progress.show(fmt::format("{}  {} points", session.tracing().has_begun() ? "curve" : "path", points));
    stopped = limit_met(options, points, watch, interrupts);
    if (stopped) break;
    checkpoints.keep_now_and_then();
  }
  if (stopped || !options.scratch) checkpoints.keep(stopped);
  if (stopped) session.tracing().stop(*stopped);
  return stopped;
}

void write_files(const CurveSession& session, const EventCurve& curve, const OutputFolder& folder,
                 const CallOptions& options) {
  const bool pictures = options.pictures == CallOptions::Pictures::written;
  const RunDescription& of = session.description();
  FileSet files(folder);
  const std::vector<LoadText> loads = driven_by_lambda(session.deck());
  for (const auto& [name, content] : curve_files(curve, loads, of.units, of))
    if (pictures || name != "report.html") files.write(name, content);
  files.put_in_place();
  std::error_code error;
  if (!pictures) std::filesystem::remove(folder.path() / "report.html", error);
  if (error) throw OutputError((folder.path() / "report.html").string() + ": cannot be removed: " + error.message());
}

}  // namespace

ExitStatus trace_curve_and_write(CurveSession& session, const OutputFolder& folder, const CallOptions& options) {
  const InterruptGuard interrupts;
  CheckpointKeeper checkpoints(folder, options.checkpoint_pause,
                               [&](const std::optional<BranchEnd>& stopped) { return session.checkpoint(stopped); });
  const std::optional<BranchEnd> stopped = trace(session, checkpoints, options, interrupts);
  const std::string where = folder.path().string();
  const EventCurve curve = session.tracing().curve();
  if (curve.problem.empty()) {
    write_files(session, curve, folder, options);
    if (options.report == CallOptions::Report::table) std::cout << curve_text(curve);
  }
  if (!stopped && options.scratch) checkpoints.drop();
  if (stopped) {
    std::cerr << fmt::format("note: the curve ended: {} ({}); trace-path resume {} goes on\n",
                             curve.problem.empty() ? explanation(stopped->reason) : curve.problem, stopped->detail,
                             where);
    return std::cout ? exit_status(stopped->reason) : ExitStatus::file_error;
  }
  if (curve.problem.empty()) return curve_status(curve);
  std::cerr << fmt::format("error: {}: {}\n", session.description().deck, curve.problem);
  return ExitStatus::no_start;
}

}  // namespace arcwall
