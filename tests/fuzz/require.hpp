#pragma once

#include <cstdio>
#include <cstdlib>

namespace arcwall::fuzz {

/// Ends the program with a signal, which a fuzzer takes for a finding, unless `holds`.
inline void require(bool holds, const char* otherwise) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", otherwise);
  std::abort();
}

}  // namespace arcwall::fuzz
