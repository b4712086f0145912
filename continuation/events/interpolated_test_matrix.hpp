#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "continuation/path_point.hpp"
#include "continuation/segment.hpp"
#include "continuation/step/corrector.hpp"

namespace arcwall {

/// What vanishes at a singular place: an eigenvalue whose mode is no motion along the path, or λ′.
enum class Vanishing { eigenvalue, turning };

/// A point of the path inside a segment.
struct PathSample {
  double t = 0.0;  ///< as a fraction of the segment's chord
  State state{};
  Direction tangent{};
  int iterations = 0;
  double residual = 0.0;            ///< relative
  std::optional<Index> negative{};  ///< eigenvalues
};

/// A segment on which singular places are looked for, and the points of the path that were found inside it.
struct SegmentSamples {
  Corrector& corrector;
  const Segment& segment;
  const Metric& metric;
  std::vector<PathSample> seen{};
  Index pairs = 4;     ///< eigenpairs nearest zero that a test matrix is made of, at most
  Index changes = 1;   ///< how many eigenvalues change their sign
  bool turns = false;  ///< λ does
};

/// The path across the segment's chord at t, which is remembered. Empty where there is none, and where it lies so far
/// from the interpolated point that it belongs to another branch.
std::optional<PathSample> sample_at(SegmentSamples& on, double t);

/// Four points of the path around a place and, by the cubic through its values there, a smooth symmetric matrix S that
/// is singular in the places looked for. For branch points it is
///
///   S = (Cᵀ W K⁻¹ W C)⁻¹,     C = Q B,     Q = I − t_x t_xᵀ W/(1 + t_λ)                                         (1)
///
/// t the unit tangent, t_λ over λ₀ and not negative at the first point, B the critical modes at one of the points. Q
/// has the eigenvalue t_λ along t_x: at a limit point it takes out of K⁻¹ what is infinite there.
///
/// With a border, and where λ turns, it is made of eigenpairs (μ, φ), with limit points among its zeros:
///
///   S = (Bᵀ W Σ φ φᵀ/μ W B)⁻¹                                                                                   (2)
///
/// With a border it is μ itself where one alone changes its sign.
class InterpolatedTestMatrix {
 public:
  static constexpr std::size_t nodes = 4;

  InterpolatedTestMatrix(double centre, double spread, std::vector<PathSample> samples,
                         std::array<Matrix, nodes> values)
      : centre_(centre), spread_(spread), samples_(std::move(samples)), values_(std::move(values)) {}

  /// The middle of the samples, and the distance between two of them, both as fractions of the chord.
  double centre() const { return centre_; }
  double spread() const { return spread_; }

  /// Of S at t, ascending.
  Vector eigenvalues(double t) const;

  /// How fast the j-th of them changes by t, in magnitude.
  double rate(double t, Index j) const;

  /// How many of them are negative.
  Index negative(double t) const { return (eigenvalues(t).array() < 0.0).count(); }

  /// The path at t, interpolated likewise.
  PathPoint point(double t, const Metric& metric) const;

 private:
  std::array<double, nodes> weights(double t) const;

  double centre_, spread_;
  std::vector<PathSample> samples_;
  std::array<Matrix, nodes> values_;
};

/// S from four points around `centre`. Empty if one of them is not found. `order`: of a system with a border, that of
/// the one eigenvalue looked for, the least of all being the first; 0: the greatest negative one.
std::optional<InterpolatedTestMatrix> test_matrix_around(SegmentSamples& on, double centre, double spread,
                                                         Vanishing what, Index order);

}  // namespace arcwall
