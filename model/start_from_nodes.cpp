#include "model/start_from_nodes.hpp"

#include <utility>

#include "continuation/equilibria/equilibrium_at.hpp"
#include "continuation/tracer.hpp"
#include "model/deck_mesh.hpp"

namespace arcwall {

namespace {

// The end of the path from rest with contact at the nodes, if no event lies on the way but the contacts at λ = 0.
std::optional<State> of_nodes(const Assembly& of, const TraceOptions& options) {
  State rest{.x = {}, .lambda = 0.0, .active_set = of.contact->open_active_set()};
  rest.x = Vector::Zero(of.contact->size(rest.active_set));
  Tracer tracer(*of.contact, rest, options);
  State last = rest;
  while (const auto arc = tracer.next()) {
    for (const Event& event : arc->events)
      if (event.state.lambda != 0.0 && event.kind != EventKind::end) return std::nullopt;
    last = arc->to.state;
  }
  if (tracer.end()->reason != EndReason::stop) return std::nullopt;
  return last;
}

}  // namespace

std::optional<State> begun_from_nodes(const Assembly& of, const TraceOptions& nodal, const TraceOptions& options) {
  const std::optional<State> nodes = of_nodes(of, nodal);
  if (!nodes) return std::nullopt;
  constexpr double none = 0.0, roundoff = 1e-7;
  for (const State& guess : in_moving_formulation(of, *nodes, {none, roundoff}))
    if (auto found = equilibrium_at_lambda(of.system(), guess, options)) return std::move(found->state);
  return std::nullopt;
}

}  // namespace arcwall
