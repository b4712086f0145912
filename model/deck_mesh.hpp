#pragma once

#include <initializer_list>
#include <memory>
#include <vector>

#include "core/observable.hpp"
#include "model/model.hpp"

namespace arcwall {

/// Where Newton's method may begin with moving contact points, from an equilibrium with contact at the nodes: the
/// likeliest first, as nodes hardly tell whether contact is at a point, along a part without pressure or along one with
/// pressure. Each is within an element of what it is meant for. `touching`: gaps below which open nodes touch, too, one
/// after the other [scale of guards].
std::vector<State> in_moving_formulation(const Assembly& of, const State& equilibrium,
                                         std::initializer_list<double> touching);

/// The states of a model on the deck's own mesh, whose unknowns always mean the same and whose contacts are those of
/// nodes: what is sought beside the traced path is sought there. Where contact slides, the states of the path have
/// other unknowns; there is a way to and fro.
class DeckMesh {
 public:
  /// `model` must outlive this.
  explicit DeckMesh(const Model& model);

  /// Whether every unknown of the deck's mesh can be read off the model's states.
  bool is_complete() const;

  /// The structure among the walls, with contact at its nodes.
  const System& system() const;

  Index size() const { return size_; }

  /// Equilibria at one λ that are nearer than this are the same [path metric]: one of nodes and one of the path, and
  /// two of the path. With contact at nodes all are solutions of the same equations; where contact moves, meshes
  /// differ.
  double same_of_nodes() const { return same_equations() ? 1e-6 : 0.03; }
  double same_on_path() const { return same_equations() ? 1e-6 : 0.003; }

  /// The unknowns of the structure in a state of the model, whichever mesh that has.
  Vector unknowns(const State& of_model) const;

  /// These as a state of system(), without contact forces.
  State state(const Vector& unknowns, double lambda) const;

  /// Between the unknowns of two states, in the path metric, whatever multiples of 2π rotations have [-].
  double distance(const Vector& a, const Vector& b) const;

  /// Of a change of the unknowns, likewise.
  double length(const Vector& change) const;

  /// in_moving_formulation() of an equilibrium of system(), where contact points move.
  std::vector<State> in_path_formulation(const State& equilibrium) const;

 private:
  Vector values(const State& state) const;
  bool same_equations() const { return model_.sliding() == nullptr; }

  const Model& model_;
  Index size_;
  std::vector<Index> turning_sets_;
  std::vector<std::shared_ptr<const Observable>> readings_{};  // empty where states have the deck's mesh
  Vector rest_{};
};

}  // namespace arcwall
