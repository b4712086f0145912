#include "apps/kept_memory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <vector>

#ifdef __GLIBC__

namespace {

using namespace arcwall;

constexpr std::size_t megabyte = 1 << 20;

std::size_t resident() {
  std::ifstream statm("/proc/self/statm");
  std::size_t whole = 0, pages = 0;
  statm >> whole >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// What is freed first, and what lies behind it.
TEST(KeptMemory, FreedMemoryStaysUntilItIsGivenBack) {
  keep_freed_memory();
  std::vector<std::vector<char>> left(64);
  for (std::vector<char>& block : left) block.assign(megabyte, 'x');
  const std::vector<char> kept(megabyte, 'x');
  const std::size_t all = resident();
  left.clear();
  if (mallinfo2().fordblks < 48 * megabyte) GTEST_SKIP() << "another allocator than glibc's";
  EXPECT_GT(resident() + 16 * megabyte, all);
  give_back_freed_memory();
  EXPECT_LT(resident() + 48 * megabyte, all);
  EXPECT_EQ(kept.back(), 'x');
}

}  // namespace

#endif
