#include "apps/cli/trace_and_write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "answers/sessions.hpp"
#include "apps/cli/checkpoint_keeper.hpp"
#include "apps/cli/interrupt.hpp"
#include "apps/cli/json_lines.hpp"
#include "apps/converge/convergence_files.hpp"
#include "apps/output/branch_map_page.hpp"
#include "apps/output/contacts_csv.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/load_text.hpp"
#include "apps/output/paraview.hpp"
#include "apps/output/path_csv.hpp"
#include "apps/output/report_html.hpp"
#include "apps/output/result_json.hpp"
#include "apps/output/run_warnings.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/deck/writer.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

using Report = CallOptions::Report;

void warn_of_start(const Session& run) {
  if (const std::string warning = warning_of_start(run.model(), run.record()); !warning.empty())
    std::cerr << "warning: " << warning << "\n";
}

// Until all has ended or a limit is met. The last checkpoint knows nothing of ends that came from outside.
std::optional<BranchEnd> trace(Session& run, CheckpointKeeper& checkpoints, const CallOptions& options,
                               const InterruptGuard& interrupts) {
  const Stopwatch watch;
  ProgressLine progress(options.progress);
  const std::vector<std::string> lambda_is = names_of_lambda(run.model().whole_deck());
  JsonLines lines(run.record());
  std::optional<BranchEnd> stopped;
  for (int points = 1; run.next() != nullptr; ++points) {
    if (run.record().points.size() == 1) warn_of_start(run);
    progress.show(run.record(), lambda_is);
    if (options.report == Report::json_lines) lines.print_new(run.record());
    stopped = limit_met(options, points, watch, interrupts);
    if (stopped) break;
    checkpoints.keep_now_and_then();
  }
  if (!run.record().points.empty() && (stopped || !options.scratch)) checkpoints.keep(stopped);
  if (stopped) {
    run.stop(*stopped);
    run.next();
  }
  if (options.report == Report::json_lines) lines.print_new(run.record());
  return stopped;
}

// Those of an earlier run would show another path than the tables.
void remove_pictures(const OutputFolder& folder) {
  for (const char* name : {"report.html", "shapes.pvd"}) {
    std::error_code error;
    std::filesystem::remove(folder.path() / name, error);
    if (error) throw OutputError((folder.path() / name).string() + ": cannot be removed: " + error.message());
  }
  remove_shapes(folder);
}

// The table of events, with error bars where a study of the deck lies in the folder.
std::string report_of_events(const OutputFolder& folder, const Session& run) {
  const StudiedDeck deck{.text = run.description().deck_text, .assignments = run.description().assignments};
  return events_text(run.record(), names_of_lambda(run.model().whole_deck())) +
         error_bars_text(folder.path(), run.record(), deck);
}

// result.json comes last: where it is, the others are, but for the pictures, which can be many.
void write_files(const OutputFolder& folder, const Session& run, const CallOptions& options, const RunSeconds& seconds,
                 ExitStatus status) {
  const bool pictures = options.pictures == CallOptions::Pictures::written;
  if (!pictures) remove_pictures(folder);
  const Record& record = run.record();
  const RunDescription& description = run.description();
  const DrawnScenes drawn = pictures ? scenes_to_draw(run.model(), record) : DrawnScenes();
  FileSet files(folder);
  files.write("path.csv", path_csv(record, description.units));
  if (record.has_walls) files.write("contacts.csv", contacts_csv(record, description.units));
  files.write("events.json", to_text(events_json(record), JsonLayout::lines));
  files.write("events.txt", report_of_events(folder, run));
  files.write("branches.json", to_text(branch_map_json(record, branch_map_of(run.model(), record)), JsonLayout::lines));
  if (pictures) files.write("report.html", ReportPage(record, report_content(run.model(), record, drawn)).pieces());
  if (description.ledger == StepLedger::kept) files.write("steps.jsonl", record.steps);
  files.write("deck.toml", deck::to_toml(run.model().given_deck()));
  const auto result = result_json(run.model(), description, record, seconds, static_cast<int>(status));
  files.write("result.json", to_text(result, JsonLayout::lines));
  files.put_in_place();
  if (pictures) write_shapes(folder, run.model(), record, drawn);
}

// An early end in full: the reason, the last good point, and what to try.
void say_that_it_ended_early(const RecordBranch& branch, const Session& run, const std::string& where) {
  const Record& record = run.record();
  std::cerr << fmt::format("error: branch {} ended early: {}; what was traced is in {}\n", branch.id,
                           how_it_ended(*branch.end), where);
  const auto is_its = [&](const RecordPoint& point) { return point.branch == branch.id; };
  const auto last = std::find_if(record.points.rbegin(), record.points.rend(), is_its);
  if (last != record.points.rend())
    std::cerr << "  last point: " << progress_text(record, *last, names_of_lambda(run.model().whole_deck())) << "\n";
  std::cerr << "  try: " << what_to_try(branch.end->reason) << "\n";
}

// `stopped`: from outside, so that the run can go on.
void say_how_it_ended(const std::optional<BranchEnd>& stopped, const Session& run, const std::string& where) {
  const Record& record = run.record();
  if (stopped) {
    std::cerr << fmt::format("note: the run ended: {}; what was traced is in {}, and trace-path resume {} goes on\n",
                             how_it_ended(*stopped), where, where);
    return;
  }
  const RecordBranch& branch = decisive_branch(record);
  const ExitStatus status = exit_status(branch.end->reason);
  if (status == ExitStatus::limit_met)
    std::cerr << fmt::format(
        "note: the run ended: {}, {}; what was traced is in {}\n", how_it_ended(*branch.end),
        run.model().deck().path.max_points_given.in_deck ? "as the deck has it" : "which is the default", where);
  else if (status != ExitStatus::success)
    say_that_it_ended_early(branch, run, where);
}

}  // namespace

ExitStatus trace_and_write(Session& run, const OutputFolder& folder, const CallOptions& options,
                           const Stopwatch& since_begin) {
  const InterruptGuard interrupts;
  const Stopwatch since_start;
  CheckpointKeeper checkpoints(folder, options.checkpoint_pause,
                               [&](const std::optional<BranchEnd>& stopped) { return run.checkpoint(stopped); });
  const std::optional<BranchEnd> stopped = trace(run, checkpoints, options, interrupts);
  const Record& record = run.record();
  const EndReason reason = stopped ? stopped->reason : decisive_branch(record).end->reason;
  if (record.points.empty() && (reason == EndReason::singular || reason == EndReason::not_finite)) {
    std::cerr << "error: there is no equilibrium at the start: " << explanation(reason) << "\n";
    return ExitStatus::no_start;
  }
  for (const std::string& warning : warnings_of_paths(run.model(), record)) std::cerr << "warning: " << warning << "\n";
  const ExitStatus status = std::cout ? exit_status(reason) : ExitStatus::file_error;
  write_files(folder, run, options, {.total = since_begin.seconds(), .tracing = since_start.seconds()}, status);
  if (!stopped && options.scratch) checkpoints.drop();
  if (options.report == Report::table) std::cout << report_of_events(folder, run);
  say_how_it_ended(stopped, run, folder.path().string());
  return status;
}

void write_run(Session& run, const OutputFolder& folder, const CallOptions& options, const BranchEnd& stopped,
               const RunSeconds& seconds) {
  const bool ended = run.has_ended();
  const std::string checkpoint = run.checkpoint(ended ? std::nullopt : std::optional(stopped));
  folder.write_durably("checkpoint", checkpoint);
  if (ended) {
    const ExitStatus status = exit_status(run.record());
    return write_files(folder, run, options, seconds, status);
  }
  const Session as_ended =
      resume_session(checkpoint, (folder.path() / "checkpoint").string(), Session::Resume::as_ended);
  write_files(folder, as_ended, options, seconds, exit_status(stopped.reason));
}

}  // namespace arcwall
