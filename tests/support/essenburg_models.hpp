#pragma once

#include <vector>

#include "tests/support/models.hpp"

/// Beams whose thickness changes.
namespace arcwall::test {

/// A rectangular section for the Essenburg theory.
Section essenburg_section(double E, double nu, double width, double height, double shear_correction = 1.0);

/// How the beams of a model are computed.
struct EssenburgBeams {
  int order = 2;
  QuadraticTerm quadratic = QuadraticTerm::fixed;
  double shear_correction = 1.0;
};

/// The right half, 0 ≤ x ≤ 1, of Selke & Kikuchi's first example [kN, cm]: section 0.2 × 0.2, E = 21000, ν = 0.29, 0.08
/// above a flat foundation, upright at the middle (joint 0), on a roller at its end (joint 1), bent by an end moment λ.
/// `scale` multiplies the moment and the clearance.
struct EssenburgFoundation {
  int elements = 80;
  EssenburgBeams beams{};
  double scale = 1.0;
  double first_step = 0.05;

  std::unique_ptr<Structure> structure() const;
  std::vector<TestWall> walls() const;
  ContactModel model() const { return {structure(), walls(), first_step}; }
};

/// The channel of Selke & Kikuchi's second example [kN, cm]: pinned column of length 2, width 0.1, between walls 0.15
/// from its faces, E = 21000, ν = 0.29, pushed by λ at its sliding end (joint 1).
struct EssenburgChannel {
  int elements = 160;  ///< even
  double height = 0.1;
  EssenburgBeams beams{};
  std::vector<SineDeviation> imperfection{};
  double first_step = 0.05;

  std::unique_ptr<Structure> structure() const;
  std::vector<TestWall> walls() const;
  ContactModel model() const { return {structure(), walls(), first_step}; }
};

}  // namespace arcwall::test
