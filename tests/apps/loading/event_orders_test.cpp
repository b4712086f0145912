// Loads at which columns on springs and arches under pressure lose their stability, against closed forms: their errors
// fall with the order of the theory. Those of heat, of prescribed movements and of walls that move are beside their
// own tests.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/apps/loading/loading_decks.hpp"

namespace arcwall::loading_test {

namespace {

struct Theory {
  const char* name;
  double order;  // of events, at least
  std::vector<int> elements;
};

// So many elements in each of two members; the errors relative to the reference.
template <class DeckOf>
void expect_order(const DeckOf& deck_of, double reference, const Theory& theory) {
  SCOPED_TRACE(theory.name);
  std::vector<double> errors;
  for (const int elements : theory.elements) {
    const TracedDeck traced(deck_of(theory.name, elements));
    errors.push_back(event_near(traced, EventKind::branch_point, reference).lambda / reference - 1.0);
  }
  EXPECT_GT(least_order(errors, 1e-11), theory.order) << errors[0] << ", " << errors[1] << ", " << errors[2];
}

std::string column_with(const std::string& theory, int elements, const std::string& more) {
  return fmt::format(R"(
title = "Column on springs"
material.m = {{ E = 21000.0, nu = 0.29 }}
section.s = {{ shape = "rectangle", width = 0.1, height = 0.1 }}
point = {{ A = [0.0, 0.0], mid = [1.0, 0.0], B = [2.0, 0.0] }}
support = {{ A = ["x", "z"], B = ["z"] }}
load = [{{ at = "B", force = [-1.0, 0.0] }}]
{more}
[member]
first = {{ from = "A", to = "mid", theory = "{theory}", elements = {elements}, material = "m", section = "s" }}
second = {{ from = "mid", to = "B", theory = "{theory}", elements = {elements}, material = "m", section = "s" }}
[[monitor]]
name = "turn"
at = "A"
component = "rotation"
)",
                     fmt::arg("theory", theory), fmt::arg("elements", elements), fmt::arg("more", more));
}

}  // namespace

// A spring c in the middle holds it against the half wave: (λ̂ c / 2P) (L/2 − tan u / k) = 1 with u = k L / 2,
// λ̂ P = EI k² and λ̂ = 1 − P / EA, solved to all digits for c = 1.7271807701906376.
TEST(EventOrders, OfASpringInTheMiddleOfAColumn) {
  const auto deck = [](const std::string& theory, int elements) {
    return column_with(theory, elements, R"(
spring = [{ at = "mid", stiffness = { z = 1.7271807701906376 } }]
path = { step = 0.1, branches = "primary", stop = { lambda = [-0.1, 1.2] } }
)");
  };
  expect_order(deck, 1.108973634593219, {.name = "classic", .order = 3.5, .elements = {2, 4, 8}});
  expect_order(deck, 1.108973634593219, {.name = "elastica", .order = 5.0, .elements = {2, 4, 8}});
}

// Soil of 5 kN/cm²: EI q² − λ̂ P q + λ̂² k = 0 with q = (mπ/L)², least for m = 4. A foundation is of order 4 in either
// theory.
TEST(EventOrders, OfAColumnInSoil) {
  const auto deck = [](const std::string& theory, int elements) {
    return column_with(theory, elements, R"(
spring = [{ on = "first", foundation = { z = 5.0 } }, { on = "second", foundation = { z = 5.0 } }]
path = { step = 0.1, branches = "primary", stop = { lambda = [-0.1, 2.3] } }
)");
  };
  expect_order(deck, 2.247047004611333, {.name = "classic", .order = 3.5, .elements = {6, 12, 24}});
  expect_order(deck, 2.247047004611333, {.name = "elastica", .order = 3.5, .elements = {6, 12, 24}});
}

// A pinned half circle, EA R² / EI = 10⁴, sways at p R³ / EI = 3.00127583475769 (shooting). Pressure is of order 4 in
// either theory.
TEST(EventOrders, OfAnArchUnderPressure) {
  const auto deck = [](const std::string& theory, int elements) {
    return fmt::format(R"(
title = "Half circle under pressure"
material.m = {{ E = 1.0, nu = 0.3 }}
section.s = {{ shape = "general", A = 1e4, I = 1.0 }}
point = {{ l = [-1.0, 0.0], c = [0.0, 1.0], r = [1.0, 0.0] }}
support = {{ l = ["x", "z"], r = ["x", "z"] }}
load = [{{ on = "w", pressure = 1.0 }}, {{ on = "e", pressure = 1.0 }}]
path = {{ step = 0.2, branches = "primary", stop = {{ lambda = [-0.5, 3.2] }} }}
monitor = [{{ name = "u", at = "c", component = "x" }}]
[member]
w = {{ from = "l", to = "c", via = [-0.7071067811865475, 0.7071067811865476], theory = "{theory}", elements = {elements}, material = "m", section = "s" }}
e = {{ from = "c", to = "r", via = [0.7071067811865475, 0.7071067811865476], theory = "{theory}", elements = {elements}, material = "m", section = "s" }}
)",
                       fmt::arg("theory", theory), fmt::arg("elements", elements));
  };
  expect_order(deck, 3.00127583475769, {.name = "classic", .order = 3.5, .elements = {4, 8, 16}});
  expect_order(deck, 3.00127583475769, {.name = "elastica", .order = 3.5, .elements = {4, 8, 16}});
}

}  // namespace arcwall::loading_test
