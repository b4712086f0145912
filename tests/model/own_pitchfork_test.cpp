// The branch of a pitchfork may end at a second one, where it goes through the first branch from one side to the other:
// λ turns along it and an eigenvalue touches zero without passing it. Whatever the steps are, also where one of them is
// shorter than a count of eigenvalues beside such a point takes, the second pitchfork is told and `follow` goes on
// along the first branch, not into the mirror image of the second. On the first branch an eigenvalue passes zero at
// both.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/model/traced_session.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::own_pitchfork_test {

using namespace test::tables;
namespace {

Session traced(const std::string& branches, double step) {
  return test::traced(title("a clamped arch with a load on its crown") + material("steel", 21000.0, "nu = 0.3") +
                          rectangle("s", 0.06248188940972283, 0.018655954346713677) +
                          points({{"left", 0.0, 0.0}, {"right", 5.020538616883647, 0.0}}) +
                          supports({{"left", "x z rotation"}, {"right", "x z rotation"}}) +
                          force("arch:0.5", 0.0, -0.0015829032310130389) + monitor("down", "arch:0.5", "z", flipped) +
                          monitor("across", "arch:0.5", "x") +
                          member("arch", "left", "right", "euler-bernoulli", 20,
                                 "via = [2.5102693084418237, 0.8933280363771969]", "steel"),
                      {"path.branches=\"" + branches + "\"", "path.step=" + std::to_string(step),
                       "path.stop={ lambda = [-3.0, 1.0], down = [-1.7866560727543939, 2.679984109131591] }"});
}

TEST(OwnPitchfork, IsToldAndLeftWhateverTheStep) {
  const auto both = test::events_of(traced("primary", 0.05).record(), EventKind::branch_point);
  ASSERT_EQ(both.size(), 2U);
  for (const double step : {0.05, 0.025, 0.0125, 0.005}) {
    SCOPED_TRACE(step);
    const Session run = traced("most-stable", step);
    const Record& record = run.record();
    const auto met = test::events_of(record, EventKind::branch_point);
    ASSERT_EQ(met.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(met[i].lambda, both[i].lambda, 1e-8);
    EXPECT_EQ(record.branches.size(), 3U);
    const RecordPoint& last = record.points.back();
    EXPECT_EQ(record.branches.back().end->reason, EndReason::stop);
    EXPECT_EQ(last.lambda, 1.0);
    EXPECT_EQ(last.count.unstable, 0);
    EXPECT_NEAR(last.monitors[1], 0.0, 1e-9);
  }
}

// An arch lies down on a round bump and lifts off it again. The point that was its contact is given up where λ turns
// next: with it the mesh is unsymmetric, the pitchfork opened a little, and the path runs round for ever.
TEST(OwnPitchfork, IsMetAgainAfterContact) {
  const Session run = test::traced(
      title("a clamped arch above a bump") + material("steel", 21000.0, "nu = 0.3") +
      rectangle("s", 4.636952381323354, 0.6918670694032281) +
      points({{"left", 0.0, 0.0}, {"right", 42.94059583618587, 0.0}}) +
      supports({{"left", "x z rotation"}, {"right", "x z rotation"}}) + force("arch:0.5", 0.0, -76.35508947597694) +
      wall(
          "bump",
          R"(side = "below"; profile = { type = "circle", centre = [21.457883158860305, -3.4363532150608505], radius = 6.3520729898973 })") +
      monitor("down", "arch:0.5", "z", flipped) +
      path("step = 0.05; jumps = false; stop = { lambda = [-3.0, 3.0], down = [-14.24570006850356, 21.36855010275534] "
           "}") +
      member("arch", "left", "right", "euler-bernoulli", 36, "sine = { rise = 7.12285003425178, waves = 1 }", "steel"));
  const auto met = test::events_of(run.record(), EventKind::branch_point);
  ASSERT_EQ(met.size(), 2U);
  EXPECT_NEAR(met[1].lambda, met[0].lambda, 1e-8);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
  EXPECT_EQ(run.points().back().count.unstable, 0);
}

}  // namespace
}  // namespace arcwall::own_pitchfork_test
