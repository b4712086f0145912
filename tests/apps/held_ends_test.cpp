// Walls that come to places which supports hold, or these to walls: no contact force moves them, so the path ends
// there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/apps/traced_deck.hpp"

namespace arcwall::held_ends_test {
namespace {

using test::TracedDeck;

std::string beam(const std::string& rest) {
  return R"toml(
title = "A beam whose ends are held"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1.0e4, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
member.c = { from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 8 }
)toml" + rest;
}

void expect_end_at(const std::string& deck, double lambda, const std::string& place) {
  const TracedDeck traced(deck);
  const BranchEnd& end = *traced.record().branches.back().end;
  EXPECT_EQ(end.reason, EndReason::not_modelled);
  EXPECT_NE(end.detail.find(place), std::string::npos) << end.detail;
  EXPECT_LE(traced.last().lambda, lambda + 1e-9);
  EXPECT_GE(traced.last().lambda, lambda - 1e-5);
}

TEST(HeldEnds, AnEndIsLoweredOntoAFloor) {
  for (const char* points : {"moving", "nodes"})
    expect_end_at(beam(fmt::format(R"toml(
support = {{ a = ["x", "z", "rotation"], b = ["x", "rotation"] }}
prescribed = [{{ at = "b", z = -0.003 }}]
wall = [{{ name = "floor", side = "below", contact_surface = "axis", profile = {{ type = "flat", z = -0.002 }} }}]
contact.points = "{}"
path = {{ step = 0.05, branches = "primary", stop = {{ lambda = [-1.0, 1.0] }} }}
)toml",
                                   points)),
                  2.0 / 3.0, "floor at c:1");
}

TEST(HeldEnds, AFloorRisesToSupports) {
  for (const char* points : {"moving", "nodes"})
    expect_end_at(beam(fmt::format(R"toml(
support = {{ a = ["x", "z"], b = ["x", "z"] }}
wall = [{{ name = "floor", side = "below", contact_surface = "axis", profile = {{ type = "flat", z = -0.002 }}, motion = {{ z = 0.004 }} }}]
load = [{{ at = "c:0.5", force = [0.0, 1.0e-3], constant = true }}]
contact.points = "{}"
path = {{ step = 0.05, branches = "primary", stop = {{ lambda = [-1.0, 1.0] }} }}
)toml",
                                   points)),
                  0.5, "floor at c:");
}

}  // namespace
}  // namespace arcwall::held_ends_test
