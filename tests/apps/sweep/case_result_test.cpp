#include "apps/sweep/case_result.hpp"

#include <gtest/gtest.h>

namespace arcwall::sweep::case_result_test {
namespace {

// A case that ended early has told its snap, if it had one; a limit on points may have cut it off before another.
TEST(CaseResult, AnEarlyEndBehindTheSnapIsNoFailure) {
  const Json snap{{"kind", "limit-point"}, {"lambda", 2.0}, {"unstable_before", 0}, {"unstable_after", 1}};
  const Json touch{{"kind", "contact-closes"}, {"lambda", 1.0}, {"unstable_before", 0}, {"unstable_after", 0}};
  EXPECT_FALSE((CaseResult{.there = true, .status = 3, .events = {touch, snap}}.failed()));
  EXPECT_TRUE((CaseResult{.there = true, .status = 3, .events = {touch}}.failed()));
  EXPECT_TRUE((CaseResult{.there = true, .status = 6, .events = {touch, snap}}.failed()));
  EXPECT_TRUE((CaseResult{.there = true, .events = {touch, snap}}.failed()));
  EXPECT_FALSE((CaseResult{.there = true, .status = 0}.failed()));
}

}  // namespace
}  // namespace arcwall::sweep::case_result_test
