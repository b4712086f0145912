#include "core/algebra/block_tridiagonal/null_space_ldlt.hpp"

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

std::unique_ptr<NullSpaceLdlt> NullSpaceLdlt::of(const SparseMatrix& matrix, Index multipliers, const Blocks& blocks,
                                                 const std::vector<bool>& translation_free) {
  const Index n = matrix.cols() - multipliers;
  const SparseMatrix A = matrix.topLeftCorner(n, n);
  std::unique_ptr<NullSpaceLdlt> ldlt(new NullSpaceLdlt(A, blocks, translation_free));
  return ldlt->reuse_analysis(matrix, multipliers) ? std::move(ldlt) : nullptr;
}

bool NullSpaceLdlt::reuse_analysis(const SparseMatrix& matrix, Index multipliers) {
  return matrix.cols() - multipliers == A_.cols() && find_chunks(matrix, multipliers) &&
         find_pressed_blocks(matrix, multipliers);
}

// In each column A's entries come first; only multipliers may follow.
bool NullSpaceLdlt::find_chunks(const SparseMatrix& matrix, Index multipliers) {
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

bool NullSpaceLdlt::find_pressed_blocks(const SparseMatrix& matrix, Index multipliers) {
  pressed_.clear();
  turned_.reset();
  if (multipliers == 0) return true;
  const Index n = matrix.cols() - multipliers;
  const SparseIndex *start = matrix.outerIndexPtr(), *row = matrix.innerIndexPtr();
  struct Entry {
    std::size_t block, position;
    Index place;
  };
  std::vector<std::vector<Entry>> rows(static_cast<std::size_t>(multipliers));
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for (std::size_t k = 0; k < blocks_[b].size(); ++k) {
      const Index column = blocks_[b][k];
      for (Index at = start[column + 1]; at-- > start[column] && row[at] >= n;)
        rows[static_cast<std::size_t>(row[at] - n)].push_back({.block = b, .position = k, .place = at});
    }
  std::map<std::size_t, PressedBlock> by_block;
  for (std::size_t m = 0; m < rows.size(); ++m) {
    const Index multiplier = n + static_cast<Index>(m), diagonal = start[multiplier];
    const bool has_diagonal_alone = start[multiplier + 1] == diagonal + 1 && row[diagonal] == multiplier;
    if (rows[m].empty() || rows[m].front().block != rows[m].back().block || !has_diagonal_alone) return false;
    const std::size_t block = rows[m].front().block;
    PressedBlock& pressed = by_block.try_emplace(block, PressedBlock{.unknowns = &blocks_[block]}).first->second;
    pressed.multipliers.push_back(multiplier);
    pressed.compliance.push_back(diagonal);
    pressed.row.emplace_back(blocks_[block].size(), no_entry);
    for (const Entry& entry : rows[m]) pressed.row.back()[entry.position] = entry.place;
  }
  for (auto& [block, pressed] : by_block) {
    if (pressed.multipliers.size() > pressed.unknowns->size() || !find_couplings(pressed, block)) return false;
    pressed_.push_back(std::move(pressed));
  }
  return true;
}

// Turned coordinates couple with all that any of the block's unknowns couples with. Blocks of separate parts of a
// structure do not couple.
bool NullSpaceLdlt::find_couplings(PressedBlock& pressed, std::size_t block) const {
  const auto add = [&](const Unknowns& columns) {
    Coupling coupling{.columns = &columns, .places = {}};
    for (const Index column : columns)
      for (const Index row : *pressed.unknowns) coupling.places.push_back(place_of(A_, row, column));
    const auto missing = std::count(coupling.places.begin(), coupling.places.end(), no_entry);
    if (missing == 0) pressed.couplings.push_back(std::move(coupling));
    return missing == 0 || missing == static_cast<std::ptrdiff_t>(columns.size() * pressed.unknowns->size());
  };
  return add(blocks_[block]) && !pressed.couplings.empty() && (block == 0 || add(blocks_[block - 1])) &&
         (block + 1 == blocks_.size() || add(blocks_[block + 1]));
}

NullSpaceLdlt::Small NullSpaceLdlt::values(const PressedBlock& pressed, const Coupling& coupling) const {
  Small values(pressed.unknowns->size(), coupling.columns->size());
  for (std::size_t i = 0; i < coupling.places.size(); ++i) values.data()[i] = A_.valuePtr()[coupling.places[i]];
  return values;
}

void NullSpaceLdlt::set_values(const Coupling& coupling, const Small& values) {
  for (std::size_t i = 0; i < coupling.places.size(); ++i) A_.valuePtr()[coupling.places[i]] = values.data()[i];
}

FactorStatus NullSpaceLdlt::factorize(const SparseMatrix& matrix, const MatrixProperties& known) {
  for (const Chunk& chunk : chunks_) std::copy_n(matrix.valuePtr() + chunk.from, chunk.count, A_.valuePtr() + chunk.to);
  pivots_ = {};
  refused_ = false;
  ground_.assign(known.ground.begin(), known.ground.end());
  if (eliminate_multipliers(matrix)) {
    const FactorStatus status = ldlt_.factorize(A_, {.ground = ground_});
    refused_ = ldlt_.refused();
    pivots_.add(ldlt_.pivots());
    if (status == FactorStatus::ok) return status;
  }
  return is_finite(matrix) ? FactorStatus::singular : FactorStatus::not_finite;
}

// Rows are taken out only once all blocks have been turned and all rows have been kept.
bool NullSpaceLdlt::eliminate_multipliers(const SparseMatrix& matrix) {
  for (PressedBlock& pressed : pressed_)
    if (!read_multipliers(matrix, pressed)) return false;
  for (PressedBlock& pressed : pressed_)
    if (!keep_rows(pressed)) return false;
  for (PressedBlock& pressed : pressed_) take_out(pressed);
  tell_what_is_free();
  return true;
}

// False where entries are not finite, or two multipliers hold the same.
bool NullSpaceLdlt::read_multipliers(const SparseMatrix& matrix, PressedBlock& pressed) {
  const auto count = static_cast<Index>(pressed.multipliers.size());
  const auto c_of = [&](Index j) { return -matrix.valuePtr()[pressed.compliance[static_cast<std::size_t>(j)]]; };
  pressed.order.clear();
  for (const bool rigid : {true, false}) {
    for (Index j = 0; j < count; ++j)
      if ((c_of(j) == 0.0) == rigid) pressed.order.push_back(j);
    if (rigid) pressed.rigid = static_cast<Index>(pressed.order.size());
  }
  pressed.c.resize(count);
  Small Ct = Small::Zero(static_cast<Index>(pressed.unknowns->size()), count);
  for (Index j = 0; j < count; ++j) {
    const Index which = pressed.order[static_cast<std::size_t>(j)];
    pressed.c[j] = c_of(which);
    const std::vector<Index>& row = pressed.row[static_cast<std::size_t>(which)];
    for (std::size_t i = 0; i < row.size(); ++i)
      if (row[i] != no_entry) Ct(static_cast<Index>(i), j) = matrix.valuePtr()[row[i]];
  }
  return Ct.allFinite() && pressed.c.allFinite() && turn(pressed, Ct);
}

// Cᵀ = Q R, A := QᵀAQ, unless all multipliers are springs that are softer than the structure.
bool NullSpaceLdlt::turn(PressedBlock& pressed, const Small& Ct) {
  const Index count = Ct.cols();
  const double greatest = values(pressed, pressed.couplings.front()).cwiseAbs().maxCoeff();
  const auto is_soft = [&](Index j) { return Ct.col(j).squaredNorm() < std::abs(pressed.c[j]) * greatest; };
  pressed.is_turned = pressed.rigid > 0;
  for (Index j = 0; j < count; ++j) pressed.is_turned = pressed.is_turned || !is_soft(j);
  pressed.Q = Small::Identity(Ct.rows(), Ct.rows());
  pressed.R = Ct;
  if (!pressed.is_turned) return true;
  const Eigen::HouseholderQR<Small> qr(Ct);
  pressed.Q = qr.householderQ() * Small::Identity(Ct.rows(), Ct.rows());
  pressed.R = qr.matrixQR().topRows(count).triangularView<Eigen::Upper>();
  for (Index j = 0; j < pressed.rigid; ++j)
    if (pressed.R(j, j) == 0.0) return false;
  for (const Coupling& coupling : pressed.couplings) {
    Small turned = pressed.Q.transpose() * values(pressed, coupling);
    if (coupling.columns == pressed.unknowns) turned *= pressed.Q;
    set_values(coupling, turned);
  }
  return true;
}

bool NullSpaceLdlt::keep_rows(PressedBlock& pressed) const {
  pressed.rows.clear();
  bool finite = true;
  for (const Coupling& coupling : pressed.couplings) {
    const Small all = values(pressed, coupling);
    finite = finite && all.allFinite();
    pressed.rows.push_back(all.topRows(pressed.is_turned ? pressed.c.size() : 0));
  }
  return finite;
}

// In place of the rows stand pivots as large as what else is there. Those of the multipliers are as large, and less
// where one holds almost what others hold.
void NullSpaceLdlt::take_out(PressedBlock& pressed) {
  const Index rigid = pressed.rigid, soft = pressed.c.size() - rigid, held = pressed.R.rows() - rigid;
  Small own = values(pressed, pressed.couplings.front());
  const double greatest = own.cwiseAbs().maxCoeff(), scale = greatest > 0.0 ? greatest : 1.0;
  own.topRows(rigid).setZero();
  own.leftCols(rigid).setZero();
  own.diagonal().head(rigid).setConstant(scale);
  const auto R = pressed.R.bottomRightCorner(held, soft);
  const Small springs = R * pressed.c.tail(soft).cwiseInverse().asDiagonal() * R.transpose();
  own.block(rigid, rigid, held, held) += springs;
  set_values(pressed.couplings.front(), own);
  for (std::size_t b = 1; b < pressed.couplings.size(); ++b) {
    Small beside = values(pressed, pressed.couplings[b]);
    beside.topRows(rigid).setZero();
    set_values(pressed.couplings[b], beside);
  }
  pressed.is_stiff.clear();
  for (Index j = 0; j < pressed.c.size(); ++j) {
    const double R_jj = pressed.is_turned ? pressed.R(j, j) : 0.0, share = R_jj / pressed.R.col(j).norm();
    pressed.is_stiff.push_back(pressed.is_turned && R_jj * R_jj >= std::abs(pressed.c[j]) * scale);
    pivots_.add(j < rigid ? -scale * share * share : -std::copysign(scale, pressed.c[j]));
  }
  for (Index column = 0; column < held && !pressed.is_turned; ++column)
    for (Index row = column; row < held; ++row)
      ground_.push_back({.row = std::max(pressed.unknown(row), pressed.unknown(column)),
                         .column = std::min(pressed.unknown(row), pressed.unknown(column)),
                         .stiffness = springs(row, column)});
}

// Nodes whose unknowns have been turned are not free, nor do they have translations as first unknowns.
void NullSpaceLdlt::tell_what_is_free() {
  if (translation_free_.empty()) return;
  std::vector<bool> turned;
  for (const PressedBlock& pressed : pressed_) turned.push_back(pressed.is_turned);
  if (turned_ == turned) return;
  std::vector<bool> translation_free = translation_free_;
  for (const PressedBlock& pressed : pressed_)
    for (const Index unknown : *pressed.unknowns)
      if (pressed.is_turned) translation_free[static_cast<std::size_t>(unknown)] = false;
  ldlt_.set_translation_free(translation_free);
  turned_ = std::move(turned);
}

// A block's entries of a long vector, and back. Eigen's x(unknowns) would copy the list to the heap each time, and so
// would its products of such entries, but for lazy ones.
NullSpaceLdlt::SmallVector NullSpaceLdlt::gathered(const Eigen::Ref<const Vector>& x, const Unknowns& unknowns) {
  SmallVector entries(static_cast<Index>(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i) entries[static_cast<Index>(i)] = x[unknowns[i]];
  return entries;
}

void NullSpaceLdlt::scatter(const SmallVector& entries, const Unknowns& unknowns, Eigen::Ref<Vector> x) {
  for (std::size_t i = 0; i < unknowns.size(); ++i) x[unknowns[i]] = entries[static_cast<Index>(i)];
}

NullSpaceLdlt::SmallVector NullSpaceLdlt::turned(const PressedBlock& pressed, const Eigen::Ref<const Vector>& x) {
  return pressed.Q.transpose().lazyProduct(gathered(x, *pressed.unknowns));
}

// With r the rigid and s the soft multipliers of a block, K the rows of QᵀAQ that they hold and f in turned
// coordinates:
//
//   R_rrᵀ w_r = g_r,   A w = f − K_rᵀ w_r − R_ss c⁻¹ (R_rsᵀ w_r − g_s)                                    (1)
//
// Then R p = f − K w and c p = Rᵀ w − g: each multiplier from that of the two where fewer digits cancel.   (2)
void NullSpaceLdlt::solve(Eigen::Ref<Matrix> X) const {
  known_.resize(pressed_.size() * static_cast<std::size_t>(X.cols()));
  const auto known = [&](Index column, std::size_t h) -> Known& {
    return known_[static_cast<std::size_t>(column) * pressed_.size() + h];
  };
  for (Index column = 0; column < X.cols(); ++column) {
    auto x = X.col(column);
    for (std::size_t h = 0; h < pressed_.size(); ++h) known(column, h) = turn_right_hand_side(pressed_[h], x);
    for (std::size_t h = 0; h < pressed_.size(); ++h) move_known(pressed_[h], known(column, h), x);
    for (const PressedBlock& pressed : pressed_)
      for (Index j = 0; j < pressed.rigid; ++j) x[pressed.unknown(j)] = 0.0;
  }
  ldlt_.solve(X.topRows(A_.cols()));
  for (Index column = 0; column < X.cols(); ++column) {
    auto x = X.col(column);
    for (std::size_t h = 0; h < pressed_.size(); ++h)
      for (Index j = 0; j < pressed_[h].rigid; ++j) x[pressed_[h].unknown(j)] = known(column, h).w[j];
    for (std::size_t h = 0; h < pressed_.size(); ++h) find_multipliers(pressed_[h], known(column, h), x);
    for (const PressedBlock& pressed : pressed_) {
      const SmallVector u = pressed.Q.lazyProduct(gathered(x, *pressed.unknowns));
      scatter(u, *pressed.unknowns, x);
    }
  }
}

NullSpaceLdlt::Known NullSpaceLdlt::turn_right_hand_side(const PressedBlock& pressed, Eigen::Ref<Vector> x) {
  const SmallVector f = turned(pressed, x);
  scatter(f, *pressed.unknowns, x);
  Known known{.w = {}, .f = f.head(pressed.c.size()), .g = SmallVector(pressed.c.size())};
  for (Index j = 0; j < pressed.c.size(); ++j) known.g[j] = x[pressed.multiplier(j)];
  known.w = known.g.head(pressed.rigid);
  pressed.R.topLeftCorner(pressed.rigid, pressed.rigid)
      .triangularView<Eigen::Upper>()
      .transpose()
      .solveInPlace(known.w);
  return known;
}

// To the right-hand side of (1).
void NullSpaceLdlt::move_known(const PressedBlock& pressed, const Known& known, Eigen::Ref<Vector> x) {
  const Index rigid = pressed.rigid, soft = pressed.c.size() - rigid, held = pressed.R.rows() - rigid;
  for (std::size_t b = 0; b < pressed.couplings.size() && rigid > 0; ++b) {
    const SmallVector there = gathered(x, *pressed.couplings[b].columns);
    scatter(there - pressed.rows[b].topRows(rigid).transpose().lazyProduct(known.w), *pressed.couplings[b].columns, x);
  }
  const auto R = pressed.R.rightCols(soft);
  const SmallVector pull =
      (R.topRows(rigid).transpose().lazyProduct(known.w) - known.g.tail(soft)).cwiseQuotient(pressed.c.tail(soft));
  const SmallVector force = R.bottomRows(held).lazyProduct(pull);
  for (Index j = 0; j < held; ++j) x[pressed.unknown(rigid + j)] -= force[j];
}

// By (2).
void NullSpaceLdlt::find_multipliers(const PressedBlock& pressed, const Known& known, Eigen::Ref<Vector> x) {
  SmallVector left = known.f;
  for (std::size_t b = 0; b < pressed.couplings.size() && pressed.is_turned; ++b)
    left -= pressed.rows[b].lazyProduct(gathered(x, *pressed.couplings[b].columns));
  for (Index j = pressed.c.size(); j-- > 0;) {
    double p = pressed.is_turned ? left[j] / pressed.R(j, j) : 0.0;
    if (j >= pressed.rigid && !pressed.is_stiff[static_cast<std::size_t>(j)]) {
      p = -known.g[j];
      for (Index i = 0; i < pressed.R.rows(); ++i) p += pressed.R(i, j) * x[pressed.unknown(i)];
      p /= pressed.c[j];
    }
    x[pressed.multiplier(j)] = p;
    for (Index i = 0; i < j && pressed.is_turned; ++i) left[i] -= pressed.R(i, j) * p;
  }
}

// Multipliers and what they hold add 2 |p|ᵀ |R|ᵀ |w| + |p|ᵀ |c| |p|.
double NullSpaceLdlt::weighted(const Eigen::Ref<const Vector>& v) const {
  Vector w = v.head(A_.cols());
  double sum = 0.0;
  for (const PressedBlock& pressed : pressed_) {
    const SmallVector here = turned(pressed, w);
    scatter(here, *pressed.unknowns, w);
    for (Index j = 0; j < pressed.c.size(); ++j) {
      const double p = std::abs(v[pressed.multiplier(j)]);
      for (Index i = 0; i < pressed.R.rows(); ++i) sum += 2.0 * p * std::abs(pressed.R(i, j) * here[i]);
      sum += p * std::abs(pressed.c[j]) * p;
    }
  }
  for (const PressedBlock& pressed : pressed_)
    for (std::size_t b = 0; b < pressed.couplings.size(); ++b) {
      const SmallVector there = gathered(w, *pressed.couplings[b].columns);
      for (Index i = 0; i < pressed.rigid; ++i)
        for (Index j = 0; j < there.size(); ++j)
          sum += 2.0 * std::abs(w[pressed.unknown(i)] * pressed.rows[b](i, j) * there[j]);
    }
  return sum + ldlt_.weighted(w);
}

}  // namespace arcwall
