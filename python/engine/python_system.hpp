#pragma once

#include <string>

#include "core/system.hpp"
#include "python/engine/python.hpp"

namespace arcwall::python {

/// What a function of Python returned, as a vector of `size` numbers. Raises TypeError for what is no array of real
/// numbers, ValueError for one of another shape; `what` names it.
Vector vector_from(const py::object& returned, Index size, const std::string& what);

/// One number, likewise.
double number_from(const py::object& returned, const std::string& what);

/// A call of a function with (x, lam). What it raises is raised again with `arcwall_state`, a pair of x and lam, and a
/// note that says where it was.
py::object called(const py::object& function, const std::string& what, const State& state);

/// A smooth system whose equations are methods of an object of Python: residual(x, lam), jacobian(x, lam), dlam(x, lam)
/// and, where it has one, energy(x, lam); else the energy is nan. The interpreter's lock is held while it is asked.
class PythonSystem final : public System {
 public:
  /// Of `size` unknowns, at least one. Raises TypeError where a method is missing.
  PythonSystem(const py::object& system, Vector weights);

  Index size(const Piece&) const override { return weights_.size(); }
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;
  Vector weights(const Piece&) const override { return weights_; }

 private:
  py::object residual_, jacobian_, dlam_, energy_;
  Vector weights_;
};

}  // namespace arcwall::python
