#pragma once

#include <cstdint>

#include "core/types.hpp"

namespace arcwall {

/// Tells the patterns of compressed matrices apart without a copy of them, which would be large beside the factors of a
/// chain: by 128 bits (XXH3), which two that differ have in common once in 10³⁸.
class PatternFingerprint {
 public:
  /// Of no matrix.
  PatternFingerprint() = default;
  explicit PatternFingerprint(const SparseMatrix& A);

  bool operator==(const PatternFingerprint&) const = default;

  /// Whether the sizes alone are the same.
  bool has_sizes_of(const SparseMatrix& A) const { return columns_ == A.cols() && nonzeros_ == A.nonZeros(); }

 private:
  Index columns_ = -1, nonzeros_ = 0;
  std::uint64_t low_ = 0, high_ = 0;
};

}  // namespace arcwall
