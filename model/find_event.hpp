#pragma once

#include <functional>
#include <optional>
#include <string>

#include "continuation/path_point.hpp"
#include "continuation/tracer.hpp"
#include "model/model.hpp"

namespace arcwall {

/// An event with the arc of the path that ends at it.
struct FoundEvent {
  Arc arc;
  Event event;
};

/// The `number`-th event of a kind, the first being number 1: the model's paths are traced no farther than need be.
/// Empty, with the reason in `problem`, where there is none. `stopped` is asked at each point; true ends the search.
std::optional<FoundEvent> find_event(const Model& model, EventKind kind, int number,
                                     const std::function<bool()>& stopped, std::string& problem);

}  // namespace arcwall
