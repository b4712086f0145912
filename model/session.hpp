#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "continuation/trace_options.hpp"
#include "model/model.hpp"
#include "model/record.hpp"
#include "model/run_description.hpp"

namespace arcwall {

class Answers;
class Tracing;

/// Owns a deck, its model and the run that traces its paths point by point. Sessions share no data: several may run at
/// once, each in its own thread. A resumed run has bit-identical results.
class Session {
 public:
  /// Builds the model of a deck. `answers` answers what the deck asks of its run besides the paths and must outlive the
  /// session: answers/sessions.hpp makes sessions with all answers. Throws InputError with all errors of the deck.
  Session(RunDescription description, const Answers& answers);

  Session(Session&& other) noexcept;
  Session& operator=(Session&& other) noexcept;
  ~Session();

  /// Computes the equilibrium at the start. Returns false if there is none: see problem(). No effect on a run that has
  /// begun.
  bool begin();

  /// Adds disconnected branches from equilibria of this model, traced in this order after all others. Call it after
  /// begin() and before next(). Checkpoints omit them.
  void trace_also(std::vector<BranchStart> found);

  /// Returns why begin() found no equilibrium; empty if it found one or was not called.
  const std::string& problem() const { return problem_; }

  /// Traces one more point and returns it, valid until the next call. Null when all branches have ended or there is no
  /// start. Calls begin() if needed.
  const RecordPoint* next();

  /// Returns true if all branches have ended.
  bool has_ended() const;

  /// Ends all branches at their last points; the next call of next() records it. No effect on a run that has not begun.
  /// Jumps are not computed at this end, but at the end of the resumed run. checkpoint() omits it except for its
  /// argument.
  void stop(const BranchEnd& end);

  const RunDescription& description() const { return description_; }
  const Model& model() const { return *model_; }

  /// Returns all branches, points and events traced so far.
  const Record& record() const { return *record_; }
  const std::vector<RecordPoint>& points() const { return record_->points; }
  const std::vector<RecordEvent>& events() const { return record_->events; }

  /// Returns bytes from which the run can be resumed. `stopped`: end imposed from outside; may be empty. Requires that
  /// begin() returned true.
  std::string checkpoint(const std::optional<BranchEnd>& stopped = {});

  enum class Resume {
    go_on,     ///< continue from the last point
    as_ended,  ///< restore the end at which the run was stopped
  };

  /// Returns the session of a checkpoint. Throws OutputError, which names `file`, if the bytes are not readable by this
  /// version.
  static Session from(std::string_view checkpoint, const std::string& file, Resume how, const Answers& answers);

 private:
  friend class SessionContent;

  RunDescription description_;
  const Answers* answers_;
  std::unique_ptr<Model>
      model_;  // it and the record keep their places when the session moves: the tracing refers to them
  std::unique_ptr<Record> record_;
  State start_{};
  std::string problem_{};
  std::unique_ptr<Tracing> tracing_;
  bool stopped_ = false;  // from outside: nothing that takes long is done at the end
};

}  // namespace arcwall
