#pragma once

#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// Adds to each event of a record at which a stable structure loses its stability where that falls to at the same λ
/// (docs/theory.md, section 15): by descent among the obstacles on the deck's mesh, and from there to an equilibrium of
/// the path's own formulation, whether a traced branch passes it or not. `record` is a run of `model` that has ended.
void add_jumps(const Model& model, Record& record);

}  // namespace arcwall
