#pragma once

#include <cmath>

#include "core/types.hpp"
#include "model/deck/values.hpp"

namespace arcwall::deck {

struct Deck;

/// Coordinates of a structure's own place and size, in which its model computes.
///
/// A place of the user's coordinates is origin + 2^exponent · (the place in the frame). Displacements and other lengths
/// have the factor alone. Forces, angles and λ are the same in both. A power of two keeps all digits, and so does the
/// origin.
struct Frame {
  Vector origin{};
  int exponent = 0;

  bool is_users() const { return *this == Frame{}; }

  /// Returns what the power `length` of a length in the frame is in the user's unit.
  double factor(int length = 1) const { return std::ldexp(1.0, exponent * length); }

  /// Returns a place of the frame in the user's coordinates.
  Vec2 place(const Vec2& here) const { return is_users() ? here : Vec2(origin.x, origin.z) + factor() * here; }

  /// Returns a place of the user's coordinates in the frame.
  Vec2 here(const Vec2& place) const { return is_users() ? place : factor(-1) * (place - Vec2(origin.x, origin.z)); }

  bool operator==(const Frame&) const = default;
};

/// Returns the frame for a deck in the user's coordinates: the user's own for a structure of ordinary size that is not
/// far from the origin.
Frame frame_of(const Deck& deck);

/// Returns a deck in the user's coordinates in those of a frame. Values of λ and of monitors remain the user's.
Deck in_frame(Deck deck, const Frame& frame);

}  // namespace arcwall::deck
