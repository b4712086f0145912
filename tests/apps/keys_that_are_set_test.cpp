// Keys may be given by --set, as sweeps do, as well as in the deck: the run is the same to the last bit, and is
// verified.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "apps/output/events_json.hpp"
#include "apps/output/path_csv.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::keys_that_are_set_test {
namespace {

using test::TracedDeck;

// A strip over a step, half of a whole, that a load presses on it; every key below is somewhere in it.
const std::string strip = R"toml(
title = "Half a strip on a plateau"
units = { length = "mm", force = "N" }
variables = { drop = 2.0 }
material.m = { E = 2.0e5, allowable = 400.0 }
section.s = { shape = "rectangle", width = 10.0, width_to = 8.0, height = 1.0, height_to = 0.9 }
point = { mid = [0.0, 0.0], end = [100.0, 0.0] }
support = { mid = "symmetry-x" }
spring = [{ name = "hanger", at = "end", stiffness = { x = 0.1, z = 0.5 } }]
load = [{ on = "strip", distributed = [0.0, -0.1], distributed_to = [0.0, -0.3], per = "x" }]
prescribed = [{ at = "end", z = 1.0, from = "stage" }]
member.strip = { from = "mid", to = "end", theory = "elastica", elements = 8, material = "m", section = "s" }
path = { watch = { value = { sink = [-1.7] }, zero = ["past"] }, branches = "jump" }
monitor = [{ name = "sink", at = "end", component = "z" }, { name = "past", at = "end", component = "z" }, { name = "use", component = "utilisation" }, { name = "first", wall = "plateau", member = "strip", component = "contact-start" }, { name = "on", wall = "plateau", member = "strip", component = "force-z" }, { name = "pull", at = "end", component = "reaction-z" }]
stage = [{ name = "load", drives = ["load.0"], step = 0.1, stop = { lambda = [-0.1, 1.0] } }, { name = "grip", drives = ["prescribed.0"], step = 0.1, stop = { lambda = [-0.1, 2.0], contacts = 9 } }]
[[wall]]
name = "plateau"
contact_surface = "axis"
outline = { type = "polyline", x = [-300.0, -200.0, 200.0, 300.0], z = [-102.0, "-drop", "-drop", -102.0] }
corner_radius = [5.0, 5.0]
)toml";

// A key, as it stands in the deck, what stands there instead before it is set, and how it is set.
struct Key {
  std::string written, before, assignment;
};

const std::vector<Key> keys{
    {"drop = 2.0", "drop = 1.0", "drop=2.0"},
    {"drop = 2.0", "drop = 1.0", "variables.drop=2.0"},
    {", allowable = 400.0", ", allowable = 1.0", "material.m.allowable=400.0"},
    {", width_to = 8.0", "", "section.s.width_to=8.0"},
    {", height_to = 0.9", "", "section.s.height_to=0.9"},
    {"mid = \"symmetry-x\"", "mid = [\"x\", \"z\"]", "support.mid=\"symmetry-x\""},
    {", distributed_to = [0.0, -0.3]", "", "load.0.distributed_to=[0.0, -0.3]"},
    {", per = \"x\"", "", "load.0.per=\"x\""},
    {", from = \"stage\"", "", "prescribed.0.from=\"stage\""},
    {"value = { sink = [-1.7] }, ", "", "path.watch.value={ sink = [-1.7] }"},
    {"zero = [\"past\"]", "zero = []", "path.watch.zero=[\"past\"]"},
    {", branches = \"jump\"", "", "path.branches=\"jump\""},
    {", contacts = 9", "", "stage.1.stop.contacts=9"},
    {"corner_radius = [5.0, 5.0]", "corner_radius = 1.0", "wall.plateau.corner_radius=[5.0, 5.0]"},
    {"component = \"utilisation\"", "component = \"max-stress\"", "monitor.2.component=\"utilisation\""},
    {"component = \"contact-start\"", "component = \"contact-end\"", "monitor.first.component=\"contact-start\""}};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace

TEST(KeysThatAreSet, AreThoseOfTheDeck) {
  const TracedDeck given(strip);
  const std::string rows = path_csv(given.record(), UnitLabels::shown);
  const auto events = events_json(given.record());
  for (const Key& key : keys) {
    SCOPED_TRACE(key.assignment);
    const TracedDeck set(replaced(strip, key.written, key.before), {key.assignment});
    EXPECT_EQ(path_csv(set.record(), UnitLabels::shown), rows);
    EXPECT_EQ(events_json(set.record()), events);
  }
}

TEST(KeysThatAreSet, MakeARunThatIsVerified) {
  const TracedDeck run(strip);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop) << run.record().branches.back().end->detail;
  EXPECT_GT(run.record().points.back().contacts, 0);
  EXPECT_FALSE(test::events_of(run, EventKind::value_crossing).empty());
  test::expect_whole(run);
}

}  // namespace arcwall::keys_that_are_set_test
