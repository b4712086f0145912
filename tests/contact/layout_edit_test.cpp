#include "contact/sliding/layout_edit.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "elements/sliding_structure.hpp"
#include "tests/support/models.hpp"

namespace arcwall::layout_edit_test {

namespace {

using sliding::divide_beside_waiting;
using sliding::divide_evenly;
using sliding::LayoutEdit;

constexpr double length = 3.0;

// A straight beam along x, for which 15 elements are asked.
std::unique_ptr<SlidingStructure> beam() {
  StructureBuilder builder;
  MemberDescription member{.name = "beam", .section = {.E = 100.0, .A = 1.0, .I = 0.1, .height = 0.2}, .elements = 15};
  member.from = builder.add_joint({0.0, 0.0});
  member.to = builder.add_joint({length, 0.0});
  member.axis = straight_axis({0.0, 0.0}, {length, 0.0});
  builder.add_member(std::move(member));
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.shared_rotation(0).value());
  return builder.build_sliding();
}

LayoutEdit open_edit(const SlidingBody& body) {
  LayoutEdit edit{.body = body};
  edit.elements.push_back({MeshSegment(15)});
  edit.handed_on.emplace_back();
  return edit;
}

std::size_t insert_waiting(LayoutEdit& edit, double s) {
  const int undivided = edit.undivided_at(0, s);
  const std::size_t point = edit.insert({.point = {.undivided = undivided}, .s = s}, undivided, undivided);
  divide_beside_waiting(edit);
  return point;
}

void insert_closed(LayoutEdit& edit, double s, int before, int behind) {
  edit.insert({.point = {}, .s = s, .closed = true, .force = 1.0}, before, behind);
}

void erase(LayoutEdit& edit, std::size_t point) {
  edit.erase(point, edit.elements_without(point));
  divide_beside_waiting(edit);
}

std::vector<int> elements(const LayoutEdit& edit) {
  std::vector<int> numbers;
  for (const MeshSegment& segment : edit.elements.front()) numbers.push_back(segment.elements);
  return numbers;
}

using Numbers = std::vector<int>;

}  // namespace

TEST(LayoutEdit, PointsThatHaveOnlyWaitedLeaveTheMeshAsItWas) {
  const auto body = beam();
  LayoutEdit edit = open_edit(*body);
  insert_waiting(edit, 1.5);
  EXPECT_EQ(elements(edit), (Numbers{8, 8})) << "halves alike";
  insert_waiting(edit, 0.6);
  EXPECT_EQ(elements(edit), (Numbers{3, 5, 8})) << "of 15, not of 16";
  insert_waiting(edit, 2.45);
  erase(edit, 1);
  EXPECT_EQ(elements(edit), (Numbers{3, 9, 3}));
  erase(edit, 0);
  erase(edit, 0);
  EXPECT_EQ(elements(edit), Numbers{15});
}

TEST(LayoutEdit, APointThatSlidesWhileItWaitsLeavesTheMeshAsItWas) {
  const auto body = beam();
  LayoutEdit edit = open_edit(*body);
  const std::size_t point = insert_waiting(edit, 0.2);
  EXPECT_EQ(elements(edit), (Numbers{1, 14}));
  edit.place(point) = 2.0;
  divide_evenly(edit);
  EXPECT_EQ(elements(edit), (Numbers{10, 5}));
  erase(edit, point);
  EXPECT_EQ(elements(edit), Numbers{15});
}

TEST(LayoutEdit, WhatATouchFindsDependsOnItsPlaceAlone) {
  const auto body = beam();
  LayoutEdit early = open_edit(*body), late = open_edit(*body);
  const std::size_t point = insert_waiting(early, 1.5);
  early.place(point) = 1.1;
  divide_beside_waiting(early);
  insert_waiting(late, 1.1);
  for (LayoutEdit* edit : {&early, &late}) {
    edit->touch(point);
    divide_evenly(*edit);
    EXPECT_EQ(elements(*edit), (Numbers{6, 10}));
    EXPECT_FALSE(edit->points[point].waits());
  }
}

TEST(LayoutEdit, APartBesideAWaitingPointTakesTheNumberOfOneThatIsAboutAsLong) {
  const auto body = beam();
  LayoutEdit edit = open_edit(*body);
  insert_closed(edit, 1.0, 7, 10);
  insert_waiting(edit, 2.0);
  EXPECT_EQ(elements(edit), (Numbers{7, 7, 7})) << "that of the part beside no such point, which does not change";
  erase(edit, 1);
  EXPECT_EQ(elements(edit), (Numbers{7, 10}));
}

TEST(LayoutEdit, PartsThatAreJoinedKeepWhatTheyHaveWithoutTheirWaitingPoints) {
  const auto body = beam();
  LayoutEdit edit = open_edit(*body);
  insert_closed(edit, 1.0, 5, 10);
  insert_waiting(edit, 0.25);
  insert_waiting(edit, 2.25);
  edit.erase(1, edit.elements_before(1) + edit.elements_behind(1));
  divide_beside_waiting(edit);
  EXPECT_EQ(edit.undivided_at(0, 1.0), 15);
  erase(edit, 0);
  erase(edit, 0);
  EXPECT_EQ(elements(edit), Numbers{15});
}

TEST(LayoutEdit, AContactInAPartWithWaitingPointsDividesWhatThatHasWithoutThem) {
  const auto body = beam();
  LayoutEdit edit = open_edit(*body);
  insert_waiting(edit, 0.5);
  insert_closed(edit, 2.0, 7, 5);
  divide_beside_waiting(edit);
  erase(edit, 0);
  EXPECT_EQ(elements(edit), (Numbers{10, 5}));
}

}  // namespace arcwall::layout_edit_test
