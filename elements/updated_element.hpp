#pragma once

#include <algorithm>
#include <array>

#include "core/types.hpp"
#include "elements/element.hpp"

namespace arcwall {

/// An element in the updated Lagrangian formulation, between two load increments: its reference is the configuration at
/// the unknowns u₀, which it reached with the forces f₀; what follows is linear, with the stiffness K = K_L + K_σ.
///
///     U = U₀ + f₀ᵀ (u − u₀) + ½ (u − u₀)ᵀ K (u − u₀)
///
/// Element::updated() moves on: the configuration and the stresses at the end of an increment.
class UpdatedElement : public Element {
 public:
  int unknown_count() const final { return unknowns_; }

  double evaluate(const double* u, double* f, double* K) const final {
    const Eigen::Map<const Vector> at(u, unknowns_);
    const Vector du = at - u_, df = K_ * du;
    if (f != nullptr) Eigen::Map<Vector>(f, unknowns_) = f_ + df;
    if (K != nullptr) Eigen::Map<Matrix>(K, unknowns_, unknowns_) = K_;
    return U_ + du.dot(f_ + 0.5 * df);
  }

 protected:
  UpdatedElement(int unknowns, const double* u, double energy)
      : unknowns_(unknowns), u_(Eigen::Map<const Vector>(u, unknowns)), U_(energy) {}

  /// To be called by constructors.
  void set_response(Vector f, Matrix K) {
    f_ = std::move(f);
    K_ = std::move(K);
  }

  const Vector& reference() const { return u_; }
  double energy() const { return U_; }

 private:
  int unknowns_;
  Vector u_, f_;
  Matrix K_;
  double U_;
};

}  // namespace arcwall
