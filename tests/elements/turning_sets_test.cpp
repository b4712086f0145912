// Which rotations may grow by whole turns while the equations stay what they are.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "core/turns.hpp"
#include "elements/sliding_structure.hpp"
#include "elements/structure.hpp"
#include "tests/support/essenburg_models.hpp"

namespace arcwall::turning_sets_test {
namespace {

struct Frame {
  StructureBuilder builder{};
  Index first = 0, second = 0;  // members
};

// Two members around a rigid corner, from a hinge on the left to a free end.
Frame frame(Theory theory, int order) {
  Frame frame;
  const Vec2 foot(0.0, 0.0), corner(1.0, 0.5), end(2.0, 0.5);
  for (const Vec2& place : {foot, corner, end}) frame.builder.add_joint(place);
  const auto add = [&](const char* name, Index from, Index to, const Vec2& a, const Vec2& b) {
    return frame.builder.add_member({.name = name,
                                     .from = from,
                                     .to = to,
                                     .axis = straight_axis(a, b),
                                     .theory = theory,
                                     .order = order,
                                     .section = test::essenburg_section(100.0, 0.3, 0.2, 0.2),
                                     .elements = 3});
  };
  frame.first = add("first", 0, 1, foot, corner);
  frame.second = add("second", 1, 2, corner, end);
  frame.builder.fix(frame.builder.dof(0, Dof::x));
  frame.builder.fix(frame.builder.dof(0, Dof::z));
  return frame;
}

// All that may act along a slender member, and a moment.
void load(Frame& frame) {
  frame.builder.add_distributed_load(frame.first, {0.3, -0.2}, LoadKind::proportional);
  frame.builder.add_distributed_load(frame.second, {0.1, 0.4}, LoadKind::constant, LoadFrame::member);
  frame.builder.add_pressure(frame.first, {.constant = 0.2, .proportional = 0.1});
  frame.builder.add_pressure(frame.second, {.constant = 0.2, .proportional = 0.1});
  frame.builder.add_foundation(frame.second, Vec2(0.7, 0.9));
  frame.builder.add_thermal_strain(frame.first, {.strain = {.proportional = 0.01}, .curvature = {.constant = 0.1}});
  frame.builder.add_load(frame.builder.shared_rotation(2).value(), 0.5, LoadKind::proportional);
}

std::map<Index, std::vector<Index>> by_set(const std::vector<Index>& sets) {
  std::map<Index, std::vector<Index>> unknowns;
  for (std::size_t i = 0; i < sets.size(); ++i)
    if (sets[i] >= 0) unknowns[sets[i]].push_back(static_cast<Index>(i));
  return unknowns;
}

Vector residual(const Equations& system, const State& state) {
  Vector F(state.x.size());
  system.residual(state, F);
  return F;
}

// By how much F changes, at most, where unknowns grow by 2π.
double change_by_a_turn(const Equations& system, const State& state, const std::vector<Index>& unknowns) {
  State turned = state;
  for (const Index i : unknowns) turned.x[i] += 2.0 * pi;
  return (residual(system, turned) - residual(system, state)).cwiseAbs().maxCoeff();
}

State somewhere(const Structure& structure) {
  State state{.x = Vector(structure.size({})), .lambda = 0.7, .active_set = {}};
  for (Index i = 0; i < state.x.size(); ++i) state.x[i] = 0.1 * std::sin(3.0 * double(i) + 1.0);
  return state;
}

constexpr double roundoff = 1e-12;

}  // namespace

TEST(TurningSets, AreSingleRotationsOfSlenderMembers) {
  for (const auto& [theory, order] :
       {std::pair(Theory::euler_bernoulli, 2), {Theory::elastica, 4}, {Theory::elastica, 6}}) {
    Frame described = frame(theory, order);
    load(described);
    const auto structure = described.builder.build();
    const State state = somewhere(*structure);
    const auto sets = by_set(structure->metric({}).turning_sets);
    EXPECT_EQ(sets.size(), 7u);  // nodes of two members of three elements
    for (const auto& [set, unknowns] : sets) {
      EXPECT_EQ(unknowns.size(), 1u);
      EXPECT_LT(change_by_a_turn(*structure, state, unknowns), roundoff * residual(*structure, state).norm());
    }
  }
}

// The exact theory interpolates rotations: all of a frame turn together.
TEST(TurningSets, AreAllRotationsTogetherOfExactMembers) {
  for (const int order : {1, 2}) {
    const auto structure = frame(Theory::reissner, order).builder.build();
    const State state = somewhere(*structure);
    const auto sets = by_set(structure->metric({}).turning_sets);
    ASSERT_EQ(sets.size(), 1u);
    const std::vector<Index>& all = sets.begin()->second;
    EXPECT_EQ(all.size(), order == 1 ? 7u : 13u);
    EXPECT_LT(change_by_a_turn(*structure, state, all), roundoff * residual(*structure, state).norm());
    EXPECT_GT(change_by_a_turn(*structure, state, {all.front()}), 1e-3);
  }
}

TEST(TurningSets, LeaveOutWhatASpringOrASupportCounts) {
  Frame described = frame(Theory::elastica, 4);
  StructureBuilder& builder = described.builder;
  const Index foot = builder.shared_rotation(0).value(), corner = builder.shared_rotation(1).value(),
              end = builder.shared_rotation(2).value();
  builder.add_ground_stiffness(foot, 0.4);
  builder.add_spring(corner, end, 0.3);
  const auto structure = builder.build();
  const std::vector<Index> sets = structure->metric({}).turning_sets;
  const auto set_of = [&](Index dof) { return sets[static_cast<std::size_t>(structure->unknown(dof).value())]; };
  EXPECT_EQ(set_of(foot), -1);
  EXPECT_EQ(set_of(corner), set_of(end));
  const State state = somewhere(*structure);
  EXPECT_GT(change_by_a_turn(*structure, state, {structure->unknown(foot).value()}), 1.0);
  for (const auto& [set, unknowns] : by_set(sets)) EXPECT_LT(change_by_a_turn(*structure, state, unknowns), roundoff);

  Frame exact = frame(Theory::reissner, 1);
  exact.builder.fix(exact.builder.shared_rotation(2).value());
  EXPECT_TRUE(by_set(exact.builder.build()->metric({}).turning_sets).empty());
}

TEST(TurningSets, AreThoseOfMeshesThatSlide) {
  Frame described = frame(Theory::elastica, 4);
  load(described);
  const auto structure = described.builder.build_sliding();
  ElementsPerSegment cut(static_cast<std::size_t>(structure->strands()), {MeshSegment(2), MeshSegment(3)});
  const auto mesh = structure->mesh(cut);
  Vector s(mesh->breakpoints());
  for (Index k = 0; k < s.size(); ++k) s[k] = 0.4 * structure->length(mesh->breakpoint(k).first);
  const Vector x = structure->rest(*mesh, s) + 0.05 * Vector::LinSpaced(mesh->unknowns(), -1.0, 1.0);
  const auto F = [&](const Vector& at) {
    Vector value(at.size());
    mesh->residual({.x = at, .s = s, .lambda = 0.7}, value);
    return value;
  };
  const auto sets = by_set(mesh->metric().turning_sets);
  EXPECT_EQ(sets.size(), 11u);
  for (const auto& [set, unknowns] : sets) {
    Vector turned = x;
    for (const Index i : unknowns) turned[i] += 2.0 * pi;
    EXPECT_LT((F(turned) - F(x)).cwiseAbs().maxCoeff(), roundoff * F(x).norm());
  }
}

TEST(TurnedTowards, TakesTheNearestTurnOfEachSet) {
  const Vector x = Eigen::Vector4d(0.1, 0.2, 0.3, 7.0);
  const Vector other = Eigen::Vector4d(0.1 + 4.0 * pi, 0.1 - 2.0 * pi, 0.4 - 2.0 * pi, 0.0);
  const Vector turned = turned_towards(other, x, {0, 5, 5, -1});
  EXPECT_NEAR(turned[0], other[0], 1e-14);
  EXPECT_NEAR(turned[1], 0.2 - 2.0 * pi, 1e-14);
  EXPECT_NEAR(turned[2], 0.3 - 2.0 * pi, 1e-14);
  EXPECT_EQ(turned[3], 7.0);
  EXPECT_EQ(turned_towards(other, x, {}), x);
}

}  // namespace arcwall::turning_sets_test
