#include <gtest/gtest.h>

#include <algorithm>

#include "elements/mechanism.hpp"
#include "tests/support/models.hpp"

namespace arcwall::find_mechanism_test {

namespace {

// A portal of three beams, 3 high and 4 wide; hinges at the feet, and where asked for at both corners.
std::unique_ptr<Structure> portal(bool hinged_corners, double unit = 1.0) {
  StructureBuilder builder;
  const Vec2 at[] = {Vec2(0.0, 0.0) * unit, Vec2(0.0, 3.0) * unit, Vec2(4.0, 3.0) * unit, Vec2(4.0, 0.0) * unit};
  for (const Vec2& position : at) builder.add_joint(position);
  for (int i = 0; i < 3; ++i)
    builder.add_member({.name = "beam",
                        .from = i,
                        .to = i + 1,
                        .axis = straight_axis(at[i], at[i + 1]),
                        .section = {.E = 2.1e4, .A = 1.0 * unit * unit, .I = 0.1 * unit * unit * unit * unit},
                        .hinge_from = hinged_corners && i == 1,
                        .hinge_to = hinged_corners && i == 1});
  for (const Index foot : {0, 3})
    for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(foot, which));
  builder.add_load(builder.dof(1, Dof::x), 1.0, LoadKind::proportional);
  return builder.build();
}

// Bars between the given points, each to the next; the first and the last are held.
std::unique_ptr<Structure> bar_chain(const std::vector<Vec2>& at) {
  StructureBuilder builder;
  for (const Vec2& position : at) builder.add_joint(position);
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
    builder.add_member({.name = "bar",
                        .from = static_cast<Index>(i),
                        .to = static_cast<Index>(i) + 1,
                        .axis = straight_axis(at[i], at[i + 1]),
                        .theory = Theory::truss,
                        .section = {.E = 1.0, .A = 1.0}});
  for (const std::size_t end : {std::size_t{0}, at.size() - 1})
    for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(static_cast<Index>(end), which));
  return builder.build();
}

// A straight beam of unit length in members of a few elements each, its axis at some slope; held in x and z at the
// left, and in what is asked for besides.
struct StraightBeam {
  int members = 1, elements = 1;
  double height = 0.1;
  bool clamped = false;    // at the left
  bool supported = false;  // across the axis, at the right
  int hinge = -1;          // behind this member

  std::unique_ptr<Structure> structure() const {
    StructureBuilder builder;
    const auto at = [&](int i) { return Vec2(Vec2(0.6, 0.8) * (double(i) / members)); };
    for (int i = 0; i <= members; ++i) builder.add_joint(at(i));
    for (int i = 0; i < members; ++i)
      builder.add_member({.name = "beam",
                          .from = i,
                          .to = i + 1,
                          .axis = straight_axis(at(i), at(i + 1)),
                          .section = {.E = 1.0, .A = height, .I = height * height * height / 12.0},
                          .elements = elements,
                          .hinge_to = i == hinge});
    for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(0, which));
    if (clamped) builder.fix(*builder.shared_rotation(0));
    if (supported) builder.fix(builder.dof(members, Dof::z));
    return builder.build();
  }
};

// A girder of square panels of bars with one diagonal each, on a pin and a roller.
std::unique_ptr<Structure> girder(int panels, int without_diagonal = -1) {
  StructureBuilder builder;
  std::vector<Vec2> at;
  for (int i = 0; i <= panels; ++i)
    for (const double z : {0.0, 1.0}) at.emplace_back(double(i), z);
  for (const Vec2& position : at) builder.add_joint(position);
  const auto bar = [&](Index a, Index b) {
    builder.add_member({.name = "bar",
                        .from = a,
                        .to = b,
                        .axis = straight_axis(at[static_cast<std::size_t>(a)], at[static_cast<std::size_t>(b)]),
                        .theory = Theory::truss,
                        .section = {.E = 1.0, .A = 1.0}});
  };
  for (Index i = 0; i <= panels; ++i) {
    bar(2 * i, 2 * i + 1);
    if (i == panels) break;
    bar(2 * i, 2 * i + 2);
    bar(2 * i + 1, 2 * i + 3);
    if (i != without_diagonal) bar(2 * i, 2 * i + 3);
  }
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.dof(2 * Index(panels), Dof::z));
  return builder.build();
}

}  // namespace

// How a beam is written down, how finely it is divided and how slender it is are not what makes a mechanism.
TEST(FindMechanism, AStraightBeamIsTheSameInOneMemberAndInMany) {
  for (const int members : {1, 500, 3000})
    for (const int elements : {1, 20})
      for (const double height : {0.1, 1e-7}) {
        const StraightBeam beam{.members = members, .elements = elements, .height = height};
        StraightBeam clamped = beam, pinned = beam;
        clamped.clamped = true;
        pinned.supported = true;
        EXPECT_TRUE(find_mechanism(*beam.structure())) << members << " members";
        EXPECT_FALSE(find_mechanism(*clamped.structure())) << members << " members";
        EXPECT_FALSE(find_mechanism(*pinned.structure())) << members << " members";
      }
}

TEST(FindMechanism, OneHingeAmongManyMembersIsFound) {
  StraightBeam beam{.members = 400, .supported = true, .hinge = 100};
  const auto mechanism = find_mechanism(*beam.structure());
  ASSERT_TRUE(mechanism.has_value());
  EXPECT_EQ(mechanism->dof, Dof::rotation);  // both parts turn about their ends, the shorter one more
  EXPECT_LE(mechanism->node, 101);
  beam.clamped = true;
  EXPECT_FALSE(find_mechanism(*beam.structure()));
}

TEST(FindMechanism, AGirderOfManyBarsNeedsAllItsDiagonalsSlow) {
  for (const int panels : {4, 40, 400}) {
    EXPECT_FALSE(find_mechanism(*girder(panels))) << panels << " panels";
    EXPECT_TRUE(find_mechanism(*girder(panels, panels / 2))) << panels << " panels";
  }
}

TEST(FindMechanism, APortalWithFourHingesSways) {
  for (const double unit : {1.0, 100.0, 0.01}) {
    const auto mechanism = find_mechanism(*portal(true, unit));
    ASSERT_TRUE(mechanism.has_value());
    // Sway moves both corners by the same; rotations of the columns are a third of it per unit of length.
    EXPECT_TRUE(mechanism->node == 1 || mechanism->node == 2);
    EXPECT_EQ(mechanism->dof, Dof::x);
  }
}

TEST(FindMechanism, APortalWithRigidCornersStands) {
  for (const double unit : {1.0, 100.0, 0.01}) EXPECT_FALSE(find_mechanism(*portal(false, unit)).has_value());
}

TEST(FindMechanism, AStraightChainOfTwoBarsMovesAcross) {
  const auto mechanism = find_mechanism(*bar_chain({{0.0, 0.0}, {1.0, 0.0}, {2.5, 0.0}}));
  ASSERT_TRUE(mechanism.has_value());
  EXPECT_EQ(mechanism->node, 1);
  EXPECT_EQ(mechanism->dof, Dof::z);
}

TEST(FindMechanism, ABentChainOfTwoBarsStandsAndOneOfThreeMoves) {
  EXPECT_FALSE(find_mechanism(*bar_chain({{0.0, 0.0}, {1.0, 0.3}, {2.0, 0.0}})).has_value());
  EXPECT_TRUE(find_mechanism(*bar_chain({{0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}, {3.0, 0.0}})).has_value());
}

TEST(FindMechanism, AStructureThatIsHeldNowhereMoves) {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(1.0, 0.0);
  builder.add_joint(a);
  builder.add_joint(b);
  builder.add_member(
      {.name = "m", .from = 0, .to = 1, .axis = straight_axis(a, b), .section = {.E = 1.0, .A = 1.0, .I = 1.0}});
  EXPECT_TRUE(find_mechanism(*builder.build()).has_value());
}

TEST(FindMechanism, SoundModelsHaveNone) {
  EXPECT_FALSE(find_mechanism(*test::lee_frame(5)).has_value());
  EXPECT_FALSE(find_mechanism(*test::deep_arch(1)).has_value());
  for (const int order : {4, 6})
    EXPECT_FALSE(find_mechanism(*test::lee_frame(5, {.theory = Theory::elastica, .order = order})).has_value());
  EXPECT_FALSE(find_mechanism(*test::williams_toggle(1)).has_value());
  EXPECT_FALSE(find_mechanism(*test::VonMisesTruss{}.structure()).has_value());
  EXPECT_FALSE(find_mechanism(*test::Cantilever{.elements = 1, .tip_force = 1.0}.structure()).has_value());
}

namespace {

// One beam element between joints at 0 and at 2 on the x axis.
StructureBuilder free_beam() {
  StructureBuilder builder;
  builder.add_joint({0.0, 0.0});
  builder.add_joint({2.0, 0.0});
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis({0.0, 0.0}, {2.0, 0.0}),
                      .section = {.E = 1.0, .A = 1.0, .I = 1.0}});
  return builder;
}

}  // namespace

// A beam that is held in x at one end moves in z at both, and by turning; two springs leave it nothing.
TEST(FreeDirections, AreThoseOfAllMotions) {
  for (const bool sprung : {false, true}) {
    StructureBuilder builder = free_beam();
    builder.fix(builder.dof(0, Dof::x));
    if (sprung)
      for (const Index end : {0, 1}) builder.add_ground_stiffness(builder.dof(end, Dof::z), 1e-3);
    const std::vector<NodeDirection> free = free_directions(*builder.build(), {0, 1}).all;
    ASSERT_EQ(free.size(), sprung ? 0u : 2u);
    for (const NodeDirection& one : free) EXPECT_EQ(one.dof, Dof::z);
  }
}

// A free beam has three motions, and both ends move in x and z: three directions hold it, and leave its length alone.
TEST(FreeDirections, AreHeldByAsManyAsThereAreMotions) {
  StructureBuilder builder = free_beam();
  const FreeDirections free = free_directions(*builder.build(), {0, 1});
  EXPECT_EQ(free.all.size(), 4u);
  ASSERT_EQ(free.fewest.size(), 3u);
  EXPECT_EQ(
      std::count_if(free.fewest.begin(), free.fewest.end(), [](const NodeDirection& one) { return one.dof == Dof::x; }),
      1);
  for (const NodeDirection& one : free.fewest) builder.add_ground_stiffness(builder.dof(one.node, one.dof), 1e-3);
  EXPECT_FALSE(find_mechanism(*builder.build()));
  EXPECT_TRUE(free_directions(*builder.build(), {0, 1}).fewest.empty());
}

// A beam on one hinge turns about it, unless a spring holds its other end or its rotation.
TEST(FindMechanism, SpringsToTheGroundHold) {
  for (const int springs : {0, 1, 2}) {
    StructureBuilder builder;
    builder.add_joint({0.0, 0.0});
    builder.add_joint({2.0, 1.0});
    builder.add_member({.name = "beam",
                        .from = 0,
                        .to = 1,
                        .axis = straight_axis({0.0, 0.0}, {2.0, 1.0}),
                        .section = {.E = 1.0, .A = 1.0, .I = 1.0},
                        .elements = 3});
    for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(0, which));
    if (springs == 1) builder.add_ground_stiffness(builder.dof(1, Dof::z), 1e-3);
    if (springs == 2) builder.add_ground_stiffness(builder.shared_rotation(0).value(), 1e-3);
    EXPECT_EQ(find_mechanism(*builder.build()).has_value(), springs == 0) << springs;
  }
}

}  // namespace arcwall::find_mechanism_test
