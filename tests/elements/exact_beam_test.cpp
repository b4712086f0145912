#include "elements/exact_beam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "tests/elements/element_checks.hpp"
#include "tests/support/branch.hpp"
#include "tests/support/models.hpp"

namespace arcwall {

namespace {

using test::evaluated;
using test::expect_derivatives;
using test::Numbers;

constexpr ExactBeamStiffness stiffness{.EA = 200.0, .GA = 70.0, .EI = 3.0};

// A stretch of a circle that turns from −half to half about its chord, or straight where half = 0; of unequal parts.
ExactBeamReference stretch(int order, double half) {
  constexpr double length = 1.3, direction = 0.7;
  const auto at = [&](double s) {
    const double a = half * (1.0 - 2.0 * s / length);  // tangent against the chord
    const Vec2 along =
        half == 0.0 ? Vec2(s, 0.0)
                    : Vec2(length / (2.0 * half) * Vec2(std::sin(half) - std::sin(a), std::cos(a) - std::cos(half)));
    return Vec2(Eigen::Rotation2Dd(direction) * along);
  };
  ExactBeamReference reference;
  for (const double s : order == 1 ? std::vector{0.0, length} : std::vector{0.0, 0.53 * length, length}) {
    reference.nodes.push_back(at(s));
    reference.arcs.push_back(s);
  }
  return reference;
}

std::vector<ExactBeamReference> stretches() {
  return {stretch(1, 0.0), stretch(1, 0.4), stretch(2, 0.0), stretch(2, 0.4)};
}

// The element moved as a rigid body: turned by `angle` about its first node and shifted.
Vector rigid_motion(const ExactBeamReference& reference, double angle, const Vec2& shift) {
  Vector u(3 * (reference.order() + 1));
  for (std::size_t a = 0; a < reference.nodes.size(); ++a)
    u.segment<3>(static_cast<Index>(3 * a))
        << shift + Eigen::Rotation2Dd(angle) * reference.nodes[a] - reference.nodes[a],
        angle;
  return u;
}

}  // namespace

TEST(ExactBeam, DerivativesAreConsistentStraightAndCurved) {
  Numbers numbers(30);
  for (const ExactBeamReference& reference : stretches()) {
    const ExactBeam beam(reference, stiffness);
    const Index n = beam.unknown_count();
    expect_derivatives(beam, Vector::Zero(n));
    for (int i = 0; i < 10; ++i) expect_derivatives(beam, 0.5 * numbers.vector(n));
    for (const double angle : {2.0, -9.0, 50.0})
      expect_derivatives(beam, rigid_motion(reference, angle, {0.4, -3.0}) + 0.2 * numbers.vector(n));
  }
}

TEST(ExactBeam, RigidMotionsOfAnyAngleGiveNoForce) {
  for (const ExactBeamReference& reference : stretches()) {
    const ExactBeam beam(reference, stiffness);
    for (const double angle : {0.0, 0.1, 1.5, 3.0, 3.3, -4.0, 2.0 * pi, 17.0, -40.0}) {
      SCOPED_TRACE(angle);
      const auto moved = evaluated(beam, rigid_motion(reference, angle, {3.0, -2.0}));
      // Displacements of size 5 and angles up to 40 are known to ε.
      const double roundoff = 1e-15 * 40.0 * stiffness.EA;
      EXPECT_LE(moved.f.norm(), 10.0 * roundoff);
      EXPECT_NEAR(moved.energy, 0.0, 1e-24 * stiffness.EA * 40.0 * 40.0);
    }
  }
}

// Reduced integration leaves no motion without energy but the rigid ones.
TEST(ExactBeam, StiffnessAtRestHasTheThreeRigidMotionsAndNoOther) {
  for (const ExactBeamReference& reference : stretches()) {
    const Matrix K = evaluated(ExactBeam(reference, stiffness), Vector::Zero(3 * (reference.order() + 1))).K;
    const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(K).eigenvalues();
    EXPECT_LE(values.head(3).cwiseAbs().maxCoeff(), 1e-12 * values[values.size() - 1]);
    EXPECT_GT(values[3], 1e-3 * values[values.size() - 1]);
  }
}

TEST(ExactBeam, ForcesAreIndifferentToRotationsOfTheWhole) {
  Numbers numbers(31);
  for (const ExactBeamReference& reference : stretches()) {
    const ExactBeam beam(reference, stiffness);
    const Vector u = 0.5 * numbers.vector(beam.unknown_count());
    const auto at = evaluated(beam, u);
    const double angle = 2.6;
    const Eigen::Rotation2Dd turn(angle);
    Vector v = u, f = at.f;
    for (std::size_t a = 0; a < reference.nodes.size(); ++a) {
      const auto i = static_cast<Index>(3 * a);
      v.segment<2>(i) = turn * Vec2(reference.nodes[a] + u.segment<2>(i)) - reference.nodes[a];
      v[i + 2] += angle;
      f.segment<2>(i) = turn * Vec2(at.f.segment<2>(i));
    }
    const auto after = evaluated(beam, v);
    EXPECT_NEAR(after.energy, at.energy, 1e-13 * stiffness.EA);
    EXPECT_LE((after.f - f).norm(), 1e-13 * stiffness.EA * 10.0);
  }
}

// Stretched by e, sheared by g and bent by k, all constant: resultants are the stiffnesses times these, at any
// rotation.
TEST(ExactBeam, ConstantStrainsGiveTheirExactForces) {
  constexpr double e = 0.1, g = -0.2, turn = 1.9;
  for (const int order : {1, 2}) {
    const ExactBeamReference reference = stretch(order, 0.0);
    const Vec2 axis = reference.nodes.back().normalized();
    const Eigen::Rotation2Dd rotation(turn);
    const Vec2 t = rotation * axis, n = perp(t);
    Vector u(3 * (order + 1));
    for (std::size_t a = 0; a < reference.nodes.size(); ++a)
      u.segment<3>(static_cast<Index>(3 * a)) << reference.arcs[a] * ((1.0 + e) * t + g * n) - reference.nodes[a], turn;
    const Vector f = evaluated(ExactBeam(reference, stiffness), u).f;
    const Vec2 force = stiffness.EA * e * t + stiffness.GA * g * n;
    EXPECT_LE((f.segment<2>(f.size() - 3) - force).norm(), 1e-13 * stiffness.EA);
    EXPECT_LE((f.segment<2>(0) + force).norm(), 1e-13 * stiffness.EA);
    // The moments at the ends balance the couple of the forces.
    const Vec2 r = reference.arcs.back() * ((1.0 + e) * t + g * n);
    double moments = 0.0;
    for (Index i = 2; i < f.size(); i += 3) moments += f[i];
    EXPECT_NEAR(moments, -(r.x() * force.y() - r.y() * force.x()), 1e-13 * stiffness.EA);
  }
}

TEST(ExactDistributedLoad, IsLinearAndItsForcesAddUp) {
  Numbers numbers(32);
  const Vec2 load(0.8, -2.0);
  for (const ExactBeamReference& reference : stretches()) {
    const ExactDistributedLoad element(reference, load);
    const Vector u = numbers.vector(element.unknown_count());
    expect_derivatives(element, u);
    const auto at = evaluated(element, u);
    EXPECT_EQ(at.K, Matrix::Zero(u.size(), u.size()));
    Vec2 sum = Vec2::Zero();
    for (Index i = 0; i < u.size(); i += 3) sum += at.f.segment<2>(i);
    EXPECT_LE((sum + reference.arcs.back() * load).norm(), 1e-14);
  }
}

// Equal parts: a sixth, four sixths, a sixth, which is Simpson's rule.
TEST(ExactDistributedLoad, OfOrderTwoIsSharedAsInSimpsonsRule) {
  const ExactDistributedLoad element({.nodes = {{0, 0}, {1, 0}, {2, 0}}, .arcs = {0.0, 1.0, 2.0}}, {0.0, 3.0});
  const Vector f = -evaluated(element, Vector::Zero(9)).f;
  EXPECT_NEAR(f[1], 1.0, 1e-14);
  EXPECT_NEAR(f[4], 4.0, 1e-14);
  EXPECT_NEAR(f[7], 1.0, 1e-14);
}

namespace {

// E = G = 1, so that areas are stiffnesses.
Section section(const ExactBeamStiffness& of) {
  return {.E = 1.0, .A = of.EA, .I = of.EI, .G = 1.0, .shear_area = of.GA};
}

// A cantilever along an axis, clamped at its start.
struct Cantilever {
  ExactBeamStiffness stiffness{};
  int order = 2, elements = 1;
  Vec2 tip_force = Vec2::Zero();
  double tip_moment = 0.0;
  Vec2 distributed = Vec2::Zero();
  std::vector<SineDeviation> imperfection{};

  std::unique_ptr<Structure> along(std::unique_ptr<Axis> axis) const {
    StructureBuilder builder;
    const Index root = builder.add_joint(axis->at(0.0).position);
    const Index tip = builder.add_joint(axis->at(axis->length()).position);
    const Index member = builder.add_member({.name = "cantilever",
                                             .from = root,
                                             .to = tip,
                                             .axis = std::move(axis),
                                             .imperfection = imperfection,
                                             .theory = Theory::exact,
                                             .order = order,
                                             .section = section(stiffness),
                                             .elements = elements});
    for (const Freedom which : {Freedom::x, Freedom::z}) builder.fix(builder.freedom(root, which));
    builder.fix(builder.shared_rotation(root).value());
    builder.add_load(builder.freedom(tip, Freedom::x), tip_force.x(), LoadKind::proportional);
    builder.add_load(builder.freedom(tip, Freedom::z), tip_force.y(), LoadKind::proportional);
    builder.add_load(builder.shared_rotation(tip).value(), tip_moment, LoadKind::proportional);
    if (distributed != Vec2::Zero()) builder.add_distributed_load(member, distributed, LoadKind::proportional);
    return builder.build();
  }
  std::unique_ptr<Structure> straight() const { return along(straight_axis({0.0, 0.0}, {1.0, 0.0})); }
};

constexpr Index tip = 1;  // the second joint

Vec2 displacement(const Structure& structure, const Vector& x, Index node) {
  return structure.current(x, node) - structure.position(node);
}

// Displacement of the tip under small loads: −K(0)⁻¹ F_λ.
Vec2 linear_tip(const Structure& structure) {
  Linearization rest;
  structure.linearize(test::rest(structure), rest);
  const Matrix K = test::full(rest.K);
  return displacement(structure, Vector(K.ldlt().solve(-rest.F_lambda)), tip);
}

// Errors over four meshes, each twice as fine as the one before, fall with h^(2 order). `finest_error` is a little
// above the error measured on the finest mesh.
void expect_order(int order, int coarsest, double finest_error, const std::function<double(int elements)>& error) {
  SCOPED_TRACE("order " + std::to_string(order));
  std::vector<double> sizes, errors;
  for (int elements = coarsest; sizes.size() < 4; elements *= 2) {
    sizes.push_back(1.0 / elements);
    errors.push_back(error(elements));
  }
  EXPECT_NEAR(test::observed_order(sizes, errors), 2.0 * order, 0.2);
  EXPECT_LE(std::abs(errors.back()), finest_error);
}

State solved(const Structure& structure, double lambda, int steps) {
  return test::solved_at(structure, test::rest(structure), lambda, steps);
}

}  // namespace

// Timoshenko's beam under a tip force: P L³/(3 EI) + P L/GA, whatever the thickness. Order 2 has it on any mesh; order
// 1 misses 1/(4 n²) of the bending.
TEST(ExactBeamOrder, ThinBeamsDoNotLock) {
  for (const double thickness : {0.1, 1e-2, 1e-3, 1e-4}) {
    SCOPED_TRACE(thickness);
    const double EI = thickness * thickness / 12.0, GA = 0.3;
    const double bending = 1.0 / (3.0 * EI), shear = 1.0 / GA;
    for (const int elements : {1, 2, 4}) {
      const auto deflection = [&](int order) {
        const Cantilever beam{.stiffness = {.EA = 1.0, .GA = GA, .EI = EI},
                              .order = order,
                              .elements = elements,
                              .tip_force = {0.0, 1.0}};
        return linear_tip(*beam.straight()).y();
      };
      const double tolerance = 1e-15 / EI * bending;  // ε times the condition of K
      EXPECT_NEAR(deflection(1), bending * (1.0 - 0.25 / (elements * elements)) + shear, tolerance);
      EXPECT_NEAR(deflection(2), bending + shear, tolerance);
    }
  }
}

// End moment m = M L/EI: x/L = sin m/m, z/L = (1 − cos m)/m, θ = m; there are no forces, so EA and GA do not enter.
TEST(ExactBeamOrder, CantileverUnderAnEndMoment) {
  for (const int order : {1, 2})
    expect_order(order, order == 1 ? 8 : 4, order == 1 ? 7e-5 : 1.5e-8, [&](int elements) {
      const Cantilever beam{
          .stiffness = {.EA = 1e3, .GA = 400.0, .EI = 1.0}, .order = order, .elements = elements, .tip_moment = 1.0};
      const auto structure = beam.straight();
      const State state = solved(*structure, pi, 20);
      return (structure->current(state.x, tip) - Vec2(0.0, 2.0 / pi)).norm();
    });
}

// The moment does work on the rotation, at any size: a full circle at 2π, two at 4π.
TEST(ExactBeamOrder, AnEndMomentRollsTheCantileverUp) {
  const Cantilever beam{
      .stiffness = {.EA = 1e3, .GA = 400.0, .EI = 1.0}, .order = 2, .elements = 24, .tip_moment = 1.0};
  const auto structure = beam.straight();
  const Index rotation = structure->members()[0].rotations.back().value();
  for (const int turns : {1, 2}) {
    const State state = solved(*structure, 2.0 * pi * turns, 40 * turns);
    EXPECT_NEAR(structure->value(state.x, rotation), 2.0 * pi * turns, 1e-10);
    EXPECT_LE(structure->current(state.x, tip).norm(), 1e-3);
    EXPECT_NEAR(structure->energy(state), -0.5 * std::pow(2.0 * pi * turns, 2), 1e-9);
  }
}

// A quarter of a circle of radius 1 under a small tip force or load along z. With N = V sin α, Q = V cos α, V the force
// beyond a section at α, and arms of 1 − sin α to the tip, Castigliano's theorem gives
// P [(3π/4 − 2)/EI + (π/4)/EA + (π/4)/GA] and q [(5/4 − π/2 + π²/16)/EI + (π²/16 − 1/4)/EA + (π²/16 + 1/4)/GA].
TEST(ExactBeamOrder, QuarterCircleUnderSmallLoads) {
  constexpr ExactBeamStiffness thick{.EA = 100.0, .GA = 40.0, .EI = 1.0};
  const auto axis = [] { return arc_axis({0.0, 0.0}, {std::sqrt(0.5), 1.0 - std::sqrt(0.5)}, {1.0, 1.0}); };
  const double under_force = (0.75 * pi - 2.0) / thick.EI + 0.25 * pi / thick.EA + 0.25 * pi / thick.GA;
  const double sixteenth = pi * pi / 16.0;
  const double under_load =
      (1.25 - 0.5 * pi + sixteenth) / thick.EI + (sixteenth - 0.25) / thick.EA + (sixteenth + 0.25) / thick.GA;
  for (const int order : {1, 2}) {
    expect_order(order, 4, order == 1 ? 1.2e-4 : 2.5e-8, [&](int elements) {
      const Cantilever beam{.stiffness = thick, .order = order, .elements = elements, .tip_force = {0.0, 1.0}};
      return linear_tip(*beam.along(axis())).y() - under_force;
    });
    expect_order(order, 4, order == 1 ? 1.2e-4 : 2.5e-8, [&](int elements) {
      const Cantilever beam{.stiffness = thick, .order = order, .elements = elements, .distributed = {0.0, 1.0}};
      return linear_tip(*beam.along(axis())).y() - under_load;
    });
  }
}

// Along z = y(x) = 0.2 sin πx, small force along z at the tip: Castigliano again, the integral by Simpson's rule. The
// nodes of the deviated axis are not equally far apart.
TEST(ExactBeamOrder, ImperfectCantileverUnderASmallForce) {
  constexpr ExactBeamStiffness thick{.EA = 100.0, .GA = 40.0, .EI = 1.0};
  const auto compliance = [&](double x) {
    const double slope = 0.2 * pi * std::cos(pi * x), ds = std::sqrt(1.0 + slope * slope);
    const double M = 1.0 - x, N = slope / ds, Q = 1.0 / ds;
    return ds * (M * M / thick.EI + N * N / thick.EA + Q * Q / thick.GA);
  };
  constexpr int parts = 2000;
  double exact = 0.0;
  for (int i = 0; i < parts; ++i)
    exact += (compliance(double(i) / parts) + 4.0 * compliance((i + 0.5) / parts) + compliance((i + 1.0) / parts)) /
             (6.0 * parts);
  for (const int order : {1, 2})
    expect_order(order, 4, order == 1 ? 1.2e-4 : 3e-9, [&](int elements) {
      const Cantilever beam{.stiffness = thick,
                            .order = order,
                            .elements = elements,
                            .tip_force = {0.0, 1.0},
                            .imperfection = {{.amplitude = 0.2, .waves = 1}}};
      return linear_tip(*beam.straight()).y() - exact;
    });
}

namespace {

// A straight pinned column of length 1 and EI = 1, EA = 1000, GA = 500, pushed by λ.
std::unique_ptr<Structure> pinned_column(int order, int elements) {
  StructureBuilder builder;
  const Index left = builder.add_joint({0.0, 0.0}), right = builder.add_joint({1.0, 0.0});
  builder.add_member({.name = "column",
                      .from = left,
                      .to = right,
                      .axis = straight_axis({0.0, 0.0}, {1.0, 0.0}),
                      .theory = Theory::exact,
                      .order = order,
                      .section = section({.EA = 1000.0, .GA = 500.0, .EI = 1.0}),
                      .elements = elements});
  builder.fix(builder.freedom(left, Freedom::x));
  for (const Index end : {left, right}) builder.fix(builder.freedom(end, Freedom::z));
  builder.add_load(builder.freedom(right, Freedom::x), -1.0, LoadKind::proportional);
  return builder.build();
}

// Near the half wave whose ends turn by ±alpha: a sine in w, a cosine in θ.
State half_wave(const Structure& structure, double alpha, double chord, double middle, double lambda) {
  State state{.x = Vector::Zero(structure.size({})), .lambda = lambda};
  for (Index i = 0; i < state.x.size(); ++i) {
    const auto [node, freedom] = structure.meaning(i);
    const double s = structure.position(node).x();
    switch (freedom) {
      case Freedom::x:
        state.x[i] = (chord - 1.0) * s - 0.25 * (1.0 - chord) / pi * std::sin(2.0 * pi * s);
        break;
      case Freedom::z:
        state.x[i] = middle * std::sin(pi * s);
        break;
      case Freedom::rotation:
        state.x[i] = alpha * std::cos(pi * s);
        break;
    }
  }
  return state;
}

}  // namespace

// Engesser's load of a column that is flexible in shear and compressible: P (1 − P/EA + P/GA) = π² EI/L².
TEST(ExactBeamOrder, BucklingLoadOfAColumnFlexibleInShear) {
  constexpr double exact = 9.774071919207518;
  for (const int order : {1, 2})
    expect_order(order, 4, order == 1 ? 2e-2 : 3e-6, [&](int elements) {
      const auto structure = pinned_column(order, elements);
      // The straight column is in equilibrium at ε = −λ/EA; the least eigenvalue changes sign at the buckling load.
      const auto least = [&](double lambda) {
        State state{.x = Vector::Zero(structure->size({})), .lambda = lambda};
        for (Index i = 0; i < state.x.size(); ++i)
          if (structure->meaning(i).freedom == Freedom::x)
            state.x[i] = -lambda / 1000.0 * structure->position(structure->meaning(i).node).x();
        Linearization now;
        structure->linearize(state, now);
        EXPECT_LE(now.F.norm(), 1e-10);
        return Eigen::SelfAdjointEigenSolver<Matrix>(test::full(now.K), Eigen::EigenvaluesOnly).eigenvalues()[0];
      };
      double low = 8.0, high = 16.0;
      for (int i = 0; i < 44; ++i) (least(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
      return 0.5 * (low + high) - exact;
    });
}

// The same column far beyond: by shooting with 20 digits its ends have turned by 80° at this load, the pins are that
// far apart and the middle has moved so far.
TEST(ExactBeamOrder, PostBucklingOfAColumnFlexibleInShear) {
  constexpr double load = 12.710989706261067, chord = 0.5387607770484912, middle = 0.36192745099447826;
  constexpr double alpha = 80.0 * pi / 180.0;
  for (const int order : {1, 2}) {
    const auto state_error = [&](int elements) {
      const auto structure = pinned_column(order, elements);
      const State state = test::solved_at(*structure, half_wave(*structure, alpha, chord, middle, load), load, 1);
      const MemberMesh& mesh = structure->members()[0];
      const Vec2 end = structure->current(state.x, mesh.nodes.back());
      const Vec2 centre = structure->current(state.x, mesh.nodes[mesh.nodes.size() / 2]);
      return Eigen::Vector3d(structure->value(state.x, mesh.rotations.front().value()) - alpha, end.x() - chord,
                             centre.y() - middle);
    };
    for (const int which : {0, 1, 2})
      expect_order(order, order == 1 ? 16 : 8, order == 1 ? 2e-4 : 4e-8,
                   [&](int elements) { return state_error(elements)[which]; });
  }
}

namespace {

struct LimitPoint {
  double load;
  Vec2 displacement;
};

// The limit points of a path on which the loaded joint moves down to `lowest`.
std::vector<LimitPoint> limit_points(const Structure& structure, Index loaded, double first_step, double lowest) {
  TraceOptions options;
  options.step.first = first_step;
  const auto deflection = test::displacement(structure, loaded, Freedom::z);
  options.landmarks.push_back({.quantity = deflection, .value = lowest, .stops = true, .label = "deflection"});
  std::vector<LimitPoint> found;
  for (const Event& event : test::events_of(test::trace(structure, options), EventKind::limit_point))
    found.push_back({.load = event.state.lambda, .displacement = displacement(structure, event.state.x, loaded)});
  return found;
}

// Lee's frame of test::lee_frame, flexible in shear: ν = 0.3, shear correction 1, so GA = 720·6/2.6.
std::unique_ptr<Structure> lee_frame(int order, int elements) {
  StructureBuilder builder;
  const Vec2 at[] = {{0.0, 0.0}, {0.0, 120.0}, {24.0, 120.0}, {120.0, 120.0}};
  Index joints[4];
  for (int i = 0; i < 4; ++i) joints[i] = builder.add_joint(at[i]);
  const int count[] = {elements, elements / 5, elements * 4 / 5};
  for (int i = 0; i < 3; ++i)
    builder.add_member({.name = "member",
                        .from = joints[i],
                        .to = joints[i + 1],
                        .axis = straight_axis(at[i], at[i + 1]),
                        .theory = Theory::exact,
                        .order = order,
                        .section = {.E = 720.0, .A = 6.0, .I = 2.0, .G = 720.0 / 2.6, .shear_area = 6.0},
                        .elements = count[i]});
  for (const Index end : {joints[0], joints[3]})
    for (const Freedom which : {Freedom::x, Freedom::z}) builder.fix(builder.freedom(end, which));
  builder.add_load(builder.freedom(joints[2], Freedom::z), -1.0, LoadKind::proportional);
  return builder.build();
}

// test::deep_arch with so large a shear stiffness that it does not enter.
std::unique_ptr<Structure> deep_arch(int order, int elements) {
  StructureBuilder builder;
  constexpr double R = 100.0, half = 107.5 * pi / 180.0;
  const auto on_circle = [](double angle) { return Vec2(R * std::sin(angle), R * std::cos(angle)); };
  const Vec2 at[] = {on_circle(-half), on_circle(0.0), on_circle(half)};
  Index joints[3];
  for (int i = 0; i < 3; ++i) joints[i] = builder.add_joint(at[i]);
  for (int i = 0; i < 2; ++i)
    builder.add_member({.name = i == 0 ? "west" : "east",
                        .from = joints[i],
                        .to = joints[i + 1],
                        .axis = arc_axis(at[i], on_circle((i - 0.5) * half), at[i + 1]),
                        .theory = Theory::exact,
                        .order = order,
                        .section = section({.EA = 1e8, .GA = 1e11, .EI = 1e6}),
                        .elements = elements});
  for (const Index end : {joints[0], joints[2]})
    for (const Freedom which : {Freedom::x, Freedom::z}) builder.fix(builder.freedom(end, which));
  builder.fix(builder.shared_rotation(joints[2]).value());
  builder.add_load(builder.freedom(joints[1], Freedom::z), -1.0, LoadKind::proportional);
  return builder.build();
}

}  // namespace

// Limit points of the same continuous model, by shooting with 20 digits.
TEST(ExactBeamOrder, LimitPointsOfLeesFrameFlexibleInShear) {
  const LimitPoint exact[] = {{.load = 1.854655874000, .displacement = {26.878701338298, -48.751058692948}},
                              {.load = -0.939614235717, .displacement = {90.180114170564, -58.223594604971}}};
  for (const int order : {1, 2}) {
    std::vector<std::vector<LimitPoint>> found;
    for (const int elements : {10, 20, 40, 80})
      found.push_back(limit_points(*lee_frame(order, elements / (order == 2 ? 2 : 1)), 2, 0.1, -64.0));
    for (const auto& limits : found) ASSERT_EQ(limits.size(), 2u);
    for (const std::size_t which : {0u, 1u}) {
      std::size_t mesh = 0;
      expect_order(order, 10, order == 1 ? 8e-4 : 6e-7,
                   [&](int) { return found[mesh++][which].load - exact[which].load; });
      mesh = 0;
      expect_order(order, 10, order == 1 ? 7e-3 : 4.5e-6,
                   [&](int) { return (found[mesh++][which].displacement - exact[which].displacement).norm(); });
    }
  }
}

// The first limit load without shear, by shooting with 20 digits; shear changes it by some EI/(GA R²) = 1e-9 of it.
TEST(ExactBeamOrder, LimitLoadOfTheDeepArch) {
  constexpr double exact = 897.294947593916;
  for (const int order : {1, 2})
    expect_order(order, order == 1 ? 16 : 8, order == 1 ? 0.2 : 1.8e-4, [&](int elements) {
      const auto structure = deep_arch(order, elements);
      const auto limits = limit_points(*structure, 1, 20.0, -114.5);
      EXPECT_FALSE(limits.empty());
      return limits.empty() ? 0.0 : limits.front().load - exact;
    });
}

namespace {

constexpr ExactBeamStiffness ordinary{.EA = 100.0, .GA = 40.0, .EI = 1.0};

}  // namespace

TEST(ExactBeamStructure, MiddleNodesAreNodesOfTheStructureButNotOfTheMesh) {
  const auto first = Cantilever{.stiffness = ordinary, .order = 1, .elements = 4}.straight();
  const auto second = Cantilever{.stiffness = ordinary, .order = 2, .elements = 4}.straight();
  EXPECT_EQ(first->node_count(), 5);
  EXPECT_EQ(first->size({}), 12);
  EXPECT_TRUE(first->members()[0].middle_nodes.empty());
  EXPECT_EQ(second->node_count(), 9);
  EXPECT_EQ(second->size({}), 24);
  const MemberMesh& mesh = second->members()[0];
  EXPECT_EQ(mesh.nodes.size(), 5u);
  ASSERT_EQ(mesh.middle_nodes.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_LE((second->position(mesh.middle_nodes[k]) - Vec2(0.125 + 0.25 * double(k), 0.0)).norm(), 1e-15);
    EXPECT_TRUE(second->unknown(mesh.middle_rotations[k]));
  }
  // Means over all nodes: a unit displacement of every node along x, but for the clamped one.
  const Vector weights = second->weights({});
  double translation = 0.0, rotation = 0.0;
  for (Index i = 0; i < weights.size(); ++i)
    (second->meaning(i).freedom == Freedom::rotation ? rotation : translation) += weights[i];
  EXPECT_NEAR(rotation, 8.0 / 9.0, 1e-15);
  EXPECT_NEAR(translation, 2.0 * 8.0 / 9.0, 1e-14);
  // Unknowns are numbered along the member, so the stiffness is a band.
  Linearization now;
  second->linearize(test::rest(*second), now);
  for (Index j = 0; j < now.K.cols(); ++j)
    for (SparseMatrix::InnerIterator entry(now.K, j); entry; ++entry) EXPECT_LE(entry.row() - j, 8);
}

TEST(ExactBeamStructure, ReactionsBalanceTheLoads) {
  for (const int order : {1, 2}) {
    const Cantilever beam{.stiffness = ordinary,
                          .order = order,
                          .elements = 5,
                          .tip_force = {0.3, -0.4},
                          .tip_moment = 0.2,
                          .distributed = {0.5, -1.0}};
    const auto structure = beam.straight();
    const State state = solved(*structure, 1.5, 3);
    EXPECT_NEAR(structure->reaction(state, structure->freedom(0, Freedom::x)), -1.5 * (0.3 + 0.5), 1e-12);
    EXPECT_NEAR(structure->reaction(state, structure->freedom(0, Freedom::z)), -1.5 * (-0.4 - 1.0), 1e-12);
    // Moments about the clamped end at the origin, of the loads where they are now.
    const Vec2 end = structure->current(state.x, tip);
    double moment = 1.5 * (0.2 + end.x() * -0.4 - end.y() * 0.3);
    const MemberMesh& mesh = structure->members()[0];
    const auto add = [&](Index node, double share) {
      const Vec2 r = structure->current(state.x, node);
      moment += 1.5 * share * (r.x() * -1.0 - r.y() * 0.5);
    };
    for (std::size_t k = 0; k + 1 < mesh.nodes.size(); ++k) {
      const double ends = order == 1 ? 0.1 : 1.0 / 30.0;
      add(mesh.nodes[k], ends);
      add(mesh.nodes[k + 1], ends);
      if (order == 2) add(mesh.middle_nodes[k], 4.0 / 30.0);
    }
    EXPECT_NEAR(structure->reaction(state, structure->members()[0].rotations.front().value()), -moment, 1e-12);
  }
}

// One element a member tells a structure from a mechanism, however thin.
TEST(ExactBeamStructure, MechanismsAreFoundWithOneElementAMember) {
  for (const double thickness : {1.0, 1e-2, 1e-4})
    for (const int order : {1, 2})
      for (const bool rolls : {false, true}) {
        StructureBuilder builder;
        const Index left = builder.add_joint({0.0, 0.0}), right = builder.add_joint({0.6, 0.8});
        builder.add_member({.name = "beam",
                            .from = left,
                            .to = right,
                            .axis = straight_axis({0.0, 0.0}, {0.6, 0.8}),
                            .theory = Theory::exact,
                            .order = order,
                            .section = section({.EA = 1.0, .GA = 0.3, .EI = thickness * thickness / 12.0}),
                            .elements = 1});
        builder.fix(builder.freedom(left, Freedom::x));
        builder.fix(builder.freedom(left, Freedom::z));
        if (!rolls) builder.fix(builder.freedom(right, Freedom::z));
        const auto mechanism = find_mechanism(*builder.build());
        EXPECT_EQ(mechanism.has_value(), rolls) << "thickness " << thickness << " order " << order;
      }
}

}  // namespace arcwall
