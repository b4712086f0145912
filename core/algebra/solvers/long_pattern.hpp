#pragma once

#include <algorithm>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// Where a matrix has entries, as the 64-bit interfaces of CHOLMOD and UMFPACK read it: their factors may have more
/// entries than 32 bits count.
struct LongPattern {
  std::vector<Index> columns{}, rows{};  ///< where each column begins, and the rows of its entries

  LongPattern() = default;
  explicit LongPattern(const SparseMatrix& A)
      : columns(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1),
        rows(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros()) {}

  bool is_of(const SparseMatrix& A) const {
    return std::equal(columns.begin(), columns.end(), A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1) &&
           std::equal(rows.begin(), rows.end(), A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
  }
};

}  // namespace arcwall
