// A member that is drawn from its other end has the same events: zones at its beginning and at its end are alike.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "model/deck/reader.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::reversed_members_test {
namespace {

using test::traced;

enum class Drawn { forward, backward };

// From A, on the left, to B.
std::string strip(Drawn drawn, const std::string& length, const std::string& wall, const std::string& member) {
  const auto [from, to] = drawn == Drawn::forward ? std::pair("A", "B") : std::pair("B", "A");
  return R"toml(
title = "A strip over a floor"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e5, I = 1.0 }
point = { A = [0.0, 0.0], B = [)toml" +
         length + ", 0.0] }\nmember.beam = { from = \"" + from + "\", to = \"" + to +
         "\", theory = \"euler-bernoulli\", material = \"m\", section = \"s\", elements = 60" + member +
         " }\nwall = [{ name = \"floor\", side = \"below\", contact_surface = \"axis\", profile = { type = \"flat\", z "
         "= " +
         wall + " } }]\nmonitor = [{ name = \"A\", at = \"A\", component = \"z\" }]\n";
}

// Clamped at its right end, bent in half waves, and pressed down more at its free end than at the other.
std::string wavy(Drawn drawn, const std::string& waves, const std::string& at_clamp) {
  const auto [from, to] = drawn == Drawn::forward ? std::pair("-1.0", at_clamp) : std::pair(at_clamp.c_str(), "-1.0");
  return strip(drawn, "5.0", "-0.0101",
               ", imperfection = { shape = \"sine\", amplitude = 0.01, waves = " + waves + " }") +
         "support = { B = [\"x\", \"z\", \"rotation\"] }\npath = { step = 0.005, max_step = 0.05, "
         "stop = { lambda = [-0.1, 40.0] } }\nload = [{ on = \"beam\", distributed = [0.0, " +
         from + "], distributed_to = [0.0, " + to + "] }]\n";
}

void expect_same_events(const Session& forward, const Session& backward) {
  const auto &one = forward.record().events, &other = backward.record().events;
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].kind, other[i].kind);
    EXPECT_NEAR(one[i].lambda, other[i].lambda, 1e-8 * (1.0 + std::abs(one[i].lambda)));
  }
}

}  // namespace

// The first zone reaches the free end; it merges with the next one, and both press the whole strip but its clamp.
TEST(ReversedMembers, MergeTheZoneAtTheirFreeEndWithTheNext) {
  for (const auto& [waves, at_clamp] : {std::pair("2", "-0.9"), {"4", "-0.3"}}) {
    SCOPED_TRACE(waves);
    const Session forward = traced(wavy(Drawn::forward, waves, at_clamp));
    const Session backward = traced(wavy(Drawn::backward, waves, at_clamp));
    EXPECT_FALSE(test::events_of(forward.record(), EventKind::contacts_merge).empty());
    EXPECT_EQ(forward.record().branches.back().end->reason, EndReason::stop);
    expect_same_events(forward, backward);
  }
}

// A force P = 0.02 λ lifts a strip of weight q = 0.01 off its floor at a = 2 from its clamp. The edges of the lifted
// part have neither slope nor moment, so that its half length is 3P/4q: it reaches the clamp at λ = 4/3.
TEST(ReversedMembers, LoseTheZoneAtTheirClampWhereItIsLifted) {
  const auto lifted = [](Drawn drawn) {
    const std::string at = drawn == Drawn::forward ? "beam:0.2" : "beam:0.8";
    return strip(drawn, "10.0", "0.0", "") +
           "support = { A = [\"x\", \"z\", \"rotation\"] }\npath = { step = 0.05, max_step = 0.5, stop = { lambda = "
           "[-0.1, 3.0] } }\nload = [{ on = \"beam\", distributed = [0.0, -0.01], constant = true }, { at = \"" +
           at + "\", force = [0.0, 0.02] }]\n";
  };
  const Session forward = traced(lifted(Drawn::forward)), backward = traced(lifted(Drawn::backward));
  EXPECT_NEAR(test::event_of(forward.record(), EventKind::contact_shrinks).lambda, 4.0 / 3.0, 1e-5);
  expect_same_events(forward, backward);
}

}  // namespace arcwall::reversed_members_test
