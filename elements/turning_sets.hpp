#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "elements/nodal_terms.hpp"

namespace arcwall {

/// Which freedoms may all grow by 2π while F stays what it is. Slender beams see the direction of a section alone, so
/// that every rotation is a set by itself; what sees the difference of two makes one set of both; what sees a rotation
/// itself makes it none.
class TurningSets {
 public:
  explicit TurningSets(std::size_t freedoms) : first_(freedoms + 1) {
    std::iota(first_.begin(), first_.end(), Index{0});
  }

  void join(Index a, Index b) { first_[index(root(a + 1))] = root(b + 1); }
  void hold(Index freedom) { first_[index(root(freedom + 1))] = root(ground); }

  /// What supports and springs do.
  void add(const NodalTerms& terms) {
    for (Index freedom = 0; freedom + 1 < static_cast<Index>(first_.size()); ++freedom)
      if (terms.is_held(freedom) || terms.ground_stiffness(freedom) != 0.0) hold(freedom);
    for (const NodalTerms::Spring& spring : terms.springs()) join(spring.first, spring.second);
    for (const NodalTerms::LawSpring& spring : terms.law_springs()) {
      if (spring.first)
        join(*spring.first, spring.second);
      else
        hold(spring.second);
    }
  }

  /// A number that all of one set have; −1 of a freedom that is in none.
  Index of(Index freedom) const {
    const Index set = root(freedom + 1);
    return set == root(ground) ? -1 : set;
  }

 private:
  static constexpr Index ground = 0;  // freedoms follow

  static std::size_t index(Index i) { return static_cast<std::size_t>(i); }
  Index root(Index i) const {
    while (first_[index(i)] != i) i = std::exchange(first_[index(i)], first_[index(first_[index(i)])]);
    return i;
  }

  mutable std::vector<Index> first_;  // of each, one of the same set; paths are halved
};

}  // namespace arcwall
