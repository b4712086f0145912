#include "core/chain_ldlt.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace arcwall {

namespace {

constexpr Index most_columns = 2;  // that are solved for at once

Index rounded_up(Index count) { return (count + Lanes::count - 1) / Lanes::count * Lanes::count; }

}  // namespace

ChainLdlt::ChainLdlt(const SparseMatrix& A, const ChainGroups& groups) {
  Index greatest = 1;
  for (const auto& group : groups) greatest = std::max(greatest, static_cast<Index>(group.size()));
  width_ = elimination_width(greatest);
  assert(width_ > 0);
  lay_out_rounds(static_cast<Index>(groups.size()));

  const ChainRound& first = rounds_.front();
  std::vector<Index> group_of(static_cast<std::size_t>(A.cols())), row_of(static_cast<std::size_t>(A.cols()));
  pivot_places_.resize(static_cast<std::size_t>(A.cols()));
  places_.resize(static_cast<std::size_t>(A.cols()));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto group = static_cast<Index>(g), size = static_cast<Index>(groups[g].size());
    for (Index k = 0; k < size; ++k) {
      const auto unknown = static_cast<std::size_t>(groups[g][static_cast<std::size_t>(k)]);
      group_of[unknown] = group;
      row_of[unknown] = k;
      pivot_places_[unknown] = pivot_place(group, k);
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

  std::vector<bool> taken(static_cast<std::size_t>(first_size_), false);
  for (const auto* places : {&slots_, &filling_})
    for (const std::int32_t place : *places) taken[static_cast<std::size_t>(place)] = true;
  empty_.clear();
  for (Index place = 0; place < first_size_; ++place)
    if (!taken[static_cast<std::size_t>(place)]) empty_.push_back(static_cast<std::int32_t>(place));
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

// In the round in which its group goes.
std::int32_t ChainLdlt::pivot_place(Index group, Index row) const {
  auto round = rounds_.begin();
  for (; !round->eliminates(group); ++round) group /= 2;
  return static_cast<std::int32_t>(round->diagonal_at(group, packed(row, row)));
}

bool ChainLdlt::factorize(const SparseMatrix& A) {
  const double* values = A.valuePtr();
  for (const std::int32_t place : empty_) numbers_[static_cast<std::size_t>(place)] = 0.0;
  for (const std::int32_t place : filling_) numbers_[static_cast<std::size_t>(place)] = 1.0;
  for (std::size_t i = 0; i < slots_.size(); ++i) numbers_[static_cast<std::size_t>(slots_[i])] = values[i];
  eliminate_rounds(width_, rounds_, numbers_.data(), coupling_.data());

  pivots_ = {};
  double least = infinity, greatest = 0.0, sum = 0.0;  // of 1/|d|
  for (const std::int32_t place : pivot_places_) {
    const double reciprocal = numbers_[static_cast<std::size_t>(place)], magnitude = std::abs(reciprocal);
    pivots_.signs.negative += reciprocal < 0.0 ? 1 : 0;
    least = std::min(least, magnitude);
    greatest = std::max(greatest, magnitude);
    sum += magnitude;  // NaN if any is, which minima and maxima pass over
  }
  pivots_.signs.positive = static_cast<Index>(pivot_places_.size()) - pivots_.signs.negative;
  if (!(least > 0.0 && sum < infinity)) return false;
  pivots_.least = 1.0 / greatest;
  pivots_.greatest = 1.0 / least;
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
    solve_rounds(width_, R, rounds_, numbers_.data(), work_.data());
    for (Index j = 0; j < X.rows(); ++j)
      for (Index r = 0; r < R; ++r) X(j, first + r) = entry(j, r);
  };
  Index column = 0;
  for (; column + 2 <= X.cols(); column += 2) solve_columns(std::integral_constant<Index, 2>{}, column);
  if (column < X.cols()) solve_columns(std::integral_constant<Index, 1>{}, column);
}

double ChainLdlt::weighted(const Vector& v) const {
  std::fill(work_.begin(), work_.end(), 0.0);
  for (Index j = 0; j < v.size(); ++j) {
    const Place& place = places_[static_cast<std::size_t>(j)];
    work_[static_cast<std::size_t>(place.row + place.group)] = std::abs(v[j]);
  }
  return weighted_rounds(width_, rounds_, numbers_.data(), work_.data());
}

}  // namespace arcwall
