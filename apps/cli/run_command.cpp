#include <filesystem>
#include <iostream>

#include "answers/sessions.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/summary.hpp"
#include "apps/cli/trace_and_write.hpp"
#include "core/error.hpp"
#include "model/deck/given_points.hpp"

namespace arcwall {

namespace {

// The command line of `run` as values.
struct RunRequest {
  RunDescription run{};
  std::filesystem::path folder{};
  Foreign foreign = Foreign::refuse;
  CallOptions call{};
};

// One after the other: where a later initialiser of an aggregate throws, g++ destroys members of an inner one twice.
RunRequest request_from(const Options& options) {
  RunRequest request;
  request.call = call_options(options);
  request.foreign = options.has("force") ? Foreign::overwrite : Foreign::refuse;
  request.run.deck = options.words().front();
  request.run.assignments = options.texts("set");
  request.run.units = options.has("no-units") ? UnitLabels::left_out : UnitLabels::shown;
  request.run.ledger = options.has("verbose") ? StepLedger::kept : StepLedger::none;
  request.folder = options.text("out").value_or(std::filesystem::path(request.run.deck).stem().string());
  request.run.deck_text = deck::read_deck_file(request.run.deck);
  request.run.deck_path = whole_path(request.run.deck);
  return request;
}

ExitStatus dry_run(const RunRequest& request, const Session& run) {
  const DeckIdentity identity = identity_of(request.run);
  require_usable(request.folder, identity, request.foreign);
  if (const std::string replaced = note_of_replaced(request.folder, identity); !replaced.empty())
    std::cerr << "note: " << replaced << "\n";
  if (request.call.report != CallOptions::Report::table) return ExitStatus::success;
  std::cout << summary(run.model()) << "\nwould write into " << request.folder.string() << ": path.csv, "
            << (run.record().has_walls ? "contacts.csv, " : "")
            << "events.json, events.txt, branches.json, deck.toml, checkpoint, result.json"
            << (request.call.pictures == CallOptions::Pictures::written ? ", report.html, shapes.pvd, shapes/" : "")
            << "\n";
  return ExitStatus::success;
}

// A run of the same deck that could go on is not lost without a word. One of another version is none.
void say_what_is_replaced(const RunRequest& request) {
  try {
    const Session there = stored_session(request.folder, Session::Resume::go_on);
    const RunDescription& of = there.description();
    if (there.has_ended() || of.deck_text != request.run.deck_text || of.assignments != request.run.assignments) return;
    const std::string folder = request.folder.string();
    std::cerr << "note: " << folder << " holds a run of this deck that had not ended (" << there.record().points.size()
              << " points); it is traced anew. `trace-path resume " << folder << "` would have continued it\n";
  } catch (const OutputError&) {
  } catch (const InputError&) {
  }
}

ExitStatus run(const Options& options) {
  const Stopwatch since_begin;
  const RunRequest request = request_from(options);
  Session run = make_session(request.run);
  require_other_than_input(request.folder, request.run.deck);
  for (const std::string& warning : run.model().warnings()) std::cerr << "warning: " << warning << "\n";
  if (options.has("dry-run")) return dry_run(request, run);

  const DeckIdentity identity = identity_of(request.run);
  const std::string replaced = note_of_replaced(request.folder, identity);
  const OutputFolder folder(request.folder, identity, request.foreign);
  if (!replaced.empty()) std::cerr << "note: " << replaced << "\n";
  say_what_is_replaced(request);
  if (!run.begin()) {
    std::cerr << "error: there is no equilibrium at the start: " << run.problem() << "\n";
    return ExitStatus::no_start;
  }
  return trace_and_write(run, folder, request.call, since_begin);
}

}  // namespace

OptionDescription set_option() {
  return {.name = "set",
          .value = "key=value",
          .help = "replace or add one value of the deck, written as in TOML; may be repeated",
          .repeatable = true};
}

Command run_command() {
  std::vector<OptionDescription> options = {
      {"out", "DIR", "folder to write into (default: the deck's name without its ending)"},
      {"no-units", "", "omit units in the header of path.csv"},
      {"force", "", "overwrite a folder that holds other files"},
      set_option()};
  for (OptionDescription& option : call_options()) options.push_back(std::move(option));
  options.push_back({"verbose", "", "write steps.jsonl: each attempted step and its outcome"});
  options.push_back({"dry-run", "", "validate only, write nothing"});
  return {.description = {.name = "run",
                          .example = "trace-path run channel.toml --out results --set member.column.elements=160",
                          .usage = "DECK [options]",
                          .summary = "trace the equilibrium paths of a deck and write the results",
                          .options = std::move(options),
                          .least_words = 1,
                          .most_words = 1},
          .run = run};
}

}  // namespace arcwall
