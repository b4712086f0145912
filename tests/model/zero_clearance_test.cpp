// Members between walls without clearance: two straight walls that touch an axis from both sides hold it without a
// force. The references are closed forms of the extensible elastica, straight under P = λ with the stretch 1 − P/EA.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "core/derivative_check.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/deck/reader.hpp"
#include "model/model.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::zero_clearance_test {
namespace {

// A pinned column of EI = 2.1875e7 and EA = 1.05e7 between two walls at the distance GAP from its axis.
constexpr const char* column = R"toml(
title = "A column between walls"
units = { length = "mm", force = "N" }
material.steel = { E = 2.1e5 }
section.col = { shape = "rectangle", width = 10.0, height = 5.0 }
point = { a = [0.0, 0.0], b = [1000.0, 0.0] }
support = { a = ["x", "z"], b = ["z"] }
member.col = { from = "a", to = "b", theory = "euler-bernoulli", material = "steel", section = "col", elements = 40 }
load = [{ at = "b", force = [-1.0, 0.0] }]
wall = [
  { name = "under", side = "below", contact_surface = "axis", profile = { type = "flat", z = 0.0 } },
  { name = "over", side = "above", contact_surface = "axis", profile = { type = "flat", z = 0.0 } },
]
monitor = [{ name = "mid", at = "col:0.5", component = "z" }, { name = "off", at = "col:0.4", component = "z" }]
path = { step = 50.0, stop = { lambda = [-10.0, 6000.0] } }
)toml";

constexpr double EI = 2.1875e7, EA = 1.05e7, length = 1000.0;
const double euler = pi * pi * EI / (length * length);

Session traced(const std::vector<std::string>& assignments = {}) { return test::traced(column, assignments); }

std::vector<RecordEvent> events(const Session& run, EventKind kind) { return test::events_of(run.record(), kind); }

std::string problem_of(const std::vector<std::string>& assignments) {
  try {
    const Session run = make_session({.deck = "deck.toml", .deck_text = column, .assignments = assignments});
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

std::string clearance(double gap) {
  const std::string wall = "contact_surface = \"axis\", profile = { type = \"flat\", z = ";
  return "wall = [{ name = \"under\", side = \"below\", " + wall + round_trip(-gap) +
         " } }, { name = \"over\", side = \"above\", " + wall + round_trip(gap) + " } }]";
}

// The load at which m half waves are neutral on a foundation k on both sides: EI q² − s P q + s² k = 0 with
// q = (mπ/L)² and the stretch s = 1 − P/EA.
double load_on_foundation(double k, int m) {
  const double q = std::pow(m * pi / length, 2);
  const auto unbalanced = [&](double P) {
    const double s = 1.0 - P / EA;
    return EI * q * q - s * P * q + s * s * k;
  };
  double low = 0.0, high = 0.1 * EA;
  for (int i = 0; i < 200; ++i) (unbalanced(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  return low;
}

int first_half_waves_on_foundation(double k) {
  int first = 1;
  while (load_on_foundation(k, first + 1) < load_on_foundation(k, first)) ++first;
  return first;
}

double first_load_on_foundation(double k) { return load_on_foundation(k, first_half_waves_on_foundation(k)); }

}  // namespace

// It cannot leave its line at any load: no branch point, and both walls touch every node that is free across them.
TEST(ZeroClearance, RigidWallsHoldAColumnStraightForEver) {
  for (const std::string theory : {"euler-bernoulli", "elastica", "reissner"})
    for (const std::string law : {"contact = {}", "contact = { method = \"augmented\", penalty = 10.0 }"}) {
      SCOPED_TRACE(theory + " " + law);
      const std::string shear = "material.steel.nu = 0.3";
      const Session run = traced({"member.col.theory = \"" + theory + "\"", law, shear});
      ASSERT_EQ(run.record().branches.size(), 1U);
      EXPECT_EQ(run.record().branches[0].end->reason, EndReason::stop);
      ASSERT_EQ(run.events().size(), 2U);
      EXPECT_EQ(run.events()[0].kind, EventKind::start);
      EXPECT_EQ(run.events()[1].kind, EventKind::end);
      EXPECT_NEAR(run.points().back().lambda, 6000.0, 1e-9);
      for (const RecordPoint& point : run.points()) {
        EXPECT_EQ(point.count.unstable, Index{0});
        EXPECT_EQ(point.count.stability, Stability::stable);
        EXPECT_EQ(point.contacts, 2 * 39);
        ASSERT_EQ(point.forces.size(), 2U * 39U);
        for (const RecordForce& contact : point.forces) EXPECT_LE(std::abs(contact.force), 1e-8);
        EXPECT_LE(std::abs(point.monitors[1]), 1e-12);
      }
    }
}

// However coarse the mesh: not between nodes either, where an element's own buckling load is passed.
TEST(ZeroClearance, ElementsBetweenRigidWallsDoNotBuckle) {
  for (const std::string theory : {"euler-bernoulli", "elastica"})
    for (const int elements : {1, 2, 8}) {
      SCOPED_TRACE(theory + " " + std::to_string(elements));
      const Session run = traced(
          {"member.col.theory = \"" + theory + "\"", "member.col.elements = " + std::to_string(elements),
           "path.stop.lambda = [-10.0, 60000.0]", "monitor = [{ name = \"x\", at = \"b\", component = \"x\" }]"});
      EXPECT_EQ(run.record().branches[0].end->reason, EndReason::stop);
      EXPECT_EQ(run.events().size(), 2U);
      for (const RecordPoint& point : run.points()) EXPECT_EQ(point.count.unstable, Index{0});
    }
}

// A load across is borne by the wall that it presses on.
TEST(ZeroClearance, TheWallThatIsPressedBearsTheLoad) {
  const Session run = traced(
      {"load = [{ on = \"col\", distributed = [0.0, -1.0] }]", "path.step = 0.1", "path.stop.lambda = [-1.0, 1.0]"});
  EXPECT_EQ(run.events().size(), 2U);
  const auto borne = [](const RecordPoint& point, const std::string& wall) {
    double sum = 0.0;
    for (const RecordForce& contact : point.forces)
      if (contact.label.wall == wall) sum += contact.force;
    return sum;
  };
  // Of the 25 N of each element every end has a half; those of the column are held by its supports.
  EXPECT_NEAR(borne(run.points().back(), "under"), 1000.0 - 25.0, 1e-6);
  EXPECT_EQ(borne(run.points().back(), "over"), 0.0);
  const Session up = traced(
      {"load = [{ on = \"col\", distributed = [0.0, 1.0] }]", "path.step = 0.1", "path.stop.lambda = [-1.0, 1.0]"});
  EXPECT_EQ(borne(up.points().back(), "under"), 0.0);
  EXPECT_NEAR(borne(up.points().back(), "over"), borne(run.points().back(), "under"), 1e-9);
}

// Away from rest, with forces of either sign, on sloped walls; round-off times the ratio of stiffnesses as elsewhere.
TEST(ZeroClearance, DerivativesAreConsistentWithEveryLaw) {
  const std::string sloped =
      "wall = [{ name = \"under\", side = \"below\", contact_surface = \"axis\", profile = { type = \"line\", z = 0.0, "
      "slope = "
      "0.1 } "
      "}, { name = \"over\", side = \"above\", contact_surface = \"axis\", profile = { type = \"line\", z = 0.0, slope "
      "= 0.1 } "
      "}]";
  for (const std::string law : {"contact = {}", "contact = { method = \"augmented\", penalty = 10.0 }",
                                "contact = { method = \"penalty\", penalty = 10.0 }"}) {
    SCOPED_TRACE(law);
    const Model model(deck::read_deck_text(column, "deck.toml", {law, sloped, "point.b = [1000.0, 100.0]"}));
    std::string reason;
    State state = *model.start(reason);
    EXPECT_EQ(state.active_set.closed_count(), 2 * 40);
    EXPECT_EQ(model.system().multiplier_count(state.active_set), 40);
    for (Index i = 0; i < state.x.size(); ++i) state.x[i] = 0.01 * std::sin(1.0 + 7.0 * double(i));
    state.lambda = 3.0;
    EXPECT_LE(check_derivatives(model.system(), state).worst(), 1e-7);
  }
}

// Walls that are springs are a foundation that holds in both senses.
TEST(ZeroClearance, SpringsOnBothSidesAreAFoundation) {
  for (const std::string theory : {"euler-bernoulli", "elastica"})
    for (const double k : {0.002, 0.2, 1.0}) {
      SCOPED_TRACE(theory + " " + round_trip(k));
      const double load = first_load_on_foundation(k);
      const Session run =
          traced({"member.col.theory = \"" + theory + "\"",
                  "contact = { method = \"penalty\", penalty = " + round_trip(k) + " }",
                  "path.stop.lambda = [-10.0, " + round_trip(1.01 * load) + "]", "path.branches = \"primary\""});
      const auto found = events(run, EventKind::branch_point);
      ASSERT_FALSE(found.empty());
      const double phase = first_half_waves_on_foundation(k) * pi / 40.0;  // of an element
      EXPECT_NEAR(found[0].lambda, load, std::pow(phase, 4) / 360.0 * load);
      EXPECT_FALSE(found[0].mesh_artefact);
      EXPECT_EQ(found[0].unstable_before, Index{0});
      EXPECT_EQ(found[0].unstable_after, Index{1});
      EXPECT_TRUE(events(run, EventKind::contact_closes).empty());
    }
}

// Walls that are nearer to each other than round-off, or overlap by it, leave no clearance either.
TEST(ZeroClearance, RoundOffIsNoClearance) {
  const double load = first_load_on_foundation(0.2);
  for (const double gap : {1e-10, -1e-10})
    for (const bool rigid : {true, false}) {
      SCOPED_TRACE(round_trip(gap));
      const Session run =
          traced({clearance(gap), rigid ? "contact = {}" : "contact = { method = \"penalty\", penalty = 0.2 }",
                  "path.branches = \"primary\"", "path.stop.lambda = [-10.0, " + round_trip(1.01 * load) + "]"});
      const auto found = events(run, EventKind::branch_point);
      ASSERT_EQ(found.empty(), rigid);
      for (const RecordEvent& event : found) EXPECT_NEAR(event.lambda, load, 1e-3 * load);
    }
}

// The way that leaves the straight one is followed.
TEST(ZeroClearance, BucklesOnSpringsAndIsFollowed) {
  const Session run = traced({"contact = { method = \"penalty\", penalty = 0.2 }", "path.stop.off = [-5.0, 5.0]"});
  ASSERT_GE(run.record().branches.size(), 2U);
  EXPECT_EQ(run.record().branches[0].end->reason, EndReason::switched_branch);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
}

// --- nearly none ----------------------------------------------------------------------------------------------------

// The straight column is neutral to m half waves at P (1 − P/EA) = m² EI π²/L².
double euler_load(int m) { return 0.5 * EA * (1.0 - std::sqrt(1.0 - 4.0 * m * m * euler / EA)); }

// In the limit of no clearance the column leaves the straight line at its Euler load and touches at once; at 4 times
// that the point of contact spreads, and at 16 times the flat part buckles (Link 1954; closed forms of the linear
// theory).
TEST(NearlyZeroClearance, ThePitchforkIsLeftHoweverShortItsBranchSlow) {
  for (const std::string theory : {"euler-bernoulli", "elastica"})
    for (const double gap : {1e-2, 3e-3, 1e-3}) {
      SCOPED_TRACE(theory + " " + round_trip(gap));
      const Session run =
          traced({"member.col.theory = \"" + theory + "\"", clearance(gap), "path.stop.lambda = [-10.0, 3400.0]"});
      const double error = theory == "euler-bernoulli" ? 4e-6 : 1e-8;
      ASSERT_EQ(run.record().branches.size(), 2U);
      EXPECT_EQ(run.record().branches[0].end->reason, EndReason::switched_branch);
      EXPECT_EQ(run.record().branches[1].end->reason, EndReason::stop);
      const auto leaves = events(run, EventKind::branch_point), closes = events(run, EventKind::contact_closes),
                 spreads = events(run, EventKind::contact_spreads);
      ASSERT_EQ(leaves.size(), 1U);
      ASSERT_EQ(closes.size(), 1U);
      ASSERT_EQ(spreads.size(), 1U);
      EXPECT_NEAR(leaves[0].lambda, euler_load(1), error * euler);
      EXPECT_NEAR(closes[0].lambda, euler_load(1), error * euler);
      EXPECT_NEAR(spreads[0].lambda, euler_load(2), 4.0 * error * euler);
      EXPECT_NEAR(std::abs(run.points().back().monitors[0]), gap, 1e-9 * gap);
      for (const RecordPoint& point : run.points())  // undecided where the wall has hardly a force yet
        EXPECT_TRUE(point.branch == 0 || point.count.stability != Stability::unstable);
    }
}

// The greatest load of a column between springs is that of the foundation without clearance, less a part that goes with
// the clearance to the power of 2/3, as with any small deviation from a pitchfork that is unstable (Koiter 1945).
TEST(NearlyZeroClearance, SpringsTendToTheFoundation) {
  const double load = first_load_on_foundation(0.2);
  std::vector<double> lack;
  for (const double gap : {0.01, 0.001}) {
    SCOPED_TRACE(gap);
    const Session run =
        traced({clearance(gap), "contact = { method = \"penalty\", penalty = 0.2 }", "path.stop.off = [-20.0, 20.0]"});
    ASSERT_EQ(run.record().branches.size(), 2U);
    EXPECT_EQ(run.record().branches[0].end->reason, EndReason::switched_branch);
    EXPECT_EQ(run.record().branches[1].end->reason, EndReason::stop);
    const auto limits = events(run, EventKind::limit_point);
    ASSERT_FALSE(limits.empty());
    lack.push_back(load - limits.back().lambda);
    EXPECT_GT(lack.back(), 0.0);
    EXPECT_LT(lack.back(), 2e-3 * load);
  }
  EXPECT_NEAR(lack[0] / lack[1], std::pow(10.0, 2.0 / 3.0), 0.15);
}

// With an imperfection the path has no pitchfork; many contacts close and open nearly at once.
TEST(NearlyZeroClearance, AnImperfectColumnBetweenSpringsIsFollowedOnEveryMeshSlow) {
  for (const int elements : {40, 50, 80}) {
    SCOPED_TRACE(elements);
    const Session run = traced({clearance(0.01), "contact = { method = \"penalty\", penalty = 0.2 }",
                                "member.col.elements = " + std::to_string(elements),
                                "member.col.imperfection = { shape = \"sine\", amplitude = 0.001, waves = 1 }",
                                "path.stop.off = [-20.0, 20.0]"});
    EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
    const auto limits = events(run, EventKind::limit_point);
    ASSERT_FALSE(limits.empty());
    EXPECT_NEAR(limits.back().lambda, first_load_on_foundation(0.2), 2e-3 * first_load_on_foundation(0.2));
  }
}

// --- what is not modelled -------------------------------------------------------------------------------------------

// What would not be answered rightly is refused with the walls and what to do.
TEST(ZeroClearance, IsRefusedWhereItIsNotModelled) {
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(problem_of({"contact.points = \"moving\""}), "use \"nodes\", or leave a clearance");
  has(problem_of({"path.method = \"incremental\"", "path.output_at = { lambda = [1.0] }", "path.stop = {}"}),
      "use \"spherical\", or leave a clearance");
  const std::string faces =
      problem_of({"wall = [{ name = \"under\", side = \"below\", profile = { type = \"flat\", z = -2.5 } }, { name = "
                  "\"over\", side = "
                  "\"above\", profile = { type = \"flat\", z = 2.5 } }]"});
  has(faces, "touches walls \"under\" and \"over\" from both sides at the start");
  has(faces, "put both walls at the axis, with contact_surface = \"axis\", or leave a clearance");
  const std::string stops = problem_of(
      {"contact.points = \"nodes\"",
       "wall = [{ name = \"under\", side = \"below\", contact_surface = \"axis\", profile = { type = \"circle\", "
       "centre = [500.0, "
       "-20.0], radius = 20.0 } }, { name = \"over\", side = \"above\", contact_surface = \"axis\", profile = { "
       "type = \"circle\", "
       "centre = [500.0, 20.0], radius = 20.0 } }]"});
  has(stops, "touches walls \"under\" and \"over\" from both sides at the start, at col:0.5");
  has(stops, "leave a clearance");
  const auto moving = [](const std::string& under, const std::string& over) {
    return problem_of(
        {"wall = [{ name = \"under\", side = \"below\", contact_surface = \"axis\", profile = { type = \"flat\", z = "
         "0.0 }" +
         under +
         " }, { name = \"over\", side = \"above\", contact_surface = \"axis\", profile = { type = \"flat\", z = 0.0 }" +
         over + " }]"});
  };
  const std::string turn = ", motion = { rotation = 0.1 }";
  for (const std::string& problem : {moving("", ", motion = { z = 1.0 }"), moving(turn, turn)}) {
    has(problem, "only where they move together");
    has(problem, "give both walls the same motion, without a rotation, or leave a clearance");
  }
}

}  // namespace arcwall::zero_clearance_test
