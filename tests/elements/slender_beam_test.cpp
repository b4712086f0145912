#include "elements/slender_beam.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "elements/classic_beam.hpp"
#include "elements/elastica_beam.hpp"
#include "tests/elements/element_checks.hpp"
#include "tests/elements/slender_beam_checks.hpp"

namespace arcwall::slender_beam_test {

namespace {

using test::Numbers;

struct Shape {
  std::string name;
  std::unique_ptr<Axis> axis;
  std::vector<SineDeviation> deviations{};

  ImperfectAxis curve() const { return {*axis, deviations}; }
};

// Straight, circular, sine and spline axes with and without imperfections, about 2 long.
std::vector<Shape> shapes() {
  const std::vector<SineDeviation> waves{{.amplitude = 0.03, .waves = 1}, {.amplitude = -0.01, .waves = 3}};
  const Vec2 a(0.3, -0.1), b(1.9, 0.9);
  const auto spline = [] { return spline_axis({{0.0, 0.0}, {0.7, 0.3}, {1.2, 0.2}, {1.9, 0.5}}); };
  std::vector<Shape> all;
  for (const bool imperfect : {false, true}) {
    const auto deviations = imperfect ? waves : std::vector<SineDeviation>{};
    const std::string suffix = imperfect ? ", imperfect" : "";
    all.push_back({.name = "straight" + suffix, .axis = straight_axis(a, b), .deviations = deviations});
    all.push_back({.name = "arc" + suffix, .axis = arc_axis(a, {1.0, 0.7}, b), .deviations = deviations});
    all.push_back({.name = "sine" + suffix, .axis = sine_axis(a, b, 0.1, 2), .deviations = deviations});
    all.push_back({.name = "spline" + suffix, .axis = spline(), .deviations = deviations});
  }
  return all;
}

// A straight beam bent by a constant force n: r′ = (1 + N/EA) t, θ′ = M/EI, M′ = −(1 + N/EA) n·t⊥, N = n·t. State
// (x, z, θ, M), by Runge and Kutta's rule with steps of 1e-3: off by less than 1e-12.
Eigen::Vector4d elastica(double s, double EA, double EI) {
  const Vec2 n(-1.0, 5.0);
  const auto rate = [&](const Eigen::Vector4d& y) {
    const Vec2 t(std::cos(y[2]), std::sin(y[2]));
    const double stretch = 1.0 + n.dot(t) / EA;
    return Eigen::Vector4d(stretch * t.x(), stretch * t.y(), y[3] / EI, -stretch * n.dot(perp(t)));
  };
  Eigen::Vector4d y(0.0, 0.0, 0.3, 2.0);
  const int steps = 1 + static_cast<int>(std::abs(s) / 1e-3);
  const double d = s / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector4d k1 = rate(y), k2 = rate(y + 0.5 * d * k1), k3 = rate(y + 0.5 * d * k2), k4 = rate(y + d * k3);
    y += d / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return y;
}

// Errors of the position and the angle inside an element of length h whose ends are on that curve, and orders of both
// over four lengths.
struct PlaceOrders {
  double position, angle;
};

PlaceOrders place_orders(const std::function<std::unique_ptr<SlenderBeam>(const StretchReference&)>& make, double EA,
                         double EI) {
  const auto axis = straight_axis({0.0, 0.0}, {1.0, 0.0});
  std::vector<double> sizes, positions, angles;
  for (const double h : {0.2, 0.1, 0.05, 0.025}) {
    const auto at = [&](double xi) { return elastica(h * (xi - 0.4), EA, EI); };
    const Eigen::Vector4d first = at(0.0), second = at(1.0), inside = at(0.3);
    const auto beam = make(stretch_reference(ImperfectAxis(*axis, {}), 0.3, 0.3 + h));
    const BeamPlace place =
        beam->place({.chord = (second - first).head<2>(), .angle1 = first[2], .angle2 = second[2]}, 0.3);
    sizes.push_back(h);
    positions.push_back((place.offset - (inside - first).head<2>()).norm());
    angles.push_back(place.angle - inside[2]);
  }
  return {.position = test::observed_order(sizes, positions), .angle = test::observed_order(sizes, angles)};
}

struct Kind {
  std::string name;
  std::function<std::unique_ptr<SlenderBeam>(const StretchReference&)> make;
};

std::vector<Kind> kinds(double EA, double EI) {
  const auto elastica = [=](ElasticaOrder order) {
    return [=](const StretchReference& stretch) { return std::make_unique<ElasticaBeam>(stretch, EA, EI, order); };
  };
  return {{"classic", [=](const StretchReference& stretch) { return std::make_unique<ClassicBeam>(stretch, EA, EI); }},
          {"elastica of order 4", elastica(ElasticaOrder::four)},
          {"elastica of order 6", elastica(ElasticaOrder::six)}};
}

// All kinds on all shapes.
template <class Check>
void on_all(const Check& check) {
  for (const Kind& kind : kinds(200.0, 3.0))
    for (const Shape& shape : shapes()) {
      SCOPED_TRACE(kind.name + ", " + shape.name);
      check(kind, shape.curve(), stretch_reference(shape.curve(), 0.4, 1.1));
    }
}

}  // namespace

TEST(StretchReference, IsThatOfTheDeviatedCurve) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const ImperfectAxis curve = shape.curve();
    const StretchReference stretch = stretch_reference(curve, 0.4, 0.7);
    EXPECT_LE((stretch.chord - (curve.at(0.7).position - curve.at(0.4).position)).norm(), 1e-15);
    EXPECT_EQ(stretch.length, curve.length(0.4, 0.7));
    EXPECT_EQ(stretch.angles[0], curve.at(0.4).angle);
    EXPECT_EQ(stretch.angles[3], curve.at(0.7).angle);
    for (const std::size_t k : {1u, 2u}) {
      double low = 0.4, high = 0.7;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (curve.length(0.4, middle) < double(k) / 3.0 * stretch.length ? low : high) = middle;
      }
      EXPECT_NEAR(stretch.angles[k], curve.at(low).angle, 1e-13);
    }
  }
}

// Differences of step d: truncation d²/6 of third derivatives (up to 100), round-off ε/d.
TEST(StretchReference, RatesAreThoseOfItsEnds) {
  constexpr double d = 1e-5;
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const ImperfectAxis curve = shape.curve();
    const StretchReference at = stretch_reference(curve, 0.43, 0.75);
    for (std::size_t i = 0; i < 2; ++i) {
      const double by1 = i == 0 ? d : 0.0, by2 = i == 1 ? d : 0.0;
      const StretchReference above = stretch_reference(curve, 0.43 + by1, 0.75 + by2),
                             below = stretch_reference(curve, 0.43 - by1, 0.75 - by2);
      EXPECT_NEAR(at.length_rate[i], (above.length - below.length) / (2.0 * d), 5e-9);
      EXPECT_LE((at.chord_rate[i] - (above.chord - below.chord) / (2.0 * d)).norm(), 5e-9);
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(at.angle_rate[i][k], (above.angles[k] - below.angles[k]) / (2.0 * d), 5e-9);
    }
  }
}

TEST(StretchReference, OfAStraightAxisIsExactHoweverShort) {
  const auto axis = straight_axis({100.0, 50.0}, {103.0, 54.0});
  const ImperfectAxis curve(*axis, {});
  const double from = 2.0, to = from + 1e-7;
  const StretchReference stretch = stretch_reference(curve, from, to);
  EXPECT_EQ(stretch.length, to - from);
  EXPECT_NEAR(stretch.chord.norm(), to - from, 1e-15 * (to - from));
  EXPECT_EQ(stretch.length_rate, (std::array{-1.0, 1.0}));
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(stretch.angles[k], std::atan2(4.0, 3.0));
    EXPECT_EQ(stretch.angle_rate[0][k], 0.0);
    EXPECT_EQ(stretch.angle_rate[1][k], 0.0);
  }
}

TEST(StretchReference, ChordsOfShortArcsKeepTheirDigits) {
  const auto axis = arc_axis({0.0, 0.0}, {100.0, 30.0}, {200.0, 0.0});
  const ImperfectAxis curve(*axis, {});
  const double d = std::ldexp(1.0, -20);
  const StretchReference stretch = stretch_reference(curve, 40.0, 40.0 + d);
  const double bend = d * axis->at(40.0).curvature;
  EXPECT_NEAR(stretch.chord.norm() / d, 1.0 - bend * bend / 24.0, 1e-15);
}

TEST(SlenderBeams, DerivativesAreConsistent) {
  Numbers numbers(60);
  on_all([&](const Kind& kind, const ImperfectAxis&, const StretchReference& stretch) {
    for (const double turn : {0.0, 2.0, -7.0})
      test::expect_response_derivatives(*kind.make(stretch), test::deformed(stretch, 0.2, turn, numbers));
  });
}

TEST(SlenderBeams, ForceRatesAreThoseOfTheMaterialPoints) {
  Numbers numbers(61);
  on_all([&](const Kind& kind, const ImperfectAxis& curve, const StretchReference& stretch) {
    for (int i = 0; i < 3; ++i)
      test::expect_force_rates(kind.make, curve, 0.4, 1.1, test::deformed(stretch, 0.2, 1.0, numbers));
  });
}

TEST(SlenderBeams, AgreeWithTheirFormByDisplacements) {
  Numbers numbers(62);
  on_all([&](const Kind& kind, const ImperfectAxis&, const StretchReference& stretch) {
    const auto beam = kind.make(stretch);
    const Vector u = 0.2 * numbers.vector(6);
    const auto by_displacement = test::evaluated(dynamic_cast<const Element&>(*beam), u);
    const BeamResponse by_place = test::response(*beam, {.chord = stretch.chord + u.segment<2>(3) - u.segment<2>(0),
                                                         .angle1 = stretch.angles.front() + u[2] + 2.0 * pi,
                                                         .angle2 = stretch.angles.back() + u[5] - 4.0 * pi});
    EXPECT_NEAR(by_place.energy, by_displacement.energy, 1e-13 * std::abs(by_displacement.energy));
    const Eigen::Vector4d f(by_displacement.f[3], by_displacement.f[4], by_displacement.f[2], by_displacement.f[5]);
    EXPECT_LE((by_place.force - f).norm(), 1e-12 * f.norm());
    const std::vector<Index> rows{3, 4, 2, 5};
    EXPECT_LE((by_place.stiffness - by_displacement.K(rows, rows)).norm(), 1e-12 * by_place.stiffness.norm());
  });
}

TEST(SlenderBeams, PlacesMeetTheEndsAndTheirGradientsAreConsistent) {
  Numbers numbers(63);
  on_all([&](const Kind& kind, const ImperfectAxis&, const StretchReference& stretch) {
    for (const double turn : {0.0, 2.0, -7.0})
      test::expect_place(*kind.make(stretch), test::deformed(stretch, 0.2, turn, numbers));
  });
}

// A quadratic angle has order 3 and a cubic one order 4, positions one more. The classic beam's are so up to terms in
// (EI κ²/EA)² = 2e-5 that the tilt of its chord leaves out.
TEST(SlenderBeams, PlacesInsideConvergeToTheElastica) {
  for (const double EA : {1e3, 1e6})
    for (const Kind& kind : kinds(EA, 1.0)) {
      SCOPED_TRACE(kind.name);
      const double degree = kind.name == "elastica of order 6" ? 3.0 : 2.0;
      const PlaceOrders orders = place_orders(kind.make, EA, 1.0);
      EXPECT_NEAR(orders.position, degree + 2.0, 0.2);
      EXPECT_NEAR(orders.angle, degree + 1.0, 0.2);
    }
}

}  // namespace arcwall::slender_beam_test
