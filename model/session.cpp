#include "model/session.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "model/checkpoint/checkpoint_file.hpp"
#include "model/deck/reader.hpp"
#include "model/path_answers.hpp"
#include "model/record_parts.hpp"
#include "model/recorder.hpp"
#include "model/regular_file.hpp"
#include "model/session_content.hpp"
#include "model/tracing.hpp"
#include "model/version.hpp"

namespace arcwall {

using Json = nlohmann::json;

namespace {

// What was traced. The rest of a record follows from the deck.
template <typename Archive>
void keep_traced(Archive& archive, Record& record) {
  archive(record.branches, record.points, record.events, record.branch_points, record.searches, record.steps);
}

// Whether all that a jump refers to is in the record. One that was not found has no monitors.
bool is_whole(const Record& record, const RecordJump& jump) {
  const auto are_all = [&](const std::vector<double>& monitors) { return monitors.size() == record.columns.size(); };
  const bool has_none = jump.monitors.empty() && !jump.reason.empty();
  if (jump.point >= record.points.size() || !(are_all(jump.monitors) || has_none)) return false;
  if (jump.reason.empty() && jump.state.x.size() == 0) return false;
  if (jump.on_branch && (*jump.on_branch < 0 || *jump.on_branch >= static_cast<Index>(record.branches.size())))
    return false;
  if (jump.on_return &&
      (!are_all(jump.on_return->monitors) || (jump.on_return->jump && !is_whole(record, *jump.on_return->jump))))
    return false;
  return std::all_of(jump.destinations.begin(), jump.destinations.end(),
                     [&](const RecordJump& one) { return is_whole(record, one); });
}

bool is_whole(const Record& record, const RecordSearch& search) {
  return std::all_of(search.found.begin(), search.found.end(), [&](const RecordFound& found) {
    const auto is_there = [&](Index branch) {
      return branch >= 0 && branch < static_cast<Index>(record.branches.size());
    };
    return found.monitors.size() == record.columns.size() &&
           std::all_of(found.branches.begin(), found.branches.end(), is_there);
  });
}

// Whether all that a record refers to is in it.
bool is_whole(const Record& record, std::size_t ended_stages) {
  const auto has_branch = [&](Index branch) {
    return branch >= 0 && branch < static_cast<Index>(record.branches.size());
  };
  const auto has_event = [&](Index event) { return event >= 0 && event < static_cast<Index>(record.events.size()); };
  for (const RecordBranch& branch : record.branches)
    if ((branch.origin && !has_event(*branch.origin)) || branch.stage < 0 ||
        branch.stage > static_cast<Index>(ended_stages))
      return false;
  const auto are_all = [&](const std::optional<RecordRates>& rates) {
    return !rates || rates->monitors.size() == record.columns.size();
  };
  for (const RecordPoint& point : record.points)
    if (!has_branch(point.branch) || point.monitors.size() != record.columns.size() || !are_all(point.rates) ||
        !are_all(point.rates_after))
      return false;
  for (const RecordEvent& event : record.events)
    if (!has_branch(event.branch) || event.monitors.size() != record.columns.size() ||
        (event.jump && !is_whole(record, *event.jump)))
      return false;
  for (const RecordBranchPoint& point : record.branch_points)
    if (!has_event(point.event)) return false;
  return std::all_of(record.searches.begin(), record.searches.end(),
                     [&](const RecordSearch& search) { return is_whole(record, search); });
}

bool is_finite(const StageEnd& end) {
  return std::isfinite(end.lambda) && std::all_of(end.grips.begin(), end.grips.end(), [](const GripPlace& place) {
           return std::isfinite(place.x) && std::isfinite(place.z) && std::isfinite(place.rotation);
         });
}

ArchiveModel model_of(const Model& model) {
  ArchiveModel result{.system = &model.system()};
  for (std::size_t stage = 0; stage <= model.ended_stages().size(); ++stage) {
    const Model& here = model.at_stage(static_cast<Index>(stage));
    if (stage > 0) result.later.push_back(&here.system());
    if (const SlidingContact* sliding = here.sliding()) result.sliding.push_back(sliding);
  }
  return result;
}

}  // namespace

Session::Session(RunDescription description, const Answers& answers)
    : description_(std::move(description)),
      answers_(&answers),
      model_(std::make_unique<Model>(
          deck::read_deck_text(description_.deck_text, description_.deck, description_.assignments))),
      record_(std::make_unique<Record>(empty_record(*model_))) {}

Session::Session(Session&& other) noexcept = default;
Session& Session::operator=(Session&& other) noexcept = default;
Session::~Session() = default;

bool Session::begin() {
  if (tracing_) return true;
  std::optional<State> start = model_->start(problem_);
  if (!start) return false;
  start_ = std::move(*start);
  tracing_ = make_tracing(*model_, *record_, start_, description_.ledger, *answers_);
  return true;
}

const RecordPoint* Session::next() {
  if (!problem_.empty() || !begin()) return nullptr;
  const bool had_ended = tracing_->has_ended();
  if (tracing_->advance()) return &record_->points.back();
  if (!had_ended && !stopped_) answers_->complete(*model_, *record_);
  return nullptr;
}

void Session::trace_also(std::vector<BranchStart> found) {
  if (tracing_) tracing_->trace_also(std::move(found));
}

bool Session::has_ended() const { return tracing_ && tracing_->has_ended(); }

void Session::stop(const BranchEnd& end) {
  if (!tracing_) return;
  stopped_ = true;
  tracing_->stop(end);
}

std::string Session::checkpoint(const std::optional<BranchEnd>& stopped) {
  return to_checkpoint(SessionContent::of(*this, stopped));
}

Session Session::from(std::string_view checkpoint, const std::string& file, Resume how, const Answers& answers) {
  return SessionContent::read(from_checkpoint(checkpoint, file), file, how, answers);
}

Json SessionContent::of(Session& session, const std::optional<BranchEnd>& stopped) {
  ArchiveWriter archive(model_of(*session.model_));
  std::string program = program_version();
  std::optional<BranchEnd> ending = stopped;
  std::vector<StageEnd> ended_stages = session.model_->ended_stages();
  archive(program, session.description_, ending, session.start_, ended_stages);
  keep_traced(archive, *session.record_);
  session.tracing_->serialize(archive);
  return archive.json();
}

RunDescription described_in(const Json& content, const std::string& file) try {
  ArchiveReader head(content, ArchiveModel{});
  std::string program;
  head(program);
  if (program != program_version())
    throw OutputError(file + ": was written by version " + program + "; only that version can go on with it");
  RunDescription description;
  head(description);
  return description;
} catch (const BadArchive& problem) {
  throw OutputError(file + ": is no checkpoint of this deck: " + problem.what() + "; run the deck again");
}

Session SessionContent::read(const Json& content, const std::string& file, Session::Resume how,
                             const Answers& answers) {
  try {
    // What the run is of comes first: the rest can be read when its model is there.
    RunDescription description = described_in(content, file);
    if (description.traced == Traced::curve)
      throw OutputError(file + ": is of a curve of events, not of a run; trace-path resume and verify take it");
    Session session(std::move(description), answers);

    ArchiveReader archive(content, model_of(*session.model_));
    std::string program;
    std::optional<BranchEnd> stopped;
    std::vector<StageEnd> ended_stages;
    archive(program, session.description_, stopped, session.start_, ended_stages);
    for (const StageEnd& end : ended_stages) archive.require(is_finite(end) && session.model_->begin_stage(end));
    archive.set_stages(model_of(*session.model_));
    archive.require(session.start_.x.size() > 0);
    session.tracing_ =
        make_tracing(*session.model_, *session.record_, session.start_, session.description_.ledger, answers);
    keep_traced(archive, *session.record_);
    archive.require(is_whole(*session.record_, ended_stages.size()));
    session.tracing_->serialize(archive);
    archive.require(archive.at_end());
    if (stopped && how == Session::Resume::as_ended) {
      session.stop(*stopped);
      session.next();
    }
    return session;
  } catch (const BadArchive& problem) {
    throw OutputError(file + ": is no checkpoint of this deck: " + problem.what() + "; run the deck again");
  }
}

std::string bytes_of_checkpoint(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "checkpoint";
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) throw OutputError(folder.string() + ": there is no such folder");
  if (!std::filesystem::exists(file, ignored))
    throw OutputError(file.string() + ": there is none; `trace-path run DECK --out " + folder.string() + "` writes it");
  return bytes_of_regular_file(file);
}

}  // namespace arcwall
