// Stops without clearance: two smooth ones that touch each other across a member hold the place of its axis and the
// direction there, two sharp corners the place alone, and both let it slide through. The references are closed forms of
// the extensible elastica.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/derivative_check.hpp"
#include "core/text.hpp"
#include "model/deck/reader.hpp"
#include "model/model.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::pinches_test {
namespace {

using test::traced;

constexpr double EA = 1e5, radius = 0.02;

enum class Stops { pegs, wedges, flat_wedges };

// Round ones, and wedges whose flanks are at atan 2 or atan 0.2 against the axis; `up`: the stop is above the axis.
std::string outline(Stops stops, double at, bool up) {
  const double sign = up ? 1.0 : -1.0, height = sign * (stops == Stops::wedges ? 0.2 : 0.02);
  if (stops == Stops::pegs)
    return fmt::format(R"({{ type = "circle", centre = [{}, {}], radius = {} }})", at, sign * radius, radius);
  return fmt::format(R"({{ type = "polyline", x = [{}, {}, {}], z = [{}, 0.0, {}] }})", at + 0.1 * sign, at,
                     at - 0.1 * sign, height, height);
}

// A pinned column of EI = 1, EA = 1e5 and length 1, with two stops that touch each other on its axis.
std::string column(double at, const std::string& path, Stops stops = Stops::pegs) {
  const auto stop = [&](const std::string& name, bool up) {
    return "{ name = \"" + name + "\", contact_surface = \"axis\", outline = " + outline(stops, at, up) + " }";
  };
  return std::string(R"toml(
title = "A column between pegs"
units = { length = "m", force = "N" }
material.m = { E = 1.0, nu = 0.3 }
section.s = { shape = "general", A = 100000.0, I = 1.0 }
point = { A = [0.0, 0.0], B = [1.0, 0.0] }
support = { A = ["x", "z"], B = ["z"] }
member.column = { from = "A", to = "B", theory = "elastica", elements = 48, material = "m", section = "s" }
load = [{ at = "B", force = [-1.0, 0.0] }]
monitor = [
  { name = "off", at = "column:0.6875", component = "z" },
  { name = "short", at = "B", component = "x", sign = -1 },
  { name = "above", wall = "over", component = "force-z" },
  { name = "below", wall = "under", component = "force-z" },
]
)toml") + "wall = [" +
         stop("over", true) + ", " + stop("under", false) + "]\n" + path + "\n";
}

// The load at which a column, pinned at its ends and clamped at the fraction `at` of its span where it slides through,
// is neutral first: its longer part has tan z = z, z² = P (1 − P/EA) l²/EI with the part's stress-free length
// l = span/(1 − P/EA), the span of the part at the held end that of rest; that of the other is shortened.
double first_load(double at) {
  const double z = 4.493409457909064;
  const double held = z * z / (at * at);  // P/(1 − P/EA)
  const double of_held = held / (1.0 + held / EA);
  const double l = 1.0 - at;  // stress-free: (1 − at) is the span at rest, and what slides in is at P/(EA − P)
  const auto unbalanced = [&](double P) {
    const double rest = l - at * P / (EA - P);
    return P * (1.0 - P / EA) * rest * rest - z * z;
  };
  double low = 0.0, high = 0.01 * EA;
  for (int i = 0; i < 200; ++i) (unbalanced(0.5 * (low + high)) > 0.0 ? high : low) = 0.5 * (low + high);
  return std::min(of_held, low);
}

// The load at which a pinned column that slides through a hinge at the fraction `at` of its span is neutral first: both
// parts, whose stress-free lengths l are those of first_load(), turn there by M (1 − k l cot k l)/(P l) under a moment.
double first_load_on_knife_edges(double at) {
  const auto unbalanced = [&](double P) {
    const double k = std::sqrt(P * (1.0 - P / EA)), held = at / (1.0 - P / EA), other = 1.0 - held;
    const auto turn = [&](double l) { return std::sin(k * l) - k * l * std::cos(k * l); };
    return other * std::sin(k * other) * turn(held) + held * std::sin(k * held) * turn(other);
  };
  double low = 0.1, high = 0.1;
  while (unbalanced(high += 0.1) > 0.0) low = high;
  for (int i = 0; i < 100; ++i) (unbalanced(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  return low;
}

const RecordEvent* first_branch_point(const Session& run) {
  for (const RecordEvent& event : run.events())
    if (event.kind == EventKind::branch_point) return &event;
  return nullptr;
}

}  // namespace

// Pegs hold the slope, too: 4 z² EI/L² with z = tan z where they stand in the middle, less what the column shortens.
TEST(Pinches, PegsHoldTheSlope) {
  for (const std::string theory : {"euler-bernoulli", "elastica"})
    for (const double at : {0.5, 0.4}) {
      SCOPED_TRACE(theory + " " + round_trip(at));
      const double load = first_load(at);
      const Session run = traced(column(at, "path = { step = 5.0, branches = \"primary\", stop = { lambda = [-1.0, " +
                                                round_trip(1.01 * load) + "] } }"),
                                 {"member.column.theory = \"" + theory + "\""});
      EXPECT_EQ(run.record().branches[0].end->reason, EndReason::stop);
      const RecordEvent* leaves = first_branch_point(run);
      ASSERT_NE(leaves, nullptr);
      EXPECT_NEAR(leaves->lambda, load, (theory == "euler-bernoulli" ? 1e-5 : 1e-8) * load);
      EXPECT_FALSE(leaves->mesh_artefact);
      EXPECT_EQ(leaves->unstable_before, Index{0});
      EXPECT_EQ(leaves->unstable_after, Index{1});
      for (const RecordPoint& point : run.points()) EXPECT_EQ(point.contacts, 2);
    }
}

// Four pegs, two at each third: the part at the held end, which is as long as they are apart, is neutral first, at
// 9 z² EI/L², less what the column shortens.
TEST(Pinches, FourPegsHoldAColumnAtItsThirds) {
  const double z = 4.493409457909064, held = 9.0 * z * z, load = held / (1.0 + held / EA);
  for (const std::string theory : {"euler-bernoulli", "elastica"}) {
    SCOPED_TRACE(theory);
    std::string deck = column(1.0 / 3.0, "path = { step = 5.0, branches = \"primary\", stop = { lambda = [-1.0, " +
                                             round_trip(1.01 * load) + "] } }");
    std::string second = deck.substr(deck.find("wall = [") + 8, deck.find("]\npath") - deck.find("wall = [") - 8);
    for (std::size_t at; (at = second.find(round_trip(1.0 / 3.0))) != std::string::npos;)
      second.replace(at, round_trip(1.0 / 3.0).size(), "0.6666666666666667");
    second.replace(second.find("over"), 4, "over2");
    second.replace(second.find("under"), 5, "under2");
    deck.insert(deck.find("]\npath"), ", " + second);
    const Session run = traced(deck, {"member.column.theory = \"" + theory + "\""});
    EXPECT_EQ(run.record().branches[0].end->reason, EndReason::stop);
    const RecordEvent* leaves = first_branch_point(run);
    ASSERT_NE(leaves, nullptr);
    EXPECT_NEAR(leaves->lambda, load, (theory == "euler-bernoulli" ? 1e-4 : 1e-8) * load);
    EXPECT_EQ(leaves->unstable_before, Index{0});
    EXPECT_EQ(leaves->unstable_after, Index{1});
    for (const RecordPoint& point : run.points()) EXPECT_EQ(point.contacts, 4);
  }
}

// With one in the middle 4 π² EI/L², less what the column shortens.
TEST(Pinches, KnifeEdgesHoldThePlaceAlone) {
  EXPECT_NEAR(first_load_on_knife_edges(0.5), 39.49401537685698, 2e-5);  // P (1 − P/EA) = 4 π² but for (P/EA)²
  for (const std::string theory : {"euler-bernoulli", "elastica"})
    for (const double at : {0.5, 0.4}) {
      SCOPED_TRACE(theory + " " + round_trip(at));
      const double load = first_load_on_knife_edges(at);
      const Session run = traced(column(at,
                                        "path = { step = 5.0, branches = \"primary\", stop = { lambda = [-1.0, " +
                                            round_trip(1.01 * load) + "] } }",
                                        Stops::wedges),
                                 {"member.column.theory = \"" + theory + "\""});
      EXPECT_EQ(run.record().branches[0].end->reason, EndReason::stop);
      const RecordEvent* leaves = first_branch_point(run);
      ASSERT_NE(leaves, nullptr);
      EXPECT_NEAR(leaves->lambda, load, (theory == "euler-bernoulli" ? 1e-5 : 1e-8) * load);
      EXPECT_EQ(leaves->unstable_before, Index{0});
      EXPECT_EQ(leaves->unstable_after, Index{1});
      for (const RecordPoint& point : run.points()) EXPECT_EQ(point.contacts, 2);
    }
}

// Behind the branch point the member turns in the wedges until it comes to lie along a flank.
TEST(Pinches, KnifeEdgesLetTheMemberTurnBetweenTheirFlanks) {
  const Session run =
      traced(column(0.5, "path = { step = 5.0, max_step = 0.05, stop = { off = [-0.6, 0.6] } }", Stops::flat_wedges));
  ASSERT_EQ(run.record().branches.size(), 2U);
  const auto& end = *run.record().branches[1].end;
  EXPECT_EQ(end.reason, EndReason::not_modelled);
  EXPECT_NE(end.detail.find("over and under"), std::string::npos) << end.detail;
  const State& last = run.points().back().state;
  const SlidingContactLayout& on = sliding_layout(last.active_set);
  const auto [strand, position] = on.mesh().breakpoint(0);
  const MeshState now{.x = last.x.head(on.mesh().unknowns()), .s = last.x.tail(1), .lambda = last.lambda};
  EXPECT_NEAR(std::abs(on.mesh().node(strand, position, now).angle), std::atan(0.2), 1e-6);
}

// Of the equations with a pinch, in a bent state.
class PinchesOfBothKinds : public testing::TestWithParam<Stops> {};
INSTANTIATE_TEST_SUITE_P(, PinchesOfBothKinds, testing::Values(Stops::pegs, Stops::wedges));

TEST_P(PinchesOfBothKinds, DerivativesAreConsistent) {
  const Model model(deck::read_deck_text(
      column(0.4, "path = { step = 5.0, stop = { lambda = [-1.0, 1.0] } }", GetParam()), "deck.toml", {}));
  std::string reason;
  State state = *model.start(reason);
  EXPECT_TRUE(model.system().enforcement(state.active_set, 0).two_sided);
  EXPECT_EQ(state.active_set.closed_count(), 1);
  for (Index i = 0; i + 1 < state.x.size(); ++i) state.x[i] += 1e-3 * std::sin(1.0 + 7.0 * double(i));
  state.lambda = 3.0;
  EXPECT_LE(check_derivatives(model.system(), state).worst(), 1e-6);
}

// Off the straight way the moments on both sides differ, and with them the thrusts, as nothing but the energy says what
// slides through: λ is its rate by the way of the load. By the trapezoidal rule.
TEST_P(PinchesOfBothKinds, TheEnergyGrowsByTheWorkOfTheLoadAlone) {
  const Session run =
      traced(column(0.4, "path = { step = 5.0, max_step = 0.02, stop = { off = [-0.05, 0.05] } }", GetParam()));
  ASSERT_EQ(run.record().branches.size(), 2U);
  EXPECT_EQ(run.record().branches[1].end->reason, EndReason::stop);
  double work = 0.0, energy = 0.0;
  const RecordPoint* before = nullptr;
  for (const RecordPoint& point : run.points()) {
    if (point.branch != 1) continue;
    if (before != nullptr) work += 0.5 * (point.lambda + before->lambda) * (point.monitors[1] - before->monitors[1]);
    // The record's energy is the total potential: the load's work is taken back.
    const double stored = point.energy + point.lambda * point.monitors[1];
    if (before == nullptr) energy = stored;
    if (&point == &run.points().back()) energy = stored - energy;
    before = &point;
  }
  EXPECT_GT(work, 0.1);
  EXPECT_NEAR(energy, work, 1e-5 * work);
}

}  // namespace arcwall::pinches_test
