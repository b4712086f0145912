#include <gtest/gtest.h>

#include <algorithm>

#include "tests/apps/cli/program_fixture.hpp"

// Runs that were stopped, and how they go on.
namespace arcwall::resume_test {
namespace {

namespace fs = std::filesystem;

TEST_F(ProgramTest, LimitsOnPointsAndTimeGiveStatus6AndWhatWasTraced) {
  EXPECT_EQ(run("truss.toml --max-points 3").status, 6);
  const std::string csv = content(work() / "truss" / "path.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);

  EXPECT_EQ(run("truss.toml --max-time 1e-9").status, 6);
  const Json result = Json::parse(content(work() / "truss" / "result.json"));
  EXPECT_EQ(result["status"], 6);
  EXPECT_EQ(result["branches"][0]["end"]["reason"], "max_time");
}

TEST_F(ProgramTest, ResumeGoesOnBehindALimit) {
  ASSERT_EQ(run("truss.toml --out whole").status, 0);
  const Outcome stopped = run("truss.toml --quiet --max-points 3");
  EXPECT_EQ(stopped.status, 6);
  expect_in("trace-path resume truss", stopped.err);
  EXPECT_EQ(run("resume truss --max-points 4 --quiet").status, 6);
  const std::string csv = content(work() / "truss" / "path.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 7);
  const Outcome ended = run("resume truss");
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.out, content(work() / "whole" / "events.txt"));
  const Outcome again = run("resume truss --quiet");
  EXPECT_EQ(again.status, 0);
  expect_in("nothing is left to trace", again.err);
  for (const char* name : {"path.csv", "events.json", "deck.toml", "checkpoint", "report.html"})
    EXPECT_EQ(content(work() / "truss" / name), content(work() / "whole" / name)) << name;
}

// The C library and OpenBLAS are told that the processor is an old one. What differs by more than 1e-12 of its column's
// greatest value would be more than last bits.
TEST_F(ProgramTest, ResumeOnAnotherProcessorAgreesToTwelveDigits) {
  const std::string other =
      "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2_Usable,-AVX2,-AVX512F OPENBLAS_CORETYPE=Prescott ";
  for (const std::string deck : {"lee", "lattice"}) {
    ASSERT_EQ(run("examples " + deck + " --out deck.toml").status, 0);
    ASSERT_EQ(run("run deck.toml --out whole --quiet --no-pictures").status, 0);
    EXPECT_EQ(run("run deck.toml --out part --quiet --no-pictures --max-points 20").status, 6);
    EXPECT_EQ(shell(other + "\"$PROGRAM\" resume part --quiet --no-pictures").status, 0);
    const auto whole = table(content(work() / "whole" / "path.csv")),
               part = table(content(work() / "part" / "path.csv"));
    ASSERT_EQ(whole.size(), part.size()) << deck;
    for (std::size_t column = 0; column < whole[0].size(); ++column) {
      double greatest = 0.0;
      for (std::size_t i = 1; i < whole.size(); ++i)
        greatest = std::max(greatest, std::abs(std::strtod(whole[i][column].c_str(), nullptr)));
      for (std::size_t i = 1; i < whole.size(); ++i) {
        const std::string &a = whole[i][column], &b = part[i][column];
        if (a != b) {
          EXPECT_NEAR(std::stod(a), std::stod(b), 1e-12 * greatest) << deck << " " << whole[0][column] << " " << i;
        }
      }
    }
    fs::remove_all(work() / "whole");
    fs::remove_all(work() / "part");
    fs::remove(work() / "deck.toml");
  }
}

TEST_F(ProgramTest, ResumeWithoutAWholeCheckpointGivesStatus5) {
  expect_in("no such folder", run("resume nowhere").err);
  EXPECT_EQ(run("resume nowhere").status, 5);
  EXPECT_EQ(run("resume .").status, 5);
  ASSERT_EQ(run("truss.toml --quiet").status, 0);
  const std::string bytes = content(work() / "truss" / "checkpoint");
  put(work() / "truss" / "checkpoint", bytes.substr(0, bytes.size() / 2));
  const Outcome outcome = run("resume truss");
  EXPECT_EQ(outcome.status, 5);
  expect_in("truss/checkpoint: is damaged", outcome.err);
}

// Each point once, in whichever call it was traced.
TEST_F(ProgramTest, JsonOfAResumedRunGoesOnBehindThatBefore) {
  const Outcome whole = run("truss.toml --json --out whole");
  const Outcome first = run("truss.toml --json --max-points 5"), second = run("resume truss --json");
  std::vector<Json> parts = json_lines(first.out), expected = json_lines(whole.out);
  std::erase_if(parts, [](const Json& line) {
    return line.contains("end") || (line.contains("event") && line["event"]["kind"] == "end");
  });
  for (const Json& line : json_lines(second.out)) parts.push_back(line);
  EXPECT_EQ(parts, expected);
}

TEST_F(ProgramTest, AnInterruptedRunWritesWhatItHas) {
  const Outcome outcome =
      shell("\"$PROGRAM\" truss.toml --quiet" + endless + " & child=$!; sleep 0.5; kill -TERM $child; wait $child");
  EXPECT_EQ(outcome.status, 130);
  EXPECT_EQ(names_in(work() / "truss"), run_outputs);
  EXPECT_EQ(Json::parse(content(work() / "truss" / "events.json"))["events"].back()["reason"], "interrupted");
  expect_in("trace-path resume truss goes on", outcome.err);
}

// Killed before its first point.
TEST_F(ProgramTest, AFolderWithNothingButWhatAKilledRunWasWritingIsUsed) {
  fs::create_directory(work() / "truss");
  put(work() / "truss" / ".probe.1234", "");
  put(work() / "truss" / ".checkpoint.1234", "half");
  EXPECT_EQ(run("truss.toml --quiet").status, 0);
  EXPECT_EQ(names_in(work() / "truss"), run_outputs);
}

// A killed run leaves a checkpoint and perhaps what it was writing.
TEST_F(ProgramTest, AFolderOfAKilledRunOfTheSameDeckIsUsedAgain) {
  const Outcome killed = shell(
      "\"$PROGRAM\" truss.toml --quiet --checkpoint-pause 0 --set path.max_step=1e-8 --set path.min_step=1e-12 & "
      "child=$!; until [ -e truss/checkpoint ]; do sleep 0.01; done; kill -KILL $child; wait $child");
  EXPECT_EQ(killed.status, 128 + 9);
  put(work() / "truss" / ".checkpoint.1234", "half");
  fs::create_directory(work() / "truss" / "shapes");
  put(work() / "truss" / "shapes" / ".0007.vtu.1234", "half");
  put(work() / "truss" / ".mine.1234", "kept");
  ASSERT_EQ(shell("cp truss.toml other.toml").status, 0);
  EXPECT_EQ(run("other.toml --out truss").status, 5);
  EXPECT_EQ(run("truss.toml --quiet").status, 0);
  std::set<std::string> expected = run_outputs;
  expected.insert(".mine.1234");
  EXPECT_EQ(names_in(work() / "truss"), expected);
  EXPECT_EQ(names_in(work() / "truss" / "shapes").count(".0007.vtu.1234"), 0u);
}

TEST_F(ProgramTest, ARunThatCouldGoOnIsNotReplacedWithoutAWord) {
  ASSERT_EQ(run("run truss.toml --max-points 3").status, 6);
  expect_in(
      "note: truss holds a run of this deck that had not ended (3 points); it is traced anew. `trace-path resume "
      "truss` would have continued it",
      run("run truss.toml --max-points 3").err);
  EXPECT_EQ(run("run truss.toml --max-points 3 --set path.step=0.01").err.find("holds a run"), std::string::npos);
  ASSERT_EQ(run("run truss.toml").status, 0);
  EXPECT_EQ(run("run truss.toml").err, "");
}

}  // namespace
}  // namespace arcwall::resume_test
