#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "apps/cli/commands.hpp"
#include "apps/cli/trace_curve.hpp"
#include "apps/output/curve_files.hpp"
#include "apps/output/events_json.hpp"
#include "core/error.hpp"
#include "model/deck/given_points.hpp"
#include "model/deck/reader.hpp"

namespace arcwall {

namespace {

namespace fs = std::filesystem;

// The combination of numbers that lowers the event most: some runs, which are over together.
ExitStatus worst(const deck::Deck& deck, const RunDescription& of, const OutputFolder& folder,
                 const CallOptions& call) {
  const InterruptGuard interrupts;
  const WorstCombination found = worst_combination(deck, [&] { return interrupts.interrupted(); });
  if (!found.problem.empty()) throw InputError(fmt::format("{}: curve.worst: {}", of.deck, found.problem));
  FileSet files(folder);
  files.write("curve.json", to_text(worst_json(deck, found, of), JsonLayout::lines));
  files.put_in_place();
  if (call.report == CallOptions::Report::table) std::cout << worst_text(deck, found);
  if (interrupts.interrupted()) return ExitStatus::interrupted;
  return found.settled ? ExitStatus::success : ExitStatus::limit_met;
}

// A curve of the same deck that could go on is not lost without a word.
void say_what_is_replaced(const fs::path& folder, const RunDescription& asked) {
  try {
    const StoredTracing there = stored_tracing(folder, Session::Resume::go_on);
    const auto* const curve = std::get_if<CurveSession>(&there);
    if (curve == nullptr || curve->tracing().has_ended()) return;
    const RunDescription& of = curve->description();
    if (of.deck_text != asked.deck_text || of.assignments != asked.assignments) return;
    std::cerr << fmt::format(
        "note: {0} holds a curve of this deck that had not ended; it is traced anew. `trace-path resume {0}` would "
        "have gone on with it\n",
        folder.string());
  } catch (const OutputError&) {
  } catch (const InputError&) {
  }
}

ExitStatus curve(const Options& options) {
  RunDescription of{.deck = options.words().front(),
                    .assignments = options.texts("set"),
                    .units = options.has("no-units") ? UnitLabels::left_out : UnitLabels::shown,
                    .traced = Traced::curve};
  of.deck_text = deck::read_deck_file(of.deck);
  of.deck_path = whole_path(of.deck);
  const deck::Deck deck = deck::read_deck_text(of.deck_text, of.deck, of.assignments);
  if (!deck.curve)
    throw InputError(
        fmt::format("{}: curve: the deck does not say which event is followed; add a table [curve] with "
                    "event, parameter and range, or with event, worst and radius",
                    of.deck));
  const fs::path out = options.text("out").value_or(fs::path(of.deck).stem().string() + "-curve");
  require_other_than_input(out, of.deck);
  const Foreign foreign = options.has("force") ? Foreign::overwrite : Foreign::refuse;
  require_no_run(out, foreign);
  const DeckIdentity identity = identity_of(of);
  const std::string replaced = note_of_replaced(out, identity);
  const auto say_replaced = [&] {
    if (!replaced.empty()) std::cerr << "note: " << replaced << "\n";
  };
  const CallOptions call = call_options(options);
  if (deck.curve->parameter.empty()) {
    const OutputFolder folder(out, identity, foreign);
    say_replaced();
    return worst(deck, of, folder, call);
  }
  CurveSession session(std::move(of));
  const OutputFolder folder(out, identity, foreign);
  say_replaced();
  say_what_is_replaced(out, session.description());
  return trace_curve_and_write(session, folder, call);
}

}  // namespace

Command curve_command() {
  std::vector<OptionDescription> options = {
      {"out", "DIR", "folder to write into (default: the deck's name without its ending, and -curve)"},
      {"force", "", "overwrite a folder that holds other files"},
      {"no-units", "", "no units in the titles of curve.csv"},
      set_option()};
  for (OptionDescription& option : call_options())
    if (std::string(option.name) != "json") options.push_back(std::move(option));
  return {.description = {.name = "curve",
                          .example = "trace-path curve channel.toml --set curve.range=[0.15,0.25]",
                          .usage = "DECK [options]",
                          .summary = "follow an event while a parameter of the deck varies",
                          .options = std::move(options),
                          .least_words = 1,
                          .most_words = 1},
          .run = curve};
}

}  // namespace arcwall
