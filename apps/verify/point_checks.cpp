#include "apps/verify/point_checks.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "apps/verify/entries.hpp"
#include "apps/verify/spline_pulls.hpp"
#include "core/text.hpp"

namespace arcwall::verify {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Distance that the corrector may leave, in the path metric: its tolerance is 10⁻¹², of an estimate.
constexpr double distance_left = 4e-12;

std::string named(const ContactLabel& label) {
  return label.wall + " at " + label.member + ":" + round_trip(label.fraction);
}

void add_to(Vector& sum, const std::vector<Index>& unknowns, const Vector& part) {
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i] >= 0) sum[unknowns[i]] += part[static_cast<Index>(i)];
}

// What the wall exerts: p, less the spring of the augmented Lagrangian.
double wall_force(const Touch& touch) { return touch.force - touch.stiffness * touch.gap.value(); }

// What unknowns are off by in the digits that they are stored with.
Vector roundoff(const PointAtHand& at) {
  return 16.0 * epsilon * at.point.state.x.head(structure_unknowns(at.model, at.point.state)).cwiseAbs();
}

// Where a position, an angle or a change of thickness may still move: the metric's mean over the nodes.
Vector uncertainty(const PointAtHand& at) {
  const State& state = at.point.state;
  Vector off = roundoff(at);
  const Vector weights = at.model.system().weights(state.active_set).head(off.size());
  for (Index i = 0; i < off.size(); ++i)
    if (weights[i] > 0.0) off[i] += distance_left / std::sqrt(weights[i]);
  return off;
}

double smallest_force(const PointAtHand& at) { return 1e-11 * at.scales.force; }

}  // namespace

bool is_well_formed(const Model& model, const State& state) {
  return model.system().size(state.active_set) == state.x.size() && state.x.allFinite() && std::isfinite(state.lambda);
}

PointAtHand at_hand(const Model& model, const RecordPoint& point, const std::vector<PlainWall>& walls,
                    const Scales& scales) {
  PointAtHand at{.model = model, .point = point, .scales = scales};
  at.walls = walls_at(walls, point.state.lambda);
  at.touches = touches(model, at.walls, point.state);
  at.potentials = potentials(model, point.state);
  for (const Potential& potential : at.potentials) at.stiffness.push_back(stiffness(potential));
  return at;
}

void check_contacts(const PointAtHand& at, Findings& findings, bool waits) {
  constexpr double entered_in_change = 1e-6;  // of the length
  const double length = 1e-10 * at.scales.length, force = smallest_force(at);
  for (const Touch& touch : at.touches.all) {
    const double gap = touch.gap.value();
    if (touch.closed) {
      if (touch.listed) findings.compare("contact forces push", -touch.force, force, named(touch.label));
      findings.compare("closed contacts touch", std::abs(gap + touch.compliance * (touch.force - touch.against)),
                       length, named(touch.label));
    } else if (std::isfinite(gap)) {
      findings.compare("open contacts are outside", -gap, length, named(touch.label));
    }
  }
  if (at.model.sliding() == nullptr || at.walls.empty()) return;
  const Entry entry = deepest_entry(at.model, at.walls, at.point.state, 2e-9 * at.scales.length);
  if (std::isfinite(entry.depth))
    findings.compare("no wall is entered between nodes", entry.depth,
                     entry.allowed + (waits ? entered_in_change * at.scales.length : 0.0), entry.where);
  if (!waits)
    for (const SplinePull& pull : spline_pulls(at.model, at.walls, at.point.state))
      findings.compare("no part lies across where its wall would pull", pull.pull, pull.held, named(pull.label));
  for (const Tangency& tangency : at.touches.tangencies) {
    findings.compare("contacts that slide are tangent", std::abs(tangency.tilt.value()), 1e-9, named(tangency.label));
    if (!tangency.end_of_pressed)
      findings.compare("no moment holds a contact", std::abs(tangency.moment), force * at.scales.length,
                       named(tangency.label));
  }
  for (const Pinched& pinched : at.touches.pinched)
    findings.compare("closed contacts touch", std::abs(pinched.along.value()), length, named(pinched.label));
}

namespace {

// Out-of-balance forces, what of them may be, and what of that the last digits of the unknowns make.
struct Balance {
  Vector F{}, allowed{}, rounded{};

  double share(Index i) const { return std::abs(F[i]) / allowed[i]; }
};

// Forces by differences of energies; what may be left is the stiffness times what the unknowns may be off by, and what
// differences are off by.
Balance balance(const PointAtHand& at) {
  constexpr double differences = 1e-10;  // of the sum of the parts; 1e-12 to 1e-11 measured
  Balance sum{.F = -point_loads(at.model, at.point.state)};
  Vector parts = sum.F.cwiseAbs();
  sum.allowed = Vector::Constant(parts.size(), 1e-300);
  sum.rounded = Vector::Zero(parts.size());
  const Vector off = uncertainty(at), digits = roundoff(at);
  const auto add = [&](const std::vector<Index>& unknowns, const Vector& part) {
    add_to(sum.F, unknowns, part);
    add_to(parts, unknowns, part.cwiseAbs());
  };
  for (std::size_t e = 0; e < at.potentials.size(); ++e) {
    const Potential& potential = at.potentials[e];
    add(potential.unknowns, forces(potential));
    const auto of_stiffness = [&](const Vector& by) {
      Vector here = Vector::Zero(potential.at.size());
      for (std::size_t i = 0; i < potential.unknowns.size(); ++i)
        if (potential.unknowns[i] >= 0) here[static_cast<Index>(i)] = by[potential.unknowns[i]];
      return Vector(at.stiffness[e].cwiseAbs() * here);
    };
    add_to(sum.allowed, potential.unknowns, of_stiffness(off));
    add_to(sum.rounded, potential.unknowns, of_stiffness(digits));
  }
  for (const Touch& touch : at.touches.all)
    if (touch.closed) add(touch.gap.unknowns, -wall_force(touch) * touch.gap.gradient());
  for (const Tangency& tangency : at.touches.tangencies)
    add(tangency.tilt.unknowns, -tangency.moment * tangency.tilt.gradient());
  for (const Pinched& pinched : at.touches.pinched)
    add(pinched.along.unknowns, -pinched.force * pinched.along.gradient());
  sum.allowed += differences * parts;
  return sum;
}

// By how much a node inside a part may pull where the pressure between it and its neighbours comes to zero: that of a
// parabola over less than an element, which the mesh does not tell. A node that pulls by itself does so by more.
double pull_between_nodes(const std::vector<Touch>& touches, std::size_t node) {
  constexpr double of_bend = 0.2;
  const Touch& touch = touches[node];
  const auto is_beside = [&](const Touch& other) {
    return other.closed && !other.listed && other.label.wall == touch.label.wall &&
           other.label.member == touch.label.member;
  };
  if (node == 0 || node + 1 == touches.size() || !is_beside(touches[node - 1]) || !is_beside(touches[node + 1]))
    return 0.0;
  return of_bend * std::abs(touches[node - 1].force - 2.0 * touch.force + touches[node + 1].force);
}

// What is out of balance along the wall's normal where a contact is: its force is wrong by that.
void check_contact_forces(const PointAtHand& at, const Balance& balance, Findings& findings) {
  for (std::size_t number = 0; number < at.touches.all.size(); ++number) {
    const Touch& touch = at.touches.all[number];
    if (!touch.closed) continue;
    const Vector normal = touch.gap.gradient();
    double left = 0.0, square = 0.0, bound = 0.0, rounded = 0.0;
    for (Index i = 0; i < 2; ++i)
      if (const Index unknown = touch.gap.unknowns[static_cast<std::size_t>(i)]; unknown >= 0) {
        left += normal[i] * balance.F[unknown];
        bound += std::abs(normal[i]) * balance.allowed[unknown];
        rounded += std::abs(normal[i]) * balance.rounded[unknown];
        square += normal[i] * normal[i];
      }
    if (square == 0.0) continue;
    findings.compare("contact forces balance", std::abs(left) / square, bound / square, named(touch.label));
    // Nodes inside a part are held by differences of what its elements bend; where nothing else presses it, by nothing.
    if (!touch.listed)
      findings.compare("contact forces push", -touch.force,
                       1e4 * smallest_force(at) + rounded / square + pull_between_nodes(at.touches.all, number),
                       named(touch.label));
  }
}

}  // namespace

// A contact is to blame where all else is in balance.
void check_equilibrium(const PointAtHand& at, Findings& findings) {
  const Balance found = balance(at);
  std::vector<std::uint8_t> at_contact(static_cast<std::size_t>(found.F.size()), 0);
  for (const Touch& touch : at.touches.all)
    for (const Index unknown : touch.gap.unknowns)
      if (touch.closed && unknown >= 0) at_contact[static_cast<std::size_t>(unknown)] = 1;
  const auto check = [&](bool contacts) {
    for (Index i = 0; i < found.F.size(); ++i)
      if ((at_contact[static_cast<std::size_t>(i)] != 0) == contacts)
        findings.compare("forces balance at nodes", std::abs(found.F[i]), found.allowed[i],
                         found.share(i) > 1.0 ? name_of_unknown(at.model, at.point.state, i) : "");
  };
  check(false);
  check_contact_forces(at, found, findings);
  check(true);
}

Energy energy(const PointAtHand& at) {
  Energy sum;
  const auto add = [&](double part) {
    sum.value += part;
    sum.magnitude += std::abs(part);
  };
  for (const Potential& potential : at.potentials) add(potential.energy(potential.at));
  add(-work_of_point_loads(at.model, at.point.state));
  for (const Touch& touch : at.touches.all) add(0.5 * touch.compliance * touch.force * touch.force);
  return sum;
}

namespace {

// Columns that are orthogonal to all rows of G.
Matrix null_space(const Matrix& G, Index n) {
  if (G.rows() == 0) return Matrix::Identity(n, n);
  const Eigen::ColPivHouseholderQR<Matrix> factors(G.transpose());
  const Matrix Q = factors.householderQ();
  return Q.rightCols(n - factors.rank());
}

struct Eigencount {
  Index negative = 0, zero = 0;
};

Eigencount eigencount(const Matrix& K, const Matrix& G, const ZeroEigenvalue& zero) {
  const Matrix Z = null_space(G, K.rows());
  if (Z.cols() == 0) return {};
  const Vector values =
      Eigen::SelfAdjointEigenSolver<Matrix>(Z.transpose() * K * Z, Eigen::EigenvaluesOnly).eigenvalues();
  std::vector<double> sizes(values.begin(), values.end());
  for (double& size : sizes) size = std::abs(size);
  std::sort(sizes.begin(), sizes.end());
  const double most = std::max(zero.least, sizes.size() > 1 ? zero.of_next * sizes[1] : 0.0);
  return {.negative = (values.array() < -most).count(), .zero = (values.array().abs() <= most).count()};
}

void add_block(Matrix& K, const std::vector<Index>& unknowns, const Matrix& block) {
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    for (std::size_t j = 0; j < unknowns.size(); ++j)
      if (unknowns[i] >= 0 && unknowns[j] >= 0)
        K(unknowns[i], unknowns[j]) += block(static_cast<Index>(i), static_cast<Index>(j));
}

void add_row(Matrix& G, const std::vector<Index>& unknowns, const Vector& gradient) {
  G.conservativeResize(G.rows() + 1, Eigen::NoChange);
  G.row(G.rows() - 1).setZero();
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i] >= 0) G(G.rows() - 1, unknowns[i]) = gradient[static_cast<Index>(i)];
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
void add_moved_supports(const PointAtHand& at, Matrix& K) {
  const Index last = K.rows() - 1;
  for (const Potential& potential : at.potentials) {
    const Vector change = gradient_rate(potential);
    if (change.size() == 0) continue;
    for (std::size_t i = 0; i < potential.unknowns.size(); ++i)
      if (const Index unknown = potential.unknowns[i]; unknown >= 0) {
        K(unknown, last) += change[static_cast<Index>(i)];
        K(last, unknown) += change[static_cast<Index>(i)];
      }
    K(last, last) += potential.rates.dot(change);
  }
}

// The material coordinates at pinches as the last unknowns of K.
void add_slides(const PointAtHand& at, Matrix& K) {
  const std::vector<Pinched>& pinched = at.touches.pinched;
  const auto slides = static_cast<Index>(pinched.size()), n = K.rows() - slides;
  const auto step = [&](Index i) { return pinched[static_cast<std::size_t>(i)].step; };
  const auto moved = [&](Index i, double by_i, Index j, double by_j) {
    State state = at.point.state;
    state.x[pinched[static_cast<std::size_t>(i)].coordinate] += by_i;
    state.x[pinched[static_cast<std::size_t>(j)].coordinate] += by_j;
    return potentials(at.model, state);
  };
  const auto energy = [&](Index i, double by_i, Index j, double by_j) {
    double sum = 0.0;
    for (const Potential& potential : moved(i, by_i, j, by_j)) sum += potential.energy(potential.at);
    return sum;
  };
  const auto forces_at = [&](Index i, double by) {
    Vector sum = Vector::Zero(n);
    for (const Potential& potential : moved(i, by, i, 0.0))
      add_to(sum, potential.unknowns, potential.gradient(potential.at));
    return sum;
  };
  for (Index i = 0; i < slides; ++i) {
    const double h = step(i);
    K.col(n + i).head(n) = (forces_at(i, h) - forces_at(i, -h)) / (2.0 * h);
    K.row(n + i).head(n) = K.col(n + i).head(n).transpose();
    for (Index j = 0; j < slides; ++j) {
      const double k = step(j);
      K(n + i, n + j) =
          (energy(i, h, j, k) - energy(i, h, j, -k) - energy(i, -h, j, k) + energy(i, -h, j, -k)) / (4.0 * h * k);
    }
  }
}

enum class Supports { held, dead };  // those that λ moves, or their forces in their place

// K of the elements, less p ∂²g of the contacts, plus their springs; on the motions that leave closed contacts closed.
// What walls touch from opposite sides cannot move across them, with or without a force.
// Lengths and angles are made comparable: D K D has a unit diagonal.
CountRange range_of_counts(const PointAtHand& at, const ZeroEigenvalue& zero, Supports supports) {
  const auto slides = static_cast<Index>(at.touches.pinched.size());
  const Index n = structure_unknowns(at.model, at.point.state) + (supports == Supports::dead ? 1 : 0) + slides;
  Matrix K = Matrix::Zero(n, n), idle_springs = Matrix::Zero(n, n), strong(0, n), all(0, n);
  for (std::size_t e = 0; e < at.potentials.size(); ++e) add_block(K, at.potentials[e].unknowns, at.stiffness[e]);
  if (supports == Supports::dead) add_moved_supports(at, K);
  if (slides > 0) add_slides(at, K);
  for (const Touch& touch : at.touches.all) {
    if (!touch.closed && !touch.two_sided) continue;
    const Vector gradient = touch.gap.gradient();
    const bool carries = touch.force > 1e-11 * at.scales.force || touch.two_sided;
    const double part = touch.two_sided ? 0.5 : 1.0;  // of the one spring that two walls without clearance are
    add_block(K, touch.gap.unknowns,
              touch.stiffness * gradient * gradient.transpose() - wall_force(touch) * touch.gap.hessian());
    if (touch.compliance > 0.0) {
      add_block(carries ? K : idle_springs, touch.gap.unknowns,
                part * gradient * gradient.transpose() / touch.compliance);
    } else {
      add_row(all, touch.gap.unknowns, gradient);
      if (carries || !touch.listed) add_row(strong, touch.gap.unknowns, gradient);
    }
  }
  for (const Tangency& tangency : at.touches.tangencies) {
    const Vector gradient = tangency.tilt.gradient();
    if (tangency.unresolved) {
      add_row(all, tangency.tilt.unknowns, gradient);  // between held and free
    } else if (tangency.spring) {
      add_block(K, tangency.tilt.unknowns, *tangency.spring * gradient * gradient.transpose());
    } else {
      add_row(all, tangency.tilt.unknowns, gradient);
      add_row(strong, tangency.tilt.unknowns, gradient);
    }
  }
  for (const Pinched& pinched : at.touches.pinched)
    for (Matrix* held : {&all, &strong}) add_row(*held, pinched.along.unknowns, pinched.along.gradient());
  Vector least = Vector::Constant(n, 1e-300);
  for (std::size_t e = 0; zero.of_parts > 0.0 && e < at.potentials.size(); ++e)
    for (const Index unknown : at.potentials[e].unknowns)
      if (unknown >= 0) least[unknown] += zero.of_parts * at.stiffness[e].cwiseAbs().maxCoeff();
  const Vector scale = (K + idle_springs).diagonal().cwiseAbs().cwiseMax(least).cwiseSqrt().cwiseInverse();
  const auto scaled = [&](const Matrix& stiffness) {
    return Matrix(scale.asDiagonal() * stiffness * scale.asDiagonal());
  };
  const Eigencount held = eigencount(scaled(K + idle_springs), all * scale.asDiagonal(), zero);
  const bool all_carry = all.rows() == strong.rows() && idle_springs.isZero(0.0);
  const Eigencount free = all_carry ? held : eigencount(scaled(K), strong * scale.asDiagonal(), zero);
  return {.least = held.negative, .most = free.negative + free.zero};
}

}  // namespace

CountRange unstable_range(const PointAtHand& at, const ZeroEigenvalue& zero) {
  return range_of_counts(at, zero, Supports::held);
}

std::optional<CountRange> unstable_load_control_range(const PointAtHand& at, const ZeroEigenvalue& zero) {
  const auto is_held = [](const Touch& touch) {
    const auto& unknowns = touch.gap.unknowns;
    return touch.closed && std::find(unknowns.begin(), unknowns.end(), -1) != unknowns.end();
  };
  if (!is_driven_by_supports_alone(at.model) || std::any_of(at.touches.all.begin(), at.touches.all.end(), is_held))
    return std::nullopt;
  return range_of_counts(at, zero, Supports::dead);
}

}  // namespace arcwall::verify
