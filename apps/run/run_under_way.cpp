#include "apps/run/run_under_way.hpp"

#include <fstream>
#include <iterator>

#include "apps/checkpoint/checkpoint_file.hpp"
#include "apps/checkpoint/parts.hpp"
#include "apps/deck/reader.hpp"
#include "apps/output/recorder.hpp"
#include "apps/output/version.hpp"
#include "core/error.hpp"

namespace arcwall {

using Json = nlohmann::json;

namespace {

// What was traced. The rest of a record follows from the deck.
template <typename Archive>
void keep_traced(Archive& archive, Record& record) {
  archive(record.branches, record.points, record.events, record.branch_points, record.steps);
}

// Whether all that a record refers to is in it.
bool is_whole(const Record& record) {
  const auto has_branch = [&](Index branch) {
    return branch >= 0 && branch < static_cast<Index>(record.branches.size());
  };
  const auto has_event = [&](Index event) { return event >= 0 && event < static_cast<Index>(record.events.size()); };
  for (const RecordBranch& branch : record.branches)
    if (branch.origin && !has_event(*branch.origin)) return false;
  for (const RecordPoint& point : record.points)
    if (!has_branch(point.branch) || point.monitors.size() != record.columns.size()) return false;
  for (const RecordEvent& event : record.events)
    if (!has_branch(event.branch) || event.monitors.size() != record.columns.size()) return false;
  for (const RecordBranchPoint& point : record.branch_points)
    if (!has_event(point.event)) return false;
  return true;
}

ArchiveModel model_of(const Study& study) { return {.system = &study.system(), .sliding = study.sliding()}; }

std::shared_ptr<Study> study_of(const RunDescription& run) {
  return std::make_shared<Study>(deck::read_deck_text(run.deck_text, run.deck, run.assignments));
}

}  // namespace

RunUnderWay::RunUnderWay(RunDescription description, std::shared_ptr<Study> study)
    : description_(std::move(description)),
      study_(study ? std::move(study) : study_of(description_)),
      record_(std::make_unique<Record>(empty_record(*study_))) {}

RunUnderWay::RunUnderWay(RunDescription description) : RunUnderWay(std::move(description), nullptr) {}

bool RunUnderWay::begin(std::string& reason) {
  std::optional<State> start = study_->start(reason);
  if (!start) return false;
  start_ = std::move(*start);
  tracing_ = make_tracing(*study_, *record_, start_, description_.ledger);
  return true;
}

bool RunUnderWay::advance() { return tracing_->advance(); }

bool RunUnderWay::has_ended() const { return tracing_->has_ended(); }

void RunUnderWay::stop(const BranchEnd& end) { tracing_->stop(end); }

std::string RunUnderWay::checkpoint(const std::optional<BranchEnd>& stopped) {
  ArchiveWriter archive(model_of(*study_));
  std::string program = program_version();
  std::optional<BranchEnd> ending = stopped;
  archive(program, description_, ending, start_);
  keep_traced(archive, *record_);
  tracing_->serialize(archive);
  return to_checkpoint(archive.json());
}

RunUnderWay RunUnderWay::from(std::string_view checkpoint, const std::string& file, Resume how) {
  return from_content(from_checkpoint(checkpoint, file), file, how);
}

RunUnderWay RunUnderWay::from_content(const Json& content, const std::string& file, Resume how,
                                      std::shared_ptr<Study> study) {
  try {
    // What the run is of comes first: the rest can be read when its model is there.
    ArchiveReader head(content, ArchiveModel{});
    std::string program;
    head(program);
    if (program != program_version())
      throw OutputError(file + ": was written by version " + program + "; only that version can go on with it");
    RunDescription description;
    std::optional<BranchEnd> stopped;
    head(description, stopped);
    RunUnderWay run(std::move(description), std::move(study));

    ArchiveReader archive(content, model_of(*run.study_));
    archive(program, run.description_, stopped, run.start_);
    archive.require(run.start_.x.size() > 0);
    run.tracing_ = make_tracing(*run.study_, *run.record_, run.start_, run.description_.ledger);
    keep_traced(archive, *run.record_);
    archive.require(is_whole(*run.record_));
    run.tracing_->serialize(archive);
    archive.require(archive.at_end());
    if (stopped && how == Resume::as_ended) {
      run.stop(*stopped);
      run.advance();
    }
    return run;
  } catch (const BadArchive& problem) {
    throw OutputError(file + ": is no checkpoint of this deck: " + problem.what() + "; run the deck again");
  }
}

RunUnderWay stored_run(const std::filesystem::path& folder, RunUnderWay::Resume how) {
  const std::filesystem::path file = folder / "checkpoint";
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    std::error_code ignored;
    throw OutputError(std::filesystem::is_directory(folder, ignored)
                          ? file.string() + ": there is none; `trace-path run DECK --out " + folder.string() +
                                "` writes it"
                          : folder.string() + ": there is no such folder");
  }
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) throw OutputError(file.string() + ": cannot be read");
  return RunUnderWay::from(bytes, file.string(), how);
}

}  // namespace arcwall
