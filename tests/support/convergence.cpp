#include "tests/support/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/text.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::test {

std::vector<double> on_four_meshes(int coarsest, const std::function<double(int)>& value) {
  std::vector<double> values;
  for (int elements = coarsest; values.size() < 4; elements *= 2) values.push_back(value(elements));
  return values;
}

void expect_order(const std::vector<double>& errors, double order, double noise) {
  std::vector<double> sizes, resolved;
  std::string shown = "errors";
  for (std::size_t mesh = 0; mesh < errors.size(); ++mesh) {
    shown += " " + round_trip(errors[mesh]);
    if (std::abs(errors[mesh]) < noise) continue;
    sizes.push_back(std::exp2(-double(mesh)));
    resolved.push_back(errors[mesh]);
  }
  SCOPED_TRACE(shown);
  const std::size_t n = sizes.size();
  ASSERT_GE(n, 2U);
  EXPECT_NEAR(observed_order(sizes, resolved), order, 0.2);
  EXPECT_NEAR(observed_order({sizes[n - 2], sizes[n - 1]}, {resolved[n - 2], resolved[n - 1]}), order, 0.2);
}

double extrapolated(std::vector<double> values, double order) {
  for (; values.size() > 1; values.pop_back(), order += 2.0)
    for (std::size_t i = 0; i + 1 < values.size(); ++i)
      values[i] = values[i + 1] + (values[i + 1] - values[i]) / (std::exp2(order) - 1.0);
  return values.front();
}

void expect_convergence(const std::vector<double>& values, const Expectation& expected) {
  std::vector<double> errors;
  for (const double value : values) errors.push_back(value - expected.exact);
  expect_order(errors, expected.order);
  EXPECT_NEAR(extrapolated(values, expected.order) / expected.exact, 1.0, expected.limit_error);
}

double at_zero(const std::function<double(double)>& value, double s) {
  const double a = value(s), b = value(0.5 * s), c = value(0.25 * s);
  return (8.0 * c - 6.0 * b + a) / 3.0;
}

}  // namespace arcwall::test
