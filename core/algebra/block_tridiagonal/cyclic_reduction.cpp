#include "core/algebra/block_tridiagonal/cyclic_reduction.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace arcwall {

namespace {

// Widths with code of their own. That for eight unknowns takes as long to compile as all of these.
using Widths = std::integer_sequence<Index, 1, 2, 3, 4, 5, 6>;

template <Index... widths>
Index least_width(Index greatest, std::integer_sequence<Index, widths...>) {
  for (const Index width : {widths...})
    if (greatest <= width) return width;
  return 0;
}

// Calls `code` with the width as a constant.
template <class Code, Index... widths>
ARCWALL_IN_PLACE void with_width(Index width, const Code& code, std::integer_sequence<Index, widths...>) {
  ((width == widths ? code(std::integral_constant<Index, widths>{}) : void()), ...);
}

// Calls `code`, a lambda that is always inlined, made for vectors of four numbers where the processor has them.
#ifdef __x86_64__
template <class Code>
[[gnu::target("avx")]] void by_avx(const Code& code) {
  code();
}
#endif

// Without fused operations numbers are the same on every processor, and a pivot that vanishes exactly does so: by fused
// ones k − (k/k) k would not.
template <class Code>
void in_vectors(const Code& code) {
#ifdef __x86_64__
  if (has_wide_registers()) return by_avx(code);
#endif
  code();
}

// Of lanes together.
PivotScan<double> together(const PivotScan<Lanes>& lanes) {
  PivotScan<double> all;
  for (int part = 0; part < BlockChain::parts; ++part) {
    all.least = std::min(all.least, magnitude(lanes.least[part]));  // −0 counts as 0
    all.greatest = std::max(all.greatest, lanes.greatest[part]);
    all.sum += lanes.sum[part];
    all.negative += lanes.negative[part];
  }
  return all;
}

// The first blocks of the parts, each of which has received what the part before has left behind its end.
template <Index B, Index T>
void eliminate_first_blocks(BlockChain& chain, PivotScan<double>& pivots) {
  using One = BlockElimination<B, T, double>;
  const Lanes *first = chain.block(0), *end = chain.block(chain.length);
  double* const last = chain.last.data();
  for (int part = 0; part < BlockChain::parts; ++part) {
    double* const own = last + part * One::size;
    for (Index k = 0; k <= One::triangle; ++k) own[k] = first[k][part] + (part > 0 ? end[k][part - 1] : 0.0);
    // Those of odd number have the couplings.
    for (Index row = 0; row < B; ++row)
      for (Index column = 0; column < B; ++column) {
        const double coupling = first[One::at.behind(row, column)][part];
        if (part % 2 == 1)
          own[One::at.behind(row, column)] = part + 1 < BlockChain::parts ? coupling : 0.0;
        else if (part + 1 < BlockChain::parts)
          (own + One::size)[One::at.before(column, row)] = coupling;
      }
  }
  std::fill_n(last + BlockChain::parts * One::size, One::triangle + 1, 0.0);
  for_each_elimination(BlockChain::parts, [&](const EliminationStep& j) { One::eliminate(j, last, pivots); });
  One::factorize_alone(last, pivots);
}

template <Index B, Index T>
PivotScan<double> eliminate_all(BlockChain& chain) {
  using InLanes = BlockElimination<B, T, Lanes>;
  std::fill_n(chain.block(chain.length), InLanes::triangle + 1, Lanes(0.0));
  PivotScan<Lanes> pivots;
  in_vectors([&]() ARCWALL_INLINE_LAMBDA {
    PivotScan<Lanes> seen;
    for_each_elimination(chain.length, [&](const EliminationStep& j) ARCWALL_INLINE_LAMBDA {
      InLanes::eliminate(j, chain.numbers.data(), seen);
    });
    pivots = seen;
  });
  PivotScan<double> all = together(pivots);
  eliminate_first_blocks<B, T>(chain, all);
  return all;
}

template <Index B, Index C>
void solve_first_blocks(const BlockChain& chain, Lanes* first, Lanes* end) {
  using One = BlockElimination<B, 0, double>;
  const double* const numbers = chain.last.data();
  std::array<double, static_cast<std::size_t>((BlockChain::parts + 1) * B * C)> x{};
  const auto entry = [&x](int part, Index k) -> double& { return x[static_cast<std::size_t>(part * B * C + k)]; };
  for (Index k = 0; k < B * C; ++k)
    for (int part = 0; part < BlockChain::parts; ++part)
      entry(part, k) = first[k][part] + (part > 0 ? end[k][part - 1] : 0.0);
  for_each_elimination(BlockChain::parts,
                       [&](const EliminationStep& j) { One::template forward<C>(j, numbers, x.data()); });
  One::template solve_alone<C>(numbers, x.data());
  for_each_elimination_reversed(BlockChain::parts,
                                [&](const EliminationStep& j) { One::template backward<C>(j, numbers, x.data()); });
  for (Index k = 0; k < B * C; ++k)
    for (int part = 0; part < BlockChain::parts; ++part) {
      first[k].set(part, entry(part, k));
      end[k].set(part, part + 1 < BlockChain::parts ? entry(part + 1, k) : 0.0);
    }
}

template <Index B, Index C>
void solve_all(const BlockChain& chain, Lanes* x) {
  using InLanes = BlockElimination<B, 0, Lanes>;
  const Lanes* const numbers = chain.numbers.data();
  Lanes* const end = x + chain.length * B * C;
  std::fill_n(end, B * C, Lanes(0.0));
  in_vectors([&]() ARCWALL_INLINE_LAMBDA {
    for_each_elimination(chain.length, [&](const EliminationStep& j)
                                           ARCWALL_INLINE_LAMBDA { InLanes::template forward<C>(j, numbers, x); });
  });
  solve_first_blocks<B, C>(chain, x, end);
  in_vectors([&]() ARCWALL_INLINE_LAMBDA {
    for_each_elimination_reversed(chain.length, [&](const EliminationStep& j) ARCWALL_INLINE_LAMBDA {
      InLanes::template backward<C>(j, numbers, x);
    });
  });
}

template <Index B>
double weighted_first_blocks(const BlockChain& chain, const Lanes* first) {
  using One = BlockElimination<B, 0, double>;
  const double* const numbers = chain.last.data();
  std::array<double, static_cast<std::size_t>((BlockChain::parts + 1) * B)> v{};
  for (Index k = 0; k < B; ++k)
    for (int part = 0; part < BlockChain::parts; ++part) v[static_cast<std::size_t>(part * B + k)] = first[k][part];
  double sum = 0.0;
  for_each_elimination(BlockChain::parts,
                       [&](const EliminationStep& j) { sum += One::weighted(j, numbers, v.data(), {}); });
  for (Index r = 0; r < B; ++r) {
    double u = std::abs(v[static_cast<std::size_t>(r)]);
    for (Index k = r + 1; k < B; ++k) u += std::abs(numbers[packed(k, r)] * v[static_cast<std::size_t>(k)]);
    sum += u * u / std::abs(numbers[packed(r, r)]);
  }
  return sum;
}

template <Index B>
double weighted_all(const BlockChain& chain, const std::vector<Index>& grounded_before, Lanes* v) {
  using InLanes = BlockElimination<B, 0, Lanes>;
  Lanes* const end = v + chain.length * B;
  for (Index k = 0; k < B; ++k) end[k] = Lanes(v[k][1], v[k][2], v[k][3], 0.0);
  Lanes sum = 0.0;
  for_each_elimination(chain.length, [&](const EliminationStep& j) {
    std::array<Lanes, static_cast<std::size_t>(B)> common;
    common.fill(0.0);
    for (int part = 0; part < BlockChain::parts && !grounded_before.empty(); ++part) {
      const Index a = part * chain.length + j.before(), b = part * chain.length + j.behind();
      if (grounded_before[static_cast<std::size_t>(b)] > grounded_before[static_cast<std::size_t>(a + 1)]) continue;
      for (std::size_t c = 0; c < std::min<std::size_t>(B, 2); ++c)
        common[c].set(part, v[j.block * B + static_cast<Index>(c)][part]);
    }
    sum += InLanes::weighted(j, chain.numbers.data(), v, common);
  });
  return sum[0] + sum[1] + sum[2] + sum[3] + weighted_first_blocks<B>(chain, v);
}

}  // namespace

BlockChain::BlockChain(Index of_width, Index blocks, bool knows)
    : width(of_width), length((blocks + BlockChain::parts - 1) / BlockChain::parts), knows_translations(knows) {
  numbers.assign(static_cast<std::size_t>((length + 1) * layout().size()), Lanes(0.0));
  last.assign(static_cast<std::size_t>((BlockChain::parts + 1) * layout().size()), 0.0);
}

Index elimination_width(Index greatest) { return least_width(greatest, Widths{}); }

PivotScan<double> eliminate_blocks(BlockChain& chain) {
  PivotScan<double> pivots;
  const auto eliminate = [&](auto width) {
    constexpr Index B = width.value, T = can_know_translations(B) ? 2 : 0;
    pivots = chain.knows_translations ? eliminate_all<B, T>(chain) : eliminate_all<B, 0>(chain);
  };
  with_width(chain.width, eliminate, Widths{});
  return pivots;
}

void solve_blocks(const BlockChain& chain, Index columns, Lanes* x) {
  const auto solve = [&](auto width) {
    columns == 1 ? solve_all<width.value, 1>(chain, x) : solve_all<width.value, 2>(chain, x);
  };
  with_width(chain.width, solve, Widths{});
}

double weighted_by_blocks(const BlockChain& chain, const std::vector<Index>& grounded_before, Lanes* v) {
  double sum = 0.0;
  with_width(
      chain.width, [&](auto width) { sum = weighted_all<width.value>(chain, grounded_before, v); }, Widths{});
  return sum;
}

}  // namespace arcwall
