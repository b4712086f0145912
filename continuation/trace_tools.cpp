#include "continuation/trace_tools.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcwall {

TraceTools::TraceTools(const System& from_system, TraceOptions from_options)
    : system(from_system),
      options(std::move(from_options)),
      corrector(system, options.corrector, std::abs(options.step.first), options.factorization),
      counter(system, corrector.factorized(), options.guard_tolerance, options.factorization),
      corner_workspace{.solver = BorderedSolver(options.factorization)} {}

// A spring that holds in both senses stays at its place.
bool TraceTools::ties_contact_to_nodes(const ActiveSet& active_set) const {
  for (std::size_t j = 0; j < std::min(options.node_contacts.size(), active_set.contacts()); ++j) {
    const auto contact = static_cast<Index>(j);
    const Enforcement how = system.enforcement(active_set, contact);
    const bool is_spring = how.two_sided && how.compliance > 0.0;
    if (options.node_contacts[j] && active_set[j] && !is_spring) return true;
  }
  return false;
}

std::vector<int> signs_at(const std::vector<EventDetector>& detectors, const PathPoint& point) {
  std::vector<int> signs;
  for (const EventDetector& detector : detectors) signs.push_back(sign_of(detector.value(point)));
  return signs;
}

}  // namespace arcwall
