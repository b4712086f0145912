#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/branch.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/toys.hpp"

// The star dome of 24 bars (Hangai & Kawamata 1973): apex at 8.216, ring of six nodes of radius 25 at 6.216, six pinned
// supports of radius 50 between them, at 0. Engineering strain; λ over EA pushes the apex down. The singular points of
// its symmetric path are roots of the determinants on the symmetric subspace and on the irreducible parts beside it, in
// extended precision; those of the two-dimensional parts E₁ and E₂ are double points.
namespace arcwall::star_dome_test {

namespace {

using test::SmoothToy;
using Vec3 = Eigen::Vector3d;

struct SpaceBar {
  int from, to;  // nodes below 7 are free
};

struct Dome {
  std::array<Vec3, 13> nodes{};
  std::vector<SpaceBar> bars{};

  Dome() {
    constexpr double sixth = 3.14159265358979323846 / 3.0;
    const auto at = [](double radius, double angle, double z) {
      return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
    };
    nodes[0] = Vec3(0.0, 0.0, 8.216);
    for (int k = 0; k < 6; ++k) {
      nodes[static_cast<std::size_t>(1 + k)] = at(25.0, sixth * k, 6.216);
      nodes[static_cast<std::size_t>(7 + k)] = at(50.0, sixth * (k + 0.5), 0.0);
      bars.push_back({0, 1 + k});
      bars.push_back({1 + k, 1 + (k + 1) % 6});
      bars.push_back({1 + k, 7 + k});
      bars.push_back({1 + k, 7 + (k + 5) % 6});
    }
  }

  Vec3 place(int node, const Vector& x) const {
    const Vec3& start = nodes[static_cast<std::size_t>(node)];
    return node < 7 ? Vec3(start + x.segment<3>(3 * node)) : start;
  }
};

// V = ½ Σ L₀ (l/L₀ − 1)² + λ z of the apex.
SmoothToy star_dome() {
  const Dome dome;
  SmoothToy toy;
  toy.unknowns = 21;
  const auto each_bar = [dome](const Vector& x, const auto& add) {
    for (const SpaceBar& bar : dome.bars) {
      const Vec3 r = dome.place(bar.to, x) - dome.place(bar.from, x);
      const double L =
          (dome.nodes[static_cast<std::size_t>(bar.to)] - dome.nodes[static_cast<std::size_t>(bar.from)]).norm();
      add(bar, r, r.norm(), L);
    }
  };
  toy.potential = [each_bar](const Vector& x, double lambda) {
    double sum = lambda * x[2];
    each_bar(x, [&](const SpaceBar&, const Vec3&, double l, double L) { sum += 0.5 * L * std::pow(l / L - 1.0, 2); });
    return sum;
  };
  toy.F = [each_bar](const Vector& x, double lambda) -> Vector {
    Vector F = Vector::Zero(21);
    F[2] = lambda;
    each_bar(x, [&](const SpaceBar& bar, const Vec3& r, double l, double L) {
      const Vec3 force = (l / L - 1.0) * r / l;
      F.segment<3>(3 * bar.from) -= force;
      if (bar.to < 7) F.segment<3>(3 * bar.to) += force;
    });
    return F;
  };
  toy.K = [each_bar](const Vector& x, double) -> Matrix {
    Matrix K = Matrix::Zero(21, 21);
    each_bar(x, [&](const SpaceBar& bar, const Vec3& r, double l, double L) {
      const Vec3 n = r / l;
      const Eigen::Matrix3d k =
          n * n.transpose() / L + (1.0 / L - 1.0 / l) * (Eigen::Matrix3d::Identity() - n * n.transpose());
      K.block<3, 3>(3 * bar.from, 3 * bar.from) += k;
      if (bar.to >= 7) return;
      K.block<3, 3>(3 * bar.to, 3 * bar.to) += k;
      K.block<3, 3>(3 * bar.from, 3 * bar.to) -= k;
      K.block<3, 3>(3 * bar.to, 3 * bar.from) -= k;
    });
    return K;
  };
  toy.F_lambda = [](const Vector&, double) { return Vector(Vector::Unit(21, 2)); };
  return toy;
}

struct Singular {
  EventKind kind;
  double lambda;
  double apex;  // its descent, upwards positive
  Index multiplicity = 1;
};

constexpr auto limit = EventKind::limit_point, branches = EventKind::branch_point;
const Singular expected[] = {
    {limit, 0.00031565459615127224, -0.768440505197295},      {limit, -0.00027600019594723737, -3.027769320245371},
    {branches, 0.007774985152703406, -9.118078320126072, 2},  {branches, 0.008734826375059773, -10.081777352109768},
    {limit, 0.008865401394251772, -10.536555545842466},       {branches, 0.008784608612537806, -10.871571039719761, 2},
    {limit, -0.004746627741311194, -11.778446578915252},      {limit, 0.004746627741311194, -4.653553421084747},
    {branches, -0.008784608612537806, -5.560428960280239, 2}, {limit, -0.008865401394251772, -5.895444454157533},
    {branches, -0.008734826375059773, -6.350222647890233},    {branches, -0.007774985152703406, -7.3139216798739275, 2},
    {limit, 0.00027600019594723737, -13.40423067975463},      {limit, -0.00031565459615127224, -15.663559494802705}};

}  // namespace

TEST(StarDome, HasItsSimpleAndDoublePointsInOrder) {
  const SmoothToy dome = star_dome();
  for (const double step : {0.25, 1.0, 4.0}) {
    SCOPED_TRACE(step);
    TraceOptions options;
    options.step.first = 2e-5 * step;
    options.step.max *= step;
    options.target_values = {test::stop_at_lambda(0.01)};
    const test::Branch branch = test::trace(dome, options, {.x = Vector::Zero(21), .lambda = 0.0});
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    auto found = test::events_of(branch);
    found.erase(found.begin());  // the start
    ASSERT_EQ(found.size(), std::size(expected));
    for (std::size_t i = 0; i < found.size(); ++i) {
      SCOPED_TRACE(i);
      EXPECT_EQ(found[i].kind, expected[i].kind);
      EXPECT_FALSE(found[i].unconfirmed);
      EXPECT_NEAR(found[i].state.lambda, expected[i].lambda, 1e-11);
      EXPECT_NEAR(found[i].state.x[2], expected[i].apex, 1e-6);
      const Index change = found[i].unstable_after.value() - found[i].unstable_before.value();
      EXPECT_EQ(std::abs(change), expected[i].multiplicity);
      if (found[i].kind != branches) continue;
      EXPECT_EQ(found[i].branching->multiplicity, expected[i].multiplicity);
      EXPECT_EQ(found[i].branching->modes.size(), static_cast<std::size_t>(expected[i].multiplicity));
      const auto type = expected[i].multiplicity == 1 ? BranchType::pitchfork : BranchType::multiple;
      EXPECT_EQ(found[i].branching->type, type);
    }
  }
}

}  // namespace arcwall::star_dome_test
