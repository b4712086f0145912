#include <gtest/gtest.h>

#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "tests/support/invariants.hpp"
#include "tests/support/sliding_models.hpp"

// Contact that meets point loads. References are closed forms of beams with small slopes.
namespace arcwall::sliding_loads_test {

namespace {

using test::ExploredBranch;
using test::SlidingModel;

constexpr double L = 2.0, gap = 1e-3;           // of the beam; between its lower face and the floor
constexpr double small_slopes = 5.0 * gap / L;  // the squares of slopes are less than a thousandth of this

// A beam on two supports, EI = 1, the right one sliding along x, above a floor. λ pushes it down by a force at a, where
// it may have a joint, and bends its right end down by a moment.
struct Beam {
  int elements;
  Theory theory;
  double a, force, moment = 0.0;
  bool jointed = false;

  SlidingModel model() const {
    StructureBuilder builder;
    const Index left = builder.add_joint({0.0, 0.0}), right = builder.add_joint({L, 0.0});
    const int before = static_cast<int>(std::lround(elements * a / L));
    const auto add_member = [&](Index from, Index to, double begin, double end, int count) {
      builder.add_member({.name = std::to_string(begin),
                          .from = from,
                          .to = to,
                          .axis = straight_axis({begin, 0.0}, {end, 0.0}),
                          .theory = theory,
                          .order = 4,
                          .section = {.E = 1.0, .A = 1e4, .I = 1.0, .height = 0.01},
                          .elements = count});
    };
    Index loaded = 0;
    if (jointed) {
      loaded = builder.add_joint({a, 0.0});
      add_member(left, loaded, 0.0, a, before);
      add_member(loaded, right, a, L, elements - before);
    } else {
      add_member(left, right, 0.0, L, elements);
      loaded = builder.mesh(0).nodes[static_cast<std::size_t>(before)];
    }
    builder.fix(builder.dof(left, Dof::x));
    for (const Index end : {left, right}) builder.fix(builder.dof(end, Dof::z));
    builder.add_load(builder.dof(loaded, Dof::z), -force, LoadKind::proportional);
    if (moment != 0.0) builder.add_load(*builder.shared_rotation(right), moment, LoadKind::proportional);
    return {builder, {{.name = "floor", .side = Side::below, .profile = flat_profile(-gap - 0.005)}}, 0.05};
  }
};

struct Path {
  std::vector<Event> events;
  std::vector<ContactPoint> contacts;  // at the end
  EndReason end;
};

Path path_of(const Beam& beam, double to) {
  const SlidingModel model = beam.model();
  TraceOptions options;
  options.step.first = 0.05;
  options.target_values = {test::stop_at_lambda(-1.0), test::stop_at_lambda(to)};
  const auto branches = test::follow(model.system(), model.system().rest(), options);
  EXPECT_EQ(branches.size(), 1U);
  const ExploredBranch& branch = branches.front();
  test::expect_sliding_invariants(model.system(), branch.arcs, options, branch.lambda_scale, {.recount_every = 3});
  return {.events = test::events_of(branches),
          .contacts = model.system().closed_contacts(branch.arcs.back().to.state),
          .end = branch.record.end->reason};
}

// expect(beam), with the number of elements, the theory and whether there is a joint at the force.
template <class Expect>
void on_every_mesh(const Expect& expect) {
  for (const Theory theory : {Theory::euler_bernoulli, Theory::elastica})
    for (const bool jointed : {false, true})
      for (const int elements : {10, 20, 40, 80}) {
        SCOPED_TRACE(std::to_string(elements) + (theory == Theory::euler_bernoulli ? ", classic" : ", elastica") +
                     (jointed ? ", jointed" : ""));
        expect(Beam{.elements = elements, .theory = theory, .a = 0.0, .force = 0.0, .jointed = jointed});
      }
}

// One event, at this λ, and one contact at the end of the path.
void expect_one_touch(const Path& path, double lambda) {
  EXPECT_EQ(path.end, EndReason::stop);
  ASSERT_EQ(path.events.size(), 1U);
  EXPECT_EQ(path.events[0].kind, EventKind::contact_closes);
  EXPECT_NEAR(path.events[0].state.lambda, lambda, small_slopes * lambda);
  ASSERT_EQ(path.contacts.size(), 1U);
}

// A force at c from the clamped end of a span l with one clamped and one simply supported end makes a moment there.
double clamping_moment(double c, double l) { return c * (l - c) * (2.0 * l - c) / (2.0 * l * l); }

double root_of(const std::function<double(double)>& f, double from, double to) {
  std::uintmax_t most = 200;
  const auto [a, b] =
      boost::math::tools::toms748_solve(f, from, to, boost::math::tools::eps_tolerance<double>(48), most);
  return 0.5 * (a + b);
}

}  // namespace

// The middle touches at P = 48 EI g/L³. From there on the floor bears what is added, and nothing moves.
TEST(SlidingLoads, TouchesUnderTheForce) {
  on_every_mesh([](Beam beam) {
    const double lambda = 48.0 * gap / (L * L * L);
    beam.a = 0.5 * L;
    beam.force = 1.0;
    const Path path = path_of(beam, 3.0 * lambda);
    ASSERT_NO_FATAL_FAILURE(expect_one_touch(path, lambda));
    EXPECT_NEAR(path.contacts[0].place.x(), beam.a, small_slopes * beam.a);
    EXPECT_NEAR(path.contacts[0].force, 2.0 * lambda, small_slopes * lambda);
  });
}

// The place of the greatest deflection touches, at (L² − b²)^½/√3 from the left support, b being the distance of the
// force from the right one. Then the contact divides the beam into two spans that are clamped there, and both have the
// same moment there: as the force grows, the contact comes ever nearer to it.
TEST(SlidingLoads, ComesNearAForceThatGrowsSlow) {
  on_every_mesh([](Beam beam) {
    const double a = 0.6 * L, b = L - a, touches = 9.0 * std::sqrt(3.0) * L * gap / (b * std::pow(L * L - b * b, 1.5));
    for (const double to : {2.0 * touches, 30.0 * touches}) {
      beam.a = a;
      beam.force = 1.0;
      const Path path = path_of(beam, to);
      ASSERT_NO_FATAL_FAILURE(expect_one_touch(path, touches));
      const auto moment_missing = [&](double x) {
        return 3.0 * gap * (1.0 / ((L - x) * (L - x)) - 1.0 / (x * x)) - to * clamping_moment(a - x, L - x);
      };
      const double x = root_of(moment_missing, 0.5 * L, a);
      EXPECT_NEAR(path.contacts[0].place.x(), x, small_slopes * x) << to;
    }
  });
}

// The moment at the right end pulls the contact past the force, which then acts on the left span.
TEST(SlidingLoads, PassesAForceSlow) {
  on_every_mesh([](Beam beam) {
    const double a = 0.6 * L, force = 2e-3, moment = 2.6e-3;
    beam.a = a;
    beam.force = force;
    beam.moment = moment;
    const auto lambda_at = [&](double x) {
      const double bent = x < a ? -force * clamping_moment(a - x, L - x) : force * clamping_moment(x - a, x);
      return 3.0 * gap * (1.0 / ((L - x) * (L - x)) - 1.0 / (x * x)) / (0.5 * moment - bent);
    };
    for (const double to : {1.5, 2.1, 3.5}) {
      const Path path = path_of(beam, to);
      EXPECT_EQ(path.end, EndReason::stop);
      ASSERT_EQ(path.events.size(), 1U);
      EXPECT_EQ(path.events[0].kind, EventKind::contact_closes);
      ASSERT_EQ(path.contacts.size(), 1U);
      const double x = root_of([&](double at) { return lambda_at(at) - to; }, 0.5 * L, 0.65 * L);
      EXPECT_EQ(x < a, to < 2.0);
      EXPECT_NEAR(path.contacts[0].place.x(), x, small_slopes * x) << to;
    }
  });
}

}  // namespace arcwall::sliding_loads_test
