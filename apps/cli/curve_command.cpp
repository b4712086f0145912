#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "apps/cli/commands.hpp"
#include "apps/cli/interrupt.hpp"
#include "apps/output/curve_files.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/files.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/toml_source.hpp"

namespace arcwall {

namespace {

ExitStatus curve(const Options& options) {
  const std::string& file = options.words().front();
  const std::vector<std::string> assignments = options.texts("set");
  const std::string text = deck::read_text_file(file);
  const deck::Deck deck = deck::read_deck_text(text, file, assignments);
  if (!deck.curve)
    throw InputError(
        fmt::format("{}: curve: the deck does not say which event is followed; add a table [curve] with "
                    "event, over and range",
                    file));
  const InterruptGuard interrupts;
  const bool quiet = options.has("quiet");
  const std::filesystem::path out =
      options.text("out").value_or(std::filesystem::path(file).stem().string() + "-curve");
  require_other_than_input(out, file);
  const Foreign foreign = options.has("force") ? Foreign::overwrite : Foreign::refuse;
  require_no_run(out, foreign);
  const OutputFolder folder(out, std::filesystem::path(file).filename().string(), foreign);
  if (deck.curve->over.empty()) {
    const WorstCombination worst = worst_combination(deck, [&] { return interrupts.interrupted(); });
    if (!worst.problem.empty()) throw InputError(fmt::format("{}: curve.worst: {}", file, worst.problem));
    FileSet files(folder);
    files.write("curve.json", to_text(worst_json(deck, worst, text, assignments), JsonLayout::lines));
    files.put_in_place();
    if (!quiet) std::cout << worst_text(deck, worst);
    if (interrupts.interrupted()) return ExitStatus::interrupted;
    return worst.settled ? ExitStatus::success : ExitStatus::limit_met;
  }
  const EventCurve found = trace_event_curve(deck, [&] { return interrupts.interrupted(); });
  if (!found.problem.empty()) {
    std::cerr << fmt::format("error: {}: {}\n", file, found.problem);
    return interrupts.interrupted() ? ExitStatus::interrupted : ExitStatus::no_start;
  }
  FileSet files(folder);
  const UnitLabels labels = options.has("no-units") ? UnitLabels::left_out : UnitLabels::shown;
  for (const auto& [name, content] : curve_files(found, labels, text, assignments)) files.write(name, content);
  files.put_in_place();
  if (!quiet) std::cout << curve_text(found);
  return curve_status(found);
}

}  // namespace

Command curve_command() {
  return {
      .description = {.name = "curve",
                      .example = "trace-path curve channel.toml --set curve.range=[0.15,0.25]",
                      .usage = "DECK [options]",
                      .summary = "follows an event while a number of the deck varies",
                      .options = {{"out", "DIR",
                                   "folder to write into (default: the deck's name without its ending, and -curve)"},
                                  {"force", "", "write into DIR though something else filled it"},
                                  {"no-units", "", "no units in the titles of curve.csv"},
                                  {"quiet", "", "no table"},
                                  set_option()},
                      .least_words = 1,
                      .most_words = 1},
      .run = curve};
}

}  // namespace arcwall
