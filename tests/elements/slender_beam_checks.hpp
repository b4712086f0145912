#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "elements/slender_beam.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::test {

constexpr double slender_step = 1e-6;       // of differences: truncation 1e-12, round-off 1e-10 of the greatest
constexpr double slender_tolerance = 1e-8;  // relative to the greatest entry: leaves room for both

inline BeamResponse response(const SlenderBeam& beam, const BeamEnds& ends) {
  BeamResponse out;
  beam.respond(ends, true, out);
  return out;
}

/// The ends with entry i of q moved.
inline BeamEnds moved(BeamEnds ends, Index i, double by) {
  (i < 2 ? ends.chord[i] : i == 2 ? ends.angle1 : ends.angle2) += by;
  return ends;
}

/// The ends of a stretch, deformed by a few numbers of size one times `amplitude` and turned by `turn`.
inline BeamEnds deformed(const StretchReference& stretch, double amplitude, double turn, Numbers& numbers) {
  const Vector by = amplitude * numbers.vector(4);
  const Vec2 chord = stretch.chord + stretch.chord.norm() * by.head<2>();
  return {.chord = std::cos(turn) * chord + std::sin(turn) * perp(chord),
          .angle1 = stretch.angles.front() + turn + by[2],
          .angle2 = stretch.angles.back() + turn + by[3]};
}

/// Force and stiffness are derivatives of the energy; the stiffness is symmetric.
inline void expect_response_derivatives(const SlenderBeam& beam, const BeamEnds& ends) {
  const BeamResponse at = response(beam, ends);
  const double K_scale = at.stiffness.cwiseAbs().maxCoeff();
  const double f_scale = std::max(at.force.cwiseAbs().maxCoeff(), 1e-2 * K_scale);
  EXPECT_LE((at.stiffness - at.stiffness.transpose()).cwiseAbs().maxCoeff(), 1e-14 * K_scale);
  for (Index i = 0; i < 4; ++i) {
    const BeamResponse above = response(beam, moved(ends, i, slender_step)),
                       below = response(beam, moved(ends, i, -slender_step));
    EXPECT_NEAR((above.energy - below.energy) / (2.0 * slender_step), at.force[i], slender_tolerance * f_scale);
    const Eigen::Vector4d column = (above.force - below.force) / (2.0 * slender_step);
    EXPECT_LE((column - at.stiffness.col(i)).cwiseAbs().maxCoeff(), slender_tolerance * K_scale) << "entry " << i;
  }
}

/// `force_rate` is the derivative of the force by the material coordinates of the ends.
inline void expect_force_rates(const std::function<std::unique_ptr<SlenderBeam>(const StretchReference&)>& make,
                               const ImperfectAxis& shape, double from, double to, const BeamEnds& ends) {
  const double step = slender_step * (to - from);
  const auto at = [&](double a, double b) { return response(*make(stretch_reference(shape, a, b)), ends); };
  const BeamResponse here = at(from, to);
  const Eigen::Vector4d first = (at(from + step, to).force - at(from - step, to).force) / (2.0 * step);
  const Eigen::Vector4d second = (at(from, to + step).force - at(from, to - step).force) / (2.0 * step);
  const double scale = std::max(here.force_rate[0].cwiseAbs().maxCoeff(), here.force_rate[1].cwiseAbs().maxCoeff());
  EXPECT_LE((here.force_rate[0] - first).cwiseAbs().maxCoeff(), slender_tolerance * scale);
  EXPECT_LE((here.force_rate[1] - second).cwiseAbs().maxCoeff(), slender_tolerance * scale);
}

/// place() meets both ends and is consistent with its gradients, which at the ends are those of the ends themselves.
inline void expect_place(const SlenderBeam& beam, const BeamEnds& ends) {
  const double l = ends.chord.norm();
  const BeamPlace first = beam.place(ends, 0.0), second = beam.place(ends, 1.0);
  EXPECT_LE(first.offset.norm(), 1e-15 * l);
  EXPECT_LE((second.offset - ends.chord).norm(), 1e-14 * l);
  EXPECT_EQ(first.angle, ends.angle1);
  EXPECT_NEAR(second.angle, ends.angle2, 1e-14 * (1.0 + std::abs(ends.angle2)));
  EXPECT_LE(first.offset_gradient.cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LE((second.offset_gradient - Eigen::Matrix<double, 2, 4>::Identity()).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LE((first.angle_gradient - Eigen::RowVector4d(0, 0, 1, 0)).cwiseAbs().maxCoeff(), 1e-13 * (1.0 + 1.0 / l));
  EXPECT_LE((second.angle_gradient - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff(), 1e-13 * (1.0 + 1.0 / l));
  for (const double xi : {0.0, 0.2, 0.5, 0.77, 1.0}) {
    const BeamPlace at = beam.place(ends, xi);
    for (Index i = 0; i < 4; ++i) {
      const BeamPlace above = beam.place(moved(ends, i, slender_step), xi),
                      below = beam.place(moved(ends, i, -slender_step), xi);
      const Vec2 offset_slope = (above.offset - below.offset) / (2.0 * slender_step);
      const double angle_slope = (above.angle - below.angle) / (2.0 * slender_step);
      EXPECT_LE((offset_slope - at.offset_gradient.col(i)).norm(), slender_tolerance * (1.0 + l)) << "ξ = " << xi;
      EXPECT_NEAR(angle_slope, at.angle_gradient[i], slender_tolerance * (1.0 + 1.0 / l)) << "ξ = " << xi;
    }
  }
}

}  // namespace arcwall::test
