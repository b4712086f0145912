// A ring between two plates, held by nothing else, drawn of members that begin and end anywhere on it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/apps/loading/loading_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::loading_test {

using namespace test::tables;

namespace {

// An arc of the ring from one angle to another [degrees].
struct Quarter {
  double from, to;
};

// A ring of radius and EI 1 and EA = 1e5 of such members; λ is the way of the upper plate.
std::string ring_of(const std::vector<Quarter>& arcs, int elements, double greatest_way) {
  const auto place = [](double degrees) {
    return fmt::format("[{:.12f}, {:.12f}]", std::cos(degrees * pi / 180.0), std::sin(degrees * pi / 180.0));
  };
  const auto name = [](double degrees) { return fmt::format("p{}", std::lround(degrees + 360.0) % 360); };
  std::string points, members;
  for (const auto& [from, to] : arcs) {
    for (const double end : {from, to})
      if (points.find(name(end) + " =") == std::string::npos) points += name(end) + " = " + place(end) + "\n";
    members += fmt::format(
        "[member.m{}]\nfrom = \"{}\"\nto = \"{}\"\nvia = {}\ntheory = \"elastica\"\nelements = {}\n"
        "material = \"m\"\nsection = \"s\"\n",
        members.size(), name(from), name(to), place(0.5 * (from + to)),
        std::lround(elements * std::abs(to - from) / 360.0));
  }
  return "title = \"Ring\"\nmaterial.m = { E = 1.0 }\nsection.s = { shape = \"general\", A = 1e5, I = 1.0 "
         "}\n[point]\n" +
         points + members + flat_wall("floor", "below", -1.0, on_axis) +
         flat_wall("plate", "above", 1.0, R"(contact_surface = "axis"; motion = { z = -1.0 })") +
         path(fmt::format(
             R"(step = 0.01; branches = "primary"; output_at = {{ lambda = [0.1] }}; stop = {{ lambda = [-0.01, {}] }})",
             greatest_way)) +
         wall_monitor("force", "plate", "force-z", flipped);
}

}  // namespace

// By shooting along the elastica that stretches: the force at ways of 0.1 and 1, and where the touches spread.
TEST(RingBetweenPlates, IsTheSameWhereverItsMembersMeetSlow) {
  struct Cut {
    std::string what;
    std::vector<Quarter> arcs;
    int elements;
  };
  for (const Cut& cut :
       {Cut{"two halves from below", {{-90.0, 90.0}, {270.0, 90.0}}, 64},
        Cut{"four quarters that meet between", {{45.0, 135.0}, {135.0, 225.0}, {225.0, 315.0}, {45.0, -45.0}}, 48},
        Cut{"three members", {{90.0, 210.0}, {330.0, 210.0}, {-30.0, 90.0}}, 48}}) {
    SCOPED_TRACE(cut.what);
    const TracedDeck ring(ring_of(cut.arcs, cut.elements, 1.0));
    const Record& record = ring.record();
    EXPECT_EQ(record.branches.back().end->reason, EndReason::stop) << record.branches.back().end->detail;
    const auto spreads = events_of(ring, EventKind::contact_spreads);
    ASSERT_FALSE(spreads.empty());
    EXPECT_NEAR(spreads.front().lambda, 0.5644732048945937, 1e-5);
    EXPECT_NEAR(spreads.front().monitors[0], 2.7864167288521418, 1e-4);
    for (const RecordPoint& point : record.points) {
      if (point.lambda == 0.1) {
        EXPECT_NEAR(point.monitors[0], 0.6253825639848148, 1e-5);
      }
    }
    EXPECT_NEAR(record.points.back().monitors[0], 5.7419796992860315, 1e-4);
    expect_confirmed(ring);
  }
}

// Clamped where it lies on the floor the ring is one strand that begins and ends there.
TEST(RingBetweenPlates, MayBeHeldAtOneOfItsJoints) {
  const TracedDeck loose(ring_of({{-90.0, 90.0}, {90.0, 270.0}}, 48, 0.1));
  const TracedDeck held(ring_of({{-90.0, 90.0}, {90.0, 270.0}}, 48, 0.1),
                        {"support.p270=[\"x\", \"z\", \"rotation\"]"});
  EXPECT_EQ(held.model().sliding_structure()->strands(), 1);
  EXPECT_NEAR(held.record().points.back().monitors[0], loose.record().points.back().monitors[0], 1e-5);
  expect_confirmed(held);
}

}  // namespace arcwall::loading_test
