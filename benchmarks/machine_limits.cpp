// What the machine can do at most, for docs/performance.md: memory bandwidth, multiply-add rate, and what a sequence of
// dependent operations waits for, which is the limit of a factorization along a chain.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

namespace {

// a := b + s c, three streams. The greatest arrays are far beyond any cache.
void triad(benchmark::State& timing) {
  const auto n = static_cast<std::size_t>(timing.range(0));
  std::vector<double> a(n), b(n, 1.0), c(n, 2.0);
  for (auto _ : timing) {
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3.0 * c[i];
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  }
  timing.counters["bytes"] =
      benchmark::Counter(3.0 * sizeof(double) * double(n), benchmark::Counter::kIsIterationInvariantRate);
}

// Independent multiply-adds, enough of them to fill the pipes; the compiler makes vectors of them.
void multiply_add(benchmark::State& timing) {
  constexpr int lanes = 64, rounds = 1000;
  double sums[lanes] = {};
  const double factor = 0.999;
  for (auto _ : timing) {
    for (int round = 0; round < rounds; ++round)
      for (double& sum : sums) sum = sum * factor + 1.0;
    benchmark::DoNotOptimize(sums);
  }
  timing.counters["flops"] = benchmark::Counter(2.0 * lanes * rounds, benchmark::Counter::kIsIterationInvariantRate);
}

// One after the other: each waits for the last.
void dependent_multiply_add(benchmark::State& timing) {
  double sum = 0.0;
  const double factor = 0.999;
  for (auto _ : timing) benchmark::DoNotOptimize(sum = sum * factor + 1.0);
}

void dependent_division(benchmark::State& timing) {
  double value = 1.5;
  for (auto _ : timing) benchmark::DoNotOptimize(value = 1.7 / value);
}

void arc_tangent(benchmark::State& timing) {
  double angle = 0.1;
  for (auto _ : timing) {
    angle = angle < 1.0 ? angle + 1e-4 : 0.1;
    benchmark::DoNotOptimize(std::atan2(angle, 1.0));
  }
}

BENCHMARK(triad)->Arg(1 << 13)->Arg(1 << 17)->Arg(1 << 25)->MinTime(0.2);
BENCHMARK(multiply_add)->MinTime(0.2);
BENCHMARK(dependent_multiply_add)->MinTime(0.1);
BENCHMARK(dependent_division)->MinTime(0.1);
BENCHMARK(arc_tangent)->MinTime(0.1);

}  // namespace

BENCHMARK_MAIN();
