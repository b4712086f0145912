#include "continuation/trace_tools.hpp"

#include <cmath>
#include <utility>

namespace arcwall {

TraceTools::TraceTools(const System& from_system, TraceOptions from_options)
    : system(from_system),
      options(std::move(from_options)),
      corrector(system, options.corrector, std::abs(options.step.first), options.factorization),
      counter(system, corrector.factorized(), options.guard_tolerance, options.factorization),
      corner_workspace{.solver = BorderedSolver(options.factorization)} {}

std::vector<int> signs_at(const std::vector<EventDetector>& detectors, const PathPoint& point) {
  std::vector<int> signs;
  for (const EventDetector& detector : detectors) signs.push_back(sign_of(detector.value(point)));
  return signs;
}

}  // namespace arcwall
