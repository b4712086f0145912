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
    {.name = "classic", .theory = Theory::classic},
    {.name = "elastica4", .theory = Theory::elastica, .order = 4},
    {.name = "elastica6", .theory = Theory::elastica, .order = 6},
    {.name = "exact1", .theory = Theory::exact, .order = 1},
    {.name = "exact2", .theory = Theory::exact, .order = 2},
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

// The greatest error of K at `count` random states, some contacts closed with forces of either sign.
double worst_tangent(const Beam& beam, ContactLaw::Method method, int count, std::uint32_t seed) {
  const ContactModel model(cantilever(beam), smooth_walls(), 0.1, law_of(method));
  const MultiplierContact& system = model.system();
  Numbers numbers(seed);
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    Piece piece = system.open_piece();
    for (std::size_t j = 0; j < piece.size(); ++j) piece[j] = numbers() > 0.4 ? 1 : 0;
    const State state{.x = 0.2 * numbers.vector(system.size(piece)), .lambda = numbers(), .piece = piece};
    worst = std::max(worst, check_derivatives(system, state).K);
  }
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
TEST(Tangents, AreDerivativesForEveryTheoryWallAndLaw) { expect_tangents(40); }

TEST(Tangents, AreDerivativesAtAThousandStatesSlow) { expect_tangents(1000); }

}  // namespace arcwall::tangents_test
