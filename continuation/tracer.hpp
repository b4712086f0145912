#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "continuation/trace_options.hpp"
#include "continuation/tracer_state.hpp"
#include "core/system.hpp"

namespace arcwall {

struct TraceTools;

/// Traces one branch arc by arc, from a state on the path.
///
///     Tracer tracer(system, start, options);
///     while (const auto arc = tracer.next()) use(*arc);
///     explain(*tracer.end());
class Tracer {
 public:
  /// `system` must outlive this; the start solves its equations or nearly so.
  Tracer(const System& system, BranchStart start, TraceOptions options, std::vector<Watch> watched = {});
  Tracer(const System& system, State start, TraceOptions options, std::vector<Watch> watched = {})
      : Tracer(system, BranchStart{.state = std::move(start)}, std::move(options), std::move(watched)) {}
  ~Tracer();

  /// The next arc; the first has length zero and carries the `start` event. Empty when the branch has ended: see end().
  std::optional<Arc> next();

  /// Why the branch ended; empty while it goes on.
  const std::optional<BranchEnd>& end() const { return state_.end; }

  /// Ends the branch where it is (a time limit, an interrupt).
  void stop(BranchEnd end) { state_.end = std::move(end); }

  /// λ₀ of the path metric.
  double lambda_scale() const { return state_.lambda_scale; }

  /// The point that the next step leaves: the last accepted one, or one near the beginning of a piece entered there.
  const PathPoint& here() const { return state_.from.point; }

  /// The one before it on the same smooth arc, without its eigenpairs; empty behind a change of contacts and at the
  /// start.
  const std::optional<PathPoint>& before() const { return state_.from.before; }

  /// Visits all that changes while the branch is traced: `archive(values…)` writes or reads them, `Archive::reads` says
  /// which. A tracer of the same system and options into which they are read goes on to the same last bit.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(state_);
    archive.require(is_of_this_branch(state_));
  }

 private:
  bool is_of_this_branch(const TracerState& state) const;
  std::optional<Arc> begin();

  std::unique_ptr<TraceTools> tools_;
  TracerState state_;
};

}  // namespace arcwall
