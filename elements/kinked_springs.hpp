#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/observable.hpp"
#include "core/system.hpp"
#include "elements/spring_law.hpp"

namespace arcwall {

/// A system with springs whose laws are straight pieces (SpringLaw::Interpolation::linear), on each of which the
/// equations are smooth. The inner system takes the stiffness of a law from the stretch alone, which at a kink does not
/// say which active set counts. This one takes it from the active set of the state (ActiveSet::kinks).
///
/// With s = 1 of a kink at stretch u_k ≥ 0 and s = −1 of one below 0, the status of a kink is 0 up to it, seen from
/// rest, and 1 beyond it. Its guard is s (u_k − u)/w or s (u − u_k)/w, w the width of the law. On an active set that is
/// left a law goes on straight:
///
///     F = F_inner + Σ δ_k Δ_k (u − u_k) ∇u        δ_k = [u_k is passed, by the active set] − [u ≥ u_k]
///
/// where Δ_k is the jump of stiffness. δ_k (u − u_k) vanishes wherever the guards hold.
class KinkedSprings final : public System {
 public:
  struct Spring {
    std::shared_ptr<const SpringLaw> law;
    std::shared_ptr<const Observable> first, second;  ///< `first` is null of a spring to the ground
  };

  /// `inner` must outlive this; it has those springs, and entries of K for them. Laws without kinks change nothing.
  KinkedSprings(const System& inner, const std::vector<Spring>& springs);

  /// The state with a status of each kink: that of its active set, where this has any, else by the stretch.
  State with_kinks(State state) const;

  /// What the force of a spring, of those given, changes in its derivative by the unknowns and λ at a kink, where the
  /// inner system has taken the other active set.
  Row force_gradient_off(std::size_t spring, const State& state) const;

  Dimensions dimensions(const ActiveSet& active_set) const override { return inner_.dimensions(active_set); }
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;
  StateMetric metric(const ActiveSet& active_set) const override { return inner_.metric(active_set); }
  CountedDirections counted_directions(const ActiveSet& active_set) const override {
    return inner_.counted_directions(active_set);
  }

  ActiveSet open_active_set() const override;
  Vector guards(const State& state) const override;
  double guard(const State& state, Index j) const override;
  Row guard_gradient(const State& state, Index j) const override;
  GuardsAlong guards_along(const State& state, const Direction& direction) const override;
  std::string watched_place(const State& state, Index j) const override;
  Vector unit_force(const State& state, Index j) const override;
  Enforcement enforcement(const ActiveSet& active_set, Index j) const override;
  Vector transfer(const Vector& x, const ActiveSet& from, const ActiveSet& to) const override {
    return inner_.transfer(x, from, to);
  }

  std::vector<Transition> transitions(const State& state, const Direction& forward, Index bound,
                                      double tolerance) const override;
  StepVerdict check(const CheckedStep& step) const override;
  std::optional<std::string> penetrated_place(const State& state, double margin) const override {
    return inner_.penetrated_place(state, margin);
  }
  std::optional<PathKink> kink_between(const State& from, const State& to) const override {
    return inner_.kink_between(from, to);
  }
  Index separate_contacts(const ActiveSet& active_set) const override { return inner_.separate_contacts(active_set); }
  ActiveSet canonical_active_set(const State& state) const override {
    return inner_.canonical_active_set(state).with_kinks_of(state.active_set);
  }

 private:
  struct Kink {
    std::size_t spring;
    double stretch, jump;
    double sense;  // 1: passed upwards from rest; −1: downwards
    double width;
  };

  Index kink_count() const { return static_cast<Index>(kinks_.size()); }
  const Kink* kink(const ActiveSet& active_set, Index j) const;
  Index inner_number(const ActiveSet& active_set, Index j) const;
  double stretch(const Kink& kink, const State& state) const;
  Row stretch_gradient(const Kink& kink, const State& state) const;
  static double misplaced(const Kink& kink, bool beyond, double stretch);
  template <class Visit>
  void for_each_misplaced(const State& state, const Visit& visit) const;
  double kink_guard(const Kink& kink, const State& state, std::size_t j) const;
  Transition keeping_kinks(Transition transition, const ActiveSet& from) const;

  const System& inner_;
  std::vector<Spring> springs_;
  std::vector<Kink> kinks_;
};

/// A force that springs with kinks are part of: as `inner` says, but at a kink its derivative is that on the active set
/// of the state.
class KinkedForce final : public Observable {
 public:
  struct Part {
    std::size_t spring;  ///< of those of `springs`
    double sign;
  };

  /// `springs` must outlive this.
  KinkedForce(const KinkedSprings& springs, std::shared_ptr<const Observable> inner, std::vector<Part> parts)
      : springs_(springs), inner_(std::move(inner)), parts_(std::move(parts)) {}

  double value(const State& state) const override { return inner_->value(state); }
  Row gradient(const State& state) const override;

 private:
  const KinkedSprings& springs_;
  std::shared_ptr<const Observable> inner_;
  std::vector<Part> parts_;
};

}  // namespace arcwall
