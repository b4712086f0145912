#pragma once

#include <limits>

#include "core/linearization.hpp"

namespace arcwall {

/// What a solution leaves of J δx + F_λ δλ = ± f: r = ± f − J δx − F_λ δλ. Below some ε of the sum of its terms'
/// magnitudes r is round-off, and no other solution is better. On a fine mesh stiffness times displacement is large
/// beside f.
class BorderedResidual {
 public:
  static constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();

  /// `sign`: of f.
  BorderedResidual(const Linearization& equations, double sign, const Vector& f, const Eigen::Ref<const Vector>& dx,
                   double dlambda);

  const Vector& r() const { return r_; }
  double size() const { return size_; }  ///< ‖r‖
  bool is_small() const { return size_ <= small_; }

 private:
  Vector r_;
  double size_, small_;  // small: what round-off leaves
};

}  // namespace arcwall
