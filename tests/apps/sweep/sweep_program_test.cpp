#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/sweep/case_list.hpp"
#include "apps/sweep/runner.hpp"
#include "tests/apps/cli/program_fixture.hpp"

// `trace-path sweep`, as a user runs it.
namespace arcwall::sweep::sweep_program_test {
namespace {

namespace fs = std::filesystem;

const char* const stiffness_sweep =
    "title = \"Bars of several stiffnesses\"\ndeck = \"truss.toml\"\n[grid]\nmaterial.bar.E = [5e4, 1e5, 2e5]\n";

class SweepProgramTest : public ProgramTest {
 protected:
  void plan(const std::string& text) const {
    put(work() / "sweep.toml", text);
    const Outcome outcome = run("sweep plan sweep.toml --out study");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  Outcome plan_wrong(const std::string& text) const {
    put(work() / "sweep.toml", text);
    return run("sweep plan sweep.toml --out study");
  }

  fs::path study() const { return work() / "study"; }

  // A program for the cases in place of trace-path.
  fs::path stand_in(const std::string& script) const {
    put(work() / "stand-in", "#!/bin/sh\n" + script + "\n");
    fs::permissions(work() / "stand-in", fs::perms::owner_all);
    return work() / "stand-in";
  }

  RunCounts run_by(const std::string& script, std::optional<double> most_seconds = {}) const {
    const RunRequest request{
        .folder = study(), .program = stand_in(script), .jobs = 2, .most_seconds = most_seconds, .patience = 0.2};
    return run_cases(request, {}, Rerun::none, [](const RunCounts&) {});
  }
};

// The first peak of the truss is 2 EA h³/(3 √3 L³), half its rise 0.5 and L² = 25.25.
TEST_F(SweepProgramTest, LimitLoadsOfAllCasesAreCollected) {
  plan(stiffness_sweep);
  ASSERT_EQ(run("sweep run study --jobs 2").status, 0);
  const Outcome outcome = run("sweep collect study");
  EXPECT_EQ(outcome.status, 0);
  expect_in("3 cases, 3 ended as the deck asks", outcome.out);

  const auto rows = table(content(study() / "cases.csv"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(content(study() / "cases.csv").substr(0, 37), "case,material.bar.E,status,reason,det");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double peak = 2.0 * std::stod(rows[i][1]) * 0.125 / (3.0 * std::sqrt(3.0) * std::pow(25.25, 1.5));
    EXPECT_EQ(rows[i][0], std::to_string(i - 1));
    EXPECT_EQ(rows[i][2], "0");
    EXPECT_EQ(rows[i][3], "stop");
    EXPECT_NEAR(std::stod(rows[i][7]), peak, 1e-9 * peak);  // snap_load
  }
  // start, two limit points and end of each case.
  EXPECT_EQ(table(content(study() / "sweep.csv")).size(), 13u);
}

// The peak is proportional to Young's modulus, which is twice the variable.
TEST_F(SweepProgramTest, VariablesGoByName) {
  std::string deck = content(work() / "truss.toml") + "\n[variables]\nhalf = 25000.0\n";
  deck.replace(deck.find("E = "), deck.find('\n', deck.find("E = ")) - deck.find("E = "), "E = \"2 * half\"");
  put(work() / "truss.toml", deck);
  plan("title = \"Bars\"\ndeck = \"truss.toml\"\n[grid]\nhalf = [2.5e4, 5e4, 1e5]\n");
  ASSERT_EQ(run("sweep run study --jobs 2").status, 0);
  ASSERT_EQ(run("sweep collect study").status, 0);
  const auto rows = table(content(study() / "cases.csv"));
  ASSERT_EQ(rows.size(), 4u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double peak = 4.0 * std::stod(rows[i][1]) * 0.125 / (3.0 * std::sqrt(3.0) * std::pow(25.25, 1.5));
    EXPECT_NEAR(std::stod(rows[i][7]), peak, 1e-9 * peak);
  }
  const std::string copy = content(study() / "cases" / "00001" / "deck.toml");
  expect_in("E = \"2 * half\"", copy);
  expect_in("half = 50000.0", copy);
  EXPECT_NE(
      plan_wrong("title = \"Bars\"\ndeck = \"truss.toml\"\n[grid]\nhalf = [1.0]\nvariables.half = [2.0]\n").status, 0);
}

// The load at which a column of linear width buckles goes with its height cubed, whatever the widths.
TEST_F(SweepProgramTest, TapersVaryByTheirKeys) {
  put(work() / "column.toml", R"toml(
title = "A column that tapers"
material.m = { E = 1.0e9 }
section.s = { shape = "rectangle", width = 0.12, width_to = 0.06, height = 0.01 }
point = { clamp = [0.0, 0.0], tip = [10.0, 0.0] }
support = { clamp = ["x", "z", "rotation"] }
load = [{ at = "tip", force = [-1.0, 0.0] }]
path = { step = 0.02, branches = "primary", stop = { event = "branch-point", lambda = [-0.1, 2.0] } }
member.s = { from = "clamp", to = "tip", theory = "elastica", elements = 12, material = "m", section = "s" }
)toml");
  plan(
      "title = \"Columns\"\ndeck = \"column.toml\"\n[grid]\nsection.s.width_to = [0.04, 0.08]\nsection.s.height = "
      "[0.01, "
      "0.012]\n");
  ASSERT_EQ(run("sweep run study --jobs 2").status, 0);
  ASSERT_EQ(run("sweep collect study").status, 0);
  std::vector<double> loads;
  for (const auto& row : table(content(study() / "sweep.csv")))
    if (row.at(4) == "branch-point") loads.push_back(std::stod(row.at(8)));
  ASSERT_EQ(loads.size(), 4u);
  for (const std::size_t width : {0u, 1u}) {
    const std::string value = width == 0 ? "0.04" : "0.08";
    ASSERT_EQ(run("run column.toml --set section.s.width_to=" + value).status, 0);
    const std::string events = content(work() / "column" / "events.json");
    const auto event = nlohmann::json::parse(events)["events"][1];
    EXPECT_EQ(event["kind"], "branch-point");
    EXPECT_EQ(double(event["lambda"]), loads[2 * width]);
    EXPECT_NEAR(loads[2 * width + 1], std::pow(1.2, 3) * loads[2 * width], 1e-6 * loads[2 * width]);
  }
  EXPECT_GT(loads[2], 1.1 * loads[0]);
}

TEST_F(SweepProgramTest, APlannedFolderStandsAlone) {
  plan(stiffness_sweep);
  EXPECT_EQ(names_in(study()), (std::set<std::string>{"cases.jsonl", "sweep.toml", "truss.toml"}));
  EXPECT_TRUE(content(study() / "cases.jsonl")
                  .starts_with("{\"case\":0,\"set\":{\"material.bar.E\":50000.0},\"deck\":\"truss.toml\"}\n"));
  ASSERT_EQ(shell("mv study elsewhere; rm truss.toml sweep.toml; \"$PROGRAM\" sweep run elsewhere").status, 0);
  EXPECT_EQ(run("sweep collect elsewhere").status, 0);
  // A case is what `run` writes for its values.
  ASSERT_EQ(run("run elsewhere/truss.toml --set material.bar.E=5e4").status, 0);
  EXPECT_EQ(content(work() / "truss" / "path.csv"), content(work() / "elsewhere" / "cases" / "00000" / "path.csv"));
}

TEST_F(SweepProgramTest, PlanningAgainChangesNothingAndAnotherSweepIsKept) {
  plan(stiffness_sweep);
  ASSERT_EQ(run("sweep run study --quiet").status, 0);
  plan(stiffness_sweep);
  EXPECT_TRUE(fs::exists(study() / "cases" / "00002"));
  const Outcome refused = plan_wrong(std::string(stiffness_sweep) + "section.bar.A = [1.0]\n");
  EXPECT_EQ(refused.status, 5);
  expect_in("name another folder with --out", refused.err);
}

TEST_F(SweepProgramTest, WrongKeysAndValuesOfAnyCaseAreToldBeforeAnythingRuns) {
  const Outcome outcome = plan_wrong(
      "title = \"t\"\ndeck = \"truss.toml\"\n[grid]\nmaterial.bar.E = [1e5, -1.0]\nmember.left.elemnts = [1, 2]\n");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(
      outcome.err,
      "error: sweep.toml:4:14: material.bar.E=-1: -1 is out of range (2 cases, the first is case 2); give a number "
      "greater than 0\n"
      "error: sweep.toml:5:13: member.left.elemnts: \"elemnts\" is not a key of this table (4 cases, the first is "
      "case 0); did you mean elements?\n");
  EXPECT_FALSE(fs::exists(study()));

  const Outcome gone = plan_wrong("title = \"t\"\ndeck = \"gone.toml\"\n[grid]\npath.step = [1.0]\n");
  EXPECT_EQ(gone.status, 2);
  expect_in("sweep.toml:2:8: deck: gone.toml: there is no such file", gone.err);
}

TEST_F(SweepProgramTest, CompleteCasesAreNotRunAgain) {
  plan(stiffness_sweep);
  ASSERT_EQ(run("sweep run study --case 1").status, 0);
  EXPECT_EQ(names_in(study() / "cases"), std::set<std::string>{"00001"});
  put(study() / "cases" / "00001" / "mark", "");
  expect_in("3 of 3 cases completed, 2 of them new", run("sweep run study").out);
  EXPECT_TRUE(fs::exists(study() / "cases" / "00001" / "mark"));
  expect_in("1 of 1 cases completed, 1 of them new", run("sweep run study --case 1 --force").out);
  EXPECT_FALSE(fs::exists(study() / "cases" / "00001" / "mark"));
}

TEST_F(SweepProgramTest, OptionsBehindTwoDashesAreThoseOfRun) {
  plan(stiffness_sweep);
  EXPECT_EQ(run("sweep run study -- --max-points 3").status, 3);
  const Outcome outcome = run("sweep collect study");
  expect_in("max_points      3  0, 1, 2", outcome.out);
  EXPECT_EQ(run("sweep run study --failed").status, 0);
  for (const char* wrong : {"--forse", "--out x", "--force", "--max-time 1", "other.toml", "--json", "--help"}) {
    const Outcome refused = run("sweep run study -- " + std::string(wrong));
    EXPECT_EQ(refused.status, 2) << wrong;
    EXPECT_EQ(refused.out, "") << wrong;
  }
}

TEST_F(SweepProgramTest, ACrashCostsOneCase) {
  plan(stiffness_sweep);
  const RunCounts counts = run_by("case $* in *E=1e+05*) kill -SEGV $$;; esac; exec '" TRACE_PATH_PROGRAM "' \"$@\"");
  EXPECT_EQ(counts.ran, 3);
  EXPECT_EQ(counts.failed, 1);
  expect_in("crash       1  1", run("sweep collect study").out);
  expect_in("\n1,1e+05,,crash,signal 11 (Segmentation fault),", content(study() / "cases.csv"));
}

TEST_F(SweepProgramTest, ACaseThatDoesNotStopIsKilled) {
  plan(stiffness_sweep);
  const RunCounts counts =
      run_by("case $* in *E=1e+05*) exec sleep 60;; esac; exec '" TRACE_PATH_PROGRAM "' \"$@\"", 0.3);
  EXPECT_EQ(counts.ran, 3);
  EXPECT_EQ(counts.failed, 1);
  ASSERT_EQ(run("sweep collect study").status, 0);
  expect_in("\n1,1e+05,,max_time,did not stop and was killed,", content(study() / "cases.csv"));
}

TEST_F(SweepProgramTest, AProgramThatCannotBeStartedIsAnError) {
  plan(stiffness_sweep);
  const RunRequest request{.folder = study(), .program = work() / "gone"};
  EXPECT_THROW(run_cases(request, {}, Rerun::none, [](const RunCounts&) {}), OutputError);
  EXPECT_EQ(names_in(study() / "cases"), std::set<std::string>{});
}

TEST_F(SweepProgramTest, CasesWithoutResultsAreListedAsNotRun) {
  plan(stiffness_sweep);
  const Outcome outcome = run("sweep collect study");
  EXPECT_EQ(outcome.status, 0);
  expect_in("not_run      3  0, 1, 2", outcome.out);
  expect_in("\n2,2e+05,,not_run,,,,,,,,\n", content(study() / "cases.csv"));
}

TEST_F(SweepProgramTest, FailuresWithoutResultsHaveTheirReason) {
  plan("title = \"t\"\ndeck = \"truss.toml\"\n[[list]]\nload.0.force = [0.0, -1.0]\n");
  ASSERT_EQ(run("sweep run study -- --set material.bar.E=-1").status, 3);
  expect_in("wrong_input      1  0", run("sweep collect study").out);
  expect_in("material.bar.E: -1 is out of range", content(study() / "cases.csv"));
}

TEST_F(SweepProgramTest, AnInterruptStopsCleanlyAndTheNextCallGoesOn) {
  plan("title = \"t\"\ndeck = \"truss.toml\"\n[grid]\nmaterial.bar.E = [1e5, 2e5]\n");
  // Steps so small that a case would take minutes.
  const Outcome outcome = shell(
      "\"$PROGRAM\" sweep run study --jobs 2 -- --set path.max_step=1e-8 --set path.min_step=1e-12 "
      "--set path.max_points=100000000 & child=$!; sleep 0.5; kill -INT $child; wait $child");
  EXPECT_EQ(outcome.status, 130);
  for (const std::string& name : names_in(study() / "cases")) EXPECT_EQ(name[0], '.') << "no case has results";
  // With other options they begin anew.
  expect_in("2 of 2 cases completed, 2 of them new", run("sweep run study").out);
  EXPECT_EQ(names_in(study() / "cases"), (std::set<std::string>{"00000", "00001"}));
}

// As when the time of a task on a cluster is over again and again: each began every case from its start, for ever.
TEST_F(SweepProgramTest, ACaseThatWasCutOffGoesOnFromItsCheckpoint) {
  plan("title = \"t\"\ndeck = \"truss.toml\"\n[[list]]\npath.max_step = 0.0002\n");
  const std::string command =
      "\"$PROGRAM\" sweep run study --quiet -- --checkpoint-pause 0 --set path.max_points=1000000";
  const Outcome cut = shell(command +
                            " & child=$!; until [ -e study/cases/.00000/checkpoint ]; do sleep 0.01; done; "
                            "kill -TERM $child; wait $child");
  ASSERT_EQ(cut.status, 130) << "the case is too short to be cut off";
  expect_in(
      "0 of 1 cases completed, 0 of them as the deck asks\n1 more are running or were interrupted, 0 have not begun\n",
      run("sweep status study").out);
  const std::string begun = content(study() / "cases" / ".00000" / "path.csv");
  ASSERT_GT(begun.size(), 100u);
  ASSERT_EQ(shell(command).status, 0);
  const std::string whole = content(study() / "cases" / "00000" / "path.csv");
  EXPECT_TRUE(content(study() / "cases" / "00000" / "messages.txt").find("traced anew") == std::string::npos);
  ASSERT_EQ(run("run study/truss.toml --out alone --quiet --set path.max_points=1000000 --set path.max_step=0.0002 "
                "--no-pictures")
                .status,
            0);
  EXPECT_EQ(whole, content(work() / "alone" / "path.csv"));
  expect_in("1 of 1 cases completed, 1 of them as the deck asks\n", run("sweep status study").out);
}

TEST_F(SweepProgramTest, ACaseThatTheTimeOfItsProcessCutGoesOnWithFailed) {
  plan("title = \"t\"\ndeck = \"truss.toml\"\n[[list]]\npath.max_step = 0.0002\n");
  const std::string options = " -- --set path.max_points=1000000";
  ASSERT_EQ(run("sweep run study --quiet --max-time 0.0001" + options).status, 3);
  const std::size_t before = table(content(study() / "cases" / "00000" / "path.csv")).size();
  ASSERT_EQ(run("sweep run study --quiet --failed --max-time 1e300" + options).status, 0);
  EXPECT_GT(table(content(study() / "cases" / "00000" / "path.csv")).size(), before);
  EXPECT_EQ(names_in(study() / "cases" / "00000").count("begun.json"), 0u);
}

TEST_F(SweepProgramTest, CasesThatWereHinderedAreRunAgain) {
  plan(stiffness_sweep);
  EXPECT_EQ(
      run_by("case $* in *E=1e+05*) exit 5;; *E=2e+05*) kill -KILL $$;; esac; exec '" TRACE_PATH_PROGRAM "' \"$@\"")
          .failed,
      2);
  expect_in("file_error      1  1", run("sweep status study").out);
  expect_in("3 of 3 cases completed, 2 of them new", run("sweep run study").out);
}

TEST_F(SweepProgramTest, SharesOfTheCasesAreDisjointAndTogetherAll) {
  plan(stiffness_sweep);
  expect_in("2 of 2 cases completed, 2 of them new", run("sweep run study --part 0/2").out);
  EXPECT_EQ(names_in(study() / "cases"), (std::set<std::string>{"00000", "00002"}));
  expect_in("1 of 1 cases completed, 1 of them new", run("sweep run study --part 1/2").out);
  for (const char* wrong : {"2/2", "1", "a/b", "-1/2", "0/0", "1/"})
    EXPECT_EQ(run("sweep run study --part " + std::string(wrong)).status, 2) << wrong;
  EXPECT_EQ(run("sweep run study --tolerant --force -- --max-points 3").status, 0);
}

TEST_F(SweepProgramTest, ACaseThatAnotherProcessRunsIsLeftToIt) {
  plan("title = \"t\"\ndeck = \"truss.toml\"\n[[list]]\npath.step = 1.0\n");
  const Outcome outcome = shell(
      "\"$PROGRAM\" sweep run study --quiet -- --set path.max_step=1e-8 --set path.min_step=1e-12 "
      "--set path.max_points=100000000 & child=$!; "
      "until [ -e study/cases/.00000/messages.txt ]; do sleep 0.05; done; "
      "\"$PROGRAM\" sweep run study; "
      // The process of the case holds it as well.
      "for pid in $(cat /proc/$child/task/$child/children); do readlink /proc/$pid/fd/* | "
      "grep 'cases/.00000$' | sed 's/.*study/held: study/'; done; "
      "kill -TERM $child; wait $child");
  expect_in("0 of 1 cases completed, 0 of them new; another process is running 1", outcome.out);
  expect_in("held: study/cases/.00000", outcome.out);
}

// As when a sweep was killed while the process of a case waits for the disk.
TEST_F(SweepProgramTest, ACaseIsBegunAnewOnceItsOldProcessHasEnded) {
  plan("title = \"t\"\ndeck = \"truss.toml\"\n[[list]]\npath.step = 1.0\n");
  const Outcome outcome = shell(
      "mkdir -p study/cases/.00000; flock study/cases/.00000 sleep 0.2 & "
      "until ! flock --nonblock study/cases/.00000 true; do sleep 0.01; done; "
      "\"$PROGRAM\" sweep run study; wait");
  expect_in("1 of 1 cases completed, 1 of them new", outcome.out);
}

TEST_F(SweepProgramTest, TheReportIsOnePageWithoutNetworkThatTrustsNoText) {
  plan(
      "title = \"<script>alert(1)</script>\"\ndeck = \"truss.toml\"\n[grid]\nmaterial.bar.E = [1e5, 2e5]\n"
      "section.bar.A = [1.0, 2.0]\n");
  ASSERT_EQ(run("sweep run study --quiet").status, 0);
  ASSERT_EQ(run("sweep collect study --over section.bar.A").status, 0);
  ASSERT_EQ(run("sweep collect study").status, 0);
  const std::string page = content(study() / "report.html");
  expect_in("&lt;script&gt;alert(1)&lt;/script&gt;", page);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  // The data is JSON in ASCII without <.
  const std::size_t begin = page.find("id=\"data\">") + 10, end = page.find("</script>", begin);
  const auto data = nlohmann::json::parse(page.substr(begin, end - begin));
  EXPECT_EQ(data.at("keys").at(1).at("name"), "section.bar.A");
  EXPECT_EQ(data.at("cases").at("number"), nlohmann::json({0, 1, 2, 3}));
}

// w = h (1 − 1/√3) at the snap, whatever E.
TEST_F(SweepProgramTest, MapsMayShowAMonitorAtTheEvents) {
  plan("title = \"t\"\ndeck = \"truss.toml\"\n[grid]\nmaterial.bar.E = [1e5, 2e5]\nsection.bar.A = [1.0, 2.0]\n");
  ASSERT_EQ(run("sweep run study --quiet").status, 0);
  ASSERT_EQ(run("sweep collect study --monitor w").status, 0);
  const std::string page = content(study() / "report.html");
  const std::size_t begin = page.find("id=\"data\">") + 10, end = page.find("</script>", begin);
  const auto data = nlohmann::json::parse(page.substr(begin, end - begin));
  EXPECT_EQ(data.at("loads").at(0).at("axis"), "w of the snap [m]");
  for (const auto& load : data.at("cases").at("loads").at(0)) EXPECT_NEAR(load.get<double>(), 0.211325, 1e-6);
  const Outcome unknown = run("sweep collect study --monitor v");
  EXPECT_EQ(unknown.status, 2);
  expect_in("which no case has", unknown.err);
}

TEST_F(SweepProgramTest, ScriptsForEnginesQuoteAnyName) {
  plan(stiffness_sweep);
  const std::string name = "it's {} \"a\" $(study) \\";
  fs::rename(study(), work() / name);
  const Outcome slurm = shell(
      "\"$PROGRAM\" sweep emit *study* --engine slurm --jobs 2 >job.sh && "
      "for i in 0 1 2; do SLURM_ARRAY_TASK_ID=$i sh job.sh || exit 1; done; cat job.sh");
  EXPECT_EQ(slurm.status, 0) << slurm.err;
  expect_in("#SBATCH --array=0-2%2\n", slurm.out);
  EXPECT_EQ(names_in(work() / name / "cases").size(), 3u);
  EXPECT_EQ(shell("\"$PROGRAM\" sweep emit *study* --engine parallel --jobs 2 >job.sh && sh -n job.sh").status, 0);
  const Outcome packed = shell(
      "rm -rf *study*/cases; \"$PROGRAM\" sweep emit *study* --engine slurm --tasks 2 --time 0:30:00 --memory 2G "
      "--partition short --log logs/%a.txt -- --set 'path.output_at={lambda=[1.5]}' >job.sh && "
      "for i in 0 1; do SLURM_ARRAY_TASK_ID=$i sh job.sh || exit 1; done; cat job.sh");
  EXPECT_EQ(packed.status, 0) << packed.err;
  expect_in("#SBATCH --array=0-1\n", packed.out);
  expect_in("#SBATCH --time=0:30:00\n#SBATCH --mem=2G\n#SBATCH --partition=short\n#SBATCH --output=logs/%a.txt\n",
            packed.out);
  EXPECT_EQ(names_in(work() / name / "cases").size(), 3u);
  expect_in(",1.5,", content(work() / name / "cases" / "00002" / "path.csv"));
  EXPECT_EQ(run("sweep emit *study* --engine slurm --time '1 h'").status, 2);
}

TEST_F(SweepProgramTest, WrongCommandLinesAreErrorsThatProposeTheNearest) {
  plan(stiffness_sweep);
  const auto expect_error = [&](const std::string& arguments, const std::string& message) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    expect_in(message, outcome.err);
  };
  expect_error("sweep", "usage: trace-path sweep COMMAND");
  expect_error("sweeep", "did you mean sweep?");
  expect_error("sweep pln", "did you mean plan?");
  expect_error("sweep --out x", "stands before the command");
  expect_error("sweep plan", "usage: trace-path sweep plan SWEEP");
  expect_error("sweep run study --job 2", "did you mean --jobs?");
  expect_error("sweep run study --case 3", "has the cases 0 to 2");
  expect_error("sweep run study --case -1", "must be a whole number from 0");
  expect_error("sweep run .", "is no planned sweep");
  expect_error("sweep run gone", "is no planned sweep");
  expect_error("sweep emit study", "--engine is missing; it is parallel or slurm");
  expect_error("sweep emit study --engine paralel", "did you mean parallel?");
  expect_error("sweep collect study --over material.bar.nu", "varied are material.bar.E");
}

TEST_F(SweepProgramTest, TheExampleIsListedAndRight) {
  expect_in("\nsweep-channel ", run("examples").out);
  ASSERT_EQ(run("examples sweep-channel --out sweep-channel.toml").status, 0);
  ASSERT_EQ(run("examples channel --out channel.toml").status, 0);
  EXPECT_EQ(run("sweep plan sweep-channel.toml").status, 0);
  expect_in("20 of 20 cases completed, 20 of them new",
            run("sweep run sweep-channel --jobs 2 -- --set member.column.elements=10 --max-points 20").out);
}

TEST_F(SweepProgramTest, HelpBeginsWithAnExample) {
  for (const char* command : {"sweep", "sweep plan", "sweep run", "sweep emit", "sweep collect"}) {
    const Outcome outcome = run(std::string(command) + " --help");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out.find("  trace-path " + std::string(command)), 0u) << outcome.out;
    EXPECT_EQ(run(std::string(command) + " --version").out.find("trace-path "), 0u);
  }
  expect_in("\n  sweep ", run("--help").out);
}

TEST_F(SweepProgramTest, DamagedFoldersAreErrors) {
  plan(stiffness_sweep);
  ASSERT_EQ(run("sweep run study --quiet").status, 0);
  put(study() / "cases" / "00001" / "events.json", "{\"events\": 1");
  const Outcome damaged = run("sweep collect study");
  EXPECT_EQ(damaged.status, 5);
  expect_in("00001/events.json: is damaged; run the case again with --force", damaged.err);
  put(study() / "cases.jsonl", "{\"case\":0,\"set\":{},\"deck\":\"truss.toml\"}\nnonsense\n");
  const Outcome list = run("sweep run study");
  EXPECT_EQ(list.status, 2);
  expect_in("cases.jsonl:2: is not the line of case 1", list.err);
}

TEST_F(SweepProgramTest, OneKeyUnderTwoNamesIsRefusedWithBoth) {
  ASSERT_EQ(run("examples channel --out channel.toml").status, 0);
  const Outcome refused = plan_wrong(
      "title = \"t\"\ndeck = \"channel.toml\"\n[grid]\nwall.0.profile.z = [0.2, 0.21]\nwall.upper.profile.z = "
      "[0.22]\n");
  EXPECT_EQ(refused.status, 2);
  expect_in("sweep.toml:5", refused.err);
  expect_in("wall.upper.profile.z: is another name of wall.0.profile.z", refused.err);
  const Outcome tied = plan_wrong(
      "title = \"t\"\ndeck = \"channel.toml\"\n[grid]\nwall.0.profile.z = [0.2, 0.21]\n[tie]\nwall.upper.profile.z = { "
      "to = \"wall.0.profile.z\" }\n");
  EXPECT_EQ(tied.status, 2);
  expect_in("is another name of wall.0.profile.z", tied.err);
}

// Of a text a spreadsheet would make a formula; numbers stay numbers.
TEST_F(SweepProgramTest, TextsInTablesAreNoFormulas) {
  plan(
      "title = \"t\"\ndeck = \"truss.toml\"\n[grid]\ntitle = [\"=1+1\", \"+a\", \"-b\", \"@c\"]\nload.0.force.0 = "
      "[-1.5]\n");
  ASSERT_EQ(run("sweep run study --quiet").status, 0);
  ASSERT_EQ(run("sweep collect study").status, 0);
  const std::string cases = content(study() / "cases.csv");
  for (const char* row : {"\n0,'=1+1,-1.5,", "\n1,'+a,-1.5,", "\n2,'-b,-1.5,", "\n3,'@c,-1.5,"}) expect_in(row, cases);
}

}  // namespace
}  // namespace arcwall::sweep::sweep_program_test
