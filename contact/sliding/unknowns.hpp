#pragma once

#include <map>
#include <optional>
#include <utility>

#include "contact/sliding/layout.hpp"
#include "core/state.hpp"

namespace arcwall {

/// Where the unknowns of an active set of sliding contact stand in State::x, one block behind the other:
///
///     x   `nodes`    positions and rotations of the mesh's nodes              unknowns of the mesh
///     N              of these the last, `straights`: axial forces             multipliers
///     p   `closed`   forces of the closed contacts, in the active set's order      multipliers, with −g = 0
///     p   `pressed`  forces of the pressed nodes, in the layout's order       multipliers, with −g = 0
///     p   `neutral`  forces that hold the middles of neutral spans            multipliers, with −c = 0
///     τ   `pinched`  forces along the axis at pinched points                  multipliers, with −c = 0
///     m   `tips`     moments that hold the tangency at pressed tips           multipliers, with −t = 0
///     T   `rubbing`  forces of friction, of closed contacts in their order    multipliers, with w − σ = 0
///     m   `points`   moments that hold the tangency at the tracked points     multipliers, with −t = 0
///     w   `rubbing`  places on the obstacle that hold these contacts          the border, with the law of friction
///     s   `points`   material coordinates of the tracked points               the border
///
/// All but w and s are unknowns of K. Equations stand in the same order; that of s_k says that the body may slide at
/// point k.
class SlidingUnknowns {
 public:
  /// `active_set` must outlive this.
  explicit SlidingUnknowns(const ActiveSet& active_set);

  Index nodes = 0;      ///< entries of x, with those of N
  Index straights = 0;  ///< entries of N
  Index closed = 0;     ///< forces of closed contacts
  Index pressed = 0;    ///< forces of pressed nodes
  Index neutral = 0;    ///< neutral spans
  Index pinched = 0;    ///< pinched points
  Index tips = 0;       ///< pressed tips
  Index rubbing = 0;    ///< closed contacts with friction
  Index points = 0;     ///< tracked points

  Index behind_mesh() const { return closed + pressed + neutral + pinched + tips + rubbing + points; }
  Index multipliers() const { return straights + behind_mesh(); }
  Index of_K() const { return nodes + behind_mesh(); }
  Index border() const { return rubbing + points; }
  Index size() const { return of_K() + border(); }

  /// Index of the force of a contact in State::x; empty where it is open.
  std::optional<Index> force(std::size_t contact) const;

  Index pressed_force(std::size_t node) const { return nodes + closed + static_cast<Index>(node); }
  Index holding_force(std::size_t span) const { return nodes + closed + pressed + static_cast<Index>(span); }
  Index force_along(std::size_t pinched_point) const { return holding_force(0) + neutral + Index(pinched_point); }
  Index tip_moment(std::size_t tip) const { return force_along(0) + pinched + static_cast<Index>(tip); }
  Index moment(Index point) const { return tip_moment(0) + tips + rubbing + point; }
  Index coordinate(Index point) const { return of_K() + rubbing + point; }

  /// Index of the friction force of a contact, and of the place that holds it; empty without friction.
  std::optional<Index> friction(std::size_t contact) const;
  std::optional<Index> place(std::size_t contact) const;

 private:
  std::optional<Index> rank(std::size_t contact) const;

  const ActiveSet* active_set_;
};

/// Unknowns for another active set of the same points and mesh; what is new there is zero.
Vector moved_unknowns(const Vector& x, const ActiveSet& from, const ActiveSet& to);

/// Numbers at the places of segments that several bounds have in common. Each is computed when it is first asked for.
class SharedByBounds {
 public:
  template <class Compute>
  double at(std::size_t segment, Index place, const Compute& compute) {
    const auto [known, is_new] = known_.try_emplace({segment, place}, 0.0);
    if (is_new) known->second = compute();
    return known->second;
  }

 private:
  std::map<std::pair<std::size_t, Index>, double> known_;
};

/// A state of sliding contact with its unknowns by name. A view: `state` must outlive it.
struct SlidingState {
  explicit SlidingState(const State& of)
      : state(of),
        layout(sliding_layout(of.active_set)),
        mesh(layout.mesh()),
        index(of.active_set),
        now(mesh_state_of(of)) {}
  SlidingState(State&&) = delete;

  const State& state;
  const SlidingContactLayout& layout;
  const SlidingMesh& mesh;
  SlidingUnknowns index;
  MeshState now;                     ///< x, s and λ
  mutable SharedByBounds pressures;  ///< at the places of pressed parts, see CurvePressure

  std::size_t contacts() const { return state.active_set.contacts(); }
  bool is_closed(std::size_t contact) const { return state.active_set[contact] != 0; }
  double s(Index point) const { return now.s[point]; }
  bool rubs(std::size_t contact) const { return arcwall::rubs(state.active_set, contact); }

  /// Of a contact, 0 where it is open [force].
  double force(std::size_t contact) const {
    const auto at = index.force(contact);
    return at ? state.x[*at] : 0.0;
  }
  double pressed_force(std::size_t node) const { return state.x[index.pressed_force(node)]; }
  double moment(Index point) const { return state.x[index.moment(point)]; }

  /// A derivative that is still zero.
  Row no_slope() const { return {.dx = Vector::Zero(state.x.size()), .dlambda = 0.0}; }
};

/// A state and the direction in which it moves. A view: both must outlive it.
struct SlidingMotion {
  const SlidingState& at;
  const Direction& direction;
  mutable SharedByBounds pressure_rates{};  ///< along the direction, at the places of pressed parts
};

}  // namespace arcwall
