#pragma once

#include <memory>

#include "elements/updated_element.hpp"

namespace arcwall {

/// The classic beam of Selke and Kikuchi's incremental scheme (eqs. 13 and 18 to 20): between two nodes straight in
/// each configuration, u linear and w cubic in the increments, axial force and bending moments carried along.
class UpdatedClassicBeam final : public UpdatedElement {
 public:
  /// Stresses [force], [force·length] at the nodes; moments turn the nodes anticlockwise.
  struct Resultants {
    double N = 0.0, M1 = 0.0, M2 = 0.0;
  };

  /// `chord`: between the nodes in the configuration at `u` [length].
  UpdatedClassicBeam(const double* u, const Vec2& chord, const Resultants& stresses, double EA, double EI,
                     double energy = 0.0);

  std::unique_ptr<Element> updated(const double* u) const override;

  const Resultants& stresses() const { return stresses_; }

 private:
  Vec2 chord_;
  Resultants stresses_;
  double EA_, EI_;
};

}  // namespace arcwall
