#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>

#include "apps/build_path.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/interrupt.hpp"
#include "apps/cli/progress.hpp"
#include "apps/cli/summary.hpp"
#include "apps/deck/reader.hpp"
#include "apps/deck/toml_source.hpp"
#include "apps/deck/writer.hpp"
#include "apps/output/contacts_csv.hpp"
#include "apps/output/event_names.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/files.hpp"
#include "apps/output/path_csv.hpp"
#include "apps/output/recorder.hpp"
#include "apps/output/result_json.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace arcwall {

namespace {

enum class Report { table, json_lines, none };

// The command line of `run` as values.
struct RunRequest {
  std::string deck{};  // file
  std::string deck_text{};
  std::vector<std::string> assignments{};
  std::filesystem::path folder{};
  Foreign foreign = Foreign::refuse;
  UnitLabels units = UnitLabels::shown;
  std::optional<int> max_points{};
  std::optional<double> max_seconds{};
  Report report = Report::table;
  Progress progress = Progress::hidden;
  bool dry = false;
};

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

RunRequest request_from(const Options& options);
ExitStatus dry_run(const RunRequest& request, const Study& study);
void trace(const RunRequest& request, const Study& study, State start, const InterruptGuard& interrupts,
           Record& record);
void trace_increments(const RunRequest& request, Study& study, State start, const InterruptGuard& interrupts,
                      Record& record);
const BranchEnd& decisive_end(const Record& record);
void write_files(const OutputFolder& folder, const RunRequest& request, const Study& study, const Record& record,
                 const RunSeconds& seconds, ExitStatus status);
void say_how_it_ended(const BranchEnd& end, ExitStatus status, const OutputFolder& folder);

ExitStatus run(const Options& options) {
  const Stopwatch since_begin;
  const RunRequest request = request_from(options);
  Study study(deck::read_deck_text(request.deck_text, request.deck, request.assignments));
  for (const std::string& warning : study.warnings()) std::cerr << "warning: " << warning << "\n";
  if (request.dry) return dry_run(request, study);

  Record record = empty_record(study);
  const OutputFolder folder(request.folder, record.deck, request.foreign);
  const InterruptGuard interrupts;
  const Stopwatch since_start;
  std::string reason;
  std::optional<State> start = study.start(reason);
  if (!start) {
    std::cerr << "error: there is no equilibrium at the start: " << reason << "\n";
    return ExitStatus::no_start;
  }
  if (study.in_increments())
    trace_increments(request, study, std::move(*start), interrupts, record);
  else
    trace(request, study, std::move(*start), interrupts, record);
  const BranchEnd& end = decisive_end(record);
  if (record.points.empty() && (end.reason == EndReason::singular || end.reason == EndReason::not_finite)) {
    std::cerr << "error: there is no equilibrium at the start: " << explanation(end.reason) << "\n";
    return ExitStatus::no_start;
  }
  const ExitStatus status = std::cout ? exit_status(end.reason) : ExitStatus::file_error;
  const RunSeconds seconds{.total = since_begin.seconds(), .tracing = since_start.seconds()};
  write_files(folder, request, study, record, seconds, status);
  if (request.report == Report::table) std::cout << events_text(record);
  say_how_it_ended(end, status, folder);
  return status;
}

RunRequest request_from(const Options& options) {
  RunRequest request{.deck = options.words().front(),
                     .assignments = options.texts("set"),
                     .foreign = options.has("force") ? Foreign::overwrite : Foreign::refuse,
                     .units = options.has("no-units") ? UnitLabels::left_out : UnitLabels::shown,
                     .max_points = options.count("max-points"),
                     .max_seconds = options.seconds("max-time"),
                     .dry = options.has("dry-run")};
  request.folder = options.text("out").value_or(std::filesystem::path(request.deck).stem().string());
  if (options.has("quiet")) request.report = Report::none;
  if (options.has("json")) request.report = Report::json_lines;
  if (!options.has("quiet") && !options.has("json")) request.progress = progress_wanted();
  request.deck_text = deck::read_text_file(request.deck);
  return request;
}

ExitStatus dry_run(const RunRequest& request, const Study& study) {
  require_usable(request.folder, empty_record(study).deck, request.foreign);
  if (request.report != Report::table) return ExitStatus::success;
  std::cout << summary(study) << "\nwould write into " << request.folder.string() << ": path.csv, "
            << (study.contact() != nullptr ? "contacts.csv, " : "")
            << "events.json, events.txt, deck.toml, result.json\n";
  return ExitStatus::success;
}

void print_lines(const Record& record, std::size_t& events_printed) {
  const auto line = [](const char* name, nlohmann::ordered_json json) {
    std::cout << to_text(nlohmann::ordered_json{{name, std::move(json)}}, JsonLayout::one_line);
  };
  if (!record.points.empty() && !record.branches.back().end) line("point", point_json(record, record.points.back()));
  for (; events_printed < record.events.size(); ++events_printed)
    line("event", event_json(record, record.events[events_printed]));
  if (const auto& end = record.branches.back().end) {
    nlohmann::ordered_json json{{"branch", record.branches.back().id}};
    json.update(end_json(*end));
    json["status"] = static_cast<int>(exit_status(end->reason));
    line("end", std::move(json));
  }
  std::cout << std::flush;
}

// What reads the lines has gone, or its disk is full.
BranchEnd nobody_reads() {
  return {.reason = EndReason::interrupted, .detail = "standard output can no longer be written"};
}

// Every branch, one after the other; the record says how each ended.
void trace(const RunRequest& request, const Study& study, State start, const InterruptGuard& interrupts,
           Record& record) {
  const Stopwatch watch;
  TraceOptions options = study.options();
  if (request.max_points) options.max_points = *request.max_points;
  Explorer explorer(study.system(), std::move(start), std::move(options), study.watched(), study.explore());
  std::optional<Recorder> recorder;
  ProgressLine progress(request.progress);
  std::size_t events_printed = 0;
  const auto end_branch = [&](int branch) {
    recorder->end(explorer.branches()[static_cast<std::size_t>(branch)].end.value());
    if (request.report == Report::json_lines) print_lines(record, events_printed);
  };
  int branch = -1;
  while (const std::optional<Explorer::Step> step = explorer.next()) {
    if (step->branch != branch) {
      if (recorder) end_branch(branch);
      branch = step->branch;
      recorder.emplace(study, record, explorer.branches()[static_cast<std::size_t>(branch)]);
    }
    recorder->add(step->arc);
    progress.show(record);
    if (request.report == Report::json_lines) print_lines(record, events_printed);
    if (interrupts.interrupted()) {
      explorer.stop({.reason = EndReason::interrupted, .detail = "by a signal"});
    } else if (!std::cout) {
      explorer.stop(nobody_reads());
    } else if (request.max_seconds && watch.seconds() >= *request.max_seconds) {
      explorer.stop({.reason = EndReason::max_time, .detail = round_trip(*request.max_seconds) + " s"});
    }
  }
  if (!recorder) {  // not even a start: the branch has no points, but an end
    recorder.emplace(study, record);
    branch = 0;
  }
  end_branch(branch);
}

// Whether the way between two states crosses a bound that stops.
const Landmark* crossed(const std::vector<Landmark>& landmarks, const State& from, const State& to) {
  const auto stops = [&](const Landmark& landmark) {
    const double before = landmark.quantity->value(from) - landmark.value;
    const double after = landmark.quantity->value(to) - landmark.value;
    return landmark.stops && before != 0.0 && before * after <= 0.0;
  };
  const auto found = std::find_if(landmarks.begin(), landmarks.end(), stops);
  return found == landmarks.end() ? nullptr : &*found;
}

// The deck's load increments: one branch.
void trace_increments(const RunRequest& request, Study& study, State start, const InterruptGuard& interrupts,
                      Record& record) {
  const Stopwatch watch;
  LoadIncrements increments = study.increments(std::move(start));
  Recorder recorder(study, record);
  ProgressLine progress(request.progress);
  std::size_t events_printed = 0;
  State last;
  const auto add = [&](const Arc& arc) {
    recorder.add(arc);
    progress.show(record);
    if (request.report == Report::json_lines) print_lines(record, events_printed);
    last = arc.to.state;
  };
  const auto ending = [&]() -> BranchEnd {
    const int most_points = request.max_points.value_or(study.options().max_points);
    add(increments.start());
    for (const double level : load_levels(study.deck().path)) {
      const State before = last;
      const auto arc = increments.to(level);
      if (!arc) return increments.end().value();
      add(*arc);
      if (const Landmark* bound = crossed(study.options().landmarks, before, last))
        return {.reason = EndReason::stop, .detail = bound->label};
      if (study.options().stop_contacts && study.closed_contacts(last) >= *study.options().stop_contacts)
        return {.reason = EndReason::stop, .detail = "contacts"};
      if (static_cast<int>(record.points.size()) >= most_points)
        return {.reason = EndReason::max_points, .detail = std::to_string(most_points)};
      if (interrupts.interrupted()) return {.reason = EndReason::interrupted, .detail = "by a signal"};
      if (!std::cout) return nobody_reads();
      if (request.max_seconds && watch.seconds() >= *request.max_seconds)
        return {.reason = EndReason::max_time, .detail = round_trip(*request.max_seconds) + " s"};
    }
    std::string detail = "lambda = " + round_trip(last.lambda);
    if (increments.unsettled() > 0)
      detail += fmt::format("; contacts did not settle in {} increments", increments.unsettled());
    return {.reason = EndReason::stop, .detail = detail};
  };
  recorder.end(ending());
  if (request.report == Report::json_lines) print_lines(record, events_printed);
}

// The branch whose end decides the status: an interrupt, then a limit, then an early end.
const BranchEnd& decisive_end(const Record& record) {
  const auto severity = [](const RecordBranch& branch) {
    switch (exit_status(branch.end->reason)) {
      case ExitStatus::interrupted:
        return 3;
      case ExitStatus::limit_met:
        return 2;
      case ExitStatus::success:
        return 0;
      case ExitStatus::internal_error:
      case ExitStatus::wrong_input:
      case ExitStatus::ended_early:
      case ExitStatus::no_start:
      case ExitStatus::file_error:
        return 1;
    }
    return 1;
  };
  return *std::max_element(record.branches.begin(), record.branches.end(),
                           [&](const RecordBranch& a, const RecordBranch& b) { return severity(a) < severity(b); })
              ->end;
}

// result.json comes last: where it is, the others are.
void write_files(const OutputFolder& folder, const RunRequest& request, const Study& study, const Record& record,
                 const RunSeconds& seconds, ExitStatus status) {
  FileSet files(folder);
  files.write("path.csv", path_csv(record, request.units));
  if (record.has_walls) files.write("contacts.csv", contacts_csv(record, request.units));
  files.write("events.json", to_text(events_json(record), JsonLayout::lines));
  files.write("events.txt", events_text(record));
  files.write("deck.toml", deck::to_toml(study.deck()));
  const auto result = result_json(study, request.deck_text, record, seconds, static_cast<int>(status));
  files.write("result.json", to_text(result, JsonLayout::lines));
  files.put_in_place();
}

void say_how_it_ended(const BranchEnd& end, ExitStatus status, const OutputFolder& folder) {
  if (status == ExitStatus::success) return;
  std::cerr << fmt::format(
      "{}{}; what was traced is in {}\n",
      status == ExitStatus::ended_early ? "error: a branch ended early: " : "note: the run ended: ", how_it_ended(end),
      folder.path().string());
}

}  // namespace

OptionDescription set_option() {
  return {.name = "set",
          .value = "key=value",
          .help = "replace or add one value of the deck, written as in TOML; may be repeated",
          .repeatable = true};
}

Command run_command() {
  return {
      .description = {.name = "run",
                      .example = "trace-path run channel.toml --out results --set member.column.elements=160",
                      .usage = "DECK [options]",
                      .summary = "traces the paths of a deck and writes them into a folder",
                      .options = {{"out", "DIR", "folder to write into (default: the deck's name without its ending)"},
                                  {"no-units", "", "leave the units out of the header of path.csv"},
                                  {"force", "", "write into DIR though something else filled it"},
                                  set_option(),
                                  {"max-points", "N", "end after N points (status 6)"},
                                  {"max-time", "SECONDS", "end after that time (status 6)"},
                                  {"json", "", "points, events and end on standard output, one JSON object a line"},
                                  {"quiet", "", "no progress and no table of events"},
                                  {"dry-run", "", "read, build and check, say what would be written, write nothing"}},
                      .least_words = 1,
                      .most_words = 1},
      .run = run};
}

}  // namespace arcwall
