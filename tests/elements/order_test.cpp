#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "tests/support/branch.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/models.hpp"

// Order of convergence: of the classic beam 4 in displacements and limit loads, 6 on circles; of the elastica beams 4
// and 6, and circles are exact.
namespace arcwall::order_test {

namespace {

struct Tip {
  Vec2 displacement;
  double rotation;
};

// Node 1 is the tip.
Tip tip_of(const Structure& structure, const State& state) {
  return {.displacement = structure.current(state, 1) - structure.position(1),
          .rotation = structure.value(state, structure.members()[0].rotations.back().value())};
}

Tip solved_tip(const test::Cantilever& cantilever, double lambda) {
  const auto structure = cantilever.structure();
  return tip_of(*structure, test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, lambda, 40));
}

// A cantilever with EI = 1 whose tip carries `constant` and λ times `varying`.
std::unique_ptr<Structure> loaded_cantilever(std::unique_ptr<Axis> axis, std::vector<SineDeviation> imperfection,
                                             int elements, const test::BeamTheory& beam, double EA,
                                             const Vec2& constant, const Vec2& varying) {
  StructureBuilder builder;
  const Vec2 a = axis->at(0.0).position, b = axis->at(axis->length()).position;
  const Index root = builder.add_joint(a), tip = builder.add_joint(b);
  builder.add_member({.name = "column",
                      .from = root,
                      .to = tip,
                      .axis = std::move(axis),
                      .imperfection = std::move(imperfection),
                      .theory = beam.theory,
                      .order = beam.order,
                      .section = {.E = 1.0, .A = EA, .I = 1.0},
                      .elements = elements});
  for (const Dof which : {Dof::x, Dof::z}) {
    const int i = which == Dof::x ? 0 : 1;
    builder.fix(builder.dof(root, which));
    builder.add_load(builder.dof(tip, which), constant[i], LoadKind::constant);
    builder.add_load(builder.dof(tip, which), varying[i], LoadKind::proportional);
  }
  builder.fix(builder.shared_rotation(root).value());
  return builder.build();
}

// Under an axial force P: reached under an inclined one, whose transverse part is then taken away.
Tip buckled_tip(int elements, const test::BeamTheory& beam, double EA, double P) {
  const Vec2 inclined(-P, 0.2 * P);
  const auto straight = [] { return straight_axis({0.0, 0.0}, {1.0, 0.0}); };
  const auto bent = loaded_cantilever(straight(), {}, elements, beam, EA, Vec2::Zero(), inclined);
  const State state = test::solved_at(*bent, {.x = Vector::Zero(bent->size({}))}, 1.0, 40);
  const auto column = loaded_cantilever(straight(), {}, elements, beam, EA, {-P, 0.0}, {0.0, inclined.y()});
  return tip_of(*column, test::solved_at(*column, state, 0.0, 20));
}

void expect_order(double order, const std::vector<double>& sizes, const std::vector<double>& errors) {
  EXPECT_NEAR(test::observed_order(sizes, errors), order, 0.2);
  const std::size_t n = sizes.size();
  EXPECT_NEAR(test::observed_order({sizes[n - 2], sizes[n - 1]}, {errors[n - 2], errors[n - 1]}), order, 0.2);
}

// First limit load of a model.
double first_limit_load(const std::unique_ptr<Structure>& structure, double first_step, double until) {
  TraceOptions options;
  options.step.first = first_step;
  options.target_values.push_back(test::stop_at_lambda(until));
  Tracer tracer(*structure, test::rest(*structure), options);
  while (const auto arc = tracer.next())
    for (const Event& event : arc->events)
      if (event.kind == EventKind::limit_point) return event.state.lambda;
  ADD_FAILURE() << "no limit point";
  return 0.0;
}

// A straight cantilever of length 1, EI = 1, clamped at the left along x, under a dead force n at its tip, as an
// extensible elastica. With N(θ) = n·t and M = 0 where θ = α at the tip, the first integral is
//
//   M² = 2 [N(α) − N(θ)] [1 + (N(α) + N(θ))/(2 EA)],   N(α) − N(θ) = 2 sin((α − θ)/2) n·t⊥((α + θ)/2)
//
// and with θ = α (1 − u²) all of ∫ ds = ∫ dθ/M and ∫ (1 + N/EA) t ds are smooth.
struct ExactTip {
  double length = 0.0;
  Vec2 position = Vec2::Zero();
};

ExactTip exact_tip(const Vec2& n, double EA, double alpha) {
  const auto t = [](double angle) { return Vec2(std::cos(angle), std::sin(angle)); };
  const auto rate = [&](double u) {
    const double theta = alpha * (1.0 - u * u), N = n.dot(t(theta));
    const double sine_over_square = u > 0.0 ? std::sin(0.5 * alpha * u * u) / (u * u) : 0.5 * alpha;
    const double moment_over_u = std::sqrt(4.0 * sine_over_square * n.dot(perp(t(0.5 * (alpha + theta)))) *
                                           (1.0 + 0.5 * (n.dot(t(alpha)) + N) / EA));
    const double ds = 2.0 * alpha / moment_over_u;
    return Eigen::Vector3d(ds, (1.0 + N / EA) * std::cos(theta) * ds, (1.0 + N / EA) * std::sin(theta) * ds);
  };
  Eigen::Vector3d integral = Eigen::Vector3d::Zero();
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i)
    for (const double node : {-Gauss::abscissa()[i], Gauss::abscissa()[i]})
      integral += 0.5 * Gauss::weights()[i] * rate(0.5 * (1.0 + node));
  return {.length = integral[0], .position = integral.tail<2>()};
}

// The angle α at which the length is 1, between two that enclose it.
double exact_tip_angle(const Vec2& n, double EA, double low, double high) {
  boost::uintmax_t iterations = 100;
  const auto bracket =
      boost::math::tools::toms748_solve([&](double alpha) { return exact_tip(n, EA, alpha).length - 1.0; }, low, high,
                                        boost::math::tools::eps_tolerance<double>(52), iterations);
  return 0.5 * (bracket.first + bracket.second);
}

Tip exact(const Vec2& n, double EA, double alpha) {
  return {.displacement = exact_tip(n, EA, alpha).position - Vec2(1.0, 0.0), .rotation = alpha};
}

// The same for a cantilever of any stress-free shape, by its initial value problem in the arc length s of the axis,
// where the curve is v times as long and turns at the rate φ′:
//
//   r′ = v (1 + N/EA) t,   θ′ = φ′ + v M/EI,   M′ = −v (1 + N/EA) n·t⊥,   n′ = −v q
//
// Runge and Kutta's rule with 16000 steps is off by less than 1e-13; the moment at the root is that with which M ends
// at zero.
// The dead load q per length of the curve is carried as n.
struct DeadLoad {
  Vec2 tip = Vec2::Zero(), distributed = Vec2::Zero();
};

Tip shot(const ImperfectAxis& shape, double length, const DeadLoad& load, double EA, double low, double high) {
  constexpr std::size_t steps = 16000;
  const double d = length / double(steps);
  std::vector<DeviatedPoint> rest;  // at the ends and in the middle of each step
  for (std::size_t i = 0; i <= 2 * steps; ++i) rest.push_back(shape.along(length * double(i) / double(2 * steps)));
  using State = Eigen::Matrix<double, 6, 1>;  // x, z, θ, M, n
  const auto rate = [&](const DeviatedPoint& at, const State& y) {
    const Vec2 t(std::cos(y[2]), std::sin(y[2])), n = y.tail<2>();
    const double stretch = at.speed * (1.0 + n.dot(t) / EA);
    State r;
    r << stretch * t, at.turning + at.speed * y[3], -stretch * n.dot(perp(t)), -at.speed * load.distributed;
    return r;
  };
  const auto end = [&](double moment) {
    State y;
    y << 0.0, 0.0, rest.front().angle, moment, load.tip + shape.length(0.0, length) * load.distributed;
    for (std::size_t i = 0; i < 2 * steps; i += 2) {
      const State k1 = rate(rest[i], y), k2 = rate(rest[i + 1], y + 0.5 * d * k1),
                  k3 = rate(rest[i + 1], y + 0.5 * d * k2), k4 = rate(rest[i + 2], y + d * k3);
      y += d / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    return y;
  };
  boost::uintmax_t iterations = 60;
  const auto bracket = boost::math::tools::toms748_solve([&](double moment) { return end(moment)[3]; }, low, high,
                                                         boost::math::tools::eps_tolerance<double>(48), iterations);
  const State y = end(bracket.first);
  return {.displacement = y.head<2>() - (shape.at(length).position - shape.at(0.0).position),
          .rotation = y[2] - shape.at(length).angle};
}

constexpr int elastica_orders[] = {4, 6};

test::BeamTheory elastica(int order) { return {.theory = Theory::elastica, .order = order}; }

}  // namespace

// End moment m = M L/EI bends a cantilever to a circle: x/L = sin m/m, y/L = (1 − cos m)/m, θ = m; N = 0, so EA does
// not enter. Half a circle: m = π. Circles are bent with order 6, other shapes with order 4.
TEST(BeamOrder, CantileverUnderAnEndMomentConvergesWithOrderSix) {
  std::vector<double> sizes, errors;
  for (const int elements : {4, 8, 16, 32}) {
    const Tip tip = solved_tip({.EA = 1e3, .EI = 1.0, .length = 1.0, .elements = elements, .tip_moment = 1.0}, pi);
    EXPECT_NEAR(tip.rotation, pi, 1e-10);  // exact on any mesh
    sizes.push_back(1.0 / elements);
    errors.push_back((tip.displacement - Vec2(-1.0, 2.0 / pi)).norm());
  }
  expect_order(6.0, sizes, errors);
  EXPECT_LE(errors.back(), 1e-8);
}

TEST(BeamOrder, CantileverRollsUpToTwoTurns) {
  const Tip tip = solved_tip({.EA = 1e3, .EI = 1.0, .length = 1.0, .elements = 40, .tip_moment = 1.0}, 4.0 * pi);
  EXPECT_NEAR(tip.rotation, 4.0 * pi, 1e-9);
  // Half angle of an element α = 4π/80: chords are off by 31/15120 α⁶ = 3e-8 of themselves, which cancels over whole
  // turns.
  EXPECT_LE((tip.displacement - Vec2(-1.0, 0.0)).norm(), 1e-8);
}

// Transverse tip load P L²/EI = 5, inextensible, by elliptic integrals (Mattiasson 1981): w/L, u/L, θ.
TEST(BeamOrder, CantileverUnderATransverseTipLoadConvergesWithOrderFour) {
  const Vec2 expected(-0.38762836072442987186, 0.71379152361191272809);
  const double expected_rotation = 1.2153681176116810959;
  std::vector<double> sizes, errors, rotation_errors;
  for (const int elements : {4, 8, 16, 32}) {
    // The stretch P/EA = 5e-10 is far below the errors.
    const Tip tip = solved_tip({.EA = 1e10, .EI = 1.0, .length = 1.0, .elements = elements, .tip_force = 1.0}, 5.0);
    sizes.push_back(1.0 / elements);
    errors.push_back((tip.displacement - expected).norm());
    rotation_errors.push_back(tip.rotation - expected_rotation);
  }
  expect_order(4.0, sizes, errors);
  expect_order(4.0, sizes, rotation_errors);
  EXPECT_LE(errors.back(), 1e-6);
}

// The extensible elastica with 20000 elements. What rounding leaves of the matrix would hold the free end as if by a
// spring, were it not known that nothing does: the path then takes 466 iterations instead of 122.
TEST(BeamOrder, CantileverKeepsItsDigitsOnAFineMeshSlow) {
  constexpr double EA = 1e4;
  const auto structure =
      test::Cantilever{.EA = EA, .EI = 1.0, .length = 1.0, .elements = 20000, .tip_force = 1.0}.structure();
  TraceOptions options;
  options.step.first = 0.5;
  options.target_values.push_back(test::stop_at_lambda(5.0));
  int iterations = 0;
  options.ledger = [&](const StepAttempt& attempt) { iterations += attempt.iterations; };
  Tracer tracer(*structure, test::rest(*structure), options);
  while (tracer.next()) continue;
  ASSERT_EQ(tracer.here().state.lambda, 5.0);
  const Vec2 load(0.0, 5.0);
  const Tip expected = exact(load, EA, exact_tip_angle(load, EA, 1.0, 1.4));
  const Tip tip = tip_of(*structure, tracer.here().state);
  EXPECT_LE((tip.displacement - expected.displacement).norm(), 1e-10);
  EXPECT_NEAR(tip.rotation, expected.rotation, 1e-10);
  EXPECT_LT(iterations, 250);
}

// Lee's frame: 1.855672753757 by shooting with the extensible elastica (EA = 4320), confirmed by collocation to 3e-11.
TEST(BeamOrder, LimitLoadOfLeesFrameConvergesWithOrderFour) {
  std::vector<double> sizes, errors;
  for (const int elements : {10, 20, 40, 80}) {
    sizes.push_back(1.0 / elements);
    errors.push_back(first_limit_load(test::lee_frame(elements), 0.1, 3.0) - 1.855672753757);
  }
  expect_order(4.0, sizes, errors);
  EXPECT_LE(std::abs(errors.back()), 2e-8);
}

// The same with 20000 elements, whose stiffness is 10¹⁷ times the frame's: what rounding leaves of the matrix alone
// gives five digits.
TEST(BeamOrder, LimitLoadOfLeesFrameKeepsItsDigitsOnAFineMeshSlow) {
  EXPECT_NEAR(first_limit_load(test::lee_frame(20000), 0.1, 3.0), 1.855672753757, 5e-9);
}

// The 215° arch with EA = 1e8: 897.294947593916 by shooting with the extensible elastica. Initially curved elements.
TEST(BeamOrder, LimitLoadOfTheDeepArchConvergesWithOrderFour) {
  std::vector<double> sizes, errors;
  for (const int elements : {8, 16, 32, 64}) {
    sizes.push_back(1.0 / elements);
    errors.push_back(first_limit_load(test::deep_arch(elements), 20.0, 1200.0) / 897.294947593916 - 1.0);
  }
  expect_order(4.0, sizes, errors);
  // Extrapolated from the last two meshes: what the next terms of the error leave.
  const double extrapolated = (16.0 * errors[3] - errors[2]) / 15.0;
  EXPECT_NEAR(extrapolated, 0.0, 1e-8);
}

// The angle of a circle is linear along the axis, which both elements can be; chords are then exact.
TEST(ElasticaOrderOfConvergence, CirclesAreExactOnAnyMesh) {
  for (const int order : elastica_orders) {
    const Tip tip = solved_tip(
        {.EA = 1e3, .EI = 1.0, .length = 1.0, .elements = 4, .tip_moment = 1.0, .beam = elastica(order)}, pi);
    EXPECT_NEAR(tip.rotation, pi, 1e-12);
    EXPECT_LE((tip.displacement - Vec2(-1.0, 2.0 / pi)).norm(), 1e-12);
  }
}

// Mattiasson 1981, P L²/EI = 5, inextensible.
TEST(ExactCantilever, IsThatOfTheEllipticIntegrals) {
  const Vec2 n(0.0, 5.0);
  const Tip tip = exact(n, 1e15, exact_tip_angle(n, 1e15, 1.0, 1.4));
  EXPECT_LE((tip.displacement - Vec2(-0.38762836072442987186, 0.71379152361191272809)).norm(), 1e-14);
  EXPECT_NEAR(tip.rotation, 1.2153681176116810959, 1e-14);
}

// Tip load P L²/EI = 10 with EA L²/EI = 1000, so that the axis stretches by up to 1 %.
TEST(ElasticaOrderOfConvergence, CantileverUnderATransverseTipLoad) {
  const Vec2 n(0.0, 10.0);
  const Tip expected = exact(n, 1e3, exact_tip_angle(n, 1e3, 1.2, 1.5));
  for (const int order : elastica_orders) {
    SCOPED_TRACE(order);
    std::vector<double> sizes, errors, rotation_errors;
    for (const int elements : {8, 12, 18, 27}) {
      const Tip tip = solved_tip(
          {.EA = 1e3, .EI = 1.0, .length = 1.0, .elements = elements, .tip_force = 1.0, .beam = elastica(order)}, 10.0);
      sizes.push_back(1.0 / elements);
      errors.push_back((tip.displacement - expected.displacement).norm());
      rotation_errors.push_back(tip.rotation - expected.rotation);
    }
    expect_order(order, sizes, errors);
    expect_order(order, sizes, rotation_errors);
  }
}

// A distributed load makes the force vary along the element, which neither element follows: order 4, and where the axis
// stretches a remainder of order 2 (docs/theory.md, section 2.5); here P/EA = 1e-7.
TEST(ElasticaOrderOfConvergence, CantileverUnderADistributedLoad) {
  constexpr double EA = 1e8;
  const Vec2 q(-2.0, 12.0);
  const auto axis = straight_axis({0.0, 0.0}, {1.0, 0.0});
  const Tip expected = shot(ImperfectAxis(*axis, {}), 1.0, {.distributed = q}, EA, 0.0, 20.0);
  for (const int order : elastica_orders) {
    SCOPED_TRACE(order);
    std::vector<double> sizes, errors;
    for (const int elements : {8, 12, 18, 27}) {
      StructureBuilder builder;
      const Index root = builder.add_joint({0.0, 0.0}), tip = builder.add_joint({1.0, 0.0});
      const Index member = builder.add_member({.name = "beam",
                                               .from = root,
                                               .to = tip,
                                               .axis = straight_axis({0.0, 0.0}, {1.0, 0.0}),
                                               .theory = Theory::elastica,
                                               .order = order,
                                               .section = {.E = 1.0, .A = EA, .I = 1.0},
                                               .elements = elements});
      builder.fix(builder.dof(root, Dof::x));
      builder.fix(builder.dof(root, Dof::z));
      builder.fix(builder.shared_rotation(root).value());
      builder.add_distributed_load(member, q, LoadKind::proportional);
      const auto structure = builder.build();
      const Tip found =
          tip_of(*structure, test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, 1.0, 20));
      sizes.push_back(1.0 / elements);
      errors.push_back((found.displacement - expected.displacement).norm());
    }
    expect_order(4.0, sizes, errors);
  }
}

// Half of a pinned column is a cantilever under an axial force; 1.3 times the Euler load π² EI/(4 L²).
TEST(ElasticaOrderOfConvergence, ColumnBehindItsBucklingLoad) {
  constexpr double EA = 1e3, P = 1.3 * pi * pi / 4.0;
  const Vec2 n(-P, 0.0);
  const Tip expected = exact(n, EA, exact_tip_angle(n, EA, 0.5, 2.0));
  for (const int order : elastica_orders) {
    SCOPED_TRACE(order);
    std::vector<double> sizes, errors, rotation_errors;
    for (const int elements : {6, 9, 12, 18}) {
      const Tip tip = buckled_tip(elements, elastica(order), EA, P);
      sizes.push_back(1.0 / elements);
      errors.push_back((tip.displacement - expected.displacement).norm());
      rotation_errors.push_back(tip.rotation - expected.rotation);
    }
    expect_order(order, sizes, errors);
    expect_order(order, sizes, rotation_errors);
  }
}

// A sine wave with an imperfection, which no polynomial angle follows exactly: curvature and stretch vary along it.
TEST(ElasticaOrderOfConvergence, CantileverOfAnyStressFreeShape) {
  constexpr double EA = 1e3;
  const Vec2 n(-1.0, 3.0), a(0.0, 0.0), b(1.0, 0.2);
  const std::vector<SineDeviation> waves{{.amplitude = 0.02, .waves = 3}};
  const auto axis = sine_axis(a, b, 0.1, 2);
  const Tip expected = shot(ImperfectAxis(*axis, waves), axis->length(), {.tip = n}, EA, 0.0, 5.0);
  for (const int order : elastica_orders) {
    SCOPED_TRACE(order);
    std::vector<double> sizes, errors;
    for (const int elements : {16, 20, 24, 32}) {
      const auto structure =
          loaded_cantilever(sine_axis(a, b, 0.1, 2), waves, elements, elastica(order), EA, Vec2::Zero(), n);
      const Tip tip =
          tip_of(*structure, test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, 1.0, 10));
      sizes.push_back(1.0 / elements);
      errors.push_back((tip.displacement - expected.displacement).norm());
    }
    expect_order(order, sizes, errors);
  }
}

TEST(ElasticaOrderOfConvergence, LimitLoadOfLeesFrame) {
  for (const int order : elastica_orders) {
    SCOPED_TRACE(order);
    std::vector<double> sizes, errors;
    for (const int elements : {5, 10, 15, 20}) {
      sizes.push_back(1.0 / elements);
      errors.push_back(first_limit_load(test::lee_frame(elements, elastica(order)), 0.1, 3.0) - 1.855672753757);
    }
    expect_order(order, sizes, errors);
  }
}

TEST(ElasticaOrderOfConvergence, LimitLoadOfTheDeepArch) {
  for (const int order : elastica_orders) {
    SCOPED_TRACE(order);
    std::vector<double> sizes, errors;
    for (const int elements : {12, 16, 24, 32}) {
      sizes.push_back(1.0 / elements);
      errors.push_back(first_limit_load(test::deep_arch(elements, elastica(order)), 20.0, 1200.0) / 897.294947593916 -
                       1.0);
    }
    expect_order(order, sizes, errors);
  }
}

}  // namespace arcwall::order_test
