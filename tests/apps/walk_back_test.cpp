// A path that would go back along itself is ended where the way on was missed.
#include <gtest/gtest.h>

#include <string>

#include "apps/output/exit_status.hpp"
#include "tests/apps/traced_deck.hpp"

namespace arcwall::walk_back_test {
namespace {

// A strip of two thicknesses, pushed together between two flat walls. Contact at nodes, on 40 and on 80 elements a
// member, follows it with λ growing all the way to 7.07: the contact at the joint opens on the way.
const std::string stepped = R"toml(title = "stepped strip"
[material.steel]
E = 21000.0
[section.s]
shape = "rectangle"
width = 0.7890606294094236
height = 0.1267474851349183
[section.t]
shape = "rectangle"
width = 0.7890606294094236
height = 0.1517680229730473
[member.thin]
from = "left"
to = "joint"
theory = "elastica"
material = "steel"
section = "s"
elements = 20
imperfection = { shape = "sine", amplitude = 0.018343140464892185, waves = 2 }
[member.thick]
from = "joint"
to = "right"
theory = "elastica"
material = "steel"
section = "t"
elements = 20
[point]
left = [0.0, 0.0]
joint = [3.5571845498618875, 0.0]
right = [7.787215995808299, 0.0]
[support]
left = ["x", "z"]
right = ["z"]
[[load]]
at = "right"
force = [-0.45761661018592664, 0.0]
[[load]]
at = "joint"
force = [0.0, -0.0045739479453340785]
[[wall]]
name = "upper"
side = "above"
profile = { type = "flat", z = 0.6873220269829299 }
[[wall]]
name = "lower"
side = "below"
profile = { type = "flat", z = -0.6873220269829299 }
[[monitor]]
name = "shortening"
at = "right"
component = "x"
sign = -1
[path]
step = 0.05
stop = { lambda = [-1.0, 7.07], shortening = [-1.55, 5.45] }
jumps = false
)toml";

}  // namespace

TEST(WalkBack, IsNoEndOfSuccess) {
  for (const char* elements : {"16", "22", "28"}) {
    const test::TracedDeck traced(
        stepped, {std::string("member.thin.elements=") + elements, std::string("member.thick.elements=") + elements});
    const Record& record = traced.record();
    const BranchEnd& end = record.branches.at(0).end.value();
    if (end.reason == EndReason::stop) {
      EXPECT_EQ(record.points.back().lambda, 7.07) << elements;
      continue;
    }
    EXPECT_EQ(exit_status(record), ExitStatus::ended_early) << elements << ": " << end.detail;
    EXPECT_GT(record.points.back().lambda, 5.8) << elements;  // before the changes that lie farther back
  }
}

}  // namespace arcwall::walk_back_test
