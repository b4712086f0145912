#pragma once

#include <algorithm>
#include <array>

#include "elements/distributed_load.hpp"
#include "elements/element.hpp"
#include "elements/slender_beam.hpp"

namespace arcwall {

/// What acts along a stretch, on an element of a classic or elastica beam, whose unknowns it has: displacements and
/// rotations of both ends. `Acting` answers to the places and angles of these, as StretchFoundation does.
template <class Acting>
class OnSlenderBeam final : public Element {
 public:
  /// `given`: what `Acting` is made with.
  template <class Given>
  OnSlenderBeam(const StretchReference& stretch, const Given& given)
      : acting_(stretch, given), chord_(stretch.chord), angles_{stretch.angles.front(), stretch.angles.back()} {}

  int unknown_count() const override { return 6; }

  double evaluate(const double* u, double* f, double* K) const override {
    const Vec2 second = chord_ + Vec2(u[3], u[4]);
    const auto response = acting_.respond({u[0], u[1]}, angles_[0] + u[2], second, angles_[1] + u[5]);
    if (f != nullptr) std::copy_n(response.force.data(), response.force.size(), f);
    if (K != nullptr) std::copy_n(response.stiffness.data(), response.stiffness.size(), K);
    return response.energy;
  }

 private:
  Acting acting_;
  Vec2 chord_;
  std::array<double, 2> angles_;
};

}  // namespace arcwall
