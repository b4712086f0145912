#include <gtest/gtest.h>

#include <string>

#include "core/derivative_check.hpp"
#include "tests/contact/contact_models.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/essenburg_models.hpp"

// The tangent of every theory among every kind of wall with every law of contact.
namespace arcwall::tangents_test {

namespace {

using test::ContactModel;
using test::Numbers;

struct Beam {
  std::string name;
  Theory theory;
  int order = 2;
  QuadraticTerm quadratic = QuadraticTerm::fixed;
};

const std::vector<Beam> beams{
    {.name = "euler-bernoulli", .theory = Theory::euler_bernoulli},
    {.name = "elastica4", .theory = Theory::elastica, .order = 4},
    {.name = "elastica6", .theory = Theory::elastica, .order = 6},
    {.name = "exact1", .theory = Theory::reissner, .order = 1},
    {.name = "exact2", .theory = Theory::reissner, .order = 2},
    {.name = "essenburg1", .theory = Theory::essenburg, .order = 1},
    {.name = "essenburg2", .theory = Theory::essenburg, .order = 2},
    {.name = "essenburg2director", .theory = Theory::essenburg, .order = 2, .quadratic = QuadraticTerm::director}};

// With an imperfection, two elements.
std::unique_ptr<Structure> cantilever(const Beam& beam) {
  return test::contact_beam({.imperfection = {{.amplitude = 0.02, .waves = 2}},
                             .theory = beam.theory,
                             .order = beam.order,
                             .quadratic = beam.quadratic,
                             .section = test::essenburg_section(100.0, 0.3, 1.0, 0.3),
                             .elements = 2});
}

// Flat, line, parabola, circle and one cubic as a spline, on both sides: none has a kink in any derivative.
std::vector<test::TestWall> smooth_walls() {
  std::vector<test::TestWall> walls = test::all_walls(false);
  for (test::TestWall& wall : walls) {
    const double sign = wall.side == Side::above ? 1.0 : -1.0;
    if (&wall - walls.data() == 4 || &wall - walls.data() == 9)
      wall.profile = spline_profile({-1.5, 0.5, 2.0, 4.0}, {sign, 1.1 * sign, 0.9 * sign, 1.2 * sign});
  }
  return walls;
}

ContactLaw law_of(ContactLaw::Method method) { return {.method = method, .stiffness = 100.0}; }

// The same walls, each moved and turned by λ.
std::vector<test::TestWall> moving_walls() {
  std::vector<test::TestWall> walls = smooth_walls();
  for (test::TestWall& wall : walls) wall.motion = {.way = {0.2, -0.3}, .turn = 0.1, .about = {1.0, 0.0}};
  return walls;
}

// A random state, some contacts closed with forces of either sign.
State random_state(const MultiplierContact& system, Numbers& numbers) {
  ActiveSet active_set = system.open_active_set();
  for (std::size_t j = 0; j < active_set.size(); ++j) active_set[j] = numbers() > 0.4 ? 1 : 0;
  return {.x = 0.2 * numbers.vector(system.size(active_set)), .lambda = numbers(), .active_set = active_set};
}

// The greatest error of K at `count` random states.
double worst_tangent(const Beam& beam, ContactLaw::Method method, int count, std::uint32_t seed) {
  const ContactModel model(cantilever(beam), smooth_walls(), 0.1, law_of(method));
  Numbers numbers(seed);
  double worst = 0.0;
  for (int i = 0; i < count; ++i)
    worst = std::max(worst, check_derivatives(model.system(), random_state(model.system(), numbers)).K);
  return worst;
}

constexpr std::array methods{ContactLaw::Method::rigid, ContactLaw::Method::penalty, ContactLaw::Method::augmented};

void expect_tangents(int count) {
  std::uint32_t seed = 100;
  for (const Beam& beam : beams)
    for (const ContactLaw::Method method : methods)
      EXPECT_LE(worst_tangent(beam, method, count, seed++), 1e-9) << beam.name << ", law " << static_cast<int>(method);
}

}  // namespace

// Central differences of fourth order, step 1e-4: 1e-12 by round-off. K is compared as a whole, so it is symmetric too.
TEST(Tangents, AreDerivativesForEveryTheoryWallAndLawSlow) { expect_tangents(40); }

// What moves with λ has rates: of the gaps in F_λ and in the guards, and of the directions of the forces in F_λ.
TEST(Tangents, KnowTheRatesOfWallsThatMove) {
  std::uint32_t seed = 200;
  for (const Beam& beam : beams)
    for (const ContactLaw::Method method : methods) {
      SCOPED_TRACE(beam.name + ", law " + std::to_string(static_cast<int>(method)));
      const ContactModel model(cantilever(beam), moving_walls(), 0.1, law_of(method));
      const MultiplierContact& system = model.system();
      Numbers numbers(seed++);
      for (int i = 0; i < 10; ++i) {
        const State state = random_state(system, numbers);
        const DerivativeReport report = check_derivatives(system, state);
        EXPECT_LE(report.K, 1e-9);
        EXPECT_LE(report.F_lambda, 1e-9);
        EXPECT_LE(report.guard_gradient, 1e-9);
        const Direction direction{.dx = numbers.vector(state.x.size()), .dlambda = numbers()};
        const Vector rates = system.guards_along(state, direction).rates;
        for (Index j = 0; j < rates.size(); ++j)
          EXPECT_NEAR(rates[j], apply(system.guard_gradient(state, j), direction), 1e-12 * (1.0 + std::abs(rates[j])));
      }
    }
}

TEST(Tangents, AreDerivativesAtAThousandStatesNightly) { expect_tangents(1000); }

}  // namespace arcwall::tangents_test
