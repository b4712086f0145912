#pragma once

#include <cstddef>
#include <utility>

#include "core/types.hpp"

namespace arcwall::verify {

/// The unknowns of a state, of which a few at a time are given other values while somebody looks at all of them. Copies
/// for each element or contact would take memory and time with the square of their number.
class MovedUnknowns {
 public:
  explicit MovedUnknowns(Vector x) : x_(std::move(x)) {}

  double value(Index unknown) const { return x_[unknown]; }

  /// visit(x) where the unknowns with these indices have the values u; −1 stands for what is held. Not from inside
  /// another visit, nor by several threads.
  template <class Indices, class Visit>
  auto with(const Indices& unknowns, const Vector& u, const Visit& visit) const {
    const Vector before = exchanged(unknowns, u);
    auto result = visit(std::as_const(x_));
    exchanged(unknowns, before);
    return result;
  }

 private:
  template <class Indices>
  Vector exchanged(const Indices& unknowns, const Vector& u) const {
    Vector before = u;
    for (std::size_t i = 0; i < static_cast<std::size_t>(u.size()); ++i)
      if (unknowns[i] >= 0) before[static_cast<Index>(i)] = std::exchange(x_[unknowns[i]], u[static_cast<Index>(i)]);
    return before;
  }

  mutable Vector x_;
};

}  // namespace arcwall::verify
