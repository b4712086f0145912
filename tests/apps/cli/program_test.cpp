#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "tests/apps/cli/program_fixture.hpp"

namespace arcwall::program_test {
namespace {

namespace fs = std::filesystem;

TEST_F(ProgramTest, RunWritesAFolderNamedAfterTheDeckAndPrintsTheEvents) {
  const Outcome outcome = run("run truss.toml");

  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(names_in(work() / "truss"), run_outputs);
  EXPECT_EQ(outcome.out, content(work() / "truss" / "events.txt"));
  EXPECT_EQ(outcome.err.find("branch 0"), std::string::npos) << "progress without a terminal";
  const Json events = Json::parse(content(work() / "truss" / "events.json"))["events"];
  ASSERT_EQ(events.size(), 4u);
  // The first peak, 2 EA h³/(3 √3 L³).
  EXPECT_NEAR(events[1]["lambda"].get<double>(), 2.0 * 1e5 * 0.125 / (3.0 * std::sqrt(3.0) * std::pow(25.25, 1.5)),
              1e-8);
}

// On a flat foundation the forces of the wall and the reactions of both supports sum to zero.
TEST_F(ProgramTest, ContactsAreListedWithForcesAndPressures) {
  ASSERT_EQ(run("examples foundation --out foundation.toml").status, 0);
  for (const bool nodes : {false, true}) {
    ASSERT_EQ(run("foundation.toml --no-units --force --set contact.points='\"" +
                  std::string(nodes ? "nodes" : "moving") + "\"'")
                  .status,
              0);
    EXPECT_EQ(names_in(work() / "foundation").count("contacts.csv"), 1u);
    const auto rows = table(content(work() / "foundation" / "contacts.csv"));
    const auto path = table(content(work() / "foundation" / "path.csv"));
    double force = 0.0;
    for (std::size_t i = rows.size(); i-- > 1 && rows[i][1] == path.back()[1];) {
      EXPECT_EQ(rows[i][3], "foundation");
      force += std::stod(rows[i][7]);
      if (nodes) {  // 40 elements of 0.05
        EXPECT_NEAR(std::stod(rows[i][8]) * 0.05, std::stod(rows[i][7]), 1e-12);
      } else {
        EXPECT_EQ(rows[i][8], "");
      }
    }
    EXPECT_GT(force, 1.0);
    EXPECT_NEAR(force + 2.0 * std::stod(path.back()[5]), 0.0, 1e-7);
  }
}

TEST_F(ProgramTest, LoadIncrementsMeetTheLevelsOfTheDeck) {
  ASSERT_EQ(run("examples foundation --out foundation.toml").status, 0);
  const std::string increments =
      " --set path.method='\"incremental\"' --set path.step=0.1 --set path.output_at='{lambda=[0.25, 0.5]}'";
  ASSERT_EQ(run("foundation.toml --no-units --set contact.method='\"penalty\"' --set contact.penalty=1e8" + increments)
                .status,
            0);
  const auto path = table(content(work() / "foundation" / "path.csv"));
  ASSERT_EQ(path.size(), 8u);  // header, start, three increments to 0.25, three to 0.5
  EXPECT_EQ(path[4][3], "0.25");
  EXPECT_EQ(path[7][3], "0.5");
  EXPECT_EQ(path[7].back(), "end");
  // The beam lies on the foundation, 0.08 below.
  EXPECT_NEAR(std::stod(path[7][4]), -0.08, 1e-6);

  const Outcome moment =
      run("foundation.toml --set 'monitor=[{name=\"M\", member=\"beam\", component=\"max-moment\"}]'" + increments);
  EXPECT_EQ(moment.status, 2);
  expect_in("max-moment is not available with load increments", moment.err);
  const Outcome refused = run("truss.toml" + increments);
  EXPECT_EQ(refused.status, 2);
  expect_in("path.method: method \"incremental\" needs members of theory", refused.err);
}

TEST_F(ProgramTest, ADeckAloneIsRun) {
  EXPECT_EQ(run("truss.toml --quiet").status, 0);
  EXPECT_EQ(names_in(work() / "truss"), run_outputs);
}

TEST_F(ProgramTest, NoPicturesLeavesOutTheReportAndTheShapesOfAnEarlierRunToo) {
  ASSERT_EQ(run("run truss.toml").status, 0);
  ASSERT_EQ(run("run truss.toml --no-pictures").status, 0);
  std::set<std::string> tables = run_outputs;
  for (const char* picture : {"report.html", "shapes", "shapes.pvd"}) tables.erase(picture);
  EXPECT_EQ(names_in(work() / "truss"), tables);
}

TEST_F(ProgramTest, TheDeckAsItWasRunGivesTheSamePath) {
  ASSERT_EQ(run("truss.toml --set path.step=2.5").status, 0);
  ASSERT_EQ(run("truss/deck.toml --out again").status, 0);
  EXPECT_EQ(content(work() / "truss" / "path.csv"), content(work() / "again" / "path.csv"));
}

// A deck in words that are read as others: the same path, and these words in what is written.
TEST_F(ProgramTest, ADeckInOtherWordsIsRunAndWrittenInThoseOfToday) {
  const std::string old = "sed -e 's/euler-bernoulli/classic/' -e 's/most-stable/follow/' -e 's/output_at/land/' ";
  ASSERT_EQ(run("examples channel --out channel.toml").status, 0);
  ASSERT_EQ(shell("printf '%s\\n' 'land = { lambda = [1.0] }' 'landing = false' 'branches = \"follow\"' >keys && " +
                  old + "-e '/^\\[path\\]/r keys' channel.toml >old.toml && grep -q classic old.toml")
                .status,
            0);
  ASSERT_EQ(
      run("run channel.toml --quiet --no-pictures --set path.output_at.lambda=[1.0] --set path.jumps=false").status, 0);
  ASSERT_EQ(run("run old.toml --quiet --no-pictures --set contact.points='\"sliding\"'").status, 0);
  const std::string written = content(work() / "old" / "deck.toml");
  for (const char* word : {"output_at.lambda = [1.0]", "jumps = false", "branches = \"most-stable\"",
                           "points = \"moving\"", "theory = \"euler-bernoulli\"", "equilibrium_family = \"symmetric\""})
    expect_in(word, written);
  for (const char* word : {"\nland", "follow", "sliding", "classic", "continuum"})
    EXPECT_EQ(written.find(word), std::string::npos) << word;
  EXPECT_EQ(content(work() / "old" / "path.csv"), content(work() / "channel" / "path.csv"));
}

TEST_F(ProgramTest, QuietPrintsNothingOnStandardOutput) {
  const Outcome outcome = run("truss.toml --quiet");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "");
}

TEST_F(ProgramTest, NoUnitsLeavesTheBracketsOut) {
  ASSERT_EQ(run("truss.toml --no-units").status, 0);
  EXPECT_EQ(content(work() / "truss" / "path.csv").substr(0, 28), "branch,step,arc,lambda,w,uns");
}

TEST_F(ProgramTest, JsonIsOneObjectALine) {
  const Outcome outcome = run("truss.toml --json");

  EXPECT_EQ(outcome.status, 0);
  const std::vector<Json> objects = json_lines(outcome.out);
  std::size_t points = 0, events = 0;
  for (const Json& object : objects) {
    ASSERT_EQ(object.size(), 1u);
    points += object.contains("point");
    events += object.contains("event");
  }
  EXPECT_EQ(events, 4u);
  EXPECT_EQ(points + events + 1, objects.size());
  EXPECT_EQ(objects.back()["end"]["reason"], "stop");
  EXPECT_EQ(objects.back()["end"]["status"], 0);
  const std::string csv = content(work() / "truss" / "path.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), points + 1);
}

TEST_F(ProgramTest, DryRunWritesNothing) {
  const Outcome outcome = run("truss.toml --dry-run --out results");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(wrote_nothing());
  expect_in("would write into results", outcome.out);
  expect_in("path.csv", outcome.out);
}

TEST_F(ProgramTest, CheckSummarisesTheDeck) {
  const Outcome outcome = run("check truss.toml");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(wrote_nothing());
  expect_in("unknowns  2", outcome.out);
  expect_in("left: truss, 1 element", outcome.out);
}

// Lee's frame with 10 elements a member: the first limit load of the elastica, 1.855672753757 by shooting, to 4e-8.
TEST_F(ProgramTest, TheoryElasticaIsRunWithOrderSixUnlessTheDeckSaysFour) {
  const std::string members[] = {"column", "short", "long"};
  const int elements[] = {10, 2, 8};
  std::string values;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string member = " --set member." + members[i];
    values += member + ".theory='\"elastica\"'" + member + ".elements=" + std::to_string(elements[i]);
  }
  ASSERT_EQ(run("examples lee --out lee.toml").status, 0);
  ASSERT_EQ(run("lee.toml --quiet --out six" + values).status, 0);
  ASSERT_EQ(run("lee.toml --quiet --out four --set member.column.order=4" + values).status, 0);

  const auto first_limit = [&](const char* folder) {
    return Json::parse(content(work() / folder / "events.json"))["events"][1]["lambda"].get<double>();
  };
  EXPECT_NEAR(first_limit("six"), 1.855672753757, 5e-8);
  EXPECT_GT(std::abs(first_limit("four") - 1.855672753757), 1e-6);
}

TEST_F(ProgramTest, CheckNamesTheFirstGapOfAWall) {
  ASSERT_EQ(run("examples foundation --out foundation.toml").status, 0);
  const Outcome outcome = run("check foundation.toml");
  EXPECT_EQ(outcome.status, 0);
  expect_in("foundation: below the structure", outcome.out);
  expect_in("smallest initial gap 0.08 cm at beam:", outcome.out);
}

TEST_F(ProgramTest, CheckSaysWhereContactIsLookedForAndWhy) {
  ASSERT_EQ(run("examples channel --out channel.toml").status, 0);
  expect_in(
      "anywhere along the members (moving): the default where all members are of theory euler-bernoulli or elastica",
      run("check channel.toml").out);
  const std::string nodes = run("check channel.toml --set contact.points='\"nodes\"'").out;
  expect_in("at the nodes of the mesh: as contact.points says", nodes);
  expect_in("loads of snaps depend on the mesh", nodes);
  EXPECT_EQ(run("check truss.toml").out.find("contact"), std::string::npos);
}

TEST_F(ProgramTest, AnEventOfTheDecksChoiceStopsThePath) {
  const Outcome outcome = run("run truss.toml --set path.stop.event='\"limit-point\"'");
  EXPECT_EQ(outcome.status, 0);
  expect_in("ended: event = limit-point (stop)", outcome.out);
  const Json events = Json::parse(content(work() / "truss" / "events.json"))["events"];
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[1]["kind"], "limit-point");
}

TEST_F(ProgramTest, EveryErrorOfADeckIsReportedAndNothingWritten) {
  const Outcome outcome = run("run truss.toml --set material.bar.E=-1 --set load.0.at='\"nowhere\"'");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(wrote_nothing());
  EXPECT_EQ(outcome.out, "");
  expect_in("E", outcome.err);
  expect_in("nowhere", outcome.err);
  std::istringstream stream(outcome.err);
  for (std::string line; std::getline(stream, line);) EXPECT_TRUE(line.starts_with("error: ")) << line;
}

TEST_F(ProgramTest, ADeckThatIsNotThereIsWrongInput) {
  EXPECT_EQ(run("run gone.toml").status, 2);
  EXPECT_EQ(run("gone.toml").status, 2);
  EXPECT_EQ(run("run .").status, 2);
  EXPECT_TRUE(wrote_nothing());
}

TEST_F(ProgramTest, UnknownAndShortenedOptionsAreErrorsThatProposeTheNearest) {
  const auto expect_proposal = [&](const std::string& arguments, const std::string& proposal) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    expect_in("did you mean " + proposal, outcome.err);
  };
  expect_proposal("run truss.toml --forse", "--force");
  expect_proposal("run truss.toml --quie", "--quiet");
  expect_proposal("run truss.toml --max 3", "--max-points or --max-time");
  expect_proposal("run truss.toml --drY-run", "--dry-run");
  expect_proposal("check truss.toml --sets a=1", "--set");
  expect_proposal("--versoin", "--version");
  expect_proposal("chek truss.toml", "check");
  expect_proposal("examples trus", "truss");
  EXPECT_TRUE(wrote_nothing());
}

TEST_F(ProgramTest, WrongCommandLinesAreErrors) {
  for (const char* arguments : {"",
                                "run",
                                "run truss.toml other.toml",
                                "run truss.toml -x",
                                "run truss.toml --out",
                                "run truss.toml --out=",
                                "run truss.toml --quiet=yes",
                                "run truss.toml --out a --out b",
                                "run truss.toml --max-points 0",
                                "run truss.toml --max-points 1.5",
                                "run truss.toml --max-points 99999999999",
                                "run truss.toml --max-time -1",
                                "run truss.toml --max-time nan",
                                "run truss.toml --max-time 1s",
                                "run truss.toml --set",
                                "run truss.toml --set x",
                                "run truss.toml --verbose=2",
                                "run truss.toml --processes 2",
                                "resume",
                                "report",
                                "report a b",
                                "verify",
                                "converge",
                                "converge truss.toml --levels 1",
                                "converge truss.toml --factor 1",
                                "''",
                                "run ''",
                                "--quiet truss.toml",
                                "examples --out x",
                                "examples truss channel",
                                "--help more"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
  }
  EXPECT_TRUE(wrote_nothing());
}

TEST_F(ProgramTest, HelpBeginsWithAnExample) {
  for (const char* command : {"", "run", "resume", "report", "verify", "converge", "curve", "check", "examples"}) {
    const Outcome outcome = run(std::string(command) + " --help");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out.find("  trace-path " + std::string(command)), 0u) << outcome.out;
    EXPECT_EQ(outcome.err, "");
    const Outcome version = run(std::string(command) + " --version");
    EXPECT_EQ(version.status, 0);
    EXPECT_EQ(version.out.find("trace-path "), 0u) << version.out;
  }
}

// Whether the run ended or was stopped, byte for byte.
TEST_F(ProgramTest, ReportIsWrittenAgainAsItWas) {
  for (const char* more : {"", " --max-points 3", " --set path.step=0.2"}) {
    run(std::string("truss.toml --quiet") + more);
    const std::string page = content(work() / "truss" / "report.html");
    ASSERT_NE(page, "");
    std::filesystem::remove(work() / "truss" / "report.html");

    const Outcome outcome = run("report truss");

    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    expect_in("wrote truss/report.html", outcome.err);
    EXPECT_TRUE(content(work() / "truss" / "report.html") == page) << more;
  }
}

TEST_F(ProgramTest, ReportOfWhatIsNoRunGivesStatus5) {
  EXPECT_EQ(run("report nowhere").status, 5);
  expect_in("no such folder", run("report nowhere").err);
  expect_in("checkpoint: there is none", run("report .").err);
  EXPECT_FALSE(std::filesystem::exists(work() / "report.html"));
}

// Every accepted step is a row of path.csv; what was cut back says why.
TEST_F(ProgramTest, VerboseWritesTheLedgerOfSteps) {
  ASSERT_EQ(run("truss.toml --verbose --quiet").status, 0);
  const std::vector<Json> steps = json_lines(content(work() / "truss" / "steps.jsonl"));
  const auto rows = table(content(work() / "truss" / "path.csv"));
  std::size_t accepted = 0;
  for (const Json& step : steps) {
    EXPECT_GT(step["radius"].get<double>(), 0.0);
    if (step["outcome"] != "accepted") continue;
    ++accepted;
    EXPECT_EQ(step["lambda"].get<double>(), std::stod(rows[accepted + 1][3]));
    EXPECT_LT(std::abs(step["root"].get<double>()), std::abs(step["other_root"].get<double>()));
    EXPECT_LE(step["residual"].get<double>(), 1e-9);
  }
  EXPECT_EQ(accepted + 2, rows.size());  // a header and the start

  // Under load control the branch ends at the limit point, by steps that fail and are halved.
  ASSERT_EQ(run("truss.toml --verbose --quiet --out load --set path.method='\"load\"'").status, 3);
  const std::vector<Json> failing = json_lines(content(work() / "load" / "steps.jsonl"));
  EXPECT_NE(failing.back()["outcome"], "accepted");
  EXPECT_NEAR(failing.back()["radius"].get<double>(), 0.5 * failing[failing.size() - 2]["radius"].get<double>(), 1e-12);

  ASSERT_EQ(run("truss.toml --verbose --quiet --out parts --max-points 4").status, 6);
  ASSERT_EQ(run("resume parts --quiet").status, 0);
  EXPECT_EQ(content(work() / "parts" / "steps.jsonl"), content(work() / "truss" / "steps.jsonl"));
}

TEST_F(ProgramTest, ABranchThatEndsEarlyGivesStatus3AndWhatWasTraced) {
  const Outcome outcome = run("truss.toml --set path.method='\"load\"'");
  EXPECT_EQ(outcome.status, 3);
  expect_in("control_turns", outcome.err);
  expect_in("last point: branch 0", outcome.err);
  expect_in("try: path.method = \"spherical\"", outcome.err);
  EXPECT_EQ(names_in(work() / "truss"), run_outputs);
}

TEST_F(ProgramTest, ConstantLoadsThatNothingCarriesGiveStatus4) {
  const Outcome outcome = shell(
      "cp truss.toml ../heavy.toml; "
      "printf '[[load]]\\nat = \"top\"\\nforce = [0.0, -1e300]\\nconstant = true\\n' >>../heavy.toml; "
      "\"$PROGRAM\" run ../heavy.toml");
  EXPECT_EQ(outcome.status, 4);
  expect_in("no equilibrium at the start", outcome.err);
  EXPECT_TRUE(wrote_nothing());
}

TEST_F(ProgramTest, AFolderOfAnotherDeckIsKept) {
  ASSERT_EQ(run("truss.toml --out results").status, 0);
  ASSERT_EQ(shell("cp truss.toml other.toml").status, 0);
  const std::string before = content(work() / "results" / "result.json");

  const Outcome refused = run("other.toml --out results");
  EXPECT_EQ(refused.status, 5);
  expect_in("--force", refused.err);
  EXPECT_EQ(content(work() / "results" / "result.json"), before);

  EXPECT_EQ(run("truss.toml --out results").status, 0);
  EXPECT_EQ(run("other.toml --out results --force").status, 0);
  EXPECT_EQ(Json::parse(content(work() / "results" / "result.json"))["deck"]["file"], "other.toml");
}

// A deck is known by its place and its text.
TEST_F(ProgramTest, AnotherDeckWithTheSameFileNameDoesNotReplaceResults) {
  ASSERT_EQ(shell("mkdir a b moved; cp truss.toml a/deck.toml; (cat truss.toml; echo '# other') >b/deck.toml; "
                  "cp a/deck.toml moved/deck.toml")
                .status,
            0);
  ASSERT_EQ(run("run a/deck.toml --out results --quiet").status, 0);
  const Json of_a = Json::parse(content(work() / "results" / "result.json"))["deck"];
  EXPECT_EQ(of_a["path"], fs::canonical(work() / "a" / "deck.toml").string());

  for (const char* dry : {"", " --dry-run"}) {
    const Outcome refused = run("run b/deck.toml --out results --quiet" + std::string(dry));
    EXPECT_EQ(refused.status, 5) << refused.err;
    expect_in(of_a["path"], refused.err);
    expect_in("--out", refused.err);
    expect_in("--force", refused.err);
  }
  EXPECT_EQ(Json::parse(content(work() / "results" / "result.json"))["deck"], of_a);

  const Outcome again = run("run a/deck.toml --out results --quiet");
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(again.err.find("replaced"), std::string::npos) << again.err;
  EXPECT_EQ(run("run moved/deck.toml --out results --quiet").status, 0) << "the same text elsewhere";
  EXPECT_EQ(run("run a/deck.toml --out results --quiet").status, 0);
  ASSERT_EQ(shell("echo '# edited' >>a/deck.toml").status, 0);
  EXPECT_EQ(run("run a/deck.toml --out results --quiet").status, 0) << "the same file, edited";

  const Outcome forced = run("run b/deck.toml --out results --quiet --force");
  EXPECT_EQ(forced.status, 0);
  expect_in("note: results: the results of " + of_a["path"].get<std::string>() + " are replaced", forced.err);
}

TEST_F(ProgramTest, ARunThatHasNotEndedIsKnownByTheDeckOfItsCheckpoint) {
  ASSERT_EQ(shell("mkdir a b; cp truss.toml a/deck.toml; (cat truss.toml; echo '# other') >b/deck.toml").status, 0);
  ASSERT_EQ(run("run a/deck.toml --out results --quiet --max-points 3").status, 6);
  ASSERT_EQ(shell("find results -type f ! -name checkpoint -delete").status, 0);
  EXPECT_EQ(run("run b/deck.toml --out results --quiet").status, 5);
  EXPECT_EQ(run("run a/deck.toml --out results --quiet").status, 0);
}

TEST_F(ProgramTest, WhatCannotBeWrittenGivesStatus5) {
  EXPECT_EQ(run("truss.toml --out truss.toml/results").status, 5);
  EXPECT_EQ(run("truss.toml --out truss.toml").status, 5);
  EXPECT_EQ(run("examples truss --out truss.toml").status, 5);
  EXPECT_EQ(run("examples truss --out gone/truss.toml").status, 5);
  EXPECT_EQ(shell("\"$PROGRAM\" examples truss >/dev/full").status, 5);
  EXPECT_TRUE(wrote_nothing());
}

// No file may grow beyond 512 bytes.
TEST_F(ProgramTest, ADiskThatIsFullKeepsTheFilesOfTheEarlierRun) {
  ASSERT_EQ(run("truss.toml --max-points 3").status, 6);
  const auto contents = [&] {
    std::map<std::string, std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(work() / "truss"))
      if (entry.is_regular_file()) result[entry.path()] = content(entry.path());
    return result;
  };
  const auto before = contents();

  const Outcome outcome = shell("ulimit -f 1; \"$PROGRAM\" truss.toml --max-points 4");

  EXPECT_EQ(outcome.status, 5);
  expect_in("cannot be written: File too large", outcome.err);
  EXPECT_EQ(contents(), before);
}

TEST_F(ProgramTest, LinesThatNobodyReadsEndTheRunWithStatus5AndWhatWasTraced) {
  const Outcome outcome = shell("{ \"$PROGRAM\" truss.toml --json" + endless + "; echo $? >status; } | head -n 1");

  EXPECT_EQ(content(work() / "status"), "5\n");
  expect_in("error: standard output cannot be written\n", outcome.err);
  EXPECT_EQ(json_lines(outcome.out).size(), 1u);
  EXPECT_EQ(names_in(work() / "truss"), run_outputs);
  const Json end = Json::parse(content(work() / "truss" / "events.json"))["events"].back();
  EXPECT_EQ(end["reason"], "interrupted");
  EXPECT_EQ(end["detail"], "standard output can no longer be written");
  EXPECT_EQ(Json::parse(content(work() / "truss" / "result.json"))["status"], 5);
}

TEST_F(ProgramTest, LinesForAFullDeviceEndTheRunWithStatus5AndWhatWasTraced) {
  const Outcome outcome = shell("\"$PROGRAM\" truss.toml --json" + endless + " >/dev/full");

  EXPECT_EQ(outcome.status, 5);
  expect_in("error: standard output cannot be written\n", outcome.err);
  EXPECT_EQ(names_in(work() / "truss"), run_outputs);
}

TEST_F(ProgramTest, ExamplesAreListedAndRight) {
  const Outcome list = run("examples");
  ASSERT_EQ(list.status, 0);
  for (const char* name : {"arch", "cantilever", "channel", "cylinder", "foundation", "lee", "thick", "truss"}) {
    expect_in(std::string("\n") + name + " ", list.out);
    ASSERT_EQ(shell("\"$PROGRAM\" examples " + std::string(name) + " >deck.toml").status, 0);
    EXPECT_EQ(run("deck.toml --quiet --out " + std::string(name)).status, 0) << name;
  }
}

TEST_F(ProgramTest, VerifyConfirmsARunAndNamesWhatDoesNotHold) {
  ASSERT_EQ(run("run truss.toml --quiet").status, 0);
  const Outcome confirmed = run("verify truss");
  EXPECT_EQ(confirmed.status, 0) << confirmed.err;
  expect_in("forces balance at nodes", confirmed.out);
  expect_in("checks passed.\n\nnot checked:", confirmed.out);
  EXPECT_EQ(run("verify truss --quiet").out, "");

  std::string path = content(work() / "truss" / "path.csv");
  path.replace(path.find("\n0,2,") + 5, 2, "7.");  // the arc of step 2
  put(work() / "truss" / "path.csv", path);
  const Outcome refuted = run("verify truss");
  EXPECT_EQ(refuted.status, 7);
  expect_in("truss/path.csv: branch 0, step 2: path.csv matches the states: arc: ", refuted.err);
  EXPECT_EQ(refuted.err.find("failed:"), std::string::npos) << refuted.err;
  EXPECT_EQ(refuted.out, "");

  path.replace(path.find("\n0,3,") + 5, 2, "7.");
  put(work() / "truss" / "path.csv", path);
  expect_in("failed: path.csv matches the states, 2 of ", run("verify truss").err);

  EXPECT_EQ(run("verify nowhere").status, 5);
  fs::remove(work() / "truss" / "path.csv");
  EXPECT_EQ(run("verify truss").status, 5);
}

TEST_F(ProgramTest, ARunThatNothingEndsIsWarnedOfAndSaysWhoseLimitItMet) {
  ASSERT_EQ(shell("grep -v -e '^w = ' -e 'path.stop' truss.toml >endless.toml").status, 0);
  const Outcome checked = run("check endless.toml");
  EXPECT_EQ(checked.status, 0);
  expect_in("warning: no bound in [path.stop] ends the path", checked.err);
  const Outcome endless = run("run endless.toml --quiet --no-pictures");
  EXPECT_EQ(endless.status, 6);
  expect_in("warning: no bound in [path.stop] ends the path", endless.err);
  expect_in("(max_points), which is the default; ", endless.err);
  const Outcome bounded = run("run endless.toml --quiet --no-pictures --set path.max_points=9");
  EXPECT_EQ(bounded.status, 6);
  EXPECT_EQ(bounded.err.find("warning"), std::string::npos) << bounded.err;
  expect_in("(max_points), as the deck has it; ", bounded.err);
}

TEST_F(ProgramTest, VerifyTracesARunAgainWithAQuarterOfTheStep) {
  ASSERT_EQ(run("run truss.toml --quiet").status, 0);
  const Outcome confirmed = run("verify truss --again");
  EXPECT_EQ(confirmed.status, 0) << confirmed.err;
  expect_in("with a quarter of the step: ", confirmed.out);
  expect_in("forces balance at nodes", confirmed.out);
  EXPECT_EQ(run("verify truss --again --quiet").out, "");
}

TEST_F(ProgramTest, VerifyTakesRunsThatWereStopped) {
  ASSERT_EQ(run("run truss.toml --quiet --max-points 7").status, 6);
  const Outcome outcome = run("verify truss");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(run("verify truss --again --quiet").status, 0) << "what it would have met later is no difference";
}

}  // namespace
}  // namespace arcwall::program_test
