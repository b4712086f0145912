#pragma once

#include <cstdint>
#include <span>

#include "core/state.hpp"

namespace arcwall {

/// 128 bits of numbers (XXH3) that tell them apart without a copy of them, which would be large beside the factors of a
/// chain: two lists that differ have them in common once in 10³⁸.
class Fingerprint {
 public:
  Fingerprint() = default;
  template <class Number>
  explicit Fingerprint(std::span<const Number> numbers) : Fingerprint(numbers.data(), numbers.size_bytes()) {}

  bool operator==(const Fingerprint&) const = default;

 private:
  Fingerprint(const void* bytes, std::size_t count);

  std::uint64_t low_ = 0, high_ = 0;
};

/// Of the pattern of a compressed matrix.
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
  Fingerprint starts_, rows_;
};

/// Of a state, to the last bit.
class StateFingerprint {
 public:
  /// Of no state.
  StateFingerprint() = default;
  explicit StateFingerprint(const State& state);

  bool operator==(const StateFingerprint&) const = default;

 private:
  Index size_ = -1;
  double lambda_ = 0.0;
  Piece piece_;
  Fingerprint x_;
};

}  // namespace arcwall
