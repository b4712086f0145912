#pragma once

#include <optional>

#include "continuation/stability_count.hpp"
#include "continuation/trace_options.hpp"
#include "core/system.hpp"

namespace arcwall {

/// An equilibrium and what its second variation says.
struct CountedState {
  State state{};
  StabilityCount count{};
};

/// The equilibrium at λ of a guess that is near it, on its active set; empty where Newton's method finds none, or one
/// that enters an obstacle or at which a contact would pull. Of `options` those of Newton's method and of contact
/// count.
std::optional<CountedState> equilibrium_at_lambda(const System& system, const State& guess,
                                                  const TraceOptions& options);

}  // namespace arcwall
