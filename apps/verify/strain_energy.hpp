#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "apps/verify/gauss_rules.hpp"
#include "apps/verify/jet.hpp"
#include "elements/essenburg_beam.hpp"
#include "elements/truss.hpp"

// The strain energy of each theory by quadrature of its formula in docs/theory.md, section 2, with its derivatives by
// jets. Of the elements that are checked by it nothing is used but the names of their variants.
namespace arcwall::verify {

/// An energy with its derivatives by a few unknowns.
struct LocalEnergy {
  double energy = 0.0;  ///< [force·length]
  Vector gradient{};
  Matrix stiffness{};

  LocalEnergy() = default;
  explicit LocalEnergy(Index unknowns)
      : gradient(Vector::Zero(unknowns)), stiffness(Matrix::Zero(unknowns, unknowns)) {}
  template <int N>
  explicit LocalEnergy(const Jet<N>& jet) : energy(jet.value), gradient(N), stiffness(N, N) {
    for (std::size_t i = 0; i < jet.variables; ++i) {
      gradient[static_cast<Index>(i)] = jet.slope[i];
      for (std::size_t j = 0; j < jet.variables; ++j)
        stiffness(static_cast<Index>(i), static_cast<Index>(j)) = jet.second(i, j);
    }
  }

  /// Adds an energy of N variables, whose derivatives by the unknowns are the rows of a constant matrix.
  template <int N, class Rows>
  void add(const Jet<N>& jet, const Rows& rows) {
    Eigen::Matrix<double, N, 1> slope;
    Eigen::Matrix<double, N, N> bend;
    for (std::size_t i = 0; i < jet.variables; ++i) {
      slope[static_cast<Index>(i)] = jet.slope[i];
      for (std::size_t j = 0; j < jet.variables; ++j)
        bend(static_cast<Index>(i), static_cast<Index>(j)) = jet.second(i, j);
    }
    energy += jet.value;
    gradient.noalias() += rows.transpose() * slope;
    stiffness.noalias() += rows.transpose() * (bend * rows).eval();
  }

  LocalEnergy& operator+=(const LocalEnergy& other) {
    energy += other.energy;
    gradient += other.gradient;
    stiffness += other.stiffness;
    return *this;
  }
};

/// Stiffnesses of a section.
struct PlainStiffness {
  double EA = 0.0, GA = 0.0;  ///< [force]
  double EI = 0.0;            ///< [force·length²]
};

/// Of the section at a fraction of an element.
using SectionAlong = std::function<PlainStiffness(double)>;

/// What a section wants to be without force.
struct FreeDeformation {
  double strain = 0.0;
  double curvature = 0.0;  ///< by stress-free length, positive to the left [1/length]
};

// --- bars -----------------------------------------------------------------------------------------------------------

/// ½ EA L (ε − e)²; unknowns u1, w1, u2, w2.
LocalEnergy bar_energy(const Vec2& chord, double EA, TrussStrain measure, double free_strain, const Vector& u);

// --- slender beams --------------------------------------------------------------------------------------------------

/// A stretch of a stress-free axis.
struct Stretch {
  double length = 0.0;             ///< of the axis
  Vec2 chord = Vec2::Zero();       ///< from its first end to its second
  std::array<double, 4> angles{};  ///< of the tangent at 0, ⅓, ⅔ and 1 of its length [rad]
};

/// The angle of the stress-free axis at a fraction of its length: the cubic through the four.
double angle_inside(const Stretch& stretch, double fraction);

/// What the angle of a slender beam's axis may be along an element.
enum class AxisAngle {
  expanded,   ///< quadratic, in the expansion (2.3): the classic beam
  quadratic,  ///< (2.8) with a₃ as at rest
  cubic       ///< (2.8)
};

struct SlenderElement {
  Stretch stretch{};
  AxisAngle angle = AxisAngle::expanded;
  SectionAlong section{};  ///< uniform where the angle is expanded
  FreeDeformation free{};
};

/// Where the ends are and how they are turned, against rest.
struct EndsMotion {
  Vec2 first = Vec2::Zero(), second = Vec2::Zero();  ///< displacements [length]
  double turn1 = 0.0, turn2 = 0.0;                   ///< [rad]
};

/// Unknowns x1, z1, φ1, x2, z2, φ2. NaN where the inner iteration of (2.8) finds no state.
LocalEnergy slender_energy(const SlenderElement& element, const EndsMotion& motion);

/// A place inside an element, from its first end, with the derivatives by the same unknowns, as the energy has the axis
/// there: see docs/theory.md, section 2.6.
struct PlaceInside {
  Vec2 offset = Vec2::Zero();
  Eigen::Matrix<double, 2, 6> gradient = Eigen::Matrix<double, 2, 6>::Zero();
};
PlaceInside place_inside(const SlenderElement& element, const EndsMotion& motion, double fraction);

// --- beams with nodes between which places and rotations are interpolated -------------------------------------------

/// Two nodes, or three with one in the middle, of a stress-free axis.
struct NodesAlong {
  std::vector<Vec2> places{};  ///< from the first
  std::vector<double> arcs{};  ///< arc length of the axis from the first

  int order() const { return static_cast<int>(places.size()) - 1; }
};

/// Lagrange's polynomials at a fraction of an element, and their derivatives by 2·fraction − 1.
struct NodeShapes {
  std::array<double, 3> N{}, dN{};
};
NodeShapes node_shapes(int order, double fraction);

/// (2.6a); unknowns u, w, θ of each node.
LocalEnergy reissner_energy(const NodesAlong& nodes, const SectionAlong& section, const FreeDeformation& free,
                            const Vector& u);

/// The stress-free section at a node of an Essenburg beam.
struct PlainDirector {
  Vec2 director{0.0, 1.0};  ///< D
  Vec2 normal{0.0, 1.0};    ///< n of the bulge that keeps its direction
};

/// Material, and places over the height with their areas, of an Essenburg beam.
struct EssenburgMaterial {
  double E = 0.0, nu = 0.0, shear_correction = 1.0;
  std::vector<std::pair<double, double>> heights{};
  QuadraticTerm quadratic = QuadraticTerm::fixed;
};

/// (2.15); unknowns u, w, φ, e, ξ of each node.
LocalEnergy essenburg_energy(const std::vector<Vec2>& places, const std::vector<PlainDirector>& directors,
                             const EssenburgMaterial& material, const Vector& u);

}  // namespace arcwall::verify
