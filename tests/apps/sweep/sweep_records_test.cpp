#include <nlohmann/json.hpp>

#include "apps/sweep/collection.hpp"
#include "apps/sweep/runner.hpp"
#include "tests/apps/cli/program_fixture.hpp"

// Sweeps whose results are lines of a file in place of folders.
namespace arcwall::sweep::sweep_records_test {
namespace {

namespace fs = std::filesystem;

class SweepRecordsTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    put(work() / "sweep.toml",
        "title = \"Bars\"\ndeck = \"truss.toml\"\n[grid]\nmaterial.bar.E = [5e4, 1e5, 2e5]\nsection.bar.A = [1, 2]\n");
    ASSERT_EQ(run("sweep plan sweep.toml --out study").status, 0);
  }

  fs::path study() const { return work() / "study"; }
  fs::path records() const { return study() / "results" / "0-of-1.jsonl"; }

  std::string tables() const {
    EXPECT_EQ(run("sweep collect study").status, 0);
    return content(study() / "cases.csv") + content(study() / "sweep.csv");
  }

  // What folders would say.
  std::string tables_of_folders() const {
    EXPECT_EQ(shell("cp -r study whole; rm -rf whole/results whole/cases; \"$PROGRAM\" sweep run whole --quiet; "
                    "\"$PROGRAM\" sweep collect whole")
                  .status,
              0);
    return content(work() / "whole" / "cases.csv") + content(work() / "whole" / "sweep.csv");
  }
};

TEST_F(SweepRecordsTest, TablesAreThoseOfFolders) {
  ASSERT_EQ(run("sweep run study --records --jobs 2").status, 0);
  EXPECT_TRUE(names_in(study() / "cases").empty());
  EXPECT_EQ(names_in(study() / "results"), std::set<std::string>{"0-of-1.jsonl"});
  EXPECT_EQ(tables(), tables_of_folders());
  expect_in("6 of 6 cases completed, 6 of them as the deck asks", run("sweep status study").out);
}

// A sweep whose results are records gives it to its cases by itself, so that each case was told that it had it twice.
TEST_F(SweepRecordsTest, ScratchMayBeGivenToCases) {
  ASSERT_EQ(run("sweep run study --records -- --scratch").status, 0);
  expect_in("6 of 6 cases completed, 6 of them as the deck asks", run("sweep status study").out);
}

TEST_F(SweepRecordsTest, EachShareHasAFileOfItsOwn) {
  ASSERT_EQ(run("sweep run study --records --part 0/2").status, 0);
  expect_in("3 of 6 cases completed", run("sweep status study").out);
  ASSERT_EQ(run("sweep run study --records --part 1/2").status, 0);
  EXPECT_EQ(names_in(study() / "results"), (std::set<std::string>{"0-of-2.jsonl", "1-of-2.jsonl"}));
  expect_in("0 of them new", run("sweep run study --records").out);
  EXPECT_EQ(tables(), tables_of_folders());
}

// Killed while it wrote: what has no end of its line is no record.
TEST_F(SweepRecordsTest, HalfALineIsCutOffAndItsCaseRunAgain) {
  ASSERT_EQ(run("sweep run study --records --quiet").status, 0);
  const std::string whole = content(records());
  for (const std::size_t cut : {std::size_t{1}, std::size_t{300}}) {
    put(records(), whole.substr(0, whole.size() - cut));
    expect_in("5 of 6 cases completed", run("sweep status study").out);
    expect_in("1 of them new", run("sweep run study --records").out);
    EXPECT_EQ(content(records()), whole);
  }
}

TEST_F(SweepRecordsTest, DamagedRecordsAreNamed) {
  ASSERT_EQ(run("sweep run study --records --quiet").status, 0);
  const std::string whole = content(records());
  put(records(), "nonsense\n" + whole);
  Outcome outcome = run("sweep collect study");
  EXPECT_EQ(outcome.status, 5);
  expect_in("line 1 is damaged; remove the line, and the case is run again", outcome.err);
  std::string bad = whole;
  bad.replace(bad.find("\"reason\""), 8, "\"reasno\"");
  put(records(), bad);
  outcome = run("sweep collect study");
  EXPECT_EQ(outcome.status, 5);
  expect_in("is damaged; run the case again with --force", outcome.err);
  ASSERT_EQ(run("sweep run study --records --quiet --case 0 --force").status, 0);
  EXPECT_EQ(tables(), tables_of_folders());
}

TEST_F(SweepRecordsTest, TwoProcessesDoNotWriteOneFile) {
  ASSERT_EQ(run("sweep run study --records --quiet --case 0").status, 0);
  const Outcome outcome = shell(
      "flock study/results/0-of-1.jsonl sleep 0.3 & until ! flock --nonblock study/results/0-of-1.jsonl true; do "
      "sleep 0.01; done; \"$PROGRAM\" sweep run study --records; status=$?; wait; exit $status");
  EXPECT_EQ(outcome.status, 5);
  expect_in("another process is running these cases; share them among several with --part I/N", outcome.err);
}

TEST_F(SweepRecordsTest, CasesAreRunAgainThatFailedOrAllOfThem) {
  EXPECT_EQ(run("sweep run study --records --quiet -- --max-points 3").status, 3);
  expect_in("max_points      6", run("sweep collect study").out);
  expect_in("0 of them new", run("sweep run study --records").out);
  expect_in("6 of them new", run("sweep run study --records --failed").out);
  expect_in("0 of them new", run("sweep run study --records --failed").out);
  EXPECT_EQ(tables(), tables_of_folders());
  expect_in("1 of 1 cases completed, 1 of them new", run("sweep run study --records --case 2 --force").out);
  EXPECT_EQ(tables(), tables_of_folders());
}

// As of a full disk.
TEST_F(SweepRecordsTest, WhatHinderedACaseIsNoResult) {
  put(work() / "stand-in", "#!/bin/sh\nexit 5\n");
  fs::permissions(work() / "stand-in", fs::perms::owner_all);
  const RunRequest request{.folder = study(), .program = work() / "stand-in", .keep = Keep::records};
  EXPECT_EQ(run_cases(request, {}, Rerun::none, [](const RunCounts&) {}).failed, 6);
  expect_in("file_error      6", run("sweep collect study").out);
  expect_in("6 of 6 cases completed, 6 of them new", run("sweep run study --records").out);
  EXPECT_EQ(tables(), tables_of_folders());
}

// Two hundred by two hundred cases: tables have every case, the page half of them, each as it is. λ is e + 100 a.
TEST_F(SweepRecordsTest, OfManyCasesSomeAreDrawnAsTheyAreSlow) {
  const Outcome made = shell(
      "mkdir -p study/results; python3 -c '\nimport json\n"
      "cases, results = open(\"study/cases.jsonl\", \"w\"), open(\"study/results/0-of-1.jsonl\", \"w\")\n"
      "for n in range(40000):\n"
      "  e, a = n // 200 + 1, n % 200 + 1\n"
      "  json.dump({\"case\": n, \"set\": {\"material.bar.E\": e, \"section.bar.A\": a}, \"deck\": \"truss.toml\"}, "
      "cases)\n"
      "  cases.write(\"\\n\")\n"
      "  events = [{\"id\": 0, \"kind\": \"limit-point\", \"branch\": 0, \"step\": 1, \"arc\": 1.0, \"lambda\": e + "
      "100 * a, "
      "\"monitors\": {}, \"unstable_before\": 0, \"unstable_after\": 1}]\n"
      "  json.dump({\"case\": n, \"round\": 0, \"kind\": \"result\", \"status\": 0, \"reason\": \"stop\", \"detail\": "
      "\"\", "
      "\"counts\": {}, \"events\": events}, results, separators=(\",\", \":\"))\n"
      "  results.write(\"\\n\")\n' && \"$PROGRAM\" sweep collect study");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(table(content(study() / "cases.csv")).size(), 40001u);
  const std::string page = content(study() / "report.html");
  const std::size_t begin = page.find("id=\"data\">") + 10, end = page.find("</script>", begin);
  EXPECT_LT(end - begin, 2'000'000u);
  const auto data = nlohmann::json::parse(page.substr(begin, end - begin));
  EXPECT_EQ(data.at("ran"), 40000);
  const auto& cases = data.at("cases");
  const std::size_t drawn = cases.at("number").size();
  EXPECT_NEAR(static_cast<double>(drawn), 20000.0, 10.0);
  std::vector<int> of_rows(200, 0), of_columns(200, 0);
  for (std::size_t i = 0; i < drawn; ++i) {
    const int e = cases.at("values").at(0).at(i), a = cases.at("values").at(1).at(i);
    EXPECT_EQ(cases.at("loads").at(0).at(i), e + 100 * a);
    ++of_rows[static_cast<std::size_t>(e - 1)];
    ++of_columns[static_cast<std::size_t>(a - 1)];
  }
  // No row and no column of the grid is left out: each has about half of its cases.
  for (const auto& counts : {of_rows, of_columns})
    for (const int count : counts) EXPECT_NEAR(count, 100, 10);
}

// No folder for each of very many cases, though nobody has asked for records.
TEST_F(SweepRecordsTest, VeryManyCasesAreRecords) {
  ASSERT_EQ(
      shell("for n in $(seq 6 20000); do echo '{\"case\":'$n',\"set\":{\"material.bar.E\":1e5,\"section.bar.A\":1},"
            "\"deck\":\"truss.toml\"}'; done >>study/cases.jsonl")
          .status,
      0);
  expect_in("1 of 1 cases completed, 1 of them new", run("sweep run study --case 20000").out);
  EXPECT_EQ(names_in(study() / "results"), std::set<std::string>{"0-of-1.jsonl"});
}

}  // namespace
}  // namespace arcwall::sweep::sweep_records_test
