#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/output/temporary_folder.hpp"

namespace arcwall {

/// What a program did.
struct Outcome {
  int status = -1;  ///< -1: a signal ended it
  std::string out{}, err{};
};

/// The built program, as a user runs it, in a folder with the deck truss.toml.
class ProgramTest : public testing::Test {
 protected:
  /// Arguments as in a shell, in the folder `work`.
  Outcome run(const std::string& arguments) const { return shell("\"$PROGRAM\" " + arguments); }

  Outcome shell(const std::string& script) const {
    const std::string command = "cd '" + work().string() + "' && PROGRAM='" TRACE_PATH_PROGRAM "' && { " + script +
                                "; } >../out 2>../err </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(folder_ / "out"), content(folder_ / "err")};
  }

  void SetUp() override {
    std::filesystem::create_directory(work());
    ASSERT_EQ(run("examples truss --out truss.toml").status, 0);
    before_ = names_in(work());
  }

  std::filesystem::path work() const { return folder_ / "work"; }
  bool wrote_nothing() const { return names_in(work()) == before_; }

 private:
  TemporaryFolder folder_;
  std::set<std::string> before_;
};

/// What a run of a deck without walls writes.
inline const std::set<std::string> run_outputs{"branches.json", "checkpoint", "deck.toml",   "events.json",
                                               "events.txt",    "path.csv",   "report.html", "result.json",
                                               "shapes",        "shapes.pvd"};

/// Steps so small that the run would take minutes.
inline const std::string endless =
    " --set path.max_step=1e-8 --set path.min_step=1e-12 --set path.max_points=100000000";

using Json = nlohmann::json;

/// The objects of a text with one a line.
inline std::vector<Json> json_lines(const std::string& text) {
  std::vector<Json> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(Json::parse(line));
  return result;
}

/// Cells of a table without quotes.
inline std::vector<std::vector<std::string>> table(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    rows.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

inline void expect_in(const std::string& part, const std::string& text) {
  EXPECT_NE(text.find(part), std::string::npos) << "no \"" << part << "\" in\n" << text;
}

}  // namespace arcwall
