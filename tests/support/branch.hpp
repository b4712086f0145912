#pragma once

#include <vector>

#include "continuation/tracer.hpp"

namespace arcwall::test {

/// A traced branch, kept whole.
struct Branch {
  std::vector<Arc> arcs{};
  BranchEnd end{};
  double lambda_scale = 1.0;  ///< λ₀ of the path metric

  const PathPoint& last() const { return arcs.back().to; }
};

/// The system at rest: x = 0, λ = 0, all contacts open.
State rest(const System& system);

/// Traces until the branch ends; stops a branch of more than 20 000 points.
Branch trace(const System& system, const TraceOptions& options, const State& start, std::vector<Watch> watched = {});
Branch trace(const System& system, const TraceOptions& options, std::vector<Watch> watched = {});

/// All events in order, or those of one kind.
std::vector<Event> events_of(const Branch& branch);
std::vector<Event> events_of(const Branch& branch, EventKind kind);

/// The event of this kind; fails the test if there is not exactly one.
Event only_event(const Branch& branch, EventKind kind);

/// How exactly two runs shall agree.
struct SameEvents {
  double relative = 1e-8;                ///< of λ
  double at_displacement_limits = 1e-8;  ///< likewise, of their λ, which changes with the place at first order
};

/// The same kinds in the same order, with the same contacts, monitors and unstable counts, at the same λ.
void expect_same_events(const std::vector<Event>& found, const std::vector<Event>& expected,
                        const SameEvents& how = {});

/// A bound of λ that ends the branch.
TargetValue stop_at_lambda(double value);

}  // namespace arcwall::test
