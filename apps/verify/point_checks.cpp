#include "apps/verify/point_checks.hpp"

#include <fmt/format.h>

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

// What unknowns are off by in the digits that they are stored with.
Vector roundoff(const PointAtHand& at) {
  return 16.0 * epsilon * at.point.state.x.head(structure_unknowns(at.model, at.point.state)).cwiseAbs();
}

double smallest_force(const PointAtHand& at) { return 1e-11 * at.scales.force; }

}  // namespace

// A position, an angle or a change of thickness may still move: the metric's mean over the nodes.
Vector uncertainty(const PointAtHand& at) {
  const State& state = at.point.state;
  Vector off = roundoff(at);
  const Vector weights = at.model.system().weights(state.active_set).head(off.size());
  for (Index i = 0; i < off.size(); ++i)
    if (weights[i] > 0.0) off[i] += distance_left / std::sqrt(weights[i]);
  return off;
}

Vector made_by(const Potential& potential, const Vector& off) {
  const std::vector<Index>& unknowns = potential.unknowns;
  Vector here = Vector::Zero(static_cast<Index>(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i] >= 0) here[static_cast<Index>(i)] = off[unknowns[i]];
  return potential.stiffness.cwiseAbs() * here;
}

bool is_well_formed(const Model& model, const State& state) {
  return model.system().size(state.active_set) == state.x.size() && state.x.allFinite() && std::isfinite(state.lambda);
}

PointAtHand at_hand(const Model& model, const PlainMembers& members, const RecordPoint& point,
                    const std::vector<PlainWall>& walls, const Scales& scales) {
  PointAtHand at{.model = model, .members = members, .point = point, .scales = scales};
  at.walls = walls_at(walls, point.state.lambda);
  at.touches = touches(model, at.walls, point.state);
  at.potentials = potentials(model, members, point.state);
  return at;
}

namespace {

// |T| ≤ μ p, and |T| = μ p of what slips.
void check_friction(const Touch& touch, double force, Findings& findings) {
  constexpr double law = 1e-9;  // of μ p
  const double most = touch.friction->coefficient * std::max(touch.force, 0.0);
  const double off = std::abs(touch.friction->force) - most;
  findings.compare("friction is at most μ p", touch.friction->slips ? std::abs(off) : off, law * most + force,
                   named(touch.label));
}

}  // namespace

void check_contacts(const PointAtHand& at, Findings& findings, bool waits) {
  constexpr double entered_in_change = 1e-6;  // of the length
  const double length = gap_left * at.scales.length, force = smallest_force(at);
  for (const Touch& touch : at.touches.all) {
    const double gap = touch.gap.value();
    if (touch.closed) {
      if (touch.listed) findings.compare("contact forces push", -touch.force, force, named(touch.label));
      if (touch.friction) check_friction(touch, force, findings);
      findings.compare("closed contacts have zero gap",
                       std::abs(gap + touch.compliance * (touch.force - touch.against)), length, named(touch.label));
    } else if (std::isfinite(gap)) {
      findings.compare("open contacts have no negative gap", -gap, length, named(touch.label));
    }
  }
  if (at.model.sliding() == nullptr || at.walls.empty()) return;
  const Entry entry = deepest_entry(at.model, at.walls, at.point.state, 2e-9 * at.scales.length);
  if (std::isfinite(entry.depth))
    findings.compare("no wall is entered between nodes", entry.depth,
                     entry.allowed + (waits ? entered_in_change * at.scales.length : 0.0), entry.where);
  if (!waits)
    for (const SplinePull& pull : spline_pulls(at.model, at.walls, at.point.state))
      findings.compare("zones do not pull at spline knots", pull.pull, pull.held, named(pull.label));
  for (const Tangency& tangency : at.touches.tangencies) {
    findings.compare("moving contacts are tangent", std::abs(tangency.tilt.value()), 1e-9, named(tangency.label));
    if (!tangency.end_of_pressed)
      findings.compare("tangency multiplier is zero", std::abs(tangency.moment), force * at.scales.length,
                       named(tangency.label));
  }
  for (const Pinched& pinched : at.touches.pinched)
    findings.compare("closed contacts have zero gap", std::abs(pinched.along.value()), length, named(pinched.label));
}

namespace {

// Out-of-balance forces, what of them may be, and what of that the last digits of the unknowns make.
struct Balance {
  Vector F{}, allowed{}, rounded{};

  double share(Index i) const { return std::abs(F[i]) / allowed[i]; }
};

// Forces by the derivatives of energies; what may be left is the stiffness times what the unknowns may be off by, and
// what differences of gaps are off by.
Balance balance(const PointAtHand& at) {
  constexpr double differences = 1e-10;  // of the sum of the parts
  Balance sum{.F = -point_loads(at.model, at.point.state)};
  Vector parts = sum.F.cwiseAbs();
  sum.allowed = Vector::Constant(parts.size(), 1e-300);
  sum.rounded = Vector::Zero(parts.size());
  const Vector off = uncertainty(at), digits = roundoff(at);
  const auto add = [&](const std::vector<Index>& unknowns, const Vector& part) {
    add_to(sum.F, unknowns, part);
    add_to(parts, unknowns, part.cwiseAbs());
  };
  for (const Potential& potential : at.potentials) {
    add(potential.unknowns, potential.gradient);
    add_to(sum.allowed, potential.unknowns, made_by(potential, off));
    add_to(sum.rounded, potential.unknowns, made_by(potential, digits));
  }
  for (const Touch& touch : at.touches.all)
    if (touch.closed) {
      add(touch.gap.unknowns, -wall_force(touch) * touch.gap.gradient());
      if (touch.friction) add(touch.gap.unknowns, -touch.friction->force * touch.friction->along.gradient());
    }
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
  const bool slides = at.model.sliding() != nullptr;
  const std::vector<double> ringing = slides ? knot_ringing(at.model, at.walls, at.point.state) : std::vector<double>();
  auto of_node = ringing.begin();
  for (std::size_t number = 0; number < at.touches.all.size(); ++number) {
    const Touch& touch = at.touches.all[number];
    const double rings = touch.listed ? 0.0 : *of_node++;
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
                       1e4 * smallest_force(at) + rounded / square + pull_between_nodes(at.touches.all, number) + rings,
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

namespace {

// What energies of laws are differences of.
double energy_of_laws(const Model& model) {
  double sum = 0.0;
  for (const deck::Spring& spring : model.deck().springs)
    std::visit(
        [&](const auto& kind) {
          if (!kind.law) return;
          double along = 1.0;
          if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, deck::Foundation>)
            for (const MemberMesh& mesh : model.structure().members())
              if (mesh.name == kind.member) along = mesh.length;
          sum += along * greatest_energy(*kind.law);
        },
        spring.kind);
  return sum;
}

}  // namespace

namespace {

// Of a displacement of the structure's size and of a rotation of 1: what is left of them where a load is taken off.
Vector last_digits(const PointAtHand& at) {
  const Vector weights = at.model.system().weights(at.point.state.active_set);
  Vector digits = Vector::Zero(structure_unknowns(at.model, at.point.state));
  const double nodes = double(digits.size()) / 3.0;
  for (Index i = 0; i < digits.size(); ++i)
    if (weights[i] > 0.0) digits[i] = 16.0 * epsilon / std::sqrt(nodes * weights[i]);
  return digits;
}

}  // namespace

Energy energy(const PointAtHand& at) {
  Energy sum{.magnitude = energy_of_laws(at.model)};
  const auto add = [&](double part) {
    sum.value += part;
    sum.magnitude += std::abs(part);
  };
  const Vector digits = last_digits(at);
  for (const Potential& potential : at.potentials) {
    add(potential.energy);
    const Vector by_digits = potential.gradient.cwiseAbs() + made_by(potential, digits);
    for (std::size_t i = 0; i < potential.unknowns.size(); ++i)
      if (const Index unknown = potential.unknowns[i]; unknown >= 0)
        sum.rounded += by_digits[static_cast<Index>(i)] * digits[unknown];
  }
  add(-work_of_point_loads(at.model, at.point.state));
  for (const Touch& touch : at.touches.all) add(0.5 * touch.compliance * touch.force * touch.force);
  return sum;
}

}  // namespace arcwall::verify
