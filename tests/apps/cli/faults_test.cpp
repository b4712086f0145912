#include <gtest/gtest.h>

#include "tests/apps/cli/program_fixture.hpp"

/// What surrounds the program may be hostile: other processes, files that are none, a lack of memory.
namespace arcwall::faults_test {
namespace {

namespace fs = std::filesystem;

class FaultsTest : public ProgramTest {
 protected:
  /// Nothing here may wait for ever: the status is 124 if it did.
  Outcome run_soon(const std::string& arguments) const { return shell("timeout 20 \"$PROGRAM\" " + arguments); }

  void expect_file_error(const std::string& arguments, const std::string& sentence) const {
    const Outcome outcome = run_soon(arguments);
    EXPECT_EQ(outcome.status, 5) << arguments << "\n" << outcome.err;
    expect_in(sentence, outcome.err);
  }

  /// A planned sweep of two cases in `study`.
  void plan_study() const {
    std::ofstream(work() / "sweep.toml")
        << "title = \"two\"\ndeck = \"truss.toml\"\n[grid]\n\"path.step\" = [1.0, 2.0]\n";
    ASSERT_EQ(run("sweep plan sweep.toml --out study").status, 0);
  }
};

TEST_F(FaultsTest, ASecondRunIntoAFolderEndsWithTheProcessOfTheFirst) {
  const Outcome outcome =
      shell("\"$PROGRAM\" run truss.toml --quiet --checkpoint-pause 0" + endless +
            " & first=$!; until [ -e truss/checkpoint ]; do sleep 0.02; done; "
            "\"$PROGRAM\" run truss.toml; second=$?; \"$PROGRAM\" resume truss; third=$?; "
            "\"$PROGRAM\" report truss; fourth=$?; kill -KILL $first; wait $first; "
            "\"$PROGRAM\" resume truss --max-points 3 --quiet; echo $first $second $third $fourth $?");
  std::istringstream words(outcome.out);
  std::string first, second, third, fourth, last;
  words >> first >> second >> third >> fourth >> last;
  EXPECT_EQ(second + third + fourth, "555");
  EXPECT_EQ(last, "6") << "after the kill the folder is free";
  expect_in("truss: process " + first + " is writing into this folder", outcome.err);
}

// Of 100 such pairs 27 failed, and 6 ended well twice with files of both.
TEST_F(FaultsTest, OfTwoRunsAtOnceOneOrBothAreWhole) {
  for (int pair = 0; pair < 3; ++pair) {
    const Outcome outcome = shell(
        "rm -rf truss; \"$PROGRAM\" run truss.toml --quiet & first=$!; \"$PROGRAM\" run truss.toml --quiet; second=$?; "
        "wait $first; echo $? $second; \"$PROGRAM\" verify truss --quiet; echo $?");
    EXPECT_TRUE(outcome.out == "0 5\n0\n" || outcome.out == "5 0\n0\n" || outcome.out == "0 0\n0\n")
        << outcome.out << outcome.err;
    EXPECT_EQ(names_in(work() / "truss"), run_outputs);
  }
}

TEST_F(FaultsTest, ACheckpointThatIsNoFileIsRefusedAtOnce) {
  ASSERT_EQ(run("run truss.toml --quiet").status, 0);
  const std::vector<std::pair<std::string, std::string>> kinds{
      {"mkfifo truss/checkpoint", "is a pipe where a file is expected"},
      {"ln -s /dev/zero truss/checkpoint", "is a device where a file is expected"},
      {"mkdir truss/checkpoint", "is a folder where a file is expected"},
      {"truncate -s 1T truss/checkpoint", "bytes, more than the"}};
  for (const auto& [make, sentence] : kinds) {
    ASSERT_EQ(shell("rm -rf truss/checkpoint && " + make).status, 0);
    for (const char* command : {"resume truss", "report truss", "verify truss"}) expect_file_error(command, sentence);
  }
}

TEST_F(FaultsTest, TablesThatAreNoFilesAreRefusedAtOnce) {
  ASSERT_EQ(run("run truss.toml --quiet").status, 0);
  ASSERT_EQ(shell("rm truss/path.csv && mkfifo truss/path.csv").status, 0);
  expect_file_error("verify truss", "path.csv: is a pipe where a file is expected");
}

// Without its result.json the folder is known by the checkpoint, which is none.
TEST_F(FaultsTest, AFolderWithAPipeIsSomebodyElses) {
  ASSERT_EQ(shell("mkdir truss && mkfifo truss/checkpoint").status, 0);
  expect_file_error("run truss.toml", "is not empty, and not filled by this program");
}

TEST_F(FaultsTest, ACaseListThatHoldsNoCaseIsRefused) {
  plan_study();
  for (const char* make : {": >study/cases.jsonl", "rm study/cases.jsonl; mkfifo study/cases.jsonl",
                           "rm study/cases.jsonl; mkdir study/cases.jsonl"}) {
    ASSERT_EQ(shell(make).status, 0);
    for (const char* command : {"sweep collect study", "sweep emit study --engine slurm", "sweep run study"})
      expect_file_error(command, "study/cases.jsonl: ");
  }
}

TEST_F(FaultsTest, FilesOfTheUserInShapesStay) {
  ASSERT_EQ(run("run truss.toml --quiet").status, 0);
  put(work() / "truss" / "shapes" / "view.pvsm", "hours of work");
  ASSERT_EQ(run("run truss.toml --quiet --no-pictures").status, 0);
  EXPECT_EQ(names_in(work() / "truss" / "shapes"), std::set<std::string>{"view.pvsm"});
}

TEST_F(FaultsTest, ADeckIsNotWrittenOver) {
  ASSERT_EQ(shell("mkdir here && cp truss.toml here/deck.toml").status, 0);
  const std::string before = content(work() / "here" / "deck.toml");
  for (const char* command : {"run here/deck.toml --out here --force", "converge here/deck.toml --out here --force"}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    expect_in("here/deck.toml: would be written over by here/deck.toml; name another folder with --out", outcome.err);
  }
  EXPECT_EQ(content(work() / "here" / "deck.toml"), before);
}

TEST_F(FaultsTest, SignalsOfTerminalsAndBatchSystemsEndARunWithACheckpoint) {
  for (const char* signal : {"HUP", "XCPU", "USR1"}) {
    const Outcome outcome = shell("rm -rf truss; \"$PROGRAM\" run truss.toml --quiet --checkpoint-pause 0" + endless +
                                  " & run=$!; until [ -e truss/checkpoint ]; do sleep 0.02; done; kill -" + signal +
                                  " $run; wait $run; echo $?");
    EXPECT_EQ(outcome.out, "130\n") << signal << outcome.err;
  }
}

// Named as slow, since sanitizers need more addresses than the test leaves.
TEST_F(FaultsTest, MemoryThatRunsOutHasASentenceAndAStatusSlow) {
  const Outcome outcome =
      shell("ulimit -v 200000; \"$PROGRAM\" run truss.toml --set member.left.elements=3000000 --quiet");
  EXPECT_EQ(outcome.status, 8) << outcome.err;
  expect_in("error: memory ran out", outcome.err);
  expect_in("trace-path resume", outcome.err);
}

// A limit of no bytes for files stands for a full disk. The shell is in the group of the program.
TEST_F(FaultsTest, ACaseThatCannotBeWrittenEndsNoOtherProcess) {
  plan_study();
  for (const char* how : {"", " --records"}) {
    const Outcome outcome =
        shell("timeout 20 setsid -w bash -c 'trap \"\" XFSZ; ulimit -f 0; \"$1\" sweep run study --quiet" +
              std::string(how) + "; exit $((10 + $?))' bash \"$PROGRAM\"");
    EXPECT_EQ(outcome.status, 15) << "the shell goes on behind the program\n" << outcome.err;
  }
  EXPECT_EQ(run_soon("sweep run study --quiet").status, 0);
}

TEST_F(FaultsTest, ALinkInPlaceOfTheFolderOfACaseIsNotFollowed) {
  plan_study();
  ASSERT_EQ(shell("mkdir -p precious/deep study/cases; echo mine >precious/thesis.tex; echo mine >precious/deep/data; "
                  "ln -s ../../precious study/cases/.00000")
                .status,
            0);
  expect_file_error("sweep run study --quiet", "study/cases/.00000: is a link");
  EXPECT_EQ(names_in(work() / "precious"), (std::set<std::string>{"deep", "thesis.tex"}));
  EXPECT_EQ(content(work() / "precious" / "deep" / "data"), "mine\n");
  ASSERT_EQ(
      shell("rm study/cases/.00000; mkdir study/cases/.00000; ln -s ../../../precious study/cases/.00000/old").status,
      0);
  EXPECT_EQ(run_soon("sweep run study --quiet").status, 0);
  EXPECT_EQ(names_in(work() / "precious"), (std::set<std::string>{"deep", "thesis.tex"}))
      << "what is emptied may have links in it";
}

TEST_F(FaultsTest, ALinkInPlaceOfTheFolderOfShapesIsNotFollowed) {
  ASSERT_EQ(shell("mkdir -p precious truss; echo mine >precious/0000.vtu; echo mine >precious/9999.vtu; "
                  "ln -s ../precious truss/shapes")
                .status,
            0);
  for (const char* pictures : {"", " --no-pictures"})
    expect_file_error("run truss.toml --force --quiet" + std::string(pictures), "truss/shapes: is a link");
  EXPECT_EQ(content(work() / "precious" / "0000.vtu"), "mine\n");
  EXPECT_EQ(names_in(work() / "precious"), (std::set<std::string>{"0000.vtu", "9999.vtu"}));
}

// g++ destroys members twice where a later initialiser of an aggregate throws.
TEST_F(FaultsTest, AWrongOptionBesideOneThatIsRightIsRefusedInWords) {
  for (const char* wrong : {"--max-time 0", "--max-points 0", "--max-points x", "--checkpoint-pause -1"}) {
    const Outcome outcome = run("run truss.toml --set path.step=1.0 " + std::string(wrong));
    EXPECT_EQ(outcome.status, 2) << wrong << "\n" << outcome.err;
    expect_in(std::string(wrong).substr(0, std::string(wrong).find(' ')), outcome.err);
  }
}

TEST_F(FaultsTest, OddEventsOfACaseAreDamageAndNoDefectOfTheProgram) {
  plan_study();
  ASSERT_EQ(run("sweep run study --quiet").status, 0);
  const fs::path file = work() / "study" / "cases" / "00000" / "events.json";
  const Json whole = Json::parse(content(file));
  for (const Json& odd : {Json(), Json(true), Json(7), Json("text"), Json::array({1}), Json::object()}) {
    std::vector<Json> wrong(1, whole);
    wrong.back()["events"][0] = odd;
    for (const char* key : {"kind", "lambda", "monitors"}) {
      if (std::string(key) == "lambda" ? odd.is_number() || odd.is_null()
                                       : std::string(key) == "kind" && odd.is_string())
        continue;
      if (std::string(key) == "monitors" && odd.is_object()) continue;
      wrong.push_back(whole);
      wrong.back()["events"][0][key] = odd;
    }
    for (const Json& json : wrong) {
      std::ofstream(file) << json.dump();
      expect_file_error("sweep collect study", "is damaged");
    }
  }
}

// Nothing is written to a terminal that obeys no escapes; `script` makes one.
TEST_F(FaultsTest, ADumbTerminalGetsNoEscapes) {
  if (shell("command -v script").status != 0) GTEST_SKIP() << "there is no `script`";
  const auto escapes = [&](const std::string& setting) {
    const Outcome outcome = shell("env -u NO_COLOR PROGRAM=\"$PROGRAM\" " + setting +
                                  " script -qec '\"$PROGRAM\" run truss.toml --force' /dev/null");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out.find('\x1b') != std::string::npos;
  };
  EXPECT_TRUE(escapes("TERM=xterm"));
  EXPECT_FALSE(escapes("TERM=dumb"));
  EXPECT_FALSE(escapes("TERM=xterm NO_COLOR=1"));
}

}  // namespace
}  // namespace arcwall::faults_test
