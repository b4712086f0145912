#include <filesystem>
#include <regex>

#include "tests/apps/cli/program_fixture.hpp"

// What `trace-path verify` finds in a folder somebody has edited.
namespace arcwall::copies_test {
namespace {

namespace fs = std::filesystem;

class EditedFolder : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    ASSERT_EQ(run("examples channel --out channel.toml").status, 0);
    ASSERT_EQ(
        run("run channel.toml --out whole --quiet --no-pictures --max-points 20 --set member.column.elements=8").status,
        6);
    ASSERT_EQ(run("verify whole --quiet").status, 0);
  }

  // The first failure of a copy in which the first match of a pattern is replaced.
  std::string verdict(const std::string& file, const std::string& pattern, const std::string& by) const {
    fs::remove_all(work() / "edited");
    fs::copy(work() / "whole", work() / "edited", fs::copy_options::recursive);
    const std::string before = content(work() / "edited" / file);
    const std::string behind =
        std::regex_replace(before, std::regex(pattern), by, std::regex_constants::format_first_only);
    EXPECT_NE(before, behind) << pattern << " is not in " << file;
    put(work() / "edited" / file, behind);
    const Outcome outcome = run("verify edited");
    EXPECT_EQ(outcome.status, 7) << file << ": " << pattern << outcome.err;
    return outcome.err;
  }
};

// Changes of contact among them, whose kinds, walls and places single states do not tell where contact slides.
TEST_F(EditedFolder, EveryEditOfEventsIsFound) {
  // The list of changes of contact tells these two as well, and is looked at first.
  expect_in("edited/events.json: ", verdict("events.json", "contact-closes", "limit-point"));
  expect_in("edited/events.json: ", verdict("events.json", "\"upper\"", "\"lower\""));
  expect_in("kind is \"turning-point\" instead of \"start\"", verdict("events.json", "\"start\"", "\"turning-point\""));
  expect_in("fraction", verdict("events.json", "\"fraction\": 0.5", "\"fraction\": 0.25"));
  expect_in("events.json repeats the run: event 0.residual",
            verdict("events.json", "\"residual\": ", "\"residual\": 7"));
  expect_in("lambda_uncertainty", verdict("events.json", "\"lambda_uncertainty\": ", "\"lambda_uncertainty\": 1"));
  expect_in("reason is \"stop\" instead of \"max_points\"", verdict("events.json", "\"max_points\"", "\"stop\""));
  expect_in("instead of \"20 points\"", verdict("events.json", "20 points", "21 points"));
  expect_in("mirror_image is true instead of false",
            verdict("events.json", "\"mirror_image\": false", "\"mirror_image\": true"));
  expect_in("remark is more than the run has",
            verdict("events.json", "\"mirror_image\"", "\"remark\": 1, \"mirror_image\""));
  expect_in("residual is missing", verdict("events.json", "\"residual\": [^,]*,", ""));
}

// Such values ended in an internal error.
TEST_F(EditedFolder, ValuesOfAnotherKindAreFound) {
  for (const auto& [pattern, by] :
       std::vector<std::pair<std::string, std::string>>{{"\"kind\": \"start\"", "\"kind\": {}"},
                                                        {"\"step\": 0", "\"step\": true"},
                                                        {"\"id\": 0", "\"id\": [0]"},
                                                        {"\"lambda\": \\[[^\\]]*\\]", "\"lambda\": 3"},
                                                        {"\"lambda\": [0-9.e+-]+,", ""},
                                                        {"\"monitors\": \\{[^}]*\\}", "\"monitors\": null"},
                                                        {"\"wall\": \"upper\"", "\"wall\": 7"},
                                                        {"\"events\": \\[", "\"events\": [[], \"x\", "}})
    expect_in("edited/events.json: ", verdict("events.json", pattern, by));
}

TEST_F(EditedFolder, EveryEditOfTheResultIsFound) {
  expect_in("result.json repeats the run: status", verdict("result.json", "\"status\": 6", "\"status\": 0"));
  expect_in("result.json repeats the run: counts.iterations",
            verdict("result.json", "\"iterations\": ", "\"iterations\": 1"));
  expect_in("deck.crc32 is", verdict("result.json", "\"crc32\": \"[^\"]*\"", "\"crc32\": \"00000000\""));
  expect_in("deck.set", verdict("result.json", "elements=8", "elements=80"));
  expect_in("branches[0].end.reason is", verdict("result.json", "\"max_points\"", "\"stop\""));
  expect_in("it cannot be read", verdict("result.json", "\\{", ""));
}

TEST_F(EditedFolder, EveryEditOfTheDeckIsFound) {
  expect_in("deck.toml equals the deck: it is not the deck of the checkpoint with its defaults",
            verdict("deck.toml", "elements = 8", "elements = 9"));
}

// They differ from run to run.
TEST_F(EditedFolder, TimesAndVersionsMayBeOthers) {
  const std::string text = content(work() / "whole" / "result.json");
  put(work() / "whole" / "result.json", std::regex_replace(text, std::regex("\"total\": "), "\"total\": 1"));
  EXPECT_EQ(run("verify whole --quiet").status, 0);
}

}  // namespace
}  // namespace arcwall::copies_test
