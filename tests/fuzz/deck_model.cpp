// Decks with odd values as models: what a deck builds, `check` says, the start finds and the first points of its path
// are, ends in values or in an InputError. With ARCWALL_FUZZ_SHOW set in the environment the deck is printed.
#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "apps/build_path.hpp"
#include "apps/cli/summary.hpp"
#include "apps/deck/reader.hpp"
#include "apps/output/contacts_csv.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/path_csv.hpp"
#include "apps/output/recorder.hpp"
#include "apps/output/result_json.hpp"
#include "apps/study.hpp"
#include "core/error.hpp"
#include "tests/fuzz/mutated_deck.hpp"
#include "tests/fuzz/require.hpp"

namespace arcwall::fuzz {
namespace {

constexpr int most_points = 5;
constexpr std::int64_t most_elements = 20;

// A size that a run of some milliseconds can have.
bool is_small(const deck::Deck& deck) {
  std::int64_t elements = 0;
  for (const deck::Member& member : deck.members) elements += member.elements;
  return elements <= most_elements;
}

void trace(const Study& study, State start, Record& record) {
  TraceOptions options = study.options();
  options.max_points = std::min(options.max_points, most_points);
  Explorer explorer(study.system(), std::move(start), std::move(options), study.watched(), study.explore());
  std::optional<Recorder> recorder;
  int branch = -1;
  const auto end_branch = [&] { recorder->end(explorer.branches()[static_cast<std::size_t>(branch)].end.value()); };
  while (const std::optional<Explorer::Step> step = explorer.next()) {
    if (step->branch != branch) {
      if (recorder) end_branch();
      branch = step->branch;
      recorder.emplace(study, record, explorer.branches()[static_cast<std::size_t>(branch)]);
    }
    recorder->add(step->arc);
    if (record.points.size() >= most_points) explorer.stop({.reason = EndReason::max_points, .detail = ""});
  }
  if (!recorder) {
    recorder.emplace(study, record);
    branch = 0;
  }
  end_branch();
}

void trace_increments(Study& study, State start, Record& record) {
  const std::vector<double> levels = load_levels(study.deck().path);
  LoadIncrements increments = study.increments(std::move(start));
  Recorder recorder(study, record);
  recorder.add(increments.start());
  for (std::size_t i = 0; i < std::min<std::size_t>(levels.size(), most_points); ++i) {
    const auto arc = increments.to(levels[i]);
    if (!arc) break;
    recorder.add(*arc);
  }
  recorder.end(increments.end().value_or(BranchEnd{.reason = EndReason::stop, .detail = ""}));
}

void check_points(const Record& record) {
  double arc = -1.0;
  for (const RecordPoint& point : record.points) {
    require(std::isfinite(point.lambda) && point.state.x.allFinite(), "a point is not finite");
    if (point.branch == 0) require(point.arc >= std::exchange(arc, point.arc), "arc lengths decrease");
  }
}

void write(const Study& study, const Record& record) {
  path_csv(record, UnitLabels::shown);
  contacts_csv(record, UnitLabels::shown);
  to_text(events_json(record), JsonLayout::lines);
  events_text(record);
  to_text(result_json(study, "", record, {}, 0), JsonLayout::lines);
}

void follow(const std::string& text) {
  deck::Deck deck = deck::read_deck_text(text, "fuzz.toml");
  if (!is_small(deck)) return;
  Study study(std::move(deck));
  summary(study);
  std::string reason;
  std::optional<State> start = study.start(reason);
  if (!start) {
    require(!reason.empty(), "there is no start and no reason");
    return;
  }
  Record record = empty_record(study);
  if (study.in_increments())
    trace_increments(study, std::move(*start), record);
  else
    trace(study, std::move(*start), record);
  check_points(record);
  write(study, record);
}

}  // namespace
}  // namespace arcwall::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider provider(data, size);
  const std::string text = arcwall::fuzz::mutated_deck(provider);
  static const bool show = std::getenv("ARCWALL_FUZZ_SHOW") != nullptr;
  if (show) std::cout << text << std::flush;
  try {
    arcwall::fuzz::follow(text);
  } catch (const arcwall::InputError& error) {
    if (show)
      for (const auto& diagnostic : error.diagnostics()) std::cout << "# " << to_text(diagnostic) << "\n";
  }
  return 0;
}
