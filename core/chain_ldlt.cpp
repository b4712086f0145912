#include "core/chain_ldlt.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace arcwall {

namespace {

constexpr Index most_columns = 2;  // that are solved for at once

// Groups that are worked on at once, as the entries of one array.
constexpr Index lanes = 4;
using Lanes = Eigen::Array<double, lanes, 1>;

Lanes load(const double* from) { return Eigen::Map<const Lanes>(from); }
void store(const Lanes& value, double* to) { Eigen::Map<Lanes>{to} = value; }

Index rounded_up(Index count) { return (count + lanes - 1) / lanes * lanes; }

// Widths with code of their own.
using Widths = std::integer_sequence<Index, 1, 2, 3, 4, 6, 8>;
static_assert(ChainLdlt::widest == 8);

template <Index... widths>
Index next_width(Index width, std::integer_sequence<Index, widths...>) {
  Index result = 0;
  ((result = result == 0 && width <= widths ? widths : result), ...);
  return result;
}

// Calls `code` with the width as a constant.
template <typename Code, Index... widths>
void with_width(Index width, const Code& code, std::integer_sequence<Index, widths...>) {
  ((width == widths ? code(std::integral_constant<Index, widths>{}) : void()), ...);
}

// Place of entry (row, column) in a packed lower triangle.
constexpr Index packed(Index row, Index column) { return row * (row + 1) / 2 + column; }

using Neighbours = std::vector<std::vector<Index>>;  // of each unknown, itself included, sorted

Neighbours neighbours(const SparseMatrix& A, Index n) {
  Neighbours result(static_cast<std::size_t>(n));
  for (Index column = 0; column < n; ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry) {
      if (entry.row() >= n) continue;
      result[static_cast<std::size_t>(column)].push_back(entry.row());
      if (entry.row() != column) result[static_cast<std::size_t>(entry.row())].push_back(column);
    }
  for (auto& list : result) std::sort(list.begin(), list.end());
  return result;
}

// The unknowns with the same neighbours.
std::vector<Index> alike(const Neighbours& neighbours, Index unknown) {
  const std::vector<Index>& near = neighbours[static_cast<std::size_t>(unknown)];
  std::vector<Index> result;
  for (const Index other : near)
    if (neighbours[static_cast<std::size_t>(other)] == near) result.push_back(other);
  return result;
}

// What can be reached from some unknowns, by the number of steps that it takes.
class Levels {
 public:
  explicit Levels(const Neighbours& neighbours) : neighbours_(neighbours), seen_(neighbours.size(), 0) {}

  bool seen(Index unknown) const { return seen_[static_cast<std::size_t>(unknown)] == visit_; }

  // Appends the levels of a part; false if one is wider than `widest`.
  bool from(std::vector<Index> level, Index widest, ChainGroups& out) {
    for (const Index unknown : level) mark(unknown);
    while (!level.empty()) {
      if (static_cast<Index>(level.size()) > widest) return false;
      std::vector<Index> next;
      for (const Index unknown : level)
        for (const Index other : neighbours_[static_cast<std::size_t>(unknown)])
          if (!seen(other)) {
            mark(other);
            next.push_back(other);
          }
      out.push_back(std::move(level));
      level = std::move(next);
    }
    return true;
  }

  void forget() { ++visit_; }

 private:
  void mark(Index unknown) { seen_[static_cast<std::size_t>(unknown)] = visit_; }

  const Neighbours& neighbours_;
  std::vector<int> seen_;
  int visit_ = 1;
};

// Whether all entries are in groups or between groups beside each other.
bool is_tridiagonal(const SparseMatrix& A, const ChainGroups& groups) {
  std::vector<Index> group(static_cast<std::size_t>(A.cols()));
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Index unknown : groups[g]) group[static_cast<std::size_t>(unknown)] = static_cast<Index>(g);
  for (Index column = 0; column < A.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry)
      if (std::abs(group[static_cast<std::size_t>(entry.row())] - group[static_cast<std::size_t>(column)]) > 1)
        return false;
  return true;
}

// Each multiplier goes to the last group that it touches.
void insert_multipliers(const SparseMatrix& A, Index multipliers, ChainGroups& groups) {
  const Index n = A.cols() - multipliers;
  std::vector<std::size_t> last(static_cast<std::size_t>(multipliers), 0);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Index unknown : groups[g])
      for (SparseMatrix::InnerIterator entry(A, unknown); entry; ++entry)
        if (entry.row() >= n) last[static_cast<std::size_t>(entry.row() - n)] = g;
  for (Index m = 0; m < multipliers; ++m) groups[last[static_cast<std::size_t>(m)]].push_back(n + m);
}

}  // namespace

std::optional<ChainGroups> chain_groups(const SparseMatrix& A, Index multipliers, Index widest) {
  const Index n = A.cols() - multipliers;
  if (n == 0) return std::nullopt;
  const Neighbours near = neighbours(A, n);
  Levels search(near), levels(near);
  ChainGroups groups;
  for (Index unknown = 0; unknown < n; ++unknown) {
    if (levels.seen(unknown)) continue;
    // From the far end of what is found from anywhere.
    ChainGroups found;
    search.forget();
    if (!search.from(alike(near, unknown), n, found)) return std::nullopt;
    std::vector<Index> start = alike(near, found.back().front());
    if (!levels.from(std::move(start), widest, groups)) return std::nullopt;
  }
  insert_multipliers(A, multipliers, groups);
  for (const auto& group : groups)
    if (static_cast<Index>(group.size()) > widest) return std::nullopt;
  if (!is_tridiagonal(A, groups)) return std::nullopt;
  return groups;
}

// Groups 1, 3, 5 … of those that are left are eliminated, each from its two neighbours; the last one by itself. Entry k
// of all groups stands together: that of group i of the eliminated ones at k · stride + i.
//
//   [D_a       Aᵀ_ja        ]            D_j = L d Lᵀ,  Y = L⁻¹ A_j,  Z = d⁻¹ Y                                   (1)
//   [A_ja  D_j        A_jb  ]     →
//   [          Aᵀ_jb  D_b   ]            D_a −= Y_aᵀ Z_a,  D_b −= Y_bᵀ Z_b,  A_ba = −Y_bᵀ Z_a                     (2)
template <Index B>
struct ChainLdlt::Code {
  static constexpr Index triangle = packed(B, 0);
  using Block = std::array<std::array<Lanes, B>, B>;

  static void load_block(const double* from, Index stride, Block& block) {
    for (Index row = 0; row < B; ++row)
      for (Index column = 0; column < B; ++column) at(block, row, column) = load(from + (row * B + column) * stride);
  }
  static Lanes& at(Block& block, Index row, Index column) {
    return block[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  }

  // Equations (1) and (2) for one round; the new couplings go to `coupling`.
  static void eliminate(const Round& round, double* numbers, double* coupling) {
    for (Index i = 0; i < round.stride; i += lanes) {
      double* diagonal = numbers + round.diagonal + i;
      double* before = numbers + round.before + i;
      double* behind = numbers + round.behind + i;
      std::array<Lanes, triangle> D;
      Block a, b, z;
      for (Index k = 0; k < triangle; ++k) D[static_cast<std::size_t>(k)] = load(diagonal + k * round.stride);
      load_block(before, round.stride, a);
      load_block(behind, round.stride, b);
      for (Index c = 0; c < B; ++c) {
        const Lanes reciprocal = 1.0 / D[packed(c, c)];
        std::array<Lanes, B> column;
        for (Index r = c + 1; r < B; ++r) column[static_cast<std::size_t>(r)] = D[packed(r, c)];
        for (Index r = c + 1; r < B; ++r) {
          const Lanes l = column[static_cast<std::size_t>(r)] * reciprocal;
          for (Index k = c + 1; k <= r; ++k) D[packed(r, k)] -= l * column[static_cast<std::size_t>(k)];
          for (Index k = 0; k < B; ++k) {
            at(a, r, k) -= l * at(a, c, k);
            at(b, r, k) -= l * at(b, c, k);
          }
          D[packed(r, c)] = l;
        }
        D[packed(c, c)] = reciprocal;
      }
      for (Index k = 0; k < triangle; ++k) store(D[static_cast<std::size_t>(k)], diagonal + k * round.stride);

      double* left = numbers + round.kept + i;
      scale(D, a, before, round.stride, z);
      subtract_square(a, z, left, round.left_stride);
      for (Index row = 0; row < B; ++row)
        for (Index column = 0; column < B; ++column) {
          Lanes sum = at(b, 0, row) * at(z, 0, column);
          for (Index k = 1; k < B; ++k) sum += at(b, k, row) * at(z, k, column);
          store(-sum, coupling + (row * B + column) * round.stride + i);
        }
      scale(D, b, behind, round.stride, z);
      subtract_square(b, z, left + 1, round.left_stride);
    }
  }

  // Z = d⁻¹ Y, kept in `to`.
  static void scale(const std::array<Lanes, triangle>& D, Block& y, double* to, Index stride, Block& z) {
    for (Index row = 0; row < B; ++row)
      for (Index column = 0; column < B; ++column) {
        at(z, row, column) = at(y, row, column) * D[packed(row, row)];
        store(at(z, row, column), to + (row * B + column) * stride);
      }
  }

  static void subtract_square(Block& y, Block& z, double* from, Index stride) {
    for (Index row = 0; row < B; ++row)
      for (Index column = 0; column <= row; ++column) {
        Lanes sum = at(y, 0, row) * at(z, 0, column);
        for (Index k = 1; k < B; ++k) sum += at(y, k, row) * at(z, k, column);
        double* entry = from + packed(row, column) * stride;
        store(load(entry) - sum, entry);
      }
  }

  // What is left of a round are the groups of the next one.
  static void pass_on(const Round& round, const Round& next, const double* coupling, double* numbers) {
    for (Index k = 0; k < triangle; ++k) {
      const double* from = numbers + round.kept + k * round.left_stride;
      double* kept = numbers + next.kept + k * next.left_stride;
      double* eliminated = numbers + next.diagonal + k * next.stride;
      if (next.left == 0) eliminated[0] = from[0];
      for (Index i = 0; i < next.left; ++i) kept[i] = from[2 * i];
      for (Index i = 0; i < round.left / 2; ++i) eliminated[i] = from[2 * i + 1];
    }
    for (Index row = 0; row < B; ++row)
      for (Index column = 0; column < B; ++column) {
        const double* from = coupling + (row * B + column) * round.stride;
        double* before = numbers + next.before + (row * B + column) * next.stride;
        double* behind = numbers + next.behind + (column * B + row) * next.stride;
        // Of group i + 1 with group i; the last one may have nothing behind it, and the last of all stands alone.
        if (next.left == 0) before[0] = 0.0;
        if (round.left % 2 == 0 || next.left == 0) behind[next.eliminated - 1] = 0.0;
        for (Index i = 0; i + 1 < round.left; i += 2) before[i / 2] = from[i];
        for (Index i = 1; i + 1 < round.left; i += 2) behind[i / 2] = from[i];
      }
  }

  // L y = f for those eliminated, and what it takes from those left: f_a −= Z_aᵀ y, f_b −= Z_bᵀ y.
  template <Index R>
  static void forward(const Round& round, const double* numbers, double* f, double* left) {
    for (Index i = 0; i < round.stride; i += lanes)
      for (Index s = 0; s < R; ++s) {
        std::array<Lanes, B> y;
        for (Index r = 0; r < B; ++r) {
          double* entry = f + (r * R + s) * round.stride + i;
          Lanes sum = load(entry);
          for (Index c = 0; c < r; ++c)
            sum -= load(numbers + round.diagonal + packed(r, c) * round.stride + i) * y[static_cast<std::size_t>(c)];
          store(y[static_cast<std::size_t>(r)] = sum, entry);
        }
        for (const auto& [z, shift] : {std::pair(round.before, Index{0}), std::pair(round.behind, Index{1})})
          for (Index c = 0; c < B; ++c) {
            double* entry = left + (c * R + s) * round.left_stride + i + shift;
            Lanes sum = load(entry);
            for (Index r = 0; r < B; ++r)
              sum -= load(numbers + z + (r * B + c) * round.stride + i) * y[static_cast<std::size_t>(r)];
            store(sum, entry);
          }
      }
  }

  // x = L⁻ᵀ (d⁻¹ y − Z_a x_a − Z_b x_b)
  template <Index R>
  static void backward(const Round& round, const double* numbers, double* x, const double* left) {
    for (Index i = 0; i < round.stride; i += lanes)
      for (Index s = 0; s < R; ++s) {
        std::array<Lanes, B> z;
        for (Index r = 0; r < B; ++r) {
          Lanes sum = load(x + (r * R + s) * round.stride + i) *
                      load(numbers + round.diagonal + packed(r, r) * round.stride + i);
          for (Index c = 0; c < B; ++c) {
            const double* entry = left + (c * R + s) * round.left_stride + i;
            sum -= load(numbers + round.before + (r * B + c) * round.stride + i) * load(entry);
            sum -= load(numbers + round.behind + (r * B + c) * round.stride + i) * load(entry + 1);
          }
          z[static_cast<std::size_t>(r)] = sum;
        }
        for (Index r = B; r-- > 0;) {
          for (Index k = r + 1; k < B; ++k)
            z[static_cast<std::size_t>(r)] -=
                load(numbers + round.diagonal + packed(k, r) * round.stride + i) * z[static_cast<std::size_t>(k)];
          store(z[static_cast<std::size_t>(r)], x + (r * R + s) * round.stride + i);
        }
      }
  }

  // From those that are left of a round to the next one's, and back.
  template <Index R, bool back>
  static void exchange(const Round& round, const Round& next, double* left, double* eliminated, double* kept) {
    const auto move = [](double& from, double& to) { back ? from = to : to = from; };
    for (Index k = 0; k < B * R; ++k) {
      double* all = left + k * round.left_stride;
      if (next.left == 0) move(all[0], eliminated[k * next.stride]);
      for (Index i = 0; i < next.left; ++i) move(all[2 * i], kept[k * next.left_stride + i]);
      for (Index i = 0; i < round.left / 2; ++i) move(all[2 * i + 1], eliminated[k * next.stride + i]);
    }
  }

  template <Index R>
  static void solve(const std::vector<Round>& rounds, const double* numbers, double* work) {
    const auto eliminated = [&](const Round& round) { return work + R * round.right_hand_side; };
    const auto left = [&](const Round& round) { return work + R * round.right_hand_side_left; };
    for (std::size_t k = 0; k < rounds.size(); ++k) {
      const Round& round = rounds[k];
      if (k > 0) exchange<R, false>(rounds[k - 1], round, left(rounds[k - 1]), eliminated(round), left(round));
      forward<R>(round, numbers, eliminated(round), left(round));
    }
    for (std::size_t k = rounds.size(); k-- > 0;) {
      const Round& round = rounds[k];
      backward<R>(round, numbers, eliminated(round), left(round));
      if (k > 0) exchange<R, true>(rounds[k - 1], round, left(rounds[k - 1]), eliminated(round), left(round));
    }
  }
};

void ChainLdlt::analyse(const SparseMatrix& A, const ChainGroups& groups) {
  Index greatest = 1;
  for (const auto& group : groups) greatest = std::max(greatest, static_cast<Index>(group.size()));
  width_ = next_width(greatest, Widths{});
  assert(width_ > 0);
  lay_out_rounds(static_cast<Index>(groups.size()));

  const Round& first = rounds_.front();
  std::vector<Index> group_of(static_cast<std::size_t>(A.cols())), row_of(static_cast<std::size_t>(A.cols()));
  pivots_.resize(static_cast<std::size_t>(A.cols()));
  places_.resize(static_cast<std::size_t>(A.cols()));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto group = static_cast<Index>(g), size = static_cast<Index>(groups[g].size());
    for (Index k = 0; k < size; ++k) {
      const auto unknown = static_cast<std::size_t>(groups[g][static_cast<std::size_t>(k)]);
      group_of[unknown] = group;
      row_of[unknown] = k;
      pivots_[unknown] = pivot_place(group, k);
      const bool goes = first.eliminates(group);
      const Index stride = goes ? first.stride : first.left_stride;
      const Index start = goes ? first.right_hand_side : first.right_hand_side_left;
      places_[unknown] = {.row = static_cast<std::int32_t>(start + k * stride),
                          .stride = static_cast<std::int32_t>(stride),
                          .group = static_cast<std::int32_t>(group / 2)};
    }
    for (Index k = size; k < width_; ++k)
      filling_.push_back(static_cast<std::int32_t>(first.diagonal_at(group, packed(k, k))));
  }

  slots_.clear();
  for (Index column = 0; column < A.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry) {
      auto one = static_cast<std::size_t>(entry.row()), other = static_cast<std::size_t>(column);
      if (!first.eliminates(group_of[one])) std::swap(one, other);
      const Index group = group_of[one], row = row_of[one], other_row = row_of[other];
      Index slot = first.diagonal_at(group, packed(std::max(row, other_row), std::min(row, other_row)));
      if (group_of[other] != group)
        slot = (group_of[other] < group ? first.before : first.behind) + (row * width_ + other_row) * first.stride +
               group / 2;
      slots_.push_back(static_cast<std::int32_t>(slot));
    }
}

// Where the numbers of each round stand, and ones on the diagonal of what is only there to fill the lanes: in later
// rounds they stay.
void ChainLdlt::lay_out_rounds(Index groups) {
  const Index triangle = packed(width_, 0), square = width_ * width_;
  const auto take = [](Index& end, Index count) { return std::exchange(end, end + count); };
  rounds_.clear();
  Index numbers = 0, work = 0;
  for (Index left = groups; left > 0; left = rounds_.back().left) {
    Round round{.eliminated = std::max<Index>(1, left / 2), .left = left == 1 ? 0 : left - left / 2};
    round.stride = rounded_up(round.eliminated);
    round.left_stride = round.stride + lanes;
    round.kept = take(numbers, triangle * round.left_stride);
    round.diagonal = take(numbers, triangle * round.stride);
    round.before = take(numbers, square * round.stride);
    round.behind = take(numbers, square * round.stride);
    round.right_hand_side = take(work, width_ * round.stride);
    round.right_hand_side_left = take(work, width_ * round.left_stride);
    if (rounds_.empty()) first_size_ = numbers;
    rounds_.push_back(round);
  }
  numbers_.assign(static_cast<std::size_t>(numbers), 0.0);
  coupling_.assign(static_cast<std::size_t>(square * rounds_.front().stride), 0.0);
  work_.assign(static_cast<std::size_t>(most_columns * work), 0.0);

  filling_.clear();
  for (const Round& round : rounds_)
    for (Index i = round.eliminated; i < round.stride; ++i)
      for (Index k = 0; k < width_; ++k) {
        const Index place = round.diagonal + packed(k, k) * round.stride + i;
        numbers_[static_cast<std::size_t>(place)] = 1.0;
        if (&round == &rounds_.front()) filling_.push_back(static_cast<std::int32_t>(place));
      }
}

// In the round in which its group goes.
std::int32_t ChainLdlt::pivot_place(Index group, Index row) const {
  auto round = rounds_.begin();
  for (; !round->eliminates(group); ++round) group /= 2;
  return static_cast<std::int32_t>(round->diagonal_at(group, packed(row, row)));
}

bool ChainLdlt::factorize(const double* values) {
  std::fill_n(numbers_.begin(), first_size_, 0.0);
  for (const std::int32_t place : filling_) numbers_[static_cast<std::size_t>(place)] = 1.0;
  for (std::size_t i = 0; i < slots_.size(); ++i) numbers_[static_cast<std::size_t>(slots_[i])] = values[i];
  const auto run = [&](auto width) {
    using Kernel = Code<width.value>;
    for (std::size_t k = 0; k < rounds_.size(); ++k) {
      if (k > 0) Kernel::pass_on(rounds_[k - 1], rounds_[k], coupling_.data(), numbers_.data());
      Kernel::eliminate(rounds_[k], numbers_.data(), coupling_.data());
    }
  };
  with_width(width_, run, Widths{});

  inertia_ = {};
  double least = infinity, greatest = 0.0;  // of 1/|d|
  for (const std::int32_t place : pivots_) {
    const double reciprocal = numbers_[static_cast<std::size_t>(place)], magnitude = std::abs(reciprocal);
    (reciprocal < 0.0 ? inertia_.negative : inertia_.positive) += 1;
    if (!(magnitude > 0.0 && magnitude < infinity)) return false;
    least = std::min(least, magnitude);
    greatest = std::max(greatest, magnitude);
  }
  least_pivot_ = 1.0 / greatest;
  greatest_pivot_ = 1.0 / least;
  return true;
}

void ChainLdlt::solve(Eigen::Ref<Matrix> X) const {
  const auto solve_columns = [&](auto count, Index first) {
    constexpr Index R = count.value;
    // Entries of R columns lie in turns.
    const auto entry = [&](Index unknown, Index r) -> double& {
      const Place& place = places_[static_cast<std::size_t>(unknown)];
      return work_[static_cast<std::size_t>(R * place.row + r * place.stride + place.group)];
    };
    std::fill(work_.begin(), work_.end(), 0.0);
    for (Index j = 0; j < X.rows(); ++j)
      for (Index r = 0; r < R; ++r) entry(j, r) = X(j, first + r);
    with_width(
        width_, [&](auto width) { Code<width.value>::template solve<R>(rounds_, numbers_.data(), work_.data()); },
        Widths{});
    for (Index j = 0; j < X.rows(); ++j)
      for (Index r = 0; r < R; ++r) X(j, first + r) = entry(j, r);
  };
  Index column = 0;
  for (; column + 2 <= X.cols(); column += 2) solve_columns(std::integral_constant<Index, 2>{}, column);
  if (column < X.cols()) solve_columns(std::integral_constant<Index, 1>{}, column);
}

// z = |v_j| + |Z_a| |v_a| + |Z_b| |v_b| of each group eliminated, then zᵀ |L| |d| |L|ᵀ z.
double ChainLdlt::weighted(const Vector& v) const {
  const Index B = width_;
  const auto number = [&](Index place) { return std::abs(numbers_[static_cast<std::size_t>(place)]); };
  std::vector<double> all(static_cast<std::size_t>(B * (rounds_.front().eliminated + rounds_.front().left)), 0.0);
  double sum = 0.0;
  // Entries of the groups of this round, one after the other.
  for (Index j = 0; j < v.size(); ++j) {
    const Place& place = places_[static_cast<std::size_t>(j)];
    const Round& round = rounds_.front();
    const bool left = place.row >= round.right_hand_side_left;
    const Index group = round.left == 0 ? 0 : 2 * place.group + (left ? 0 : 1);
    const Index row = (place.row - (left ? round.right_hand_side_left : round.right_hand_side)) / place.stride;
    all[static_cast<std::size_t>(B * group + row)] = std::abs(v[j]);
  }
  for (const Round& round : rounds_) {
    const auto at = [&](Index group, Index row) {
      const auto place = static_cast<std::size_t>(B * group + row);
      return place < all.size() ? all[place] : 0.0;
    };
    for (Index i = 0; i < round.eliminated; ++i) {
      const Index group = round.left == 0 ? 0 : 2 * i + 1;
      std::array<double, widest> z{};
      for (Index r = 0; r < B; ++r) {
        double& entry = z[static_cast<std::size_t>(r)] = at(group, r);
        if (round.left == 0) continue;
        for (Index c = 0; c < B; ++c)
          entry += number(round.before + (r * B + c) * round.stride + i) * at(group - 1, c) +
                   number(round.behind + (r * B + c) * round.stride + i) * at(group + 1, c);
      }
      for (Index r = 0; r < B; ++r) {
        double u = z[static_cast<std::size_t>(r)];
        for (Index k = r + 1; k < B; ++k)
          u += number(round.diagonal + packed(k, r) * round.stride + i) * z[static_cast<std::size_t>(k)];
        sum += u * u / number(round.diagonal + packed(r, r) * round.stride + i);
      }
    }
    for (Index i = 0; i < round.left; ++i)
      for (Index r = 0; r < B; ++r) all[static_cast<std::size_t>(B * i + r)] = at(2 * i, r);
    all.resize(static_cast<std::size_t>(B * round.left));
  }
  return sum;
}

}  // namespace arcwall
