#pragma once

#include <memory>
#include <utility>

#include "elements/classic_beam.hpp"
#include "elements/driven.hpp"
#include "elements/element.hpp"
#include "elements/slender_beam.hpp"

namespace arcwall {

/// The potential of a load that λ drives: factor(λ) · V(u).
class DrivenLoad final : public DrivenElement {
 public:
  /// `load`: V, which does not depend on λ.
  DrivenLoad(std::unique_ptr<const Element> load, const Driven& factor) : load_(std::move(load)), factor_(factor) {}

  int unknown_count() const override { return load_->unknown_count(); }
  double evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const override;
  void complete_end_forces(const double* u, double lambda, double* f) const override;

 private:
  std::unique_ptr<const Element> load_;
  Driven factor_;
};

/// Potential of a dead load q per length of the undeformed axis on a classic beam element:
///
///     V = −h q·[(r1 + r2)/2 + Δr⊥ (φ1 − φ2)/12]
///
/// with node displacements in r, the current chord Δr turned by +90° and end angles φ: the mean position of Hermite's
/// cubic. Unknowns as in ClassicBeam. Measured from the undeformed state.
class BeamDistributedLoad final : public Element {
 public:
  BeamDistributedLoad(const BeamReference& reference, const Vec2& load) : reference_(reference), load_(load) {}

  int unknown_count() const override { return 6; }
  double evaluate(const double* u, double* f, double* K) const override;

 private:
  BeamReference reference_;
  Vec2 load_;  // [force/length]
};

/// The same on a stretch between points that may slide, by where its ends are: r are places and φ the angles of the
/// axis' tangent, of which only the difference counts.
class StretchLoad {
 public:
  StretchLoad(const StretchReference& stretch, const Vec2& load)
      : length_(stretch.length), length_rate_(stretch.length_rate), load_(load) {}

  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// Derivatives are by (r1, φ1, r2, φ2).
  struct Response {
    double energy = 0.0;
    Vector6 force = Vector6::Zero();
    Matrix6 stiffness = Matrix6::Zero();
    std::array<Vector6, 2> force_rate{Vector6::Zero(), Vector6::Zero()};  ///< ∂force/∂S1, ∂force/∂S2
  };
  Response respond(const Vec2& r1, double angle1, const Vec2& r2, double angle2) const;

 private:
  double length_;
  std::array<double, 2> length_rate_;
  Vec2 load_;
};

/// The same for a bar: half of the load at each end. Unknowns as in Truss.
class TrussDistributedLoad final : public Element {
 public:
  /// `resultant` = load times the bar's undeformed length [force].
  explicit TrussDistributedLoad(const Vec2& resultant) : resultant_(resultant) {}

  int unknown_count() const override { return 4; }
  double evaluate(const double* u, double* f, double* K) const override;

 private:
  Vec2 resultant_;
};

}  // namespace arcwall
