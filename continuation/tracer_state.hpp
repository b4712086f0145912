#pragma once

#include <optional>
#include <vector>

#include "continuation/corners/visited_corner.hpp"
#include "continuation/events/singular_point.hpp"
#include "continuation/events/value_point.hpp"
#include "continuation/step/landed_guard.hpp"
#include "continuation/trace_options.hpp"

namespace arcwall {

/// A point that the next step leaves, and what is known just behind it. It is the last accepted one; behind a
/// transition to an active set that begins with a new span it lies near the beginning of that active set.
struct Departure {
  PathPoint point{};
  std::optional<PathPoint> before{};              ///< the last point on the same smooth arc, without its eigenpairs
  Vector eigenvalues_before{};                    ///< there, of the modes of `point`; NaN where a mode was not known
  NearNull last_pairs{};                          ///< where `point` has no eigenpairs: those that were known last
  std::vector<int> signs{};                       ///< of each detector just behind `point`
  std::optional<Index> negative_eigenvalues{};    ///< just behind `point`, with all closed contacts held
  StabilityCount count_after{};                   ///< just behind `point`
  Index zero_eigenvalues = 0;                     ///< at `point`
  std::vector<SingularPoint> pending_singular{};  ///< located with `point` and just behind it: the next points
  std::optional<Landing> passed_bound{};   ///< `point` lies a little beyond this validity bound of its active set
  std::optional<PathPoint> known_end{};    ///< of the next step: the first point of an active set that was entered
  std::vector<ValuePoint> values_ahead{};  ///< the next points, between a change of contact and such an active set
  std::optional<PathPoint> begin{};        ///< of that active set, behind those points

  /// The eigenpairs nearest zero that were known last.
  const NearNull& nearest() const { return point.nearest.values.size() > 0 ? point.nearest : last_pairs; }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(point, before, eigenvalues_before, last_pairs, signs, negative_eigenvalues, count_after, zero_eigenvalues,
            pending_singular, passed_bound, known_end, values_ahead, begin);
    archive.require(values_ahead.empty() || begin);
    archive.require(!before || eigenvalues_before.size() == point.nearest.values.size());
  }
};

/// Everything that varies while a branch is traced. Written and read by an archive this is the checkpoint: a tracer of
/// the same system and options into which it is read goes on to the same last bit.
struct TracerState {
  double lambda_scale = 1.0;             ///< λ₀ of the path metric
  bool lambda_scale_is_assumed = false;  ///< the structure has not moved yet
  BranchStart start{};
  StepControl step{StepOptions{}, StepOptions{}.max};
  Departure from{};
  std::vector<VisitedCorner> visited{};
  std::optional<BranchEnd> end{};
  int points = 0;                    ///< accepted
  double greatest_lambda = 0.0;      ///< the greatest |λ| of these
  int corners_without_progress = 0;  ///< changes of contacts in a row at one place

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(lambda_scale, lambda_scale_is_assumed, start, step, from, visited, end, points, greatest_lambda,
            corners_without_progress);
  }
};

}  // namespace arcwall
