#include "core/algebra/block_tridiagonal/block_tridiagonal_ldlt.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <utility>

namespace arcwall {

namespace {

constexpr Index displacements = 2;  // of a node, its first unknowns
constexpr Index none = -1;

}  // namespace

BlockTridiagonalLdlt::BlockTridiagonalLdlt(const SparseMatrix& A, const Blocks& blocks,
                                           const std::vector<bool>& translation_free)
    : block_count_(static_cast<Index>(blocks.size())), unknown_count_(A.cols()) {
  Index greatest = 1;
  for (const auto& block : blocks) greatest = std::max(greatest, static_cast<Index>(block.size()));
  const Index width = elimination_width(greatest);
  assert(width > 0);
  const bool knows = can_know_translations(width) &&
                     std::find(translation_free.begin(), translation_free.end(), true) != translation_free.end();
  chain_ = BlockChain(width, block_count_, knows);
  find_values(A, blocks);
  find_unknowns(blocks);
  set_translation_free(translation_free);
  work_.resize(static_cast<std::size_t>(2 * (chain_.length + 1) * width));
}

// A coupling is stored with the block of odd number in its part, or with the last one of a part.
BlockTridiagonalLdlt::Spot BlockTridiagonalLdlt::spot_of(Index block, Index row, Index other, Index other_row) const {
  const BlockLayout at = chain_.layout();
  const Index length = chain_.length;
  if (block == other)
    return {.record = block % length, .place = at.diagonal(std::max(row, other_row), std::min(row, other_row))};
  if (block > other) {
    std::swap(block, other);
    std::swap(row, other_row);
  }
  const Index record = block % length;
  if (record % 2 == 1 || record + 1 == length) return {.record = record, .place = at.behind(row, other_row)};
  return {.record = record + 1, .place = at.before(other_row, row)};
}

void BlockTridiagonalLdlt::find_values(const SparseMatrix& A, const Blocks& blocks) {
  std::vector<std::int32_t> block_of(static_cast<std::size_t>(A.cols())), row_of(block_of);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t k = 0; k < blocks[b].size(); ++k) {
      block_of[static_cast<std::size_t>(blocks[b][k])] = static_cast<std::int32_t>(b);
      row_of[static_cast<std::size_t>(blocks[b][k])] = static_cast<std::int32_t>(k);
    }
  const Index count = chain_.layout().size(), length = chain_.length;
  std::vector<std::int32_t> value_at(static_cast<std::size_t>(BlockChain::parts * length * count), none);
  const Index first = blocks[blocks.size() > 1 ? 1 : 0].front();  // its pivot is an entry of A
  std::int32_t value = 0;
  for (Index column = 0; column < A.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry, ++value) {
      if (entry.row() == first && column == first) padding_ = value;
      const auto i = static_cast<std::size_t>(entry.row()), j = static_cast<std::size_t>(column);
      const Spot spot = spot_of(block_of[i], row_of[i], block_of[j], row_of[j]);
      const Index part = std::min(block_of[i], block_of[j]) / length;
      value_at[static_cast<std::size_t>((part * length + spot.record) * count + spot.place)] = value;
    }
  // Blocks of even number have no couplings of their own before the first elimination.
  std::vector<Index> list;
  for (Index block = 0; block < BlockChain::parts * length; ++block) {
    const Index record = block % length;
    const bool couples = record % 2 == 1 || record + 1 == length;
    const auto from = value_at.begin() + block * count;
    list.assign(from, from + (couples ? count : packed(chain_.width, 0)));
    values_.add(list);
  }
  values_.complete();
  if (chain_.knows_translations) block_of_ = std::move(block_of);
}

void BlockTridiagonalLdlt::find_unknowns(const Blocks& blocks) {
  for (Index block = 0; block < BlockChain::parts * chain_.length; ++block) {
    std::vector<Index> list;
    if (block < block_count_) list = blocks[static_cast<std::size_t>(block)];
    const auto size = static_cast<Index>(list.size());
    if (size < chain_.width) narrow_.push_back({.block = block, .size = size});
    list.resize(static_cast<std::size_t>(chain_.width), none);
    unknowns_.add(list);
  }
  unknowns_.complete();
}

bool BlockTridiagonalLdlt::is_node_with_translations(Index block, const std::vector<bool>& translation_free) const {
  const ShiftedIndices unknowns = unknowns_[block];
  const auto is_first = [&](Index unknown) {
    return unknown >= 0 && translation_free[static_cast<std::size_t>(unknown)];
  };
  if (!is_first(unknowns[0]) || unknowns[1] != unknowns[0] + 1) return false;
  for (std::size_t k = 1; k < unknowns.size(); ++k)
    if (is_first(unknowns[k])) return false;
  return true;
}

// A block is free where it and its neighbours are nodes that are translation-free: only then Σ_b A_ab T is zero for it.
void BlockTridiagonalLdlt::set_translation_free(const std::vector<bool>& translation_free) {
  if (!chain_.knows_translations) return;
  grounded_before_.assign(1, 0);
  bool before = true, own = is_node_with_translations(0, translation_free);
  for (Index block = 0; block < BlockChain::parts * chain_.length; ++block) {
    const bool behind = block + 1 >= block_count_ || is_node_with_translations(block + 1, translation_free);
    const bool is_free = block < block_count_ && before && own && behind;
    grounded_before_.push_back(grounded_before_.back() + (is_free ? 0 : 1));
    before = std::exchange(own, behind);
  }
}

// Whether nothing but ground terms resists a block's translations.
bool BlockTridiagonalLdlt::is_free(Index block) const {
  const auto i = static_cast<std::size_t>(block);
  return grounded_before_[i + 1] == grounded_before_[i];
}

FactorStatus BlockTridiagonalLdlt::factorize(const SparseMatrix& A, const MatrixProperties& known) {
  const double padding = padding_ ? A.valuePtr()[*padding_] : 0.0;
  read(A, padding);
  if (chain_.knows_translations) find_ground_parts(known.ground);
  const bool usable = read_pivots(eliminate_blocks(chain_), padding);
  refused_ = usable && has_grown(A);
  if (usable) return refused_ ? FactorStatus::singular : FactorStatus::ok;
  return is_finite(A) ? FactorStatus::singular : FactorStatus::not_finite;  // no pivot is spared from what is not
}

void BlockTridiagonalLdlt::read(const SparseMatrix& A, double padding) {
  for (Index record = 0; record < chain_.length; ++record)
    gather(values_, record, A.valuePtr(), 1, chain_.block(record));
  for (const Narrow& narrow : narrow_)
    for (Index k = narrow.size; k < chain_.width; ++k) number(narrow.block, chain_.layout().diagonal(k, k)) = padding;
}

// From an array to the numbers of a block of each part, `step` apart.
void BlockTridiagonalLdlt::gather(const ShiftedLists& lists, Index record, const double* array, Index step,
                                  Lanes* to) const {
  const Index length = chain_.length;
  const std::array from{lists[record], lists[length + record], lists[2 * length + record], lists[3 * length + record]};
  const auto value = [&](std::size_t part, std::size_t k) {
    const std::int32_t offset = from[part].offsets()[k];
    return offset < 0 ? 0.0 : array[from[part].first() + offset];
  };
  for (std::size_t k = 0; k < from[0].size(); ++k)
    to[static_cast<Index>(k) * step] = Lanes(value(0, k), value(1, k), value(2, k), value(3, k));
}

void BlockTridiagonalLdlt::scatter(const ShiftedLists& lists, Index record, const Lanes* from, Index step,
                                   double* array) const {
  for (Index part = 0; part < BlockChain::parts; ++part) {
    const ShiftedIndices to = lists[part * chain_.length + record];
    for (std::size_t k = 0; k < to.size(); ++k)
      if (to[k] >= 0) array[to[k]] = from[static_cast<Index>(k) * step][static_cast<int>(part)];
  }
}

// R, by which each block resists translations, in place of two columns of D: ground terms where it is free.
void BlockTridiagonalLdlt::find_ground_parts(GroundTerms ground) {
  const BlockLayout at = chain_.layout();
  const Index length = chain_.length;
  for (Index record = 0; record < length; ++record) {
    const auto is_free_in = [&](Index part) { return is_free(part * length + record); };
    if (is_free_in(0) && is_free_in(1) && is_free_in(2) && is_free_in(3)) {
      for (Index column = 0; column < displacements; ++column)
        for (Index row = 0; row < chain_.width; ++row) chain_.block(record)[at.ground(row, column)] = 0.0;
      continue;
    }
    for (Index part = 0; part < BlockChain::parts; ++part) find_ground_part(part * length + record, is_free_in(part));
  }
  for (const GroundTerm& term : ground) {
    const Index block = block_of_[static_cast<std::size_t>(term.row)];
    if (!is_free(block)) continue;  // K's own entries count there
    const auto row = static_cast<Index>(unknowns_[block].place_of(term.row));
    const auto column = static_cast<Index>(unknowns_[block].place_of(term.column));
    if (column < displacements) number(block, at.ground(row, column)) += term.stiffness;
    if (row < displacements && row != column) number(block, at.ground(column, row)) += term.stiffness;
  }
}

// Zero, or D T + Σ_b A_ab T, which is no small difference where a support or a contact is near.
void BlockTridiagonalLdlt::find_ground_part(Index block, bool is_free) {
  const BlockLayout at = chain_.layout();
  const Index length = chain_.length;
  for (Index column = displacements; column-- > 0;)  // from the last, as R takes the place of D's entries
    for (Index row = 0; row < chain_.width; ++row) {
      double& R = number(block, at.ground(row, column));
      R = is_free ? 0.0 : number(block, at.diagonal(std::max(row, column), std::min(row, column)));
      if (is_free) continue;
      for (const Index other : {block - 1, block + 1}) {
        if (other < 0 || other >= BlockChain::parts * length) continue;
        const Spot spot = spot_of(block, row, other, column);
        R += number(std::min(block, other) / length * length + spot.record, spot.place);
      }
    }
}

double& BlockTridiagonalLdlt::number(Index block, Index place) {
  Lanes& lanes = chain_.block(block % chain_.length)[place];
  return reinterpret_cast<double*>(&lanes)[block / chain_.length];
}

// False for a pivot that is zero, or so near that it is what rounding has left of rounding errors, or not finite. Where
// there is no unknown, the padding is a pivot: one of those seen elsewhere.
bool BlockTridiagonalLdlt::read_pivots(const PivotScan<double>& scan, double padding) {
  const Index padded = BlockChain::parts * chain_.length * chain_.width - unknown_count_;
  const Index negative = static_cast<Index>(scan.negative) - (padding < 0.0 ? padded : 0);
  pivots_ = {.signs = {.negative = negative, .positive = unknown_count_ - negative},
             .least = 1.0 / scan.greatest,
             .greatest = 1.0 / scan.least};
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  return pivots_.greatest < infinity && scan.sum < infinity && pivots_.least > epsilon * epsilon * pivots_.greatest;
}

// Whether a pivot is much greater than all entries: after one of δ stands one of c²/δ. Then these two are far apart.
bool BlockTridiagonalLdlt::has_grown(const SparseMatrix& A) const {
  constexpr double much = 1e5;
  // On fine meshes pivots always differ that much, but the greatest is no greater than what one entry tells already.
  const double one = padding_ ? std::abs(A.valuePtr()[*padding_]) : 0.0;
  return pivots_.least * much * much < pivots_.greatest && pivots_.greatest > much * one && growth(A) > much;
}

void BlockTridiagonalLdlt::solve(Eigen::Ref<Matrix> X) const {
  for (Index first = 0; first < X.cols(); first += 2) {
    const Index columns = std::min<Index>(2, X.cols() - first), step = chain_.width * columns;
    for (Index c = 0; c < columns; ++c)
      for (Index record = 0; record < chain_.length; ++record)
        gather(unknowns_, record, X.col(first + c).data(), columns, work_.data() + record * step + c);
    solve_blocks(chain_, columns, work_.data());
    for (Index c = 0; c < columns; ++c)
      for (Index record = 0; record < chain_.length; ++record)
        scatter(unknowns_, record, work_.data() + record * step + c, columns, X.col(first + c).data());
  }
}

double BlockTridiagonalLdlt::weighted(const Eigen::Ref<const Vector>& v) const {
  for (Index record = 0; record < chain_.length; ++record)
    gather(unknowns_, record, v.data(), 1, work_.data() + record * chain_.width);
  return weighted_by_blocks(chain_, grounded_before_, work_.data());
}

}  // namespace arcwall
