#include "core/algebra/fingerprint.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace arcwall {

namespace {

template <class Number>
std::span<const Number> numbers_at(const Number* first, Index count) {
  return {first, static_cast<std::size_t>(count)};
}

}  // namespace

Fingerprint::Fingerprint(const void* bytes, std::size_t count) {
  const XXH128_hash_t hash = XXH3_128bits(bytes, count);
  low_ = hash.low64;
  high_ = hash.high64;
}

PatternFingerprint::PatternFingerprint(const SparseMatrix& A)
    : columns_(A.cols()),
      nonzeros_(A.nonZeros()),
      starts_(numbers_at(A.outerIndexPtr(), columns_ + 1)),
      rows_(numbers_at(A.innerIndexPtr(), nonzeros_)) {}

StateFingerprint::StateFingerprint(const State& state)
    : size_(state.x.size()), lambda_(state.lambda), piece_(state.piece), x_(numbers_at(state.x.data(), size_)) {}

}  // namespace arcwall
