#include "core/chain_ldlt.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <utility>

namespace arcwall {

namespace {

constexpr Index most_columns = 2;  // that are solved for at once
constexpr Index together = 64;     // groups whose numbers are brought to their places before the next ones

Index rounded_up(Index count) { return (count + Lanes::count - 1) / Lanes::count * Lanes::count; }

// Whether an index is the next one at a constant distance; then it is taken in.
template <class Steps>
bool extended(Steps& steps, Index index) {
  if (steps.count == 1) steps.step = static_cast<std::int32_t>(index - steps.first);
  if (index != steps.first + steps.count * steps.step) return false;
  ++steps.count;
  return true;
}

}  // namespace

ChainLdlt::ChainLdlt(const SparseMatrix& A, const ChainGroups& groups, const std::vector<bool>& afloat)
    : unknowns_(A.cols()) {
  Index greatest = 1;
  for (const auto& group : groups) greatest = std::max(greatest, static_cast<Index>(group.size()));
  width_ = elimination_width(greatest);
  assert(width_ > 0);
  lay_out_rounds(static_cast<Index>(groups.size()));
  find_afloat(groups, afloat);

  std::vector<Index> group_of(static_cast<std::size_t>(A.cols())), row_of(static_cast<std::size_t>(A.cols()));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto group = static_cast<Index>(g), size = static_cast<Index>(groups[g].size());
    for (Index k = 0; k < size; ++k) {
      const auto unknown = static_cast<std::size_t>(groups[g][static_cast<std::size_t>(k)]);
      group_of[unknown] = group;
      row_of[unknown] = k;
    }
    for (Index k = size; k < width_; ++k) {
      filling_.push_back(static_cast<std::int32_t>(rounds_.front().diagonal_at(group, packed(k, k))));
      unused_.push_back({.pivot = pivot_place(group, k), .first = pivot_place(group, 0), .side = side_of(group, k, 0)});
    }
  }
  lay_out_values(A, group_of, row_of);
  lay_out_unknowns(groups);
}

void ChainLdlt::lay_out_values(const SparseMatrix& A, const std::vector<Index>& group_of,
                               const std::vector<Index>& row_of) {
  constexpr std::int32_t none = -1, filled = -2;
  const ChainRound& first = rounds_.front();
  std::vector<std::int32_t> value_at(static_cast<std::size_t>(first_size_), none);
  std::int32_t value = 0;
  for (Index column = 0; column < A.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry) {
      auto one = static_cast<std::size_t>(entry.row()), other = static_cast<std::size_t>(column);
      if (!first.eliminates(group_of[one])) std::swap(one, other);
      const Index group = group_of[one], row = row_of[one], other_row = row_of[other];
      Index place = first.diagonal_at(group, packed(std::max(row, other_row), std::min(row, other_row)));
      if (group_of[other] != group)
        place = (group_of[other] < group ? first.before : first.behind) + (row * width_ + other_row) * first.stride +
                group / 2;
      value_at[static_cast<std::size_t>(place)] = value++;
    }
  for (const std::int32_t place : filling_) value_at[static_cast<std::size_t>(place)] = filled;

  struct Places {
    Index first, count;
  };
  std::vector<Places> rows;
  const Index square = width_ * width_, triangle = packed(width_, 0);
  for (Index k = 0; k < triangle; ++k) rows.push_back({first.kept + k * first.left_stride, first.left_stride});
  for (Index k = 0; k < triangle; ++k) rows.push_back({first.diagonal + k * first.stride, first.stride});
  for (Index k = 0; k < square; ++k) rows.push_back({first.before + k * first.stride, first.stride});
  for (Index k = 0; k < square; ++k) rows.push_back({first.behind + k * first.stride, first.stride});

  value_runs_.clear();
  empty_.clear();
  for (Index from = 0; from < first.left_stride; from += together)
    for (const Places& row : rows) {
      bool follows = false;
      for (Index i = from; i < std::min(from + together, row.count); ++i) {
        const auto place = static_cast<std::int32_t>(row.first + i);
        const std::int32_t here = value_at[static_cast<std::size_t>(place)];
        if (here == none) empty_.push_back(place);
        if (here < 0) {
          follows = false;
        } else if (!std::exchange(follows, true) || !extended(value_runs_.back().values, here)) {
          value_runs_.push_back({.place = place, .values = {.first = here}});
        }
      }
    }
}

void ChainLdlt::lay_out_unknowns(const ChainGroups& groups) {
  const auto count = static_cast<Index>(groups.size());
  unknown_runs_.clear();
  for (Index from = 0; from < count; from += 2 * together)
    for (const Index first : {0, 1})
      for (Index k = 0; k < width_; ++k) {
        bool follows = false;
        for (Index g = from + first; g < std::min(from + 2 * together, count); g += 2) {
          const std::vector<Index>& group = groups[static_cast<std::size_t>(g)];
          if (k >= static_cast<Index>(group.size())) {
            follows = false;
            continue;
          }
          const Index unknown = group[static_cast<std::size_t>(k)];
          if (!std::exchange(follows, true) || !extended(unknown_runs_.back().unknowns, unknown))
            unknown_runs_.push_back(side_of(g, k, unknown));
        }
      }
}

// Where a row of a group has its right-hand side in the first round.
ChainLdlt::UnknownRun ChainLdlt::side_of(Index group, Index row, Index unknown) const {
  const ChainRound& first = rounds_.front();
  const bool goes = first.eliminates(group);
  const Index stride = goes ? first.stride : first.left_stride;
  const Index start = goes ? first.right_hand_side : first.right_hand_side_left;
  return {.row = static_cast<std::int32_t>(start + row * stride),
          .stride = static_cast<std::int32_t>(stride),
          .group = static_cast<std::int32_t>(group / 2),
          .unknowns = {.first = static_cast<std::int32_t>(unknown)}};
}

// Where the numbers of each round stand, and ones on the diagonal of what is only there to fill the lanes: in later
// rounds they stay.
void ChainLdlt::lay_out_rounds(Index groups) {
  const Index triangle = packed(width_, 0), square = width_ * width_;
  const auto take = [](Index& end, Index count) { return std::exchange(end, end + count); };
  rounds_.clear();
  Index numbers = 0, work = 0;
  for (Index left = groups; left > 0; left = rounds_.back().left) {
    ChainRound round{.eliminated = std::max<Index>(1, left / 2), .left = left == 1 ? 0 : left - left / 2};
    round.stride = rounded_up(round.eliminated);
    round.left_stride = round.stride + Lanes::count;
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
  for (const ChainRound& round : rounds_)
    for (Index i = round.eliminated; i < round.stride; ++i)
      for (Index k = 0; k < width_; ++k) {
        const Index place = round.diagonal + packed(k, k) * round.stride + i;
        numbers_[static_cast<std::size_t>(place)] = 1.0;
        if (&round == &rounds_.front()) filling_.push_back(static_cast<std::int32_t>(place));
      }
}

// A group is afloat in a round if it was in the one before, and so was what went there on its two sides.
void ChainLdlt::find_afloat(const ChainGroups& groups, const std::vector<bool>& unknowns) {
  // The columns of a motion are the first two of the groups beside it, too.
  const auto displacements_first = [&](const std::vector<Index>& group) {
    const auto is_first = [&](Index unknown) { return unknowns[static_cast<std::size_t>(unknown)]; };
    return group.size() >= 2 && is_first(group[0]) && group[1] == group[0] + 1 &&
           std::none_of(group.begin() + 1, group.end(), is_first);
  };
  // Those whose neighbours on both sides are such, too.
  const auto inside = [](const std::vector<bool>& such, std::size_t g) {
    return g > 0 && g + 1 < such.size() && such[g - 1] && such[g] && such[g + 1];
  };
  std::vector<bool> proper(groups.size()), afloat(groups.size());
  if (!unknowns.empty())
    for (std::size_t g = 0; g < groups.size(); ++g) proper[g] = displacements_first(groups[g]);
  for (std::size_t g = 0; g < groups.size(); ++g) afloat[g] = inside(proper, g);
  for (ChainRound& round : rounds_) {
    std::vector<bool> left(static_cast<std::size_t>(round.left));
    for (std::size_t g = 0; g < left.size(); ++g) left[g] = inside(afloat, 2 * g);
    round.afloat.assign(static_cast<std::size_t>(round.stride / Lanes::count), 0);
    for (std::size_t i = 0; i < round.afloat.size(); ++i) {
      const auto first = static_cast<std::ptrdiff_t>(i * Lanes::count), end = first + Lanes::count;
      round.afloat[i] = end <= round.left && std::all_of(left.begin() + first, left.begin() + end, std::identity{});
    }
    afloat = std::move(left);
  }
}

// In the round in which its group goes.
std::int32_t ChainLdlt::pivot_place(Index group, Index row) const {
  auto round = rounds_.begin();
  for (; !round->eliminates(group); ++round) group /= 2;
  return static_cast<std::int32_t>(round->diagonal_at(group, packed(row, row)));
}

bool ChainLdlt::factorize(const SparseMatrix& A) {
  const double* values = A.valuePtr();
  double* numbers = numbers_.data();
  for (const std::int32_t place : empty_) numbers[place] = 0.0;
  for (const std::int32_t place : filling_) numbers[place] = 1.0;
  for (const ValueRun& run : value_runs_)
    for (std::int32_t i = 0; i < run.values.count; ++i) numbers[run.place + i] = values[run.values.at(i)];
  eliminate_rounds(width_, rounds_, numbers, coupling_.data());
  const bool regular = read_pivots();
  refused_ = regular && grew(A);
  return regular && !refused_;
}

// Whether a pivot is much greater than all entries: after one of δ stands one of c²/δ. Then these two are far apart.
bool ChainLdlt::grew(const SparseMatrix& A) {
  constexpr double much = 1e5;
  greatest_entry_.reset();
  if (pivots_.least * much * much >= pivots_.greatest) return false;
  // The first pivots are entries; it takes the others only where these are small.
  const ChainRound& first = rounds_.front();
  const Eigen::Map<const Vector> reciprocals(numbers_.data() + first.diagonal_row(0), first.eliminated);
  greatest_entry_ = 1.0 / reciprocals.cwiseAbs().minCoeff();
  if (pivots_.greatest > 100.0 * *greatest_entry_)
    greatest_entry_ = Eigen::Map<const Vector>(A.valuePtr(), A.nonZeros()).cwiseAbs().maxCoeff();
  return pivots_.greatest > much * *greatest_entry_;
}

// Of four at a time, so that none waits for another. Places that no unknown has are given a pivot of their group: they
// have nothing to do with the others, and their right-hand sides are zero.
bool ChainLdlt::read_pivots() {
  struct Seen {  // of 1/|d|
    double least = infinity, greatest = 0.0, sum = 0.0;
    Index negative = 0;

    void add(double reciprocal) {
      const double magnitude = std::abs(reciprocal);
      least = std::min(least, magnitude);
      greatest = std::max(greatest, magnitude);
      sum += magnitude;  // NaN if any is, which minima and maxima pass over
      negative += reciprocal < 0.0;
    }
  };
  std::array<Seen, 4> seen;
  double* numbers = numbers_.data();
  Index repeated = 0;  // negative ones
  for (const Unused& place : unused_) {
    numbers[place.pivot] = numbers[place.first];
    repeated += numbers[place.first] < 0.0;
  }
  for (const ChainRound& round : rounds_)
    for (Index k = 0; k < width_; ++k) {
      const double* row = numbers + round.diagonal_row(k);
      Index i = 0;
      for (; i + 4 <= round.eliminated; i += 4)
        for (Index one = 0; one < 4; ++one) seen[static_cast<std::size_t>(one)].add(row[i + one]);
      for (; i < round.eliminated; ++i) seen.front().add(row[i]);
    }

  pivots_ = {.signs = {.negative = -repeated}};
  double sum = 0.0;
  for (const Seen& part : seen) {
    pivots_.signs.negative += part.negative;
    pivots_.least = std::min(pivots_.least, 1.0 / part.greatest);
    pivots_.greatest = std::max(pivots_.greatest, 1.0 / part.least);
    sum += part.sum;
  }
  pivots_.signs.positive = unknowns_ - pivots_.signs.negative;
  return pivots_.greatest < infinity && sum < infinity;
}

// What right-hand sides do not fill: what there is only to fill the lanes, and places that no unknown has.
void ChainLdlt::clear_unused(Index columns) const {
  double* work = work_.data();
  for (const ChainRound& round : rounds_)
    for (Index k = 0; k < width_ * columns; ++k) {
      double* row = work + columns * round.right_hand_side + k * round.stride;
      std::fill(row + round.eliminated, row + round.stride, 0.0);
      row = work + columns * round.right_hand_side_left + k * round.left_stride;
      std::fill(row + round.left, row + round.left_stride, 0.0);
    }
  for (const Unused& place : unused_)
    for (Index r = 0; r < columns; ++r) work[columns * place.side.row + r * place.side.stride + place.side.group] = 0.0;
}

void ChainLdlt::solve(Eigen::Ref<Matrix> X) const {
  const auto solve_columns = [&](auto count, Index first) {
    constexpr Index R = count.value;
    // Entries of R columns lie in turns.
    const auto row = [&](const UnknownRun& run, Index r) {
      return work_.data() + R * run.row + r * run.stride + run.group;
    };
    clear_unused(R);
    for (const UnknownRun& run : unknown_runs_)
      for (Index r = 0; r < R; ++r) {
        double* to = row(run, r);
        const double* from = &X(0, first + r);
        for (std::int32_t i = 0; i < run.unknowns.count; ++i) to[i] = from[run.unknowns.at(i)];
      }
    solve_rounds(width_, R, rounds_, numbers_.data(), work_.data());
    for (const UnknownRun& run : unknown_runs_)
      for (Index r = 0; r < R; ++r) {
        const double* from = row(run, r);
        double* to = &X(0, first + r);
        for (std::int32_t i = 0; i < run.unknowns.count; ++i) to[run.unknowns.at(i)] = from[i];
      }
  };
  Index column = 0;
  for (; column + 2 <= X.cols(); column += 2) solve_columns(std::integral_constant<Index, 2>{}, column);
  if (column < X.cols()) solve_columns(std::integral_constant<Index, 1>{}, column);
}

double ChainLdlt::weighted(const Vector& v) const {
  clear_unused(1);
  for (const UnknownRun& run : unknown_runs_)
    for (std::int32_t i = 0; i < run.unknowns.count; ++i)
      work_[static_cast<std::size_t>(run.row + run.group + i)] = v[run.unknowns.at(i)];
  return weighted_rounds(width_, rounds_, numbers_.data(), work_.data());
}
}  // namespace arcwall
