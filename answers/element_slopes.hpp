#pragma once

#include "model/model.hpp"

namespace arcwall {

/// The greatest angle by which an element's end has turned against the element's chord [rad]; of bars 0. An element
/// that is bent to an arc turns by twice that.
double greatest_slope(const Model& model, const State& state);

/// Slopes up to which elements tell how their body bends [rad]. Far beyond, the energy of an element that is hardly
/// longer than its section is high has a second well, in which it has collapsed to a fifth of its length: its ends lean
/// on its chord by 0.3 rad and more there.
inline constexpr double greatest_resolved_slope = 0.15;

}  // namespace arcwall
