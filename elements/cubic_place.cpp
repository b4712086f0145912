#include "elements/cubic_place.hpp"

#include <cmath>

namespace arcwall {

// With the chord c and its direction β, ∂β/∂c = c⊥/|c|².
CubicPlace cubic_place(const Eigen::Matrix<double, 6, 1>& ends, double xi) {
  const Vec2 c = ends.segment<2>(3) - ends.head<2>(), across = perp(c);
  const double beta = std::atan2(c.y(), c.x()), square = c.squaredNorm();
  const double N1 = xi * (1.0 - xi) * (1.0 - xi), N2 = -xi * xi * (1.0 - xi), N = N1 + N2;
  const auto against_chord = [&](double angle) { return std::remainder(angle - beta, 2.0 * pi); };
  const double H = N1 * against_chord(ends[2]) + N2 * against_chord(ends[5]);
  const Vec2 H_c = -N / square * across;
  Eigen::Matrix2d turn;  // of c into c⊥
  turn << 0.0, -1.0, 1.0, 0.0;

  // By c and the two angles.
  Eigen::Matrix<double, 2, 4> by;
  by.leftCols<2>() = xi * Eigen::Matrix2d::Identity() + H * turn + across * H_c.transpose();
  by.col(2) = N1 * across;
  by.col(3) = N2 * across;
  Eigen::Matrix2d H_cc;
  H_cc << 2.0 * c.x() * c.y(), c.y() * c.y() - c.x() * c.x(), c.y() * c.y() - c.x() * c.x(), -2.0 * c.x() * c.y();
  H_cc *= -N / (square * square);

  Eigen::Matrix<double, 4, 6> spread = Eigen::Matrix<double, 4, 6>::Zero();
  spread(0, 0) = spread(1, 1) = -1.0;
  spread(0, 3) = spread(1, 4) = spread(2, 2) = spread(3, 5) = 1.0;
  CubicPlace place{.position = ends.head<2>() + xi * c + H * across, .gradient = by * spread};
  place.gradient.leftCols<2>() += Eigen::Matrix2d::Identity();
  for (Index k = 0; k < 2; ++k) {
    Eigen::Matrix4d second = Eigen::Matrix4d::Zero();
    const Eigen::RowVector2d row = turn.row(k);
    second.topLeftCorner<2, 2>() = row.transpose() * H_c.transpose() + H_c * row + across[k] * H_cc;
    second.block<1, 2>(2, 0) = N1 * row;
    second.block<1, 2>(3, 0) = N2 * row;
    second.block<2, 1>(0, 2) = N1 * row.transpose();
    second.block<2, 1>(0, 3) = N2 * row.transpose();
    place.second[static_cast<std::size_t>(k)] = spread.transpose() * second * spread;
  }
  return place;
}

}  // namespace arcwall
