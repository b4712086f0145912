#include "apps/sweep/sweep_file.hpp"

#include <gtest/gtest.h>

#include "apps/sweep/case_list.hpp"
#include "core/error.hpp"

namespace arcwall::sweep::sweep_file_test {
namespace {

const std::string head = "title = \"t\"\ndeck = \"d.toml\"\n";

std::string problems_of(const std::string& text) {
  try {
    read_sweep_text(text, "s.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> names(const Sweep& sweep) {
  std::vector<std::string> result;
  for (const Key& key : sweep.keys) result.push_back(key.name);
  return result;
}

TEST(SweepFile, KeysAreDottedOrQuotedOrNested) {
  const Sweep sweep = read_sweep_text(head +
                                          "[grid]\n\"wall.0.profile.z\" = [0.1, 0.2]\npath.step = [1]\n"
                                          "[grid.member.column]\nfrom = [\"a\", \"b\"]\n",
                                      "s.toml");
  EXPECT_EQ(names(sweep), (std::vector<std::string>{"wall.0.profile.z", "path.step", "member.column.from"}));
  EXPECT_EQ(sweep.rows.size(), 4u);
  EXPECT_EQ(sweep.keys[0].position.line, 4);
}

TEST(SweepFile, AGridTakesListsAndRanges) {
  const Sweep sweep = read_sweep_text(
      head +
          "[grid]\na.b = { from = 10, to = 40, count = 4 }\nc = { from = 1, to = 100, count = 3, spacing = \"log\" }\n",
      "s.toml");
  ASSERT_EQ(sweep.rows.size(), 12u);
  EXPECT_EQ(sweep.rows[4], (std::vector<Json>{20, 10}));
  EXPECT_TRUE(sweep.rows[4][0].is_number_integer());
}

TEST(SweepFile, AListHasItsRows) {
  const Sweep sweep =
      read_sweep_text(head + "[[list]]\na.b = 1\nc = \"x\"\n[[list]]\nc = \"y\"\na.b = 2.5\n", "s.toml");
  EXPECT_EQ(sweep.rows, (std::vector<std::vector<Json>>{{1, "x"}, {2.5, "y"}}));
}

TEST(SweepFile, AHypercubeIsThatOfItsSeed) {
  const Sweep sweep = read_sweep_text(
      head + "[latin_hypercube]\nsamples = 5\nseed = 3\n[latin_hypercube.ranges]\na.b = { from = 0.0, to = 1.0 }\n",
      "s.toml");
  EXPECT_EQ(sweep.rows, latin_hypercube({{.from = 0.0, .to = 1.0}}, 5, 3));
}

TEST(SweepFile, TiedKeysFollow) {
  const Sweep sweep = read_sweep_text(
      head + "[grid]\na.b = [1.0, 2.5]\n[tie]\nc.d = { to = \"a.b\", factor = -2.0, offset = 1.0 }\n", "s.toml");
  const std::vector<Case> list = cases(sweep, "d.toml");
  EXPECT_EQ(assignments(list[1]), (std::vector<std::string>{"a.b=2.5", "c.d=-4"}));
}

TEST(SweepFile, EveryErrorIsReportedAtOnceWithItsLine) {
  EXPECT_EQ(problems_of("title = 1\ndec = \"d.toml\"\n[grid]\na.b = 5\nc = []\ne = { from = 1, to = 1, count = 1 }\n"
                        "f = { from = -1, to = 1, count = 3, spacing = \"log\", step = 1 }\n"
                        "[tie]\ng = { to = \"a.d\" }\nc = { to = \"e\", factor = \"x\" }\n"),
            "s.toml:1:1: deck: is missing; add deck\n"
            "s.toml:1:9: title: 1 is of the wrong type; give text in quotes\n"
            "s.toml:2:1: dec: \"dec\" is not a key of this table; did you mean deck?\n"
            "s.toml:4:7: grid.a.b: 5 does not say which values; give a list, or { from, to, count }\n"
            "s.toml:5:5: grid.c: the list is empty; give at least one value\n"
            "s.toml:6:22: grid.e.to: is the same as from; give two ends that differ\n"
            "s.toml:6:33: grid.e.count: 1 is out of range; give an integer of at least 2 and at most 1000000\n"
            "s.toml:7:47: grid.f.spacing: \"log\" needs two ends of one sign, other than 0; use \"linear\"\n"
            "s.toml:7:54: grid.f.step: \"step\" is not a key of this table; known are from, to, spacing, count\n"
            "s.toml:9:12: tie.g.to: \"a.d\" is not varied; did you mean a.b?\n"
            "s.toml:10:1: tie.c: is varied itself; vary it or tie it\n"
            "s.toml:10:26: tie.c.factor: \"x\" is of the wrong type; give a number");
}

TEST(SweepFile, OneWayToVaryKeysIsWanted) {
  EXPECT_NE(problems_of(head).find("no key is varied; give one of [grid], [[list]] and [latin_hypercube]"),
            std::string::npos);
  EXPECT_NE(problems_of(head + "[grid]\na = [1]\n[[list]]\na = 1\n").find("more than one way"), std::string::npos);
  for (const char* empty : {"[grid]\n", "[[list]]\n", "[latin_hypercube]\nsamples = 2\nseed = 1\nranges = {}\n"})
    EXPECT_NE(problems_of(head + empty).find("varies no key"), std::string::npos) << empty;
}

TEST(SweepFile, RowsOfAListHaveTheSameKeys) {
  EXPECT_EQ(problems_of(head + "[[list]]\na = 1\nb = 2\n[[list]]\na = 1\nc = 3\n"),
            "s.toml:6:1: list.1: has no b; give each row the same keys\n"
            "s.toml:8:1: list.1.c: is not in the first row; give each row the same keys");
}

TEST(SweepFile, WhatCannotBeAValueIsRefused) {
  EXPECT_NE(problems_of(head + "[grid]\na = [1979-05-27]\n").find("is no value of a deck"), std::string::npos);
  EXPECT_NE(problems_of(head + "[grid]\na = [nan]\n").find("is not a finite number"), std::string::npos);
  EXPECT_NE(problems_of(head + "[grid]\na = [1]\n\"a\" = [2]\n"), "");
  EXPECT_NE(problems_of(head + "[grid]\na.b = [1]\n\"a.b\" = [2]\n").find("is there twice"), std::string::npos);
  EXPECT_NE(problems_of(head + "[grid]\na = [\"x\"]\n[tie]\nb = { to = \"a\" }\n").find("values that are no numbers"),
            std::string::npos);
}

TEST(SweepFile, NoSweepIsLargerThanCanBeMeant) {
  EXPECT_NE(
      problems_of(head + "[grid]\na = { from = 0, to = 1, count = 1000 }\nb = { from = 0, to = 1, count = 1001 }\n")
          .find("more than 1000000 cases"),
      std::string::npos);
}

TEST(CaseList, ValuesAreWrittenAsInToml) {
  EXPECT_EQ(toml_text(Json::parse(R"({"type": "flat", "z": 0.1, "x y": [1, true, "a\"b"]})")),
            R"({ type = "flat", z = 0.1, "x y" = [1, true, "a\"b"] })");
  EXPECT_EQ(toml_text(0.1), "0.1");
  EXPECT_EQ(toml_text(100000), "100000");
}

}  // namespace
}  // namespace arcwall::sweep::sweep_file_test
