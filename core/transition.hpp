#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/deferred.hpp"
#include "core/observable.hpp"
#include "core/state.hpp"

namespace arcwall {

/// Describes a family of equilibria in which only the total length of several contact zones is determined.
struct Continuum {
  Index parts = 0;      ///< number of contact zones; new ones are still points
  double energy = 0.0;  ///< total potential [force·length]
  double length = 0.0;  ///< total length of the zones [length]
};

/// Describes the next active set and layout beyond a validity bound.
struct Transition {
  enum class Change {
    spreads,    ///< a contact point becomes a contact zone, an arch between two points, or both
    gathers,    ///< a contact zone becomes a contact point; only the new layout locates it
    splits,     ///< a contact zone separates in its interior
    joins,      ///< the reverse, or a whole tail or a tip is touched; the place is known on the active set ahead alone
    passes,     ///< a contact at the end of a member moves inside, or one that has come to it stays there
    remeshed,   ///< the same point with other unknowns
    continuum,  ///< a family of equilibria with the same load and energy
    unsupported,  ///< a contact configuration that is not modelled
    blocked,      ///< nothing: a wall has come to a place that supports hold
  };
  Change change = Change::remeshed;
  std::string detail{};  ///< of the last three: what and why
  /// That lies ahead, of which the active set ahead, where there is one, keeps one member.
  std::optional<Continuum> continuum{};
  /// That change: in the active set before; of `gathers`, of `joins`, and of `splits` without a quantity in the active
  /// set ahead.
  std::vector<Index> contacts{};
  Deferred<State> guess{};  ///< on the active set ahead, near the first point there; may be made when it is tried
  Direction forward{};      ///< there, roughly; without entries: not known
  /// Has `value` at the first point of the active set ahead and grows along it. Null: the first point lies in the plane
  /// through the guess across `forward`.
  std::shared_ptr<const Observable> quantity{};
  double value = 0.0;
  double least = 0.0;  ///< of the quantity: below that the active set is not looked at, which round-off may hide, or
                       ///< which is tried otherwise
  /// The equations of the active set before are singular at the change: guards that should vanish together miss each
  /// other by more than elsewhere, and neither signs of eigenvalues nor the tangent are sure there.
  bool from_singular = false;
};

}  // namespace arcwall
