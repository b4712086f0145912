#pragma once

#include <algorithm>
#include <memory>

namespace arcwall {

/// A potential of a few unknowns: the strain energy of one beam or bar element, or the potential of a load on it. Most
/// potentials depend on the unknowns alone and override evaluate(); others are a DrivenElement.
class Element {
 public:
  /// Most unknowns an element may have.
  static constexpr int max_unknowns = 15;

  virtual ~Element() = default;

  virtual int unknown_count() const = 0;

  /// The potential at local unknowns u; where it depends on λ, at λ = 0. Where they are not null, `f` (n entries)
  /// receives its gradient and `K` the lower triangle of its Hessian (n × n, column-major).
  virtual double evaluate(const double* u, double* f, double* K) const = 0;

  /// Whether the potential itself depends on λ.
  virtual bool depends_on_lambda() const { return false; }

  /// The potential at (u, λ), with `f` and `K` as above; `f_lambda` (n entries) receives ∂f/∂λ where it is not null.
  virtual double evaluate_at(const double* u, double /*lambda*/, double* f, double* K, double* f_lambda) const {
    if (f_lambda != nullptr) std::fill_n(f_lambda, unknown_count(), 0.0);
    return evaluate(u, f, K);
  }

  /// Makes of the gradient f at (u, λ) the forces on the ends of this element alone. They differ where the potential
  /// has parts that cancel between neighbours: see BeamPressure.
  virtual void complete_end_forces(const double* /*u*/, double /*lambda*/, double* /*f*/) const {}

  /// The same material in the updated Lagrangian formulation, at the end of an increment that led to u: see
  /// UpdatedElement. A stress-free element begins at u = 0. Null where a theory has no such form.
  virtual std::unique_ptr<Element> updated(const double* /*u*/) const { return nullptr; }
};

/// A potential that λ drives: of a load that grows with λ, a temperature, a pressure. It overrides evaluate_at().
class DrivenElement : public Element {
 public:
  bool depends_on_lambda() const final { return true; }
  double evaluate(const double* u, double* f, double* K) const final { return evaluate_at(u, 0.0, f, K, nullptr); }
  double evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const override = 0;
};

}  // namespace arcwall
