#pragma once

// What chain_elimination.cpp knows of elements translation_free. Not installed.
#include <algorithm>
#include <array>

#include "core/algebra/block_tridiagonal/elimination_group.hpp"

namespace arcwall::elimination {

constexpr unsigned all_lanes = (1U << lanes) - 1U;

[[gnu::noinline]] inline void set_some(unsigned which, const Lanes& value, Lanes& to) {
  for (int lane = 0; lane < lanes; ++lane)
    if ((which >> static_cast<unsigned>(lane)) & 1U) to.set(lane, value[lane]);
}

// Equation (3) where elements are translation_free, in some lanes. Each of the two elements at a group has its part of
// D T: first all that lies before the group is reduced, while D T has the part before alone; then what lies behind,
// while that part is kept where the group's coupling with what is behind will stand at last. The first groups of the
// stretches have no part before: it is that of the end of the stretch before.
template <Index B>
struct Afloat {
  using InLanes = Chain<B, Lanes>;
  static constexpr Index displacements = std::min<Index>(B, 2);
  using Columns = std::array<Lanes, static_cast<std::size_t>(displacements* B)>;  // D T, by columns

  // The coupling of a group with another, by rows of the one and columns of the other.
  struct Coupling {
    const Lanes* numbers;
    Index row, column;

    ARCWALL_IN_PLACE const Lanes& at(Index i, Index j) const { return numbers[i * row + j * column]; }
  };

  ChainNumbers& chain;
  Lanes* numbers = chain.numbers.data();
  std::uint8_t* now = chain.afloat_now.data();
  const std::uint8_t* parted = chain.parted.data();

  ARCWALL_IN_PLACE Lanes* of(Index group) const { return numbers + group * InLanes::per_group; }
  ARCWALL_IN_PLACE static Coupling by_rows(const Lanes* coupling) { return {coupling, B, 1}; }
  ARCWALL_IN_PLACE static Coupling by_columns(const Lanes* coupling) { return {coupling, 1, B}; }

  ARCWALL_IN_PLACE static void set(unsigned which, const Lanes& value, Lanes& to) {
    if (which == all_lanes)
      to = value;
    else
      set_some(which, value, to);
  }
  template <class Value>
  ARCWALL_IN_PLACE static void set(unsigned which, Lanes* D, const Value& value) {
    if (which == 0) return;
    ARCWALL_EACH (column, 0, displacements)
      ARCWALL_EACH (row, column, B) set(which, value(row, column), D[packed(row, column)]);
  }

  static constexpr std::size_t in_columns(Index row, Index column) {
    return static_cast<std::size_t>(column * B + row);
  }

  // Where nothing has gone: of the last group of a stretch, and of what is behind it.
  ARCWALL_IN_PLACE void begin_at_end() const {
    const Index last = chain.length - 1;
    const Coupling behind = by_rows(of(last) + InLanes::behind), before = by_columns(behind.numbers);
    if (last == 0) set(parted[0], of(0), [&](Index i, Index k) { return -behind.at(i, k); });
    set(parted[last + 1], of(last + 1), [&](Index i, Index k) { return -before.at(i, k); });
  }

  // Gives the part before the group before.
  ARCWALL_IN_PLACE Columns before_going(const Going& j) const {
    const Index a = j.before(), b = j.behind();
    Lanes* const own = of(j.group);
    chain.went_afloat[static_cast<std::size_t>(j.group)] = now[a] & now[j.group];
    const Coupling before = by_rows(own + InLanes::before), behind = by_rows(own + InLanes::behind);
    Columns part;
    part.fill(0.0);
    if (j.distance > 1) {
      if (a > 0) std::copy_n(of(a) + InLanes::behind, part.size(), part.begin());
      if (j.group == chain.length - 1)
        set(parted[j.group], own, [&](Index i, Index k) { return own[packed(i, k)] - behind.at(i, k); });
      return part;
    }
    set(parted[j.group], own, [&](Index i, Index k) { return -before.at(i, k) - behind.at(i, k); });
    set(parted[b], of(b), [&](Index i, Index k) { return -behind.at(k, i); });
    if (a > 0) {
      ARCWALL_EACH (column, 0, displacements)
        ARCWALL_EACH (row, column, B) part[in_columns(row, column)] = of(a)[packed(row, column)];
      std::copy_n(part.begin(), part.size(), of(a) + InLanes::behind);
    }
    set(parted[a], of(a), [&](Index i, Index k) { return part[in_columns(i, k)] - before.at(k, i); });
    return part;
  }

  // One element is left of two.
  ARCWALL_IN_PLACE void when_gone(const Going& j, const Columns& part) const {
    const Index a = j.before(), b = j.behind();
    now[a] = now[a] & now[j.group];
    const Lanes* const coupling = j.before_goes_first() ? of(a) + InLanes::behind : of(b) + InLanes::before;
    const Coupling of_a = j.before_goes_first() ? by_rows(coupling) : by_columns(coupling);
    const Coupling of_b = j.before_goes_first() ? by_columns(coupling) : by_rows(coupling);
    set(parted[a] & now[a], of(a), [&](Index i, Index k) { return part[in_columns(i, k)] - of_a.at(i, k); });
    set(parted[b] & now[a], of(b), [&](Index i, Index k) { return -of_b.at(i, k); });
  }
};

}  // namespace arcwall::elimination
