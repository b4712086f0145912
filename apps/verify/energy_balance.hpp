#pragma once

#include "apps/verify/findings.hpp"
#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall::verify {

/// Checks along a branch of a deck with friction that what is dissipated never falls, that it is −∫ T dw of the forces
/// and places at its points, and that the work done is the energy stored and dissipated. Bounds are the errors of
/// the quadratures, by how much trapezoids differ from polynomials through four points, and of the rates by λ. `model`:
/// of the branch's stage.
void check_energy_balance(const Model& model, const Record& record, Index branch, Findings& findings);

}  // namespace arcwall::verify
