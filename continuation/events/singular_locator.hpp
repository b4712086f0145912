#pragma once

#include <array>
#include <optional>
#include <vector>

#include "continuation/path_point.hpp"
#include "continuation/segment.hpp"
#include "continuation/stability.hpp"
#include "continuation/step/corrector.hpp"

namespace arcwall {

/// A place of an arc where K is singular, or λ′ zero, or nearly so.
struct SingularPlace {
  PathPoint point{};
  double t = 0.0;           ///< as a fraction of the segment's chord
  double half_width = 0.0;  ///< likewise, of what is left uncertain
  Index change = 0;         ///< of the number of negative eigenvalues across it
  Index multiplicity = 1;   ///< of the zero eigenvalue
  bool at_limit = false;    ///< λ turns there, too
  bool touches = false;     ///< zero is reached without a change of sign, as nearly as can be told
};

/// Finds where K becomes singular between two points of an arc although λ does not turn there.
class SingularLocator {
 public:
  /// What vanishes: an eigenvalue whose mode is no motion along the path, or λ′.
  enum class What { eigenvalue, turning };

  /// `corrector` must outlive this.
  explicit SingularLocator(Corrector& corrector) : corrector_(corrector) {}

  /// The first places, in their order, where the number of negative eigenvalues changes: `before` and `after` at the
  /// segment's ends, not equal, λ not turning. Empty if the ends do not seem to belong to one arc; shorter steps will
  /// show more.
  std::vector<SingularPlace> changes(const Segment& segment, const Metric& metric, Index before, Index after);

  /// The places where something comes to zero and goes back, or two eigenvalues pass zero in opposite senses: one place
  /// that touches, or two in order. None if it stays clear of zero. `from_singular`: the segment's start is singular,
  /// which does not count. `noise`: values below this have no sign. Nothing if the search fails.
  std::optional<std::vector<SingularPlace>> touches(const Segment& segment, const Metric& metric, What what,
                                                    bool from_singular, double noise);

 private:
  struct Sample {
    double t;
    State state;
    Direction tangent;
    int iterations;
    std::optional<Index> negative;
  };
  struct Bracket {
    double from = 0.0, to = 1.0;
    Index before, after;
  };
  class Level;
  std::optional<Sample> sample_at(const Segment& segment, const Metric& metric, double t);
  std::optional<Bracket> bisect(const Segment& segment, const Metric& metric, Index before, Index after);
  std::optional<Level> level_at(const Segment& segment, const Metric& metric, double centre, double spread, What what,
                                Index order);
  Matrix critical_modes(const Sample& sample, const Metric& metric) const;
  std::optional<Matrix> test_matrix(const Sample& sample, const Metric& metric, What what, Index order, Matrix& modes);
  std::vector<SingularPlace> roots(const Level& level, const Segment& segment, const Metric& metric,
                                   const Bracket& bracket) const;
  std::vector<SingularPlace> nearest_sample(const Bracket& bracket) const;
  bool lies_on_path(const PathPoint& point, const Metric& metric);

  Corrector& corrector_;
  std::vector<Sample> seen_;  // on the segment under way
};

}  // namespace arcwall
