#include "continuation/committed_point.hpp"

#include <utility>

#include "continuation/step/point_on_path.hpp"

namespace arcwall {

namespace {

// The sign of the determinant of the equations times that of the rate of λ, which goes on where what slips changes; 0
// where it is not known.
int orientation(const PathPoint& at) {
  const double rate = at.tangent.dlambda;
  if (!at.negative_eigenvalues || rate == 0.0) return 0;
  return (*at.negative_eigenvalues % 2 == 0) == (rate > 0.0) ? 1 : -1;
}

}  // namespace

// What slips depends on the tangent, and that on what slips: all that contradict each other change, and after some
// rounds one after the other.
std::optional<bool> commit(TraceTools& tools, const Metric& metric, const Direction& forward, double length,
                           PathPoint& at) {
  constexpr int together = 10, most_rounds = 1000;  // each point changes a few times, of some hundred on a wall
  const PathHistory* const history = tools.system.history();
  if (history == nullptr) return false;
  at.state = history->committed(at.state, at.tangent, length);
  const int arriving = length > 0.0 ? orientation(at) : 0;
  bool has_changed = false;
  for (int round = 0; round < most_rounds; ++round) {
    PathHistory::Leaving next = history->leaving(at.state, at.tangent, round >= together);
    if (!next.has_changed) {
      at.state = std::move(next.state);
      return has_changed;
    }
    CorrectorResult seen = tools.corrector.inspect(next.state, metric, at.tangent);
    if (!seen.converged()) return std::nullopt;
    PathPoint turned = path_point(tools.system, metric, std::move(seen), forward);
    decide_count(tools, turned);
    if (arriving * orientation(turned) < 0) {
      turned.tangent = reversed(std::move(turned.tangent));
      turned.guard_rates *= -1.0;
    }
    turned.arc = at.arc;
    turned.iterations = at.iterations;
    turned.unsettled = at.unsettled;
    turned.count = tools.counter.count(turned.state, turned.negative_eigenvalues);
    at = std::move(turned);
    has_changed = true;
  }
  return std::nullopt;
}

BranchEnd end_without_tangent() {
  return {.reason = EndReason::no_continuation,
          .detail = "no motion was found in which all places that slip on compliant walls agree"};
}

}  // namespace arcwall
