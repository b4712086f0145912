#pragma once

#include "continuation/path_point.hpp"
#include "model/model.hpp"
#include "model/path_answers.hpp"
#include "model/record.hpp"

namespace arcwall {

/// Returns the jump from an event at which a stable structure loses its stability; `behind`: its path behind the event.
/// Of two mirror images the one on which the first monitor that changes increases.
Fall fall_beyond(const Model& model, const Event& lost, const PathPoint& behind);

/// Adds to each event of a record at which a stable structure loses its stability where that falls to at the same λ
/// (docs/theory.md, section 15): by descent among the obstacles on the deck's mesh, and from there to an equilibrium of
/// the path's own formulation, whether a traced branch passes it or not. `record` is a run of `model` that has ended.
void add_jumps(const Model& model, Record& record);

}  // namespace arcwall
