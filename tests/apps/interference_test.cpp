// Walls into which the structure reaches at rest, and which are pushed to their places before the path starts.
#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "tests/apps/traced_deck.hpp"

namespace arcwall::interference_test {
namespace {

using test::TracedDeck;

// A beam of EI = 1 and span 2, pressed endwise, with walls of its own.
std::string beam(const std::string& walls) {
  return R"toml(
title = "A beam with preloaded stops"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e4, I = 1.0 }
point = { A = [0.0, 0.0], B = [2.0, 0.0] }
support = { A = ["x", "z"], B = ["z"] }
load = [{ at = "B", force = [-1.0, 0.0] }]
member.beam = { from = "A", to = "B", theory = "elastica", elements = 12, material = "m", section = "s" }
path = { step = 0.1, stop = { lambda = [-1.0, 0.5] } }
monitor = [{ name = "up", wall = "under", component = "force-z" }, { name = "third", at = "beam:0.6666666666666666", component = "z" }]
)toml" + walls;
}

// A round stop whose nearest point is at x and z.
std::string stop(const std::string& name, double x, double z, bool under, double interference) {
  const double radius = 0.1, centre = under ? z - radius : z + radius;
  return "[[wall]]\nname = \"" + name + "\"\ncontact_surface = \"axis\"\noutline = { type = \"circle\", centre = [" +
         std::to_string(x) + ", " + std::to_string(centre) +
         "], radius = 0.1 }\ninterference = " + std::to_string(interference) + "\n";
}

double at_start(const TracedDeck& traced, std::size_t monitor) {
  return traced.record().points.front().monitors.at(monitor);
}

}  // namespace

// In small slopes a stop that lifts the middle by d bears 48 EI d/L³.
TEST(Interference, OfAStopUnderTheMiddlePreloadsIt) {
  for (const std::string points : {"moving", "nodes"}) {
    const TracedDeck traced(beam(stop("under", 1.0, 1e-4, true, 2e-4)), {"contact.points=\"" + points + "\""});
    EXPECT_NEAR(at_start(traced, 0), 48.0 * 1e-4 / 8.0, 1e-9) << points;
    EXPECT_EQ(traced.record().points.front().count.unstable, 0) << points;
  }
}

// A wall is where it is drawn in the end: an interference with what it does not overlap with does nothing, and says so.
TEST(Interference, WithoutAnOverlapHasNoEffect) {
  const auto told = [](double z) {
    const TracedDeck traced(beam(stop("under", 1.0, z, true, 2e-4)));
    int count = 0;
    for (const std::string& warning : traced.model().warnings())
      count += warning.find("interference of wall \"under\" has no effect") != std::string::npos ? 1 : 0;
    return count;
  };
  EXPECT_EQ(told(-1e-4), 1);
  EXPECT_EQ(told(1e-4), 0);
}

// How far the wall was moved back does not matter.
TEST(Interference, LeadsToTheSameStateFromFarther) {
  const std::string walls = stop("under", 0.9, 0.05, true, 0.06);
  const TracedDeck near(beam(walls)), far(beam(walls), {"wall.under.interference=0.4"});
  EXPECT_GT(at_start(near, 0), 0.1);
  EXPECT_NEAR(at_start(far, 0), at_start(near, 0), 1e-9);
  EXPECT_NEAR(far.record().points.back().monitors[0], near.record().points.back().monitors[0], 1e-8);
}

// Stops from both sides at the thirds: each half of the beam is a beam of span L/2 with one of the forces,
// P = 486 EI d/L³ in small slopes. Slopes of 10⁻⁴ move the contacts along the round stops, which changes that by some
// 10⁻⁵ of it.
TEST(Interference, OfStopsOnBothSidesHoldsBoth) {
  const TracedDeck traced(
      beam(stop("under", 2.0 / 3.0, 1e-4, true, 1e-4) + stop("over", 4.0 / 3.0, -1e-4, false, 1e-4)));
  EXPECT_NEAR(at_start(traced, 0), 486.0 * 1e-4 / 8.0, 1e-6);
  EXPECT_NEAR(at_start(traced, 1), -1e-4, 1e-8);
}

TEST(Interference, ThatIsTooSmallIsRefused) {
  try {
    const TracedDeck traced(beam(stop("under", 1.0, 0.01, true, 0.005)));
    FAIL() << "it was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is inside the wall at the start: node beam:0.5 by 0.01, more than its"),
              std::string::npos)
        << error.what();
  }
}

// A circlip of radius 9.5 mm and height 1.4 mm on a shaft of radius 9.1 mm, drawn to seven digits, which pliers open.
const std::string circlip = R"toml(
title = "A circlip on a shaft that is too thick for it"
units = { length = "mm", force = "N" }
material.spring = { E = 2.06e5 }
section.clip = { shape = "rectangle", width = 0.9, height = 1.4 }
point = { back = [-9.5, 0.0], up = [8.927080, 3.249191], down = [8.927080, -3.249191] }
support.back = ["z", "rotation"]
load = [{ at = "up", force = [0.0, 1.0] }, { at = "down", force = [0.0, -1.0] }]
path = { step = 0.1, stop = { lambda = [-1.0, 12.0] } }
monitor = [{ name = "open", at = "up", component = "z" }, { name = "moment", member = "upper", component = "greatest-moment" }]
[member]
upper = { from = "back", to = "up", via = [-1.649658, 9.355674], theory = "elastica", material = "spring", section = "clip", elements = 40 }
lower = { from = "back", to = "down", via = [-1.649658, -9.355674], theory = "elastica", material = "spring", section = "clip", elements = 40 }
[[wall]]
name = "shaft"
outline = { type = "circle", centre = [0.0, 0.0], radius = 9.1 }
interference = 0.3
)toml";

// Own shooting of the extensible elastica: it lies on the shaft over 0.209 of each half from its back on, pressed by
// 1.4200 N/mm, and touches with its tips.
TEST(Interference, OfAShaftInARingGrowsTheShaft) {
  const TracedDeck traced(circlip, {"path.stop.lambda=[-1.0, 0.2]"});
  EXPECT_NEAR(at_start(traced, 0), 0.9057728, 2e-5);
  EXPECT_NEAR(at_start(traced, 1), 161.7692, 5e-3);
  double tip = 0.0;
  for (const RecordForce& force : traced.record().points.front().forces)
    if (force.label.member == "upper" && force.label.fraction == 1.0) tip = force.force;
  EXPECT_NEAR(tip, 16.49945, 2e-3);
}

// Nodes leave the shaft and come back to it in mirrored pairs until the tips leave, at 11.566766104 by own shooting of
// a half that only its back holds. One of a pair may be first by the digits of the deck, and the other follows at the
// same place.
TEST(Interference, OfAShaftInARingLetsMirroredTipsGo) {
  for (const char* elements : {"20", "30", "40"}) {
    SCOPED_TRACE(elements);
    const TracedDeck traced(
        circlip, {std::string("member.upper.elements=") + elements, std::string("member.lower.elements=") + elements});
    const Record& record = traced.record();
    EXPECT_EQ(record.branches.back().end->reason, EndReason::stop);
    const RecordEvent& last = *std::find_if(record.events.rbegin(), record.events.rend(), [](const RecordEvent& event) {
      return event.kind == EventKind::contact_opens;
    });
    EXPECT_NEAR(last.lambda, 11.566766104, 1e-6);
    EXPECT_EQ(last.contacts.size(), 2U);
  }
}

// Only an arc about the same centre makes contact go to nodes, which may miss what is between them: a pin in a frame is
// pushed along its normal. With a node over the pin, which sways off its top a little, the force is half a percent
// less.
TEST(Interference, OfAPinInAFrameMovesThePin) {
  const std::string frame = R"toml(
title = "A square frame with a pin in it"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e4, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0], c = [1.0, 1.0], d = [0.0, 1.0] }
support = { a = ["x", "z", "rotation"], b = ["x", "z", "rotation"] }
load = [{ at = "c", force = [0.1, 0.0] }]
path = { step = 0.1, stop = { lambda = [-1.0, 0.2] } }
monitor = [{ name = "pin", wall = "pin", component = "force-z" }]
[member]
left = { from = "a", to = "d", theory = "elastica", material = "m", section = "s", elements = 8 }
right = { from = "b", to = "c", theory = "elastica", material = "m", section = "s", elements = 8 }
top = { from = "d", to = "c", theory = "elastica", material = "m", section = "s", elements = 10 }
[[wall]]
name = "pin"
contact_surface = "axis"
outline = { type = "circle", centre = [0.55, 0.991], radius = 0.01 }
interference = 0.002
)toml";
  const TracedDeck moving(frame), nodes(frame, {"contact.points=\"nodes\"", "member.top.elements=20"});
  ASSERT_NE(moving.model().sliding(), nullptr);
  EXPECT_GT(at_start(moving, 0), 0.01);
  EXPECT_NEAR(at_start(moving, 0), at_start(nodes, 0), 5e-3 * at_start(nodes, 0));
}

}  // namespace arcwall::interference_test
