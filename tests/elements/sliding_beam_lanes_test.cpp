#include "elements/sliding_beam_lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "elements/classic_beam.hpp"
#include "tests/support/dense.hpp"

// Against the beams one by one, whose derivatives slender_beam_test.cpp checks.
namespace arcwall::sliding_beam_lanes_test {

namespace {

using test::Numbers;
using Wanted = SlidingBeamLanes::Wanted;

// x1, z1, angle1, x2, z2, angle2 by chord and angles.
Eigen::Matrix<double, 4, 6> by_ends() {
  Eigen::Matrix<double, 4, 6> T = Eigen::Matrix<double, 4, 6>::Zero();
  T(0, 0) = T(1, 1) = -1.0;
  T(0, 3) = T(1, 4) = T(2, 2) = T(3, 5) = 1.0;
  return T;
}

struct Places {
  std::array<double, 4> s{};
  std::array<Vec2, 4> place{};
  std::array<double, 4> angle{};

  SlidingBeamLanes::End of(const SlidingBeamLanes& beams) const {
    const auto four = [](const auto& value) { return Lanes(value(0), value(1), value(2), value(3)); };
    return {.rest = beams.rest_at(four([&](std::size_t i) { return s[i]; })),
            .x = four([&](std::size_t i) { return place[i].x(); }),
            .z = four([&](std::size_t i) { return place[i].y(); }),
            .angle = four([&](std::size_t i) { return angle[i]; })};
  }
};

}  // namespace

// Elements of 1/90 of a wave up to five waves, in the middle of great displacements, at each multiple of a turn.
TEST(SlidingBeamLanes, AreTheBeamsOneByOne) {
  constexpr double EA = 210.0, EI = 0.175;
  const auto axis = straight_axis({0.3, -0.1}, {1.9, 0.9});
  const std::vector<std::vector<SineDeviation>> imperfections{
      {}, {{.amplitude = 0.03, .waves = 1}}, {{.amplitude = 0.03, .waves = 1}, {.amplitude = -0.02, .waves = 11}}};
  Numbers numbers(31);
  for (const auto& deviations : imperfections)
    for (const double h : {0.02, 0.1, 0.3, 0.9})
      for (const int turns : {0, 1, -3}) {
        SCOPED_TRACE(std::to_string(deviations.size()) + " waves, h = " + std::to_string(h));
        const ImperfectAxis shape(*axis, deviations);
        Places first, second;
        for (std::size_t i = 0; i < 4; ++i) {
          first.s[i] = 0.2 * double(i) + 0.1 * numbers() + 0.1;
          second.s[i] = first.s[i] + h * (1.0 + 0.1 * numbers());
          const AxisPoint a = shape.at(first.s[i]), b = shape.at(second.s[i]);
          const double turn = 2.0 * pi * turns + 1.3 * numbers();
          const Eigen::Rotation2Dd rotation(turn);
          first.place[i] = Vec2(numbers(), numbers());
          second.place[i] = first.place[i] + rotation * ((b.position - a.position) * (1.0 + 0.02 * numbers()));
          first.angle[i] = a.angle + turn + 0.3 * numbers();
          second.angle[i] = b.angle + turn + 0.3 * numbers();
        }
        SlidingBeamLanes::Response found;
        const SlidingBeamLanes beams(shape, EA, EI);
        beams.respond(first.of(beams), second.of(beams), Wanted::rates, found);
        for (std::size_t i = 0; i < 4; ++i) {
          BeamResponse expected;
          ClassicBeam(stretch_reference(shape, first.s[i], second.s[i], DividedPart::Inside::left_out), EA, EI)
              .respond({.chord = second.place[i] - first.place[i], .angle1 = first.angle[i], .angle2 = second.angle[i]},
                       true, expected);
          const auto T = by_ends();
          const Eigen::Matrix<double, 6, 6> K = T.transpose() * expected.stiffness * T;
          const Eigen::Matrix<double, 6, 1> f = T.transpose() * expected.force;
          const double K_size = K.cwiseAbs().maxCoeff();
          const int lane = static_cast<int>(i);
          EXPECT_NEAR(found.energy[lane], expected.energy, 1e-13 * K_size);
          for (Index row = 0; row < 6; ++row) {
            EXPECT_NEAR(found.force[row][lane], f[row], 1e-13 * K_size);
            for (Index column = 0; column <= row; ++column)
              EXPECT_NEAR(found.stiffness[row + 6 * column][lane], K(row, column), 1e-13 * K_size);
            for (std::size_t end = 0; end < 2; ++end) {
              const Eigen::Matrix<double, 6, 1> rate = T.transpose() * expected.force_rate[end];
              EXPECT_NEAR(found.force_rate[end][row][lane], rate[row], 1e-13 * K_size);
            }
          }
        }
      }
}

// Less than all is the same.
TEST(SlidingBeamLanes, LeaveOutWhatIsNotWanted) {
  const auto axis = straight_axis({0.0, 0.0}, {2.0, 0.0});
  const ImperfectAxis shape(*axis, {{.amplitude = 0.05, .waves = 2}});
  const Places first{.s = {0.0, 0.2, 0.4, 0.6}, .place = {Vec2(0, 0), Vec2(1, 0), Vec2(2, 0), Vec2(3, 1)}};
  const Places second{.s = {0.3, 0.5, 0.7, 0.9},
                      .place = {Vec2(0.3, 0.1), Vec2(1.3, 0), Vec2(2.3, -0.1), Vec2(3.3, 1)}};
  const SlidingBeamLanes beams(shape, 100.0, 1.0);
  SlidingBeamLanes::Response all, stiffness, force, energy;
  beams.respond(first.of(beams), second.of(beams), Wanted::rates, all);
  beams.respond(first.of(beams), second.of(beams), Wanted::stiffness, stiffness);
  beams.respond(first.of(beams), second.of(beams), Wanted::force, force);
  beams.respond(first.of(beams), second.of(beams), Wanted::energy, energy);
  for (int lane = 0; lane < 4; ++lane) {
    EXPECT_EQ(energy.energy[lane], all.energy[lane]);
    for (Index row = 0; row < 6; ++row) {
      EXPECT_EQ(force.force[row][lane], all.force[row][lane]);
      EXPECT_EQ(stiffness.force[row][lane], all.force[row][lane]);
      EXPECT_EQ(stiffness.stiffness[row][lane], all.stiffness[row][lane]);
    }
  }
}

// Of places that follow each other each is found once.
TEST(SlidingBeamLanes, AreAtRestWhereTheNextOnesBegin) {
  const auto axis = straight_axis({0.0, 0.0}, {2.0, 0.0});
  const SlidingBeamLanes beams(ImperfectAxis(*axis, {{.amplitude = 0.05, .waves = 2}}), 100.0, 1.0);
  using Rest = SlidingBeamLanes::Rest;
  const Rest next = SlidingBeamLanes::next_of(beams.rest_at(Lanes(0.1, 0.2, 0.4, 0.7)), beams.rest_at(Lanes(1.1)));
  const Rest expected = beams.rest_at(Lanes(0.2, 0.4, 0.7, 1.1));
  for (const auto number : {&Rest::s, &Rest::deviation, &Rest::slope, &Rest::bend, &Rest::angle, &Rest::speed,
                            &Rest::speed_first, &Rest::speed_second, &Rest::speed_third})
    for (int lane = 0; lane < 4; ++lane) {
      EXPECT_NE((expected.*number)[lane], 0.0);
      EXPECT_EQ((next.*number)[lane], (expected.*number)[lane]);
    }
}

}  // namespace arcwall::sliding_beam_lanes_test
