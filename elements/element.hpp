#pragma once

#include <algorithm>
#include <memory>

namespace arcwall {

/// Evaluates a potential of a few unknowns: the strain energy of an element, or the potential of a load on it. Override
/// evaluate() if it depends on the unknowns alone; else derive from DrivenElement.
class Element {
 public:
  /// Largest number of unknowns.
  static constexpr int max_unknowns = 15;

  virtual ~Element() = default;

  virtual int unknown_count() const = 0;

  /// Returns the potential [force·length] at local unknowns u, and λ = 0. Writes, unless null, its gradient to `f` (n
  /// entries) and the lower triangle of its Hessian to `K` (n × n, column-major).
  virtual double evaluate(const double* u, double* f, double* K) const = 0;

  /// Returns true if the potential depends on λ.
  virtual bool depends_on_lambda() const { return false; }

  /// Returns the potential at (u, λ), with `f` and `K` as above. Writes ∂f/∂λ to `f_lambda` (n entries) unless null.
  virtual double evaluate_at(const double* u, double /*lambda*/, double* f, double* K, double* f_lambda) const {
    if (f_lambda != nullptr) std::fill_n(f_lambda, unknown_count(), 0.0);
    return evaluate(u, f, K);
  }

  /// Converts the gradient f at (u, λ) to end forces of this element. They differ if parts of the potential cancel
  /// between neighbours: see BeamPressure.
  virtual void complete_end_forces(const double* /*u*/, double /*lambda*/, double* /*f*/) const {}

  /// Returns the element in the updated Lagrangian formulation, with reference configuration u: see UpdatedElement.
  /// u = 0: stress-free. Null if the theory has no such formulation.
  virtual std::unique_ptr<Element> updated(const double* /*u*/) const { return nullptr; }
};

/// Evaluates a potential that depends on λ: of a load, a temperature, a pressure. Override evaluate_at().
class DrivenElement : public Element {
 public:
  bool depends_on_lambda() const final { return true; }
  double evaluate(const double* u, double* f, double* K) const final { return evaluate_at(u, 0.0, f, K, nullptr); }
  double evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const override = 0;
};

}  // namespace arcwall
