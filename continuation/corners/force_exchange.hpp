#pragma once

#include <optional>

#include "continuation/trace_tools.hpp"

namespace arcwall {

/// What is behind an exchange of forces.
struct ForceExchange {
  State state{};            ///< at the same λ and shape, with the new contact closed
  Index without_force = 0;  ///< the contact whose force has vanished; still closed
};

/// Where a contact closes at a place that the closed contacts hold already, the structure cannot follow: at constant λ
/// and shape its force grows from zero, those of the others change by K⁻¹, until the first of them vanishes. `closing`
/// is an open contact of the state without a gap. Empty where the structure moves with that force, by more than points
/// that coincide, or where no force vanishes.
std::optional<ForceExchange> exchange_forces(TraceTools& tools, const State& state, Index closing, double lambda_scale);

}  // namespace arcwall
