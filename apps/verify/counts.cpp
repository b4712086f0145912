#include "apps/verify/counts.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

namespace arcwall::verify {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// A condition that motions fulfil: the gradient of a gap, or of a tilt.
struct Held {
  std::vector<Index> unknowns{};
  Vector gradient{};
};

// K of the elements, less p ∂²g of the contacts, plus their springs; and which motions leave closed contacts closed.
struct SecondVariation {
  Index unknowns = 0;
  Triplets K{}, idle_springs{};       // of contacts without a force
  std::vector<Held> all{}, strong{};  // of the closed contacts, and of those that carry something

  SparseMatrix matrix(bool with_idle) const {
    SparseMatrix sum(unknowns, unknowns);
    Triplets entries = K;
    if (with_idle) entries.insert(entries.end(), idle_springs.begin(), idle_springs.end());
    sum.setFromTriplets(entries.begin(), entries.end());
    return sum;
  }
};

// Columns that are orthogonal to all rows of G.
Matrix null_space(const Matrix& G) {
  const Eigen::ColPivHouseholderQR<Matrix> factors(G.transpose());
  const Matrix Q = factors.householderQ();
  return Q.rightCols(G.cols() - factors.rank());
}

// The unknowns of each set of conditions that have unknowns in common, one after the other.
class Coupled {
 public:
  Coupled(const std::vector<Held>& rows, Index unknowns) : group_(static_cast<std::size_t>(unknowns)) {
    std::iota(group_.begin(), group_.end(), Index{0});
    for (const Held& row : rows)
      for (const Index unknown : row.unknowns)
        if (unknown >= 0) group_[root(unknown)] = static_cast<Index>(root(first_of(row)));
  }

  std::map<Index, std::vector<const Held*>> sets(const std::vector<Held>& rows) {
    std::map<Index, std::vector<const Held*>> sets;
    for (const Held& row : rows)
      if (first_of(row) >= 0) sets[static_cast<Index>(root(first_of(row)))].push_back(&row);
    return sets;
  }

 private:
  static Index first_of(const Held& row) {
    const auto found = std::find_if(row.unknowns.begin(), row.unknowns.end(), [](Index i) { return i >= 0; });
    return found == row.unknowns.end() ? -1 : *found;
  }
  std::size_t root(Index i) {
    auto at = static_cast<std::size_t>(i);
    while (group_[at] != static_cast<Index>(at)) at = static_cast<std::size_t>(group_[at]);
    return at;
  }

  std::vector<Index> group_;
};

// An orthonormal basis of the motions that fulfil the conditions, each of which is about the few unknowns of a node.
SparseMatrix motions_left(const std::vector<Held>& rows, const Vector& scale) {
  const Index n = scale.size();
  Triplets entries;
  Index columns = 0;
  std::vector<bool> is_held(static_cast<std::size_t>(n), false);
  Coupled coupled(rows, n);
  for (const auto& [first, set] : coupled.sets(rows)) {
    std::vector<Index> unknowns;
    for (const Held* row : set)
      for (const Index unknown : row->unknowns)
        if (unknown >= 0 && !is_held[static_cast<std::size_t>(unknown)]) {
          is_held[static_cast<std::size_t>(unknown)] = true;
          unknowns.push_back(unknown);
        }
    Matrix G = Matrix::Zero(static_cast<Index>(set.size()), static_cast<Index>(unknowns.size()));
    for (std::size_t r = 0; r < set.size(); ++r)
      for (std::size_t i = 0; i < set[r]->unknowns.size(); ++i) {
        const auto at = std::find(unknowns.begin(), unknowns.end(), set[r]->unknowns[i]);
        if (at != unknowns.end())
          G(static_cast<Index>(r), at - unknowns.begin()) += set[r]->gradient[static_cast<Index>(i)] * scale[*at];
      }
    const Matrix Z = null_space(G);
    for (Index j = 0; j < Z.cols(); ++j, ++columns)
      for (Index i = 0; i < Z.rows(); ++i)
        entries.emplace_back(unknowns[static_cast<std::size_t>(i)], columns, Z(i, j));
  }
  for (Index i = 0; i < n; ++i)
    if (!is_held[static_cast<std::size_t>(i)]) entries.emplace_back(i, columns++, 1.0);
  SparseMatrix Z(n, columns);
  Z.setFromTriplets(entries.begin(), entries.end());
  return Z;
}

struct Eigencount {
  Index negative = 0, zero = 0;
};

// Sylvester: as many negative pivots as eigenvalues. Empty where the factors are not those of a matrix that is nearer
// than the shift.
std::optional<Index> negative_pivots(const SparseMatrix& A, double shift) {
  SparseMatrix shifted = A;
  for (Index i = 0; i < A.rows(); ++i) shifted.coeffRef(i, i) += shift;
  const Eigen::SimplicialLDLT<SparseMatrix> factors(shifted);
  if (factors.info() != Eigen::Success) return std::nullopt;
  Vector ones(A.rows());
  for (Index i = 0; i < ones.size(); ++i) ones[i] = i % 2 == 0 ? 1.0 : -0.7;
  const Vector x = factors.solve(ones);
  if (!((shifted * x - ones).norm() <= std::abs(shift) * x.norm() + 1e-12 * ones.norm())) return std::nullopt;
  return (factors.vectorD().array() < 0.0).count();
}

std::optional<Eigencount> count_by_factors(const SparseMatrix& A, double least) {
  const auto below = negative_pivots(A, least), up_to = negative_pivots(A, -least);
  if (!below || !up_to) return std::nullopt;
  return Eigencount{.negative = *below, .zero = *up_to - *below};
}

Eigencount count_by_eigenvalues(const SparseMatrix& A, const ZeroEigenvalue& zero) {
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(Matrix(A), Eigen::EigenvaluesOnly).eigenvalues();
  std::vector<double> sizes(values.begin(), values.end());
  for (double& size : sizes) size = std::abs(size);
  std::sort(sizes.begin(), sizes.end());
  const double most = std::max(zero.least, sizes.size() > 1 ? zero.of_next * sizes[1] : 0.0);
  return {.negative = (values.array() < -most).count(), .zero = (values.array().abs() <= most).count()};
}

std::optional<Eigencount> eigencount(const SparseMatrix& A, const ZeroEigenvalue& zero) {
  if (A.rows() == 0) return Eigencount{};
  if (zero.of_next == 0.0)
    if (const auto count = count_by_factors(A, zero.least)) return count;
  if (A.rows() > most_of_dense) return std::nullopt;
  return count_by_eigenvalues(A, zero);
}

void add_block(Triplets& K, const std::vector<Index>& unknowns, const Matrix& block) {
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    for (std::size_t j = 0; j < unknowns.size(); ++j)
      if (unknowns[i] >= 0 && unknowns[j] >= 0)
        K.emplace_back(unknowns[i], unknowns[j], block(static_cast<Index>(i), static_cast<Index>(j)));
}

}  // namespace

bool is_driven_by_supports_alone(const Model& model) {
  const deck::Deck& deck = model.deck();
  const auto varies = [](const deck::Load& load) { return !load.constant; };
  const auto moves = [](const deck::Wall& wall) { return wall.motion && wall.motion->progress.proportional != 0.0; };
  return model.sliding() == nullptr && std::none_of(deck.loads.begin(), deck.loads.end(), varies) &&
         std::none_of(deck.walls.begin(), deck.walls.end(), moves);
}

namespace {

// λ as the last unknown of K, which moves supports.
void add_moved_supports(const PointAtHand& at, Index last, Triplets& K) {
  for (const Potential& potential : at.potentials) {
    const Vector change = gradient_rate(potential);
    if (change.size() == 0) continue;
    for (std::size_t i = 0; i < potential.unknowns.size(); ++i)
      if (const Index unknown = potential.unknowns[i]; unknown >= 0) {
        K.emplace_back(unknown, last, change[static_cast<Index>(i)]);
        K.emplace_back(last, unknown, change[static_cast<Index>(i)]);
      }
    K.emplace_back(last, last, potential.rates.dot(change));
  }
}

// The material coordinates at pinches as the last unknowns of K.
void add_slides(const PointAtHand& at, Index n, Triplets& K) {
  const std::vector<Pinched>& pinched = at.touches.pinched;
  const auto slides = static_cast<Index>(pinched.size());
  const auto step = [&](Index i) { return pinched[static_cast<std::size_t>(i)].step; };
  const auto moved = [&](Index i, double by_i, Index j, double by_j) {
    State state = at.point.state;
    state.x[pinched[static_cast<std::size_t>(i)].coordinate] += by_i;
    state.x[pinched[static_cast<std::size_t>(j)].coordinate] += by_j;
    return potentials(at.model, at.members, state);
  };
  const auto energy = [&](Index i, double by_i, Index j, double by_j) {
    double sum = 0.0;
    for (const Potential& potential : moved(i, by_i, j, by_j)) sum += potential.energy;
    return sum;
  };
  const auto forces_at = [&](Index i, double by) {
    Vector sum = Vector::Zero(n);
    for (const Potential& potential : moved(i, by, i, 0.0))
      for (std::size_t k = 0; k < potential.unknowns.size(); ++k)
        if (potential.unknowns[k] >= 0) sum[potential.unknowns[k]] += potential.gradient[static_cast<Index>(k)];
    return sum;
  };
  for (Index i = 0; i < slides; ++i) {
    const double h = step(i);
    const Vector change = (forces_at(i, h) - forces_at(i, -h)) / (2.0 * h);
    for (Index j = 0; j < n; ++j)
      if (change[j] != 0.0) {
        K.emplace_back(j, n + i, change[j]);
        K.emplace_back(n + i, j, change[j]);
      }
    for (Index j = 0; j < slides; ++j) {
      const double k = step(j);
      K.emplace_back(
          n + i, n + j,
          (energy(i, h, j, k) - energy(i, h, j, -k) - energy(i, -h, j, k) + energy(i, -h, j, -k)) / (4.0 * h * k));
    }
  }
}

double greatest_stiffness(const PointAtHand& at) {
  double greatest = 0.0;
  for (const Potential& potential : at.potentials)
    greatest = std::max(greatest, potential.stiffness.cwiseAbs().maxCoeff());
  return greatest;
}

// A zone whose axial force is an unknown: a bar, or where it has no length its ends are at one place.
void add_straight(const Potential& potential, double greatest, SecondVariation& sum) {
  constexpr double no_length = 1e-9;  // of what gives way elsewhere
  const std::vector<Index> ends(potential.unknowns.begin(), potential.unknowns.end() - 1);
  const Vector of_length = potential.stiffness.col(6).head(6);
  const double compliance = -potential.stiffness(6, 6);
  Matrix K = potential.stiffness.topLeftCorner(6, 6);
  if (compliance * greatest > no_length) {
    K += of_length * of_length.transpose() / compliance;
  } else {
    sum.all.push_back({ends, of_length});
    sum.strong.push_back({ends, of_length});
  }
  add_block(sum.K, ends, K);
  sum.K.emplace_back(potential.unknowns.back(), potential.unknowns.back(), 1.0);
}

enum class Supports { held, dead };  // those that λ moves, or their forces in their place

// What walls touch from opposite sides cannot move across them, with or without a force.
SecondVariation second_variation(const PointAtHand& at, Supports supports) {
  const auto slides = static_cast<Index>(at.touches.pinched.size());
  const Index without = structure_unknowns(at.model, at.point.state) + (supports == Supports::dead ? 1 : 0);
  SecondVariation sum{.unknowns = without + slides};
  for (const Potential& potential : at.potentials)
    potential.unknowns.size() == 7 ? add_straight(potential, greatest_stiffness(at), sum)
                                   : add_block(sum.K, potential.unknowns, potential.stiffness);
  if (supports == Supports::dead) add_moved_supports(at, without - 1, sum.K);
  if (slides > 0) add_slides(at, without, sum.K);
  for (const Touch& touch : at.touches.all) {
    if (!touch.closed && !touch.two_sided) continue;
    const Vector gradient = touch.gap.gradient();
    const bool carries = touch.force > 1e-11 * at.scales.force || touch.two_sided;
    const double part = touch.two_sided ? 0.5 : 1.0;  // of the one spring that two walls without clearance are
    add_block(sum.K, touch.gap.unknowns,
              touch.stiffness * gradient * gradient.transpose() - wall_force(touch) * touch.gap.hessian());
    if (touch.compliance > 0.0) {
      add_block(carries ? sum.K : sum.idle_springs, touch.gap.unknowns,
                part * gradient * gradient.transpose() / touch.compliance);
    } else {
      sum.all.push_back({touch.gap.unknowns, gradient});
      if (carries || !touch.listed) sum.strong.push_back(sum.all.back());
    }
  }
  for (const Tangency& tangency : at.touches.tangencies) {
    const Vector gradient = tangency.tilt.gradient();
    if (tangency.unresolved) {
      sum.all.push_back({tangency.tilt.unknowns, gradient});  // between held and free
    } else if (tangency.spring) {
      add_block(sum.K, tangency.tilt.unknowns, *tangency.spring * gradient * gradient.transpose());
    } else {
      sum.all.push_back({tangency.tilt.unknowns, gradient});
      sum.strong.push_back(sum.all.back());
    }
  }
  for (const Pinched& pinched : at.touches.pinched)
    for (std::vector<Held>* held : {&sum.all, &sum.strong})
      held->push_back({pinched.along.unknowns, pinched.along.gradient()});
  return sum;
}

// Lengths and angles are made comparable: D K D has a unit diagonal.
Vector comparable(const PointAtHand& at, const SecondVariation& of, const ZeroEigenvalue& zero) {
  Vector least = Vector::Constant(of.unknowns, 1e-300);
  if (zero.of_parts > 0.0)
    for (const Potential& potential : at.potentials)
      for (const Index unknown : potential.unknowns)
        if (unknown >= 0) least[unknown] += zero.of_parts * potential.stiffness.cwiseAbs().maxCoeff();
  return Vector(of.matrix(true).diagonal()).cwiseAbs().cwiseMax(least).cwiseSqrt().cwiseInverse();
}

std::optional<CountRange> range_of_counts(const PointAtHand& at, const ZeroEigenvalue& zero, Supports supports) {
  const SecondVariation of = second_variation(at, supports);
  const Vector scale = comparable(at, of, zero);
  const auto count = [&](bool with_idle, const std::vector<Held>& held) {
    const SparseMatrix Z = motions_left(held, scale);
    const SparseMatrix K = scale.asDiagonal() * of.matrix(with_idle) * scale.asDiagonal();
    return eigencount(SparseMatrix(Z.transpose() * K * Z), zero);
  };
  const auto held = count(true, of.all);
  const bool all_carry = of.all.size() == of.strong.size() && of.idle_springs.empty();
  const auto free = all_carry ? held : count(false, of.strong);
  if (!held || !free) return std::nullopt;
  return CountRange{.least = held->negative, .most = free->negative + free->zero};
}

}  // namespace

namespace {

// Friction has no energy whose second variation could be counted.
bool has_friction(const PointAtHand& at) {
  return at.model.system().history() != nullptr ||
         std::any_of(at.touches.all.begin(), at.touches.all.end(),
                     [](const Touch& touch) { return touch.friction.has_value(); });
}

}  // namespace

std::optional<CountRange> unstable_range(const PointAtHand& at, const ZeroEigenvalue& zero) {
  if (has_friction(at)) return std::nullopt;
  auto range = range_of_counts(at, zero, Supports::held);
  const double sure = gap_left * at.scales.length;  // places along a wall
  const auto bends_anew = [&](const Touch& touch) {
    return touch.closed && std::any_of(at.walls.begin(), at.walls.end(), [&](const PlainWall& wall) {
             return wall.deck().name == touch.label.wall && wall.bends_anew(touch.place, sure);
           });
  };
  if (std::none_of(at.touches.all.begin(), at.touches.all.end(), bends_anew)) return range;
  for (const double along : {-sure, sure}) {
    PointAtHand beside = at;
    for (PlainWall& wall : beside.walls) wall = wall.curved_as_beside(along);
    beside.touches = touches(at.model, beside.walls, at.point.state);
    const auto other = range_of_counts(beside, zero, Supports::held);
    if (!range || !other) return std::nullopt;
    range = {.least = std::min(range->least, other->least), .most = std::max(range->most, other->most)};
  }
  return range;
}

std::optional<CountRange> unstable_load_control_range(const PointAtHand& at, const ZeroEigenvalue& zero) {
  const auto is_held = [](const Touch& touch) {
    const auto& unknowns = touch.gap.unknowns;
    return touch.closed && std::find(unknowns.begin(), unknowns.end(), -1) != unknowns.end();
  };
  if (has_friction(at) || !is_driven_by_supports_alone(at.model) ||
      std::any_of(at.touches.all.begin(), at.touches.all.end(), is_held))
    return std::nullopt;
  return range_of_counts(at, zero, Supports::dead);
}

}  // namespace arcwall::verify
