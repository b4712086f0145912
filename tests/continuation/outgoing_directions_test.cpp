#include "continuation/corners/outgoing_directions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "continuation/corners/choice.hpp"
#include "tests/support/layout_toys.hpp"
#include "tests/support/toys.hpp"

namespace arcwall::corner_test {

namespace {

using test::LinearContactToy;

ActiveSet open_active_set(const LinearContactToy& toy) {
  return ActiveSet(static_cast<std::size_t>(toy.contact_count()), 0);
}

State origin(const LinearContactToy& toy) {
  return {.x = Vector::Zero(toy.A.rows()), .lambda = 0.0, .active_set = open_active_set(toy)};
}

std::vector<Index> all(const LinearContactToy& toy) {
  std::vector<Index> weak;
  for (Index j = 0; j < toy.contact_count(); ++j) weak.push_back(j);
  return weak;
}

// Gaps are the unknowns themselves: M = A⁻¹, a = A⁻¹ f. Made from M and a.
LinearContactToy rate_problem(const Matrix& M, const Vector& a) {
  LinearContactToy toy;
  toy.A = M.inverse();
  toy.f = toy.A * a;
  toy.G = Matrix::Identity(a.size(), a.size());
  toy.gap0 = Vector::Zero(a.size());
  return toy;
}

// Equilibrium of the rates, and 0 ≤ ṗ ⊥ ġ ≥ 0 for the weak contacts.
void expect_ray(const LinearContactToy& toy, const State& corner, const std::vector<Index>& weak,
                const OutgoingDirection& ray) {
  Linearization now;
  const State there = toy.with_active_set(corner, ray.active_set);
  toy.linearize(there, now);
  ASSERT_EQ(ray.direction.dx.size(), there.x.size());
  const double size = ray.direction.dx.norm() + std::abs(ray.direction.dlambda);
  EXPECT_GT(size, 0.0);
  const Vector rate = test::full(now.K) * ray.direction.dx + now.F_lambda * ray.direction.dlambda;
  EXPECT_LE(rate.norm(), 1e-10 * size * (1.0 + toy.A.norm()));
  const Index n = toy.A.rows();
  for (const Index j : weak) {
    const auto k = toy.multiplier_index(ray.active_set, j);
    const double force = k ? ray.direction.dx[*k] : 0.0, opening = toy.G.row(j).dot(ray.direction.dx.head(n));
    EXPECT_GE(force, -1e-6 * size);
    EXPECT_GE(opening, -1e-6 * size);
    EXPECT_LE(std::min(force, opening), 1e-6 * size);
    EXPECT_EQ(ray.loading[static_cast<std::size_t>(j)] != 0, force > 1e-6 * size);
  }
}

std::vector<OutgoingDirection> rays(const LinearContactToy& toy, const State& corner, const std::vector<Index>& weak,
                                    const CornerOptions& options = {}) {
  CornerWorkspace workspace;
  std::vector<OutgoingDirection> found = outgoing_directions(toy, corner, weak, options, workspace);
  for (const OutgoingDirection& ray : found) expect_ray(toy, corner, weak, ray);
  return found;
}

Index with_rising_lambda(const std::vector<OutgoingDirection>& found) {
  return std::count_if(found.begin(), found.end(),
                       [](const OutgoingDirection& ray) { return ray.direction.dlambda > 0.0; });
}

}  // namespace

TEST(Corner, AStopIsLeftForwardsClosedAndBackwardsOpen) {
  const LinearContactToy toy = test::stopped_springs(2.0);
  const State corner{.x = Vector{{1.0, 1.5}}, .lambda = 1.0, .active_set = {0}};
  const auto found = rays(toy, corner, {0});
  ASSERT_EQ(found.size(), 2U);
  for (const OutgoingDirection& ray : found) {
    const bool forward = ray.direction.dlambda > 0.0;
    EXPECT_EQ(ray.active_set, forward ? ActiveSet{1} : ActiveSet{0});
    // Behind the stop ẋ = (0, 1/k), ṗ = 1; before it ẋ = (1, 1 + 1/k).
    const Vector dx = ray.direction.dx / ray.direction.dlambda;
    EXPECT_NEAR(dx[0], forward ? 0.0 : 1.0, 1e-14);
    EXPECT_NEAR(dx[1], forward ? 0.5 : 1.5, 1e-14);
    if (forward) {
      EXPECT_NEAR(dx[2], 1.0, 1e-14);
    }
  }
}

TEST(Corner, TheSameRaysLeaveFromTheClosedActiveSet) {
  const LinearContactToy toy = test::stopped_springs(2.0);
  const State corner{.x = Vector{{1.0, 1.5, 0.0}}, .lambda = 1.0, .active_set = {1}};
  const auto found = rays(toy, corner, {0});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(with_rising_lambda(found), 1);
}

// A = −1, g = x: off the wall x = −λ, on it p = −λ. Both leave towards falling λ.
TEST(Corner, AnUnstableFreeBranchMakesLambdaTurn) {
  const LinearContactToy toy = rate_problem(-Matrix::Identity(1, 1), -Vector::Ones(1));
  const auto found = rays(toy, origin(toy), {0});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(with_rising_lambda(found), 0);
  EXPECT_NE(found[0].active_set, found[1].active_set);
}

// Two such contacts side by side, each open or closed as it likes: four rays, all towards falling λ.
TEST(Corner, SeveralRaysAreAllFound) {
  const LinearContactToy toy = rate_problem(-Matrix::Identity(2, 2), -Vector::Ones(2));
  const auto found = rays(toy, origin(toy), all(toy));
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(with_rising_lambda(found), 0);
  std::vector<ActiveSet> active_sets;
  for (const OutgoingDirection& ray : found) active_sets.push_back(ray.active_set);
  const std::vector<ActiveSet> expected{{0, 0}, {0, 1}, {1, 0}, {1, 1}};
  EXPECT_TRUE(std::is_permutation(active_sets.begin(), active_sets.end(), expected.begin(), expected.end()));
}

// M = −[1 2; 2 1], a = (1, −1). λ̇ = 1: none closed ġ₂ = −1; 2 closed p₂ = −1; 1 closed p₁ = 1, ġ₂ = −3; both p₁ = −1.
// λ̇ = −1 by symmetry; λ̇ = 0: M p < 0.
TEST(Corner, ThereMayBeNoRay) {
  const LinearContactToy toy = rate_problem(Matrix{{-1.0, -2.0}, {-2.0, -1.0}}, Vector{{1.0, -1.0}});
  EXPECT_TRUE(rays(toy, origin(toy), all(toy)).empty());
}

TEST(Corner, OneOfOppositeContactsThatAreSymmetricOpensAsTheOtherCloses) {
  // Two equal stops in the two directions of a symmetric pair: both close together.
  LinearContactToy toy = rate_problem(Matrix::Identity(2, 2), -Vector::Ones(2));
  const auto found = rays(toy, origin(toy), all(toy));
  ASSERT_EQ(found.size(), 2U);
  for (const OutgoingDirection& ray : found)
    EXPECT_EQ(ray.active_set, ray.direction.dlambda > 0.0 ? (ActiveSet{1, 1}) : (ActiveSet{0, 0}));
}

// One stop named twice: the force may be shared in any way, the motion is one.
TEST(Corner, GuardsThatCoincideGiveEachMotionOnce) {
  LinearContactToy toy = test::stopped_springs(2.0);
  toy.G = toy.G.replicate(2, 1).eval();
  toy.gap0 = Vector::Ones(2);
  const State corner{.x = Vector{{1.0, 1.5}}, .lambda = 1.0, .active_set = {0, 0}};
  const auto found = rays(toy, corner, {0, 1});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(with_rising_lambda(found), 1);
}

TEST(Corner, StronglyClosedContactsHoldMeanwhile) {
  // The stop of the first spring carries 1; the second meets one of its own at x₂ = 2, λ = 2.
  LinearContactToy toy = test::stopped_springs(1.0);
  toy.G = Matrix{{-1.0, 0.0}, {0.0, -1.0}};
  toy.gap0 = Vector{{1.0, 3.0}};
  const State corner{.x = Vector{{1.0, 3.0, 1.0}}, .lambda = 2.0, .active_set = {1, 0}};
  const auto found = rays(toy, corner, {1});
  ASSERT_EQ(found.size(), 2U);
  for (const OutgoingDirection& ray : found) {
    EXPECT_EQ(ray.active_set[0], 1);
    EXPECT_EQ(ray.active_set[1], ray.direction.dlambda > 0.0 ? 1 : 0);
  }
}

// With a positive definite stiffness each direction of λ has one ray.
TEST(Corner, PivotingFindsTheRaysOfEnumerationForManyContacts) {
  test::Numbers numbers(80);
  for (const Index w : {3, 8, 13}) {
    SCOPED_TRACE(w);
    LinearContactToy toy;
    const Matrix B = numbers.matrix(w, w);
    toy.A = B * B.transpose() + Matrix::Identity(w, w);
    toy.f = numbers.vector(w);
    toy.G = numbers.matrix(w, w);
    toy.gap0 = Vector::Zero(w);
    const auto enumerated = rays(toy, origin(toy), all(toy), {.max_enumerated = 20});
    const auto pivoted = rays(toy, origin(toy), all(toy), {.max_enumerated = 0});
    ASSERT_EQ(enumerated.size(), 2U);
    ASSERT_EQ(pivoted.size(), 2U);
    for (const OutgoingDirection& a : pivoted) {
      const auto same = [&](const OutgoingDirection& b) {
        if (a.active_set != b.active_set || a.direction.dlambda * b.direction.dlambda <= 0.0) return false;
        const Vector u = a.direction.dx / a.direction.dlambda, v = b.direction.dx / b.direction.dlambda;
        return (u - v).norm() <= 1e-9 * u.norm();
      };
      EXPECT_EQ(std::count_if(enumerated.begin(), enumerated.end(), same), 1);
    }
  }
}

// A heavy beam on two beds with a trench between them, which next to nothing else resists: that the whole beam moves
// leaves nothing of how it bends in what resists with all contacts open. As λ grows the beds bear all of the weight,
// less what is bent off them beside the trench; as it falls the beam is off both.
TEST(Corner, PivotingHoldsABodyThatOnlyContactsHold) {
  constexpr Index n = 41, middle = 20, trench = 6;
  constexpr double bending = 1e6, spring = 1e-9;
  Matrix D = Matrix::Zero(n - 2, n);
  for (Index i = 0; i < n - 2; ++i) D.row(i).segment<3>(i) << 1.0, -2.0, 1.0;
  LinearContactToy toy;
  toy.A = bending * D.transpose() * D + spring * Matrix::Identity(n, n);
  toy.f = -Vector::Ones(n);
  toy.G = Matrix::Zero(n - 2 * trench + 1, n);
  toy.gap0 = Vector::Zero(toy.G.rows());
  Index contact = 0;
  for (Index i = 0; i < n; ++i)
    if (std::abs(i - middle) >= trench) toy.G(contact++, i) = 1.0;
  const auto found = rays(toy, origin(toy), all(toy));
  ASSERT_EQ(found.size(), 2U);
  for (const OutgoingDirection& ray : found) {
    const auto closed = static_cast<Index>(toy.closed(ray.active_set).size());
    if (ray.direction.dlambda < 0.0) {
      EXPECT_EQ(closed, 0);
      continue;
    }
    expect_ray(toy, origin(toy), all(toy), ray);
    const Vector forces = ray.direction.dx.tail(closed) / ray.direction.dlambda;
    EXPECT_NEAR(forces.sum(), double(n), 1e-6 * double(n));
    EXPECT_GT(closed, 4);
    EXPECT_LT(closed, toy.contact_count());
  }
}

TEST(Corner, MoreThanTwelveWeakContactsAreSolvedByPivotingByDefault) {
  // Independent stops whose gaps open and close in turn.
  constexpr Index w = 15;
  Vector a(w);
  for (Index i = 0; i < w; ++i) a[i] = i % 2 == 0 ? 1.0 : -1.0;
  const LinearContactToy toy = rate_problem(Matrix::Identity(w, w), a);
  const auto found = rays(toy, origin(toy), all(toy));
  ASSERT_EQ(found.size(), 2U);
  for (const OutgoingDirection& ray : found)
    for (Index i = 0; i < w; ++i)
      EXPECT_EQ(ray.active_set[static_cast<std::size_t>(i)] != 0, a[i] * ray.direction.dlambda < 0.0);
}

// A mass without a spring on a stop: it moves off without a load, or is pressed on by one.
TEST(Corner, WhereTheStiffnessIsSingularAGapTakesThePlaceOfTheLoad) {
  LinearContactToy toy;
  toy.A = Matrix::Zero(1, 1);
  toy.f = -Vector::Ones(1);
  toy.G = Matrix::Ones(1, 1);
  toy.gap0 = Vector::Zero(1);
  const auto found = rays(toy, origin(toy), {0});
  ASSERT_EQ(found.size(), 2U);
  for (const OutgoingDirection& ray : found) {
    const bool pressed = ray.loading[0] != 0;
    EXPECT_EQ(ray.direction.dlambda > 1e-12, pressed);
    EXPECT_EQ(ray.direction.dx[0] > 1e-12, !pressed);
  }
}

TEST(Corner, AStiffnessThatIsSingularTwiceGivesNoRays) {
  LinearContactToy toy;
  toy.A = Matrix::Zero(2, 2);
  toy.f = Vector::Ones(2);
  toy.G = Matrix::Identity(1, 2);
  toy.gap0 = Vector::Zero(1);
  CornerWorkspace workspace;
  EXPECT_TRUE(outgoing_directions(toy, origin(toy), {0}, {}, workspace).empty());
}

// A spring s that is next to nothing beside the one to a second mass: on the stop λ presses with a force of its size,
// and off it x = −λ/s.
TEST(Corner, ANearlySingularStiffnessKeepsBothWays) {
  LinearContactToy toy;
  for (const double stiffness : {1e-13, -1e-13}) {
    toy.A = Matrix{{1.0 + stiffness, -1.0}, {-1.0, 1.0}};
    toy.f = Vector{{-1.0, 0.0}};
    toy.G = Matrix{{1.0, 0.0}};
    toy.gap0 = Vector::Zero(1);
    const auto found = rays(toy, origin(toy), {0});
    ASSERT_EQ(found.size(), 2U) << stiffness;
    EXPECT_EQ(with_rising_lambda(found), stiffness < 0.0 ? 2 : 1) << stiffness;
  }
}

// An active set that is left and come back to has another layout, with the same unknowns.
TEST(Corner, APathThatComesBackOnAnotherLayoutIsAClosedLoop) {
  const LinearContactToy toy = rate_problem(Matrix::Identity(2, 2), Vector{{1.0, -1.0}});
  TraceTools tools(toy, TraceOptions{});
  std::vector<VisitedCorner> visited;
  std::optional<BranchEnd> end;
  for (int round = 0; round < 4 && !end; ++round) {
    State corner = origin(toy);
    corner.active_set = ActiveSet(2, 0, std::make_shared<test::NumberedLayout>(round));
    PathPoint at;
    at.state = corner;
    at.tangent = {.dx = Vector::Zero(2), .dlambda = 1.0};
    at.arc = round;
    Choice choice = choose(tools, visited, rays(toy, corner, all(toy)), at, {}, 1.0);
    if (const auto* const found = std::get_if<BranchEnd>(&choice.result)) end = *found;
    remember(visited, std::move(choice.visit));
  }
  ASSERT_TRUE(end.has_value());
  EXPECT_EQ(end->reason, EndReason::closed_loop);
}

// Once all ways that leave a corner are taken a path that comes back to it is a closed loop; one that has not moved
// since has no continuation.
TEST(Corner, APathThatStandsIsNoClosedLoop) {
  const LinearContactToy toy = rate_problem(Matrix::Identity(2, 2), Vector{{1.0, -1.0}});
  const State corner = origin(toy);
  for (const bool stands : {false, true}) {
    TraceTools tools(toy, TraceOptions{});
    PathPoint at;
    at.state = corner;
    at.tangent = {.dx = Vector::Zero(2), .dlambda = 1.0};
    std::vector<VisitedCorner> visited;
    std::optional<BranchEnd> end;
    for (int round = 0; round < 4 && !end; ++round) {
      at.arc = stands ? 0.0 : double(round);
      Choice choice = choose(tools, visited, rays(toy, corner, all(toy)), at, {}, 1.0);
      if (const auto* const found = std::get_if<BranchEnd>(&choice.result)) end = *found;
      remember(visited, std::move(choice.visit));
    }
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(end->reason, stands ? EndReason::no_continuation : EndReason::closed_loop);
  }
}

}  // namespace arcwall::corner_test
