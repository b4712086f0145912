#pragma once

#include <cstddef>
#include <cstdlib>  // says which C library it is

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace arcwall {

/// Freed memory stays with the program. By default glibc gives vectors of a large structure back to the system and asks
/// for them again a step later, at the price of a page fault for every 4 kB: a twentieth or more of the time of a
/// path with 20000 elements.
inline void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int greatest_threshold = 32 << 20;  // that glibc accepts for blocks of their own [byte]
  mallopt(M_MMAP_THRESHOLD, greatest_threshold);
  mallopt(M_TRIM_THRESHOLD, 2 * greatest_threshold);
#endif
}

/// But what building and analysing a large structure left free goes back, once that is done: a path uses its own
/// vectors again and again, and seldom the room between.
inline void give_back_freed_memory() {
#ifdef __GLIBC__
  constexpr std::size_t much = 4 << 20;  // [byte]
  if (mallinfo2().fordblks > much) malloc_trim(0);
#endif
}

}  // namespace arcwall
