#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/branch.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/sliding_models.hpp"

// Cantilevers that touch a wall with their tips: they lie down there, the contact moves inside or spreads, and comes
// back to the tip. EI = L = 1, EA = 1e5 per stress-free length, contact on the axis. References are the extensible
// elastica, θ′ = κ₀ + M/EI, (x′, z′) = (1 + N/EA)(cos θ, sin θ), M′ = −(1 + N/EA) Q, shot from the clamp or from the
// contact to the clamp with Runge-Kutta's method and Newton's; all digits given stay with half the steps.
namespace arcwall::sliding_tips_test {

namespace {

using test::ExploredBranch;
using test::SlidingModel;

constexpr auto opens = EventKind::contact_opens, closes = EventKind::contact_closes,
               spreads = EventKind::contact_spreads, gathers = EventKind::contact_shrinks,
               passes = EventKind::contact_transfers;

struct Path : test::SlidingPath {
  double load(std::size_t event) const { return events()[event].state.lambda; }
  double point() const { return last().x[last().x.size() - 1]; }
  double all_forces() const {
    double sum = 0.0;
    for (const ContactPoint& contact : model.system().closed_contacts(last())) sum += contact.force_vector.y();
    for (const ContactPoint& node : model.system().pressed_nodes(last())) sum += node.force_vector.y();
    return sum;
  }
};

Path path_of(SlidingModel model, double to, double step) { return {test::sliding_path(std::move(model), to, step)}; }

// From the end of a path back to rest.
std::vector<Event> unloaded(const Path& path) {
  TraceOptions options = path.options;
  options.step.first *= -1.0;
  options.target_values = {test::stop_at_lambda(0.0)};
  return test::events_of(test::follow(path.model.system(), path.last(), options));
}

// A strip of length 1 along the x-axis, or a leaf with the curvature 0.3, clamped at its left end.
struct Cantilever {
  int elements = 40;
  Theory theory = Theory::elastica;
  bool curved = false;
  bool reversed = false;     // runs towards the clamp
  double dead = 0.0;         // along all of it, down, times λ
  double load_at = 1.0;      // a fraction of its length
  double load = 0.0;         // there, down, times λ
  double load_on_tip = 0.0;  // besides, likewise
  double moment = 0.0;       // on the tip, clockwise, times λ

  SlidingModel above(std::unique_ptr<Profile> wall) const {
    const Vec2 middle(std::sin(0.15) / 0.3, (1.0 - std::cos(0.15)) / 0.3);
    const Vec2 tip = curved ? Vec2(std::sin(0.3) / 0.3, (1.0 - std::cos(0.3)) / 0.3) : Vec2(1.0, 0.0);
    test::ClampedMember strip = test::clamped_member({0.0, 0.0}, tip, reversed,
                                                     {.name = "strip",
                                                      .theory = theory,
                                                      .order = theory == Theory::elastica ? 6 : 2,
                                                      .section = {.E = 1.0, .A = 1e5, .I = 1.0, .height = 0.01},
                                                      .elements = elements},
                                                     curved ? std::optional(middle) : std::nullopt);
    StructureBuilder& builder = strip.builder;
    const Index free = strip.free;
    const auto node = static_cast<std::size_t>(std::lround(elements * (reversed ? 1.0 - load_at : load_at)));
    const auto push = [&](Index at, double force) {
      if (force != 0.0) builder.add_load(builder.dof(at, Dof::z), -force, LoadKind::proportional);
    };
    push(builder.mesh(0).nodes[node], load);
    push(free, load_on_tip);
    if (moment != 0.0) builder.add_load(builder.shared_rotation(free).value(), -moment, LoadKind::proportional);
    if (dead != 0.0) builder.add_distributed_load(0, {0.0, -dead}, LoadKind::proportional);
    return {builder, {{.name = "wall", .side = Side::below, .profile = std::move(wall), .on_axis = true}}, 0.05};
  }
};

// Of errors on meshes each half as coarse as the one before, unless the finer one is round-off.
void expect_order(double least, const std::vector<double>& errors) {
  constexpr double round_off = 1e-10;
  for (std::size_t finer = 1; finer < errors.size(); ++finer)
    if (std::abs(errors[finer]) > round_off) {
      EXPECT_GE(std::log2(std::abs(errors[finer - 1] / errors[finer])), least) << "mesh " << finer;
    }
}

class SlidingTip : public ::testing::TestWithParam<Theory> {
 protected:
  double least_order() const { return GetParam() == Theory::euler_bernoulli ? 3.5 : 5.0; }
};

INSTANTIATE_TEST_SUITE_P(Theories, SlidingTip, ::testing::Values(Theory::euler_bernoulli, Theory::elastica),
                         [](const auto& theory) {
                           return theory.param == Theory::euler_bernoulli ? "Classic" : "Elastica";
                         });

}  // namespace

// A heavy strip 0.05 above a floor: its tip touches at q = 0.4008018816, in small slopes 8 d, and is parallel to the
// floor at 3.6092847770, in small slopes 72 d. From then on it lies on the floor from a point that wanders towards the
// clamp: at q = 10.827854330940692 it is 0.7601942080 from there, in small slopes (72 d/q)^¼, and the clamp bears
// 5.4915969725. Unloaded, it does all that backwards.
TEST_P(SlidingTip, LiesDownOnAFloor) {
  constexpr double q = 10.827854330940692;
  std::vector<double> touches, lies, places, reactions;
  for (const int elements : {10, 20, 40}) {
    const Path path = path_of(
        Cantilever{.elements = elements, .theory = GetParam(), .dead = 1.0}.above(flat_profile(-0.05)), q, 0.04);
    ASSERT_EQ(path.kinds(), (std::vector{closes, spreads}));
    const Event down = path.events()[1];
    EXPECT_EQ(path.model.system().contact(down.state, down.guards[0]).label.fraction, 1.0);
    EXPECT_EQ(down.unstable_after, 0);
    touches.push_back(path.load(0) / 0.4008018816034775 - 1.0);
    lies.push_back(path.load(1) / 3.6092847769802305 - 1.0);
    places.push_back(path.point() / 0.7601942080 - 1.0);
    reactions.push_back((q - path.all_forces()) / 5.491596972522974 - 1.0);
    path.expect_invariants();
    if (elements > 10) continue;
    const std::vector<Event> back = unloaded(path);
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(back[0].kind, gathers);
    EXPECT_NEAR(back[0].state.lambda, path.load(1), 1e-8);
    EXPECT_EQ(back[1].kind, opens);
    EXPECT_NEAR(back[1].state.lambda, path.load(0), 1e-8);
  }
  for (const auto& errors : {touches, lies, reactions}) expect_order(3.5, errors);
  expect_order(3.5, places);
  for (const auto& errors : {touches, lies, places, reactions}) EXPECT_LE(std::abs(errors.back()), 1e-5);
}

// A strip without weight, g above the floor, under a load P at a. In small slopes its tip lies down when P a² (1 − a) =
// 6 g EI; then it touches at s = a + 6 g EI/(P a²) with the force P a²/s², comes to rest at the load, and lies on the
// floor without force beyond. A load on the tip goes into the floor there and changes nothing of that.
TEST_P(SlidingTip, LiesDownWithoutWeight) {
  constexpr double g = 1e-3, a = 0.75;
  for (const double on_tip : {0.0, 0.5})
    for (const double P : {0.08, 0.4}) {
      const Path path = path_of(
          Cantilever{.elements = 20, .theory = GetParam(), .load_at = a, .load = 1.0, .load_on_tip = on_tip}.above(
              flat_profile(-g)),
          P, 1e-3);
      ASSERT_EQ(path.kinds(), (std::vector{closes, spreads}));
      EXPECT_NEAR(path.load(1), 6.0 * g / (a * a * (1.0 - a)), 1e-5 * path.load(1));
      const double s = a + 6.0 * g / (P * a * a), p = P * a * a / (s * s);
      EXPECT_NEAR(path.point(), s, 1e-5 * s);
      EXPECT_NEAR(path.force(0), p, 1e-4 * p);
      EXPECT_NEAR(path.force(1), on_tip * P, 1e-9);
      path.expect_invariants();
    }
}

// A leaf bent upward with a load at 3/4 of its length, 0.1 above a floor. Its tip touches at P = 1.1962683672, pointing
// down, and is parallel to the floor at 2.1606587541. The contact then leaves the tip, which lifts off: at P = 6 it is
// at 0.8629064708 and bears 3.8204551360, at 10 at 0.8214816693 with 7.5838883229.
TEST_P(SlidingTip, LiftsOffAgainWhereContactMovesInside) {
  std::vector<double> touches, passes_at, places, forces;
  for (const int elements : {20, 40, 80}) {
    for (const bool reversed : {false, true}) {
      const Path path = path_of(Cantilever{.elements = elements,
                                           .theory = GetParam(),
                                           .curved = true,
                                           .reversed = reversed,
                                           .load_at = 0.75,
                                           .load = 1.0}
                                    .above(flat_profile(-0.1)),
                                6.0, 0.1);
      ASSERT_EQ(path.kinds(), (std::vector{closes, passes}));
      const double place = reversed ? 1.0 - path.point() : path.point();
      if (reversed) {
        EXPECT_NEAR(place / 0.8629064708 - 1.0, places.back(), 1e-9);
        EXPECT_NEAR(path.force(0) / 3.8204551360 - 1.0, forces.back(), 1e-9);
        continue;
      }
      touches.push_back(path.load(0) / 1.1962683672318815 - 1.0);
      passes_at.push_back(path.load(1) / 2.1606587541 - 1.0);
      places.push_back(place / 0.8629064708 - 1.0);
      forces.push_back(path.force(0) / 3.8204551360 - 1.0);
      path.expect_invariants();
    }
  }
  for (const auto& errors : {touches, passes_at, places, forces}) {
    expect_order(least_order(), errors);
    EXPECT_LE(std::abs(errors.back()), 1e-7);
  }
}

// A strip whose tip meets a cylinder of radius 0.2, its top 0.05 below the tip, under a load at 0.8: it touches at P =
// 0.2135655724 and is tangent to it at 2.6229685102. At P = 8 the contact is at 0.9754740781 and bears 5.7948498108.
TEST_P(SlidingTip, SlidesOntoACylinder) {
  std::vector<double> touches, passes_at, places, forces;
  for (const int elements : {20, 40, 80}) {
    const Path path = path_of(Cantilever{.elements = elements, .theory = GetParam(), .load_at = 0.8, .load = 1.0}.above(
                                  circle_profile({1.0, -0.25}, 0.2, Side::below)),
                              8.0, 0.02);
    ASSERT_EQ(path.kinds(), (std::vector{closes, passes}));
    touches.push_back(path.load(0) / 0.2135655724265 - 1.0);
    passes_at.push_back(path.load(1) / 2.6229685102495 - 1.0);
    places.push_back(path.point() / 0.97547407803025 - 1.0);
    forces.push_back(path.force(0) / 5.794849810795 - 1.0);
    path.expect_invariants();
    if (elements > 20) continue;
    const std::vector<Event> back = unloaded(path);
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(back[0].kind, passes);
    EXPECT_NEAR(back[0].state.lambda, path.load(1), 1e-9);
    EXPECT_EQ(back[1].kind, opens);
    EXPECT_NEAR(back[1].state.lambda, path.load(0), 1e-9);
  }
  for (const auto& errors : {touches, passes_at, places, forces}) {
    expect_order(least_order(), errors);
    EXPECT_LE(std::abs(errors.back()), 1e-7);
  }
}

// A strip that a moment on its tip bends round a cylinder of radius 1, its top 0.02 below the strip and at x = 0.1.
// When the moment is EI/R all of the strip beyond its contact bends as the cylinder does: the tip touches there. From
// then on the strip arches between both contacts, of which the inner one lets go at M = 1.0994410022 and 0.6379065821
// of the length.
TEST_P(SlidingTip, TouchesWithAllOfTheTail) {
  std::vector<double> loads, places;
  for (const int elements : {10, 20, 40}) {
    const Path path =
        path_of(Cantilever{.elements = elements, .theory = GetParam(), .load_at = 1.0, .moment = 1.0}.above(
                    circle_profile({0.1, -1.02}, 1.0, Side::below)),
                1.5, 0.05);
    ASSERT_EQ(path.kinds(), (std::vector{closes, closes, opens}));
    EXPECT_NEAR(path.load(1), 1.0, 1e-8);
    const Event inner = path.events()[2];
    EXPECT_EQ(path.model.system().contact(path.events()[1].state, path.events()[1].guards[0]).label.fraction, 1.0);
    loads.push_back(path.load(2) / 1.0994410022 - 1.0);
    places.push_back(path.model.system().contact(inner.state, inner.guards[0]).label.fraction / 0.6379065821 - 1.0);
    path.expect_invariants();
  }
  for (const auto& errors : {loads, places}) {
    expect_order(least_order(), errors);
    EXPECT_LE(std::abs(errors.back()), 1e-6);
  }
}

}  // namespace arcwall::sliding_tips_test
