#include "core/pattern_fingerprint.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstddef>

namespace arcwall {

PatternFingerprint::PatternFingerprint(const SparseMatrix& A) : columns_(A.cols()), nonzeros_(A.nonZeros()) {
  const auto bytes = [](Index count) { return static_cast<std::size_t>(count) * sizeof(SparseIndex); };
  const XXH128_hash_t columns = XXH3_128bits(A.outerIndexPtr(), bytes(columns_ + 1));
  const XXH128_hash_t rows = XXH3_128bits(A.innerIndexPtr(), bytes(nonzeros_));
  const XXH64_hash_t all[]{columns.low64, columns.high64, rows.low64, rows.high64};
  const XXH128_hash_t hash = XXH3_128bits(all, sizeof all);
  low_ = hash.low64;
  high_ = hash.high64;
}

}  // namespace arcwall
