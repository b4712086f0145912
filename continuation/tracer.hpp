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

/// Traces one branch of an equilibrium path, one step (arc) a call.
///
///     Tracer tracer(system, start, options);
///     while (const auto arc = tracer.next()) use(*arc);
///     explain(*tracer.end());
class Tracer {
 public:
  /// `system` must outlive this. `start` is an equilibrium, or close to one. `watched`: monitors whose turning points
  /// are events.
  Tracer(const System& system, BranchStart start, TraceOptions options, std::vector<Watch> watched = {});
  Tracer(const System& system, State start, TraceOptions options, std::vector<Watch> watched = {})
      : Tracer(system, BranchStart{.state = std::move(start)}, std::move(options), std::move(watched)) {}
  ~Tracer();

  /// Returns the next arc; the first has length zero and the `start` event. Empty when the branch has ended: see end().
  std::optional<Arc> next();

  /// Returns the reason of the end; empty before the end.
  const std::optional<BranchEnd>& end() const { return state_.end; }

  /// Ends the branch at its last point (time limit, interrupt).
  void stop(BranchEnd end) { state_.end = std::move(end); }

  /// Returns λ₀ of the path metric; theory section 3. It changes once where the structure does not move at the start.
  double lambda_scale() const { return state_.lambda_scale; }

  /// Returns the start point of the next step: the last accepted point, or one just after a change of the layout.
  const PathPoint& here() const { return state_.from.point; }

  /// Returns the point before here() on the same smooth arc, without its eigenpairs. Empty at the start and after a
  /// change of the active set.
  const std::optional<PathPoint>& before() const { return state_.from.before; }

  /// Writes or reads the whole variable state by `archive(values…)`; `Archive::reads` is true for reading. A tracer
  /// with the same system and options continues with bit-identical results.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(state_);
    archive.require(is_of_this_branch(state_));
  }

 private:
  bool is_of_this_branch(const TracerState& state) const;
  void set_detectors();
  void measure_lambda_scale();
  std::optional<Arc> begin();

  std::unique_ptr<TraceTools> tools_;
  std::vector<Watch> watched_;
  TracerState state_;
};

}  // namespace arcwall
