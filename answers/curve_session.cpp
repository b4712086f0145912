#include "answers/curve_session.hpp"

#include <utility>

#include "answers/deck_answers.hpp"
#include "core/error.hpp"
#include "model/checkpoint/archive.hpp"
#include "model/checkpoint/checkpoint_file.hpp"
#include "model/checkpoint/parts.hpp"
#include "model/deck/reader.hpp"
#include "model/session_content.hpp"
#include "model/version.hpp"

namespace arcwall {

using Json = nlohmann::json;

namespace {

deck::Deck deck_with_curve(const RunDescription& description) {
  deck::Deck deck = deck::read_deck_text(description.deck_text, description.deck, description.assignments);
  if (deck.curve && !deck.curve->parameter.empty()) return deck;
  throw InputError({Diagnostic{.file = description.deck,
                               .key = "curve",
                               .message = "the deck does not say which event is followed",
                               .cure = "add a table [curve] with event, parameter and range"}});
}

ArchiveModel model_of(const CurveTracing& tracing) {
  const Model& model = tracing.family().own();
  ArchiveModel result{.system = &model.system()};
  if (const SlidingContact* sliding = model.sliding()) result.sliding.push_back(sliding);
  return result;
}

}  // namespace

/// A curve's session as the content of its checkpoint, and back.
class CurveContent {
 public:
  static Json of(const CurveSession& session, const std::optional<BranchEnd>& stopped);
  static CurveSession read(const Json& content, const std::string& file, Session::Resume how);
};

CurveSession::CurveSession(RunDescription description)
    : description_(std::move(description)),
      deck_(deck_with_curve(description_)),
      tracing_(std::make_unique<CurveTracing>(deck_)) {
  description_.traced = Traced::curve;
}

std::string CurveSession::checkpoint(const std::optional<BranchEnd>& stopped) const {
  return to_checkpoint(CurveContent::of(*this, stopped));
}

CurveSession CurveSession::from(std::string_view checkpoint, const std::string& file, Session::Resume how) {
  return CurveContent::read(from_checkpoint(checkpoint, file), file, how);
}

Json CurveContent::of(const CurveSession& session, const std::optional<BranchEnd>& stopped) {
  ArchiveWriter archive(model_of(*session.tracing_));
  std::string program = program_version();
  RunDescription description = session.description_;
  std::optional<BranchEnd> ending = stopped;
  archive(program, description, ending);
  session.tracing_->serialize(archive);
  return archive.json();
}

CurveSession CurveContent::read(const Json& content, const std::string& file, Session::Resume how) {
  try {
    RunDescription description = described_in(content, file);
    if (description.traced != Traced::curve) throw OutputError(file + ": is of a run, not of a curve of events");
    CurveSession session(std::move(description));
    ArchiveReader archive(content, model_of(*session.tracing_));
    std::string program;
    std::optional<BranchEnd> stopped;
    archive(program, session.description_, stopped);
    session.tracing_->serialize(archive);
    archive.require(archive.at_end());
    if (stopped && how == Session::Resume::as_ended) session.tracing_->stop(*stopped);
    return session;
  } catch (const BadArchive& problem) {
    throw OutputError(file + ": is no checkpoint of this deck: " + problem.what() + "; trace the curve again");
  }
}

StoredTracing stored_tracing(const std::filesystem::path& folder, Session::Resume how) {
  const std::string file = (folder / "checkpoint").string();
  const Json content = from_checkpoint(bytes_of_checkpoint(folder), file);
  if (described_in(content, file).traced == Traced::curve) return CurveContent::read(content, file, how);
  return SessionContent::read(content, file, how, deck_answers());
}

}  // namespace arcwall
