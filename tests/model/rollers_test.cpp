// A strip in line over a joint that a support or a spring holds along x, among rollers: the one that presses on the
// joint touches it together with others elsewhere.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/model/traced_session.hpp"

namespace arcwall::rollers_test {
namespace {

using test::events_of;
using test::traced;

constexpr double EI = 2.1e5 * 20.0 * 64.0 / 12.0;

std::string member(const char* name, const char* from, const char* to, int elements) {
  return fmt::format(
      "[member.{}]\nfrom = \"{}\"\nto = \"{}\"\ntheory = \"elastica\"\nmaterial = \"s\"\nsection = \"r\"\n"
      "elements = {}\n",
      name, from, to, elements);
}

std::string roller(int number, double x, double z, double motion = 0.0) {
  std::string text = fmt::format(
      "[[wall]]\nname = \"w{}\"\noutline = {{ type = \"circle\", centre = [{}, {}], radius = 5.0 }}\n", number, x, z);
  if (motion != 0.0) text += fmt::format("motion = {{ z = {} }}\n", motion);
  return text + fmt::format("[[monitor]]\nname = \"f{0}\"\nwall = \"w{0}\"\ncomponent = \"force-z\"\n", number);
}

// A strip 2 × 220 long and 4 high that touches rollers below, w1 and w2, and is 0.5 off w3, which presses it down.
struct Strip {
  double joint = 0.0;  // its place, at which it is held along x; below w3 unless that is elsewhere
  int before = 16, behind = 16;
  double west = -200.0, east = 200.0, motion = -5.5, east_gap = 0.0;

  std::string deck() const {
    return start(true) + roller(1, west, -7.0) + roller(2, east, -7.0 - east_gap) + roller(3, joint, 7.5, motion);
  }
  // The same without the joint, held at its end.
  std::string in_one() const {
    return start(false) + roller(1, west, -7.0) + roller(2, east, -7.0 - east_gap) + roller(3, joint, 7.5, motion);
  }

 private:
  std::string start(bool joined) const {
    return fmt::format("title = \"rollers\"\nsupport = {{ {} = [\"x\"] }}\n", joined ? "c" : "a") +
           "path = { step = 0.05, stop = { lambda = [-0.1, 1.0] } }\nmaterial.s = { E = 2.1e5 }\n"
           "section.r = { shape = \"rectangle\", width = 20.0, height = 4.0 }\n" +
           fmt::format("point = {{ a = [-220.0, 0.0], {} b = [220.0, 0.0] }}\n",
                       joined ? fmt::format("c = [{:.1f}, 0.0],", joint) : "") +
           (joined ? member("l", "a", "c", before) + member("r", "c", "b", behind)
                   : member("m", "a", "b", before + behind));
  }
};

struct Forces {
  double west, east, above;
};

void expect_forces(const std::string& deck, const Forces& expected, double accuracy) {
  const Session run = traced(deck);
  const RecordPoint& last = run.record().points.back();
  EXPECT_EQ(last.lambda, 1.0);
  EXPECT_EQ(last.count.unstable, 0);
  EXPECT_NEAR(last.monitors[0], expected.west, accuracy);
  EXPECT_NEAR(last.monitors[1], expected.east, accuracy);
  EXPECT_NEAR(last.monitors[2], expected.above, accuracy);
}

// What a strip in one has.
Forces forces_in_one(const Strip& strip) {
  const Session run = traced(strip.in_one());
  const std::vector<double>& last = run.record().points.back().monitors;
  return {.west = last[0], .east = last[1], .above = last[2]};
}

}  // namespace

// In small slopes f₃ = 3 EI l w/(a b)², of which the lever takes a part to each side.
TEST(Rollers, ThatTouchTogetherAllHold) {
  for (const Strip& strip :
       {Strip{.joint = -100.0, .before = 12, .behind = 32}, Strip{}, Strip{.before = 8, .behind = 8},
        Strip{.before = 20, .behind = 20}, Strip{.motion = -6.45238}, Strip{.east = 150.0}, Strip{.west = -150.0}}) {
    SCOPED_TRACE(fmt::format("{} {} {} {}", strip.joint, strip.west, strip.east, strip.before));
    const Forces held = forces_in_one(strip);
    const double a = strip.joint - strip.west, b = strip.east - strip.joint, l = a + b;
    const double above = 3.0 * EI * l * (-strip.motion - 0.5) / (a * a * b * b);
    EXPECT_NEAR(held.above, -above, 0.01 * above);
    EXPECT_NEAR(held.west, above * b / l, 0.01 * above);
    expect_forces(strip.deck(), held, 2e-4 * above);
  }
}

// The strip swings about w1 until it comes to w2, before contact has moved along it by what a span begins with.
TEST(Rollers, ARollerIsMetWhileTheStripSwings) {
  for (const double gap : {1.0, 2.0, 5.0}) {
    SCOPED_TRACE(gap);
    const Strip strip{.joint = -100.0, .before = 12, .behind = 32, .east_gap = gap};
    const Forces held = forces_in_one(strip);
    EXPECT_GT(held.east, 1.0);
    expect_forces(strip.deck(), held, 2e-4 * -held.above);
  }
}

// What slides under the peg stretches the spring alone: nothing gives way.
TEST(Rollers, ASpringAtAJointLeavesContactFreeToSlide) {
  for (const double stiffness : {0.01, 0.1, 10.0}) {
    SCOPED_TRACE(stiffness);
    const Session run = traced(
        "title = \"a peg above a spring\"\nsupport = { a = [\"z\"], b = [\"z\"] }\n"
        "path = { step = 0.05, stop = { lambda = [-0.1, 1.0] } }\nmaterial.s = { E = 2.1e5 }\n"
        "section.r = { shape = \"rectangle\", width = 20.0, height = 4.0 }\n"
        "point = { a = [-220.0, 0.0], c = [0.0, 0.0], b = [220.0, 0.0] }\n" +
        member("l", "a", "c", 16) + member("r", "c", "b", 16) + roller(3, 0.0, 7.5, -6.5) +
        fmt::format("[[spring]]\nat = \"c\"\nstiffness = {{ x = {} }}\n", stiffness));
    const RecordPoint& last = run.record().points.back();
    EXPECT_EQ(last.lambda, 1.0);
    EXPECT_TRUE(events_of(run.record(), EventKind::branch_point).empty());
    for (const RecordPoint& point : run.record().points) EXPECT_EQ(point.count.unstable.value_or(0), 0);
    EXPECT_NEAR(last.monitors[0], -48.0 * EI * 6.0 / (440.0 * 440.0 * 440.0), 0.1);
  }
}

// Contact at nodes does not feel a roller between two of them. A path that would lead the roller through the strip ends
// there and names it; to where moving contact finds the same force, the run holds.
TEST(Rollers, ARollerDoesNotSlipThroughBetweenNodes) {
  const std::string strip =
      "title = \"a strip pushed by a roller\"\nsupport = { a = [\"x\", \"z\", \"rotation\"], b = [\"z\", \"rotation\"] "
      "}\n"
      "path = { step = 0.1, stop = { lambda = [-1.0, 40.0] } }\nmaterial.s = { E = 2.1e5, nu = 0.3 }\n"
      "section.r = { shape = \"rectangle\", width = 10.0, height = 1.0 }\n"
      "point = { a = [0.0, 0.0], b = [200.0, 0.0] }\n"
      "monitor = [{ name = \"mid\", at = \"c:0.5\", component = \"z\" }]\n"
      "wall = [{ name = \"peg\", motion = { z = 1.0 }, outline = { type = \"circle\", centre = [120.0, -10.0], radius "
      "= 3.0 } }]\n"
      "contact.points = \"nodes\"\nmember.c = { from = \"a\", to = \"b\", theory = \"reissner\", material = \"s\", "
      "section = "
      "\"r\", elements = 20 }\n";
  const Session run = traced(strip);
  for (const RecordPoint& point : run.record().points) EXPECT_GE(point.monitors[0], -1e-9) << point.lambda;
  const BranchEnd& end = *run.record().branches.back().end;
  EXPECT_EQ(end.reason, EndReason::not_modelled);
  EXPECT_NE(end.detail.find("peg at c:"), std::string::npos) << end.detail;
}

}  // namespace arcwall::rollers_test
