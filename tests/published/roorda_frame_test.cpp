#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/convergence.hpp"
#include "tests/support/models.hpp"

// Roorda's frame (Roorda 1965, Koiter 1967): the inextensible frame buckles where 3 (1 − k cot k) + k² = 0, P = k², at
// an asymmetric branch point, P/P_c = 1 − 0.3805 θ + …, θ the rotation of the corner. A column that shortens acts like
// an imperfection and rounds the branch point off, so the comparisons are with the limit 1/EA → 0 of the paths beside
// it. The expected values are those of the inextensible elastica, by shooting with adaptive Taylor series.
namespace arcwall::roorda_frame_test {

namespace {

using test::BeamTheory;
using test::RoordaFrame;

// The load at which the corner of a frame has turned so far.
double load_at(const RoordaFrame& frame, double rotation) {
  const auto structure = frame.structure();
  TraceOptions options;
  options.step.first = 1.0;
  const auto turn = test::joint_rotation(*structure, 1);
  options.target_values = {{.quantity = turn, .value = rotation, .stops = true, .label = "rotation"},
                           {.quantity = turn, .value = -rotation, .stops = true, .label = "the other side"}};
  const test::Branch branch = test::trace(*structure, options);
  EXPECT_NEAR(turn->value(branch.last().state), rotation, 1e-10) << branch.end.detail;
  return branch.last().state.lambda;
}

// The branches of the perfect, inextensible frame: 1/EA = s. Shortening alone leads to positive rotations; an
// eccentricity of 10 s, which vanishes with it, to negative ones.
double load_of_the_perfect_frame(double rotation, const BeamTheory& beam, int elements) {
  return test::at_zero(
      [&](double s) {
        const double eccentricity = rotation < 0.0 ? 10.0 * s : 0.0;
        return load_at({.EA = 1.0 / s, .eccentricity = eccentricity, .elements = elements, .beam = beam}, rotation);
      },
      4e-6);
}

double limit_load(const RoordaFrame& frame) {
  const auto structure = frame.structure();
  TraceOptions options;
  options.step.first = 1.0;
  options.target_values = {
      {.quantity = test::joint_rotation(*structure, 1), .value = 0.8, .stops = true, .label = "turn"}};
  return only_event(test::trace(*structure, options), EventKind::limit_point).state.lambda;
}

constexpr double critical = 13.885942905964721;  // P_c

}  // namespace

TEST(RoordasFrame, BothBranchesAreThoseOfTheElasticaSlow) {
  struct Sample {
    double rotation, load;
  };
  for (const Sample& sample :
       {Sample{0.05, 13.63708015382994}, Sample{0.1, 13.416041476310122}, Sample{0.3, 12.741203415079577},
        Sample{-0.05, 14.167082113194644}, Sample{-0.1, 14.485814736361185}, Sample{-0.3, 16.286701533380796}}) {
    SCOPED_TRACE(sample.rotation);
    for (const BeamTheory& beam : test::elastica_theories()) {
      const auto loads = test::on_four_meshes(
          4, [&](int elements) { return load_of_the_perfect_frame(sample.rotation, beam, elements); });
      test::expect_convergence(loads, {.exact = sample.load, .order = double(beam.convergence)});
    }
  }
}

// The slope at the branch point, by central differences of fourth order, and the load there.
TEST(RoordasFrame, TheBranchPointIsAsymmetricWithKoitersSlope) {
  const auto at = [](double rotation) { return load_of_the_perfect_frame(rotation, {}, 32) / critical; };
  const double h = 0.05;
  const double a = at(-2.0 * h), b = at(-h), c = at(h), d = at(2.0 * h);
  EXPECT_NEAR((a - 8.0 * b + 8.0 * c - d) / (12.0 * h), -0.38051994661846, 2e-4);  // h⁴ times the fifth derivative/30
  EXPECT_NEAR((-a + 4.0 * b + 4.0 * c - d) / 6.0, 1.0, 2e-5);                      // h⁴ times the fourth derivative/6
}

// A load that stands beside the column by e on the unstable side lowers the limit load by 1.1514 √e to first order
// (Koiter's 0.3805 again).
TEST(RoordasFrame, EccentricLoadsLowerTheLimitLoadSlow) {
  struct Sample {
    double eccentricity, load;
  };
  for (const Sample& sample :
       {Sample{-1e-3, 13.395936092306327}, Sample{-1e-2, 12.43820240758229}, Sample{-0.05, 11.026499088665936}}) {
    SCOPED_TRACE(sample.eccentricity);
    for (const BeamTheory& beam : test::elastica_theories()) {
      const auto loads = test::on_four_meshes(4, [&](int elements) {
        const auto load = [&](double s) {
          return limit_load({.EA = 1.0 / s, .eccentricity = sample.eccentricity, .elements = elements, .beam = beam});
        };
        return test::at_zero(load, 4e-6);
      });
      test::expect_convergence(loads, {.exact = sample.load, .order = double(beam.convergence)});
    }
  }
}

}  // namespace arcwall::roorda_frame_test
