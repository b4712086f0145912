#pragma once

#include <optional>
#include <vector>

#include "continuation/trace_options.hpp"
#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// An equilibrium of a traced path at a λ.
struct OnPath {
  State state{};
  std::size_t point = 0;  ///< of the record: the last one before it
  double arc = 0.0;       ///< along its branch, or from the state where it was traced from one
  std::optional<Index> unstable{};
};

/// What to trace a path with that begins with λ towards a value and ends there.
TraceOptions options_towards(const Model& model, const State& from, double lambda);

/// Which path is followed: all of it, or no further than it is stable.
enum class Follow { path, stable_path };

/// From a point of the path to the λ, along the path; empty where it does not lead there.
std::optional<OnPath> at_lambda(const Model& model, const State& from, double lambda, Follow follow = Follow::path);

/// The points of a record between each of which and the next one of its branch the path passes through a λ.
std::vector<std::size_t> crossings(const Record& record, double lambda);

/// The equilibrium at a λ behind such a point.
std::optional<OnPath> at_crossing(const Model& model, const Record& record, std::size_t point, double lambda);

}  // namespace arcwall
