#include "core/algebra/block_tridiagonal/held_chain.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace arcwall {

namespace {

constexpr Index no_entry = -1;

// Of an entry of a lower triangle in its values.
Index place_of(const SparseMatrix& A, Index one, Index other) {
  const Index column = std::min(one, other), row = std::max(one, other);
  const SparseIndex* first = A.innerIndexPtr() + A.outerIndexPtr()[column];
  const SparseIndex* last = A.innerIndexPtr() + A.outerIndexPtr()[column + 1];
  const SparseIndex* at = std::lower_bound(first, last, row);
  return at != last && *at == row ? at - A.innerIndexPtr() : no_entry;
}

}  // namespace

std::unique_ptr<HeldChain> HeldChain::of(const SparseMatrix& matrix, Index multipliers, const ChainGroups& groups) {
  const Index n = matrix.cols() - multipliers;
  SparseMatrix A = matrix.topLeftCorner(n, n);
  A.makeCompressed();
  std::unique_ptr<HeldChain> chain(new HeldChain(A, groups));
  return chain->adopts(matrix, multipliers) ? std::move(chain) : nullptr;
}

bool HeldChain::adopts(const SparseMatrix& matrix, Index multipliers) {
  return matrix.cols() - multipliers == A_.cols() && find_chunks(matrix, multipliers) &&
         find_holds(matrix, multipliers);
}

// In each column A's entries come first; only multipliers may follow.
bool HeldChain::find_chunks(const SparseMatrix& matrix, Index multipliers) {
  const Index n = matrix.cols() - multipliers;
  const SparseIndex *start = matrix.outerIndexPtr(), *row = matrix.innerIndexPtr();
  const SparseIndex *start_of_A = A_.outerIndexPtr(), *row_of_A = A_.innerIndexPtr();
  chunks_.clear();
  for (Index column = 0; column < n; ++column) {
    const Index from = start[column], to = start_of_A[column], count = start_of_A[column + 1] - to;
    const Index all = start[column + 1] - from;
    if (all < count || !std::equal(row_of_A + to, row_of_A + to + count, row + from)) return false;
    if (all > count && row[from + count] < n) return false;
    if (!chunks_.empty() && chunks_.back().from + chunks_.back().count == from)
      chunks_.back().count += count;
    else
      chunks_.push_back({.from = from, .to = to, .count = count});
  }
  return true;
}

bool HeldChain::find_holds(const SparseMatrix& matrix, Index multipliers) {
  holds_.clear();
  if (multipliers == 0) return true;
  const Index n = matrix.cols() - multipliers;
  const SparseIndex *start = matrix.outerIndexPtr(), *row = matrix.innerIndexPtr();
  struct Entry {
    std::size_t group, position;
    Index place;
  };
  std::vector<std::vector<Entry>> rows(static_cast<std::size_t>(multipliers));
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (std::size_t k = 0; k < groups_[g].size(); ++k) {
      const Index column = groups_[g][k];
      for (Index at = start[column + 1]; at-- > start[column] && row[at] >= n;)
        rows[static_cast<std::size_t>(row[at] - n)].push_back({.group = g, .position = k, .place = at});
    }
  std::map<std::size_t, Hold> by_group;
  for (std::size_t m = 0; m < rows.size(); ++m) {
    const Index multiplier = n + static_cast<Index>(m), diagonal = start[multiplier];
    const bool has_diagonal_alone = start[multiplier + 1] == diagonal + 1 && row[diagonal] == multiplier;
    if (rows[m].empty() || rows[m].front().group != rows[m].back().group || !has_diagonal_alone) return false;
    const std::size_t group = rows[m].front().group;
    Hold& hold = by_group.try_emplace(group, Hold{.unknowns = &groups_[group]}).first->second;
    hold.multipliers.push_back(multiplier);
    hold.compliance.push_back(diagonal);
    hold.row.emplace_back(groups_[group].size(), no_entry);
    for (const Entry& entry : rows[m]) hold.row.back()[entry.position] = entry.place;
  }
  for (auto& [group, hold] : by_group) {
    if (hold.multipliers.size() > hold.unknowns->size() || !find_blocks(hold, group)) return false;
    holds_.push_back(std::move(hold));
  }
  return true;
}

// Turned coordinates couple with all that any of the group's unknowns couples with. Groups of separate parts of a chain
// do not couple.
bool HeldChain::find_blocks(Hold& hold, std::size_t group) const {
  const auto add = [&](const Unknowns& columns) {
    Block block{.columns = &columns, .places = {}};
    for (const Index column : columns)
      for (const Index row : *hold.unknowns) block.places.push_back(place_of(A_, row, column));
    const auto missing = std::count(block.places.begin(), block.places.end(), no_entry);
    if (missing == 0) hold.blocks.push_back(std::move(block));
    return missing == 0 || missing == static_cast<std::ptrdiff_t>(columns.size() * hold.unknowns->size());
  };
  return add(groups_[group]) && !hold.blocks.empty() && (group == 0 || add(groups_[group - 1])) &&
         (group + 1 == groups_.size() || add(groups_[group + 1]));
}

HeldChain::Small HeldChain::values(const Hold& hold, const Block& block) const {
  Small values(hold.unknowns->size(), block.columns->size());
  for (std::size_t i = 0; i < block.places.size(); ++i) values.data()[i] = A_.valuePtr()[block.places[i]];
  return values;
}

void HeldChain::set_values(const Block& block, const Small& values) {
  for (std::size_t i = 0; i < block.places.size(); ++i) A_.valuePtr()[block.places[i]] = values.data()[i];
}

// Rows are taken out of the chain only once all groups have been turned and all rows have been kept.
bool HeldChain::factorize(const SparseMatrix& matrix) {
  for (const Chunk& chunk : chunks_) std::copy_n(matrix.valuePtr() + chunk.from, chunk.count, A_.valuePtr() + chunk.to);
  pivots_ = {};
  refused_ = false;
  for (Hold& hold : holds_)
    if (!turn(matrix, hold)) return false;
  for (Hold& hold : holds_) {
    hold.rows.clear();
    for (const Block& block : hold.blocks) {
      hold.rows.push_back(values(hold, block).topRows(hold.c.size()));
      if (!hold.rows.back().allFinite()) return false;
    }
  }
  for (Hold& hold : holds_) take_out(hold);
  const bool regular = chain_.factorize(A_);
  refused_ = chain_.refused();
  pivots_.add(chain_.pivots());
  return regular;
}

// Cᵀ = Q R, A := QᵀAQ. False where two multipliers hold the same, or entries are not finite.
bool HeldChain::turn(const SparseMatrix& matrix, Hold& hold) {
  const auto count = static_cast<Index>(hold.multipliers.size());
  const auto c_of = [&](Index j) { return -matrix.valuePtr()[hold.compliance[static_cast<std::size_t>(j)]]; };
  hold.order.clear();
  for (const bool rigid : {true, false}) {
    for (Index j = 0; j < count; ++j)
      if ((c_of(j) == 0.0) == rigid) hold.order.push_back(j);
    if (rigid) hold.rigid = static_cast<Index>(hold.order.size());
  }
  hold.c.resize(count);
  Small Ct = Small::Zero(static_cast<Index>(hold.unknowns->size()), count);
  for (Index j = 0; j < count; ++j) {
    const Index which = hold.order[static_cast<std::size_t>(j)];
    hold.c[j] = c_of(which);
    const std::vector<Index>& row = hold.row[static_cast<std::size_t>(which)];
    for (std::size_t i = 0; i < row.size(); ++i)
      if (row[i] != no_entry) Ct(static_cast<Index>(i), j) = matrix.valuePtr()[row[i]];
  }
  if (!Ct.allFinite() || !hold.c.allFinite()) return false;
  const Eigen::HouseholderQR<Small> qr(Ct);
  hold.Q = qr.householderQ() * Small::Identity(Ct.rows(), Ct.rows());
  hold.R = qr.matrixQR().topRows(count).triangularView<Eigen::Upper>();
  for (Index j = 0; j < hold.rigid; ++j)
    if (hold.R(j, j) == 0.0) return false;
  for (const Block& block : hold.blocks) {
    Small turned = hold.Q.transpose() * values(hold, block);
    if (block.columns == hold.unknowns) turned *= hold.Q;
    set_values(block, turned);
  }
  return true;
}

// In place of the rows stand pivots as large as what else is there. Those of the multipliers are as large, and less
// where one holds almost what others hold.
void HeldChain::take_out(Hold& hold) {
  const Index rigid = hold.rigid, soft = hold.c.size() - rigid;
  const Block& own_block = hold.blocks.front();
  Small own = values(hold, own_block);
  const double greatest = own.cwiseAbs().maxCoeff(), scale = greatest > 0.0 ? greatest : 1.0;
  own.topRows(rigid).setZero();
  own.leftCols(rigid).setZero();
  own.diagonal().head(rigid).setConstant(scale);
  const auto R = hold.R.bottomRightCorner(soft, soft);
  own.block(rigid, rigid, soft, soft) += R * hold.c.tail(soft).cwiseInverse().asDiagonal() * R.transpose();
  set_values(own_block, own);
  for (std::size_t b = 1; b < hold.blocks.size(); ++b) {
    Small beside = values(hold, hold.blocks[b]);
    beside.topRows(rigid).setZero();
    set_values(hold.blocks[b], beside);
  }
  hold.is_stiff.clear();
  for (Index j = 0; j < hold.c.size(); ++j) {
    const double share = hold.R(j, j) / hold.R.col(j).norm();
    hold.is_stiff.push_back(hold.R(j, j) * hold.R(j, j) >= std::abs(hold.c[j]) * scale);
    pivots_.add(j < rigid ? -scale * share * share : -std::copysign(scale, hold.c[j]));
  }
}

// A group's entries of a long vector, and back. Eigen's x(unknowns) would copy the list to the heap each time, and so
// would its products of such entries, but for lazy ones.
HeldChain::SmallVector HeldChain::gathered(const Eigen::Ref<const Vector>& x, const Unknowns& unknowns) {
  SmallVector entries(static_cast<Index>(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i) entries[static_cast<Index>(i)] = x[unknowns[i]];
  return entries;
}

void HeldChain::scatter(const SmallVector& entries, const Unknowns& unknowns, Eigen::Ref<Vector> x) {
  for (std::size_t i = 0; i < unknowns.size(); ++i) x[unknowns[i]] = entries[static_cast<Index>(i)];
}

HeldChain::SmallVector HeldChain::turned(const Hold& hold, const Eigen::Ref<const Vector>& x) {
  return hold.Q.transpose().lazyProduct(gathered(x, *hold.unknowns));
}

// With r the rigid and s the soft multipliers of a group, K the rows of QᵀAQ that they hold and f in turned
// coordinates:
//
//   R_rrᵀ w_r = g_r,   A w = f − K_rᵀ w_r − R_ss c⁻¹ (R_rsᵀ w_r − g_s)                                    (1)
//
// Then R p = f − K w and c p = Rᵀ w − g: each multiplier from that of the two where fewer digits cancel.   (2)
void HeldChain::solve(Eigen::Ref<Matrix> X) const {
  known_.resize(holds_.size() * static_cast<std::size_t>(X.cols()));
  const auto known = [&](Index column, std::size_t h) -> Known& {
    return known_[static_cast<std::size_t>(column) * holds_.size() + h];
  };
  for (Index column = 0; column < X.cols(); ++column) {
    auto x = X.col(column);
    for (std::size_t h = 0; h < holds_.size(); ++h) known(column, h) = turn_right_hand_side(holds_[h], x);
    for (std::size_t h = 0; h < holds_.size(); ++h) move_known(holds_[h], known(column, h), x);
    for (const Hold& hold : holds_)
      for (Index j = 0; j < hold.rigid; ++j) x[hold.unknown(j)] = 0.0;
  }
  chain_.solve(X.topRows(A_.cols()));
  for (Index column = 0; column < X.cols(); ++column) {
    auto x = X.col(column);
    for (std::size_t h = 0; h < holds_.size(); ++h)
      for (Index j = 0; j < holds_[h].rigid; ++j) x[holds_[h].unknown(j)] = known(column, h).w[j];
    for (std::size_t h = 0; h < holds_.size(); ++h) find_multipliers(holds_[h], known(column, h), x);
    for (const Hold& hold : holds_) {
      const SmallVector u = hold.Q.lazyProduct(gathered(x, *hold.unknowns));
      scatter(u, *hold.unknowns, x);
    }
  }
}

HeldChain::Known HeldChain::turn_right_hand_side(const Hold& hold, Eigen::Ref<Vector> x) {
  const SmallVector f = turned(hold, x);
  scatter(f, *hold.unknowns, x);
  Known known{.w = {}, .f = f.head(hold.c.size()), .g = SmallVector(hold.c.size())};
  for (Index j = 0; j < hold.c.size(); ++j) known.g[j] = x[hold.multiplier(j)];
  known.w = known.g.head(hold.rigid);
  hold.R.topLeftCorner(hold.rigid, hold.rigid).triangularView<Eigen::Upper>().transpose().solveInPlace(known.w);
  return known;
}

// To the right-hand side of (1).
void HeldChain::move_known(const Hold& hold, const Known& known, Eigen::Ref<Vector> x) {
  const Index rigid = hold.rigid, soft = hold.c.size() - rigid;
  for (std::size_t b = 0; b < hold.blocks.size(); ++b) {
    const SmallVector there = gathered(x, *hold.blocks[b].columns);
    scatter(there - hold.rows[b].topRows(rigid).transpose().lazyProduct(known.w), *hold.blocks[b].columns, x);
  }
  const auto R = hold.R.rightCols(soft);
  const SmallVector pull =
      (R.topRows(rigid).transpose().lazyProduct(known.w) - known.g.tail(soft)).cwiseQuotient(hold.c.tail(soft));
  const SmallVector force = R.bottomRows(soft).lazyProduct(pull);
  for (Index j = 0; j < soft; ++j) x[hold.unknown(rigid + j)] -= force[j];
}

// By (2).
void HeldChain::find_multipliers(const Hold& hold, const Known& known, Eigen::Ref<Vector> x) {
  SmallVector left = known.f;
  for (std::size_t b = 0; b < hold.blocks.size(); ++b)
    left -= hold.rows[b].lazyProduct(gathered(x, *hold.blocks[b].columns));
  for (Index j = hold.c.size(); j-- > 0;) {
    double p = left[j] / hold.R(j, j);
    if (!hold.is_stiff[static_cast<std::size_t>(j)]) {
      p = -known.g[j];
      for (Index i = 0; i <= j; ++i) p += hold.R(i, j) * x[hold.unknown(i)];
      p /= hold.c[j];
    }
    x[hold.multiplier(j)] = p;
    for (Index i = 0; i < j; ++i) left[i] -= hold.R(i, j) * p;
  }
}

// Multipliers and what they hold add 2 |p|ᵀ |R|ᵀ |w| + |p|ᵀ |c| |p|.
double HeldChain::weighted(const Eigen::Ref<const Vector>& v) const {
  Vector w = v.head(A_.cols());
  double sum = 0.0;
  for (const Hold& hold : holds_) {
    const SmallVector here = turned(hold, w);
    scatter(here, *hold.unknowns, w);
    for (Index j = 0; j < hold.c.size(); ++j) {
      const double p = std::abs(v[hold.multiplier(j)]);
      for (Index i = 0; i <= j; ++i) sum += 2.0 * p * std::abs(hold.R(i, j) * here[i]);
      sum += p * std::abs(hold.c[j]) * p;
    }
  }
  for (const Hold& hold : holds_)
    for (std::size_t b = 0; b < hold.blocks.size(); ++b) {
      const SmallVector there = gathered(w, *hold.blocks[b].columns);
      for (Index i = 0; i < hold.rigid; ++i)
        for (Index j = 0; j < there.size(); ++j)
          sum += 2.0 * std::abs(w[hold.unknown(i)] * hold.rows[b](i, j) * there[j]);
    }
  return sum + chain_.weighted(w);
}

}  // namespace arcwall
