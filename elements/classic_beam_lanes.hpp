#pragma once

#include <array>

#include "elements/classic_beam.hpp"

namespace arcwall {

/// Four classic beams side by side: the same operations as ClassicBeam::evaluate, and so the same numbers.
class ClassicBeamLanes {
 public:
  explicit ClassicBeamLanes(const std::array<const ClassicBeam*, Lanes::count>& beams);

  /// `u` and `f` have six entries; `K`, where it is not null, receives the lower triangle of 6 × 6, column-major.
  void evaluate(const Lanes* u, Lanes* f, Lanes* K) const;

 private:
  ClassicBeamMaterial<Lanes> material_;
};

}  // namespace arcwall
