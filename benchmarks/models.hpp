#pragma once

#include <memory>

#include "elements/structure.hpp"

namespace arcwall::bench {

/// A structure with one way that shows where its path is.
struct Model {
  std::unique_ptr<Structure> structure{};
  std::shared_ptr<const Observable> down{};  ///< way of the loaded point [length]
  double end = 0.0;                          ///< where the path is followed to, in the same unit
  double first_step = 0.0;                   ///< of λ
  Index elements = 0;
};

/// Lee, Manuel and Rossow 1968: column and beam of equal length, pinned at the far ends, loaded at 1/5 of the beam.
/// Half of the elements are the column's.
Model lee_frame(int elements);

/// Arches of the same rise over spans from 1 to 2 that share their crown, which is loaded: `arms` half-arches of
/// `elements` elements each. They snap through together.
Model star_of_arches(int arms, int elements);

/// A square lattice of side × side rigid joints whose rows are shallow arches between clamped ends, under a load on
/// each joint. They snap through together.
Model square_frame(int side);

/// The side that gives about this many unknowns.
int square_side(Index unknowns);

State rest(const Structure& structure);

}  // namespace arcwall::bench
