#pragma once

#include <cstdio>
#include <ctime>
#include <string>

namespace arcwall::bench {

/// CPU seconds of this process: other processes on the machine hardly touch them.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// One line of what benchmarks/suite.py collects: case,size,figure,unit,value.
inline void print_figure(const std::string& work, long size, const char* figure, const char* unit, double value) {
  std::printf("%s,%ld,%s,%s,%.10g\n", work.c_str(), size, figure, unit, value);
}

}  // namespace arcwall::bench
