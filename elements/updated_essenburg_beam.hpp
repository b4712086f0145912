#pragma once

#include <memory>
#include <vector>

#include "elements/essenburg_beam.hpp"
#include "elements/updated_element.hpp"

namespace arcwall {

/// The Essenburg beam of Selke and Kikuchi's incremental scheme (eqs. 13 to 17): increments of Green's strain in the
/// present configuration, stresses of the second kind C times them, Cauchy stresses carried along at the quadrature
/// points. C stays what it is on the section's present axes: the material is not that of EssenburgBeam at large
/// strains.
class UpdatedEssenburgBeam final : public UpdatedElement {
 public:
  struct Material {
    EssenburgLaw law{};
    std::vector<EssenburgNode> sections{};
    std::vector<EssenburgPoint> points{};
  };
  using Stresses = std::vector<Eigen::Matrix2d>;  ///< Cauchy, on the global axes, one a quadrature point

  /// Stress-free.
  UpdatedEssenburgBeam(std::shared_ptr<const Material> material, const double* u);

  UpdatedEssenburgBeam(std::shared_ptr<const Material> material, const double* u, Stresses stresses, double energy);

  std::unique_ptr<Element> updated(const double* u) const override;

  const Stresses& stresses() const { return stresses_; }

 private:
  template <int nodes>
  void respond();

  std::shared_ptr<const Material> material_;
  Stresses stresses_;
};

}  // namespace arcwall
