#pragma once

#include <memory>

namespace arcwall {

/// A potential of a few unknowns: the strain energy of one beam or bar element, or the potential of a load on it.
class Element {
 public:
  /// Most unknowns an element may have.
  static constexpr int max_unknowns = 15;

  virtual ~Element() = default;

  virtual int unknown_count() const = 0;

  /// The potential at local unknowns u. Where they are not null, `f` (n entries) receives its gradient and `K` the
  /// lower triangle of its Hessian (n × n, column-major).
  virtual double evaluate(const double* u, double* f, double* K) const = 0;

  /// The same material in the updated Lagrangian formulation, at the end of an increment that led to u: see
  /// UpdatedElement. A stress-free element begins at u = 0. Null where a theory has no such form.
  virtual std::unique_ptr<Element> updated(const double* /*u*/) const { return nullptr; }
};

}  // namespace arcwall
