#pragma once

#include <optional>

#include "continuation/trace_options.hpp"
#include "core/state.hpp"
#include "model/assembly.hpp"

namespace arcwall {

/// Returns an equilibrium of moving contact behind the first step from rest: contact at the nodes chooses which parts
/// of members leave the walls that they rest on, and moving contact points complete it. `nodal`: options of the path
/// with contact at the nodes, which ends by a target value of λ; `options`: of the path that is begun. Empty if an
/// event lies between, or if no equilibrium of moving contact is near.
std::optional<State> begun_from_nodes(const Assembly& of, const TraceOptions& nodal, const TraceOptions& options);

}  // namespace arcwall
