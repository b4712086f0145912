#pragma once

// What chain_elimination.cpp does with the numbers of one group and its neighbours. Not installed.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/algebra/block_tridiagonal/chain_elimination.hpp"
#include "core/algebra/block_tridiagonal/elimination_order.hpp"

// A loop from one number up to another, both constant: without a loop, so that what it works on stays in registers.
// Where assertions are on, sanitizers may be, too, and what they add to each line is not multiplied.
#ifdef NDEBUG
#define ARCWALL_EACH(index, from, to) _Pragma("GCC unroll 36") for (Index index = (from); index < (to); ++index)
#else
#define ARCWALL_EACH(index, from, to) for (Index index = (from); index < (to); ++index)
#endif

namespace arcwall::elimination {

constexpr int lanes = Lanes::count;

constexpr int count_of(const Lanes*) { return lanes; }
constexpr int count_of(const double*) { return 1; }
inline double number(const Lanes& of, int lane) { return of[lane]; }
inline double number(double of, int) { return of; }

// ChainPivots, side by side.
template <class Real>
struct Seen {
  Real least = infinity, greatest = 0.0, sum = 0.0, least_first = infinity, negative = 0.0;

  ARCWALL_IN_PLACE void add(const Real& reciprocal) {
    const Real size = magnitude(reciprocal);
    least = where_less(size, least, size, least);
    greatest = where_less(greatest, size, size, greatest);
    sum += size;  // NaN if any is, which minima and maxima pass over
    negative += where_less(reciprocal, Real(0.0), Real(1.0), Real(0.0));
  }
  ARCWALL_IN_PLACE void add_first(const Real& reciprocal) {
    const Real size = magnitude(reciprocal);
    least_first = where_less(size, least_first, size, least_first);
  }
  void tell(ChainPivots& pivots) const {
    for (int lane = 0; lane < count_of(&least); ++lane) {
      pivots.least = std::min(pivots.least, std::abs(number(least, lane)));  // −0 counts as 0
      pivots.greatest = std::max(pivots.greatest, number(greatest, lane));
      pivots.sum += number(sum, lane);
      pivots.least_first = std::min(pivots.least_first, number(least_first, lane));
      pivots.negative += static_cast<Index>(number(negative, lane));
    }
  }
};

// Equations of chain_elimination.hpp for groups of B unknowns; numbers of all stretches in lanes, of one in doubles.
template <Index B, class Real>
struct Chain {
  static constexpr Index triangle = packed(B, 0), square = B * B, per_group = triangle + 2 * square;
  static constexpr Index before = triangle, behind = triangle + square;
  using Triangle = std::array<Real, triangle>;
  using Block = std::array<std::array<Real, B>, B>;

  // Of a packed triangle.
  static constexpr std::size_t in_triangle(Index row, Index column) {
    return static_cast<std::size_t>(packed(row, column));
  }

  ARCWALL_IN_PLACE static Real& at(Block& block, Index row, Index column) {
    return block[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  }

  // Equations (1) and (2) for one group. One side after the other, so that what is worked on fits in the registers.
  ARCWALL_IN_PLACE static void eliminate(const Going& j, Real* numbers, Seen<Real>& seen) {
    Real* const own = numbers + j.group * per_group;
    Real* const a = numbers + j.before() * per_group;
    Real* const b = numbers + j.behind() * per_group;
    Triangle D;
    factorize(own, D, seen);
    if (j.distance == 1) seen.add_first(D[0]);
    Block Y;
    forward(D, own + before, Y);
    scale(D, Y, own + before);
    subtract_square(Y, own + before, a);
    forward(D, own + behind, Y);
    if (j.before_goes_first())
      couple(Y, own + before, a + behind, 1, B);
    else
      couple(Y, own + before, b + before, B, 1);
    scale(D, Y, own + behind);
    subtract_square(Y, own + behind, b);
  }

  // L and 1/d, in place and in D.
  ARCWALL_IN_PLACE static void factorize(Real* diagonal, Triangle& D, Seen<Real>& seen) {
    ARCWALL_EACH (k, 0, triangle) D[static_cast<std::size_t>(k)] = diagonal[k];
    ARCWALL_EACH (c, 0, B) {
      const Real reciprocal = 1.0 / D[in_triangle(c, c)];
      std::array<Real, B> column;
      ARCWALL_EACH (r, c + 1, B) column[static_cast<std::size_t>(r)] = D[in_triangle(r, c)];
      ARCWALL_EACH (r, c + 1, B) {
        const Real l = column[static_cast<std::size_t>(r)] * reciprocal;
        ARCWALL_EACH (k, c + 1, r + 1) D[in_triangle(r, k)] -= l * column[static_cast<std::size_t>(k)];
        D[in_triangle(r, c)] = l;
      }
      D[in_triangle(c, c)] = reciprocal;
      seen.add(reciprocal);
    }
    ARCWALL_EACH (k, 0, triangle) diagonal[k] = D[static_cast<std::size_t>(k)];
  }

  // Y = L⁻¹ A
  ARCWALL_IN_PLACE static void forward(const Triangle& D, const Real* A, Block& Y) {
    ARCWALL_EACH (row, 0, B)
      ARCWALL_EACH (column, 0, B) at(Y, row, column) = A[row * B + column];
    ARCWALL_EACH (c, 0, B)
      ARCWALL_EACH (r, c + 1, B)
        ARCWALL_EACH (k, 0, B) at(Y, r, k) -= D[in_triangle(r, c)] * at(Y, c, k);
  }

  // Z = d⁻¹ Y
  ARCWALL_IN_PLACE static void scale(const Triangle& D, Block& Y, Real* Z) {
    ARCWALL_EACH (row, 0, B)
      ARCWALL_EACH (column, 0, B) Z[row * B + column] = at(Y, row, column) * D[in_triangle(row, row)];
  }

  // Entry (row, column) of Yᵀ Z
  ARCWALL_IN_PLACE static Real product(Block& Y, const Real* Z, Index row, Index column) {
    Real sum = at(Y, 0, row) * Z[column];
    ARCWALL_EACH (k, 1, B) sum += at(Y, k, row) * Z[k * B + column];
    return sum;
  }

  ARCWALL_IN_PLACE static void subtract_square(Block& Y, const Real* Z, Real* from) {
    ARCWALL_EACH (row, 0, B)
      ARCWALL_EACH (column, 0, row + 1) from[packed(row, column)] -= product(Y, Z, row, column);
  }

  // A_ba, or A_ab where the steps from row to row and from column to column say so.
  ARCWALL_IN_PLACE static void couple(Block& Y_b, const Real* Z_a, Real* to, Index row_step, Index column_step) {
    ARCWALL_EACH (row, 0, B)
      ARCWALL_EACH (column, 0, B) to[row * row_step + column * column_step] = -product(Y_b, Z_a, row, column);
  }

  // Of R right-hand sides, which share each number of the factors.
  template <Index R>
  using Entries = std::array<Real, static_cast<std::size_t>(R)>;

  template <Index R>
  ARCWALL_IN_PLACE static Entries<R> load(const Real* from) {
    Entries<R> entries;
    ARCWALL_EACH (s, 0, R) entries[static_cast<std::size_t>(s)] = from[s];
    return entries;
  }
  template <Index R>
  ARCWALL_IN_PLACE static void store(const Entries<R>& entries, Real* to) {
    ARCWALL_EACH (s, 0, R) to[s] = entries[static_cast<std::size_t>(s)];
  }
  template <Index R>
  ARCWALL_IN_PLACE static void subtract(const Real& number, const Entries<R>& of, Entries<R>& from) {
    ARCWALL_EACH (s, 0, R) from[static_cast<std::size_t>(s)] -= number * of[static_cast<std::size_t>(s)];
  }

  // L y = f for one that goes.
  template <Index R>
  ARCWALL_IN_PLACE static std::array<Entries<R>, B> forward_own(const Real* own, Real* f) {
    std::array<Entries<R>, B> y;
    ARCWALL_EACH (r, 0, B) {
      Entries<R>& sum = y[static_cast<std::size_t>(r)];
      sum = load<R>(f + r * R);
      ARCWALL_EACH (c, 0, r) subtract<R>(own[packed(r, c)], y[static_cast<std::size_t>(c)], sum);
      store<R>(sum, f + r * R);
    }
    return y;
  }

  // And what it takes from its neighbours: f_a −= Z_aᵀ y, f_b −= Z_bᵀ y.
  template <Index R>
  ARCWALL_IN_PLACE static void forward(const Going& j, const Real* numbers, Real* f) {
    const Real* const own = numbers + j.group * per_group;
    const auto y = forward_own<R>(own, f + j.group * (B * R));
    for (const auto& [Z, neighbour] : {std::pair(own + before, j.before()), std::pair(own + behind, j.behind())})
      ARCWALL_EACH (c, 0, B) {
        Real* const entry = f + neighbour * (B * R) + c * R;
        Entries<R> sum = load<R>(entry);
        ARCWALL_EACH (r, 0, B) subtract<R>(Z[r * B + c], y[static_cast<std::size_t>(r)], sum);
        store<R>(sum, entry);
      }
  }

  // x = L⁻ᵀ z
  template <Index R>
  ARCWALL_IN_PLACE static void backward_own(const Real* own, std::array<Entries<R>, B>& z, Real* x) {
    ARCWALL_EACH (from_last, 0, B) {
      const Index r = B - 1 - from_last;
      Entries<R>& sum = z[static_cast<std::size_t>(r)];
      ARCWALL_EACH (k, r + 1, B) subtract<R>(own[packed(k, r)], z[static_cast<std::size_t>(k)], sum);
      store<R>(sum, x + r * R);
    }
  }

  // d⁻¹ y
  template <Index R>
  ARCWALL_IN_PLACE static std::array<Entries<R>, B> scaled(const Real* own, const Real* y) {
    std::array<Entries<R>, B> z;
    ARCWALL_EACH (r, 0, B) {
      z[static_cast<std::size_t>(r)] = load<R>(y + r * R);
      for (Real& entry : z[static_cast<std::size_t>(r)]) entry = entry * own[packed(r, r)];
    }
    return z;
  }

  // x = L⁻ᵀ(d⁻¹ y − Z_a x_a − Z_b x_b)
  template <Index R>
  ARCWALL_IN_PLACE static void backward(const Going& j, const Real* numbers, Real* x) {
    const Real* const own = numbers + j.group * per_group;
    auto z = scaled<R>(own, x + j.group * (B * R));
    for (const auto& [Z, neighbour] : {std::pair(own + before, j.before()), std::pair(own + behind, j.behind())})
      ARCWALL_EACH (c, 0, B) {
        const Entries<R> known = load<R>(x + neighbour * (B * R) + c * R);
        ARCWALL_EACH (r, 0, B) subtract<R>(Z[r * B + c], known, z[static_cast<std::size_t>(r)]);
      }
    backward_own<R>(own, z, x + j.group * (B * R));
  }

  // Of the last one, which has no neighbours any more.
  template <Index R>
  ARCWALL_IN_PLACE static void solve_alone(const Real* own, Real* x) {
    forward_own<R>(own, x);
    auto z = scaled<R>(own, x);
    backward_own<R>(own, z, x);
  }

  // uᵀ |d| u with u = |L|ᵀ |v_j| + |Z_a| |v_a| + |Z_b| |v_b|, and v without `common`, its first two entries
  ARCWALL_IN_PLACE static Real weighted(const Going& j, const Real* numbers, const Real* v,
                                        const std::array<Real, B>& common) {
    const Real* const own = numbers + j.group * per_group;
    const Real* const v_own = v + j.group * B;
    const Real* const v_a = v + j.before() * B;
    const Real* const v_b = v + j.behind() * B;
    const auto size = [&](const Real* of, Index c) { return magnitude(of[c] - common[static_cast<std::size_t>(c)]); };
    Real sum = 0.0;
    ARCWALL_EACH (r, 0, B) {
      Real u = size(v_own, r);
      ARCWALL_EACH (k, r + 1, B) u += magnitude(own[packed(k, r)]) * size(v_own, k);
      ARCWALL_EACH (c, 0, B) {
        u += magnitude(own[before + r * B + c]) * size(v_a, c);
        u += magnitude(own[behind + r * B + c]) * size(v_b, c);
      }
      sum += u * u / magnitude(own[packed(r, r)]);
    }
    return sum;
  }
};

}  // namespace arcwall::elimination
