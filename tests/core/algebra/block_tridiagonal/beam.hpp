#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/types.hpp"

namespace arcwall::test {

// A beam of length 1 and stiffness EI = 1, its nodes with the unknowns x, z and θ; cubic elements are exact at their
// nodes. It is held in z at all supports, places in eighths of its length, and in x at the first.
struct Beam {
  Index elements;
  std::vector<Index> supports;
  SparseMatrix lower{};
  std::vector<bool> translation_free{};

  Beam(Index of_elements, std::vector<Index> of_supports)
      : elements(of_elements), supports(std::move(of_supports)), unknown_(static_cast<std::size_t>(3 * elements + 3)) {
    Index next = 0;
    for (Index dof = 0; dof < 3 * elements + 3; ++dof)
      unknown_[static_cast<std::size_t>(dof)] = is_held(dof) ? -1 : next++;
    assemble(next);
    translation_free.resize(static_cast<std::size_t>(next));
    for (Index node = 0; node <= elements; ++node) {
      const auto is_support = [&](Index at) { return is_held(3 * at) || is_held(3 * at + 1); };
      if (!is_support(node) && !is_support(std::max(node - 1, Index{0})) && !is_support(std::min(node + 1, elements)))
        translation_free[static_cast<std::size_t>(unknown(3 * node))] = true;
    }
  }

  Index unknown(Index dof) const { return unknown_[static_cast<std::size_t>(dof)]; }
  Index deflection(Index eighths) const { return unknown(3 * (elements * eighths / 8) + 1); }

 private:
  bool is_held(Index dof) const {
    const auto first_of = [&](Index at) { return 3 * (elements * at / 8); };
    if (supports.empty()) return false;
    return dof == first_of(supports.front()) ||
           std::any_of(supports.begin(), supports.end(), [&](Index at) { return dof == first_of(at) + 1; });
  }

  void assemble(Index unknowns) {
    const double h = 1.0 / double(elements), EA = 12.0;
    Matrix block = Matrix::Zero(6, 6);  // of one element
    for (const Index a : {0, 1})
      for (const Index b : {0, 1}) {
        const double sign = a == b ? 1.0 : -1.0, side = a == 0 ? 1.0 : -1.0;
        block(3 * a, 3 * b) = sign * EA / h;
        block(3 * a + 1, 3 * b + 1) = sign * 12.0 / (h * h * h);
        block(3 * a + 1, 3 * b + 2) = block(3 * b + 2, 3 * a + 1) = side * 6.0 / (h * h);
        block(3 * a + 2, 3 * b + 2) = (a == b ? 4.0 : 2.0) / h;
      }
    std::vector<Eigen::Triplet<double, Index>> entries;
    for (Index e = 0; e < elements; ++e)
      for (Index i = 0; i < 6; ++i)
        for (Index j = 0; j <= i; ++j)
          if (unknown(3 * e + i) >= 0 && unknown(3 * e + j) >= 0)
            entries.emplace_back(unknown(3 * e + i), unknown(3 * e + j), block(i, j));
    lower.resize(unknowns, unknowns);
    lower.setFromTriplets(entries.begin(), entries.end());
  }

  std::vector<Index> unknown_;
};

}  // namespace arcwall::test
