#include "core/algebra/block_tridiagonal/chain_elimination.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/algebra/block_tridiagonal/elimination_afloat.hpp"
#include "core/algebra/block_tridiagonal/elimination_group.hpp"
#include "core/algebra/block_tridiagonal/elimination_order.hpp"

namespace arcwall {

namespace {

using namespace elimination;

// A chain of a width with all that is worked on: in lanes, and at last the groups that these leave.
template <Index B>
struct WholeChain {
  using InLanes = Chain<B, Lanes>;
  using One = Chain<B, double>;

  // Numbers of two groups that a solution comes to soon: processors do not foresee its order, and main memory is far.
  static constexpr Index ahead = 24;
  template <Index distance>
  ARCWALL_IN_PLACE static void ask_from(const Going& j, const ChainNumbers& chain) {
    const Index group = std::clamp<Index>(j.group + distance, 0, chain.length - 1);
    const Lanes* const from = chain.numbers.data() + group * InLanes::per_group;
    ask_ahead(from, from + InLanes::per_group * 2);
  }

  ARCWALL_IN_PLACE static void eliminate(ChainNumbers& chain, Index begin, Index end, ChainPivots& pivots) {
    Lanes* const numbers = chain.numbers.data();
    Seen<Lanes> seen;
    if (begin == 0) std::fill_n(chain.group(chain.length), InLanes::triangle, Lanes(0.0));
    if (chain.translation_free.empty()) {
      for_each_going(begin, end, chain.length,
                     [&] [[gnu::always_inline]] (const Going& j) { InLanes::eliminate(j, numbers, seen); });
    } else {
      if (begin == 0) chain.afloat_now = chain.translation_free;
      const Afloat<B> translation_free{chain};
      if (end == chain.length) translation_free.begin_at_end();
      for_each_going(begin, end, chain.length, [&] [[gnu::always_inline]] (const Going& j) {
        const auto part = translation_free.before_going(j);
        InLanes::eliminate(j, numbers, seen);
        translation_free.when_gone(j, part);
      });
    }
    seen.tell(pivots);
    if (end == chain.length) eliminate_last(chain, pivots);
  }

  static void eliminate_last(ChainNumbers& chain, ChainPivots& pivots) {
    const Lanes *first = chain.group(0), *end = chain.group(chain.length);
    double* const last = chain.last.data();
    const auto group = [last](int lane) { return last + lane * One::per_group; };
    for (int lane = 0; lane < lanes; ++lane) {
      for (Index k = 0; k < One::triangle; ++k) group(lane)[k] = first[k][lane] + (lane > 0 ? end[k][lane - 1] : 0.0);
      // Those of odd number have the couplings.
      for (Index row = 0; row < B; ++row)
        for (Index column = 0; column < B; ++column) {
          const double coupling = first[InLanes::behind + row * B + column][lane];
          if (lane % 2 == 1)
            group(lane)[One::behind + row * B + column] = lane + 1 < lanes ? coupling : 0.0;
          else
            group(lane + 1)[One::before + column * B + row] = coupling;
        }
    }
    std::fill_n(group(lanes), One::triangle, 0.0);
    Seen<double> seen;
    for_each_going(0, lanes, lanes, [&](const Going& j) { One::eliminate(j, last, seen); });
    typename One::Triangle D;
    One::factorize(last, D, seen);
    if (chain.length > 1) seen.least_first = infinity;
    seen.tell(pivots);
  }

  template <Index R>
  ARCWALL_IN_PLACE static void forward(const ChainNumbers& chain, Index begin, Index end, ChainWork& work) {
    const Lanes* const numbers = chain.numbers.data();
    Lanes *const x = work.entries.data(), *const behind = x + chain.length * B * R;
    if (begin == 0) std::fill_n(behind, B * R, Lanes(0.0));
    for_each_going(begin, end, chain.length, [&] [[gnu::always_inline]] (const Going& j) {
      if (j.distance == 1) ask_from<ahead>(j, chain);
      InLanes::template forward<R>(j, numbers, x);
    });
    if (end == chain.length) solve_last<R>(chain, x, behind, work.last.data());
  }

  template <Index R>
  ARCWALL_IN_PLACE static void backward(const ChainNumbers& chain, Index begin, Index end, ChainWork& work) {
    for_each_gone(begin, end, chain.length, [&] [[gnu::always_inline]] (const Going& j) {
      if (j.distance == 1) ask_from<-ahead>(j, chain);
      InLanes::template backward<R>(j, chain.numbers.data(), work.entries.data());
    });
  }

  template <Index R>
  static void solve_last(const ChainNumbers& chain, Lanes* first, Lanes* end, double* x) {
    const double* const numbers = chain.last.data();
    const auto entry = [x](int lane, Index k) -> double& { return x[lane * B * R + k]; };
    for (Index k = 0; k < B * R; ++k) {
      for (int lane = 0; lane < lanes; ++lane) entry(lane, k) = first[k][lane] + (lane > 0 ? end[k][lane - 1] : 0.0);
      entry(lanes, k) = 0.0;
    }
    for_each_going(0, lanes, lanes, [&](const Going& j) { One::template forward<R>(j, numbers, x); });
    One::template solve_alone<R>(numbers, x);
    for_each_gone(0, lanes, lanes, [&](const Going& j) { One::template backward<R>(j, numbers, x); });
    for (Index k = 0; k < B * R; ++k)
      for (int lane = 0; lane < lanes; ++lane) {
        first[k].set(lane, entry(lane, k));
        end[k].set(lane, lane + 1 < lanes ? entry(lane + 1, k) : 0.0);
      }
  }

  ARCWALL_IN_PLACE static double weighted(const ChainNumbers& chain, ChainWork& work) {
    const Lanes* const numbers = chain.numbers.data();
    Lanes *const v = work.entries.data(), *const end = v + chain.length * B;
    for (Index k = 0; k < B; ++k) end[k] = Lanes(v[k][1], v[k][2], v[k][3], 0.0);
    Lanes sum = 0.0;
    for_each_going(0, chain.length, chain.length, [&] [[gnu::always_inline]] (const Going& j) {
      if (j.distance == 1) ask_from<ahead>(j, chain);
      std::array<Lanes, B> common;
      common.fill(0.0);
      const unsigned which = chain.translation_free.empty() ? 0U : chain.went_afloat[static_cast<std::size_t>(j.group)];
      if (which != 0)
        for (Index c = 0; c < std::min<Index>(B, 2); ++c)
          Afloat<B>::set(which, v[j.group * B + c], common[static_cast<std::size_t>(c)]);
      sum += InLanes::weighted(j, numbers, v, common);
    });
    double* const last = work.last.data();
    for (Index k = 0; k < B; ++k)
      for (int lane = 0; lane <= lanes; ++lane) last[lane * B + k] = lane < lanes ? v[k][lane] : 0.0;
    return sum[0] + sum[1] + sum[2] + sum[3] + weighted_last(chain.last.data(), last);
  }

  static double weighted_last(const double* numbers, const double* v) {
    double sum = 0.0;
    for_each_going(0, lanes, lanes, [&](const Going& j) { sum += One::weighted(j, numbers, v, {}); });
    for (Index r = 0; r < B; ++r) {
      double u = std::abs(v[r]);
      for (Index k = r + 1; k < B; ++k) u += std::abs(numbers[packed(k, r)] * v[k]);
      sum += u * u / std::abs(numbers[packed(r, r)]);
    }
    return sum;
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
ARCWALL_IN_PLACE void with_width(Index width, const Code& code, std::integer_sequence<Index, widths...>) {
  ((width == widths ? code(WholeChain<widths>{}) : void()), ...);
}

// The code of all widths in one function, so that it can be made for more than one processor.
ARCWALL_IN_PLACE void eliminate_any(ChainNumbers& chain, Index begin, Index end, ChainPivots& seen) {
  with_width(
      chain.width, [&] [[gnu::always_inline]] (auto whole) { whole.eliminate(chain, begin, end, seen); }, Widths{});
}
ARCWALL_IN_PLACE void forward_any(const ChainNumbers& chain, Index columns, Index begin, Index end, ChainWork& work) {
  const auto code = [&] [[gnu::always_inline]] (auto whole) {
    if (columns == 1) whole.template forward<1>(chain, begin, end, work);
    if (columns == 2) whole.template forward<2>(chain, begin, end, work);
  };
  with_width(chain.width, code, Widths{});
}
ARCWALL_IN_PLACE void backward_any(const ChainNumbers& chain, Index columns, Index begin, Index end, ChainWork& work) {
  const auto code = [&] [[gnu::always_inline]] (auto whole) {
    if (columns == 1) whole.template backward<1>(chain, begin, end, work);
    if (columns == 2) whole.template backward<2>(chain, begin, end, work);
  };
  with_width(chain.width, code, Widths{});
}
ARCWALL_IN_PLACE double weighted_any(const ChainNumbers& chain, ChainWork& work) {
  double sum = 0.0;
  with_width(
      chain.width, [&] [[gnu::always_inline]] (auto whole) { sum = whole.weighted(chain, work); }, Widths{});
  return sum;
}

// One vector of four where the processor has them. Factors are the same numbers everywhere, and a pivot that vanishes
// exactly does so: k − (k/k) k would not by fused operations. Solutions have these, too.
#ifdef __x86_64__
[[gnu::target("avx")]] void eliminate_wide(ChainNumbers& chain, Index begin, Index end, ChainPivots& seen) {
  eliminate_any(chain, begin, end, seen);
}
[[gnu::target("avx,fma")]] void forward_wide(const ChainNumbers& chain, Index columns, Index begin, Index end,
                                             ChainWork& work) {
  forward_any(chain, columns, begin, end, work);
}
[[gnu::target("avx,fma")]] void backward_wide(const ChainNumbers& chain, Index columns, Index begin, Index end,
                                              ChainWork& work) {
  backward_any(chain, columns, begin, end, work);
}
[[gnu::target("avx,fma")]] double weighted_wide(const ChainNumbers& chain, ChainWork& work) {
  return weighted_any(chain, work);
}
bool has_fused_operations() { return has_wide_registers() && __builtin_cpu_supports("fma") != 0; }
#endif

}  // namespace

ChainNumbers::ChainNumbers(Index of_width, Index groups) : width(of_width), length((groups + lanes - 1) / lanes) {
  numbers.assign(static_cast<std::size_t>((length + 1) * per_group()), Lanes(0.0));
  last.assign(static_cast<std::size_t>((lanes + 1) * per_group()), 0.0);
}

Index elimination_width(Index greatest) { return next_width(greatest, Widths{}); }

void eliminate_groups(ChainNumbers& chain, Index begin, Index end, ChainPivots& seen) {
#ifdef __x86_64__
  if (has_wide_registers()) return eliminate_wide(chain, begin, end, seen);
#endif
  eliminate_any(chain, begin, end, seen);
}

void forward_groups(const ChainNumbers& chain, Index columns, Index begin, Index end, ChainWork& work) {
#ifdef __x86_64__
  if (has_fused_operations()) return forward_wide(chain, columns, begin, end, work);
#endif
  forward_any(chain, columns, begin, end, work);
}

void backward_groups(const ChainNumbers& chain, Index columns, Index begin, Index end, ChainWork& work) {
#ifdef __x86_64__
  if (has_fused_operations()) return backward_wide(chain, columns, begin, end, work);
#endif
  backward_any(chain, columns, begin, end, work);
}

double weighted_by_chain(const ChainNumbers& chain, ChainWork& work) {
#ifdef __x86_64__
  if (has_fused_operations()) return weighted_wide(chain, work);
#endif
  return weighted_any(chain, work);
}

}  // namespace arcwall
