#pragma once

#include <memory>
#include <optional>

#include "continuation/metric.hpp"
#include "core/equilibrium_line.hpp"
#include "core/observable.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

/// Stores the roots τ of a constraint along a line: the one taken and, of a quadratic, the other one.
struct ConstraintRoots {
  double taken = 0.0;
  std::optional<double> other{};
};

/// Defines the scalar equation c(x, λ) = 0 that closes F(x, λ) = 0 in a step.
///
/// gradient() is the derivative of value(), except for UpdatedPlaneConstraint, whose value is always 0.
class PathConstraint : public Observable {
 public:
  /// Returns τ at which the state moved along the line satisfies the constraint, linearised by default. Empty if the
  /// roots are complex.
  virtual std::optional<ConstraintRoots> advance(const State& at, const EquilibriumLine& line) const;
};

/// Prescribes the value of a quantity: load and displacement control, stop bounds, output points.
class ValueConstraint final : public PathConstraint {
 public:
  /// `quantity` must outlive this.
  ValueConstraint(const Observable& quantity, double target) : quantity_(quantity), target_(target) {}
  double value(const State& state) const override { return quantity_.value(state) - target_; }
  Row gradient(const State& state) const override { return quantity_.gradient(state); }

 private:
  const Observable& quantity_;
  double target_;
};

/// Prescribes guard j = 0: location of an active-set change.
class GuardConstraint final : public PathConstraint {
 public:
  /// `system` must outlive this.
  GuardConstraint(const UnilateralSystem& system, Index j) : system_(system), j_(j) {}
  double value(const State& state) const override { return system_.guard(state, j_); }
  Row gradient(const State& state) const override { return system_.guard_gradient(state, j_); }

 private:
  const UnilateralSystem& system_;
  Index j_;
};

/// ⟨normal, X − origin⟩ = offset: a fixed plane (Riks 1979; Keller 1977, who calls offset the pseudo-arclength).
class PlaneConstraint final : public PathConstraint {
 public:
  /// `origin` must outlive this.
  PlaneConstraint(const Metric& metric, const State& origin, const Direction& normal, double offset);
  PlaneConstraint(const Metric&, State&&, const Direction&, double) = delete;
  double value(const State& state) const override;
  Row gradient(const State&) const override { return normal_; }

 private:
  const State& origin_;
  Row normal_;
  double offset_;
};

/// ⟨b − a, X − a⟩ = part · |b − a|²: the plane normal to a chord of the path.
class ChordPlaneConstraint final : public PathConstraint {
 public:
  /// All three must outlive this.
  ChordPlaneConstraint(const Metric& metric, const State& a, const State& b, double part)
      : metric_(metric), a_(a), b_(b), part_(part) {}
  double value(const State& state) const override;
  Row gradient(const State&) const override { return metric_.row(difference(b_, a_)); }

 private:
  const Metric& metric_;
  const State &a_, &b_;
  double part_;
};

/// Each iterate stays in the plane normal to the chord from the origin to the last (Ramm 1981).
class UpdatedPlaneConstraint final : public PathConstraint {
 public:
  /// Both must outlive this.
  UpdatedPlaneConstraint(const Metric& metric, const State& origin) : metric_(metric), origin_(origin) {}
  double value(const State&) const override { return 0.0; }
  Row gradient(const State& state) const override { return metric_.row(difference(state, origin_)); }

 private:
  const Metric& metric_;
  const State& origin_;
};

/// |X − origin|² = radius² (Crisfield 1981), with λ in the distance (spherical) or without (cylindrical). The quadratic
/// is solved as such: of its roots the one nearer the previous tangent is taken; complex roots give no step.
class SphereConstraint final : public PathConstraint {
 public:
  enum class Form { spherical, cylindrical };

  /// `tangent` is the one at the origin. All three must outlive this.
  SphereConstraint(const Metric& metric, Form form, const State& origin, const Direction& tangent, double radius)
      : metric_(metric), form_(form), origin_(origin), tangent_(tangent), radius_(radius) {}
  SphereConstraint(const Metric&, Form, State&&, const Direction&, double) = delete;
  double value(const State& state) const override;
  Row gradient(const State& state) const override;
  std::optional<ConstraintRoots> advance(const State& at, const EquilibriumLine& line) const override;

 private:
  double inner(const Direction& a, const Direction& b) const {
    return form_ == Form::spherical ? metric_.inner(a, b) : metric_.inner_x(a, b);
  }

  const Metric& metric_;
  Form form_;
  const State& origin_;
  const Direction& tangent_;
  double radius_;
};

/// Path-following methods.
enum class PathMethod { load, displacement, riks, normal_plane, cylindrical, spherical, pseudo_arclength };

/// Returns the constraint of a step of length s [path metric] along the unit tangent. `control`: controlled quantity of
/// `displacement`, else null. All arguments by reference or pointer must outlive the result.
std::unique_ptr<PathConstraint> step_constraint(PathMethod method, const Metric& metric, const State& from,
                                                const Direction& tangent, double s, const Observable* control);

}  // namespace arcwall
