// A zone that begins at a joint at once: other changes of contact would lead the path back along itself.
#include <gtest/gtest.h>

#include <string>

#include "tests/apps/traced_deck.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::walk_back_test {

using namespace test::tables;
namespace {

// A strip of two thicknesses, pushed together between two flat walls. Contact at nodes, on 40 and on 80 elements a
// member, follows it with λ growing all the way to 7.07: the contact at the joint opens on the way.
const std::string stepped =
    title("stepped strip") + material("steel", 21000.0) + rectangle("s", 0.7890606294094236, 0.1267474851349183) +
    rectangle("t", 0.7890606294094236, 0.1517680229730473) +
    member("thin", "left", "joint", "elastica", 20, imperfection({{2, 0.018343140464892185}}), "steel") +
    member("thick", "joint", "right", "elastica", 20, "", "steel", "t") +
    points({{"left", 0.0, 0.0}, {"joint", 3.5571845498618875, 0.0}, {"right", 7.787215995808299, 0.0}}) +
    supports({{"left", "x z"}, {"right", "z"}}) + force("right", -0.45761661018592664, 0.0) +
    force("joint", 0.0, -0.0045739479453340785) + channel(0.6873220269829299) +
    monitor("shortening", "right", "x", flipped) +
    path("step = 0.05; stop = { lambda = [-1.0, 7.07], shortening = [-1.55, 5.45] }; jumps = false");

}  // namespace

// The arch between the joint and the contact behind it vanishes: contact passes to a zone from there to that contact at
// once, and the joint leaves the wall. With contact at nodes it does so at 6.225 on 160 elements a member and at 6.132
// on 320, and λ grows to 7.07 with a shortening of 0.1722.
TEST(WalkBack, IsNoneWhereAZoneBeginsAtAJoint) {
  for (const char* elements : {"16", "20", "22", "28"}) {
    const test::TracedDeck traced(
        stepped, {std::string("member.thin.elements=") + elements, std::string("member.thick.elements=") + elements});
    const Record& record = traced.record();
    const RecordEvent& merge = test::event_of(traced, EventKind::contacts_merge);
    EXPECT_NEAR(merge.lambda, 6.10, 0.05) << elements;
    EXPECT_EQ(merge.unstable_after, Index{0}) << elements;
    EXPECT_EQ(record.branches.at(0).end.value().reason, EndReason::stop) << elements;
    EXPECT_EQ(record.points.back().lambda, 7.07) << elements;
    EXPECT_NEAR(record.points.back().monitors.at(0), 0.1722, 5e-5) << elements;
  }
}

// Unloading from 6.5 brings contact back to the joint at the load at which it left.
TEST(WalkBack, UnloadingReturnsContactToTheJoint) {
  const test::TracedDeck traced(
      stepped.substr(0, stepped.find("[path]")) +
      table("[[stage]]",
            R"(name = "in"; drives = ["load.0", "load.1"]; step = 0.05; stop = { lambda = [-1.0, 6.5] })") +
      table("[[stage]]",
            R"(name = "out"; drives = ["load.0", "load.1"]; step = -0.05; stop = { lambda = [-0.6, 1.0] })"));
  const double merge = test::event_of(traced, EventKind::contacts_merge).lambda;
  EXPECT_NEAR(6.5 + test::event_of(traced, EventKind::contact_transfers).lambda, merge, 1e-7 * merge);
}

}  // namespace arcwall::walk_back_test
