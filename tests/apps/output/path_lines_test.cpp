#include "apps/output/path_lines.hpp"

#include <gtest/gtest.h>

namespace arcwall::path_lines_test {
namespace {

// Points of one branch with these stabilities.
Record record_of(const std::vector<Stability>& stabilities) {
  Record record;
  record.branches.push_back({.points = static_cast<Index>(stabilities.size())});
  for (std::size_t i = 0; i < stabilities.size(); ++i)
    record.points.push_back({.step = static_cast<Index>(i), .count = {.stability = stabilities[i]}});
  return record;
}

RecordEvent event(Index step, std::optional<Index> before, std::optional<Index> after) {
  return {.kind = EventKind::limit_point, .step = step, .unstable_before = before, .unstable_after = after};
}

void expect_line(const PathLine& line, Stability stability, std::size_t first, std::size_t last) {
  EXPECT_EQ(line.stability, stability);
  EXPECT_EQ(line.first, first);
  EXPECT_EQ(line.last, last);
}

TEST(PathLines, ABranchOfOneKindIsOneLine) {
  const auto lines = path_lines(record_of({Stability::stable, Stability::stable, Stability::stable}));
  ASSERT_EQ(lines.size(), 1u);
  expect_line(lines[0], Stability::stable, 0, 2);
}

// A limit point is singular itself; the line before it is stable, the one behind it is not.
TEST(PathLines, AnEventPartsTheLines) {
  Record record = record_of({Stability::stable, Stability::undecided, Stability::unstable});
  record.events.push_back(event(1, 0, 1));

  const auto lines = path_lines(record);

  ASSERT_EQ(lines.size(), 2u);
  expect_line(lines[0], Stability::stable, 0, 1);
  expect_line(lines[1], Stability::unstable, 1, 2);
}

// Between two events no point says what holds there; at a corner with two events the first tells what was before.
TEST(PathLines, BetweenEventsTheyTellWhatHolds) {
  Record record = record_of({Stability::stable, Stability::undecided, Stability::undecided, Stability::stable});
  record.events = {event(1, 0, 2), event(2, 2, std::nullopt), event(2, std::nullopt, 0)};

  const auto lines = path_lines(record);

  ASSERT_EQ(lines.size(), 3u);
  expect_line(lines[0], Stability::stable, 0, 1);
  expect_line(lines[1], Stability::unstable, 1, 2);
  expect_line(lines[2], Stability::stable, 2, 3);
}

TEST(PathLines, WhatNoneKnowsIsUndecided) {
  Record record = record_of({Stability::undecided, Stability::undecided});
  record.events = {event(0, std::nullopt, std::nullopt), event(1, std::nullopt, std::nullopt)};
  ASSERT_EQ(path_lines(record).size(), 1u);
  expect_line(path_lines(record)[0], Stability::undecided, 0, 1);
}

TEST(PathLines, BranchesAreNotJoined) {
  Record record = record_of({Stability::stable, Stability::stable, Stability::stable, Stability::stable});
  record.branches = {{.id = 0, .points = 2}, {.id = 1, .points = 0}, {.id = 2, .points = 2}};
  record.points[2].branch = record.points[3].branch = 2;

  const auto lines = path_lines(record);

  ASSERT_EQ(lines.size(), 2u);
  expect_line(lines[0], Stability::stable, 0, 1);
  expect_line(lines[1], Stability::stable, 2, 3);
  EXPECT_EQ(lines[1].branch, 2);
  EXPECT_EQ(first_points(record), (std::vector<std::size_t>{0, 2, 2, 4}));
  EXPECT_EQ(point_of({.branch = 2, .step = 1}, first_points(record)), 3u);
}

TEST(PathLines, OfNoOrOnePointThereIsNone) {
  EXPECT_TRUE(path_lines({}).empty());
  EXPECT_TRUE(path_lines(record_of({Stability::stable})).empty());
}

}  // namespace
}  // namespace arcwall::path_lines_test
