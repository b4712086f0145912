#pragma once

#include <array>

#include "core/types.hpp"

namespace arcwall {

/// The cubic between two ends that has their places r1, r2 and tangents: over the chord c = r2 − r1 and its direction
/// β, at a fraction ξ of it,
///
///     r(ξ) = r1 + ξ c + c⊥ (N1 (θ1 − β) + N2 (θ2 − β)),   N1 = ξ (1 − ξ)², N2 = −ξ² (1 − ξ)
///
/// Angles against the chord are taken to within half a turn.
class CubicAxis {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// A place, and its derivatives by (x1, z1, angle1, x2, z2, angle2).
  struct Place {
    Vec2 position = Vec2::Zero();
    Eigen::Matrix<double, 2, 6> gradient = Eigen::Matrix<double, 2, 6>::Zero();
  };

  CubicAxis(const Vec2& r1, double angle1, const Vec2& r2, double angle2);

  Place at(double xi) const;

  /// Adds q·∂²r(ξ) by the same six.
  void add_second(double xi, const Vec2& q, Matrix6& to) const;

  /// A sum of functions of places on the axis, in its derivatives by r1, c, θ1 and θ2: at each place the slope q of one
  /// and its second derivatives k, in x and in z. It costs a third of what as many gradients and their products do.
  class Sum {
   public:
    explicit Sum(const CubicAxis& axis) : axis_(axis) {}

    Vec2 position(double xi) const {
      const Shapes N(xi);
      return axis_.first_ + xi * axis_.chord_ + (N.first * axis_.turn1_ + N.second * axis_.turn2_) * axis_.across_;
    }
    void add_slope(double xi, const Vec2& q) {
      const Shapes N(xi);
      by_first_ += q;
      by_chord_ += axis_.by_chord(xi).transpose() * q;
      turned_[0] += N.first * q;
      turned_[1] += N.second * q;
    }
    void add_second(double xi, const Vec2& k) {
      const Shapes N(xi);
      const Eigen::Matrix2d B = axis_.by_chord(xi), kB = k.asDiagonal() * B;
      k_ += k;
      k_chord_ += kB;
      chord_chord_ += B.transpose() * kB;
      const Vec2 pushed = kB.transpose() * axis_.across_;
      chord_turn_[0] += N.first * pushed;
      chord_turn_[1] += N.second * pushed;
      k_turn_[0] += N.first * k;
      k_turn_[1] += N.second * k;
      turn_turn_[0] += N.first * N.first * k;
      turn_turn_[1] += N.first * N.second * k;
      turn_turn_[2] += N.second * N.second * k;
    }

    /// The derivatives by the six of both ends.
    Vector6 gradient() const;
    Matrix6 hessian() const;

   private:
    const CubicAxis& axis_;
    Vec2 by_first_ = Vec2::Zero(), by_chord_ = Vec2::Zero();                   // Σ q, Σ Bᵀ q; B = ∂r/∂c
    std::array<Vec2, 2> turned_{Vec2::Zero(), Vec2::Zero()};                   // Σ N_i q
    Vec2 k_ = Vec2::Zero();                                                    // Σ k
    Eigen::Matrix2d k_chord_ = Eigen::Matrix2d::Zero();                        // Σ k B
    Eigen::Matrix2d chord_chord_ = Eigen::Matrix2d::Zero();                    // Σ Bᵀ k B
    std::array<Vec2, 2> k_turn_{Vec2::Zero(), Vec2::Zero()};                   // Σ N_i k
    std::array<Vec2, 2> chord_turn_{Vec2::Zero(), Vec2::Zero()};               // Σ N_i Bᵀ k c⊥
    std::array<Vec2, 3> turn_turn_{Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};  // Σ N1² k, Σ N1 N2 k, Σ N2² k
  };

 private:
  friend class Sum;

  // Of the turns of the ends against the chord.
  struct Shapes {
    double first, second;
    explicit Shapes(double xi) : first(xi * (1.0 - xi) * (1.0 - xi)), second(-xi * xi * (1.0 - xi)) {}
    double sum() const { return first + second; }
  };

  // ∂r/∂c
  Eigen::Matrix2d by_chord(double xi) const {
    const Shapes N(xi);
    const double H = N.first * turn1_ + N.second * turn2_, s = N.sum() / square_;
    const double xx = s * across_.x() * across_.x(), xz = s * across_.x() * across_.y(),
                 zz = s * across_.y() * across_.y();
    Eigen::Matrix2d B;
    B << xi - xx, -H - xz, H - xz, xi - zz;
    return B;
  }
  Eigen::Matrix2d second_by_chord(const Vec2& q) const;  // q·∂²r/∂c² where N1 + N2 = 1

  Vec2 first_, chord_, across_;  // r1, c, c⊥
  double square_;                // |c|²
  double turn1_, turn2_;         // of the ends against the chord
};

}  // namespace arcwall
