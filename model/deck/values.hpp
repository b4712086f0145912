#pragma once

#include <string>
#include <vector>

/// What the parts of a deck are made of (model/deck/deck.hpp).
namespace arcwall::deck {

/// Where something stands in its source; says nothing about the value, so all positions are equal.
struct Position {
  int line = 0;        ///< counts from 1; 0: unknown
  int column = 0;      ///< counts from 1, in characters; 0: unknown
  int assignment = 0;  ///< the `--set` it came from, counts from 1; 0: the file

  friend bool operator==(const Position&, const Position&) { return true; }
};

/// What the deck was read from; like a position no part of its value.
struct Source {
  std::string file{};                      ///< as the user named it
  std::vector<std::string> assignments{};  ///< the texts of `--set key=value`

  friend bool operator==(const Source&, const Source&) { return true; }
};

/// A point or a vector of the plane: x along, z across.
struct Vector {
  double x = 0.0;
  double z = 0.0;

  bool operator==(const Vector&) const = default;
};

}  // namespace arcwall::deck
