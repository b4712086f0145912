#include "core/algebra/sums.hpp"

#include <gtest/gtest.h>

#include "tests/support/dense.hpp"

namespace arcwall::sums_test {

TEST(Sums, AreThoseOfEachExpressionWhateverTheLength) {
  test::Numbers numbers(51);
  for (const Index n : {0, 1, 3, 4, 5, 8, 103}) {
    const Vector a = numbers.vector(n), b = numbers.vector(n);
    Vector moved = a;
    const auto [squares, products] = sums_over<2>(n, [&](const auto& at, auto& sums) {
      const auto x = at(a.data()), y = at(b.data());
      sums[0] += x * x;
      sums[1] += x * y;
      at.set(moved.data(), x + 2.0 * y);
    });
    EXPECT_NEAR(squares, a.squaredNorm(), 1e-13);
    EXPECT_NEAR(products, a.dot(b), 1e-13);
    EXPECT_EQ(moved, a + 2.0 * b);
    for_entries(n, [&](const auto& at) { at.set(moved.data(), -at(a.data())); });
    EXPECT_EQ(moved, -a);
  }
}

}  // namespace arcwall::sums_test
