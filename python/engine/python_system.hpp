#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/system.hpp"
#include "python/engine/python.hpp"

namespace arcwall::python {

/// What a function of Python returned, as a vector of `size` numbers. Raises TypeError for what is no array of real
/// numbers, ValueError for one of another shape; `what` names it.
Vector vector_from(const py::object& returned, Index size, const std::string& what);

/// One number, likewise.
double number_from(const py::object& returned, const std::string& what);

/// Gives what is being raised `arcwall_state`, a pair of x and lam, and a note that says where it was.
void add_state(const py::error_already_set& error, const py::object& x, double lambda, const std::string& what);

/// A function of Python asked in a state: `read` makes of what it returned what is wanted. What either raises is raised
/// again with the state.
template <typename Read>
auto asked(const py::object& function, const std::string& what, const State& state, const Read& read) {
  const py::array_t<double> x = to_frozen_array(state.x);
  try {
    return read(function(x, state.lambda));
  } catch (const py::error_already_set& error) {
    add_state(error, x, state.lambda, what);
    throw;
  }
}

/// What a function returned though it must be finite: which number it was.
struct NotFinite {
  std::string what{};  ///< `residual(x, lam) returned nan in entry 3`
  State state{};
};

/// Raises it as an exception of class `name` in arcwall.errors, with the state.
[[noreturn]] void raise(const char* name, const std::string& before, const NotFinite& of);

/// A smooth system whose equations are methods of an object of Python: residual(x, lam), jacobian(x, lam), dlam(x, lam)
/// and, where it has one, energy(x, lam); else the energy is nan. The interpreter's lock is held while it is asked.
///
/// F, K and F_λ may be no numbers, since a trial state may lie outside of where the equations are defined: the step is
/// shortened then. Energies are asked for at points of the path, and NotFinite is raised where they are none.
class PythonSystem final : public System {
 public:
  /// Of `size` unknowns, at least one. Raises TypeError where a method is missing.
  PythonSystem(const py::object& system, Vector weights);

  Dimensions dimensions(const ActiveSet&) const override { return {.unknowns = weights_.size()}; }
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;
  StateMetric metric(const ActiveSet&) const override { return {.weights = weights_}; }

  /// What was not finite last, since this was asked before.
  std::optional<NotFinite> take_not_finite() const { return std::exchange(not_finite_, std::nullopt); }

 private:
  Vector residual_at(const State& state) const;
  void note(const std::string& what, const std::optional<std::string>& where, const State& state) const;

  py::object residual_, jacobian_, dlam_, energy_;
  Vector weights_;
  mutable std::optional<NotFinite> not_finite_{};
};

}  // namespace arcwall::python
