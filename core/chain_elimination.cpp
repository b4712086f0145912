#include "core/chain_elimination.hpp"

#include <array>
#include <utility>

namespace arcwall {

namespace {

constexpr Index lanes = Lanes::count;  // groups that are worked on at once

ARCWALL_IN_PLACE Lanes load(const double* from) { return Lanes::load(from); }
ARCWALL_IN_PLACE void store(const Lanes& value, double* to) { value.store(to); }

//   [D_a       Aᵀ_ja        ]            D_j = L d Lᵀ,  Y = L⁻¹ A_j,  Z = d⁻¹ Y                                   (1)
//   [A_ja  D_j        A_jb  ]     →
//   [          Aᵀ_jb  D_b   ]            D_a −= Y_aᵀ Z_a,  D_b −= Y_bᵀ Z_b,  A_ba = −Y_bᵀ Z_a                     (2)
template <Index B>
struct Chain {
  static constexpr Index triangle = packed(B, 0);
  using Block = std::array<std::array<Lanes, B>, B>;

  // Of a packed triangle.
  static constexpr std::size_t in_triangle(Index row, Index column) {
    return static_cast<std::size_t>(packed(row, column));
  }

  ARCWALL_IN_PLACE static void load_block(const double* from, Index stride, Block& block) {
    for (Index row = 0; row < B; ++row)
      for (Index column = 0; column < B; ++column) at(block, row, column) = load(from + (row * B + column) * stride);
  }
  ARCWALL_IN_PLACE static Lanes& at(Block& block, Index row, Index column) {
    return block[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  }

  // Equations (1) and (2) for one round; the new couplings go to `coupling`.
  static void eliminate(const ChainRound& round, double* numbers, double* coupling) {
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
        const Lanes reciprocal = 1.0 / D[in_triangle(c, c)];
        std::array<Lanes, B> column;
        for (Index r = c + 1; r < B; ++r) column[static_cast<std::size_t>(r)] = D[in_triangle(r, c)];
        for (Index r = c + 1; r < B; ++r) {
          const Lanes l = column[static_cast<std::size_t>(r)] * reciprocal;
          for (Index k = c + 1; k <= r; ++k) D[in_triangle(r, k)] -= l * column[static_cast<std::size_t>(k)];
          for (Index k = 0; k < B; ++k) {
            at(a, r, k) -= l * at(a, c, k);
            at(b, r, k) -= l * at(b, c, k);
          }
          D[in_triangle(r, c)] = l;
        }
        D[in_triangle(c, c)] = reciprocal;
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
  ARCWALL_IN_PLACE static void scale(const std::array<Lanes, triangle>& D, Block& y, double* to, Index stride,
                                     Block& z) {
    for (Index row = 0; row < B; ++row)
      for (Index column = 0; column < B; ++column) {
        at(z, row, column) = at(y, row, column) * D[in_triangle(row, row)];
        store(at(z, row, column), to + (row * B + column) * stride);
      }
  }

  ARCWALL_IN_PLACE static void subtract_square(Block& y, Block& z, double* from, Index stride) {
    for (Index row = 0; row < B; ++row)
      for (Index column = 0; column <= row; ++column) {
        Lanes sum = at(y, 0, row) * at(z, 0, column);
        for (Index k = 1; k < B; ++k) sum += at(y, k, row) * at(z, k, column);
        double* entry = from + packed(row, column) * stride;
        store(load(entry) - sum, entry);
      }
  }

  // What is left of a round are the groups of the next one.
  static void pass_on(const ChainRound& round, const ChainRound& next, const double* coupling, double* numbers) {
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
  static void forward(const ChainRound& round, const double* numbers, double* f, double* left) {
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
  static void backward(const ChainRound& round, const double* numbers, double* x, const double* left) {
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

  // uᵀ |d| u with u = |L|ᵀ v_j + |Z_a| v_a + |Z_b| v_b
  static double weighted(const ChainRound& round, const double* numbers, const double* v, const double* left) {
    Lanes sum = 0.0;
    for (Index i = 0; i < round.stride; i += lanes) {
      const auto number = [&](Index place) { return magnitude(load(numbers + place + i)); };
      for (Index r = 0; r < B; ++r) {
        Lanes u = load(v + r * round.stride + i);
        for (Index k = r + 1; k < B; ++k)
          u += number(round.diagonal + packed(k, r) * round.stride) * load(v + k * round.stride + i);
        for (Index c = 0; c < B; ++c) {
          const double* entry = left + c * round.left_stride + i;
          u += number(round.before + (r * B + c) * round.stride) * load(entry);
          u += number(round.behind + (r * B + c) * round.stride) * load(entry + 1);
        }
        sum += u * u / number(round.diagonal + packed(r, r) * round.stride);
      }
    }
    return sum[0] + sum[1] + sum[2] + sum[3];
  }

  // From those that are left of a round to the next one's, and back.
  template <Index R, bool back>
  static void exchange(const ChainRound& round, const ChainRound& next, double* left, double* eliminated,
                       double* kept) {
    const auto move = [](double& from, double& to) { back ? from = to : to = from; };
    for (Index k = 0; k < B * R; ++k) {
      double* all = left + k * round.left_stride;
      if (next.left == 0) move(all[0], eliminated[k * next.stride]);
      for (Index i = 0; i < next.left; ++i) move(all[2 * i], kept[k * next.left_stride + i]);
      for (Index i = 0; i < round.left / 2; ++i) move(all[2 * i + 1], eliminated[k * next.stride + i]);
    }
  }

  // All rounds.
  static void eliminate(const std::vector<ChainRound>& rounds, double* numbers, double* coupling) {
    for (std::size_t k = 0; k < rounds.size(); ++k) {
      if (k > 0) pass_on(rounds[k - 1], rounds[k], coupling, numbers);
      eliminate(rounds[k], numbers, coupling);
    }
  }

  static double weighted(const std::vector<ChainRound>& rounds, const double* numbers, double* work) {
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
  static void solve(const std::vector<ChainRound>& rounds, const double* numbers, double* work) {
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

// Calls `code` with the width as a constant.
template <typename Code, Index... widths>
void with_width(Index width, const Code& code, std::integer_sequence<Index, widths...>) {
  ((width == widths ? code(std::integral_constant<Index, widths>{}) : void()), ...);
}

}  // namespace

Index elimination_width(Index greatest) { return next_width(greatest, Widths{}); }

void eliminate_rounds(Index width, const std::vector<ChainRound>& rounds, double* numbers, double* coupling) {
  with_width(
      width, [&](auto B) { Chain<B.value>::eliminate(rounds, numbers, coupling); }, Widths{});
}

void solve_rounds(Index width, Index columns, const std::vector<ChainRound>& rounds, const double* numbers,
                  double* work) {
  const auto solve = [&](auto B) {
    if (columns == 1) Chain<B.value>::template solve<1>(rounds, numbers, work);
    if (columns == 2) Chain<B.value>::template solve<2>(rounds, numbers, work);
  };
  with_width(width, solve, Widths{});
}

double weighted_rounds(Index width, const std::vector<ChainRound>& rounds, const double* numbers, double* work) {
  double sum = 0.0;
  with_width(
      width, [&](auto B) { sum = Chain<B.value>::weighted(rounds, numbers, work); }, Widths{});
  return sum;
}

}  // namespace arcwall
