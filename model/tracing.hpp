#pragma once

#include <memory>

#include "model/checkpoint/archive.hpp"
#include "model/model.hpp"
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

  /// Visits all that changes but the record, which holds what was traced so far.
  virtual void serialize(ArchiveWriter& archive) = 0;
  virtual void serialize(ArchiveReader& archive) = 0;
};

/// Along the equations' path, or in the deck's load increments. `model` and `record` must outlive it.
std::unique_ptr<Tracing> make_tracing(Model& model, Record& record, const State& start, StepLedger ledger);

}  // namespace arcwall
