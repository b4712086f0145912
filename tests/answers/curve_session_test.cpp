// Curves of events that are stopped and taken up again, checked again, and run as cases of a sweep.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "answers/curve_session.hpp"
#include "answers/sessions.hpp"
#include "apps/output/curve_files.hpp"
#include "apps/verify/curve_checks.hpp"
#include "core/error.hpp"
#include "model/checkpoint/checkpoint_file.hpp"
#include "tests/apps/cli/program_fixture.hpp"
#include "tests/apps/deck_texts.hpp"

namespace arcwall::curve_session_test {
namespace {

namespace fs = std::filesystem;

const std::string truss = test::truss_on_spring + R"toml([curve]
event = { kind = "limit-point" }
parameter = "spring.0.stiffness.z"
range = [0.5, 12.0]
)toml";

// Contact that slides: an event's states have meshes of their own.
std::string channel(const std::string& kind, const std::string& over = "wall.upper.profile.z",
                    const std::string& range = "[0.19, 0.215]", int elements = 12) {
  return test::pressed_column_in_channel(elements,
                                         "jumps = false, stop = { lambda = [-1.0, 10.0], event = \"limit-point\" }") +
         fmt::format("[curve]\nevent = {{ kind = \"{}\" }}\nparameter = \"{}\"\nrange = {}\n", kind, over, range);
}

// Symmetric, so that its pitchfork persists.
const std::string column = test::straight_column(8) + R"toml([curve]
event = { kind = "branch-point" }
parameter = "point.B.0"
range = [1.9, 2.2]
)toml";

CurveSession session_of(const std::string& deck) { return CurveSession({.deck = "deck.toml", .deck_text = deck}); }

std::string csv_of(const CurveSession& session) { return curve_csv(session.tracing().curve(), UnitLabels::left_out); }

CurveSession traced(const std::string& deck) {
  CurveSession session = session_of(deck);
  while (session.tracing().advance()) {
  }
  EXPECT_EQ(session.tracing().curve().problem, "");
  return session;
}

verify::StoredCurve files_of(const CurveSession& session) {
  const RunDescription& of = session.description();
  const EventCurve curve = session.tracing().curve();
  return {.curve_csv = curve_csv(curve, of.units), .curve_json = curve_json(curve, of).dump()};
}

bool holds(const CurveSession& session, const verify::StoredCurve& files) {
  return !verify::verify_curve(session, files).findings.first();
}

class FollowedCurve : public testing::TestWithParam<std::string> {};

std::vector<std::string> curves() {
  return {truss, column, channel("contact-closes"), channel("contact-splits"), channel("limit-point")};
}

}  // namespace

// After each point of the path and of the curve the bytes of a checkpoint are read, and what goes on from there comes
// to the same bytes at the end as what was never stopped.
TEST_P(FollowedCurve, GoesOnFromACheckpointToTheSameLastBitSlow) {
  CurveSession whole = session_of(GetParam());
  std::vector<std::string> kept{whole.checkpoint()};
  while (whole.tracing().advance()) kept.push_back(whole.checkpoint());
  const std::string end = whole.checkpoint();
  ASSERT_EQ(whole.tracing().curve().problem, "");
  ASSERT_GT(kept.size(), 8U);
  for (std::size_t i = 0; i < kept.size(); i += 1 + kept.size() / 6) {
    CurveSession again = CurveSession::from(kept[i], "checkpoint", Session::Resume::go_on);
    while (again.tracing().advance()) {
    }
    EXPECT_EQ(csv_of(again), csv_of(whole)) << i;
    EXPECT_TRUE(again.checkpoint() == end) << i;
  }
}

// Each point is one of the deck with the number's value there, by formulas that tracing knows nothing of; runs of such
// decks meet the event at the same λ.
TEST_P(FollowedCurve, IsConfirmedByOtherFormulasSlow) {
  const CurveSession session = traced(GetParam());
  const verify::Verdict verdict = verify::verify_curve(session, files_of(session));
  EXPECT_FALSE(verdict.findings.first()) << to_text(*verdict.findings.first());
  const verify::Comparison runs = verify::compare_with_runs(session);
  EXPECT_TRUE(runs.differences.empty()) << runs.differences.front();
  EXPECT_GE(runs.same, 3);
  EXPECT_LE(runs.worst, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Kinds, FollowedCurve, testing::ValuesIn(curves()),
                         [](const auto& deck) { return "Deck" + std::to_string(deck.index); });

TEST(CurveSession, ThatIsStoppedSaysWhereAndGoesOn) {
  CurveSession session = session_of(truss);
  while (!session.tracing().has_begun()) ASSERT_TRUE(session.tracing().advance());
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(session.tracing().advance());
  const BranchEnd limit{.reason = EndReason::max_points, .detail = "4 points"};
  const std::string bytes = session.checkpoint(limit);
  session.tracing().stop(limit);
  EXPECT_FALSE(session.tracing().advance());
  const EventCurve part = session.tracing().curve();
  EXPECT_EQ(part.points.size(), 4U);
  EXPECT_EQ(part.specials.front().reason, EndReason::max_points);
  EXPECT_EQ(part.specials.back().reason, EndReason::max_points);
  EXPECT_EQ(curve_status(part), ExitStatus::limit_met);

  const CurveSession as_ended = CurveSession::from(bytes, "checkpoint", Session::Resume::as_ended);
  EXPECT_EQ(csv_of(as_ended), csv_of(session));
  EXPECT_TRUE(holds(as_ended, files_of(session)));
}

// A digit of any cell, a special point, the list's length.
TEST(CurveSession, KnowsItsFilesFromEditedOnes) {
  const CurveSession session = traced(truss);
  const verify::StoredCurve files = files_of(session);
  ASSERT_TRUE(holds(session, files));
  const std::size_t row = files.curve_csv.find('\n', files.curve_csv.size() / 2) + 1;
  int cells = 0;
  for (std::size_t at = row; files.curve_csv[at] != '\n'; ++at) {
    if (files.curve_csv[at] < '0' || files.curve_csv[at] > '9' || (files.curve_csv[at + 1] != ',')) continue;
    verify::StoredCurve edited = files;
    edited.curve_csv[at] = edited.curve_csv[at] == '7' ? '3' : '7';
    EXPECT_FALSE(holds(session, edited)) << cells;
    ++cells;
  }
  EXPECT_GE(cells, 7);
  verify::StoredCurve shorter = files;
  shorter.curve_csv.resize(row);
  EXPECT_FALSE(holds(session, shorter));
  for (const char* part : {"cusp", "limit-point", "spring.0.stiffness.z", "the number turns"}) {
    verify::StoredCurve edited = files;
    edited.curve_json.replace(edited.curve_json.find(part), 1, "x");
    EXPECT_FALSE(holds(session, edited)) << part;
  }
}

// A state that is no equilibrium of its deck is found, whatever the files say.
TEST(CurveSession, WhoseStatesAreOfAnotherDeckIsNotConfirmed) {
  const CurveSession session = traced(truss);
  std::string stiffer = truss;
  stiffer.replace(stiffer.find("E = 10000.0"), 11, "E = 20000.0");
  nlohmann::json kept = from_checkpoint(session.checkpoint(), "checkpoint");
  ASSERT_EQ(kept.at(1).at(1), truss);
  kept[1][1] = stiffer;
  const CurveSession other = CurveSession::from(to_checkpoint(kept), "checkpoint", Session::Resume::go_on);
  const verify::Verdict verdict = verify::verify_curve(other, files_of(other));
  ASSERT_TRUE(verdict.findings.first());
  EXPECT_NE(to_text(*verdict.findings.first()).find("forces balance"), std::string::npos);
}

TEST(CurveSession, IsNotTakenForARun) {
  const std::string bytes = traced(truss).checkpoint();
  EXPECT_THROW(resume_session(bytes, "checkpoint", Session::Resume::go_on), OutputError);
  Session run = make_session({.deck = "deck.toml", .deck_text = truss});
  ASSERT_TRUE(run.begin());
  EXPECT_THROW(CurveSession::from(run.checkpoint(), "checkpoint", Session::Resume::go_on), OutputError);
}

namespace {

class CurveProgramTest : public ProgramTest {
 protected:
  void put(const std::string& name, const std::string& text) const { std::ofstream(work() / name) << text; }
};

}  // namespace

TEST_F(CurveProgramTest, GoesOnBehindALimitAndAKill) {
  put("deck.toml", truss);
  ASSERT_EQ(run("curve deck.toml --out whole --quiet").status, 0);
  EXPECT_EQ(run("curve deck.toml --out part --quiet --max-points 30").status, 6);
  EXPECT_EQ(run("verify part --quiet").status, 0);
  EXPECT_EQ(run("resume part --quiet --max-points 5").status, 6);
  // It dies as it writes a checkpoint at each point; until it is dead the folder is its own.
  shell("\"$PROGRAM\" resume part --quiet --checkpoint-pause 0 & sleep 0.05; kill -9 $!; wait $!");
  EXPECT_EQ(run("resume part --quiet").status, 0);
  for (const char* name : {"curve.csv", "curve.json", "report.html", "checkpoint"})
    EXPECT_EQ(content(work() / "part" / name), content(work() / "whole" / name)) << name;
  EXPECT_EQ(run("verify part --again --quiet").status, 0);
  ASSERT_EQ(shell("sed -i '3s/[0-9],/7,/' part/curve.csv").status, 0);
  const Outcome edited = run("verify part");
  EXPECT_EQ(edited.status, 7);
  expect_in("curve.csv: point 1", edited.err);
}

// Limit loads of the truss on its spring over the stiffness, for three moduli: the cusp is at k = EA h²/L³.
TEST_F(CurveProgramTest, IsACaseOfASweepSlow) {
  put("deck.toml", truss);
  put("sweep.toml",
      "title = \"Curves\"\ndeck = \"deck.toml\"\ncommand = \"curve\"\n[grid]\nmaterial.m.E = [8e3, 1e4, 1.1e4]\n");
  ASSERT_EQ(run("sweep plan sweep.toml --out study").status, 0);
  for (const char* how : {"", " --force --records"}) {
    ASSERT_EQ(run(std::string("sweep run study --quiet") + how).status, 0);
    if (*how != '\0') fs::remove_all(work() / "study" / "cases");
    const Outcome collected = run("sweep collect study");
    ASSERT_EQ(collected.status, 0) << collected.err;
    const auto rows = table(content(work() / "study" / "sweep.csv"));
    int cusps = 0;
    for (const auto& row : rows)
      if (row.at(2) == "cusp") {
        const double cusp = std::stod(row[1]) / std::pow(101.0, 1.5);
        EXPECT_NEAR(std::stod(row[4]), cusp, 1e-9 * cusp);
        ++cusps;
      }
    EXPECT_EQ(cusps, 3);
    EXPECT_EQ(table(content(work() / "study" / "cases.csv")).size(), 4U);
    EXPECT_GT(table(content(work() / "study" / "curves.csv")).size(), 60U);
    expect_in("Curves of the event", content(work() / "study" / "report.html"));
  }
  EXPECT_EQ(run("verify study/cases/00001 --quiet").status, 5);  // records keep no checkpoint
  put("wrong.toml", "title = \"Curves\"\ndeck = \"truss.toml\"\ncommand = \"curve\"\n[grid]\nmaterial.bar.E = [1e4]\n");
  const Outcome wrong = run("sweep plan wrong.toml --out other");
  EXPECT_EQ(wrong.status, 2);
  expect_in("does not say which event is followed", wrong.err);
}

// The knock-down map of a column in a channel over the amplitudes of a half sine and of its third harmonic: each value
// by a run of its own, and along curves over the one for three values of the other, which land on the same values.
TEST_F(CurveProgramTest, MakesTheKnockDownMapOfRunsSlow) {
  const std::string half = "member.column.imperfection.0.amplitude", third = "member.column.imperfection.1.amplitude";
  put("deck.toml", channel("limit-point", third, "[5e-5, 1.5e-3]\noutput_at = [1e-4, 4e-4, 1e-3]", 20));
  const std::string head = "title = \"Map\"\ndeck = \"deck.toml\"\n", of_half = half + " = [0.001, 0.00176, 0.003]\n";
  put("runs.toml", head + "[grid]\n" + of_half + third + " = [1e-4, 4e-4, 1e-3]\n");
  put("curves.toml", head + "command = \"curve\"\n[grid]\n" + of_half);
  for (const std::string sweep : {"runs", "curves"}) {
    ASSERT_EQ(run("sweep plan " + sweep + ".toml --out " + sweep + "-study").status, 0);
    ASSERT_EQ(run("sweep run " + sweep + "-study --quiet").status, 0);
    ASSERT_EQ(run("sweep collect " + sweep + "-study").status, 0);
  }
  std::map<std::pair<double, double>, double> of_curves;
  for (const auto& row : table(content(work() / "curves-study" / "curves.csv")))
    if (row[0] != "case") of_curves[{std::stod(row[1]), std::stod(row[3])}] = std::stod(row[4]);
  int same = 0;
  for (const auto& row : table(content(work() / "runs-study" / "cases.csv"))) {
    if (row[0] == "case") continue;
    const double lambda = std::stod(row.at(8));
    const auto found = of_curves.find({std::stod(row[1]), std::stod(row[2])});
    ASSERT_NE(found, of_curves.end()) << row[1] << " " << row[2];
    EXPECT_NEAR(found->second, lambda, 1e-9 * lambda);
    ++same;
  }
  EXPECT_EQ(same, 9);
}

}  // namespace arcwall::curve_session_test
