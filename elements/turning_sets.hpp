#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "elements/nodal_terms.hpp"

namespace arcwall {

/// Which degrees of freedom may all grow by 2π while F stays what it is. Slender beams see the direction of a section
/// alone, so that every rotation is a set by itself; what sees the difference of two makes one set of both; what sees a
/// rotation itself makes it none.
class TurningSets {
 public:
  explicit TurningSets(std::size_t dofs) : first_(dofs + 1) { std::iota(first_.begin(), first_.end(), Index{0}); }

  void join(Index a, Index b) { first_[index(root(a + 1))] = root(b + 1); }
  void hold(Index dof) { first_[index(root(dof + 1))] = root(ground); }

  /// What supports and springs do.
  void add(const NodalTerms& terms) {
    for (Index dof = 0; dof + 1 < static_cast<Index>(first_.size()); ++dof)
      if (terms.is_held(dof) || terms.ground_stiffness(dof) != 0.0) hold(dof);
    for (const NodalTerms::Spring& spring : terms.springs()) join(spring.first, spring.second);
    for (const NodalTerms::LawSpring& spring : terms.law_springs()) {
      if (spring.first)
        join(*spring.first, spring.second);
      else
        hold(spring.second);
    }
  }

  /// A number that all of one set have; −1 of a degree of freedom that is in none.
  Index of(Index dof) const {
    const Index set = root(dof + 1);
    return set == root(ground) ? -1 : set;
  }

 private:
  static constexpr Index ground = 0;  // degrees of freedom follow

  static std::size_t index(Index i) { return static_cast<std::size_t>(i); }
  Index root(Index i) const {
    while (first_[index(i)] != i) i = std::exchange(first_[index(i)], first_[index(first_[index(i)])]);
    return i;
  }

  mutable std::vector<Index> first_;  // of each, one of the same set; paths are halved
};

}  // namespace arcwall
