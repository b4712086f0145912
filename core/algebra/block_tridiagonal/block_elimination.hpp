#pragma once

// The equations of cyclic reduction (README.md) for one block between two others. Not installed.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/lanes.hpp"
#include "core/types.hpp"

// A loop between two constants that is written out, so that what it works on stays in registers. Where assertions are
// on, sanitizers may be on, too, and what they add to each line is not multiplied.
#ifdef NDEBUG
#define ARCWALL_UNROLLED_FOR(index, from, to) _Pragma("GCC unroll 36") for (Index index = (from); index < (to); ++index)
#else
#define ARCWALL_UNROLLED_FOR(index, from, to) for (Index index = (from); index < (to); ++index)
#endif

// Behind the parameters of a lambda that has to be a part of what calls it. Both compilers take the attribute there,
// and the standard one in front of them is of C++23.
#define ARCWALL_INLINE_LAMBDA __attribute__((always_inline))

namespace arcwall {

/// Place of entry (row, column) in a packed lower triangle.
constexpr Index packed(Index row, Index column) { return row * (row + 1) / 2 + column; }

/// Where the numbers of a block j stand: D_j, which becomes L and 1/d; A_ja, which becomes Z_a; and A_jb, which becomes
/// Z_b; a is the block before and b the one behind. Couplings are stored by rows of j, with the block of the two that
/// is eliminated first. Where translations are known, R_j stands in place of the first two columns of D_j until that is
/// eliminated; R_j is not symmetric and has one entry more.
struct BlockLayout {
  Index width;

  constexpr Index diagonal(Index row, Index column) const { return packed(row, column); }
  constexpr Index ground(Index row, Index column) const {
    return row >= column ? packed(row, column) : packed(width, 0);
  }
  constexpr Index before(Index row, Index column) const { return packed(width, 0) + 1 + row * width + column; }
  constexpr Index behind(Index row, Index column) const { return before(width, 0) + row * width + column; }
  constexpr Index size() const { return behind(width, 0); }
};

/// The elimination of a block whose neighbours are those at a distance; block number `length` stands for what comes
/// behind the last one.
struct EliminationStep {
  Index block, distance, length;

  Index before() const { return block - distance; }
  Index behind() const { return std::min(block + distance, length); }
  /// Whether the neighbour before is eliminated earlier than the one behind: it then stores the coupling of the two.
  bool before_is_next() const { return block + distance >= length || (before() / (2 * distance)) % 2 == 1; }
};

/// Every other block is eliminated, then every other one of those that are left, until block 0 alone is left.
template <class Visit>
ARCWALL_IN_PLACE void for_each_elimination(Index length, const Visit& visit) {
  for (Index distance = 1; distance < length; distance *= 2)
    for (Index block = distance; block < length; block += 2 * distance) visit(EliminationStep{block, distance, length});
}

/// The same steps, the last round first.
template <class Visit>
ARCWALL_IN_PLACE void for_each_elimination_reversed(Index length, const Visit& visit) {
  Index distance = 1;
  while (distance < length) distance *= 2;
  for (distance /= 2; distance > 0; distance /= 2)
    for (Index block = distance; block < length; block += 2 * distance) visit(EliminationStep{block, distance, length});
}

/// What the pivots of an elimination were, side by side in lanes. Reciprocals are what is at hand.
template <class Real>
struct PivotScan {
  Real least = infinity, greatest = 0.0;  ///< magnitudes of 1/d
  Real sum = 0.0;                         ///< of these magnitudes: not finite where one is not
  Real negative = 0.0;                    ///< their number

  ARCWALL_IN_PLACE void add(const Real& reciprocal) {
    const Real size = magnitude(reciprocal);
    least = where_less(size, least, size, least);
    greatest = where_less(greatest, size, size, greatest);
    sum += size;  // NaN if any is, which minima and maxima pass over
    negative += where_less(reciprocal, Real(0.0), Real(1.0), Real(0.0));
  }
};

inline bool is_zero(double number) { return number == 0.0; }
inline bool is_zero(const Lanes& numbers) {
  return numbers[0] == 0.0 && numbers[1] == 0.0 && numbers[2] == 0.0 && numbers[3] == 0.0;
}

/// Equations for blocks of B unknowns, of which the first T are translations: 2, or 0 where these are not known. Real
/// is Lanes for four parts of a chain side by side, or double.
template <Index B, Index T, class Real>
struct BlockElimination {
  static constexpr BlockLayout at{B};
  static constexpr Index triangle = packed(B, 0), size = at.size();
  using Triangle = std::array<Real, static_cast<std::size_t>(triangle)>;
  template <Index columns>
  using Rows = std::array<std::array<Real, static_cast<std::size_t>(columns)>, static_cast<std::size_t>(B)>;

  template <class Array>
  ARCWALL_IN_PLACE static auto& entry(Array& of, Index row, Index column) {
    return of[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  }
  ARCWALL_IN_PLACE static auto& entry(Triangle& of, Index row, Index column) {
    return of[static_cast<std::size_t>(packed(row, column))];
  }
  ARCWALL_IN_PLACE static const Real& entry(const Triangle& of, Index row, Index column) {
    return of[static_cast<std::size_t>(packed(row, column))];
  }

  // With D_j = L d Lᵀ, Y = L⁻¹ A_j and Z = d⁻¹ Y:
  //
  //   A_ba = −Y_bᵀ Z_a,   D_a −= Y_aᵀ Z_a,   D_b −= Y_bᵀ Z_b                                              (1)
  //
  // but for the columns of translations, of which R_a −= Z_aᵀ L⁻¹ R_j and R_b −= Z_bᵀ L⁻¹ R_j are kept instead.  (2)
  ARCWALL_IN_PLACE static void eliminate(const EliminationStep& j, Real* numbers, PivotScan<Real>& pivots) {
    Real* const own = numbers + j.block * size;
    Real* const a = numbers + j.before() * size;
    Real* const b = numbers + j.behind() * size;
    Rows<T> ground;
    ARCWALL_UNROLLED_FOR(row, 0, B)
    ARCWALL_UNROLLED_FOR(column, 0, T) entry(ground, row, column) = own[at.ground(row, column)];
    Triangle D;
    form_diagonal(own, D);
    factorize(D, own, pivots);
    const bool is_grounded = T > 0 && !all_zero(ground);
    if (is_grounded) forward_own<T>(D.data(), ground);
    Rows<B> Y;
    const auto condense = [&](Real* coupling, Real* neighbour) ARCWALL_INLINE_LAMBDA {
      scale(D, Y, coupling);
      ARCWALL_UNROLLED_FOR(row, T, B)
      ARCWALL_UNROLLED_FOR(column, T, row + 1)
      neighbour[at.diagonal(row, column)] -= product(Y, coupling, row, column);
      if (is_grounded) ARCWALL_UNROLLED_FOR(row, 0, B)
      ARCWALL_UNROLLED_FOR(column, 0, T)
      ARCWALL_UNROLLED_FOR(k, 0, B)
      neighbour[at.ground(row, column)] -= coupling[k * B + row] * entry(ground, k, column);
    };
    Real *const with_a = own + at.before(0, 0), *const with_b = own + at.behind(0, 0);
    load_entries<B>(with_a, Y);
    forward_own<B>(D.data(), Y);
    condense(with_a, a);
    load_entries<B>(with_b, Y);
    forward_own<B>(D.data(), Y);
    Real* const to = j.before_is_next() ? a + at.behind(0, 0) : b + at.before(0, 0);
    const Index row_step = j.before_is_next() ? 1 : B, column_step = j.before_is_next() ? B : 1;
    ARCWALL_UNROLLED_FOR(row, 0, B)
    ARCWALL_UNROLLED_FOR(column, 0, B)
    to[row * row_step + column * column_step] = -product(Y, with_a, row, column);
    condense(with_b, b);
  }

  /// The last block, which has no neighbours any more.
  ARCWALL_IN_PLACE static void factorize_alone(Real* own, PivotScan<Real>& pivots) {
    Triangle D;
    ARCWALL_UNROLLED_FOR(k, 0, triangle) D[static_cast<std::size_t>(k)] = own[k];
    factorize(D, own, pivots);
  }

  // Equation (3.3b) of docs/theory.md: D_j T = R_j − A_ja T − A_jb T
  ARCWALL_IN_PLACE static void form_diagonal(const Real* own, Triangle& D) {
    ARCWALL_UNROLLED_FOR(row, 0, B)
    ARCWALL_UNROLLED_FOR(column, 0, row + 1) {
      Real sum = own[at.diagonal(row, column)];
      if (column < T) sum = (sum - own[at.before(row, column)]) - own[at.behind(row, column)];
      entry(D, row, column) = sum;
    }
  }

  ARCWALL_IN_PLACE static bool all_zero(const Rows<T>& ground) {
    Real sum = 0.0;
    ARCWALL_UNROLLED_FOR(row, 0, B)
    ARCWALL_UNROLLED_FOR(column, 0, T) sum += magnitude(entry(ground, row, column));
    return is_zero(sum);
  }

  // L and 1/d, in D and stored.
  ARCWALL_IN_PLACE static void factorize(Triangle& D, Real* stored, PivotScan<Real>& pivots) {
    ARCWALL_UNROLLED_FOR(c, 0, B) {
      const Real reciprocal = 1.0 / entry(D, c, c);
      std::array<Real, static_cast<std::size_t>(B)> column;
      ARCWALL_UNROLLED_FOR(r, c + 1, B) column[static_cast<std::size_t>(r)] = entry(D, r, c);
      ARCWALL_UNROLLED_FOR(r, c + 1, B) {
        const Real l = column[static_cast<std::size_t>(r)] * reciprocal;
        ARCWALL_UNROLLED_FOR(k, c + 1, r + 1) entry(D, r, k) -= l * column[static_cast<std::size_t>(k)];
        entry(D, r, c) = l;
      }
      entry(D, c, c) = reciprocal;
      pivots.add(reciprocal);
    }
    ARCWALL_UNROLLED_FOR(k, 0, triangle) stored[k] = D[static_cast<std::size_t>(k)];
  }

  // Z = d⁻¹ Y
  ARCWALL_IN_PLACE static void scale(const Triangle& D, const Rows<B>& Y, Real* Z) {
    ARCWALL_UNROLLED_FOR(row, 0, B)
    ARCWALL_UNROLLED_FOR(column, 0, B) Z[row * B + column] = entry(Y, row, column) * entry(D, row, row);
  }

  // Entry (row, column) of Yᵀ Z
  ARCWALL_IN_PLACE static Real product(const Rows<B>& Y, const Real* Z, Index row, Index column) {
    Real sum = entry(Y, 0, row) * Z[column];
    ARCWALL_UNROLLED_FOR(k, 1, B) sum += entry(Y, k, row) * Z[k * B + column];
    return sum;
  }

  // --- solutions: C right-hand sides side by side share each number of the factors -----------------------------------

  template <Index C>
  ARCWALL_IN_PLACE static void load_entries(const Real* from, Rows<C>& entries) {
    ARCWALL_UNROLLED_FOR(row, 0, B)
    ARCWALL_UNROLLED_FOR(c, 0, C) entry(entries, row, c) = from[row * C + c];
  }
  template <Index C>
  ARCWALL_IN_PLACE static void store_entries(const Rows<C>& entries, Real* to) {
    ARCWALL_UNROLLED_FOR(row, 0, B)
    ARCWALL_UNROLLED_FOR(c, 0, C) to[row * C + c] = entry(entries, row, c);
  }

  // y = L⁻¹ f
  template <Index C>
  ARCWALL_IN_PLACE static void forward_own(const Real* own, Rows<C>& y) {
    ARCWALL_UNROLLED_FOR(r, 0, B)
    ARCWALL_UNROLLED_FOR(k, 0, r)
    ARCWALL_UNROLLED_FOR(c, 0, C) entry(y, r, c) -= own[packed(r, k)] * entry(y, k, c);
  }

  // x = L⁻ᵀ z
  template <Index C>
  ARCWALL_IN_PLACE static void backward_own(const Real* own, Rows<C>& z) {
    ARCWALL_UNROLLED_FOR(from_last, 0, B) {
      const Index r = B - 1 - from_last;
      ARCWALL_UNROLLED_FOR(k, r + 1, B)
      ARCWALL_UNROLLED_FOR(c, 0, C) entry(z, r, c) -= own[packed(k, r)] * entry(z, k, c);
    }
  }

  // d⁻¹ y
  template <Index C>
  ARCWALL_IN_PLACE static void scale_own(const Real* own, Rows<C>& y) {
    ARCWALL_UNROLLED_FOR(r, 0, B)
    ARCWALL_UNROLLED_FOR(c, 0, C) entry(y, r, c) = entry(y, r, c) * own[packed(r, r)];
  }

  // y_j = L⁻¹ f_j,   f_a −= Z_aᵀ y_j,   f_b −= Z_bᵀ y_j
  template <Index C>
  ARCWALL_IN_PLACE static void forward(const EliminationStep& j, const Real* numbers, Real* f) {
    const Real* const own = numbers + j.block * size;
    Rows<C> y;
    load_entries<C>(f + j.block * (B * C), y);
    forward_own<C>(own, y);
    store_entries<C>(y, f + j.block * (B * C));
    for (const auto& [Z, neighbour] :
         {std::pair(own + at.before(0, 0), j.before()), std::pair(own + at.behind(0, 0), j.behind())}) {
      Rows<C> sum;
      load_entries<C>(f + neighbour * (B * C), sum);
      ARCWALL_UNROLLED_FOR(k, 0, B)
      ARCWALL_UNROLLED_FOR(r, 0, B)
      ARCWALL_UNROLLED_FOR(c, 0, C) entry(sum, k, c) -= Z[r * B + k] * entry(y, r, c);
      store_entries<C>(sum, f + neighbour * (B * C));
    }
  }

  // x_j = L⁻ᵀ(d⁻¹ y_j − Z_a x_a − Z_b x_b)
  template <Index C>
  ARCWALL_IN_PLACE static void backward(const EliminationStep& j, const Real* numbers, Real* x) {
    const Real* const own = numbers + j.block * size;
    Rows<C> z;
    load_entries<C>(x + j.block * (B * C), z);
    scale_own<C>(own, z);
    for (const auto& [Z, neighbour] :
         {std::pair(own + at.before(0, 0), j.before()), std::pair(own + at.behind(0, 0), j.behind())}) {
      Rows<C> known;
      load_entries<C>(x + neighbour * (B * C), known);
      ARCWALL_UNROLLED_FOR(k, 0, B)
      ARCWALL_UNROLLED_FOR(r, 0, B)
      ARCWALL_UNROLLED_FOR(c, 0, C) entry(z, r, c) -= Z[r * B + k] * entry(known, k, c);
    }
    backward_own<C>(own, z);
    store_entries<C>(z, x + j.block * (B * C));
  }

  template <Index C>
  ARCWALL_IN_PLACE static void solve_alone(const Real* own, Real* x) {
    Rows<C> z;
    load_entries<C>(x, z);
    forward_own<C>(own, z);
    scale_own<C>(own, z);
    backward_own<C>(own, z);
    store_entries<C>(z, x);
  }

  /// uᵀ |d| u with u = |L|ᵀ |v_j| + |Z_a| |v_a| + |Z_b| |v_b|, where `common` has been taken off each v.
  ARCWALL_IN_PLACE static Real weighted(const EliminationStep& j, const Real* numbers, const Real* v,
                                        const std::array<Real, static_cast<std::size_t>(B)>& common) {
    const Real* const own = numbers + j.block * size;
    const auto size_of = [&](Index block, Index c) {
      return magnitude(v[block * B + c] - common[static_cast<std::size_t>(c)]);
    };
    Real sum = 0.0;
    ARCWALL_UNROLLED_FOR(r, 0, B) {
      Real u = size_of(j.block, r);
      ARCWALL_UNROLLED_FOR(k, r + 1, B) u += magnitude(own[packed(k, r)]) * size_of(j.block, k);
      ARCWALL_UNROLLED_FOR(c, 0, B) {
        u += magnitude(own[at.before(r, c)]) * size_of(j.before(), c);
        u += magnitude(own[at.behind(r, c)]) * size_of(j.behind(), c);
      }
      sum += u * u / magnitude(own[packed(r, r)]);
    }
    return sum;
  }
};

}  // namespace arcwall
