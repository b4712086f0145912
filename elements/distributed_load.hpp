#pragma once

#include <array>
#include <memory>
#include <utility>

#include "elements/driven.hpp"
#include "elements/element.hpp"
#include "elements/line_load.hpp"
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

/// Potential of a dead load along a stretch, by its length:
///
///     V = −∫ q(S)·(r(S) − R(S)) dS
///
/// with places r now and R at rest on the CubicAxis of the ends, which the ends of the stretch may slide along. Exact
/// for a load that is linear along a straight axis, else of order 4.
class StretchLoad {
 public:
  /// The stretch begins and ends at these arc lengths of the member.
  StretchLoad(const StretchReference& stretch, const LineLoad& load, double from = 0.0, double to = 0.0)
      : stretch_(stretch), load_(load), from_(from), to_(to) {}

  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// Derivatives are by (r1, φ1, r2, φ2).
  struct Response {
    double energy = 0.0;
    Vector6 force = Vector6::Zero();
    Matrix6 stiffness = Matrix6::Zero();
    std::array<Vector6, 2> force_rate{Vector6::Zero(), Vector6::Zero()};  ///< ∂force/∂S1, ∂force/∂S2
  };
  /// Places are measured from the stress-free place of the first end, angles are those of the axis' tangent.
  Response respond(const Vec2& r1, double angle1, const Vec2& r2, double angle2) const;

 private:
  StretchReference stretch_;
  LineLoad load_;
  double from_, to_;
};

/// The same on an element of a classic or elastica beam, whose unknowns it has: displacements and rotations of both
/// ends.
class BeamDistributedLoad final : public Element {
 public:
  BeamDistributedLoad(const StretchReference& stretch, const LineLoad& load, double from = 0.0, double to = 0.0)
      : along_(stretch, load, from, to),
        chord_(stretch.chord),
        angles_{stretch.angles.front(), stretch.angles.back()} {}

  int unknown_count() const override { return 6; }
  double evaluate(const double* u, double* f, double* K) const override;

 private:
  StretchLoad along_;
  Vec2 chord_;  // stress-free
  std::array<double, 2> angles_;
};

/// The same for a bar, whose unknowns are those of Truss.
class TrussDistributedLoad final : public Element {
 public:
  /// `forces`: at its ends, the integrals of the load by linear shape functions [force].
  explicit TrussDistributedLoad(const std::array<Vec2, 2>& forces) : forces_(forces) {}

  int unknown_count() const override { return 4; }
  double evaluate(const double* u, double* f, double* K) const override;

 private:
  std::array<Vec2, 2> forces_;
};

}  // namespace arcwall
