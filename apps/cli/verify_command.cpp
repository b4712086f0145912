#include <filesystem>
#include <iostream>

#include "answers/curve_session.hpp"
#include "apps/cli/commands.hpp"
#include "apps/verify/again.hpp"
#include "apps/verify/copies.hpp"
#include "apps/verify/curve_checks.hpp"
#include "apps/verify/verify.hpp"
#include "core/error.hpp"
#include "model/regular_file.hpp"

namespace arcwall {

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw OutputError(file.string() + ": there is none; trace-path resume writes what a run lacks");
  return bytes_of_regular_file(file);
}

// A first step of a quarter, the greatest step likewise: the events must be the same.
ExitStatus trace_again(const Session& run, const std::string& folder, bool quiet) {
  if (run.model().in_increments()) {
    std::cerr << "note: " << folder
              << " holds load increments, whose results depend on their steps; not traced again\n";
    return ExitStatus::success;
  }
  const std::optional<Session> again = verify::traced_again(run);
  if (!again) {
    std::cerr << "error: " << folder << ": with a quarter of the step there is no equilibrium at the start\n";
    return ExitStatus::not_confirmed;
  }
  const verify::Comparison comparison =
      verify::compare(run.record(), again->record(), verify::step_discretisation(run.model()));
  for (const std::string& difference : comparison.differences)
    std::cerr << "error: " << folder << ": " << difference << "\n";
  if (!quiet) std::cout << "\n" << to_text(comparison, "with a quarter of the step");
  return comparison.differences.empty() ? ExitStatus::success : ExitStatus::not_confirmed;
}

// Says what does not hold; the table otherwise.
bool tell(const verify::Verdict& verdict, const std::filesystem::path& folder, bool quiet) {
  if (const auto& first = verdict.findings.first()) {
    std::cerr << "error: " << folder.string() << "/" << to_text(*first) << "\n";
    if (verdict.findings.failures() > 1)
      for (const verify::CheckSummary& check : verdict.findings.checks())
        if (check.failures > 0)
          std::cerr << "  failed: " << check.name << ", " << check.failures << " of " << check.count << "\n";
    return false;
  }
  if (!quiet) std::cout << to_text(verdict);
  return true;
}

ExitStatus verify_curve(const CurveSession& session, const std::filesystem::path& folder, const Options& options) {
  const verify::StoredCurve files{.curve_csv = text_of(folder / "curve.csv"),
                                  .curve_json = text_of(folder / "curve.json")};
  const bool quiet = options.has("quiet");
  if (!tell(verify::verify_curve(session, files), folder, quiet)) return ExitStatus::not_confirmed;
  if (!options.has("again")) return ExitStatus::success;
  const verify::Comparison comparison = verify::compare_with_runs(session);
  for (const std::string& difference : comparison.differences)
    std::cerr << "error: " << folder.string() << ": " << difference << "\n";
  if (!quiet) std::cout << "\n" << to_text(comparison, "in runs of the deck with the number's values");
  return comparison.differences.empty() ? ExitStatus::success : ExitStatus::not_confirmed;
}

ExitStatus verify_run(const Session& run, const std::filesystem::path& folder, const Options& options) {
  const verify::StoredFiles files{.path_csv = text_of(folder / "path.csv"),
                                  .contacts_csv = run.record().has_walls ? text_of(folder / "contacts.csv") : "",
                                  .events_json = text_of(folder / "events.json"),
                                  .result_json = text_of(folder / "result.json"),
                                  .deck_toml = text_of(folder / "deck.toml")};
  verify::Verdict verdict = verify::verify(run.model(), run.record(), files, "checkpoint");
  verify::check_copies(run.model(), run.record(), run.description(), files, verdict.findings);
  if (!tell(verdict, folder, options.has("quiet"))) return ExitStatus::not_confirmed;
  return options.has("again") ? trace_again(run, folder.string(), options.has("quiet")) : ExitStatus::success;
}

ExitStatus verify_folder(const Options& options) {
  const std::filesystem::path folder = options.words().front();
  const StoredTracing stored = stored_tracing(folder, Session::Resume::as_ended);
  if (const auto* const curve = std::get_if<CurveSession>(&stored)) return verify_curve(*curve, folder, options);
  return verify_run(std::get<Session>(stored), folder, options);
}

}  // namespace

Command verify_command() {
  return {
      .description =
          {.name = "verify",
           .example = "trace-path verify results",
           .usage = "DIR [options]",
           .summary = "check stored results of a run or a curve with independent formulas",
           .options =
               {{"again", "",
                 "also trace the deck with a quarter of the step and compare the events; of a curve, trace the deck at "
                 "some of its points"},
                {"quiet", "", "no table, the status alone (7 where something does not hold)"}},
           .least_words = 1,
           .most_words = 1},
      .run = verify_folder};
}

}  // namespace arcwall
