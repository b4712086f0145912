// A pinned column between four round pegs with clearance, two at each third of its length. References: extensible
// elastica of EI = 1, EA = 1e5 and length 1, shot from the held end with an 8th-order method (1e-12): the distance to a
// peg and the angle with it at the touch, and the other end's place and moment, vanish. The load is the other end's.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/apps/traced_deck.hpp"

namespace arcwall {

namespace {

std::string column(int elements) {
  constexpr double radius = 0.02, clearance = 0.02;
  std::string walls;
  for (const int third : {1, 2})
    for (const double side : {1.0, -1.0})
      walls += fmt::format(
          R"({{ name = "{}{}", contact_surface = "axis", outline = {{ type = "circle", centre = [{:.17g}, {:.17g}], radius = {} }} }},
)",
          side > 0.0 ? "over" : "under", third, third / 3.0, side * (radius + clearance), radius);
  return fmt::format(R"(
title = "A column between four pegs"
units = {{ length = "m", force = "N" }}
material.m = {{ E = 1.0, nu = 0.3 }}
section.s = {{ shape = "general", A = 100000.0, I = 1.0 }}
point = {{ A = [0.0, 0.0], B = [1.0, 0.0] }}
support = {{ A = ["x", "z"], B = ["z"] }}
member.column = {{ from = "A", to = "B", theory = "elastica", elements = {}, material = "m", section = "s" }}
load = [{{ at = "B", force = [-1.0, 0.0] }}]
monitor = [{{ name = "middle", at = "column:0.5", component = "z" }}]
path = {{ step = 1.0, branches = "most-stable", jumps = false, stop = {{ lambda = [-1.0, 150.0] }} }}
wall = [
{}]
)",
                     elements, walls);
}

}  // namespace

// It buckles at π², touches the upper pegs one after the other, since it shortens towards one of them, leaves the
// second one again, and touches the lower one across from that: there the open touch and the new one are at one place
// of the column, and on no mesh is there an element between them.
TEST(FourPegs, TouchAColumnOneAfterTheOtherSlow) {
  for (const int elements : {12, 24, 48}) {
    SCOPED_TRACE(elements);
    const test::TracedDeck traced(column(elements));
    const auto touches = test::events_of(traced, EventKind::contact_closes);
    ASSERT_GE(touches.size(), 3U);
    const double error = elements == 12 ? 1e-6 : elements == 24 ? 5e-8 : 5e-9;
    EXPECT_NEAR(touches[0].lambda, 9.877060699468, error * touches[0].lambda);
    EXPECT_NEAR(touches[1].lambda, 10.021164976409, error * touches[1].lambda);
    EXPECT_NEAR(touches[2].lambda, 39.671721537296, error * touches[2].lambda);
    const auto& end = traced.record().branches.back().end;
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(end->reason, EndReason::stop) << end->detail;
  }
}

}  // namespace arcwall
