#pragma once

#include <filesystem>
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

class Tracing;

/// A deck, the model that it builds and the run that traces its paths, point by point. A session owns all of them and
/// shares nothing with other sessions, so that several may run at once, each in a thread of its own.
///
/// A run can be kept as bytes and taken up again; it then goes on to the last bit as if it had never stopped.
class Session {
 public:
  /// Reads the deck in a file and builds its model; `assignments` are texts `key=value` that replace values of it.
  /// Throws InputError with everything that is wrong with the deck.
  static Session open(const std::string& file, std::vector<std::string> assignments = {});

  /// The same for a deck in memory.
  explicit Session(RunDescription description);

  Session(Session&& other) noexcept;
  Session& operator=(Session&& other) noexcept;
  ~Session();

  /// Finds the equilibrium at which the paths start, without a point of them yet. False if there is none.
  /// A run that has begun goes on as it is.
  bool begin();

  /// Has branches traced from these equilibria too, in this order, where all others have ended: those that a search has
  /// found in another run of the deck. Their states are of this model. Behind begin(), before next(); a checkpoint does
  /// not keep them.
  void trace_also(std::vector<BranchStart> found);

  /// Why begin() found no equilibrium; empty if it found one, or has not been called.
  const std::string& problem() const { return problem_; }

  /// Traces one more point and returns it; null when every branch has ended or there is no start. Begins the run where
  /// begin() has not been called. The pointer is valid until the next call.
  const RecordPoint* next();

  /// Whether every branch has its end.
  bool has_ended() const;

  /// Ends every branch where it is; the next call of next() records that. A checkpoint does not know of it but for its
  /// argument. A run that has not begun has no branches, so that nothing happens. Where the structure falls to is not
  /// looked for at the end of such a run; whoever goes on with it has that at its own end.
  void stop(const BranchEnd& end);

  const RunDescription& description() const { return description_; }
  const Model& model() const { return *model_; }

  /// All that was traced so far: branches, points and events.
  const Record& record() const { return *record_; }
  const std::vector<RecordPoint>& points() const { return record_->points; }
  const std::vector<RecordEvent>& events() const { return record_->events; }

  /// Bytes from which the run can be taken up where it is; `stopped` is the reason from outside for which it ends here,
  /// if there is one. begin() has found a start.
  std::string checkpoint(const std::optional<BranchEnd>& stopped = {});

  enum class Resume {
    go_on,     ///< from where the run was stopped
    as_ended,  ///< with the end that it had when it was stopped
  };

  /// The session of a checkpoint. Throws OutputError, which names `file`, for bytes that are none of this program.
  static Session from(std::string_view checkpoint, const std::string& file, Resume how);

 private:
  friend class SessionContent;

  RunDescription description_;
  std::unique_ptr<Model>
      model_;  // it and the record keep their places when the session moves: the tracing refers to them
  std::unique_ptr<Record> record_;
  State start_{};
  std::string problem_{};
  std::unique_ptr<Tracing> tracing_;
  bool stopped_ = false;  // from outside: nothing that takes long is done at the end
};

/// The session whose files are in a folder, from its checkpoint. Throws OutputError if there is none or it cannot be
/// read.
Session stored_session(const std::filesystem::path& folder, Session::Resume how);

}  // namespace arcwall
