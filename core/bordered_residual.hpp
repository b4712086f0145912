#pragma once

#include <limits>
#include <utility>

#include "core/system.hpp"

namespace arcwall {

/// What a solution leaves of J δx + F_λ δλ = ± f: r = ± f − J δx − F_λ δλ. Below some ε of the sum of its terms'
/// magnitudes r is round-off, and no other solution is better. On a fine mesh stiffness times displacement is large
/// beside f.
class BorderedResidual {
 public:
  static constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();

  /// `sign`: of f. `equations`, `f` and `dx` must outlive this.
  BorderedResidual(const Linearization& equations, double sign, const Vector& f, const Eigen::Ref<const Vector>& dx,
                   double dlambda);

  const Vector& r() const& { return r_; }
  Vector r() && { return std::move(r_); }
  bool is_small() const;

 private:
  Vector terms() const;

  const Linearization& equations_;
  const Vector& f_;
  Eigen::Ref<const Vector> dx_;
  double dlambda_;
  Vector r_;
};

}  // namespace arcwall
