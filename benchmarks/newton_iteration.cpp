// What one Newton iteration costs on Lee's frame, by the number of elements: along a whole path, and its three parts
// alone. The time per iteration and element should hardly depend on the mesh.
#include <benchmark/benchmark.h>

#include <memory>

#include "continuation/tracer.hpp"
#include "elements/member_point.hpp"
#include "elements/structure.hpp"

namespace arcwall {

namespace {

constexpr double side = 120.0;     // [cm]
constexpr double end_down = 90.0;  // way of the loaded point at which the path ends [cm]

// Lee, Manuel and Rossow 1968: column and beam of equal length, pinned at the far ends, loaded at 1/5 of the beam. Half
// of the elements are the column's.
struct LeeFrame {
  std::unique_ptr<Structure> structure{};
  std::shared_ptr<const Observable> down{};  // way of the loaded point
};

LeeFrame lee_frame(int elements) {
  StructureBuilder builder;
  const Index foot = builder.add_joint({0.0, 0.0}), corner = builder.add_joint({0.0, side}),
              end = builder.add_joint({side, side});
  const Section section{.E = 720.0, .A = 6.0, .I = 2.0};
  const int in_column = elements / 2, in_beam = elements - in_column;
  builder.add_member({.name = "column",
                      .from = foot,
                      .to = corner,
                      .axis = straight_axis({0.0, 0.0}, {0.0, side}),
                      .section = section,
                      .elements = in_column});
  const Index beam = builder.add_member({.name = "beam",
                                         .from = corner,
                                         .to = end,
                                         .axis = straight_axis({0.0, side}, {side, side}),
                                         .section = section,
                                         .elements = in_beam});
  for (const Index pin : {foot, end})
    for (const Freedom which : {Freedom::x, Freedom::z}) builder.fix(builder.freedom(pin, which));
  const Index loaded = builder.mesh(beam).nodes[static_cast<std::size_t>(in_beam / 5)];
  const Index vertical = builder.freedom(loaded, Freedom::z);
  builder.add_load(vertical, -1.0, LoadKind::proportional);
  LeeFrame frame{.structure = builder.build()};
  frame.down =
      std::make_shared<ScaledObservable>(std::make_shared<FreedomObservable>(*frame.structure, vertical), -1.0);
  return frame;
}

State rest(const Structure& structure) { return {.x = Vector::Zero(structure.size({}))}; }

// A state in the middle of the snap, so that the matrices are typical: indefinite and far from rest.
State deformed(const LeeFrame& frame) {
  TraceOptions options{.step = {.first = 0.1}};
  options.landmarks.push_back({.quantity = frame.down, .value = 55.0, .stops = true, .label = "down"});
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
  const LeeFrame frame = lee_frame(elements);
  TraceOptions options{.step = {.first = 0.1}};
  options.landmarks.push_back({.quantity = frame.down, .value = end_down, .stops = true, .label = "down"});
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
  const LeeFrame frame = lee_frame(elements);
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
  const LeeFrame frame = lee_frame(elements);
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
  const LeeFrame frame = lee_frame(elements);
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
  const LeeFrame frame = lee_frame(elements);
  const State at = deformed(frame);
  Linearization now;
  frame.structure->linearize(at, now);
  BorderedSolver solver;
  if (solver.factorize(now, 0) != FactorStatus::ok) timing.SkipWithError("K is singular");
  const Row border{.dx = Vector::Zero(at.x.size()), .dlambda = 1.0};
  EquilibriumLine line;
  for (auto _ : timing) benchmark::DoNotOptimize(solver.line(border, line));
  per_element(timing, 1.0, elements);
}

void sizes(benchmark::internal::Benchmark* timing) {
  for (const int elements : {20, 200, 2000, 20000}) timing->Arg(elements);
}

BENCHMARK(path)->Apply(sizes)->Unit(benchmark::kMillisecond);
BENCHMARK(corrector)->Apply(sizes)->Unit(benchmark::kMicrosecond);
BENCHMARK(linearize)->Apply(sizes)->Unit(benchmark::kMicrosecond);
BENCHMARK(factorize)->Apply(sizes)->Unit(benchmark::kMicrosecond);
BENCHMARK(line_solve)->Apply(sizes)->Unit(benchmark::kMicrosecond);

}  // namespace

}  // namespace arcwall

BENCHMARK_MAIN();
