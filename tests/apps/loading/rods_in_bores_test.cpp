// Rods that nothing but the walls of a bore holds, under their own weight. References: extensible elastica of EI = 1,
// EA = 1e5 and length 1, θ′ = M/EI, (x′, z′) = (1 + N/EA) (cos θ, sin θ), M′ = −(r′ × n), shot with an 8th-order method
// (1e-12) from the middle or from the foot; a rod's mirror image in the round bore is itself. All digits given stay
// with a tolerance a hundred times as large.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/apps/loading/loading_decks.hpp"

namespace arcwall::loading_test {

namespace {

constexpr double pi = 3.14159265358979;

std::string half_plane(const std::string& name, const Vec2& point, const Vec2& normal) {
  return fmt::format(
      R"({{ name = "{}", contact_surface = "axis", outline = {{ type = "half-plane", point = [{:.17g}, {:.17g}], normal = [{:.17g}, {:.17g}] }} }})",
      name, point.x(), point.y(), normal.x(), normal.y());
}

std::string outline(const std::string& name, const std::string& outline, const std::string& more = "") {
  return "{ name = \"" + name + "\", contact_surface = \"axis\", outline = " + outline + more + " }";
}

const std::string round_bore =
    outline("bore", R"({ type = "circle", centre = [0.0, 0.0], radius = 1.0, structure = "inside" })");

// Floor, walls and roof of a square bore.
std::string square_bore(double side, double height) {
  return half_plane("floor", {0.0, 0.0}, {0.0, 1.0}) + ", " + half_plane("west", {0.0, 0.0}, {1.0, 0.0}) + ", " +
         half_plane("east", {side, 0.0}, {-1.0, 0.0}) + ", " + half_plane("roof", {0.0, height}, {0.0, -1.0});
}

// The same as one outline, with sharp corners.
std::string sharp_bore(double side, double height) {
  return outline("bore", fmt::format(R"({{ type = "polyline", x = [0.0, {0}, {0}, 0.0], z = [0.0, 0.0, {1}, {1}], )"
                                     R"(closed = true, structure = "inside" }})",
                                     side, height));
}

// The same of one outline whose corners are rounded.
std::string rounded_bore(double side, double radius) {
  return outline("bore",
                 fmt::format(R"({{ type = "polyline", x = [0.0, {0}, {0}, 0.0], z = [0.0, 0.0, {0}, {0}], )"
                             R"(closed = true, structure = "inside" }})",
                             side),
                 fmt::format(", corner_radius = {}", radius));
}

enum class Weight { grows, constant };

// A rod with the weight 1 per length, times λ, or constant and with a force λ on its middle.
std::string rod(const Vec2& a, const Vec2& b, const std::string& walls, Weight weight, double until,
                int elements = 24) {
  const bool grows = weight == Weight::grows;
  return fmt::format(R"(
title = "A rod in a bore"
material.m = {{ E = 1.0, nu = 0.3 }}
section.s = {{ shape = "general", A = 100000.0, I = 1.0 }}
point = {{ A = [{:.17g}, {:.17g}], B = [{:.17g}, {:.17g}] }}
member.rod = {{ from = "A", to = "B", theory = "elastica", elements = {}, material = "m", section = "s" }}
load = [{{ on = "rod", distributed = [0.0, -1.0]{} }}]
wall = [{}]
path = {{ step = 1.0, jumps = false, stop = {{ lambda = [-0.1, {}] }} }}
monitor = [
  {{ name = "middle", at = "rod:0.5", component = "z" }},
  {{ name = "foot", at = "A", component = "z" }},
  {{ name = "top", at = "B", component = "z" }},
]
)",
                     a.x(), a.y(), b.x(), b.y(), elements,
                     grows ? "" : R"(, constant = true }, { at = "rod:0.5", force = [0.0, -1.0])", walls, until);
}

void expect_end_by_stop(const TracedDeck& traced) {
  const auto& end = traced.record().branches.back().end;
  ASSERT_TRUE(end.has_value());
  EXPECT_EQ(end->reason, EndReason::stop) << end->detail;
}

double of_monitor(const RecordPoint& point, std::size_t which) { return point.monitors[which]; }

}  // namespace

// As long as the bore's radius it rests on its tips, until its middle touches and spreads.
TEST(RodInARoundBore, TouchesWithItsMiddleSlow) {
  std::vector<double> touches, spreads;
  for (const int elements : {12, 24, 48}) {
    const double deep = -std::sqrt(0.75);
    const TracedDeck traced(rod({-0.5, deep}, {0.5, deep}, round_bore, Weight::grows, 20.0, elements));
    const auto middle = events_of(traced, EventKind::contact_spreads);
    ASSERT_EQ(middle.size(), 1U);
    touches.push_back(std::abs(event_of(traced, EventKind::contact_closes, 2).lambda / 7.99867129 - 1.0));
    spreads.push_back(std::abs(middle.front().lambda / 14.37045844 - 1.0));
    expect_end_by_stop(traced);
    if (elements == 24) expect_confirmed(traced);
  }
  for (const auto& errors : {touches, spreads})
    for (const std::size_t finer : {1U, 2U}) EXPECT_GE(std::log2(errors[finer - 1] / errors[finer]), 3.5);
  EXPECT_LE(touches.back(), 1e-7);
  EXPECT_LE(spreads.back(), 1e-6);
}

// Released at a slant, and a short one far above the ground, it comes to rest at the bottom: its middle 0.87955721
// below the centre. A short rigid one that is 2a long rests √(1 − a²) below it.
TEST(RodInARoundBore, RollsToTheBottomSlow) {
  const double deep = std::sqrt(0.75) - 1e-3;
  const Eigen::Rotation2D<double> turn(pi / 9.0);
  const TracedDeck slanted(
      rod(turn * Vec2(-0.4999, -deep), turn * Vec2(0.4999, -deep), round_bore, Weight::constant, 10.0));
  const Vec2 began = turn * Vec2(0.0, -deep);
  EXPECT_NEAR(began.y() + of_monitor(slanted.record().points.front(), 0), -0.87955721, 1e-4);
  expect_confirmed(slanted);

  const TracedDeck small(rod({0.5, -0.4}, {0.7, -0.3}, round_bore, Weight::constant, 100.0));
  EXPECT_NEAR(-0.35 + of_monitor(small.record().points.front(), 0), -std::sqrt(1.0 - 0.0125), 1e-4);
  expect_confirmed(small);
}

// It leans in a bore that is 0.6 wide, its foot in the corner and its top on the wall. Its foot touches two walls
// there: it comes to lie on one of them where the rod sags so far, and its top on the wall above; what lies is of a
// length that λ determines.
TEST(RodInASquareBore, LeansInItsCornerSlow) {
  for (const int way : {0, 1, 2}) {
    const std::string floor = half_plane("floor", {0.0, 0.0}, {0.0, 1.0}),
                      west = half_plane("west", {0.0, 0.0}, {1.0, 0.0}),
                      east = half_plane("east", {0.6, 0.0}, {-1.0, 0.0});
    const std::string walls = way == 0   ? floor + ", " + west + ", " + east
                              : way == 1 ? west + ", " + floor + ", " + east
                                         : sharp_bore(0.6, 1.0);
    std::vector<double> foot_lies, top_lies;
    for (const int elements : {12, 24, 48}) {
      const TracedDeck traced(rod({0.0, 0.0}, {0.6, 0.8}, walls, Weight::grows, 100.0, elements));
      const auto lies = events_of(traced, EventKind::contact_spreads);
      ASSERT_EQ(lies.size(), 2U);
      foot_lies.push_back(std::abs(lies[0].lambda / 9.37023088 - 1.0));
      top_lies.push_back(std::abs(lies[1].lambda / 11.67063634 - 1.0));
      expect_end_by_stop(traced);
      const double top = 0.8 + of_monitor(traced.record().points.back(), 2);
      EXPECT_NEAR(top, 0.47597605874, elements == 12 ? 2e-4 : 2e-5);
      if (elements == 24) expect_confirmed(traced);
    }
    EXPECT_LE(foot_lies.back(), 1e-7);
    EXPECT_LE(top_lies.back(), 1e-6);
  }
}

// Where the weight is constant the part on the wall has a load along it from the start, and one that λ drives beside.
TEST(RodInASquareBore, LeansThereUnderAForceTooSlow) {
  const TracedDeck traced(
      rod({0.05, 0.05}, {0.55, 0.05 + 0.5 * std::sqrt(3.0)}, square_bore(0.6, 1.0), Weight::constant, 20.0, 48));
  const auto lies = events_of(traced, EventKind::contact_spreads);
  ASSERT_EQ(lies.size(), 2U);
  EXPECT_NEAR(lies[0].lambda, 6.78291821, 1e-6);
  EXPECT_NEAR(lies[1].lambda, 8.45093774, 1e-6);
  expect_end_by_stop(traced);
  expect_confirmed(traced);
}

// What falls flush, or on one end and then over, lies on the floor with all of its length, be that one wall of several
// or a part of an outline; there a force changes nothing any more.
TEST(RodInASquareBore, LiesOnItsFloorSlow) {
  const double side = 1.4;
  for (const std::string& walls : {square_bore(side, side), sharp_bore(side, side), rounded_bore(side, 0.1)})
    for (const double higher : {0.0, 0.2, 0.7}) {
      const double run = std::sqrt(1.0 - higher * higher);
      const double from = higher > 0.5 ? 0.4 : 0.2;  // the lower end slides away from under the rod
      const TracedDeck traced(rod({from, 0.05}, {from + run, 0.05 + higher}, walls, Weight::constant, 20.0));
      SCOPED_TRACE(walls);
      expect_end_by_stop(traced);
      for (const RecordPoint& point : traced.record().points) {
        EXPECT_NEAR(of_monitor(point, 1), -0.05, 1e-9);
        EXPECT_NEAR(of_monitor(point, 0), -0.05 - 0.5 * higher, 1e-9);
        EXPECT_NEAR(of_monitor(point, 2), -0.05 - higher, 1e-9);
        EXPECT_EQ(point.count.unstable, Index{0});
      }
      expect_confirmed(traced);
    }
}

// A force lifts one end from the floor as soon as it acts: of a rod whose weight is q the part a = 2 F/q is in the air,
// its end at h = q a⁴/(24 EI) in small slopes. Let down again it lies as before. Two forces lift both ends, until these
// parts meet: then it touches at a point, and leaves as a whole where they bear the weight.
TEST(RodInASquareBore, IsLiftedFromItsFloorAndLetDownSlow) {
  for (const std::string& walls : {square_bore(1.4, 1.4), rounded_bore(1.4, 0.1)}) {
    const std::string force = R"(at = "rod:0.5", force = [0.0, -1.0])";
    std::string deck = rod({0.2, 0.0}, {1.2, 0.0}, walls, Weight::constant, 0.2, 48);
    deck.replace(deck.find(force), force.size(), R"(at = "B", force = [0.0, 1.0])");
    const std::string path = deck.substr(deck.find("path = "), deck.find("monitor") - deck.find("path = "));
    std::string staged = deck;
    staged.replace(staged.find(path), path.size(), R"(
path = { step = 0.01, jumps = false }
stage = [
  { name = "up", drives = ["load.1"], step = 0.01, stop = { lambda = [-1.0, 0.3] } },
  { name = "down", drives = ["load.1"], step = -0.01, stop = { lambda = [-0.5, 1.0] } },
]
)");
    const TracedDeck one(staged);
    const auto leaves = events_of(one, EventKind::contact_opens), lies = events_of(one, EventKind::contact_closes);
    ASSERT_EQ(leaves.size(), 1U);
    ASSERT_EQ(lies.size(), 1U);
    EXPECT_NEAR(leaves.front().lambda, 0.0, 1e-5);  // the springs that hold the rod along the floor
    EXPECT_NEAR(lies.front().lambda, -0.3, 1e-5);
    double highest = 0.0;
    for (const RecordPoint& point : one.record().points) highest = std::max(highest, of_monitor(point, 2));
    const double a = 2.0 * 0.3, h = a * a * a * a / 24.0;
    EXPECT_NEAR(highest, h, 1e-3 * h);
    EXPECT_NEAR(of_monitor(one.record().points.back(), 2), 0.0, 1e-12);
    expect_end_by_stop(one);
    expect_confirmed(one);

    deck.replace(deck.find("wall = ["), 0, R"(
load = [
  { on = "rod", distributed = [0.0, -1.0], constant = true },
  { at = "A", force = [0.0, 0.5] },
  { at = "B", force = [0.0, 1.0] },
]
)");
    deck.erase(deck.find("load = [{"), deck.find("\n", deck.find("load = [{")) - deck.find("load = [{"));
    const TracedDeck both(deck, {"path.step=0.01", "path.stop.lambda=[-1.0,0.45]"});
    ASSERT_EQ(events_of(both, EventKind::contact_opens).size(), 1U);
    EXPECT_NEAR(event_of(both, EventKind::contact_opens).lambda, 0.0, 1e-5);
    EXPECT_NEAR(event_of(both, EventKind::contact_shrinks).lambda, 1.0 / 3.0, 1e-4);
    expect_end_by_stop(both);
    expect_confirmed(both);
  }
}

// A moment on a free end that lies on the floor is borne by nothing: turned up, √(2 M/q) of the rod is in the air;
// turned down, it arches beside the end. What the mesh makes of the pressure hides it below q h²/24.
TEST(RodInASquareBore, IsPeeledOffItsFloorByAMoment) {
  for (const double sense : {1.0, -1.0}) {
    std::string deck = rod({0.2, 0.0}, {1.2, 0.0}, square_bore(1.4, 1.4), Weight::constant, 0.1, 48);
    const std::string force = R"(at = "rod:0.5", force = [0.0, -1.0])";
    deck.replace(deck.find(force), force.size(), fmt::format(R"(at = "B", moment = {:.1f})", sense));
    const TracedDeck traced(deck, {"path.step=0.005"});
    const EventKind leaves = sense > 0.0 ? EventKind::contact_opens : EventKind::contact_splits;
    ASSERT_EQ(events_of(traced, leaves).size(), 1U);
    EXPECT_LE(event_of(traced, leaves).lambda, 1.01 / 24.0 / (48.0 * 48.0));
    expect_end_by_stop(traced);
    expect_confirmed(traced);
    if (sense < 0.0) continue;
    const double a = std::sqrt(2.0 * 0.1);  // EI w″″ = −q with w = w′ = w″ = 0 at the edge, no force at the end
    EXPECT_NEAR(of_monitor(traced.record().points.back(), 2), a * a * a * a / 8.0, 2e-3 * a * a * a * a / 8.0);
  }
}

// An end in a sharp hollow corner touches two lines of an outline, which a contact at a node does not.
TEST(RodInASquareBore, NeedsContactThatSlidesInSharpCorners) {
  const std::string deck = rod({0.2, 0.05}, {1.2, 0.05}, sharp_bore(1.4, 1.4), Weight::constant, 20.0);
  try {
    const TracedDeck traced(deck, {"contact.points=\"nodes\""});
    FAIL() << "nodes touch two lines at once";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("touches two lines at once"), std::string::npos) << error.what();
  }
}

// A part of an outline on which a rod lies ends where that bends, and a rod that is pushed there is told so.
TEST(RodOnAnOutline, IsToldWhereItsStraightPartEnds) {
  std::string deck = rod({0.2, 0.0}, {1.2, 0.0}, rounded_bore(1.4, 0.1), Weight::constant, 20.0);
  const std::string force = R"(at = "rod:0.5", force = [0.0, -1.0])";
  deck.replace(deck.find(force), force.size(), R"(at = "rod:0.5", force = [1.0, 0.0])");
  const TracedDeck traced(deck, {"path.step=1e-8"});
  const auto& end = traced.record().branches.back().end;
  ASSERT_TRUE(end.has_value());
  EXPECT_EQ(end->reason, EndReason::not_modelled);
  EXPECT_NE(end->detail.find("reached a bend or the end of the wall"), std::string::npos) << end->detail;
}

}  // namespace arcwall::loading_test
