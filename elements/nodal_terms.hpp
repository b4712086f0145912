#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/linearization.hpp"
#include "core/types.hpp"
#include "elements/driven.hpp"
#include "elements/spring_law.hpp"

namespace arcwall {

/// What acts on single degrees of freedom of a structure, however it is meshed: point loads p, supports that give a
/// degree of freedom the value ū, and stiffnesses k_i to ground and k_ij between two degrees of freedom. u is the
/// displacement or rotation from the stress-free state, f(u, λ) the force of the elements on it.
///
///     F_i = f_i(u, λ) + k_i u_i + Σ_j k_ij (u_i − u_j) − p_i(λ)    of a degree of freedom that is free, an unknown of
///     the mesh u_i = ū_i(λ)                                                 of one that is held; its support exerts
///     F_i Π   = U(u, λ) + Σ ½ k_i u_i² + Σ ½ k_ij (u_i − u_j)² − Σ p_i u_i                                 over both
///
/// The mesh is known by two functions of a degree of freedom: `unknown_of` gives its unknown, −1 if it is held, and
/// `displacement_of` gives u.
class NodalTerms {
 public:
  /// Adds a force or moment on the degree of freedom.
  void add_load(Index dof, const Driven& load) { entry(loads_, dof) += load; }

  /// Lets a support give the degree of freedom this value: a displacement [length] or a rotation [rad].
  void hold(Index dof, const Driven& value) { entry(supports_, dof) = value; }

  /// Adds a spring from the degree of freedom to the ground, of stiffness k [force/length], for a rotation
  /// [force·length].
  void add_ground_stiffness(Index dof, double k) { entry(ground_, dof) += k; }

  /// Adds a spring between two degrees of freedom, likewise. The pattern of the structure must have its entry.
  void add_spring(Index first, Index second, double k) {
    springs_.push_back({.first = first, .second = second, .stiffness = k});
  }

  /// A spring whose force is not proportional to its stretch, the displacement of `second` against `first`: to the
  /// ground where there is no first. The pattern of the structure must have the entry of two.
  struct LawSpring {
    std::optional<Index> first;
    Index second;
    std::shared_ptr<const SpringLaw> law;

    bool joins(Index dof) const { return dof == second || (first && dof == *first); }
    double sign(Index dof) const { return dof == second ? 1.0 : -1.0; }
  };
  void add_spring(const LawSpring& spring) { law_springs_.push_back(spring); }
  const std::vector<LawSpring>& law_springs() const { return law_springs_; }

  /// A joint where the pressure on members ends, and which a support holds in x or z or both. Where the pressures on
  /// the members that end there less those on the members that begin there leave p, their potentials, areas about an
  /// origin, leave a part of the force on it: ½ p (−z, x) with its place (x, z). In a direction that is free this has a
  /// potential, as the other one is given.
  struct PressedEnd {
    Index x, z;     ///< degrees of freedom
    Vec2 rest;      ///< stress-free place, from the origin
    Driven excess;  ///< p [force/length]

    bool joins(Index dof) const { return dof == x || dof == z; }
    Index other(Index dof) const { return dof == x ? z : x; }
    /// By the place in the other direction [1/length].
    double factor(Index dof) const { return dof == x ? -0.5 : 0.5; }
    double rest_of_other(Index dof) const { return dof == x ? rest.y() : rest.x(); }
  };
  void add_pressed_end(const PressedEnd& end) { pressed_ends_.push_back(end); }
  const std::vector<PressedEnd>& pressed_ends() const { return pressed_ends_; }

  /// The terms of a path in λ from 0 to 1 that applies the constant parts of loads and supports: there these are the
  /// proportional parts, and those that were are left out. Springs stay.
  NodalTerms ramp() const {
    NodalTerms terms = *this;
    for (auto* list : {&terms.loads_, &terms.supports_})
      for (auto& [dof, value] : *list) value = {.constant = 0.0, .proportional = value.constant};
    for (PressedEnd& end : terms.pressed_ends_) end.excess = {.constant = 0.0, .proportional = end.excess.constant};
    return terms;
  }

  bool is_held(Index dof) const { return find(supports_, dof) != nullptr; }

  /// The load on a degree of freedom, the value of a held one, and the stiffness to ground; 0 where there is none.
  Driven load(Index dof) const { return value_or_zero(loads_, dof); }
  Driven support(Index dof) const { return value_or_zero(supports_, dof); }
  double ground_stiffness(Index dof) const { return value_or_zero(ground_, dof); }

  /// A spring between two degrees of freedom.
  struct Spring {
    Index first, second;
    double stiffness;

    bool joins(Index dof) const { return dof == first || dof == second; }
    Index other(Index dof) const { return dof == first ? second : first; }
  };
  const std::vector<Spring>& springs() const { return springs_; }

  /// Whether the degree of freedom is held at a value that is not always zero; and whether any is.
  bool is_displaced(Index dof) const { return !support(dof).is_zero(); }
  bool has_displaced_supports() const {
    return std::any_of(supports_.begin(), supports_.end(), [](const auto& entry) { return !entry.second.is_zero(); });
  }

  /// visit(degree of freedom, rate by λ) of each support that λ moves.
  template <class Visit>
  void for_each_moved_support(const Visit& visit) const {
    for (const auto& [dof, value] : supports_)
      if (value.proportional != 0.0) visit(dof, value.proportional);
  }

  /// Greatest proportional load [force]; `length_of(degree of freedom)` is 1, or the length that a moment is divided
  /// by.
  template <class LengthOf>
  double greatest_proportional_load(const LengthOf& length_of) const {
    double greatest = 0.0;
    for (const auto& [dof, load] : loads_) greatest = std::max(greatest, std::abs(load.proportional) / length_of(dof));
    return greatest;
  }

  /// Adds k u − p and the forces of springs to the forces F on the unknowns.
  template <class UnknownOf, class DisplacementOf>
  void add_forces(double lambda, const UnknownOf& unknown_of, const DisplacementOf& displacement_of, double* F) const {
    for (const auto& [dof, load] : loads_)
      if (const Index i = unknown_of(dof); i >= 0) F[i] -= load.at(lambda);
    for (const auto& [dof, k] : ground_)
      if (const Index i = unknown_of(dof); i >= 0) F[i] += k * displacement_of(dof);
    for (const Spring& spring : springs_) {
      const double force = spring.stiffness * (displacement_of(spring.second) - displacement_of(spring.first));
      if (const Index i = unknown_of(spring.first); i >= 0) F[i] -= force;
      if (const Index i = unknown_of(spring.second); i >= 0) F[i] += force;
    }
    for (const LawSpring& spring : law_springs_) {
      const double force = spring.law->at(stretch_of(spring, displacement_of)).force;
      if (const Index i = unknown_of(spring.second); i >= 0) F[i] += force;
      if (spring.first)
        if (const Index i = unknown_of(*spring.first); i >= 0) F[i] -= force;
    }
    for (const PressedEnd& end : pressed_ends_)
      for (const Index dof : {end.x, end.z})
        if (const Index i = unknown_of(dof); i >= 0) F[i] += force_of(end, dof, lambda, displacement_of);
  }

  /// Adds these forces and their derivatives to F, K and F_λ, and lists the stiffnesses in `ground`. K has the pattern
  /// of the structure, whose diagonal is complete.
  template <class UnknownOf, class DisplacementOf>
  void linearize(double lambda, const UnknownOf& unknown_of, const DisplacementOf& displacement_of,
                 Linearization& out) const {
    add_forces(lambda, unknown_of, displacement_of, out.F.data());
    for (const auto& [dof, load] : loads_)
      if (const Index i = unknown_of(dof); i >= 0) out.F_lambda[i] -= load.proportional;
    out.ground.clear();
    for (const auto& [dof, k] : ground_)
      if (const Index i = unknown_of(dof); i >= 0) {
        out.K.coeffRef(i, i) += k;
        out.ground.push_back({.row = i, .column = i, .stiffness = k});
      }
    for (const Spring& spring : springs_) linearize(spring, unknown_of, out);
    for (const LawSpring& spring : law_springs_) linearize(spring, unknown_of, displacement_of, out);
    for (const PressedEnd& end : pressed_ends_)
      for (const Index dof : {end.x, end.z})
        if (const Index i = unknown_of(dof); i >= 0)
          out.F_lambda[i] += force_rate_of(end, dof, lambda, displacement_of);
  }

  /// Σ ½ k u² − Σ p u, over free and held degrees of freedom, and the energy of springs between them.
  template <class DisplacementOf>
  double energy(double lambda, const DisplacementOf& displacement_of) const {
    double energy = 0.0;
    for (const auto& [dof, load] : loads_) energy -= load.at(lambda) * displacement_of(dof);
    for (const auto& [dof, k] : ground_) {
      const double u = displacement_of(dof);
      energy += 0.5 * k * u * u;
    }
    for (const Spring& spring : springs_) {
      const double stretch = displacement_of(spring.second) - displacement_of(spring.first);
      energy += 0.5 * spring.stiffness * stretch * stretch;
    }
    for (const LawSpring& spring : law_springs_) energy += spring.law->at(stretch_of(spring, displacement_of)).energy;
    for (const PressedEnd& end : pressed_ends_) energy += energy_of(end, lambda, displacement_of);
    return energy;
  }

  /// What the support of a held degree of freedom exerts besides the force of the elements: k ū − p and the forces of
  /// springs.
  template <class DisplacementOf>
  double support_force(Index dof, double lambda, const DisplacementOf& displacement_of) const {
    double force = ground_stiffness(dof) * support(dof).at(lambda) - load(dof).at(lambda);
    for (const Spring& spring : springs_)
      if (spring.joins(dof)) force += spring.stiffness * (displacement_of(dof) - displacement_of(spring.other(dof)));
    for (const LawSpring& spring : law_springs_)
      if (spring.joins(dof)) force += spring.sign(dof) * spring.law->at(stretch_of(spring, displacement_of)).force;
    for (const PressedEnd& end : pressed_ends_)
      if (end.joins(dof)) force += force_of(end, dof, lambda, displacement_of);
    return force;
  }

  /// Adds its derivatives by the unknowns, a vector, and by λ.
  template <class UnknownOf, class DisplacementOf, class Derivatives>
  void add_support_force_gradient(Index dof, double lambda, const UnknownOf& unknown_of,
                                  const DisplacementOf& displacement_of, Derivatives& by_unknowns,
                                  double& by_lambda) const {
    by_lambda += ground_stiffness(dof) * support(dof).proportional - load(dof).proportional;
    for (const Spring& spring : springs_) {
      if (!spring.joins(dof)) continue;
      const Index other = spring.other(dof), i = unknown_of(other);
      by_lambda += spring.stiffness * (support(dof).proportional - support(other).proportional);
      if (i >= 0) by_unknowns[i] -= spring.stiffness;
    }
    for (const LawSpring& spring : law_springs_) {
      if (!spring.joins(dof)) continue;
      const double k = spring.sign(dof) * spring.law->at(stretch_of(spring, displacement_of)).stiffness;
      by_lambda += k * stretch_rate(spring);
      if (const Index i = unknown_of(spring.second); i >= 0) by_unknowns[i] += k;
      if (spring.first)
        if (const Index i = unknown_of(*spring.first); i >= 0) by_unknowns[i] -= k;
    }
    for (const PressedEnd& end : pressed_ends_) {
      if (!end.joins(dof)) continue;
      by_lambda += force_rate_of(end, dof, lambda, displacement_of);
      if (const Index i = unknown_of(end.other(dof)); i >= 0) by_unknowns[i] += end.factor(dof) * end.excess.at(lambda);
    }
  }

  /// What loads and springs exert on a degree of freedom that is not held: p − k u and the forces of springs. Adds its
  /// derivatives by the unknowns and by λ.
  template <class UnknownOf, class DisplacementOf, class Derivatives>
  double force_on(Index dof, double lambda, const UnknownOf& unknown_of, const DisplacementOf& displacement_of,
                  Derivatives& by_unknowns, double& by_lambda) const {
    const double ground = ground_stiffness(dof);
    double resists = ground;
    for (const Spring& spring : springs_)
      if (spring.joins(dof)) resists += spring.stiffness;
    Derivatives against = Derivatives::Zero(by_unknowns.size());
    double against_lambda = 0.0;
    add_support_force_gradient(dof, lambda, unknown_of, displacement_of, against, against_lambda);
    if (const Index i = unknown_of(dof); i >= 0) against[i] += resists;
    by_unknowns -= against;
    by_lambda -= against_lambda;
    return -support_force(dof, lambda, displacement_of) - ground * displacement_of(dof);
  }

 private:
  template <class Value>
  using List = std::vector<std::pair<Index, Value>>;  // ascending by degree of freedom

  template <class Entries>
  static auto place(Entries& list, Index dof) {
    return std::lower_bound(list.begin(), list.end(), dof,
                            [](const auto& here, Index wanted) { return here.first < wanted; });
  }
  template <class Value>
  static Value& entry(List<Value>& list, Index dof) {
    auto at = place(list, dof);
    if (at == list.end() || at->first != dof) at = list.insert(at, {dof, Value{}});
    return at->second;
  }
  template <class Value>
  static const Value* find(const List<Value>& list, Index dof) {
    const auto at = place(list, dof);
    return at == list.end() || at->first != dof ? nullptr : &at->second;
  }
  template <class Value>
  static Value value_or_zero(const List<Value>& list, Index dof) {
    const Value* found = find(list, dof);
    return found == nullptr ? Value{} : *found;
  }

  template <class DisplacementOf>
  static double stretch_of(const LawSpring& spring, const DisplacementOf& displacement_of) {
    return displacement_of(spring.second) - (spring.first ? displacement_of(*spring.first) : 0.0);
  }
  // At fixed unknowns, by λ.
  double stretch_rate(const LawSpring& spring) const {
    return support(spring.second).proportional - (spring.first ? support(*spring.first).proportional : 0.0);
  }

  template <class UnknownOf, class DisplacementOf>
  void linearize(const LawSpring& spring, const UnknownOf& unknown_of, const DisplacementOf& displacement_of,
                 Linearization& out) const {
    const double k = spring.law->at(stretch_of(spring, displacement_of)).stiffness, rate = k * stretch_rate(spring);
    const Index a = spring.first ? unknown_of(*spring.first) : -1, b = unknown_of(spring.second);
    if (a >= 0) out.F_lambda[a] -= rate;
    if (b >= 0) out.F_lambda[b] += rate;
    for (const Index i : {a, b})
      if (i >= 0) out.K.coeffRef(i, i) += k;
    if (a >= 0 && b >= 0) out.K.coeffRef(std::max(a, b), std::min(a, b)) -= k;
    if ((a >= 0) != (b >= 0)) out.ground.push_back({.row = std::max(a, b), .column = std::max(a, b), .stiffness = k});
  }

  // With one direction free the force on it times its displacement, since the other is given. With both given: p times
  // the area that the radius to the joint has swept, by the constant displacements first, then by those in λ.
  template <class DisplacementOf>
  double energy_of(const PressedEnd& end, double lambda, const DisplacementOf& displacement_of) const {
    const double to_x = force_of(end, end.x, lambda, displacement_of) * displacement_of(end.x);
    const double to_z = force_of(end, end.z, lambda, displacement_of) * displacement_of(end.z);
    if (!is_held(end.x)) return to_x;
    if (!is_held(end.z)) return to_z;
    const Driven x = support(end.x), z = support(end.z);
    const double bend = 0.5 * lambda * (x.constant * z.proportional - z.constant * x.proportional);
    return to_x + to_z + end.excess.at(lambda) * bend;
  }

  // The force of a pressed end on one of its degrees of freedom, and its rate by λ at fixed unknowns.
  template <class DisplacementOf>
  static double force_of(const PressedEnd& end, Index dof, double lambda, const DisplacementOf& displacement_of) {
    const double place = end.rest_of_other(dof) + displacement_of(end.other(dof));
    return end.factor(dof) * end.excess.at(lambda) * place;
  }
  template <class DisplacementOf>
  double force_rate_of(const PressedEnd& end, Index dof, double lambda, const DisplacementOf& displacement_of) const {
    const double place = end.rest_of_other(dof) + displacement_of(end.other(dof));
    return end.factor(dof) *
           (end.excess.proportional * place + end.excess.at(lambda) * support(end.other(dof)).proportional);
  }

  // A spring whose other end is held is one to a ground that may move.
  template <class UnknownOf>
  void linearize(const Spring& spring, const UnknownOf& unknown_of, Linearization& out) const {
    const Index a = unknown_of(spring.first), b = unknown_of(spring.second);
    const double k = spring.stiffness;
    for (const Index i : {a, b})
      if (i >= 0) out.K.coeffRef(i, i) += k;
    if (a >= 0 && b >= 0) {
      out.K.coeffRef(std::max(a, b), std::min(a, b)) -= k;
    } else if (a >= 0 || b >= 0) {
      const Index i = std::max(a, b);
      out.F_lambda[i] -= k * support(a >= 0 ? spring.second : spring.first).proportional;
      out.ground.push_back({.row = i, .column = i, .stiffness = k});
    }
  }

  List<Driven> loads_, supports_;
  List<double> ground_;
  std::vector<Spring> springs_;
  std::vector<LawSpring> law_springs_;
  std::vector<PressedEnd> pressed_ends_;
};

}  // namespace arcwall
