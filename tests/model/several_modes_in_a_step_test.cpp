// A step of any length tells each buckling load that it passes, in their order.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "core/types.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::several_modes_in_a_step_test {

namespace {

enum class Driven { pushed, loaded, heated };

struct Strip {
  Driven driven{};
  double slenderness = 0.0;  // L/h
  int elements = 0;
  double max_step = 0.0;
};

std::ostream& operator<<(std::ostream& out, const Strip& strip) {
  return out << "driven " << int(strip.driven) << ", L/h " << strip.slenderness << ", " << strip.elements
             << " elements, max_step " << strip.max_step;
}

// Between supports that hold it sideways alone, L = 1: the strip buckles where P (1 − P/EA) = n² π² EI; between
// supports that hold it lengthways, too, where P = n² π² EI.
double buckling_strain(const Strip& strip, int n) {
  const double euler = n * n * pi * pi / (12.0 * strip.slenderness * strip.slenderness);  // P/EA
  return strip.driven == Driven::heated ? euler : 0.5 * (1.0 - std::sqrt(1.0 - 4.0 * euler));
}

constexpr double E = 2.0e11, width = 0.02, expansion = 1.25e-5;

double lambda_of(const Strip& strip, double strain) {
  switch (strip.driven) {
    case Driven::pushed:
      return strain;
    case Driven::loaded:
      return strain * E * width / strip.slenderness;
    case Driven::heated:
      return strain / expansion;
  }
  return 0.0;
}

std::string drive(const Strip& strip) {
  switch (strip.driven) {
    case Driven::pushed:
      return "prescribed = [{ at = \"b\", x = -1.0 }]";
    case Driven::loaded:
      return "load = [{ at = \"b\", force = [-1.0, 0.0] }]";
    case Driven::heated:
      return "load = [{ on = \"strip\", temperature = 1.0 }]";
  }
  return {};
}

// λ ends between the third buckling load and the fourth.
std::string deck_of(const Strip& strip) {
  const char* const held = strip.driven == Driven::heated ? R"("x", "z")" : R"("z")";
  return fmt::format(R"toml(
title = "A perfect strip"
material.m = {{ E = {}, expansion = {} }}
section.s = {{ shape = "rectangle", width = {}, height = {} }}
point = {{ a = [0.0, 0.0], b = [1.0, 0.0] }}
support = {{ a = ["x", "z"], b = [{}] }}
member.strip = {{ from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = {} }}
{}
path = {{ branches = "primary", max_step = {}, stop.lambda = [{}, {}] }}
)toml",
                     E, expansion, width, 1.0 / strip.slenderness, held, strip.elements, drive(strip), strip.max_step,
                     -lambda_of(strip, buckling_strain(strip, 1)),
                     lambda_of(strip, 0.75 * buckling_strain(strip, 3) + 0.25 * buckling_strain(strip, 4)));
}

class SeveralModesInAStep : public testing::TestWithParam<Strip> {};

}  // namespace

TEST_P(SeveralModesInAStep, AreToldOneByOne) {
  const Strip& strip = GetParam();
  const Session run = test::traced(deck_of(strip));
  const auto found = test::events_of(run.record(), EventKind::branch_point);
  ASSERT_EQ(found.size(), 3U);
  for (int n = 1; n <= 3; ++n) {
    const RecordEvent& event = found[static_cast<std::size_t>(n - 1)];
    // 20 elements have an error of some 1e-6 in the third buckling load.
    EXPECT_NEAR(event.lambda / lambda_of(strip, buckling_strain(strip, n)), 1.0, 2e-5);
    EXPECT_EQ(event.unstable_before, n - 1);
    EXPECT_EQ(event.unstable_after, n);
  }
}

INSTANTIATE_TEST_SUITE_P(Strips, SeveralModesInAStep,
                         testing::Values(Strip{Driven::pushed, 200.0, 40, 0.2}, Strip{Driven::pushed, 200.0, 34, 5.0},
                                         Strip{Driven::pushed, 50.0, 20, 5.0}, Strip{Driven::pushed, 1000.0, 60, 5.0},
                                         Strip{Driven::pushed, 1000.0, 20, 0.05}, Strip{Driven::loaded, 200.0, 40, 5.0},
                                         Strip{Driven::loaded, 1000.0, 20, 0.05}, Strip{Driven::heated, 50.0, 40, 5.0},
                                         Strip{Driven::heated, 1000.0, 34, 0.2}));

// Columns that nothing ties together buckle at one load, P (1 − P/EA) = π² EI/L², each in its own mode.
TEST(EqualColumns, BuckleTogetherHoweverManyTheyAre) {
  for (const int count : {2, 5, 9}) {
    SCOPED_TRACE(count);
    std::string loads;
    std::string columns;
    for (int i = 0; i < count; ++i) {
      loads += fmt::format(R"({{ at = "b{0}", force = [-1.0, 0.0] }}, )", i);
      columns += fmt::format(R"toml(
point.a{0} = [0.0, {0}.0]
point.b{0} = [1.0, {0}.0]
member.c{0} = {{ from = "a{0}", to = "b{0}", theory = "elastica", material = "m", section = "s", elements = 8 }}
support.a{0} = ["x", "z"]
support.b{0} = ["z"]
)toml",
                             i);
    }
    const std::string deck = fmt::format(R"toml(
title = "Columns"
material.m = {{ E = 1.0e4 }}
section.s = {{ shape = "rectangle", width = 1.0, height = 0.1 }}
path = {{ branches = "primary", stop.lambda = [-1.0, 12.0] }}
load = [{}]
{})toml",
                                         loads, columns);
    const Session run = test::traced(deck);
    const auto found = test::events_of(run.record(), EventKind::branch_point);
    ASSERT_EQ(found.size(), 1U);
    const double EA = 1000.0, euler = pi * pi / 1200.0;
    EXPECT_NEAR(found[0].lambda, 0.5 * EA * (1.0 - std::sqrt(1.0 - 4.0 * euler)), 1e-3);
    EXPECT_EQ(found[0].multiplicity, count);
    EXPECT_EQ(found[0].unstable_before, 0);
    EXPECT_EQ(found[0].unstable_after, count);
  }
}

}  // namespace arcwall::several_modes_in_a_step_test
