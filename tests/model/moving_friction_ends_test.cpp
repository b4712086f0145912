#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "model/dissipation.hpp"
#include "tests/model/friction_decks.hpp"

// Friction at free ends of members and at the edges of flat contact zones, beside contact points that move. References
// by shooting with steps of order 8.
namespace arcwall::friction_test {

namespace {

const std::string moving = "[contact]\npoints = \"moving\"\n";

// A strip bent to a circle of radius 1, which a clamp at 60° points down to a floor; the clamp goes down by λ. The tip
// slides until it is tangent; from there on contact moves inside.
std::string bent_strip(double friction, const std::string& stages) {
  std::string text = strip(friction, stages);
  const auto replace = [&](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("clamp = [0.0, 0.8660254037844386]\ntip = [0.5, 0.0]",
          "clamp = [0.0, 0.49888640232521775]\ntip = [0.8188453735832679, 0.0]");
  replace("to = \"tip\"", "to = \"tip\"\nvia = [0.345729380571248, 0.14490042572575468]");
  return text + moving;
}

// The column between rough walls and its mirror image beside it, which has the same loads.
std::string twin_columns(double friction, std::string stages) {
  std::string text = column(friction, "",
                            "[member.image]\nfrom = \"far\"\nto = \"near\"\ntheory = \"elastica\"\nmaterial = \"m\"\n"
                            "section = \"s\"\nelements = 20\n"
                            "imperfection = [{ shape = \"sine\", amplitude = 1e-9, waves = 1 }]\n"
                            "[[load]]\nat = \"far\"\nforce = [1.0, 0.0]\n"
                            "[[monitor]]\nname = \"image\"\nat = \"far\"\ncomponent = \"x\"\n");
  const auto insert = [](std::string& to, const std::string& behind, const std::string& what) {
    for (std::size_t at = to.find(behind); at != std::string::npos; at = to.find(behind, at + what.size())) {
      at += behind.size();
      to.insert(at, what);
    }
  };
  insert(text, "[point]\n", "near = [-0.5, 0.0]\nfar = [-2.5, 0.0]\n");
  insert(text, "[support]\n", "near = [\"x\", \"z\"]\nfar = [\"z\"]\n");
  insert(stages, "drives = [\"load.0\"", ", \"load.1\"");
  return text + stages;
}

}  // namespace

TEST(MovingFrictionEnds, DraggedTipSlipsSticksAndSlipsBack) {
  const std::string text =
      strip(0.3,
            stage("press", "prescribed.0", 0.0005, -1.0, 0.4) + stage("drag", "prescribed.1", 0.01, -1.0, 0.1) +
                stage("back", "prescribed.1", -0.001, -0.2, 1.0),
            "[[prescribed]]\nat = \"clamp\"\nx = 1.0\n") +
      moving;
  const Session session = run_of(text);
  EXPECT_EQ(reason(session), EndReason::stop);
  expect_law(session);
  const RecordPoint& pressed = point_at(session, 0, 0.4);
  EXPECT_NEAR(pressed.monitors[0], 0.848318084440 - 0.5, 1e-7);
  EXPECT_NEAR(pressed.monitors[2], 2.043932631876, 1e-6);
  EXPECT_NEAR(pressed.monitors[1], -0.6131797895628, 1e-6);
  const auto slips = lambdas(session, EventKind::contact_slips, 2);
  ASSERT_EQ(slips.size(), 1U);
  EXPECT_NEAR(slips[0], -0.00245442295107, 1e-8);
  EXPECT_NEAR(monitor_at_end(session, 2), 1.597276181152, 1e-6);
  EXPECT_NEAR(monitor_at_end(session, 1), 0.479182854346, 1e-6);
  for (const std::size_t killed : {std::size_t{5}, session.points().size() / 2, session.points().size() - 3})
    expect_resumed(text, session, killed);
}

TEST(MovingFrictionEnds, PressedTipSticksBucklesAndSlips) {
  const Session session = run_of(strip(0.8, stage("press", "prescribed.0", 0.0005, -1.0, 0.08)) + moving);
  expect_law(session);
  const auto slips = lambdas(session, EventKind::contact_slips, 0),
             turns = lambdas(session, EventKind::contact_limit_point, 0),
             smooth = lambdas(session, EventKind::limit_point, 0);
  ASSERT_EQ(slips.size(), 1U);
  EXPECT_NEAR(slips[0], 0.0723106541656, 1e-7);
  ASSERT_EQ(turns.size(), 1U);
  ASSERT_EQ(smooth.size(), 1U);
  EXPECT_NEAR(smooth[0], 0.06692724, 1e-6);
}

// The strip comes down steeper than upright and turns back while its tip slips, which changes the sense in which its
// coordinate runs along the floor but not what is lost.
TEST(MovingFrictionEnds, TipThatTurnsPastUprightLosesTheSame) {
  std::string text = strip(0.1, stage("press", "prescribed.0", 0.005, -1.0, 0.3));
  const auto replace = [&](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("clamp = [0.0, 0.8660254037844386]\ntip = [0.5, 0.0]",
          "clamp = [0.0, 0.8521838639381606]\ntip = [0.5232424505364857, 0.0]");
  replace("to = \"tip\"", "to = \"tip\"\nvia = [0.3884674796183538, 0.5039757640576243]");
  replace("z = 0.0 }", "z = -0.09538309169853121 }");
  const double at_nodes = total_dissipation(run_of(text).points().back());
  EXPECT_GT(at_nodes, 0.02);
  EXPECT_NEAR(total_dissipation(run_of(text + moving).points().back()), at_nodes, 1e-9);
}

// The slip goes on as contact moves inside; turned, the point rolls before it slips back.
TEST(MovingFrictionEnds, ContactMovesInsideFromATip) {
  const Session session = run_of(bent_strip(
      0.3, stage("press", "prescribed.0", 0.0005, -1.0, 0.2) + stage("lift", "prescribed.0", -0.001, -0.1, 1.0)));
  expect_law(session);
  const auto inside = lambdas(session, EventKind::contact_transfers, 0);
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_NEAR(inside[0], 0.02720047487, 1e-7);
  const RecordPoint& pressed = point_at(session, 0, 0.2);
  ASSERT_EQ(pressed.forces.size(), 1U);
  EXPECT_NEAR(pressed.forces[0].force, 1.7608939598, 1e-5);
  EXPECT_NEAR(pressed.forces[0].label.fraction, 0.69114965928, 1e-6);
  EXPECT_EQ(pressed.forces[0].friction->mode, ContactMode::slips_forward);
  const auto slips = lambdas(session, EventKind::contact_slips, 1);
  ASSERT_EQ(slips.size(), 1U);
  EXPECT_NEAR(0.2 + slips[0], 0.1970972067, 1e-9);
}

// Where the bending moment at its contact vanishes, the column between rough walls lies on one of them: flush, without
// pressure, with a force and its friction at each edge. Both slip.
TEST(MovingFrictionEnds, ColumnSlipsOnTheEdgesOfItsZone) {
  const Session session =
      run_of(column(0.2, stage("on", "load.0", 0.05, -1.0, 2.2) + "[path]\noutput_at = { lambda = [1.9] }\n"));
  expect_law(session);
  EXPECT_EQ(reason(session), EndReason::stop);
  const auto spreads = lambdas(session, EventKind::contact_spreads, 0);
  ASSERT_EQ(spreads.size(), 1U);
  EXPECT_NEAR(spreads[0], 1.780749199922, 1e-6);
  const RecordPoint& there = point_at(session, 0, 1.9);
  ASSERT_EQ(there.forces.size(), 2U);
  EXPECT_NEAR(there.forces[0].force, 0.27909030262, 1e-6);
  EXPECT_NEAR(there.forces[1].force, 0.30766630771, 1e-6);
  EXPECT_NEAR(2.0 * there.forces[0].label.fraction, 0.98405363961, 1e-5);
  EXPECT_NEAR(2.0 * there.forces[1].label.fraction, 1.04684854548, 1e-5);
  EXPECT_NEAR(there.monitors[0], 0.05332340099, 1e-6);
  for (const RecordForce& edge : there.forces) EXPECT_EQ(edge.friction->mode, ContactMode::slips_forward);
  EXPECT_NEAR(point_at(session, 0, 2.2).monitors[0], 0.05888030620, 1e-6);
}

// Turned at 1.9 both edges stick; the left one slips on at 1.78496, the right one slips back, and where the left one
// has come to its other bound, too, the zone gathers: at the thrust that its other end had where it spread.
TEST(MovingFrictionEnds, EdgesGatherAgain) {
  const std::string text =
      column(0.2, stage("on", "load.0", 0.05, -1.0, 1.9) + stage("back", "load.0", -0.02, -0.3, 5.0));
  const Session session = run_of(text);
  expect_law(session);
  EXPECT_EQ(reason(session), EndReason::stop);
  const auto slips = lambdas(session, EventKind::contact_slips, 1),
             shrinks = lambdas(session, EventKind::contact_shrinks, 1);
  ASSERT_EQ(slips.size(), 2U);
  EXPECT_NEAR(1.9 + slips[0], 1.784961, 5e-6);
  ASSERT_EQ(shrinks.size(), 1U);
  EXPECT_NEAR(1.9 + shrinks[0], 1.6743009425, 1e-7);
  for (const std::size_t killed : {session.points().size() - 12, session.points().size() - 4})
    expect_resumed(text, session, killed);
}

// A zone gathers before its length is 0, and so much sooner as elements are longer. What is lost until behind that does
// not depend on it.
TEST(MovingFrictionEnds, GatheringLosesTheSameOnAnyMesh) {
  const auto lost = [](int elements) {
    std::string text = column(0.2, stage("on", "load.0", 0.05, -1.0, 1.9) + "max_step = 0.01\n" +
                                       stage("back", "load.0", -0.02, -0.3, 5.0) + "max_step = 0.01\n");
    text.replace(text.find("elements = 20"), 13, fmt::format("elements = {}", elements));
    const Session run = run_of(text);
    EXPECT_EQ(reason(run), EndReason::stop) << elements;
    EXPECT_FALSE(lambdas(run, EventKind::contact_shrinks, 1).empty()) << elements;
    return lost_until(run.points().back());
  };
  EXPECT_GT(lost(20), 1e-4);
  EXPECT_NEAR(lost(20), lost(80), 1e-8);
}

// Two zones that are mirror images slip in opposite senses and gather together, whatever their edges do there: both
// slip if the load has gone to 1.9, one sticks if it turns sooner.
TEST(MovingFrictionEnds, MirrorImagesGatherAlike) {
  for (const double most : {1.9, 1.79, 1.782}) {
    SCOPED_TRACE(most);
    const std::string stages = stage("on", "load.0", 0.05, -1.0, most) + stage("back", "load.0", -0.02, -0.3, 5.0);
    const Session both = run_of(twin_columns(0.2, stages)), one = run_of(column(0.2, stages));
    expect_law(both);
    EXPECT_EQ(reason(both), EndReason::stop);
    EXPECT_FALSE(lambdas(one, EventKind::contact_spreads, 0).empty());
    // A zone of a load of 1.782 is so short that it gathers where the stage begins.
    EXPECT_TRUE(most < 1.785 || !lambdas(one, EventKind::contact_shrinks, 1).empty());
    for (const EventKind kind : {EventKind::contact_spreads, EventKind::contact_shrinks, EventKind::contact_slips})
      for (const Index branch : {0, 1}) {
        const auto found = lambdas(both, kind, branch), expected = lambdas(one, kind, branch);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-8);
      }
    for (const RecordPoint& point : both.points()) EXPECT_NEAR(point.monitors[0], point.monitors[2], 1e-9);
    // Steps differ, and with them the error of the quadrature.
    EXPECT_NEAR(lost_until(both.points().back()), 2.0 * lost_until(one.points().back()), 1e-7);
  }
}

// A straight strip that comes down flat on a table whose edge is below its middle: without pressure no edge of the zone
// says where it ends.
TEST(MovingFrictionEnds, AStripThatTouchesAllAlongAPartIsNotModelled) {
  const auto lowered = [](int elements, double edge, const std::string& drive, const std::string& motion) {
    return material("m", 1e4) + rectangle("s", 0.1, 0.05) + points({{"a", 0.0, 0.0}, {"b", -1.0, 0.0}}) +
           member("m", "a", "b", "elastica", elements) + supports({{"a", "x z rotation"}}) + moving + drive +
           wall("table", fmt::format("outline = {{ type = \"polyline\", points = [[-3.0, -0.05], [{}, -0.05]] }}; {}{}",
                                     edge, rough(0.3), motion)) +
           path("step = 0.02; stop = { lambda = [-1.0, 0.06] }");
  };
  const std::string clamp = prescribed("a", "z = -1.0");
  for (const std::string& deck :
       {lowered(6, -0.5, clamp, ""), lowered(8, -0.6, clamp, ""), lowered(8, -0.6, "", "; motion = { z = 1.0 }")}) {
    const Session run = run_of(deck);
    EXPECT_EQ(reason(run), EndReason::not_modelled);
    EXPECT_NEAR(run.points().back().lambda, 0.05, 1e-12);
  }
}

}  // namespace arcwall::friction_test
