#include "elements/essenburg_beam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

#include "tests/elements/element_checks.hpp"

namespace arcwall::essenburg_beam_test {

namespace {

using test::evaluated;
using test::Numbers;

constexpr double E = 3.0, nu = 0.29, height = 0.25, width = 0.4, length = 0.6;

EssenburgStiffness stiffness(double shear_correction = 1.0) {
  return {.E = E, .nu = nu, .shear_correction = shear_correction, .points = rectangle_points(width, height)};
}

// A stretch of a circle whose tangent turns from −half to half about its chord, straight where half = 0. Directors
// deviate from the fixed normals by `tilt`, as with an imperfection.
EssenburgReference stretch(int order, double half, QuadraticTerm quadratic, double direction = 0.7, double tilt = 0.0) {
  EssenburgReference reference;
  for (int a = 0; a <= order; ++a) {
    const double s = length * (double(a) / order - 0.5), turn = 2.0 * half * s / length;
    const double radius = half == 0.0 ? 0.0 : 0.5 * length / half;
    const Vec2 along = half == 0.0 ? Vec2(s, 0.0) : Vec2(radius * Vec2(std::sin(turn), 1.0 - std::cos(turn)));
    const auto normal = [&](double angle) { return Vec2(-std::sin(angle), std::cos(angle)); };
    reference.nodes.push_back(Eigen::Rotation2Dd(direction) * along);
    reference.sections.push_back(
        {.D = normal(direction + turn + tilt), .n = normal(direction + turn), .quadratic = quadratic});
  }
  return reference;
}

std::vector<EssenburgReference> stretches() {
  std::vector<EssenburgReference> all;
  for (const QuadraticTerm quadratic : {QuadraticTerm::fixed, QuadraticTerm::director})
    for (const int order : {1, 2})
      for (const double half : {0.0, 0.3}) all.push_back(stretch(order, half, quadratic, 0.7, 0.02));
  return all;
}

// Changes of positions and sections of the size of the element: ξ times the height is of order 1.
Vector random_unknowns(Numbers& numbers, Index n) {
  Vector u = 0.3 * numbers.vector(n);
  for (Index i = 4; i < n; i += 5) u[i] /= height;
  return u;
}

// What a rotation about the origin of the deformed element and a shift make of the unknowns.
Vector moved(const EssenburgReference& reference, const Vector& u, double angle, const Vec2& shift) {
  Vector v = u;
  for (std::size_t a = 0; a < reference.nodes.size(); ++a) {
    const auto i = static_cast<Index>(5 * a);
    v.segment<2>(i) =
        Eigen::Rotation2Dd(angle) * Vec2(reference.nodes[a] + u.segment<2>(i)) + shift - reference.nodes[a];
    v[i + 2] += angle;
  }
  return v;
}

}  // namespace

TEST(EssenburgBeam, DerivativesAreExactAtAThousandRandomStatesSlow) {
  Numbers numbers(70);
  for (const EssenburgReference& reference : stretches()) {
    const EssenburgBeam beam(reference, stiffness(5.0 / 6.0));
    for (int i = 0; i < 125; ++i)
      test::expect_derivatives_within(beam, random_unknowns(numbers, beam.unknown_count()), 1e-9);
  }
}

// The Hessian is that of a potential: forces give a symmetric matrix of differences, not only the triangle in store.
TEST(EssenburgBeam, DifferencesOfTheForcesAreSymmetric) {
  Numbers numbers(71);
  constexpr double step = 1e-3;
  for (const EssenburgReference& reference : stretches()) {
    const EssenburgBeam beam(reference, stiffness());
    const Index n = beam.unknown_count();
    const Vector u = random_unknowns(numbers, n);
    const auto force = [&](Index i, double shift) {
      Vector at = u;
      at[i] += shift;
      return evaluated(beam, at).f;
    };
    Matrix K(n, n);
    for (Index i = 0; i < n; ++i)
      K.col(i) = (45.0 * (force(i, step) - force(i, -step)) - 9.0 * (force(i, 2.0 * step) - force(i, -2.0 * step)) +
                  (force(i, 3.0 * step) - force(i, -3.0 * step))) /
                 (60.0 * step);
    EXPECT_LE((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff());
  }
}

TEST(EssenburgBeam, RigidMotionsOfAnyAngleGiveNoForce) {
  for (const EssenburgReference& reference : stretches()) {
    const EssenburgBeam beam(reference, stiffness());
    const Vector rest = Vector::Zero(beam.unknown_count());
    for (const double angle : {0.0, 0.1, 1.5, 3.0, -4.0, 2.0 * pi, 17.0}) {
      const auto at = evaluated(beam, moved(reference, rest, angle, {3.0, -2.0}));
      EXPECT_LE(at.f.norm(), 1e-14 * 17.0 * E) << angle;
    }
  }
}

// With z² ξ along the director the energy does not see a rotation of the whole, along a fixed direction it does; shifts
// are seen by neither.
TEST(EssenburgBeam, TheDirectorVariantIsIndifferentToRotationsTheFixedOneToShifts) {
  Numbers numbers(72);
  for (const EssenburgReference& reference : stretches()) {
    const EssenburgBeam beam(reference, stiffness());
    const Vector u = random_unknowns(numbers, beam.unknown_count());
    const auto at = evaluated(beam, u), shifted = evaluated(beam, moved(reference, u, 0.0, {3.0, -2.0}));
    EXPECT_NEAR(shifted.energy, at.energy, 1e-13 * at.energy);
    EXPECT_LE((shifted.f - at.f).norm(), 1e-13 * at.f.norm());
    const Vector turned = moved(reference, u, 1.1, {0.0, 0.0});
    const double change = std::abs(evaluated(beam, turned).energy - at.energy) / at.energy;
    if (reference.sections[0].quadratic == QuadraticTerm::fixed) {
      EXPECT_GT(change, 1e-3);
      continue;
    }
    EXPECT_LE(change, 1e-13);
    Vector f = at.f;
    for (Index i = 0; i < f.size(); i += 5) f.segment<2>(i) = Eigen::Rotation2Dd(1.1) * Vec2(at.f.segment<2>(i));
    EXPECT_LE((evaluated(beam, turned).f - f).norm(), 1e-13 * f.norm());
  }
}

// Reduced integration leaves no motion without energy but the rigid ones, also of thin elements.
TEST(EssenburgBeam, StiffnessAtRestHasTheThreeRigidMotionsAndNoOther) {
  for (const EssenburgReference& reference : stretches())
    for (const double thickness : {height, 0.1 * height}) {
      EssenburgStiffness of = stiffness();
      of.points = rectangle_points(width, thickness);
      const EssenburgBeam beam(reference, of);
      Matrix K = evaluated(beam, Vector::Zero(beam.unknown_count())).K;
      const Vector scale = K.diagonal().cwiseSqrt().cwiseInverse();
      K = scale.asDiagonal() * K * scale.asDiagonal();
      const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(K).eigenvalues();
      EXPECT_LE(values.head(3).cwiseAbs().maxCoeff(), 1e-13);
      EXPECT_GT(values[3], 1e-7);  // bending: (h/l)⁴ with the shear stiffness scaled to 1
    }
}

// Linear theory: bent uniformly by κ, with the thickness following freely, ξ = ν κ/2, an element has the end moments
// E I κ. Two points along an element of order 1 see the shear strain κ x that its straight fields make and multiply the
// stiffness by 1 + (l/h)²/(2 (1 + ν)).
TEST(EssenburgBeam, FullIntegrationOfOrderOneLocksByItsLaw) {
  const double EI = E * width * std::pow(height, 3) / 12.0, kappa = 1e-6;
  for (const QuadraticTerm quadratic : {QuadraticTerm::fixed, QuadraticTerm::director}) {
    const auto moment = [&](int order, int axial_points) {
      const EssenburgBeam beam(stretch(order, 0.0, quadratic, 0.0), stiffness(), axial_points);
      Vector u = Vector::Zero(beam.unknown_count());
      for (Index a = 0; a <= order; ++a) {
        const double x = length * (double(a) / order - 0.5);
        u[5 * a + 1] = 0.5 * kappa * x * x;
        u[5 * a + 2] = kappa * x;
        u[5 * a + 4] = 0.5 * nu * kappa;
      }
      const Vector f = evaluated(beam, Vector::Zero(u.size())).K * u;
      // Thickness and inner nodes are in equilibrium by themselves.
      for (Index a = 0; a <= order; ++a) EXPECT_LE(f.segment<2>(5 * a + 3).norm(), 1e-13 * EI * kappa);
      EXPECT_NEAR(f[2], -f[f.size() - 3], 1e-13 * EI * kappa);
      return f[f.size() - 3];
    };
    EXPECT_NEAR(moment(1, 1) / (EI * kappa), 1.0, 1e-12);
    EXPECT_NEAR(moment(2, 2) / (EI * kappa), 1.0, 1e-12);
    EXPECT_NEAR(moment(1, 2) / (EI * kappa), 1.0 + std::pow(length / height, 2) / (2.0 * (1.0 + nu)), 1e-12);
  }
}

// Where the lower face of Selke & Kikuchi's first beam [kN, cm] has gone in its middle under end moments, before it
// touches: the right half, upright at x = 0 and on a roller at x = 1, in equal elements of order 1.
double bottom(int elements, int axial_points, double moment) {
  constexpr double h = 0.2;
  const auto n = static_cast<Index>(5 * (elements + 1));
  const auto at = [&](int a) { return Vec2(double(a) / elements, 0.0); };
  const EssenburgStiffness steel{.E = 21000.0, .nu = 0.29, .points = rectangle_points(h, h)};
  const EssenburgBeam beam({.nodes = {at(0), at(1)}, .sections = {EssenburgNode{}, EssenburgNode{}}}, steel,
                           axial_points);
  Vector u = Vector::Zero(n);
  for (int iteration = 0; iteration < 12; ++iteration) {
    Vector F = -moment * Vector::Unit(n, n - 3);
    Matrix K = Matrix::Zero(n, n);
    for (Index k = 0; k < elements; ++k) {
      const auto element = evaluated(beam, u.segment<10>(5 * k));
      F.segment<10>(5 * k) += element.f;
      K.block<10, 10>(5 * k, 5 * k) += element.K;
    }
    for (const Index held : {Index{0}, Index{2}, n - 4}) {
      F[held] = 0.0;
      K.row(held).setZero();
      K.col(held).setZero();
      K(held, held) = 1.0;
    }
    u -= K.ldlt().solve(F);
  }
  return u[1] - 0.5 * h * u[3] + 0.25 * h * h * u[4];
}

// The free rows of their Table 1, −0.0706, −0.0790 and −0.0792, are those of linear elements with full integration, 40
// on the half. The other values are those of an independent program with the same elements.
TEST(EssenburgBeam, FullIntegrationHasTheFreeRowsOfTable1) {
  for (const auto& [elements, expected] :
       {std::pair{5, -0.05127959}, {10, -0.06482912}, {20, -0.06941206}, {40, -0.07066070}, {80, -0.07097991}})
    EXPECT_NEAR(bottom(elements, 2, 0.4), expected, 1e-8) << elements;
  for (const auto& [moment, printed] : {std::pair{0.4, -0.0706}, {0.4475, -0.0790}, {0.4485, -0.0792}})
    EXPECT_NEAR(bottom(40, 2, moment), printed, 1e-4) << moment;
  for (const auto& [elements, expected] : {std::pair{5, -0.07108215}, {10, -0.07108567}, {40, -0.07108687}})
    EXPECT_NEAR(bottom(elements, 1, 0.4), expected, 1e-8) << "one point along the axis, " << elements;
}

// A bar pulled along its axis contracts freely by λ3: S33 = 0 gives λ3² = 1 − ν (λ1² − 1), and the force is
// E A λ1 (λ1² − 1)/2; with the quadratic term along the director at any rotation.
TEST(EssenburgBeam, StretchedBarsHaveTheForceOfStVenantAndKirchhoff) {
  constexpr double stretch_ratio = 1.3;
  const double contraction = std::sqrt(1.0 - nu * (stretch_ratio * stretch_ratio - 1.0));
  const double force = 0.5 * E * width * height * stretch_ratio * (stretch_ratio * stretch_ratio - 1.0);
  for (const QuadraticTerm quadratic : {QuadraticTerm::fixed, QuadraticTerm::director})
    for (const int order : {1, 2}) {
      const EssenburgReference reference = stretch(order, 0.0, quadratic, 0.7);
      const EssenburgBeam beam(reference, stiffness());
      Vector u = Vector::Zero(beam.unknown_count());
      for (Index a = 0; a <= order; ++a) {
        u.segment<2>(5 * a) = (stretch_ratio - 1.0) * reference.nodes[static_cast<std::size_t>(a)];
        u[5 * a + 3] = contraction - 1.0;
      }
      const double turn = quadratic == QuadraticTerm::director ? 0.4 : 0.0;
      const Vector f = evaluated(beam, moved(reference, u, turn, {0.0, 0.0})).f;
      const Vec2 along(std::cos(0.7 + turn), std::sin(0.7 + turn));
      EXPECT_LE((f.segment<2>(5 * order) - force * along).norm(), 1e-14);
      for (Index a = 0; a <= order; ++a) EXPECT_LE(f.segment<3>(5 * a + 2).norm(), 1e-14);
    }
}

// Points of the sections integrate zⁿ: rectangles have b hⁿ⁺¹/(2ⁿ (n + 1)), circles 2 rⁿ⁺² B((n + 1)/2, 3/2), a tube is
// a circle less a circle.
TEST(SectionPoints, IntegratePowersOfTheHeight) {
  const auto integral = [](const std::vector<SectionPoint>& points, int n) {
    double sum = 0.0;
    for (const auto& [z, area] : points) sum += area * std::pow(z, n);
    return sum;
  };
  const auto circle = [](double r, int n) { return 2.0 * std::pow(r, n + 2) * std::beta(0.5 * (n + 1), 1.5); };
  for (int n = 0; n <= 8; ++n) {
    const bool odd = n % 2 == 1;
    const double rectangle = odd ? 0.0 : 0.3 * 2.0 * std::pow(0.6, n + 1) / (n + 1);
    EXPECT_NEAR(integral(rectangle_points(0.3, 1.2), n), rectangle, 1e-15);
    EXPECT_NEAR(integral(circle_points(0.6), n), odd ? 0.0 : circle(0.6, n), 1e-15);
    EXPECT_NEAR(integral(tube_points(0.6, 0.1), n), odd ? 0.0 : circle(0.6, n) - circle(0.5, n), 1e-15);
  }
}

}  // namespace arcwall::essenburg_beam_test
