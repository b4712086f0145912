// Elements of members whose sections taper.
#include <gtest/gtest.h>

#include <cmath>

#include "elements/elastica_beam.hpp"
#include "elements/heated_beam.hpp"
#include "elements/reissner_beam.hpp"
#include "tests/elements/element_checks.hpp"
#include "tests/elements/slender_beam_checks.hpp"

namespace arcwall::tapered_beam_test {
namespace {

using test::Numbers;

constexpr double E = 200.0, length = 2.5;

// A rectangle whose width grows and whose height falls.
SectionSizes rectangle(double t) {
  const double b = 1.0 + 0.5 * t, h = 0.4 - 0.25 * t;
  return {.A = b * h, .I = b * h * h * h / 12.0, .height = h, .shear_area = 5.0 / 6.0 * b * h};
}

std::shared_ptr<const SectionTaper> taper() {
  return std::make_shared<SectionTaper>(std::vector<double>{0.0, 1.0}, rectangle);
}

StretchTaper along() {
  const SectionSizes middle = rectangle(0.5);
  return {.sizes = taper(), .length = length, .A = middle.A, .I = middle.I};
}

std::unique_ptr<SlenderBeam> beam(const StretchReference& stretch, ElasticaOrder order) {
  return std::make_unique<ElasticaBeam>(stretch, E * rectangle(0.5).A, E * rectangle(0.5).I, order, along());
}

constexpr ElasticaOrder orders[] = {ElasticaOrder::four, ElasticaOrder::six};

}  // namespace

TEST(SectionTaper, HasTheSizesAndTheirDerivatives) {
  const auto sizes = taper();
  constexpr double step = 1e-4;
  for (const double t : {0.0, 0.3, 0.71, 1.0}) {
    EXPECT_NEAR(sizes->at(t).A, rectangle(t).A, 1e-15);
    EXPECT_NEAR(sizes->at(t).I, rectangle(t).I, 1e-16);
    EXPECT_NEAR(sizes->at(t).height, rectangle(t).height, 1e-15);
    const auto I = [](double at) { return rectangle(at).I; };
    EXPECT_NEAR(sizes->at(t, 1).I, (I(t + step) - I(t - step)) / (2.0 * step), 1e-9);
    EXPECT_NEAR(sizes->at(t, 2).I, (I(t + step) - 2.0 * I(t) + I(t - step)) / (step * step), 1e-8);
    EXPECT_NEAR(sizes->at(t, 1).A, 0.5 * (0.4 - 0.25 * t) - 0.25 * (1.0 + 0.5 * t), 1e-14);
    EXPECT_NEAR(sizes->at(t, 2).A, -0.25, 1e-13);
  }
}

TEST(SectionTaper, OfATableIsLinearBetweenItsPlaces) {
  const SectionTaper table({0.0, 0.2, 1.0}, [](double t) {
    return t <= 0.2 ? SectionSizes{.A = 1.0 + t, .I = 2.0} : SectionSizes{.A = 1.2, .I = 2.0 - (t - 0.2)};
  });
  EXPECT_NEAR(table.at(0.1).A, 1.1, 1e-15);
  EXPECT_NEAR(table.at(0.1, 1).A, 1.0, 1e-14);
  EXPECT_NEAR(table.at(0.6).I, 1.6, 1e-15);
  EXPECT_NEAR(table.at(0.6, 1).I, -1.0, 1e-14);
}

TEST(TaperedBeam, DerivativesAreConsistent) {
  Numbers numbers(91);
  const auto arc = arc_axis({0.0, 0.0}, {1.0, 0.3}, {2.0, 0.0});
  const ImperfectAxis shape(*arc, {{.amplitude = 0.03, .waves = 2}});
  for (const ElasticaOrder order : orders) {
    const StretchReference stretch = stretch_reference(shape, 0.5, 0.9);
    for (int i = 0; i < 4; ++i) {
      const BeamEnds ends = test::deformed(stretch, 0.2, i, numbers);
      test::expect_response_derivatives(*beam(stretch, order), ends);
      test::expect_place(*beam(stretch, order), ends);
    }
  }
}

TEST(TaperedBeam, ForceRatesAreThoseOfTheForceByTheEnds) {
  Numbers numbers(92);
  const auto arc = arc_axis({0.0, 0.0}, {1.0, 0.3}, {2.0, 0.0});
  const ImperfectAxis shape(*arc, {{.amplitude = 0.03, .waves = 2}});
  for (const ElasticaOrder order : orders) {
    const StretchReference stretch = stretch_reference(shape, 0.5, 0.9);
    const auto make = [&](const StretchReference& of) { return beam(of, order); };
    for (int i = 0; i < 3; ++i)
      test::expect_force_rates(make, shape, 0.5, 0.9, test::deformed(stretch, 0.2, 0.3, numbers));
  }
}

// A quarter of the rod pulled, N ∫ ds/EA(s), and bent by end moments, M ∫ ds/EI(s): of the smallest loads.
TEST(TaperedBeam, StretchesAndBendsByItsOwnSections) {
  constexpr double part = 0.25;
  constexpr int places = 20000;
  const auto line = straight_axis({0.0, 0.0}, {length, 0.0});
  const StretchReference quarter = stretch_reference(ImperfectAxis(*line, {}), 0.0, part * length);
  double by_A = 0.0, by_I = 0.0;
  for (int i = 0; i < places; ++i) {
    const SectionSizes here = rectangle(part * (i + 0.5) / places);
    by_A += part * length / places / (E * here.A);
    by_I += part * length / places / (E * here.I);
  }
  const Eigen::Matrix4d K =
      test::response(*beam(quarter, ElasticaOrder::six), {.chord = quarter.chord, .angle1 = 0.0, .angle2 = 0.0})
          .stiffness;
  EXPECT_NEAR(1.0 / K(0, 0), by_A, 1e-8 * by_A);
  // Both ends turn apart, free across.
  const Eigen::Matrix3d bending = K.bottomRightCorner<3, 3>();
  const Eigen::Vector3d turned = bending.fullPivLu().solve(Eigen::Vector3d(0.0, -1.0, 1.0));
  EXPECT_NEAR(turned[2] - turned[1], by_I, 1e-4 * by_I);
}

// Under a uniform strain ε its end bears ε ∫ EA N₃′ ds = ε ∫ (1 + t) (4 t − 1) dt = 11 ε/6, to which two points are
// exact.
TEST(TaperedBeam, FlexibleInShearHasTheStiffnessOfItsPoints) {
  const ExactBeamReference reference{.nodes = {{0.0, 0.0}, {0.5, 0.0}, {1.0, 0.0}}, .arcs = {0.0, 0.5, 1.0}};
  const ReissnerBeam varying(reference,
                             [](double t) { return ExactBeamStiffness{.EA = 1.0 + t, .GA = 1.0, .EI = 1.0}; });
  Vector pulled = Vector::Zero(9);
  pulled[3] = 0.5e-6;
  pulled[6] = 1e-6;
  EXPECT_NEAR(test::evaluated(varying, pulled).f[6], 11.0 / 6.0 * 1e-6, 1e-15);
  Numbers numbers(93);
  test::expect_derivatives(varying, 0.2 * numbers.vector(9));
}

}  // namespace arcwall::tapered_beam_test
