#pragma once

#include <memory>
#include <vector>

#include "elements/essenburg_beam.hpp"
#include "elements/updated_element.hpp"

namespace arcwall {

/// The Essenburg beam of Selke and Kikuchi's incremental scheme (eqs. 13 and 15 to 17): in each configuration the
/// stresses of Cauchy are carried at the quadrature points, and their increments are C times those of Green's strain.
class UpdatedEssenburgBeam final : public UpdatedElement {
 public:
  /// Without stress, but moved to u.
  UpdatedEssenburgBeam(const double* u, std::shared_ptr<const EssenburgElement> element);

  /// With Cauchy's stresses at the points of the element [force/length²].
  UpdatedEssenburgBeam(const double* u, std::shared_ptr<const EssenburgElement> element,
                       std::vector<Eigen::Matrix2d> stresses, double energy);

  std::unique_ptr<Element> updated(const double* u) const override;

  const std::vector<Eigen::Matrix2d>& stresses() const { return stresses_; }

 private:
  EssenburgElement::Response respond(std::size_t i, const Eigen::Matrix2d& F) const;

  std::shared_ptr<const EssenburgElement> element_;
  std::vector<Eigen::Matrix2d> stresses_;
};

}  // namespace arcwall
