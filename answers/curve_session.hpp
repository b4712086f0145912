#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "answers/curve_tracing.hpp"
#include "model/run_description.hpp"
#include "model/session.hpp"

namespace arcwall {

/// A deck with a `[curve]` and the curve of its event, traced point by point. Like a Session it can be kept as bytes
/// and taken up again, and goes on to the last bit as if it had never stopped.
class CurveSession {
 public:
  /// Reads the deck. Throws InputError where it is wrong, or has no curve that could be followed.
  explicit CurveSession(RunDescription description);

  const RunDescription& description() const { return description_; }
  const deck::Deck& deck() const { return deck_; }

  /// The curve and what it is of; see there.
  CurveTracing& tracing() { return *tracing_; }
  const CurveTracing& tracing() const { return *tracing_; }

  /// Bytes from which the curve can be taken up where it is; `stopped` is the reason from outside for which it ends
  /// here, if there is one.
  std::string checkpoint(const std::optional<BranchEnd>& stopped = {}) const;

  /// The session of a checkpoint. Throws OutputError, which names `file`, for bytes that are none of a curve of this
  /// program.
  static CurveSession from(std::string_view checkpoint, const std::string& file, Session::Resume how);

 private:
  friend class CurveContent;

  RunDescription description_;
  deck::Deck deck_;
  std::unique_ptr<CurveTracing> tracing_;
};

/// What the checkpoint in a folder is of: a run, or a curve of events.
using StoredTracing = std::variant<Session, CurveSession>;

/// Throws OutputError if there is none or it cannot be read.
StoredTracing stored_tracing(const std::filesystem::path& folder, Session::Resume how);

}  // namespace arcwall
