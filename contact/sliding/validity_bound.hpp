#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

class ValidityBound;

/// What validity bounds watch: one class each.
enum class BoundKind {
  clamp,
  coarse,
  curvature,
  edge_presses,
  end_stays,
  fine,
  friction,
  half_wave,
  holding_moment,
  length,
  lies_down,
  load_ahead,
  load_behind,
  load_beside_part,
  load_in_part,
  load_presses,
  loaded_part,
  neutral,
  pinch,
  pressure,
  pulling_jump,
  rolling,
  room,
  straight,
  straight_end,
  tail,
  tip_presses,
  unlike,
  upright,
};

/// How a state came to a validity bound.
struct Arrival {
  const Direction& forward;                ///< of the path
  double tolerance;                        ///< of bounds
  const ValidityBound* at_hand = nullptr;  ///< the bound that is passed: it is reached, however near it is
};

/// What a bound watches, in words for messages and events: a place of the body, and the obstacle there.
struct BoundPlace {
  MaterialPoint at{};
  std::optional<std::size_t> obstacle{};  ///< empty where none is touched
};

/// A condition without which a layout is not valid: a guard of the active sets that have the layout, with what lies
/// behind it.
///
/// Each kind of bound is one class, with its value, its gradient and its transitions side by side. An object of it
/// belongs to one tracked point, segment, pressed node or free end of a layout, and serves all states on that layout.
class ValidityBound {
 public:
  virtual ~ValidityBound() = default;

  virtual BoundKind kind() const = 0;

  /// Positive on the active set, of order 1.
  virtual double value(const SlidingSetting& setting, const SlidingState& at) const = 0;

  /// Derivative of the value by all unknowns.
  virtual Row gradient(const SlidingSetting& setting, const SlidingState& at) const = 0;

  /// Derivative of the value along a direction.
  virtual double rate(const SlidingSetting& setting, const SlidingMotion& motion) const {
    return apply(gradient(setting, motion.at), motion.direction);
  }

  /// What the bound watches.
  virtual BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const = 0;

  /// What may lie behind the bound, the likeliest first; where that depends on others of its kind that are reached
  /// together, for all of them.
  virtual std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                              const Arrival& arrival) const = 0;
};

/// A bound of one kind.
template <BoundKind of>
class BoundOfKind : public ValidityBound {
 public:
  static constexpr BoundKind kind_of = of;
  BoundKind kind() const final { return of; }
};

/// A bound as one of its kind; null if it is of another.
template <class Bound>
const Bound* as(const ValidityBound& bound) {
  return bound.kind() == Bound::kind_of ? static_cast<const Bound*>(&bound) : nullptr;
}

/// All bounds of a layout: of its tracked points, its segments, its pressed nodes and the free ends. To add a kind of
/// bound, write a class for it, with a BoundKind, and add a line in validity_bounds.cpp.
std::vector<std::unique_ptr<const ValidityBound>> validity_bounds(const SlidingBody& body,
                                                                  const SlidingContactLayout& on);

/// Whether a bound is reached at a state, surely or as nearly as mirror images of what is reached there: it is near
/// zero, and is so or below a little farther on. Of nearly straight bodies some are near zero all along.
bool is_reached(const ValidityBound& bound, const SlidingSetting& setting, const SlidingState& at,
                const Arrival& arrival);

/// The bounds of one kind that are reached together at a state.
template <class Bound>
std::vector<const Bound*> reached(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival) {
  std::vector<const Bound*> found;
  for (const auto& bound : at.layout.bounds())
    if (const auto* same = as<Bound>(*bound))
      if (is_reached(*same, setting, at, arrival)) found.push_back(same);
  return found;
}

}  // namespace arcwall::sliding
