#pragma once

#include <cmath>

#include "contact/sliding/unknowns.hpp"
#include "core/observable.hpp"

namespace arcwall::sliding {

/// The length of the span between a tracked point and the next one [length].
class SpanLength final : public Observable {
 public:
  explicit SpanLength(std::size_t point) : point_(static_cast<Index>(point)) {}

  double value(const State& state) const override {
    const SlidingUnknowns index(state.active_set);
    return state.x[index.coordinate(point_ + 1)] - state.x[index.coordinate(point_)];
  }

  Row gradient(const State& state) const override {
    const SlidingUnknowns index(state.active_set);
    Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
    row.dx[index.coordinate(point_ + 1)] = 1.0;
    row.dx[index.coordinate(point_)] = -1.0;
    return row;
  }

 private:
  Index point_;
};

/// The length of a strand between a tracked point and an end [length].
class TailLength final : public Observable {
 public:
  /// `end`: the coordinate of the end.
  TailLength(std::size_t point, double end) : point_(static_cast<Index>(point)), end_(end) {}

  double value(const State& state) const override {
    return std::abs(end_ - state.x[SlidingUnknowns(state.active_set).coordinate(point_)]);
  }

  Row gradient(const State& state) const override {
    Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
    row.dx[SlidingUnknowns(state.active_set).coordinate(point_)] = end_ > 0.0 ? -1.0 : 1.0;
    return row;
  }

 private:
  Index point_;
  double end_;
};

}  // namespace arcwall::sliding
