#pragma once

#include <array>
#include <optional>

#include "elements/chord_frame.hpp"
#include "elements/element.hpp"
#include "elements/slender_beam.hpp"

namespace arcwall {

/// Order of convergence of an elastica element: its angle is quadratic or cubic along the axis.
enum class ElasticaOrder { four, six };

/// Extensible elastica by a mixed element: the angle along the axis and a constant force vector, from which the axial
/// force follows; what of them the ends do not determine is eliminated inside (docs/theory.md, section 2.5).
///
/// Unknowns as in ClassicBeam. Where the inner Newton iteration finds no state (bends far above those of a sensible
/// mesh), energy and derivatives are NaN.
class ElasticaBeam final : public Element, public SlenderBeam {
 public:
  /// `taper`: of the section; the stiffnesses are those of its A and I.
  ElasticaBeam(const StretchReference& stretch, double EA, double EI, ElasticaOrder order,
               const std::optional<StretchTaper>& taper = {});

  int unknown_count() const override { return 6; }
  double evaluate(const double* u, double* f, double* K) const override;

  void respond(const BeamEnds& ends, bool with_rates, BeamResponse& out) const override;

  /// Between the ends positions have order 4 or 5, angles 3 or 4.
  BeamPlace place(const BeamEnds& ends, double xi) const override;

 private:
  static constexpr std::size_t points = 7;  // of Gauss's rule along the axis

  using Coefficients = Eigen::Matrix<double, 5, 1>;
  using Weights = Eigen::Matrix<double, 5, 5>;
  struct Potential;
  struct Solution;

  // Of the stress-free state by a material coordinate.
  struct Rate {
    double length = 0.0, chord = 0.0;
    Coefficients angle = Coefficients::Zero();
    double along = 0.0, across = 0.0;  // ∫ sin θ⁰ θ⁰′ and ∫ cos θ⁰ θ⁰′, θ⁰′ the rate of the angle
    std::array<double, points> softness{};  // of a at the points
    Weights bending = Weights::Zero();      // of W
  };

  using Vector7 = Eigen::Matrix<double, 7, 1>;
  using InnerGradient = Eigen::Matrix<double, 4, 3>;
  Potential potential(const ChordMotion& at, const Eigen::Vector4d& inner) const;
  Eigen::Vector4d first_guess(const ChordMotion& at) const;
  Solution solve(const ChordMotion& at) const;
  Solution condensed(const ChordMotion& at, const Eigen::Vector4d& inner, const Potential& potential,
                     const InnerGradient& minus_gradient) const;
  Eigen::Vector3d slope_rate(const ChordMotion& at, const Solution& solution, const Rate& rest) const;
  Vector7 taper_rate(const ChordMotion& at, const Solution& solution, const Rate& rest) const;
  void add_taper(const StretchReference& stretch);
  Eigen::Matrix<double, 5, 1> weighted(const Eigen::Matrix<double, 5, 1>& p) const;

  RestChord rest_;
  double length_;  // h, of the stress-free axis
  double EA_, EI_;
  bool cubic_;
  Coefficients angle_;                        // coefficients of the stress-free angle against its chord
  std::array<double, points> cosine_, sine_;  // of that angle at the points
  std::array<Rate, 2> rates_;
  std::optional<StretchTaper> taper_;
  std::array<double, 2> ends_;           // S1, S2
  std::array<double, points> softness_;  // a, at the points
  Weights bending_;                      // W
};

}  // namespace arcwall
