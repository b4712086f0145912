#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "continuation/path_point.hpp"
#include "continuation/trace_options.hpp"
#include "model/model.hpp"
#include "model/record.hpp"
#include "model/stages.hpp"

namespace arcwall {

class ArchiveReader;
class ArchiveWriter;

/// Stores a jump at constant λ.
struct Fall {
  std::shared_ptr<const RecordJump> jump{};  ///< as an event has it, without a traced branch and a return
  std::optional<State> state{};              ///< stable equilibrium where it ends; empty: none, or two are possible
};

/// Answers what a deck asks of the paths of one model besides their points. The tracing asks while it traces; the
/// library `answers` above this one knows.
class PathAnswers {
 public:
  virtual ~PathAnswers() = default;

  /// Returns the jump from an event at which a stable structure loses its stability; `behind`: its path behind the
  /// event.
  virtual Fall fall(const Event& lost, const PathPoint& behind) = 0;

  /// Returns the derivatives of an event at the end of an arc by the numbers that the deck names.
  virtual std::vector<RecordSensitivity> sensitivities(const Arc& arc, const Event& event) = 0;

  /// Returns the end of the record's last branch if its last step came back to known states; else empty.
  virtual std::optional<BranchEnd> end_of_branch() = 0;

  /// Returns the start of one more branch, once all branches of the record have ended; empty if none is known.
  virtual std::optional<BranchStart> next_start() = 0;

  /// Visits all that changes but the record.
  virtual void serialize(ArchiveWriter& archive) = 0;
  virtual void serialize(ArchiveReader& archive) = 0;
};

/// Answers what decks ask of their runs.
class Answers {
 public:
  virtual ~Answers() = default;

  /// Returns the answers of a model's paths. `model` and `record` must outlive them. `ended_stages`: how the stages
  /// before the model's have ended.
  virtual std::unique_ptr<PathAnswers> of_paths(const Model& model, Record& record,
                                                std::vector<StageEnd> ended_stages) const = 0;

  /// Adds to the record of a run that has ended what only the whole run tells: its jumps.
  virtual void complete(const Model& model, Record& record) const = 0;
};

}  // namespace arcwall
