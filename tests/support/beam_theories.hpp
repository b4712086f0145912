#pragma once

#include <string>
#include <vector>

#include "elements/structure.hpp"

namespace arcwall::test {

/// How the beams of a model are computed.
struct BeamTheory {
  std::string name = "classic";
  Theory theory = Theory::euler_bernoulli;
  int order = 2;        ///< as in MemberDescription
  int convergence = 4;  ///< exponent of the element length in the error
  int on_circles = 6;   ///< the same where the axis bends to a circle; 0: exact
  int finer = 1;        ///< elements for what one of order four needs
};

/// Theories whose limit is the extensible elastica: no flexibility in shear.
inline std::vector<BeamTheory> elastica_theories() {
  return {BeamTheory{},
          {.name = "elastica, order 4", .theory = Theory::elastica, .order = 4, .convergence = 4, .on_circles = 0}};
}

/// Theories whose limit is Reissner's beam: extensible and flexible in shear.
inline std::vector<BeamTheory> shear_theories() {
  return {
      {.name = "exact, linear", .theory = Theory::reissner, .order = 1, .convergence = 2, .on_circles = 2, .finer = 2},
      {.name = "exact, quadratic", .theory = Theory::reissner, .order = 2, .convergence = 4, .on_circles = 4}};
}

/// Theories of both kinds, for models in which no force shears or stretches the beam.
inline std::vector<BeamTheory> all_beam_theories() {
  std::vector<BeamTheory> all = elastica_theories();
  for (BeamTheory& theory : shear_theories()) all.push_back(std::move(theory));
  return all;
}

/// A section by its stiffnesses; GA concerns the theories that are flexible in shear.
inline Section section_of(double EA, double EI, double GA = 0.0) {
  return {.E = 1.0, .A = EA, .I = EI, .G = 1.0, .shear_area = GA};
}

}  // namespace arcwall::test
