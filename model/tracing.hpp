#pragma once

#include <memory>
#include <vector>

#include "continuation/trace_options.hpp"
#include "model/checkpoint/archive.hpp"
#include "model/model.hpp"
#include "model/path_answers.hpp"
#include "model/record.hpp"
#include "model/run_description.hpp"

namespace arcwall {

/// The paths of a model, traced point by point into a record.
class Tracing {
 public:
  virtual ~Tracing() = default;

  /// One more point. False when all branches have ended, and the record says how.
  virtual bool advance() = 0;

  /// Whether that is so.
  virtual bool has_ended() const = 0;

  /// Ends everything where it is; the next advance() records that.
  virtual void stop(const BranchEnd& end) = 0;

  /// Has branches traced from these equilibria of the model, in this order, where all others have ended. Before the
  /// first advance(); nothing in load increments and of decks with stages.
  virtual void trace_also(std::vector<BranchStart> found) { static_cast<void>(found); }

  /// Visits all that changes but the record, which holds what was traced so far.
  virtual void serialize(ArchiveWriter& archive) = 0;
  virtual void serialize(ArchiveReader& archive) = 0;
};

/// Along the equations' path, or in the deck's load increments. `model`, `record` and `answers` must outlive it.
std::unique_ptr<Tracing> make_tracing(Model& model, Record& record, const State& start, StepLedger ledger,
                                      const Answers& answers);

}  // namespace arcwall
