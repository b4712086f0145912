#pragma once

#include <functional>
#include <optional>

#include "elements/classic_beam.hpp"
#include "elements/elastica_beam.hpp"
#include "elements/element.hpp"
#include "elements/reissner_beam.hpp"
#include "elements/thermal_strain.hpp"
#include "elements/truss.hpp"

namespace arcwall {

/// A slender beam between two material points.
struct SlenderSection {
  double EA = 0.0, EI = 0.0;             ///< by stress-free length, without heat
  std::optional<ElasticaOrder> order{};  ///< of the elastica; empty: classic
  std::optional<StretchTaper> taper{};   ///< empty: the same all along
};

/// visit(beam) with that beam, by value, its stiffnesses times a factor. The classic beam is uniform: in its place
/// stands the elastica of the same order.
template <class Visit>
void with_slender_beam(const StretchReference& stretch, const SlenderSection& section, double stiffer,
                       const Visit& visit) {
  const double EA = stiffer * section.EA, EI = stiffer * section.EI;
  if (section.order || section.taper) {
    visit(ElasticaBeam(stretch, EA, EI, section.order.value_or(ElasticaOrder::four), section.taper));
  } else {
    visit(ClassicBeam(stretch, EA, EI));
  }
}

/// The rate by λ of what a beam under temperatures exerts on its ends, by (x1, z1, angle1, x2, z2, angle2).
Eigen::Matrix<double, 6, 1> heat_rate(const StretchReference& cold, const SlenderSection& section,
                                      const ThermalStrain& thermal, double lambda, const BeamEnds& ends);

/// A classic beam, or one of the elastica, under temperatures that λ may drive. Unknowns as in ClassicBeam.
class HeatedBeam final : public DrivenElement {
 public:
  HeatedBeam(const StretchReference& cold, const SlenderSection& section, const ThermalStrain& thermal)
      : cold_(cold), section_(section), thermal_(thermal) {}

  int unknown_count() const override { return 6; }
  double evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const override;

 private:
  StretchReference cold_;
  SlenderSection section_;
  ThermalStrain thermal_;
};

/// A ReissnerBeam under temperatures, likewise.
class HeatedReissnerBeam final : public DrivenElement {
 public:
  HeatedReissnerBeam(const ExactBeamReference& reference, const std::function<ExactBeamStiffness(double)>& stiffness,
                     const ThermalStrain& thermal)
      : beam_(reference, stiffness), thermal_(thermal) {}

  int unknown_count() const override { return beam_.unknown_count(); }
  double evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const override;

 private:
  ReissnerBeam beam_;
  ThermalStrain thermal_;
};

/// A bar under a temperature: U = ½ EA L (ε − e)².
class HeatedTruss final : public DrivenElement {
 public:
  HeatedTruss(const Vec2& chord, double EA, TrussStrain strain, const Driven& thermal)
      : bar_(chord, EA, strain), thermal_(thermal) {}

  int unknown_count() const override { return 4; }
  double evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const override;

 private:
  Truss bar_;
  Driven thermal_;
};

}  // namespace arcwall
