#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "apps/cli/commands.hpp"
#include "apps/cli/interrupt.hpp"
#include "apps/converge/convergence.hpp"
#include "apps/converge/convergence_files.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/files.hpp"
#include "apps/output/result_json.hpp"
#include "core/error.hpp"
#include "model/deck/given_points.hpp"
#include "model/deck/reader.hpp"

namespace arcwall {

namespace {

constexpr int most_levels = 8;

// At least `least` and at most `most`.
int count_of(const Options& options, const std::string& name, int otherwise, int least, int most) {
  const int count = options.count(name).value_or(otherwise);
  if (count < least || count > most)
    throw InputError(fmt::format("--{} {} is out of range; give a number from {} to {}", name, count, least, most));
  return count;
}

// The status of the first branch that did not end as its deck says.
ExitStatus status_of(const Convergence& study) {
  for (const MeshRun& mesh : study.meshes) {
    if (!mesh.problem.empty()) {
      std::cerr << fmt::format("error: with {} times the elements there is no equilibrium at the start: {}\n",
                               mesh.times, mesh.problem);
      return ExitStatus::no_start;
    }
    for (const RecordBranch& branch : mesh.record.branches) {
      const ExitStatus status = branch.end ? exit_status(branch.end->reason) : ExitStatus::success;
      if (status == ExitStatus::success) continue;
      std::cerr << fmt::format("note: with {} times the elements branch {} ended early: {}\n", mesh.times, branch.id,
                               how_it_ended(*branch.end));
      return status;
    }
  }
  return ExitStatus::success;
}

ExitStatus converge(const Options& options) {
  const std::string& file = options.words().front();
  const std::vector<std::string> assignments = options.texts("set");
  const std::string text = deck::read_deck_file(file);
  const deck::Deck deck = deck::read_deck_text(text, file, assignments);
  const InterruptGuard interrupts;
  MeshStudy study{.levels = count_of(options, "levels", 3, 2, most_levels),
                  .factor = count_of(options, "factor", 2, 2, 10)};
  const bool quiet = options.has("quiet");
  study.begins = [quiet](const MeshRun& run) {
    if (!quiet) std::cerr << fmt::format("note: tracing with {} times the elements\n", run.times);
  };
  study.stopped = [&interrupts] { return interrupts.interrupted(); };
  const std::filesystem::path out = options.text("out").value_or(std::filesystem::path(file).stem().string());
  require_other_than_input(out, file);
  const DeckIdentity identity(std::filesystem::path(file).filename().string(), whole_path(file), crc32_text(text));
  const std::string replaced = note_of_replaced(out, identity);
  const OutputFolder folder(out, identity, options.has("force") ? Foreign::overwrite : Foreign::refuse);
  if (!replaced.empty()) std::cerr << "note: " << replaced << "\n";
  const auto found = arcwall::converge(deck, study);
  if (!found) return ExitStatus::interrupted;
  FileSet files(folder);
  files.write("convergence.txt", convergence_text(*found));
  files.write("convergence.json",
              to_text(convergence_json(*found, {.text = text, .path = identity.path, .assignments = assignments}),
                      JsonLayout::lines));
  files.put_in_place();
  if (!quiet) std::cout << convergence_text(*found);
  return status_of(*found);
}

}  // namespace

Command converge_command() {
  return {
      .description = {.name = "converge",
                      .example = "trace-path converge channel.toml --levels 4",
                      .usage = "DECK [options]",
                      .summary = "estimate the mesh error of event loads from several meshes",
                      .options = {{"levels", "N", "number of meshes, 2 to 8 (default: 3)"},
                                  {"factor", "F", "ratio of elements from one mesh to the next, 2 to 10 (default: 2)"},
                                  {"out", "DIR", "folder to write into (default: the deck's name without its ending)"},
                                  {"force", "", "overwrite a folder that holds other files"},
                                  {"quiet", "", "print neither progress nor tables"},
                                  set_option()},
                      .least_words = 1,
                      .most_words = 1},
      .run = converge};
}

}  // namespace arcwall
