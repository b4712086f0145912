#include "core/algebra/block_tridiagonal/chain_ldlt.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <utility>

namespace arcwall {

namespace {

constexpr int stretches = Lanes::count;
constexpr Index most_columns = 2;  // that are solved for at once
constexpr Index ahead = 24;        // groups behind which memory is asked for what comes next

// Caches hold no more of a chain's numbers than these [byte].
constexpr std::size_t caches = 8 << 20;

}  // namespace

ChainLdlt::ChainLdlt(const SparseMatrix& A, const ChainGroups& groups, const std::vector<bool>& translation_free)
    : unknown_count_(A.cols()) {
  Index greatest = 1;
  for (const auto& group : groups) greatest = std::max(greatest, static_cast<Index>(group.size()));
  assert(elimination_width(greatest) > 0);
  chain_ = ChainNumbers(elimination_width(greatest), static_cast<Index>(groups.size()));
  is_far_ = chain_.numbers.size() * sizeof(Lanes) > caches;
  together_ = is_far_ ? 2 : 16;
  find_values(A, groups);
  find_unknowns(groups);
  find_afloat(groups, translation_free);
  work_.entries.resize(static_cast<std::size_t>(most_columns * (chain_.length + 1) * chain_.width));
  work_.last.resize(static_cast<std::size_t>(most_columns * (stretches + 1) * chain_.width));
}

// Where an entry of a group and itself or the one beside it stands in the numbers of which group of its stretch: a
// coupling belongs to those of odd number, and to the last.
ChainLdlt::Spot ChainLdlt::spot_of(Index group, Index row, Index other, Index other_row) const {
  const Index length = chain_.length;
  if (group == other)
    return {.record = group % length, .place = packed(std::max(row, other_row), std::min(row, other_row))};
  if (group > other) {
    std::swap(group, other);
    std::swap(row, other_row);
  }
  const Index record = group % length;
  if (record % 2 == 1 || record + 1 == length) return {.record = record, .place = chain_.behind(row, other_row)};
  return {.record = record + 1, .place = chain_.before(other_row, row)};
}

void ChainLdlt::find_values(const SparseMatrix& A, const ChainGroups& groups) {
  std::vector<std::int32_t> group_of(static_cast<std::size_t>(A.cols())), row_of(group_of);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t k = 0; k < groups[g].size(); ++k) {
      group_of[static_cast<std::size_t>(groups[g][k])] = static_cast<std::int32_t>(g);
      row_of[static_cast<std::size_t>(groups[g][k])] = static_cast<std::int32_t>(k);
    }
  const Index count = chain_.per_group(), width = chain_.width, length = chain_.length;
  std::vector<std::int32_t> value_at(static_cast<std::size_t>(length * count * stretches), LanePlaces::none);
  const auto at = [&](Index record, Index place, Index lane) -> std::int32_t& {
    return value_at[static_cast<std::size_t>((record * count + place) * stretches + lane)];
  };
  // Of an unknown of a group that goes first its pivot is this entry.
  const Index first = groups[groups.size() > 1 ? 1 : 0].front();
  std::int32_t value = 0;
  for (Index column = 0; column < A.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry, ++value) {
      if (entry.row() == first && column == first) filling_ = value;
      const auto i = static_cast<std::size_t>(entry.row()), j = static_cast<std::size_t>(column);
      const Spot spot = spot_of(group_of[i], row_of[i], group_of[j], row_of[j]);
      at(spot.record, spot.place, std::min(group_of[i], group_of[j]) / length) = value;
    }
  for (Index record = 0; record < length; ++record) {
    for (Index lane = 0; lane < stretches; ++lane) {
      const auto group = static_cast<std::size_t>(lane * length + record);
      for (auto k = group < groups.size() ? static_cast<Index>(groups[group].size()) : 0; k < width; ++k)
        at(record, packed(k, k), lane) = LanePlaces::filled;
    }
    const bool odd = record % 2 == 1, couples = odd || record + 1 == length;
    std::vector<LanePlaces::Place> places;
    for (Index place = 0; place < count; ++place) {
      if (place >= chain_.before(0, 0) && place < chain_.behind(0, 0) && !odd) continue;
      if (place >= chain_.behind(0, 0) && !couples) continue;
      LanePlaces::Place& next = places.emplace_back(LanePlaces::Place{.at = place, .from = {}});
      for (Index lane = 0; lane < stretches; ++lane)
        next.from[static_cast<std::size_t>(lane)] = at(record, place, lane);
    }
    values_.add(std::move(places));
  }
  values_.complete();
}

void ChainLdlt::find_unknowns(const ChainGroups& groups) {
  for (Index record = 0; record < chain_.length; ++record) {
    std::vector<LanePlaces::Place> places;
    for (Index k = 0; k < chain_.width; ++k) {
      LanePlaces::Place& next = places.emplace_back(LanePlaces::Place{.at = k, .from = {}});
      for (Index lane = 0; lane < stretches; ++lane) {
        const auto group = static_cast<std::size_t>(lane * chain_.length + record);
        const bool is_there = group < groups.size() && k < static_cast<Index>(groups[group].size());
        next.from[static_cast<std::size_t>(lane)] =
            is_there ? static_cast<std::int32_t>(groups[group][static_cast<std::size_t>(k)]) : LanePlaces::none;
      }
    }
    unknowns_.add(std::move(places));
  }
  unknowns_.complete();
}

// An element is translation_free where the nodes at both its ends are; what is not there, behind the last node, holds
// nothing either.
void ChainLdlt::find_afloat(const ChainGroups& groups, const std::vector<bool>& unknowns) {
  if (unknowns.empty()) return;
  const auto count = static_cast<Index>(groups.size()), length = chain_.length;
  const auto is_afloat = [&](Index g) {
    const std::vector<Index>& group = groups[static_cast<std::size_t>(g)];
    const auto is_first = [&](Index unknown) { return unknowns[static_cast<std::size_t>(unknown)]; };
    return group.size() >= 2 && is_first(group[0]) && group[1] == group[0] + 1 &&
           std::none_of(group.begin() + 1, group.end(), is_first);
  };
  const auto holds_nothing = [&](Index g) { return g + 1 >= count || (is_afloat(g) && is_afloat(g + 1)); };
  chain_.translation_free.assign(static_cast<std::size_t>(length), 0);
  chain_.parted.assign(static_cast<std::size_t>(length) + 1, 0);
  bool any = false;
  for (Index g = 0; g < stretches * length; ++g) {
    const Index record = g % length;
    const auto bit = [&](Index stretch) { return static_cast<std::uint8_t>(1U << static_cast<unsigned>(stretch)); };
    if (holds_nothing(g)) chain_.translation_free[static_cast<std::size_t>(record)] |= bit(g / length);
    if (g >= count || !is_afloat(g) || !holds_nothing(g) || (g > 0 && !holds_nothing(g - 1))) continue;
    chain_.parted[static_cast<std::size_t>(record)] |= bit(g / length);
    if (g > 0 && record == 0) chain_.parted.back() |= bit(g / length - 1);
    any = true;
  }
  if (!any || count == 1) chain_.translation_free.clear();
  chain_.afloat_now = chain_.went_afloat = chain_.translation_free;
}

bool ChainLdlt::factorize(const SparseMatrix& A) { return factorize_beside(A, {}); }

bool ChainLdlt::factorize_and_solve(const SparseMatrix& A, Columns of, Eigen::Ref<Matrix> X) {
  if (static_cast<Index>(of.size()) > most_columns) return SymmetricFactors::factorize_and_solve(A, of, X);
  if (!factorize_beside(A, of)) return false;
  solve_backward(X);
  return true;
}

// As far as the forward part of the solution goes: the factors of a part are used where they still are at hand.
bool ChainLdlt::factorize_beside(const SparseMatrix& A, Columns of) {
  const double* const values = A.valuePtr();
  const double filling = filling_ ? values[*filling_] : 0.0;
  ChainPivots seen;
  Index there = 0, sides_there = 0;  // groups with their numbers and right-hand sides
  for (Index begin = 0; begin < chain_.length; begin += together_) {
    const Index end = std::min(begin + together_, chain_.length);
    if (is_far_) ask_for_entries(begin + ahead, values, of);
    for (; there < std::min(end + 1, chain_.length); ++there)
      values_.gather(there, values, filling, 1.0, 1, chain_.group(there));
    eliminate_groups(chain_, begin, end, seen);
    if (of.empty()) continue;
    gather(of, end, sides_there);
    forward_groups(chain_, static_cast<Index>(of.size()), begin, end, work_);
  }
  refused_ = false;
  if (!read(seen, filling)) return false;
  refused_ = grew(A, seen.least_first);
  return !refused_;
}

// Right-hand sides of groups up to `end` and the next one, in lanes.
void ChainLdlt::gather(Columns of, Index end, Index& there) const {
  const auto columns = static_cast<Index>(of.size());
  for (; there < std::min(end + 1, chain_.length); ++there) {
    Lanes* const to = work_.entries.data() + there * chain_.width * columns;
    for (Index r = 0; r < columns; ++r) {
      const ScaledColumn& column = of[static_cast<std::size_t>(r)];
      unknowns_.gather(there, column.entries, 0.0, column.factor, columns, to + r);
    }
  }
}

void ChainLdlt::solve(Eigen::Ref<Matrix> X) const {
  for (Index first = 0; first < X.cols(); first += most_columns) {
    auto columns = X.middleCols(first, std::min(most_columns, X.cols() - first));
    std::array<ScaledColumn, most_columns> of{};
    for (Index r = 0; r < columns.cols(); ++r) of[static_cast<std::size_t>(r)] = {columns.col(r).data(), 1.0};
    Index there = 0;
    for (Index begin = 0; begin < chain_.length; begin += together_) {
      const Index end = std::min(begin + together_, chain_.length);
      gather({of.data(), static_cast<std::size_t>(columns.cols())}, end, there);
      forward_groups(chain_, columns.cols(), begin, end, work_);
    }
    solve_backward(columns);
  }
}

void ChainLdlt::solve_backward(Eigen::Ref<Matrix> X) const {
  const Index columns = X.cols();
  for (Index end = chain_.length; end > 0;) {
    const Index begin = (end - 1) / together_ * together_;
    if (is_far_) ask_for_solutions(begin - ahead, X);
    backward_groups(chain_, columns, begin, end, work_);
    for (Index record = begin; record < end; ++record)
      for (Index r = 0; r < columns; ++r)
        unknowns_.scatter(record, work_.entries.data() + record * chain_.width * columns + r, columns, &X(0, r));
    end = begin;
  }
}

// Of groups from `begin` on: their numbers' places, and what goes there.
void ChainLdlt::ask_for_entries(Index begin, const double* values, Columns of) {
  const Index end = std::min(begin + together_, chain_.length - 1);
  if (begin >= end) return;
  ask_ahead<true>(chain_.group(begin), chain_.group(end));
  values_.ask_ahead(begin, end, values);
  for (const ScaledColumn& column : of) unknowns_.ask_ahead(begin, end, column.entries);
}

// In lanes, and where they go.
void ChainLdlt::ask_for_solutions(Index begin, const Eigen::Ref<const Matrix>& X) const {
  if (begin < 0) return;
  const Lanes* const entries = work_.entries.data();
  const Index count = X.cols() * chain_.width, end = begin + together_;
  ask_ahead(entries + begin * count, entries + end * count);
  for (Index r = 0; r < X.cols(); ++r) unknowns_.ask_ahead(begin, end, X.col(r).data());
}

// False for one that is zero, or so near that it is what rounding has left of rounding errors, or not finite. Where no
// unknown is, the filling is a pivot: one of those seen elsewhere.
bool ChainLdlt::read(const ChainPivots& seen, double filling) {
  const Index filled = stretches * chain_.length * chain_.width - unknown_count_;
  const Index negative = seen.negative - (filling < 0.0 ? filled : 0);
  pivots_ = {.signs = {.negative = negative, .positive = unknown_count_ - negative},
             .least = 1.0 / seen.greatest,
             .greatest = 1.0 / seen.least};
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  return pivots_.greatest < infinity && seen.sum < infinity && pivots_.least > epsilon * epsilon * pivots_.greatest;
}

// Whether a pivot is much greater than all entries: after one of δ stands one of c²/δ. Then these two are far apart.
bool ChainLdlt::grew(const SparseMatrix& A, double least_first) {
  constexpr double much = 1e5;
  greatest_entry_.reset();
  if (pivots_.least * much * much >= pivots_.greatest) return false;
  // The first pivots are entries; it takes the others only where these are small.
  greatest_entry_ = 1.0 / least_first;
  if (pivots_.greatest > 100.0 * *greatest_entry_)
    greatest_entry_ = Eigen::Map<const Vector>(A.valuePtr(), A.nonZeros()).cwiseAbs().maxCoeff();
  return pivots_.greatest > much * *greatest_entry_;
}

double ChainLdlt::weighted(const Eigen::Ref<const Vector>& v) const {
  for (Index record = 0; record < chain_.length; ++record)
    unknowns_.gather(record, v.data(), 0.0, 1.0, 1, work_.entries.data() + record * chain_.width);
  return weighted_by_chain(chain_, work_);
}

}  // namespace arcwall
