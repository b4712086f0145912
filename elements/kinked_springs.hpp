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
/// say which piece counts. This one takes it from the piece of the state (Piece::kinks).
///
/// With s = 1 of a kink at stretch u_k ≥ 0 and s = −1 of one below 0, the status of a kink is 0 up to it, seen from
/// rest, and 1 beyond it. Its guard is s (u_k − u)/w or s (u − u_k)/w, w the width of the law. On a piece that is left
/// a law goes on straight:
///
///     F = F_inner + Σ δ_k Δ_k (u − u_k) ∇u        δ_k = [u_k is passed, by the piece] − [u ≥ u_k]
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

  /// The state with a status of each kink: that of its piece, where this has any, else by the stretch.
  State with_kinks(State state) const;

  /// What the force of a spring, of those given, changes in its derivative by the unknowns and λ at a kink, where the
  /// inner system has taken the other piece.
  Row force_gradient_off(std::size_t spring, const State& state) const;

  Index size(const Piece& piece) const override { return inner_.size(piece); }
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;
  Vector weights(const Piece& piece) const override { return inner_.weights(piece); }
  std::vector<Index> turning_sets(const Piece& piece) const override { return inner_.turning_sets(piece); }
  double squared_motion_by_lambda(const Piece& piece) const override { return inner_.squared_motion_by_lambda(piece); }
  Index multiplier_count(const Piece& piece) const override { return inner_.multiplier_count(piece); }
  bool has_stability() const override { return inner_.has_stability(); }

  Piece open_piece() const override;
  Index guard_count(const Piece& piece) const override {
    return inner_.guard_count(piece.with_kinks({})) + kink_count();
  }
  Vector guards(const State& state) const override;
  double guard(const State& state, Index j) const override;
  Row guard_gradient(const State& state, Index j) const override;
  GuardsAlong guards_along(const State& state, const Direction& direction) const override;
  std::string watched_place(const State& state, Index j) const override;
  Vector unit_force(const State& state, Index j) const override;
  double compliance(const Piece& piece, Index j) const override;
  bool is_two_sided(const Piece& piece, Index j) const override;
  std::optional<Index> multiplier_index(const Piece& piece, Index j) const override;
  double multiplier_scale() const override { return inner_.multiplier_scale(); }
  Vector transfer(const Vector& x, const Piece& from, const Piece& to) const override {
    return inner_.transfer(x, from, to);
  }
  bool leaves_stability_open(const Piece& piece) const override { return inner_.leaves_stability_open(piece); }
  std::optional<std::string> invalid_place(const State& state) const override { return inner_.invalid_place(state); }

  std::vector<Transition> transitions(const State& state, const Direction& forward, Index bound,
                                      double tolerance) const override;
  bool admissible(const State& state, double margin) const override { return inner_.admissible(state, margin); }
  std::string most_inadmissible(const State& state, double margin) const override {
    return inner_.most_inadmissible(state, margin);
  }
  std::optional<Transition> with_inserted_contact(const State& from, const Direction& forward, const State& to,
                                                  double margin) const override;
  std::optional<Transition> with_mesh_for_landing(const State& from, const Direction& forward, const State& to,
                                                  Index guard) const override;
  bool passes_through(const State& from, const State& to) const override { return inner_.passes_through(from, to); }
  bool may_have_kink(const State& from, const State& to) const override { return inner_.may_have_kink(from, to); }
  bool comes_behind_an_end(const State& from, const State& to) const override {
    return inner_.comes_behind_an_end(from, to);
  }
  Piece canonical_piece(const State& state) const override {
    return inner_.canonical_piece(state).with_kinks_of(state.piece);
  }

 private:
  struct Kink {
    std::size_t spring;
    double stretch, jump;
    double sense;  // 1: passed upwards from rest; −1: downwards
    double width;
  };

  Index kink_count() const { return static_cast<Index>(kinks_.size()); }
  const Kink* kink(const Piece& piece, Index j) const;
  Index inner_number(const Piece& piece, Index j) const;
  double stretch(const Kink& kink, const State& state) const;
  Row stretch_gradient(const Kink& kink, const State& state) const;
  static double misplaced(const Kink& kink, bool beyond, double stretch);
  template <class Visit>
  void for_each_misplaced(const State& state, const Visit& visit) const;
  double kink_guard(const Kink& kink, const State& state, std::size_t j) const;
  Transition keeping_kinks(Transition transition, const Piece& from) const;

  const System& inner_;
  std::vector<Spring> springs_;
  std::vector<Kink> kinks_;
};

/// A force that springs with kinks are part of: as `inner` says, but at a kink its derivative is that on the piece of
/// the state.
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
