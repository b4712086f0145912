// What one Newton iteration costs on Lee's frame, by the number of elements: along a whole path, and its three parts
// alone. The time per iteration and element should hardly depend on the mesh.
#include <benchmark/benchmark.h>

#include "benchmarks/models.hpp"
#include "continuation/step/corrector.hpp"
#include "continuation/tracer.hpp"

namespace arcwall::bench {

namespace {

// A state in the middle of the snap, so that the matrices are typical: indefinite and far from rest.
State deformed(const Model& frame) {
  TraceOptions options{.step = {.first = 0.1}};
  options.target_values.push_back({.quantity = frame.down, .value = 55.0, .stops = true, .label = "down"});
  Tracer tracer(*frame.structure, rest(*frame.structure), options);
  while (tracer.next()) {
  }
  return tracer.here().state;
}

// Shown in seconds with a prefix, as in 450ns.
void per_element(benchmark::State& timing, double iterations, double elements) {
  using Counter = benchmark::Counter;
  timing.counters["per_iteration_per_element"] =
      Counter(iterations * elements, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

// The whole path, located events and stability included: what a user waits for, over the iterations of its points.
void path(benchmark::State& timing) {
  const auto elements = static_cast<int>(timing.range(0));
  const Model frame = lee_frame(elements);
  TraceOptions options{.step = {.first = 0.1}};
  options.target_values.push_back({.quantity = frame.down, .value = frame.end, .stops = true, .label = "down"});
  int points = 0, iterations = 0;
  double limit = 0.0;
  for (auto _ : timing) {
    points = iterations = 0;
    limit = 0.0;
    Tracer tracer(*frame.structure, rest(*frame.structure), options);
    while (const auto arc = tracer.next()) {
      ++points;
      iterations += arc->to.iterations;
      for (const Event& event : arc->events)
        if (event.kind == EventKind::limit_point && limit == 0.0) limit = event.state.lambda;
    }
  }
  per_element(timing, iterations, elements);
  timing.counters["iterations"] = iterations;
  timing.counters["points"] = points;
  timing.counters["first_limit"] = limit;
}

// Newton's method alone: a step off the path and back, by the corrector that the tracer uses. The number of iterations
// counts the last look at the solution, which gives tangent and pivot signs, as one. With 20000 elements round-off may
// keep the method from settling; its iterations cost the same.
void corrector(benchmark::State& timing) {
  const auto elements = static_cast<int>(timing.range(0));
  const Model frame = lee_frame(elements);
  const State at = deformed(frame);
  const Metric metric(frame.structure->weights({}), 1.0);
  Corrector newton(*frame.structure, {}, 0.1);
  const Direction up{.dx = Vector::Zero(at.x.size()), .dlambda = 1.0};
  const Direction tangent = newton.inspect(at, metric, up).tangent;
  constexpr double s = 0.02;
  const PlaneConstraint plane(metric, at, tangent, s);
  int iterations = 0;
  bool converged = false;
  for (auto _ : timing) {
    const CorrectorResult result = newton.correct(moved(at, tangent, s), plane, metric, tangent, s);
    iterations = result.iterations + (result.converged() ? 1 : 0);
    converged = result.converged();
  }
  per_element(timing, iterations, elements);
  timing.counters["iterations"] = iterations;
  timing.counters["converged"] = converged;
}

// F, K and F_λ at one state.
void linearize(benchmark::State& timing) {
  const auto elements = static_cast<int>(timing.range(0));
  const Model frame = lee_frame(elements);
  const State at = deformed(frame);
  Linearization now;
  for (auto _ : timing) {
    frame.structure->linearize(at, now);
    benchmark::DoNotOptimize(now.K.valuePtr());
  }
  per_element(timing, 1.0, elements);
}

// Numerical LDLᵀ of K with its analysis at hand.
void factorize(benchmark::State& timing) {
  const auto elements = static_cast<int>(timing.range(0));
  const Model frame = lee_frame(elements);
  Linearization now;
  frame.structure->linearize(deformed(frame), now);
  BorderedSolver solver;
  for (auto _ : timing)
    if (solver.factorize(now, 0) != FactorStatus::ok) timing.SkipWithError("K is singular");
  per_element(timing, 1.0, elements);
}

// The line of linearised equilibrium: two right-hand sides and the check of the pivots.
void line_solve(benchmark::State& timing) {
  const auto elements = static_cast<int>(timing.range(0));
  const Model frame = lee_frame(elements);
  const State at = deformed(frame);
  Linearization now;
  frame.structure->linearize(at, now);
  BorderedSolver solver;
  if (solver.factorize(now, 0) != FactorStatus::ok) timing.SkipWithError("K is singular");
  const Row border{.dx = Vector::Zero(at.x.size()), .dlambda = 1.0};
  const Vector weights = frame.structure->weights({});
  EquilibriumLine line;
  for (auto _ : timing) benchmark::DoNotOptimize(solver.line(border, weights, line));
  per_element(timing, 1.0, elements);
}

void sizes(benchmark::internal::Benchmark* timing) {
  for (const int elements : {20, 200, 2000, 20000, 100000}) timing->Arg(elements);
}

BENCHMARK(path)->Apply(sizes)->Unit(benchmark::kMillisecond);
BENCHMARK(corrector)->Apply(sizes)->Unit(benchmark::kMicrosecond);
BENCHMARK(linearize)->Apply(sizes)->Unit(benchmark::kMicrosecond);
BENCHMARK(factorize)->Apply(sizes)->Unit(benchmark::kMicrosecond);
BENCHMARK(line_solve)->Apply(sizes)->Unit(benchmark::kMicrosecond);

}  // namespace

}  // namespace arcwall::bench

BENCHMARK_MAIN();
