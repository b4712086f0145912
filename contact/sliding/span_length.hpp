#pragma once

#include "contact/sliding/unknowns.hpp"
#include "core/observable.hpp"

namespace arcwall::sliding {

/// The length of the span between a tracked point and the next one [length].
class SpanLength final : public Observable {
 public:
  explicit SpanLength(std::size_t point) : point_(static_cast<Index>(point)) {}

  double value(const State& state) const override {
    const SlidingUnknowns index(state.piece);
    return state.x[index.coordinate(point_ + 1)] - state.x[index.coordinate(point_)];
  }

  Row gradient(const State& state) const override {
    const SlidingUnknowns index(state.piece);
    Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
    row.dx[index.coordinate(point_ + 1)] = 1.0;
    row.dx[index.coordinate(point_)] = -1.0;
    return row;
  }

 private:
  Index point_;
};

}  // namespace arcwall::sliding
