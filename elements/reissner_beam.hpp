#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/types.hpp"
#include "elements/element.hpp"
#include "elements/line_load.hpp"
#include "elements/shape_functions.hpp"

namespace arcwall {

/// A stretch of a beam in its stress-free shape: two nodes (order 1) or the ends with a middle node (order 2), in the
/// order in which they lie along the axis.
struct ExactBeamReference {
  std::vector<Vec2> nodes{};   ///< positions [length]
  std::vector<double> arcs{};  ///< arc length of the axis from the first node to each, rising from 0 [length]

  int order() const { return static_cast<int>(nodes.size()) - 1; }
};

/// ds/dξ of its axis.
inline double arc_speed(const ExactBeamReference& reference, const ShapeFunctions& shape) {
  double speed = 0.0;
  for (std::size_t a = 0; a < reference.arcs.size(); ++a) speed += shape.dN[a] * reference.arcs[a];
  return speed;
}

/// Stiffness of a section that is flexible in shear.
struct ExactBeamStiffness {
  double EA = 0.0;  ///< [force]
  double GA = 0.0;  ///< shear modulus times shear area [force]
  double EI = 0.0;  ///< [force·length²]
};

/// Geometrically exact beam that is flexible in shear (Reissner 1972, Simo 1985), of any displacement and rotation.
///
/// Unknowns: u, w, θ of each node along the axis: the first end, the middle node if there is one, the second end. θ is
/// the rotation of the section from its stress-free state and need not be wrapped. Shape functions of degree `order`;
/// integrated with `order` Gauss points, so that nothing locks however thin the beam. At nodes the error falls with
/// h^(2 order), initially curved members included.
class ReissnerBeam final : public Element {
 public:
  ReissnerBeam(const ExactBeamReference& reference, const ExactBeamStiffness& stiffness);
  /// `stiffness`: at a fraction of the stretch.
  ReissnerBeam(const ExactBeamReference& reference, const std::function<ExactBeamStiffness(double)>& stiffness);

  int unknown_count() const override { return 3 * (order_ + 1); }
  double evaluate(const double* u, double* f, double* K) const override { return evaluate(u, {}, f, K, {}, nullptr); }

  /// A strain and a curvature.
  struct Deformation {
    double strain = 0.0, curvature = 0.0;
  };

  /// The same where sections are without force at a deformation e: U = ½ ∫ (EA (ε − e)² + …). `f_rate`, where it is not
  /// null, receives the rate of f where e changes at `e_rate`.
  double evaluate(const double* u, const Deformation& e, double* f, double* K, const Deformation& e_rate,
                  double* f_rate) const;

 private:
  struct GaussPoint {
    double ds = 0.0;                 // weight times arc length
    std::array<double, 3> N{}, D{};  // shape functions, and their derivatives in the arc length
    double cos0 = 1.0, sin0 = 0.0;   // direction of the interpolated axis r₀, on which the section stands
    double stretch0 = 1.0;           // |r₀′|, which is not quite 1
    ExactBeamStiffness stiffness{};
  };
  // Derivatives of the energy per length in u′ (x, z), θ and θ′.
  struct First {
    double x, z, theta, kappa;
  };
  struct Second {
    double xx, xz, zz, xt, zt, tt, kk;
  };

  static void add_forces(const GaussPoint& at, std::size_t nodes, const First& U, double* f);
  static void add_stiffness(const GaussPoint& at, std::size_t nodes, const Second& U, double* K);

  int order_;
  std::array<GaussPoint, 2> points_{};  // the first `order_`
};

/// Potential of a dead load per length of the undeformed axis on an ReissnerBeam, whose unknowns it has, or on another
/// beam with displacements of the same shape functions: V = −∫ q·u ds, linear in the displacements.
class ExactDistributedLoad final : public Element {
 public:
  /// `load_at`: at a fraction of the stretch [force/length]. Of the unknowns of each node the first two are the
  /// displacements. `pieces`: on which the load is smooth.
  ExactDistributedLoad(const ExactBeamReference& reference, const std::function<Vec2(double)>& load_at,
                       int unknowns_a_node = 3, const SmoothPieces& pieces = {});

  int unknown_count() const override { return stride_ * static_cast<int>(forces_.size()); }
  double evaluate(const double* u, double* f, double* K) const override;

 private:
  std::vector<Vec2> forces_;  // at each node
  int stride_;
};

}  // namespace arcwall
