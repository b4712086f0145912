#include "core/deferred.hpp"

#include <gtest/gtest.h>

namespace arcwall::deferred_test {

TEST(Deferred, IsMadeOnceAndWhenItIsAskedFor) {
  int made = 0;
  const Deferred<int> value([&] { return ++made; });
  EXPECT_EQ(made, 0);
  EXPECT_EQ(value.get(), 1);
  EXPECT_EQ(value.get(), 1);
  EXPECT_EQ(made, 1);
}

TEST(Deferred, MayBeGivenAsItIs) {
  EXPECT_EQ(Deferred<int>(3).get(), 3);
  EXPECT_EQ(Deferred<int>().get(), 0);
}

}  // namespace arcwall::deferred_test
