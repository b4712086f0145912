#include "core/chain_elimination.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace arcwall {

namespace {

// A loop from one number up to another, both constant: without a loop, so that what it works on stays in registers.
// Where assertions are on, sanitizers may be, too, and what they add to each line is not multiplied.
#ifdef NDEBUG
#define ARCWALL_EACH(index, from, to) _Pragma("GCC unroll 36") for (Index index = (from); index < (to); ++index)
#else
#define ARCWALL_EACH(index, from, to) for (Index index = (from); index < (to); ++index)
#endif

constexpr Index lanes = Lanes::count;  // groups that are worked on at once

ARCWALL_IN_PLACE Lanes load(const double* from) { return Lanes::load(from); }
ARCWALL_IN_PLACE void store(const Lanes& value, double* to) { value.store(to); }

//   [D_a       Aᵀ_ja        ]            D_j = L d Lᵀ,  Y = L⁻¹ A_j,  Z = d⁻¹ Y                                   (1)
//   [A_ja  D_j        A_jb  ]     →
//   [          Aᵀ_jb  D_b   ]            D_a −= Y_aᵀ Z_a,  D_b −= Y_bᵀ Z_b,  A_ba = −Y_bᵀ Z_a                     (2)
template <Index B>
struct Chain {
  static constexpr Index triangle = packed(B, 0);
  using Triangle = std::array<Lanes, triangle>;
  using Block = std::array<std::array<Lanes, B>, B>;

  // Of a packed triangle.
  static constexpr std::size_t in_triangle(Index row, Index column) {
    return static_cast<std::size_t>(packed(row, column));
  }

  ARCWALL_IN_PLACE static Lanes& at(Block& block, Index row, Index column) {
    return block[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  }

  // Equations (1) and (2) for one round; the new couplings go to `coupling`. One side after the other, so that what is
  // worked on fits in the registers.
  ARCWALL_IN_PLACE static void eliminate(const ChainRound& round, double* numbers, double* coupling) {
    const Index stride = round.stride;
    for (Index i = 0; i < stride; i += lanes) {
      double *before = numbers + round.before + i, *behind = numbers + round.behind + i;
      double* left = numbers + round.kept + i;
      Triangle D;
      factorize(numbers + round.diagonal + i, stride, D);
      Block Y;
      forward(D, before, stride, Y);
      scale(D, Y, before, stride);
      subtract_square(Y, before, stride, left, round.left_stride);
      forward(D, behind, stride, Y);
      couple(Y, before, stride, coupling + i);
      scale(D, Y, behind, stride);
      subtract_square(Y, behind, stride, left + 1, round.left_stride);
      if (round.is_afloat(i))
        balance<Rows::own, Rows::others>(coupling - 1 + i, coupling + i, stride, left, round.left_stride);
    }
  }

  // Whose unknowns the rows of a coupling belong to, seen from one of its two groups.
  enum class Rows { own, others };

  // Equation (3) with a group's two couplings.
  template <Rows one_rows, Rows other_rows>
  ARCWALL_IN_PLACE static void balance(const double* one, const double* other, Index stride, double* D,
                                       Index D_stride) {
    constexpr Index displacements = std::min<Index>(B, 2);
    const auto at = [](Rows rows, Index row, Index column) {
      return rows == Rows::own ? row * B + column : column * B + row;
    };
    ARCWALL_EACH (column, 0, displacements)
      ARCWALL_EACH (row, column, B)
        store(-load(one + at(one_rows, row, column) * stride) - load(other + at(other_rows, row, column) * stride),
              D + packed(row, column) * D_stride);
  }

  // The same before anything is eliminated, on both sides of those that will be and of those that will be left.
  ARCWALL_IN_PLACE static void balance(const ChainRound& round, double* numbers) {
    for (Index i = 0; i < round.stride; i += lanes) {
      if (!round.is_afloat(i)) continue;
      const double *before = numbers + round.before + i, *behind = numbers + round.behind + i;
      balance<Rows::own, Rows::own>(before, behind, round.stride, numbers + round.diagonal + i, round.stride);
      balance<Rows::others, Rows::others>(behind - 1, before, round.stride, numbers + round.kept + i,
                                          round.left_stride);
    }
  }

  // L and 1/d, in place and in D.
  ARCWALL_IN_PLACE static void factorize(double* diagonal, Index stride, Triangle& D) {
    ARCWALL_EACH (k, 0, triangle) D[static_cast<std::size_t>(k)] = load(diagonal + k * stride);
    ARCWALL_EACH (c, 0, B) {
      const Lanes reciprocal = 1.0 / D[in_triangle(c, c)];
      std::array<Lanes, B> column;
      ARCWALL_EACH (r, c + 1, B) column[static_cast<std::size_t>(r)] = D[in_triangle(r, c)];
      ARCWALL_EACH (r, c + 1, B) {
        const Lanes l = column[static_cast<std::size_t>(r)] * reciprocal;
        ARCWALL_EACH (k, c + 1, r + 1) D[in_triangle(r, k)] -= l * column[static_cast<std::size_t>(k)];
        D[in_triangle(r, c)] = l;
      }
      D[in_triangle(c, c)] = reciprocal;
    }
    ARCWALL_EACH (k, 0, triangle) store(D[static_cast<std::size_t>(k)], diagonal + k * stride);
  }

  // Y = L⁻¹ A
  ARCWALL_IN_PLACE static void forward(const Triangle& D, const double* A, Index stride, Block& Y) {
    ARCWALL_EACH (row, 0, B)
      ARCWALL_EACH (column, 0, B) at(Y, row, column) = load(A + (row * B + column) * stride);
    ARCWALL_EACH (c, 0, B)
      ARCWALL_EACH (r, c + 1, B)
        ARCWALL_EACH (k, 0, B) at(Y, r, k) -= D[in_triangle(r, c)] * at(Y, c, k);
  }

  // Z = d⁻¹ Y
  ARCWALL_IN_PLACE static void scale(const Triangle& D, Block& Y, double* Z, Index stride) {
    ARCWALL_EACH (row, 0, B)
      ARCWALL_EACH (column, 0, B) store(at(Y, row, column) * D[in_triangle(row, row)], Z + (row * B + column) * stride);
  }

  // Entry (row, column) of Yᵀ Z
  ARCWALL_IN_PLACE static Lanes product(Block& Y, const double* Z, Index stride, Index row, Index column) {
    Lanes sum = at(Y, 0, row) * load(Z + column * stride);
    ARCWALL_EACH (k, 1, B) sum += at(Y, k, row) * load(Z + (k * B + column) * stride);
    return sum;
  }

  ARCWALL_IN_PLACE static void subtract_square(Block& Y, const double* Z, Index stride, double* from,
                                               Index from_stride) {
    ARCWALL_EACH (row, 0, B)
      ARCWALL_EACH (column, 0, row + 1) {
        double* entry = from + packed(row, column) * from_stride;
        store(load(entry) - product(Y, Z, stride, row, column), entry);
      }
  }

  ARCWALL_IN_PLACE static void couple(Block& Y_b, const double* Z_a, Index stride, double* coupling) {
    ARCWALL_EACH (row, 0, B)
      ARCWALL_EACH (column, 0, B)
        store(-product(Y_b, Z_a, stride, row, column), coupling + (row * B + column) * stride);
  }

  // The even and the odd ones of those that follow each other in `all`, and back.
  ARCWALL_IN_PLACE static void part(const double* __restrict all, double* __restrict even, Index evens,
                                    double* __restrict odd, Index odds) {
    for (Index i = 0; i < odds; ++i) {
      even[i] = all[2 * i];
      odd[i] = all[2 * i + 1];
    }
    for (Index i = odds; i < evens; ++i) even[i] = all[2 * i];
  }
  ARCWALL_IN_PLACE static void join(double* __restrict all, const double* __restrict even, Index evens,
                                    const double* __restrict odd, Index odds) {
    for (Index i = 0; i < odds; ++i) {
      all[2 * i] = even[i];
      all[2 * i + 1] = odd[i];
    }
    for (Index i = odds; i < evens; ++i) all[2 * i] = even[i];
  }

  // What is left of a round are the groups of the next one.
  ARCWALL_IN_PLACE static void pass_on(const ChainRound& round, const ChainRound& next, const double* coupling,
                                       double* numbers) {
    const Index couplings = round.left - 1, evens = round.left - round.left / 2, odds = round.left / 2;
    for (Index k = 0; k < triangle; ++k) {
      const double* from = numbers + round.kept + k * round.left_stride;
      double* eliminated = numbers + next.diagonal + k * next.stride;
      if (next.left == 0)
        eliminated[0] = from[0];
      else
        part(from, numbers + next.kept + k * next.left_stride, evens, eliminated, odds);
    }
    for (Index row = 0; row < B; ++row)
      for (Index column = 0; column < B; ++column) {
        const double* from = coupling + (row * B + column) * round.stride;
        double* before = numbers + next.before + (row * B + column) * next.stride;
        double* behind = numbers + next.behind + (column * B + row) * next.stride;
        // Of group i + 1 with group i; the last one may have nothing behind it, and the last of all stands alone.
        if (next.left == 0) before[0] = 0.0;
        if (round.left % 2 == 0 || next.left == 0) behind[next.eliminated - 1] = 0.0;
        part(from, before, couplings - couplings / 2, behind, couplings / 2);
      }
  }

  // Of R right-hand sides, which share each number of the factors.
  template <Index R>
  using Entries = std::array<Lanes, static_cast<std::size_t>(R)>;

  template <Index R>
  ARCWALL_IN_PLACE static Entries<R> load_entries(const double* from, Index stride) {
    Entries<R> entries;
    ARCWALL_EACH (s, 0, R) entries[static_cast<std::size_t>(s)] = load(from + s * stride);
    return entries;
  }
  template <Index R>
  ARCWALL_IN_PLACE static void store_entries(const Entries<R>& entries, double* to, Index stride) {
    ARCWALL_EACH (s, 0, R) store(entries[static_cast<std::size_t>(s)], to + s * stride);
  }
  template <Index R>
  ARCWALL_IN_PLACE static void subtract(const Lanes& number, const Entries<R>& of, Entries<R>& from) {
    ARCWALL_EACH (s, 0, R) from[static_cast<std::size_t>(s)] -= number * of[static_cast<std::size_t>(s)];
  }

  // L y = f for those eliminated, and what it takes from those left: f_a −= Z_aᵀ y, f_b −= Z_bᵀ y.
  template <Index R>
  ARCWALL_IN_PLACE static void forward(const ChainRound& round, const double* numbers, double* f, double* left) {
    const Index stride = round.stride, left_stride = round.left_stride;
    for (Index i = 0; i < stride; i += lanes) {
      std::array<Entries<R>, B> y;
      ARCWALL_EACH (r, 0, B) {
        Entries<R>& sum = y[static_cast<std::size_t>(r)];
        sum = load_entries<R>(f + r * R * stride + i, stride);
        ARCWALL_EACH (c, 0, r)
          subtract<R>(load(numbers + round.diagonal + packed(r, c) * stride + i), y[static_cast<std::size_t>(c)], sum);
        store_entries<R>(sum, f + r * R * stride + i, stride);
      }
      for (const auto& [z, shift] : {std::pair(round.before, Index{0}), std::pair(round.behind, Index{1})})
        ARCWALL_EACH (c, 0, B) {
          double* entry = left + c * R * left_stride + i + shift;
          Entries<R> sum = load_entries<R>(entry, left_stride);
          ARCWALL_EACH (r, 0, B)
            subtract<R>(load(numbers + z + (r * B + c) * stride + i), y[static_cast<std::size_t>(r)], sum);
          store_entries<R>(sum, entry, left_stride);
        }
    }
  }

  // x = L⁻ᵀ (d⁻¹ y − Z_a x_a − Z_b x_b)
  template <Index R>
  ARCWALL_IN_PLACE static void backward(const ChainRound& round, const double* numbers, double* x, const double* left) {
    const Index stride = round.stride, left_stride = round.left_stride;
    for (Index i = 0; i < stride; i += lanes) {
      std::array<Entries<R>, B> z;
      ARCWALL_EACH (r, 0, B) {
        const Lanes reciprocal = load(numbers + round.diagonal + packed(r, r) * stride + i);
        z[static_cast<std::size_t>(r)] = load_entries<R>(x + r * R * stride + i, stride);
        for (Lanes& entry : z[static_cast<std::size_t>(r)]) entry = entry * reciprocal;
      }
      ARCWALL_EACH (c, 0, B) {
        const double* entry = left + c * R * left_stride + i;
        const Entries<R> before = load_entries<R>(entry, left_stride);
        const Entries<R> behind = load_entries<R>(entry + 1, left_stride);
        ARCWALL_EACH (r, 0, B) {
          Entries<R>& sum = z[static_cast<std::size_t>(r)];
          subtract<R>(load(numbers + round.before + (r * B + c) * stride + i), before, sum);
          subtract<R>(load(numbers + round.behind + (r * B + c) * stride + i), behind, sum);
        }
      }
      ARCWALL_EACH (from_last, 0, B) {
        const Index r = B - 1 - from_last;
        Entries<R>& sum = z[static_cast<std::size_t>(r)];
        ARCWALL_EACH (k, r + 1, B)
          subtract<R>(load(numbers + round.diagonal + packed(k, r) * stride + i), z[static_cast<std::size_t>(k)], sum);
        store_entries<R>(sum, x + r * R * stride + i, stride);
      }
    }
  }

  // uᵀ |d| u with u = |L|ᵀ |v_j| + |Z_a| |v_a| + |Z_b| |v_b|, of groups afloat with v − T v_j for v
  ARCWALL_IN_PLACE static double weighted(const ChainRound& round, const double* numbers, const double* v,
                                          const double* left) {
    Lanes sum = 0.0;
    for (Index i = 0; i < round.stride; i += lanes) {
      std::array<Lanes, B> common;
      common.fill(0.0);
      if (round.is_afloat(i) && i + lanes < round.stride && round.is_afloat(i + lanes))
        for (Index c = 0; c < std::min<Index>(B, 2); ++c)
          common[static_cast<std::size_t>(c)] = load(v + c * round.stride + i);
      const auto number = [&](Index place) { return magnitude(load(numbers + place + i)); };
      const auto size = [&](const double* entry, Index c) {
        return magnitude(load(entry) - common[static_cast<std::size_t>(c)]);
      };
      ARCWALL_EACH (r, 0, B) {
        Lanes u = size(v + r * round.stride + i, r);
        ARCWALL_EACH (k, r + 1, B)
          u += number(round.diagonal + packed(k, r) * round.stride) * size(v + k * round.stride + i, k);
        ARCWALL_EACH (c, 0, B) {
          const double* entry = left + c * round.left_stride + i;
          u += number(round.before + (r * B + c) * round.stride) * size(entry, c);
          u += number(round.behind + (r * B + c) * round.stride) * size(entry + 1, c);
        }
        sum += u * u / number(round.diagonal + packed(r, r) * round.stride);
      }
    }
    return sum[0] + sum[1] + sum[2] + sum[3];
  }

  // From those that are left of a round to the next one's, and back.
  template <Index R, bool back>
  ARCWALL_IN_PLACE static void exchange(const ChainRound& round, const ChainRound& next, double* left,
                                        double* eliminated, double* kept) {
    for (Index k = 0; k < B * R; ++k) {
      double *all = left + k * round.left_stride, *odd = eliminated + k * next.stride;
      if (next.left == 0)
        back ? all[0] = odd[0] : odd[0] = all[0];
      else if (back)
        join(all, kept + k * next.left_stride, next.left, odd, next.eliminated);
      else
        part(all, kept + k * next.left_stride, next.left, odd, next.eliminated);
    }
  }

  // All rounds.
  ARCWALL_IN_PLACE static void eliminate(const std::vector<ChainRound>& rounds, double* numbers, double* coupling) {
    for (std::size_t k = 0; k < rounds.size(); ++k) {
      if (k > 0)
        pass_on(rounds[k - 1], rounds[k], coupling, numbers);
      else
        balance(rounds[k], numbers);
      eliminate(rounds[k], numbers, coupling);
    }
  }

  ARCWALL_IN_PLACE static double weighted(const std::vector<ChainRound>& rounds, const double* numbers, double* work) {
    double sum = 0.0;
    for (std::size_t k = 0; k < rounds.size(); ++k) {
      const ChainRound& round = rounds[k];
      double *eliminated = work + round.right_hand_side, *left = work + round.right_hand_side_left;
      if (k > 0) exchange<1, false>(rounds[k - 1], round, work + rounds[k - 1].right_hand_side_left, eliminated, left);
      sum += weighted(round, numbers, eliminated, left);
    }
    return sum;
  }

  template <Index R>
  ARCWALL_IN_PLACE static void solve(const std::vector<ChainRound>& rounds, const double* numbers, double* work) {
    const auto eliminated = [&](const ChainRound& round) { return work + R * round.right_hand_side; };
    const auto left = [&](const ChainRound& round) { return work + R * round.right_hand_side_left; };
    for (std::size_t k = 0; k < rounds.size(); ++k) {
      const ChainRound& round = rounds[k];
      if (k > 0) exchange<R, false>(rounds[k - 1], round, left(rounds[k - 1]), eliminated(round), left(round));
      forward<R>(round, numbers, eliminated(round), left(round));
    }
    for (std::size_t k = rounds.size(); k-- > 0;) {
      const ChainRound& round = rounds[k];
      backward<R>(round, numbers, eliminated(round), left(round));
      if (k > 0) exchange<R, true>(rounds[k - 1], round, left(rounds[k - 1]), eliminated(round), left(round));
    }
  }
};

// Widths with code of their own.
using Widths = std::integer_sequence<Index, 1, 2, 3, 4, 5, 6, 8>;

template <Index... widths>
Index next_width(Index width, std::integer_sequence<Index, widths...>) {
  Index result = 0;
  ((result = result == 0 && width <= widths ? widths : result), ...);
  return result;
}

// The code of a width, and its choice: all of it in one function, so that it can be made for more than one processor.
struct Elimination {
  Index width;
  const std::vector<ChainRound>& rounds;

  // Calls `code` with the width as a constant.
  template <typename Code, Index... widths>
  ARCWALL_IN_PLACE void with_width(const Code& code, std::integer_sequence<Index, widths...>) const {
    ((width == widths ? code(Chain<widths>{}) : void()), ...);
  }

  ARCWALL_IN_PLACE void eliminate(double* numbers, double* coupling) const {
    with_width([&] [[gnu::always_inline]] (auto chain) { chain.eliminate(rounds, numbers, coupling); }, Widths{});
  }
  ARCWALL_IN_PLACE void solve(Index columns, const double* numbers, double* work) const {
    const auto code = [&] [[gnu::always_inline]] (auto chain) {
      if (columns == 1) chain.template solve<1>(rounds, numbers, work);
      if (columns == 2) chain.template solve<2>(rounds, numbers, work);
    };
    with_width(code, Widths{});
  }
  ARCWALL_IN_PLACE double weighted(const double* numbers, double* work) const {
    double sum = 0.0;
    with_width([&] [[gnu::always_inline]] (auto chain) { sum = chain.weighted(rounds, numbers, work); }, Widths{});
    return sum;
  }
};

// One vector of four where the processor has them. Factors are the same numbers everywhere, and a pivot that vanishes
// exactly does so: k − (k/k) k would not by fused operations. Solutions have these, too.
#ifdef __x86_64__
[[gnu::target("avx")]] void eliminate_wide(const Elimination& chain, double* numbers, double* coupling) {
  chain.eliminate(numbers, coupling);
}
[[gnu::target("avx,fma")]] void solve_wide(const Elimination& chain, Index columns, const double* numbers,
                                           double* work) {
  chain.solve(columns, numbers, work);
}
[[gnu::target("avx,fma")]] double weighted_wide(const Elimination& chain, const double* numbers, double* work) {
  return chain.weighted(numbers, work);
}
bool has_fused_operations() { return has_wide_registers() && __builtin_cpu_supports("fma") != 0; }
#endif

}  // namespace

Index elimination_width(Index greatest) { return next_width(greatest, Widths{}); }

void eliminate_rounds(Index width, const std::vector<ChainRound>& rounds, double* numbers, double* coupling) {
  const Elimination chain{width, rounds};
#ifdef __x86_64__
  if (has_wide_registers()) return eliminate_wide(chain, numbers, coupling);
#endif
  chain.eliminate(numbers, coupling);
}

void solve_rounds(Index width, Index columns, const std::vector<ChainRound>& rounds, const double* numbers,
                  double* work) {
  const Elimination chain{width, rounds};
#ifdef __x86_64__
  if (has_fused_operations()) return solve_wide(chain, columns, numbers, work);
#endif
  chain.solve(columns, numbers, work);
}

double weighted_rounds(Index width, const std::vector<ChainRound>& rounds, const double* numbers, double* work) {
  const Elimination chain{width, rounds};
#ifdef __x86_64__
  if (has_fused_operations()) return weighted_wide(chain, numbers, work);
#endif
  return chain.weighted(numbers, work);
}

}  // namespace arcwall
