#include "core/chain_elimination.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
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

constexpr int lanes = Lanes::count;
constexpr unsigned all_lanes = (1U << lanes) - 1U;

// A group that goes, at a distance from its two neighbours; those at and beyond `length` are the one group there.
struct Going {
  Index group, distance, length;

  Index before() const { return group - distance; }
  Index behind() const { return std::min(group + distance, length); }
  bool is_last() const { return group + distance >= length; }
  // Whether the group before it goes before the one behind: their coupling belongs to that one.
  bool before_goes_first() const { return is_last() || (before() / (2 * distance)) % 2 == 1; }
};

// The last group of a stretch that goes at a distance, where it has nothing but the end behind it and nothing that goes
// there makes it wait; empty if there is none.
ARCWALL_IN_PLACE std::optional<Going> at_end(int round, Index length) {
  const Index distance = Index{1} << round, rank = (length - 1) / distance;
  const Index group = (rank - (rank % 2 == 0)) * distance;
  if (group <= 0 || group + distance <= length) return std::nullopt;
  return Going{group, distance, length};
}

// What can go when an odd group has gone: itself at a distance of 1, then groups at greater distances.
inline int last_round(Index odd) { return std::countr_one(static_cast<std::uint64_t>(odd) >> 1U); }
ARCWALL_IN_PLACE Going after(Index odd, int round, Index length) {
  return {odd + 1 - (Index{1} << round), Index{1} << round, length};
}
inline int rounds_of(Index length) { return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(length - 1))); }

// The groups of a part [begin, end) of a chain that can go, each as soon as it can. `visit` is called at one place, as
// it is long and becomes part of this.
template <class Visit>
ARCWALL_IN_PLACE void for_each_going(Index begin, Index end, Index length, const Visit& visit) {
  for (Index odd = begin + 1; odd < end || end == length; odd += 2) {
    const bool closes = odd >= end;
    const int last = closes ? rounds_of(length) - 1 : last_round(odd);
    for (int round = closes ? 1 : 0; round <= last; ++round)
      if (const std::optional<Going> j = closes ? at_end(round, length) : after(odd, round, length)) visit(*j);
    if (closes) return;
  }
}

// The same groups, the last one that went first.
template <class Visit>
ARCWALL_IN_PLACE void for_each_gone(Index begin, Index end, Index length, const Visit& visit) {
  const Index last_odd = end - 1 - end % 2;
  for (Index odd = end == length ? last_odd + 2 : last_odd; odd > begin; odd -= 2) {
    const bool closes = odd > last_odd;
    for (int round = closes ? rounds_of(length) - 1 : last_round(odd); round >= (closes ? 1 : 0); --round)
      if (const std::optional<Going> j = closes ? at_end(round, length) : after(odd, round, length)) visit(*j);
  }
}

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

[[gnu::noinline]] void set_some(unsigned which, const Lanes& value, Lanes& to) {
  for (int lane = 0; lane < lanes; ++lane)
    if ((which >> static_cast<unsigned>(lane)) & 1U) to.set(lane, value[lane]);
}

// Equation (3) where elements are afloat, in some lanes. Each of the two elements at a group has its part of D T: first
// all that lies before the group is reduced, while D T has the part before alone; then what lies behind, while that
// part is kept where the group's coupling with what is behind will stand at last. The first groups of the stretches
// have no part before: it is that of the end of the stretch before.
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

// A chain of a width with all that is worked on: in lanes, and at last the groups that these leave.
template <Index B>
struct WholeChain {
  using InLanes = Chain<B, Lanes>;
  using One = Chain<B, double>;

  // Numbers of two groups that a solution comes to soon: processors do not foresee its order.
  static constexpr Index ahead = 8;
  template <Index distance>
  ARCWALL_IN_PLACE static void expect(const Going& j, const ChainNumbers& chain) {
    constexpr Index per_line = 2;
    const Index group = std::clamp<Index>(j.group + distance, 0, chain.length - 1);
    const Lanes* const from = chain.numbers.data() + group * InLanes::per_group;
    ARCWALL_EACH (line, 0, InLanes::per_group * 2 / per_line) __builtin_prefetch(from + line * per_line);
  }

  ARCWALL_IN_PLACE static void eliminate(ChainNumbers& chain, Index begin, Index end, ChainPivots& pivots) {
    Lanes* const numbers = chain.numbers.data();
    Seen<Lanes> seen;
    if (begin == 0) std::fill_n(chain.group(chain.length), InLanes::triangle, Lanes(0.0));
    if (chain.afloat.empty()) {
      for_each_going(begin, end, chain.length,
                     [&] [[gnu::always_inline]] (const Going& j) { InLanes::eliminate(j, numbers, seen); });
    } else {
      if (begin == 0) chain.afloat_now = chain.afloat;
      const Afloat<B> afloat{chain};
      if (end == chain.length) afloat.begin_at_end();
      for_each_going(begin, end, chain.length, [&] [[gnu::always_inline]] (const Going& j) {
        const auto part = afloat.before_going(j);
        InLanes::eliminate(j, numbers, seen);
        afloat.when_gone(j, part);
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
      if (j.distance == 1) expect<ahead>(j, chain);
      InLanes::template forward<R>(j, numbers, x);
    });
    if (end == chain.length) solve_last<R>(chain, x, behind, work.last.data());
  }

  template <Index R>
  ARCWALL_IN_PLACE static void backward(const ChainNumbers& chain, Index begin, Index end, ChainWork& work) {
    for_each_gone(begin, end, chain.length, [&] [[gnu::always_inline]] (const Going& j) {
      if (j.distance == 1) expect<-ahead>(j, chain);
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
      if (j.distance == 1) expect<ahead>(j, chain);
      std::array<Lanes, B> common;
      common.fill(0.0);
      const unsigned which = chain.afloat.empty() ? 0U : chain.went_afloat[static_cast<std::size_t>(j.group)];
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
