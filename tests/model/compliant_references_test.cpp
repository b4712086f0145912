#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "tests/model/compliant_decks.hpp"

// Beams and columns on compliant walls against references of their own: Hetényi's beam, and an elastica that is shot.
namespace arcwall::compliant_test {

// --- small slopes ---------------------------------------------------------------------------------------------------

namespace {

// A beam on two rollers, 2L between them, δ above a bed of stiffness k, under P in its middle: the part |x| < a is
// pressed, where EI w⁗ = −k (w − δ), and free beyond it. For a given a all is linear (Hetényi, Beams on Elastic
// Foundation, 1946, on lift-off).
struct Bed {
  double load, reaction, deflection;  // P, of the bed, in the middle
};

Bed bed_with_edge_at(double a, double L, double EI, double k, double gap) {
  const double b = std::pow(k / (4.0 * EI), 0.25);
  // v = w − δ: products of cos, sin and exponentials, f_i and derivatives by x; beyond a Σ d_i (x − a)^i.
  const auto pressed = [&](double x, int derivative, int which) {
    // exp(s b x) times cos or sin of b x: derivatives of exp(z x), z = b (s + i)
    const double s = which < 2 ? 1.0 : -1.0;
    const std::complex<double> z(b * s, b);
    const std::complex<double> value = std::pow(z, derivative) * std::exp(z * x);
    return which % 2 == 0 ? value.real() : value.imag();
  };
  const auto free = [&](double x, int derivative, int which) {
    double factor = 1.0;
    for (int i = 0; i < derivative; ++i) factor *= which - i;
    return which < derivative ? 0.0 : factor * std::pow(x - a, which - derivative);
  };
  Matrix A = Matrix::Zero(9, 9);  // c0 … c3, d0 … d3, P
  Vector right = Vector::Zero(9);
  for (int i = 0; i < 4; ++i) {
    A(0, i) = pressed(0.0, 1, i);
    A(1, i) = EI * pressed(0.0, 3, i);
    A(2, i) = pressed(a, 0, i);
    A(3, 4 + i) = free(a, 0, i);
    for (int d = 1; d < 4; ++d) {
      A(3 + d, i) = pressed(a, d, i);
      A(3 + d, 4 + i) = -free(a, d, i);
    }
    A(7, 4 + i) = free(L, 0, i);
    A(8, 4 + i) = free(L, 2, i);
  }
  A(1, 8) = -0.5;  // EI w‴(0+) = P/2
  right[3] = gap;
  const Vector c = A.fullPivLu().solve(right);
  double v = 0.0, shear = 0.0;
  for (int i = 0; i < 4; ++i) {
    v += c[i] * pressed(0.0, 0, i);
    shear += c[i] * EI * (pressed(a, 3, i));
  }
  return {.load = c[8], .reaction = c[8] - 2.0 * shear, .deflection = gap + v};
}

// The same as a deck of `elements` elements: slopes of 1e-4.
}  // namespace

TEST(CompliantWalls, LiftABeamOffABedWhereHetenyiDoes) {
  constexpr double L = 1.0, EI = 100.0, k = 1e5, gap = 1e-4, a = 0.31;
  const Bed exact = bed_with_edge_at(a, L, EI, k, gap);
  const Session run = traced(beam_over_bed("euler-bernoulli", 80, exact.load));
  ASSERT_EQ(run.points().back().lambda, 1.0);
  EXPECT_NEAR(last(run, 0), -exact.deflection, 1e-6 * exact.deflection);
  EXPECT_NEAR(last(run, 1), exact.reaction, 1e-6 * exact.reaction);
  EXPECT_NEAR(last(run, 2), L - a, 1e-5);
  // First contact: P L³/(6 EI) = δ of the beam of length 2 L.
  const RecordEvent& touch = event_of(record(run), EventKind::contact_closes);
  EXPECT_NEAR(touch.lambda * exact.load, 6.0 * EI * gap / (L * L * L), 1e-6 * 6.0 * EI * gap);
  ASSERT_EQ(touch.contacts.size(), 1U);
  EXPECT_EQ(touch.contacts.front().label.wall, "bed");
  EXPECT_NEAR(touch.contacts.front().label.fraction, 0.5, 1e-9);
}

// --- the elastica, shot ---------------------------------------------------------------------------------------------

namespace {

// Half of a pinned column of length 2 with a stress-free shape (S, d(S)), symmetric about its middle, under an end load
// P below a bed −k max(0, z − h) per stress-free length. F is the force on the left part, M its moment:
//
//     φ′ = φ₀′ + s₀′ M/EI,   r′ = s₀′ (1 + F·t/EA) t,   F_z′ = s₀′ k max(0, z − h),   M′ = −r′ × F
//
// with z(0) = M(0) = 0 and F_x = −P; at the middle φ = 0 and F_z = 0. Unknowns: φ and F_z at the end, and P.
class ShotColumn {
 public:
  static constexpr double EA = 210.0, EI = 0.175, height = 0.15, length = 2.0;
  using Unknowns = Eigen::Vector3d;
  using Values = std::array<double, 5>;  // x, z, φ, M, F_z

  explicit ShotColumn(double stiffness) : k_(stiffness) {}

  // At the middle, by Runge and Kutta's rule.
  Values run(const Unknowns& of) const {
    constexpr int steps = 1000;
    constexpr double h = 0.5 * length / steps;
    Values y{0.0, 0.0, of[0], 0.0, of[1]};
    for (int i = 0; i < steps; ++i) {
      const double S = i * h;
      const Values k1 = rate(S, y, of[2]), k2 = rate(S + 0.5 * h, plus(y, k1, 0.5 * h), of[2]),
                   k3 = rate(S + 0.5 * h, plus(y, k2, 0.5 * h), of[2]), k4 = rate(S + h, plus(y, k3, h), of[2]);
      for (std::size_t j = 0; j < y.size(); ++j) y[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
    }
    return y;
  }

  double bed(const Unknowns& of) const { return 2.0 * (run(of)[4] - of[1]); }

  // The tangent of the solutions, in which they go on from `forward`.
  Unknowns tangent(const Unknowns& at, const Unknowns& forward) const {
    const Eigen::Matrix<double, 2, 3> J = jacobian(at);
    const Unknowns t = Unknowns(J.row(0)).cross(Unknowns(J.row(1))).normalized();
    return t.dot(forward) < 0.0 ? Unknowns(-t) : t;
  }

  // The solution on the plane across `forward` through a guess.
  Unknowns corrected(Unknowns at, const Unknowns& forward) const {
    const Unknowns guess = at;
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector2d off = residual(at);
      if (off.norm() < 1e-13) break;
      Eigen::Matrix3d A;
      A << jacobian(at), forward.transpose();
      at += A.fullPivLu().solve(Unknowns(-off[0], -off[1], forward.dot(guess - at)));
    }
    return at;
  }

 private:
  static Values plus(const Values& y, const Values& rate, double h) {
    Values sum = y;
    for (std::size_t i = 0; i < y.size(); ++i) sum[i] += h * rate[i];
    return sum;
  }

  Values rate(double S, const Values& y, double P) const {
    constexpr double a1 = 2e-3, a3 = 3e-4, w = std::numbers::pi / length;
    const double slope = a1 * w * std::cos(w * S) + 3.0 * a3 * w * std::cos(3.0 * w * S);
    const double bend = -a1 * w * w * std::sin(w * S) - 9.0 * a3 * w * w * std::sin(3.0 * w * S);
    const double speed = std::sqrt(1.0 + slope * slope);
    const double c = std::cos(y[2]), s = std::sin(y[2]);
    const double stretched = speed * (1.0 + (-P * c + y[4] * s) / EA);
    return {stretched * c, stretched * s, bend / (speed * speed) + speed * y[3] / EI,
            -(stretched * c * y[4] + stretched * s * P), speed * k_ * std::max(0.0, y[1] - height)};
  }

  Eigen::Vector2d residual(const Unknowns& of) const {
    const Values end = run(of);
    return {end[2], end[4]};
  }

  Eigen::Matrix<double, 2, 3> jacobian(const Unknowns& at) const {
    constexpr double step = 1e-6;
    Eigen::Matrix<double, 2, 3> J;
    for (int i = 0; i < 3; ++i)
      J.col(i) = (residual(at + step * Unknowns::Unit(i)) - residual(at - step * Unknowns::Unit(i))) / (2.0 * step);
    return J;
  }

  double k_;
};

// The end load at which the middle reaches the bed, and its first maximum.
struct ShotEvents {
  double touch = 0.0, snap = 0.0, bed = 0.0;
};

ShotEvents events_of_shot(const ShotColumn& pressed) {
  using Unknowns = ShotColumn::Unknowns;
  const ShotColumn free(0.0);
  Unknowns at = free.corrected({0.02, 0.0, 0.35}, Unknowns::UnitX());
  Unknowns t = free.tangent(at, Unknowns::UnitX());
  ShotEvents events;
  // Steps, shorter where the path turns, and halved onto the place where a value changes its sign.
  const auto go_on_to_zero = [&](const ShotColumn& column, auto&& value) {
    constexpr double longest = 0.02, straight = 0.998;  // cosine
    double step = longest;
    bool is_near = false;
    for (int i = 0; i < 4000 && step > 1e-10; ++i) {
      const Unknowns ahead = column.corrected(at + step * t, t), there = column.tangent(ahead, t);
      const bool follows = (ahead - at).norm() < 1.2 * step && there.dot(t) > straight;
      const bool passed = follows && value(ahead, there) < 0.0;
      is_near = is_near || passed;
      if (!follows || passed) {
        step *= 0.5;
        continue;
      }
      at = ahead;
      t = there;
      if (!is_near) step = std::min(longest, 1.1 * step);
    }
  };
  go_on_to_zero(free, [&](const Unknowns& y, const Unknowns&) { return ShotColumn::height - free.run(y)[1]; });
  events.touch = at[2];
  at = pressed.corrected(at + 1e-4 * t, t);
  t = pressed.tangent(at, t);
  go_on_to_zero(pressed, [](const Unknowns&, const Unknowns& tangent) { return tangent[2]; });
  events.snap = at[2];
  events.bed = pressed.bed(at);
  return events;
}

}  // namespace

// A touch, a spread, and a snap. On a softer bed the column buckles sideways before that.
TEST(CompliantWalls, PressAnElasticaAsShootingSaysSlow) {
  for (const double stiffness : {500.0, 2000.0}) {
    SCOPED_TRACE(stiffness);
    const ShotEvents shot = events_of_shot(ShotColumn(stiffness));
    const Session run = traced(column_in_channel("elastica; order = 6", 64, stiffness));
    EXPECT_NEAR(event_of(record(run), EventKind::contact_closes).lambda, shot.touch, 1e-8 * shot.touch);
    const RecordEvent& snap = event_of(record(run), EventKind::limit_point);
    EXPECT_NEAR(snap.lambda, shot.snap, 1e-5 * shot.snap);
    EXPECT_NEAR(-snap.monitors[1], shot.bed, 1e-4 * shot.bed);
  }
}

}  // namespace arcwall::compliant_test
