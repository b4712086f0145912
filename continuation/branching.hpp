#pragma once

#include <optional>
#include <vector>

#include "continuation/corrector.hpp"
#include "continuation/path_point.hpp"
#include "continuation/segment.hpp"

namespace arcwall {

/// Finds where K becomes singular between two points of an arc although λ does not turn there.
class BranchPointLocator {
 public:
  /// Both must outlive this.
  BranchPointLocator(const System& system, Corrector& corrector) : system_(system), corrector_(corrector) {}

  /// `before` and `after`: negative eigenvalues at the segment's ends, not equal. Gives a point inside the segment;
  /// `out.localised` says how surely. Where no mode can be computed, `out.mode` stays empty. Empty if the ends do not
  /// seem to belong to one arc.
  std::optional<PathPoint> locate(const Segment& segment, const Metric& metric, Index before, Index after,
                                  BranchPoint& out);

 private:
  struct Sample {
    State state;
    Direction tangent;
    double eigenvalue;
    int iterations;
  };
  struct Estimate {
    double t;            // as a fraction of the segment
    double uncertainty;  // likewise
    PathPoint point;
  };
  Estimate bisect(const Segment& segment, const Metric& metric, Index order, bool falls);
  std::optional<Estimate> interpolate(const Segment& segment, const Metric& metric, double t, double spread,
                                      Index order);
  std::optional<Sample> sample_at(const Segment& segment, const Metric& metric, double t, Index order);
  std::optional<Sample> sampled(CorrectorResult at, const Metric& metric, const Direction& forward, Index order);

  const System& system_;
  Corrector& corrector_;
  struct Seen {
    double t;
    Sample sample;
  };
  std::vector<Seen> seen_;  // on the segment under way
};

/// A first point on a bifurcated branch.
struct SteppedOff {
  State state{};
  Direction tangent{};  ///< away from the branch point, of unit length
};

/// Leaves the branch point along ± its other tangent by a distance near `distance`; halves it while a guard is violated
/// by more than the tolerance or the step falls back onto the old branch.
std::optional<SteppedOff> step_off(const System& system, Corrector& corrector, const Metric& metric,
                                   const BranchPoint& point, int sign, double distance, double guard_tolerance);

}  // namespace arcwall
