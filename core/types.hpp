#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>
#include <cstdint>
#include <limits>

namespace arcwall {

using Index = Eigen::Index;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using LongRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vec2 = Eigen::Vector2d;

/// Compressed columns; up to 2³¹ entries.
using SparseIndex = std::int32_t;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, SparseIndex>;

constexpr double pi = 3.14159265358979323846;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns true if all entries are finite.
template <typename Entries>
bool all_finite(const Eigen::DenseBase<Entries>& entries) {
  return (entries.derived().array() * 0.0).sum() == 0.0;
}

/// Returns v rotated by +90° (anticlockwise).
inline Vec2 perp(const Vec2& v) { return {-v.y(), v.x()}; }

/// Returns a × b, positive if b points to the left of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Returns the angle from a to b, anticlockwise, in [−π, π] [rad].
inline double turn_between(const Vec2& a, const Vec2& b) { return std::atan2(cross(a, b), a.dot(b)); }

}  // namespace arcwall
