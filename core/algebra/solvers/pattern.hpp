#pragma once

#include <algorithm>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// A copy of where a compressed matrix has entries. The indices are of 64 bits for the interface of CHOLMOD, whose
/// factors may have more entries than 32 bits count.
struct Pattern {
  std::vector<Index> columns{}, rows{};  ///< where each column begins, and the rows of its entries

  Pattern() = default;
  explicit Pattern(const SparseMatrix& A)
      : columns(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1),
        rows(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros()) {}

  /// Whether the numbers of rows, columns and entries are those of A.
  bool has_sizes_of(const SparseMatrix& A) const {
    return static_cast<Index>(columns.size()) == A.cols() + 1 && static_cast<Index>(rows.size()) == A.nonZeros();
  }

  bool is_of(const SparseMatrix& A) const {
    return has_sizes_of(A) && std::equal(columns.begin(), columns.end(), A.outerIndexPtr()) &&
           std::equal(rows.begin(), rows.end(), A.innerIndexPtr());
  }
};

}  // namespace arcwall
